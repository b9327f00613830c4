"""Many designs at once: insertion gain and natural frequencies by the compiled frequency-domain solution.

SI units, Hz and dB. Source of the model: the paper (see :mod:`trackig_core.track.design`). Every design is
solved as ``solve(design, "exact")`` does, within 0.01 dB; the compiled code stands in
:mod:`trackig_core.frequency_domain.batch_kernels`.
"""

import numbers
import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import dataclass, fields
from functools import cached_property, partial
from typing import TYPE_CHECKING, Any, TypeAlias, TypeVar, cast

import numpy as np
from numpy.typing import NDArray

from trackig_core.arrays import AnyArray, BoolArray, RealArray
from trackig_core.bands import BAND_CENTRES, BAND_EDGES, BAND_LABELS, LINE_FRACTION, decibels
from trackig_core.frequency_domain import batch_kernels as kernels
from trackig_core.frequency_domain import wave_kernels
from trackig_core.frequency_domain.kernel_rows import law_row
from trackig_core.frequency_domain.natural_frequencies import natural_frequencies
from trackig_core.frequency_domain.refinement import banded_spectrum, stiff_spectrum
from trackig_core.frequency_domain.static_lattice import (
    bending_stiffness,
    point_compliance,
    support_stiffness,
)
from trackig_core.frequency_domain.track_model import track_model
from trackig_core.levels.insertion_gain import (
    REFERENCES,
    SUMMATIONS,
    check_choice,
    integrate_bands,
    line_over_rigid,
    rigid_band_energy,
    summed_energy,
)
from trackig_core.results import SolveCancelled
from trackig_core.track.damping_table import interpolated_terms
from trackig_core.track.design import (
    ELEMENTS_PER_BAY,
    ONE_AXLE,
    PATHS,
    RANGES,
    REFERENCE_FREQUENCY,
    DesignError,
    Rail,
    TrackDesign,
    numbers_by_part,
    with_numbers,
)
from trackig_core.track.fields import DEFAULT_WHEEL_LOAD, check_number
from trackig_core.track.static_stiffness import stand_in
from trackig_core.track.viscoelastic_law import NEGLIGIBLE, relaxation

if TYPE_CHECKING:
    import pandas

Columns: TypeAlias = dict[str, AnyArray]
"""Fields of many designs by name: arrays of numbers, or of objects."""

_Made = TypeVar("_Made")

Row: TypeAlias = int | tuple[int, ...]
Shape: TypeAlias = tuple[int, ...]

FIELDS = tuple(each.name for each in fields(TrackDesign))
"""Fields of a design, in order."""

SURROUNDINGS = ("suspension", "axle_positions", "speed", "ground")
"""Fields that are off by default."""

STIFF_FIELDS = ("fastener_spacing", "wheel_mass", "rail", *SURROUNDINGS)
"""Fields on which the very stiff reference track depends."""

CHUNK = 256
"""Designs that a thread solves at a time [-]: some 10 ms, after which progress is reported."""

INTERVALS_PER_BAND = 6
"""Intervals per band from which spectra are refined [-]. Half as many as those of one exact solve cost
0.0002 dB in 99 designs of 100 and 0.003 dB at worst, since refinement finds every peak from either."""

_PER_DESIGN = (len(SUMMATIONS), len(BAND_CENTRES))

_BAND_CUBES = np.diff(BAND_EDGES**3) / 3


