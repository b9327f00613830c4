"""The sidebar: every input as a slider with a number box beside it, in the order of the load path.

Sliders count in steps, since Page Up moves a browser's slider by ten units, whatever these are; they
show the value itself, to screen readers and in the box. A box takes any number within the range, with
point or comma, says what it takes when it gets something else, and never changes a number that was typed.

A widget changes an input and nothing else; no widget watches another.
"""

import math

import panel as pn
import panel_material_ui as pmui
from bokeh.models import CustomJSTickFormatter
from panel.viewable import Viewer

from dashboard.fields import FIELDS, six_figures
from dashboard.formats import quantity_text
from dashboard.session.inputs import display_values
from dashboard.theme import GROUP_HEADING, HIDDEN_LABEL, SELECT_CSS, SLIDER
from dashboard.views.components import QuickSlider

STEPS_PER_DECADE = 100
"""Steps of a logarithmic slider from a value to its tenfold."""

LOG_FIGURES = 3
"""Figures to which a logarithmic slider rounds; a box takes six."""

FULL_WIDTH = {"sizing_mode": "stretch_width", "margin": (2, 12, 4, 16), "stylesheets": [SELECT_CSS]}

BOX_WIDTH = 92
"""Width of a number box [px]."""


class QuantityControl(Viewer):
    """One number as slider and box, both bound to the same input.

    Parameters
    ----------
    inputs : DesignInputs
        The inputs.
    name : str
        Which of them.
    """

    def __init__(self, inputs, name):
        super().__init__()
        self._inputs, self._name = inputs, name
        self._number = inputs.param[name]
        self._log = FIELDS[name].logarithmic
        enabled = inputs.param.two_stage if FIELDS[name].second_stage else None
        disabled = enabled.rx.not_() if enabled is not None else False
        self.slider = QuickSlider(
            label=self._number.label,
            start=0,
            end=self._to_slider(self._number.bounds[1]),
            step=1,
            value=self._to_slider(self._value),
            format=self._formatter(),
            show_value=False,
            tooltips=False,
            disabled=disabled,
            size="small",
            sx=SLIDER,
            sizing_mode="stretch_width",
            margin=(0, 4, 0, 0),
        )
        self.box = pmui.TextInput(
            label=f"{self._number.label}: type a number",
            value=quantity_text(self._value),
            disabled=disabled,
            max_length=24,
            size="small",
            variant="outlined",
            width=BOX_WIDTH,
            sx=HIDDEN_LABEL,
            margin=0,
        )
        self._mark_preset()
        self.slider.param.watch(self._slider_moved, "value")
        self.box.param.watch(self._box_typed, "value")
        inputs.param.watch(self.show, [name, "preset"])
        inputs.param.watch(self._mark_preset, "preset")
        self._row = pmui.Row(self.slider, self.box, sizing_mode="stretch_width", margin=(0, 12, 2, 16))

    @property
    def _value(self):
        return getattr(self._inputs, self._name)

    def _to_slider(self, value):
        low, _ = self._number.bounds
        if self._log:
            return STEPS_PER_DECADE * math.log10(value / low)
        return (value - low) / self._number.step

    def _from_slider(self, position):
        low, high = self._number.bounds
        if self._log:
            value = float(f"{low * 10 ** (position / STEPS_PER_DECADE):.{LOG_FIGURES}g}")
        else:
            value = six_figures(low + position * self._number.step)
        return min(max(value, low), high)

    def _formatter(self):
        low, _ = self._number.bounds
        value, figures = (
            (f"{low} * 10 ** (tick / {STEPS_PER_DECADE})", LOG_FIGURES)
            if self._log
            else (f"{low} + tick * {self._number.step}", 6)
        )
        return CustomJSTickFormatter(code=f"return String(Number(({value}).toPrecision({figures})))")

    def _slider_moved(self, event):
        # a slider that follows the input must not round what was typed
        if event.new != self._to_slider(self._value):
            setattr(self._inputs, self._name, self._from_slider(event.new))

    def _box_typed(self, event):
        low, high = self._number.bounds
        try:
            value = float(event.new.replace(",", "."))
        except ValueError:
            value = math.nan
        if low <= value <= high:
            self.box.param.update(error_state=False, helper_text="")
            setattr(self._inputs, self._name, value)
        else:
            wanted = "a number, " if math.isnan(value) else ""
            advice = f"give {wanted}{quantity_text(low)} to {quantity_text(high)}"
            self.box.param.update(error_state=True, helper_text=advice)

    def show(self, *_):
        """Show the input as it stands, whatever was typed."""
        # a slider that stands where it gives this value is left alone: it may be under the user's thumb
        if self._from_slider(self.slider.value) != self._value:
            self.slider.value = self._to_slider(self._value)
        self.box.param.update(value=quantity_text(self._value), error_state=False, helper_text="")

    def _mark_preset(self, *_):
        preset = display_values(self._inputs.preset_design).get(self._name)
        self.slider.marks = False if preset is None else [{"value": self._to_slider(preset)}]

    def __panel__(self):
        """Return what is put on the page."""
        return self._row


class Controls(Viewer):
    """All controls of the sidebar.

    Parameters
    ----------
    inputs : DesignInputs
        What they change.
    """

    def __init__(self, inputs):
        super().__init__()
        self._inputs = inputs
        self.quantities = {name: QuantityControl(inputs, name) for name in FIELDS}
        # Material's select opens by mouse only; the browser's own obeys the keyboard
        self.preset = pn.widgets.Select.from_param(inputs.param.preset, **FULL_WIDTH)
        self.two_stage = pmui.Switch.from_param(inputs.param.two_stage, size="small", margin=(2, 12, 6, 16))
        self.rail = pn.widgets.Select.from_param(inputs.param.rail, **FULL_WIDTH)
        self.state = pmui.Typography(
            inputs.param.modified.rx.where("Modified", "As in Table 1"), variant="body2", margin=(6, 0, 0, 16)
        )
        self.revert = pmui.Button(
            label="Back to Table 1",
            icon="restore",
            variant="text",
            size="small",
            disabled=inputs.param.modified.rx.not_(),
            on_click=self._revert,
            margin=(0, 12, 0, 0),
        )
        # a card's button to open it has no name of its own
        self.advanced = pmui.Accordion(
            ("Advanced", self.quantities["contact_stiffness"]),
            active=[],
            title_variant="subtitle2",
            disable_gutters=True,
            elevation=0,
            sizing_mode="stretch_width",
            margin=(0, 0, 8, 0),
        )

    def _revert(self, _):
        self._inputs.revert()
        for quantity in self.quantities.values():
            quantity.show()

    def __panel__(self):
        """Return what is put on the page."""
        quantity = self.quantities
        return pmui.Column(
            self.preset,
            pmui.Row(self.state, pn.HSpacer(), self.revert, sizing_mode="stretch_width", margin=0),
            heading("Rail pad"),
            quantity["pad_stiffness"],
            quantity["pad_loss_factor"],
            heading("Block and boot"),
            self.two_stage,
            quantity["block_mass"],
            quantity["boot_stiffness"],
            quantity["boot_loss_factor"],
            heading("Track"),
            quantity["fastener_spacing"],
            self.rail,
            heading("Vehicle"),
            quantity["wheel_mass"],
            self.advanced,
            sizing_mode="stretch_width",
            margin=(10, 0),
        )


def heading(text):
    """Return a group's heading."""
    return pmui.Typography(text, variant="subtitle2", sx=GROUP_HEADING, margin=(8, 12, 2, 16))
