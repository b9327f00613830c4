"""The seam between design and kernel: run the time stepping and keep its low-passed record.

SI units. Rest until time zero, then a step squeezes the contact spring (the paper, see
:mod:`trackig_core.design`). Each block of steps is low-passed before it is decimated, because on a
stiff track the ringing far above 500 Hz is orders of magnitude stronger than the force at 5 Hz and
would fold down onto it.

The one rule: nothing that is not finite leaves this module.
"""

from functools import lru_cache
from typing import NamedTuple

import numpy as np
from scipy.signal import firwin, kaiserord

from trackig_core import kernel
from trackig_core.design import DEFAULT_STEP
from trackig_core.grid import LONGEST_RECORD, RECORD_RATE
from trackig_core.kernel import LANES
from trackig_core.layout import GHOSTS, QUANTITIES, Layout, aligned_zeros
from trackig_core.relaxation import laws
from trackig_core.results import TimeHistory

PASS_BAND = 600.0
"""Frequency up to which the record is kept unaliased [Hz]: above the top edge of the 500 Hz band, 562 Hz."""

STOP_BAND_ATTENUATION = 150.0
"""Attenuation of all that could fold down below :data:`PASS_BAND` [dB]."""

DECAY = 1e-4
"""Amplitude, relative to its peak, below which a force has died down [-]: 80 dB."""

DECAY_WINDOW = 0.1
"""Last part of the record in which the force must stay below :data:`DECAY` [s]: half a period at 5 Hz."""

COMB_RATE = 32768.0
"""Rate below which the record is not halved by a comb [Hz]: half of it lies well above :data:`PASS_BAND`."""

COMB_ORDER = 4
"""Zeros that a comb puts on each frequency that halving the rate would fold onto 0 Hz [-]; around them,
:data:`PASS_BAND` wide, it attenuates by 123 dB or more at the paper's rate."""

BLOCK_SAMPLES = 16
"""Decimated samples per call of the kernel: their rows stay in the second-level cache until they are
filtered, and ``cancelled`` is asked every few milliseconds."""


NO_COMB = np.array([1.0, 0.0, 0.0, 0.0])
"""The comb that lets every row pass as it is."""

DOUBLED = 2.0
"""By what factor the paper's record is made longer while the force has not died down [-]."""


class SolveCancelled(Exception):  # noqa: N818  (it is no error: the caller asked for it)
    """The caller cancelled the run."""


class LowPass(NamedTuple):
    """The filter that precedes decimation, in two stages: a cheap comb at full rate, then a sharp filter.

    Attributes
    ----------
    comb : numpy.ndarray (comb_taps,) [-]
        Coefficients of the first stage, newest row first, with zeros to a multiple of four.
    comb_factor : int
        Time steps per row that the first stage keeps.
    taps : numpy.ndarray (taps,) [-]
        Symmetric coefficients of the second stage, a multiple of four of them.
    factor : int
        Rows of the first stage per sample that the second keeps.
    whole : numpy.ndarray [-]
        Symmetric coefficients of both in one, at full rate; unit gain at 0 Hz.
    """

    comb: np.ndarray
    comb_factor: int
    taps: np.ndarray
    factor: int
    whole: np.ndarray


