"""Questions and answers as records: what was asked, of which design, and what came out.

A question holds plain values, as a file or a command line gives them, in SI units. An answer holds the
sentence that is read aloud, the versions that computed it, and a digest of every figure: asked again with the
same versions on the same machine, the same digest comes out.
"""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, is_dataclass
from importlib import import_module
from typing import TYPE_CHECKING, Any, Protocol, Unpack

import numpy as np

from trackig_core.decide.requirements import Requirements
from trackig_core.decide.solving import How
from trackig_core.decide.versions import versions
from trackig_core.levels.source import SourceSpectrum
from trackig_core.levels.specification import Specification
from trackig_core.names import brief
from trackig_core.track.design import TrackDesign

if TYPE_CHECKING:
    import pandas


class Result(Protocol):
    """What every result can do beside what it is."""

    def to_dataframe(self) -> pandas.DataFrame:
        """Return all figures as a pandas.DataFrame."""


@dataclass(frozen=True)
class Kind:
    """How one kind of question is asked.

    Attributes
    ----------
    function : str
        Name of the function of ``trackig_core.decide`` that answers.
    settings : tuple of str
        Its arguments that make the question.
    needs_specification : bool
        Whether there is no answer without one.
    takes_source : bool
        Whether it takes a source spectrum.
    takes_how : bool
        Whether it takes the arguments of :class:`How`.
    """

    function: str
    settings: tuple[str, ...]
    needs_specification: bool = True
    takes_source: bool = False
    takes_how: bool = True


KINDS = {
    "range": Kind("feasible_ranges", ("fields", "ranges")),
    "sensitivity": Kind(
        "sensitivity", ("changes",), needs_specification=False, takes_source=True, takes_how=False
    ),
    "sobol": Kind(
        "sobol",
        ("tolerances", "production", "figures", "samples", "seed"),
        needs_specification=False,
        takes_source=True,
    ),
    "tolerance": Kind("tolerance", ("tolerances", "production", "samples", "seed")),
    "map": Kind(
        "design_map",
        ("x_field", "y_field", "figures", "ranges", "points"),
        needs_specification=False,
        takes_source=True,
    ),
    "find": Kind(
        "find",
        ("free", "choices", "objectives", "cost", "population", "generations", "seed"),
        takes_source=True,
    ),
}
"""Kinds of question by name."""


@dataclass(frozen=True)
class Question:
    """A question about a design.

    Parameters
    ----------
    kind : str
        A key of :data:`KINDS`.
    design : TrackDesign
        The design.
    settings : dict
        Arguments by name, plain values [SI units]: a tolerance is a share, ``{"uniform": share}`` or
        ``{"normal": deviation}``; rails stand by their names, measured curves by their rows.
    specification : Specification or None
        What designs are held against.
    source : SourceSpectrum or None
        Levels on the reference track.
    reference, summation : str
        Definition of insertion gain, as for :func:`trackig_core.solve`.

    Raises
    ------
    ValueError
        If there is no such kind, a setting is none of it, or a specification is missing.
    """

    kind: str
    design: TrackDesign
    settings: Mapping[str, Any] = field(default_factory=dict, hash=False)
    specification: Specification | None = None
    source: SourceSpectrum | None = None
    reference: str = "line"
    summation: str = "energy"

    def __post_init__(self) -> None:
        """Check what can be checked without asking."""
        if self.kind not in KINDS:
            raise ValueError(f"question = {brief(self.kind)}: give {', '.join(KINDS)}")
        kind = KINDS[self.kind]
        for name in self.settings:
            if name not in (*kind.settings, "max_deflection"):
                allowed = ", ".join((*kind.settings, "max_deflection"))
                raise ValueError(f"{self.kind} has no setting {brief(name)}: give {allowed}")
            _check_plain(self.settings[name], name)
        if self.specification is None and kind.needs_specification:
            raise ValueError(f"{self.kind} needs a specification to hold designs against: give one")
        Requirements(self.specification, self.source, self.reference, self.summation)

    def ask(self, **how: Unpack[How]) -> Any:
        """Return the result, as the function of that name does.

        Parameters
        ----------
        **how
            Where the designs are solved, and who is told; see :class:`How`.

        Returns
        -------
        FeasibleRanges, Sensitivity, SobolIndices, ToleranceResult, DesignMap or FoundDesigns
            The result.

        Raises
        ------
        DesignError
            If a value is one that no track can have.
        SolveCancelled
            If ``cancelled`` answered true.
        ValueError
            If a setting is not allowed.
        """
        kind = KINDS[self.kind]
        arguments: dict[str, Any] = {
            name: _MADE.get(name, _same)(value) for name, value in self.settings.items()
        }
        arguments |= {"reference": self.reference, "summation": self.summation}
        arguments["specification"] = self.specification
        if kind.takes_source:
            arguments["source"] = self.source
        if kind.takes_how:
            arguments |= how
        return getattr(import_module("trackig_core.decide"), kind.function)(self.design, **arguments)

    def __str__(self) -> str:
        """Return what is asked, of which design."""
        return f"{self.kind} of {self.design}"


