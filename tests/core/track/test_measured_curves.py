"""Measured tables: what is refused, how they are read, and how the fit says that it is poor."""

import numpy as np
import pytest

import trackig_core as tig
from trackig_core.frequency_domain.floquet_waves import exact_spectrum
from trackig_core.time_domain.grid import PAPER_TIME_STEP, RING_BAYS, make_grid
from trackig_core.time_domain.spectrum import force_spectrum
from trackig_core.time_domain.time_stepping import simulate
from trackig_core.track.viscoelastic_law import FIT_FREQUENCIES, relaxation

BLOCK = tig.PRESETS["booted-block-low-mass"]
NAN = float("nan")


@pytest.mark.parametrize(
    ("points", "row", "words"),
    [
        ([(5, 0.1)], None, "1 rows: give from 2"),
        ([], None, "0 rows"),
        ([(f, 0.1) for f in range(1, 1002)], None, "1001 rows"),
        (5.0, None, "give rows of frequency, loss factor"),
        ([5.0, 6.0], None, "give rows"),
        ([(50, 0.1), (5, 0.1)], 2, "sort the rows"),
        ([(5, 0.1), (20, 0.1), (20, 0.2)], 3, "not above the 20 Hz of row 2"),
        ([(5, 0.1), (20, -0.1)], 2, "loss factor = -0.1"),
        ([(-5, 0.1), (20, 0.1)], 1, "frequency = -5"),
        ([(5, 0.1), (20, NAN)], 2, "loss factor = nan"),
        ([(5, 0.1), (float("inf"), 0.1)], 2, "frequency = inf"),
        ([(5, 0.1), (20, "0,2")], 2, "loss factor = '0,2'"),
        ([(5, 0.1), (20, True)], 2, "loss factor = True"),
        ([(5, 0.1), (20, 10**400)], 2, "from 0.0001 to 2"),
        ([(5, 0.1), (20, 0.1, 7)], 2, "3 values: give frequency, loss factor"),
        ([(5, 0.1), (20, None)], 2, "loss factor = None"),
    ],
)
def test_bad_tables_name_the_row(points, row, words):
    with pytest.raises(tig.MeasurementError, match=words) as caught:
        tig.LossFactorCurve(points)
    assert caught.value.row == row
    assert str(caught.value).startswith("row " if row else "")
    assert len(str(caught.value)) < 300


def test_a_stiffness_table_has_three_columns():
    with pytest.raises(tig.MeasurementError, match="row 1: 2 values: give frequency, stiffness, loss factor"):
        tig.StiffnessCurve([(5, 0.1), (20, 0.1)])
    with pytest.raises(
        tig.MeasurementError, match=r"row 2: stiffness = 28: give a number from 100000 .* N/m"
    ):
        tig.StiffnessCurve([(5, 28e6, 0.1), (20, 28, 0.1)])


@pytest.mark.parametrize("preload", [NAN, float("inf"), -1.0, 1.1e6, 10**400, True, "30 kN"])
def test_a_preload_is_a_load_that_a_support_carries(preload):
    points = [(5, 28e6, 0.1), (20, 28e6, 0.1)]
    with pytest.raises(
        tig.MeasurementError, match=r"preload = .*: give a number from 0 to 1e\+06 N"
    ) as caught:
        tig.StiffnessCurve(points, preload)
    assert len(str(caught.value)) < 300
    assert tig.StiffnessCurve(points, 30_000).preload == 30e3


def test_no_law_is_fitted_again_for_another_preload():
    points = [(5, 28e6, 0.11), (20, 29e6, 0.12), (500, 38e6, 0.13)]
    plain, loaded = (tig.StiffnessCurve(points, preload) for preload in (None, 30e3))
    assert plain != loaded
    assert loaded.without_preload == plain
    assert relaxation(loaded, None) is relaxation(plain, None)


def test_between_points_values_are_straight_over_the_logarithm_of_frequency():
    curve = tig.LossFactorCurve([(10, 0.1), (100, 0.3), (1000, 0.2)])
    assert curve.loss_factor([1, 10, 10**1.5, 100, 5000]) == pytest.approx([0.1, 0.1, 0.2, 0.3, 0.2])


def test_a_constant_curve_is_the_constant():
    curve = tig.LossFactorCurve([(5, 0.2), (500, 0.2)])
    frequency = np.geomspace(5, 500, 30)
    measured, constant = relaxation(28e6, curve), relaxation(28e6, 0.2)
    assert measured.dynamic_stiffness(frequency) == pytest.approx(
        constant.dynamic_stiffness(frequency), rel=1e-5
    )
    gains = [
        tig.solve(BLOCK.replace(boot_loss_factor=value), "exact").insertion_gain for value in (curve, 0.2)
    ]
    assert gains[0] == pytest.approx(gains[1], abs=1e-4)


def test_a_rising_loss_factor_is_followed():
    curve = tig.LossFactorCurve([(5, 0.1), (500, 0.25)])
    law = relaxation(28e6, curve)
    errors = law.loss_factor(FIT_FREQUENCIES) / curve.loss_factor(FIT_FREQUENCIES) - 1
    assert np.abs(errors).max() == pytest.approx(law.worst_error)
    assert law.worst_error < 0.06
    assert law.dynamic_stiffness(50.0).real == pytest.approx(28e6)


def causal_curve(law, frequency):
    stiffness = law.dynamic_stiffness(frequency)
    return tig.StiffnessCurve(zip(frequency, stiffness.real, law.loss_factor(frequency), strict=True))


