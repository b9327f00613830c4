"""What the verification says is what the solution is compared with elsewhere."""

import dataclasses

import numpy as np
import pytest

import trackig_core as tig
from trackig_core.time_domain.grid import PAPER_TIME_STEP, make_grid, paper_memory_order
from trackig_core.time_domain.time_stepping import simulate

BLOCK = tig.PRESETS["booted-block-low-mass"]


def gain(solution, spectrum):
    return tig.insertion_gain(spectrum, solution.design, solution.natural_frequencies.loaded_track).levels


def test_it_tells_mistakes_from_the_cost_of_the_time_step(solved, preset):
    solution = dataclasses.replace(solved(preset), history=None)
    theory = tig.verify(solution)
    assert gain(solution, theory.exact) == pytest.approx(tig.solve(solution.design, "exact").insertion_gain)
    mistakes = np.abs(solution.insertion_gain - gain(solution, theory.scheme)).max()
    cost = np.abs(solution.insertion_gain - gain(solution, theory.exact)).max()
    assert mistakes < 1e-4 < cost < 0.2
    at_run = np.flatnonzero(theory.time_steps == solution.grid.dt)[0]
    assert theory.first_order_errors[at_run] == pytest.approx(cost, abs=1e-3)


def test_a_run_gone_wrong_is_told():
    """A run of a slightly different boot does not pass for this one."""
    other = tig.solve(BLOCK.replace(boot_stiffness=28.3e6))
    pretender = dataclasses.replace(other, design=BLOCK)
    mistakes = np.abs(pretender.insertion_gain - gain(pretender, tig.verify(pretender).scheme)).max()
    assert mistakes > 0.05


def test_only_stable_time_steps_are_studied():
    fine = tig.verify(tig.solve(BLOCK.replace(fastener_spacing=0.2)))
    assert fine.time_steps.max() == 1 / 262144
    assert len(fine.time_steps) == len(fine.first_order_errors) == len(fine.second_order_errors) == 3


@pytest.mark.parametrize("fidelity", ["paper", "live"])
@pytest.mark.parametrize("part", ["pad", "boot"])
def test_a_run_with_so_much_loss_that_the_papers_memory_is_unstable_is_as_exact_as_any(part, fidelity):
    """A loss factor of two is allowed; the paper's recursion would answer a constant strain the wrong way."""
    design = BLOCK.replace(**{f"{part}_loss_factor": 2.0})
    solution = tig.solve(design, fidelity)
    assert np.abs(solution.insertion_gain - tig.solve(design, "exact").insertion_gain).max() < 0.05
    assert any("one of second order is used" in note for note in solution.notes) == (fidelity == "paper")
    theory = tig.verify(solution)
    assert np.abs(solution.insertion_gain - gain(solution, theory.scheme)).max() < 0.01
    assert theory.memory_order == 2
    assert np.isnan(theory.first_order_errors[theory.time_steps >= solution.grid.dt]).all()
    np.testing.assert_array_equal(theory.run_errors, theory.second_order_errors)
    assert np.isfinite(theory.second_order_errors).all()


def test_the_papers_memory_is_the_papers_up_to_a_loss_factor_of_one():
    strong = BLOCK.replace(pad_loss_factor=1.0, boot_loss_factor=1.0)
    assert paper_memory_order(strong, PAPER_TIME_STEP) == 1
    assert paper_memory_order(strong.replace(boot_loss_factor=1.1), PAPER_TIME_STEP) == 2
    assert paper_memory_order(strong.replace(pad_loss_factor=0.0, boot_loss_factor=0.0), 1e-3) == 1
    # what the order is for: the same run with the paper's memory leaves the finite numbers
    lossy = BLOCK.replace(boot_loss_factor=2.0)
    with pytest.raises(FloatingPointError), np.errstate(over="ignore", invalid="ignore"):
        simulate(lossy, make_grid(lossy, bays=17))


def test_what_cannot_be_verified_says_why():
    with pytest.raises(ValueError, match="'exact' was not stepped in time"):
        tig.verify(tig.solve(BLOCK, "exact"))
    with pytest.raises(tig.DesignError, match="no bound"):
        tig.verify(tig.solve(tig.PRESETS["slab-track"].replace(pad_loss_factor=0.0)))


@pytest.mark.parametrize("value", [BLOCK, None])
def test_only_solutions_are_verified(value):
    with pytest.raises(TypeError, match="give what solve"):
        tig.verify(value)
