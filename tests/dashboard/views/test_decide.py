"""The tab Decide: every figure on it is the library's, in the units of the sliders."""

import asyncio

import numpy as np
import pytest

import trackig_core as tig
from dashboard.fields import FIELDS
from dashboard.session.assessment import Assessment
from dashboard.session.inputs import DesignInputs, GainDefinition
from dashboard.session.pins import Pins
from dashboard.session.results import Outcome
from dashboard.views.decide import NO_SPECIFICATION, Decide, where

WAIT = 60
LIMITS = tig.Specification(
    [(31.5, 15.0), (63, -4.0), (125, -6.0), (250, -14.0)], rail_deflection_limit=2.5e-3
)
BLOCK = tig.PRESETS["booted-block-low-mass"]


class Session:
    """The tab with a solved design."""

    def __init__(self, summary, make_pictures, specification):
        self.inputs, self.definition, self.pins = DesignInputs(), GainDefinition(), Pins()
        self.pinned = make_pictures()
        outcome = Outcome(summary=summary("booted-block-low-mass"))
        self.assessment = Assessment(self.inputs, outcome, self.definition, self.pins, self.pinned)
        self.assessment.specification = specification
        self.view = Decide(self.inputs, self.definition, self.pins, self.assessment)

    def do(self, action, *arguments, **values):
        """Call something on an event loop, and wait for all that it set going."""

        async def acted():
            action(*arguments, **values)
            async with asyncio.timeout(WAIT):
                while tasks := asyncio.all_tasks() - {asyncio.current_task()}:
                    await asyncio.wait(tasks)

        asyncio.run(acted())


@pytest.fixture
def session(summary, make_pictures):
    return Session(summary, make_pictures, LIMITS)


def test_nothing_is_asked_that_nobody_looks_at(session):
    session.do(session.assessment.param.trigger, "results")
    assert session.view.how_far.inquiry.asked is None


def test_without_a_specification_it_says_what_to_do(summary, make_pictures):
    session = Session(summary, make_pictures, None)
    session.do(session.view.look, active=True)
    assert NO_SPECIFICATION in session.view.how_far.sentence.object
    # what matters can be said all the same
    assert "rail deflection depends most on" in session.view.what_matters.sentence.object


def test_ranges_are_the_library_s_in_the_units_of_the_sliders(session):
    session.do(session.view.look, active=True)
    view = session.view.how_far
    expected = tig.decide.feasible_ranges(BLOCK, LIMITS, fields=list(FIELDS))
    assert dict(view.inquiry.result) == dict(expected)
    (low, high), *_ = expected["boot_stiffness"]
    assert f"{high / 1e6:.4g} kN/mm" in view.table.object
    assert "kN/mm" in view.sentence.object
    assert "mm" in view.sentence.object, "how far the rail sinks"
    assert where(expected, "boot_stiffness") in view.table.object
    assert low < high


def test_the_table_follows_the_specification(session):
    session.do(session.view.look, active=True)
    before = session.view.how_far.table.object
    session.do(session.assessment.param.update, specification=tig.Specification([(63, 20.0)]))
    assert session.view.how_far.table.object != before
    assert "everywhere" in session.view.how_far.table.object


def test_what_matters_is_drawn_as_computed(session):
    session.do(session.view.look, active=True)
    view = session.view.what_matters
    expected = tig.decide.sensitivity(BLOCK, LIMITS, changes=dict.fromkeys(FIELDS, 0.1))
    cells = view.changes.cells.data
    for row, name in enumerate(FIELDS):
        mine = [each == FIELDS[name].label for each in cells["field"]]
        np.testing.assert_array_equal(np.array(cells["change"])[mine], expected.bands[row, 1])
    first = expected.ranked("margin")[0]
    assert view.tornado.bars.data["field"][0] == FIELDS[first].label
    assert (
        view.tornado.bars.data["less"][0] == expected.differences["margin"][expected.fields.index(first), 0]
    )
    session.do(view.figure.param.update, value="deflection")
    assert view.tornado.model.xaxis.axis_label == "Change of: Rail deflection, mm"
    row = expected.fields.index(expected.ranked("deflection")[0])
    assert view.tornado.bars.data["more"][0] == pytest.approx(
        1e3 * expected.differences["deflection"][row, 1]
    )


def test_production_is_the_library_s(session):
    view = session.view.how_sure
    view.samples.value = 1000
    session.do(view.ask)
    shares = {name: {"uniform": box.value / 100} for name, box in view.tolerances.items()}
    question = tig.decide.Question(
        "tolerance", BLOCK, {"tolerances": shares, "samples": 1000, "seed": 0}, specification=LIMITS
    )
    expected = question.ask()
    assert view.inquiry.result.complying == expected.complying
    np.testing.assert_array_equal(view.percentiles.bands.data["high"], expected.percentiles[2])
    np.testing.assert_array_equal(view.percentiles.bands.data["limit"], LIMITS.levels)
    assert "of production" in view.sentence.object
    for box in view.tolerances.values():
        box.value = 0.0
    session.do(view.ask)
    assert "Give one of the tolerances" in view.sentence.object


def test_a_tap_on_the_map_takes_the_design_there(session):
    view = session.view.map
    session.do(view.ask)
    found = view.inquiry.result
    view._tapped(20.0, 100.0)
    taken = session.inputs.to_design()
    expected = found.design_at(20e6, 100.0)
    assert taken.boot_stiffness == pytest.approx(expected.boot_stiffness, rel=1e-5)
    assert taken.block_mass == pytest.approx(expected.block_mass, rel=1e-5)
    assert taken.pad_stiffness == BLOCK.pad_stiffness


def test_a_map_shows_both_edges_and_the_pins(session, summary):
    pin = session.pins.add(tig.PRESETS["booted-block-high-mass"], "Heavy <b>")
    session.pinned.summaries = {pin.key: summary("booted-block-high-mass")}
    session.do(session.view.map.ask)
    drawn = session.view.map.map
    edges = ("just complies", "sinks just as far as allowed")
    assert drawn.legend.listed == (*edges, "This design", "Heavy <b>")
    assert len(drawn.model.renderers) == 1 + len(drawn.legend.listed)
    assert "Heavy &lt;b&gt;" in drawn.legend.model.text
    assert not drawn.model.legend


def test_a_search_is_drawn_taken_and_pinned(session):
    view = session.view.search
    session.do(view.ask)
    found = view.inquiry.result
    assert found.front.size
    data = view.cloud.designs.data
    best = int(np.flatnonzero(data["row"] == found.front[0])[0])
    assert data["y"][best] == pytest.approx(1e3 * found.values[found.front[0], 1])
    assert view.take.disabled
    view.cloud.designs.selected.indices = [best]
    assert not view.take.disabled
    expected = found.many.design(int(found.front[0]))
    levels = view.cloud.curves.data["ys"][0]
    np.testing.assert_allclose(levels, tig.solve(expected, "exact").insertion_gain, atol=0.01)
    view.take.param.trigger("clicks")
    view.pin.param.trigger("clicks")
    assert session.inputs.boot_stiffness == pytest.approx(expected.boot_stiffness / 1e6, rel=1e-5)
    assert session.pins.pinned[0].design == session.inputs.to_design()


def test_with_nothing_free_it_says_what_to_do(session):
    session.view.search.free.value = []
    session.do(session.view.search.ask)
    assert "Choose which numbers are free" in session.view.search.sentence.object
