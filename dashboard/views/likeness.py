"""A warning where compared designs differ in more than their supports, and the way to set them alike.

Insertion gain says what supports do only between tracks with one wheel, one contact spring and one rail: the
loaded-track frequency moves with each of them.
"""

import html

import panel as pn
import panel_material_ui as pmui
from panel.viewable import Viewer

from dashboard import formats, theme
from dashboard.fields import FIELDS
from dashboard.session.special import rail_text

ALIKE = {
    "wheel_mass": "unsprung wheel mass",
    "contact_stiffness": "contact stiffness",
    "rail": "rail",
}
"""What designs that are compared should have in common, and what it is called."""

MEANING = (
    "Their insertion gains differ for that too, not for their supports alone. "
    "“Set all alike” gives every pinned design what this design has."
)


class Likeness(Viewer):
    """The warning; it takes no room while the designs that are shown are alike.

    Parameters
    ----------
    pins : Pins
        What is set alike.
    assessment : Assessment
        The designs that are shown.
    """

    def __init__(self, pins, assessment):
        super().__init__()
        self._pins, self._assessment = pins, assessment
        self.text = pn.pane.HTML(
            "", stylesheets=[theme.WARNING_CSS], sizing_mode="stretch_width", margin=(6, 8, 6, 12)
        )
        self.set_alike = pmui.Button(
            label="Set all alike",
            icon="balance",
            size="small",
            variant="outlined",
            margin=(6, 12, 6, 0),
            on_click=self._set_alike,
        )
        self.row = pmui.Row(self.text, self.set_alike, sizing_mode="stretch_width", margin=0, visible=False)

    def show(self):
        """Compare the designs that are shown as they are now."""
        words = likeness_words([each.design for each in self._assessment.results if each.shown])
        self.text.object = f'<div role="alert">{html.escape(words)}</div>' if words else ""
        self.row.visible = bool(words)

    def _set_alike(self, *_):
        design = self._assessment.current.design
        self._pins.set_alike(**{name: getattr(design, name) for name in ALIKE})

    def __panel__(self):
        """Return what is put on the page."""
        return self.row


def likeness_words(designs):
    """Return in what designs differ beside their supports, as a sentence; empty where they are alike.

    Parameters
    ----------
    designs : sequence of trackig_core.TrackDesign
        The designs.
    """
    differing = []
    for name, words in ALIKE.items():
        values = {getattr(design, name) for design in designs}
        if len(values) > 1:
            differing.append(f"{words} ({_listed(name, values)})")
    return f"These designs differ in {_joined(differing)}. {MEANING}" if differing else ""


def _listed(name, values):
    if name == "rail":
        return _joined(sorted({rail_text(rail) for rail in values}))
    field = FIELDS[name]
    figures = [formats.quantity_text(field.to_display(value)) for value in sorted(values)]
    return f"{_joined(figures)} {field.unit}"


def _joined(parts):
    *others, last = parts
    return f"{', '.join(others)} and {last}" if others else last
