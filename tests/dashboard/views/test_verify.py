"""The checks: computed only while looked at, and every figure in a sentence is that of the picture."""

import asyncio
import itertools
import re
import threading

import numpy as np
import pytest

import trackig_core as tig
from dashboard import formats, theme
from dashboard.compute import checker as checker_module
from dashboard.compute.checker import VerificationRunner, check
from dashboard.fields import PRESET_LABELS
from dashboard.figures.verification import (
    ComparisonFigure,
    DampingFigure,
    ElementFigure,
    ReceptanceFigure,
    TimeStepFigure,
)
from dashboard.session.inputs import GainDefinition
from dashboard.session.results import Outcome, SolutionSummary, VerifiedSummary
from dashboard.views.verify import Verify, largest
from tests.waiting import WAIT, until


@pytest.fixture
def outcome():
    return Outcome()


@pytest.fixture
def view(outcome):
    return Verify(outcome, GainDefinition(), lambda _: None)


def test_nothing_is_checked_that_nobody_looks_at(outcome, summary, monkeypatch):
    asked = []
    monkeypatch.setattr(
        checker_module, "check", lambda shown: asked.append(shown) or VerifiedSummary(shown, None, "x")
    )

    async def session():
        checker = VerificationRunner(outcome)
        outcome.summary = summary("slab-track")
        await asyncio.sleep(0.05)
        assert asked == []
        checker.look(True)
        await until(lambda: outcome.verified is not None)
        assert asked == [summary("slab-track")]
        outcome.summary = SolutionSummary.of(tig.solve(tig.PRESETS["slab-track"], "exact"), 0.002)
        await asyncio.sleep(0.2)
        assert asked == [summary("slab-track")], "an exact curve has no run to be checked"
        outcome.summary = summary("booted-sleeper")
        await until(lambda: outcome.verified.summary is summary("booted-sleeper"))

    asyncio.run(session())


def test_only_the_newest_picture_is_checked_next(outcome, summary, monkeypatch):
    go_on, asked = threading.Event(), []

    def slow(shown):
        asked.append(shown)
        go_on.wait(WAIT)
        return VerifiedSummary(shown, None, "x")

    monkeypatch.setattr(checker_module, "check", slow)

    async def session():
        checker = VerificationRunner(outcome)
        checker.look(True)
        outcome.summary = summary("slab-track")
        await until(lambda: asked)
        for name in ("booted-sleeper", "booted-block-low-mass", "booted-block-high-mass"):
            outcome.summary = summary(name)
        await asyncio.sleep(0.05)
        go_on.set()
        await until(lambda: outcome.verified is not None and outcome.verified.summary is outcome.summary)

    asyncio.run(session())
    assert asked == [summary("slab-track"), summary("booted-block-high-mass")]


def test_a_check_is_the_librarys(summary):
    shown = summary("booted-sleeper")
    verified = check(shown)
    assert verified.problem == ""
    expected = tig.verify(shown.solution)
    np.testing.assert_array_equal(verified.theory.exact.energy, expected.exact.energy)
    assert check(shown).theory is verified.theory
    stiffer = shown.of_design(shown.design.replace(pad_static_stiffness=200e6))
    assert (check(stiffer).summary, check(stiffer).theory) == (stiffer, verified.theory)


def test_a_track_without_exact_answer_says_why(outcome, view, fake_picture):
    without = tig.PRESETS["slab-track"].replace(pad_loss_factor=0.0)
    outcome.verified = check(fake_picture(without))
    assert "more than 0" in view.words["run"].object


@pytest.mark.parametrize("preset", ["booted-block-low-mass", "slab-track"])
def test_run_and_exact_answer_are_drawn_with_their_difference_in_words(outcome, view, summary, preset):
    outcome.verified = check(summary(preset))
    exact = tig.solve(tig.PRESETS[preset], "exact").insertion_gain
    data = view.comparison.bands.data
    np.testing.assert_allclose(data["exact"], exact, atol=1e-9)
    np.testing.assert_allclose(data["run"], summary(preset).solution.insertion_gain, atol=1e-9)
    np.testing.assert_allclose(data["difference"], data["run"] - data["exact"])
    ends = view.difference.model.y_range
    assert ends.start < data["difference"].min()
    assert data["difference"].max() < ends.end
    said, band = re.search(r"difference ([\d.]+) dB at ([\d.]+) Hz", view.words["run"].object).groups()
    worst = np.argmax(np.abs(data["difference"]))
    assert float(said) == pytest.approx(abs(data["difference"][worst]), abs=0.005)
    assert band == tig.BAND_LABELS[worst]


def test_the_checks_follow_the_choice_of_sum_and_reference(outcome, summary):
    definition = GainDefinition()
    view = Verify(outcome, definition, lambda _: None)
    outcome.verified = check(summary("booted-sleeper"))
    definition.param.update(reference="rigid", summation="coherent")
    expected = tig.solve(tig.PRESETS["booted-sleeper"], "exact", reference="rigid", summation="coherent")
    np.testing.assert_allclose(view.comparison.bands.data["exact"], expected.insertion_gain, atol=1e-9)
    assert "coherent / rigid" in view.comparison.model.yaxis.axis_label


def test_small_differences_are_told_as_they_are():
    differences = np.zeros(21)
    assert largest(differences) == "below 0.000001 dB"
    differences[3] = -0.00034
    assert largest(differences) == "0.0003 dB at 10 Hz"
    differences[5] = 0.116
    assert largest(differences) == "0.12 dB at 16 Hz"


