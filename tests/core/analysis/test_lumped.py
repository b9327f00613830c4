"""The chain of wheel and block: against its own matrices, the beam's statics, and a theorem."""

import numpy as np
import pytest
from hypothesis import given

import trackig_core as tig
from tests.core.time_domain.test_grid import designs
from trackig_core.analysis.lumped import (
    compare_with_beam,
    effective_supports,
    lumped_frequencies,
    lumped_insertion_gain,
    lumped_spectrum,
)
from trackig_core.bands import BAND_CENTRES
from trackig_core.frequency_domain.floquet_waves import waves
from trackig_core.track.viscoelastic_law import laws

BLOCK, SLAB = tig.PRESETS["booted-block-low-mass"], tig.PRESETS["slab-track"]


def chain(design, pad, boot):
    """Return stiffness and mass matrix of wheel, rail (no mass) and blocks; ground last when single-stage."""
    n, k = effective_supports(design), design.contact_stiffness
    stiffness = np.zeros((3, 3), dtype=complex)
    stiffness[:2, :2] += k * np.array([[1, -1], [-1, 1]])
    stiffness[1:, 1:] += n * pad * np.array([[1, -1], [-1, 1]])
    stiffness[2, 2] += 1e30 if boot is None else n * boot
    return stiffness, np.array([design.wheel_mass, 0.0, n * (design.block_mass or 0.0)])


def test_the_chain_is_as_stiff_and_shares_its_load_as_the_beam_at_rest(preset):
    design = tig.PRESETS[preset].replace(pad_loss_factor=1e-6)
    if design.two_stage:
        design = design.replace(boot_loss_factor=1e-6)
    still = waves(design, [0.05])
    alike = still.coherent_sum()[0].real / still.receptance()[0].real
    assert effective_supports(design) == pytest.approx(alike, rel=0.015)
    share = still.energy_sum()[0] / abs(still.coherent_sum()[0]) ** 2
    spectrum = lumped_spectrum(design, [0.05])
    assert spectrum.energy[0] / spectrum.coherent_energy[0] == pytest.approx(share, rel=0.015)


def test_a_load_stands_on_one_support_at_least():
    apart = SLAB.replace(fastener_spacing=2.0, pad_stiffness=1e11)
    assert effective_supports(apart) == 1.0
    spectrum = lumped_spectrum(apart, [10.0])
    assert spectrum.energy == pytest.approx(spectrum.coherent_energy)


@pytest.mark.parametrize("design", [BLOCK, SLAB], ids=["two-stage", "single-stage"])
def test_the_spectrum_is_that_of_the_chains_matrices(design):
    for frequency in (5.0, 39.0, 134.0, 500.0):
        pad, boot = (law.dynamic_stiffness(frequency) if law else None for law in laws(design))
        stiffness, mass = chain(design, pad, boot)
        load = design.contact_stiffness * np.array([-1.0, 1.0, 0.0])
        moved = np.linalg.solve(stiffness - (2 * np.pi * frequency) ** 2 * np.diag(mass), load)
        n = effective_supports(design)
        ground = n * pad * (moved[1] - moved[2]) if boot is None else n * boot * moved[2]
        spectrum = lumped_spectrum(design, [frequency], step=1.0)
        expected = abs(ground / (2 * np.pi * frequency)) ** 2
        assert spectrum.coherent_energy[0] == pytest.approx(expected, rel=1e-9)


def test_without_loss_the_coupled_pair_is_that_of_an_eigenvalue_problem():
    design = BLOCK.replace(pad_loss_factor=0.0, boot_loss_factor=0.0)
    stiffness, mass = chain(design, design.pad_stiffness, design.boot_stiffness)
    flexibility = np.linalg.inv(stiffness.real)[::2, ::2]  # the rail has no mass: it follows
    root = np.sqrt(mass[::2])
    expected = 1 / np.sqrt(np.linalg.eigvalsh(flexibility * np.outer(root, root))) / (2 * np.pi)
    assert lumped_frequencies(design).coupled == pytest.approx(np.sort(expected))


@given(designs)
def test_the_coupled_pair_straddles_the_uncoupled(design):
    found = lumped_frequencies(design)
    assert found.coupled[0] <= min(found.uncoupled) * (1 + 1e-9)
    assert found.coupled[1] >= max(found.uncoupled) * (1 - 1e-9)


def test_every_stiffness_is_taken_at_the_frequency_found():
    pad, boot = laws(BLOCK)
    coupled = lumped_frequencies(BLOCK).coupled
    assert len(coupled) == 2
    for frequency in coupled:
        stiffness, mass = chain(BLOCK, pad.stiffness(frequency), boot.stiffness(frequency))
        dynamic = stiffness.real - (2 * np.pi * frequency) ** 2 * np.diag(mass)
        size = np.abs(stiffness.real).max()
        assert np.linalg.det(dynamic / size) == pytest.approx(0, abs=1e-9)


def test_single_stage_has_one_frequency():
    found = lumped_frequencies(SLAB)
    assert found.coupled == found.uncoupled
    assert len(found.coupled) == 1


def test_the_chain_is_good_enough_below_the_resonance_of_every_preset(preset):
    design = tig.PRESETS[preset]
    resonance = lumped_frequencies(design).coupled[0]
    below = resonance / BAND_CENTRES > 1.4
    for reference, summation in (("line", "energy"), ("rigid", "coherent")):
        compared = compare_with_beam(design, reference, summation)
        assert np.abs(compared.difference[below]).max() < 1.5
        assert compared.good_enough[below].all()


def test_running_waves_make_the_beam_louder_than_the_chain():
    """From where waves begin to run along the track to the block's frequency, many supports are at work."""
    design = tig.PRESETS["booted-block-high-mass"]
    found = tig.solve(design, "exact").natural_frequencies
    low, high = 1.2 * found.cut_on[0], 0.7 * found.coupled_block
    waves_run = (low < BAND_CENTRES) & (high > BAND_CENTRES)
    compared = compare_with_beam(design)
    assert (compared.lumped[waves_run] < compared.beam[waves_run]).all()
    assert not compared.good_enough[waves_run].any()


def test_the_chains_gain_is_integrated_over_its_peak():
    fine = np.geomspace(1.0, 570.0, 200_001)
    sharp = BLOCK.replace(pad_loss_factor=0.02, boot_loss_factor=0.02)
    spectrum = lumped_spectrum(sharp, fine)
    loaded = lumped_frequencies(sharp).coupled[0]
    expected = tig.insertion_gain(spectrum, sharp, loaded).levels
    assert lumped_insertion_gain(sharp).levels == pytest.approx(expected, abs=0.01)


def test_without_loss_there_is_no_gain():
    with pytest.raises(tig.DesignError, match="boot_loss_factor"):
        lumped_insertion_gain(BLOCK.replace(boot_loss_factor=0.0))
