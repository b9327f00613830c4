"""Natural frequencies against one field, and the reasons why chain and beam depart."""

import re

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import trackig_core as tig
from tests.core.time_domain.test_grid import designs
from trackig_core.analysis.frequency_sweep import FIELDS, NOTABLE, departure, frequency_sweep
from trackig_core.analysis.lumped import effective_supports, lumped_frequencies
from trackig_core.frequency_domain.natural_frequencies import natural_frequencies

BLOCK, SLAB = tig.PRESETS["booted-block-low-mass"], tig.PRESETS["slab-track"]

VALUES = {
    "pad_stiffness": (1e7, 2e9),
    "pad_loss_factor": (0.05, 0.4),
    "block_mass": (10.0, 500.0),
    "boot_stiffness": (2e6, 2e8),
    "boot_loss_factor": (0.05, 0.4),
    "fastener_spacing": (0.2, 1.0),
    "wheel_mass": (200.0, 1500.0),
    "contact_stiffness": (2e8, 5e9),
}


@pytest.mark.parametrize("field", FIELDS)
def test_every_point_is_that_of_its_design(field):
    values = np.linspace(*VALUES[field], 4)
    found = frequency_sweep(BLOCK, field, values)
    assert found.lumped_coupled.shape == found.lumped_uncoupled.shape == (2, 4)
    for index, value in enumerate(values):
        changed = BLOCK.replace(**{field: value})
        beam, chain = natural_frequencies(changed), lumped_frequencies(changed)
        assert found.loaded_track[index] == beam.loaded_track
        assert found.coupled_block[index] == beam.coupled_block
        assert found.cut_on[index] == beam.cut_on[0]
        assert tuple(found.lumped_coupled[:, index]) == chain.coupled
        assert tuple(found.lumped_uncoupled[:, index]) == chain.uncoupled


def test_single_stage_has_one_row_and_no_block():
    found = frequency_sweep(SLAB, "pad_stiffness", [1e8, 1e9])
    assert found.lumped_coupled.shape == (1, 2)
    assert np.isnan(found.coupled_block).all()
    with pytest.raises(tig.DesignError, match="boot"):
        frequency_sweep(SLAB, "boot_stiffness", [1e7])


@given(designs, st.sampled_from(FIELDS))
def test_the_coupled_pair_straddles_the_uncoupled_all_along(design, field):
    values = [value for value in np.linspace(*VALUES[field], 3) if "loss" not in field] or [0.2]
    found = frequency_sweep(design, field, values)
    low, high = found.lumped_coupled
    assert (low <= found.lumped_uncoupled.min(axis=0) * (1 + 1e-9)).all()
    assert (high >= found.lumped_uncoupled.max(axis=0) * (1 - 1e-9)).all()


def test_coupled_curves_veer_where_uncoupled_ones_cross():
    found = frequency_sweep(BLOCK, "boot_stiffness", np.geomspace(2e6, 2e8, 60))
    difference = np.diff(found.lumped_uncoupled, axis=0)[0]
    assert difference[0] < 0 < difference[-1]
    assert (np.diff(found.lumped_coupled, axis=0) > 0.5 * found.lumped_coupled[0]).all()


@pytest.mark.parametrize("field", ["rail", "pads", "", "mass_per_metre"])
def test_only_fields_that_are_numbers_can_be_varied(field):
    with pytest.raises(tig.DesignError, match="one of pad_stiffness"):
        frequency_sweep(BLOCK, field, [1.0])


@given(designs)
def test_a_reason_is_given_for_each_frequency_that_departs_and_no_other(design):
    found = departure(design)
    ratios = [found.loaded_track, found.coupled_block]
    assert len(found.reasons) == sum(abs(ratio - 1) > NOTABLE for ratio in ratios)


@given(designs)
def test_the_blocks_two_reasons_are_all_there_are(design):
    """A held wheel lets the contact spring alone lower the block's frequency; letting it go raises it."""
    beam, chain = natural_frequencies(design).coupled_block, lumped_frequencies(design).coupled[1]
    held = lumped_frequencies(design.replace(wheel_mass=1e4)).coupled[1]
    slack = 1 + effective_supports(design) * design.block_mass / 1e4  # the heaviest wheel recoils a little
    assert held <= beam * slack
    assert chain >= held * (1 - 1e-9)


def test_a_light_wheel_is_told_of_waves():
    light = BLOCK.replace(wheel_mass=20.0)
    reason = departure(light).reasons[0]
    assert "waves begin" in reason
    frequencies = natural_frequencies(light)
    assert f"at {frequencies.cut_on[0]:.0f} Hz" in reason
    assert frequencies.loaded_track <= frequencies.cut_on[0] < lumped_frequencies(light).coupled[0]


def test_a_fairly_light_wheel_is_told_of_the_rails_mass():
    found = departure(BLOCK.replace(wheel_mass=200.0))
    assert "rail has no mass" in found.reasons[0]
    share = float(re.search(r"(\d+)% of its mass", found.reasons[0])[1]) / 100
    # with that mass added to its wheel the chain comes close to the beam
    mended = lumped_frequencies(BLOCK.replace(wheel_mass=200.0 * (1 + share))).coupled[0]
    beam = natural_frequencies(BLOCK.replace(wheel_mass=200.0)).loaded_track
    assert abs(mended / beam - 1) < 0.5 * abs(found.loaded_track - 1)


def test_stiff_pads_are_told_of_the_contact_spring():
    stiff = BLOCK.replace(pad_stiffness=1e9)
    found = departure(stiff)
    assert found.coupled_block < 1
    assert "contact spring" in found.reasons[-1]
    # and with the contact spring stiffened the reason is gone
    assert departure(stiff.replace(contact_stiffness=1e13)).coupled_block > 1


def test_heavy_blocks_are_told_of_the_wheel_that_recoils():
    heavy = BLOCK.replace(block_mass=400.0)
    assert "recoils" in departure(heavy).reasons[-1]
    assert departure(heavy.replace(wheel_mass=1e4)).coupled_block < 1 + NOTABLE
