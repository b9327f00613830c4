"""Boxes and options from which several of the questions are put together."""

import panel as pn
import panel_material_ui as pmui

from dashboard import theme
from dashboard.fields import FIELDS
from dashboard.views.decide.asked import BOX
from trackig_core.track.fields import SLIDER_RANGES


def percent_box(name, value, low=0.0):
    """Return a box for a share of a field [%]."""
    return pmui.FloatInput(
        label=f"{FIELDS[name].label}, ± %",
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
    return FIELDS[name].label.lower() if name in FIELDS else "measured specimens"


def number_options():
    """Return the fields that a designer chooses as numbers, by what they are called."""
    return {FIELDS[name].label: name for name in SLIDER_RANGES}


def is_number(design, name):
    """Return whether a field of a design is a single number: neither absent nor measured over frequency."""
    return isinstance(getattr(design, name), float)