@dataclass(frozen=True, eq=False, repr=False)
class BatchSolution:
    """Insertion gain and natural frequencies of many designs.

    ``...`` below is the shape to which the designs' fields broadcast: ``(n,)`` for ``n`` designs.

    Attributes
    ----------
    columns : dict of str to numpy.ndarray (...)
        Every field of the designs, by name [SI units]; arrays of objects where a field is not a number.
    loaded_track : numpy.ndarray (...) [Hz]
        Loaded-track frequencies.
    coupled_block : numpy.ndarray (...) [Hz]
        Frequencies of the block between pad and boot; NaN when single-stage.
    resolved : numpy.ndarray of bool (...)
        False where some resonances are too sharp to be resolved: do not trust their bands.
    energy_ratio : numpy.ndarray of float32 (..., 2, 21) [-]
        Band energy over that of the exact rigid track: energy sum, coherent sum.
    line_ratio : numpy.ndarray (..., 2) [-]
        Height of the reference line over the exact rigid track: energy sum, coherent sum; NaN on ground that
        yields.
    reference, summation : str
        Definition of :attr:`insertion_gain`.
    wheel_load : float [N]
        Static load of the wheel, for :attr:`rail_deflection`.
    stiff_ratio : numpy.ndarray (..., 2, 21) [-] or None
        Band energy of the very stiff reference track over that of the exact rigid track; None where no design
        stands on ground that yields, and it is computed when it is asked for.
    """

    columns: Columns
    loaded_track: RealArray
    coupled_block: RealArray
    resolved: BoolArray
    energy_ratio: NDArray[np.float32]
    line_ratio: RealArray
    reference: str = "line"
    summation: str = "energy"
    wheel_load: float = DEFAULT_WHEEL_LOAD
    stiff_ratio: RealArray | None = None

    @property
    def band_centres(self) -> RealArray:
        """Exact mid-band frequencies (21,) [Hz]."""
        return BAND_CENTRES

    @cached_property
    def insertion_gain(self) -> RealArray:
        """Insertion gain per band (..., 21) [dB]."""
        return self.gain_for(self.reference, self.summation)

    def gain_for(self, reference: str = "line", summation: str = "energy") -> RealArray:
        """Return the insertion gain for any definition, without solving the designs again.

        Parameters
        ----------
        reference : str
            ``"line"``, ``"rigid"`` or ``"stiff"``, see :func:`trackig_core.solve`.
        summation : str
            ``"energy"`` or ``"coherent"``.

        Returns
        -------
        numpy.ndarray (..., 21)
            Levels [dB].

        Raises
        ------
        ValueError
            If a choice is not one of the above, or the reference has no meaning for one of the designs.
        """
        _check_reference(self.columns, reference)
        check_choice("summation", summation, SUMMATIONS)
        kind = SUMMATIONS.index(summation)
        levels = self.energy_ratio[..., kind, :].astype(float)
        np.log10(levels, out=levels)  # in place: a million designs take 168 MB
        levels *= 10
        if reference == "line":
            levels -= decibels(self.line_ratio[..., kind, None])
        elif reference == "stiff":
            levels -= decibels(self._stiff_ratio[..., kind, :])
        return levels

    @cached_property
    def _stiff_ratio(self) -> RealArray:
        """Band energy of the very stiff reference tracks, whenever it was computed (..., 2, 21) [-]."""
        if self.stiff_ratio is not None:
            return self.stiff_ratio
        return _stiff_ratios(self.columns).reshape(*self.loaded_track.shape, *_PER_DESIGN)

    @cached_property
    def rail_deflection(self) -> RealArray:
        """Static deflection of the rail under the wheel, over a support (...) [m]."""
        spacing = self.columns["fastener_spacing"].astype(float)
        rails = self.columns["rail"]
        rail = np.array([rail.bending_stiffness for rail in rails.flat]).reshape(rails.shape)
        support = support_stiffness(_static(self.columns, "pad"), _static(self.columns, "boot"))
        return self.wheel_load * point_compliance(support, bending_stiffness(rail, spacing))

    @cached_property
    def deflection_at_least(self) -> BoolArray:
        """Whether the rail sinks at least so far, a dynamic stiffness standing in for a static one (...)."""
        pad, boot = (_missing(self.columns[f"{part}_static_stiffness"]) for part in ("pad", "boot"))
        return pad | (boot & ~_missing(self.columns["boot_stiffness"]))

    def column(self, name: str) -> AnyArray:
        """Return a field of all designs, or a number of their suspensions or grounds.

        Parameters
        ----------
        name : str
            Name of a field, or path of a number, such as ``"ground.stiffness"``.

        Returns
        -------
        numpy.ndarray (...)
            Values [unit of the field]; NaN where a design has no such number of a part.
        """
        part, _, number = name.partition(".")
        values = self.columns[part]
        if not number:
            return values
        found = [getattr(each, number, None) for each in values.flat]
        return np.array(found, dtype=float).reshape(values.shape)

    def design(self, row: Row) -> TrackDesign:
        """Return one of the designs.

        Parameters
        ----------
        row : int or tuple of int
            Its place.

        Returns
        -------
        TrackDesign
            The design.
        """
        return _design({name: values[row] for name, values in self.columns.items()})

    def __repr__(self) -> str:
        """Return the designs' number, their loaded-track frequencies and the definition, on one line."""
        found, number = self.loaded_track, self.loaded_track.size
        tracks = f", loaded track {found.min():.1f} to {found.max():.1f} Hz" if number else ""
        return (
            f"<BatchSolution: {number} design{'s' * (number != 1)}{tracks}, "
            f"reference {self.reference}, summation {self.summation}>"
        )

    def to_dataframe(self) -> "pandas.DataFrame":
        """Return a table of the designs.

        Returns
        -------
        pandas.DataFrame
            One row a design: fields [SI units], natural frequencies [Hz], static deflection [m], bands [dB].
        """
        import pandas as pd

        columns: Columns = {}
        for name in FIELDS:
            if name not in SURROUNDINGS or _is_on(name, self.columns[name]):
                paths = [path for path in PATHS if path.partition(".")[0] == name]
                shown = {each: self.column(each).ravel() for each in paths or [name]}
                columns |= {each: values for each, values in shown.items() if not _is_nowhere(values)}
        columns["rail"] = np.array([rail.name for rail in columns["rail"]])
        columns["loaded_track"] = self.loaded_track.ravel()
        columns["coupled_block"] = self.coupled_block.ravel()
        columns["rail_deflection"] = self.rail_deflection.ravel()
        bands = self.insertion_gain.reshape(-1, len(BAND_LABELS))
        return pd.DataFrame(columns | dict(zip(BAND_LABELS, bands.T, strict=True)))