@dataclass(frozen=True)
class Answer:
    """What came out of a question.

    Parameters
    ----------
    question : Question
        What was asked.
    sentence : str
        The answer in one sentence.
    digest : str
        SHA-256 of every figure.
    versions : dict of str to str
        What computed it: versions by package.

    Raises
    ------
    ValueError
        If a text is none that can be printed.
    """

    question: Question
    sentence: str
    digest: str
    versions: Mapping[str, str] = field(hash=False)

    def __post_init__(self) -> None:
        """Check what a file may have given."""
        texts = {"sentence": self.sentence, "digest": self.digest, **self.versions}
        for name, text in texts.items():
            if not isinstance(text, str) or not text.isprintable():
                raise ValueError(f"{name} = {brief(text)}: give a text of printable characters")

    @classmethod
    def of(cls, question: Question, result: Result) -> Answer:
        """Return the record of a result.

        Parameters
        ----------
        question : Question
            What was asked.
        result : object
            What :meth:`Question.ask` returned.

        Returns
        -------
        Answer
            The record.
        """
        return cls(question, str(result), digest(result), versions())

    def holds(self, **how: Unpack[How]) -> bool:
        """Return whether the same figures come out, to the last bit, when it is asked again."""
        return digest(self.question.ask(**how)) == self.digest

    def __str__(self) -> str:
        """Return the answer in one sentence."""
        return self.sentence


def digest(result: Result) -> str:
    """Return the SHA-256 of every figure of a result (str)."""
    found = hashlib.sha256()
    for name, column in result.to_dataframe().items():
        values = column.to_numpy()
        found.update(f"{name}\0".encode())
        if values.dtype.kind in "fib":
            found.update(np.ascontiguousarray(values).tobytes())
        else:
            found.update("\0".join(map(_in_full, values)).encode())
    return found.hexdigest()


def _in_full(cell: object) -> str:
    """Return a cell as text in which every figure shows, also those of a curve or a rail."""
    return repr(cell) if is_dataclass(cell) else str(cell)


def arguments(settings: Mapping[str, Any]) -> dict[str, Any]:
    """Return the arguments that plain values stand for.

    Parameters
    ----------
    settings : dict
        Plain values by name, as for :class:`Question`.

    Returns
    -------
    dict
        Arguments of the function that answers.

    Raises
    ------
    ValueError
        If a tolerance is of no known kind.
    """
    return {name: _MADE.get(name, _same)(value) for name, value in settings.items()}


def _check_plain(value: Any, name: str) -> None:
    """Raise a ValueError if a setting is not made of numbers, texts, lists and dicts, as files are."""
    if isinstance(value, Mapping):
        for key, each in value.items():
            _check_plain(each, f"{name}.{key}")
    elif isinstance(value, list | tuple):
        for each in value:
            _check_plain(each, name)
    elif not isinstance(value, bool | int | float | str):
        raise ValueError(f"{name} = {brief(value)}: give numbers, texts, lists and dicts of them")


def _same(value: Any) -> Any:
    return value


def _tolerances(given: Mapping[str, Any]) -> dict[str, Any]:
    """Return tolerances of plain values."""
    return {name: _tolerance(name, value) for name, value in given.items()}


def _tolerance(name: str, given: Any) -> Any:
    if not isinstance(given, Mapping):
        return given
    # slow to load, and a study that holds a question need not ask it
    from trackig_core.decide.tolerances import Normal, Uniform

    kinds: dict[str, Callable[[float], Any]] = {"uniform": Uniform, "normal": Normal}
    if len(given) != 1 or not set(given) <= set(kinds):
        raise ValueError(f"tolerance of {name} = {brief(given)}: give a share, or one of uniform and normal")
    ((kind, share),) = given.items()
    return kinds[kind](share)


_MADE: dict[str, Callable[[Any], Any]] = {
    "tolerances": _tolerances,
    "points": tuple,
    "figures": tuple,
    "objectives": tuple,
}
"""What makes an argument of a plain value, by the name of the setting."""
