"""The compiled time step under vehicles and on ground: plain transcription, theory, stability, physics."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import trackig_core as tig
from tests.core.frequency_domain.test_axles import CLAY, PRIMARY, SURROUNDED
from tests.core.slow import run_ring
from trackig_core.frequency_domain.floquet_waves import exact_spectrum
from trackig_core.frequency_domain.lattice import Lattice
from trackig_core.time_domain import vehicle_kernels as kernels
from trackig_core.time_domain.grid import fewest_bays, make_grid, stable_time_step
from trackig_core.time_domain.spectrum import force_spectrum
from trackig_core.time_domain.time_stepping import LOADED_SUPPORT, Run, simulate
from trackig_core.time_domain.vehicle_layout import VehicleLayout
from trackig_core.track.viscoelastic_law import laws

BLOCK, SLAB = tig.PRESETS["booted-block-low-mass"], tig.PRESETS["slab-track"]


def step_through(design, grid, steps, advance=kernels.advance, **choices):
    """Return the state after some steps, and the record at every step, in order."""
    run = Run(design, grid, **choices)
    layout = VehicleLayout(grid, len(design.axle_positions))
    constants = run._constants._replace(comb=np.array([1.0, 0.0, 0.0, 0.0]), comb_factor=1)
    state = run._state._replace(window=np.zeros((4, layout.columns(LOADED_SUPPORT.count))))
    rows = np.empty((steps, state.window.shape[1]))
    advance(*state, *constants, rows)
    record = np.empty((steps, layout.width(LOADED_SUPPORT.count)))
    layout.put_in_order(rows, record)
    return state, record


def unfold(values, grid):
    """Return the whole ring's values (bays,), support 0 first, from those that are stored."""
    return np.concatenate([values, values[:0:-1]]) if grid.symmetric else values


@pytest.mark.parametrize("design", SURROUNDED.values(), ids=SURROUNDED)
@pytest.mark.parametrize(("bays", "per_bay"), [(67, 3), (47, 6)])
def test_kernel_is_the_plain_transcription(design, bays, per_bay):
    grid = make_grid(design, bays=bays, elements_per_bay=per_bay)
    assert grid.bays == bays
    state, record = step_through(design, grid, 500)
    forces, rail, _, wheels = run_ring(design, *laws(design), bays, per_bay, grid.dt, 500)
    found = np.array([unfold(row, grid) for row in record[:, : grid.stored_bays]])
    assert np.abs(found - forces).max() <= 1e-9 * np.abs(forces).max()
    assert state.rail[2] == pytest.approx(rail[0], rel=1e-9)
    assert state.wheels[:, 0] == pytest.approx(wheels, rel=1e-9)


def test_a_wheel_may_be_excited_alone():
    design = BLOCK.replace(axle_positions=(0.0, 0.4, 2.4))
    grid = make_grid(design, bays=67)
    alone = []
    for wheel in range(3):
        _, record = step_through(design, grid, 300, rough_wheel=wheel)
        forces, *_ = run_ring(design, *laws(design), 67, 3, grid.dt, 300, rough_wheel=wheel)
        assert np.abs(record[:, :67] - forces).max() <= 1e-9 * np.abs(forces).max()
        alone.append(record)
    _, together = step_through(design, grid, 300)
    assert np.abs(sum(alone) - together).max() <= 1e-9 * np.abs(together).max()


def test_one_wheel_on_rigid_ground_is_the_ordinary_kernel():
    """A suspension next to nothing strong, through the general kernel, against none through the ordinary."""
    weak = BLOCK.replace(suspension=tig.Suspension(1e3, 0.0, 1e5))
    general, ordinary = (simulate(each, make_grid(each, bays=67, record=0.2)) for each in (weak, BLOCK))
    count = min(len(general.time), len(ordinary.time), 400)
    scale = np.abs(ordinary.support_force).max()
    assert np.abs(general.support_force[:count] - ordinary.support_force[:count]).max() < 1e-4 * scale
    assert general.multiplicity.tolist() == ordinary.multiplicity.tolist()


@pytest.mark.parametrize("design", SURROUNDED.values(), ids=SURROUNDED)
def test_a_run_is_its_own_z_transform(design):
    """From the lowest band edge on; bodies that bounce at 1 Hz outlast any record by a little."""
    grid = make_grid(design, time_step=1 / 32768)
    independent = design.speed is None and len(design.axle_positions) > 1
    wheels = range(len(design.axle_positions)) if independent else [None]
    runs = [simulate(design, grid, memory_order=2, rough_wheel=wheel) for wheel in wheels]
    spectra = [force_spectrum(run, like=runs[0]) for run in runs]
    frequency = spectra[0].frequency
    within = (frequency > 4.4) & (frequency < 500)
    energy = sum(each.energy for each in spectra)[within]
    exact = exact_spectrum(design, frequency[within], 1e-4, Lattice(3, grid.bays, grid.dt, 2))
    most = 1e-4 if design.suspension is None else 2e-4
    assert np.abs(10 * np.log10(energy / exact.energy)).max() < most


@pytest.mark.parametrize("design", SURROUNDED.values(), ids=SURROUNDED)
def test_live_fidelity_keeps_its_promise(design):
    live, exact = tig.solve(design, "live"), tig.solve(design, "exact")
    assert np.abs(live.insertion_gain - exact.insertion_gain).max() < 0.05