def solve_many(
    base: TrackDesign | Sequence[TrackDesign] | None = None,
    *,
    reference: str | None = None,
    summation: str = "energy",
    threads: int | None = None,
    progress: Callable[[float], object] | None = None,
    cancelled: Callable[[], bool] | None = None,
    designs: Sequence[TrackDesign] | None = None,
    wheel_load: float = DEFAULT_WHEEL_LOAD,
    **arrays: object,
) -> BatchSolution:
    """Compute the insertion gain and natural frequencies of many tracks, as ``solve(design, "exact")`` does.

    Designs of one unsprung wheel on rigid ground are solved by compiled code, hundreds in the time that one
    with a suspension, several axles or ground that yields takes; those are solved one by one.

    Parameters
    ----------
    base : TrackDesign or sequence of TrackDesign
        The design whose fields are varied, or all designs themselves.
    reference : str, optional
        As for :func:`trackig_core.solve`; the result has the gain for each. By default the line, or if any
        design stands on ground that yields, the very stiff track.
    summation : str
        ``"energy"`` or ``"coherent"``; the result has the gain for either.
    threads : int, optional
        Threads that solve side by side; by default one for each processor.
    progress : callable, optional
        Called now and then with the fraction done, 0 to 1, from the calling thread.
    cancelled : callable, optional
        Asked now and then; the run ends when it answers true.
    designs : sequence of TrackDesign, optional
        All designs, by name in place of ``base``.
    wheel_load : float
        Static load of the wheel, which sinks the rail by ``rail_deflection`` [N].
    **arrays : array_like
        Values by name of a field of the design, or by path of a number of its suspension or ground as in
        ``**{"ground.stiffness": array}`` [unit of the field]: numbers, rails or measured curves, which are
        broadcast against each other as NumPy does.

    Returns
    -------
    BatchSolution
        Insertion gain (..., 21) [dB], natural frequencies (...) [Hz] and static deflection (...) [m].

    Raises
    ------
    DesignError
        If a value is not allowed; the message names row and field.
    SolveCancelled
        If ``cancelled`` answered true.
    ValueError
        If a choice is not one of the above, a reference has no meaning for one of the designs, or shapes do
        not broadcast.
    """
    check_choice("summation", summation, SUMMATIONS)
    wheel_load = check_number("wheel_load", wheel_load)
    if isinstance(base, TrackDesign):
        columns = _varied(base, arrays)
    elif arrays:
        raise ValueError(f"{next(iter(arrays))}: give one design as base to vary its fields")
    else:
        columns = _columns_of(designs if base is None else base)
    if reference is None:
        reference = "stiff" if _is_on("ground", columns["ground"]) else "line"
    _check_reference(columns, reference)
    shape = columns["rail"].shape
    count = columns["rail"].size
    rows = {
        "loaded_track": np.empty(count),
        "coupled_block": np.empty(count),
        "resolved": np.empty(count, dtype=bool),
        "energy_ratio": np.empty((count, *_PER_DESIGN), dtype=np.float32),
        "line_ratio": np.empty((count, 2)),
    }
    yields = _is_on("ground", columns["ground"])
    if yields:  # there is no other reference
        rows["stiff_ratio"] = np.empty((count, *_PER_DESIGN))

    def solve_chunk(begin: int) -> None:
        chunk = slice(begin, min(begin + CHUNK, count))
        within = {name: values.flat[chunk] for name, values in columns.items()}
        try:
            for name, values in _solved(within).items():
                rows[name][chunk] = values
            if yields:
                rows["stiff_ratio"][chunk] = _stiff_ratios(within)
        except DesignError as error:
            raise _in_row(error, begin + cast("int", error.row), shape) from None  # it counts from the chunk

    _run(solve_chunk, range(0, count, CHUNK), threads, progress, cancelled)
    return BatchSolution(
        columns=columns,
        reference=reference,
        summation=summation,
        wheel_load=wheel_load,
        **{name: values.reshape(shape + values.shape[1:]) for name, values in rows.items()},
    )


