"""Figures that a text may ask for by name, and claims about them: computed, never written.

A lesson's text says ``{{ change insertion_gain(63) }}`` where a printed book would say "falls by 4.5 dB",
and its claims say ``insertion_gain(63) falls by at least 3 dB``. Both are about two designs, before and
after. Units are those of the trade, as on the sliders (:mod:`dashboard.session.inputs`).

    quantity       insertion_gain(63)   insertion_gain(63, coherent, rigid)   peak   slope(200, 400)
                   loaded_track   coupled_block   block_on_boot   cut_on   lumped_lower   lumped_upper
                   supports   stiffening(500)   boot_stiffness   wheel_mass   ... every slider
                   at_most(boot_stiffness, 63, -1.5)   production(63, -1.5, 15)
    placeholder    quantity | before quantity | change quantity | difference quantity | percent quantity
    claim          quantity is at least|at most NUMBER UNIT         (``before quantity is ...`` too)
                   quantity falls|rises|changes by at least|at most NUMBER UNIT|%
                   ... between NUMBER and NUMBER UNIT

``at_most`` is the greatest value of a slider, all others held, with which insertion gain in a band keeps a
limit [dB]; ``production`` is how much of production keeps it while the stiffnesses of pads and boots scatter
by so many per cent, evenly within them.

A name is looked up in the table below; nothing from a text is ever evaluated as code.
"""

import difflib
import re
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

import trackig_core as tig
from dashboard.fields import FIELDS
from trackig_core.decide.tolerances import LARGEST
from trackig_core.track.fields import SLIDER_RANGES

LONGEST = 120
"""Characters that one placeholder or claim may have [-]."""

_NUMBER = r"-?\d{1,6}(?:\.\d{1,6})?"
_QUANTITY = r"(?P<name>[a-z_]{1,40})(?:\((?P<arguments>[a-z0-9., _-]{0,60})\))?"
_PLACEHOLDER = re.compile(rf"(?:(?P<form>before|change|difference|percent) )?{_QUANTITY}")
_CLAIM = re.compile(
    rf"(?P<before>before )?{_QUANTITY} (?:(?P<state>is)|(?P<verb>falls|rises|changes) by)"
    rf" (?:(?P<bound>at least|at most) (?P<limit>{_NUMBER})"
    rf"|between (?P<low>{_NUMBER}) and (?P<high>{_NUMBER}))"
    r"(?: (?P<unit>\S{1,20}))?"
)


class QuantityError(ValueError):
    """A text asks for a figure that does not exist, or makes a claim that cannot be read."""


@dataclass(frozen=True)
class Quantity:
    """One figure of a design.

    Attributes
    ----------
    name : str
        Its name, with its arguments as written.
    unit : str
        Its unit; empty when it has none.
    of : callable
        ``of(design)`` returns the figure, or None where a design has no such figure.
    """

    name: str
    unit: str
    of: Callable[[tig.TrackDesign], float | None]

    def value(self, design):
        """Return the figure of a design.

        Parameters
        ----------
        design : trackig_core.TrackDesign
            The design.

        Returns
        -------
        float
            The figure [unit].

        Raises
        ------
        QuantityError
            If the design has no such figure.
        """
        try:
            found = self.of(design)
        except tig.DesignError as error:
            raise QuantityError(f"{self.name}: {error}") from None
        if found is None:
            raise QuantityError(f"{self.name}: a single-stage track has none; leave it out or add a stage")
        return float(found)

    def written(self, value, unit=None):
        """Return a figure of this quantity as text with its unit."""
        unit = self.unit if unit is None else unit
        style = ".1f" if unit.startswith("dB") else ".0f" if unit == "%" else ".3g"
        # z: what rounds to nothing has no sign
        return f"{value:{'z' + style}} {unit}".strip()


