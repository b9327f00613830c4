"""The pinned designs as a list in which they are named, recoloured, shown, put back and removed.

A row lives as long as its pin, so that nobody loses the focus while typing a name.
"""

import panel as pn
import panel_material_ui as pmui
from panel.viewable import Viewer

from dashboard import theme
from dashboard.client.exchange import notify
from dashboard.figures.swatches import swatch_svg
from dashboard.session.inputs import values_of
from dashboard.session.pins import PinError
from dashboard.views.components import words
from trackig_core.names import LONGEST_NAME

COLOURS = {name: number for number, name in enumerate(theme.DESIGN_COLOUR_NAMES)}


class PinRow(Viewer):
    """One pinned design.

    Parameters
    ----------
    inputs : DesignInputs
        Where its values are put back.
    pins : Pins
        What it changes.
    key : int
        Which pin it is.
    """

    def __init__(self, inputs, pins, key):
        super().__init__()
        self._inputs, self._pins, self._key = inputs, pins, key
        self.swatch = pn.pane.HTML("", width=36, margin=(18, 4, 0, 4), stylesheets=[theme.SWATCH_CSS])
        self.name_box = pmui.TextInput(
            label="Name of the design",
            max_length=LONGEST_NAME,
            size="small",
            variant="outlined",
            sizing_mode="stretch_width",
            styles=GROWS,
            min_width=120,
            sx=theme.HIDDEN_LABEL | theme.WHOLE_NAME,
            margin=(9, 4, 0, 0),
        )
        self.colour = pn.widgets.Select(
            label="Colour",
            options=COLOURS,
            width=116,
            margin=(0, 4, 0, 4),
            stylesheets=[theme.SELECT_CSS],
        )
        self.shown = pmui.Checkbox(label="Show", margin=(7, 4, 0, 4), size="small")
        self.use = pmui.Button(label="Use", on_click=self._use, **BUTTON)
        self.remove = pmui.Button(label="Remove", on_click=lambda _: pins.remove(key), **BUTTON)
        self.show(pins[key])
        self.name_box.param.watch(self._rename, "value")
        self.colour.param.watch(self._recolour, "value")
        self.shown.param.watch(self._show_or_hide, "value")
        self._row = pmui.Row(
            pmui.Row(self.swatch, self.name_box, styles=GROWS | {"max-width": "100%"}, margin=0),
            pmui.Row(
                self.colour, self.shown, self.use, self.remove, styles={"margin-left": "auto"}, margin=0
            ),
            sizing_mode="stretch_width",
            # what stands beside a long name makes way for it
            sx={"flexWrap": "wrap"},
            margin=(0, 8, 0, 8),
        )

    def show(self, pin):
        """Show the pin as it stands."""
        self.swatch.object = swatch_svg(*theme.look(pin.colour))
        self.name_box.param.update(value=pin.name, error_state=False, helper_text="")
        self.colour.value, self.shown.value = pin.colour, pin.shown

    def _rename(self, event):
        if event.new == self._pins[self._key].name:
            return
        try:
            self._pins.rename(self._key, event.new)
        except PinError as problem:
            self.name_box.param.update(error_state=True, helper_text="not taken")
            notify("warning", str(problem))

    def _recolour(self, event):
        if event.new != self._pins[self._key].colour:
            self._pins.recolour(self._key, event.new)

    def _show_or_hide(self, event):
        if event.new != self._pins[self._key].shown:
            self._pins.show(self._key, event.new)

    def _use(self, _):
        pin = self._pins[self._key]
        self._inputs.take(values_of(pin.design, pin.preset))

    def __panel__(self):
        """Return what is put on the page."""
        return self._row


GROWS = {"flex": "1 1 max-content", "width": "auto"}
"""What is as wide as its words, and takes what room is left."""

BUTTON = {"size": "small", "variant": "text", "margin": (7, 2, 0, 2)}


class PinList(Viewer):
    """All pinned designs, one a row.

    Parameters
    ----------
    inputs : DesignInputs
        Where values are put back.
    pins : Pins
        What is listed.
    """

    def __init__(self, inputs, pins):
        super().__init__()
        self._inputs, self._pins = inputs, pins
        self.rows = {}
        self.nothing = words(NOTHING_YET, margin=(4, 12))
        self._column = pmui.Column(sizing_mode="stretch_width", margin=(0, 0, 6, 0))
        pins.param.watch(self._show, "pinned")
        self._show()

    def _show(self, *_):
        pinned = self._pins.pinned
        there = {pin.key: self.rows.get(pin.key) for pin in pinned}
        changed = list(there) != list(self.rows) or not self._column.objects
        self.rows = {
            key: PinRow(self._inputs, self._pins, key) if row is None else row for key, row in there.items()
        }
        for pin in pinned:
            self.rows[pin.key].show(pin)
        if changed:
            self._column.objects = [row.__panel__() for row in self.rows.values()] or [self.nothing]

    def __panel__(self):
        """Return what is put on the page."""
        return self._column


NOTHING_YET = (
    "Nothing is pinned yet. Pin the current design with the button above the sliders, "
    "or the paper's four tracks with the one above."
)
