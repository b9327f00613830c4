"""What the designs of a workshop are held against: a specification, and a source.

dB, Hz. Every design that is on the table, the one at hand and each pinned one, is assessed as soon as its
picture is there, with the insertion gain that the page shows.

The one rule: a design is assessed by its last good picture, or not at all; nothing here solves.
"""

from dataclasses import dataclass

import numpy as np
import param

import trackig_core as tig
from dashboard import theme
from dashboard.session.pins import THIS_DESIGN
from dashboard.session.results import SolutionSummary


@dataclass(frozen=True, eq=False)
class Assessed:
    """One design, and what became of it.

    Attributes
    ----------
    key : int or None
        Key of its pin; None: the design at hand.
    name : str
        What it is called.
    colour : str
        Colour of its curves.
    dash : tuple of float
        Dash of its curves; empty if solid.
    shown : bool
        Whether it is drawn.
    summary : SolutionSummary
        Its last good picture.
    levels : numpy.ndarray (21,)
        Its insertion gain [dB].
    verdict : trackig_core.Verdict or None
        How it fares against the specification; None without one.
    level : trackig_core.TrackLevel or None
        What the source becomes with it; None without a source.
    """

    key: int | None
    name: str
    colour: str
    dash: tuple[float, ...]
    shown: bool
    summary: SolutionSummary
    levels: np.ndarray
    verdict: tig.Verdict | None
    level: tig.TrackLevel | None


class Assessment(param.Parameterized):
    """Specification, source and the designs that are held against them.

    Parameters
    ----------
    outcome : Outcome
        Picture of the design at hand.
    definition : GainDefinition
        How insertion gain is reckoned.
    pins : Pins
        The pinned designs.
    pinned : PinnedSummaries
        Their pictures, by key.
    curves : PinnedCurves
        Their insertion gain, by key.
    """

    specification = param.ClassSelector(class_=tig.Specification, default=None, allow_None=True)
    source = param.ClassSelector(class_=tig.SourceSpectrum, default=None, allow_None=True)
    title = param.String(default=tig.Study.name, doc="What the study is called.")
    assessed = param.Parameter(default=(), doc="A tuple of Assessed, the design at hand first.")

    def __init__(self, outcome, definition, pins, pinned, curves):
        super().__init__()
        self._outcome, self._definition = outcome, definition
        self._pins, self._pinned, self._curves = pins, pinned, curves
        outcome.param.watch(self._assess, "summary")
        definition.param.watch(self._assess, ["summation", "reference"])
        pins.param.watch(self._assess, ["pinned", "base"])
        curves.param.watch(self._assess, "levels")
        self.param.watch(self._assess, ["specification", "source"])
        self._assess()

    @property
    def shown(self):
        """Those that are drawn, a tuple of Assessed; the design at hand is the first."""
        return tuple(each for each in self.assessed if each.shown)

    @property
    def base(self):
        """The design from which differences are taken (Assessed), or None while it has no picture."""
        return next((each for each in self.assessed if each.key == self._pins.base), None)

    def _assess(self, *_):
        self.assessed = tuple(self._assessments())

    def _assessments(self):
        summary, levels = self._outcome.summary, self._curves.levels
        if summary is not None:
            gain = self._definition.levels(summary.solution)
            yield self._assessment(None, THIS_DESIGN, theme.THIS_DESIGN, (), True, summary, gain)
        for pin in self._pins.pinned:
            if pin.key in levels:
                summary = self._pinned.summaries[pin.key]
                look = (pin.key, pin.name, pin.colour_code, pin.dash, pin.shown)
                yield self._assessment(*look, summary, levels[pin.key])

    def _assessment(self, key, name, colour, dash, shown, summary, levels):
        return Assessed(
            key=key,
            name=name,
            colour=colour,
            dash=dash,
            shown=shown,
            summary=summary,
            levels=levels,
            verdict=None if self.specification is None else self.specification.check(levels),
            level=None if self.source is None else self.source.with_track(levels),
        )
