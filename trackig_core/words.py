"""Figures in words, for whoever prints a result: with their unit, at a length that can be read aloud."""

from collections.abc import Iterable, Sequence

import numpy as np

from trackig_core.arrays import AnyArray, RealArray

_PREFIXES = ((1e9, "G"), (1e6, "M"), (1e3, "k"), (1.0, ""))
_PREFIXED = ("N", "N s/m", "N m", "N m2")
_STIFFNESS = "N/m"
_OF_SUPPORTS, _LEAST_OF_SUPPORTS = (1e6, "kN/mm"), 1e4
"""Unit of stiffness that inputs and tables have, and from where on figures are given in it [N/m]."""

_SMALL = {"m": (1e-3, "mm"), "s": (1e-3, "ms"), "m/N": (1e-9, "nm/N")}
"""Units that are too large for what is below a tenth of them, and what stands in."""


def quantity(value: float, unit: str, figures: int = 4) -> str:
    """Return a number with its unit, such as ``"10.85 kN/mm"``.

    Parameters
    ----------
    value : float
        The number [unit].
    unit : str
        Its SI unit; empty if it has none.
    figures : int
        Figures that are shown [-].

    Returns
    -------
    str
        The number in words.
    """
    if unit in _PREFIXED:
        size, prefix = next((each for each in _PREFIXES if abs(value) >= each[0]), (1.0, ""))
        return f"{value / size:.{figures}g} {prefix}{unit}"
    if unit == _STIFFNESS and abs(value) >= _LEAST_OF_SUPPORTS:
        size, unit = _OF_SUPPORTS
        value = value / size
        figures = max(figures, len(f"{abs(value):.0f}"))
    if unit in _SMALL and abs(value) < 0.1:
        size, unit = _SMALL[unit]
        value = value / size
    return f"{value:.{figures}g} {unit}".rstrip()


def hertz(frequencies: Iterable[float]) -> str:
    """Return frequencies [Hz] with three figures, such as ``"39.1 and 301 Hz"``."""
    return f"{' and '.join(f'{each:.3g}' for each in frequencies)} Hz"


def span(values: AnyArray, unit: str) -> str:
    """Return least and greatest of some numbers [unit], one if they are the same."""
    low, high = (quantity(float(each), unit, 3) for each in (np.nanmin(values), np.nanmax(values)))
    return low if low == high else f"{low} to {high}"


def extremes(levels: RealArray, labels: Sequence[str]) -> str:
    """Return least and greatest of levels per band [dB], and where: ``"-39.0 dB at 500 Hz to ..."``."""
    places = int(np.nanargmin(levels)), int(np.nanargmax(levels))
    return " to ".join(f"{levels[at]:.1f} dB at {labels[at]} Hz" for at in places)


def largest(differences: RealArray, labels: Sequence[str]) -> str:
    """Return the difference of levels per band [dB] that is largest in magnitude, and where."""
    at = int(np.nanargmax(np.abs(differences)))
    return f"{differences[at]:+.1f} dB at {labels[at]} Hz"


def counted(number: int, thing: str) -> str:
    """Return how many of something there are, such as ``"2 bands"``."""
    return f"{number} {thing}{'' if number == 1 else 's'}"
