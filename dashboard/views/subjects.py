"""The subjects of the *Learn* tab that explain the curves: resonances, slopes, damping, definitions, ladder.

Each asks a question of :mod:`dashboard.teaching.explanations` about the current design, and draws the
answer; it computes nothing itself.
"""

import panel as pn
import panel_material_ui as pmui
from panel.viewable import Viewer

import trackig_core as tig
from dashboard import theme
from dashboard.compute.questions import Question, QuestionRunner
from dashboard.fields import NUMBERS, OPENING_PRESET, to_display
from dashboard.figures.learn import (
    BandsFigure,
    Curve,
    LumpedVsBeamFigure,
    SlopesFigure,
    StiffReferenceFigure,
    SweepFigure,
)
from dashboard.figures.verification import DampingFigure
from dashboard.session.inputs import DesignInputs
from dashboard.teaching import explanations
from dashboard.views.components import PAPER, bokeh_pane, caption, gain_axis, put_words, words

HALF = {"xs": 12, "lg": 6}

OPENING_FIELD = "boot_stiffness"
"""The slider against which resonances are drawn at first."""


class Subject(Viewer):
    """What all subjects share: a question about the current design, answered while it is looked at.

    Parameters
    ----------
    outcome : Outcome
        Whose design is asked about.
    definition : GainDefinition
        Which insertion gain is shown.

    Attributes
    ----------
    title : str
        What the menu calls it.
    question : Question
        What is asked.
    """

    title = ""
    at_rest_only = False

    def __init__(self, outcome, definition):
        super().__init__()
        self.outcome, self.definition = outcome, definition
        self.question = Question()
        QuestionRunner(self.question)
        self.problem = pmui.Alert(
            object="", severity="warning", visible=False, sizing_mode="stretch_width", margin=(4, 8)
        )
        self.question.param.watch(self._complain, "problem")
        self.question.param.watch(self._answered, "answer")
        outcome.param.watch(self._follow, ["summary", "asked"])
        definition.param.watch(self._follow, ["reference", "summation"])

    def _follow(self, *_):
        summary = self.outcome.summary
        if summary is None or (self.at_rest_only and not self._is_at_rest(summary)):
            return
        self.question.asked = self.ask(summary.solution.design)

    def _is_at_rest(self, summary):
        """Return whether a picture is the last one of its inputs, or will be for long."""
        return summary.solution.fidelity == "paper" or summary.design == self.outcome.asked

    def _complain(self, *_):
        put_words(self.problem, self.question.problem)

    def _answered(self, *_):
        if self.question.answer is not None:
            self.show(self.question.answer)

    def ask(self, design):
        """Return the question about a design: a function and its arguments."""
        raise NotImplementedError

    def show(self, answer):
        """Draw an answer."""
        raise NotImplementedError

    def gain_arguments(self, design):
        """Return which insertion gain is shown of a design, as arguments of an explanation."""
        return self.definition.reference_of(design), self.definition.summation


def say(text, sentences):
    """Let a text say some sentences, which are made from numbers and this program's own words."""
    text.object = "<br><br>".join(sentences)


def panel_of(title, *parts, explanation=""):
    """Return parts under a heading, as one panel of the page."""
    return pmui.Paper(caption(title, explanation), *parts, **PAPER)


def pair(left, right):
    """Return two parts side by side, one above the other where the window is narrow."""
    return pmui.Grid(
        pmui.Grid(left, size=HALF),
        pmui.Grid(right, size=HALF),
        container=True,
        sizing_mode="stretch_width",
    )


