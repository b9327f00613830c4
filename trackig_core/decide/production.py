"""How sure a design is to comply when its fields scatter as production makes them.

SI units, dB. The share of complying samples estimates the probability of compliance; its confidence interval
is Wilson's for independent samples, which quasi-random ones beat, so it is on the safe side. Whether a halved
scatter helps is McNemar's question about the same samples twice, answered exactly. Sources: Wilson (1927),
"Probable inference, the law of succession, and statistical inference"; McNemar (1947), "Note on the sampling
error of the difference between correlated proportions or percentages".
"""

from __future__ import annotations

from collections import ChainMap
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from itertools import product
from typing import TYPE_CHECKING, Any, Unpack

import numpy as np
from scipy.stats import binomtest

from trackig_core.arrays import BoolArray, RealArray
from trackig_core.decide.requirements import Requirements
from trackig_core.decide.solving import How, part_of, solve_designs
from trackig_core.decide.tolerances import (
    CONFIDENCE,
    Factor,
    Tolerance,
    columns_of,
    drawn_shares,
    make_factors,
)
from trackig_core.decide.words import how_much, sentence, spoken
from trackig_core.frequency_domain.batch import BatchSolution, solve_many
from trackig_core.levels.specification import Specification
from trackig_core.track.design import TrackDesign

if TYPE_CHECKING:
    import pandas

PERCENTILES = (5.0, 50.0, 95.0)
"""Percentiles of insertion gain that are kept [%]."""

TRIED = 2048
"""Samples from which it is judged what to tighten [-]: the same for all, so that differences show."""

MOST_FACTORS = 12
"""Tolerances that may vary at once [-]: they have 4096 corners."""


@dataclass(frozen=True, eq=False, repr=False)
class ToleranceResult:
    """How sure a design is to comply.

    Attributes
    ----------
    design : TrackDesign
        The design as it is stated.
    factors : tuple of str
        What varies: fields, and ``"production"`` for a table.
    samples, seed : int
        How many samples were drawn, and the seed of the sequence.
    complying : int
        Samples that comply.
    confidence_interval : (float, float)
        Probability of compliance, lowest and highest, 95 % [-].
    percentiles : numpy.ndarray (3, 21) [dB]
        Insertion gain below which 5, 50 and 95 % of production lie, band by band.
    margin_percentiles : numpy.ndarray (3,) [dB]
        The same of the governing margin.
    worst_corner : TrackDesign
        The design with every field at one end of its tolerance that keeps the limits least.
    worst_margin : float [dB]
        Its governing margin.
    tightened : dict of str to float
        Probability of compliance with the scatter of one factor halved, the greatest gain first [-].
    helpful : tuple of str
        Factors whose halved scatter helps: with it more of the same samples comply than chance explains, and
        not fewer than with the best of them. Empty where none helps.
    design_complies : bool
        Whether the design as it is stated complies. If not, less scatter brings production closer to failing.
    many : BatchSolution
        The samples, solved.
    margins : numpy.ndarray (samples,) [dB]
        Their governing margins.
    """

    design: TrackDesign
    factors: tuple[str, ...]
    samples: int
    seed: int
    complying: int
    confidence_interval: tuple[float, float]
    percentiles: RealArray
    margin_percentiles: RealArray
    worst_corner: TrackDesign
    worst_margin: float
    tightened: dict[str, float]
    helpful: tuple[str, ...]
    design_complies: bool
    many: BatchSolution = field(repr=False)
    margins: RealArray = field(repr=False)

    @property
    def probability(self) -> float:
        """Probability of compliance [-]."""
        return self.complying / self.samples

    @property
    def tighten_first(self) -> str | None:
        """Factor whose halved scatter helps most; None if none helps."""
        return next(iter(self.helpful), None)

    def to_dataframe(self) -> pandas.DataFrame:
        """Return a pandas.DataFrame, one row a sample: fields [SI], figures, governing margin [dB]."""
        return self.many.to_dataframe().assign(margin=self.margins)

    def __repr__(self) -> str:
        """Return the gist."""
        low, high = self.confidence_interval
        return (
            f"ToleranceResult(probability={self.probability:.4g} ({low:.4g} to {high:.4g}), "
            f"samples={self.samples}, seed={self.seed})"
        )

    def __str__(self) -> str:
        """Return one sentence."""
        low, high = (f"{100 * end:.1f}" for end in self.confidence_interval)
        said = sentence(f"{how_much(self.probability)} of production ({low}–{high} %) complies")
        if not self.design_complies:
            return (
                f"{said}; the design as stated does not."
                if self.complying
                else f"{said}, nor does the design."
            )
        if self.helpful:
            return f"{said}; tighten {' or '.join(map(_spoken, self.helpful))} first."
        if self.complying == self.samples:
            return f"{said}."
        return f"{said}{', and no more' if self.complying else ','} whichever scatter is halved."


def _spoken(factor: str) -> str:
    return "the scatter of the tested specimens" if factor == "production" else f"the {spoken(factor)}"


