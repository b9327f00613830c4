"""From force records to the energy spectrum of the force into the ground.

N2 s2 over Hz. The one normalisation: F(f) = dt * sum_n F_n exp(-i 2 pi f n dt), the Fourier integral
of the record, so that a spectrum does not depend on the record's length or rate.

Source: the paper (see :mod:`trackig_core.design`): energy is summed over the supports, not force.
The one rule: nothing is said above the low-pass filter's pass band.
"""

import numpy as np
from scipy.fft import rfft

from trackig_core.results import ForceSpectrum

TOP_FREQUENCY = 600.0
"""Highest frequency of a spectrum [Hz]: above the upper edge of the 500 Hz band, 562 Hz."""


def force_spectrum(history):
    """Return the energy spectrum of a run, corrected for the low-pass filter's own response.

    Parameters
    ----------
    history : TimeHistory
        Record of the run.

    Returns
    -------
    ForceSpectrum
        At multiples of one over the record's length, up to 600 Hz.
    """
    frequency, interval = _axis(history)
    correction = (interval / filter_gain(history.low_pass, history.time_step, frequency)) ** 2

    energy = np.zeros(len(frequency))
    total = np.zeros(len(frequency), dtype=complex)
    # A few supports at a time, so that the transforms stay small beside the record itself.
    for first in range(0, history.multiplicity.size, 32):
        some = slice(first, first + 32)
        forces = np.ascontiguousarray(history.support_force[:, some].T)
        transforms = rfft(forces, axis=1)[:, 1 : len(frequency) + 1]
        energy += history.multiplicity[some] @ (transforms.real**2 + transforms.imag**2)
        total += history.multiplicity[some] @ transforms
    return ForceSpectrum(
        frequency=frequency,
        energy=correction * energy,
        coherent_energy=correction * np.abs(total) ** 2,
        step=history.step,
    )


def block_to_rail(history):
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
    frequency, _ = _axis(history)
    some = slice(1, len(frequency) + 1)
    return frequency, np.abs(rfft(history.block_displacement)[some] / rfft(history.rail_displacement)[some])


def _axis(history):
    """Return the frequencies of a record's transform up to 600 Hz, zero left out, and its interval [s]."""
    samples = len(history.time)
    interval = (history.time[-1] - history.time[0]) / (samples - 1)
    count = int(TOP_FREQUENCY * samples * interval) + 1
    return np.arange(1, count) / (samples * interval), interval


def filter_gain(taps, time_step, frequency):
    """Return the magnitude of a filter's frequency response.

    Parameters
    ----------
    taps : numpy.ndarray (taps,)
        Symmetric coefficients [-].
    time_step : float
        Interval between taps [s].
    frequency : numpy.ndarray (frequencies,)
        Frequencies [Hz].

    Returns
    -------
    numpy.ndarray (frequencies,)
        Gain [-].
    """
    from_centre = np.arange(taps.size) - (taps.size - 1) / 2
    return np.cos(2 * np.pi * time_step * np.outer(frequency, from_centre)) @ taps
