"""Find designs that comply: the front of governing margin against deflection, or against what else counts.

SI units, dB. The search is pymoo's NSGA-II, every generation solved in one call. Sources: Deb et al. (2002),
"A fast and elitist multiobjective genetic algorithm: NSGA-II"; Blank and Deb (2020), "pymoo: multi-objective
optimization in Python".
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Unpack

import numpy as np

from trackig_core.arrays import AnyArray, BoolArray, IntArray, RealArray
from trackig_core.decide.feasible import Ranges, searched_ranges
from trackig_core.decide.numbers import is_logarithmic, single_numbers
from trackig_core.decide.requirements import DEFLECTION, MARGIN, UNITS, Requirements
from trackig_core.decide.solving import How, joined, solve_designs
from trackig_core.decide.tolerances import drawn_shares
from trackig_core.decide.words import away, in_unit, spoken
from trackig_core.frequency_domain.batch import BatchSolution
from trackig_core.levels.source import SourceSpectrum
from trackig_core.levels.specification import Specification
from trackig_core.names import brief
from trackig_core.results import SolveCancelled
from trackig_core.track.design import TrackDesign
from trackig_core.track.measured_curves import LossFactorCurve, StiffnessCurve
from trackig_core.track.rails import RAILS, Rail
from trackig_core.track.static_stiffness import stand_in

if TYPE_CHECKING:
    import pandas

Choices = Mapping[str, Sequence[Any]]
"""What is chosen from a catalogue: values by field, or by any other name dicts of several fields at once,
each with a ``"cost"`` if it has one, and the name of the ``"component"``."""

COST = "cost"

COMPONENT = "component"

NO_FIELDS = {COST, COMPONENT}
"""What a choice may say beside the fields that it sets."""

POPULATION = 100
"""Designs of a generation [-]."""

GENERATIONS = 60
"""Generations [-]."""


@dataclass(frozen=True, eq=False, repr=False)
class FoundDesigns:
    """Designs that were tried, and the best of them.

    Attributes
    ----------
    design : TrackDesign
        The design from which the search departed.
    free : tuple of str
        Fields and choices that were free.
    objectives : tuple of str
        What was sought: ``"margin"`` as great, all others as small as possible.
    many : BatchSolution
        All designs that were tried, solved.
    values : numpy.ndarray (tried, objectives)
        Their objectives [units of these].
    slack : numpy.ndarray (tried,) [dB]
        How far each keeps the limit that it keeps least; negative if it fails.
    governed_by : tuple of str
        Limit that each keeps least: a band, or ``"deflection"``.
    front : numpy.ndarray of int (best,)
        Complying designs that no other beats in every objective, by the first objective.
    chosen : dict of str to numpy.ndarray of object (tried,)
        Names of the components that each has, by what was chosen between.
    seed, generations : int
        Seed, and generations that were finished.
    stopped : bool
        Whether the search was stopped before its end.
    deflections : numpy.ndarray (tried,) [m]
        Static rail deflection that each costs, under the specification's wheel load.
    deflection_limit : float or None [m]
        Greatest one allowed; without one a search runs to the softest designs of its ranges.
    """

    design: TrackDesign
    free: tuple[str, ...]
    objectives: tuple[str, ...]
    many: BatchSolution = field(repr=False)
    values: RealArray = field(repr=False)
    slack: RealArray = field(repr=False)
    governed_by: tuple[str, ...] = field(repr=False)
    front: IntArray = field(repr=False)
    chosen: dict[str, AnyArray] = field(repr=False)
    seed: int
    generations: int
    stopped: bool
    deflections: RealArray = field(repr=False)
    deflection_limit: float | None

    @property
    def complies(self) -> BoolArray:
        """Which of the designs comply (tried,)."""
        return self.slack >= 0

    @property
    def closest(self) -> int:
        """Place of the design that keeps its limits best, or misses them least."""
        return int(self.slack.argmax())

    @property
    def in_the_way(self) -> str | None:
        """Limit that the closest design misses most, if none complies: a band, or ``"deflection"``."""
        return None if self.front.size else self.governed_by[self.closest]

    def best(self) -> list[TrackDesign]:
        """Return the designs of the front."""
        return [self.many.design(int(place)) for place in self.front]

    def to_dataframe(self) -> pandas.DataFrame:
        """Return a pandas.DataFrame, one row a design tried: fields [SI], components, figures, front."""
        table = (
            self.many.to_dataframe()
            .assign(**self.chosen)
            .assign(slack=self.slack, governed_by=self.governed_by)
        )
        table = table.assign(**dict(zip(self.objectives, self.values.T, strict=True)))
        return table.assign(front=np.isin(np.arange(self.slack.size), self.front))

    def __repr__(self) -> str:
        """Return the gist."""
        return (
            f"FoundDesigns(tried={self.slack.size}, complying={int(self.complies.sum())}, "
            f"front={self.front.size}, seed={self.seed})"
        )

    def __str__(self) -> str:
        """Return one sentence."""
        if not self.front.size:
            by, miss = self.in_the_way, -float(self.slack[self.closest])
            if by == DEFLECTION:
                return f"No design complies; the closest sinks {10 ** (miss / 20) - 1:.0%} more than allowed."
            return f"No design complies; the closest misses the limit at {by} Hz by {away(miss)}."
        best = zip(self.objectives, self.values[self.front].T, strict=True)
        ends = (f"{spoken(name)} {_span(name, values)}" for name, values in best)
        unlimited = self.unlimited and f" {self.unlimited}"
        return f"{self.summary}: {', '.join(ends)}.{unlimited}"

    @property
    def unlimited(self) -> str:
        """That no limit of deflection bounds the search, and how far the best sink; empty if one does."""
        if self.deflection_limit is not None or not self.front.size:
            return ""
        sinks = _span(DEFLECTION, self.deflections[self.front])
        return f"No limit of rail deflection is set: with the best designs the rail sinks {sinks}."

    @property
    def explained(self) -> str:
        """What it means that no other beats a design, in words; empty if none complies."""
        if not self.front.size:
            return ""
        if len(self.objectives) == 1:
            return f"No other beats a design: none that was tried is better in {spoken(self.objectives[0])}."
        names = " and ".join(map(spoken, self.objectives))
        return (
            f"No other beats a design: none that was tried is as good in {names}, and better in one of them."
        )

    @property
    def summary(self) -> str:
        """How many designs comply, and how many of them are best, in words; of some that comply."""
        complying, best = int(self.complies.sum()), self.front.size
        comply = "complies" if complying == 1 else "comply"
        said = f"{complying} of {self.slack.size} designs {comply}"
        if complying == 1:
            return said
        return f"{said}, and no other beats {'one' if best == 1 else best} of them"


def _span(name: str, values: RealArray) -> str:
    """Return least and greatest of an objective with its unit, one number where they are the same."""
    low, high = (in_unit(name, float(end)) for end in (values.min(), values.max()))
    return low if low == high else f"from {low} to {high}"


def find(
    design: TrackDesign,
    specification: Specification,
    free: Sequence[str] | Ranges = (),
    *,
    choices: Choices | None = None,
    objectives: Sequence[str] = (MARGIN, DEFLECTION),
    cost: Mapping[str, float] | None = None,
    population: int = POPULATION,
    generations: int = GENERATIONS,
    seed: int = 0,
    so_far: Callable[[FoundDesigns], object] | None = None,
    source: SourceSpectrum | None = None,
    max_deflection: float | None = None,
    reference: str = "line",
    summation: str = "energy",
    **how: Unpack[How],
) -> FoundDesigns:
    """Search for designs that comply, and for the best of them.

    Parameters
    ----------
    design : TrackDesign
        The design from which the search departs; what is not free stays as it is here.
    specification : Specification
        Greatest insertion gain per band [dB], and deflection [m].
    free : sequence of str, or dict of str to (float, float)
        Fields that are free, with their ranges [unit of the field]; by default :data:`SEARCHED_RANGES`. Those
        of suspension and ground are named by path, such as ``"ground.stiffness"``. A stated static stiffness
        keeps its ratio to the dynamic one.
    choices : dict of str to sequence, optional
        What is chosen from a catalogue: values by field, or by any other name dicts of several fields at
        once, each of which may have a ``"cost"``, and with the name of a ``"component"`` stands for the whole
        pad or boot, as :meth:`trackig_core.study.Component.choice` gives it. A rail is a ``Rail``, its name
        or a dict of its fields; what is measured is a curve, or a list of its rows, or a dict of its fields.
    objectives : sequence of str
        One or more of ``"margin"`` (as great as possible), other figures (see ``Requirements.values``),
        fields that are numbers, and ``"cost"``, all as small as possible.
    cost : dict of str to float, optional
        Cost per unit by field [1/unit of the field], for the objective ``"cost"``.
    population, generations : int
        Designs of a generation, and how many generations [-].
    seed : int
        Seed: the same seed gives the same designs.
    so_far : callable, optional
        Called after each generation with what was found until then.
    source, max_deflection, reference, summation
        As for :func:`design_map`.
    **how
        Where the designs are solved, and who is told; see :class:`How`. When ``cancelled`` answers true, what
        was found until then is returned.

    Returns
    -------
    FoundDesigns
        All designs tried, and the front; if none complies, the closest, and which limit stands in the way.

    Raises
    ------
    DesignError
        If a range or a choice reaches beyond what a track can have.
    SolveCancelled
        If ``cancelled`` answered true before a generation was finished.
    ValueError
        If nothing is free, or a name or number is not one of the above.
    """
    required = Requirements(specification, source, reference, summation, max_deflection)
    space = _Space.of(design, free, choices or {})
    sought = _Sought(required, tuple(objectives), dict(cost or {}))
    sought.check(design, space)
    if population < 4 or generations < 1:
        raise ValueError("give a population of 4 or more, and 1 generation or more")
    trail = _Trail(design, space, sought, seed)
    search = _nsga2(design, space, sought, population, seed)
    for number in range(generations):
        done, part = number / generations, 1 / generations
        tried = search.ask()
        places = np.array(tried.get("X"), dtype=float)
        columns = _with_static(design, space.columns(places))
        try:
            many = solve_designs(design, columns, {**how, "progress": None})
        except SolveCancelled:
            if not trail.parts:
                raise
            return trail.found(stopped=True)
        _tell(search, tried, *trail.add(many, places))
        if so_far is not None:
            so_far(trail.found())
        progress = how.get("progress")
        if progress is not None:
            progress(done + part)
        cancelled = how.get("cancelled")
        if cancelled is not None and cancelled():
            return trail.found(stopped=number + 1 < generations)
    return trail.found()


@dataclass(frozen=True)
class _Space:
    """What is free, as places from 0 to 1: fields along their ranges first, then choices."""

    ranges: dict[str, tuple[float, float]]
    choices: dict[str, tuple[dict[str, Any], ...]]

    @classmethod
    def of(cls, design: TrackDesign, free: Sequence[str] | Ranges, choices: Choices) -> _Space:
        names = [field.name for field in dataclasses.fields(TrackDesign)]
        offered = {
            name: tuple(
                _made_choice({name: each} if name in names and not _sets(name, each) else each)
                for each in values
            )
            for name, values in choices.items()
        }
        for name, values in offered.items():
            if not values:
                raise ValueError(f"{name}: give one or more to choose from")
            for each in values:
                design.replace(**_fields(each))
        ranges = searched_ranges(design, tuple(free), free if isinstance(free, Mapping) else None)
        chosen = [key for values in offered.values() for key in _fields(values[0])]
        for name, values in offered.items():
            if any(each.keys() - {COST} != values[0].keys() - {COST} for each in values):
                raise ValueError(f"{name}: give the same fields for each")
        twice = {name for name in chosen if name in ranges or chosen.count(name) > 1}
        if twice:
            raise ValueError(f"{', '.join(sorted(twice))}: free in two ways; give it once")
        if not ranges and not offered:
            raise ValueError("nothing is free: name fields, such as free=['boot_stiffness', 'block_mass']")
        return cls(ranges, offered)

    @property
    def names(self) -> tuple[str, ...]:
        return (*self.ranges, *self.choices)

    def columns(self, places: RealArray) -> dict[str, AnyArray]:
        """Return columns of designs (n,) at places (n, names)."""
        columns: dict[str, AnyArray] = {}
        for (name, (low, high)), place in zip(self.ranges.items(), places.T, strict=False):
            value = low * (high / low) ** place if is_logarithmic(name) else low + (high - low) * place
            columns[name] = value.clip(low, high)
        for name, values in self.choices.items():
            rows = self.chosen(places, name)
            for key in _fields(values[0]):
                column = _objects(values[row][key] for row in rows)
                is_number = all(isinstance(each[key], int | float) for each in values)
                columns[key] = column.astype(float) if is_number else column
        return columns

    def components(self, places: RealArray) -> dict[str, AnyArray]:
        """Return the names of the components of designs (n,) at places (n, names), by choice."""
        return {
            name: _objects(values[row][COMPONENT] for row in self.chosen(places, name))
            for name, values in self.choices.items()
            if COMPONENT in values[0]
        }

    def measured(self, field: str) -> bool:
        """Return whether one of the choices has a field that is no single number."""
        return any(
            field in each and not isinstance(each[field], int | float)
            for values in self.choices.values()
            for each in values
        )

    def chosen(self, places: RealArray, name: str) -> IntArray:
        """Return which of the choices of a name is made (n,)."""
        count = len(self.choices[name])
        return np.minimum((places[:, self.names.index(name)] * count).astype(int), count - 1)

    def prices(self, places: RealArray) -> RealArray:
        """Return the cost of what is chosen (n,)."""
        total = np.zeros(len(places))
        for name, values in self.choices.items():
            total += np.array([float(each.get(COST, 0.0)) for each in values])[self.chosen(places, name)]
        return total

    def place_of(self, design: TrackDesign) -> RealArray:
        """Return the place that is nearest to a design (names,)."""
        place = []
        for name, (low, high) in self.ranges.items():
            value = min(max(design.value(name), low), high)
            logarithmic = is_logarithmic(name)
            place.append(
                np.log(value / low) / np.log(high / low) if logarithmic else (value - low) / (high - low)
            )
        for values in self.choices.values():
            same = [all(design.value(k) == v for k, v in _fields(each).items()) for each in values]
            place.append(((same.index(True) if any(same) else 0) + 0.5) / len(values))
        return np.array(place)


def _fields(choice: Mapping[str, Any]) -> dict[str, Any]:
    """Return the fields that a choice sets."""
    return {name: value for name, value in choice.items() if name not in NO_FIELDS}


def _sets(field: str, given: Any) -> bool:
    """Return whether a choice is a dict that sets a field, rather than the value of that field."""
    return isinstance(given, Mapping) and field in given


def _objects(values: Iterable[Any]) -> AnyArray:
    """Return values (n,) as an array of objects, none of which is taken apart."""
    listed = list(values)
    column = np.empty(len(listed), dtype=object)
    column[:] = listed
    return column


def _made_choice(given: Mapping[str, Any]) -> dict[str, Any]:
    """Return a choice with rails and curves in place of plain values.

    What a component does not give is absent from the track.
    """
    choice = {name: _made(name, value) for name, value in given.items()}
    for part in ("pad", "boot"):
        if COMPONENT in choice and f"{part}_stiffness" in choice:
            choice = {f"{part}_loss_factor": None, f"{part}_static_stiffness": None} | choice
    return choice


def _made(name: str, given: Any) -> Any:
    """Return what a plain value of a field stands for."""
    if name == "rail" and isinstance(given, str):
        if given not in RAILS:
            raise ValueError(f"rail {brief(given)}: give one of {', '.join(RAILS)}")
        return RAILS[given]
    if name == "rail" and isinstance(given, Mapping):
        try:
            return Rail(**given)
        except TypeError:
            keys = ", ".join(each.name for each in dataclasses.fields(Rail))
            raise ValueError(f"rail {brief(dict(given))}: give {keys}") from None
    if isinstance(given, list | tuple):
        rows: Any = given  # the curve checks them
        return LossFactorCurve(rows) if name.endswith("loss_factor") else StiffnessCurve(rows)
    if name.endswith("_stiffness") and isinstance(given, Mapping):
        try:
            return StiffnessCurve(**given)
        except TypeError:
            raise ValueError(f"{name} {brief(dict(given))}: give points and preload") from None
    return given


@dataclass(frozen=True)
class _Sought:
    """What is sought."""

    required: Requirements
    objectives: tuple[str, ...]
    cost: dict[str, float]

    def check(self, design: TrackDesign, space: _Space) -> None:
        """Raise a ValueError if an objective cannot be computed."""
        fields = [each.name for each in dataclasses.fields(design)]
        numbers = [name for name in fields if isinstance(design.value(name), float)]
        numbers += [name for name in single_numbers(design) if name not in fields]
        for name in self.cost:
            if name not in numbers:
                raise ValueError(f"cost of {brief(name)}: give a cost per unit of {', '.join(numbers)}")
        if not self.objectives:
            raise ValueError("objectives: give one or more, such as 'margin'")
        priced = self.cost or any(COST in each for values in space.choices.values() for each in values)
        for name in self.objectives:
            if name == COST and not priced:
                raise ValueError(
                    "cost: give a cost per unit, such as cost={'block_mass': 2.0}, or of each choice"
                )
            if name != COST and name not in numbers:
                self.required.check_figures((name,), design)
        for name in (*self.objectives, *self.cost):
            if space.measured(name):
                raise ValueError(
                    f"{name}: a component that is measured over frequency has no single one; "
                    "leave it out of the choices, or seek something else"
                )

    def values(self, many: BatchSolution, prices: RealArray) -> RealArray:
        """Return the objectives of designs (n, objectives)."""
        return np.stack([self._value(many, name, prices) for name in self.objectives], axis=-1)

    def _value(self, many: BatchSolution, name: str, prices: RealArray) -> RealArray:
        if name == COST:
            for each, per_unit in self.cost.items():
                prices = prices + per_unit * many.column(each).astype(float)
            return prices
        if name in UNITS:
            return self.required.values(many, name)
        return many.column(name).astype(float)

    def minimised(self, values: RealArray) -> RealArray:
        """Return objectives that are the better the smaller they are."""
        return values * [-1.0 if name == MARGIN else 1.0 for name in self.objectives]


class _Trail:
    """What was tried, generation by generation."""

    def __init__(self, design: TrackDesign, space: _Space, sought: _Sought, seed: int) -> None:
        self.design, self.space, self.sought, self.seed = design, space, sought, seed
        self.parts: list[BatchSolution] = []
        self._values: list[RealArray] = []
        self._slacks: list[RealArray] = []
        self._deflections: list[RealArray] = []
        self._places: list[RealArray] = []

    def add(self, many: BatchSolution, places: RealArray) -> tuple[RealArray, RealArray]:
        """Take in a generation; return what is to be minimised, and what may not be above zero."""
        self.parts.append(many)
        self._places.append(places)
        self._values.append(self.sought.values(many, self.space.prices(places)))
        self._slacks.append(self.sought.required.slacks(many))
        self._deflections.append(self.sought.required.deflection(many))
        return self.sought.minimised(self._values[-1]), -self._slacks[-1].min(axis=-1, keepdims=True)

    def found(self, stopped: bool = False) -> FoundDesigns:
        """Return what was found until now."""
        values, slacks = np.concatenate(self._values), np.concatenate(self._slacks)
        slack = slacks.min(axis=-1)
        names = (*self.sought.required.names, DEFLECTION)
        complying = np.flatnonzero(slack >= 0)
        minimised = self.sought.minimised(values)
        front = complying[_not_dominated(minimised[complying])]
        return FoundDesigns(
            design=self.design,
            free=self.space.names,
            objectives=self.sought.objectives,
            many=joined(self.parts),
            values=values,
            slack=slack,
            governed_by=tuple(names[limit] for limit in slacks.argmin(axis=-1)),
            front=front[np.argsort(minimised[front, 0], kind="stable")],
            chosen=self.space.components(np.concatenate(self._places)),
            seed=self.seed,
            generations=len(self.parts),
            stopped=stopped,
            deflections=np.concatenate(self._deflections),
            deflection_limit=self.sought.required.deflection_limit,
        )


def _with_static(design: TrackDesign, columns: dict[str, AnyArray]) -> dict[str, AnyArray]:
    """Return columns in which a stated static stiffness keeps its ratio to a dynamic one that is free."""
    for part in ("pad", "boot"):
        static, dynamic = f"{part}_static_stiffness", f"{part}_stiffness"
        stated, free = getattr(design, static), columns.get(dynamic)
        if static not in columns and stated is not None and free is not None and free.dtype != object:
            columns[static] = free * (stated / stand_in(None, getattr(design, dynamic)))
    return columns


def _not_dominated(values: RealArray) -> IntArray:
    """Return which rows no other beats in every column (best,); of equal rows the first."""
    # slow to load, and nothing else needs it
    from pymoo.util.nds.non_dominated_sorting import NonDominatedSorting

    if not len(values):
        return np.empty(0, dtype=np.int64)
    _, first = np.unique(values, axis=0, return_index=True)
    best = NonDominatedSorting().do(values[first], only_non_dominated_front=True)
    return np.sort(first[best])


def _nsga2(design: TrackDesign, space: _Space, sought: _Sought, population: int, seed: int) -> Any:
    """Return a search that is asked for designs and told how they fare."""
    # slow to load, and nothing else needs it
    from pymoo.algorithms.moo.nsga2 import NSGA2
    from pymoo.config import Config
    from pymoo.core.problem import Problem
    from pymoo.core.termination import NoTermination

    Config.warnings["not_compiled"] = False
    count = len(space.names)
    first = drawn_shares(count, population, seed)
    first[0] = space.place_of(design)
    problem = Problem(n_var=count, n_obj=len(sought.objectives), n_ieq_constr=1, xl=0.0, xu=1.0)
    search = NSGA2(pop_size=population, sampling=first)
    search.setup(problem, termination=NoTermination(), seed=seed, verbose=False)
    return search


def _tell(search: Any, tried: Any, objectives: RealArray, constraints: RealArray) -> None:
    """Tell a search how its designs fare."""
    from pymoo.core.evaluator import Evaluator
    from pymoo.problems.static import StaticProblem

    Evaluator().eval(StaticProblem(search.problem, F=objectives, G=constraints), tried)
    search.tell(infills=tried)
