"""Hysteretic damping in the exact solver against a dense solution, and its refusal in time."""

import numpy as np
import pytest

import trackig_core as tig
from trackig_core.analysis import (
    Lattice,
    receptance,
    single_degree_gain,
    single_degree_insertion_loss,
    track_model,
)
from trackig_core.time_domain.grid import make_grid
from trackig_core.time_domain.time_stepping import simulate

BLOCK, SLAB = tig.PRESETS["booted-block-low-mass"], tig.PRESETS["slab-track"]


def dense_receptance(design, frequency, bays=60):
    """Return the receptance over a support of a ring of hysteretic supports, by a dense solve [m/N]."""
    squared = (2 * np.pi * frequency) ** 2
    pad = design.pad_stiffness * (1 + 1j * design.pad_loss_factor)
    support = pad
    if design.two_stage:
        boot = design.boot_stiffness * (1 + 1j * design.boot_loss_factor)
        support = pad - pad**2 / (pad + boot - design.block_mass * squared)
    dx = design.fastener_spacing / 3
    count = 3 * bays
    first = np.roll(np.eye(count), 1, axis=0) + np.roll(np.eye(count), -1, axis=0) - 2 * np.eye(count)
    matrix = design.rail.bending_stiffness / dx**3 * (first @ first) + 0j
    matrix -= design.rail.mass_per_metre * dx * squared * np.eye(count)
    matrix[range(0, count, 3), range(0, count, 3)] += support
    return np.linalg.solve(matrix, np.eye(count)[0])[0]


@pytest.mark.parametrize("design", [BLOCK, SLAB], ids=["two-stage", "single-stage"])
def test_a_dense_solution_agrees(design):
    model = track_model(design, "hysteretic")
    frequency = [20.0, 60.0, 200.0, 450.0]
    found = receptance(model, frequency, lattice=Lattice(bays=60))
    expected = [dense_receptance(design, each) for each in frequency]
    np.testing.assert_allclose(found, expected, rtol=1e-7)


def test_the_exact_solver_takes_it_and_says_so():
    solution = tig.solve(BLOCK, "exact", damping="hysteretic")
    assert any("not causal" in note for note in solution.notes)
    assert solution.natural_frequencies.coupled_block == pytest.approx(
        np.sqrt((100e6 + 28e6) / 45) / (2 * np.pi)
    )
    difference = solution.insertion_gain - tig.solve(BLOCK, "exact").insertion_gain
    # the causal boot is softer at 5 Hz and stiffer at 500 Hz than the one that never changes
    assert difference[-1] < -2
    assert 0.1 < np.abs(difference[5:12]).max() < 5


def test_a_lossless_pad_over_a_hysteretic_boot_is_solved():
    assert np.isfinite(
        tig.solve(BLOCK.replace(pad_loss_factor=0.0), "exact", damping="hysteretic").insertion_gain
    ).all()
    with pytest.raises(tig.DesignError, match="without loss the exact spectrum has no bound"):
        tig.solve(BLOCK.replace(boot_loss_factor=0.0), "exact", damping="hysteretic")


@pytest.mark.parametrize("fidelity", ["paper", "live"])
def test_it_cannot_be_stepped_in_time(fidelity):
    with pytest.raises(ValueError, match=r"not causal and cannot be stepped in time.*give fidelity 'exact'"):
        tig.solve(BLOCK, fidelity, damping="hysteretic")


def test_no_run_takes_it_by_another_way():
    model = track_model(BLOCK, "hysteretic")
    with pytest.raises(ValueError, match="cannot be stepped in time"):
        simulate(model, make_grid(BLOCK, bays=21, record=0.25))
    with pytest.raises(ValueError, match="cannot be stepped in time"):
        receptance(model, [50.0], lattice=Lattice(time_step=1e-5))


def test_a_measured_loss_factor_is_taken_as_it_is():
    curve = tig.LossFactorCurve(((5, 0.1), (500, 0.3)))
    model = track_model(SLAB.replace(pad_loss_factor=curve), "hysteretic")
    np.testing.assert_allclose(
        model.pad.dynamic_stiffness([5.0, 500.0]), 1e9 * (1 + 1j * np.array([0.1, 0.3]))
    )


def test_a_measured_stiffness_says_itself_how_it_changes():
    curve = tig.StiffnessCurve(((5, 20e6, 0.1), (500, 40e6, 0.3)))
    with pytest.raises(tig.DesignError, match=r"boot_stiffness.*one stiffness at all frequencies"):
        tig.solve(BLOCK.replace(boot_stiffness=curve, boot_loss_factor=None), "exact", damping="hysteretic")


def test_there_are_two_dampings():
    with pytest.raises(ValueError, match="damping = 'structural': give 'viscoelastic' or 'hysteretic'"):
        tig.solve(BLOCK, "exact", damping="structural")


def test_one_mass_on_one_spring():
    resonance = np.sqrt(4e7 / 1000) / (2 * np.pi)
    stiffness = 4e7 * (1 + 0.1j)
    at = single_degree_insertion_loss(
        [1e-3, resonance, np.sqrt(2) * resonance, 100 * resonance], 1000.0, stiffness
    )
    # |1 - 1/(1 + i eta)| is eta/sqrt(1 + eta^2) at resonance
    expected = [0.0, 20 * np.log10(0.1 / np.sqrt(1.01)), 20 * np.log10(abs(1 - 2 / (1 + 0.1j))), None]
    np.testing.assert_allclose(at[:3], expected[:3], atol=1e-6)
    assert at[3] == pytest.approx(80 - 10 * np.log10(1.01), abs=1e-2)


def test_on_a_stiff_contact_and_a_light_rail_slab_track_is_one_mass_on_one_spring():
    light = tig.Rail("light", 10.0, SLAB.rail.bending_stiffness)
    design = SLAB.replace(rail=light, contact_stiffness=1e14, pad_stiffness=10e6)
    solution = tig.solve(design, "exact", damping="hysteretic", reference="rigid", summation="coherent")
    model = track_model(design, "hysteretic")
    expected = single_degree_gain(model, tig.BAND_CENTRES)
    ratio = tig.BAND_CENTRES / solution.natural_frequencies.loaded_track
    apart = (ratio < 0.5) | ((ratio > 1.4) & (ratio < 3))  # near the peak a band is no single frequency
    np.testing.assert_allclose(solution.insertion_gain[apart], expected[apart], atol=0.25)
