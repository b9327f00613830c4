"""The grid in space and time: how a design is cut into elements and steps.

A ring of bays, each ``elements_per_bay`` (three) elements long, with a support (S) under the first
element of each bay and the wheel (W) over support 0. Ring and load are symmetric about that
support, so only half of the ring is stepped (several axles, or one between supports, need all of it):

    element    -2   -1  |  0    1    2  |  3    4    5  | ... |  E s  ...  | ...   half | mirrored
    bay          ghost  |     bay 0     |     bay 1     |     |   bay s    |   last bay | ghost
                        |  W            |               |     |            |            |
    rail      --o----o--|--o----o----o--|--o----o----o--|-...-|--o----o----|--o----o----o----o--
    pad                 |  S            |  S            |     |  S         |  S         :
    block               |  #            |  #            |     |  #         |  #         :
    boot      ..........|..S............|..S............|.....|..S.........|..S.........:.......
                        ^ mirror: element -i moves as i                mid-span mirror ^

An odd number of bays puts the far mirror in the middle of the last bay.
:mod:`trackig_core.time_domain.memory_layout` shows how this lies in memory.

SI units. Source: the paper (see :mod:`trackig_core.track.design`), sections on the grid and on stability.
"""

import math
from dataclasses import dataclass

import numpy as np

from trackig_core.frequency_domain.track_model import Track, track_model
from trackig_core.time_domain.decimation import RECORD_RATE
from trackig_core.track.design import ELEMENTS_PER_BAY as ELEMENTS_PER_BAY
from trackig_core.track.design import ONE_AXLE

RING_BAYS = 667
"""Supports around the ring [-]: the paper's 2000 elements, made divisible by three."""

FEWEST_BAYS = 17
"""Fewest supports around a ring [-]: fewer do not fill the kernel's lanes."""

PAPER_TIME_STEP = 1.0 / 131072
"""The paper's time step [s]."""

PAPER_RECORD = 2.0
"""Length of the record [s]: 262144 of the paper's steps."""

SHORTEST_RECORD = 0.01
"""Shortest record that can be asked for [s]."""

LONGEST_RECORD = 16.0
"""Length to which a record may be doubled while the force has not died down [s]."""

MEMORY_LIMIT = 2e9
"""Bytes that a run may need; one that needs more is refused."""

DURATION_LIMIT = 60.0
"""Seconds that a run may take; one that would take longer is refused."""

LEAST_STATIC_SHARE = 0.2
"""Part of its static stiffness that the paper's damping recursion must leave a spring [-]; at the paper's
time step it does with loss factors up to one."""

STEP_RATE = 4e8
"""Rail elements advanced by one time step per second [1/s]: a modest core of 2020, so that estimates err
towards refusing."""


class RunTooLargeError(ValueError):
    """A run would need more memory or time than is allowed; it was not begun."""


@dataclass(frozen=True)
class Grid:
    """Elements and steps of one run; those of :func:`make_grid` are stable.

    Attributes
    ----------
    bays : int
        Supports around the ring, odd.
    elements_per_bay : int
        Rail elements between supports.
    dx : float [m]
        Length of a rail element.
    dt : float [s]
        Time step.
    steps : int
        Time steps of the record; a record that is extended takes more.
    notes : tuple of str
        What was changed against the paper's grid, and why.
    symmetric : bool
        Whether half of the ring is stepped for all of it; several axles need the whole.
    """

    bays: int
    elements_per_bay: int
    dx: float
    dt: float
    steps: int
    notes: tuple[str, ...] = ()
    symmetric: bool = True

    @property
    def elements(self) -> int:
        """Rail elements around the ring."""
        return self.bays * self.elements_per_bay

    @property
    def half_bays(self) -> int:
        """Bays that are stored: support 0 and those on one side of it."""
        return (self.bays + 1) // 2

    @property
    def stored_bays(self) -> int:
        """Bays that are stepped: those of half the ring, or all."""
        return self.half_bays if self.symmetric else self.bays

    def duration_estimate(self, record: float) -> float:
        """Return the time that a record of given length [s] would take on a modest core [s]."""
        return record / self.dt * self.stored_bays * self.elements_per_bay / STEP_RATE

    def memory_estimate(self, record: float) -> float:
        """Return the memory that a record of given length [s] would take [bytes]."""
        # all supports at the decimated rate, copied up to twice on the way to the spectrum
        return 3 * 8 * self.stored_bays * record * RECORD_RATE

    def can_afford(self, record: float) -> bool:
        """Return whether a record of given length [s] keeps within the limits of time and memory."""
        return (
            self.duration_estimate(record) <= DURATION_LIMIT and self.memory_estimate(record) <= MEMORY_LIMIT
        )


