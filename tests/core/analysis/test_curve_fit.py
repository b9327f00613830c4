"""How far a fitted law is from measured points, counted where it is fitted."""

import numpy as np
import pytest

import trackig_core as tig
from trackig_core.track.viscoelastic_law import relaxation


def test_a_law_is_found_again_from_points_of_it():
    law = relaxation(28e6, 0.2)
    frequency = np.geomspace(5, 500, 40)
    rows = zip(frequency, law.dynamic_stiffness(frequency).real, law.loss_factor(frequency), strict=True)
    fit = tig.analysis.curve_fit(tig.StiffnessCurve(rows))
    assert fit.is_fitted.all()
    assert fit.error_at_points < 2e-3
    assert fit.law.stiffness(50.0) == pytest.approx(28e6, rel=1e-4)


def test_errors_are_those_of_the_law_at_the_points():
    curve = tig.StiffnessCurve([(1, 310.4e6, 0.151), (10, 605.7e6, 0.151), (30, 671e6, 0.151)])
    fit = tig.analysis.curve_fit(curve)
    law = relaxation(curve, None)
    assert fit.is_fitted.tolist() == [False, True, True]
    expected = [law.stiffness(f) / k - 1 for f, k, _ in curve.points]
    np.testing.assert_allclose(fit.stiffness_error, expected, rtol=1e-12)
    assert fit.error_at_points == pytest.approx(
        max(np.abs([*expected[1:], *fit.loss_factor_error[1:]])), rel=1e-12
    )
    assert abs(expected[0]) > 0.5 > fit.error_at_points


def test_points_all_outside_the_fit_have_no_error_there():
    fit = tig.analysis.curve_fit(tig.StiffnessCurve([(600, 30e6, 0.1), (900, 31e6, 0.1)]))
    assert fit.error_at_points is None


def test_a_loss_factor_alone_has_no_stiffness_to_compare():
    fit = tig.analysis.curve_fit(tig.LossFactorCurve([(5, 0.2), (500, 0.2)]))
    assert fit.stiffness_error is None
    assert fit.error_at_points == pytest.approx(fit.error_between, rel=0.5)
