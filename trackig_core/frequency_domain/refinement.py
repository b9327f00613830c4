"""Exact spectra over the bands, on a frequency axis that is refined until it shows every peak.

Hz and N2 s2. Source of the model: the paper (see :mod:`trackig_core.track.design`); the lattice is solved by
:mod:`trackig_core.frequency_domain.floquet_waves`.
"""

import numpy as np

from trackig_core.bands import BAND_EDGES, LINE_FRACTION
from trackig_core.frequency_domain.floquet_waves import INFINITE, exact_spectrum
from trackig_core.results import ForceSpectrum
from trackig_core.track.design import DEFAULT_STEP, DesignError
from trackig_core.track.viscoelastic_law import laws

STRAIGHTNESS = 0.05
"""Bend of a refined spectrum between neighbouring frequencies that is left alone [dB]."""

MOST_HALVINGS = 40
"""Halvings of an interval after which a peak is taken as resolved [-]: a frequency has few more digits."""

WIDEST_STEP = 3.0
"""How much wider an interval may be than its neighbour [-]: halved intervals differ by factors of two."""

MOST_FREQUENCIES = 20_000
"""Frequencies after which a spectrum is refined no further [-]: more are asked for only where losses are so
small that rounding shows."""


def resolved_spectrum(design, frequency, step, lattice=INFINITE):
    """Return an exact spectrum on a frequency axis that is refined until it shows every peak.

    Parameters
    ----------
    design : TrackDesign
        The track and its wheel.
    frequency : numpy.ndarray (frequencies,)
        Frequencies to begin with [Hz], ascending and greater than zero; all are kept.
    step : float
        Height of the step [m].
    lattice : Lattice
        What to solve.

    Returns
    -------
    ForceSpectrum
        Energy at the given and the added frequencies.
    """
    return refined_spectrum(lambda between: exact_spectrum(design, between, step, lattice), frequency)


def refined_spectrum(spectrum_at, frequency):
    """Return any model's spectrum on a frequency axis that is refined until it shows every peak.

    Intervals are halved until a straight line between neighbours, in decibels, misses the spectrum
    by no more than :data:`STRAIGHTNESS`, and no interval is more than :data:`WIDEST_STEP` times as wide as
    the next.

    Parameters
    ----------
    spectrum_at : callable
        ``spectrum_at(frequency)`` returns the ForceSpectrum at an array of frequencies [Hz].
    frequency : numpy.ndarray (frequencies,)
        Frequencies to begin with [Hz], ascending and greater than zero; all are kept.

    Returns
    -------
    ForceSpectrum
        Energy at the given and the added frequencies.
    """
    known = spectrum_at(frequency)
    rows = np.array([known.frequency, known.energy, known.coherent_energy])
    straight = np.zeros(rows.shape[1] - 1, dtype=bool)
    for _ in range(MOST_HALVINGS):
        halved = np.flatnonzero(~straight)
        left, right = rows[:, halved], rows[:, halved + 1]
        between = spectrum_at((left[0] + right[0]) / 2)
        middle = np.array([between.frequency, between.energy, between.coherent_energy])
        ratio = middle[1:] ** 2 / (left[1:] * right[1:])
        with np.errstate(invalid="ignore", divide="ignore"):  # energies that rounding drowns; told below
            bend = np.abs(np.log(ratio)).max(axis=0)
        straight[halved] = ~(bend > 2 * STRAIGHTNESS / 10 * np.log(10))
        straight = np.insert(straight, halved, straight[halved])
        rows = np.insert(rows, halved + 1, middle, axis=1)
        straight &= ~_too_wide(np.diff(rows[0]))
        if straight.all() or rows.shape[1] > MOST_FREQUENCIES:
            break
    return ForceSpectrum(frequency=rows[0], energy=rows[1], coherent_energy=rows[2], step=known.step)


def _too_wide(intervals):
    """Return which intervals are much wider than a neighbour: a peak's flank may look straight by chance."""
    neighbour = np.full_like(intervals, np.inf)
    neighbour[1:] = intervals[:-1]
    neighbour[:-1] = np.minimum(neighbour[:-1], intervals[1:])
    return intervals > WIDEST_STEP * neighbour


def require_damping(design):
    """Raise a DesignError if a design has no exact spectrum.

    With a loss-free spring on the ground there is a frequency at which waves never die along the track.

    Parameters
    ----------
    design : TrackDesign
        The track.

    Raises
    ------
    DesignError
        If the spring that stands on the ground has no loss.
    """
    pad, boot = laws(design)
    if not (boot or pad).strengths:
        field, value = _grounded_loss(design)
        raise DesignError(field, value, "more than 0: without loss the exact spectrum has no bound")


def _grounded_loss(design):
    """Return name and value of the loss factor of the spring that stands on the ground."""
    field = "boot_loss_factor" if design.two_stage else "pad_loss_factor"
    return field, getattr(design, field)


def band_frequencies(loaded_track):
    """Return frequencies from which a spectrum over all bands may be refined.

    Parameters
    ----------
    loaded_track : float
        Loaded-track frequency, at a tenth of which the line is anchored [Hz].

    Returns
    -------
    numpy.ndarray (frequencies,)
        Frequencies [Hz], ascending, among them every band edge and the anchor if it lies below the bands.
    """
    anchor = LINE_FRACTION * loaded_track
    between = np.geomspace(BAND_EDGES[0], BAND_EDGES[-1], 12 * (len(BAND_EDGES) - 1) + 1)
    below = [anchor, *np.geomspace(anchor, BAND_EDGES[0], 12)[1:-1]] if anchor < BAND_EDGES[0] else []
    return np.concatenate([below, between])


def banded_spectrum(design, loaded_track, lattice=INFINITE, step=DEFAULT_STEP):
    """Return the exact spectrum over all one-third-octave bands, and down to where the line is anchored.

    Parameters
    ----------
    design : TrackDesign
        The track and its wheel.
    loaded_track : float
        Its loaded-track frequency [Hz].
    lattice : Lattice
        What to solve.
    step : float
        Height of the step [m].

    Returns
    -------
    ForceSpectrum
        Energy at frequencies that resolve every peak and include every band edge.

    Raises
    ------
    DesignError
        If the spectrum cannot be told from rounding, as with next to no loss.
    """
    spectrum = resolved_spectrum(design, band_frequencies(loaded_track), step, lattice)
    if not ((spectrum.energy > 0) & np.isfinite(spectrum.energy)).all():
        field, value = _grounded_loss(design)
        raise DesignError(field, value, "more loss: rounding drowns the exact spectrum of this design")
    return spectrum
