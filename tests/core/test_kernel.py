"""The compiled time step against a plain transcription, and against the laws of physics."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import trackig_core as tig
from tests.core.slow import run_ring
from trackig_core import kernel
from trackig_core.grid import make_grid
from trackig_core.relaxation import laws
from trackig_core.simulate import at_rest

BLOCK, SLAB = tig.PRESETS["booted-block-low-mass"], tig.PRESETS["slab-track"]


def step_through(design, grid, steps, **choices):
    """Return the state after some steps, and the record (steps, half_bays + 2)."""
    state, constants = at_rest(design, grid, **choices)
    record = np.empty((steps, grid.half_bays + 2))
    kernel.advance(*state, *constants, record)
    return state, record


def unfold(half_rows):
    """Return the whole ring's values (bays,) from those of its stored half, support 0 first."""
    return np.concatenate([half_rows, half_rows[:0:-1]])


def whole_rail(rows):
    """Return the ring's elements in order, from rows (per_bay, half_bays) without ghosts."""
    per_bay, half = rows.shape
    elements = rows.T.ravel()
    count = per_bay * (2 * half - 1)
    return elements[np.minimum(np.arange(count), count - np.arange(count))]


@pytest.mark.parametrize("design", [BLOCK, SLAB], ids=["two-stage", "single-stage"])
@pytest.mark.parametrize(("bays", "per_bay"), [(667, 3), (9, 3), (7, 2), (7, 4), (5, 5)])
def test_kernel_is_the_plain_transcription(design, bays, per_bay):
    grid = make_grid(design, bays=bays, elements_per_bay=per_bay)
    state, record = step_through(design, grid, 500)
    forces, rail, block, wheel = run_ring(design, *laws(design), bays, per_bay, grid.dt, 500)
    scale = np.abs(forces).max()
    mirrored = np.apply_along_axis(unfold, 1, record[:, :-2])
    assert np.abs(mirrored - forces).max() <= 1e-9 * scale
    assert np.abs(whole_rail(state.rail[:, 1:-1]) - rail).max() <= 1e-9 * np.abs(rail).max()
    assert np.abs(unfold(state.block) - block).max() <= 1e-9 * max(np.abs(block).max(), 1e-30)
    assert state.wheel[0] == pytest.approx(wheel, rel=1e-9)


def test_interpreted_and_compiled_kernels_agree():
    grid = make_grid(BLOCK, bays=5)
    compiled, record = step_through(BLOCK, grid, 60)
    state, constants = at_rest(BLOCK, grid)
    interpreted = np.empty_like(record)
    kernel.advance.py_func(*state, *constants, interpreted)
    assert interpreted == pytest.approx(record, rel=1e-12)
    assert state.rail == pytest.approx(compiled.rail, rel=1e-9, abs=1e-20)


@given(factor=st.floats(-1e3, 1e3).filter(lambda x: abs(x) > 1e-3))
@settings(max_examples=10, deadline=None)
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
    # velocities live half a step after displacements: kinetic + half the work of forces at both instants
    energies = []
    record = np.empty((1, grid.half_bays + 2))
    for _ in range(10_000):
        before = [state.rail[:, 1:-1].copy(), state.block.copy(), state.wheel[0]]
        kernel.advance(*state, *constants, record)
        energies.append(leap_frog_energy(design, grid, before, state))
    start = 0.5 * design.contact_stiffness * 1e-4**2
    assert np.abs(np.array(energies) / energies[0] - 1).max() < 1e-9
    assert energies[0] == pytest.approx(start, rel=0.02)


def leap_frog_energy(design, grid, before, state):
    """Return v M v / 2 + a_n K a_(n+1) / 2 over the whole ring [J]."""
    dx, rail = grid.dx, design.rail
    a0, a1 = whole_rail(before[0]), whole_rail(state.rail[:, 1:-1])
    v = whole_rail(state.rail_velocity)
    b0, b1, vb = unfold(before[1]), unfold(state.block), unfold(state.block_velocity)
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
    kernel.decimate(record, taps, 3, samples)
    whole = np.array([np.convolve(column, taps[::-1], mode="valid") for column in record.T]).T
    assert samples == pytest.approx(whole[:30:3])
