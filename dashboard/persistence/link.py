"""The address bar's codec: the whole design, how it is looked at and what is pinned, as a query string.

All of a design is written, defaults too, so that a link reopens the same design in versions whose
defaults are others. Numbers have six significant figures, as inputs have, in display units; those that no
slider shows have as many as they need. Curves, rails of one's own and numbers that the sidebar does not have
are too much for an address: the link says that they are in the study's file.

A link is hostile: whatever it holds, decoding raises nothing and gives designs that can be solved. A number
that no track has leaves the preset's; what was ignored is said in words that repeat nothing but numbers and
the letters of a key.
"""

import math
import re
from dataclasses import dataclass
from urllib.parse import urlencode

import trackig_core as tig
from dashboard.fields import (
    EVERY_FIELD,
    EXTRA_FIELDS,
    EXTRAS,
    FIELDS,
    LOAD,
    NUMBERS,
    OPENING_PRESET,
    SHOWN,
    SURROUNDINGS,
)
from dashboard.formats import name_text, quantity_text
from dashboard.session import surroundings
from dashboard.session.inputs import DesignInputs, GainDefinition, design_of, preset_values, values_of
from dashboard.session.pins import free_colour, free_name
from dashboard.session.special import DEFAULTS, is_curve, is_on_slider, on_slider, special_values
from dashboard.theme import MOST_PINNED
from trackig_core.names import LONGEST_NAME
from trackig_core.track.fields import RANGES

VERSION = "1"
"""Version of the format; a link of another version is read as far as its keys are known."""

LONGEST_NUMBER, LONGEST_VALUE, LONGEST_KEY = 32, 800, 24
"""Characters that are read of a number, bytes of any value, and characters that are shown of a key."""

MOST_PROBLEMS = 3
"""Problems of a link that are named one by one: they are told at once, in a message that covers no plot."""

MOST_OFFERED = 4
"""Values of a choice that are named as examples."""

SEPARATOR = "~"
"""Stands between the parts of a pin; the name comes last, so that it may hold it."""

FILE = "file"
"""Key of what a link cannot hold: fields of the current design, and pins as :data:`PINS`."""

PINS = "pins"

NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?", re.ASCII | re.IGNORECASE)

OPTIONAL = (*EXTRAS, *SURROUNDINGS)
"""Inputs that a link holds where they are set."""

EXTRA_SEPARATOR, EXTRA_SIGN = ";", "="
"""Between the optional inputs of a pin, and between name and value."""

CHOICES = {
    "preset": tuple(DesignInputs.param.preset.objects),
    "two_stage": ("0", "1"),
    "rail": tuple(DesignInputs.param.rail.objects),
}
"""What inputs that are no numbers may be in a link."""

VIEW_CHOICES = {
    name: tuple(GainDefinition.param[name].objects) for name in ("summation", "reference", "bands")
}
"""What choices of view may be in a link, by key; a page that offers others adds them."""

SERVED = ("theme", "bokeh-", "autoload")
"""What keys begin with that belong to the server below the dashboard."""


@dataclass(frozen=True)
class Link:
    """What a link holds.

    Attributes
    ----------
    values : dict
        All inputs, by name of :data:`dashboard.fields.INPUTS` [display units], special ones in SI units.
    view : dict
        Choices of view that the link makes, by key.
    pins : tuple of trackig_core.PinnedDesign
        Pinned designs, of different names and colours.
    base : int or None
        Number of the pin from which differences are taken, counted from 0.
    problems : tuple of str
        What was ignored, in words for the user; no more than a handful.
    """

    values: dict
    view: dict
    pins: tuple[tig.PinnedDesign, ...]
    base: int | None
    problems: tuple[str, ...]


