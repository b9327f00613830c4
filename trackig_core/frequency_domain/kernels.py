"""Compiled closed form of the supported rail: two waves that decay from bay to bay.

Arrays and floats go in, arrays are changed in place; SI units. Source of the model: the paper (see
:mod:`trackig_core.track.design`); the derivation stands with each function. No objects, no I/O, and no
globals but this file's own constants: Numba's disk cache notices neither a changed global nor an edit in
another file.
"""

from trackig_core.arrays import ComplexArray, RealArray
from trackig_core.compiling import njit


@njit(nogil=True, cache=True)
def bay_waves(
    frequency_squared: RealArray,
    support_stiffness: ComplexArray,
    bending: float,
    element_mass: float,
    per_bay: int,
    multipliers: ComplexArray,
    amplitudes: ComplexArray,
) -> None:
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
        wave_1, wave_2 = supported_waves(c1, p1, c2, p2, support_stiffness[i])
        multipliers[0, i], amplitudes[0, i] = wave_1
        multipliers[1, i], amplitudes[1, i] = wave_2


@njit(nogil=True, cache=True)
def beam_waves(
    poles: RealArray,
    strengths: RealArray,
    support_stiffness: ComplexArray,
    multipliers: ComplexArray,
    amplitudes: ComplexArray,
) -> None:
    """Solve a supported beam whose free waves are known: two waves that decay from bay to bay.

    Parameters
    ----------
    poles, strengths : numpy.ndarray (2, frequencies)
        The free beam under equal forces over all supports, of phase k spacing from one to the next, moves
        by the sum of strength [m/N] over (pole - w) [-], w = 2 cos(k spacing) - 2.
    support_stiffness : numpy.ndarray of complex (frequencies,)
        Dynamic stiffness of a support [N/m].
    multipliers, amplitudes : numpy.ndarray of complex (2, frequencies)
        Filled, as by :func:`bay_waves`.
    """
    for i in range(support_stiffness.size):
        wave_1, wave_2 = supported_waves(
            poles[0, i], strengths[0, i], poles[1, i], strengths[1, i], support_stiffness[i]
        )
        multipliers[0, i], amplitudes[0, i] = wave_1
        multipliers[1, i], amplitudes[1, i] = wave_2


@njit(nogil=True, cache=True)
def supported_waves(
    c1: float, p1: float, c2: float, p2: float, stiffness: complex
) -> tuple[tuple[complex, complex], tuple[complex, complex]]:
    """Return factor from bay to bay [-] and share in the receptance [m/N] of both waves.

    Parameters
    ----------
    c1, p1, c2, p2 : float
        Poles [-] and strengths [m/N] of the free rail under forces over all supports.
    stiffness : complex
        Dynamic stiffness of a support [N/m].

    Returns
    -------
    tuple of tuple of complex
        (factor, share) of either wave.
    """
    # numerator n0 - n1 w and denominator w^2 - d1 w + d0 of the receptance, w = y - 2
    n0 = p1 * c2 + p2 * c1
    n1 = p1 + p2
    d1 = c1 + c2 + stiffness * n1
    d0 = c1 * c2 + stiffness * n0
    root = (0.25 * d1 * d1 - d0) ** 0.5
    # the larger root by addition, the smaller from their product: neither cancels
    if (root * d1.conjugate()).real < 0:
        root = -root
    large = 0.5 * d1 + root
    return (
        decaying_wave(large, (n1 * large - n0) / (2.0 * root)),
        decaying_wave(d0 / large, (n1 * (d0 / large) - n0) / (-2.0 * root)),
    )


@njit(nogil=True, cache=True)
def decaying_wave(w: complex, share: complex) -> tuple[complex, complex]:
    """Return factor from bay to bay and share in the receptance of the wave of w = y - 2."""
    half = (w * (1.0 + 0.25 * w)) ** 0.5
    if (half * (1.0 + 0.5 * w).conjugate()).real < 0:
        half = -half
    return 1.0 / (1.0 + 0.5 * w + half), share / (2.0 * half)


@njit(nogil=True, cache=True)
def chebyshev_excess(excess: float, degree: int) -> tuple[float, float]:
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
