"""From force records to the energy spectrum of the force into the ground.

N2 s2 over Hz. The one normalisation: F(f) = dt * sum_n F_n exp(-i 2 pi f n dt), the Fourier integral
of the record, so that a spectrum does not depend on the record's length or rate.

Source: the paper (see :mod:`trackig_core.track.design`): energy is summed over the supports, not force.
Nothing is said above the low-pass filter's pass band.
"""

from functools import lru_cache

import numpy as np
from scipy.fft import next_fast_len, rfft

from trackig_core.arrays import RealArray
from trackig_core.results import ForceSpectrum, TimeHistory
from trackig_core.time_domain.decimation import LowPass

TOP_FREQUENCY = 600.0
"""Highest frequency of a spectrum [Hz]: above the upper edge of the 500 Hz band, 562 Hz."""

POINTS_PER_FRINGE = 8
"""Frequencies per fringe that wheels put on a spectrum as they follow each other, at least [-]."""

COLUMNS = 8
"""Supports that are transformed at a time [-]: few enough that memory is used again, not asked for anew."""


def force_spectrum(
    history: TimeHistory, padding: float = 1, like: TimeHistory | None = None
) -> ForceSpectrum:
    """Return the energy spectrum of a run, corrected for the low-pass filter's own response.

    Parameters
    ----------
    history : TimeHistory
        Record of the run.
    padding : float
        Length of the transform in parts of the record [-], which zeros make longer: a force that has died
        down stays so. It is longer yet where wheels follow each other so late that fringes need it.

    like : TimeHistory, optional
        Record of another run of the same grid, whose frequencies are taken.

    Returns
    -------
    ForceSpectrum
        At multiples of one over the transform's length, up to 600 Hz.
    """
    low_pass, model = history.low_pass, history if like is None else like
    record = len(model.time) * low_pass.steps_per_sample * low_pass.time_step
    length = transform_length(model, max(padding, POINTS_PER_FRINGE * model.last_onset / record))
    frequency = _axis(low_pass, length)
    correction = _correction(low_pass, length)

    # Plain sums: a product of matrices would be shared among threads, which wait for each other when other
    # solves keep the cores busy.
    energy = np.zeros(len(frequency))
    total = np.zeros(len(frequency), dtype=complex)
    for first in range(0, history.multiplicity.size, COLUMNS):
        some = slice(first, first + COLUMNS)
        forces = _folded(history.support_force[:, some].T, length)
        transforms = rfft(forces, length, axis=1)[:, 1 : len(frequency) + 1]
        share = history.multiplicity[some, None]
        energy += np.sum(share * (transforms.real**2 + transforms.imag**2), axis=0)
        total += np.sum(share * transforms, axis=0)
    return ForceSpectrum(
        frequency=frequency,
        energy=correction * energy,
        coherent_energy=correction * np.abs(total) ** 2,
        step=history.step,
    )


def _folded(forces: RealArray, length: int) -> RealArray:
    """Return a record (columns, samples) that is no longer than a transform, which is none the wiser."""
    columns, samples = forces.shape
    if samples <= length:
        return np.ascontiguousarray(forces)
    turns = -(-samples // length)
    whole = np.zeros((columns, turns * length))
    whole[:, :samples] = forces
    return whole.reshape(columns, turns, length).sum(axis=1)


def transform_length(history: TimeHistory, padding: float) -> int:
    """Return the number of samples of a transform: ``padding`` times the record's, or a little more."""
    samples = len(history.time)
    return samples if padding == 1 else int(next_fast_len(round(padding * samples), real=True))


def block_to_rail(history: TimeHistory) -> tuple[RealArray, RealArray]:
    """Return how much the block moves per movement of the rail, at the loaded support.

    Parameters
    ----------
    history : TimeHistory
        Record of a two-stage run.

    Returns
    -------
    frequency : numpy.ndarray (frequencies,)
        Frequencies [Hz], up to 600 Hz.
    ratio : numpy.ndarray (frequencies,)
        Magnitude of block over rail displacement [-]; the low-pass filter's response cancels.
    """
    frequency = _axis(history.low_pass, len(history.time))
    some = slice(1, len(frequency) + 1)
    return frequency, np.abs(rfft(history.block_displacement)[some] / rfft(history.rail_displacement)[some])


def _axis(low_pass: LowPass, length: int) -> RealArray:
    """Return the frequencies of a transform up to 600 Hz, zero left out [Hz]."""
    interval = low_pass.steps_per_sample * low_pass.time_step
    return np.arange(1, int(TOP_FREQUENCY * length * interval) + 1) / (length * interval)


@lru_cache(maxsize=64)
def _correction(low_pass: LowPass, length: int) -> RealArray:
    """Return what makes a squared transform an energy (frequencies,) [s2], the filter's response divided out.

    The same few filters and lengths come back with every run.
    """
    interval = low_pass.steps_per_sample * low_pass.time_step
    return (interval / low_pass.gain(_axis(low_pass, length))) ** 2
