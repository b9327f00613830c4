"""Compiled inner loops: the time step of the lattice, and the low-pass filter of its record.

Arrays and floats go in, arrays are changed in place; SI units. The update lines are the paper's
(see :mod:`trackig_core.design`), its brackets and the rail's sign mended. The drawing in
:mod:`trackig_core.grid` shows which element lies where.

The one rule: no objects, no I/O and no globals. Numba's disk cache notices neither a changed global
nor an edit in another file.
"""

from numba import njit


@njit(nogil=True, cache=True, fastmath={"contract"})
def advance(
    rail,
    rail_velocity,
    block,
    block_velocity,
    wheel,
    pad_memory,
    boot_memory,
    compression,
    pad_force,
    time_step,
    bending,
    pad_stiffness,
    pad_decay,
    pad_gain,
    boot_stiffness,
    boot_decay,
    boot_gain,
    element_mass,
    block_mass,
    wheel_mass,
    contact_stiffness,
    two_stage,
    record,
):
    """Step the half ring through as many time steps as ``record`` has rows.

    Forces come from the displacements of one instant; velocities follow, then displacements. The
    memory of each pad and boot is kept as terms R_j [N], of which the force is

        f = k_now e - sum_j R_j,    then    R_j <- decay_j R_j + gain_j e

    so first-order and second-order integration differ only in the numbers k_now, decay and gain.

    Parameters
    ----------
    rail : numpy.ndarray (elements_per_bay, bays + 2)
        Displacement of the rail's elements [m], with a ghost bay at either end; changed.
    rail_velocity : numpy.ndarray (elements_per_bay, bays)
        Velocity of the rail's elements [m/s]; changed.
    block, block_velocity : numpy.ndarray (bays,)
        Displacement [m] and velocity [m/s] of the blocks; changed. At rest when single-stage.
    wheel : numpy.ndarray (2,)
        Displacement [m] and velocity [m/s] of the wheel; changed.
    pad_memory, boot_memory : numpy.ndarray (terms, bays)
        Memory terms [N]; changed.
    compression, pad_force : numpy.ndarray (bays,)
        Working space.
    time_step : float
        dt [s].
    bending : float
        dt EI / (m' dx^4) [1/s].
    pad_stiffness, boot_stiffness : float
        k_now [N/m].
    pad_decay, pad_gain, boot_decay, boot_gain : numpy.ndarray (terms,)
        Factor per step [-] and feed [N/m] of the memory terms.
    element_mass, block_mass, wheel_mass : float
        Masses [kg].
    contact_stiffness : float
        [N/m].
    two_stage : bool
        Whether there are blocks and boots.
    record : numpy.ndarray (steps, bays + 2)
        Filled: force that each support passes into the ground [N], then displacement of rail and
        block at the loaded support [m].
    """
    per_bay, bays = rail_velocity.shape
    for step in range(record.shape[0]):
        # Mirror the two neighbours on either side of the half ring into the ghost bays.
        for offset in range(1, 3):
            rail[-offset % per_bay, 1 + (-offset // per_bay)] = rail[offset % per_bay, 1 + offset // per_bay]
        for row in range(2):
            rail[row, bays + 1] = rail[-row % per_bay, bays + (-row // per_bay)]

        for row in range(per_bay):
            velocity = rail_velocity[row]
            first = 1 + (row - 2) // per_bay
            second = 1 + (row - 1) // per_bay
            fourth = 1 + (row + 1) // per_bay
            fifth = 1 + (row + 2) // per_bay
            far_left = rail[(row - 2) % per_bay, first : first + bays]
            left = rail[(row - 1) % per_bay, second : second + bays]
            here = rail[row, 1 : 1 + bays]
            right = rail[(row + 1) % per_bay, fourth : fourth + bays]
            far_right = rail[(row + 2) % per_bay, fifth : fifth + bays]
            for bay in range(bays):
                velocity[bay] -= bending * (
                    far_left[bay] + far_right[bay] - 4.0 * (left[bay] + right[bay]) + 6.0 * here[bay]
                )

        loaded = rail[0, 1 : 1 + bays]
        for bay in range(bays):
            compression[bay] = loaded[bay] - block[bay]
            pad_force[bay] = pad_stiffness * compression[bay]
        remember(pad_force, compression, pad_memory, pad_decay, pad_gain)

        force = record[step, :bays]
        if two_stage:
            for bay in range(bays):
                force[bay] = boot_stiffness * block[bay]
            remember(force, block, boot_memory, boot_decay, boot_gain)
        else:
            for bay in range(bays):
                force[bay] = pad_force[bay]
        record[step, bays] = loaded[0]
        record[step, bays + 1] = block[0]

        per_element_mass = time_step / element_mass
        supported = rail_velocity[0]
        for bay in range(bays):
            supported[bay] -= per_element_mass * pad_force[bay]
        contact = contact_stiffness * (wheel[0] - loaded[0])
        wheel[1] -= time_step * contact / wheel_mass
        supported[0] += per_element_mass * contact
        wheel[0] += time_step * wheel[1]

        for row in range(per_bay):
            here = rail[row, 1 : 1 + bays]
            velocity = rail_velocity[row]
            for bay in range(bays):
                here[bay] += time_step * velocity[bay]
        if two_stage:
            per_block_mass = time_step / block_mass
            for bay in range(bays):
                block_velocity[bay] += per_block_mass * (pad_force[bay] - force[bay])
                block[bay] += time_step * block_velocity[bay]


@njit(nogil=True, cache=True, fastmath={"contract"}, inline="always")
def remember(force, strain, memory, decay, gain):
    """Take the memory terms off a row of spring forces, and let the terms take up the strain.

    Parameters
    ----------
    force : numpy.ndarray (bays,)
        Spring forces k_now e [N]; changed.
    strain : numpy.ndarray (bays,)
        Compressions e [m].
    memory : numpy.ndarray (terms, bays)
        Memory terms R_j [N]; changed.
    decay, gain : numpy.ndarray (terms,)
        Factor per step [-] and feed [N/m].
    """
    for term in range(decay.size):
        kept = memory[term]
        keep = decay[term]
        feed = gain[term]
        for bay in range(force.size):
            force[bay] -= kept[bay]
            kept[bay] = keep * kept[bay] + feed * strain[bay]


@njit(nogil=True, cache=True, fastmath={"contract"})
def decimate(record, taps, factor, samples):
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


@njit(nogil=True, cache=True)
def bay_waves(frequency_squared, support_stiffness, bending, element_mass, per_bay, multipliers, amplitudes):
    """Solve the supported rail exactly: two waves that decay from bay to bay.

    The rail displacement at support s per unit force at support 0 is
    sum_j amplitude_j multiplier_j^|s|. With r^2 = m w^2 / (EI/dx^3), m an element's mass, the free
    lattice's symbol factors into (S - r)(S + r), S = 2 cos(k dx) - 2. Summing over the elements
    between supports turns each factor into a Chebyshev polynomial of 1 +- r/2, and the row of
    springs adds to a quadratic in y = 2 cos(k spacing), whose roots are the waves.

    Parameters
    ----------
    frequency_squared : numpy.ndarray (frequencies,)
        Angular frequency squared [1/s2].
    support_stiffness : numpy.ndarray of complex (frequencies,)
        Dynamic stiffness of a support [N/m].
    bending : float
        EI / dx^3 [N/m].
    element_mass : float
        m' dx [kg].
    per_bay : int
        Rail elements per bay.
    multipliers : numpy.ndarray of complex (2, frequencies)
        Filled: factor from bay to bay [-], of magnitude up to one.
    amplitudes : numpy.ndarray of complex (2, frequencies)
        Filled: share of each wave in the point receptance [m/N].
    """
    for i in range(frequency_squared.size):
        r = (element_mass * frequency_squared[i] / bending) ** 0.5
        # T_n(x) - 1 and U_{n-1}(x) by recurrence from the small number x - 1, for x = 1 + r/2 and 1 - r/2
        c1, u1 = chebyshev_excess(0.5 * r, per_bay)
        c2, u2 = chebyshev_excess(-0.5 * r, per_bay)
        p1 = -u1 / (2 * r * bending)
        p2 = u2 / (2 * r * bending)
        # numerator n0 - n1 w and denominator w^2 - d1 w + d0 of the receptance, w = y - 2
        n0 = p1 * c2 + p2 * c1
        n1 = p1 + p2
        stiffness = support_stiffness[i]
        d1 = c1 + c2 + stiffness * n1
        d0 = c1 * c2 + stiffness * n0
        root = (0.25 * d1 * d1 - d0) ** 0.5
        # the larger root by addition, the smaller from their product: neither cancels
        if (root * d1.conjugate()).real < 0:
            root = -root
        large = 0.5 * d1 + root
        for wave in range(2):
            w = large if wave == 0 else d0 / large
            share = (n1 * w - n0) / (2.0 * root if wave == 0 else -2.0 * root)
            half = (w * (1.0 + 0.25 * w)) ** 0.5
            if (half * (1.0 + 0.5 * w).conjugate()).real < 0:
                half = -half
            multipliers[wave, i] = 1.0 / (1.0 + 0.5 * w + half)
            amplitudes[wave, i] = share / (2.0 * half)


@njit(nogil=True, cache=True)
def chebyshev_excess(excess, degree):
    """Return 2 T_n(1 + x) - 2 and U_{n-1}(1 + x) for a small x, without cancellation.

    Parameters
    ----------
    excess : float
        x [-].
    degree : int
        n, one or more.

    Returns
    -------
    tuple of float
        2 T_n(1 + x) - 2 and U_{n-1}(1 + x) [-].
    """
    before, now = 0.0, excess
    u_before, u_now = 0.0, 1.0
    for _ in range(degree - 1):
        before, now = now, 2.0 * (1.0 + excess) * now - before + 2.0 * excess
        u_before, u_now = u_now, 2.0 * (1.0 + excess) * u_now - u_before
    return 2.0 * now, u_now


@njit(nogil=True, cache=True)
def rail_compliance(frequency_squared, bending, element_mass, per_bay):
    """Return how far the rail gives way over every support to equal forces that oppose its motion.

    About 1 / (mass of a bay times w^2): the rail moves as one, but for bending between supports.

    Parameters
    ----------
    frequency_squared : float
        Angular frequency squared [1/s2].
    bending : float
        EI / dx^3 [N/m].
    element_mass : float
        m' dx [kg].
    per_bay : int
        Rail elements per bay.

    Returns
    -------
    float
        Displacement per force and support [m/N].
    """
    r = (element_mass * frequency_squared / bending) ** 0.5
    c1, u1 = chebyshev_excess(0.5 * r, per_bay)
    c2, u2 = chebyshev_excess(-0.5 * r, per_bay)
    return (u1 / c1 - u2 / c2) / (2 * r * bending)
