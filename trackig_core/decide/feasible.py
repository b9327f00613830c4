"""How far each number of a design may be moved, all others held, before the design stops complying.

SI units; margins in dB. Every field is scanned over its range on a logarithmic axis, all fields in one call
of :func:`trackig_core.solve_many`: coarsely, and finely where its margin is near zero. The margin of each
band is smooth in each field, though their least is not: splines through the scan, band by band, show where
compliance begins or ends within an interval, even if both of its ends comply or both fail. Such intervals are
scanned again, twice, all together; within the last ones, less than 0.1 % wide, the edge is interpolated.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Unpack

import numpy as np
from scipy.interpolate import CubicSpline

from trackig_core.arrays import AnyArray, BoolArray, IntArray, RealArray
from trackig_core.decide.numbers import single_numbers
from trackig_core.decide.requirements import DEFLECTION, Requirements
from trackig_core.decide.solving import How, solve_designs
from trackig_core.decide.words import away, spoken
from trackig_core.levels.specification import Specification
from trackig_core.names import brief
from trackig_core.track.design import TrackDesign
from trackig_core.track.fields import GIVEN, RANGES, SEARCHED_RANGES, SLIDER_RANGES, amount
from trackig_core.track.rails import RAILS

if TYPE_CHECKING:
    import pandas

Ranges = Mapping[str, tuple[float, float]]
"""Lowest and highest value by field [unit of the field]."""

Intervals = tuple[tuple[float, float], ...]
"""Lowest and highest value of each stretch of one field [unit of the field]."""

Evaluate = Callable[[IntArray, RealArray], RealArray]
"""From numbers of fields (n,) and places along their ranges (n,), 0 to 1, to margins (n, columns) [dB]."""

INTERVALS = 128
"""Intervals of the scan of one field [-]. Of 742 stretches and gaps 0.07 % to 8 % wide, made by lifting or
lowering the limits of random designs until they only just complied or failed, it misses three, all narrower
than 0.5 %; half as many intervals miss twelve."""

CLEAR = 2.0
"""How far from just complying [dB] both ends of two intervals, and the spline between them, have to be for
the node between to be left to the spline. Of 133 stretches and gaps as above no edge moved."""

FINER = 8
"""Intervals into which one that is looked at again is divided [-]."""

ROUNDS = 2
"""How often intervals are divided [-]: 128 x 8 x 8 of them make 0.07 % of each over a range of 1 to 200."""

BETWEEN = 8
"""Parts of an interval at whose ends the splines are looked at [-]."""

NOISE = 0.002
"""How much the margins themselves may be in error [dB]."""

SURE = 0.01
"""Error of the splines [dB] up to which they are believed to rise or fall steadily where they say so."""


@dataclass(frozen=True, eq=False, repr=False)
class FeasibleRanges(Mapping[str, Intervals]):
    """Where a design complies along each of its fields, all others held: a mapping of intervals by field.

    Attributes
    ----------
    design : TrackDesign
        The design.
    intervals : dict of str to tuple of (float, float)
        Every stretch of compliance within the range of the field, ascending [unit of the field].
    ranges : dict of str to (float, float)
        Ranges that were searched [unit of the field].
    complies : bool
        Whether the design itself complies.
    margin : float [dB]
        Governing margin of the design itself; negative where insertion gain fails.
    governed_by : str
        Band, by its nominal mid-band frequency, with that margin; ``"deflection"`` where no band has a limit:
        the margin is then 20 lg of limit over deflection.
    deflection, deflection_limit : float [m], float or None [m]
        Static rail deflection of the design itself, and the greatest allowed.
    rails : dict of str to bool
        Whether the design complies with each rail of the catalogue.
    """

    design: TrackDesign
    intervals: dict[str, Intervals]
    ranges: dict[str, tuple[float, float]]
    complies: bool
    margin: float
    governed_by: str
    deflection: float
    deflection_limit: float | None
    rails: dict[str, bool]

    def __getitem__(self, field: str) -> Intervals:
        """Return the intervals of a field."""
        return self.intervals[field]

    def __iter__(self) -> Iterator[str]:
        """Iterate over the fields."""
        return iter(self.intervals)

    def __len__(self) -> int:
        """Return how many fields there are."""
        return len(self.intervals)

    def sentence(self, field: str) -> str:
        """Return where a field complies, in words, such as ``"boot stiffness at most 10.85 kN/mm"``."""
        return f"{spoken(field)} {self._where(field)}"

    def _where(self, field: str) -> str:
        intervals, (least, greatest) = self.intervals[field], self.ranges[field]
        if not intervals:
            return "of no value"
        if intervals == ((least, greatest),):
            return "of any value"
        texts = []
        for low, high in intervals:
            if low == least:
                texts.append(f"at most {amount(field, high)}")
            elif high == greatest:
                texts.append(f"at least {amount(field, low)}")
            else:
                texts.append(f"from {amount(field, low)} to {amount(field, high)}")
        return " or ".join(texts)

    def to_dataframe(self) -> pandas.DataFrame:
        """Return a pandas.DataFrame, one row an interval: field, low, high [unit], range, unit."""
        import pandas as pd

        rows = [
            (field, low, high, *self.ranges[field], RANGES[field][2])
            for field, intervals in self.intervals.items()
            for low, high in intervals
        ]
        return pd.DataFrame(rows, columns=["field", "low", "high", "range_low", "range_high", "unit"])

    def __repr__(self) -> str:
        """Return fields and intervals, short."""
        return f"FeasibleRanges({', '.join(map(self.sentence, self))})"

    def __str__(self) -> str:
        """Return one sentence."""
        verdict = "complies" if self.complies else "fails"
        said = f"The design {verdict}, {self._because}"
        changes = [field for field in self if self.intervals[field]]
        if not changes:
            return f"{said}; no change of a single field makes it comply."
        return f"{said}; it complies with {', or '.join(map(self.sentence, changes))}."

    @property
    def _because(self) -> str:
        """Margin, and deflection if it is limited, in words."""
        words = []
        if self.governed_by != DEFLECTION:
            side = "within" if self.margin >= 0 else "beyond"
            words.append(f"{away(self.margin)} {side} the limit at {self.governed_by} Hz")
        if self.deflection_limit is not None:
            sinks = f"{1e3 * self.deflection:.2f} of {1e3 * self.deflection_limit:.2f} mm"
            words.append(f"its rail sinking {sinks}")
        return ", ".join(words)


def feasible_ranges(
    design: TrackDesign,
    specification: Specification,
    *,
    max_deflection: float | None = None,
    reference: str = "line",
    summation: str = "energy",
    fields: Sequence[str] | None = None,
    ranges: Ranges | None = None,
    **how: Unpack[How],
) -> FeasibleRanges:
    """Find where a design complies along each of its fields, all others held.

    Parameters
    ----------
    design : TrackDesign
        The design.
    specification : Specification
        Greatest insertion gain per band [dB].
    max_deflection : float, optional
        Greatest rail deflection, in place of the specification's own limit [m].
    reference, summation : str
        Definition of insertion gain, as for :func:`trackig_core.solve`.
    fields : sequence of str, optional
        Fields to look at; by default those of :data:`SLIDER_RANGES` that are the track's, not the vehicle's
        (see :data:`GIVEN`), and single numbers in this design.
        Those of suspension and ground are named by path, such as ``"ground.stiffness"``.
    ranges : dict of str to (float, float), optional
        Ranges of some fields [unit of the field], in place of :data:`SEARCHED_RANGES`.
    **how
        Where the designs are solved; see :class:`How`. It is over before progress could be told.

    Returns
    -------
    FeasibleRanges
        ``{field: ((low, high), ...)}`` [unit of the field], edges to 0.1 %.

    Raises
    ------
    DesignError
        If a range reaches beyond what a track can have.
    SolveCancelled
        If ``cancelled`` answered true.
    ValueError
        If a field is not a single number of this design, or a choice is not one of the above.
    """
    required = Requirements(specification, None, reference, summation, max_deflection)
    searched = searched_ranges(design, fields, ranges)
    names = list(searched)
    how = {**how, "progress": None}  # of calls of some 10 ms

    def evaluate(numbers: IntArray, places: RealArray) -> RealArray:
        return required.slacks(solve_designs(design, _rows(design, searched, numbers, places), how))

    rails = [design.rail, *RAILS.values()]
    around = solve_designs(design, {"rail": np.array(rails, dtype=object)}, how)
    found = complying_stretches(evaluate, len(names)) if names else []
    complies, margins = required.complies(around), required.margins(around)[0]
    margin = float(required.governing_margin(around)[0])
    return FeasibleRanges(
        design=design,
        intervals={
            name: tuple((at(searched[name], low), at(searched[name], high)) for low, high in stretches)
            for name, stretches in zip(names, found, strict=True)
        },
        ranges=searched,
        complies=bool(complies[0]),
        margin=margin,
        governed_by=required.names[int(margins.argmin())] if required.names else DEFLECTION,
        deflection=float(required.deflection(around)[0]),
        deflection_limit=required.deflection_limit,
        rails={rail.name: bool(each) for rail, each in zip(rails[1:], complies[1:], strict=True)},
    )


def searched_ranges(
    design: TrackDesign, fields: Sequence[str] | None, ranges: Ranges | None
) -> dict[str, tuple[float, float]]:
    """Return the ranges of the fields that are asked for, checked."""
    known = single_numbers(design)
    for name in (*(fields or ()), *(ranges or ())):
        if name not in known:
            raise ValueError(
                f"{brief(name)} is not a single number of this design: give any of {', '.join(known)}"
            )
    given = dict(ranges or {})
    for name, (low, high) in given.items():
        if not 0 < low < high:
            raise ValueError(
                f"range of {name} = {brief((low, high))}: give a low end above 0 and a higher one"
            )
        design.replace(**{name: low}), design.replace(**{name: high})
    asked = (*SLIDER_RANGES.keys() - GIVEN.keys(), *given)
    wanted = [name for name in known if name in asked] if fields is None else fields
    return {name: given.get(name, SEARCHED_RANGES[name]) for name in wanted}


def at(ends: tuple[float, float], place: float) -> float:
    """Return the value at a place along a range, 0 to 1, on a logarithmic axis."""
    low, high = ends
    if place in (0.0, 1.0):
        return high if place else low
    return float(low * (high / low) ** place)


def _rows(design: TrackDesign, ranges: Ranges, numbers: IntArray, places: RealArray) -> dict[str, AnyArray]:
    """Return columns of designs of which each differs from the base in one field."""
    columns = {}
    for number, (name, (low, high)) in enumerate(ranges.items()):
        values = np.full(places.size, design.value(name))
        mine = numbers == number
        values[mine] = np.clip(low * (high / low) ** places[mine], low, high)
        columns[name] = values
    return columns


def complying_stretches(evaluate: Evaluate, count: int) -> list[list[tuple[float, float]]]:
    """Return where no margin is below zero, along several axes from 0 to 1.

    Parameters
    ----------
    evaluate : callable
        From numbers of axes (n,) and places (n,) to margins (n, columns) [dB], smooth along each axis.
    count : int
        How many axes.

    Returns
    -------
    list of list of (float, float)
        Begin and end of each stretch, per axis, ascending.
    """
    margins = _scanned(evaluate, count)
    begins = margins[:, 0].min(axis=-1) >= 0
    axis, low, width = np.arange(count), np.zeros(count), 1.0 / INTERVALS
    for _ in range(ROUNDS):
        panel, interval = np.nonzero(_to_look_at_again(margins))
        if not panel.size:
            return [[(0.0, 1.0)] if complies else [] for complies in begins]
        axis, low = axis[panel], low[panel] + interval * width
        ends = margins[panel, interval], margins[panel, interval + 1]
        width /= FINER
        inner = low[:, None] + np.arange(1, FINER) * width
        between = evaluate(np.repeat(axis, FINER - 1), inner.ravel()).reshape(*inner.shape, -1)
        margins = np.concatenate([ends[0][:, None], between, ends[1][:, None]], axis=1)
    least = margins.min(axis=-1)
    panel, interval = np.nonzero((least[:, :-1] >= 0) != (least[:, 1:] >= 0))
    before, after = least[panel, interval], least[panel, interval + 1]
    edges = low[panel] + (interval + before / (before - after)) * width
    return [_between_edges(np.sort(edges[axis[panel] == each]), bool(begins[each])) for each in range(count)]


def _scanned(evaluate: Evaluate, count: int) -> RealArray:
    """Return margins at the nodes of the scan (axes, nodes, columns) [dB].

    Every other node is evaluated, and those between where compliance may change near them; where it cannot,
    the spline through the others stands for them.
    """
    nodes = np.linspace(0.0, 1.0, INTERVALS + 1)
    axes, coarse = np.arange(count), nodes[::2]
    known = evaluate(np.repeat(axes, coarse.size), np.tile(coarse, count)).reshape(count, coarse.size, -1)
    margins = np.empty((count, nodes.size, known.shape[-1]))
    margins[:, ::2] = known
    margins[:, 1::2] = CubicSpline(coarse, known, axis=1)(nodes[1::2])
    least = margins.min(axis=-1)
    around = np.stack([least[:, :-2:2], least[:, 1::2], least[:, 2::2]])
    axis, place = np.nonzero((around.min(axis=0) < CLEAR) & (around.max(axis=0) > -CLEAR))
    if axis.size:
        margins[axis, 2 * place + 1] = evaluate(axis, nodes[2 * place + 1])
    return margins


def _between_edges(edges: RealArray, complies: bool) -> list[tuple[float, float]]:
    """Return the stretches that begin and end at edges, of which the first is left if it complies."""
    all_edges = [0.0] * complies + [float(edge) for edge in edges]
    if len(all_edges) % 2:
        all_edges.append(1.0)
    return list(zip(all_edges[::2], all_edges[1::2], strict=True))


def _to_look_at_again(margins: RealArray) -> BoolArray:
    """Return in which intervals compliance begins or ends, or may do both.

    Parameters
    ----------
    margins : numpy.ndarray (panels, nodes, columns)
        Margins at evenly spaced nodes, an odd number of them [dB].

    Returns
    -------
    numpy.ndarray of bool (panels, nodes - 1)
        Whether to look at an interval again.
    """
    panels, nodes, columns = margins.shape
    least = margins.min(axis=-1)
    complies = least >= 0
    sign = np.where(complies[:, :-1], 1.0, -1.0)
    places = (np.arange(nodes - 1)[:, None] + np.arange(1, BETWEEN) / BETWEEN).ravel()
    curves = np.moveaxis(margins, 1, 0).reshape(nodes, -1)
    within = CubicSpline(np.arange(nodes), curves)(places).reshape(nodes - 1, BETWEEN - 1, panels, columns)
    least_within = np.moveaxis(within.min(axis=-1), 2, 0)
    # the spline through every other node is some sixteen times worse: what it misses bounds the error
    coarse = CubicSpline(np.arange(0, nodes, 2), curves[::2])(np.arange(1, nodes, 2))
    missed = np.abs(coarse.reshape(-1, panels, columns).min(axis=-1).T - least[:, 1::2]) / 4
    error = np.repeat(missed, 2, axis=1)
    error = np.maximum(error, np.maximum(np.roll(error, 1, axis=1), np.roll(error, -1, axis=1)))
    # towards the other side: below zero where it complies, above where it fails
    furthest = (sign[..., None] * least_within).min(axis=-1)
    ends = np.minimum(sign * least[:, :-1], sign * least[:, 1:])
    turns = (furthest < ends) | (error > SURE)
    # where two bands change places, the extreme lies between the places that are looked at
    beyond = np.abs(np.diff(least_within, axis=-1)).max(axis=-1) / 2
    return (complies[:, :-1] != complies[:, 1:]) | (turns & (furthest < error + beyond + NOISE))