def tolerance(
    design: TrackDesign,
    specification: Specification,
    tolerances: Mapping[str, float | Tolerance],
    *,
    production: Mapping[str, Sequence[Any]] | None = None,
    samples: int = 10_000,
    seed: int = 0,
    max_deflection: float | None = None,
    reference: str = "line",
    summation: str = "energy",
    **how: Unpack[How],
) -> ToleranceResult:
    """Estimate how sure a design is to comply when its fields scatter.

    Parameters
    ----------
    design : TrackDesign
        The design as it is stated.
    specification : Specification
        Greatest insertion gain per band [dB].
    tolerances : dict of str to float or Tolerance
        By field, or by path of a number of suspension or ground such as ``"ground.stiffness"``: a share such
        as 0.1 for any value within +-10 %, or a :class:`Uniform` or :class:`Normal`.
    production : dict of str to sequence, optional
        Measured values by field [unit of the field], row by row of the same specimen.
    samples : int
        Samples that are drawn [-], 100 or more.
    seed : int
        Seed of the quasi-random sequence: the same seed gives the same figures.
    max_deflection : float, optional
        Greatest rail deflection, in place of the specification's own limit [m].
    reference, summation : str
        Definition of insertion gain, as for :func:`trackig_core.solve`.
    **how
        Where the designs are solved, and who is told; see :class:`How`.

    Returns
    -------
    ToleranceResult
        Probability of compliance, percentile bands, worst corner, and what to tighten.

    Raises
    ------
    DesignError
        If a tolerance reaches beyond what a track can have.
    SolveCancelled
        If ``cancelled`` answered true.
    ValueError
        If nothing varies, or a number or choice is not one of the above.
    """
    required = Requirements(specification, None, reference, summation, max_deflection)
    factors = make_factors(design, tolerances, production)
    if len(factors) > MOST_FACTORS:
        raise ValueError(
            f"{len(factors)} tolerances: give at most {MOST_FACTORS}, for every corner of them is solved"
        )
    if samples < 100:
        raise ValueError(f"samples = {samples}: give 100 or more")
    shares = drawn_shares(len(factors), samples, seed)
    tried = min(TRIED, samples)
    work = samples + tried * len(factors)
    many = solve_designs(design, columns_of(factors, shares), part_of(how, 0.0, samples / work))
    margins = required.governing_margin(many)
    complying = int(required.complies(many).sum())
    interval = binomtest(complying, samples).proportion_ci(CONFIDENCE, method="wilson")
    corner, worst = _worst_corner(design, required, factors, how)
    rest = part_of(how, samples / work, 1.0)
    halved = _halved(design, required, factors, shares[:tried], rest)
    return ToleranceResult(
        design=design,
        factors=tuple(each.name for each in factors),
        samples=samples,
        seed=seed,
        complying=complying,
        confidence_interval=(float(interval.low), float(interval.high)),
        percentiles=np.percentile(required.levels(many), PERCENTILES, axis=0),
        margin_percentiles=np.percentile(margins, PERCENTILES),
        worst_corner=corner,
        worst_margin=worst,
        tightened={name: float(complies.mean()) for name, complies in halved.items()},
        helpful=_helpful(required.complies(many)[:tried], halved),
        design_complies=bool(required.complies(solve_many(design))[0]),
        many=many,
        margins=margins,
    )


def _halved(
    design: TrackDesign, required: Requirements, factors: Sequence[Factor], shares: RealArray, how: How
) -> dict[str, BoolArray]:
    """Return which samples (n,) comply with the scatter of one factor halved, the greatest gain first."""
    halved = [factor.halved(shares[:, number]) for number, factor in enumerate(factors)]
    numbers = [number for number, values in enumerate(halved) if values]
    if not numbers:
        return {}
    as_drawn = columns_of(factors, shares)
    columns = {
        name: np.concatenate([halved[number].get(name, values) for number in numbers])
        for name, values in as_drawn.items()
    }
    many = solve_designs(design, columns, how)
    margins = required.governing_margin(many).reshape(len(numbers), -1)
    complies = required.complies(many).reshape(margins.shape)
    # of equal gains, the one that lifts the weak end of production
    order = np.lexsort((np.percentile(margins, PERCENTILES[0], axis=1), complies.mean(axis=1)))[::-1]
    return {factors[numbers[place]].name: complies[place] for place in order}


def _helpful(as_drawn: BoolArray, halved: Mapping[str, BoolArray]) -> tuple[str, ...]:
    """Return the factors whose halved scatter helps, those that are as good as the best."""
    best = next(iter(halved.values()), as_drawn)
    # as many questions are asked as there are factors: chance may not answer one of them
    doubt = (1 - CONFIDENCE) / max(len(halved), 1)
    helping = (name for name, complies in halved.items() if _doubt(complies, as_drawn) < doubt)
    return tuple(name for name in helping if _doubt(best, halved[name]) >= doubt)


def _doubt(these: BoolArray, those: BoolArray) -> float:
    """Return how likely chance alone lets as many more of the same samples comply [-], by McNemar's test."""
    gained, lost = (int(np.count_nonzero(one & ~other)) for one, other in ((these, those), (those, these)))
    if gained == 0:
        return 1.0
    return float(binomtest(gained, gained + lost, alternative="greater").pvalue)


def _worst_corner(
    design: TrackDesign, required: Requirements, factors: Sequence[Factor], how: How
) -> tuple[TrackDesign, float]:
    """Return the corner of the tolerances that keeps the limits least, and its governing margin [dB]."""
    corners = product(*(factor.corners() for factor in factors))
    many = solve_many(
        [design.replace(**dict(ChainMap(*corner))) for corner in corners],
        threads=how.get("threads"),
        cancelled=how.get("cancelled"),
    )
    worst = int(required.slacks(many).min(axis=-1).argmin())
    return many.design(worst), float(required.governing_margin(many)[worst])
