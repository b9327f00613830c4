"""Compiled inner loop: the time step of the lattice under any wheels, what they carry, and on any ground.

What :mod:`trackig_core.time_domain.kernels` does for one unsprung wheel on rigid ground, here with wheels on
any rail element, bogies and bodies above them and feet that move; the same scheme, but elements lie in order,
along half of the ring or all of it. Arrays and floats go in, arrays are changed in place; SI units. Source of
the model: the paper (see :mod:`trackig_core.track.design`).

Velocities stand half-way between displacements. A dashpot of the vehicle feels the mean of the velocity
before and the velocity after, so that wheel, bogie and body of one axle are solved together, by matrices that
never change. The foot of a support follows the trapezoidal rule, T = 2/dt:

    y[n] = T u[n] - p,    z[n] = T y[n] - r,    p <- T u[n] + y[n],    r <- T y[n] + z[n]

with y its velocity and z its acceleration. The force of the spring above it, k u + c y + m z, is thus
(k + c T + m T^2) u - (c + m T) p - m r, and u follows from the same instant's displacements: it needs no mass
and makes no time step unstable.

No objects, no I/O, and no globals but this file's own constants. Numba's disk cache notices neither a changed
global nor an edit in another file.
"""

from trackig_core.arrays import IntArray, RealArray
from trackig_core.compiling import njit

LANES = 16
"""Supports that are stepped side by side [-]: two vectors of eight doubles."""

QUANTITIES = 10
"""Rows of lanes per group of supports: block, its velocity, three memory terms of pad and of boot, p, r."""


