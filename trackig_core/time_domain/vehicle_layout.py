"""The track under any wheels and on any ground as the kernel steps it, at rest and in memory. SI units.

Elements and supports lie in order, along the whole ring, or along half of it where one wheel stands over
support 0. The kernel is :func:`trackig_core.time_domain.vehicle_kernels.advance`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from trackig_core.arrays import IntArray, RealArray
from trackig_core.frequency_domain.axles import wheel_delays, wheel_elements
from trackig_core.frequency_domain.kernel_rows import recursion_row
from trackig_core.frequency_domain.track_model import TrackModel
from trackig_core.time_domain.memory_layout import COLUMNS, aligned_zeros
from trackig_core.time_domain.vehicle_kernels import LANES, QUANTITIES

if TYPE_CHECKING:
    from trackig_core.time_domain.grid import Grid
    from trackig_core.time_domain.time_stepping import Probes
    from trackig_core.track.design import TrackDesign

GHOSTS = 2
"""Elements beyond either end of the rail."""


class VehicleLayout:
    """Places of elements, supports and records of one grid.

    Its methods are those of :class:`trackig_core.time_domain.memory_layout.Layout`.

    Parameters
    ----------
    grid : Grid
        The grid.
    wheels : int
        Wheels on the rail.
    """

    def __init__(self, grid: Grid, wheels: int) -> None:
        self._grid, self._wheels = grid, wheels
        self.groups = -(-grid.stored_bays // LANES)
        self.elements = grid.stored_bays * grid.elements_per_bay

    def rail_place(self, element: int) -> int:
        """Return where an element lies in the rail's displacements, counted from support 0 either way."""
        if self._grid.symmetric:
            return abs(element) + GHOSTS
        return element % self._grid.elements + GHOSTS

    def block_place(self, support: int) -> int:
        """Return where the block of a support lies among all that is kept of supports, as one row."""
        group, lane = divmod(support % self._grid.bays, LANES)
        return group * QUANTITIES * LANES + lane

    def foot_place(self, support: int) -> int:
        """Return where p of the foot of a support lies there."""
        return self.block_place(support) + 8 * LANES

    def mirrors(self) -> IntArray:
        """Return the places from which the ghosts take their displacements (4,)."""
        if self._grid.symmetric:
            beyond = self._grid.elements - self.elements
            return np.array([self.rail_place(each) for each in (2, 1, beyond, beyond - 1)])
        return np.array([self.rail_place(each) for each in (-2, -1, 0, 1)])

    def columns(self, probes: int) -> int:
        """Return how many columns a record has for the forces, the wheels and some more quantities."""
        return self.groups * LANES + -(-(self._wheels - 1 + probes) // COLUMNS) * COLUMNS

    def width(self, probes: int) -> int:
        """Return how many columns a record in order has."""
        return self._grid.stored_bays + self._wheels - 1 + probes

    def put_in_order(self, rows: RealArray, ordered: RealArray) -> None:
        """Copy rows of a record without the columns that fill up groups."""
        bays = self._grid.stored_bays
        ordered[:, :bays] = rows[:, :bays]
        ordered[:, bays:] = rows[:, self.groups * LANES :][:, : ordered.shape[1] - bays]


class State(NamedTuple):
    """What the kernel changes from step to step, in the order in which it takes it."""

    rail: RealArray
    rail_velocity: RealArray
    supports: RealArray
    wheels: RealArray
    window: RealArray
    over: RealArray
    pushed: RealArray
    clock: IntArray


class Constants(NamedTuple):
    """What the kernel is given and leaves alone, in the order in which it takes it."""

    mirrors: IntArray
    wheel_places: IntArray
    onsets: RealArray
    rail_probes: IntArray
    block_probes: IntArray
    foot_probes: IntArray
    time_step: float
    bending: float
    pad: RealArray
    boot: RealArray
    element_mass: float
    block_mass: float
    contact_stiffness: float
    step: float
    keep: RealArray
    spring: RealArray
    push: RealArray
    foot: RealArray
    bays: int
    two_stage: bool
    comb: RealArray
    comb_factor: int


def at_rest(
    model: TrackModel,
    grid: Grid,
    *,
    memory_order: int,
    step: float,
    probes: Probes,
    comb: RealArray,
    comb_factor: int,
    rough_wheel: int | None = None,
) -> tuple[State, Constants]:
    """Return a track at rest that a step of roughness is about to reach.

    Parameters
    ----------
    model : TrackModel
        The track.
    grid : Grid
        Its grid.
    memory_order : int
        1 for the paper's recursion of the damping memory, 2 for the second-order one.
    step : float
        Height of the step of roughness [m].
    probes : Probes
        What is recorded beside the forces and the wheels.
    comb : numpy.ndarray (taps,)
        First stage of the low-pass filter, newest first [-].
    comb_factor : int
        Time steps per row of the record.
    rough_wheel : int or None
        The only wheel that a step reaches; None: each, with its delay.

    Returns
    -------
    State, Constants
        Arguments of :func:`trackig_core.time_domain.vehicle_kernels.advance`.
    """
    track, rail = model.design, model.design.rail
    wheels = wheel_elements(track, grid.elements_per_bay)
    layout = VehicleLayout(grid, len(wheels))
    state = State(
        rail=aligned_zeros(layout.elements + 2 * GHOSTS),
        rail_velocity=aligned_zeros(layout.elements),
        supports=aligned_zeros(layout.groups, QUANTITIES * LANES),
        wheels=np.zeros((len(wheels), 6)),
        window=aligned_zeros(comb.size, layout.columns(probes.count)),
        over=aligned_zeros(layout.groups * LANES),
        pushed=aligned_zeros(layout.groups * LANES),
        clock=np.zeros(1, dtype=np.int64),
    )
    keep, spring, push = axle_matrices(track, grid.dt)
    pad, boot = (recursion_row(law, grid.dt, memory_order) for law in (model.pad, model.boot))
    constants = Constants(
        layout.mirrors(),
        np.array([layout.rail_place(element) for element in wheels], dtype=np.int64),
        onsets(track, rough_wheel) / grid.dt,
        np.array([layout.rail_place(element) for element in probes.rail], dtype=np.int64),
        np.array([layout.block_place(support) for support in probes.blocks], dtype=np.int64),
        np.array([layout.foot_place(support) for support in probes.feet], dtype=np.int64),
        grid.dt,
        grid.dt * rail.bending_stiffness / (rail.mass_per_metre * grid.dx**4),
        pad,
        boot,
        element_mass=rail.mass_per_metre * grid.dx,
        block_mass=1.0 if track.block_mass is None else track.block_mass,
        contact_stiffness=track.contact_stiffness,
        step=step,
        keep=keep,
        spring=spring,
        push=push,
        foot=foot_constants(track, float((boot if track.two_stage else pad)[0]), grid.dt),
        bays=grid.stored_bays,
        two_stage=track.two_stage,
        comb=comb,
        comb_factor=comb_factor,
    )
    return state, constants


def onsets(design: TrackDesign, rough_wheel: int | None) -> RealArray:
    """Return when the step of roughness reaches each wheel (wheels,) [s]; infinity where it never does."""
    count = len(design.axle_positions)
    if rough_wheel is not None:
        return np.where(np.arange(count) == rough_wheel, 0.0, np.inf)
    delays = wheel_delays(design)
    return np.zeros(count) if delays is None else delays


def axle_matrices(design: TrackDesign, time_step: float) -> tuple[RealArray, RealArray, RealArray]:
    """Return what moves wheel, bogie and body of one axle on.

    With masses M, dashpots C, springs K and forces F,

        (M + C dt/2) v[n+1/2] = (M - C dt/2) v[n-1/2] - dt K u[n] + dt F[n].

    Parameters
    ----------
    design : TrackDesign
        The track, for its wheel and suspension.
    time_step : float
        dt [s].

    Returns
    -------
    keep, spring : numpy.ndarray (3, 3)
        Factors of velocities [-] and displacements [1/s].
    push : numpy.ndarray (3,)
        Factors of a force on the wheel [m/s per N].
    """
    masses = np.array([design.wheel_mass, 1.0, 1.0])  # what is not there stands still, whatever its mass
    dashpots, springs = np.zeros((3, 3)), np.zeros((3, 3))
    if design.suspension is not None:
        above = design.suspension
        stiffness, damping, body_mass = above.secondary
        masses[1:] = above.bogie_mass, body_mass or 1.0
        for matrix, values in (
            (springs, (above.primary_stiffness, stiffness)),
            (dashpots, (above.primary_damping, damping)),
        ):
            for lower, value in enumerate(values):
                matrix[lower : lower + 2, lower : lower + 2] += value * np.array([[1.0, -1.0], [-1.0, 1.0]])
    after: RealArray = np.asarray(np.linalg.inv(np.diag(masses) + dashpots * time_step / 2), dtype=float)
    keep: RealArray = after @ (np.diag(masses) - dashpots * time_step / 2)
    return keep, -time_step * after @ springs, time_step * after[:, 0]


def foot_constants(design: TrackDesign, spring: float, time_step: float) -> RealArray:
    """Return displacement of a foot per force [m/N], its dashpot [N s/m] and mass [kg] (3,)."""
    ground = design.ground
    if ground is None:
        return np.zeros(3)
    rate = 2 / time_step
    foot = ground.stiffness + ground.damping * rate + ground.mass * rate**2
    return np.array([1 / (spring + foot), ground.damping, ground.mass])
