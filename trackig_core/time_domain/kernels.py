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

LANES = 16
"""Stretches into which the half ring is cut, to be stepped side by side [-]: two vectors of eight doubles."""


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
    first: int,
    record: RealArray,
) -> None:
    """Step the half ring through time, and keep a low-passed row of what happens every few steps.

    Forces come from the displacements of one instant; velocities follow, then displacements. The
    memory of each pad and boot is kept as terms R_j [N], of which the force is

        f = k_now e - sum_j R_j,    then    R_j <- decay_j R_j + gain_j e

    so first-order and second-order integration differ only in the numbers k_now, decay and gain.

    The half ring is cut into :data:`LANES` stretches that lie side by side in memory (see
    :mod:`trackig_core.time_domain.memory_layout`), so that every loop below runs over whole vectors; only
    where a stretch begins or ends do its neighbours lie one lane further. On one core of a server of 2024
    with 512-bit vectors (4.1 GHz) a step of the paper's ring takes 0.55 us, which is 50 GFlop/s and 37 % of
    what a loop of nothing but multiply-adds in registers reached in the same run; memory traffic is what
    holds it back, since the 41 kB that a step reads and writes fill the first-level cache.
    ``tests/benchmarks`` measures it.

    Parameters
    ----------
    rail : numpy.ndarray ((elements + 4) * LANES,)
        Displacement of the rail's elements [m], with two rows of ghosts at either end; changed.
    rail_velocity : numpy.ndarray (elements * LANES,)
        Velocity of the rail's elements [m/s]; changed.
    supports : numpy.ndarray (bays, 8 * LANES)
        Per row of supports: displacement [m] and velocity [m/s] of the blocks, three memory terms of
        the pads and three of the boots [N]; changed. All but the pads' stay zero when single-stage.
    wheel : numpy.ndarray (2,)
        Displacement [m] and velocity [m/s] of the wheel; changed.
    window : numpy.ndarray (taps, columns)
        Last rows of the record at full rate; changed.
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
        Factor per step [-] and feed [N/m] of the memory terms.
    element_mass, block_mass, wheel_mass : float
        Masses [kg].
    contact_stiffness : float
        [N/m].
    two_stage : bool
        Whether there are blocks and boots.
    taps : numpy.ndarray (taps,)
        Filter before the record is thinned out, newest row first [-]; a multiple of four of them.
    factor : int
        Time steps per row of the record.
    first : int
        Time steps taken before this call.
    record : numpy.ndarray (rows, columns)
        Filled: force that each support passes into the ground [N], displacement of the wheel, of the
        rail's and of the blocks' probes [m].
    """
    rail_rows = rail.reshape(rail.size // LANES, LANES)
    velocity_rows = rail_velocity.reshape(rail_velocity.size // LANES, LANES)
    count = first
    for kept in range(record.shape[0]):
        for _ in range(factor):
            row = window[count % window.shape[0]]
            fill_ghosts(rail, mirrors)
            record_displacements(row, rail, supports, wheel, rail_probes, block_probes)
            if two_stage:
                step_two_stage(
                    rail_rows, velocity_rows, supports, row, time_step, element_mass, block_mass,
                    pad_stiffness, pad_decay, pad_gain, boot_stiffness, boot_decay, boot_gain,
                )  # fmt: skip
            else:
                step_single_stage(
                    rail_rows, velocity_rows, supports, row, time_step, element_mass,
                    pad_stiffness, pad_decay, pad_gain,
                )  # fmt: skip
            contact = contact_stiffness * (wheel[0] - rail[2 * LANES])
            wheel[1] -= time_step * contact / wheel_mass
            wheel[0] += time_step * wheel[1]
            rail_velocity[0] += time_step * contact / element_mass
            step_rail(rail, rail_velocity, bending, time_step)
            count += 1
        apply_fir(window, count - 1, taps, record[kept])


@njit(nogil=True, cache=True, inline="always")
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
    rail[0], rail[LANES] = rail[mirrors[0]], rail[mirrors[1]]
    rail[end + LANES - 1], rail[end + 2 * LANES - 1] = rail[mirrors[2]], rail[mirrors[3]]
    for lane in range(1, LANES):
        rail[lane] = rail[end - 2 * LANES + lane - 1]
        rail[LANES + lane] = rail[end - LANES + lane - 1]
        rail[end + lane - 1] = rail[2 * LANES + lane]
        rail[end + LANES + lane - 1] = rail[3 * LANES + lane]


@njit(nogil=True, cache=True, inline="always")
def record_displacements(
    row: RealArray,
    rail: RealArray,
    supports: RealArray,
    wheel: RealArray,
    rail_probes: IntArray,
    block_probes: IntArray,
) -> None:
    """Note the displacements that are recorded, behind the forces of a row.

    Parameters
    ----------
    row, rail, supports, wheel, rail_probes, block_probes : numpy.ndarray
        As in :func:`advance`.
    """
    column = supports.shape[0] * LANES
    row[column] = wheel[0]
    for place in rail_probes:
        column += 1
        row[column] = rail[place]
    for place in block_probes:
        column += 1
        row[column] = supports[place // (8 * LANES), place % (8 * LANES)]


@njit(nogil=True, cache=True, fastmath={"contract"}, inline="always")
def viscoelastic_force(
    memory: RealArray,
    place: int,
    strain: float,
    stiffness: float,
    keep0: float,
    keep1: float,
    keep2: float,
    feed0: float,
    feed1: float,
    feed2: float,
) -> float:
    """Return the force of a spring with three memory terms [N], and let the terms take up its strain.

    Parameters
    ----------
    memory : numpy.ndarray
        A row of supports; its terms stand :data:`LANES` places apart from ``place`` on; changed [N].
    place : int
        First term.
    strain : float
        e [m].
    stiffness, keep0, keep1, keep2, feed0, feed1, feed2 : float
        k_now [N/m], decays [-] and gains [N/m].
    """
    term0, term1, term2 = memory[place], memory[place + LANES], memory[place + 2 * LANES]
    memory[place] = keep0 * term0 + feed0 * strain
    memory[place + LANES] = keep1 * term1 + feed1 * strain
    memory[place + 2 * LANES] = keep2 * term2 + feed2 * strain
    return stiffness * strain - (term0 + term1 + term2)


@njit(nogil=True, cache=True, fastmath={"contract"}, inline="always")
def step_two_stage(
    rail_rows: RealArray,
    velocity_rows: RealArray,
    supports: RealArray,
    row: RealArray,
    time_step: float,
    element_mass: float,
    block_mass: float,
    pad_stiffness: float,
    pad_decay: RealArray,
    pad_gain: RealArray,
    boot_stiffness: float,
    boot_decay: RealArray,
    boot_gain: RealArray,
) -> None:
    """Let pads push rail and blocks, boots push blocks and ground; move the blocks.

    Parameters
    ----------
    rail_rows, velocity_rows : numpy.ndarray (elements + 4, LANES) and (elements, LANES)
        Displacements [m], ghosts included, and velocities [m/s] of the rail; the velocities are changed.
    row : numpy.ndarray
        Its first columns are filled with the boots' forces [N].
    supports, time_step, element_mass, block_mass, pad_stiffness, pad_decay, \
pad_gain, boot_stiffness, boot_decay, boot_gain
        As in :func:`advance`.
    """
    bays = supports.shape[0]
    step = velocity_rows.shape[0] // bays
    per_element, per_block = time_step / element_mass, time_step / block_mass
    p0, p1, p2 = pad_decay[0], pad_decay[1], pad_decay[2]
    q0, q1, q2 = pad_gain[0], pad_gain[1], pad_gain[2]
    b0, b1, b2 = boot_decay[0], boot_decay[1], boot_decay[2]
    c0, c1, c2 = boot_gain[0], boot_gain[1], boot_gain[2]
    for bay in range(bays):
        here = supports[bay]
        above = rail_rows[bay * step + 2]
        velocity = velocity_rows[bay * step]
        force = row[bay * LANES : (bay + 1) * LANES]
        for lane in range(LANES):
            block = here[lane]
            pad = viscoelastic_force(
                here, 2 * LANES + lane, above[lane] - block, pad_stiffness, p0, p1, p2, q0, q1, q2
            )
            boot = viscoelastic_force(here, 5 * LANES + lane, block, boot_stiffness, b0, b1, b2, c0, c1, c2)
            force[lane] = boot
            velocity[lane] -= per_element * pad
            block_velocity = here[LANES + lane] + per_block * (pad - boot)
            here[LANES + lane] = block_velocity
            here[lane] = block + time_step * block_velocity


@njit(nogil=True, cache=True, fastmath={"contract"}, inline="always")
def step_single_stage(
    rail_rows: RealArray,
    velocity_rows: RealArray,
    supports: RealArray,
    row: RealArray,
    time_step: float,
    element_mass: float,
    pad_stiffness: float,
    pad_decay: RealArray,
    pad_gain: RealArray,
) -> None:
    """Let pads push rail and ground.

    Parameters
    ----------
    rail_rows, velocity_rows : numpy.ndarray (elements + 4, LANES) and (elements, LANES)
        Displacements [m], ghosts included, and velocities [m/s] of the rail; the velocities are changed.
    row : numpy.ndarray
        Its first columns are filled with the pads' forces [N].
    supports, time_step, element_mass, pad_stiffness, pad_decay, pad_gain
        As in :func:`advance`.
    """
    bays = supports.shape[0]
    step = velocity_rows.shape[0] // bays
    per_element = time_step / element_mass
    p0, p1, p2 = pad_decay[0], pad_decay[1], pad_decay[2]
    q0, q1, q2 = pad_gain[0], pad_gain[1], pad_gain[2]
    for bay in range(bays):
        here = supports[bay]
        above = rail_rows[bay * step + 2]
        velocity = velocity_rows[bay * step]
        force = row[bay * LANES : (bay + 1) * LANES]
        for lane in range(LANES):
            pad = viscoelastic_force(
                here, 2 * LANES + lane, above[lane], pad_stiffness, p0, p1, p2, q0, q1, q2
            )
            force[lane] = pad
            velocity[lane] -= per_element * pad


@njit(nogil=True, cache=True, fastmath={"contract"}, inline="always")
def step_rail(
    rail: RealArray,
    rail_velocity: RealArray,
    bending: float,
    time_step: float,
) -> None:
    """Let the rail straighten itself, and move it.

    Parameters
    ----------
    rail, rail_velocity, bending, time_step
        As in :func:`advance`.
    """
    for place in range(rail_velocity.size):
        rail_velocity[place] -= bending * (
            rail[place]
            + rail[place + 4 * LANES]
            - 4.0 * (rail[place + LANES] + rail[place + 3 * LANES])
            + 6.0 * rail[place + 2 * LANES]
        )
    for place in range(rail_velocity.size):
        rail[place + 2 * LANES] += time_step * rail_velocity[place]


@njit(nogil=True, cache=True, fastmath={"contract"}, inline="always")
def apply_fir(
    window: RealArray,
    newest: int,
    taps: RealArray,
    kept: RealArray,
) -> None:
    """Sum the rows of a window, each times its coefficient of a filter.

    Parameters
    ----------
    window : numpy.ndarray (taps, columns)
        Rows; row n of all that there were lies at n modulo their number.
    newest : int
        Number of the newest.
    taps : numpy.ndarray (taps,)
        Coefficients, newest first [-]; a multiple of four of them.
    kept : numpy.ndarray (columns,)
        Filled.
    """
    rows = window.shape[0]
    kept[:] = 0.0
    for tap in range(0, taps.size, 4):
        row0, row1 = window[(newest - tap) % rows], window[(newest - tap - 1) % rows]
        row2, row3 = window[(newest - tap - 2) % rows], window[(newest - tap - 3) % rows]
        h0, h1, h2, h3 = taps[tap], taps[tap + 1], taps[tap + 2], taps[tap + 3]
        for column in range(kept.size):
            kept[column] += (h0 * row0[column] + h1 * row1[column]) + (h2 * row2[column] + h3 * row3[column])


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
