"""Numbers and names as text: the one place where figures are rounded for readers."""

import math

from trackig_core.decide.words import change_words


def frequency_text(frequency):
    """Return a frequency [Hz] as a reader wants it: three figures, with its unit."""
    decimals = max(0, 2 - math.floor(math.log10(frequency)))
    return f"{frequency:.{decimals}f} Hz"


def duration_text(seconds):
    """Return a duration [s] in ms below one second, else in s."""
    return f"{1000 * seconds:.0f} ms" if seconds < 0.9995 else f"{seconds:.1f} s"


def level_text(level):
    """Return a level [dB] with its sign and one decimal; a true minus, so that columns align."""
    return f"{level:+.1f} dB".replace("-", "−")


def change_text(value):
    """Return a change with its sign, a true minus, and two figures, however small."""
    return change_words(value).replace("-", "−")


SUMMATIONS = {
    "energy": "energies of the supports summed, as in the paper",
    "coherent": "forces of the supports summed",
}
REFERENCES = {
    "line": "relative to the straight line through the track's own spectrum, as in the paper",
    "rigid": "relative to the exact rigid track",
    "stiff": "relative to a very stiff track on the same ground, under the same vehicle",
}
"""How each kind of insertion gain is named in what leaves the page."""

FIDELITIES = {
    "paper": "time stepping at the paper's resolution",
    "live": "time stepping at the live resolution",
    "exact": "frequency-domain solution",
}
"""How each way of solving is named in what leaves the page."""


def definition_text(summation, reference):
    """Return which insertion gain is meant, in words: how supports are summed, and relative to what."""
    return f"{SUMMATIONS[summation]}; {REFERENCES[reference]}"


def fidelities_text(fidelities):
    """Return how solutions were obtained, in words: each way once."""
    ways = set(fidelities)
    return " and ".join(words for each, words in FIDELITIES.items() if each in ways)


def force_text(force):
    """Return a force [kN] with its sign, three figures and its unit."""
    return f"{force:+.3g} kN".replace("-", "−")


def deflection_text(statics):
    """Return the rail deflection of a static response with three figures and its unit.

    Parameters
    ----------
    statics : trackig_core.StaticResponse
        The response; while a static stiffness is not stated, the rail sinks at least so far.
    """
    return f"{'at least ' if statics.at_least else ''}{millimetre_text(statics.rail_deflection)}"


def millimetre_text(length):
    """Return a length [m] in mm: three figures, and no more than three decimals, with its unit."""
    millimetres = 1e3 * length
    decimals = min(max(0, 2 - math.floor(math.log10(millimetres))), 3) if millimetres > 0 else 2
    return f"{millimetres:.{decimals}f} mm"


def load_text(load):
    """Return a load [N] in kN: three figures, with its unit."""
    return f"{load / 1e3:.3g} kN"


def wheels_text(load):
    """Return which wheels stand on the track, in words.

    Parameters
    ----------
    load : trackig_core.study.StaticLoad
        The wheels.
    """
    each = f"{quantity_text(load.wheel_load / 1e3)} kN"
    if load.wheelbase is None:
        return f"one wheel of {each}"
    return f"two wheels of {each}, {quantity_text(load.wheelbase)} m apart"


UNSTATED_WORDS = "the static stiffness of the {parts} is not stated, so that the dynamic one stands in"
"""Why the rail sinks at least so far."""


def unstated_text(statics):
    """Return why a static response is a lower bound, in words; empty where it is none."""
    if not statics.at_least:
        return ""
    return UNSTATED_WORDS.format(parts=" and the ".join(statics.unstated))


def beyond_text(least, greatest, low, high):
    """Return how far a force reaches beyond an axis, in words; empty if it does not.

    Parameters
    ----------
    least, greatest : float
        The force's extremes [kN].
    low, high : float
        The axis' ends [kN].

    Returns
    -------
    str
        Words to stand behind a name.
    """
    beyond = [force for force, leaves in ((greatest, greatest > high), (least, least < low)) if leaves]
    if not beyond:
        return ""
    return " (cut off: reaches " + " and ".join(force_text(force) for force in beyond) + ")"


def extrapolated_text(name):
    """Return what hatched bands are, in words (str): they rest on more than was measured of a design."""
    return f"beyond what was measured of {name}"


def signed_text(level, decimals=1):
    """Return a difference or level for a column of a table: sign, decimals, no unit; nothing is 0.0."""
    text = f"{level:+.{decimals}f}"
    return "0.0" if float(text) == 0 else text.replace("-", "−")


def plain_text(level):
    """Return a level [dB] that is no difference for a column of a table: one decimal, no unit."""
    return f"{level:.1f}".replace("-", "−")


def slope_text(slope):
    """Return a slope [dB per octave] with its sign, whole."""
    return f"{slope:+.0f} dB per octave".replace("-", "−") if round(slope) else "level"


LEAST_DIFFERENCE = 1e-6
"""Differences of levels below this are not told apart [dB]."""


def difference_text(difference):
    """Return a small difference of levels [dB], greater than zero: one figure, or two decimals."""
    decimals = max(2, -math.floor(math.log10(difference)))
    return f"{difference:.{decimals}f} dB"


def quantity_text(value):
    """Return an input's value as it is typed: up to six figures, no trailing zeros."""
    return f"{value:.6g}"


def extent_text(points):
    """Return how many bands a table has and where, such as ``"6 bands, 31.5 to 125 Hz"``.

    Parameters
    ----------
    points : sequence of (float, float)
        Rows of frequency [Hz], ascending, and level [dB]; one or more.
    """
    first, last = (quantity_text(points[end][0]) for end in (0, -1))
    return f"1 band, {first} Hz" if len(points) == 1 else f"{len(points)} bands, {first} to {last} Hz"


def name_text(name, longest):
    """Return a name that somebody typed as it is shown: one line of printable characters, cut at a length."""
    words = "".join(letter if letter.isprintable() else " " for letter in name[: longest + 1])
    return words if len(words) <= longest else words[: longest - 1] + "…"
