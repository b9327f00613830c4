"""Relaxation terms of a constant loss factor, interpolated in a table of least-squares fits.

Loss factors have no unit; strengths are for a stiffness of 1 N/m at 50 Hz; times in s. The table was made by
:mod:`trackig_core.track.make_damping_table`.

The best three terms depend on the loss factor without jumps, down to zero, where strength over loss factor
has a limit. The logarithms of both, at Chebyshev nodes from zero to one and from one to two, are therefore
interpolated by one polynomial each. They differ from a fit by some 1e-7, as much as a fit from the true
optimum. Above a loss factor of two the third term reaches the shortest relaxation time allowed, and three
terms no longer hold the error of a few per cent.
"""

from functools import cache
from importlib.resources import files

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import ArrayLike

from trackig_core.arrays import RealArray

TABLES = (("damping_table.csv", 0.0, 1.0), ("damping_table_above_one.csv", 1.0, 2.0))
"""File of each table, and the loss factors from which to which it reaches [-]."""

LARGEST = TABLES[-1][2]
"""Loss factor at which the tables end [-]."""


def nodes(low: float, high: float) -> RealArray:
    """Return the Chebyshev nodes between two loss factors, descending (16,) [-]."""
    return low + (high - low) * (1 + np.cos(np.pi * (np.arange(16) + 0.5) / 16)) / 2


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
    values = _interpolated(loss_factor, *TABLES[0])
    for table in TABLES[1:]:
        above = loss_factor > table[1]
        if above.any():
            values = np.where(above[..., None], _interpolated(loss_factor, *table), values)
    return loss_factor[..., None] * values[..., :3], values[..., 3:6], values[..., 6]


def _interpolated(loss_factor: RealArray, file: str, low: float, high: float) -> RealArray:
    """Return all columns of a table (..., 7), at its nearest end for loss factors beyond it."""
    # Chebyshev polynomials T_n(x) = cos(n arccos x), x from -1 to 1 along the table
    angle = np.arccos(np.clip(2 * (loss_factor - low) / (high - low) - 1, -1, 1))
    coefficients = _coefficients(file, low, high)
    return np.exp(np.cos(angle[..., None] * np.arange(len(coefficients))) @ coefficients)


@cache
def _coefficients(file: str, low: float, high: float) -> RealArray:
    """Return the coefficients of the Chebyshev polynomials (16, 7), of the logarithms of all columns [-]."""
    with (files("trackig_core.track") / "data" / file).open() as lines:
        table = np.loadtxt(lines, delimiter=",", skiprows=1)
    along = 2 * (table[:, 0] - low) / (high - low) - 1
    return np.asarray(chebyshev.chebfit(along, np.log(table[:, 1:]), len(table) - 1))
