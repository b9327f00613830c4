"""The compiled time step against a plain transcription, and against the laws of physics."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import trackig_core as tig
from tests.core.slow import run_ring
from trackig_core.time_domain import kernels
from trackig_core.time_domain.grid import make_grid
from trackig_core.time_domain.memory_layout import GHOSTS, Layout
from trackig_core.time_domain.time_stepping import LOADED_SUPPORT, at_rest
from trackig_core.time_domain.vectors import WIDTH
from trackig_core.track.viscoelastic_law import laws

BLOCK, SLAB = tig.PRESETS["booted-block-low-mass"], tig.PRESETS["slab-track"]


def step_through(design, grid, steps, **choices):
    """Return the state after some steps, and the forces (steps, half_bays) and displacements (steps, 3)."""
    state, constants = at_rest(design, grid, **choices)
    return state, advance(state, constants, grid, steps)


def advance(state, constants, grid, steps, step=kernels.advance):
    """Step on from the start and return the record (steps, half_bays + 3), supports in order."""
    layout = Layout(grid)
    rows = np.empty((steps, layout.columns(LOADED_SUPPORT.count)))
    step(*state, *constants, rows)
    record = np.empty((steps, layout.width(LOADED_SUPPORT.count)))
    layout.put_in_order(rows, record)
    return record


def unfold(half_rows):
    """Return the whole ring's values (bays,) from those of its stored half, support 0 first."""
    return np.concatenate([half_rows, half_rows[:0:-1]])


def whole_rail(grid, values, ghosts=0):
    """Return the ring's elements in order, from what is stored of the rail with rows of ghosts or without."""
    layout = Layout(grid)
    from_wheel = np.minimum(np.arange(grid.elements), grid.elements - np.arange(grid.elements))
    places = [layout.rail_place(element) - (GHOSTS - ghosts) * kernels.LANES for element in from_wheel]
    return values[places]


def whole_blocks(grid, supports, quantity=0):
    """Return the displacement of the ring's blocks in order, or their velocity (1)."""
    layout = Layout(grid)
    places = [layout.block_place(bay) + quantity * kernels.LANES for bay in range(grid.half_bays)]
    return unfold(supports.ravel()[places])


@pytest.mark.parametrize("design", [BLOCK, SLAB], ids=["two-stage", "single-stage"])
@pytest.mark.parametrize(("bays", "per_bay"), [(667, 3), (17, 3), (31, 2), (33, 4), (67, 5)])
def test_kernel_is_the_plain_transcription(design, bays, per_bay):
    grid = make_grid(design, bays=bays, elements_per_bay=per_bay)
    state, record = step_through(design, grid, 500)
    forces, rail, block, wheel = run_ring(design, *laws(design), bays, per_bay, grid.dt, 500)
    scale = np.abs(forces).max()
    mirrored = np.apply_along_axis(unfold, 1, record[:, : grid.half_bays])
    assert np.abs(mirrored - forces).max() <= 1e-9 * scale
    assert np.abs(whole_rail(grid, state.rail, GHOSTS) - rail).max() <= 1e-9 * np.abs(rail).max()
    blocks = whole_blocks(grid, state.supports)
    assert np.abs(blocks - block).max() <= 1e-9 * max(np.abs(block).max(), 1e-30)
    assert state.wheel[0] == pytest.approx(wheel, rel=1e-9)


def test_probes_record_wheel_rail_and_block_at_the_loaded_support():
    grid = make_grid(BLOCK, bays=17)
    _, record = step_through(BLOCK, grid, 100)
    _, rail, block, wheel = run_ring(BLOCK, *laws(BLOCK), 17, 3, grid.dt, 99)
    assert record[99, grid.half_bays :] == pytest.approx([wheel, rail[0], block[0]], rel=1e-9)
    assert record[0, grid.half_bays :].tolist() == [1e-4, 0, 0]


def test_mirror_images_beyond_the_half_ring_move_as_what_they_mirror():
    grid = make_grid(BLOCK, bays=667)
    layout = Layout(grid)
    state, _ = step_through(BLOCK, grid, 3000)
    images = range(grid.half_bays, layout.slots)
    assert list(images)
    rows = state.supports.ravel()
    for image in images:
        own, mirrored = layout.block_place(image), layout.block_place(grid.bays - image)
        assert rows[own] == pytest.approx(rows[mirrored], rel=1e-6, abs=1e-300)


@pytest.mark.parametrize("taps", [8, 16])
def test_the_window_keeps_a_weighted_sum_of_the_last_rows_across_calls(taps):
    grid = make_grid(BLOCK, bays=17)
    comb = np.random.default_rng(3).normal(size=taps)
    _, full = step_through(BLOCK, grid, 96)
    layout = Layout(grid)
    state, constants = at_rest(BLOCK, grid, comb=comb, comb_factor=4)
    rows = np.empty((24, layout.columns(LOADED_SUPPORT.count)))
    kernels.advance(*state, *constants, rows[:5])
    kernels.advance(*state, *constants, rows[5:])
    kept = np.empty((24, layout.width(LOADED_SUPPORT.count)))
    layout.put_in_order(rows, kept)
    expected = np.array([np.convolve(column, comb)[3:96:4] for column in full.T]).T
    assert kept == pytest.approx(expected, rel=1e-9, abs=1e-12 * np.abs(full).max())


