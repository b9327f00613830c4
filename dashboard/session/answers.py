"""Answers that are kept: part of the study and of the report, each with what the report shows of it."""

import param

from dashboard.fields import ASKED_FIELDS
from dashboard.formats import definition_text, quantity_text
from dashboard.session.special import curve_text
from trackig_core.bands import BAND_LABELS
from trackig_core.levels.specification import not_judged_text
from trackig_core.track.design import measured_curves

MOST_KEPT = 20
"""Answers that a session keeps [-]: a page of the report each."""

TITLES = {
    "range": "How far may each number go?",
    "sensitivity": "What matters?",
    "sobol": "What matters over the tolerances?",
    "tolerance": "How sure is it to comply?",
    "map": "Which designs comply over two numbers?",
    "find": "Which designs comply?",
}
"""What each kind of question is called."""


FIGURE_WORDS = {
    "margin": ("Governing margin, dB", 1.0),
    "level": ("Received level, dB(A)", 1.0),
    "deflection": ("Rail deflection, mm", 1e3),
    "loaded_track": ("Loaded-track frequency, Hz", 1.0),
    "coupled_block": ("Coupled-block frequency, Hz", 1.0),
    "cost": ("Cost", 1.0),
}
"""What figures are called, with the unit in which they are shown, and what turns them into it."""


BETTER = {"margin": "high", "level": "low", "deflection": "low", "cost": "low"} | dict.fromkeys(
    BAND_LABELS, "low"
)
"""Which end of a figure is the good one; frequencies have none."""


def scale_title(name, words):
    """Return what stands at the colours of a map: what is drawn, and which end is the good one.

    Parameters
    ----------
    name : str
        Name of the figure; the bright end of its colours is the good one.
    words : str
        What it is called, with its unit.
    """
    good = f"{BETTER[name]}, bright: better" if name in BETTER else "neither end is better"
    return f"{words}\n{good}"


class KeepError(ValueError):
    """An answer cannot be kept; the message says why, and what to do."""


class Answers(param.Parameterized):
    """The answers that are kept, in the order in which they were."""

    kept = param.Parameter(default=(), doc="A tuple of trackig_core.decide.Answer.")

    def __init__(self):
        super().__init__()
        self._pages = {}

    @property
    def pages(self):
        """What the report shows of each answer by its digest; of one opened and not asked, nothing."""
        digests = {each.digest for each in self.kept}
        return {digest: page for digest, page in self._pages.items() if digest in digests}

    def keep(self, answer, page):
        """Keep an answer; one to the same question gives way to it.

        Parameters
        ----------
        answer : trackig_core.decide.Answer
            The answer.
        page : object
            What the report shows of it.

        Raises
        ------
        KeepError
            If as many are kept as can be.
        """
        others = tuple(each for each in self.kept if each.question != answer.question)
        if len(others) >= MOST_KEPT:
            raise KeepError(f"{MOST_KEPT} answers are kept, and no more can be: remove one first.")
        self._pages = {**self.pages, answer.digest: page}
        self.kept = (*others, answer)

    def note_page(self, answer, page):
        """Note what the report shows of an answer that was asked again."""
        self._pages = {**self.pages, answer.digest: page}

    def remove(self, answer):
        """Keep an answer no longer."""
        self.kept = tuple(each for each in self.kept if each is not answer)

    def replace_all(self, answers):
        """Put the answers of a study in the place of all."""
        self.kept = tuple(answers)


def question_lines(answer):
    """Return the title of an answer, and what was asked, a line of words each (str, list of str)."""
    question = answer.question
    design = question.design
    numbers = [
        f"{field.label.lower()} {with_unit(name, design.value(name), 6)}"
        for name, field in ASKED_FIELDS.items()
        if isinstance(design.value(name), float)
    ]
    numbers += [f"{field_label(name)} {curve_text(curve)}" for name, curve in measured_curves(design).items()]
    lines = [f"Asked of: {', '.join(numbers)}, rail {design.rail.name}."]
    if question.specification is not None:
        rest = not_judged_text(question.specification.not_judged)
        lines.append(f"Held against: {'; '.join(filter(None, (question.specification.name, rest)))}.")
    lines.append(f"Insertion gain: {definition_text(question.summation, question.reference)}.")
    lines += [f"{text[0].upper()}{text[1:]}." for text in settings_texts(question)]
    return TITLES[question.kind], lines


def settings_texts(question):
    """Return the settings of a question, a line of words each, in the units of the sliders (list of str)."""
    return [
        f"{_NAMES.get(name, name.replace('_', ' '))}: {_WORDS.get(name, _plain)(value)}"
        for name, value in question.settings.items()
    ]


def field_label(name):
    """Return what a field is called in the middle of a sentence."""
    return ASKED_FIELDS[name].marked.lower() if name in ASKED_FIELDS else name.replace("_", " ")


def with_unit(name, value, figures=4):
    """Return a value [SI] of a field in the slider's unit, with it."""
    field = ASKED_FIELDS.get(name)
    if field is None:
        return quantity_text(value)
    return f"{value / field.factor:.{figures}g} {field.unit}".rstrip()


def _plain(value):
    if isinstance(value, dict):
        return "; ".join(f"{field_label(key)} {_plain(each)}" for key, each in value.items())
    if isinstance(value, list | tuple):
        return ", ".join(_plain(each) for each in value)
    return field_label(value) if isinstance(value, str) else quantity_text(value)


def _changes(changes):
    if not isinstance(changes, dict):
        return f"± {100 * changes:.3g} %"
    return "; ".join(f"{field_label(name)} ± {100 * share:.3g} %" for name, share in changes.items())


def _tolerances(tolerances):
    return "; ".join(f"{field_label(name)} {_tolerance(given)}" for name, given in tolerances.items())


def _tolerance(given):
    if not isinstance(given, dict):
        return f"± {100 * given:.3g} %"
    ((kind, share),) = given.items()
    return f"± {100 * share:.3g} %" if kind == "uniform" else f"with a deviation of {100 * share:.3g} %"


def _production(table):
    rows = len(next(iter(table.values()), ()))
    return f"{rows} specimens, of which {' and '.join(map(field_label, table))} were measured"


def _ranges(ranges):
    if not isinstance(ranges, dict):
        return _plain(ranges)
    return "; ".join(
        f"{field_label(name)} {with_unit(name, low)} to {with_unit(name, high)}"
        for name, (low, high) in ranges.items()
    )


def _choices(choices):
    return "; ".join(f"{field_label(name)} of {len(values)}" for name, values in choices.items())


def _deflection(limit):
    return f"{1e3 * limit:.3g} mm"


_NAMES = {"x_field": "across", "y_field": "up", "max_deflection": "rail sinks at most"}
"""What settings are called where people choose them, if not as the library has them."""


_WORDS = {
    "max_deflection": _deflection,
    "changes": _changes,
    "tolerances": _tolerances,
    "production": _production,
    "ranges": _ranges,
    "free": _ranges,
    "choices": _choices,
}
"""How settings are put into words that hold more than names and numbers."""
