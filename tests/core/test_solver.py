"""Solving: golden results, closed form, the rigid track, any valid design, and the memory it takes."""

import pickle
import subprocess
import sys

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import trackig_core as tig
from tests.core.time_domain.test_grid import designs
from trackig_core import solver
from trackig_core.frequency_domain import axle_kernels, batch_kernels
from trackig_core.frequency_domain import kernels as frequency_kernels
from trackig_core.frequency_domain.batch_kernels import MOST_FREQUENCIES
from trackig_core.frequency_domain.floquet_waves import exact_spectrum
from trackig_core.frequency_domain.lattice import Lattice
from trackig_core.levels import kernels as level_kernels
from trackig_core.time_domain import kernels as time_kernels
from trackig_core.time_domain.grid import RING_BAYS, make_grid
from trackig_core.time_domain.spectrum import force_spectrum
from trackig_core.time_domain.time_stepping import simulate

BLOCK, SLAB = tig.PRESETS["booted-block-low-mass"], tig.PRESETS["slab-track"]


def in_decibels(energy, reference):
    return np.abs(10 * np.log10(energy / reference))


def test_golden_insertion_gain_of_the_paper_run(golden, solved, preset):
    case, solution = golden["cases"][preset], solved(preset)
    assert np.abs(solution.insertion_gain - case["insertion_gain_db"]).max() < 3e-4
    coherent = tig.insertion_gain(
        solution.spectrum,
        solution.design,
        solution.natural_frequencies.loaded_track,
        reference="rigid",
        summation="coherent",
    )
    assert np.abs(coherent.levels - case["insertion_gain_coherent_rigid_db"]).max() < 3e-4
    assert solution.band_centres == pytest.approx(case["band_hz"], abs=1e-4)
    assert solution.notes == ()


def test_golden_energy_of_the_paper_run(golden, solved, preset):
    case, spectrum = golden["cases"][preset], solved(preset).spectrum
    at = np.searchsorted(spectrum.frequency, np.array(case["spectrum_hz"]) - 1e-6)
    assert spectrum.frequency[at] == pytest.approx(case["spectrum_hz"])
    expected = case["summed_force_energy_density_for_0p1mm_step"]
    assert in_decibels(spectrum.energy[at], expected).max() < 1e-4


def test_the_run_is_its_own_z_transform(solved, preset):
    """Every bin up to 500 Hz, energy and coherent, against the same scheme in closed form."""
    solution = solved(preset)
    frequency = solution.spectrum.frequency[solution.spectrum.frequency <= 500]
    exact = exact_spectrum(solution.design, frequency, 1e-4, Lattice(3, RING_BAYS, solution.grid.dt, 1))
    count = len(frequency)
    assert in_decibels(solution.spectrum.energy[:count], exact.energy).max() < 1e-4
    assert in_decibels(solution.spectrum.coherent_energy[:count], exact.coherent_energy).max() < 1e-3


def test_a_coarser_run_with_second_order_memory_is_its_own_z_transform():
    grid = make_grid(BLOCK, time_step=1 / 32768)
    spectrum = force_spectrum(simulate(BLOCK, grid, memory_order=2))
    frequency = spectrum.frequency[spectrum.frequency <= 500]
    exact = exact_spectrum(BLOCK, frequency, 1e-4, Lattice(3, RING_BAYS, grid.dt, 2))
    assert in_decibels(spectrum.energy[: len(frequency)], exact.energy).max() < 1e-3


ordinary_designs = st.builds(
    tig.TrackDesign,
    pad_stiffness=st.floats(1e7, 2e9),
    pad_loss_factor=st.floats(0.05, 0.5),
    block_mass=st.floats(10, 500),
    boot_stiffness=st.floats(2e6, 2e8),
    boot_loss_factor=st.floats(0.05, 0.5),
    fastener_spacing=st.floats(0.3, 1.0),
    wheel_mass=st.floats(200, 1500),
    contact_stiffness=st.floats(2e8, 5e9),
)
FEW = settings(max_examples=8, suppress_health_check=[HealthCheck.too_slow])