def test_interpreted_and_compiled_kernels_agree(monkeypatch):
    grid = make_grid(BLOCK, bays=17)
    compiled, record = step_through(BLOCK, grid, 40)
    for name in ("fill_ghosts", "record_displacements", "sweep", "viscoelastic_force", "sum_up"):
        monkeypatch.setattr(kernels, name, getattr(kernels, name).py_func)
    for plain in (load, store, spread, first_lane, one_lane_up, one_lane_down):
        monkeypatch.setattr(kernels, plain.__name__, plain)
    state, constants = at_rest(BLOCK, grid)
    interpreted = advance(state, constants, grid, 40, kernels.advance.py_func)
    assert interpreted == pytest.approx(record, rel=1e-9, abs=1e-12 * np.abs(record).max())
    assert state.rail == pytest.approx(compiled.rail, rel=1e-9, abs=1e-20)


def load(array, place):
    """Return what stands in for a vector in the interpreter."""
    return array[place : place + WIDTH].copy()


def store(array, place, vector):
    array[place : place + WIDTH] = vector


def spread(number):
    return np.full(WIDTH, number)


def first_lane(number):
    return np.pad([number], (0, WIDTH - 1))


def one_lane_up(vector, number):
    return np.append(number, vector[:-1])


def one_lane_down(vector, number):
    return np.append(vector[1:], number)


@given(factor=st.floats(-1e3, 1e3).filter(lambda x: abs(x) > 1e-3))
@settings(max_examples=10)
def test_response_is_linear_in_the_step(factor):
    grid = make_grid(BLOCK, bays=31)
    _, once = step_through(BLOCK, grid, 400, step=1e-4)
    _, scaled = step_through(BLOCK, grid, 400, step=factor * 1e-4)
    assert np.abs(scaled - factor * once).max() <= 1e-12 * np.abs(factor * once).max()


def test_the_ring_is_symmetric_about_the_wheel():
    forces, rail, block, _ = run_ring(BLOCK, *laws(BLOCK), 41, 3, make_grid(BLOCK).dt, 3000)
    assert np.abs(forces[:, 1:] - forces[:, :0:-1]).max() <= 1e-9 * np.abs(forces).max()
    assert np.abs(rail[1:] - rail[:0:-1]).max() <= 1e-9 * np.abs(rail).max()
    assert np.abs(block[1:] - block[:0:-1]).max() <= 1e-9 * np.abs(block).max()


@pytest.mark.parametrize("design", [BLOCK, SLAB], ids=["two-stage", "single-stage"])
def test_without_damping_the_leap_frog_energy_stays(design):
    loss_free = {"pad_loss_factor": 0.0} | ({"boot_loss_factor": 0.0} if design.two_stage else {})
    design = design.replace(**loss_free)
    grid = make_grid(design, bays=101)
    state, constants = at_rest(design, grid)
    row = np.empty((1, Layout(grid).columns(LOADED_SUPPORT.count)))
    # velocities live half a step after displacements: kinetic + half the work of forces at both instants
    energies = []
    for _ in range(10_000):
        before = [
            whole_rail(grid, state.rail, GHOSTS),
            whole_blocks(grid, state.supports),
            state.wheel[0],
        ]
        kernels.advance(*state, *constants, row)
        energies.append(leap_frog_energy(design, grid, before, state))
    start = 0.5 * design.contact_stiffness * 1e-4**2
    assert np.abs(np.array(energies) / energies[0] - 1).max() < 1e-9
    assert energies[0] == pytest.approx(start, rel=0.02)


def leap_frog_energy(design, grid, before, state):
    """Return v M v / 2 + a_n K a_(n+1) / 2 over the whole ring [J]."""
    dx, rail = grid.dx, design.rail
    a0, a1 = before[0], whole_rail(grid, state.rail, GHOSTS)
    v = whole_rail(grid, state.rail_velocity)
    b0, b1, vb = before[1], *(whole_blocks(grid, state.supports, each) for each in (0, 1))
    w0, w1, vw = before[2], *state.wheel
    curvature0, curvature1 = (np.roll(a, 1) - 2 * a + np.roll(a, -1) for a in (a0, a1))
    s = slice(None, None, grid.elements_per_bay)
    doubled = (
        rail.mass_per_metre * dx * v @ v
        + design.wheel_mass * vw**2
        + rail.bending_stiffness / dx**3 * curvature0 @ curvature1
        + design.pad_stiffness * (a0[s] - b0) @ (a1[s] - b1)
        + design.contact_stiffness * (w0 - a0[0]) * (w1 - a1[0])
    )
    if design.two_stage:
        doubled += design.block_mass * vb @ vb + design.boot_stiffness * b0 @ b1
    return doubled / 2


def test_decimation_is_a_convolution_that_keeps_one_row_in_some():
    rng = np.random.default_rng(2)
    record, taps = rng.normal(size=(8 - 1 + 30, 5)), rng.normal(size=8)
    samples = np.empty((10, 5))
    kernels.decimate(record, taps, 3, samples)
    whole = np.array([np.convolve(column, taps[::-1], mode="valid") for column in record.T]).T
    assert samples == pytest.approx(whole[:30:3])
