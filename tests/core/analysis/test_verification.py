"""What the verification says is what the solution is compared with elsewhere."""

import dataclasses

import numpy as np
import pytest

import trackig_core as tig

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


def test_what_cannot_be_verified_says_why():
    with pytest.raises(ValueError, match="'exact' was not stepped in time"):
        tig.verify(tig.solve(BLOCK, "exact"))
    with pytest.raises(tig.DesignError, match="no bound"):
        tig.verify(tig.solve(tig.PRESETS["slab-track"].replace(pad_loss_factor=0.0)))


@pytest.mark.parametrize("value", [BLOCK, None])
def test_only_solutions_are_verified(value):
    with pytest.raises(TypeError, match="give what solve"):
        tig.verify(value)
