"""The rail that shears against an independent package, against the rail that bends, and what it changes."""

import numpy as np
import pytest

import trackig_core as tig
from tests.core.analysis.test_track_response import decibels, peer
from trackig_core.analysis import Lattice, peer_receptances, point_receptance, receptance, summed_decay_rate
from trackig_core.frequency_domain import timoshenko
from trackig_core.frequency_domain.point_force import rail_waves

BLOCK, SLAB = tig.PRESETS["booted-block-low-mass"], tig.PRESETS["slab-track"]
SHEARING = Lattice(elements_per_bay=24, rail="timoshenko")
FINE = Lattice(elements_per_bay=24)


def test_an_independent_package_has_the_same_receptances(preset):
    """Within 0.001 dB to 500 Hz; above, its 241 supports end before the waves have died away."""
    rows = peer(preset, "timoshenko")
    for place in ("support", "midspan"):
        expected = rows[f"{place}_re"] + 1j * rows[f"{place}_im"]
        found = point_receptance(tig.PRESETS[preset], rows["frequency_hz"], place, SHEARING)
        assert decibels(found / expected)[:14].max() < 0.001
        assert decibels(found / expected).max() < 0.11


def test_an_earlier_run_of_the_package_is_met_too(preset):
    earlier = peer_receptances()[preset]
    found = receptance(tig.PRESETS[preset], earlier.frequency, lattice=SHEARING)
    assert decibels(found / earlier.timoshenko).max() < 0.01


def test_an_independent_package_has_the_same_decay_sum(preset):
    rows = peer(preset, "timoshenko")[:14]
    found = summed_decay_rate(tig.PRESETS[preset], rows["frequency_hz"], "support", 1, SHEARING)
    assert np.abs(found - rows["decay_db_per_m"]).max() < 0.001


@pytest.mark.parametrize("design", [BLOCK, SLAB, BLOCK.replace(fastener_spacing=0.9)])
def test_a_rail_rigid_in_shear_and_without_rotary_inertia_only_bends(design, monkeypatch):
    monkeypatch.setattr(timoshenko, "SHEAR_MODULUS", 1e16)
    monkeypatch.setattr(timoshenko, "STEEL_DENSITY", 1e-6)
    frequency = np.geomspace(5, 800, 40)
    bending = Lattice(elements_per_bay=192)
    found, expected = (receptance(design, frequency, 2, lattice) for lattice in (SHEARING, bending))
    np.testing.assert_allclose(found, expected, rtol=3e-3)
    midspan = [point_receptance(design, frequency, "midspan", lattice) for lattice in (SHEARING, bending)]
    np.testing.assert_allclose(*midspan, rtol=3e-3)


def test_shear_costs_the_euler_rail_what_is_known():
    """2.2 dB over a support on slab track; up to 2.5 dB near 200 Hz on tracks with boots."""
    frequency = tig.BAND_CENTRES[7:]
    slab = receptance(SLAB, frequency, lattice=FINE) / receptance(SLAB, frequency, lattice=SHEARING)
    np.testing.assert_allclose(20 * np.log10(np.abs(slab)), -2.2, atol=0.04)
    high = tig.PRESETS["booted-block-high-mass"]
    booted = receptance(high, frequency, lattice=FINE) / receptance(high, frequency, lattice=SHEARING)
    assert decibels(booted).argmax() == 9  # 200 Hz
    assert decibels(booted).max() == pytest.approx(2.55, abs=0.05)


def test_between_supports_a_shearing_rail_gives_way_further():
    frequency = tig.BAND_CENTRES[7:]
    over, between = (point_receptance(SLAB, frequency, place, SHEARING) for place in ("support", "midspan"))
    ratio = 20 * np.log10(np.abs(between / over))
    assert 2.0 < ratio.min() < ratio.max() < 2.75


def test_reciprocity_holds():
    rail = rail_waves(BLOCK, np.array([20.0, 150.0, 700.0]), SHEARING)
    there, back = rail.receptance(np.array([31, 5]), 12), rail.receptance(np.array([12]), 31)
    np.testing.assert_allclose(there[0], back[0], rtol=1e-9)


def test_a_ring_of_many_bays_is_the_infinite_track():
    ring = Lattice(elements_per_bay=3, bays=900, rail="timoshenko")
    frequency = np.array([20.0, 100.0, 400.0])
    expected = receptance(BLOCK, frequency, lattice=SHEARING)
    np.testing.assert_allclose(receptance(BLOCK, frequency, lattice=ring), expected, rtol=1e-4)


def test_the_exact_solver_takes_it():
    found = tig.solve(SLAB, "exact", rail="timoshenko").insertion_gain
    difference = found - tig.solve(SLAB, "exact").insertion_gain
    assert np.abs(difference[:11]).max() < 0.2  # well below the loaded track
    assert np.abs(difference).max() > 3.0  # a softer track, whose resonance has moved
    np.testing.assert_array_equal(
        tig.solve(SLAB, "exact", rail="euler").insertion_gain, tig.solve(SLAB, "exact").insertion_gain
    )


def test_it_is_not_stepped_in_time():
    with pytest.raises(ValueError, match="rail = 'timoshenko' is not stepped in time: give fidelity 'exact'"):
        tig.solve(SLAB, "live", rail="timoshenko")
    with pytest.raises(ValueError, match="only the rail that bends is stepped in time"):
        Lattice(time_step=1e-5, rail="timoshenko")
    with pytest.raises(ValueError, match="rail = 'rigid': give 'euler' or 'timoshenko'"):
        tig.solve(SLAB, "exact", rail="rigid")
