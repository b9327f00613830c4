"""What damping does: causality, and its price."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import trackig_core as tig
from trackig_core.analysis.damping import damping_curves, gain_by_loss_factor, with_loss_factor
from trackig_core.bands import BAND_CENTRES
from trackig_core.frequency_domain.natural_frequencies import loaded_track
from trackig_core.track.viscoelastic_law import laws

BLOCK, SLAB = tig.PRESETS["booted-block-low-mass"], tig.PRESETS["slab-track"]
FREQUENCY = np.geomspace(5, 500, 200)


@given(loss_factor=st.sampled_from([0.05, 0.1, 0.2, 0.35, 0.5]))
def test_a_causal_damper_stiffens_as_its_loss_demands(loss_factor):
    """Kramers and Kronig, where the loss factor is even: stiffness grows as f^(2/pi atan eta)."""
    pad, _ = damping_curves(SLAB.replace(pad_loss_factor=loss_factor), FREQUENCY)
    assert (np.diff(pad.stiffness) > 0).all()
    assert np.interp(50.0, FREQUENCY, pad.stiffness) == pytest.approx(1, abs=1e-3)
    power = np.polyfit(np.log(FREQUENCY), np.log(pad.stiffness), 1)[0]
    assert power == pytest.approx(2 / np.pi * np.arctan(loss_factor), rel=0.05)
    assert pad.loss_factor == pytest.approx(np.full_like(FREQUENCY, loss_factor), rel=0.055)


def test_curves_are_those_of_the_laws_solved():
    pad, boot = damping_curves(BLOCK, FREQUENCY)
    for curve, law in zip((pad, boot), laws(BLOCK), strict=True):
        stiffness = curve.stiffness * law.stiffness(50.0) * (1 + 1j * curve.loss_factor)
        assert stiffness == pytest.approx(law.dynamic_stiffness(FREQUENCY))
    assert damping_curves(SLAB, FREQUENCY)[1] is None


def test_one_row_per_loss_factor_as_the_door_gives_it():
    found = gain_by_loss_factor(BLOCK, (0.1, 0.2), "rigid", "coherent")
    assert found.shape == (2, 21)
    asked = tig.solve(BLOCK, "exact", reference="rigid", summation="coherent").insertion_gain
    assert found[1] == pytest.approx(asked)


def test_damping_buys_at_resonance_and_costs_above(preset):
    """Against the rigid track; far above the resonances, where no wave is left to be damped."""
    design = tig.PRESETS[preset]
    low, high = gain_by_loss_factor(design, (0.05, 0.5), "rigid", "coherent")
    nearest = np.argmin(np.abs(np.log(BAND_CENTRES / loaded_track(design))))
    assert low[nearest] - high[nearest] > 3
    assert high[-1] - low[-1] > 0.5


def test_a_measured_pad_keeps_its_stiffness_at_50_hz():
    curve = tig.StiffnessCurve([(5, 80e6, 0.1), (50, 100e6, 0.1), (500, 130e6, 0.15)])
    measured = SLAB.replace(pad_stiffness=curve, pad_loss_factor=None)
    changed = with_loss_factor(measured, 0.3)
    assert changed.pad_loss_factor == 0.3
    assert changed.pad_stiffness == pytest.approx(laws(measured)[0].stiffness(50.0))
    assert not changed.two_stage


def test_no_loss_no_gain():
    with pytest.raises(tig.DesignError, match="boot_loss_factor"):
        gain_by_loss_factor(BLOCK, (0.0,))
