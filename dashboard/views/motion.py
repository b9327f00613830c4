"""The subject that shows the track in motion: after the step, and steadily at any one frequency.

The film is that of the design at rest; the steady shape follows the slider, since the
frequency-domain solution takes a millisecond. The server sends what moves once; the browser moves it.
"""

import math

import panel_material_ui as pmui
from bokeh.models import CustomJSTickFormatter

import trackig_core as tig
from dashboard.compute.document import NextTick
from dashboard.figures.axes import BAND_AXIS
from dashboard.figures.learn import PickFigure
from dashboard.figures.motion import FilmPlayer, ShapePlayer
from dashboard.teaching import explanations
from dashboard.views.components import QuickSlider, bokeh_pane, gain_axis, words
from dashboard.views.subjects import Subject, panel_of

STEPS_PER_DECADE = 100
"""Steps of the frequency's slider from a value to its tenfold."""

BELOW = 0.3
"""What "below the resonance" is, over the loaded-track frequency [-]."""

FILM_WORDS = (
    "At time zero the wheel is set 0.1 mm below its place, on a rail at rest. Its contact spring throws it "
    "back, "
    "waves run out along the rail, supports take them up, and what is left is the wheel on its track, dying "
    "away. "
    "Time runs as slowly as you choose; movements are drawn larger than they are, as the bar says. The rail "
    "is drawn at every element of the run; all is low-passed at 600 Hz, as the forces are."
)


class Motion(Subject):
    """Rail, wheel and blocks in motion."""

    title = "Motion"
    at_rest_only = True

    def __init__(self, outcome, definition):
        super().__init__(outcome, definition)
        self.film, self.shape = FilmPlayer(), ShapePlayer()
        self.pick = PickFigure(frequency=100.0)
        self.film_words, self.shape_words = words(), words()
        self.frequency = QuickSlider(
            label="Frequency, Hz",
            start=0,
            end=_position(BAND_AXIS[1]),
            step=1,
            value=_position(100.0),
            format=CustomJSTickFormatter(
                code=f"return (({BAND_AXIS[0]}) * 10 ** (tick / {STEPS_PER_DECADE})).toPrecision(3)"
            ),
            show_value=True,
            tooltips=False,
            size="small",
            sizing_mode="stretch_width",
            margin=(8, 16),
        )
        self.jumps = pmui.Row(
            *(
                pmui.Button(
                    label=label,
                    variant="outlined",
                    size="small",
                    on_click=self._jump(which),
                    margin=(0, 6, 6, 0),
                )
                for label, which in (
                    ("Below resonance", _below),
                    ("Loaded track", lambda natural: natural.loaded_track),
                    ("Coupled block", lambda natural: natural.coupled_block),
                )
            ),
            margin=(0, 14),
        )
        self.pick.cursor.on_change("location", self._picked)
        # the cursor is a model of Bokeh, which may change only when the document may
        self.frequency.param.watch(NextTick(self._follow_slider), "value")
        outcome.param.watch(self._show_shape, "summary")
        definition.param.watch(self._show_shape, ["reference", "summation"])
        self.question.param.watch(self._show_shape, "looked_at")
        self._follow()

    def ask(self, design):
        """Return the question about a design."""
        return tig.film, design

    def show(self, answer):
        """Show a film."""
        self.film.show(answer)
        self.film_words.object = FILM_WORDS

    def _jump(self, which):
        def jump():
            summary = self.outcome.summary
            frequency = None if summary is None else which(summary.solution.natural_frequencies)
            if frequency is not None:
                self.pick.cursor.location = min(max(frequency, BAND_AXIS[0]), BAND_AXIS[1])

        return NextTick(jump)

    def _follow_slider(self):
        # a slider that follows the cursor must not round where it stands
        position = self.frequency.value
        if position != round(_position(self.pick.cursor.location)):
            self.pick.cursor.location = BAND_AXIS[0] * 10 ** (position / STEPS_PER_DECADE)

    def _picked(self, _attribute, _old, frequency):
        self.frequency.value = round(_position(frequency))
        self._show_shape()

    def _show_shape(self, *_):
        summary = self.outcome.summary
        if summary is None or not self.question.looked_at:
            return
        self.pick.name_axis(gain_axis(self.definition, summary.design))
        self.pick.show(level=self.definition.gain(summary.solution).levels)
        shape = tig.steady_shape(summary.design, float(self.pick.cursor.location))
        self.shape.show(shape)
        self.shape_words.object = explanations.shape_words(shape)
        self.jumps[2].disabled = not summary.design.two_stage

    def __panel__(self):
        """Return what is put on the page."""
        return pmui.Column(
            panel_of("After the step", self.problem, bokeh_pane(self.film.model), self.film_words),
            panel_of(
                "Steady vibration at one frequency",
                bokeh_pane(self.pick.model),
                self.frequency,
                self.jumps,
                bokeh_pane(self.shape.model),
                self.shape_words,
                explanation="click or drag on the curve to choose the frequency",
            ),
            sizing_mode="stretch_width",
            margin=0,
        )


def _below(natural):
    return BELOW * natural.loaded_track


def _position(frequency):
    """Return where on its slider a frequency stands [Hz]."""
    return STEPS_PER_DECADE * math.log10(frequency / BAND_AXIS[0])
