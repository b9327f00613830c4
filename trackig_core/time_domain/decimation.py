"""The low-pass filter that precedes every thinning out of a record.

A step of roughness rings the rail far above the bands, and on a stiff track that content is orders of
magnitude above the force at 5 Hz: it would fold down onto it. The filter has two stages, a comb that
the kernel applies as it steps, and a sharp filter on what the comb keeps. Its response below the pass band
is known exactly, and divided out of every spectrum. Hz and s.
"""

from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np
from scipy.signal import firwin, kaiserord

from trackig_core.arrays import RealArray

RECORD_RATE = 4096.0
"""Samples a second that are kept of each force after low-passing [Hz]."""

PASS_BAND = 600.0
"""Frequency up to which the record is kept unaliased [Hz]: above the top edge of the 500 Hz band, 562 Hz."""

STOP_BAND_ATTENUATION = 150.0
"""Attenuation of all that could fold down below :data:`PASS_BAND` [dB]."""

COMB_RATE = 32768.0
"""Rate below which the record is not halved by a comb [Hz]: half of it lies well above :data:`PASS_BAND`."""

COMB_ORDER = 4
"""Zeros that a comb puts on each frequency that halving the rate would fold onto 0 Hz [-]; around them,
:data:`PASS_BAND` wide, it attenuates by 123 dB or more at the paper's rate."""

NO_COMB = np.array([1.0, 0.0, 0.0, 0.0])
"""The comb that lets every row pass as it is."""


@dataclass(frozen=True, eq=False)
class LowPass:
    """The filter of one time step.

    Attributes
    ----------
    time_step : float [s]
        Time step of the run.
    comb : numpy.ndarray (comb_taps,) [-]
        Coefficients of the first stage, newest row first, with zeros to a multiple of four.
    comb_factor : int
        Time steps per row that the first stage keeps.
    taps : numpy.ndarray (taps,) [-]
        Symmetric coefficients of the second stage, a multiple of four of them.
    factor : int
        Rows of the first stage per sample that the second keeps.
    """

    time_step: float
    comb: RealArray
    comb_factor: int
    taps: RealArray
    factor: int

    @property
    def steps_per_sample(self) -> int:
        """Time steps between decimated samples."""
        return self.comb_factor * self.factor

    @cached_property
    def whole(self) -> RealArray:
        """Symmetric coefficients of both stages in one, at full rate; unit gain at 0 Hz (all_taps,) [-]."""
        spread = np.zeros((self.taps.size - 1) * self.comb_factor + 1)
        spread[:: self.comb_factor] = self.taps
        return np.convolve(np.trim_zeros(self.comb, "b"), spread)

    def times(self, samples: int) -> RealArray:
        """Return the time that each sample stands for (samples,) [s]: the filter's centre."""
        newest = np.arange(samples, dtype=np.float64) * self.steps_per_sample + self.comb_factor - 1
        return (newest - (self.whole.size - 1) / 2) * self.time_step

    def gain(self, frequency: RealArray) -> RealArray:
        """Return the magnitude of the filter's frequency response.

        Parameters
        ----------
        frequency : numpy.ndarray (frequencies,)
            Frequencies [Hz].

        Returns
        -------
        numpy.ndarray (frequencies,)
            Gain [-].
        """
        comb = np.trim_zeros(self.comb, "b")
        first = _symmetric_gain(comb, 2 * np.pi * self.time_step * frequency)
        return first * _symmetric_gain(self.taps, 2 * np.pi * self.time_step * self.comb_factor * frequency)


def _symmetric_gain(taps: RealArray, angle: RealArray) -> RealArray:
    """Return the response of symmetric coefficients (taps,) at angles per sample (frequencies,) [rad]."""
    half = taps.size // 2
    from_centre = np.arange(half) - (taps.size - 1) / 2
    middle = taps[half] if taps.size % 2 else 0.0
    return np.abs(2 * np.cos(np.outer(angle, from_centre)) @ taps[:half] + middle)


@lru_cache(maxsize=64)
def low_pass(time_step: float) -> LowPass:
    """Return the filter that precedes decimation to :data:`RECORD_RATE`.

    Parameters
    ----------
    time_step : float
        Time step of the run [s].

    Returns
    -------
    LowPass
        Both stages; the second is a Kaiser window's.
    """
    steps = max(1, round(1 / (time_step * RECORD_RATE)))
    comb, halved = np.ones(1), 1
    while steps % (2 * halved) == 0 and 1 / (time_step * 2 * halved) >= COMB_RATE:
        pair = np.zeros(halved + 1)
        pair[[0, -1]] = 0.5
        for _ in range(COMB_ORDER):
            comb = np.convolve(comb, pair)
        halved *= 2
    rate, factor = 1 / (time_step * halved), steps // halved
    stop = rate / factor - PASS_BAND
    count, beta = kaiserord(STOP_BAND_ATTENUATION, (stop - PASS_BAND) / (rate / 2))
    count += -count % 4
    taps = firwin(count, (PASS_BAND + stop) / 2, window=("kaiser", beta), fs=rate)
    return LowPass(time_step, np.pad(comb, (0, -comb.size % 4)), halved, taps, factor)
