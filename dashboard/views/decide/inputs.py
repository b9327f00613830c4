"""Boxes and options from which several of the questions are put together."""

import math

import panel as pn
import panel_material_ui as pmui

from dashboard import theme
from dashboard.fields import FIELDS
from dashboard.formats import quantity_text
from dashboard.views.decide.asked import BOX
from trackig_core.names import brief
from trackig_core.track.fields import SLIDER_RANGES
from trackig_core.typed_numbers import NumberError, read_number


class NumberBox(pmui.TextInput):
    """A box for a number, read as anywhere: with a decimal comma, or with its unit behind it.

    Panel's own boxes for numbers have buttons without a name beside them, and lose what is typed after Enter.

    Parameters
    ----------
    label : str
        What the box is called; its end says the unit.
    value : float
        The number at first [unit].
    unit : str
        Unit of the number; empty if it has none.
    most : float
        The greatest number that may be given [unit]; the least is 0, as is an empty box.
    whole : bool
        Whether it must be a whole number.
    """

    def __init__(self, label, value, unit="", most=math.inf, whole=False, **look):
        super().__init__(label=label, value=quantity_text(value), max_length=40, size="small", **BOX, **look)
        self._unit, self._most, self._whole = unit, most, whole
        self.param.watch(self._mark, "value")

    @property
    def number(self):
        """The number as it was typed [unit]; a ValueError says why there is none."""
        text = self.value.strip()
        try:
            number = read_number(text, self._unit) if text else 0.0
        except NumberError as error:
            raise ValueError(f"{self.label}: {error}.") from None
        if not 0 <= number <= self._most:
            span = "or more" if self._most == math.inf else f"to {quantity_text(self._most)} {self._unit}"
            raise ValueError(f"{self.label}: {brief(text)}: give 0 {span.rstrip()}.")
        if self._whole and number != int(number):
            raise ValueError(f"{self.label}: {brief(text)}: give a whole number.")
        return int(number) if self._whole else number

    def _mark(self, *_):
        try:
            self.error_state = self.number is None
        except ValueError:
            self.error_state = True


def percent_box(name, value):
    """Return a box for a share of a field [%]."""
    return NumberBox(f"{FIELDS[name].label}, ± %", value, "%", most=MOST_CHANGE, width=190)


MOST_CHANGE = 90.0
"""How far a field may be changed, or scatter [%]."""


def seed_box():
    """Return a box for the seed of what is drawn by chance."""
    return NumberBox("Seed", 0, whole=True, most=MOST_SEED, width=110)


MOST_SEED = 2**31 - 1
"""A seed beyond which figures would not fit into a study file."""


def choice(label, options, width, **words):
    """Return a box to choose one of several options."""
    return pn.widgets.Select(
        label=label,
        options=options,
        width=width,
        stylesheets=[theme.SELECT_CSS],
        margin=(0, 12, 0, 0),
        **words,
    )


def titled(title, boxes):
    """Return boxes to tick below what they are called together."""
    name = pn.pane.HTML(f"<h3>{title}</h3>", stylesheets=[theme.ANSWER_CSS], margin=(0, 12))
    boxes.margin = (0, 12)
    return pn.Column(name, boxes, sizing_mode="stretch_width", margin=0)


def factor_label(name):
    """Return what scatters, as it is spoken."""
    return FIELDS[name].label.lower() if name in FIELDS else "measured specimens"


def number_options():
    """Return the fields that a designer chooses as numbers, by what they are called."""
    return {FIELDS[name].label: name for name in SLIDER_RANGES}


def is_number(design, name):
    """Return whether a field of a design is a single number: neither absent nor measured over frequency."""
    return isinstance(getattr(design, name), float)
