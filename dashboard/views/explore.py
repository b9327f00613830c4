"""The tab in which a track is explored: insertion gain, force over time, natural frequencies.

The one rule: all three are redrawn together, from the same picture.
"""

import panel as pn
import panel_material_ui as pmui
from panel.viewable import Viewer

from dashboard import style
from dashboard.figures import ForceFigure, InsertionGainFigure
from dashboard.views.frequencies import Frequencies


class Explore(Viewer):
    """Insertion gain, force and natural frequencies of the design at hand.

    Parameters
    ----------
    outcome : Outcome
        Whose picture is shown.
    """

    title = "Explore"

    def __init__(self, outcome):
        super().__init__()
        self._outcome = outcome
        self.insertion_gain = InsertionGainFigure()
        self.force = ForceFigure()
        self.frequencies = Frequencies(outcome)
        outcome.param.watch(self._show, ["picture", "preset_picture"])
        self._show()

    def _show(self, *_):
        picture = self._outcome.picture
        if picture is None:
            return
        self.insertion_gain.show(picture, self._outcome.preset_picture)
        self.force.show(picture)

    def __panel__(self):
        """Return what is put on the page."""
        return pmui.Grid(
            pmui.Grid(panel(GAIN_TITLE, GAIN_WORDS, self.insertion_gain.model), size=12),
            pmui.Grid(panel(FORCE_TITLE, FORCE_WORDS, self.force.model), size=WIDE),
            pmui.Grid(
                pmui.Paper(
                    caption("Natural frequencies", ""),
                    self.frequencies,
                    elevation=0,
                    sizing_mode="stretch_width",
                    margin=0,
                    sx=style.PANEL,
                ),
                size=NARROW,
            ),
            container=True,
            spacing=1,
            sizing_mode="stretch_width",
            margin=(0, 8, 8, 8),
        )


WIDE, NARROW = {"xs": 12, "lg": 7}, {"xs": 12, "lg": 5}

GAIN_TITLE = "Insertion gain"
GAIN_WORDS = "above 0 dB the track amplifies, below it isolates"

FORCE_TITLE = "Force into the ground"
FORCE_WORDS = "after a step of 0.1 mm between wheel and rail"


def caption(title, words):
    """Return a panel's heading."""
    return pmui.Row(
        pmui.Typography(title, variant="subtitle1", sx=style.PANEL_TITLE, margin=0),
        pmui.Typography(words, variant="body2", color="text.secondary", margin=(3, 0, 0, 10)),
        margin=(4, 0, 0, 12),
    )


def panel(title, words, model):
    """Return a figure under its heading."""
    return pmui.Paper(
        caption(title, words),
        pn.pane.Bokeh(model, sizing_mode="stretch_width", margin=0),
        elevation=0,
        sizing_mode="stretch_width",
        margin=0,
        sx=style.PANEL,
    )
