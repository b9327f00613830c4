"""The same lattice at rest: how a constant load sinks the rail, in closed form.

At zero frequency the two waves of :mod:`trackig_core.frequency_domain.floquet_waves` neither run nor lose
energy: both decay from bay to bay. With three elements a bay, s the static stiffness of a support over
EI/dx^3, and w = m + 1/m - 2 for a wave's factor m from bay to bay, the compliance of the rail over a support
is

    (27 + 4 w) / (w^2 + 4 s w + 27 s) / (EI/dx^3)

the limit of the formula in :func:`trackig_core.frequency_domain.batch_kernels.bay_waves`. Every function
takes arrays, so that many tracks cost no more calls than one. SI units.
"""

import numpy as np
from numpy.typing import ArrayLike

from trackig_core.arrays import ComplexArray, RealArray

ELEMENTS_PER_BAY = 3
"""Rail elements per bay [-]; the closed form is written out for three."""

_DOUBLE = 27 / 4
"""Support stiffness over EI/dx^3 at which both waves are one [-]."""

_APART = 1e-6
"""How far from :data:`_DOUBLE` the waves are solved at least [-]: it costs 1e-7 of a deflection."""


def support_stiffness(pad: ArrayLike, boot: ArrayLike | None = None) -> RealArray:
    """Return the static stiffness of a support: pad and boot in series.

    Parameters
    ----------
    pad : array_like (...)
        Static stiffness of the pads [N/m].
    boot : array_like (...) or None
        Static stiffness of the boots [N/m]; None or infinite when single-stage.

    Returns
    -------
    numpy.ndarray (...)
        Stiffness [N/m].
    """
    pad = np.asarray(pad, dtype=float)
    return pad if boot is None else 1 / (1 / pad + 1 / np.asarray(boot, dtype=float))


def bending_stiffness(rail: ArrayLike, spacing: ArrayLike) -> RealArray:
    """Return the bending stiffness between rail elements, EI / dx^3.

    Parameters
    ----------
    rail : array_like (...)
        Bending stiffness of the rails, EI [N m2].
    spacing : array_like (...)
        Distance between supports [m].

    Returns
    -------
    numpy.ndarray (...)
        Stiffness [N/m].
    """
    return np.asarray(rail, dtype=float) / (np.asarray(spacing, dtype=float) / ELEMENTS_PER_BAY) ** 3


def static_waves(stiffness: ArrayLike) -> tuple[ComplexArray, ComplexArray]:
    """Return the two shapes in which a sunken rail dies away from bay to bay.

    Parameters
    ----------
    stiffness : array_like (...)
        Static stiffness of a support over EI/dx^3 [-].

    Returns
    -------
    multipliers : numpy.ndarray of complex (2, ...)
        Factor of each shape from bay to bay [-].
    amplitudes : numpy.ndarray of complex (2, ...)
        Share of each in the compliance of the rail over a support, times EI/dx^3 [-].
    """
    s = np.asarray(stiffness, dtype=float)
    s = np.where(np.abs(s - _DOUBLE) < _APART, _DOUBLE + _APART, s)
    root = np.sqrt(4 * s * (s - _DOUBLE) + 0j)
    larger = -2 * s - root  # by addition; the smaller from their product: neither cancels
    w: ComplexArray = np.stack([larger, 27 * s / larger]).astype(complex)
    half = np.sqrt(w * (1 + 0.25 * w))  # (1/m - m) / 2
    half = np.where((half * (1 + 0.5 * w).conj()).real < 0, -half, half)
    residues = (27 + 4 * w) / (w - w[::-1])
    return 1 / (1 + 0.5 * w + half), -residues / (2 * half)


def point_compliance(stiffness: ArrayLike, bending: ArrayLike) -> RealArray:
    """Return how far the rail sinks under a unit load over a support.

    Parameters
    ----------
    stiffness : array_like (...)
        Static stiffness of a support [N/m].
    bending : array_like (...)
        EI / dx^3 [N/m].

    Returns
    -------
    numpy.ndarray (...)
        Compliance [m/N].
    """
    bending = np.asarray(bending, dtype=float)
    _, amplitudes = static_waves(np.asarray(stiffness, dtype=float) / bending)
    return amplitudes.sum(axis=0).real / bending
