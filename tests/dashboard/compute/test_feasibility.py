"""Where the current design complies: asked when inputs change, and never shown of another design."""

import numpy as np
import pytest

import trackig_core as tig
from dashboard.compute.feasibility import Feasibility, shown_stretches, where
from dashboard.fields import FIELDS
from dashboard.session.assessment import Assessment
from dashboard.session.inputs import DesignInputs, GainDefinition
from dashboard.session.pins import Pins
from dashboard.session.results import Outcome
from dashboard.session.shelf import Shelf
from dashboard.views.sidebar import Controls
from tests.waiting import on_a_loop

LIMITS = tig.Specification([(63, -4.0), (125, -6.0)], rail_deflection_limit=2.5e-3)
BLOCK = tig.PRESETS["booted-block-low-mass"]
OWN = [name for name in FIELDS if not FIELDS[name].whose]


class Page:
    """A sidebar that nobody has solved anything for."""

    def __init__(self, pictures):
        self.inputs, self.definition = DesignInputs(), GainDefinition()
        self.assessment = Assessment(self.inputs, Outcome(), self.definition, Pins(), pictures)
        self.feasibility = Feasibility(self.inputs, self.definition, self.assessment)
        self.panel = Controls(self.inputs, Outcome(), Shelf(), feasibility=self.feasibility).quantities

    def do(self, **changes):
        """Change inputs or the specification, and wait until everything rests."""

        def change():
            for name, value in changes.items():
                setattr(self.assessment if name == "specification" else self.inputs, name, value)

        on_a_loop(change)


@pytest.fixture
def page(make_pictures):
    return Page(make_pictures())


def test_without_a_specification_nothing_is_drawn(page):
    page.do(block_mass=50.0)
    assert (page.panel.feasible, page.panel.stale) == ({}, False)


def test_sliders_follow_inputs_without_any_solution(page):
    page.do(specification=LIMITS)
    page.do(block_mass=100.0)
    expected = tig.decide.feasible_ranges(BLOCK.replace(block_mass=100.0), LIMITS)
    assert page.panel.feasible == {name: shown_stretches(expected, name) for name in OWN}
    assert not page.panel.stale
    page.do(specification=None)
    assert (page.panel.feasible, page.panel.stale) == ({}, False)


def test_static_stiffness_is_asked_about_only_where_deflection_is_limited(page):
    asked = []
    page.feasibility.param.watch(lambda event: asked.append(event.new.design), "asked")
    page.do(specification=tig.Specification([(63, -4.0)]))
    page.do(pad_static_stiffness=80.0)
    page.do(specification=LIMITS)
    page.do(pad_static_stiffness=90.0)
    stated = [BLOCK.replace(pad_static_stiffness=each) for each in (80e6, 90e6)]
    assert list(dict.fromkeys(asked)) == [BLOCK, *stated]


def test_a_limit_of_deflection_alone_bounds_what_the_rail_sinks_by(page):
    """What the rail sinks by falls with stiffness, and does not depend on masses or damping."""
    limit = tig.static_response(BLOCK.replace(boot_stiffness=20e6)).rail_deflection
    page.do(specification=tig.Specification([], rail_deflection_limit=limit))
    [(low, high)] = page.panel.feasible["boot_stiffness"]
    # edges are found to 0.1 %
    assert (low, high) == (pytest.approx(20.0, rel=1e-3), FIELDS["boot_stiffness"].high)
    page.feasibility.given = True
    page.do()
    for name in ("block_mass", "wheel_mass", "boot_loss_factor"):
        assert page.panel.feasible[name] == [(FIELDS[name].low, FIELDS[name].high)]


def test_what_is_of_an_earlier_design_is_marked_until_the_answer_is_there(page):
    page.do(specification=LIMITS)
    stale = []
    page.panel.param.watch(lambda event: stale.append((event.new, page.feasibility.result.design)), "stale")
    page.do(block_mass=100.0)
    heavy = BLOCK.replace(block_mass=100.0)
    assert stale == [(True, BLOCK), (False, heavy)]
    # to and fro within a moment: what is shown is right at once
    page.do(block_mass=100.0)
    assert stale[2:] == []


def test_ground_that_was_not_solved_yet_is_asked_about_against_the_stiff_track(page):
    clay = tig.GROUNDS["soft clay"]
    page.do(specification=LIMITS)
    page.do(ground=clay)
    assert page.feasibility.problem == ""
    assert page.feasibility.answered.reference == "stiff"
    expected = tig.decide.feasible_ranges(BLOCK.replace(ground=clay), LIMITS, reference="stiff")
    assert page.panel.feasible == {name: shown_stretches(expected, name) for name in OWN}


def test_a_single_stage_has_no_boot_to_be_asked_about(page):
    page.do(specification=LIMITS, two_stage=False)
    assert set(page.panel.feasible) == {name for name in OWN if not FIELDS[name].second_stage}


def test_a_refusal_takes_the_stretches_away(page, monkeypatch):
    page.do(specification=LIMITS)

    def refuse(*_, **__):
        raise ValueError("there is no such track")

    monkeypatch.setattr(tig.decide.Question, "ask", refuse)
    page.do(block_mass=100.0)
    assert page.panel.feasible == {}
    assert "no such track" in page.feasibility.problem


def test_the_edges_that_are_shown_comply():
    found = tig.decide.feasible_ranges(BLOCK, LIMITS)
    required = tig.decide.Requirements(LIMITS)
    assert any(found[name] for name in OWN)
    for name in OWN:
        edges = [edge for stretch in shown_stretches(found, name) for edge in stretch]
        assert len(edges) == 2 * len(found[name])
        if edges:
            many = tig.solve_many(BLOCK, **{name: np.array(edges) * FIELDS[name].factor})
            assert required.complies(many).all(), name
        for (low, high), (begin, end) in zip(found[name], shown_stretches(found, name), strict=True):
            shown = np.array([begin, end]) * FIELDS[name].factor
            np.testing.assert_allclose(shown, [low, high], rtol=2e-3)


def test_words_name_the_ends_that_are_edges():
    found = tig.decide.feasible_ranges(BLOCK, LIMITS)
    for name in OWN:
        words = where(found, name)
        assert ("nowhere" in words) == (found[name] == ())
    easy = tig.decide.feasible_ranges(BLOCK, tig.Specification([(63, 30.0)]))
    assert where(easy, "block_mass") == "everywhere"