def encode(values, view=None, pins=(), base=None):
    """Return the query string of a link, without the question mark.

    Parameters
    ----------
    values : mapping
        All inputs, by name of :data:`dashboard.fields.INPUTS` [display units].
    view : mapping, optional
        Choices of view by key, such as those of :data:`VIEW_CHOICES`.
    pins : iterable of trackig_core.PinnedDesign
        Pinned designs; those of which a link cannot hold all are left out.
    base : int, optional
        Number of the pin from which differences are taken, counted from 0.

    Returns
    -------
    str
        Letters, digits and signs that an address may hold; some 300 characters, and 100 to 600 a pin.
    """
    pins = tuple(pins)
    held = [pin for pin in pins if not _too_much(special_values(pin.design))]
    missing = [*_too_much(values.get("special", {})), *([PINS] if len(held) < len(pins) else [])]
    pairs = [("v", VERSION), *zip(SHOWN, _texts(values), strict=True)]
    pairs += [*_optional(values).items(), *(view or {}).items()]
    pairs += [("pin", _pin_text(pin)) for pin in held]
    if base is not None and pins[base] in held:
        pairs.append(("base", str(held.index(pins[base]) + 1)))
    if missing:
        pairs.append((FILE, ",".join(missing)))
    return urlencode(pairs)


def _too_much(special):
    """Return the fields of special inputs that an address cannot hold."""
    return [name for name, value in special.items() if name not in NUMBERS or is_curve(value)]


def left_out(values, pins=()):
    """Return what a link leaves out of designs, in words.

    Parameters
    ----------
    values : mapping
        All inputs, by name of :data:`dashboard.fields.INPUTS` [display units].
    pins : iterable of trackig_core.PinnedDesign
        Pinned designs.

    Returns
    -------
    list of str
        Labels of inputs, and names of pinned designs; empty if it holds everything.
    """
    labels = [f"the {_label(name).lower()}" for name in _too_much(values["special"])]
    names = [f"the pinned design “{pin.name}”" for pin in pins if _too_much(special_values(pin.design))]
    return [*labels, *names]


def _texts(values):
    """Return inputs as texts, in the order of :data:`dashboard.fields.SHOWN`."""
    special = values.get("special", {})
    for name in SHOWN:
        exact = special.get(name)
        yield repr(exact / FIELDS[name].factor) if isinstance(exact, float) else _text(values[name])


def _optional(values):
    """Return the texts of the optional inputs that are set, by name."""
    given = {name: values.get(name, EXTRA_FIELDS[name].default) for name in EXTRAS}
    numbers = {name: _text(value) for name, value in given.items() if value != EXTRA_FIELDS[name].default}
    around = surroundings.OFF | {name: values[name] for name in SURROUNDINGS if name in values}
    on = [name for name in SURROUNDINGS if around[name] != surroundings.OFF[name]]
    return {**numbers, **{name: surroundings.written(name, around) for name in on}}


def _text(value):
    if isinstance(value, str):
        return value
    return str(int(value)) if isinstance(value, bool) else quantity_text(value)


def _pin_text(pin):
    # the format has a place for every input: those that a single-stage track lacks are as its preset opens
    values = preset_values(pin.preset or OPENING_PRESET) | values_of(pin.design)
    extras = (EXTRA_SIGN.join(each) for each in _optional(values).items() if each[0] not in LOAD)
    shown = EXTRA_SEPARATOR.join((str(int(pin.shown)), *extras))
    return SEPARATOR.join((str(pin.colour), shown, *_texts(values), pin.name))


