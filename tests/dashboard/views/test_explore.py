"""Views in process: the status line, the frequencies, the three pictures."""

import dataclasses

import numpy as np
import pytest

import trackig_core as tig
from dashboard import theme
from dashboard.fields import PRESET_LABELS
from dashboard.formats import duration_text
from dashboard.session.assessment import Assessment
from dashboard.session.inputs import DesignInputs, GainDefinition
from dashboard.session.pins import Pins
from dashboard.session.results import Outcome, SolutionSummary
from dashboard.views.explore import Explore
from dashboard.views.frequencies import Frequencies, frequencies_html, statics_html
from dashboard.views.status import Status, status_html, status_words


@pytest.fixture
def outcome():
    return Outcome()


@pytest.fixture
def explore(make_pictures):
    """Return a function that makes the view, with pins and pictures of theirs if a test gives them."""

    def make(outcome, definition, pins=None, pinned=None):
        pins, pinned = pins or Pins(), pinned or make_pictures()
        assessment = Assessment(DesignInputs(), outcome, definition, pins, pinned)
        return Explore(outcome, definition, pins, assessment)

    return make


def test_the_status_follows_a_solve(outcome, summary):
    status = Status(outcome, lambda *_: None, lambda *_: None)
    assert "Not solved yet" in status.text.object
    outcome.busy = True
    assert "Solving …" in status.text.object
    shown = summary("slab-track")
    outcome.param.update(summary=shown, busy=False)
    assert f"Paper&#x27;s run, solved in {duration_text(shown.seconds)}" in status.text.object
    outcome.from_cache = True
    assert "solved before" in status.text.object


def test_the_status_and_a_chip_say_which_fidelity_is_on_screen(explore, outcome, fake_picture, summary):
    view, design = explore(outcome, GainDefinition()), summary("slab-track").design
    outcome.summary = fake_picture(design, fidelity="live", notes=("17 bays",))
    assert status_words(outcome).startswith("Live run, solved in")
    assert status_words(outcome).endswith("17 bays")
    assert view.fidelity.label == "live run"
    outcome.summary = summary("slab-track")
    assert status_words(outcome).startswith("Paper's run, solved in")
    assert view.fidelity.label == "paper's run"


def test_an_exact_curve_leaves_the_last_force_dimmed_until_a_run_is_there(
    explore, outcome, fake_picture, summary
):
    view, stepped = explore(outcome, GainDefinition()), summary("slab-track")
    outcome.summary = stepped
    force = view.force.samples.data
    exact = SolutionSummary.of(tig.solve(summary("booted-sleeper").design, "exact"), 0.002)
    outcome.summary = exact
    assert view.fidelity.label == "exact curve"
    assert status_words(outcome).startswith("Exact curve; its force follows")
    assert view.insertion_gain.bands.data["level"] == pytest.approx(exact.solution.insertion_gain)
    assert view.force.samples.data is force
    gain_pane, force_pane = view.panes
    assert (gain_pane.styles, force_pane.styles) == (theme.FRESH, theme.STALE)
    outcome.summary = fake_picture(exact.design, fidelity="live")
    assert view.force.samples.data is not force
    assert force_pane.styles == theme.FRESH


def test_notes_of_the_solution_are_told(outcome, fake_picture, summary):
    design = summary("slab-track").design
    outcome.summary = fake_picture(design, notes=("time step halved once", "record extended"))
    assert status_words(outcome).endswith(" · time step halved once · record extended")


def test_a_problem_is_told_before_the_old_picture(outcome, summary):
    outcome.param.update(summary=summary("slab-track"), problem="The solver failed.")
    assert status_words(outcome) == "The solver failed."
    assert 'class="problem"' in status_html(outcome)


def test_a_problem_is_forgotten_while_the_next_solve_runs(outcome):
    outcome.param.update(problem="The solver failed.", busy=True)
    assert status_words(outcome) == "Solving …"
    assert 'class="problem"' not in status_html(outcome)


def test_no_text_becomes_markup(outcome):
    outcome.problem = "pad_stiffness = '<img src=x onerror=alert(1)>'"
    assert "<img" not in status_html(outcome)


