"""Spectra and insertion gain over the bands, on a frequency axis that is refined until it shows every peak.

Hz, N2 s2 and dB. Source of the model: the paper (see :mod:`trackig_core.track.design`); the lattice is
solved by :mod:`trackig_core.frequency_domain.floquet_waves`.
"""

from collections.abc import Callable
from functools import lru_cache

import numpy as np

from trackig_core.arrays import BoolArray, RealArray
from trackig_core.bands import LINE_FRACTION, ONE_THIRD_OCTAVES, Bands
from trackig_core.frequency_domain import batch_kernels
from trackig_core.frequency_domain.batch_kernels import (
    MOST_FREQUENCIES,
    MOST_HALVINGS,
    STRAIGHTNESS,
    WIDEST_STEP,
)
from trackig_core.frequency_domain.floquet_waves import exact_spectrum
from trackig_core.frequency_domain.kernel_rows import recursion_row
from trackig_core.frequency_domain.lattice import INFINITE, Lattice
from trackig_core.frequency_domain.natural_frequencies import loaded_track
from trackig_core.frequency_domain.track_model import Track, TrackModel, track_model
from trackig_core.levels.insertion_gain import insertion_gain
from trackig_core.results import ForceSpectrum, InsertionGain
from trackig_core.track.design import DEFAULT_STEP, DesignError


def resolved_spectrum(
    design: Track, frequency: RealArray, step: float, lattice: Lattice = INFINITE
) -> ForceSpectrum:
    """Return a track's spectrum on a frequency axis that is refined until it shows every peak.

    Parameters
    ----------
    design : TrackDesign or TrackModel
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
    model = track_model(design)
    if model.causal and _is_compiled(lattice):
        axis, energy, coherent_energy = batch_kernels.resolve_row(
            model.row, *_stepping(model, lattice), frequency
        )
        return ForceSpectrum(axis, energy * step**2, coherent_energy * step**2, step)
    return refined_spectrum(lambda between: exact_spectrum(model, between, step, lattice), frequency)


def _is_compiled(lattice: Lattice) -> bool:
    """Return whether a lattice is refined by compiled code: those of bending rails, but for study only."""
    if lattice.rail != "euler" or lattice.elements_per_bay != batch_kernels.ELEMENTS_PER_BAY:
        return False
    ring_in_continuous_time = lattice.bays is not None and lattice.time_step is None
    return not ring_in_continuous_time


def _stepping(model: TrackModel, lattice: Lattice) -> tuple[RealArray, float, int]:
    """Return recursions, time step and ring as compiled code takes them."""
    if lattice.time_step is None:
        return np.zeros((2, 7)), 0.0, 0
    rows = [recursion_row(law, lattice.time_step, lattice.memory_order) for law in (model.pad, model.boot)]
    return np.stack(rows), lattice.time_step, lattice.bays or 0


def refined_spectrum(
    spectrum_at: Callable[[RealArray], ForceSpectrum], frequency: RealArray
) -> ForceSpectrum:
    """Return any model's spectrum on a frequency axis that is refined until it shows every peak.

    Intervals are halved until a straight line between neighbours, in decibels, misses the spectrum
    by no more than ``STRAIGHTNESS``, and no interval is more than ``WIDEST_STEP`` times as wide as
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
        with np.errstate(invalid="ignore", divide="ignore"):  # energies that rounding drowns; reported below
            bend = np.abs(np.log(ratio)).max(axis=0)
        straight[halved] = ~(bend > 2 * STRAIGHTNESS / 10 * np.log(10))
        straight = np.insert(straight, halved, straight[halved])
        rows = np.insert(rows, halved + 1, middle, axis=1)
        straight &= ~_too_wide(np.diff(rows[0]))
        if straight.all() or rows.shape[1] > MOST_FREQUENCIES:
            break
    return ForceSpectrum(frequency=rows[0], energy=rows[1], coherent_energy=rows[2], step=known.step)


