"""The seam between design and kernel: run the time stepping and keep its low-passed record.

SI units. Rest until time zero, then a step squeezes the contact spring (the paper, see
:mod:`trackig_core.track.design`). Each block of steps is low-passed before it is decimated, because on a
stiff track the ringing far above 500 Hz is orders of magnitude stronger than the force at 5 Hz and
would fold down onto it. A run that leaves the finite numbers ends in an error.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple, Protocol

import numpy as np

from trackig_core.arrays import IntArray, RealArray
from trackig_core.frequency_domain.kernel_rows import recursion_row
from trackig_core.frequency_domain.track_model import Track, track_model
from trackig_core.results import SolveCancelled, TimeHistory
from trackig_core.time_domain import kernels, vehicle_kernels, vehicle_layout
from trackig_core.time_domain.decimation import NO_COMB, RECORD_RATE, low_pass
from trackig_core.time_domain.grid import LONGEST_RECORD, Grid
from trackig_core.time_domain.kernels import LANES, QUANTITIES
from trackig_core.time_domain.memory_layout import GHOSTS, Layout, aligned_zeros
from trackig_core.time_domain.vehicle_layout import VehicleLayout
from trackig_core.track.design import DEFAULT_STEP
from trackig_core.track.viscoelastic_law import Relaxation

DECAY = 1e-4
"""Amplitude, relative to its peak, below which a force has died down [-]: 80 dB."""

SPRUNG_DECAY = 1e-6
"""The same under a wheel that carries a suspension [-]: 120 dB. A body that still bounces at 1 Hz passes next
to no force, but cut off it would count in the lowest bands."""

DECAY_WINDOW = 0.1
"""Last part of the record in which the force must stay below :data:`DECAY` [s]: half a period at 5 Hz."""

LEAST_BLOCK = 16
"""Decimated samples per call of the kernel, at least."""

BLOCK_BYTES = 400_000
"""Rows of the record per call of the kernel [bytes]: they stay in the second-level cache until they are
filtered; ``cancelled`` is asked every few milliseconds."""


class Ending(Protocol):
    """When a record may end."""

    def reached(self, forces: RealArray) -> bool:
        """Return whether a record may end, given its latest part (samples, supports) [N]."""

    def more(self, steps_done: int) -> int:
        """Return how many steps a record that may not end is made longer by."""


class Decay:
    """When the paper's record may end: its force has decayed by 80 dB; if not, it is doubled.

    Parameters
    ----------
    amplitude : float
        Amplitude over the peak's below which a force has died down [-].
    """

    def __init__(self, amplitude: float = DECAY) -> None:
        self._amplitude, self._peak = amplitude, 0.0

    def reached(self, forces: RealArray) -> bool:
        """Return whether a record may end.

        Parameters
        ----------
        forces : numpy.ndarray (samples, supports)
            The latest part of the record [N].
        """
        window = max(1, round(DECAY_WINDOW * RECORD_RATE))
        self._peak = max(self._peak, _largest(forces))
        return _largest(forces[-window:]) <= self._amplitude * self._peak

    def more(self, steps_done: int) -> int:
        """Return how many steps a record that may not end is made longer by."""
        return steps_done


def _largest(forces: RealArray) -> float:
    """Return the largest magnitude, without an array of all magnitudes."""
    return max(float(forces.max()), -float(forces.min()))


def simulate(
    design: Track,
    grid: Grid,
    *,
    memory_order: int = 1,
    step: float = DEFAULT_STEP,
    rough_wheel: int | None = None,
    ending: Ending | None = None,
    progress: Callable[[float], object] | None = None,
    cancelled: Callable[[], object] | None = None,
) -> TimeHistory:
    """Step a design through time until the force into the ground has died down.

    The record is made longer, up to 16 s, until its ending is reached.

    Parameters
    ----------
    design : TrackDesign or TrackModel
        The track.
    grid : Grid
        Its grid.
    memory_order : int
        1 for the paper's recursion of the damping memory, 2 for the second-order one.
    step : float
        Step that squeezes the contact spring [m].
    rough_wheel : int, optional
        The only wheel under which the roughness steps, of several whose roughness is independent; by default
        the step reaches each wheel, with its delay.
    ending : Ending, optional
        Says when the record may end, and how much longer it is made if it may not. By default the paper's:
        it is doubled until the low-passed force has decayed by 80 dB, under a suspension by 120 dB.
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
    model = track_model(design)
    run = Run(model, grid, memory_order=memory_order, step=step, rough_wheel=rough_wheel)
    ending = ending or Decay(DECAY if model.design.suspension is None else SPRUNG_DECAY)
    supports = grid.stored_bays
    parts = [run.collect(grid.steps, progress, cancelled)]
    while not (decayed := ending.reached(parts[-1][:, :supports]) and run.begun):
        more = ending.more(run.steps_done)
        record = (run.steps_done + more) * grid.dt
        if record > LONGEST_RECORD or not grid.can_afford(record):
            break
        parts.append(run.collect(more, progress, cancelled))
    samples = parts[0] if len(parts) == 1 else np.concatenate(parts)
    if progress is not None:
        progress(1.0)

    multiplicity = np.full(supports, 2.0 if grid.symmetric else 1.0)
    multiplicity[0] = 1.0
    after_wheels = supports + len(model.design.axle_positions)
    return TimeHistory(
        time=run.filter.times(len(samples)),
        support_force=samples[:, :supports],
        multiplicity=multiplicity,
        wheel_displacement=samples[:, supports],
        rail_displacement=samples[:, after_wheels],
        block_displacement=samples[:, after_wheels + 1] if model.design.two_stage else None,
        low_pass=run.filter,
        time_step=grid.dt,
        step=step,
        steps=run.steps_done,
        decayed=decayed,
        last_onset=run.last_onset,
    )