@given(ordinary_designs)
@FEW
def test_any_ordinary_run_is_its_own_z_transform(design):
    solution = tig.solve(design)
    lattice = Lattice(3, RING_BAYS, solution.grid.dt, 1)
    # Supports more than 0.8 m apart let waves of the pinned-pinned shape into the bands. They linger in the
    # ring after the force as a whole has died down: a few lines are then less exact, and by 0.010 dB a band.
    if design.fastener_spacing <= 0.8:
        frequency = solution.spectrum.frequency[solution.spectrum.frequency <= 500]
        exact = exact_spectrum(design, frequency, 1e-4, lattice)
        assert in_decibels(solution.spectrum.energy[: len(frequency)], exact.energy).max() < 0.01
    exact = exact_spectrum(design, np.arange(1, 11_400) * 0.05, 1e-4, lattice)
    gain = tig.insertion_gain(exact, design, solution.natural_frequencies.loaded_track)
    most = 0.01 if design.fastener_spacing <= 0.8 else 0.012
    assert np.abs(solution.insertion_gain - gain.levels).max() < most


@given(ordinary_designs, st.booleans(), st.floats(0.2, 0.3), st.floats(0.01, 0.05))
@FEW
def test_any_valid_design_gives_finite_results(design, single_stage, spacing, loss):
    design = design.replace(fastener_spacing=spacing, pad_loss_factor=loss)
    if single_stage:
        design = design.replace(block_mass=None, boot_stiffness=None, boot_loss_factor=None)
    solution = tig.solve(design)
    for values in (solution.insertion_gain, solution.total_force, solution.loaded_support_force):
        assert np.isfinite(values).all()
    assert np.ptp(solution.insertion_gain) > 0


@given(designs.filter(lambda design: design.boot_loss_factor > 1e-3))
@settings(max_examples=100)
def test_any_valid_design_has_a_finite_exact_solution(design):
    solution = tig.solve(design, "exact")
    assert np.isfinite(solution.insertion_gain).all()
    assert solution.time is solution.total_force is solution.grid is None


def test_the_exact_solution_is_the_limit_of_the_paper_run(solved, preset):
    """The paper's first-order memory costs up to 0.16 dB; with second-order memory 0.001 dB is left."""
    design = tig.PRESETS[preset]
    exact = tig.solve(design, "exact").insertion_gain
    assert np.abs(solved(preset).insertion_gain - exact).max() < 0.16
    spectrum = force_spectrum(simulate(design, make_grid(design), memory_order=2))
    loaded_track = solved(preset).natural_frequencies.loaded_track
    for choice, left in (({}, 1e-3), ({"reference": "rigid"}, 1e-3), ({"summation": "coherent"}, 2e-3)):
        stepped = tig.insertion_gain(spectrum, design, loaded_track, **choice)
        assert np.abs(stepped.levels - tig.solve(design, "exact", **choice).insertion_gain).max() < left


def test_light_damping_is_resolved_exactly():
    """Loss factors of 0.01 against a spectrum a hundred times as dense."""
    for preset in tig.PRESETS.values():
        design = preset.replace(pad_loss_factor=0.01)
        if design.two_stage:
            design = design.replace(boot_loss_factor=0.01)
        solution = tig.solve(design, "exact")
        loaded = solution.natural_frequencies.loaded_track
        dense = exact_spectrum(design, np.geomspace(min(4.4, loaded / 10), 570, 60_000), 1e-4)
        assert (
            np.abs(solution.insertion_gain - tig.insertion_gain(dense, design, loaded).levels).max() < 0.005
        )


def test_without_loss_the_exact_solution_is_refused():
    with pytest.raises(tig.DesignError, match="pad_loss_factor"):
        tig.solve(SLAB.replace(pad_loss_factor=0.0), "exact")
    with pytest.raises(tig.DesignError, match="boot_loss_factor"):
        tig.solve(BLOCK.replace(boot_loss_factor=0.0), "exact")
    finite = tig.solve(BLOCK.replace(pad_loss_factor=0.0), "exact").insertion_gain
    assert np.isfinite(finite).all()