def _run(
    work: Callable[[int], None],
    chunks: range,
    threads: int | None,
    progress: Callable[[float], object] | None,
    cancelled: Callable[[], bool] | None,
) -> None:
    """Do all chunks, several at a time, watching from the calling thread."""
    threads = threads or os.cpu_count() or 1
    with ThreadPoolExecutor(min(threads, max(1, len(chunks)))) as pool:
        try:
            futures = [pool.submit(work, begin) for begin in chunks]
            for done, future in enumerate(as_completed(futures), start=1):
                future.result()
                if progress is not None:
                    progress(done / len(chunks))
                if cancelled is not None and cancelled():
                    raise SolveCancelled("the run was cancelled")
        except BaseException:
            pool.shutdown(wait=True, cancel_futures=True)
            raise


def _in_row(error: DesignError, place: int, shape: Shape) -> DesignError:
    """Return a DesignError that names the row, a number or for several axes a tuple."""
    row = place if len(shape) == 1 else tuple(int(index) for index in np.unravel_index(place, shape))
    return DesignError(error.field, error.value, error.allowed, row)


def _columns_of(designs: Iterable[TrackDesign] | None) -> Columns:
    """Return the fields of given designs as columns."""
    designs = list(designs if designs is not None else ())
    for row, design in enumerate(designs):
        if not isinstance(design, TrackDesign):
            raise DesignError("design", design, "a TrackDesign, such as PRESETS['slab-track']", row)
    return {name: _column([getattr(design, name) for design in designs], name) for name in FIELDS}


def _is_on(name: str, values: AnyArray) -> bool:
    """Return whether any design has a suspension, several axles, a speed or ground that yields."""
    off = ONE_AXLE if name == "axle_positions" else None
    return any(each != off for each in values.flat)


def _check_reference(columns: Columns, reference: str) -> None:
    """Raise a ValueError if there is no such reference, or if it has no meaning for one of the designs."""
    check_choice("reference", reference, REFERENCES)
    if reference != "stiff" and _is_on("ground", columns["ground"]):
        row = next(place for place, each in enumerate(columns["ground"].flat) if each is not None)
        raise ValueError(
            f"reference = {reference!r}: give 'stiff', for row {row} stands on ground that yields, and "
            "against a rigid track the ground's own amplification would count as the track's"
        )


