"""A dynamic stiffness holds at the frequency that the design names, and loss factors reach to two."""

import numpy as np
import pytest

import trackig_core as tig
from trackig_core.analysis import with_loss_factor
from trackig_core.track.viscoelastic_law import laws

BLOCK = tig.PRESETS["booted-block-low-mass"]
LOSS = tig.LossFactorCurve(((5.0, 0.1), (500.0, 0.3)))


@pytest.mark.parametrize("frequency", [5.0, 10.0, 20.0, 50.0, 500.0])
def test_the_stated_stiffness_is_met_at_its_frequency(frequency):
    for law, stiffness in zip(laws(BLOCK.replace(stiffness_frequency=frequency)), (100e6, 28e6), strict=True):
        assert law.stiffness(frequency) == pytest.approx(stiffness, rel=1e-12)


def test_a_measured_loss_factor_is_scaled_at_it_too():
    pad, _ = laws(BLOCK.replace(stiffness_frequency=10.0, pad_loss_factor=LOSS))
    assert pad.stiffness(10.0) == pytest.approx(100e6, rel=1e-12)


def test_a_measured_stiffness_has_frequencies_of_its_own():
    curve = tig.StiffnessCurve(((5, 20e6, 0.1), (500, 40e6, 0.3)))
    measured = BLOCK.replace(boot_stiffness=curve, boot_loss_factor=None)
    assert laws(measured)[1] == laws(measured.replace(stiffness_frequency=10.0))[1]


def test_a_stiffness_stated_at_10_hz_is_a_stiffer_one_at_50_hz():
    pad, boot = laws(BLOCK.replace(stiffness_frequency=10.0))
    same = BLOCK.replace(pad_stiffness=pad.stiffness(50.0), boot_stiffness=boot.stiffness(50.0))
    assert same.boot_stiffness > 1.1 * BLOCK.boot_stiffness
    np.testing.assert_allclose(
        tig.solve(BLOCK.replace(stiffness_frequency=10.0), "exact").insertion_gain,
        tig.solve(same, "exact").insertion_gain,
        atol=1e-6,
    )


def test_many_designs_are_solved_as_one_is():
    frequencies = np.array([10.0, 50.0, 200.0])
    many = tig.solve_many(BLOCK, stiffness_frequency=frequencies)
    mixed = tig.solve_many(
        [
            BLOCK.replace(stiffness_frequency=10.0),
            BLOCK.replace(stiffness_frequency=10.0, boot_loss_factor=LOSS),
        ]
    )
    expected = [tig.solve(BLOCK.replace(stiffness_frequency=f), "exact").insertion_gain for f in frequencies]
    np.testing.assert_allclose(many.insertion_gain, expected, atol=0.01)
    np.testing.assert_array_equal(many.insertion_gain[1], tig.solve_many(BLOCK).insertion_gain[0])
    np.testing.assert_allclose(mixed.insertion_gain[0], expected[0], atol=0.01)
    assert np.abs(mixed.insertion_gain[1] - expected[0]).max() > 0.1


def test_another_loss_factor_keeps_the_stated_stiffness():
    design = BLOCK.replace(stiffness_frequency=10.0)
    changed = with_loss_factor(design, 0.05)
    assert changed.boot_stiffness == pytest.approx(28e6, rel=1e-12)
    assert changed.stiffness_frequency == 10.0


def test_a_study_keeps_it_and_older_files_mean_50_hz():
    design = BLOCK.replace(stiffness_frequency=10.0, boot_static_stiffness=20e6)
    text = tig.Study(design).to_toml()
    assert "stiffness_frequency_Hz = 10.0\n" in text
    assert tig.Study.from_toml(text).design == design
    assert "stiffness_frequency_Hz" not in tig.Study(BLOCK).to_toml()


@pytest.mark.parametrize("loss_factor", [1.0, 1.2, 1.5, 2.0])
def test_loss_factors_to_two_are_met_within_5_percent(loss_factor):
    _, boot = laws(BLOCK.replace(boot_loss_factor=loss_factor))
    frequency = np.geomspace(5, 500, 300)
    error = np.abs(boot.loss_factor(frequency) / loss_factor - 1).max()
    assert error < 0.0495
    assert boot.worst_error == pytest.approx(error, rel=0.02)
    assert boot.stiffness(50.0) == pytest.approx(28e6, rel=1e-9)


def test_a_lossy_design_is_stepped_and_solved_alike():
    lossy = BLOCK.replace(boot_loss_factor=1.5)
    exact = tig.solve(lossy, "exact").insertion_gain
    np.testing.assert_allclose(tig.solve(lossy, "live").insertion_gain, exact, atol=0.1)
    np.testing.assert_allclose(tig.solve_many(lossy).insertion_gain[0], exact, atol=0.01)
