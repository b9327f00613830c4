"""Numbers of a design in words that can be read aloud: SI units, with prefixes where figures are long."""

import math

from trackig_core.decide.requirements import DEFLECTION, UNITS
from trackig_core.track.fields import GIVEN, RANGES, amount


def spoken(field: str) -> str:
    """Return the name of a field as it is spoken: ``"boot stiffness"`` or ``"ground damping (site)"``.

    Whose it is stands behind it where no track's supplier chooses it.
    """
    name = field.replace("_", " ").replace(".", " ")
    return f"{name} ({GIVEN[field]})" if field in GIVEN else name


def percent(share: float) -> str:
    """Return a share [-] in per cent, such as ``"94 %"``, with a decimal near nothing and near all."""
    if 0 < share < 0.0005:
        return "under 0.1 %"
    if share in (0.0, 1.0) or 0.02 <= share <= 0.98:
        return f"{100 * share:.0f} %"
    return f"{100 * share:.1f} %"


def away(margin: float) -> str:
    """Return how far a level is from its limit [dB], on either side of it: one decimal, never none."""
    return "under 0.1 dB" if 0 < abs(margin) < 0.05 else f"{abs(margin):.1f} dB"


def how_much(share: float) -> str:
    """Return a share [-] of something that follows: ``"none"``, ``"all"`` or as :func:`percent` says it."""
    return {0.0: "none", 1.0: "all"}.get(share) or percent(share)


def in_unit(name: str, value: float) -> str:
    """Return a figure, a field or a cost with its unit; a deflection in mm."""
    if name == DEFLECTION:
        return f"{1e3 * value:.2f} mm"
    if name in UNITS:
        return f"{value:.1f} {UNITS[name]}"
    return amount(name, value) if name in RANGES else f"{value:.4g}"


def change_words(value: float) -> str:
    """Return a change with its sign and two figures, however small; floating-point dust is no change.

    Parameters
    ----------
    value : float
        Any change, in the unit that is shown.

    Returns
    -------
    str
        Such as ``"+0.34"``, ``"-12"``, ``"+0.0021"`` or ``"0"``.
    """
    if abs(value) < DUST:
        return "0"
    rounded = float(f"{value:.1e}")
    decimals = max(0, 1 - math.floor(math.log10(abs(rounded))))
    return f"{rounded:+.{decimals}f}"


DUST = 1e-6
"""Change [dB, mm, Hz] below which a figure is taken to stay as it is."""


def sentence(text: str) -> str:
    """Return a text that begins with a capital."""
    return text[0].upper() + text[1:]
