"""Spectra and insertion gain over the bands, on a frequency axis that is refined until it shows every peak.

Hz, N2 s2 and dB. Source of the model: the paper (see :mod:`trackig_core.track.design`); the lattice is
solved by :mod:`trackig_core.frequency_domain.floquet_waves`.
"""

from collections.abc import Callable
from dataclasses import replace
from functools import lru_cache

import numpy as np

from trackig_core.arrays import BoolArray, RealArray
from trackig_core.bands import LINE_FRACTION, ONE_THIRD_OCTAVES, WIDEST, Bands
from trackig_core.frequency_domain import batch_kernels
from trackig_core.frequency_domain.axles import wheel_delays
from trackig_core.frequency_domain.batch_kernels import (
    MOST_FREQUENCIES,
    MOST_HALVINGS,
    STRAIGHTNESS,
    WIDEST_STEP,
)
from trackig_core.frequency_domain.floquet_waves import exact_spectrum
from trackig_core.frequency_domain.kernel_rows import recursion_row, surroundings_row, wheel_row
from trackig_core.frequency_domain.lattice import INFINITE, Lattice
from trackig_core.frequency_domain.natural_frequencies import loaded_track
from trackig_core.frequency_domain.track_model import Track, TrackModel, track_model
from trackig_core.levels.insertion_gain import insertion_gain, own_reference
from trackig_core.results import ForceSpectrum, InsertionGain
from trackig_core.track.design import DEFAULT_STEP, ELEMENTS_PER_BAY, ONE_AXLE, DesignError, TrackDesign

STIFF_PAD = 1e13
"""Pad of the very stiff reference track [N/m]."""

STIFF_LOSS = 0.1
"""Its loss factor [-]. It has next to nothing to lose, but without loss waves of the pinned-pinned shape
would never die between supports far apart."""

STIFF_CONTACT = 1e15
"""Contact spring of the very stiff reference track [N/m]."""

POINTS_PER_FRINGE = 8
"""Frequencies per fringe of wheels that follow each other [-]."""


def resolved_spectrum(
    design: Track, frequency: RealArray, step: float, lattice: Lattice = INFINITE
) -> ForceSpectrum:
    """Return a track's spectrum on a frequency axis that is refined until it shows every peak.

    Parameters
    ----------
    design : TrackDesign or TrackModel
        The track and its wheel.
    frequency : numpy.ndarray (frequencies,)
        Frequencies to begin with [Hz], ascending and greater than zero; all are kept.
    step : float
        Height of the step [m].
    lattice : Lattice
        What to solve.

    Returns
    -------
    ForceSpectrum
        Energy at the given and the added frequencies.
    """
    model = track_model(design)
    if model.causal and _is_compiled(model, lattice):
        surroundings, wheels = np.empty(0), np.empty(0, dtype=np.int64)
        if not model.is_simplified:
            surroundings, wheels = surroundings_row(model.design), wheel_row(model.design)
        axis, energy, coherent_energy = batch_kernels.resolve_row(
            model.row, surroundings, wheels, *_stepping(model, lattice), frequency
        )
        return ForceSpectrum(axis, energy * step**2, coherent_energy * step**2, step)
    return refined_spectrum(lambda between: exact_spectrum(model, between, step, lattice), frequency)


def _is_compiled(model: TrackModel, lattice: Lattice) -> bool:
    """Return whether compiled code refines a track on a lattice.

    On the infinite track it does, and the paper's simplified model on every lattice whose rail only bends,
    but those for study. Wheels that follow each other meet the same roughness: fringes are not refined.
    """
    if not model.is_simplified:
        return lattice == INFINITE and (model.design.speed is None or len(model.design.axle_positions) == 1)
    euler = lattice.rail == "euler" and lattice.elements_per_bay == ELEMENTS_PER_BAY
    ring_in_continuous_time = lattice.bays is not None and lattice.time_step is None
    return euler and not ring_in_continuous_time


def _stepping(model: TrackModel, lattice: Lattice) -> tuple[RealArray, float, int]:
    """Return recursions, time step and ring as compiled code takes them."""
    if lattice.time_step is None:
        return np.zeros((2, 7)), 0.0, 0
    rows = [recursion_row(law, lattice.time_step, lattice.memory_order) for law in (model.pad, model.boot)]
    return np.stack(rows), lattice.time_step, lattice.bays or 0


