"""The tab in which a track is explored: insertion gain, force over time, natural frequencies, standing load.

All are redrawn together, from the same solution.
"""

import html

import panel as pn
import panel_material_ui as pmui

from dashboard import theme
from dashboard.compute.document import NextTick
from dashboard.figures.force import ForceFigure
from dashboard.figures.insertion_gain import InsertionGainFigure
from dashboard.session.bands import bands_text
from dashboard.session.production import Production
from dashboard.views.components import bokeh_pane, caption, gain_axis, panel, put_words, words
from dashboard.views.frequencies import Frequencies
from dashboard.views.tab import Tab
from dashboard.views.verdict import ShortVerdict


class Explore(Tab):
    """Insertion gain, force and natural frequencies of the current design.

    Parameters
    ----------
    outcome : Outcome
        How the solver fares.
    definition : GainDefinition
        Which insertion gain is shown.
    pins : Pins
        Whether the pinned designs are drawn alone.
    assessment : Assessment
        Results that are drawn, and the specification, which is drawn as a limit.
    production : Production, optional
        Insertion gain of production, which is drawn on request.
    """

    title = "Explore"
    link_name = "explore"

    def __init__(self, outcome, definition, pins, assessment, production=None):
        super().__init__()
        self._outcome, self._definition = outcome, definition
        self._production = Production() if production is None else production
        self._pins, self._assessment = pins, assessment
        self._drawn = None
        self.insertion_gain = InsertionGainFigure()
        self.force = ForceFigure()
        self.frequencies = Frequencies(outcome, assessment)
        self.verdict = ShortVerdict(assessment)
        self.panes = [bokeh_pane(each.layout) for each in (self.insertion_gain, self.force)]
        self.fidelity = pmui.Chip(
            label="", size="small", variant="outlined", visible=False, margin=(7, 0, 0, 10)
        )
        self.show_current = pmui.Button(
            label="Show this design",
            icon="visibility",
            size="small",
            variant="outlined",
            visible=pins.param.alone,
            on_click=lambda _: pins.param.update(alone=False),
            margin=(0, 12, 0, 0),
        )
        self.reference_words = words(size=14, visible=False, margin=(0, 14, 4, 14))
        self.bands_words = words(size=14, visible=False, margin=(0, 14, 4, 14))
        self.choices = [
            pn.widgets.Select.from_param(
                definition.param[name], width=width, margin=(0, 0, 4, 12), stylesheets=[theme.SELECT_CSS]
            )
            for name, width in CHOICE_WIDTHS.items()
        ]
        self.choices[0].styles = {"margin-left": "auto"}
        outcome.param.watch(self._dim, ["problem", "progress", "summary"])
        show = NextTick(self._show)
        # results follow the definition and the specification too
        assessment.param.watch(show, ["results", "preset", "measured"])
        pins.param.watch(show, "alone")
        self._production.param.watch(show, ["wanted", "computed"])
        self._show()
        self._dim()

    def _show(self):
        results = self._assessment.results
        self.insertion_gain.name_axis(gain_axis(self._definition, self._assessment.current.design))
        self._say_reference()
        words = bands_text(self._definition.bands)
        put_words(self.bands_words, f"{words[:1].upper()}{words[1:]}." if words else "")
        if self._assessment.current.summary is None:
            return
        if results is not self._drawn:
            self._drawn = results
            self._show_forces()
        self._show_gain()

    def _say_reference(self):
        """Say where another reference than the chosen one is in force, and why."""
        designs = {each.name: each.design for each in self._assessment.results if each.shown}
        wanted = self._definition.reference
        yielding = [name for name, each in designs.items() if self._definition.reference_of(each) != wanted]
        words = f"{html.escape(', '.join(yielding))}: {YIELDING_WORDS}" if yielding else ""
        put_words(self.reference_words, words)

    def _show_forces(self):
        current = self._assessment.current
        if current.summary.time is not None:  # an exact curve leaves the last force as it is, dimmed
            self.force.show(current, self._assessment.shown_pins)
        # one by one: all at once, param would look through all that a chip has
        self.fidelity.label, self.fidelity.variant = FIDELITY_CHIPS[current.summary.solution.fidelity]
        self.fidelity.visible = True

    def _show_gain(self):
        specification = self._assessment.in_force
        self.insertion_gain.show(
            self._assessment.current,
            self._assessment.shown_pins,
            preset=self._assessment.preset,
            limit=None if specification is None else specification.levels,
            alone=self._pins.alone,
            measured=self._assessment.measured,
            production=self._production.band(self._assessment.current.design, self._definition),
        )

    def _dim(self, *_):
        summary, stale = self._outcome.summary, self._outcome.stale
        without_force = summary is not None and summary.time is None
        for pane in (*self.panes, self.frequencies.pane):
            is_old = stale or (without_force and pane is self.panes[1])
            pane.styles = theme.STALE if is_old else theme.FRESH

    def build(self):
        """Return what is put on the page, whole."""
        place = pn.Column(sizing_mode="stretch_width", margin=0)
        for _ in self.fill(place):
            pass
        return place

    def fill(self, place):
        """Put the view into its place, a panel at a time."""
        gain, force, frequencies = (panel() for _ in range(3))
        gain.margin = (0, 8, 8, 8)
        place.objects = [
            gain,
            pn.Column(
                force,
                frequencies,
                stylesheets=[theme.BESIDE_CSS],
                sizing_mode="stretch_width",
                margin=(0, 8, 8, 8),
            ),
        ]
        yield
        gain_pane, force_pane = self.panes
        gain.objects = [
            pn.FlexBox(
                caption(GAIN_TITLE, ""),
                self.fidelity,
                *self.choices,
                sizing_mode="stretch_width",
            ),
            pn.Row(
                pn.pane.HTML(
                    f"<p>{GAIN_WORDS}</p>",
                    stylesheets=[theme.CAPTION_CSS],
                    sizing_mode="stretch_width",
                    margin=(0, 12, 4, 12),
                ),
                self.show_current,
                sizing_mode="stretch_width",
                margin=0,
            ),
            self.reference_words,
            self.bands_words,
            self.verdict,
        ]
        yield
        gain.append(gain_pane)
        yield
        frequencies.objects = [caption("Natural frequencies and standing load", ""), self.frequencies]
        force.objects = [caption(FORCE_TITLE, FORCE_WORDS), force_pane]
        yield


FIDELITY_CHIPS = {
    "live": ("live run", "filled"),
    "exact": ("exact curve", "filled"),
    "paper": ("paper's run", "outlined"),
}
"""What the chip beside the title says of each fidelity, and how it looks."""

YIELDING_WORDS = (
    "against a very stiff track on the same ground. Where the ground yields, neither line nor rigid track is "
    "a reference: the ground's own amplification would count as the track's."
)

GAIN_TITLE = "Insertion gain"
GAIN_WORDS = (
    "Above 0 dB the track amplifies, below it isolates. Summed energy counts waves running along the rail, "
    "coherent force lets them cancel; it matters above resonance."
)

CHOICE_WIDTHS = {"bands": 270, "summation": 205, "reference": 240}
"""Each as wide as the words of its longest option [px]; the first has room beside the heading everywhere."""

FORCE_TITLE = "Force into the ground"
FORCE_WORDS = "after a step of 0.1 mm between wheel and rail"
