"""Compiled frequency-domain solution of whole designs: natural frequencies, refined spectrum, bands.

The infinite track in continuous time, three elements a bay: what
:mod:`trackig_core.frequency_domain.floquet_waves`, :mod:`trackig_core.frequency_domain.refinement`,
:mod:`trackig_core.frequency_domain.natural_frequencies` and :mod:`trackig_core.levels.insertion_gain` do for
one design in Python, here in one call per row of designs. SI units and Hz. Source of the model: the paper
(see :mod:`trackig_core.track.design`).

Arrays and floats only; no objects, no I/O, and no globals but this file's own constants: Numba's disk cache
notices neither a changed global nor an edit in another file. The loop over frequencies is written in real
numbers and without branches, so that it is compiled to vector instructions.

A track is a row of numbers, see :data:`trackig_core.frequency_domain.wave_kernels.COLUMNS`, a pad's or boot's
law seven of them: instantaneous stiffness, three strengths [N/m], three times [s].
"""

import math

import numpy as np

from trackig_core.arrays import BoolArray, IntArray, RealArray
from trackig_core.compiling import njit
from trackig_core.frequency_domain.axle_kernels import axle_energy
from trackig_core.frequency_domain.wave_kernels import (
    BENDING,
    BLOCK_MASS,
    BOOT,
    CONTACT,
    ELEMENT_MASS,
    ELEMENTS_PER_BAY,
    PAD,
    WHEEL_MASS,
    bay_waves,
)

LOADED_TRACK, COUPLED_BLOCK, WHEEL_ON_RIGID_BLOCKS, BLOCK_ON_BOOT, CUT_ON = 0, 1, 2, 3, 4
FREQUENCIES = 6
"""Columns of natural frequencies [Hz]; the cut-on pair takes two."""

STRAIGHTNESS = 0.05
"""Bend of a refined spectrum between neighbouring frequencies that is left alone [dB]."""

MOST_HALVINGS = 40
"""Halvings of an interval after which a peak is taken as resolved [-]."""

WIDEST_STEP = 3.0
"""How much wider an interval may be than its neighbour [-]: halved intervals differ by factors of two."""

MOST_FREQUENCIES = 20_000
"""Frequencies after which a spectrum is refined no further [-]."""

CAPACITY = 2 * MOST_FREQUENCIES
"""Frequencies for which a workspace has room [-]: one more halving of every interval."""

MARGIN = 1e-9
"""Relative margin around a bracket, so that a spring without memory has one too [-]."""

EDGE = 1e-5
"""Relative distance from a frequency at which the rail's receptance has no bound, within which it drowns in
rounding [-]."""

STILL = 1e-7
"""Decay from bay to bay below which a wave counts as running [-]: well above rounding."""

PAD_ON_RAIL, PAIR_LOWER, PAIR_UPPER, BOOT_ON_BLOCK, BETWEEN_SPRINGS, SURPLUS, BALANCE = 0, 1, 2, 3, 4, 5, 6
"""Equations whose roots are natural frequencies."""


@njit(nogil=True, cache=True, inline="always", error_model="numpy")
def two_sided(re: float, im: float) -> tuple[float, float]:
    """Return the real and imaginary part of (1 + p)/(1 - p)."""
    scale = 1.0 / ((1.0 - re) * (1.0 - re) + im * im)
    return (1.0 - re * re - im * im) * scale, 2.0 * im * scale


