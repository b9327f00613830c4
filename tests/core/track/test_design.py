"""A design that exists is valid; one that is not says what to do."""

import numpy as np
import pytest

import trackig_core as tig
from trackig_core.track.design import RANGES

BLOCK = tig.PRESETS["booted-block-low-mass"]


@pytest.mark.parametrize("field", [name for name in RANGES if hasattr(BLOCK, name)])
@pytest.mark.parametrize(
    "value",
    [-1.0, float("nan"), float("inf"), -float("inf"), "28e6", 1e99, 10**400, True, 1 + 2j, [28e6], b"x"],
    ids=repr,
)
def test_impossible_values_are_named_with_their_range(field, value):
    with pytest.raises(tig.DesignError) as caught:
        BLOCK.replace(**{field: value})
    low, high, unit = RANGES[field]
    assert caught.value.field == field
    assert caught.value.value is value
    assert str(caught.value).startswith(f"{field} = ")
    assert f"from {low:g} to {high:g} {unit}".strip() in str(caught.value)
    assert len(str(caught.value)) < 200


@pytest.mark.parametrize("field", [name for name in RANGES if hasattr(BLOCK, name) and "loss" not in name])
def test_zero_is_only_a_loss_factor(field):
    with pytest.raises(tig.DesignError, match=field):
        BLOCK.replace(**{field: 0.0})
    assert BLOCK.replace(pad_loss_factor=0).pad_loss_factor == 0.0


@pytest.mark.parametrize("missing", ["block_mass", "boot_stiffness", "boot_loss_factor"])
def test_a_block_needs_a_boot(missing):
    with pytest.raises(tig.DesignError, match="come together") as caught:
        BLOCK.replace(**{missing: None})
    assert caught.value.field == missing


@pytest.mark.parametrize("field", ["pad_stiffness", "pad_loss_factor", "fastener_spacing", "wheel_mass"])
def test_none_is_only_for_the_second_stage(field):
    with pytest.raises(tig.DesignError, match=field):
        BLOCK.replace(**{field: None})


def test_a_misspelt_field_is_answered_with_the_nearest():
    with pytest.raises(tig.DesignError, match="'boot_stiffness'"):
        BLOCK.replace(boot_stifness=20e6)


@pytest.mark.parametrize("rail", ["UIC 60", None, 60.0])
def test_a_rail_is_a_rail(rail):
    with pytest.raises(tig.DesignError, match="rail"):
        BLOCK.replace(rail=rail)


@pytest.mark.parametrize(
    ("arguments", "field"),
    [
        (("", 60.0, 6e6), "name"),
        (("x" * 41, 60.0, 6e6), "name"),
        ((60, 60.0, 6e6), "name"),
        (("60\n", 60.0, 6e6), "name"),
        ((" ", 60.0, 6e6), "name"),
        (("60 ", 60.0, 6e6), "name"),
        (("60", 0.0, 6e6), "mass_per_metre"),
        (("60", 60.0, 6.4), "bending_stiffness"),
    ],
)
def test_impossible_rails(arguments, field):
    with pytest.raises(tig.DesignError) as caught:
        tig.Rail(*arguments)
    assert caught.value.field == field


def test_designs_are_frozen_keys():
    same = BLOCK.replace(pad_stiffness=np.float64(100e6), wheel_mass=880)
    assert same == BLOCK
    assert hash(same) == hash(BLOCK)
    assert isinstance(same.pad_stiffness, float)
    assert BLOCK.replace(boot_stiffness=20e6) != BLOCK
    with pytest.raises(AttributeError):
        BLOCK.pad_stiffness = 1e6


def test_a_design_without_statics_differs_in_nothing_else():
    plain = tig.PRESETS["booted-block-low-mass"]
    stated = plain.replace(pad_static_stiffness=80e6, boot_static_stiffness=12e6, speed=30.0)
    assert stated.without_statics == plain.replace(speed=30.0)
    assert plain.without_statics is plain
    curve = tig.StiffnessCurve([(5, 22e6, 0.18), (500, 38e6, 0.2)])
    measured = plain.replace(boot_stiffness=curve, boot_loss_factor=None)
    assert measured.without_statics is measured
    preloaded = measured.replace(boot_stiffness=tig.StiffnessCurve(curve.points, preload=30e3))
    assert preloaded != measured
    assert preloaded.without_statics == measured
