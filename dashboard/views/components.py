"""What several views are made of: panels, captions, panes, swatches."""

import html
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


SHRINKS = {"flex": "0 1 auto", "min-width": "0", "max-width": "100%"}
"""What takes the room that its words need, and wraps them where there is less."""


class QuickSlider(pmui.FloatSlider):
    """A slider that reports its moves at once, not after Panel's 50 ms; the runner drops what is too many."""

    _priority_changes: ClassVar[list[str]] = ["value"]


def caption(title, words):
    """Return a panel's heading."""
    text = f"<h2>{html.escape(title)}</h2><p>{html.escape(words)}</p>"
    return pn.pane.HTML(text, stylesheets=[theme.CAPTION_CSS], styles=SHRINKS, margin=(4, 0, 0, 12))


def words(text="", size=16, weight=400, **place):
    """Return words that may change at any time (Markdown).

    Material's own text reads them when it is drawn and listens a moment later: a change between is lost.
    """
    place = {"margin": (2, 14, 10, 14), "sizing_mode": "stretch_width"} | place
    styles = {"font-size": f"{size}px", "font-weight": f"{weight}"}
    return pn.pane.Markdown(text, stylesheets=[theme.WORDS_CSS], styles=styles, **place)


def put_words(place, text):
    """Show words in their place, which takes no room while there are none.

    One by one: all at once, param would look through all that a pane has.

    Parameters
    ----------
    place : panel.pane.Markdown or panel_material_ui.Alert
        Where they go.
    text : str
        The words, of the place's own markup; empty if there are none.
    """
    place.object = text
    place.visible = bool(text)


def panel(*objects, name=None):
    """Return a panel of the page to which figures may be added while it is shown; scripts may know its name.

    Bokeh would lay out a figure that Material has not drawn yet, and fail.
    """
    return pn.Column(
        *objects, name=name, stylesheets=[theme.PANEL_CSS], sizing_mode="stretch_width", margin=0
    )


def bokeh_pane(model):
    """Return a figure as wide as its place."""
    return pn.pane.Bokeh(model, sizing_mode="stretch_width", margin=0)


def gain_axis(definition, *designs):
    """Return what the insertion gain's axis is called: the choice, and what designs are compared with."""
    references = dict.fromkeys(map(definition.reference_of, designs)) or [definition.reference]
    return f"IG, dB ({SUMMATION_AXIS[definition.summation]} / {' or '.join(references)})"


SUMMATION_AXIS = {"energy": "energy", "coherent": "coherent"}