@lru_cache(maxsize=64)
def low_pass(time_step):
    """Return the filter that precedes decimation to :data:`~trackig_core.grid.RECORD_RATE`.

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
    spread = np.zeros((count - 1) * halved + 1)
    spread[::halved] = taps
    return LowPass(np.pad(comb, (0, -comb.size % 4)), halved, taps, factor, np.convolve(comb, spread))


def simulate(
    design, grid, *, memory_order=1, step=DEFAULT_STEP, growth=DOUBLED, progress=None, cancelled=None
):
    """Step a design through time until the force into the ground has died down.

    The record is made longer, up to 16 s, until the low-passed force has decayed by 80 dB.

    Parameters
    ----------
    design : TrackDesign
        The track.
    grid : Grid
        Its grid.
    memory_order : int
        1 for the paper's recursion of the damping memory, 2 for the second-order one.
    step : float
        Step that squeezes the contact spring [m].
    growth : float
        By what factor a record that is too short is made longer [-].
    progress : callable, optional
        Called now and then with the fraction done, 0 to 1. The first record counts for half of it, the
        first extension for half of the rest, and so on, since nobody knows how many there will be.
    cancelled : callable, optional
        Asked now and then; the run ends when it answers true.

    Returns
    -------
    TimeHistory
        Low-passed, decimated record of the forces.

    Raises
    ------
    SolveCancelled
        If ``cancelled`` answered true.
    FloatingPointError
        If the run produced a value that is not finite.
    """
    run = _Run(design, grid, memory_order, step)
    samples = run.collect(grid.steps, progress, cancelled)
    while not (decayed := _has_decayed(samples[:, : grid.half_bays])):
        record = growth * run.steps_done * grid.dt
        if record > LONGEST_RECORD or not grid.can_afford(record):
            break
        more = round((growth - 1) * run.steps_done)
        samples = np.concatenate([samples, run.collect(more, progress, cancelled)])
    if progress is not None:
        progress(1.0)

    supports = grid.half_bays
    multiplicity = np.full(supports, 2.0)
    multiplicity[0] = 1.0
    return TimeHistory(
        time=run.sample_times(len(samples)),
        support_force=samples[:, :supports],
        multiplicity=multiplicity,
        wheel_displacement=samples[:, supports],
        rail_displacement=samples[:, supports + 1],
        block_displacement=samples[:, supports + 2] if design.two_stage else None,
        low_pass=run.filter.whole,
        time_step=grid.dt,
        step=step,
        steps=run.steps_done,
        decayed=decayed,
    )


def _has_decayed(forces):
    """Return whether the forces (samples, supports) at their end are 80 dB below their peak."""
    window = max(1, round(DECAY_WINDOW * RECORD_RATE))
    return bool(np.abs(forces[-window:]).max() <= DECAY * np.abs(forces).max())


class State(NamedTuple):
    """What the kernel changes from step to step, in the order in which it takes it."""

    rail: np.ndarray
    rail_velocity: np.ndarray
    supports: np.ndarray
    wheel: np.ndarray
    window: np.ndarray


class Constants(NamedTuple):
    """What the kernel is given and leaves alone, in the order in which it takes it."""

    mirrors: np.ndarray
    rail_probes: np.ndarray
    block_probes: np.ndarray
    time_step: float
    bending: float
    pad_stiffness: float
    pad_decay: np.ndarray
    pad_gain: np.ndarray
    boot_stiffness: float
    boot_decay: np.ndarray
    boot_gain: np.ndarray
    element_mass: float
    block_mass: float
    wheel_mass: float
    contact_stiffness: float
    two_stage: bool
    comb: np.ndarray
    comb_factor: int


TERMS = 3
"""Memory terms of a spring in the kernel [-]; those that a spring without loss has not are zero."""

PROBES = 3
"""Displacements that are recorded beside the forces: wheel, rail and block at the loaded support."""


def at_rest(design, grid, *, memory_order=1, step=DEFAULT_STEP, comb=NO_COMB, comb_factor=1):
    """Return a track at rest under a wheel that squeezes its contact spring.

    Parameters
    ----------
    design : TrackDesign
        The track.
    grid : Grid
        Its grid.
    memory_order : int
        1 for the paper's recursion of the damping memory, 2 for the second-order one.
    step : float
        Displacement of the wheel against the contact spring [m].
    comb : numpy.ndarray (taps,)
        First stage of the low-pass filter, newest first [-]; by default none.
    comb_factor : int
        Time steps per row of the record.

    Returns
    -------
    State, Constants
        Arguments of :func:`trackig_core.kernel.advance`; shapes and units are given there.
    """
    rail, layout = design.rail, Layout(grid)
    pad_law, boot_law = laws(design)
    state = State(
        rail=aligned_zeros((layout.elements + 2 * GHOSTS) * LANES),
        rail_velocity=aligned_zeros(layout.elements * LANES),
        supports=aligned_zeros(layout.bays, QUANTITIES * LANES),
        wheel=np.array([step, 0.0]),
        window=aligned_zeros(comb.size, layout.columns(PROBES)),
    )
    constants = Constants(
        layout.mirrors(),
        np.array([layout.rail_place(0)]),
        np.array([layout.block_place(0)]),
        grid.dt,
        grid.dt * rail.bending_stiffness / (rail.mass_per_metre * grid.dx**4),
        *_recursion(pad_law, grid.dt, memory_order),
        *_recursion(boot_law, grid.dt, memory_order),
        element_mass=rail.mass_per_metre * grid.dx,
        block_mass=design.block_mass if design.two_stage else 1.0,
        wheel_mass=design.wheel_mass,
        contact_stiffness=design.contact_stiffness,
        two_stage=design.two_stage,
        comb=comb,
        comb_factor=comb_factor,
    )
    return state, constants


def _recursion(law, time_step, memory_order):
    """Return stiffness, decays and gains of a spring, as many as the kernel has terms; zero for no spring."""
    if law is None:
        return 0.0, np.zeros(TERMS), np.zeros(TERMS)
    stiffness, decay, gain = law.recursion(time_step, memory_order)
    missing = (0, TERMS - decay.size)
    return stiffness, np.pad(decay, missing), np.pad(gain, missing)


class _Run:
    """One run under way: the kernel's state, and the rows that the filter still needs."""

    def __init__(self, design, grid, memory_order, step):
        self.filter = low_pass(grid.dt)
        self._state, self._constants = at_rest(
            design,
            grid,
            memory_order=memory_order,
            step=step,
            comb=self.filter.comb,
            comb_factor=self.filter.comb_factor,
        )
        self._layout = Layout(grid)
        self._dt = grid.dt
        columns = self._state.window.shape[1]
        rows = self.filter.taps.size - 1 + BLOCK_SAMPLES * self.filter.factor
        self._rows = aligned_zeros(rows, columns)
        self._kept = aligned_zeros(BLOCK_SAMPLES, columns)
        self.steps_done = 0
        self._fraction = 0.0

    @property
    def steps_per_sample(self):
        """Time steps between decimated samples."""
        return self.filter.comb_factor * self.filter.factor

    def sample_times(self, count):
        """Return the time that each decimated sample stands for [s]: the filter's centre."""
        newest = np.arange(count) * self.steps_per_sample + self.filter.comb_factor - 1
        return (newest - (self.filter.whole.size - 1) / 2) * self._dt

    def collect(self, steps, progress, cancelled):
        """Take about ``steps`` time steps and return their decimated samples, supports in order, then probes.

        Returns
        -------
        numpy.ndarray (samples, half_bays + 3)
            Forces [N]; displacements of wheel, rail and block at the loaded support [m].
        """
        count = round(steps / self.steps_per_sample)
        samples = np.empty((count, self._layout.width(PROBES)))
        began = self._fraction
        for first in range(0, count, BLOCK_SAMPLES):
            if cancelled is not None and cancelled():
                raise SolveCancelled("the run was cancelled")
            part = samples[first : first + BLOCK_SAMPLES]
            self._fill(part)
            if not np.isfinite(part[-1]).all():
                time = self.steps_done * self._dt
                raise FloatingPointError(f"the run left the finite numbers {time:.3g} s after its start")
            if progress is not None:
                self._fraction = began + (1 - began) / 2 * (first + len(part)) / count
                progress(self._fraction)
        return samples

    def _fill(self, samples):
        """Step on, and fill the next samples."""
        count, tail = len(samples), self.filter.taps.size - 1
        rows = self._rows[: tail + count * self.filter.factor]
        kernel.advance(*self._state, *self._constants, self.steps_done, rows[tail:])
        self.steps_done += count * self.steps_per_sample
        kernel.decimate(rows, self.filter.taps, self.filter.factor, self._kept[:count])
        self._rows[:tail] = rows[-tail:].copy()
        self._layout.put_in_order(self._kept[:count], samples)
