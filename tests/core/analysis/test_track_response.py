"""Receptances and decay rates against an independent package and the sum that defines them."""

import numpy as np
import pytest

import trackig_core as tig
from tests.core.conftest import DATA
from trackig_core.analysis import (
    Lattice,
    point_receptance,
    receptance,
    summed_decay_rate,
    track_response,
)
from trackig_core.analysis.track_response import BANDS, FINE
from trackig_core.frequency_domain.operating_shapes import rail_receptance
from trackig_core.frequency_domain.point_force import rail_waves

BLOCK, SLAB = tig.PRESETS["booted-block-low-mass"], tig.PRESETS["slab-track"]
PEER = np.genfromtxt(
    DATA / "peer_track_response.csv", delimiter=",", names=True, dtype=None, encoding="ascii"
)
"""Rolland 26.8; how it was run stands in make_peer_track_response.py beside the file."""


def peer(preset, rail="euler"):
    return PEER[(PEER["case"] == preset) & (PEER["rail"] == rail)]


def decibels(ratio):
    return np.abs(20 * np.log10(np.abs(ratio)))


def test_an_independent_package_has_the_same_receptances(preset):
    """Over a support within 0.009 dB from 25 to 500 Hz, half-way between two within 0.02 dB."""
    rows = peer(preset)[:14]
    for place, bound in (("support", 0.009), ("midspan", 0.02)):
        expected = rows[f"{place}_re"] + 1j * rows[f"{place}_im"]
        found = point_receptance(tig.PRESETS[preset], rows["frequency_hz"], place)
        assert decibels(found / expected).max() < bound
        assert np.abs(np.angle(found / expected)).max() < 0.005


def test_an_independent_package_has_the_same_decay_sum(preset):
    """The sum of EN 15461 over the same supports, within 0.008 dB/m from 25 to 500 Hz."""
    rows = peer(preset)[:14]
    found = summed_decay_rate(tig.PRESETS[preset], rows["frequency_hz"], points_per_bay=1)
    assert np.abs(found - rows["decay_db_per_m"]).max() < 0.0085


def test_the_sum_is_not_the_rate_of_the_longest_wave():
    slab = track_response(SLAB)
    assert (slab.longest_wave - slab.support_decay_rate).max() > 8
    ratios = [
        response.longest_wave / response.support_decay_rate
        for name, design in tig.PRESETS.items()
        if name != "slab-track"
        for response in [track_response(design)]
    ]
    assert np.min(ratios) < 0.55
    assert np.max(ratios) > 1.34


@pytest.mark.parametrize("place", ["support", "midspan"])
@pytest.mark.parametrize("points_per_bay", [1, 4])
def test_the_closed_sum_is_the_sum_along_the_rail(place, points_per_bay):
    frequency = np.array([30.0, 120.0, 400.0])
    loaded = 0 if place == "support" else 12
    step = 24 // points_per_bay
    elements = loaded + step * np.arange(4000)
    squares = np.abs(rail_waves(BLOCK, frequency, FINE).receptance(elements, loaded)) ** 2
    along = (squares.sum(axis=0) - 0.5 * squares[0]) / squares[0] * BLOCK.fastener_spacing / points_per_bay
    expected = 10 / np.log(10) / along
    np.testing.assert_allclose(
        summed_decay_rate(BLOCK, frequency, place, points_per_bay), expected, rtol=1e-6
    )


def test_reciprocity_and_the_known_case_over_a_support():
    frequency = np.array([20.0, 150.0, 700.0])
    rail = rail_waves(BLOCK, frequency, FINE)
    np.testing.assert_allclose(
        rail.receptance(np.array([31]), 12), rail.receptance(np.array([12]), 31), rtol=1e-9
    )
    elements = np.arange(-60, 90)
    np.testing.assert_allclose(
        rail.receptance(elements, 0).T, rail_receptance(BLOCK, frequency, elements, FINE).T, rtol=1e-9
    )
    np.testing.assert_allclose(point_receptance(BLOCK, frequency), receptance(BLOCK, frequency, lattice=FINE))


def test_the_equation_of_motion_holds_around_a_force_between_supports():
    frequency = np.array([60.0, 300.0])
    loaded, elements = 7, np.arange(-6, 34)
    line = rail_waves(BLOCK, frequency, FINE).receptance(elements, loaded)
    dx = BLOCK.fastener_spacing / 24
    weights = BLOCK.rail.bending_stiffness / dx**3 * np.array([1, -4, 6, -4, 1])
    forces = sum(weight * line[at : at + elements.size - 4] for at, weight in enumerate(weights))
    squared = (2 * np.pi * frequency) ** 2
    forces -= BLOCK.rail.mass_per_metre * dx * squared * line[2:-2]
    inner = elements[2:-2]
    supports = tig.analysis.track_model(BLOCK).supports(frequency).stiffness
    forces[inner % 24 == 0] += supports * line[2:-2][inner % 24 == 0]
    np.testing.assert_allclose(forces, np.outer(inner == loaded, np.ones(2)), atol=1e-6)


def test_mobility_is_the_velocity_per_force():
    response = track_response(BLOCK, [50.0, 200.0])
    np.testing.assert_allclose(response.support_mobility, 2j * np.pi * np.array([50, 200]) * response.support)
    assert np.all(response.support_mobility.real > 0)  # a passive track takes energy in
    assert np.all(response.midspan_mobility.real > 0)


def test_bands_reach_from_25_hz_to_1_khz():
    response = track_response(SLAB)
    assert response.bands is BANDS
    assert (BANDS.labels[0], BANDS.labels[7], BANDS.labels[-1]) == ("25", "125", "1000")
    assert response.longest_wave.shape == response.support_decay_rate.shape == (17,)
    np.testing.assert_allclose(
        response.support_decay_rate, summed_decay_rate(SLAB, BANDS.centres), rtol=0.012
    )


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"place": "sleeper"}, "place = 'sleeper': give 'support' or 'midspan'"),
        ({"place": "midspan", "lattice": Lattice()}, "elements_per_bay = 3.*even number"),
        ({"lattice": Lattice(elements_per_bay=24, bays=60)}, "bays = 60: give a lattice with bays=None"),
        ({"points_per_bay": 5}, "points_per_bay = 5: give a divisor of 24"),
        ({"points_per_bay": 0}, "points_per_bay = 0"),
    ],
)
def test_wrong_places_are_refused(arguments, words):
    with pytest.raises(ValueError, match=words):
        summed_decay_rate(BLOCK, [50.0], **arguments)
