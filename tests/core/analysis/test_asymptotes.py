"""Straight lines against the exact chain they are drawn for, and against what the beam does instead."""

import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import trackig_core as tig
from tests.core.time_domain.test_grid import designs
from trackig_core.analysis.asymptotes import PER_RESONANCE, gain_asymptotes, measured_slopes
from trackig_core.analysis.lumped import lumped_frequencies, lumped_insertion_gain, lumped_spectrum
from trackig_core.bands import BAND_EDGES

BLOCK, SLAB = tig.PRESETS["booted-block-low-mass"], tig.PRESETS["slab-track"]


def lightly_damped(design, loss=0.001):
    return design.replace(pad_loss_factor=loss, **({"boot_loss_factor": loss} if design.two_stage else {}))


def narrow_band_gain(design, frequency):
    """Return the chain's coherent level against the rigid track (frequencies,) [dB]."""
    spectrum = lumped_spectrum(design, frequency, step=1.0)
    return 10 * np.log10(spectrum.coherent_energy / (2 * np.pi * design.wheel_mass * frequency) ** 2)


def drawn(lines, frequency):
    return next(
        line.level[0] + line.slope * np.log2(frequency / line.frequency[0])
        for line in lines
        if line.frequency[0] <= frequency <= line.frequency[1]
    )


@given(designs, st.sampled_from(["line", "rigid"]), st.sampled_from(["energy", "coherent"]))
def test_lines_join_at_the_natural_frequencies_and_span_the_bands(design, reference, summation):
    lines = gain_asymptotes(design, reference, summation)
    corners = lumped_frequencies(design).coupled
    inside = [corner for corner in corners if BAND_EDGES[0] < corner < BAND_EDGES[-1]]
    assert [line.frequency[0] for line in lines[1:]] == pytest.approx(inside)
    assert (lines[0].frequency[0], lines[-1].frequency[1]) == pytest.approx((BAND_EDGES[0], BAND_EDGES[-1]))
    for left, right in itertools.pairwise(lines):
        assert left.frequency[1] == right.frequency[0]
        assert left.level[1] == pytest.approx(right.level[0])
        assert right.slope == pytest.approx(left.slope + PER_RESONANCE)
    for line in lines:
        octaves = np.log2(line.frequency[1] / line.frequency[0])
        assert line.level[1] - line.level[0] == pytest.approx(line.slope * octaves, abs=1e-9)


@pytest.mark.parametrize("design", [BLOCK, SLAB], ids=["two-stage", "single-stage"])
def test_with_little_loss_and_far_from_resonance_the_chain_lies_on_its_lines(design):
    # soft and heavy: resonances below the bands' middle, far apart
    design = lightly_damped(design).replace(pad_stiffness=2e7, contact_stiffness=1e12)
    if design.two_stage:
        design = design.replace(boot_stiffness=2e6, block_mass=20.0)
    corners = np.array(lumped_frequencies(design).coupled)
    for frequency in np.geomspace(BAND_EDGES[0], BAND_EDGES[-1], 60):
        away = frequency / corners
        # what one pole's curve leaves its lines by: 20 log10 |1 - x^2| below, |1 - 1/x^2| above
        left = -20 * np.log10(np.abs(1 - np.minimum(away, 1 / away) ** 2)).sum()
        if left < 12:
            line = drawn(gain_asymptotes(design, "rigid", "coherent"), frequency)
            assert narrow_band_gain(design, np.array([frequency]))[0] == pytest.approx(line + left, abs=0.1)


@given(boot=st.floats(3e6, 4e7), pad=st.floats(5e7, 5e8), wheel=st.floats(600, 1500))
def test_between_two_resonances_the_chain_is_as_steep_as_its_asymptote(boot, pad, wheel):
    design = lightly_damped(BLOCK.replace(boot_stiffness=boot, pad_stiffness=pad, wheel_mass=wheel), 1e-6)
    first, second = lumped_frequencies(design).coupled
    between = measured_slopes(design, "coherent")[1]
    assert between.frequency == pytest.approx(np.sqrt(first * second))
    assert between.lumped == pytest.approx(-12.04, rel=0.01)


@pytest.mark.parametrize(("reference", "summation"), [("line", "energy"), ("rigid", "coherent")])
def test_far_below_resonance_the_banded_chain_lies_on_its_line(preset, reference, summation):
    design = lightly_damped(tig.PRESETS[preset])
    banded = lumped_insertion_gain(design, reference, summation).levels[0]
    level = gain_asymptotes(design, reference, summation)[0].level[0]
    resonance = lumped_frequencies(design).coupled[0]
    rise = -20 * np.log10(1 - (tig.BAND_CENTRES[0] / resonance) ** 2)
    assert banded == pytest.approx(level + rise, abs=0.03)


def test_an_energy_sum_against_the_rigid_track_is_lower_by_the_loads_share():
    design = lightly_damped(SLAB)
    lowered = gain_asymptotes(design, "rigid", "energy")[0].level[0]
    assert lumped_insertion_gain(design, "rigid", "energy").levels[0] == pytest.approx(lowered, abs=0.02)
    assert lowered < -1


def test_a_causal_damper_flattens_the_slope():
    light, heavy = (
        measured_slopes(BLOCK.replace(pad_loss_factor=loss, boot_loss_factor=loss))[1].lumped
        for loss in (0.02, 0.4)
    )
    assert light < heavy - 0.5


def test_waves_flatten_what_the_beam_passes_in_energy():
    between = measured_slopes(BLOCK)[1]
    assert between.beam > between.lumped + 3


def test_without_loss_or_with_an_unknown_choice_there_are_no_slopes():
    with pytest.raises(tig.DesignError):
        measured_slopes(BLOCK.replace(boot_loss_factor=0.0))
    with pytest.raises(ValueError, match="summation"):
        gain_asymptotes(BLOCK, summation="loudness")
    with pytest.raises(ValueError, match="reference"):
        gain_asymptotes(BLOCK, reference="curve")