@njit(nogil=True, cache=True, error_model="numpy", fastmath={"contract"})
def force_energy(
    track: RealArray, frequency: RealArray, count: int, energy: RealArray, coherent: RealArray
) -> None:
    """Compute the energy of the force into the ground per unit step of roughness.

    Parameters
    ----------
    track : numpy.ndarray (19,)
        The track.
    frequency : numpy.ndarray (capacity,)
        Frequencies, of which the first ``count`` are solved [Hz].
    count : int
        How many.
    energy, coherent : numpy.ndarray (capacity,)
        Filled: squared force summed over the supports, and square of the summed force [N2 s2/m2].
    """
    k, k1, k2, k3, t1, t2, t3 = track[0], track[1], track[2], track[3], track[4], track[5], track[6]
    g, g1, g2, g3, u1, u2, u3 = track[7], track[8], track[9], track[10], track[11], track[12], track[13]
    block, bending, element_mass = track[BLOCK_MASS], track[BENDING], track[ELEMENT_MASS]
    wheel, compliance = track[WHEEL_MASS], 1.0 / track[CONTACT]
    two_stage = block > 0.0
    for i in range(count):
        angular = 2.0 * math.pi * frequency[i]
        squared = angular * angular
        # K = k_inf - sum k_j / (1 + i w t_j)
        x1, x2, x3 = angular * t1, angular * t2, angular * t3
        y1, y2, y3 = k1 / (1.0 + x1 * x1), k2 / (1.0 + x2 * x2), k3 / (1.0 + x3 * x3)
        pad_re, pad_im = k - y1 - y2 - y3, x1 * y1 + x2 * y2 + x3 * y3
        x1, x2, x3 = angular * u1, angular * u2, angular * u3
        y1, y2, y3 = g1 / (1.0 + x1 * x1), g2 / (1.0 + x2 * x2), g3 / (1.0 + x3 * x3)
        boot_re, boot_im = g - y1 - y2 - y3, x1 * y1 + x2 * y2 + x3 * y3
        # pad (boot - m w^2) / (pad + boot - m w^2) and pad boot / (pad + boot - m w^2)
        below = boot_re - block * squared
        sum_re, sum_im = pad_re + below, pad_im + boot_im
        scale = 1.0 / (sum_re * sum_re + sum_im * sum_im)
        over_re, over_im = (
            (pad_re * sum_re + pad_im * sum_im) * scale,
            (pad_im * sum_re - pad_re * sum_im) * scale,
        )
        support_re = over_re * below - over_im * boot_im if two_stage else pad_re
        support_im = over_re * boot_im + over_im * below if two_stage else pad_im
        passed_re = over_re * boot_re - over_im * boot_im if two_stage else pad_re
        passed_im = over_re * boot_im + over_im * boot_re if two_stage else pad_im

        q = element_mass * squared / bending
        s_re, s_im = support_re / bending, support_im / bending
        m1_re, m1_im, m2_re, m2_im, a1_re, a1_im, a2_re, a2_im, lost1, lost2 = bay_waves(q, s_re, s_im)
        contact_re = compliance + (a1_re + a2_re) / bending - 1.0 / (wheel * squared)
        contact_im = (a1_im + a2_im) / bending
        per_receptance = (passed_re * passed_re + passed_im * passed_im) / (
            (contact_re * contact_re + contact_im * contact_im) * squared * bending * bending
        )
        # squared displacements summed over all supports: three geometric series
        both_re, both_im = two_sided(m1_re * m2_re + m1_im * m2_im, m1_im * m2_re - m1_re * m2_im)
        pair_re, pair_im = a1_re * a2_re + a1_im * a2_im, a1_im * a2_re - a1_re * a2_im
        energy[i] = per_receptance * (
            (a1_re * a1_re + a1_im * a1_im) * (2.0 - lost1) / lost1
            + (a2_re * a2_re + a2_im * a2_im) * (2.0 - lost2) / lost2
            + 2.0 * (pair_re * both_re - pair_im * both_im)
        )
        # displacements summed: the receptance to equal forces over all supports
        low_re, low_im = s_re * (3.0 - q) - q * (9.0 - q), s_im * (3.0 - q)
        coherent[i] = per_receptance * (3.0 - q) * (3.0 - q) / (low_re * low_re + low_im * low_im)


@njit(nogil=True, cache=True, error_model="numpy")
def lattice_stiffness(recursion: RealArray, delay: complex) -> complex:
    """Return the dynamic stiffness of a spring as time stepping sees it [N/m].

    Parameters
    ----------
    recursion : numpy.ndarray (7,)
        Factor of the current strain [N/m], three decays [-] and three feeds [N/m] of the memory, see
        :meth:`trackig_core.track.viscoelastic_law.Relaxation.recursion`.
    delay : complex
        exp(-i w dt) [-].

    Returns
    -------
    complex
        Dynamic stiffness [N/m].
    """
    stiffness = complex(recursion[0], 0.0)
    for term in range(1, 4):
        stiffness -= recursion[3 + term] * delay / (1.0 - recursion[term] * delay)
    return stiffness


