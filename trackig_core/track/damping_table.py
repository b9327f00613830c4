"""Relaxation terms of a constant loss factor, interpolated in a table of least-squares fits.

Loss factors have no unit; strengths are for a stiffness of 1 N/m at 50 Hz; times in s. The table was made by
:mod:`trackig_core.track.make_damping_table`.

The best three terms depend on the loss factor without jumps, down to zero, where strength over loss factor
has a limit. The logarithms of both, at Chebyshev nodes from zero to one, are therefore interpolated by one
polynomial. It differs from a fit by some 1e-7, as much as a fit from the true optimum.
"""

from functools import cache
from importlib.resources import files

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import ArrayLike

from trackig_core.arrays import RealArray

LARGEST = 1.0
"""Loss factor at which the table ends [-]."""

NODES = LARGEST * (1 + np.cos(np.pi * (np.arange(16) + 0.5) / 16)) / 2
"""Loss factors of the table (16,) [-]: the Chebyshev nodes from zero to :data:`LARGEST`."""
NODES.flags.writeable = False


def interpolated_terms(loss_factor: ArrayLike) -> tuple[RealArray, RealArray, RealArray]:
    """Return the relaxation terms of springs with constant loss factors.

    Parameters
    ----------
    loss_factor : array_like
        Loss factors, from 0 to :data:`LARGEST` [-].

    Returns
    -------
    strengths : numpy.ndarray (..., 3)
        Stiffness that each term loses in time, for a stiffness of 1 N/m at 50 Hz; slowest term first [N/m].
    times : numpy.ndarray (..., 3)
        Relaxation times [s].
    worst_error : numpy.ndarray (...)
        Largest relative error of the loss factor, 5-500 Hz [-].
    """
    loss_factor = np.asarray(loss_factor, dtype=float)
    coefficients = _coefficients()
    # Chebyshev polynomials T_n(x) = cos(n arccos x), x from -1 to 1 along the table
    angle = np.arccos(2 * loss_factor / LARGEST - 1)
    values = np.exp(np.cos(angle[..., None] * np.arange(len(coefficients))) @ coefficients)
    return loss_factor[..., None] * values[..., :3], values[..., 3:6], values[..., 6]


@cache
def _coefficients() -> RealArray:
    """Return the coefficients of the Chebyshev polynomials (16, 7), of the logarithms of all columns [-]."""
    with (files("trackig_core.track") / "data" / "damping_table.csv").open() as lines:
        table = np.loadtxt(lines, delimiter=",", skiprows=1)
    return np.asarray(chebyshev.chebfit(2 * table[:, 0] / LARGEST - 1, np.log(table[:, 1:]), len(table) - 1))
