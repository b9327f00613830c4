"""What production makes of a drawing: how the fields of a design scatter around what is stated.

Tolerances are shares of the stated value [-]; production samples are in SI units. Samples are drawn by
scrambled Sobol sequences (scipy.stats.qmc), which fill the ranges more evenly than random numbers do, and are
the same for the same seed. Source of the sequences: Joe and Kuo (2008), "Constructing Sobol sequences with
better two-dimensional projections".
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Protocol

import numpy as np
from scipy.special import ndtr, ndtri
from scipy.stats import qmc

from trackig_core.arrays import AnyArray, RealArray
from trackig_core.decide.numbers import changeable_numbers
from trackig_core.names import brief
from trackig_core.track.design import REFERENCE_FREQUENCY, Rail, TrackDesign
from trackig_core.track.fields import RANGES, DesignError
from trackig_core.track.measured_curves import LossFactorCurve, StiffnessCurve

CONFIDENCE = 0.95
"""Confidence of every interval that is given [-]."""

CUT = 3.0
"""Standard deviations at which a normal distribution is cut off [-]: what lies beyond is not delivered."""

CORNER = 2.0
"""Standard deviations at which a normal distribution counts as at its worst [-]: 95 % lie within."""

LARGEST = 0.9
"""Largest tolerance [-]: no stiffness is left of one that may be 100 % lower."""


class Tolerance(Protocol):
    """How one number scatters around a stated value of one."""

    def factors(self, share: RealArray) -> RealArray:
        """Return the values below which shares, 0 to 1, of production lie [-]."""

    @property
    def corners(self) -> tuple[float, float]:
        """Least and greatest value that counts as a corner [-]."""


@dataclass(frozen=True)
class Uniform:
    """Anything within a share of the stated value is equally likely.

    Parameters
    ----------
    share : float
        Tolerance, such as 0.1 for +-10 % [-]; up to :data:`LARGEST`.

    Raises
    ------
    ValueError
        If it is not above zero or too large.
    """

    share: float

    def __post_init__(self) -> None:
        """Check the share."""
        _check_share("tolerance", self.share, LARGEST)

    def factors(self, share: RealArray) -> RealArray:
        """Return the values below which shares, 0 to 1, of production lie [-]."""
        return 1 + self.share * (2 * share - 1)

    @property
    def corners(self) -> tuple[float, float]:
        """Least and greatest value [-]."""
        return 1 - self.share, 1 + self.share

    def __str__(self) -> str:
        """Return the tolerance in per cent."""
        return f"anything within ±{100 * self.share:.3g} %"


@dataclass(frozen=True)
class Normal:
    """Normally distributed around the stated value, cut off at three standard deviations.

    Parameters
    ----------
    deviation : float
        Standard deviation of the normal distribution as a share of the stated value [-]; up to a third of
        :data:`LARGEST`.

    Raises
    ------
    ValueError
        If it is not above zero or too large.
    """

    deviation: float

    def __post_init__(self) -> None:
        """Check the standard deviation."""
        _check_share("standard deviation", self.deviation, LARGEST / CUT)

    def factors(self, share: RealArray) -> RealArray:
        """Return the values below which shares, 0 to 1, of production lie [-]."""
        low = ndtr(-CUT)
        return 1 + self.deviation * ndtri(low + (1 - 2 * low) * share)

    @property
    def corners(self) -> tuple[float, float]:
        """Values two standard deviations away from one [-]."""
        return 1 - CORNER * self.deviation, 1 + CORNER * self.deviation

    def __str__(self) -> str:
        """Return the deviation in per cent."""
        return f"normal, with a standard deviation of {100 * self.deviation:.3g} %"


def _check_share(what: str, share: object, most: float) -> None:
    is_number = isinstance(share, int | float) and not isinstance(share, bool)
    if not is_number or not 0 < share <= most:  # type: ignore[operator]
        raise ValueError(
            f"{what} = {brief(share)}: give a share above 0 and up to {most:g}, such as 0.1 for 10 %"
        )


@dataclass(frozen=True, eq=False)
class Factor:
    """What varies independently of all else: one field, or a row of a table of production samples.

    Attributes
    ----------
    name : str
        The field, or ``"production"``.
    columns : dict of str to numpy.ndarray
        Measured values by field [unit of the field], row by row of the same specimen; empty for a tolerance.
    tolerance : Tolerance or None
        How the field scatters; None for a table.
    stated : float
        Stated value of the field [unit of the field]; NaN for a table.
    """

    name: str
    columns: dict[str, AnyArray] = field(default_factory=dict)
    tolerance: Tolerance | None = None
    stated: float = math.nan

    @property
    def fields(self) -> tuple[str, ...]:
        """Fields that it sets."""
        return (self.name,) if self.tolerance is not None else tuple(self.columns)

    def values(self, share: RealArray) -> dict[str, AnyArray]:
        """Return values by field for shares of production, 0 to 1 (...)."""
        if self.tolerance is not None:
            return {self.name: self.stated * self.tolerance.factors(share)}
        rows = next(iter(self.columns.values())).size
        row = np.minimum((share * rows).astype(int), rows - 1)
        return {name: values[row] for name, values in self.columns.items()}

    def corners(self) -> Iterator[dict[str, Any]]:
        """Iterate over the extremes: both ends of a tolerance, or the specimens with a field's."""
        if self.tolerance is not None:
            for factor in self.tolerance.corners:
                yield {self.name: self.stated * factor}
            return
        for row in sorted(self._extreme_rows()):
            yield {name: values[row] for name, values in self.columns.items()}

    def halved(self, share: RealArray) -> dict[str, AnyArray]:
        """Return values by field as :meth:`values` does, of half the scatter; of measured curves none."""
        values = self.values(share)
        if self.tolerance is not None:
            return {self.name: (self.stated + values[self.name]) / 2}
        return {
            name: (column.mean() + values[name]) / 2
            for name, column in self.columns.items()
            if column.dtype != object
        }

    def _extreme_rows(self) -> set[int]:
        sizes = [np.array([_size(each) for each in values]) for values in self.columns.values()]
        return {int(row) for size in sizes for row in (size.argmin(), size.argmax())}


