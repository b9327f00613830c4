"""Figures of a design over two of its fields, all others held: every point of the map is an exact design.

SI units, dB, Hz.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Unpack

import numpy as np

from trackig_core.arrays import BoolArray, RealArray
from trackig_core.decide.feasible import Ranges, searched_ranges
from trackig_core.decide.numbers import is_logarithmic
from trackig_core.decide.requirements import WORDS, Requirements
from trackig_core.decide.solving import How, solve_designs
from trackig_core.decide.words import how_much, in_unit, sentence, spoken
from trackig_core.levels.source import SourceSpectrum
from trackig_core.levels.specification import Specification
from trackig_core.track.design import TrackDesign
from trackig_core.track.fields import amount

if TYPE_CHECKING:
    import pandas

POINTS = 200
"""Points along either field [-]."""

MOST_POINTS = 2000
"""Most points along either field [-]: four million designs take two minutes and 0.7 GB."""


@dataclass(frozen=True, eq=False, repr=False)
class DesignMap:
    """Figures of a design over two of its fields.

    Attributes
    ----------
    design : TrackDesign
        The design whose fields are varied.
    x_field, y_field : str
        The fields.
    x, y : numpy.ndarray (columns,), (rows,)
        Their values, evenly spaced, stiffnesses on a logarithmic axis [units of the fields].
    figures : dict of str to numpy.ndarray (rows, columns)
        Figures by name, see ``Requirements.values`` [their units].
    complies : numpy.ndarray of bool (rows, columns) or None
        Where designs comply; None without a specification.
    """

    design: TrackDesign
    x_field: str
    y_field: str
    x: RealArray = field(repr=False)
    y: RealArray = field(repr=False)
    figures: dict[str, RealArray] = field(repr=False)
    complies: BoolArray | None = field(repr=False)

    def design_at(self, x: float, y: float) -> TrackDesign:
        """Return the design of the point of the map that is nearest to two values (TrackDesign)."""
        near = {self.x_field: (self.x, x), self.y_field: (self.y, y)}
        return self.design.replace(
            **{name: float(values[np.abs(values - value).argmin()]) for name, (values, value) in near.items()}
        )

    def to_dataframe(self) -> pandas.DataFrame:
        """Return a pandas.DataFrame, one row a point: both fields [SI], figures, whether it complies."""
        import pandas as pd

        x, y = np.meshgrid(self.x, self.y)
        columns = {self.x_field: x.ravel(), self.y_field: y.ravel()}
        columns |= {name: values.ravel() for name, values in self.figures.items()}
        table = pd.DataFrame(columns)
        return table if self.complies is None else table.assign(complies=self.complies.ravel())

    def __repr__(self) -> str:
        """Return fields, size and figures."""
        fields = f"{self.x_field} x {self.y_field}, {self.x.size} x {self.y.size}"
        return f"DesignMap({fields}, figures={tuple(self.figures)})"

    def __str__(self) -> str:
        """Return one sentence."""
        name, values = next(iter(self.figures.items()))
        row, column = np.unravel_index(np.nanargmax(values), values.shape)
        place = (
            f"{spoken(self.x_field)} {amount(self.x_field, self.x[column])} and "
            f"{spoken(self.y_field)} {amount(self.y_field, self.y[row])}"
        )
        most = f"the greatest {WORDS[name]} is {in_unit(name, values[row, column])}, with {place}"
        if self.complies is None:
            return sentence(f"{most}.")
        return sentence(f"{how_much(float(self.complies.mean()))} of the map complies; {most}.")


def design_map(
    design: TrackDesign,
    x_field: str,
    y_field: str,
    specification: Specification | None = None,
    *,
    figures: Sequence[str] | None = None,
    ranges: Ranges | None = None,
    points: tuple[int, int] = (POINTS, POINTS),
    source: SourceSpectrum | None = None,
    max_deflection: float | None = None,
    reference: str = "line",
    summation: str = "energy",
    **how: Unpack[How],
) -> DesignMap:
    """Compute figures of a design over two of its fields.

    Parameters
    ----------
    design : TrackDesign
        The design whose fields are varied.
    x_field, y_field : str
        Two fields that are single numbers in this design; those of suspension and ground by path, such as
        ``"ground.stiffness"``.
    specification : Specification, optional
        Greatest insertion gain per band [dB], for the governing margin.
    figures : sequence of str, optional
        Figures by name, see ``Requirements.values``; by default all but the bands.
    ranges : dict of str to (float, float), optional
        Ranges of the fields [unit of the field], in place of :data:`SEARCHED_RANGES`.
    points : (int, int)
        Points along x and y [-].
    source : SourceSpectrum, optional
        Levels on the reference track [dB], for the A-weighted level.
    max_deflection : float, optional
        Greatest rail deflection, in place of the specification's own limit [m].
    reference, summation : str
        Definition of insertion gain, as for :func:`trackig_core.solve`.
    **how
        Where the designs are solved, and who is told; see :class:`How`.

    Returns
    -------
    DesignMap
        Figures (rows, columns), y by x.

    Raises
    ------
    DesignError
        If a range reaches beyond what a track can have.
    SolveCancelled
        If ``cancelled`` answered true.
    ValueError
        If a field or figure is none of this design, or there are too few or too many points.
    """
    required = Requirements(specification, source, reference, summation, max_deflection)
    names = required.figures(design) if figures is None else tuple(figures)
    required.check_figures(names, design)
    if not all(2 <= count <= MOST_POINTS for count in points):
        raise ValueError(f"points = {points}: give two numbers from 2 to {MOST_POINTS}")
    x, y = map_axes(design, x_field, y_field, ranges, points)
    columns = {x_field: np.tile(x, y.size), y_field: np.repeat(y, x.size)}
    many = solve_designs(design, columns, how)
    shape = (y.size, x.size)
    return DesignMap(
        design=design,
        x_field=x_field,
        y_field=y_field,
        x=x,
        y=y,
        figures={name: required.values(many, name).reshape(shape) for name in names},
        complies=None if specification is None else required.complies(many).reshape(shape),
    )


def map_axes(
    design: TrackDesign,
    x_field: str,
    y_field: str,
    ranges: Ranges | None = None,
    points: tuple[int, int] = (POINTS, POINTS),
) -> tuple[RealArray, RealArray]:
    """Return the values of two fields over which a map is drawn, however many.

    Parameters
    ----------
    design, x_field, y_field, ranges, points
        As for :func:`design_map`.

    Returns
    -------
    x, y : numpy.ndarray (columns,), (rows,)
        Values, evenly spaced, stiffnesses on a logarithmic axis [units of the fields].

    Raises
    ------
    ValueError
        If the fields are not two single numbers of this design.
    """
    if x_field == y_field:
        raise ValueError(f"both fields are {x_field}: give two")
    searched = searched_ranges(design, (x_field, y_field), ranges)
    return _axis(x_field, searched[x_field], points[0]), _axis(y_field, searched[y_field], points[1])


def _axis(field: str, ends: tuple[float, float], count: int) -> RealArray:
    low, high = ends
    axis = np.geomspace(low, high, count) if is_logarithmic(field) else np.linspace(low, high, count)
    return axis.clip(low, high)