def test_a_measured_stiffness_that_is_causal_is_found_again():
    """Points of a known law, as a test house would report them, give back that law's insertion gain."""
    truth = relaxation(28e6, 0.3)
    curve = causal_curve(truth, np.geomspace(5, 500, 100))
    found = relaxation(curve, None)
    frequency = np.geomspace(5, 500, 57)
    assert found.dynamic_stiffness(frequency) == pytest.approx(truth.dynamic_stiffness(frequency), rel=2e-3)
    measured = tig.solve(BLOCK.replace(boot_stiffness=curve, boot_loss_factor=None), "exact")
    stated = tig.solve(BLOCK.replace(boot_loss_factor=0.3), "exact")
    assert measured.insertion_gain == pytest.approx(stated.insertion_gain, abs=0.02)
    assert measured.notes == ()


def test_a_few_points_in_a_narrow_range_still_set_the_stiffness():
    curve = causal_curve(relaxation(28e6, 0.2), np.array([20.0, 50.0, 120.0]))
    assert relaxation(curve, None).stiffness(50.0) == pytest.approx(28e6, rel=0.02)
    assert relaxation(causal_curve(relaxation(28e6, 0.2), np.array([1.0, 2.0])), None).stiffness(
        1.0
    ) == pytest.approx(relaxation(28e6, 0.2).stiffness(1.0), rel=0.02)


def test_a_stiffness_that_no_causal_damper_has_is_fitted_poorly_and_says_so():
    """As much damping as this cannot come without stiffening."""
    curve = tig.StiffnessCurve([(5, 28e6, 0.3), (500, 28e6, 0.3)])
    solution = tig.solve(BLOCK.replace(boot_stiffness=curve, boot_loss_factor=None), "exact")
    assert solution.boot_law.worst_error > 0.1
    assert solution.pad_law.worst_error < 0.051
    assert len(solution.notes) == 1
    assert (
        f"fitted to the boot misses the stated values by up to {solution.boot_law.worst_error:.0%}"
        in solution.notes[0]
    )


def test_a_measured_stiffness_has_its_own_loss_factor():
    curve = tig.StiffnessCurve([(5, 28e6, 0.2), (500, 38e6, 0.2)])
    with pytest.raises(tig.DesignError, match="loss factors of its own") as caught:
        BLOCK.replace(boot_stiffness=curve)
    assert caught.value.field == "boot_loss_factor"
    single = tig.PRESETS["slab-track"].replace(pad_stiffness=curve, pad_loss_factor=None)
    assert not single.two_stage


def test_designs_with_tables_are_keys_too():
    points = [(5, 0.1), (500, 0.2)]
    one, other = (BLOCK.replace(pad_loss_factor=tig.LossFactorCurve(points)) for _ in range(2))
    assert one == other
    assert hash(one) == hash(other)


def test_a_run_follows_the_fitted_curve():
    """Time stepping and its z-transform agree on a measured pad, as they do on a constant one."""
    design = BLOCK.replace(pad_loss_factor=tig.LossFactorCurve([(5, 0.05), (80, 0.2), (500, 0.35)]))
    spectrum = tig.solve(design).spectrum
    frequency = spectrum.frequency[spectrum.frequency <= 500]
    exact = exact_spectrum(design, frequency, 1e-4, tig.Lattice(3, RING_BAYS, PAPER_TIME_STEP))
    assert np.abs(10 * np.log10(spectrum.energy[: len(frequency)] / exact.energy)).max() < 1e-3
    constant = tig.solve(BLOCK, "exact").insertion_gain
    assert np.abs(tig.solve(design, "exact").insertion_gain - constant).max() > 0.5


FLAT = [tig.StiffnessCurve([(5, 28e6, loss), (500, 28e6, loss)]) for loss in (0.05, 0.2, 0.4)]
FALLING = [tig.StiffnessCurve([(5, 30e6, loss), (500, 24e6, loss)]) for loss in (0.05, 0.3)]
STEEP = [
    tig.LossFactorCurve(points)
    for points in (
        [(5, 0.02), (50, 0.02), (500, 0.9)],
        [(400, 0.1), (500, 1.0)],
        [(5, 0.1), (100, 0.1), (200, 0.6), (500, 0.6)],
        [(5, 0.5), (500, 0.01)],
    )
]


@pytest.mark.parametrize("part", ["pad", "boot"])
@pytest.mark.parametrize("curve", [*FLAT, *FALLING, *STEEP], ids=lambda curve: str(curve.points))
def test_a_run_with_any_sound_table_stays_finite_and_follows_its_scheme(part, curve):
    """Tables that no causal damper obeys are fitted poorly, but never upset the time stepping."""
    if isinstance(curve, tig.StiffnessCurve):
        changes = {f"{part}_stiffness": curve, f"{part}_loss_factor": None}
    else:
        changes = {f"{part}_loss_factor": curve}
    design = BLOCK.replace(**changes)
    grid = make_grid(design, bays=101)
    spectrum = force_spectrum(simulate(design, grid))
    # below the bands a strongly damped track creeps back for longer than the record lasts
    banded = (spectrum.frequency > tig.BAND_EDGES[0]) & (spectrum.frequency <= 500)
    exact = exact_spectrum(design, spectrum.frequency[banded], 1e-4, tig.Lattice(3, grid.bays, grid.dt))
    assert np.abs(10 * np.log10(spectrum.energy[banded] / exact.energy)).max() < 0.05