class State(NamedTuple):
    """What the kernel changes from step to step, in the order in which it takes it."""

    rail: RealArray
    rail_velocity: RealArray
    supports: RealArray
    wheel: RealArray
    window: RealArray


class Constants(NamedTuple):
    """What the kernel is given and leaves alone, in the order in which it takes it."""

    mirrors: IntArray
    rail_probes: IntArray
    block_probes: IntArray
    time_step: float
    bending: float
    pad_stiffness: float
    pad_decay: RealArray
    pad_gain: RealArray
    boot_stiffness: float
    boot_decay: RealArray
    boot_gain: RealArray
    element_mass: float
    block_mass: float
    wheel_mass: float
    contact_stiffness: float
    two_stage: bool
    comb: RealArray
    comb_factor: int


@dataclass(frozen=True)
class Probes:
    """Where displacements are recorded beside the forces, besides that of the wheel.

    Attributes
    ----------
    rail : tuple of int
        Rail elements, counted from the wheel.
    blocks : tuple of int
        Supports whose block is recorded, counted from the wheel; zero when single-stage.
    feet : tuple of int
        Supports whose foot is recorded, counted so too; zero on rigid ground.
    """

    rail: tuple[int, ...] = (0,)
    blocks: tuple[int, ...] = (0,)
    feet: tuple[int, ...] = ()

    @property
    def count(self) -> int:
        """Displacements recorded, the wheel's among them."""
        return 1 + len(self.rail) + len(self.blocks) + len(self.feet)


LOADED_SUPPORT = Probes()
"""Wheel, and rail and block at the loaded support."""