@pytest.mark.slow
def test_paper_fidelity_sums_the_runs_of_independent_wheels():
    design = BLOCK.replace(axle_positions=(0.0, 2.4))
    fractions = []
    paper, exact = tig.solve(design, progress=fractions.append), tig.solve(design, "exact")
    assert np.abs(paper.insertion_gain - exact.insertion_gain).max() < 0.15
    assert any("one run per axle" in note for note in paper.notes)
    assert paper.history.support_force.shape[1] == 667
    assert (np.diff(fractions) > 0).all()
    assert fractions[-1] == 1.0


def test_records_that_end_at_different_times_have_the_same_frequencies():
    short, long = (simulate(BLOCK, make_grid(BLOCK, 1 / 32768, bays=67, record=each)) for each in (0.5, 3.0))
    assert len(short.time) < len(long.time)
    folded, whole = force_spectrum(long, like=short), force_spectrum(long)
    assert folded.frequency.tolist() == force_spectrum(short).frequency.tolist()
    every = round(len(long.time) / len(short.time))
    assert folded.energy == pytest.approx(whole.energy[every - 1 :: every][: len(folded.energy)], rel=1e-9)


def test_a_late_axle_lengthens_the_record():
    design = BLOCK.replace(axle_positions=(0.0, 4.8), speed=1.6)
    grid = make_grid(design, bays=67, record=0.5, time_step=1 / 32768)
    history = simulate(design, grid)
    assert history.last_onset == pytest.approx(3.0)
    assert history.steps * history.time_step > 3.5
    assert history.decayed


@pytest.mark.parametrize("design", [BLOCK.replace(axle_positions=(0.0, 2.4)), BLOCK.replace(ground=CLAY)])
def test_the_ring_is_half_or_whole_and_long_enough(design):
    grid = make_grid(design, bays=17)
    assert grid.symmetric is (design.axle_positions == (0.0,))
    assert grid.stored_bays == (grid.half_bays if grid.symmetric else grid.bays)
    assert grid.bays == max(17, fewest_bays(design))
    assert grid.bays % 2


def test_the_time_step_obeys_a_stiff_suspension():
    stiff = BLOCK.replace(suspension=tig.Suspension(1e9, 0.0, 1.0))
    dx = stiff.fastener_spacing / 3
    assert stable_time_step(stiff, dx) <= 2 / np.sqrt(2 * 1e9) * (1 + 1e-9)
    assert stable_time_step(BLOCK.replace(suspension=PRIMARY), dx) == stable_time_step(BLOCK, dx)
    assert make_grid(stiff, 1 / 4096).notes


surroundings = st.builds(
    tig.Ground,
    stiffness=st.floats(1e5, 1e13),
    damping=st.one_of(st.just(0.0), st.floats(0.0, 1e8)),
    mass=st.one_of(st.just(0.0), st.floats(0.0, 1e4)),
)
suspensions = st.builds(
    tig.Suspension,
    primary_stiffness=st.floats(1e4, 1e9),
    primary_damping=st.floats(0.0, 1e7),
    bogie_mass=st.floats(1.0, 1e4),
    secondary_stiffness=st.floats(1e4, 1e9),
    secondary_damping=st.floats(0.0, 1e7),
    body_mass=st.floats(1.0, 1e4),
)


@given(surroundings, suspensions, st.sampled_from([BLOCK, SLAB]), st.sampled_from([(0.0,), (0.3, 1.7)]))
@settings(max_examples=40)
def test_any_vehicle_on_any_ground_is_stable_at_the_bound(ground, suspension, base, axles):
    """At the longest step that the bound allows, a long run never exceeds its start."""
    design = base.replace(ground=ground, suspension=suspension, axle_positions=axles, pad_loss_factor=0.0)
    if design.two_stage:
        design = design.replace(boot_loss_factor=0.0)
    bound = 0.999 * stable_time_step(design, design.fastener_spacing / 3)
    grid = make_grid(design, bound, bays=33, record=max(0.01, 4000 * bound))
    assert grid.dt == bound
    _, record = step_through(design, grid, 4000)
    assert np.isfinite(record).all()
    largest = np.abs(record[:, : grid.stored_bays]).max(axis=1)
    assert largest[2000:].max() <= 20 * largest[:2000].max()
    # the wheels' energy comes from the contact spring: they cannot move farther than it allows
    assert np.abs(record[:, grid.stored_bays]).max() < 1.0


def test_interpreted_and_compiled_kernels_agree(monkeypatch):
    design = SURROUNDED["everything"]
    grid = make_grid(design, bays=31)
    _, compiled = step_through(design, grid, 30)
    for name, each in vars(kernels).copy().items():
        if hasattr(each, "py_func") and name != "advance":
            monkeypatch.setattr(kernels, name, each.py_func)
    _, interpreted = step_through(design, grid, 30, kernels.advance.py_func)
    assert interpreted == pytest.approx(compiled, rel=1e-9, abs=1e-12 * np.abs(compiled).max())


def test_force_into_the_ground_is_in_balance_when_everything_is_at_rest_again():
    """A wheel held down by a step for good: nothing supports it, so all forces die away."""
    history = simulate(SURROUNDED["ground"], make_grid(SURROUNDED["ground"]))
    assert history.decayed
    assert np.abs(history.support_force[-100:]).max() < 1e-4 * np.abs(history.support_force).max()
