"""The film: every frame is a low-passed instant of the plain transcription, and no film is large."""

import dataclasses

import numpy as np
import pytest
from hypothesis import given, settings

import trackig_core as tig
from tests.core.slow import run_ring
from tests.core.test_solver import ordinary_designs
from trackig_core.analysis import motion
from trackig_core.time_domain import adaptive_grid
from trackig_core.time_domain.grid import make_grid
from trackig_core.time_domain.time_stepping import Probes, Run, simulate
from trackig_core.track.viscoelastic_law import laws

BLOCK, SLAB = tig.PRESETS["booted-block-low-mass"], tig.PRESETS["slab-track"]


def smoothed(run, frames):
    """Return frames of every step (steps, places) low-passed, at the samples' times."""
    taps = run.filter.whole
    smooth = np.apply_along_axis(lambda column: np.convolve(column, taps)[: len(frames)], 0, frames)
    first = run.filter.comb_factor - 1
    return smooth[first :: run.filter.steps_per_sample]


@pytest.mark.parametrize("design", [BLOCK, SLAB], ids=["two stages", "one stage"])
@pytest.mark.parametrize("time_step", [1 / 131072, 1 / 98304])
def test_probes_are_the_low_passed_displacements_of_the_plain_transcription(design, time_step):
    grid = make_grid(design, bays=17, record=0.0625, time_step=time_step)
    run = Run(design, grid, probes=Probes(rail=(0, 1, 7, 24, 25), blocks=(0, 3, 8)))
    samples = run.collect(grid.steps)
    frames = []
    run_ring(design, *laws(design), 17, 3, grid.dt, grid.steps, frames=frames)
    expected = smoothed(run, np.array(frames))
    # the wheel, then the ring's 51 elements, then its blocks
    places = [0, 1, 2, 8, 25, 26, 52, 55, 60]
    found = samples[: len(expected), grid.half_bays :]
    assert len(found) > 200
    scale = np.abs(expected).max(axis=0)[places]
    np.testing.assert_allclose(found / (scale + 1e-12), expected[:, places] / (scale + 1e-12), atol=1e-9)


@pytest.mark.parametrize("design", [BLOCK, SLAB], ids=["two stages", "one stage"])
@pytest.mark.parametrize("axles", [(0.0,), (0.0, 1.4)], ids=["half the ring", "all of it"])
def test_wheels_and_feet_are_those_of_the_plain_transcription(design, axles):
    design = design.replace(
        suspension=tig.VEHICLES["metro"].suspension,
        axle_positions=axles,
        speed=25.0,
        ground=dataclasses.replace(tig.GROUNDS["soft clay"], mass=300.0),
    )
    grid = make_grid(design, bays=47, record=0.0625, time_step=1 / 98304)
    bays, per_bay, wheels = grid.bays, grid.elements_per_bay, len(axles)
    run = Run(design, grid, probes=Probes(rail=(0, 7), blocks=(0, 3), feet=(0, 1, 3)))
    samples = run.collect(grid.steps)
    frames = []
    run_ring(design, *laws(design), bays, per_bay, grid.dt, grid.steps, frames=frames)
    expected = smoothed(run, np.array(frames))
    rail, block = wheels, wheels + bays * per_bay
    foot = block + bays
    places = [*range(wheels), rail, rail + 7, block, block + 3, foot, foot + 1, foot + 3]
    found, expected = samples[: len(expected), grid.stored_bays :], expected[:, places]
    scale = np.abs(expected).max(axis=0)
    assert (scale[-3:] > 1e-7).all(), "feet move"
    np.testing.assert_allclose(found / (scale + 1e-12), expected / (scale + 1e-12), atol=1e-9)


@pytest.mark.parametrize("preset", list(tig.PRESETS))
def test_a_film_is_the_run_s_own_record(preset):
    design = tig.PRESETS[preset]
    made = tig.film(design)
    grid = motion.film_grid(design, motion.BAYS)
    run = Run(design, grid, memory_order=adaptive_grid.MEMORY_ORDER, probes=Probes(rail=(36,), blocks=(12,)))
    samples = run.collect(grid.steps)[:: motion.STRIDE, grid.half_bays :]
    np.testing.assert_array_equal(made.wheel, samples[:, 0])
    np.testing.assert_array_equal(made.rail[:, -1], samples[:, 1])
    history = simulate(design, grid, memory_order=adaptive_grid.MEMORY_ORDER)
    frames = slice(0, motion.STRIDE * len(made.time), motion.STRIDE)
    np.testing.assert_array_equal(made.time, history.time[frames])
    np.testing.assert_array_equal(made.wheel, history.wheel_displacement[frames])
    np.testing.assert_array_equal(made.rail[:, 0], history.rail_displacement[frames])
    if design.two_stage:
        np.testing.assert_array_equal(made.block[:, 0], history.block_displacement[frames])
        np.testing.assert_array_equal(made.block[:, -1], samples[:, 2])
    else:
        assert made.block is None