def stable_time_step(design: Track, dx: float) -> float:
    """Return a time step below which the explicit scheme is stable for certain.

    Gershgorin's bound on the highest natural frequency of the undamped lattice with every spring
    at its instantaneous (stiffest) value: each row of the mass-weighted stiffness matrix is summed
    in magnitude. Leap-frog stepping is stable for dt < 2 / omega_max. Ground that yields needs no row: its
    foot is stepped by the trapezoidal rule, and the spring above it is never stiffer than on rigid ground.
    Dashpots need none: they feel the mean of the velocities before and after.

    Parameters
    ----------
    design : TrackDesign or TrackModel
        The track.
    dx : float
        Length of a rail element [m].

    Returns
    -------
    float
        Largest safe time step [s].
    """
    model = track_model(design)
    track, pad, boot = model.design, model.pad.instantaneous, model.boot
    element_mass = track.rail.mass_per_metre * dx
    bending = 16 * track.rail.bending_stiffness / (track.rail.mass_per_metre * dx**4)
    primary = 0.0 if track.suspension is None else track.suspension.primary_stiffness
    rows = [
        bending + 2 * (pad + track.contact_stiffness) / element_mass,
        2 * (track.contact_stiffness + primary) / track.wheel_mass,
    ]
    if track.suspension is not None:
        secondary, _, body_mass = track.suspension.secondary
        rows.append(2 * (primary + secondary) / track.suspension.bogie_mass)
        rows.append(2 * secondary / (body_mass or 1.0))
    if boot is not None and track.block_mass is not None:
        rows.append((2 * pad + boot.instantaneous) / track.block_mass)
    return 2 / math.sqrt(max(rows))


def paper_memory_order(design: Track, time_step: float) -> int:
    """Return the order of the damping recursion of a run like the paper's: 1, the paper's, wherever it holds.

    The paper's sums of exponentials exceed their integrals by half a step. Springs answer a constant strain
    by so much less than their static stiffness: by less than none where the loss factor is above one, so that
    a run would creep away without bound.

    Parameters
    ----------
    design : TrackDesign or TrackModel
        The track.
    time_step : float
        Time step [s].

    Returns
    -------
    int
        1, or 2 where less than :data:`LEAST_STATIC_SHARE` of a static stiffness would be left.
    """
    for law in track_model(design).springs:
        stiffness, decay, gain = law.recursion(time_step, 1)
        left = stiffness - float(np.sum(gain / (1 - decay)))
        if left < LEAST_STATIC_SHARE * (law.instantaneous - sum(law.strengths)):
            return 2
    return 1


def fewest_bays(design: Track) -> int:
    """Return the fewest supports around a ring (int, odd): twice as many as between the outermost axles."""
    track = track_model(design).design
    span = max(track.axle_positions) - min(track.axle_positions)
    return FEWEST_BAYS + 4 * math.ceil(span / track.fastener_spacing)


def make_grid(
    design: Track,
    time_step: float = PAPER_TIME_STEP,
    elements_per_bay: int = ELEMENTS_PER_BAY,
    bays: int = RING_BAYS,
    record: float = PAPER_RECORD,
) -> Grid:
    """Cut a design into elements and steps, halving the time step until it is stable.

    Parameters
    ----------
    design : TrackDesign or TrackModel
        The track.
    time_step : float
        Time step wanted [s].
    elements_per_bay : int
        Rail elements between supports, two or more.
    bays : int
        Supports around the ring, odd and 17 or more; more are taken where the axles stand far apart.
    record : float
        Length of the record [s].

    Returns
    -------
    Grid
        A stable grid; its notes say when and why the time step was halved.

    Raises
    ------
    RunTooLargeError
        If a run on the grid would need more than 2 GB or 60 s.
    ValueError
        If ``bays`` or ``elements_per_bay`` cannot make a ring, or there is no such time step or record.
    """
    if bays < FEWEST_BAYS or bays % 2 == 0:
        raise ValueError(f"bays = {bays}: give an odd number of {FEWEST_BAYS} or more")
    if elements_per_bay < 2:
        raise ValueError(f"elements_per_bay = {elements_per_bay}: give 2 or more")
    if not (time_step > 0 and record >= SHORTEST_RECORD):
        raise ValueError(
            f"time_step = {time_step!r}, record = {record!r}: give a time step above 0 s "
            f"and a record of {SHORTEST_RECORD} s or more"
        )
    model = track_model(design)
    bays = max(bays, fewest_bays(model))
    dx = model.design.fastener_spacing / elements_per_bay
    stable = stable_time_step(model, dx)
    halvings = max(0, math.floor(math.log2(time_step / stable)) + 1)
    dt = time_step / 2**halvings
    notes: tuple[str, ...] = ()
    if halvings:
        notes = (
            f"time step halved {_times(halvings)} to 1/{1 / dt:.0f} s: this design is stable only below "
            f"{stable * 1e6:.3g} µs",
        )
    symmetric = model.design.axle_positions == ONE_AXLE
    grid = Grid(bays, elements_per_bay, dx, dt, round(record / dt), notes, symmetric)
    _refuse_if_too_large(grid, record)
    return grid


def _times(count: int) -> str:
    return {1: "once", 2: "twice"}.get(count, f"{count} times")


def _refuse_if_too_large(grid: Grid, record: float) -> None:
    seconds = grid.duration_estimate(record)
    if seconds > DURATION_LIMIT:
        raise RunTooLargeError(
            f"this run would take about {seconds:.3g} s ({grid.steps:.3g} steps of {grid.dt:.3g} s on "
            f"{grid.elements} elements), more than the {DURATION_LIMIT:.0f} s allowed: "
            "the stiffness, mass or spacing of this design needs too short a time step"
        )
    needed = grid.memory_estimate(record)
    if needed > MEMORY_LIMIT:
        raise RunTooLargeError(
            f"this run would need about {needed / 1e9:.3g} GB, more than the {MEMORY_LIMIT / 1e9:.0f} GB "
            "allowed: give a shorter record or fewer bays"
        )