def decode(arguments, view_choices=VIEW_CHOICES):
    """Return what a link holds, whatever it holds.

    Parameters
    ----------
    arguments : mapping of str to list of bytes
        The query's arguments as the server hands them on.
    view_choices : mapping of str to iterable of str
        What the page offers, by key.

    Returns
    -------
    Link
        A design that can be solved, and words on what could not be read.
    """
    known = ("v", "pin", "base", FILE, *SHOWN, *OPTIONAL, *view_choices)
    problems = [
        f"“{_key_text(key)}” is nothing that a link can set; it was ignored."
        for key in arguments
        if key not in known and not key.startswith(SERVED)
    ]
    given = {key: _first(arguments, key, problems) for key in known if arguments.get(key) and key != "pin"}
    if given.get("v", VERSION) != VERSION:
        problems.append("The link is of another version of trackig; what this one knows was opened.")
    problems += _in_the_file(given.get(FILE, ""))
    values = _values(given, "", problems)
    view = {
        key: given[key]
        for key, allowed in view_choices.items()
        if key in given and _is_allowed(key, given[key], allowed, "", problems)
    }
    pins, numbers = _pins(arguments.get("pin", ()), problems)
    base = _base(given.get("base"), numbers, problems)
    return Link(values, view, pins, base, _some_of(problems))


def _key_text(key):
    """Return a key as it may be shown: its letters, digits and hyphens, cut."""
    return re.sub(r"[^A-Za-z0-9_-]", "?", key[:LONGEST_KEY]) + ("…" if len(key) > LONGEST_KEY else "")


def _label(name):
    """Return what an input or a choice is called on the page, without its unit."""
    if name in EVERY_FIELD:
        return EVERY_FIELD[name].label
    label = DesignInputs.param[name].label if name in SHOWN else name.replace("_", " ").capitalize()
    return label.split(":")[0]


def _in_the_file(text):
    """Return words on what a link says that it left out."""
    names = text.split(",")
    fields = [_label(name) for name in (*NUMBERS, "rail", *DEFAULTS) if name in names]
    if fields:
        more = f" and {len(fields) - 2} more" if len(fields) > 2 else ""
        yield (
            f"{', '.join(fields[:2])}{more}: the link cannot hold it and needs the study file; "
            "the sliders stand in."
        )
    if PINS in names:
        yield "Pinned designs with curves or rails of their own are missing: they are in the study file."


def _decoded(raw):
    """Return a value as text; one that is too long as text that nothing can be read from."""
    return raw.decode("utf-8", errors="replace") if len(raw) <= LONGEST_VALUE else ""


def _first(arguments, key, problems):
    """Return the first value of a key as text."""
    if len({*arguments[key]}) > 1:
        problems.append(f"{_label(key)} is in the link more than once; the first was taken.")
    return _decoded(arguments[key][0])


def _values(given, whose, problems):
    """Return all inputs: those that are given and can be read, the others as in the preset.

    Parameters
    ----------
    given : mapping of str to str
        Texts by name; any may be missing.
    whose : str
        What the words on a problem begin with, such as ``"Pin 2: "``.
    problems : list of str
        Where those words go.
    """
    read = {
        name: given[name]
        for name, allowed in CHOICES.items()
        if name in given and _is_allowed(name, given[name], allowed, whose, problems)
    }
    if "two_stage" in read:
        read["two_stage"] = read["two_stage"] == "1"
    values = preset_values(read.get("preset", DesignInputs.param.preset.default)) | read
    numbers = {
        name: _number(name, given[name], values[name], whose, problems) for name in NUMBERS if name in given
    }
    exact = {name: _exact(name, value) for name, value in numbers.items()}
    special = {name: value for name, value in exact.items() if not is_on_slider(name, value)}
    shown = {name: on_slider(name, value) for name, value in exact.items()}
    extras = {
        name: _number(name, given[name], values[name], whose, problems) for name in EXTRAS if name in given
    }
    values = {**values, **shown, **extras, "special": special}
    return values | _surroundings(given, values, whose, problems)


def _surroundings(given, values, whose, problems):
    """Return vehicle, axles and ground, as far as they can be read and go with all else."""
    found = dict(surroundings.OFF)
    for name in SURROUNDINGS:
        if name in given:
            try:
                read = {name: surroundings.read(name, given[name])}
                design_of(values | found | read)
            except ValueError:
                problems.append(f"{whose}{_label(name)} cannot be read; it was ignored.")
            else:
                found |= read
    return found


