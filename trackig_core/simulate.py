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

BLOCK_SAMPLES = 64
"""Decimated samples per call of the kernel: some tens of milliseconds between looks at ``cancelled``."""


class SolveCancelled(Exception):  # noqa: N818  (it is no error: the caller asked for it)
    """The caller cancelled the run."""


@lru_cache(maxsize=16)
def low_pass(time_step):
    """Return the filter that precedes decimation to :data:`~trackig_core.grid.RECORD_RATE`.

    Parameters
    ----------
    time_step : float
        Time step of the run [s].

    Returns
    -------
    numpy.ndarray (taps,)
        Symmetric coefficients (Kaiser window), a multiple of four of them, unit gain at 0 Hz [-].
    """
    rate = 1 / time_step
    stop = RECORD_RATE - PASS_BAND
    count, beta = kaiserord(STOP_BAND_ATTENUATION, (stop - PASS_BAND) / (rate / 2))
    count += -count % 4
    taps = firwin(count, (PASS_BAND + stop) / 2, window=("kaiser", beta), fs=rate)
    taps.flags.writeable = False
    return taps


def decimation(time_step):
    """Return how many time steps [s] make one sample of the decimated record."""
    return max(1, round(1 / (time_step * RECORD_RATE)))


def simulate(design, grid, *, memory_order=1, step=DEFAULT_STEP, progress=None, cancelled=None):
    """Step a design through time until the force into the ground has died down.

    The record is doubled, up to 16 s, until the low-passed force has decayed by 80 dB.

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
    record = grid.steps * grid.dt
    samples = run.collect(grid.steps, progress, cancelled)
    while not (decayed := _has_decayed(samples)):
        record *= 2
        if record > LONGEST_RECORD or not grid.can_afford(record):
            break
        samples = np.concatenate([samples, run.collect(run.steps_done, progress, cancelled)])
    if progress is not None:
        progress(1.0)

    supports = grid.half_bays
    multiplicity = np.full(supports, 2.0)
    multiplicity[0] = 1.0
    return TimeHistory(
        time=run.sample_times(len(samples)),
        support_force=samples[:, :supports],
        multiplicity=multiplicity,
        rail_displacement=samples[:, supports],
        block_displacement=samples[:, supports + 1] if design.two_stage else None,
        low_pass=run.taps,
        time_step=grid.dt,
        step=step,
        steps=run.steps_done,
        decayed=decayed,
    )


def _has_decayed(samples):
    """Return whether the forces at the end of the record are 80 dB below their peak."""
    forces = samples[:, :-2]
    window = max(1, round(DECAY_WINDOW * RECORD_RATE))
    return bool(np.abs(forces[-window:]).max() <= DECAY * np.abs(forces).max())


class State(NamedTuple):
    """What the kernel changes from step to step, in the order in which it takes it."""

    rail: np.ndarray
    rail_velocity: np.ndarray
    block: np.ndarray
    block_velocity: np.ndarray
    wheel: np.ndarray
    pad_memory: np.ndarray
    boot_memory: np.ndarray
    compression: np.ndarray
    pad_force: np.ndarray


class Constants(NamedTuple):
    """What the kernel is given and leaves alone, in the order in which it takes it."""

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


def at_rest(design, grid, *, memory_order=1, step=DEFAULT_STEP):
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

    Returns
    -------
    State, Constants
        Arguments of :func:`trackig_core.kernel.advance`; shapes and units are given there.
    """
    rail = design.rail
    pad_law, boot_law = laws(design)
    pad = pad_law.recursion(grid.dt, memory_order)
    boot = boot_law.recursion(grid.dt, memory_order) if design.two_stage else (0.0, np.zeros(0), np.zeros(0))
    bays = grid.half_bays
    state = State(
        rail=np.zeros((grid.elements_per_bay, bays + 2)),
        rail_velocity=np.zeros((grid.elements_per_bay, bays)),
        block=np.zeros(bays),
        block_velocity=np.zeros(bays),
        wheel=np.array([step, 0.0]),
        pad_memory=np.zeros((pad[1].size, bays)),
        boot_memory=np.zeros((boot[1].size, bays)),
        compression=np.zeros(bays),
        pad_force=np.zeros(bays),
    )
    constants = Constants(
        grid.dt,
        grid.dt * rail.bending_stiffness / (rail.mass_per_metre * grid.dx**4),
        *pad,
        *boot,
        element_mass=rail.mass_per_metre * grid.dx,
        block_mass=design.block_mass if design.two_stage else 1.0,
        wheel_mass=design.wheel_mass,
        contact_stiffness=design.contact_stiffness,
        two_stage=design.two_stage,
    )
    return state, constants


class _Run:
    """One run under way: the kernel's state, and the samples that the filter still needs."""

    def __init__(self, design, grid, memory_order, step):
        self._state, self._constants = at_rest(design, grid, memory_order=memory_order, step=step)
        self._dt = grid.dt
        self.taps = low_pass(grid.dt)
        self._factor = decimation(grid.dt)
        self._before = np.zeros((self.taps.size - 1, grid.half_bays + 2))
        self.steps_done = 0
        self._fraction = 0.0

    def sample_times(self, count):
        """Return the time that each decimated sample stands for [s]: the filter's centre."""
        delay = (self.taps.size - 1) / 2
        return (np.arange(count) * self._factor - delay) * self._dt

    def collect(self, steps, progress, cancelled):
        """Take ``steps`` time steps and return their decimated samples (samples, supports + 2)."""
        tail, columns = self._before.shape
        samples = np.empty((steps // self._factor, columns))
        buffer = np.empty((tail + BLOCK_SAMPLES * self._factor, columns))
        began = self._fraction
        for first in range(0, len(samples), BLOCK_SAMPLES):
            if cancelled is not None and cancelled():
                raise SolveCancelled("the run was cancelled")
            part = samples[first : first + BLOCK_SAMPLES]
            block = buffer[: tail + len(part) * self._factor]
            block[:tail] = self._before
            kernel.advance(*self._state, *self._constants, block[tail:])
            kernel.decimate(block, self.taps, self._factor, part)
            self._before = block[-tail:].copy()
            self.steps_done += len(part) * self._factor
            if not np.isfinite(part[-1]).all():
                time = self.steps_done * self._dt
                raise FloatingPointError(f"the run left the finite numbers {time:.3g} s after its start")
            if progress is not None:
                self._fraction = began + (1 - began) / 2 * (first + len(part)) / len(samples)
                progress(self._fraction)
        return samples