@njit(nogil=True, cache=True, error_model="numpy")
def lattice_energy(
    track: RealArray,
    recursions: RealArray,
    time_step: float,
    bays: int,
    frequency: RealArray,
    count: int,
    energy: RealArray,
    coherent: RealArray,
) -> float:
    """Compute what :func:`force_energy` does for the time-stepping scheme itself, by its z-transform.

    The sums over the supports of a ring are those of
    :meth:`trackig_core.frequency_domain.floquet_waves.Waves.energy_sum`.

    Parameters
    ----------
    track : numpy.ndarray (19,)
        The track.
    recursions : numpy.ndarray (2, 7)
        Pad and boot as they are stepped, see :func:`lattice_stiffness`.
    time_step : float
        Time step [s].
    bays : int
        Supports around the ring; 0 for the infinite track.
    frequency, count, energy, coherent
        As in :func:`force_energy`.

    Returns
    -------
    float
        Largest factor of any wave from bay to bay [-].
    """
    block, bending, element_mass = track[BLOCK_MASS], track[BENDING], track[ELEMENT_MASS]
    compliance, wheel = 1.0 / track[CONTACT], track[WHEEL_MASS]
    longest = 0.0
    for i in range(count):
        angle = 2.0 * math.pi * frequency[i] * time_step
        delay = complex(math.cos(angle), -math.sin(angle))
        squared = (2.0 / time_step * math.sin(0.5 * angle)) ** 2
        support = passed = lattice_stiffness(recursions[0], delay)
        if block > 0.0:
            pad, boot = support, lattice_stiffness(recursions[1], delay)
            over = pad / (pad + boot - block * squared)
            support, passed = over * (boot - block * squared), over * boot
        q = element_mass * squared / bending
        waves = bay_waves(q, support.real / bending, support.imag / bending)
        m1, m2 = complex(waves[0], waves[1]), complex(waves[2], waves[3])
        a1, a2 = complex(waves[4], waves[5]) / bending, complex(waves[6], waves[7]) / bending
        longest = max(longest, abs(m1), abs(m2))
        summed = a1 * (1.0 + m1) / (1.0 - m1) + a2 * (1.0 + m2) / (1.0 - m2)  # the same on line and ring
        around1 = m1**bays if bays > 0 else 0.0j
        around2 = m2**bays if bays > 0 else 0.0j
        a1, a2 = a1 / (1.0 - around1), a2 / (1.0 - around2)
        contact = compliance + a1 * (1.0 + around1) + a2 * (1.0 + around2) - 1.0 / (wheel * squared)
        one = squared_modulus(a1) * shape_product(m1, m1, around1, around1, waves[8], bays).real
        two = squared_modulus(a2) * shape_product(m2, m2, around2, around2, waves[9], bays).real
        both = a1 * a2.conjugate() * shape_product(m1, m2, around1, around2, math.nan, bays)
        per_receptance = squared_modulus(passed / contact) / squared
        energy[i] = per_receptance * (one + two + 2.0 * both.real)
        coherent[i] = per_receptance * squared_modulus(summed)
    return longest


@njit(nogil=True, cache=True, inline="always", error_model="numpy")
def squared_modulus(number: complex) -> float:
    """Return the squared magnitude of a complex number."""
    return number.real * number.real + number.imag * number.imag


@njit(nogil=True, cache=True, error_model="numpy")
def shape_product(
    one: complex, other: complex, around: complex, other_around: complex, lost: float, bays: int
) -> complex:
    """Return the sum over all supports of one wave's shape times the conjugate of another's [-].

    Parameters
    ----------
    one, other : complex
        Factors of the waves from bay to bay [-].
    around, other_around : complex
        Their factors once around the ring [-]; zero on the infinite track.
    lost : float
        How much of its energy a wave with itself loses from bay to bay [-]; NaN for two waves.
    bays : int
        Supports around the ring; 0 for the infinite track.

    Returns
    -------
    complex
        The sum.
    """
    other, back = other.conjugate(), other_around.conjugate()
    product = one * other
    two_sided = (2.0 - lost) / lost + 0.0j if lost == lost else (1.0 + product) / (1.0 - product)
    apart = other - one
    opposite = bays * around / one if abs(apart) < 1e-9 else (back - around) / apart
    return two_sided * (1.0 - around * back) + (one + other) * opposite


@njit(nogil=True, cache=True, error_model="numpy")
def spring(track: RealArray, law: int, frequency: float) -> float:
    """Return Re K of the pad's or boot's law, which begins at a column of the track, at a frequency [N/m]."""
    angular = 2.0 * math.pi * frequency
    stiffness = track[law]
    for term in range(1, 4):
        stiffness -= track[law + term] / (1.0 + (angular * track[law + 3 + term]) ** 2)
    return stiffness