def at_rest(
    design: Track,
    grid: Grid,
    *,
    memory_order: int = 1,
    step: float = DEFAULT_STEP,
    probes: Probes = LOADED_SUPPORT,
    comb: RealArray = NO_COMB,
    comb_factor: int = 1,
) -> tuple[State, Constants]:
    """Return a track at rest under a wheel that squeezes its contact spring.

    Parameters
    ----------
    design : TrackDesign or TrackModel
        The track.
    grid : Grid
        Its grid.
    memory_order : int
        1 for the paper's recursion of the damping memory, 2 for the second-order one.
    step : float
        Displacement of the wheel against the contact spring [m].
    probes : Probes
        What is recorded beside the forces.
    comb : numpy.ndarray (taps,)
        First stage of the low-pass filter, newest first [-]; by default none.
    comb_factor : int
        Time steps per row of the record.

    Returns
    -------
    State, Constants
        Arguments of :func:`trackig_core.time_domain.kernels.advance`; shapes and units are given there.
    """
    model, layout = track_model(design), Layout(grid)
    track, rail = model.design, model.design.rail
    sums = -(-np.trim_zeros(comb, "b").size // comb_factor)
    state = State(
        rail=aligned_zeros((layout.elements + 2 * GHOSTS) * LANES),
        rail_velocity=aligned_zeros(layout.elements * LANES),
        supports=aligned_zeros(layout.bays, QUANTITIES * LANES),
        wheel=np.array([step, 0.0]),
        window=aligned_zeros(comb_factor + sums + 1, layout.columns(probes.count)),
    )
    constants = Constants(
        layout.mirrors(),
        np.array([layout.rail_place(element) for element in probes.rail], dtype=np.int64),
        np.array([layout.block_place(support) for support in probes.blocks], dtype=np.int64),
        grid.dt,
        grid.dt * rail.bending_stiffness / (rail.mass_per_metre * grid.dx**4),
        *_stiffness_decay_gain(model.pad, grid.dt, memory_order),
        *_stiffness_decay_gain(model.boot, grid.dt, memory_order),
        element_mass=rail.mass_per_metre * grid.dx,
        block_mass=1.0 if track.block_mass is None else track.block_mass,
        wheel_mass=track.wheel_mass,
        contact_stiffness=track.contact_stiffness,
        two_stage=track.two_stage,
        comb=comb,
        comb_factor=comb_factor,
    )
    return state, constants


def _stiffness_decay_gain(
    law: Relaxation | None, time_step: float, memory_order: int
) -> tuple[float, RealArray, RealArray]:
    row = recursion_row(law, time_step, memory_order)
    return float(row[0]), row[1:4], row[4:]


class Run:
    """One run under way: the kernel's state, and the rows that the filter still needs.

    Parameters
    ----------
    design, grid, memory_order, step, probes
        As in :func:`at_rest`.
    rough_wheel : int, optional
        As in :func:`simulate`.

    Attributes
    ----------
    filter : LowPass
        The filter that precedes the thinning out.
    steps_done : int
        Time steps taken.
    last_onset : float
        When the step of roughness reaches the last wheel [s].
    """

    def __init__(
        self,
        design: Track,
        grid: Grid,
        *,
        memory_order: int = 1,
        step: float = DEFAULT_STEP,
        probes: Probes = LOADED_SUPPORT,
        rough_wheel: int | None = None,
    ) -> None:
        self.filter = low_pass(grid.dt)
        model = track_model(design)
        comb, comb_factor = self.filter.comb, self.filter.comb_factor
        self._advance: Callable[..., None]
        self._layout: Layout | VehicleLayout
        self._state: State | vehicle_layout.State
        self._constants: Constants | vehicle_layout.Constants
        if model.is_simplified:
            self._advance, self._layout = kernels.advance, Layout(grid)
            self._state, self._constants = at_rest(
                model,
                grid,
                memory_order=memory_order,
                step=step,
                probes=probes,
                comb=comb,
                comb_factor=comb_factor,
            )
            self.last_onset = 0.0
        else:
            wheels = len(model.design.axle_positions)
            self._advance, self._layout = vehicle_kernels.advance, VehicleLayout(grid, wheels)
            self._state, self._constants = vehicle_layout.at_rest(
                model,
                grid,
                memory_order=memory_order,
                step=step,
                probes=probes,
                comb=comb,
                comb_factor=comb_factor,
                rough_wheel=rough_wheel,
            )
            when = vehicle_layout.onsets(model.design, rough_wheel)
            self.last_onset = float(when[np.isfinite(when)].max())
        self._probes, self._dt = probes, grid.dt
        columns = self._state.window.shape[1]
        self._block = max(LEAST_BLOCK, BLOCK_BYTES // (8 * columns * self.filter.factor))
        self._rows = aligned_zeros(self.filter.taps.size - 1 + self._block * self.filter.factor, columns)
        self._kept = aligned_zeros(self._block, columns)
        self.steps_done = 0
        self._fraction = 0.0

    @property
    def begun(self) -> bool:
        """Whether the step of roughness has reached every wheel that it reaches."""
        return self.steps_done * self._dt > self.last_onset

    def collect(
        self,
        steps: int,
        progress: Callable[[float], object] | None = None,
        cancelled: Callable[[], object] | None = None,
    ) -> RealArray:
        """Take about ``steps`` time steps and return their decimated samples, supports in order, then probes.

        Parameters
        ----------
        steps : int
            Time steps.
        progress, cancelled : callable, optional
            As in :func:`simulate`.

        Returns
        -------
        numpy.ndarray (samples, stored_bays + wheels + probes)
            Forces [N]; displacements of the wheels and of the probes on rail, blocks and feet [m].

        Raises
        ------
        SolveCancelled, FloatingPointError
            As in :func:`simulate`.
        """
        count = round(steps / self.filter.steps_per_sample)
        samples = np.empty((count, self._layout.width(self._probes.count)))
        began = self._fraction
        for first in range(0, count, self._block):
            if cancelled is not None and cancelled():
                raise SolveCancelled("the run was cancelled")
            part = samples[first : first + self._block]
            self._fill(part)
            if not np.isfinite(part[-1]).all():
                time = self.steps_done * self._dt
                raise FloatingPointError(f"the run left the finite numbers {time:.3g} s after its start")
            if progress is not None:
                self._fraction = began + (1 - began) / 2 * (first + len(part)) / count
                progress(self._fraction)
        return samples

    def _fill(self, samples: RealArray) -> None:
        """Step on, and fill the next samples."""
        count, tail = len(samples), self.filter.taps.size - 1
        rows = self._rows[: tail + count * self.filter.factor]
        arguments = (*self._state, *self._constants, rows[tail:])
        self._advance(*arguments)
        self.steps_done += count * self.filter.steps_per_sample
        kernels.decimate(rows, self.filter.taps, self.filter.factor, self._kept[:count])
        self._rows[:tail] = rows[-tail:]
        self._layout.put_in_order(self._kept[:count], samples)