def _size(value: Any) -> float:
    """Return a number, or what a measured curve has at 50 Hz, by which specimens are ranked."""
    if isinstance(value, StiffnessCurve):
        return float(value.stiffness(REFERENCE_FREQUENCY))
    if isinstance(value, LossFactorCurve):
        return float(value.loss_factor(REFERENCE_FREQUENCY))
    return value.mass_per_metre if isinstance(value, Rail) else float(value)


def make_factors(
    design: TrackDesign,
    tolerances: Mapping[str, float | Tolerance],
    production: Mapping[str, Sequence[Any]] | None = None,
) -> tuple[Factor, ...]:
    """Return what varies of a design, checked.

    Parameters
    ----------
    design : TrackDesign
        The design as it is stated.
    tolerances : dict of str to float or Tolerance
        By field, or by path of a number of suspension or ground: a share such as 0.1 for any value within
        +-10 %, or a :class:`Uniform` or :class:`Normal`.
    production : dict of str to sequence, optional
        Measured values by field [unit of the field], row by row of the same specimen, as a pandas.DataFrame
        or a dict; numbers or measured curves.

    Returns
    -------
    tuple of Factor
        What varies independently.

    Raises
    ------
    DesignError
        If a value is one that no track can have.
    ValueError
        If a field is not a single number of this design or is given twice, columns differ in length, or
        nothing varies.
    """
    factors = [
        _tolerance_factor(design, name, Uniform(given) if isinstance(given, int | float) else given)
        for name, given in tolerances.items()
    ]
    if production is not None:
        factors.append(_table_factor(design, production, {*tolerances}))
    if not factors:
        raise ValueError("nothing varies: give a tolerance, such as {'boot_stiffness': 0.1}")
    return tuple(factors)


def _tolerance_factor(design: TrackDesign, name: str, tolerance: Tolerance) -> Factor:
    numbers = [each for each in changeable_numbers(design) if isinstance(design.value(each), float)]
    if name not in numbers:
        raise ValueError(
            f"{brief(name)} is not a single number of this design above zero, so it has no tolerance: give "
            f"any of {', '.join(numbers)}"
        )
    stated = design.value(name)
    for factor in tolerance.factors(np.array([0.0, 1.0])):
        value = stated * float(factor)
        try:
            design.replace(**{name: value})
        except DesignError as error:
            low, high, unit = RANGES[name]
            allowed = f"a tolerance that stays within {low:g} to {high:g} {unit}".rstrip()
            raise DesignError(name, value, allowed) from error
    return Factor(name, tolerance=tolerance, stated=stated)


def _table_factor(design: TrackDesign, production: Mapping[str, Sequence[Any]], taken: set[str]) -> Factor:
    columns = {str(name): _column(production[name]) for name in production}
    for name in columns:
        if name in taken:
            raise ValueError(f"{name} has a tolerance and production samples: give one of them")
    sizes = {values.size for values in columns.values()}
    if len(sizes) != 1 or sizes == {0}:
        raise ValueError(
            "production samples: give one or more columns of the same length, a row each specimen"
        )
    for row in range(sizes.pop()):
        try:
            design.replace(**{name: values.tolist()[row] for name, values in columns.items()})
        except DesignError as error:
            raise DesignError(error.field, error.value, error.allowed, row) from None
    return Factor("production", columns=columns)


def _column(values: Sequence[Any]) -> AnyArray:
    listed = list(values)
    if all(isinstance(each, int | float | np.number) for each in listed):
        return np.array(listed, dtype=float)
    column = np.empty(len(listed), dtype=object)
    column[:] = listed
    return column


def drawn_shares(count: int, samples: int, seed: int, first: int = 0) -> RealArray:
    """Return points of a scrambled Sobol sequence.

    Parameters
    ----------
    count : int
        Factors.
    samples : int
        Points.
    seed : int
        Seed of the scrambling.
    first : int
        Points of the sequence that are passed over.

    Returns
    -------
    numpy.ndarray (samples, count)
        Shares, 0 to 1 [-].
    """
    sequence = qmc.Sobol(count, scramble=True, rng=seed)
    if first:
        sequence.fast_forward(first)
        return np.asarray(sequence.random(samples))
    # drawn to the next power of two, of which the balance holds; it warns otherwise
    return np.asarray(sequence.random_base2(max(0, math.ceil(math.log2(samples)))))[:samples]


def columns_of(factors: Sequence[Factor], shares: RealArray) -> dict[str, AnyArray]:
    """Return values by field for shares of production (..., factors), 0 to 1."""
    columns: dict[str, AnyArray] = {}
    for number, factor in enumerate(factors):
        columns |= factor.values(shares[..., number])
    return columns
