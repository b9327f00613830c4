"""Steady shapes against the dense ring, the receptance at supports, and what a track must do."""

import numpy as np
import pytest

import trackig_core as tig
from tests.core.frequency_domain.test_floquet_waves import BLOCK, FREQUENCIES, SLAB, dense_response
from trackig_core.frequency_domain.floquet_waves import contact_force, exact_spectrum, receptance
from trackig_core.frequency_domain.lattice import Lattice
from trackig_core.frequency_domain.natural_frequencies import natural_frequencies
from trackig_core.frequency_domain.operating_shapes import rail_receptance, steady_shape
from trackig_core.track.vehicle import dynamic_stiffness_above

WIDE = BLOCK.replace(fastener_spacing=1.0)  # elements so long that the rail's own lattice waves matter


@pytest.mark.parametrize("design", [BLOCK, SLAB, WIDE], ids=["two-stage", "single-stage", "wide"])
@pytest.mark.parametrize(
    "lattice",
    [Lattice(3, bays=21), Lattice(2, bays=8), Lattice(7, bays=15), Lattice(3, 21, 1 / 16384, memory_order=2)],
    ids=["ring", "even ring", "fine ring", "time steps"],
)
def test_every_element_is_that_of_the_dense_solution(design, lattice):
    bays, per_bay = (lattice.bays - 1) // 2, lattice.elements_per_bay
    for frequency in FREQUENCIES:
        rail, block, wheel = dense_response(design, frequency, lattice)
        shape = steady_shape(design, frequency, bays, lattice)
        elements = np.arange(-bays * per_bay, bays * per_bay + 1)
        assert np.abs(shape.rail[:, 0] - rail[elements]).max() <= 1e-6 * np.abs(rail).max()
        assert shape.wheel[0] == pytest.approx(wheel, rel=1e-6)
        if design.two_stage:
            supports = np.arange(-bays, bays + 1)
            assert np.abs(shape.block[:, 0] - block[supports]).max() <= 1e-6 * np.abs(block).max()
        else:
            assert shape.block is None


def test_over_supports_the_shape_is_the_receptance(preset):
    design, frequency = tig.PRESETS[preset], np.geomspace(1, 500, 60)
    shape = steady_shape(design, frequency, bays=4)
    expected = contact_force(design, frequency) * receptance(design, frequency, np.arange(-4, 5))
    assert np.abs(shape.rail[::3] - expected).max() <= 1e-9 * np.abs(expected).max()
    assert shape.position[::3] == pytest.approx(shape.support_position)
    assert shape.position == pytest.approx(np.arange(-12, 13) * design.fastener_spacing / 3)


def test_arrays_have_the_shapes_that_are_documented():
    shape = steady_shape(BLOCK, [20.0, 40.0], bays=5)
    assert shape.rail.shape == (31, 2)
    assert shape.block.shape == (11, 2)
    assert shape.wheel.shape == (2,)
    assert shape.position.shape == (31,)
    assert rail_receptance(BLOCK, [20.0, 40.0], 1).shape == (2,)


def test_contact_spring_takes_up_what_wheel_and_rail_leave_of_the_roughness():
    frequency = np.array([10.0, 39.0, 300.0])
    shape = steady_shape(BLOCK, frequency, bays=1)
    squeezed = 1 + shape.wheel - shape.rail[3]
    assert BLOCK.contact_stiffness * squeezed == pytest.approx(contact_force(BLOCK, frequency), rel=1e-9)


@pytest.mark.parametrize("name", ["booted-sleeper", "booted-block-low-mass", "booted-block-high-mass"])
def test_below_resonance_all_move_together(name):
    design = tig.PRESETS[name]
    shape = steady_shape(design, natural_frequencies(design).loaded_track / 3, bays=1)
    phases = np.angle(np.array([shape.wheel[0], shape.rail[3, 0], shape.block[1, 0]]), deg=True)
    assert np.ptp(phases % 360) < 10


@pytest.mark.parametrize("name", ["booted-sleeper", "booted-block-low-mass", "booted-block-high-mass"])
def test_above_the_block_frequency_rail_and_block_move_against_each_other(name):
    design = tig.PRESETS[name]
    at = natural_frequencies(design).coupled_block
    shape = steady_shape(design, [at / 3, at, 2 * at], bays=1)
    lag = -np.angle(shape.block[1] / shape.rail[3], deg=True)
    assert lag[0] < 10
    assert lag[1] == pytest.approx(90, abs=15)  # 90 degrees less the pad's own loss angle
    assert lag[2] > 150


def test_at_the_loaded_track_resonance_the_wheel_dominates(preset):
    design = tig.PRESETS[preset]
    near = natural_frequencies(design).loaded_track * np.linspace(0.6, 1.6, 101)
    shape = steady_shape(design, near, bays=3)
    assert (np.abs(shape.wheel) > np.abs(shape.rail).max(axis=0))[np.argmax(np.abs(shape.wheel))]
    assert near[np.argmax(np.abs(shape.wheel))] == pytest.approx(near[40], rel=0.1)
    assert np.abs(shape.wheel).max() > 2


@pytest.mark.parametrize("bays", [0, -3])
def test_no_bays_no_shape(bays):
    with pytest.raises(ValueError, match="bays"):
        steady_shape(BLOCK, 40.0, bays=bays)


def test_wheels_between_supports_move_with_rail_and_contact_springs():
    """The contact springs take up what wheels and rail leave of the roughness, each with its delay."""
    design = BLOCK.replace(
        axle_positions=(-0.2, 2.2), speed=20.0, suspension=tig.VEHICLES["metro"].suspension
    )
    frequency = np.array([10.0, 39.0, 300.0])
    shape = steady_shape(design, frequency, bays=2)
    assert shape.wheel_position == pytest.approx([-0.2, 2.2])
    assert shape.support_position == pytest.approx(0.6 * np.arange(-3, 7))
    under = [int(np.argmin(np.abs(shape.position - place))) for place in shape.wheel_position]
    roughness = np.exp(-2j * np.pi * frequency * np.array([[0.0], [2.4 / 20.0]]))
    squeezed = roughness + shape.wheels - shape.rail[under]
    angular = 2 * np.pi * frequency
    above = dynamic_stiffness_above(design, angular**2, 1j * angular)
    assert design.contact_stiffness * squeezed == pytest.approx(-above * shape.wheels, rel=1e-6)
    assert shape.foot is None


def test_feet_pass_the_force_that_the_spectrum_counts():
    design = BLOCK.replace(ground=tig.Ground(300e6, 200e3, 150.0))
    frequency = np.array([20.0, 80.0, 240.0])
    shape = steady_shape(design, frequency, bays=60)
    into = (300e6 + 2j * np.pi * frequency * 200e3) * shape.foot
    energy = np.sum(np.abs(into) ** 2, axis=0) / (2 * np.pi * frequency) ** 2
    assert energy == pytest.approx(exact_spectrum(design, frequency, 1.0).energy, rel=1e-3)