class Resonances(Subject):
    """Natural frequencies against any slider, the current design as a point that moves along."""

    title = "Resonances"

    def __init__(self, outcome, definition):
        super().__init__(outcome, definition)
        self.figure, self.words = SweepFigure(), words()
        self.field = pn.widgets.Select(
            label="Against",
            options=_fields(tig.PRESETS[OPENING_PRESET]),
            value=OPENING_FIELD,
            width=260,
            margin=(0, 12, 0, 12),
            stylesheets=[theme.SELECT_CSS],
        )
        self.field.param.watch(self._follow, "value")
        outcome.param.watch(self._point, "summary")
        self._follow()

    def ask(self, design):
        """Return the question about a design."""
        fields = _fields(design)
        chosen = self.field.value if self.field.value in fields.values() else next(iter(fields.values()))
        self.field.param.update(options=fields, value=chosen)
        return explanations.resonances, design, chosen

    def show(self, answer):
        """Draw a sweep."""
        self.figure.show(DesignInputs.param[answer.sweep.field].label, answer.values, answer.sweep)
        say(self.words, answer.words)
        self._point()

    def _point(self, *_):
        summary, answer = self.outcome.summary, self.question.answer
        if summary is None or answer is None:
            return
        name, natural = answer.sweep.field, summary.solution.natural_frequencies
        if not isinstance(getattr(summary.design, name), float):
            return
        both = (natural.loaded_track, natural.coupled_block)
        self.figure.point(
            to_display(name, getattr(summary.design, name)), [each for each in both if each is not None]
        )

    def __panel__(self):
        """Return what is put on the page."""
        return panel_of(
            "Where the resonances come from",
            self.field,
            self.problem,
            bokeh_pane(self.figure.model),
            self.words,
        )


def _fields(design):
    """Return the fields of a design that are numbers, by label: neither missing nor measured."""
    numbers = (name for name in NUMBERS if isinstance(getattr(design, name), float))
    return {DesignInputs.param[name].label: name for name in numbers}


class Slopes(Subject):
    """Insertion gain with the asymptotes of the lumped model on demand, and measured slopes beside."""

    title = "Slopes"

    def __init__(self, outcome, definition):
        super().__init__(outcome, definition)
        self.figure, self.words = SlopesFigure(), words()
        self.toggle = pmui.Switch(label="Draw the asymptotes", value=True, margin=(0, 12))
        self.toggle.param.watch(lambda event: self.figure.show_asymptotes(event.new), "value")
        self.table = pn.pane.HTML("", stylesheets=[theme.SLOPES_CSS], margin=(0, 14))
        self._follow()

    def ask(self, design):
        """Return the question about a design."""
        return explanations.slopes, design, *self.gain_arguments(design)

    def show(self, answer):
        """Draw curves and asymptotes."""
        self.figure.name_axis(gain_axis(self.definition, self.outcome.summary.design))
        levels = {"level": answer.levels}
        if answer.one_stage_levels is not None:
            levels["one_stage"] = answer.one_stage_levels
        ends = [line.level[1] for line in (*answer.asymptotes, *answer.one_stage_asymptotes)]
        self.figure.show(also=ends, **levels)
        self.figure.draw_asymptotes(answer.asymptotes, answer.one_stage_asymptotes)
        self.table.object = slopes_html(answer.measured)
        say(self.words, answer.words)

    def __panel__(self):
        """Return what is put on the page."""
        return panel_of(
            "Slopes",
            self.toggle,
            self.problem,
            bokeh_pane(self.figure.model),
            self.table,
            self.words,
            explanation="the lumped model's straight asymptotes, dotted; the beam's insertion gain, solid",
        )


SLOPE_HEADINGS = ("At", "Asymptote", "Damped lumped model", "Beam")


def slopes_html(measured):
    """Return measured slopes as a table, made of numbers and of this module's own words."""
    head = "".join(f'<th scope="col">{words}</th>' for words in SLOPE_HEADINGS)
    rows = "".join(
        "<tr>" + "".join(f"<td>{text}</td>" for text in row) + "</tr>"
        for row in explanations.slope_rows(measured)
    )
    caption_text = "Slopes of this design, dB per octave"
    return (
        f"<table><caption>{caption_text}</caption><thead><tr>{head}</tr></thead><tbody>{rows}</tbody></table>"
    )


