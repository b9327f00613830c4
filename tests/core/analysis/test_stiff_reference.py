"""The very stiff reference: its false peak is the wheel on its contact spring, and stiffening is the cure."""

import numpy as np
import pytest
from hypothesis import given, settings

import trackig_core as tig
from tests.core.test_solver import ordinary_designs
from trackig_core.analysis.stiff_reference import very_stiff

FREQUENCY = np.geomspace(5, 500, 200)


def test_the_false_peak_is_the_wheel_on_its_contact_spring(preset):
    design = tig.PRESETS[preset]
    found = tig.stiff_references(design, FREQUENCY)
    expected = np.sqrt(design.contact_stiffness / design.wheel_mass) / (2 * np.pi)
    assert found.contact_resonance == pytest.approx(expected)
    peak = found.frequency[np.argmax(found.real)]
    assert peak == pytest.approx(expected, rel=0.01)
    assert found.real.max() > 30
    # a mass on a spring on rigid ground, away from its peak
    away = np.abs(np.log(found.frequency / expected)) > 0.2
    alone = -20 * np.log10(np.abs(1 - (found.frequency[away] / expected) ** 2))
    assert np.abs(found.real[away] - alone).max() < 0.3


@given(ordinary_designs)
@settings(max_examples=20)
def test_with_the_contact_stiffened_too_it_is_the_rigid_track(design):
    found = tig.stiff_references(design, FREQUENCY)
    assert np.abs(found.stiffened).max() < 0.3
    assert np.abs(found.gain_stiffened - found.gain_rigid).max() < 0.3
    rigid = tig.solve(design, "exact", reference="rigid")
    np.testing.assert_allclose(found.gain_rigid, rigid.insertion_gain, atol=1e-9)


def test_the_false_peak_makes_a_false_dip(preset):
    design = tig.PRESETS[preset]
    found = tig.stiff_references(design, FREQUENCY)
    dip = found.gain_real - found.gain_rigid
    at = np.argmin(dip)
    assert dip[at] < -10
    low, high = tig.BAND_EDGES[at], tig.BAND_EDGES[at + 1]
    assert low <= found.contact_resonance <= high


def test_wheel_and_rail_of_the_reference_are_the_design_s():
    design = tig.PRESETS["booted-sleeper"]
    stiff = very_stiff(design, stiffen_contact=False)
    assert not stiff.two_stage
    for name in ("rail", "wheel_mass", "contact_stiffness", "fastener_spacing"):
        assert getattr(stiff, name) == getattr(design, name)