def test_a_film_shows_the_wheel_fall_and_all_come_to_rest():
    made = tig.film(BLOCK)
    before, at_rest = made.time < -0.0015, made.time > 0.29
    assert np.abs(made.wheel[before]).max() < 0.01 * made.step
    assert made.wheel.max() == pytest.approx(made.step, rel=0.06)
    for moved in (made.wheel[:, None], made.rail, made.block):
        assert np.abs(moved[at_rest]).max() < 0.03 * made.step
    # the rail is pushed down first under the wheel, then farther and farther away
    reached = np.argmax(np.abs(made.rail) > 0.02 * made.step, axis=0)
    assert (np.diff(reached[::6]) >= 0).all()
    assert reached[-1] > reached[0]


def test_positions_are_those_of_the_track():
    made = tig.film(BLOCK, bays=4)
    np.testing.assert_allclose(made.position, 0.2 * np.arange(13))
    np.testing.assert_allclose(made.support_position, 0.6 * np.arange(5))
    assert made.rail.shape == (made.time.size, 13)
    assert made.block.shape == (made.time.size, 5)


def test_a_film_scales_with_its_step():
    one, two = tig.film(SLAB, bays=3), tig.film(SLAB, bays=3, step=2e-4)
    np.testing.assert_allclose(two.rail, 2 * one.rail, rtol=1e-9)
    assert (one.step, two.step) == (1e-4, 2e-4)


@given(ordinary_designs)
@settings(max_examples=10)
def test_any_film_is_finite_and_bounded(design):
    made = tig.film(design)
    assert made.time.size == 615
    assert made.rail.shape == (615, 37)
    assert np.isfinite(made.rail).all()
    assert np.abs(made.rail).max() < 3 * made.step


@pytest.mark.parametrize("bays", [0, 61])
def test_too_many_bays_are_refused(bays):
    with pytest.raises(ValueError, match="from 1 to 60"):
        tig.film(BLOCK, bays=bays)


def test_a_film_can_be_cancelled():
    with pytest.raises(tig.SolveCancelled):
        tig.film(BLOCK, cancelled=lambda: True)


def test_a_film_of_several_axles_shows_both_sides_and_the_later_axle_later():
    design = BLOCK.replace(axle_positions=(0.0, 2.4), speed=24.0)
    made = tig.film(design, bays=4)
    assert made.wheel_position == pytest.approx([0.0, 2.4])
    assert made.support_position == pytest.approx(0.6 * np.arange(-4, 9))
    assert made.rail.shape == (made.time.size, 37)
    assert made.wheels.shape == (made.time.size, 2)
    pressed = np.abs(made.wheels) > 0.5 * made.step
    first, second = made.time[np.argmax(pressed, axis=0)]
    assert second - first == pytest.approx(0.1, abs=0.002)
    assert np.array_equal(made.wheel, made.wheels[:, 0])


def test_a_film_under_a_suspension_on_ground_is_the_run_s_own_record():
    design = BLOCK.replace(suspension=tig.VEHICLES["metro"].suspension, ground=tig.GROUNDS["soft clay"])
    made = tig.film(design, bays=4)
    grid = motion.film_grid(design, 4)
    history = simulate(design, grid, memory_order=adaptive_grid.MEMORY_ORDER)
    frames = slice(0, motion.STRIDE * len(made.time), motion.STRIDE)
    np.testing.assert_allclose(made.rail[:, 0], history.rail_displacement[frames], rtol=1e-9)
    np.testing.assert_allclose(made.block[:, 0], history.block_displacement[frames], rtol=1e-9)
    # what presses on the ground is what the history says: no foot has a mass here
    assert made.foot.shape == made.block.shape == (made.time.size, 5)
    velocity = np.gradient(made.foot, made.time, axis=0)
    pressed = design.ground.stiffness * made.foot + design.ground.damping * velocity
    force = history.support_force[frames, :5]
    within = slice(20, -20)  # the difference quotient of frames is coarse where the step has just come
    np.testing.assert_allclose(pressed[within], force[within], atol=0.1 * np.abs(force).max())
    assert tig.film(BLOCK, bays=2).foot is None
