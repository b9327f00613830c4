"""Insertion gain in the bands that were chosen: one-third octaves as in the paper, octaves, 1 Hz to 1 kHz.

A run's record covers 5 Hz to 500 Hz. Beyond it levels are those of the frequency-domain solution, which takes
about a millisecond and is kept. Verdicts, received levels and measured curves stay in the paper's bands.
"""

from functools import lru_cache

import numpy as np

import trackig_core as tig
from trackig_core.bands import BANDS, ONE_THIRD_OCTAVES, chosen_bands
from trackig_core.results import InsertionGain
from trackig_core.solver import WIDE_NOTES

PAPER = "one-third-octave"
"""The paper's bands, a key of ``trackig_core.bands.BANDS``."""

WIDE = tuple(name for name, bands in BANDS.items() if bands.last > ONE_THIRD_OCTAVES.last)
"""Bands that reach beyond a run's record."""

CHOICES = {
    "1/3 octaves, 5 to 500 Hz (paper)": PAPER,
    "Octaves, 8 to 250 Hz": "octave",
    "1/3 octaves, 1 Hz to 1 kHz": "wide one-third-octave",
    "Octaves, 1 Hz to 1 kHz": "wide octave",
}
"""Bands of the core, by what they are called on the page."""

CAPACITY = 64
"""Wide solutions kept; one holds some 20 kB."""


def gain_in(name, solution, reference, summation):
    """Return the insertion gain of a solution in bands of a choice.

    Parameters
    ----------
    name : str
        A key of ``trackig_core.bands.BANDS``.
    solution : trackig_core.Solution
        The solution. Bands that its record does not cover are of the frequency-domain solution of its design.
    reference, summation : str
        Which insertion gain is meant.

    Returns
    -------
    trackig_core.InsertionGain
        Levels (bands,) [dB]; NaN where bands of a design that loses next to nothing have no exact answer.
    """
    if name not in WIDE:
        return solution.gain_for(reference, summation, name)
    try:
        return _wide(solution.design).gain_for(reference, summation, name)
    except tig.DesignError:
        bands = chosen_bands(name)
        nothing = np.full(bands.centres.size, np.nan)
        return InsertionGain(nothing, nothing, nothing, reference, summation, bands)


@lru_cache(maxsize=CAPACITY)
def _wide(design):
    """Return the frequency-domain solution of a design from 1 Hz to 1 kHz."""
    return tig.solve(design, "exact", bands=WIDE[0])


def bands_text(name):
    """Return what is to be said of bands that are not the paper's, in words; empty of the paper's.

    Parameters
    ----------
    name : str
        A key of ``trackig_core.bands.BANDS``.
    """
    if name == PAPER:
        return ""
    bands = chosen_bands(name)
    words = f"{bands.words.lower()} bands, {bands.labels[0]} to {bands.labels[-1]} Hz"
    if name in WIDE:
        words += f", of the frequency-domain solution: {WIDE_NOTES[0]}"
    return words