def refined_spectrum(
    spectrum_at: Callable[[RealArray], ForceSpectrum], frequency: RealArray
) -> ForceSpectrum:
    """Return any model's spectrum on a frequency axis that is refined until it shows every peak.

    Intervals are halved until a straight line between neighbours, in decibels, misses the spectrum
    by no more than ``STRAIGHTNESS``, and no interval is more than ``WIDEST_STEP`` times as wide as
    the next.

    Parameters
    ----------
    spectrum_at : callable
        ``spectrum_at(frequency)`` returns the ForceSpectrum at an array of frequencies [Hz].
    frequency : numpy.ndarray (frequencies,)
        Frequencies to begin with [Hz], ascending and greater than zero; all are kept.

    Returns
    -------
    ForceSpectrum
        Energy at the given and the added frequencies.
    """
    known = spectrum_at(frequency)
    rows = np.array([known.frequency, known.energy, known.coherent_energy])
    straight = np.zeros(rows.shape[1] - 1, dtype=bool)
    for _ in range(MOST_HALVINGS):
        halved = np.flatnonzero(~straight)
        left, right = rows[:, halved], rows[:, halved + 1]
        between = spectrum_at((left[0] + right[0]) / 2)
        middle = np.array([between.frequency, between.energy, between.coherent_energy])
        ratio = middle[1:] ** 2 / (left[1:] * right[1:])
        with np.errstate(invalid="ignore", divide="ignore"):  # energies that rounding drowns; reported below
            bend = np.abs(np.log(ratio)).max(axis=0)
        straight[halved] = ~(bend > 2 * STRAIGHTNESS / 10 * np.log(10))
        straight = np.insert(straight, halved, straight[halved])
        rows = np.insert(rows, halved + 1, middle, axis=1)
        straight &= ~_too_wide(np.diff(rows[0]))
        if straight.all() or rows.shape[1] > MOST_FREQUENCIES:
            break
    return ForceSpectrum(frequency=rows[0], energy=rows[1], coherent_energy=rows[2], step=known.step)


def _too_wide(intervals: RealArray) -> BoolArray:
    """Return which intervals are much wider than a neighbour: a peak's flank may look straight by chance."""
    neighbour = np.full_like(intervals, np.inf)
    neighbour[1:] = intervals[:-1]
    neighbour[:-1] = np.minimum(neighbour[:-1], intervals[1:])
    return intervals > WIDEST_STEP * neighbour


def require_damping(design: Track) -> None:
    """Raise a DesignError if a design has no exact spectrum.

    With a loss-free spring on the ground there is a frequency at which waves never die along the track.

    Parameters
    ----------
    design : TrackDesign or TrackModel
        The track.

    Raises
    ------
    DesignError
        If the spring that stands on the ground has no loss.
    """
    model = track_model(design)
    ground = model.design.ground
    if ground is not None and ground.damping > 0:
        return
    if model.springs[-1].lossless or (ground is not None and ground.mass > 0):
        field, value = _grounded_loss(model)
        raise DesignError(field, value, "more than 0: without loss the exact spectrum has no bound")


def _grounded_loss(model: TrackModel) -> tuple[str, object]:
    """Return name and value of the loss of what stands on the ground: a spring, or a mass that moves with it.

    A mass on the ground's spring alone lets waves run without loss at its own frequency.
    """
    ground = model.design.ground
    if ground is not None and ground.mass > 0:
        return "ground.damping", ground.damping
    field = "boot_loss_factor" if model.design.two_stage else "pad_loss_factor"
    return field, getattr(model.design, field)


def band_frequencies(lowest: float, bands: Bands = ONE_THIRD_OCTAVES) -> RealArray:
    """Return frequencies from which a spectrum over all bands may be refined.

    Parameters
    ----------
    lowest : float
        Loaded-track frequency, at a tenth of which the line is anchored [Hz].
    bands : Bands
        One-third octaves that the spectrum has to cover.

    Returns
    -------
    numpy.ndarray (frequencies,)
        Frequencies [Hz], ascending, among them every band edge and the anchor if it lies below the bands.
    """
    anchor = LINE_FRACTION * lowest
    low, over = bands.edges[0], _over(bands)
    return over if anchor >= low else np.concatenate([np.geomspace(anchor, low, 12)[:-1], over])


@lru_cache(maxsize=8)
def _over(bands: Bands) -> RealArray:
    """Return frequencies from which a spectrum over bands is refined [Hz], among them every band edge."""
    return np.geomspace(bands.edges[0], bands.edges[-1], 12 * (len(bands.edges) - 1) + 1)


def banded_spectrum(
    design: Track,
    lattice: Lattice = INFINITE,
    step: float = DEFAULT_STEP,
    bands: Bands = ONE_THIRD_OCTAVES,
) -> ForceSpectrum:
    """Return the spectrum over all one-third-octave bands, and down to where the line is anchored.

    Parameters
    ----------
    design : TrackDesign or TrackModel
        The track and its wheel.
    lattice : Lattice
        What to solve.
    step : float
        Height of the step [m].
    bands : Bands
        One-third octaves to cover.

    Returns
    -------
    ForceSpectrum
        Energy at frequencies that resolve every peak and include every band edge.

    Raises
    ------
    DesignError
        If the spring on the ground has no loss, or so little that the spectrum cannot be told from rounding.
    """
    model = track_model(design)
    require_damping(model)
    if model.design.speed is not None and len(model.design.axle_positions) > 1:
        spectrum = _fringed(model, step, lattice, bands)
    else:
        first = band_frequencies(loaded_track(model), bands)
        spectrum = resolved_spectrum(model, first, step, lattice)
    if not ((spectrum.energy > 0) & np.isfinite(spectrum.energy)).all():
        field, value = _grounded_loss(model)
        raise DesignError(field, value, "more loss: rounding drowns the exact spectrum of this design")
    return spectrum


