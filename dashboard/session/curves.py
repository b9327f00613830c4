"""What is drawn of the pinned designs: reckoned once for all views, when pins or the choice of gain change.

The one rule: while the design at hand moves, nothing in here changes, so no frame pays for a pin.
"""

from types import MappingProxyType
from typing import NamedTuple

import param

NOTHING = MappingProxyType({})


class Curve(NamedTuple):
    """What is drawn of a pinned design.

    Attributes
    ----------
    name : str
        What it is called: text of a user's, which no figure takes for markup.
    drawn : numpy.ndarray (21,) or Picture
        Insertion gain [dB], or the picture whose total force is drawn.
    colour : str
        Its colour in every plot.
    dash : sequence of int
        Its dash in every plot [px]; empty: solid.
    """

    name: str
    drawn: object
    colour: str
    dash: tuple


class PinnedCurves(param.Parameterized):
    """Levels of all pins that have a picture, and curves of those that are shown.

    Parameters
    ----------
    pins : Pins
        The pins.
    pinned : PinnedSummaries
        Their pictures.
    definition : GainDefinition
        How insertion gain is reckoned.
    """

    levels = param.Parameter(default=NOTHING, doc="Insertion gain (21,) [dB] by key of the pin.")
    gains = param.Parameter(default=(), doc="Curve of insertion gain of each shown pin.")
    forces = param.Parameter(default=(), doc="Curve of each shown pin, its picture for the force.")

    def __init__(self, pins, pinned, definition):
        super().__init__()
        self._pins, self._pinned, self._definition = pins, pinned, definition
        pins.param.watch(self._collect, "pinned")
        pinned.param.watch(self._collect, "summaries")
        definition.param.watch(self._collect, ["summation", "reference"])
        self._collect()

    def _collect(self, *_):
        summaries, shown = self._pinned.summaries, self._pins.shown
        there = [pin for pin in self._pins.pinned if pin.key in summaries]
        levels = {pin.key: self._definition.levels(summaries[pin.key].solution) for pin in there}
        forces = [(pin, summaries[pin.key]) for pin in there if pin in shown]
        self.param.update(
            levels=MappingProxyType(levels),
            gains=tuple(Curve(pin.name, levels[pin.key], pin.colour_code, pin.dash) for pin, _ in forces),
            forces=tuple(Curve(pin.name, summary, pin.colour_code, pin.dash) for pin, summary in forces),
        )