def _is_allowed(name, text, allowed, whose, problems):
    if text in allowed:
        return True
    offered = ", ".join((*allowed[:MOST_OFFERED], *["…"] * (len(allowed) > MOST_OFFERED)))
    problems.append(f"{whose}{_label(name)} in the link is unknown and was ignored; it can be {offered}.")
    return False


def _number(name, text, otherwise, whose, problems):
    """Return a number that can be solved, an extra one within its slider's range; else the one that stays.

    A link to a study's design holds numbers that the box does not take: those are taken, and said.
    """
    field = EVERY_FIELD[name]
    is_number = len(text) <= LONGEST_NUMBER and NUMBER.fullmatch(text)
    number = float(text) if is_number else math.nan
    stays = "it was ignored" if otherwise is None else f"it stays at {_quantity(otherwise, field)}"
    if not math.isfinite(number):
        fault = "too large a number" if is_number else "no number"
        problems.append(f"{whose}{field.label} is {fault}; {stays}.")
        return otherwise
    low, high = field.taken
    if low <= number <= high:
        return number
    taken = name in FIELDS and RANGES[name][0] <= _exact(name, number) <= RANGES[name][1]
    problems.append(
        f"{whose}{field.label} is {_quantity(number, field)}, and its box takes {quantity_text(low)} to "
        f"{_quantity(high, field)}; {'it was taken all the same' if taken else stays}."
    )
    return number if taken else otherwise


def _exact(name, number):
    """Return a number of a design in its SI unit, to all figures but the dust of the conversion."""
    return float(f"{number * FIELDS[name].factor:.15g}")


def _quantity(number, field):
    """Return a number of a field as its box shows it, with its unit."""
    return f"{quantity_text(number)} {field.unit}".rstrip()


def _pins(raws, problems):
    """Return the pins, and the numbers that they had in the link, counted from 1."""
    pins, numbers = [], []
    if len(raws) > MOST_PINNED:
        problems.append(f"The link has {len(raws)} pinned designs; {MOST_PINNED} were taken.")
    for number, raw in enumerate(raws[:MOST_PINNED], start=1):
        pin = _pin(_decoded(raw), pins, f"Pin {number}: ", problems)
        if pin is not None:
            pins.append(pin)
            numbers.append(number)
    return tuple(pins), numbers


def _pin(text, before, whose, problems):
    """Return a pin, or None if it cannot be read; its name and colour differ from those before it."""
    parts = text.split(SEPARATOR, len(SHOWN) + 2)
    given = dict(zip(SHOWN, parts[2:], strict=False))
    if len(parts) != len(SHOWN) + 3 or any(given[key] not in allowed for key, allowed in CHOICES.items()):
        problems.append(f"{whose}it cannot be read; it was ignored.")
        return None
    colour, settings, *_, name = parts
    shown, *extras = settings.split(EXTRA_SEPARATOR)
    extra = dict(each.partition(EXTRA_SIGN)[::2] for each in extras)
    given |= {key: each for key, each in extra.items() if key in OPTIONAL and key not in LOAD}
    taken = {pin.colour for pin in before}
    free = {str(index): index for index in range(MOST_PINNED) if index not in taken}
    values = _values(given, whose, problems)
    return tig.PinnedDesign(
        name=free_name(name_text(name, LONGEST_NAME), before),
        design=design_of(values),
        colour=free.get(colour, free_colour(before)),
        shown=shown != "0",
        preset=values["preset"],
    )


def _base(text, numbers, problems):
    """Return the number, from 0, of the pin from which differences are taken, or None."""
    if text is None:
        return None
    found = [index for index, number in enumerate(numbers) if text == str(number)]
    if not found:
        problems.append("The base of differences is no pinned design; it was ignored.")
        return None
    return found[0]


def _some_of(problems):
    """Return so many problems as a user reads, and how many more there are."""
    more = len(problems) - MOST_PROBLEMS
    return (*problems[:MOST_PROBLEMS], *([f"And {more} more of the kind."] if more > 0 else []))