def _varied(base: TrackDesign, arrays: Mapping[str, object]) -> Columns:
    """Return the fields of a design, some of them varied, as checked columns of one shape."""
    given = {name: _column(values, name) for name, values in arrays.items()}
    shape = np.broadcast_shapes((1,), *(values.shape for values in given.values()))
    given = {name: np.broadcast_to(values, shape) for name, values in given.items()}
    if np.prod(shape):
        _first_row(base, given)
    objects = {name: values for name, values in given.items() if values.dtype == object}
    for name, values in given.items():
        if name not in objects:
            _check_numbers(name, values)
    if set(objects) - {"rail"}:
        for place in range(int(np.prod(shape))):
            row = {name: _plain(values.flat[place]) for name, values in given.items()}
            _checked(partial(base.replace, **row), place, shape)
    elif objects:
        rails = objects["rail"]
        for place, rail in enumerate(rails.flat):
            if not isinstance(rail, Rail):
                raise _in_row(DesignError("rail", rail, "a Rail, such as RAILS['60']"), place, shape)
    columns = {name: np.broadcast_to(_column(getattr(base, name), name), shape) for name in FIELDS}
    columns |= {name: values for name, values in given.items() if name in FIELDS}
    for part, changes in numbers_by_part(given).items():
        columns[part] = _changed_part(columns[part], part, changes)
    if "boot_static_stiffness" not in given:  # it leaves with its boot
        missing = _missing(columns["boot_stiffness"])
        if missing.any():
            static = columns["boot_static_stiffness"].astype(object)
            static[missing] = None
            columns["boot_static_stiffness"] = static
    return columns


def _changed_part(whole: AnyArray, part: str, changes: Mapping[str, AnyArray]) -> AnyArray:
    """Return a column of suspensions or grounds (...) with numbers (...) of theirs changed."""
    changed = np.empty(whole.shape, dtype=object)
    rows = zip(whole.flat, *(values.flat for values in changes.values()), strict=True)
    for place, (each, *values) in enumerate(rows):
        row = dict(zip(changes, map(_plain, values), strict=True))
        changed.flat[place] = _checked(partial(with_numbers, each, part, row), place, whole.shape)
    return changed


def _first_row(base: TrackDesign, given: Columns) -> None:
    """Raise a DesignError if fields do not exist or do not come together."""
    _checked(
        lambda: base.replace(**{name: _plain(values.flat[0]) for name, values in given.items()}),
        0,
        next((values.shape for values in given.values()), (1,)),
    )


def _checked(make: Callable[[], _Made], place: int, shape: Shape) -> _Made:
    """Return what is made, or raise a DesignError that names the row."""
    try:
        return make()
    except DesignError as error:
        raise _in_row(error, place, shape) from None


def _column(values: Any, name: str) -> AnyArray:
    """Return values as an array of floats, or else of objects."""
    if isinstance(values, Rail):
        values = [values]
    if name == "axle_positions":
        return _axle_column(values)
    array = np.asarray(values)
    if array.dtype.kind in "iuf":
        return array.astype(float, copy=False)
    if array.dtype != object:
        array = array.astype(object)
    return array


def _axle_column(values: Any) -> AnyArray:
    """Return positions of axles, or a sequence of them, as an array of tuples."""
    rows = list(values)
    if not rows or isinstance(rows[0], numbers.Number):
        rows = [rows]
    array = np.empty(len(rows), dtype=object)
    array[:] = [None if row is None else tuple(row) for row in rows]
    return array


def _missing(values: AnyArray) -> BoolArray:
    """Return where a column has None."""
    if values.dtype != object:
        return np.zeros(values.shape, dtype=bool)
    return np.array([value is None for value in values.flat], dtype=bool).reshape(values.shape)


def _is_nowhere(values: AnyArray) -> bool:
    """Return whether no design has such a number."""
    return values.dtype == float and bool(np.isnan(values).all())


def _static(columns: Columns, part: str) -> RealArray:
    """Return the static stiffness of pad or boot, infinite where there is none (...) [N/m]."""
    static, dynamic = columns[f"{part}_static_stiffness"], columns[f"{part}_stiffness"]
    if static.dtype != object:
        return static
    pairs = zip(static.flat, dynamic.flat, strict=True)
    stiffness = [np.inf if k is None else stand_in(s, k) for s, k in pairs]
    return np.array(stiffness, dtype=float).reshape(static.shape)


def _plain(value: Any) -> Any:
    return value.item() if isinstance(value, np.generic) else value


def _check_numbers(name: str, values: RealArray) -> None:
    """Raise a DesignError for the first number that is out of its range."""
    low, high, _ = RANGES[name]
    wrong = ~((values >= low) & (values <= high))  # NaN is neither
    if wrong.any():
        place = int(np.argmax(wrong))
        _checked(lambda: check_number(name, float(values.flat[place])), place, values.shape)