def read_placeholder(text):
    """Return what stands in a placeholder as a function of two designs.

    Parameters
    ----------
    text : str
        What stands between the braces.

    Returns
    -------
    callable
        ``write(before, after)`` returns the words in its place.

    Raises
    ------
    QuantityError
        If it cannot be read.
    """
    found = _match(_PLACEHOLDER, text, "a figure, such as {{ change insertion_gain(63) }}")
    quantity, form = _quantity(found["name"], found["arguments"]), found["form"]

    def write(before, after):
        if form is None or form == "before":
            return quantity.written(quantity.value(before if form else after))
        was, now = quantity.value(before), quantity.value(after)
        if form == "difference":
            return quantity.written(abs(now - was))
        if form == "percent":
            change, unit = _percent(quantity, was, now), "%"
        else:
            change, unit = now - was, quantity.unit
        size = quantity.written(abs(change), unit)
        if not float(size.split()[0]):
            return "does not change"
        return f"{'rises' if change > 0 else 'falls'} by {size}"

    return write


def read_claim(text):
    """Return a claim as a function of two designs.

    Parameters
    ----------
    text : str
        The claim.

    Returns
    -------
    callable
        ``holds(before, after)`` returns whether it is true.

    Raises
    ------
    QuantityError
        If it cannot be read.
    """
    found = _match(_CLAIM, text, "a claim, such as 'insertion_gain(63) falls by at least 3 dB'")
    quantity, unit = _quantity(found["name"], found["arguments"]), found["unit"] or ""
    if found["before"] and not found["state"]:
        raise QuantityError(f"'{text}': 'before' goes with 'is'; {found['verb']} compares before and after")
    allowed = [quantity.unit] if found["state"] else [quantity.unit, "%"]
    if unit not in allowed:
        units = " or ".join(each or "no unit" for each in allowed)
        raise QuantityError(f"'{text}': give {quantity.name} in {units}")
    if found["bound"]:
        limit = float(found["limit"])
        low, high = (limit, float("inf")) if found["bound"] == "at least" else (float("-inf"), limit)
    else:
        low, high = float(found["low"]), float(found["high"])

    def holds(before, after):
        if found["state"]:
            return low <= quantity.value(before if found["before"] else after) <= high
        was, now = quantity.value(before), quantity.value(after)
        change = _percent(quantity, was, now) if unit != quantity.unit else now - was
        change = {"falls": -change, "rises": change, "changes": abs(change)}[found["verb"]]
        return low <= change <= high

    return holds


def _match(pattern, text, wanted):
    stripped = text.strip()
    found = pattern.fullmatch(stripped) if len(stripped) <= LONGEST else None
    if found is None:
        raise QuantityError(f"'{stripped[:LONGEST]}' cannot be read: give {wanted}")
    return found


def _percent(quantity, was, now):
    if quantity.unit.startswith("dB") or was <= 0:
        raise QuantityError(f"{quantity.name}: levels have no percentage; give the change in {quantity.unit}")
    return 100 * (now / was - 1)


def _quantity(name, arguments):
    """Return the quantity of a name and its arguments."""
    given = [each.strip() for each in (arguments or "").split(",") if each.strip()]
    written = f"{name}({', '.join(given)})" if given else name
    if name not in _MAKERS:
        near = difflib.get_close_matches(name, _MAKERS, n=1)
        hint = near[0] if near else f"one of {', '.join(_MAKERS)}"
        raise QuantityError(f"'{name}' is no figure: give {hint}")
    unit, of = _MAKERS[name](written, given)
    return Quantity(written, unit, of)


def _plain(unit, of):
    """Return the maker of a quantity that takes no arguments."""

    def make(written, given):
        if given:
            raise QuantityError(f"'{written}': give nothing in brackets")
        return unit, of

    return make


def _slider(name):
    field = FIELDS[name]

    def of(design):
        value = getattr(design, name)
        return None if value is None else field.to_display(value)

    return _plain(field.unit, of)


def _frequency(name):
    return _plain("Hz", lambda design: getattr(_exact(design).natural_frequencies, name))


def _lumped(which):
    def of(design):
        coupled = tig.lumped_frequencies(design).coupled
        return coupled[which] if which < len(coupled) else None

    return _plain("Hz", of)


def _insertion_gain(written, given):
    bands, definition = given[:1], given[1:]
    index = _band(written, bands[0] if bands else "")
    summation = _choice(written, definition, ("energy", "coherent"))
    reference = _choice(written, definition, ("line", "rigid"))
    if len(definition) != len(set(definition) & {"energy", "coherent", "line", "rigid"}):
        raise QuantityError(f"'{written}': after the band, give energy or coherent, line or rigid")
    return "dB", lambda design: _levels(design, reference, summation)[index]


