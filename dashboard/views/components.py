"""What several views are made of: panels, captions, panes, swatches."""

from typing import ClassVar

import panel as pn
import panel_material_ui as pmui

from dashboard import theme

CURRENT_NAME = "this\N{NO-BREAK SPACE}design"
"""What the current design is called; no pin can be called so, since names hold no such space."""

CURRENT = 0
"""Stands for the current design where keys of pins are chosen from, which count from 1."""

PAPER = {"elevation": 0, "sizing_mode": "stretch_width", "margin": 0, "sx": theme.PANEL}
"""What a panel of the page is made of."""


class QuickSlider(pmui.FloatSlider):
    """A slider that reports its moves at once, not after Panel's 50 ms; the runner drops what is too many."""

    _priority_changes: ClassVar[list[str]] = ["value"]


SHRINKS = {"flex": "0 1 auto", "min-width": "0", "max-width": "100%"}
"""What takes the room that its words need, and wraps them where there is less."""


def caption(title, words):
    """Return a panel's heading."""
    return pmui.Row(
        pmui.Typography(title, variant="subtitle1", sx=theme.PANEL_TITLE, margin=0),
        pmui.Typography(words, variant="body2", color="text.secondary", margin=(3, 0, 0, 10), styles=SHRINKS),
        margin=(4, 0, 0, 12),
        styles=SHRINKS,
    )


def bokeh_pane(model):
    """Return a figure as wide as its place."""
    return pn.pane.Bokeh(model, sizing_mode="stretch_width", margin=0)


def gain_axis(definition):
    """Return what the insertion gain's axis is called, the choice named in it."""
    return f"IG, dB ({SUMMATION_AXIS[definition.summation]} / {definition.reference})"


SUMMATION_AXIS = {"energy": "energy", "coherent": "coherent"}