@njit(nogil=True, cache=True, error_model="numpy")
def support(track: RealArray, frequency: float) -> float:
    """Return the stiffness of a support without its loss, block included, at a frequency [N/m]."""
    pad = spring(track, PAD, frequency)
    if track[BLOCK_MASS] == 0.0:
        return pad
    below = spring(track, BOOT, frequency) - track[BLOCK_MASS] * (2.0 * math.pi * frequency) ** 2
    return pad * below / (pad + below)


@njit(nogil=True, cache=True, error_model="numpy")
def oscillator(kind: int, pad: float, boot: float, rail_mass: float, block_mass: float) -> float:
    """Return the frequency of masses on springs of given stiffnesses [Hz]."""
    if kind == PAD_ON_RAIL:
        squared = pad / rail_mass
    elif kind == BOOT_ON_BLOCK:
        squared = boot / block_mass
    elif kind == BETWEEN_SPRINGS:
        squared = (pad + boot) / block_mass
    else:
        # the two roots of (k_p - m_r x)(k_p + k_b - m_b x) = k_p^2, x = w^2
        upper, lower = pad / rail_mass, (pad + boot) / block_mass
        larger = 0.5 * (upper + lower) + math.sqrt(0.25 * (upper - lower) ** 2 + upper * pad / block_mass)
        # the smaller from their product, which does not cancel
        squared = larger if kind == PAIR_UPPER else upper * boot / block_mass / larger
    return math.sqrt(squared) / (2.0 * math.pi)


@njit(nogil=True, cache=True, error_model="numpy")
def lossless_waves(track: RealArray, frequency: float) -> tuple[float, float]:
    """Return point receptance [m/N] and largest squared factor from bay to bay [-], the loss taken out."""
    q = track[ELEMENT_MASS] * (2.0 * math.pi * frequency) ** 2 / track[BENDING]
    waves = bay_waves(q, support(track, frequency) / track[BENDING], 0.0)
    largest = max(waves[0] ** 2 + waves[1] ** 2, waves[2] ** 2 + waves[3] ** 2)
    return (waves[4] + waves[6]) / track[BENDING], largest


@njit(nogil=True, cache=True, error_model="numpy")
def residual(kind: int, track: RealArray, frequency: float) -> float:
    """Return what vanishes at a natural frequency.

    Parameters
    ----------
    kind : int
        Which equation: :data:`SURPLUS` of the rail's compliance over the support's [m/N] (all bays move as
        one), :data:`BALANCE` of receptances in the contact [m/N] (loaded track), or masses on springs [Hz].
    track : numpy.ndarray (19,)
        The track.
    frequency : float
        Frequency [Hz].

    Returns
    -------
    float
        The residual.
    """
    squared = (2.0 * math.pi * frequency) ** 2
    if kind == SURPLUS:
        q = track[ELEMENT_MASS] * squared / track[BENDING]
        return (3.0 - q) / (q * (9.0 - q) * track[BENDING]) - 1.0 / support(track, frequency)
    if kind == BALANCE:
        receptance = lossless_waves(track, frequency)[0]
        return 1.0 / track[CONTACT] + receptance - 1.0 / (track[WHEEL_MASS] * squared)
    return frequency - oscillator(
        kind,
        spring(track, PAD, frequency),
        spring(track, BOOT, frequency),
        ELEMENTS_PER_BAY * track[ELEMENT_MASS],
        track[BLOCK_MASS],
    )


@njit(nogil=True, cache=True, error_model="numpy")
def root_between(
    kind: int, track: RealArray, low: float, high: float, absolute: float, relative: float
) -> float:
    """Return the root of a residual in a bracket by Brent's method, or NaN if there is no change of sign.

    Parameters
    ----------
    kind : int
        Which equation, see :func:`residual`.
    track : numpy.ndarray (19,)
        The track.
    low, high : float
        Bracket [Hz].
    absolute, relative : float
        Tolerances [Hz] and [-].

    Returns
    -------
    float
        The root [Hz].
    """
    before = other = step = last = math.nan
    f_before = f_other = math.nan
    now = low
    for turn in range(102):
        f_now = residual(kind, track, now)  # the only call: each one is compiled anew into its caller
        if turn == 0:
            if f_now == 0.0:
                return now
            before, f_before = now, f_now
            now = high
            continue
        if turn == 1 and (f_before < 0.0) == (f_now < 0.0):
            return now if f_now == 0.0 else math.nan
        if turn == 1 or (f_before < 0.0) != (f_now < 0.0):
            other, f_other = before, f_before
            step = last = now - before
        if abs(f_other) < abs(f_now):
            before, now, other = now, other, now
            f_before, f_now, f_other = f_now, f_other, f_now
        tolerance = 0.5 * (absolute + relative * abs(now))
        half = 0.5 * (other - now)
        if f_now == 0.0 or abs(half) < tolerance:
            return now
        trial = math.inf
        if abs(step) > tolerance and abs(f_now) < abs(f_before):
            if before == other:  # secant
                trial = -f_now * (now - before) / (f_now - f_before)
            else:  # inverse quadratic
                slope_before = (f_before - f_now) / (before - now)
                slope_other = (f_other - f_now) / (other - now)
                trial = (
                    -f_now
                    * (f_other * slope_other - f_before * slope_before)
                    / (slope_other * slope_before * (f_other - f_before))
                )
        if 2.0 * abs(trial) < min(abs(step), 3.0 * abs(half) - tolerance):
            step, last = last, trial
        else:
            step = last = half
        before, f_before = now, f_now
        if abs(last) > tolerance:
            now += last
        else:
            now += tolerance if half > 0.0 else -tolerance
    return now


