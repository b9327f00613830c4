"""Where the current design complies along each of its numbers, all others held.

One answer for sidebar and tab, whatever tab is open. It is asked for when inputs, definition or specification
change, not when a picture is there: it waits for no solve, and none waits for it.
"""

import math

import param

from dashboard.compute.inquiries import Inquiry, InquiryRunner, question_of
from dashboard.fields import ASKED_FIELDS, FIELDS, PHYSICAL
from dashboard.formats import quantity_text
from trackig_core.decide.numbers import single_numbers

FIGURES = 4
"""To which edges are shown [-]: the library finds them to 0.1 %."""


class Feasibility(Inquiry):
    """Watches a session and keeps the ranges of its current design up to date.

    Parameters
    ----------
    inputs : DesignInputs
        The current design.
    definition : GainDefinition
        Which insertion gain is meant.
    assessment : Assessment
        The specification.
    """

    given = param.Boolean(default=False, doc="Whether numbers of vehicle and site are looked at too.")
    stale = param.Boolean(default=False, doc="Whether the ranges are those of an earlier design.")

    def __init__(self, inputs, definition, assessment):
        super().__init__()
        self._inputs, self._definition, self._assessment = inputs, definition, assessment
        self.runner = InquiryRunner(self)
        self.param.watch(self._note_stale, ["asked", "answered", "problem"])
        inputs.param.watch(self.ask, list(PHYSICAL))
        definition.param.watch(self.ask, ["reference", "summation"])
        assessment.param.watch(self.ask, "specification")
        self.param.watch(self.ask, "given")
        self.ask()

    def ask(self, *_):
        """Ask for the design as it stands; without a specification there is nothing to ask."""
        design, specification = self._inputs.to_design(), self._assessment.in_force
        if specification is not None and specification.rail_deflection_limit is None:
            design = design.without_statics
        settings = {"fields": list(single_numbers(design))} if self.given else {}
        question = question_of("range", settings, self._assessment, self._definition, design=design)
        if question is None:
            self.param.update(asked=None, answered=None, result=None, problem="")
        else:
            self.asked = question

    def _note_stale(self, *_):
        self.stale = self.asked != self.answered

    @property
    def stretches(self):
        """Stretches of compliance by field, for sliders [display units]; none of a design that has none."""
        if self.asked is None or self.result is None or self.problem:
            return {}
        return {name: shown_stretches(self.result, name) for name in self.result if name in FIELDS}


def shown_stretches(result, name):
    """Return where a design complies along a field, edges rounded to what still complies.

    Parameters
    ----------
    result : trackig_core.decide.FeasibleRanges
        The ranges.
    name : str
        The field.

    Returns
    -------
    list of (float, float)
        Lowest and highest value of each stretch [display unit].
    """
    field, (least, greatest) = ASKED_FIELDS[name], result.ranges[name]
    found = []
    for low, high in result[name]:
        begin = field.to_display(low) if low == least else _rounded(low / field.factor, math.ceil)
        end = field.to_display(high) if high == greatest else _rounded(high / field.factor, math.floor)
        # a stretch that is narrower than the last figure stays as it is
        narrow = begin > end
        found.append((field.to_display(low), field.to_display(high)) if narrow else (begin, end))
    return found


def _rounded(value, to_whole):
    """Return a value to so many figures, up or down."""
    step = 10.0 ** (math.floor(math.log10(value)) - FIGURES + 1)
    return float(f"{to_whole(value / step) * step:.{FIGURES}g}")


def where(result, name):
    """Return where a design complies along a field, in words and in the slider's unit.

    Parameters
    ----------
    result : trackig_core.decide.FeasibleRanges
        The ranges.
    name : str
        The field.

    Returns
    -------
    str
        Such as ``"at most 10.85 kN/mm"``, ``"everywhere"`` or ``"nowhere"``.
    """
    if not result[name]:
        return "nowhere"
    least, greatest = result.ranges[name]
    texts, unit = [], ASKED_FIELDS[name].unit
    for (low, high), stretch in zip(result[name], shown_stretches(result, name), strict=True):
        begin, end = (f"{quantity_text(edge)} {unit}".rstrip() for edge in stretch)
        if low == least and high == greatest:
            return "everywhere"
        if low == least:
            texts.append(f"at most {end}")
        elif high == greatest:
            texts.append(f"at least {begin}")
        else:
            texts.append(f"from {begin} to {end}")
    return " or ".join(texts)