@pytest.mark.parametrize("preset", list(tig.PRESETS))
def test_the_peer_stands_beside_the_twin(view, preset):
    view.peer.value = preset
    peer = tig.peer_receptances()[preset]
    np.testing.assert_allclose(view.receptance.peer.data["euler"], 1e12 * np.abs(peer.euler))
    np.testing.assert_allclose(view.receptance.peer.data["timoshenko"], 1e12 * np.abs(peer.timoshenko))
    own = view.receptance.solution.data
    at_peer = np.interp(np.log(peer.frequency), np.log(own["frequency"]), own["receptance"])
    np.testing.assert_allclose(at_peer[:10], 1e12 * np.abs(peer.euler)[:10], rtol=0.01)
    assert view.words["peer"].object.startswith(f"{PRESET_LABELS[preset]} as published, whatever the sliders")
    said = float(re.search(r"within ([\d.]+) dB", view.words["peer"].object).group(1))
    assert 0 < said < 0.07


@pytest.mark.parametrize("loss_factor", [1.05, 2.0])
def test_a_memory_that_does_not_hold_is_not_drawn(outcome, view, loss_factor):
    design = tig.PRESETS["booted-sleeper"].replace(boot_loss_factor=loss_factor)
    outcome.verified = check(SolutionSummary.of(tig.solve(design), 0.2))
    steps, ends = view.time_step.errors.data, view.time_step.model.y_range
    assert np.isnan(steps["first"]).any()
    np.testing.assert_array_equal(np.isnan(steps["one"]), [loss_factor == 2.0] * steps["one"].size)
    assert 0 < ends.start < steps["second"].min() < steps["second"].max() < ends.end
    theory, grid = outcome.verified.theory, outcome.verified.summary.solution.grid
    error = np.interp(grid.dt, theory.time_steps, theory.second_order_errors)
    assert f"{formats.difference_text(error)} at this run's time step" in view.words["convergence"].object


def test_convergence_is_drawn_with_its_slopes(outcome, view, summary):
    shown = summary("booted-sleeper")
    outcome.verified = check(shown)
    theory, grid = outcome.verified.theory, shown.solution.grid
    steps = view.time_step.errors.data
    np.testing.assert_array_equal(steps["first"], theory.first_order_errors)
    np.testing.assert_array_equal(steps["second"], theory.second_order_errors)
    np.testing.assert_allclose(steps["one"] / steps["first"], 0.5, atol=0.1)
    np.testing.assert_allclose(steps["two"] / steps["second"], 0.5, atol=0.15)
    assert view.time_step.model.select_one({"name": "run_time_step"}).location == pytest.approx(1e6 * grid.dt)
    lengths = view.element.errors.data
    np.testing.assert_allclose(lengths["length"], 1000 * 0.75 / theory.elements_per_bay)
    assert view.element.model.select_one({"name": "run_element"}).location == pytest.approx(250)


def test_dots_at_the_ends_of_convergence_are_whole(outcome, view, summary):
    low_frame = 150  # px of the 300 px of a figure that axis, legend and title leave at worst
    for name in tig.PRESETS:
        outcome.verified = check(summary(name))
        for figure, across, *heights in (
            (view.time_step, "step", "first", "second"),
            (view.element, "length", "error"),
        ):
            data = figure.errors.data
            for ends, values in (
                (figure.model.x_range, data[across]),
                (figure.model.y_range, np.concatenate([data[key] for key in heights])),
            ):
                decades = np.log(ends.end / ends.start)
                room = np.log([values.min() / ends.start, ends.end / values.max()]) / decades
                assert (low_frame * room > theme.DOT_SIZE / 2).all()
                # and the curves fill most of what is there
                assert (room < 0.2).all()


def test_damping_is_drawn_against_what_was_stated(outcome, view, summary):
    outcome.verified = check(summary("booted-sleeper"))
    loss, stiffness = view.loss_factor.values.data, view.stiffness.values.data
    assert np.abs(loss["pad"] / 0.2 - 1).max() < 0.051
    np.testing.assert_array_equal(loss["boot_stated"], 0.2)
    at_50 = np.interp(50, stiffness["frequency"], stiffness["boot"])
    assert at_50 == pytest.approx(1, abs=1e-3)
    assert "within 4.9%" in view.words["damping"].object
    outcome.verified = check(summary("slab-track"))
    assert np.isnan(view.loss_factor.values.data["boot"]).all()
    np.testing.assert_array_equal(view.loss_factor.values.data["pad_stated"], 0.15)


def test_ticks_of_convergence_are_plain_numbers_far_apart():
    for figure in (TimeStepFigure(), ElementFigure()):
        ticks = figure.model.xaxis[0].ticker.ticks
        assert min(later / tick for tick, later in itertools.pairwise(ticks)) >= 2
        assert figure.model.xaxis[0].major_label_overrides[200] == "200"


def test_no_legend_of_a_figure_lies_over_its_curves():
    figures = (
        ComparisonFigure(),
        ReceptanceFigure(),
        TimeStepFigure(),
        ElementFigure(),
        DampingFigure("stiffness", "Stiffness"),
    )
    for figure in figures:
        assert [legend in figure.model.above for legend in figure.model.legend] == [True]