@njit(nogil=True, cache=True, error_model="numpy")
def mode(kind: int, track: RealArray) -> float:
    """Return the frequency of masses on springs, consistent with the springs' stiffness there [Hz].

    It is bracketed by the frequencies with static and with instantaneous stiffnesses: relaxation stiffens.
    """
    rail_mass, block_mass = ELEMENTS_PER_BAY * track[ELEMENT_MASS], track[BLOCK_MASS]
    low = oscillator(kind, spring(track, PAD, 0.0), spring(track, BOOT, 0.0), rail_mass, block_mass)
    high = oscillator(kind, track[PAD], track[BOOT], rail_mass, block_mass)
    return root_between(kind, track, low * (1.0 - MARGIN), high * (1.0 + MARGIN), 1e-9, 9e-16)


@njit(nogil=True, cache=True, error_model="numpy")
def dies_away(track: RealArray, frequency: float) -> bool:
    """Return whether both waves decay from bay to bay, the loss taken out."""
    return math.sqrt(lossless_waves(track, frequency)[1]) < 1.0 - STILL


@njit(nogil=True, cache=True, error_model="numpy")
def waves_begin(track: RealArray, straight_rail: float) -> float:
    """Return the lowest frequency at which waves run along the track [Hz].

    On most tracks all bays then move as one; on stiff supports far apart shorter waves begin before.
    ``straight_rail`` is the same frequency for a rail that does not bend between supports [Hz].
    """
    # the rail's first own wave that repeats in every bay: q = 9
    own = 3.0 * math.sqrt(track[BENDING] / track[ELEMENT_MASS]) / (2.0 * math.pi)
    top = min(straight_rail * (1.0 + MARGIN), own * (1.0 - EDGE))
    as_one = root_between(SURPLUS, track, 1e-3 * top, top, 1e-12, 1e-14)
    if dies_away(track, as_one * (1.0 - EDGE)):
        return as_one
    low, interval = 1e-3 * as_one, as_one * (1.0 - EDGE) - 1e-3 * as_one
    for _ in range(100):
        interval *= 0.5
        if dies_away(track, low + interval):
            low += interval
        if interval < 1e-9 * low:
            break
    return low


@njit(nogil=True, cache=True, error_model="numpy")
def loaded_track(track: RealArray, straight_rail: float) -> float:
    """Return the bound mode of the wheel on the supported rail [Hz]; see :func:`waves_begin`."""
    begin = waves_begin(track, straight_rail)
    top = begin * (1.0 - EDGE)
    if not residual(BALANCE, track, top) > 0.0:  # its mode cannot be distinguished from the cut-on
        return begin
    bottom = 0.1 * begin
    while residual(BALANCE, track, bottom) >= 0.0:
        bottom *= 0.1
    return root_between(BALANCE, track, bottom, top, 1e-9, 9e-16)


