"""Designs that are kept beside the current one, to be compared with it.

Pins never change, the tuple of them does, as a whole; so whoever watches it sees each change once.
"""

from dataclasses import replace

import param

import trackig_core as tig
from dashboard.fields import PRESET_LABELS
from dashboard.theme import MOST_PINNED
from trackig_core.names import LONGEST_NAME, allowed, brief, is_name

THIS_DESIGN = "This design"
"""What the current design is called beside those that are pinned."""

PUBLISHED = "As in Table 1"
"""What the preset is called beside the design that departs from it."""


def current_design(design, preset=None):
    """Return the current design as a record like those that are pinned (trackig_core.PinnedDesign)."""
    return tig.PinnedDesign(THIS_DESIGN, design, colour=None, preset=preset)


def preset_design(design):
    """Return the preset from which the current design departs as such a record."""
    return tig.PinnedDesign(PUBLISHED, design, colour=None)


def shown_designs(study):
    """Return the current design of a study and those pinned designs that are shown."""
    return (current_design(study.design), *(each for each in study.pinned if each.shown))


def base_design(study):
    """Return the design of a study from which differences are taken, under its name."""
    base = study.view.base
    return current_design(study.design) if base is None else study.pinned[base]


class PinError(ValueError):
    """What was asked of the pins cannot be done; the message says why, and what can."""


class Pins(param.Parameterized):
    """The pinned designs, up to eight, in the order in which they were pinned."""

    pinned = param.Parameter(default=(), doc="A tuple of trackig_core.PinnedDesign, each with a key.")
    base = param.Integer(
        default=None,
        allow_None=True,
        doc="Key of the pin from which differences are taken; None: the current design.",
    )

    alone = param.Boolean(
        default=False, doc="Whether insertion gain is drawn of the pins alone, not of the current design."
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

    def add(self, design, name="", preset=None):
        """Pin a design.

        Parameters
        ----------
        design : trackig_core.TrackDesign
            The design.
        name : str
            What to call it; a number is added if another pin is called so. Empty: a name is found.
        preset : str, optional
            Key of ``trackig_core.PRESETS`` from which it departs, if from any.

        Returns
        -------
        trackig_core.PinnedDesign
            The new pin, in the first colour that no other has.

        Raises
        ------
        PinError
            If eight designs are pinned, or the name is not allowed.
        """
        return self.add_all([(design, name, preset)])[0]

    def add_table_1(self):
        """Pin those of the paper's four tracks that are not pinned as published, as one change.

        Returns
        -------
        tuple of trackig_core.PinnedDesign
            The new pins.

        Raises
        ------
        PinError
            If there is no room for them; then none was pinned.
        """
        there = [pin.design for pin in self.pinned]
        missing = {key: design for key, design in tig.PRESETS.items() if design not in there}
        return self.add_all((design, PRESET_LABELS[key], key) for key, design in missing.items())

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
        designs : iterable of (TrackDesign, str, str or None)
            Design, name and preset of each, as :meth:`add` takes them.

        Returns
        -------
        tuple of trackig_core.PinnedDesign
            The new pins.

        Raises
        ------
        PinError
            If there is no room for all of them, or a name is not allowed; then none was pinned.
        """
        designs, pinned = list(designs), list(self.pinned)
        if len(pinned) + len(designs) > MOST_PINNED:
            raise PinError(
                f"{len(pinned)} designs are pinned, and {MOST_PINNED} can be: "
                f"remove {len(pinned) + len(designs) - MOST_PINNED} to pin {len(designs)} more."
            )
        for design, name, preset in designs:
            self._latest_key += 1
            found = _checked_name(free_name(name, pinned))
            colour = free_colour(pinned)
            pinned.append(tig.PinnedDesign(found, design, colour, preset=preset, key=self._latest_key))
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
        self._change(key, name=_checked_name(name))

    def recolour(self, key, colour):
        """Give a pin another colour; a pin that has it takes this one's in exchange.

        Raises
        ------
        PinError
            If there is no such colour.
        """
        if colour not in range(MOST_PINNED):
            raise PinError(f"There is no colour {colour}: give 0 to {MOST_PINNED - 1}.")
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

        If it was the base of differences, the current design becomes it; if it was the last, the current
        design is drawn again.
        """
        gone = self[key]
        with param.parameterized.batch_call_watchers(self):
            self.pinned = tuple(pin for pin in self.pinned if pin is not gone)
            if self.base == key:
                self.base = None
            if not self.pinned:
                self.alone = False

    def choose_base(self, key):
        """Take differences from a pin, or from the current design if the key is None."""
        self.base = None if key is None else self[key].key

    def replace_all(self, pins, base=None):
        """Put other pins in the place of all, as one change: those of a link, or of a study.

        Parameters
        ----------
        pins : iterable of trackig_core.PinnedDesign
            Up to eight; each gets a new key, so that nobody takes it for one that was there before.
        base : int, optional
            Number of the pin from which differences are taken, counted from 0.

        Raises
        ------
        PinError
            If there are more than eight, or two of one colour or one name; then nothing has changed.
        """
        pins = list(pins)
        if len(pins) > MOST_PINNED:
            raise PinError(f"{len(pins)} designs are too many: {MOST_PINNED} can be pinned.")
        for what in ("name", "colour"):
            if len({getattr(pin, what) for pin in pins}) < len(pins):
                raise PinError(f"Two pinned designs have one {what}: give each its own.")
        first = self._latest_key + 1
        self._latest_key += len(pins)
        self.param.update(
            pinned=tuple(replace(pin, key=first + count) for count, pin in enumerate(pins)),
            base=None if base is None else first + range(len(pins))[base],
        )

    def set_alike(self, **values):
        """Give every pin the same values of some fields, as one change; each gets a new key.

        Parameters
        ----------
        values : dict
            Values by field of trackig_core.TrackDesign, SI units.
        """
        base = next((place for place, pin in enumerate(self.pinned) if pin.key == self.base), None)
        self.replace_all((replace(pin, design=pin.design.replace(**values)) for pin in self.pinned), base)

    def _change(self, key, **changes):
        changed = replace(self[key], **changes)
        self.pinned = tuple(changed if pin.key == key else pin for pin in self.pinned)


def _checked_name(name):
    """Return a name, or raise a PinError that says what may be one."""
    if not is_name(name):
        raise PinError(f"{brief(name)} is no name: give {allowed()}.")
    return name


def free_colour(pinned):
    """Return the first colour that none of some pins has, fewer than there are colours."""
    taken = {pin.colour for pin in pinned}
    return next(colour for colour in range(MOST_PINNED) if colour not in taken)


def distinct_colours(wanted):
    """Return colours that tell designs apart, whatever colours they want.

    Parameters
    ----------
    wanted : iterable of int
        Colour of each of some designs, such as those of a file, no more than there are colours; several may
        want one.

    Returns
    -------
    tuple of int
        The first that wants a colour has it; the others get those that nobody wants.
    """
    wanted = list(wanted)
    free = (colour for colour in range(MOST_PINNED) if colour not in wanted)
    return tuple(
        next(free) if colour in wanted[:count] or colour >= MOST_PINNED else colour
        for count, colour in enumerate(wanted)
    )


def free_name(name, pinned):
    """Return a name that none of some pins has: the given one, or with a number."""
    taken = {pin.name for pin in pinned}
    name = name.strip()
    stem = name[: LONGEST_NAME - 4] or "Design"
    numbered = (f"{stem} {number}" for number in range(2 if name else 1, MOST_PINNED + 3))
    return name if name and name not in taken else next(each for each in numbered if each not in taken)
