"""The tab in which the track is drawn as the sliders stand, so that a newcomer sees what each of them is.

The drawing follows the sliders, not the solver, and is not drawn while nobody looks.
"""

from dataclasses import replace

import panel as pn
import panel_material_ui as pmui

from dashboard import theme
from dashboard.fields import PHYSICAL
from dashboard.figures.track_drawing import track_svg
from dashboard.views.catalogue import CatalogueView
from dashboard.views.components import PAPER, caption
from dashboard.views.frequencies import Frequencies
from dashboard.views.measured import Measured
from dashboard.views.tab import Tab
from trackig_core.names import LONGEST_NAME, allowed, is_name


class Track(Tab):
    """The drawing, the natural frequencies beside it, and the track's response below.

    Parameters
    ----------
    inputs : DesignInputs
        What is drawn.
    outcome : Outcome
        Whose natural frequencies are shown.
    measuring : Measuring
        Which part's measured curve is shown.
    shelf : Shelf
        The catalogue.
    exchange : Exchange
        Opens tables.
    response : TrackResponseView
        How the track answers a hammer.
    on_look : callable
        Called with whether anybody looks: only then are responses computed.
    """

    title = "Track"
    link_name = "track"

    def __init__(self, inputs, outcome, measuring, shelf, exchange, response, on_look):
        super().__init__()
        self._inputs, self.response, self._on_look = inputs, response, on_look
        self.drawing = pn.pane.HTML(
            "", sizing_mode="stretch_width", stylesheets=[theme.DRAWING_CSS], margin=(0, 12, 8, 12)
        )
        self.frequencies = Frequencies(outcome)
        self.rail_name = pmui.TextInput(
            label="Name of the rail", max_length=LONGEST_NAME, size="small", width=320, margin=(8, 12)
        )
        self.rail_name.param.watch(self._rename_rail, "value")
        self.measured = Measured(inputs, measuring, exchange)
        self.catalogue = CatalogueView(shelf, exchange)
        inputs.param.watch(self._draw, list(PHYSICAL))

    def refresh(self):
        """Draw the track as it stands."""
        self.frequencies.look(self.in_sight)
        self._on_look(self.in_sight)
        self._draw()

    def _draw(self, *_):
        rail = self._inputs.special.get("rail")
        self.rail_name.param.update(
            value="" if rail is None else rail.name,
            visible=rail is not None,
            error_state=False,
            helper_text="",
        )
        if self.in_sight:
            self.drawing.object = track_svg(self._inputs.to_design())

    def _rename_rail(self, event):
        special = self._inputs.special
        if "rail" not in special or event.new == special["rail"].name:
            return
        if is_name(event.new):
            self._inputs.take({"special": {**special, "rail": replace(special["rail"], name=event.new)}})
        else:
            self.rail_name.param.update(error_state=True, helper_text=f"give {allowed()}")

    def fill(self, place):
        """Put the drawing into its place, then the response, what was measured, and the catalogue."""
        place.objects = [self._drawn()]
        yield
        parts = (self.response, self.measured, self.catalogue)
        for part in parts if self.response is not None else parts[1:]:
            made = part.__panel__()
            made.margin = (0, 8, 8, 8)
            place.append(made)
            yield

    def build(self):
        """Return what is put on the page, whole."""
        place = pn.Column(sizing_mode="stretch_width", margin=0)
        for _ in self.fill(place):
            pass
        return place

    def _drawn(self):
        title = caption("The track as the sliders stand", WORDS)
        drawing = pmui.Paper(title, self.drawing, self.rail_name, **PAPER)
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
