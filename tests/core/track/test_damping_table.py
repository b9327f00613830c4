"""The table of relaxation terms against the least-squares fits that it replaces, and the golden ones."""

import numpy as np
import pytest

from trackig_core.track.damping_table import LARGEST, TABLES, interpolated_terms, nodes
from trackig_core.track.design import RANGES
from trackig_core.track.make_damping_table import fitted_table
from trackig_core.track.measured_curves import LossFactorCurve
from trackig_core.track.viscoelastic_law import (
    NEGLIGIBLE,
    constant_loss_factor,
    fit_loss_factor,
    relaxation,
)

ROUND = [NEGLIGIBLE, 1e-6, 1e-4, 1e-3, 0.01, 0.05, 0.2, 0.5, 1.0, 1.000001, 1.5, 2.0]

BETWEEN = ROUND + [
    between for _, *ends in TABLES for between in nodes(*ends)[1:] + np.diff(-nodes(*ends)) / 2
]
"""Loss factors that are no nodes: the smallest that has memory, round ones, and halfway between nodes."""


@pytest.mark.parametrize("loss_factor", BETWEEN)
def test_between_nodes_the_table_gives_the_terms_of_a_fit(loss_factor):
    law, fit = constant_loss_factor(float(loss_factor)), fit_loss_factor(float(loss_factor))
    assert law.strengths == pytest.approx(fit.strengths, rel=1e-6)
    assert law.times == pytest.approx(fit.times, rel=1e-6)
    assert law.worst_error == pytest.approx(fit.worst_error, rel=1e-6)
    frequency = np.geomspace(5, 500, 301)
    ratio = law.dynamic_stiffness(frequency) / fit.dynamic_stiffness(frequency)
    assert np.abs(ratio - 1).max() < 1e-7


@pytest.mark.parametrize("loss_factor", ["0.1", "0.15", "0.2", "0.3"])
def test_terms_are_the_golden_ones(golden, loss_factor):
    law = constant_loss_factor(float(loss_factor))
    expected = golden["relaxation_fit"][loss_factor]
    assert law.strengths == pytest.approx(expected["D_relative"], rel=3e-7)
    assert law.times == pytest.approx(expected["tau_s"], rel=3e-7)


@pytest.mark.parametrize(("low", "high"), [table[1:] for table in TABLES])
def test_the_committed_tables_are_what_their_script_makes(low, high):
    at = nodes(low, high)
    strengths, times, worst_error = interpolated_terms(at)
    made = fitted_table(low, high)
    assert made[:, 0] == pytest.approx(at)
    assert strengths / at[:, None] == pytest.approx(made[:, 1:4], rel=1e-6)
    assert times == pytest.approx(made[:, 4:7], rel=1e-6)
    assert worst_error == pytest.approx(made[:, 7], rel=1e-6)


def test_the_table_covers_every_loss_factor_that_a_design_may_have():
    for part in ("pad", "boot"):
        assert RANGES[f"{part}_loss_factor"][:2] == (0.0, LARGEST)


def test_towards_zero_the_terms_keep_in_proportion_and_then_vanish():
    small, smaller = constant_loss_factor(1e-6), constant_loss_factor(1e-8)
    assert np.array(small.strengths) / 1e-6 == pytest.approx(np.array(smaller.strengths) / 1e-8, rel=1e-5)
    assert constant_loss_factor(0.5 * NEGLIGIBLE).strengths == ()


def test_a_measured_loss_factor_that_is_constant_keeps_its_own_fit():
    curve = LossFactorCurve(((5.0, 0.2), (500.0, 0.2)))
    assert relaxation(1.0, curve).strengths == pytest.approx(relaxation(1.0, 0.2).strengths, rel=1e-6)
    assert relaxation(1.0, LossFactorCurve(curve.points)).times is fit_loss_factor(curve).times
