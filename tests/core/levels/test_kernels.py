"""Compiled splines against SciPy's."""

import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.interpolate import CubicSpline

from trackig_core.levels import kernels
from trackig_core.levels.insertion_gain import integrate_bands


@st.composite
def curves(draw):
    """Draw knots and values."""
    steps = draw(st.lists(st.floats(0.01, 3), min_size=3, max_size=40))
    values = draw(st.lists(st.floats(-100, 100), min_size=len(steps) + 1, max_size=len(steps) + 1))
    return 5 + np.cumsum([0, *steps]), np.array(values)


@given(curves())
def test_slopes_and_values_are_those_of_scipy(curve):
    x, y = curve
    spline = CubicSpline(x, y)
    slopes = kernels.spline_slopes(x, y)
    scale = 1 + np.abs(spline(x, 1)).max()
    np.testing.assert_allclose(slopes, spline(x, 1), atol=1e-9 * scale)
    for at in np.linspace(x[0], x[-1], 7):
        assert kernels.spline_value(x, y, slopes, at) == pytest.approx(float(spline(at)), abs=1e-9 * scale)


@given(curves(), st.integers(1, 9))
def test_integrals_are_those_of_scipy_also_beyond_the_knots(curve, bands):
    x, y = curve
    spline = CubicSpline(x, y)
    edges = np.linspace(x[0] - 0.01, x[-1] + 0.01, bands + 1)
    integrals = kernels.spline_integrals(x, y, kernels.spline_slopes(x, y), edges)
    expected = [spline.integrate(low, high) for low, high in itertools.pairwise(edges)]
    scale = (1 + np.abs(y).max() + np.abs(spline(x, 1)).max()) * (x[-1] - x[0] + 1)
    np.testing.assert_allclose(integrals, expected, atol=1e-9 * scale)


@given(curves())
def test_the_highest_peak_is_that_of_scipy(curve):
    x, y = curve
    spline = CubicSpline(x, y)
    roots = spline.derivative().roots(extrapolate=False)
    heights = [float(spline(root)) for root in roots if np.isfinite(root) and spline(root, 2) < -1e-6]
    found = kernels.highest_peak(x, y)
    if heights:
        assert float(spline(found)) == pytest.approx(max(heights), abs=1e-9 * (1 + np.abs(y).max()))


def test_what_only_falls_or_rises_has_no_peak():
    x = np.linspace(1, 2, 9)
    for y in (x, -x, x**3, np.zeros_like(x)):
        assert np.isnan(kernels.highest_peak(x, y))


def test_bands_far_below_others_keep_their_digits():
    frequency = np.linspace(1, 100, 400)
    density = np.where(frequency < 50, 1e16, 1.0)
    last = integrate_bands(frequency, density, np.array([1.0, 40.0, 80.0, 90.0]))[-1]
    assert last == pytest.approx(10, rel=1e-9)


@pytest.mark.parametrize(
    ("frequency", "density", "says"),
    [
        ([1, 2, 3], [1, 1, 1], "at least 4"),
        ([1, 2, 2, 3], [1, 1, 1, 1], "ascending"),
        ([1, 2, 3, 4], [1, 1, np.nan, 1], "finite"),
        ([1, 2, 3, 4], [1, 1, 1], "per frequency"),
    ],
)
def test_a_spectrum_through_which_no_spline_runs_is_refused(frequency, density, says):
    with pytest.raises(ValueError, match=says):
        integrate_bands(np.array(frequency, float), np.array(density, float))