@njit(nogil=True, cache=True, fastmath={"contract"})
def advance(
    rail: RealArray,
    rail_velocity: RealArray,
    supports: RealArray,
    wheels: RealArray,
    window: RealArray,
    over: RealArray,
    pushed: RealArray,
    clock: IntArray,
    mirrors: IntArray,
    wheel_places: IntArray,
    onsets: RealArray,
    rail_probes: IntArray,
    block_probes: IntArray,
    foot_probes: IntArray,
    time_step: float,
    bending: float,
    pad: RealArray,
    boot: RealArray,
    element_mass: float,
    block_mass: float,
    contact_stiffness: float,
    step: float,
    keep: RealArray,
    spring: RealArray,
    push: RealArray,
    foot: RealArray,
    bays: int,
    two_stage: bool,
    taps: RealArray,
    factor: int,
    record: RealArray,
) -> None:
    """Step the ring, or half of it, through time, and keep a low-passed row of what happens every few steps.

    Parameters
    ----------
    rail : numpy.ndarray (elements + 4,)
        Displacement of the rail's elements [m], with two ghosts at either end; changed.
    rail_velocity : numpy.ndarray (elements,)
        Velocity of the rail's elements [m/s]; changed.
    supports : numpy.ndarray (groups, 10 * LANES)
        Per group of supports: displacement [m] and velocity [m/s] of the blocks, three memory terms of the
        pads and three of the boots [N], p [m/s] and r [m/s2] of the feet; changed.
    wheels : numpy.ndarray (wheels, 6)
        Displacements [m] of wheel, bogie and body, and their velocities [m/s]; changed.
    window : numpy.ndarray (taps, columns)
        Last rows of the record at full rate; changed.
    over, pushed : numpy.ndarray (groups * LANES,)
        Workspace: rail displacements over the supports [m], forces of the supports on the rail [N].
    clock : numpy.ndarray of int (1,)
        Time steps taken; changed.
    mirrors : numpy.ndarray of int (4,)
        Places in ``rail`` from which the ghosts take their displacements.
    wheel_places : numpy.ndarray of int (wheels,)
        Places in ``rail`` of the elements under the wheels.
    onsets : numpy.ndarray (wheels,)
        When the step of roughness reaches each wheel, in time steps [-].
    rail_probes, block_probes : numpy.ndarray of int
        Places in ``rail``, and in ``supports`` as one row, whose displacement is recorded.
    foot_probes : numpy.ndarray of int
        Places in ``supports`` as one row of p of the feet whose displacement is recorded.
    time_step : float
        dt [s].
    bending : float
        dt EI / (m' dx^4) [1/s].
    pad, boot : numpy.ndarray (7,)
        Stiffness against the current strain [N/m], factor per step [-] and feed [N/m] of three memory terms.
    element_mass, block_mass : float
        Masses [kg].
    contact_stiffness : float
        [N/m].
    step : float
        Height of the step of roughness [m].
    keep, spring : numpy.ndarray (3, 3)
        What the velocities [-] and the displacements [1/s] of an axle add to its velocities after the step.
    push : numpy.ndarray (3,)
        What a force on the wheel adds to them [m/s per N].
    foot : numpy.ndarray (3,)
        Displacement of the foot per force [m/N] (0: rigid ground), dashpot [N s/m] and mass [kg].
    bays : int
        Supports that are stepped.
    two_stage : bool
        Whether there are blocks and boots.
    taps : numpy.ndarray (taps,)
        Filter before the record is thinned out, newest row first [-].
    factor : int
        Time steps per row of the record.
    record : numpy.ndarray (rows, columns)
        Filled: force that each support passes into the ground [N]; displacement of the wheels against rail
        without roughness, of the rail's, the blocks' and the feet's probes [m].
    """
    per_bay = rail_velocity.size // bays
    per_element = time_step / element_mass
    count = clock[0]
    for kept in range(record.shape[0]):
        for _ in range(factor):
            row = window[count % window.shape[0]]
            for ghost in range(2):
                rail[ghost] = rail[mirrors[ghost]]
                rail[rail.size - 2 + ghost] = rail[mirrors[2 + ghost]]
            for bay in range(bays):
                over[bay] = rail[2 + bay * per_bay]
            column = over.size
            for wheel in range(wheels.shape[0]):
                row[column] = wheels[wheel, 0] + step * come(count, onsets[wheel])
                column += 1
            for place in rail_probes:
                row[column] = rail[place]
                column += 1
            for place in block_probes:
                row[column] = supports[place // (QUANTITIES * LANES), place % (QUANTITIES * LANES)]
                column += 1
            for probe in range(foot_probes.size):
                place = foot_probes[probe]
                row[column + probe] = supports[place // (QUANTITIES * LANES), place % (QUANTITIES * LANES)]
            if two_stage:
                step_two_stage(supports, over, pushed, row, time_step, block_mass, pad, boot, foot)
            else:
                step_single_stage(supports, over, pushed, row, time_step, pad, foot)
            for probe in range(foot_probes.size):
                place = foot_probes[probe]
                # p before and after, -y + T u and T u + y, sum up to 2 T u
                row[column + probe] += supports[place // (QUANTITIES * LANES), place % (QUANTITIES * LANES)]
                row[column + probe] *= time_step / 4.0
            for bay in range(bays):
                rail_velocity[bay * per_bay] -= per_element * pushed[bay]
            for wheel in range(wheels.shape[0]):
                place = wheel_places[wheel]
                squeezed = wheels[wheel, 0] + step * come(count, onsets[wheel]) - rail[place]
                contact = contact_stiffness * squeezed
                rail_velocity[place - 2] += per_element * contact
                step_axle(wheels[wheel], -contact, time_step, keep, spring, push)
            step_rail(rail, rail_velocity, bending, time_step)
            count += 1
        weigh_rows(window, count - 1, taps, record[kept])
    clock[0] = count


@njit(nogil=True, cache=True, inline="always")
def come(count: int, onset: float) -> float:
    """Return how much of a step of roughness has come after some time steps [-]: 0 to 1.

    A step that comes between two instants is shared out between them.
    """
    return min(max(count + 1.0 - onset, 0.0), 1.0)


@njit(nogil=True, cache=True, fastmath={"contract"}, inline="always")
def viscoelastic_force(memory: RealArray, place: int, strain: float, law: RealArray) -> float:
    """Return the force of a spring with three memory terms [N], and let the terms take up its strain.

    Parameters
    ----------
    memory : numpy.ndarray
        A group of supports; its terms stand :data:`LANES` places apart from ``place`` on; changed [N].
    place : int
        First term.
    strain : float
        e [m].
    law : numpy.ndarray (7,)
        As ``pad`` of :func:`advance`.
    """
    term0, term1, term2 = memory[place], memory[place + LANES], memory[place + 2 * LANES]
    memory[place] = law[1] * term0 + law[4] * strain
    memory[place + LANES] = law[2] * term1 + law[5] * strain
    memory[place + 2 * LANES] = law[3] * term2 + law[6] * strain
    return law[0] * strain - (term0 + term1 + term2)


@njit(nogil=True, cache=True, fastmath={"contract"}, inline="always")
def foot_displacement(
    here: RealArray, lane: int, memory: int, above: float, law: RealArray, foot: RealArray, rate: float
) -> float:
    """Return the displacement of a foot [m] from that of the upper end of the spring that stands on it.

    Parameters
    ----------
    here : numpy.ndarray (10 * LANES,)
        A group of supports.
    lane : int
        Which of them.
    memory : int
        First memory term of the spring.
    above : float
        Displacement of its upper end [m].
    law, foot : numpy.ndarray
        As ``boot`` and ``foot`` of :func:`advance`.
    rate : float
        T = 2/dt [1/s].
    """
    remembered = here[memory] + here[memory + LANES] + here[memory + 2 * LANES]
    p, r = here[8 * LANES + lane], here[9 * LANES + lane]
    return foot[0] * (law[0] * above - remembered + (foot[1] + foot[2] * rate) * p + foot[2] * r)


@njit(nogil=True, cache=True, fastmath={"contract"}, inline="always")
def move_foot(
    here: RealArray, lane: int, displacement: float, force: float, foot: RealArray, rate: float
) -> float:
    """Move a foot on, and return the force that reaches the ground proper [N].

    Parameters
    ----------
    here, lane, foot, rate
        As in :func:`foot_displacement`.
    displacement : float
        Its displacement [m].
    force : float
        Force of the spring above it [N].
    """
    velocity = rate * displacement - here[8 * LANES + lane]
    acceleration = rate * velocity - here[9 * LANES + lane]
    here[8 * LANES + lane] = rate * displacement + velocity
    here[9 * LANES + lane] = rate * velocity + acceleration
    return force - foot[2] * acceleration


@njit(nogil=True, cache=True, fastmath={"contract"}, inline="always")
def step_two_stage(
    supports: RealArray,
    over: RealArray,
    pushed: RealArray,
    row: RealArray,
    time_step: float,
    block_mass: float,
    pad: RealArray,
    boot: RealArray,
    foot: RealArray,
) -> None:
    """Let pads push rail and blocks, boots push blocks and feet; move blocks and feet.

    Parameters
    ----------
    row : numpy.ndarray
        Its first columns are filled with the forces into the ground [N].
    supports, over, pushed, time_step, block_mass, pad, boot, foot
        As in :func:`advance`.
    """
    per_block, rate = time_step / block_mass, 2.0 / time_step
    for group in range(supports.shape[0]):
        here = supports[group]
        above = over[group * LANES : (group + 1) * LANES]
        push, into = pushed[group * LANES : (group + 1) * LANES], row[group * LANES : (group + 1) * LANES]
        for lane in range(LANES):
            block = here[lane]
            upper = viscoelastic_force(here, 2 * LANES + lane, above[lane] - block, pad)
            below = foot_displacement(here, lane, 5 * LANES + lane, block, boot, foot, rate)
            lower = viscoelastic_force(here, 5 * LANES + lane, block - below, boot)
            into[lane] = move_foot(here, lane, below, lower, foot, rate)
            push[lane] = upper
            block_velocity = here[LANES + lane] + per_block * (upper - lower)
            here[LANES + lane] = block_velocity
            here[lane] = block + time_step * block_velocity


@njit(nogil=True, cache=True, fastmath={"contract"}, inline="always")
def step_single_stage(
    supports: RealArray,
    over: RealArray,
    pushed: RealArray,
    row: RealArray,
    time_step: float,
    pad: RealArray,
    foot: RealArray,
) -> None:
    """Let pads push rail and feet; move the feet.

    Parameters
    ----------
    row : numpy.ndarray
        Its first columns are filled with the forces into the ground [N].
    supports, over, pushed, time_step, pad, foot
        As in :func:`advance`.
    """
    rate = 2.0 / time_step
    for group in range(supports.shape[0]):
        here = supports[group]
        above = over[group * LANES : (group + 1) * LANES]
        push, into = pushed[group * LANES : (group + 1) * LANES], row[group * LANES : (group + 1) * LANES]
        for lane in range(LANES):
            below = foot_displacement(here, lane, 2 * LANES + lane, above[lane], pad, foot, rate)
            force = viscoelastic_force(here, 2 * LANES + lane, above[lane] - below, pad)
            into[lane] = move_foot(here, lane, below, force, foot, rate)
            push[lane] = force


@njit(nogil=True, cache=True, fastmath={"contract"}, inline="always")
def step_axle(
    axle: RealArray,
    force: float,
    time_step: float,
    keep: RealArray,
    spring: RealArray,
    push: RealArray,
) -> None:
    """Move wheel, bogie and body of one axle.

    Parameters
    ----------
    axle : numpy.ndarray (6,)
        Displacements [m] and velocities [m/s]; changed.
    force : float
        Force on the wheel [N].
    time_step, keep, spring, push
        As in :func:`advance`.
    """
    u0, u1, u2, v0, v1, v2 = axle[0], axle[1], axle[2], axle[3], axle[4], axle[5]
    for part in range(3):
        velocity = (
            (keep[part, 0] * v0 + keep[part, 1] * v1 + keep[part, 2] * v2)
            + (spring[part, 0] * u0 + spring[part, 1] * u1 + spring[part, 2] * u2)
            + push[part] * force
        )
        axle[3 + part] = velocity
        axle[part] += time_step * velocity


@njit(nogil=True, cache=True, fastmath={"contract"}, inline="always")
def step_rail(rail: RealArray, rail_velocity: RealArray, bending: float, time_step: float) -> None:
    """Let the rail straighten itself, and move it.

    Parameters
    ----------
    rail, rail_velocity, bending, time_step
        As in :func:`advance`.
    """
    for place in range(rail_velocity.size):
        rail_velocity[place] -= bending * (
            rail[place] + rail[place + 4] - 4.0 * (rail[place + 1] + rail[place + 3]) + 6.0 * rail[place + 2]
        )
    for place in range(rail_velocity.size):
        rail[place + 2] += time_step * rail_velocity[place]


@njit(nogil=True, cache=True, fastmath={"contract"}, inline="always")
def weigh_rows(window: RealArray, newest: int, taps: RealArray, kept: RealArray) -> None:
    """Sum the rows of a window, each times its coefficient of a filter.

    Parameters
    ----------
    window : numpy.ndarray (taps, columns)
        Rows; row n of all that there were lies at n modulo their number.
    newest : int
        Number of the newest.
    taps : numpy.ndarray (taps,)
        Coefficients, newest first [-].
    kept : numpy.ndarray (columns,)
        Filled.
    """
    rows = window.shape[0]
    kept[:] = 0.0
    for tap in range(taps.size):
        row, weight = window[(newest - tap) % rows], taps[tap]
        for column in range(kept.size):
            kept[column] += weight * row[column]