def _too_wide(intervals: RealArray) -> BoolArray:
    """Return which intervals are much wider than a neighbour: a peak's flank may look straight by chance."""
    neighbour = np.full_like(intervals, np.inf)
    neighbour[1:] = intervals[:-1]
    neighbour[:-1] = np.minimum(neighbour[:-1], intervals[1:])
    return intervals > WIDEST_STEP * neighbour


def require_damping(design: Track) -> None:
    """Raise a DesignError if a design has no exact spectrum.

    With a loss-free spring on the ground there is a frequency at which waves never die along the track.

    Parameters
    ----------
    design : TrackDesign or TrackModel
        The track.

    Raises
    ------
    DesignError
        If the spring that stands on the ground has no loss.
    """
    model = track_model(design)
    if model.springs[-1].lossless:
        field, value = _grounded_loss(model)
        raise DesignError(field, value, "more than 0: without loss the exact spectrum has no bound")


def _grounded_loss(model: TrackModel) -> tuple[str, object]:
    """Return name and value of the loss factor of the spring that stands on the ground."""
    field = "boot_loss_factor" if model.design.two_stage else "pad_loss_factor"
    return field, getattr(model.design, field)


def band_frequencies(lowest: float, bands: Bands = ONE_THIRD_OCTAVES) -> RealArray:
    """Return frequencies from which a spectrum over all bands may be refined.

    Parameters
    ----------
    lowest : float
        Loaded-track frequency, at a tenth of which the line is anchored [Hz].
    bands : Bands
        One-third octaves that the spectrum has to cover.

    Returns
    -------
    numpy.ndarray (frequencies,)
        Frequencies [Hz], ascending, among them every band edge and the anchor if it lies below the bands.
    """
    anchor = LINE_FRACTION * lowest
    low, over = bands.edges[0], _over(bands)
    return over if anchor >= low else np.concatenate([np.geomspace(anchor, low, 12)[:-1], over])


@lru_cache(maxsize=8)
def _over(bands: Bands) -> RealArray:
    """Return frequencies from which a spectrum over bands is refined [Hz], among them every band edge."""
    return np.geomspace(bands.edges[0], bands.edges[-1], 12 * (len(bands.edges) - 1) + 1)


def banded_spectrum(
    design: Track,
    lattice: Lattice = INFINITE,
    step: float = DEFAULT_STEP,
    bands: Bands = ONE_THIRD_OCTAVES,
) -> ForceSpectrum:
    """Return the spectrum over all one-third-octave bands, and down to where the line is anchored.

    Parameters
    ----------
    design : TrackDesign or TrackModel
        The track and its wheel.
    lattice : Lattice
        What to solve.
    step : float
        Height of the step [m].
    bands : Bands
        One-third octaves to cover.

    Returns
    -------
    ForceSpectrum
        Energy at frequencies that resolve every peak and include every band edge.

    Raises
    ------
    DesignError
        If the spring on the ground has no loss, or so little that the spectrum cannot be told from rounding.
    """
    model = track_model(design)
    require_damping(model)
    spectrum = resolved_spectrum(model, band_frequencies(loaded_track(model), bands), step, lattice)
    if not ((spectrum.energy > 0) & np.isfinite(spectrum.energy)).all():
        field, value = _grounded_loss(model)
        raise DesignError(field, value, "more loss: rounding drowns the exact spectrum of this design")
    return spectrum


def banded_gain(
    design: Track, lattice: Lattice = INFINITE, reference: str = "line", summation: str = "energy"
) -> InsertionGain:
    """Return the insertion gain of a track by the frequency-domain solution.

    Parameters
    ----------
    design : TrackDesign or TrackModel
        The track and its wheel.
    lattice : Lattice
        What to solve.
    reference, summation : str
        As for :func:`trackig_core.insertion_gain`.

    Returns
    -------
    InsertionGain
        Levels and the energies behind them.

    Raises
    ------
    DesignError
        As for :func:`banded_spectrum`.
    ValueError
        If ``reference`` or ``summation`` is not one of the choices.
    """
    model = track_model(design)
    spectrum = banded_spectrum(model, lattice)
    return insertion_gain(spectrum, model.design, loaded_track(model), reference, summation)
