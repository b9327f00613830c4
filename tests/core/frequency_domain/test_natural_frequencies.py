"""Natural frequencies against the golden ones, textbook limits, and a dense eigenvalue solution."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import trackig_core as tig
from tests.core.time_domain.test_grid import designs
from trackig_core.frequency_domain.floquet_waves import receptance
from trackig_core.frequency_domain.natural_frequencies import natural_frequencies, peak_near
from trackig_core.track.viscoelastic_law import laws

BLOCK, SLAB = tig.PRESETS["booted-block-low-mass"], tig.PRESETS["slab-track"]


def without_loss(design):
    loss = {"pad_loss_factor": 0.0} | ({"boot_loss_factor": 0.0} if design.two_stage else {})
    return design.replace(**loss)


def test_golden_frequencies(golden, preset):
    found = natural_frequencies(tig.PRESETS[preset])
    assert found.loaded_track == pytest.approx(golden["cases"][preset]["loaded_track_hz"], rel=1e-3)
    if tig.PRESETS[preset].two_stage:
        assert found.coupled_block == pytest.approx(golden["cases"][preset]["coupled_block_hz"], rel=1e-3)
    else:
        assert found.coupled_block is None
        assert found.block_on_boot is None


@pytest.mark.parametrize(
    ("name", "textbook"),
    [("booted-sleeper", 148), ("booted-block-low-mass", 268), ("booted-block-high-mass", 212)],
)
def test_without_loss_the_block_is_the_textbook_oscillator(name, textbook):
    found = natural_frequencies(without_loss(tig.PRESETS[name]))
    assert found.coupled_block == pytest.approx(textbook, abs=0.7)


@pytest.mark.parametrize("design", [BLOCK, SLAB], ids=["two-stage", "single-stage"])
def test_modes_are_those_of_a_dense_eigenvalue_problem(design):
    """Loaded track: the lowest mode of a finite ring with wheel. Cut-on: the ring's lowest without it."""
    design = without_loss(design)
    bays, per_bay = 81, 3
    count, dx = bays * per_bay, design.fastener_spacing / per_bay
    size = count + (bays if design.two_stage else 0)
    second = np.roll(np.eye(count), 1, axis=0) - 2 * np.eye(count) + np.roll(np.eye(count), -1, axis=0)
    stiffness, mass = np.zeros((size + 1, size + 1)), np.zeros(size + 1)
    stiffness[:count, :count] = design.rail.bending_stiffness / dx**3 * second @ second
    mass[:count] = design.rail.mass_per_metre * dx
    for bay in range(bays):
        if design.two_stage:
            pair = [bay * per_bay, count + bay]
            stiffness[np.ix_(pair, pair)] += design.pad_stiffness * np.array([[1, -1], [-1, 1]])
            stiffness[count + bay, count + bay] += design.boot_stiffness
            mass[count + bay] = design.block_mass
        else:
            stiffness[bay * per_bay, bay * per_bay] += design.pad_stiffness
    k = design.contact_stiffness
    stiffness[np.ix_([0, -1], [0, -1])] += k * np.array([[1, -1], [-1, 1]])
    mass[-1] = design.wheel_mass
    root = np.sqrt(mass)
    lowest = np.sqrt(np.linalg.eigvalsh(stiffness / np.outer(root, root))[0]) / (2 * np.pi)
    assert natural_frequencies(design).loaded_track == pytest.approx(lowest, rel=1e-6)


def test_cut_on_pair_is_that_of_two_masses():
    design = without_loss(BLOCK)
    rail = design.rail.mass_per_metre * design.fastener_spacing
    k, boot, block = design.pad_stiffness, design.boot_stiffness, design.block_mass
    matrix = np.array([[k / rail, -k / rail], [-k / block, (k + boot) / block]])
    expected = np.sort(np.sqrt(np.linalg.eigvals(matrix))) / (2 * np.pi)
    assert natural_frequencies(design).cut_on == pytest.approx(expected)


def test_stiffnesses_are_taken_at_the_frequency_found():
    found = natural_frequencies(BLOCK)
    pad, boot = laws(BLOCK)
    f = found.coupled_block
    assert pad.stiffness(f) + boot.stiffness(f) == pytest.approx(BLOCK.block_mass * (2 * np.pi * f) ** 2)
    assert boot.stiffness(found.block_on_boot) == pytest.approx(
        BLOCK.block_mass * (2 * np.pi * found.block_on_boot) ** 2
    )


@given(designs)
def test_the_coupled_pair_straddles_the_uncoupled(design):
    found = natural_frequencies(without_loss(design))
    assert 0 < found.loaded_track <= found.cut_on[0] * (1 + 1e-9)
    assert found.loaded_track <= min(found.wheel_on_rigid_blocks, found.block_on_boot) * (1 + 1e-6)
    assert found.coupled_block > found.block_on_boot


@given(mass=st.floats(200, 1500))
def test_a_wheel_on_a_rigid_rail_bounces_on_its_contact_spring(mass):
    stiff = SLAB.replace(pad_stiffness=1e12, pad_loss_factor=0.0, wheel_mass=mass, contact_stiffness=1e8)
    expected = np.sqrt(1e8 / mass) / (2 * np.pi)
    softened = expected / np.sqrt(
        1 + 1e8 * receptance(stiff.replace(pad_loss_factor=1e-6), [expected])[0].real
    )
    assert natural_frequencies(stiff).loaded_track == pytest.approx(softened, rel=1e-4)
    assert natural_frequencies(stiff).loaded_track == pytest.approx(expected, rel=0.02)


@pytest.mark.parametrize("fidelity", ["paper", "exact"])
def test_observed_peaks_stand_beside_the_computed_roots(preset, fidelity, solved):
    """Damping and the reference's slope move a peak off its root by less than one per cent."""
    solution = solved(preset) if fidelity == "paper" else tig.solve(tig.PRESETS[preset], "exact")
    found = solution.natural_frequencies
    assert found.observed_loaded_track == pytest.approx(found.loaded_track, rel=0.01)
    per_line = solution.spectrum.energy / solution.spectrum.frequency**2
    near = np.abs(solution.spectrum.frequency / found.loaded_track - 1) < 0.3
    highest = solution.spectrum.frequency[near][np.argmax(per_line[near])]
    assert found.observed_loaded_track == pytest.approx(highest, abs=0.5)
    if solution.design.two_stage:
        assert found.observed_coupled_block == pytest.approx(found.coupled_block, rel=0.01)
    else:
        assert found.observed_coupled_block is None


def test_a_peak_is_found_between_points_and_only_where_there_is_one():
    frequency = np.arange(1.0, 200.0)
    peaked = 1 / (1 + ((frequency - 63.4) / 4) ** 2)
    assert peak_near(frequency, peaked, 60.0) == pytest.approx(63.4, abs=0.05)
    assert peak_near(frequency, frequency**2, 60.0) is None
    assert peak_near(frequency, peaked, 5000.0) is None
