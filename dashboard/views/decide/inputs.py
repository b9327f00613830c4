"""Boxes and options from which several of the questions are put together."""

import panel as pn
import panel_material_ui as pmui

from dashboard import theme
from dashboard.fields import ASKED_FIELDS, FIELDS
from dashboard.views.decide.asked import BOX
from trackig_core.decide.numbers import changeable_numbers, single_numbers


def percent_box(name, value, low=0.0):
    """Return a box for a share of a field [%]."""
    return pmui.FloatInput(
        label=f"{ASKED_FIELDS[name].label}, ± %",
        value=value,
        start=low,
        end=90.0,
        step=1.0,
        size="small",
        width=190,
        **BOX,
    )


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


def factor_label(name):
    """Return what scatters, as it is spoken."""
    return ASKED_FIELDS[name].label.lower() if name in ASKED_FIELDS else "measured specimens"


def number_options(design):
    """Return the numbers that have a slider, and those of vehicle and ground that a design has, by label."""
    around = [name for name in single_numbers(design) if name not in FIELDS]
    return {ASKED_FIELDS[name].label: name for name in (*FIELDS, *around)}


def offer(box, options):
    """Have a box offer some options, and keep what is chosen as far as it is still among them."""
    if box.options == options:
        return
    there = list(options.values())
    if isinstance(box.value, list):
        value = [each for each in box.value if each in there]
    else:
        value = box.value if box.value in there else there[0]
    box.param.update(options=options, value=value)


def is_number(design, name):
    """Return whether a field of a design is a single number: neither absent nor measured over frequency."""
    return isinstance(design.value(name), float)


class ShareBoxes:
    """Boxes for a share of each number: of some that have a slider, of vehicle and ground of what is there.

    Parameters
    ----------
    shares : dict of str to float
        What stands in the boxes of numbers with a slider at first, by name [%].
    around : float
        What stands at first in those of vehicle and ground [%].
    exchange : Exchange
        Prepares the browser for boxes that are added.
    low : float
        Least share [%].
    changed : callable, optional
        Called when a share changes.
    **words
        Of the row that holds the boxes.

    Attributes
    ----------
    boxes : dict of str to panel_material_ui.FloatInput
        The boxes by name of the number.
    row : panel.FlexBox
        All of them.
    """

    def __init__(self, shares, around, exchange, low=0.0, changed=None, **words):
        self._around, self._exchange, self._low, self._changed = around, exchange, low, changed
        self.boxes = {}
        self.row = pn.FlexBox(margin=(0, 12), **words)
        self._add(shares)

    def _add(self, shares):
        for name, share in shares.items():
            box = self.boxes[name] = percent_box(name, share, self._low)
            if self._changed is not None:
                box.param.watch(self._changed, "value")
        self.row.objects = list(self.boxes.values())

    def offer(self, design):
        """Have boxes for those numbers of vehicle and ground that a design has."""
        there = [name for name in changeable_numbers(design) if name in AROUND]
        added = [name for name in there if name not in self.boxes]
        if added:
            self._add(dict.fromkeys(added, self._around))
            self._exchange.introduce()
        for name in AROUND & self.boxes.keys():
            self.boxes[name].visible = name in there

    def change_all(self, share):
        """Have the same share in all boxes, and in those that are added [%]."""
        self._around = share
        for box in self.boxes.values():
            box.value = share

    def shares(self, design):
        """Return the shares of what a design has, none of which is zero, by name [-]."""
        there = changeable_numbers(design)
        return {name: box.value / 100 for name, box in self.boxes.items() if box.value and name in there}


AROUND = ASKED_FIELDS.keys() - FIELDS.keys()
"""Numbers of vehicle and ground."""