def test_a_very_stiff_run_falls_on_the_rigid_line():
    """The paper's stiff reference: supports and contact so stiff that the resonance leaves the bands."""
    stiff = SLAB.replace(pad_stiffness=5e12, contact_stiffness=5e12)
    spectrum = force_spectrum(simulate(stiff, make_grid(stiff, bays=101)))
    gain = tig.insertion_gain(
        spectrum, stiff, tig.solve(stiff, "exact").natural_frequencies.loaded_track, "rigid"
    )
    assert np.abs(gain.levels).max() < 0.1
    per_octave = np.diff(10 * np.log10(gain.band_energy)) / np.diff(np.log2(tig.BAND_CENTRES))
    assert per_octave == pytest.approx(np.full(20, 9.03), abs=0.05)


def test_insertion_gain_does_not_depend_on_the_height_of_the_step():
    grid = make_grid(BLOCK)
    spectra = [force_spectrum(simulate(BLOCK, grid, step=step)) for step in (1e-4, 3e-3)]
    gains = [tig.insertion_gain(each, BLOCK, 39.0, reference="rigid").levels for each in spectra]
    assert gains[0] == pytest.approx(gains[1], abs=1e-9)


def test_total_force_is_the_sum_over_the_whole_ring(solved):
    solution = solved("booted-block-low-mass")
    forces = solution.history.support_force
    assert solution.total_force == pytest.approx(forces[:, 0] + 2 * forces[:, 1:].sum(axis=1), abs=1e-6)
    assert solution.loaded_support_force is not None
    assert len(solution.time) == len(solution.total_force) == 8192


MEMORY_SCRIPT = """
import resource, sys
before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
import trackig_core as tig
for design in tig.PRESETS.values():
    tig.solve(design)
after = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
print((after - before) / 1024)
"""


@pytest.mark.skipif(sys.platform != "linux", reason="ru_maxrss is in kB only on Linux")
def test_presets_take_at_most_400_mb_above_the_bare_interpreter():
    run = subprocess.run([sys.executable, "-c", MEMORY_SCRIPT], capture_output=True, text=True, check=True)
    assert float(run.stdout) < 400


@pytest.mark.parametrize("value", ["booted-block-low-mass", None, 3.0, SLAB.rail], ids=repr)
def test_what_is_no_design_is_told(value):
    with pytest.raises(tig.DesignError, match="give a TrackDesign"):
        tig.solve(value)


def test_results_show_themselves_in_a_few_lines(solved):
    solution = solved("slab-track")
    for shown in (solution, solution.spectrum, solution.history, solution.gain, tig.verify(solution)):
        assert 10 < len(repr(shown)) < 1500
    assert "loaded track 146.0 Hz" in repr(solution)


def test_a_costly_time_step_is_told():
    steep = SLAB.replace(pad_loss_factor=tig.LossFactorCurve([(5, 0.01), (500, 0.5)]))
    stepped, exact = tig.solve(steep), tig.solve(steep, "exact")
    error = np.abs(stepped.insertion_gain - exact.insertion_gain).max()
    assert error > 0.5
    assert any(f"cost up to {error:.1f} dB" in note for note in stepped.notes)


LOSSLESS_PAD = tig.TrackDesign(
    pad_stiffness=67.1e6,
    pad_loss_factor=0.0,
    block_mass=488.9,
    boot_stiffness=15.48e6,
    boot_loss_factor=0.02,
    fastener_spacing=0.996,
    wheel_mass=880.0,
)


def test_resonances_too_sharp_to_be_resolved_are_reported():
    frequency = np.linspace(5, 500, MOST_FREQUENCIES + 1)
    spectrum = tig.ForceSpectrum(frequency, np.ones_like(frequency), np.ones_like(frequency), 1e-4)
    assert any("too sharp" in note for note in solver._sharpness_notes(spectrum))
    for design in tig.PRESETS.values():
        assert tig.solve(design, "exact").notes == ()


