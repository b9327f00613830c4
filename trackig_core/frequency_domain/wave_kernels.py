"""Compiled closed form of the supported rail: the two waves that decay from bay to bay.

Written in real numbers and without branches, so that loops over frequencies are compiled to vector
instructions.
"""

import math

from trackig_core.compiling import njit

PAD, BOOT, BLOCK_MASS, BENDING, ELEMENT_MASS, WHEEL_MASS, CONTACT = 0, 7, 14, 15, 16, 17, 18
COLUMNS = 19
"""Columns of a track: pad law, boot law, block mass [kg] (0: single-stage), EI/dx^3 [N/m], m' dx [kg], wheel
mass [kg], contact stiffness [N/m]."""

ELEMENTS_PER_BAY = 3
"""Rail elements per bay [-]; the closed form below is written out for three."""


@njit(nogil=True, cache=True, inline="always", error_model="numpy")
def square_root(re: float, im: float) -> tuple[float, float]:
    """Return the square root of a complex number that lies in the right half plane, as two floats."""
    larger = math.sqrt(0.5 * (math.sqrt(re * re + im * im) + abs(re)))
    smaller = 0.5 * abs(im) / (larger + 1e-300)
    return (
        larger if re >= 0.0 else smaller,
        math.copysign(smaller if re >= 0.0 else larger, im),
    )


@njit(nogil=True, cache=True, inline="always", error_model="numpy")
def bay_waves(q: float, re: float, im: float) -> tuple[float, ...]:
    """Solve the supported rail exactly: two waves that decay from bay to bay.

    The derivation is that of :func:`trackig_core.frequency_domain.kernels.bay_waves`. With three elements a
    bay its Chebyshev polynomials of 1 +- r/2 multiply out to polynomials of q = r^2: with s the support's
    stiffness over EI/dx^3, the receptance over y - 2 = w is

        ((3 - q)(9 - q) + 4 w) / (w^2 - (12 q - 4 s) w + (9 - q)(s (3 - q) - q (9 - q)))

    Parameters
    ----------
    q : float
        m' dx w^2 / (EI/dx^3) [-].
    re, im : float
        Dynamic stiffness of a support over EI/dx^3 [-].

    Returns
    -------
    tuple of float (10,)
        Real and imaginary parts: factor of the first and the second wave from bay to bay [-], of magnitude up
        to one; share of the first and the second wave in the point receptance, times EI/dx^3 [-]. Then how
        much of its energy either wave loses from bay to bay [-].
    """
    still = (3.0 - q) * (9.0 - q)
    half_re, half_im = 6.0 * q - 2.0 * re, -2.0 * im
    product_re, product_im = (9.0 - q) * (re * (3.0 - q) - q * (9.0 - q)), still * im
    root_re, root_im = square_root(
        half_re * half_re - half_im * half_im - product_re, 2.0 * half_re * half_im - product_im
    )
    # the larger root by addition, the smaller from their product: neither cancels
    sign = -1.0 if root_re * half_re + root_im * half_im < 0.0 else 1.0
    root_re, root_im = sign * root_re, sign * root_im
    one_re, one_im = half_re + root_re, half_im + root_im
    scale = 1.0 / (one_re * one_re + one_im * one_im)
    two_re = (product_re * one_re + product_im * one_im) * scale
    two_im = (product_im * one_re - product_re * one_im) * scale
    # share of either wave: (still + 4 w) / (-+ 2 root)
    scale = 0.5 / (root_re * root_re + root_im * root_im)
    root_re, root_im = root_re * scale, -root_im * scale
    m1_re, m1_im, a1_re, a1_im, lost1 = wave(
        one_re, one_im, -still - 4.0 * one_re, -4.0 * one_im, root_re, root_im
    )
    m2_re, m2_im, a2_re, a2_im, lost2 = wave(
        two_re, two_im, still + 4.0 * two_re, 4.0 * two_im, root_re, root_im
    )
    return m1_re, m1_im, m2_re, m2_im, a1_re, a1_im, a2_re, a2_im, lost1, lost2


@njit(nogil=True, cache=True, inline="always", error_model="numpy")
def wave(
    re: float, im: float, share_re: float, share_im: float, root_re: float, root_im: float
) -> tuple[float, float, float, float, float]:
    """Return factor from bay to bay, share in the receptance and loss of energy of the wave of w = y - 2.

    With 1/factor = exp(a + i b) the imaginary part of 1 + w/2 = cosh(a + i b) is sinh(a) sin(b), and the real
    part of sinh(a + i b) is sinh(a) cos(b). So where a wave runs, the loss of energy, 1 - exp(-2 a) =
    2 sinh(a) |factor|, needs no difference of numbers near one.
    """
    half_re, half_im = square_root(
        re * (1.0 + 0.25 * re) - 0.25 * im * im, im * (1.0 + 0.25 * re) + 0.25 * re * im
    )
    mean_re, mean_im = 1.0 + 0.5 * re, 0.5 * im
    sign = -1.0 if half_re * mean_re + half_im * mean_im < 0.0 else 1.0
    half_re, half_im = sign * half_re, sign * half_im
    factor_re, factor_im = mean_re + half_re, mean_im + half_im
    scale = 1.0 / (factor_re * factor_re + factor_im * factor_im)
    # share * root / (2 half)
    amplitude_re = share_re * root_re - share_im * root_im
    amplitude_im = share_re * root_im + share_im * root_re
    size = half_re * half_re + half_im * half_im
    inverse = 0.5 / size
    sine = 0.5 * (1.0 + size - mean_re * mean_re - mean_im * mean_im)  # sin(b)^2
    across = sine > 0.5
    sinh = abs(mean_im if across else half_re) / math.sqrt(max(sine if across else 1.0 - sine, 0.5))
    lost = 2.0 * sinh * math.sqrt(scale) if scale > 0.5 else 1.0 - scale
    return (
        factor_re * scale,
        -factor_im * scale,
        (amplitude_re * half_re + amplitude_im * half_im) * inverse,
        (amplitude_im * half_re - amplitude_re * half_im) * inverse,
        lost,
    )
