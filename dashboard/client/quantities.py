"""The panel of quantities: one component for all that is set of a design, kept in step by the browser.

What the user sets comes as one message of newest values at a time; the browser sends the next when it hears
that the picture of the last one has been drawn, or was given up. So a hand that is faster than the server
costs the server nothing.
"""

from pathlib import Path
from typing import ClassVar

import param

from dashboard import theme
from dashboard.client.exchange import Scripted

SCRIPT = Path(__file__).parent / "scripts" / "quantities.js"


class Quantities(Scripted):
    """Sliders with boxes, choices and switches, in groups; it knows fields and values, and no track.

    Attributes
    ----------
    on_set : callable
        Called with the number of a message, what it sets, and the number of the user's gesture. Values come
        by name, of whatever types somebody may have sent; text where it was typed.
    on_revert : callable
        Called without arguments when the way back to the chosen track is taken.
    on_chip : callable
        Called with the name of the field whose chip was clicked.
    on_pick : callable
        Called with kind and name of what was chosen from the catalogue, whatever somebody may have sent.
    """

    groups = param.List(default=[], doc="Title, fields, and whether closed, of each group; see the script.")
    state = param.Dict(
        default={
            "number": 0,
            "values": {},
            "refused": {},
            "disabled": [],
            "hidden": [],
            "words": {},
            "marks": {},
            "modified": False,
        },
        doc="What is set, by name: values, advice where a text was refused, what is disabled or hidden, "
        "ticks on sliders; and the number of the last message that it reflects.",
    )
    feasible = param.Dict(
        default={},
        doc="Stretches (low, high) of a slider, by name, in which the design complies [display units]; an "
        "empty list: nowhere; no entry: nothing is drawn.",
    )
    stale = param.Boolean(default=False, doc="Whether the stretches are those of an earlier design.")
    chips = param.Dict(default={}, doc="Words of a button that stands in a slider's place, by name.")
    catalogue = param.Dict(default={}, doc="Names that a group may be set from, by kind of component.")

    _esm = SCRIPT.read_text(encoding="utf-8")
    _stylesheets: ClassVar = [theme.QUANTITIES_CSS]

    on_set = None
    on_revert = None
    on_chip = None
    on_pick = None

    def handle_message(self, message):
        """Hand on what the user set or clicked; what fits no field asks for nothing."""
        match message:
            case {"kind": "set", "number": int(number), "values": dict(values), "gesture": int(gesture)}:
                self.on_set(number, values, gesture)
            case {"kind": "revert"}:
                self.on_revert()
            case {"kind": "chip", "name": str(name)} if name in self.chips and self.on_chip is not None:
                self.on_chip(name)
            case {"kind": "pick", "of": str(kind), "name": str(name)} if self.on_pick is not None:
                self.on_pick(kind, name)

    def answer(self, number):
        """Tell the browser that the picture of a message was drawn, or given up."""
        self._send_msg({"kind": "answered", "number": number})