def _fringed(model: TrackModel, step: float, lattice: Lattice, bands: Bands) -> ForceSpectrum:
    """Return the spectrum under wheels that follow each other over the same roughness.

    Its peaks are those under independent roughness. The delays put fringes on them, as narrow as the inverse
    of the longest delay and down to zero: a fixed number of frequencies shows each, where refinement would
    not end.
    """
    independent = replace(model, design=model.design.replace(speed=None))
    axis = banded_spectrum(independent, lattice, step, bands).frequency
    delays = wheel_delays(model.design)
    longest = 0.0 if delays is None else delays.max()
    parts = np.ceil(np.diff(axis) * longest * POINTS_PER_FRINGE).astype(int).clip(1)
    # every interval in equal parts
    place = np.arange(parts.sum()) - np.repeat(np.cumsum(parts) - parts, parts)
    between = np.repeat(axis[:-1], parts) + place * np.repeat(np.diff(axis) / parts, parts)
    return exact_spectrum(model, np.append(between, axis[-1]), step, lattice)


def very_stiff(design: TrackDesign) -> TrackDesign:
    """Return the very stiff track that serves as a reference.

    It has the same rail, ground, wheel and suspension; single-stage, its pads hardly yield and neither does
    its contact, so that no resonance of its own lies in the bands (the paper's raised contact). Nor does that
    of a wheel on the rail between supports: one wheel stands over a support, and counts for each of the
    design's. On rigid ground it tends to the rigid track.

    Parameters
    ----------
    design : TrackDesign
        The track to be compared with it.

    Returns
    -------
    TrackDesign
        The reference track.
    """
    return design.replace(
        pad_stiffness=STIFF_PAD,
        pad_loss_factor=STIFF_LOSS,
        block_mass=None,
        boot_stiffness=None,
        boot_loss_factor=None,
        contact_stiffness=STIFF_CONTACT,
        axle_positions=ONE_AXLE,
        speed=None,
    )


def stiff_spectrum(design: TrackDesign) -> ForceSpectrum:
    """Return the spectrum of the very stiff reference track of a design, all its wheels together.

    Parameters
    ----------
    design : TrackDesign
        The track to be compared with it.

    Returns
    -------
    ForceSpectrum
        Energy over all bands that may be chosen, in continuous time on the infinite track, whatever solves
        the design.

    Raises
    ------
    DesignError
        If the ground has a mass but no damping.
    """
    one, wheels = _stiff_spectrum(very_stiff(design)), len(design.axle_positions)
    return ForceSpectrum(one.frequency, wheels * one.energy, wheels * one.coherent_energy, one.step)


@lru_cache(maxsize=64)
def _stiff_spectrum(stiff: TrackDesign) -> ForceSpectrum:
    model = track_model(stiff)
    if stiff.ground is not None:
        require_damping(model)
    return resolved_spectrum(model, band_frequencies(WIDEST.centres[-1], WIDEST), DEFAULT_STEP)


def gain_of(
    model: TrackModel,
    spectrum: ForceSpectrum,
    reference: str | None = None,
    summation: str = "energy",
    bands: Bands = ONE_THIRD_OCTAVES,
) -> InsertionGain:
    """Return the insertion gain of a track whose spectrum is known.

    Parameters
    ----------
    model : TrackModel
        The track.
    spectrum : ForceSpectrum
        Its spectrum.
    reference : str or None
        As for :func:`trackig_core.insertion_gain`; None: the design's own, the line, or on ground that yields
        the very stiff track.
    summation : str
        As for :func:`trackig_core.insertion_gain`.
    bands : Bands
        Bands, which the spectrum covers.

    Returns
    -------
    InsertionGain
        Levels and the energies behind them.

    Raises
    ------
    ValueError
        If a choice is not one of those there are, or the reference has no meaning for the design.
    """
    reference = own_reference(model.design) if reference is None else reference
    stiff = stiff_spectrum(model.design) if reference == "stiff" else None
    return insertion_gain(spectrum, model.design, loaded_track(model), reference, summation, bands, stiff)


def banded_gain(
    design: Track, lattice: Lattice = INFINITE, reference: str | None = None, summation: str = "energy"
) -> InsertionGain:
    """Return the insertion gain of a track by the frequency-domain solution.

    Parameters
    ----------
    design : TrackDesign or TrackModel
        The track and its wheel.
    lattice : Lattice
        What to solve.
    reference, summation : str
        As for :func:`gain_of`.

    Returns
    -------
    InsertionGain
        Levels and the energies behind them.

    Raises
    ------
    DesignError
        As for :func:`banded_spectrum`.
    ValueError
        As for :func:`gain_of`.
    """
    model = track_model(design)
    return gain_of(model, banded_spectrum(model, lattice), reference, summation)