def test_only_a_long_solve_shows_progress_and_can_be_stopped(outcome):
    stopped = []
    status = Status(outcome, stopped.append, lambda *_: None)
    outcome.busy = True
    assert not status.stop.visible
    outcome.progress = 0.42
    assert status.stop.visible
    assert status.progress.visible
    assert status.progress.value == 42
    status.stop.param.trigger("clicks")
    assert len(stopped) == 1
    outcome.param.update(busy=False, progress=None)
    assert not status.stop.visible
    assert not status.progress.visible


def test_what_was_not_solved_can_be_solved_after_all(outcome):
    asked = []
    status = Status(outcome, lambda *_: None, asked.append)
    assert not status.solve.visible
    outcome.problem = "Stopped."
    assert status.solve.visible
    status.solve.param.trigger("clicks")
    assert len(asked) == 1
    outcome.busy = True
    assert not status.solve.visible


def test_pictures_of_earlier_inputs_are_dimmed(explore, outcome, summary):
    outcome.summary = summary("slab-track")
    view = explore(outcome, GainDefinition())
    looks = (*view.panes, view.frequencies.pane)
    for changes, dimmed in (
        ({"problem": "Stopped."}, True),
        ({"problem": ""}, False),
        ({"progress": 0.1}, True),
    ):
        outcome.param.update(**changes)
        assert [float(pane.styles["opacity"]) < 1 for pane in looks] == [dimmed] * 3


def test_frequencies_are_those_of_the_solution(outcome, summary):
    view = Frequencies(outcome)
    assert view.pane.object == ""
    outcome.summary = summary("booted-block-low-mass")
    natural = outcome.summary.solution.natural_frequencies
    for frequency in (natural.loaded_track, natural.coupled_block, natural.block_on_boot, *natural.cut_on):
        digits = f"{frequency:.1f}" if frequency < 100 else f"{frequency:.0f}"
        assert f">{digits} Hz<" in view.pane.object


def test_a_single_stage_track_says_that_it_has_no_block(summary):
    natural = summary("slab-track").solution.natural_frequencies
    text = frequencies_html(natural)
    assert "one stage" in text
    assert "boot" not in text


def test_all_pictures_are_redrawn_together(explore, outcome, summary):
    view = explore(outcome, GainDefinition())
    for preset in ("booted-block-low-mass", "slab-track"):
        outcome.param.update(summary=summary(preset), preset_summary=summary("booted-sleeper"))
        solution = summary(preset).solution
        np.testing.assert_array_equal(view.insertion_gain.bands.data["level"], solution.insertion_gain)
        peak = summary(preset).total_force.max()
        assert view.force.samples.data["total"].max() == pytest.approx(peak, rel=1e-6)
        assert f"{solution.natural_frequencies.loaded_track:.1f}"[:3] in view.frequencies.pane.object
    ghost = summary("booted-sleeper").solution.insertion_gain
    np.testing.assert_array_equal(view.insertion_gain.bands.data["preset"], ghost)


def test_a_view_made_late_shows_what_is_there(explore, outcome, summary):
    outcome.summary = summary("slab-track")
    view = explore(outcome, GainDefinition())
    np.testing.assert_array_equal(
        view.insertion_gain.bands.data["level"], outcome.summary.solution.insertion_gain
    )


def test_the_choice_of_sum_and_reference_redraws_without_solving(explore, outcome, summary):
    definition = GainDefinition()
    outcome.param.update(summary=summary("booted-sleeper"), preset_summary=summary("slab-track"))
    view = explore(outcome, definition)
    for choice in ({"summation": "coherent"}, {"reference": "rigid"}):
        definition.param.update(**choice)
        chosen = {"reference": definition.reference, "summation": definition.summation}
        for column, name in (("level", "booted-sleeper"), ("preset", "slab-track")):
            expected = tig.solve(tig.PRESETS[name], **chosen).insertion_gain
            np.testing.assert_allclose(view.insertion_gain.bands.data[column], expected, atol=1e-9)
    assert view.insertion_gain.model.yaxis.axis_label == "IG, dB (coherent / rigid)"


def test_observed_frequencies_stand_beside_the_computed_ones(summary):
    natural = summary("booted-block-low-mass").solution.natural_frequencies
    text = frequencies_html(dataclasses.replace(natural, observed_loaded_track=38.7))
    assert "Observed in the run: 38.7 Hz" in text
    assert "Observed in the run: 301 Hz" in text
    assert text.count("Observed") == 2
    assert frequencies_html(dataclasses.replace(natural, observed_coupled_block=None)).count("Observed") == 1


