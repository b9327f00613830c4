"""The cheapest run that is still right: grids for insertion gain that follows the hand.

The frequency-domain solution gives the exact answer of any grid before a step is taken: the z-transform of
the scheme, on the ring, in closed form. So a grid is not guessed but tried: the time step is the longest that
is stable, the ring just long enough for its waves to die on the way round, and where the two together would
move any band by more than :data:`BUDGET`, whichever is at fault is refined. The frequency-domain solution
chooses the grid, never the answer. Hz, s, dB. The scheme is the paper's (see
:mod:`trackig_core.track.design`) with the second-order memory of the damping.
"""

import math
from dataclasses import dataclass

import numpy as np
from scipy.fft import rfft

from trackig_core.arrays import AnyArray, IntArray, RealArray
from trackig_core.bands import BAND_EDGES, LINE_FRACTION, decibels
from trackig_core.frequency_domain import batch_kernels
from trackig_core.frequency_domain.floquet_waves import waves
from trackig_core.frequency_domain.lattice import INFINITE, Lattice
from trackig_core.frequency_domain.natural_frequencies import loaded_track
from trackig_core.frequency_domain.refinement import banded_spectrum
from trackig_core.frequency_domain.track_model import Track, TrackModel, track_model
from trackig_core.time_domain.decimation import RECORD_RATE
from trackig_core.time_domain.grid import FEWEST_BAYS, Grid, fewest_bays, make_grid, stable_time_step

BUDGET = 0.035
"""Error of insertion gain that time step and ring may make in any band [dB]; the rest of the 0.05 dB that are
promised is left to the end of the record and the integration over the bands."""

MEMORY_ORDER = 2
"""Rule of the damping memory: second order allows a step several times the paper's."""

WINDOW = 384 / RECORD_RATE
"""Length of the parts by which the record grows [s], some 0.1 s: half a period at 5 Hz."""

TAIL = 1e-3
"""Energy that what is still to come may add to a band, over twice the band's own, at which a record ends [-]:
0.01 dB."""

DECAY_PARTS = 2
"""Parts over which the decay of a record's spectrum is judged [-]: beats even out."""

PADDING = 2
"""Length of the transform in parts of the record [-]: a record that ends soon has too few frequencies."""

FEWEST_STEPS = 5
"""Least number of time steps per sample of the record [-]: 20480 a second keep most tracks within budget."""

STABLE_SHARE = 0.999
"""Part of the longest stable time step that is used at most [-]."""

WAVE_LEFT = 0.06
"""Amplitude with which the longest-lived wave may arrive after one round, on the first trial [-]."""

FIRST_BAYS = 151
"""Supports around the ring on the first trial, at most [-]: light damping rarely asks for as many as
:data:`WAVE_LEFT` would."""

MOST_BAYS = 6001
"""Supports around the ring, at most [-]."""

MOST_TRIALS = 12
"""Grids tried before the last one is taken as it is [-]."""

REFINEMENT = 1.6
"""By what factor a ring that is too short is made longer [-]."""

_FREQUENCIES = np.geomspace(BAND_EDGES[0], BAND_EDGES[-1], 121)
"""Frequencies at which waves are asked how long they live [Hz]: six per band."""


@dataclass(frozen=True)
class Plan:
    """A grid, and what it costs in accuracy.

    Attributes
    ----------
    grid : Grid
        The grid.
    error : float [dB]
        Largest error of insertion gain in any band that time step and ring make.
    """

    grid: Grid
    error: float


def plan(design: Track) -> Plan:
    """Choose the cheapest grid whose insertion gain stays within :data:`BUDGET` of the exact answer.

    Parameters
    ----------
    design : TrackDesign or TrackModel
        The track.

    Returns
    -------
    Plan
        The grid, and its error; the error exceeds the budget only if no grid that may be used keeps it.

    Raises
    ------
    DesignError
        If the exact answer has no bound, for want of any loss.
    RunTooLargeError
        If the run would need more than 2 GB or 60 s.
    """
    model = track_model(design)
    exact = _bands_over_line(model, INFINITE)

    def error(bays: int | None, steps: int) -> float:
        lattice = Lattice(bays=bays, time_step=1 / (steps * RECORD_RATE), memory_order=MEMORY_ORDER)
        return float(np.abs(decibels(_bands_over_line(model, lattice) / exact)).max())

    dx = model.design.fastener_spacing / INFINITE.elements_per_bay
    stable = STABLE_SHARE * stable_time_step(model, dx)
    steps = max(FEWEST_STEPS, math.ceil(1 / (stable * RECORD_RATE)))
    bays = max(fewest_bays(model), min(FIRST_BAYS, odd(bays_until(model, WAVE_LEFT))))
    for _ in range(MOST_TRIALS):
        whole = error(bays, steps)
        if whole <= BUDGET:
            break
        of_step = error(None, steps)
        if of_step > BUDGET / 2:
            # second order: half the step makes a quarter of the error
            steps = math.ceil(steps * math.sqrt(of_step / (0.4 * BUDGET)))
        elif bays < MOST_BAYS:
            bays = min(MOST_BAYS, odd(REFINEMENT * bays))
        else:
            break
    return Plan(make_grid(model, 1 / (steps * RECORD_RATE), bays=bays, record=WINDOW), whole)


