"""Designs that are kept beside the one at hand, to be compared with it.

A pin holds what the user had set, in display units, so that it can be solved and put back. The one
rule: pins never change, the tuple of them does, as a whole; so whoever watches it sees each change once.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType

import param

import trackig_core as tig
from dashboard import theme
from dashboard.fields import PRESET_LABELS
from dashboard.session.inputs import check_values, design_of, preset_values
from trackig_core.names import LONGEST_NAME, allowed, brief, is_name

MOST = theme.MOST_PINNED

THIS_DESIGN = "This design"
"""What the current design is called beside those that are pinned."""


def current_design(design, preset=None):
    """Return the current design as a record like those that are pinned (trackig_core.PinnedDesign)."""
    return tig.PinnedDesign(THIS_DESIGN, design, colour=None, preset=preset)


def shown_designs(study):
    """Return the current design of a study and those pinned designs that are shown."""
    return (current_design(study.design), *(each for each in study.pinned if each.shown))


def base_design(study):
    """Return the design of a study from which differences are taken, under its name."""
    base = study.view.base
    return current_design(study.design) if base is None else study.pinned[base]


class PinError(ValueError):
    """What was asked of the pins cannot be done; the message says why, and what can."""


@dataclass(frozen=True)
class Pin:
    """A design as it was when it was pinned.

    Parameters
    ----------
    key : int
        Tells the pin from all others of its session, renamed or recoloured as it may be.
    name : str
        What it is called; :func:`trackig_core.names.is_name` says what may be a name.
    colour : int
        Index of its colour and its dash in :data:`dashboard.theme.DESIGN_COLOURS`.
    values : mapping
        The inputs, by name of :data:`dashboard.fields.INPUTS` [display units].
    shown : bool
        Whether it is drawn.

    Raises
    ------
    PinError
        If the name or the colour is not allowed.
    ValueError
        If inputs cannot hold the values.
    """

    key: int
    name: str
    colour: int
    values: Mapping
    shown: bool = True

    def __post_init__(self):
        """Check every value once, and keep the values from being changed."""
        if not is_name(self.name):
            raise PinError(f"{brief(self.name)} is no name: give {allowed()}.")
        if self.colour not in range(MOST):
            raise PinError(f"There is no colour {self.colour}: give 0 to {MOST - 1}.")
        check_values(self.values)
        object.__setattr__(self, "values", MappingProxyType(dict(self.values)))

    @property
    def design(self):
        """The design in SI units, to be solved."""
        return design_of(self.values)

    @property
    def colour_code(self):
        """Its colour in every plot."""
        return theme.DESIGN_COLOURS[self.colour]

    @property
    def dash(self):
        """Its dash in every plot, for readers who do not tell the colours apart."""
        return theme.DESIGN_DASHES[self.colour]


class Pins(param.Parameterized):
    """The pinned designs, up to eight, in the order in which they were pinned."""

    pinned = param.Parameter(default=(), doc="The pins, a tuple.")
    base = param.Integer(
        default=None,
        allow_None=True,
        doc="Key of the pin from which differences are taken; None: the design at hand.",
    )

    alone = param.Boolean(
        default=False, doc="Whether insertion gain is drawn of the pins alone, not of the design at hand."
    )

    _latest_key = 0

    def __getitem__(self, key):
        """Return the pin with a key.

        Raises
        ------
        PinError
            If it was removed.
        """
        pin = next((pin for pin in self.pinned if pin.key == key), None)
        if pin is None:
            raise PinError("This design is pinned no longer.")
        return pin

    @property
    def shown(self):
        """The pins that are drawn, a tuple."""
        return tuple(pin for pin in self.pinned if pin.shown)

    def add(self, values, name=""):
        """Pin a design.

        Parameters
        ----------
        values : mapping
            The inputs, by name of :data:`dashboard.fields.INPUTS` [display units].
        name : str
            What to call it; a number is added if another pin is called so. Empty: a name is found.

        Returns
        -------
        Pin
            The new pin, in the first colour that no other has.

        Raises
        ------
        PinError
            If eight designs are pinned, or the name is not allowed.
        """
        return self.add_all([(values, name)])[0]

    def add_table_1(self):
        """Pin those of the paper's four tracks that are not pinned as published, as one change.

        Returns
        -------
        tuple of Pin
            The new pins.

        Raises
        ------
        PinError
            If there is no room for them; then none was pinned.
        """
        there = [pin.design for pin in self.pinned]
        missing = [key for key, design in tig.PRESETS.items() if design not in there]
        return self.add_all((preset_values(key), PRESET_LABELS[key]) for key in missing)

    def show_table_1(self):
        """Draw the paper's four tracks and nothing else, pinning those that are missing: its Figure 2.

        Raises
        ------
        PinError
            If there is no room for them; then nothing has changed.
        """
        with param.parameterized.batch_call_watchers(self):
            self.add_table_1()
            published = set(tig.PRESETS.values())
            self.pinned = tuple(replace(pin, shown=pin.design in published) for pin in self.pinned)
            self.alone = True

    def add_all(self, designs):
        """Pin several designs as one change: all of them or none.

        Parameters
        ----------
        designs : iterable of (mapping, str)
            Values and name of each, as :meth:`add` takes them.

        Returns
        -------
        tuple of Pin
            The new pins.

        Raises
        ------
        PinError
            If there is no room for all of them, or a name is not allowed; then none was pinned.
        """
        designs, pinned = list(designs), list(self.pinned)
        if len(pinned) + len(designs) > MOST:
            raise PinError(
                f"{len(pinned)} designs are pinned, and {MOST} can be: "
                f"remove {len(pinned) + len(designs) - MOST} to pin {len(designs)} more."
            )
        for values, name in designs:
            self._latest_key += 1
            pinned.append(Pin(self._latest_key, free_name(name, pinned), free_colour(pinned), values))
        if designs:
            self.pinned = tuple(pinned)
        return self.pinned[len(pinned) - len(designs) :]

    def rename(self, key, name):
        """Give a pin another name.

        Raises
        ------
        PinError
            If the name is not allowed, or another pin has it.
        """
        name = name.strip()
        if any(pin.name == name and pin.key != key for pin in self.pinned):
            raise PinError(f"Another pinned design is called “{name}”: give another name.")
        self._change(key, name=name)

    def recolour(self, key, colour):
        """Give a pin another colour; a pin that has it takes this one's in exchange.

        Raises
        ------
        PinError
            If there is no such colour.
        """
        now = self[key]
        changed = {key: replace(now, colour=colour)}
        changed |= {
            pin.key: replace(pin, colour=now.colour)
            for pin in self.pinned
            if pin.colour == colour and pin.key != key
        }
        self.pinned = tuple(changed.get(pin.key, pin) for pin in self.pinned)

    def show(self, key, shown=True):
        """Draw a pin, or draw it no longer."""
        self._change(key, shown=shown)

    def remove(self, key):
        """Pin a design no longer.

        If it was the base of differences, the design at hand becomes it; if it was the last, the design at
        hand is drawn again.
        """
        gone = self[key]
        with param.parameterized.batch_call_watchers(self):
            self.pinned = tuple(pin for pin in self.pinned if pin is not gone)
            if self.base == key:
                self.base = None
            if not self.pinned:
                self.alone = False

    def choose_base(self, key):
        """Take differences from a pin, or from the design at hand if the key is None."""
        self.base = None if key is None else self[key].key

    def replace_all(self, pins, base=None):
        """Put other pins in the place of all, as one change: those of a link, or of a study.

        Parameters
        ----------
        pins : iterable of Pin
            Up to eight; each gets a new key, so that nobody takes it for one that was there before.
        base : int, optional
            Number of the pin from which differences are taken, counted from 0.

        Raises
        ------
        PinError
            If there are more than eight, or two of one colour or one name; then nothing has changed.
        """
        pins = list(pins)
        if len(pins) > MOST:
            raise PinError(f"{len(pins)} designs are too many: {MOST} can be pinned.")
        for what in ("name", "colour"):
            if len({getattr(pin, what) for pin in pins}) < len(pins):
                raise PinError(f"Two pinned designs have one {what}: give each its own.")
        first = self._latest_key + 1
        self._latest_key += len(pins)
        self.param.update(
            pinned=tuple(replace(pin, key=first + count) for count, pin in enumerate(pins)),
            base=None if base is None else first + range(len(pins))[base],
        )

    def _change(self, key, **changes):
        changed = replace(self[key], **changes)
        self.pinned = tuple(changed if pin.key == key else pin for pin in self.pinned)


def free_colour(pinned):
    """Return the first colour that none of up to seven pins has."""
    taken = {pin.colour for pin in pinned}
    return next(colour for colour in range(MOST) if colour not in taken)


def distinct_colours(wanted):
    """Return colours that tell designs apart, whatever colours they want.

    Parameters
    ----------
    wanted : iterable of int
        Colour of each of up to eight designs, such as those of a file; several may want one.

    Returns
    -------
    tuple of int
        The first that wants a colour has it; the others get those that nobody wants.
    """
    wanted = list(wanted)
    free = (colour for colour in range(MOST) if colour not in wanted)
    return tuple(
        next(free) if colour in wanted[:count] or colour >= MOST else colour
        for count, colour in enumerate(wanted)
    )


def free_name(name, pinned):
    """Return a name that none of some pins has: the given one, or with a number."""
    taken = {pin.name for pin in pinned}
    name = name.strip()
    stem = name[: LONGEST_NAME - 4] or "Design"
    numbered = (f"{stem} {number}" for number in range(2 if name else 1, MOST + 3))
    return name if name and name not in taken else next(each for each in numbered if each not in taken)
