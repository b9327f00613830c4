"""The seam between design and kernel: run the time stepping and keep its low-passed record.

SI units. Rest until time zero, then a step squeezes the contact spring (the paper, see
:mod:`trackig_core.design`). Each block of steps is low-passed before it is decimated, because on a
stiff track the ringing far above 500 Hz is orders of magnitude stronger than the force at 5 Hz and
would fold down onto it.

The one rule: nothing that is not finite leaves this module.
"""

from functools import lru_cache

import numpy as np
from scipy.signal import firwin, kaiserord

from trackig_core import kernel
from trackig_core.grid import DURATION_LIMIT, LONGEST_RECORD, RECORD_RATE
from trackig_core.relaxation import relaxation
from trackig_core.results import TimeHistory

DEFAULT_STEP = 1e-4
"""Step that squeezes the contact spring [m]; insertion gain does not depend on it."""

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
        Called now and then with the fraction done of the record as far as is known, 0 to 1.
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
        if record > LONGEST_RECORD or grid.duration_estimate(record) > DURATION_LIMIT:
            break
        samples = np.concatenate([samples, run.collect(run.steps_done, progress, cancelled)])

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


class _Run:
    """State of one run: what the kernel changes, and the constants that it is given."""

    def __init__(self, design, grid, memory_order, step):
        supports = grid.half_bays
        pad = relaxation(design.pad_stiffness, design.pad_loss_factor)
        pad_memory = pad.recursion(grid.dt, memory_order)
        boot_memory = (0.0, np.zeros(0), np.zeros(0))
        if design.two_stage:
            boot = relaxation(design.boot_stiffness, design.boot_loss_factor)
            boot_memory = boot.recursion(grid.dt, memory_order)
        self._state = (
            np.zeros((grid.elements_per_bay, supports + 2)),  # rail
            np.zeros((grid.elements_per_bay, supports)),  # its velocity
            np.zeros(supports),  # blocks
            np.zeros(supports),  # their velocity
            np.array([step, 0.0]),  # wheel: displacement, velocity
            np.zeros((pad_memory[1].size, supports)),
            np.zeros((boot_memory[1].size, supports)),
            np.zeros(supports),  # working space
            np.zeros(supports),
        )
        rail = design.rail
        self._constants = (
            grid.dt,
            grid.dt * rail.bending_stiffness / (rail.mass_per_metre * grid.dx**4),
            *pad_memory,
            *boot_memory,
            rail.mass_per_metre * grid.dx,
            design.block_mass if design.two_stage else 1.0,
            design.wheel_mass,
            design.contact_stiffness,
            design.two_stage,
        )
        self._dt = grid.dt
        self.taps = low_pass(grid.dt)
        self._factor = decimation(grid.dt)
        self._history = np.zeros((self.taps.size - 1, supports + 2))
        self.steps_done = 0

    def sample_times(self, count):
        """Return the time that each decimated sample stands for [s]: the filter's centre."""
        delay = (self.taps.size - 1) / 2
        return (np.arange(count) * self._factor - delay) * self._dt

    def collect(self, steps, progress, cancelled):
        """Take ``steps`` time steps and return their decimated samples (samples, supports + 2)."""
        before = len(self._history)
        samples = np.empty((steps // self._factor, self._history.shape[1]))
        target = self.steps_done + steps
        buffer = np.empty((before + BLOCK_SAMPLES * self._factor, samples.shape[1]))
        for first in range(0, len(samples), BLOCK_SAMPLES):
            if cancelled is not None and cancelled():
                raise SolveCancelled("the run was cancelled")
            part = samples[first : first + BLOCK_SAMPLES]
            block = buffer[: before + len(part) * self._factor]
            block[:before] = self._history
            kernel.advance(*self._state, *self._constants, block[before:])
            kernel.decimate(block, self.taps, self._factor, part)
            self._history = block[len(block) - before :].copy()
            if not np.isfinite(part[-1]).all():
                raise FloatingPointError(
                    f"the run left the finite numbers at {self.steps_done * self._dt:.3g} s"
                )
            self.steps_done += len(part) * self._factor
            if progress is not None:
                progress(self.steps_done / target)
        return samples
