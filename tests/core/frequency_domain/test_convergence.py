"""Convergence studies: the expected slopes, and the run follows them."""

import numpy as np
import pytest

import trackig_core as tig
from trackig_core.frequency_domain.convergence import element_errors, time_step_errors
from trackig_core.time_domain.grid import PAPER_TIME_STEP, make_grid
from trackig_core.time_domain.spectrum import force_spectrum
from trackig_core.time_domain.time_stepping import simulate

BLOCK = tig.PRESETS["booted-block-low-mass"]


def slopes(errors):
    return np.log2(np.array(errors[1:]) / errors[:-1])


@pytest.mark.parametrize("order", [1, 2])
def test_the_time_step_converges_with_the_order_of_the_memory(preset, order):
    steps = PAPER_TIME_STEP * np.array([1, 2, 4])
    errors = time_step_errors(tig.PRESETS[preset], steps, order)
    assert slopes(errors) == pytest.approx(np.full(2, order), abs=0.15)


def test_the_second_order_memory_allows_four_times_the_papers_step(preset):
    first = time_step_errors(tig.PRESETS[preset], [PAPER_TIME_STEP], 1)[0]
    assert first < 0.2
    assert time_step_errors(tig.PRESETS[preset], [4 * PAPER_TIME_STEP], 2)[0] < 0.015


def test_runs_have_the_errors_that_the_study_states():
    exact = tig.solve(BLOCK, "exact")
    for factor, order in ((1, 1), (2, 1), (4, 2)):
        grid = make_grid(BLOCK, time_step=factor * PAPER_TIME_STEP)
        spectrum = force_spectrum(simulate(BLOCK, grid, memory_order=order))
        gain = tig.insertion_gain(spectrum, BLOCK, exact.natural_frequencies.loaded_track)
        error = np.abs(gain.levels - exact.insertion_gain).max()
        assert error == pytest.approx(time_step_errors(BLOCK, [grid.dt], order)[0], abs=1e-3)


def test_elements_converge_with_second_order(preset):
    errors = element_errors(tig.PRESETS[preset], [12, 6, 3])
    assert slopes(errors) == pytest.approx([2, 2], abs=0.2)
    assert errors[-1] < 1.0
