"""Compiled inner loops: the time step of the lattice, and the low-pass filter of its record.

Arrays and floats go in, arrays are changed in place; SI units. The update lines are the paper's (see
:mod:`trackig_core.track.design`), its brackets and the rail's sign mended. The drawing in
:mod:`trackig_core.time_domain.grid` shows which element lies where on the track,
:mod:`trackig_core.time_domain.memory_layout` where in memory.

No objects, no I/O, and no globals but this file's own constants. Numba's disk cache notices
neither a changed global nor an edit in another file.
"""

from trackig_core.arrays import IntArray, RealArray
from trackig_core.compiling import njit
from trackig_core.time_domain.vectors import (
    WIDTH,
    Vector,
    first_lane,
    load,
    one_lane_down,
    one_lane_up,
    spread,
    store,
)

LANES = WIDTH
"""Stretches into which the half ring is cut, to be stepped side by side [-]: a vector."""

QUANTITIES = 8
"""Rows of lanes per row of supports: block, its velocity, three memory terms of pad and of boot."""


@njit(nogil=True, cache=True, fastmath={"contract"})
def advance(
    rail: RealArray,
    rail_velocity: RealArray,
    supports: RealArray,
    wheel: RealArray,
    window: RealArray,
    mirrors: IntArray,
    rail_probes: IntArray,
    block_probes: IntArray,
    time_step: float,
    bending: float,
    pad_stiffness: float,
    pad_decay: RealArray,
    pad_gain: RealArray,
    boot_stiffness: float,
    boot_decay: RealArray,
    boot_gain: RealArray,
    element_mass: float,
    block_mass: float,
    wheel_mass: float,
    contact_stiffness: float,
    two_stage: bool,
    taps: RealArray,
    factor: int,
    record: RealArray,
) -> None:
    """Step the half ring through time, and keep a low-passed row of what happens every few steps.

    Forces come from the displacements of one instant; velocities follow, then displacements. The
    memory of each pad and boot is kept as terms z_j [m], of which the force is

        f = k_now e - sum_j gain_j z_j,    then    z_j <- decay_j z_j + e

    so first-order and second-order integration differ only in the numbers k_now, decay and gain.

    The half ring is cut into :data:`LANES` stretches that lie side by side in memory (see
    :mod:`trackig_core.time_domain.memory_layout`), so that one vector holds the same element of each; only
    where a stretch begins or ends do its neighbours lie one lane further. A step is one sweep along the
    stretches, which reads and writes each quantity once.

    Parameters
    ----------
    rail : numpy.ndarray ((elements + 4) * LANES,)
        Displacement of the rail's elements [m], with two rows of ghosts at either end; changed.
    rail_velocity : numpy.ndarray (elements * LANES,)
        Velocity of the rail's elements [m/s]; changed.
    supports : numpy.ndarray (bays, QUANTITIES * LANES)
        Per row of supports: displacement [m] and velocity [m/s] of the blocks, three memory terms of
        the pads and three of the boots [m]; changed. All but the pads' stay zero when single-stage.
    wheel : numpy.ndarray (2,)
        Displacement [m] and velocity [m/s] of the wheel; changed.
    window : numpy.ndarray (factor + sums + 1, columns)
        Rows of the record at full rate since a row was last kept; sums for the next rows to be kept, of which
        they are parts; a row of zeros. All but the last are changed.
    mirrors : numpy.ndarray of int (4,)
        Places of the elements that the ghosts beyond both ends of the half ring mirror.
    rail_probes, block_probes : numpy.ndarray of int
        Places in ``rail``, and in ``supports`` as one row, whose displacement is recorded.
    time_step : float
        dt [s].
    bending : float
        dt EI / (m' dx^4) [1/s].
    pad_stiffness, boot_stiffness : float
        k_now [N/m].
    pad_decay, pad_gain, boot_decay, boot_gain : numpy.ndarray (3,)
        Factor per step [-] and share in the force [N/m] of the memory terms.
    element_mass, block_mass, wheel_mass : float
        Masses [kg].
    contact_stiffness : float
        [N/m].
    two_stage : bool
        Whether there are blocks and boots.
    taps : numpy.ndarray (taps,)
        Filter before the record is thinned out, newest row first [-]; at least ``sums * factor`` of them.
    factor : int
        Time steps per row of the record.
    record : numpy.ndarray (rows, columns)
        Filled: force that each support passes into the ground [N], displacement of the wheel, of the
        rail's and of the blocks' probes [m].
    """
    bays, columns = supports.shape[0], record.shape[1]
    per_bay = rail_velocity.size // (bays * LANES)
    per_element, per_block = time_step / element_mass, time_step / block_mass
    state, rows = supports.reshape(supports.size), window.reshape(window.size)
    kept_rows = record.reshape(record.size)
    for kept in range(record.shape[0]):
        for since in range(factor):
            row = since * columns
            fill_ghosts(rail, mirrors)
            record_displacements(rows, row + bays * LANES, rail, state, wheel, rail_probes, block_probes)
            contact = contact_stiffness * (wheel[0] - rail[2 * LANES])
            wheel[1] -= time_step * contact / wheel_mass
            wheel[0] += time_step * wheel[1]
            sweep(
                rail, rail_velocity, state, rows, row, bays, per_bay, per_element * contact, time_step,
                bending, per_element, per_block, pad_stiffness, pad_decay, pad_gain, boot_stiffness,
                boot_decay, boot_gain, two_stage,
            )  # fmt: skip
        sum_up(rows, columns, factor, window.shape[0] - factor - 1, taps)
        for column in range(0, columns, WIDTH):
            store(kept_rows, kept * columns + column, load(rows, factor * columns + column))


