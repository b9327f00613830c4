"""The tab in which the track is drawn as the sliders stand, so that a newcomer sees what each of them is.

The drawing follows the sliders, not the solver, and is not drawn while nobody looks.
"""

import panel as pn
import panel_material_ui as pmui

from dashboard import theme
from dashboard.fields import PHYSICAL
from dashboard.figures.track_drawing import track_svg
from dashboard.views.components import PAPER, caption
from dashboard.views.frequencies import Frequencies
from dashboard.views.measured import Measured
from dashboard.views.tab import Tab


class Track(Tab):
    """The drawing, and the natural frequencies beside it.

    Parameters
    ----------
    inputs : DesignInputs
        What is drawn.
    outcome : Outcome
        Whose natural frequencies are shown.
    measuring : Measuring
        Which part's measured curve is shown.
    exchange : Exchange
        Opens tables.
    """

    title = "Track"
    link_name = "track"

    def __init__(self, inputs, outcome, measuring, exchange):
        super().__init__()
        self._inputs = inputs
        self.drawing = pn.pane.HTML(
            "", sizing_mode="stretch_width", stylesheets=[theme.DRAWING_CSS], margin=(0, 12, 8, 12)
        )
        self.frequencies = Frequencies(outcome)
        self.measured = Measured(inputs, measuring, exchange)
        inputs.param.watch(self._draw, list(PHYSICAL))

    def refresh(self):
        """Draw the track as it stands."""
        self.frequencies.look(self.in_sight)
        self._draw()

    def _draw(self, *_):
        if self.in_sight:
            self.drawing.object = track_svg(self._inputs.to_design())

    def fill(self, place):
        """Put the drawing into its place, then what was measured."""
        place.objects = [self._drawn()]
        yield
        measured = self.measured.__panel__()
        measured.margin = (0, 8, 8, 8)
        place.append(measured)
        yield

    def build(self):
        """Return what is put on the page, whole."""
        place = pn.Column(sizing_mode="stretch_width", margin=0)
        for _ in self.fill(place):
            pass
        return place

    def _drawn(self):
        drawing = pmui.Paper(caption("The track as the sliders stand", WORDS), self.drawing, **PAPER)
        frequencies = pmui.Paper(caption("Natural frequencies", ""), self.frequencies, **PAPER)
        return pmui.Grid(
            pmui.Grid(drawing, size={"xs": 12, "lg": 8}),
            pmui.Grid(frequencies, size={"xs": 12, "lg": 4}),
            container=True,
            spacing=1,
            sizing_mode="stretch_width",
            margin=(0, 8, 8, 8),
        )


WORDS = "stiffer springs are thicker, heavier parts larger"
