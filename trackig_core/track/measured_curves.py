"""Damping and stiffness as a test house reports them: tables of points over frequency.

Hz, N/m; loss factors have no unit. Between points, values are straight lines over the logarithm of
frequency; beyond the first and last point they stay as they are there.

A table that exists is sound. Every row is checked when the table is made, and an error
names the row. Tables that were pasted or saved are read by :mod:`trackig_core.track.measured_tables`.
"""

import math
import numbers
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from trackig_core.arrays import BoolArray, RealArray
from trackig_core.bands import BAND_CENTRES, BAND_LABELS
from trackig_core.names import brief
from trackig_core.words import quantity, span

MOST_POINTS = 1000
"""Rows that a table may have [-]."""

COLUMNS = {
    "frequency": (0.1, 1e5, "Hz"),
    "stiffness": (1e5, 1e13, "N/m"),
    "loss factor": (1e-4, 2.0, ""),
}
"""Lowest and highest value, and unit, of each column."""

PRELOAD = (0.0, 1e6, "N")
"""Lowest and highest static load under which a pad or boot is measured, and its unit."""

NOMINAL_DEVIATION = 0.02
"""Relative distance between nominal and exact mid-band frequencies that is not extrapolation [-]."""


class MeasurementError(ValueError):
    """A table of measured points cannot be used.

    Attributes
    ----------
    row : int or None
        Number of the row at fault, counted from 1; None if the table as a whole is.
    """

    def __init__(self, message: str, row: int | None = None) -> None:
        self.row = row
        self.message = message
        super().__init__(message if row is None else f"row {row}: {message}")

    def __reduce__(self) -> tuple[type, tuple[str, int | None]]:
        """Let the error pass between processes."""
        return type(self), (self.message, self.row)


@dataclass(frozen=True)
class LossFactorCurve:
    """A measured loss factor over frequency.

    Parameters
    ----------
    points : iterable of (float, float)
        Rows of frequency [Hz], ascending, and loss factor [-]; two or more.

    Raises
    ------
    MeasurementError
        If a row is out of order, or not made of numbers within their ranges.
    """

    points: tuple[tuple[float, float], ...]

    def __post_init__(self) -> None:
        """Check every row once."""
        object.__setattr__(self, "points", _checked(self.points, ("frequency", "loss factor")))

    def loss_factor(self, frequency: ArrayLike) -> RealArray:
        """Return the loss factor at given frequencies [Hz]; same shape, [-]."""
        return _interpolated(frequency, self.points, 1)

    @property
    def extrapolated_bands(self) -> tuple[str, ...]:
        """Nominal mid-band frequencies, as text, of bands beyond the first and the last point [Hz]."""
        return _extrapolated(self.points)

    def __str__(self) -> str:
        """Return how many points there are, and their range."""
        frequency, loss = np.array(self.points).T
        return (
            f"measured at {frequency.size} frequencies, {span(frequency, 'Hz')}: loss factor {span(loss, '')}"
        )