def _choice(written, given, choices):
    chosen = [each for each in given if each in choices]
    if len(chosen) > 1:
        raise QuantityError(f"'{written}': give {choices[0]} or {choices[1]}, not both")
    return chosen[0] if chosen else choices[0]


def _slope(written, given):
    low, high = (_band(written, label) for label in (given if len(given) == 2 else ("", "")))
    if low >= high:
        raise QuantityError(f"'{written}': give the lower band first, such as slope(200, 400)")
    octaves = (high - low) / 3

    def of(design):
        levels = _levels(design, "line", "energy")
        return (levels[high] - levels[low]) / octaves

    return "dB/octave", of


def _stiffening(written, given):
    try:
        (frequency,) = (float(each) for each in given)
    except ValueError:
        raise QuantityError(f"'{written}': give one frequency, such as stiffening(500)") from None
    if not 5 <= frequency <= 500:
        raise QuantityError(f"'{written}': give a frequency from 5 to 500 Hz")

    def of(design):
        pad, boot = tig.damping_curves(design, [frequency])
        return (boot or pad).stiffness[0]

    return "", of


def _at_most(written, given):
    name, band, limit = given if len(given) == 3 else ("", "", "")
    if name not in SLIDER_RANGES:
        example = "at_most(boot_stiffness, 63, -1.5)"
        raise QuantityError(f"'{written}': give a slider, a band and a limit in dB, such as {example}")
    specification = _limited(written, band, limit)

    def of(design):
        found = tig.decide.feasible_ranges(design, specification, fields=[name])
        return FIELDS[name].to_display(found[name][-1][1]) if found[name] else None

    return FIELDS[name].unit, of


def _production(written, given):
    band, limit, share = given if len(given) == 3 else ("", "", "")
    specification = _limited(written, band, limit)
    scatter = _number(written, share) / 100
    if not 0 < scatter <= LARGEST:
        raise QuantityError(f"'{written}': give a tolerance above 0 and up to {100 * LARGEST:g} %")
    return "%", lambda design: 100 * _complying(design, specification, scatter)


def _limited(written, band, limit):
    """Return a specification of a single band."""
    try:
        return tig.Specification([(tig.BAND_CENTRES[_band(written, band)], _number(written, limit))])
    except tig.SpecificationError as error:
        raise QuantityError(f"'{written}': {error}") from None


def _number(written, text):
    if not re.fullmatch(_NUMBER, text):
        raise QuantityError(f"'{written}': {text or 'nothing'} is no number; give one such as -1.5")
    return float(text)


@lru_cache(maxsize=64)
def _complying(design, specification, scatter):
    springs = ("pad_stiffness", "boot_stiffness") if design.two_stage else ("pad_stiffness",)
    tolerances = dict.fromkeys(springs, scatter)
    return tig.decide.tolerance(design, specification, tolerances, samples=SPECIMENS).probability


SPECIMENS = 2048
"""Specimens that are drawn to say how much of production complies [-]."""


def _band(written, label):
    if label not in tig.BAND_LABELS:
        raise QuantityError(f"'{written}': give a band, one of {', '.join(tig.BAND_LABELS)}")
    return tig.BAND_LABELS.index(label)


@lru_cache(maxsize=64)
def _exact(design):
    return tig.solve(design, "exact")


def _levels(design, reference, summation):
    solution = _exact(design)
    loaded = solution.natural_frequencies.loaded_track
    return tig.insertion_gain(solution.spectrum, design, loaded, reference, summation).levels


_MAKERS = {
    "insertion_gain": _insertion_gain,
    "peak": _plain("dB", lambda design: _levels(design, "line", "energy").max()),
    "slope": _slope,
    "loaded_track": _frequency("loaded_track"),
    "coupled_block": _frequency("coupled_block"),
    "block_on_boot": _frequency("block_on_boot"),
    "cut_on": _plain("Hz", lambda design: _exact(design).natural_frequencies.cut_on[0]),
    "lumped_lower": _lumped(0),
    "lumped_upper": _lumped(1),
    "supports": _plain("", tig.effective_supports),
    "stiffening": _stiffening,
    "at_most": _at_most,
    "production": _production,
    **{name: _slider(name) for name in FIELDS},
}
"""What each name stands for: from the arguments that are written, a unit and a function of a design."""