@njit(nogil=True, cache=True, error_model="numpy")
def natural_frequencies(track: RealArray, found: RealArray, everything: bool) -> None:
    """Find the natural frequencies of a track.

    Parameters
    ----------
    track : numpy.ndarray (19,)
        The track.
    found : numpy.ndarray (6,)
        Filled: loaded track, coupled block, wheel on rigid blocks, block on boot, cut-on pair [Hz]; NaN for
        what a single-stage track does not have.
    everything : bool
        Whether all are wanted; else loaded track and coupled block only, the lower cut-on on the way.
    """
    two_stage = track[BLOCK_MASS] > 0.0
    rigid_blocks = track.copy()
    rigid_blocks[BLOCK_MASS] = 0.0
    modes = np.full(5, math.nan)
    for kind in range(5):
        if kind == PAD_ON_RAIL:
            wanted = everything or not two_stage
        else:
            wanted = two_stage and (everything or kind in (PAIR_LOWER, BETWEEN_SPRINGS))
        if wanted:
            modes[kind] = mode(kind, track)
    found[COUPLED_BLOCK], found[BLOCK_ON_BOOT] = modes[BETWEEN_SPRINGS], modes[BOOT_ON_BLOCK]
    found[CUT_ON] = modes[PAIR_LOWER if two_stage else PAD_ON_RAIL]
    found[CUT_ON + 1] = modes[PAIR_UPPER]
    found[LOADED_TRACK] = found[WHEEL_ON_RIGID_BLOCKS] = math.nan
    tracks = (track, rigid_blocks)
    for stage in range(2 if two_stage and everything else 1):
        straight_rail = found[CUT_ON] if stage == 0 else modes[PAD_ON_RAIL]
        found[2 * stage] = loaded_track(tracks[stage], straight_rail)
    if not two_stage:
        found[WHEEL_ON_RIGID_BLOCKS] = found[LOADED_TRACK]


@njit(nogil=True, cache=True, error_model="numpy")
def first_axis(
    loaded: float, edges: RealArray, per_band: int, line_fraction: float, frequency: RealArray
) -> tuple[int, int]:
    """Fill in the frequencies from which a spectrum is refined.

    Parameters
    ----------
    loaded : float
        Loaded-track frequency [Hz].
    edges : numpy.ndarray (22,)
        Edges of the bands [Hz].
    per_band : int
        Intervals per band [-].
    line_fraction : float
        Where the line is anchored, in parts of the loaded-track frequency [-].
    frequency : numpy.ndarray (capacity,)
        Filled [Hz]: the anchor and steps up from it if it lies below the bands; every band edge.

    Returns
    -------
    count : int
        How many.
    bands_begin : int
        Place of the first band edge.
    """
    anchor = line_fraction * loaded
    count = 0
    if anchor < edges[0]:
        below = per_band - 1
        ratio = (edges[0] / anchor) ** (1.0 / below)
        frequency[0] = anchor
        for i in range(1, below):
            frequency[i] = anchor * ratio**i
        count = below
    bands_begin = count
    for band in range(edges.size - 1):
        ratio = (edges[band + 1] / edges[band]) ** (1.0 / per_band)
        frequency[count] = edges[band]
        for i in range(1, per_band):
            frequency[count + i] = frequency[count + i - 1] * ratio
        count += per_band
    frequency[count] = edges[-1]
    return count + 1, bands_begin