@dataclass(frozen=True)
class StiffnessCurve:
    """A measured dynamic stiffness and its loss factor over frequency.

    Parameters
    ----------
    points : iterable of (float, float, float)
        Rows of frequency [Hz], ascending, dynamic stiffness (the real part of the complex stiffness)
        [N/m] and loss factor [-]; two or more.
    preload : float or None
        Static load under which it was measured [N], as EN 17495 has it reported; None if it is not stated.
        It says what the points hold for, and no figure depends on it.

    Raises
    ------
    MeasurementError
        If a row is out of order, or row or preload is not made of numbers within their ranges.
    """

    points: tuple[tuple[float, float, float], ...]
    preload: float | None = None

    def __post_init__(self) -> None:
        """Check every row and the preload once."""
        object.__setattr__(self, "points", _checked(self.points, tuple(COLUMNS)))
        if self.preload is not None:
            object.__setattr__(self, "preload", _number("preload", self.preload, PRELOAD))

    @property
    def without_preload(self) -> "StiffnessCurve":
        """The same points without the preload, on which no figure depends."""
        return self if self.preload is None else replace(self, preload=None)

    def stiffness(self, frequency: ArrayLike) -> RealArray:
        """Return the dynamic stiffness at given frequencies [Hz]; same shape, [N/m]."""
        return _interpolated(frequency, self.points, 1)

    def loss_factor(self, frequency: ArrayLike) -> RealArray:
        """Return the loss factor at given frequencies [Hz]; same shape, [-]."""
        return _interpolated(frequency, self.points, 2)

    @property
    def extrapolated_bands(self) -> tuple[str, ...]:
        """Nominal mid-band frequencies, as text, of bands beyond the first and the last point [Hz]."""
        return _extrapolated(self.points)

    def covers(self, frequency: ArrayLike) -> BoolArray:
        """Return whether given frequencies [Hz] lie between the first and the last point; same shape."""
        frequency = np.asarray(frequency)
        return (frequency >= self.points[0][0]) & (frequency <= self.points[-1][0])

    def __str__(self) -> str:
        """Return how many points there are, their range with its units, and the preload."""
        frequency, stiffness, loss = np.array(self.points).T
        preload = "" if self.preload is None else f", preload {quantity(self.preload, 'N')}"
        return (
            f"measured at {frequency.size} frequencies, {span(frequency, 'Hz')}: {span(stiffness, 'N/m')}, "
            f"loss factor {span(loss, '')}{preload}"
        )


def _extrapolated(points: Sequence[Sequence[float]]) -> tuple[str, ...]:
    first, last = points[0][0], points[-1][0]
    low, high = first / (1 + NOMINAL_DEVIATION), last * (1 + NOMINAL_DEVIATION)
    pairs = zip(BAND_LABELS, BAND_CENTRES, strict=True)
    return tuple(label for label, centre in pairs if not low <= centre <= high)


def _interpolated(frequency: ArrayLike, points: Sequence[Sequence[float]], column: int) -> RealArray:
    table = np.array(points)
    return np.interp(np.log(frequency), np.log(table[:, 0]), table[:, column])


def _checked(points: Iterable[Iterable[object]], columns: Sequence[str]) -> tuple[tuple[float, ...], ...]:
    """Return the table as a tuple of tuples of floats, or raise a MeasurementError."""
    try:
        rows = [tuple(row) for row in points]
    except TypeError:
        raise MeasurementError(f"give rows of {', '.join(columns)}") from None
    if not 2 <= len(rows) <= MOST_POINTS:
        raise MeasurementError(f"{len(rows)} rows: give from 2 to {MOST_POINTS} rows of {', '.join(columns)}")
    verified: list[tuple[float, ...]] = []
    for number, row in enumerate(rows, start=1):
        if len(row) != len(columns):
            raise MeasurementError(f"{len(row)} values: give {', '.join(columns)}", number)
        values = tuple(
            _number(column, value, COLUMNS[column], number)
            for column, value in zip(columns, row, strict=True)
        )
        if verified and values[0] <= verified[-1][0]:
            before = verified[-1][0]
            raise MeasurementError(
                f"frequency {values[0]:g} Hz is not above the {before:g} Hz of row {number - 1}: "
                "sort the rows by frequency, and give each frequency once",
                number,
            )
        verified.append(values)
    return tuple(verified)


def _number(what: str, value: object, bounds: tuple[float, float, str], row: int | None = None) -> float:
    low, high, unit = bounds
    if isinstance(value, numbers.Real) and not isinstance(value, bool):
        try:
            number = float(value)
        except OverflowError:
            number = math.inf
        if math.isfinite(number) and low <= number <= high:
            return number
    allowed = f"a number from {low:g} to {high:g} {unit}".rstrip()
    raise MeasurementError(f"{what} = {brief(value, 40)}: give {allowed}", row)