def _design(row: Mapping[str, Any]) -> TrackDesign:
    return TrackDesign(**{name: _plain(value) for name, value in row.items()})


def _solved(columns: Columns) -> dict[str, AnyArray]:
    """Solve a chunk of designs (n,); errors name the row within."""
    others = [
        row
        for row, (suspension, positions, ground) in enumerate(
            zip(columns["suspension"], columns["axle_positions"], columns["ground"], strict=True)
        )
        if not (suspension is ground is None and positions == ONE_AXLE)
    ]
    if not others:
        return _solved_simplified(columns)
    count = len(columns["rail"])
    rows = {row: _solved_alone(columns, row) for row in others}
    plain = np.setdiff1d(np.arange(count), others)
    if plain.size:
        try:
            found = _solved_simplified({name: values[plain] for name, values in columns.items()})
        except DesignError as error:
            error_row = int(plain[cast("int", error.row)])
            raise DesignError(error.field, error.value, error.allowed, error_row) from None
        rows |= {int(row): {name: found[name][place] for name in found} for place, row in enumerate(plain)}
    return {name: np.array([rows[row][name] for row in range(count)]) for name in rows[others[0]]}


def _solved_alone(columns: Columns, row: int) -> dict[str, Any]:
    """Solve one design of a chunk with all that stands around it."""
    try:
        model = track_model(_design({name: values[row] for name, values in columns.items()}))
        spectrum = banded_spectrum(model)
    except DesignError as error:
        raise DesignError(error.field, error.value, error.allowed, row) from None
    rigid = rigid_band_energy(model.design, spectrum.step)
    frequencies = natural_frequencies(model)
    energies = [summed_energy(spectrum, summation) for summation in SUMMATIONS]
    lines = np.full(len(SUMMATIONS), np.nan)
    if model.design.ground is None:
        loaded = frequencies.loaded_track
        lines = np.array([line_over_rigid(spectrum, model.design, loaded, each) for each in SUMMATIONS])
    block = frequencies.coupled_block
    return {
        "loaded_track": frequencies.loaded_track,
        "coupled_block": np.nan if block is None else block,
        "resolved": spectrum.frequency.size <= kernels.MOST_FREQUENCIES,
        "energy_ratio": np.array([integrate_bands(spectrum.frequency, each) for each in energies]) / rigid,
        "line_ratio": lines,
    }


def _stiff_ratios(columns: Columns) -> RealArray:
    """Return band energy of very stiff reference tracks over that of the exact rigid track (n, 2, 21) [-].

    Designs that differ in supports alone have the same reference, which is computed once.
    """
    known: dict[tuple[object, ...], RealArray] = {}
    rows = []
    for place, key in enumerate(zip(*(columns[name].flat for name in STIFF_FIELDS), strict=True)):
        if key not in known:
            row = {name: values.flat[place] for name, values in columns.items()}
            known[key] = _stiff_over_rigid(_design(row))
        rows.append(known[key])
    return np.array(rows).reshape(-1, *_PER_DESIGN)


def _stiff_over_rigid(design: TrackDesign) -> RealArray:
    """Return band energy of a design's very stiff reference over that of the rigid track (2, 21) [-]."""
    stiff = stiff_spectrum(design)
    energies = [integrate_bands(stiff.frequency, summed_energy(stiff, summation)) for summation in SUMMATIONS]
    return np.array(energies) / rigid_band_energy(design, stiff.step)


def _solved_simplified(columns: Columns) -> dict[str, AnyArray]:
    """Solve a chunk of designs (n,), one unsprung wheel and rigid ground each; errors name the row within."""
    tracks = _tracks(columns)
    count = len(tracks)
    energy, heights = np.empty((count, 2, len(BAND_CENTRES))), np.empty((count, 2))
    found, sound = np.empty((count, 2)), np.empty(count, dtype=np.int64)
    kernels.solve_rows(tracks, BAND_EDGES, INTERVALS_PER_BAND, LINE_FRACTION, energy, heights, found, sound)
    if (sound < 0).any():
        row = int(np.argmin(sound))
        raise _loss_error(columns, row, "more loss: rounding drowns the exact spectrum of this design")
    # E = (m_w w^2 step)^2 / w^2 of the rigid track
    rigid = ((2 * np.pi * tracks[:, wave_kernels.WHEEL_MASS]) ** 2)[:, None]
    return {
        "loaded_track": found[:, 0],
        "coupled_block": found[:, 1],
        "resolved": sound == 1,
        "energy_ratio": energy / (rigid[..., None] * _BAND_CUBES),
        "line_ratio": heights / rigid,
    }