def odd(bays: float) -> int:
    """Return the least odd whole number from ``bays`` on, and enough of them for a grid."""
    return max(FEWEST_BAYS, 2 * math.ceil((bays - 1) / 2) + 1)


def bays_until(design: Track, amplitude: float) -> float:
    """Return how many bays away every wave from 5 to 500 Hz has decayed to an amplitude.

    Parameters
    ----------
    design : TrackDesign or TrackModel
        The track.
    amplitude : float
        Amplitude over that at the start [-].

    Returns
    -------
    float
        Number of bays, not rounded.
    """
    longest = np.abs(waves(design, _FREQUENCIES).multipliers).max()
    return math.log(amplitude) / math.log(longest)


def _bands_over_line(model: TrackModel, lattice: Lattice) -> RealArray:
    """Return the energy of every band over the height of the straight line (21,)."""
    spectrum = banded_spectrum(model, lattice)
    frequency, (slopes, factors) = spectrum.frequency, np.empty((2, spectrum.frequency.size))
    bands, first = np.empty(len(BAND_EDGES) - 1), int(np.searchsorted(frequency, BAND_EDGES[0]))
    batch_kernels.band_integrals(
        frequency, spectrum.energy, frequency.size, first, BAND_EDGES, slopes, factors, bands
    )
    anchor = np.clip(LINE_FRACTION * loaded_track(model), frequency[0], frequency[-1])
    # E grows as f^2 here: E / f^2 is nearly flat
    return bands / np.interp(anchor, frequency, spectrum.energy / frequency**2)


class Settled:
    """When a live record may end: what is still to come adds next to nothing to the energy of any band.

    The spectrum of each part is added to that of the parts before, at multiples of half the inverse of a
    part's length, so that every other one changes sign from part to part. Its decay over the last parts
    tells how much is left. What rings on above the bands, between supports, does not count, and a quiet band
    counts as much as a loud one.
    """

    def __init__(self) -> None:
        self._whole: AnyArray = np.zeros(1)
        self._energies: list[RealArray] = []

    def reached(self, forces: RealArray) -> bool:
        """Return whether a record may end.

        Parameters
        ----------
        forces : numpy.ndarray (samples, supports)
            The latest part of the record [N], :data:`WINDOW` long.
        """
        part = rfft(forces, 2 * len(forces), axis=0)[1 : _NEAR[-1, 1] + 1]
        if len(self._energies) % 2:
            part[::2] *= -1
        self._whole = self._whole + part
        self._energies.append(_energy(part))
        if len(self._energies) <= DECAY_PARTS:
            return False
        before, last, whole = self._energies[-1 - DECAY_PARTS], self._energies[-1], _energy(self._whole)
        decay = np.minimum((last / before) ** (0.5 / DECAY_PARTS), 1 - 1e-9)
        to_come = np.sqrt(last) * decay / (1 - decay)
        # |F + R|^2 exceeds |F|^2 by no more than 2 |F| |R|, and |R|^2, which is small beside it
        return bool((_near(np.sqrt(whole) * to_come) <= TAIL * _near(whole)).all())

    def more(self, steps_done: int) -> int:
        """Return how many steps a record that may not end is made longer by."""
        return steps_done // len(self._energies)


def _energy(transforms: AnyArray) -> RealArray:
    """Return the energy over the half ring's supports (frequencies,)."""
    energy: RealArray = np.sum(transforms.real**2 + transforms.imag**2, axis=1)
    return energy


def _near(density: RealArray) -> RealArray:
    """Return the sums of a density (frequencies,) over a band's width around each frequency."""
    running = np.concatenate([[0.0], np.cumsum(density)])
    return running[_NEAR[:, 1]] - running[_NEAR[:, 0]]


def _neighbours() -> IntArray:
    """Return first and last (excluded) of the frequencies near each: half a band, or the next ones."""
    numbers = np.arange(1, round(2 * WINDOW * BAND_EDGES[-1]) + 1)
    half_width = 10**0.05
    first = np.minimum(np.ceil(numbers / half_width), numbers - 1).astype(int) - 1
    last = np.maximum(np.floor(numbers * half_width), numbers + 1).astype(int)
    return np.stack([np.maximum(first, 0), np.minimum(last, numbers[-1])], axis=1)


_NEAR = _neighbours()
"""Which multiples of half the inverse of a part's length make a band around each of them."""