@njit(nogil=True, cache=True)
def fill_ghosts(
    rail: RealArray,
    mirrors: IntArray,
) -> None:
    """Fill the ghosts: with the next stretch's elements, and with mirror images at both ends.

    Parameters
    ----------
    rail, mirrors : numpy.ndarray
        As in :func:`advance`.
    """
    end = rail.size - 2 * LANES
    store(rail, 0, one_lane_up(load(rail, end - 2 * LANES), rail[mirrors[0]]))
    store(rail, LANES, one_lane_up(load(rail, end - LANES), rail[mirrors[1]]))
    store(rail, end, one_lane_down(load(rail, 2 * LANES), rail[mirrors[2]]))
    store(rail, end + LANES, one_lane_down(load(rail, 3 * LANES), rail[mirrors[3]]))


@njit(nogil=True, cache=True)
def record_displacements(
    rows: RealArray,
    place: int,
    rail: RealArray,
    supports: RealArray,
    wheel: RealArray,
    rail_probes: IntArray,
    block_probes: IntArray,
) -> None:
    """Note the displacements that are recorded, behind the forces of a row.

    Parameters
    ----------
    rows : numpy.ndarray
        Filled from ``place`` on.
    place : int
        Where the first displacement goes.
    rail, supports, wheel, rail_probes, block_probes : numpy.ndarray
        As in :func:`advance`, ``supports`` as one row.
    """
    rows[place] = wheel[0]
    for probe in range(rail_probes.size):
        rows[place + 1 + probe] = rail[rail_probes[probe]]
    place += 1 + rail_probes.size
    for probe in range(block_probes.size):
        rows[place + probe] = supports[block_probes[probe]]


@njit(nogil=True, cache=True, fastmath={"contract"})
def sweep(
    rail: RealArray,
    rail_velocity: RealArray,
    supports: RealArray,
    forces: RealArray,
    force_place: int,
    bays: int,
    per_bay: int,
    kick: float,
    time_step: float,
    bending: float,
    per_element: float,
    per_block: float,
    pad_stiffness: float,
    pad_decay: RealArray,
    pad_gain: RealArray,
    boot_stiffness: float,
    boot_decay: RealArray,
    boot_gain: RealArray,
    two_stage: bool,
) -> None:
    """Let rail, pads and boots push, and move rail and blocks, in one sweep along the stretches.

    Displacements that a later element needs as they were are kept in registers: two behind the element that
    moves, itself, and two ahead.

    Parameters
    ----------
    forces : numpy.ndarray
        Filled with what the supports pass into the ground [N], from ``force_place`` on.
    force_place, bays, per_bay : int
        See ``forces``; bays in each stretch, elements in each bay.
    kick : float
        What the contact force adds to the velocity of the first element [m/s].
    per_element, per_block : float
        Time step over the mass of an element and of a block [s/kg].
    rail, rail_velocity, supports, time_step, bending, pad_stiffness, pad_decay, pad_gain, \
boot_stiffness, boot_decay, boot_gain, two_stage
        As in :func:`advance`, ``supports`` as one row; the first three are changed.
    """
    dt, k1, k4, k6 = spread(time_step), spread(-bending), spread(4.0 * bending), spread(-6.0 * bending)
    push_rail, push_block = spread(-per_element), spread(per_block)
    pad_k, boot_k = spread(pad_stiffness), spread(boot_stiffness)
    p0, p1, p2 = spread(pad_decay[0]), spread(pad_decay[1]), spread(pad_decay[2])
    q0, q1, q2 = spread(pad_gain[0]), spread(pad_gain[1]), spread(pad_gain[2])
    b0, b1, b2 = spread(boot_decay[0]), spread(boot_decay[1]), spread(boot_decay[2])
    c0, c1, c2 = spread(boot_gain[0]), spread(boot_gain[1]), spread(boot_gain[2])
    extra, nothing = first_lane(kick), spread(0.0)
    behind2, behind1 = load(rail, 0), load(rail, LANES)
    here, ahead1 = load(rail, 2 * LANES), load(rail, 3 * LANES)
    place = 0
    for bay in range(bays):
        support = bay * QUANTITIES * LANES
        if two_stage:
            block = load(supports, support)
            pad = viscoelastic_force(
                supports, support + 2 * LANES, here - block, pad_k, p0, p1, p2, q0, q1, q2
            )
            force = viscoelastic_force(supports, support + 5 * LANES, block, boot_k, b0, b1, b2, c0, c1, c2)
            block_velocity = load(supports, support + LANES) + push_block * (pad - force)
            store(supports, support + LANES, block_velocity)
            store(supports, support, block + dt * block_velocity)
        else:
            pad = viscoelastic_force(supports, support + 2 * LANES, here, pad_k, p0, p1, p2, q0, q1, q2)
            force = pad
        store(forces, force_place + bay * LANES, force)
        extra = extra + push_rail * pad
        for _ in range(per_bay):
            ahead2 = load(rail, place + 4 * LANES)
            velocity = load(rail_velocity, place) + extra + k1 * (behind2 + ahead2)
            velocity = velocity + k4 * (behind1 + ahead1) + k6 * here
            store(rail_velocity, place, velocity)
            store(rail, place + 2 * LANES, here + dt * velocity)
            behind2, behind1, here, ahead1 = behind1, here, ahead1, ahead2
            extra = nothing
            place += LANES


