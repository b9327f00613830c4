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
from dashboard.views.tab import Tab


class Track(Tab):
    """The drawing, the natural frequencies beside it, and the track's response below.

    Parameters
    ----------
    inputs : DesignInputs
        What is drawn.
    outcome : Outcome
        Whose natural frequencies are shown.
    response : TrackResponseView
        How the track answers a hammer.
    on_look : callable
        Called with whether anybody looks: only then are responses computed.
    """

    title = "Track"
    link_name = "track"

    def __init__(self, inputs, outcome, response, on_look):
        super().__init__()
        self._inputs, self.response, self._on_look = inputs, response, on_look
        self.drawing = pn.pane.HTML(
            "", sizing_mode="stretch_width", stylesheets=[theme.DRAWING_CSS], margin=(0, 12, 8, 12)
        )
        self.frequencies = Frequencies(outcome)
        inputs.param.watch(self._draw, list(PHYSICAL))

    def refresh(self):
        """Draw the track as it stands."""
        self.frequencies.look(self.in_sight)
        self._on_look(self.in_sight)
        self._draw()

    def _draw(self, *_):
        if self.in_sight:
            self.drawing.object = track_svg(self._inputs.to_design())

    def build(self):
        """Return what is put on the page."""
        drawing = pmui.Paper(caption("The track as the sliders stand", WORDS), self.drawing, **PAPER)
        frequencies = pmui.Paper(caption("Natural frequencies", ""), self.frequencies, **PAPER)
        return pmui.Grid(
            pmui.Grid(drawing, size={"xs": 12, "lg": 8}),
            pmui.Grid(frequencies, size={"xs": 12, "lg": 4}),
            pmui.Grid(self.response, size=12),
            container=True,
            spacing=1,
            sizing_mode="stretch_width",
            margin=(0, 8, 8, 8),
        )


WORDS = "stiffer springs are thicker, heavier parts larger"
