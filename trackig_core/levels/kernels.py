"""Compiled cubic splines: values, integrals over bands, and the highest peak.

Any units. The spline is that of ``scipy.interpolate.CubicSpline`` (its third derivative runs on through the
second and the last knot but one), whose answers the tests hold these to; on some hundred knots the library's
checks and reshaping took ten times as long as its arithmetic.
"""

import math

import numpy as np

from trackig_core.arrays import RealArray
from trackig_core.compiling import njit


@njit(nogil=True, cache=True, error_model="numpy")
def spline_slopes(x: RealArray, y: RealArray) -> RealArray:
    """Return the slopes of a cubic spline at its knots, from a tridiagonal system.

    Parameters
    ----------
    x, y : numpy.ndarray (knots,)
        Knots, at least four, ascending, and values.

    Returns
    -------
    numpy.ndarray (knots,)
        Slopes.
    """
    last = x.size - 1
    slopes, factors = np.empty(x.size), np.empty(x.size)
    h, h_next = x[1] - x[0], x[2] - x[1]
    rise, rise_next = (y[1] - y[0]) / h, (y[2] - y[1]) / h_next
    both = h + h_next
    factors[0] = both / h_next
    slopes[0] = ((h + 2.0 * both) * h_next * rise + h * h * rise_next) / (both * h_next)
    for i in range(1, last):
        h_next = x[i + 1] - x[i]
        rise_next = (y[i + 1] - y[i]) / h_next
        pivot = 1.0 / (2.0 * (h + h_next) - h_next * factors[i - 1])
        slopes[i] = (3.0 * (h_next * rise + h * rise_next) - h_next * slopes[i - 1]) * pivot
        factors[i] = h * pivot
        h, rise = h_next, rise_next
    before = x[last - 1] - x[last - 2]
    rise_before = (y[last - 1] - y[last - 2]) / before
    both = h + before
    end = (h * h * rise_before + (2.0 * both + h) * before * rise) / both
    slopes[last] = (end - both * slopes[last - 1]) / (before - both * factors[last - 1])
    for i in range(last - 1, -1, -1):
        slopes[i] -= factors[i] * slopes[i + 1]
    return slopes


@njit(nogil=True, cache=True, error_model="numpy")
def cubic(x: RealArray, y: RealArray, slopes: RealArray, i: int) -> tuple[float, float]:
    """Return the coefficients of the square and of the cube of a spline between two knots.

    Parameters
    ----------
    x, y, slopes : numpy.ndarray (knots,)
        Knots, values and slopes.
    i : int
        The knot where the interval begins.

    Returns
    -------
    tuple of float
        Coefficients of (x - x[i])^2 and (x - x[i])^3.
    """
    h = x[i + 1] - x[i]
    rise = (y[i + 1] - y[i]) / h
    square = (3.0 * rise - 2.0 * slopes[i] - slopes[i + 1]) / h
    return square, (slopes[i] + slopes[i + 1] - 2.0 * rise) / (h * h)


@njit(nogil=True, cache=True, error_model="numpy")
def spline_value(x: RealArray, y: RealArray, slopes: RealArray, at: float) -> float:
    """Return the value of a cubic spline.

    Parameters
    ----------
    x, y, slopes : numpy.ndarray (knots,)
        Knots, values and slopes.
    at : float
        Where, from the first knot to the last.

    Returns
    -------
    float
        The value.
    """
    i: int = min(max(int(np.searchsorted(x, at, side="right")) - 1, 0), x.size - 2)
    square, cube = cubic(x, y, slopes, i)
    t = at - x[i]
    value: float = y[i] + t * (slopes[i] + t * (square + t * cube))
    return value


@njit(nogil=True, cache=True, error_model="numpy")
def spline_integrals(x: RealArray, y: RealArray, slopes: RealArray, edges: RealArray) -> RealArray:
    """Return the integrals of a cubic spline over neighbouring bands.

    Panels are summed band by band: the difference of one running sum would lose bands that lie 160 dB below
    others.

    Parameters
    ----------
    x, y, slopes : numpy.ndarray (knots,)
        Knots, values and slopes.
    edges : numpy.ndarray (bands + 1,)
        Edges of the bands, ascending; what lies beyond the knots is extrapolated.

    Returns
    -------
    numpy.ndarray (bands,)
        Integrals.
    """
    integrals = np.zeros(edges.size - 1)
    last = x.size - 2
    i: int = min(max(int(np.searchsorted(x, edges[0], side="right")) - 1, 0), last)
    for band in range(integrals.size):
        low = edges[band]
        while low < edges[band + 1]:
            high = edges[band + 1] if i == last else min(edges[band + 1], x[i + 1])
            square, cube = cubic(x, y, slopes, i)
            near, far = low - x[i], high - x[i]
            # divided differences of the powers: no digits are lost where a panel lies far from its knot
            integrals[band] += (high - low) * (
                y[i]
                + slopes[i] * (near + far) / 2.0
                + square * (near * near + near * far + far * far) / 3.0
                + cube * (near + far) * (near * near + far * far) / 4.0
            )
            low = high
            if i < last and high >= x[i + 1]:
                i += 1
    return integrals


@njit(nogil=True, cache=True, error_model="numpy")
def highest_peak(x: RealArray, y: RealArray) -> float:
    """Return where a cubic spline has its highest maximum between its ends.

    Parameters
    ----------
    x, y : numpy.ndarray (knots,)
        Knots, at least four, ascending, and values.

    Returns
    -------
    float
        The place; NaN if there is no maximum.
    """
    slopes = spline_slopes(x, y)
    place, height = math.nan, -math.inf
    for i in range(x.size - 1):
        if slopes[i] < 0.0 and slopes[i + 1] > 0.0:
            continue  # a dip; between slopes of these signs there is no maximum beside it
        square, cube = cubic(x, y, slopes, i)
        discriminant = square * square - 3.0 * cube * slopes[i]
        if discriminant <= 0.0:
            continue
        # of the two roots of the slope the one where it falls, in the form that does not cancel
        root = math.sqrt(discriminant)
        t = (-square - root) / (3.0 * cube) if square > 0.0 else slopes[i] / (root - square)
        if t >= 0.0 and t <= x[i + 1] - x[i]:
            value = y[i] + t * (slopes[i] + t * (square + t * cube))
            if value > height:
                place, height = x[i] + t, value
    return place
