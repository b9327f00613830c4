"""Suspension, axles and ground of a design: off by default, checked, and of known numbers."""

import math
from dataclasses import astuple

import numpy as np
import pytest

import trackig_core as tig
from trackig_core.track.vehicle import dynamic_stiffness_above, rigid_energy

BLOCK = tig.PRESETS["booted-block-low-mass"]
BOGIE = tig.Suspension(1.2e6, 15e3, 800.0, 250e3, 15e3, 4000.0)


@pytest.mark.parametrize("preset", tig.PRESETS.values(), ids=tig.PRESETS)
def test_everything_is_off_by_default(preset):
    assert preset.suspension is preset.ground is preset.speed is None
    assert preset.axle_positions == (0.0,)
    assert preset.simplified is preset


def test_the_simplified_model_leaves_the_supports_alone():
    design = BLOCK.replace(
        boot_stiffness=20e6, suspension=BOGIE, axle_positions=[0, 2.4], speed=30, ground=tig.GROUNDS["rock"]
    )
    assert design.axle_positions == (0.0, 2.4)
    assert design.speed == 30.0
    assert design.simplified == BLOCK.replace(boot_stiffness=20e6)
    assert hash(design) == hash(design.replace())


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"suspension": 1e6}, "suspension = 1000000.0: give None or a Suspension"),
        ({"ground": "rock"}, "ground = 'rock': give None or a Ground"),
        ({"axle_positions": 2.4}, "axle_positions = 2.4: give 1 to 8 positions in m"),
        ({"axle_positions": ()}, "give 1 to 8 positions"),
        ({"axle_positions": range(9)}, "give 1 to 8 positions"),
        ({"axle_positions": (0, 31)}, "positions, each a number from -30 to 30 m"),
        ({"axle_positions": (0, "2.4")}, "positions, each a number"),
        ({"axle_positions": (0, 0.05)}, "no two fall on the same rail element, 0.2 m"),
        ({"speed": 0.5}, "speed = 0.5: give a number from 1 to 150 m/s"),
        ({"axle_positions": (0, 20), "speed": 4}, "speed = 4.0: give 5 m/s or more, or None"),
    ],
)
def test_impossible_surroundings_say_what_to_do(change, words):
    with pytest.raises(tig.DesignError) as caught:
        BLOCK.replace(**change)
    assert words in str(caught.value)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ((1e6, 1e3, 0.0), "bogie_mass = 0.0: give a number from 1"),
        ((-1.0, 1e3, 100.0), "primary_stiffness = -1.0"),
        ((1e6, 1e3, 100.0, 1e5), "secondary_damping = None: give a value too, or leave out all three"),
        ((1e6, 1e3, 100.0, None, None, 4000.0), "secondary_stiffness = None"),
        ((1e6, math.nan, 100.0), "primary_damping = nan"),
    ],
)
def test_impossible_suspensions(arguments, words):
    with pytest.raises(tig.DesignError) as caught:
        tig.Suspension(*arguments)
    assert words in str(caught.value)


@pytest.mark.parametrize("arguments", [(0.0, 1e5, 0.0), (3e8, -1.0, 0.0), (3e8, 1e5, -1.0)])
def test_impossible_grounds(arguments):
    with pytest.raises(tig.DesignError, match=r"ground\."):
        tig.Ground(*arguments)


def test_half_space_is_lysmers_analogue():
    """4 G r / (1 - nu) and 3.4 r^2 sqrt(rho G) / (1 - nu), by hand for round numbers."""
    ground = tig.Ground.half_space(0.5, 100e6, 0.5, 2500.0)
    assert ground.stiffness == pytest.approx(400e6)
    assert ground.damping == pytest.approx(3.4 * 0.25 * 500e3 / 0.5)
    assert ground.mass == 0.0
    with pytest.raises(tig.DesignError, match="poissons_ratio"):
        tig.Ground.half_space(0.5, 100e6, 0.6, 2500.0)


def test_the_catalogue_gets_softer_and_names_its_sources():
    stiffness = [ground.stiffness for ground in tig.GROUNDS.values()]
    assert list(tig.GROUNDS) == ["rock", "stiff clay", "soft clay"]
    assert stiffness == sorted(stiffness, reverse=True)
    assert list(tig.VEHICLES) == ["metro", "regional", "high speed", "freight"]
    for name, vehicle in tig.VEHICLES.items():
        assert vehicle.name == name
        assert vehicle.source.startswith("generic")
        # round: twice each has two digits
        numbers = (vehicle.wheel_mass, vehicle.wheelbase, *astuple(vehicle.suspension))
        assert all(float(f"{2 * each:.2g}") == 2 * each for each in numbers if each is not None)
        design = BLOCK.replace(
            wheel_mass=vehicle.wheel_mass,
            suspension=vehicle.suspension,
            axle_positions=(0.0, vehicle.wheelbase),
        )
        assert design.suspension is vehicle.suspension
        # what a wheel carries in all: an axle load between 8 and 25 t
        _, _, body = vehicle.suspension.secondary
        assert 4000 < vehicle.wheel_mass + vehicle.suspension.bogie_mass + body < 12_500


def test_looking_up_from_the_contact_a_vehicle_is_its_mass_when_slow_and_its_wheel_when_fast():
    design = BLOCK.replace(suspension=BOGIE)
    slow, fast = (2 * np.pi * np.array([each]) for each in (0.01, 1e4))
    whole = design.wheel_mass + BOGIE.bogie_mass + BOGIE.body_mass
    assert dynamic_stiffness_above(design, slow**2, 1j * slow)[0] == pytest.approx(
        -whole * slow[0] ** 2, rel=1e-4
    )
    assert dynamic_stiffness_above(design, fast**2, 1j * fast)[0] == pytest.approx(
        -design.wheel_mass * fast[0] ** 2, rel=1e-3
    )


def test_a_suspension_only_takes_energy():
    angular = 2 * np.pi * np.geomspace(0.1, 500, 300)
    above = dynamic_stiffness_above(BLOCK.replace(suspension=BOGIE), angular**2, 1j * angular)
    assert (above.imag > 0).all()


def test_energy_of_a_rigid_track_counts_every_wheel():
    frequency = np.array([5.0, 50.0])
    one = (2 * np.pi * frequency * BLOCK.wheel_mass) ** 2
    assert rigid_energy(BLOCK, frequency) == pytest.approx(one)
    assert rigid_energy(BLOCK.replace(axle_positions=(0, 2.4, 4.8)), frequency) == pytest.approx(3 * one)