def test_next_to_no_loss_is_resolved_and_rings_ten_decibels_louder_a_decade():
    peaks = [
        tig.solve(LOSSLESS_PAD.replace(boot_loss_factor=loss), "exact").insertion_gain.max()
        for loss in (1e-5, 1e-6, 1e-7, 1e-8)
    ]
    assert np.diff(peaks) == pytest.approx(10.0, abs=0.02)


LIGHT_PAD = tig.TrackDesign(
    pad_stiffness=19.12697e6,
    pad_loss_factor=0.01751834,
    block_mass=None,
    boot_stiffness=None,
    boot_loss_factor=None,
    fastener_spacing=0.806364,
    wheel_mass=1407.839,
    contact_stiffness=3628.343e6,
)
"""The flank of its resonance crosses a straight line halfway between two of the first frequencies."""


@pytest.mark.parametrize(
    "design",
    [LOSSLESS_PAD, LIGHT_PAD, BLOCK.replace(pad_loss_factor=1e-5, boot_loss_factor=1e-4)],
    ids=["lossless pad", "light pad", "next to no loss"],
)
def test_sharp_resonances_are_resolved(design):
    """Bands against Gauss integration of every interval between the solution's own frequencies."""
    solution = tig.solve(design, "exact")
    assert solution.notes == ()
    peaks = solution.spectrum.frequency
    for band in range(21):
        low, high = tig.BAND_EDGES[band : band + 2]
        inside = np.unique(np.clip(peaks, low, high))
        points, weights = np.polynomial.legendre.leggauss(16)
        middle, half = (inside[1:] + inside[:-1]) / 2, np.diff(inside) / 2
        grid = middle[:, None] + half[:, None] * points
        order = np.argsort(grid, axis=None)
        energy = np.empty(grid.size)
        energy[order] = exact_spectrum(design, grid.ravel()[order], 1e-4).energy
        total = np.sum(half[:, None] * weights * energy.reshape(grid.shape))
        assert abs(10 * np.log10(solution.gain.band_energy[band] / total)) < 0.002


def test_what_rounding_drowns_is_refused(monkeypatch):
    def drowned(*arguments):
        frequency = arguments[-1]
        return np.array([frequency, -np.ones_like(frequency), np.ones_like(frequency)])

    monkeypatch.setattr(batch_kernels, "resolve_row", drowned)
    with pytest.raises(tig.DesignError, match=r"boot_loss_factor = 0\.2: .*rounding drowns"):
        tig.solve(BLOCK, "exact")


def test_compiling_leaves_nothing_to_compile():
    tig.compile_kernels()
    modules = (time_kernels, frequency_kernels, batch_kernels, axle_kernels, level_kernels)
    every = [each for module in modules for each in vars(module).values()]
    kernels = [each for each in every if hasattr(each, "signatures")]
    before = {each: tuple(each.signatures) for each in kernels}
    followed = BLOCK.replace(axle_positions=(0.0, 0.6), speed=20.0, ground=tig.GROUNDS["rock"])
    for design, fidelity in ((BLOCK, "paper"), (BLOCK, "exact"), (followed, "exact")):
        tig.solve(design, fidelity)
    tig.verify(tig.solve(SLAB))
    assert before[time_kernels.advance]
    assert before[frequency_kernels.bay_waves]
    assert {each: tuple(each.signatures) for each in kernels} == before


def test_errors_pass_between_processes():
    with pytest.raises(tig.DesignError) as caught:
        BLOCK.replace(pad_stiffness=-1.0)
    copy = pickle.loads(pickle.dumps(caught.value))
    assert (str(copy), copy.field, copy.value) == (str(caught.value), "pad_stiffness", -1.0)
    with pytest.raises(tig.MeasurementError) as caught:
        tig.LossFactorCurve([(5, 0.1), (4, 0.1)])
    copy = pickle.loads(pickle.dumps(caught.value))
    assert (str(copy), copy.row) == (str(caught.value), 2)
