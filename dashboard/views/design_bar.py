"""The bar above the sliders: undo, redo, and pinning the current design under a name.

What a step is, :mod:`dashboard.session.steps` says.
"""

import panel as pn
import panel_material_ui as pmui
from panel.viewable import Viewer

from dashboard import theme
from dashboard.client.exchange import notify
from dashboard.fields import PRESET_LABELS
from dashboard.session.history import MOST_STEPS
from dashboard.session.pins import PinError
from trackig_core.names import LONGEST_NAME


class DesignBar(Viewer):
    """Buttons that act on the current design as a whole.

    Parameters
    ----------
    inputs : DesignInputs
        The current design.
    pins : Pins
        Where it is pinned.
    steps : Steps
        What is undone and redone.
    browser : Browser
        Says when keys ask for undo or redo.
    """

    def __init__(self, inputs, pins, steps, browser):
        super().__init__()
        self._inputs, self._pins = inputs, pins
        self.undo = pmui.Button(
            label="Undo",
            icon="undo",
            description=f"Undo (Ctrl+Z){SINCE_LOADED}",
            on_click=steps.undo,
            disabled=steps.param.can_undo.rx.not_(),
            **STEP,
        )
        self.redo = pmui.Button(
            label="Redo",
            icon="redo",
            description=f"Redo (Ctrl+Y){SINCE_LOADED}",
            on_click=steps.redo,
            disabled=steps.param.can_redo.rx.not_(),
            **STEP,
        )
        self.name_box = pmui.TextInput(
            label="Name of the design to be pinned",
            placeholder="Name (optional)",
            max_length=LONGEST_NAME,
            size="small",
            variant="outlined",
            sizing_mode="stretch_width",
            sx=theme.HIDDEN_LABEL | theme.LEFT_ALIGNED,
            margin=(4, 8, 0, 0),
        )
        self.pin = pmui.Button(
            label="Pin",
            icon="push_pin",
            description="Pin this design",
            stylesheets=[theme.TOOLTIP_CSS],
            variant="contained",
            size="small",
            on_click=self._pin,
            margin=(4, 0, 0, 0),
        )
        browser.param.watch(_as_often(steps.undo), "undone")
        browser.param.watch(_as_often(steps.redo), "redone")

    def _pin(self, _):
        inputs = self._inputs
        if inputs.refused:
            labels = " and ".join(inputs.param[name].label for name in inputs.refused)
            notify("warning", f"Nothing is pinned: what stands in {labels} was not taken. Correct it first.")
            return
        usual = "" if inputs.modified else PRESET_LABELS[inputs.preset]
        try:
            pin = self._pins.add(inputs.to_design(), self.name_box.value or usual, inputs.preset)
        except PinError as problem:
            notify("warning", str(problem))
            return
        self.name_box.value = ""
        if pn.state.notifications is not None:
            pn.state.notifications.success(f"Pinned as “{pin.name}”. See the tab Compare.", duration=3000)

    def __panel__(self):
        """Return what is put on the page."""
        return pn.Column(
            pn.Row(self.name_box, self.pin, sizing_mode="stretch_width", margin=(0, 12, 0, 16)),
            pn.Row(self.undo, self.redo, sizing_mode="stretch_width", margin=(2, 12, 0, 8)),
            sizing_mode="stretch_width",
            margin=(6, 0, 0, 0),
        )


SINCE_LOADED = (
    ". Loading the page anew keeps all that a study holds, and what stands in the boxes of Decide and of the "
    "report; it forgets the steps."
)
"""What of a session outlives a page: its state, which the browser remembers, and not how it came about."""

STEP = {"size": "small", "variant": "text", "margin": 0, "stylesheets": [theme.TOOLTIP_CSS]}


def _as_often(step):
    """Return a watcher that steps as often as a count has grown: quick presses come as one change."""

    def watch(event):
        for _ in range(min(event.new - event.old, MOST_STEPS)):
            step()

    return watch