class Damping(Subject):
    """Stiffness and loss factor over frequency, and insertion gain at three loss factors."""

    title = "Damping"

    CURVES = tuple(
        Curve(f"loss_{number}", f"loss factor {factor:g}", colour, dash)
        for number, (factor, colour, dash) in enumerate(
            zip(
                tig.LOSS_FACTORS,
                (theme.LOADED_TRACK, theme.THIS_DESIGN, theme.COUPLED_BLOCK),
                ("solid", [7, 3], [2, 3]),
                strict=True,
            )
        )
    )

    def __init__(self, outcome, definition):
        super().__init__(outcome, definition)
        self.stiffness = DampingFigure("taught_stiffness", "Stiffness over that at 50 Hz")
        self.loss_factor = DampingFigure("taught_loss_factor", "Loss factor")
        self.gain = BandsFigure("gain_by_loss", self.CURVES)
        self.words = words()
        self._follow()

    def ask(self, design):
        """Return the question about a design."""
        return explanations.damping, design, *self.gain_arguments(design)

    def show(self, answer):
        """Draw the laws and what they do."""
        curves = {"pad": answer.pad, "boot": answer.boot}
        for figure, of in ((self.stiffness, "stiffness"), (self.loss_factor, "loss_factor")):
            drawn = dict.fromkeys(("pad", "boot", "pad_stated", "boot_stated"), explanations.NOT_THERE)
            drawn |= {part: getattr(curve, of) for part, curve in curves.items() if curve is not None}
            figure.show(explanations.DAMPED, **drawn)
        self.gain.name_axis(gain_axis(self.definition, self.outcome.summary.design))
        self.gain.show(**{curve.column: row for curve, row in zip(self.CURVES, answer.levels, strict=True)})
        say(self.words, answer.words)

    def __panel__(self):
        """Return what is put on the page."""
        return panel_of(
            "Damping",
            self.problem,
            pair(bokeh_pane(self.stiffness.model), bokeh_pane(self.loss_factor.model)),
            bokeh_pane(self.gain.model),
            self.words,
            explanation="below: pads and boots alike at three loss factors, all else as it is",
        )


class Definitions(Subject):
    """The same track by four definitions, and the false peak of a very stiff reference."""

    title = "Definitions"

    FOUR = (
        Curve("energy_line", "energy sum, reference line (paper)", theme.THIS_DESIGN, width=3),
        Curve("energy_rigid", "energy sum, rigid reference", theme.THIS_DESIGN, [7, 3]),
        Curve("coherent_line", "coherent sum, reference line", theme.LOADED_TRACK),
        Curve("coherent_rigid", "coherent sum, rigid reference", theme.THEORY, [7, 3]),
    )
    AGAINST = (
        Curve("rigid", "rigid reference", theme.THIS_DESIGN, width=3),
        Curve("stiffened", "very stiff, contact stiffened too", theme.COUPLED_BLOCK, [7, 3]),
        Curve("real", "very stiff, contact spring as it is", theme.SPECIFICATION, [7, 3]),
    )

    def __init__(self, outcome, definition):
        super().__init__(outcome, definition)
        self.four = BandsFigure("definitions", self.FOUR)
        self.references = StiffReferenceFigure()
        self.against = BandsFigure("against_stiff", self.AGAINST, "IG, dB (energy)")
        self.words, self.stiff_words = words(), words()
        self._follow()

    def ask(self, design):
        """Return the question about a design."""
        return explanations.definitions, design

    def show(self, answer):
        """Draw four definitions, and very stiff references."""
        self.four.show(**answer.levels)
        self.references.show(answer.stiff)
        stiff = answer.stiff
        self.against.show(rigid=stiff.gain_rigid, stiffened=stiff.gain_stiffened, real=stiff.gain_real)
        say(self.words, answer.words)
        say(self.stiff_words, answer.stiff_words)

    def __panel__(self):
        """Return what is put on the page."""
        return pmui.Column(
            panel_of("One track, four figures", self.problem, bokeh_pane(self.four.model), self.words),
            panel_of(
                "The false peak of a very stiff track",
                pair(bokeh_pane(self.references.model), bokeh_pane(self.against.model)),
                self.stiff_words,
            ),
            sizing_mode="stretch_width",
            margin=0,
        )


class LumpedVsBeam(Subject):
    """The lumped model beside the beam, and where it is good enough."""

    title = "Lumped vs beam"

    def __init__(self, outcome, definition):
        super().__init__(outcome, definition)
        self.figure, self.words = LumpedVsBeamFigure(), words()
        self._follow()

    def ask(self, design):
        """Return the question about a design."""
        return explanations.lumped_vs_beam, design, *self.gain_arguments(design)

    def show(self, answer):
        """Draw both, and shade where they agree."""
        self.figure.name_axis(gain_axis(self.definition, self.outcome.summary.design))
        self.figure.show_comparison(answer.comparison)
        say(self.words, answer.words)

    def __panel__(self):
        """Return what is put on the page."""
        return panel_of(
            "The ladder of simplification",
            self.problem,
            bokeh_pane(self.figure.model),
            self.words,
            explanation="two masses on springs, beside the rail as a beam",
        )