def test_pins_that_are_shown_are_drawn_behind_the_design(explore, outcome, summary, make_pictures):
    pins, pinned = Pins(), make_pictures()
    one, other = pins.add_all([(tig.PRESETS[key], key, key) for key in ("slab-track", "booted-sleeper")])
    outcome.summary = summary("booted-block-low-mass")
    view = explore(outcome, GainDefinition(), pins, pinned)
    assert np.isnan(view.insertion_gain.pins.data["pin_0"]).all()
    pinned.summaries = {one.key: summary("slab-track"), other.key: summary("booted-sleeper")}
    for place, key in enumerate(("slab-track", "booted-sleeper")):
        drawn = view.insertion_gain.pins.data[f"pin_{place}"]
        np.testing.assert_array_equal(drawn, summary(key).solution.insertion_gain)
        peak = summary(key).total_force.max()
        assert view.force.pins[place].data["total"].max() == pytest.approx(peak, rel=1e-6)
    pins.show(one.key, shown=False)
    drawn = view.insertion_gain.pins.data["pin_0"]
    np.testing.assert_array_equal(drawn, summary("booted-sleeper").solution.insertion_gain)
    assert not len(view.force.pins[1].data["time"])


def test_a_specification_is_drawn_as_a_limit_as_soon_as_it_is_given(outcome, summary, make_pictures):
    definition, pins = GainDefinition(), Pins()
    outcome.summary = summary("booted-block-low-mass")
    assessment = Assessment(DesignInputs(), outcome, definition, pins, make_pictures())
    view = Explore(outcome, definition, pins, assessment)
    band = tig.BAND_LABELS.index("63")
    assessment.specification = tig.Specification([(63, -3.0)])
    assert view.insertion_gain.limit.data["limit"][band] == -3.0
    assessment.specification = tig.Specification([(63, -4.0)])
    assert view.insertion_gain.limit.data["limit"][band] == -4.0
    assessment.specification = None
    assert np.isnan(view.insertion_gain.limit.data["limit"]).all()


def test_the_papers_figure_2_is_four_curves_and_nothing_else(explore, outcome, summary, make_pictures):
    pins, definition = Pins(), GainDefinition()
    pins.add(tig.PRESETS["slab-track"].replace(pad_stiffness=500e6), "of my own")
    outcome.summary = summary("booted-block-low-mass")
    view = explore(outcome, definition, pins, make_pictures())
    pins.show_table_1()
    assert [pin.design for pin in pins.shown] == list(tig.PRESETS.values())
    view = explore(
        outcome,
        definition,
        pins,
        make_pictures(summaries={pin.key: summary(pin.preset) for pin in pins.shown}),
    )
    names = list(view.insertion_gain.legend.listed)
    assert names == list(PRESET_LABELS.values())
    assert not any(marker.visible for marker in view.insertion_gain.model.select({"name": "loaded_track"}))
    assert view.show_current.visible
    view.show_current.param.trigger("clicks")
    assert not pins.alone
    names = list(view.insertion_gain.legend.listed)
    assert names[0] == "this design"


def test_statics_stand_beside_the_natural_frequencies(session):
    session.show("booted-block-low-mass")
    view = Frequencies(session.outcome, session.assessment)
    sinks = tig.static_response(session.assessment.current.design)
    assert f"<small>at least</small> {1e3 * sinks.rail_deflection:.2f} mm" in view.pane.object
    assert "the static stiffness of the pad and the boot is not stated" in view.pane.object
    session.inputs.wheel_load = 112.5
    heavier = tig.static_response(session.assessment.current.design, 112.5e3)
    assert f"{1e3 * heavier.rail_deflection:.2f} mm" in view.pane.object
    assert f"{1e-3 * heavier.largest_seat_load:.3g} kN" in view.pane.object


def test_a_stated_static_stiffness_leaves_no_bound():
    stated = tig.PRESETS["slab-track"].replace(pad_static_stiffness=500e6)
    text = statics_html(tig.static_response(stated, 85e3, 2.5))
    assert "<small>" not in text
    assert "two wheels of 85 kN" in text
