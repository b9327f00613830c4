"""The current design and the pinned ones, with what was computed of them, for all views.

Every design is compared with the specification, and the source with its track is computed, by the
insertion gain that the page shows. dB, Hz. Nothing here solves.
"""

import dataclasses
import operator

import param

import trackig_core as tig
from dashboard.fields import LOAD
from dashboard.session.pins import current_design, preset_design
from dashboard.session.results import DesignResult


class Assessment(param.Parameterized):
    """Specification, source, and the results of all designs.

    A result whose design, solution, definition, specification and source are those of before is the same
    object as before: a frame of a drag computes the current design alone, and a figure can tell by identity
    what it need not draw again.

    Parameters
    ----------
    inputs : DesignInputs
        The current design, as long as it was never solved, and the wheels that stand on every design.
    outcome : Outcome
        Solution of the current design, and of the preset from which it departs.
    definition : GainDefinition
        Which insertion gain is shown.
    pins : Pins
        The pinned designs.
    pinned : PinnedSummaries
        Their solutions, by key.
    """

    specification = param.ClassSelector(class_=tig.Specification, default=None, allow_None=True)
    source = param.ClassSelector(class_=tig.SourceSpectrum, default=None, allow_None=True)
    measured = param.Parameter(
        default=(),
        doc="A tuple of trackig_core.levels.MeasuredGain: curves from elsewhere, which demand nothing.",
    )
    title = param.String(default=tig.Study.name, doc="What the study is called.")
    results = param.Parameter(
        default=(), doc="A tuple of DesignResult: the current design, then every pinned one."
    )
    base = param.Parameter(default=None, doc="The DesignResult from which differences are taken.")
    preset = param.Parameter(
        default=None, doc="DesignResult of the preset from which the current design departs, if it does."
    )

    def __init__(self, inputs, outcome, definition, pins, pinned):
        super().__init__()
        self._inputs, self._outcome, self._definition = inputs, outcome, definition
        self._pins, self._pinned = pins, pinned
        outcome.param.watch(self._assess, ["summary", "preset_summary"])
        definition.param.watch(self._assess, ["summation", "reference", "bands"])
        pins.param.watch(self._assess, ["pinned", "base"])
        pinned.param.watch(self._assess, "summaries")
        self.param.watch(self._assess, ["specification", "source"])
        inputs.param.watch(self._assess, list(LOAD))
        self._criteria, self._load = None, None
        self._assess()

    @property
    def in_force(self):
        """The specification by which designs are judged; None without one, or while it asks something."""
        return None if self.specification is None else self.specification.in_force

    @property
    def current(self):
        """The result of the current design; its summary is None as long as it was never solved."""
        return self.results[0]

    @property
    def shown(self):
        """Those that are solved and drawn, a tuple of DesignResult; the current design is the first."""
        return tuple(each for each in self.results if each.shown and each.summary is not None)

    @property
    def shown_pins(self):
        """The pinned ones among :attr:`shown`."""
        return tuple(each for each in self.shown if each.key is not None)

    def _assess(self, *_):
        definition, load = self._definition, self._inputs.to_load()
        chosen = (definition.reference, definition.summation, definition.bands)
        criteria = (*chosen, self.in_force, self.source, load)
        known = {each.key: each for each in self.results} if criteria == self._criteria else {}
        known_preset = self.preset if criteria == self._criteria else None
        self._criteria, self._load = criteria, load
        results = tuple(
            self._result(record, summary, known.get(record.key)) for record, summary in self._designs()
        )
        if len(results) == len(self.results) and all(map(operator.is_, results, self.results)):
            results = self.results
        base = next(each for each in results if each.key == self._pins.base)
        now = {"results": results, "base": base, "preset": self._preset_result(known_preset)}
        self.param.update({name: each for name, each in now.items() if each is not getattr(self, name)})

    def _designs(self):
        """Return each design as a record, and its last good solution or None."""
        summary = self._outcome.summary
        design = self._inputs.to_design() if summary is None else summary.design
        return [
            (current_design(design), summary),
            *((pin, self._pinned.summaries.get(pin.key)) for pin in self._pins.pinned),
        ]

    def _preset_result(self, known):
        summary = self._outcome.preset_summary
        return None if summary is None else self._result(preset_design(summary.design), summary, known)

    def _result(self, record, summary, known):
        """Return the result of a design; what is known of it by the same criteria is used again."""
        if known is not None and known.summary is summary:
            return known if known.pinned == record else dataclasses.replace(known, pinned=record)
        if summary is None:
            return DesignResult(record)
        gain = self._definition.gain(summary.solution)
        deflection = tig.analysis.limited_deflection(self.in_force, record.design)
        return DesignResult(
            pinned=record,
            summary=summary,
            gain=gain,
            gain_shown=self._definition.gain_shown(summary.solution),
            verdict=None if self.in_force is None else self.in_force.check(gain.levels, deflection),
            level=None if self.source is None else self.source.with_track(gain.levels),
            statics=self._load.response(record.design),
        )