@njit(nogil=True, cache=True, error_model="numpy")
def refine(
    track: RealArray,
    surroundings: RealArray,
    wheels: IntArray,
    recursions: RealArray,
    time_step: float,
    bays: int,
    count: int,
    axis: RealArray,
    straight: BoolArray,
    spare: RealArray,
    spare_straight: BoolArray,
) -> int:
    """Halve intervals until a spectrum shows every peak; see :mod:`trackig_core.frequency_domain.refinement`.

    Parameters
    ----------
    track : numpy.ndarray (19,)
        The track.
    surroundings, wheels
        As in :func:`trackig_core.frequency_domain.axle_kernels.axle_energy`, roughness independent; no wheels
        for one unsprung wheel over a support, on rigid ground.
    recursions, time_step, bays
        As in :func:`lattice_energy`; time step 0 for the infinite track in continuous time, which needs no
        recursions.
    count : int
        Frequencies to begin with.
    axis : numpy.ndarray (3, capacity)
        Frequency [Hz], energy and coherent energy per unit step [N2 s2/m2]; the first ``count`` frequencies
        are given, everything else is filled in.
    straight : numpy.ndarray of bool (capacity,)
        Workspace: whether an interval needs no halving.
    spare : numpy.ndarray (3, capacity)
        Workspace.
    spare_straight : numpy.ndarray of bool (capacity,)
        Workspace.

    Returns
    -------
    int
        How many frequencies there are now.
    """
    bent = math.exp(2.0 * STRAIGHTNESS / 10.0 * math.log(10.0))
    together = np.empty(0)
    straight[: count - 1] = False
    spare[0, :count] = axis[0, :count]
    halved = count
    for turn in range(MOST_HALVINGS + 1):
        for i in range(count - 1 if turn > 0 else 0):
            if not straight[i]:
                spare[0, halved] = 0.5 * (axis[0, i] + axis[0, i + 1])
                halved += 1
        if wheels.size > 0:
            axle_energy(track, surroundings, wheels, together, spare[0, :halved], spare[1], spare[2])
        elif time_step > 0.0:
            lattice_energy(track, recursions, time_step, bays, spare[0], halved, spare[1], spare[2])
        else:
            force_energy(track, spare[0], halved, spare[1], spare[2])  # the only call: it is compiled in here
        if turn == 0:
            axis[1:, :count] = spare[1:, :count]
            halved = 0
            continue
        # insert from the end, so that everything is moved once
        to = count - 1 + halved
        taken = halved - 1
        for row in range(3):
            axis[row, to] = axis[row, count - 1]
        for i in range(count - 2, -1, -1):
            is_straight = straight[i]
            if not is_straight:
                is_straight = True
                for row in range(1, 3):
                    bend = spare[row, taken] ** 2 / (axis[row, i] * axis[row, to])
                    if bend > bent or 0.0 <= bend * bent < 1.0:
                        is_straight = False
                straight[to - 1] = is_straight
                for row in range(3):
                    axis[row, to - 1] = spare[row, taken]
                taken -= 1
                to -= 1
            straight[to - 1] = is_straight
            for row in range(3):
                axis[row, to - 1] = axis[row, i]
            to -= 1
        count += halved
        halved = 0
        # an interval much wider than a neighbour: a peak's flank may look straight by chance
        all_straight = True
        before = math.inf
        for i in range(count - 1):
            here = axis[0, i + 1] - axis[0, i]
            after = axis[0, i + 2] - axis[0, i + 1] if i + 2 < count else math.inf
            spare_straight[i] = straight[i] and not here > WIDEST_STEP * min(before, after)
            all_straight = all_straight and spare_straight[i]
            before = here
        straight[: count - 1] = spare_straight[: count - 1]
        if all_straight or count > MOST_FREQUENCIES:
            break
    return count


@njit(nogil=True, cache=True, error_model="numpy")
def band_integrals(
    frequency: RealArray,
    density: RealArray,
    count: int,
    first: int,
    edges: RealArray,
    slopes: RealArray,
    factors: RealArray,
    band_energy: RealArray,
) -> None:
    """Integrate a cubic spline through a spectrum over the bands.

    Between knots a cubic with values y and slopes d integrates to h (y0 + y1)/2 + h^2 (d0 - d1)/12. Panels
    are summed band by band: the difference of one running sum would lose bands that lie far below others.

    Parameters
    ----------
    frequency, density : numpy.ndarray (capacity,)
        Knots [Hz] and density [unit/Hz], the first ``count`` of them.
    count, first : int
        How many knots, and which of them is the lowest band edge.
    edges : numpy.ndarray (22,)
        Edges of the bands [Hz], all of them knots.
    slopes, factors : numpy.ndarray (capacity,)
        Workspace.
    band_energy : numpy.ndarray (21,)
        Filled: integral over each band [unit].
    """
    # slopes that keep the second derivative continuous, a tridiagonal system; the ends are clamped to the
    # parabola through the last three knots
    h = frequency[1] - frequency[0]
    rise = (density[1] - density[0]) / h
    h_next = frequency[2] - frequency[1]
    rise_next = (density[2] - density[1]) / h_next
    slopes[0] = rise + (rise - rise_next) * h / (h + h_next)
    factors[0] = 0.0
    for i in range(1, count - 1):
        h_next = frequency[i + 1] - frequency[i]
        rise_next = (density[i + 1] - density[i]) / h_next
        pivot = 1.0 / (2.0 * (h + h_next) - h_next * factors[i - 1])
        slopes[i] = (3.0 * (h_next * rise + h * rise_next) - h_next * slopes[i - 1]) * pivot
        factors[i] = h * pivot
        h, rise = h_next, rise_next
    last = count - 1
    h, h_before = frequency[last] - frequency[last - 1], frequency[last - 1] - frequency[last - 2]
    rise = (density[last] - density[last - 1]) / h
    rise_before = (density[last - 1] - density[last - 2]) / h_before
    slopes[last] = rise + (rise - rise_before) * h / (h + h_before)
    for i in range(count - 2, 0, -1):
        slopes[i] -= factors[i] * slopes[i + 1]
    band_energy[:] = 0.0
    band = 0
    for i in range(first, count - 1):
        if band + 1 < band_energy.size and frequency[i] >= edges[band + 1]:
            band += 1
        h = frequency[i + 1] - frequency[i]
        band_energy[band] += (
            0.5 * h * (density[i] + density[i + 1]) + h * h * (slopes[i] - slopes[i + 1]) / 12.0
        )


