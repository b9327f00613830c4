"""What matters in a design: by how much figures change when fields do.

Locally, by exact differences: each field is changed up and down, all others held, and solved again. Globally,
by Sobol indices: the part of a figure's variance over the tolerances that is due to a field alone (first
order), and with all its interactions (total). SI units, dB, Hz. Source of the indices: Saltelli et al.
(2010), "Variance based sensitivity analysis of model output", as scipy.stats.sobol_indices has it.

Morris' elementary effects are not offered: they rank fields with few solutions, where each is dear. Here the
12 000 designs of the indices of ten fields take half a second of a processor, and say how much besides which.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any, Unpack

import numpy as np
from scipy.stats import sobol_indices

from trackig_core.arrays import RealArray
from trackig_core.bands import BAND_LABELS
from trackig_core.decide.numbers import changeable_numbers
from trackig_core.decide.requirements import DEFLECTION, MARGIN, UNITS, WORDS, Requirements
from trackig_core.decide.solving import How, solve_designs
from trackig_core.decide.tolerances import (
    CONFIDENCE,
    Tolerance,
    columns_of,
    drawn_shares,
    make_factors,
)
from trackig_core.decide.words import change_words, percent, spoken
from trackig_core.frequency_domain.batch import solve_many
from trackig_core.levels.source import SourceSpectrum
from trackig_core.levels.specification import Specification
from trackig_core.names import brief
from trackig_core.track.design import TrackDesign
from trackig_core.track.fields import GIVEN
from trackig_core.track.measured_curves import LossFactorCurve, StiffnessCurve

if TYPE_CHECKING:
    import pandas

CHANGE = 0.1
"""Change of a field unless another is asked for [-]."""

RESAMPLES = 200
"""Resamples of a bootstrap [-]."""

BASE_SAMPLES = 1024
"""Base samples of Sobol indices [-], a power of two; each costs two designs and one more per factor."""


@dataclass(frozen=True, eq=False, repr=False)
class Sensitivity:
    """How figures of a design change when its fields do, one at a time.

    Attributes
    ----------
    design : TrackDesign
        The design.
    changes : dict of str to float
        By how much each field was changed, down and up [-].
    figures : dict of str to float
        The design's own figures by name, see ``Requirements.values`` [their units].
    differences : dict of str to numpy.ndarray (fields, 2)
        By name, the changed design's figure less the design's own, down and up, field by field.
    bands : numpy.ndarray (fields, 2, 21) [dB]
        The same of insertion gain per band.
    """

    design: TrackDesign
    changes: dict[str, float]
    figures: dict[str, float]
    differences: dict[str, RealArray] = field(repr=False)
    bands: RealArray = field(repr=False)

    @property
    def fields(self) -> tuple[str, ...]:
        """Fields, in the order of the arrays."""
        return tuple(self.changes)

    def ranked(self, figure: str) -> tuple[str, ...]:
        """Return the fields, the one that changes a figure most first."""
        largest = np.abs(self.differences[figure]).max(axis=1)
        return tuple(self.fields[place] for place in np.argsort(-largest, kind="stable"))

    def first(self, figure: str) -> tuple[str, str]:
        """Return the track's field that changes a figure most, and one of vehicle or site that does more.

        Where none of the track's own fields was changed, the first is that of all; the second is empty if
        there is none.
        """
        ranked = self.ranked(figure)
        own = [name for name in ranked if name not in GIVEN]
        first = own[0] if own else ranked[0]
        return first, "" if first == ranked[0] else ranked[0]

    def to_dataframe(self) -> pandas.DataFrame:
        """Return a pandas.DataFrame, one row a change: field, share [-], differences."""
        import pandas as pd

        columns: dict[str, Any] = {
            "field": np.repeat(self.fields, 2),
            "change": np.array([[-each, each] for each in self.changes.values()]).ravel(),
        }
        columns |= {name: values.ravel() for name, values in self.differences.items()}
        columns |= dict(zip(BAND_LABELS, self.bands.reshape(-1, len(BAND_LABELS)).T, strict=True))
        return pd.DataFrame(columns)

    def __repr__(self) -> str:
        """Return fields and figures."""
        return f"Sensitivity(fields={self.fields}, figures={tuple(self.figures)})"

    def __str__(self) -> str:
        """Return one sentence."""
        figure = next(iter(self.figures))
        first, given = self.first(figure)
        down, up = self.differences[figure][self.fields.index(first)]
        share, unit = 100 * self.changes[first], UNITS[figure]
        if figure == DEFLECTION:
            down, up, unit = 1e3 * down, 1e3 * up, "mm"
        whose = "Of the track's own numbers, the" if given else "The"
        rest = given and f" It depends more on {spoken(given)}, which no supplier of a track chooses."
        return (
            f"{whose} {WORDS[figure]} depends most on {spoken(first)}: {share:.3g} % less changes it by "
            f"{change_words(down)} {unit}, {share:.3g} % more by {change_words(up)} {unit}.{rest}"
        )


def sensitivity(
    design: TrackDesign,
    specification: Specification | None = None,
    *,
    changes: float | Mapping[str, float] = CHANGE,
    source: SourceSpectrum | None = None,
    max_deflection: float | None = None,
    reference: str = "line",
    summation: str = "energy",
) -> Sensitivity:
    """Compute how a design's figures change when its fields do, one at a time, exactly.

    Parameters
    ----------
    design : TrackDesign
        The design.
    specification : Specification, optional
        Greatest insertion gain per band [dB], for the governing margin.
    changes : float or dict of str to float
        Change of every field, or of some by name, up and down [-]; a measured curve changes as a whole.
        Numbers of suspension and ground are named by path, such as ``"ground.stiffness"``.
    source : SourceSpectrum, optional
        Levels on the reference track [dB], for the A-weighted level.
    max_deflection : float, optional
        Greatest rail deflection, in place of the specification's own limit [m].
    reference, summation : str
        Definition of insertion gain, as for :func:`trackig_core.solve`.

    Returns
    -------
    Sensitivity
        Differences per band, of governing margin, level and natural frequencies.

    Raises
    ------
    DesignError
        If a changed value is one that no track can have.
    ValueError
        If a field cannot be changed, or a change is not above 0 and below 1.
    """
    required = Requirements(specification, source, reference, summation, max_deflection)
    changed_by = _changes(design, changes)
    changed = [
        design.replace(**{name: _scaled(design.value(name), factor)})
        for name, change in changed_by.items()
        for factor in (1 - change, 1 + change)
    ]
    many = solve_many([design, *changed])
    figures = {name: required.values(many, name) for name in required.figures(design)}
    levels = required.levels(many)
    return Sensitivity(
        design=design,
        changes=changed_by,
        figures={name: float(values[0]) for name, values in figures.items()},
        differences={name: (values[1:] - values[0]).reshape(-1, 2) for name, values in figures.items()},
        bands=(levels[1:] - levels[0]).reshape(-1, 2, len(BAND_LABELS)),
    )


def _changes(design: TrackDesign, changes: float | Mapping[str, float]) -> dict[str, float]:
    """Return the change of each field, checked."""
    known = changeable_numbers(design)
    given = dict(changes) if isinstance(changes, Mapping) else dict.fromkeys(known, changes)
    for name, change in given.items():
        if name not in known:
            raise ValueError(
                f"{brief(name)} cannot be changed in this design: give any of {', '.join(known)}"
            )
        if not 0 < change < 1:
            raise ValueError(f"change of {name} = {brief(change)}: give a share above 0 and below 1")
    return given


def _scaled(value: Any, factor: float) -> Any:
    """Return a number, or a measured curve at every frequency, times a factor."""
    if isinstance(value, StiffnessCurve):
        points = tuple((hz, factor * stiffness, loss) for hz, stiffness, loss in value.points)
        return replace(value, points=points)
    if isinstance(value, LossFactorCurve):
        return LossFactorCurve(tuple((hz, factor * loss) for hz, loss in value.points))
    return factor * value


@dataclass(frozen=True, eq=False, repr=False)
class SobolIndices:
    """Parts of the variance of figures that are due to what varies.

    Attributes
    ----------
    factors : tuple of str
        What varies: fields, and ``"production"`` for a table.
    figures : tuple of str
        Names of the figures, see ``Requirements.values``.
    first_order, total_order : numpy.ndarray (figures, factors) [-]
        Part of the variance due to a factor alone, and with all interactions in which it takes part.
    first_order_interval, total_order_interval : numpy.ndarray (figures, factors, 2) [-]
        Confidence intervals, 95 %, by bootstrap.
    samples, seed : int
        Base samples and seed.
    """

    factors: tuple[str, ...]
    figures: tuple[str, ...]
    first_order: RealArray = field(repr=False)
    total_order: RealArray = field(repr=False)
    first_order_interval: RealArray = field(repr=False)
    total_order_interval: RealArray = field(repr=False)
    samples: int
    seed: int

    def to_dataframe(self) -> pandas.DataFrame:
        """Return a pandas.DataFrame, one row a figure and factor: indices and their intervals [-]."""
        import pandas as pd

        rows = len(self.figures) * len(self.factors)
        return pd.DataFrame(
            {
                "figure": np.repeat(self.figures, len(self.factors)),
                "factor": np.tile(self.factors, len(self.figures)),
                "first_order": self.first_order.ravel(),
                "first_order_low": self.first_order_interval.reshape(rows, 2)[:, 0],
                "first_order_high": self.first_order_interval.reshape(rows, 2)[:, 1],
                "total_order": self.total_order.ravel(),
                "total_order_low": self.total_order_interval.reshape(rows, 2)[:, 0],
                "total_order_high": self.total_order_interval.reshape(rows, 2)[:, 1],
            }
        )

    def __repr__(self) -> str:
        """Return the gist."""
        return f"SobolIndices(factors={self.factors}, figures={self.figures}, samples={self.samples})"

    def __str__(self) -> str:
        """Return one sentence."""
        first = int(self.total_order[0].argmax())
        total, alone = (percent(float(order[0, first])) for order in (self.total_order, self.first_order))
        return (
            f"Of the scatter of the {WORDS[self.figures[0]]}, {total} is due to the "
            f"{spoken(self.factors[first])}, {alone} to it alone."
        )


def sobol(
    design: TrackDesign,
    tolerances: Mapping[str, float | Tolerance],
    specification: Specification | None = None,
    *,
    figures: Sequence[str] = (MARGIN,),
    production: Mapping[str, Sequence[Any]] | None = None,
    samples: int = BASE_SAMPLES,
    seed: int = 0,
    source: SourceSpectrum | None = None,
    max_deflection: float | None = None,
    reference: str = "line",
    summation: str = "energy",
    **how: Unpack[How],
) -> SobolIndices:
    """Compute Sobol indices over the tolerances of a design.

    Parameters
    ----------
    design : TrackDesign
        The design as it is stated.
    tolerances, production
        How fields scatter, as for :func:`tolerance`.
    specification : Specification, optional
        Greatest insertion gain per band [dB], for the governing margin.
    figures : sequence of str
        Whose variance is explained: the governing margin, ``"margin"``, unless others are named; see
        ``Requirements.values``.
    samples : int
        Base samples [-], a power of two; ``samples * (factors + 2)`` designs are solved.
    seed : int
        Seed of the quasi-random sequence and of the bootstrap.
    source, max_deflection, reference, summation
        As for :func:`sensitivity`.
    **how
        Where the designs are solved, and who is told; see :class:`How`.

    Returns
    -------
    SobolIndices
        First-order and total indices with confidence intervals.

    Raises
    ------
    DesignError
        If a tolerance reaches beyond what a track can have.
    SolveCancelled
        If ``cancelled`` answered true.
    ValueError
        If nothing varies, or a number or choice is not one of the above.
    """
    required = Requirements(specification, source, reference, summation, max_deflection)
    factors = make_factors(design, tolerances, production)
    required.check_figures(figures, design)

    def evaluate(shares: RealArray) -> RealArray:
        many = solve_designs(design, columns_of(factors, shares.T), how)
        return np.array([required.values(many, figure) for figure in figures])

    return indices_of(evaluate, tuple(each.name for each in factors), tuple(figures), samples, seed)


def indices_of(
    evaluate: Callable[[RealArray], RealArray],
    factors: tuple[str, ...],
    figures: tuple[str, ...],
    samples: int,
    seed: int,
) -> SobolIndices:
    """Return the Sobol indices of figures of factors that are uniform from 0 to 1.

    Parameters
    ----------
    evaluate : callable
        From shares (factors, n) to figures (figures, n).
    factors, figures : tuple of str
        Their names.
    samples : int
        Base samples, a power of two [-].
    seed : int
        Seed.

    Returns
    -------
    SobolIndices
        The indices.

    Raises
    ------
    ValueError
        If ``samples`` is no power of two.
    """
    if samples < 2 or samples & (samples - 1):
        raise ValueError(f"samples = {samples}: give a power of two, such as {BASE_SAMPLES}")
    shares = drawn_shares(2 * len(factors), samples, seed).T
    one, other = shares[: len(factors)], shares[len(factors) :]
    # one of the factors from the other sample, all else from the one
    mixed = np.repeat(one[:, None], len(factors), axis=1)
    for number in range(len(factors)):
        mixed[number, number] = other[number]
    drawn = np.concatenate([one[:, None], other[:, None], mixed], axis=1)
    values = evaluate(drawn.reshape(len(factors), -1)).reshape(len(figures), -1, samples)
    found = _indices(values)
    random = np.random.default_rng(seed)
    resampled = [_indices(values[:, :, random.integers(samples, size=samples)]) for _ in range(RESAMPLES)]
    ends = 100 * np.array([(1 - CONFIDENCE) / 2, (1 + CONFIDENCE) / 2])
    first, total = np.moveaxis(np.percentile(resampled, ends, axis=0), 0, -1)
    return SobolIndices(factors, figures, found[0], found[1], first, total, samples, seed)


def _indices(values: RealArray) -> RealArray:
    """Return first-order and total indices (2, figures, factors) of both samples and the mixed ones."""
    figures = len(values)
    # SciPy fails where there is one index alone, that of one figure for one factor
    values = np.repeat(values, 2, axis=0) if figures == 1 else values
    evaluated = {
        "f_A": values[:, 0],
        "f_B": values[:, 1],
        "f_AB": np.moveaxis(values[:, 2:], 1, 0),
    }
    with np.errstate(invalid="ignore"):  # what does not vary has no parts of a variance: NaN
        found = sobol_indices(func=evaluated, n=values.shape[-1])
    return np.array([found.first_order, found.total_order]).reshape(2, len(values), -1)[:, :figures]
