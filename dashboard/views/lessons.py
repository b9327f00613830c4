"""The subject of guided lessons: set this, predict, reveal.

Lessons are files (:mod:`dashboard.teaching.lessons`) and taken as hostile: Markdown is rendered with HTML
disabled, all else is escaped. A lesson sets sliders when asked to and never locks one. What is
revealed is computed for the lesson's own two designs, whatever the sliders stand at.
"""

import panel as pn
import panel_material_ui as pmui

import trackig_core as tig
from dashboard import theme
from dashboard.figures.learn import BandsFigure, Curve
from dashboard.teaching.lessons import load_lessons, reveal, set_sliders
from dashboard.views.components import bokeh_pane, gain_axis, put_words, words
from dashboard.views.subjects import Subject, panel_of

NO_HTML = {"html": False}

NONE_CHOSEN = "Choose an answer first: a wrong one teaches more than none."


class Answers(pmui.RadioBoxGroup):
    """Answers of which none is chosen at first; Panel would quietly choose the first when they are drawn."""

    _allows_none = True


class Lessons(Subject):
    """Guided lessons, one at a time.

    Parameters
    ----------
    outcome, presentation
        As for all subjects; a lesson needs neither.
    inputs : DesignInputs
        The sliders that lessons set.
    folder : pathlib.Path, optional
        Where lessons lie.
    """

    title = "Lessons"

    CURVES = (
        Curve("level", "this design", theme.THIS_DESIGN, width=theme.LINE_WIDTH),
        Curve("start", "where the lesson starts", theme.PRESET_GHOST, theme.SECOND_DASH),
    )

    def __init__(self, outcome, definition, inputs, folder=None):
        self.lessons, self.faults = load_lessons() if folder is None else load_lessons(folder)
        super().__init__(outcome, definition)
        self._inputs = inputs
        titles = {f"{number}. {lesson.title}": lesson for number, lesson in enumerate(self.lessons, 1)}
        self.menu = pn.widgets.Select(
            label="Lesson",
            options=titles,
            value=next(iter(titles.values()), None),
            width=420,
            margin=(0, 12),
            stylesheets=[theme.SELECT_CSS],
        )
        self.introduction, self.revealed = _text(), _text()
        self.begin = pmui.Button(label="Set where it starts", variant="outlined", on_click=self._begin)
        self.change = pmui.Button(label="Move the slider for me", variant="outlined", on_click=self._change)
        self.asked = words(weight=500, margin=(6, 14, 0, 14))
        self.answers = Answers(options=["…"], margin=(0, 14))
        self.reveal = pmui.Button(label="Reveal", variant="contained", on_click=self._reveal)
        self.verdict = pmui.Alert(
            object="", severity="info", visible=False, sizing_mode="stretch_width", margin=(4, 14)
        )
        self.broken = pmui.Alert(
            object=_escaped(self.faults),
            severity="warning",
            visible=bool(self.faults),
            sizing_mode="stretch_width",
            margin=(4, 14),
        )
        self.figure = BandsFigure("lesson", self.CURVES)
        self.menu.param.watch(self._open, "value")
        outcome.param.watch(self._draw, "summary")
        definition.param.watch(self._draw, ["reference", "summation"])
        self._open()

    def _follow(self, *_):
        """Ask for nothing when the design changes: a lesson is about its own."""

    def _open(self, *_):
        lesson = self.menu.value
        self.verdict.visible, self.revealed.visible = False, False
        for part in (self.begin, self.change, self.reveal, self.answers):
            part.disabled = lesson is None
        self.reveal.disabled = True  # until there is an answer
        if lesson is None:
            self.question.asked = (_nothing,)
            return
        self.introduction.object = ""
        self.asked.object = plain(lesson.question)
        # a radio's words are plain text, whatever they hold
        self.answers.param.update(options=[choice.text for choice in lesson.choices], value=None)
        self.question.asked = self.ask(lesson)
        if self.question.answered == self.question.asked:  # it was open already
            self._answered()

    def ask(self, lesson):
        """Return the question about a lesson."""
        return _taught, _Key(lesson)

    def _draw(self, *_):
        summary, answer = self.outcome.summary, self.question.answer
        if summary is None or answer is None:
            return
        _, start = answer
        chosen = self.definition
        self.figure.name_axis(gain_axis(chosen, summary.design))
        self.figure.show(level=chosen.gain(summary.solution).levels, start=chosen.gain(start).levels)

    def show(self, answer):
        """Show the introduction; what is revealed waits."""
        self._draw()
        answer, _ = answer
        self.introduction.object = _without_pictures(answer.introduction)
        self.revealed.object = _without_pictures(answer.reveal)
        faults = [*self.faults, *answer.problems]
        put_words(self.broken, _escaped(faults))
        self.reveal.disabled = False

    def _begin(self, _):
        set_sliders(self._inputs, self.menu.value.start)

    def _change(self, _):
        set_sliders(self._inputs, self.menu.value.change)

    def _reveal(self, _):
        answer, lesson, chosen = self.question.answer, self.menu.value, self.answers.value
        if answer is None or self.question.answered != self.question.asked:
            return
        if chosen is None:
            self.verdict.param.update(object=NONE_CHOSEN, severity="info", visible=True)
            return
        revealed, _ = answer
        right = [choice.text for choice, true in zip(lesson.choices, revealed.right, strict=True) if true]
        good = chosen in right
        words = "Right." if good else "Not quite. The solver finds: " + plain("; ".join(right))
        self.verdict.param.update(object=words, severity="success" if good else "warning", visible=True)
        self.revealed.visible = True

    def __panel__(self):
        """Return what is put on the page."""
        return panel_of(
            "Lessons",
            self.broken,
            self.menu,
            self.problem,
            self.introduction,
            pmui.Row(self.begin, self.change, margin=(0, 14)),
            bokeh_pane(self.figure.model),
            self.asked,
            self.answers,
            pmui.Row(self.reveal, margin=(0, 14)),
            self.verdict,
            self.revealed,
            explanation="set this, predict, reveal",
        )


class _Key:
    """A lesson that can be looked up: lessons hold dicts, so they are distinguished by what they say."""

    def __init__(self, lesson):
        self.lesson = lesson

    def __eq__(self, other):
        return isinstance(other, _Key) and self.lesson == other.lesson

    def __hash__(self):
        return hash(self.lesson)


def _taught(key):
    """Return what a lesson reveals, and the exact solution of the design at which it starts."""
    return reveal(key.lesson), tig.solve(key.lesson.designs()[0], "exact")


def _nothing():
    """Answer where there is no lesson to ask about."""


def _text():
    return pn.pane.Markdown(
        "",
        renderer_options=NO_HTML,
        sizing_mode="stretch_width",
        margin=(0, 14),
        stylesheets=[theme.PROSE_CSS],
    )


def _escaped(faults):
    return "\n\n".join(plain(str(fault)) for fault in faults)


def plain(text):
    """Return text that stays as it is where Markdown or HTML is rendered: what could be either is escaped."""
    return "".join(
        letter if letter.isalnum() or letter in " .,;:?%" else f"&#{ord(letter)};" for letter in text
    )


def _without_pictures(markdown):
    """Return Markdown whose pictures are plain text: nothing is fetched from elsewhere."""
    return markdown.replace("![", "!\\[")