# Not cached itself, only within those that call it: a signature of vectors, read back by another version
# of their type, would end in an error.
@njit(nogil=True, fastmath={"contract"})
def viscoelastic_force(
    memory: RealArray,
    place: int,
    strain: Vector,
    stiffness: Vector,
    keep0: Vector,
    keep1: Vector,
    keep2: Vector,
    gain0: Vector,
    gain1: Vector,
    gain2: Vector,
) -> Vector:
    """Return the force of springs with three memory terms [N], and let the terms take up their strain.

    Parameters
    ----------
    memory : numpy.ndarray
        Supports as one row; the terms stand :data:`LANES` places apart from ``place`` on; changed [m].
    place : int
        First term.
    strain : Vector
        e [m].
    stiffness, keep0, keep1, keep2, gain0, gain1, gain2 : Vector
        k_now [N/m], decays [-] and gains [N/m].
    """
    term0, term1, term2 = load(memory, place), load(memory, place + LANES), load(memory, place + 2 * LANES)
    store(memory, place, keep0 * term0 + strain)
    store(memory, place + LANES, keep1 * term1 + strain)
    store(memory, place + 2 * LANES, keep2 * term2 + strain)
    return stiffness * strain - gain0 * term0 - gain1 * term1 - gain2 * term2


@njit(nogil=True, cache=True, fastmath={"contract"})
def sum_up(
    rows: RealArray,
    columns: int,
    factor: int,
    sums: int,
    taps: RealArray,
) -> None:
    """Let the rows that came since a row was last kept enter the sums of which they are parts.

    A row of a record that is filtered, then thinned out, is a sum over ``sums`` groups of ``factor``
    rows. Each group enters all the sums that it is part of at once, so that it need not be kept.

    Parameters
    ----------
    rows : numpy.ndarray
        The window of :func:`advance` as one row. The first sum is complete afterwards.
    columns, factor, sums : int
        Columns of the window, rows of a group, groups.
    taps : numpy.ndarray
        As in :func:`advance`.
    """
    for group in range(sums):
        to = (factor + group) * columns
        newest = group * factor + factor - 1
        fours = factor - factor % 4
        for column in range(0, columns, WIDTH):
            store(rows, to + column, load(rows, to + columns + column))
        for step in range(0, fours, 4):
            place = step * columns
            h0, h1 = spread(taps[newest - step]), spread(taps[newest - step - 1])
            h2, h3 = spread(taps[newest - step - 2]), spread(taps[newest - step - 3])
            for column in range(place, place + columns, WIDTH):
                pair = h0 * load(rows, column) + h1 * load(rows, column + columns)
                other = h2 * load(rows, column + 2 * columns) + h3 * load(rows, column + 3 * columns)
                total = to + column - place
                store(rows, total, load(rows, total) + pair + other)
        for step in range(fours, factor):
            place = step * columns
            h0 = spread(taps[newest - step])
            for column in range(place, place + columns, WIDTH):
                total = to + column - place
                store(rows, total, load(rows, total) + h0 * load(rows, column))


@njit(nogil=True, cache=True, fastmath={"contract"})
def decimate(
    record: RealArray,
    taps: RealArray,
    factor: int,
    samples: RealArray,
) -> None:
    """Low-pass every column of a record and keep one row in ``factor``.

    Parameters
    ----------
    record : numpy.ndarray (taps - 1 + rows, columns)
        Record; its first ``taps - 1`` rows come from before.
    taps : numpy.ndarray (taps,)
        Coefficients of a symmetric filter [-]; a multiple of four of them.
    factor : int
        Rows per kept sample.
    samples : numpy.ndarray (rows // factor, columns)
        Filled with the kept samples [unit of the record].
    """
    for sample in range(samples.shape[0]):
        kept = samples[sample]
        kept[:] = 0.0
        start = sample * factor
        # Four taps at a time: the sums stay in cache while the record streams past once.
        for tap in range(0, taps.size, 4):
            row0 = record[start + tap]
            row1 = record[start + tap + 1]
            row2 = record[start + tap + 2]
            row3 = record[start + tap + 3]
            h0, h1, h2, h3 = taps[tap], taps[tap + 1], taps[tap + 2], taps[tap + 3]
            for column in range(kept.size):
                kept[column] += (h0 * row0[column] + h1 * row1[column]) + (
                    h2 * row2[column] + h3 * row3[column]
                )