def _loss_error(columns: Columns, row: int, allowed: str) -> DesignError:
    """Return a DesignError about the loss of the spring that stands on the ground."""
    part = "pad" if _plain(columns["block_mass"][row]) is None else "boot"
    name = f"{part}_loss_factor"
    return DesignError(name, _plain(columns[name][row]), allowed, row)


def _tracks(columns: Columns) -> RealArray:
    """Return a chunk of designs as the kernels take them (n, 19)."""
    two_stage = np.array([mass is not None for mass in columns["block_mass"]])
    tracks = np.zeros((two_stage.size, wave_kernels.COLUMNS))
    pads, boots = (tracks[:, first : first + 7] for first in (wave_kernels.PAD, wave_kernels.BOOT))
    for laws, part in ((pads, "pad"), (boots, "boot")):
        stiffness, loss_factor = columns[f"{part}_stiffness"], columns[f"{part}_loss_factor"]
        _fill_laws(laws, stiffness, loss_factor, columns["stiffness_frequency"].astype(float))
    grounded = np.where(two_stage[:, None], boots, pads)
    lossless = ~(grounded[:, 1:4] > 0).any(axis=1)
    if lossless.any():
        allowed = "more than 0: without loss the exact spectrum has no bound"
        raise _loss_error(columns, int(np.argmax(lossless)), allowed)
    dx = columns["fastener_spacing"].astype(float) / ELEMENTS_PER_BAY
    rails = columns["rail"]
    masses = columns["block_mass"]
    tracks[:, wave_kernels.BLOCK_MASS] = np.where(two_stage, masses, 0.0).astype(float)
    tracks[:, wave_kernels.BENDING] = np.array([rail.bending_stiffness for rail in rails]) / dx**3
    tracks[:, wave_kernels.ELEMENT_MASS] = np.array([rail.mass_per_metre for rail in rails]) * dx
    tracks[:, wave_kernels.WHEEL_MASS] = columns["wheel_mass"]
    tracks[:, wave_kernels.CONTACT] = columns["contact_stiffness"]
    return tracks


def _fill_laws(laws: RealArray, stiffness: AnyArray, loss_factor: AnyArray, stated: RealArray) -> None:
    """Fill in the laws (n, 7) of springs, stiffnesses stated at given frequencies; zeros for no spring."""
    if stiffness.dtype == loss_factor.dtype == float:
        _fill_constant(laws, stiffness, loss_factor, stated)
        return
    plain = np.array(
        [
            isinstance(k, float) and isinstance(eta, float)
            for k, eta in zip(stiffness, loss_factor, strict=True)
        ]
    )
    if plain.any():
        constant = laws[plain]
        _fill_constant(
            constant, stiffness[plain].astype(float), loss_factor[plain].astype(float), stated[plain]
        )
        laws[plain] = constant
    for row in np.flatnonzero(~plain):
        if stiffness[row] is not None:
            laws[row] = law_row(
                relaxation(_plain(stiffness[row]), _plain(loss_factor[row]), float(stated[row]))
            )


def _fill_constant(laws: RealArray, stiffness: RealArray, loss_factor: RealArray, stated: RealArray) -> None:
    """Fill in the laws (n, 7) of springs of constant loss factors."""
    strengths, times, _ = interpolated_terms(loss_factor)
    strengths[loss_factor < NEGLIGIBLE] = 0.0
    relaxed = strengths / (1 + (2 * np.pi * REFERENCE_FREQUENCY * times) ** 2)
    instantaneous = 1.0 + relaxed.sum(axis=1)
    if (stated != REFERENCE_FREQUENCY).any():
        there = strengths / (1 + (2 * np.pi * stated[:, None] * times) ** 2)
        stiffness = stiffness / (instantaneous - there.sum(axis=1))
    laws[:, 0] = stiffness * instantaneous
    laws[:, 1:4] = stiffness[:, None] * strengths
    laws[:, 4:7] = times