@njit(nogil=True, cache=True, error_model="numpy")
def solve_rows(
    tracks: RealArray,
    edges: RealArray,
    per_band: int,
    line_fraction: float,
    band_energy: RealArray,
    heights: RealArray,
    found: RealArray,
    sound: IntArray,
) -> None:
    """Solve a row of designs.

    Parameters
    ----------
    tracks : numpy.ndarray (designs, 19)
        The tracks.
    edges : numpy.ndarray (22,)
        Edges of the bands [Hz].
    per_band : int
        Intervals per band from which spectra are refined [-].
    line_fraction : float
        Where the line is anchored, in parts of the loaded-track frequency [-].
    band_energy : numpy.ndarray (designs, 2, 21)
        Filled: squared force summed over the supports, and square of the summed force, per unit step
        [N2 s/m2].
    heights : numpy.ndarray (designs, 2)
        Filled: either energy over frequency squared where the line is anchored [N2 s4/m2].
    found : numpy.ndarray (designs, 2)
        Filled: loaded-track and coupled-block frequency [Hz]; NaN where there is none.
    sound : numpy.ndarray of int (designs,)
        Filled: 1 if the spectrum is resolved, 0 if resonances are too sharp, -1 if rounding drowns it.
    """
    axis, spare = np.empty((3, CAPACITY)), np.empty((3, CAPACITY))
    straight, spare_straight = np.empty(CAPACITY, np.bool_), np.empty(CAPACITY, np.bool_)
    frequencies, at = np.empty(FREQUENCIES), np.empty((3, 1))
    not_stepped, nothing, unsprung = np.zeros((2, 7)), np.empty(0), np.empty(0, np.int64)
    line = unsprung.size  # no ring; a literal zero would have all of this compiled once more for it
    for row in range(tracks.shape[0]):
        track = tracks[row]
        natural_frequencies(track, frequencies, False)
        found[row, 0], found[row, 1] = frequencies[LOADED_TRACK], frequencies[COUPLED_BLOCK]
        loaded = frequencies[LOADED_TRACK]
        count, first = first_axis(loaded, edges, per_band, line_fraction, axis[0])
        count = refine(
            track, nothing, unsprung, not_stepped, 0.0, line, count, axis, straight, spare, spare_straight
        )
        while axis[0, first] < edges[0]:
            first += 1
        sound[row] = 1 if count <= MOST_FREQUENCIES else 0
        for i in range(count):
            if not (axis[1, i] > 0.0 and axis[1, i] < math.inf):
                sound[row] = -1
        at[0, 0] = min(line_fraction * loaded, edges[-1])
        force_energy(track, at[0], at.shape[1], at[1], at[2])
        for kind in range(2):
            heights[row, kind] = at[1 + kind, 0] / at[0, 0] ** 2
            band_integrals(
                axis[0], axis[1 + kind], count, first, edges, spare[0], spare[1], band_energy[row, kind]
            )


@njit(nogil=True, cache=True, error_model="numpy")
def resolve_row(
    track: RealArray,
    surroundings: RealArray,
    wheels: IntArray,
    recursions: RealArray,
    time_step: float,
    bays: int,
    frequency: RealArray,
) -> RealArray:
    """Refine the spectrum of one design.

    Parameters
    ----------
    track : numpy.ndarray (19,)
        The track.
    surroundings, wheels, recursions, time_step, bays
        As in :func:`refine`.
    frequency : numpy.ndarray (frequencies,)
        Frequencies to begin with [Hz], ascending and greater than zero; all are kept.

    Returns
    -------
    numpy.ndarray (3, more frequencies)
        Frequency [Hz], energy and coherent energy per unit step [N2 s2/m2].
    """
    capacity = max(CAPACITY, 2 * frequency.size)
    axis, spare = np.empty((3, capacity)), np.empty((3, capacity))
    axis[0, : frequency.size] = frequency
    count = refine(
        track,
        surroundings,
        wheels,
        recursions,
        time_step,
        bays,
        frequency.size,
        axis,
        np.empty(capacity, np.bool_),
        spare,
        np.empty(capacity, np.bool_),
    )
    return axis[:, :count].copy()
