"""The tab Decide: every figure on it is the library's, in the units of the sliders."""

import csv
import dataclasses
import html
import json
import re
from types import SimpleNamespace

import numpy as np
import pytest
from bokeh.models import ColorBar
from bokeh.palettes import Viridis256

import trackig_core as tig
from dashboard.compute.feasibility import Feasibility, where
from dashboard.fields import FIELDS
from dashboard.formats import millimetre_text
from dashboard.persistence.snapshot import SessionSnapshot
from dashboard.session.assessment import Assessment
from dashboard.session.inputs import DesignInputs, GainDefinition
from dashboard.session.pins import Pins
from dashboard.session.production import Production
from dashboard.session.results import Outcome
from dashboard.session.shelf import Shelf
from dashboard.views.decide.asked import NO_SPECIFICATION
from dashboard.views.decide.inputs import NumberBox, percent_box, seed_box
from dashboard.views.decide.search import chosen_words
from dashboard.views.decide.tab import Decide
from dashboard.views.decide.what_matters import starred
from tests.core.decide.test_search import CATALOGUE
from tests.waiting import on_a_loop

LIMITS = tig.Specification(
    [(31.5, 15.0), (63, -4.0), (125, -6.0), (250, -14.0)], rail_deflection_limit=2.5e-3
)
BLOCK = tig.PRESETS["booted-block-low-mass"]


class Session:
    """The tab with a solved design."""

    def __init__(self, summary, make_pictures, specification):
        self.inputs, self.definition, self.pins = DesignInputs(), GainDefinition(), Pins()
        self.pinned = make_pictures()
        self.outcome = Outcome(summary=summary("booted-block-low-mass"))
        self.assessment = Assessment(self.inputs, self.outcome, self.definition, self.pins, self.pinned)
        self.assessment.specification = specification
        self.snapshot = SessionSnapshot(self.inputs, self.definition, self.pins, self.assessment)
        self.keys = {}
        self.saved, self.production, self.shelf = [], Production(), Shelf()
        self.exchange = SimpleNamespace(
            save=lambda *file: self.saved.append(file),
            introduce=lambda: None,
            on_key=self.keys.__setitem__,
        )
        self.do(self._make)

    def _make(self):
        self.feasibility = Feasibility(self.inputs, self.definition, self.assessment)
        self.view = Decide(self.snapshot, self.exchange, self.feasibility, self.production, self.shelf)

    def do(self, action, *arguments, **values):
        """Call something on an event loop, and wait for all that it set going."""
        on_a_loop(action, *arguments, **values)


@pytest.fixture
def session(summary, make_pictures):
    return Session(summary, make_pictures, LIMITS)


def test_nothing_is_asked_that_nobody_looks_at(session):
    session.do(session.assessment.param.trigger, "results")
    assert session.view.what_matters.inquiry.asked is None


@pytest.mark.parametrize("name", ["how_sure", "what_scatters", "map", "search"])
def test_before_it_is_asked_a_question_says_what_to_press_and_draws_nothing(session, name):
    view = getattr(session.view, name)
    assert f"ress “{view.button.label}”" in view.sentence.object
    if hasattr(view, "place"):
        assert view.place.objects == []
        session.do(view.ask)
        assert len(view.place.objects) == 1
    else:
        session.do(view.ask)
    assert "ress “" not in view.sentence.object


@pytest.mark.parametrize("name", ["how_sure", "what_scatters", "map", "search"])
def test_an_answer_says_that_the_design_has_changed_and_no_longer_once_that_is_undone(session, summary, name):
    view = getattr(session.view, name)
    session.do(session.view.look, active=True)
    session.do(view.ask)
    answered = view.sentence.object
    before, after = session.outcome.summary, summary("slab-track")
    session.do(session.outcome.param.update, summary=after)
    assert "Before the last changes: " in view.sentence.object
    assert f"Press “{view.button.label}” to ask again." in view.sentence.object
    session.do(session.outcome.param.update, summary=before)
    assert view.sentence.object == answered
    session.do(session.definition.param.update, summation="coherent")
    assert "Before the last changes: " in view.sentence.object
    session.do(view.ask)
    assert "Before the last changes: " not in view.sentence.object


def test_without_a_specification_it_says_what_to_do(summary, make_pictures):
    session = Session(summary, make_pictures, None)
    session.do(session.view.look, active=True)
    assert NO_SPECIFICATION in session.view.how_far.sentence.object
    session.do(session.view.map.ask)
    assert NO_SPECIFICATION in session.view.map.sentence.object
    assert session.view.map.inquiry.asked is None
    # what matters can be said all the same
    assert "rail deflection depends most on" in session.view.what_matters.sentence.object


def test_nothing_is_held_against_limits_of_which_it_is_open_what_they_are(session):
    session.do(session.view.look, active=True)
    asked = tig.Specification.given([(63, 4.0)], set_aside=("630 Hz",))
    session.do(session.assessment.param.update, specification=asked)
    words = "Answer first, in the tab Specification: no limit is below 0 dB"
    assert words in session.view.how_far.sentence.object
    assert session.view.how_far.table.object == ""
    for each in (session.view.map, session.view.how_sure, session.view.search):
        session.do(each.ask)
        assert words in each.sentence.object
        assert each.inquiry.asked is None
    assert "Governing margin" not in session.view.what_matters.sentence.object
    session.do(session.assessment.param.update, specification=asked.kept())
    assert "The design" in session.view.how_far.sentence.object
    assert "1 not judged, of no band from 5 to 500 Hz: 630 Hz" in session.view.how_far.sentence.object


def test_ranges_are_the_library_s_in_the_units_of_the_sliders(session):
    session.do(session.view.look, active=True)
    view = session.view.how_far
    expected = tig.decide.feasible_ranges(BLOCK, LIMITS)
    assert dict(view.inquiry.result) == dict(expected)
    assert "vehicle" not in view.table.object + view.sentence.object
    session.do(view.given.param.update, value=True)
    assert list(view.inquiry.result) == list(FIELDS)
    assert "Unsprung wheel mass (vehicle)" in view.table.object
    session.do(view.given.param.update, value=False)
    (low, high), *_ = expected["boot_stiffness"]
    shown = float(re.search(r"to ([\d.]+) kN/mm", where(expected, "boot_stiffness"))[1])
    # the number itself complies, and no greater one of as many figures
    assert 0.999 * high <= shown * 1e6 <= high
    many = tig.solve_many(BLOCK, boot_stiffness=np.array([shown, shown + 0.02]) * 1e6)
    assert list(tig.decide.Requirements(LIMITS).complies(many)) == [True, False]
    assert f"to {shown:g} kN/mm" in view.table.object
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
        mine = [each == starred(name) for each in cells["field"]]
        np.testing.assert_array_equal(np.array(cells["change"])[mine], expected.bands[row, 1])
    first = expected.ranked("margin")[0]
    assert view.tornado.bars.data["field"][0] == starred(first)
    assert (starred("wheel_mass"), starred("block_mass")) == ("Unsprung wheel mass *", "Block mass")
    own, given = expected.first("margin")
    assert f"depends most on the {FIELDS[own].label.lower()}: 10 % less" in view.sentence.object
    assert "Of the track's own numbers, the " in html.unescape(view.sentence.object)
    assert (given == "wheel_mass") == (
        "more on the unsprung wheel mass (vehicle), which" in view.sentence.object
    )
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
    shares = {name: {"uniform": box.number / 100} for name, box in view.tolerances.boxes.items()}
    question = tig.decide.Question(
        "tolerance", BLOCK, {"tolerances": shares, "samples": 1000, "seed": 0}, specification=LIMITS
    )
    expected = question.ask()
    assert view.inquiry.result.complying == expected.complying
    np.testing.assert_array_equal(view.percentiles.bands.data["high"], expected.percentiles[2])
    np.testing.assert_array_equal(view.percentiles.bands.data["limit"], LIMITS.levels)
    assert "of production" in view.sentence.object
    for box in view.tolerances.boxes.values():
        box.value = "0"
    session.do(view.ask)
    assert "Give one of the tolerances" in view.sentence.object


def test_a_tap_on_the_map_takes_the_design_there(session):
    view = session.view.map
    session.do(view.ask)
    found = view.inquiry.result
    session.do(view._tapped, 20.0, 100.0)
    taken = session.inputs.to_design()
    expected = found.design_at(20e6, 100.0)
    assert taken.boot_stiffness == pytest.approx(expected.boot_stiffness, rel=1e-5)
    assert taken.block_mass == pytest.approx(expected.block_mass, rel=1e-5)
    assert taken.pad_stiffness == BLOCK.pad_stiffness


def test_a_design_that_is_taken_from_an_answer_leaves_it_as_it_is_and_another_wheel_does_not(
    session, fake_picture
):
    def solve():
        session.outcome.summary = fake_picture(session.inputs.to_design())

    session.do(session.view.look, active=True)
    design_map, search = session.view.map, session.view.search
    search.chosen.value = ["rail"]
    session.do(design_map.ask)
    session.do(search.ask)
    answered = design_map.sentence.object, search.sentence.object
    session.do(design_map._tapped, 23.0, 111.0)
    session.do(solve)
    assert session.assessment.current.design != BLOCK
    assert (design_map.sentence.object, search.sentence.object) == answered
    found = search._found()
    session.do(session.view._take, found.many.design(int(found.front[-1])), BLOCK)
    session.do(solve)
    assert session.assessment.current.design.rail != BLOCK.rail
    assert search.sentence.object == answered[1]
    assert "Before the last changes: " in design_map.sentence.object
    session.inputs.wheel_mass += 1.0
    session.do(solve)
    assert "Before the last changes: " in search.sentence.object


@pytest.mark.parametrize(
    ("name", "change"),
    [
        ("how_sure", lambda view: view.how_sure.tolerances.boxes["pad_stiffness"].param.update(value="30")),
        ("how_sure", lambda view: view.how_sure.seed.param.update(value="4")),
        ("how_sure", lambda view: view.how_sure.seed.param.update(value="four")),
        ("what_scatters", lambda view: view.how_sure.shape.param.update(value="normal")),
        ("map", lambda view: view.map.x.param.update(value="pad_stiffness")),
        ("search", lambda view: view.search.free.param.update(value=["boot_stiffness"])),
    ],
)
def test_an_answer_says_that_what_was_asked_is_not_what_stands_in_the_boxes(session, name, change):
    view = getattr(session.view, name)
    session.view.how_sure.samples.value = 1000
    session.do(view.ask)
    answered = view.sentence.object
    assert [part.styles["opacity"] for part in view.drawn] == ["1"] * len(view.drawn)
    before = session.snapshot.boxes.typed
    session.do(change, session.view)
    assert "Before the last changes: " in view.sentence.object
    assert all(float(part.styles["opacity"]) < 1 for part in view.drawn)
    session.do(session.snapshot.boxes.put_back, before)
    assert view.sentence.object == answered
    assert [part.styles["opacity"] for part in view.drawn] == ["1"] * len(view.drawn)


def test_specimens_in_use_come_back_with_the_page(session, summary, make_pictures):
    view = session.view.how_sure
    view.pasted.value = "boot stiffness [kN/mm]\n27\n28\n29"
    session.do(view._read)
    assert "production" in view.settings()
    other = Session(summary, make_pictures, LIMITS)
    other.do(other.snapshot.boxes.put_back, session.snapshot.boxes.typed)
    again = other.view.how_sure
    assert again.settings() == view.settings()
    assert "scatter as in 3 specimens" in again.specimens.object
    assert again.forget.visible
    assert again.tolerances.boxes["boot_stiffness"].disabled
    other.do(again._forget)
    assert "production" not in again.settings()
    assert again.pasted.value == view.pasted.value
    other.do(other.snapshot.boxes.put_back, json.dumps({"specimens_in_use": "nonsense"}))
    assert "production" not in again.settings()


def test_a_map_never_has_one_number_along_both_axes(surrounded, summary):
    view = surrounded.view.map
    surrounded.do(surrounded.view.look, active=True)
    view.x.value, view.y.value = "ground.stiffness", "ground.mass"
    surrounded.do(surrounded.outcome.param.update, summary=summary("slab-track"))
    assert view.x.value != view.y.value
    view.y.value = view.x.value
    surrounded.do(view.ask)
    assert "Across and up are both pad stiffness: choose two numbers." in view.sentence.object


def test_a_map_shows_both_edges_and_the_pins(session, summary):
    pin = session.pins.add(tig.PRESETS["booted-block-high-mass"], "Heavy <b>")
    session.pinned.summaries = {pin.key: summary("booted-block-high-mass")}
    session.do(session.view.map.ask)
    drawn = session.view.map.map
    edges = ("just complies", "sinks just as far as allowed")
    assert drawn.legend.listed == (*edges, "This design", "Heavy <b>")
    assert drawn.marks.data["x"] == [each.design.boot_stiffness / 1e6 for each in session.view.map._designs]
    assert drawn.marks.data["marker"] == ["circle", "diamond"]
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
    view.pin_name.value = "Best <b>"
    session.do(view.take.param.trigger, "clicks")
    session.do(view.pin.param.trigger, "clicks")
    assert session.pins.pinned[0].name == "Best <b>"
    assert session.inputs.boot_stiffness == pytest.approx(expected.boot_stiffness / 1e6, rel=1e-5)
    assert session.pins.pinned[0].design == session.inputs.to_design()


def test_a_search_without_a_limit_of_deflection_is_warned_of_and_can_be_limited(session):
    view = session.view.search
    assert not view.unlimited.visible, "the specification limits it"
    session.do(session.assessment.param.update, specification=tig.Specification([(63, -4.0)]))
    assert view.unlimited.visible
    session.do(view.limit.param.trigger, "clicks")
    assert not view.unlimited.visible
    sinks = 1e3 * tig.static_response(BLOCK).rail_deflection
    assert sinks <= float(view.deflection.value) < sinks + 0.001
    assert view.settings()["max_deflection"] == pytest.approx(sinks / 1e3, abs=1e-6)
    view.deflection.value = "0"
    assert view.unlimited.visible
    view.against.value = "block_mass"
    assert "as much margin and as little block mass" in view.explained.object
    session.do(view.ask)
    assert "No limit of rail deflection is set: with the best designs the rail sinks" in view.sentence.object
    found = view.inquiry.result
    row = int(found.front[0])
    assert f"rail deflection {millimetre_text(found.deflections[row])}" in chosen_words(found, row)


def test_colours_say_which_end_is_the_good_one(session):
    view = session.view.map
    session.do(view.ask)
    bar = view.map.model.select_one(ColorBar)
    assert bar.title == "Governing margin, dB\nhigh, bright: better"
    assert tuple(bar.color_mapper.palette) == Viridis256
    session.do(view.figure.param.update, value="deflection")
    bar = view.map.model.select_one(ColorBar)
    assert bar.title == "Rail deflection, mm\nlow, bright: better"
    assert tuple(bar.color_mapper.palette) == Viridis256[::-1]
    session.do(view.figure.param.update, value="loaded_track")
    assert view.map.model.select_one(ColorBar).title.endswith("neither end is better")
    changes = session.view.what_matters.changes.model.select_one(ColorBar)
    assert changes.title == "dB; blue: better"
    low, high = (changes.color_mapper.palette[end][:7] for end in (0, -1))
    red, blue = ([int(each[at : at + 2], 16) for at in (1, 5)] for each in (high, low))
    assert red[0] > red[1], "more vibration is red"
    assert blue[0] < blue[1], "less vibration is blue"


def test_what_vehicle_and_site_give_is_free_only_when_asked_for(session):
    search = session.view.search
    session.do(search.offer)
    assert set(search.free.options.values()) == {name for name in FIELDS if not FIELDS[name].whose}
    search.given.value = True
    assert search.free.options["Unsprung wheel mass (vehicle)"] == "wheel_mass"
    search.free.value = ["boot_stiffness", "wheel_mass"]
    assert search.settings()["free"] == ["boot_stiffness", "wheel_mass"]
    search.given.value = False
    assert search.settings()["free"] == ["boot_stiffness"]


def test_keys_move_a_cross_over_the_map_and_take_the_design_under_it(session):
    view = session.view.map
    press = session.keys["map_figure"]
    session.do(press, "ArrowRight", False)
    assert view.map.cross.data["x"] == [], "there is no map yet"
    session.do(view.ask)
    found = view.inquiry.result
    column = int(np.abs(found.x - BLOCK.boot_stiffness).argmin())
    row = int(np.abs(found.y - BLOCK.block_mass).argmin())
    for key, far in (("ArrowRight", True), ("ArrowLeft", False), ("ArrowDown", False), ("Home", False)):
        session.do(press, key, far)
    place = column + 9, row - 1
    assert view.map.cross.data == {"x": [found.x[place[0]] / 1e6], "y": [found.y[place[1]]]}
    said = view.under_cross.object
    assert f"governing margin {found.figures['margin'][place[::-1]]:.4g} dB" in said
    assert ("complies" if found.complies[place[::-1]] else "fails") in said
    session.do(press, "Enter", False)
    assert session.inputs.boot_stiffness == pytest.approx(found.x[place[0]] / 1e6, rel=1e-5)
    # the cross stays on the map
    for _ in range(30):
        session.do(press, "ArrowUp", True)
    assert view.map.cross.data["y"] == [found.y[-1]]


def test_a_map_marks_the_current_design_as_it_moves(session, summary):
    session.do(session.view.map.ask)
    other = summary("booted-block-high-mass")
    session.do(session.outcome.param.update, summary=other)
    assert session.view.map.map.marks.data["y"] == [other.design.block_mass]


def test_keys_go_through_the_best_designs_of_a_search(session):
    view = session.view.search
    session.do(view.ask)
    found, cloud = view.inquiry.result, view.cloud
    press = session.keys["objectives_figure"]
    session.do(press, "Enter", False)
    assert session.inputs.to_design() == BLOCK, "nothing is chosen yet"
    order = found.front[np.argsort(found.values[found.front, 0], kind="stable")]
    session.do(press, "ArrowRight", False)
    session.do(press, "ArrowRight", False)
    assert [cloud.designs.data["row"][place] for place in cloud.designs.selected.indices] == [order[1]]
    margin, sinks = found.values[order[1]]
    words = f"Governing margin {margin:.4g} dB, rail deflection {1e3 * sinks:.4g} mm: pad stiffness"
    assert words in view.parts.object
    session.do(press, "ArrowRight", True)
    rows = [cloud.designs.data["row"][place] for place in cloud.designs.selected.indices]
    assert rows == [order[2], order[1]]
    assert len(cloud.curves.data["xs"]) == 2
    session.do(press, "Enter", False)
    taken = found.many.design(int(order[2]))
    assert session.inputs.boot_stiffness == pytest.approx(taken.boot_stiffness / 1e6, rel=1e-5)


def grown(**settings):
    """Return what a search has found after each generation."""
    found = []
    settings = {"free": ["pad_stiffness", "boot_stiffness"], "population": 20, "generations": 4} | settings
    tig.decide.Question("find", BLOCK, settings, specification=LIMITS).ask(so_far=found.append)
    return found


def test_what_is_brushed_stays_so_while_a_search_grows(session):
    view = session.view.search
    first, *others = grown()
    session.do(view.inquiry.param.update, so_far=first)
    selected = view.cloud.designs.selected
    selected.indices = [3, 0]
    rows = [int(view.cloud.designs.data["row"][place]) for place in selected.indices]
    chosen = first.many.design(rows[0])
    told = view.parts.object
    for found in others:
        session.do(view.inquiry.param.update, so_far=found)
        assert [int(view.cloud.designs.data["row"][place]) for place in selected.indices] == rows
        assert view._design() == chosen
        assert not view.take.disabled
        assert view.parts.object == told
        assert len(view.cloud.curves.data["xs"]) == 2
    # another search has other designs
    session.do(view.inquiry.param.update, so_far=grown(seed=1)[0])
    assert selected.indices == []
    assert view.take.disabled


@pytest.mark.parametrize(("typed", "number"), [("12,5", 12.5), (" 5 % ", 5.0), ("", 0.0), ("90", 90.0)])
def test_a_box_reads_numbers_as_people_type_them(typed, number):
    box = percent_box("block_mass", 10.0)
    box.value = typed
    assert box.number == number
    assert not box.error_state


@pytest.mark.parametrize(
    ("box", "typed", "why"),
    [
        (percent_box("block_mass", 10.0), "91", "give 0 to 90 %"),
        (percent_box("block_mass", 10.0), "-1", "give 0 to 90 %"),
        (percent_box("block_mass", 10.0), "ten", "is no number"),
        (NumberBox("Price", 1.0), "-1", "give 0 or more"),
        (seed_box(), "1.5", "give a whole number"),
    ],
)
def test_a_box_says_why_it_takes_no_number(box, typed, why):
    box.value = typed
    assert box.error_state
    assert why in box.helper_text, "it is said where it was typed"
    assert box.label not in box.helper_text
    with pytest.raises(ValueError, match=why):
        _ = box.number


@pytest.mark.parametrize(
    ("kind", "share", "most"),
    [
        ("uniform", "90", "83.3 %"),
        ("uniform", "83.3", None),
        ("normal", "56", "55.5 %"),
        ("normal", "55", None),
    ],
)
def test_a_tolerance_that_no_track_could_keep_is_refused_in_words_of_the_page(session, kind, share, most):
    view = session.view.how_sure
    view.samples.value = 1000
    for name, box in view.tolerances.boxes.items():
        box.value = share if name == "fastener_spacing" else "0"
    view.shape.value = kind
    session.do(view.ask)
    if most is None:
        assert view.inquiry.result is not None
        assert view.inquiry.problem == ""
    else:
        assert f"Fastener spacing, ± %: {share}: give 0 to {most}; " in view.sentence.object
        assert "a track has a fastener spacing of 0.1 to 2 m." in view.sentence.object
        assert view.inquiry.asked is None


@pytest.mark.parametrize("kind", ["uniform", "normal"])
def test_every_share_that_a_box_takes_is_one_that_the_library_takes(session, kind):
    view = session.view.how_sure
    view.samples.value = 1000
    view.shape.value = kind
    for name, box in view.tolerances.boxes.items():
        if name != "fastener_spacing":
            box.value = "90" if kind == "uniform" else "60"
    session.do(view.ask)
    assert view.inquiry.problem == ""
    assert view.inquiry.result is not None


def test_a_number_that_is_none_is_said_where_the_answer_would_be(session):
    session.view.search.seed.value = "1.5"
    session.do(session.view.search.ask)
    assert "Seed: &#x27;1.5&#x27;: give a whole number." in session.view.search.sentence.object
    assert session.view.search.inquiry.asked is None


def test_with_nothing_free_it_says_what_to_do(session):
    session.view.search.free.value = []
    session.do(session.view.search.ask)
    assert "Choose which numbers are free" in session.view.search.sentence.object


def kept(session, view):
    """Keep the answer of a question, and return it."""
    session.do(view.keep.param.trigger, "clicks")
    return session.snapshot.answers.kept[-1]


def test_a_kept_answer_is_part_of_the_study_and_comes_out_again(session):
    session.do(session.view.what_matters.ask)
    answer = kept(session, session.view.what_matters)
    assert "changes it by" in answer.sentence
    assert answer.holds()
    study = tig.Study.from_toml(session.snapshot.study().to_toml())
    assert study.answers == (answer,)
    # the same question again takes the place of the answer, and is not kept twice
    kept(session, session.view.what_matters)
    assert len(session.snapshot.answers.kept) == 1
    ((_, row),) = session.view.kept.rows
    assert "Asked of: " in row.words.object
    assert "boot stiffness 28 kN/mm" in row.words.object
    session.do(row.again.param.trigger, "clicks")
    assert "The same figures came out, to the last bit" in row.outcome.object
    session.do(row.remove.param.trigger, "clicks")
    assert session.snapshot.answers.kept == ()
    assert session.view.kept.rows == ()


def test_an_opened_answer_is_listed_and_a_false_one_is_found_out(session):
    session.do(session.view.what_matters.ask)
    answer = kept(session, session.view.what_matters)
    forged = dataclasses.replace(answer, digest="0" * 64, versions={**answer.versions, "numpy": "1.0"})
    text = dataclasses.replace(session.snapshot.study(), answers=(forged,)).to_toml()
    session.do(session.snapshot.open, text)
    assert session.snapshot.answers.kept == (forged,)
    ((_, row),) = session.view.kept.rows
    assert forged.sentence[:20] in html.unescape(row.words.object)
    session.do(row.again.param.trigger, "clicks")
    said = "Other figures came out: it was computed with numpy 1.0, now "
    assert said in row.outcome.object
    assert session.snapshot.answers.pages[forged.digest].startswith(said)


def test_what_was_typed_is_there_again_in_another_session(session, summary, make_pictures):
    def boxes(view):
        return [
            *view.how_sure.tolerances.boxes.values(),
            *view.what_matters.changes_of.boxes.values(),
            *(view.how_sure.samples, view.how_sure.shape, view.map.x, view.map.figure),
            *(view.search.free, view.search.against, *view.search.prices.values()),
        ]

    def values(view):
        return [box.value for box in boxes(view)]

    view, first = session.view, values(session.view)
    session.do(view.look, active=True)
    view.how_sure.tolerances.boxes["pad_stiffness"].value = "7,5"
    session.do(setattr, view.what_matters.change, "value", "20")
    session.do(setattr, view.what_matters.changes_of.boxes["block_mass"], "value", "5")
    view.how_sure.samples.value = 1000
    view.how_sure.shape.value = "normal"
    view.map.x.value, view.map.figure.value = "pad_stiffness", "deflection"
    view.search.free.value = ["boot_stiffness"]
    view.search.against.value = "cost"
    view.search.prices["block_mass"].value = "2"
    # as they were: five tolerances and the other price
    assert sum(a == b for a, b in zip(values(view), first, strict=True)) == 6
    other = Session(summary, make_pictures, LIMITS)
    other.do(other.snapshot.boxes.put_back, session.snapshot.boxes.typed)
    assert values(other.view) == values(view)
    assert other.view.search.prices["block_mass"].visible


@pytest.mark.parametrize("name", ["how_far", "what_matters", "how_sure", "map", "search", "what_scatters"])
def test_every_answer_can_be_saved_with_all_that_obtains_it_again(session, name):
    view = getattr(session.view, name)
    session.view.how_sure.samples.value = 1000
    session.do(view.ask if name != "how_far" else session.feasibility.ask)
    session.do(view.export.param.trigger, "clicks")
    ((file, text),) = session.saved
    assert file == f"trackig-study-{view.kind}-answer.csv"
    lines = text.splitlines()
    remarks = [line for line in lines if line.startswith("# ")]
    settings = json.loads(next(line for line in remarks if "question:" in line).partition(", ")[2])
    question = dataclasses.replace(view.inquiry.answered, settings=settings)
    again = question.ask()
    assert f"# digest: {tig.decide.questions.digest(again)}" in remarks
    table = list(csv.reader(lines[len(remarks) :]))
    frame = again.to_dataframe()
    assert table[0] == list(frame.columns)
    assert len(table) == 1 + len(frame)
    numbers = frame.select_dtypes("number").columns
    column = [float(row[table[0].index(numbers[0])]) for row in table[1:]]
    np.testing.assert_allclose(column, frame[numbers[0]], rtol=5.1e-6)


def test_a_change_for_each_field_is_the_library_s(session):
    view = session.view.what_matters
    session.do(view.change.param.update, value="5")
    session.do(view.changes_of.boxes["boot_stiffness"].param.update, value="20")
    changes = dict.fromkeys(FIELDS, 0.05) | {"boot_stiffness": 0.2}
    expected = tig.decide.sensitivity(BLOCK, LIMITS, changes=changes)
    np.testing.assert_array_equal(view.inquiry.result.bands, expected.bands)


def test_what_the_scatter_is_due_to_is_the_library_s(session):
    view = session.view.what_scatters
    session.do(view.ask)
    shares = {
        name: tig.decide.Uniform(box.number / 100) for name, box in view._how_sure.tolerances.boxes.items()
    }
    figures = ("margin", "deflection", "loaded_track", "coupled_block")
    expected = tig.decide.sobol(BLOCK, shares, LIMITS, figures=figures)
    np.testing.assert_array_equal(view.inquiry.result.total_order, expected.total_order)
    assert f"{100 * expected.total_order[0].max():.0f} % of the scatter of the governing margin" in (
        view.sentence.object
    )
    assert view.table.object.count("class='bar'") == expected.total_order.size


def test_measured_specimens_take_the_place_of_their_tolerances(session):
    view = session.view.how_sure
    view.samples.value = 1000
    view.pasted.value = "Boot stiffness, MN/m\tBoot loss factor\n26\t0.19\n28,5\t0.21\n31\t0.2"
    session.do(view.read.param.trigger, "clicks")
    assert "Boot stiffness and boot loss factor scatter as in 3 specimens" in view.specimens.object
    assert view.tolerances.boxes["boot_stiffness"].disabled
    session.do(view.ask)
    shares = {
        name: box.number / 100
        for name, box in view.tolerances.boxes.items()
        if name not in ("boot_stiffness", "boot_loss_factor")
    }
    table = {"boot_stiffness": [26e6, 28.5e6, 31e6], "boot_loss_factor": [0.19, 0.21, 0.2]}
    expected = tig.decide.tolerance(BLOCK, LIMITS, shares, production=table, samples=1000)
    assert view.inquiry.result.complying == expected.complying
    np.testing.assert_array_equal(view.inquiry.result.percentiles, expected.percentiles)
    view.pasted.value = "colour\nred"
    session.do(view.read.param.trigger, "clicks")
    assert 'class="problem"' in view.specimens.object
    session.do(view.forget.param.trigger, "clicks")
    assert "production" not in view.settings()


def test_production_is_drawn_in_explore_for_its_own_design_alone(session):
    view = session.view.how_sure
    view.samples.value = 1000
    session.do(view.ask)
    assert session.production.band(BLOCK, session.definition) is None, "nobody asked for it"
    session.do(view.in_explore.param.update, value=True)
    np.testing.assert_array_equal(
        session.production.band(BLOCK, session.definition), view.inquiry.result.percentiles[[0, 2]]
    )
    assert session.production.band(BLOCK.replace(block_mass=50.0), session.definition) is None
    session.do(session.definition.param.update, summation="coherent")
    assert session.production.band(BLOCK, session.definition) is None


def test_a_search_chooses_from_the_catalogue_within_a_deflection(session):
    view = session.view.search
    view.chosen.value = ["rail", "pad"]
    view.free.value = ["boot_stiffness", "pad_stiffness"]
    view.deflection.value = "1,2 mm"
    settings = view.settings()
    assert settings["free"] == ["boot_stiffness"], "the pad's stiffness comes with the pad"
    assert settings["max_deflection"] == pytest.approx(1.2e-3)
    assert [each["rail"] for each in settings["choices"]["rail"]] == list(tig.RAILS)
    pads = tig.study.bundled_catalogue().of_kind("pad")
    assert [each["pad_stiffness"] for each in settings["choices"]["pad"]] == [
        each.values["pad_stiffness"] for each in pads.values()
    ]
    settings |= {"population": 20, "generations": 3}
    found = tig.decide.Question("find", BLOCK, settings, specification=LIMITS).ask()
    session.do(view.show, found)
    ticks = view.cloud.fields.xaxis.major_label_overrides
    assert [label.strip().partition("\n")[0] for label in ticks.values()] == [
        "Pad stiffness",
        "Pad loss factor",
        "Boot stiffness",
        "Rail",
        "Pad",
    ]


def test_a_search_chooses_measured_pads_of_the_catalogue_that_is_open(session):
    session.shelf.catalogue = CATALOGUE
    view = session.view.search
    view.chosen.value = ["pad"]
    session.do(view.ask)
    found = view.inquiry.result
    assert {*found.chosen["pad"]} == {"Plain", "Measured"}
    assert view.cloud.fields.xaxis.major_label_overrides[2] == "Pad\nby name"
    data = view.cloud.designs.data
    measured = int(np.flatnonzero(found.chosen["pad"][data["row"]] == "Measured")[0])
    plain = int(np.flatnonzero(found.chosen["pad"][data["row"]] == "Plain")[0])
    assert (data["ys"][measured][2], data["ys"][plain][2]) == (0.0, 1.0)
    view.cloud.designs.selected.indices = [measured]
    assert "pad Measured" in view.parts.object
    session.do(view.take.param.trigger, "clicks")
    pad = CATALOGUE.of_kind("pad")["Measured"]
    taken = session.inputs.to_design()
    assert pad.fitted_to(taken) == taken
    answer = kept(session, view)
    (opened,) = tig.Study.from_toml(session.snapshot.study().to_toml()).answers
    assert opened == answer
    ((_, row),) = session.view.kept.rows
    session.do(row.again.param.trigger, "clicks")
    assert "The same figures came out" in row.outcome.object


SPRUNG = BLOCK.replace(suspension=tig.VEHICLES["metro"].suspension, ground=tig.GROUNDS["soft clay"])


@pytest.fixture
def surrounded(session, fake_picture):
    """Return a session, the tab in sight, whose design has a suspension and ground that yields."""
    session.do(session.outcome.param.update, summary=fake_picture(SPRUNG))
    session.do(session.view.look, active=True)
    return session


def test_numbers_of_vehicle_and_ground_are_offered_while_the_design_has_them(surrounded, fake_picture):
    view = surrounded.view
    assert {*view.search.free.options.values()} == {name for name in FIELDS if not FIELDS[name].whose}
    view.search.given.value = True
    for box in (view.map.x, view.map.y, view.search.free):
        assert {"suspension.primary_stiffness", "ground.damping"} <= {*box.options.values()}
        assert "speed" not in box.options.values(), "of one wheel it does not matter"
    assert view.how_sure.tolerances.boxes["ground.stiffness"].visible
    view.map.x.value = "ground.stiffness"
    view.search.free.value = ["ground.stiffness", "block_mass"]
    surrounded.do(surrounded.outcome.param.update, summary=fake_picture(BLOCK))
    for box in (view.map.x, view.map.y, view.search.free):
        assert {*box.options.values()} == {*FIELDS}
    assert view.map.x.value in FIELDS
    assert view.search.free.value == ["block_mass"]
    assert not view.how_sure.tolerances.boxes["ground.stiffness"].visible
    assert {*view.what_matters.settings()["changes"]} == {*FIELDS}


def test_what_matters_about_vehicle_and_ground_is_the_library_s(surrounded):
    view = surrounded.view.what_matters
    expected = tig.decide.sensitivity(SPRUNG, LIMITS, reference="stiff")
    assert view.inquiry.result.fields == expected.fields
    np.testing.assert_array_equal(view.inquiry.result.bands, expected.bands)
    assert "Ground stiffness *" in view.changes.cells.data["field"]


def test_a_map_of_a_ground_takes_its_designs(surrounded, fake_picture, monkeypatch):
    monkeypatch.setattr("dashboard.views.decide.design_map.SURROUNDED_POINTS", [5, 4])
    view = surrounded.view.map
    view.x.value, view.y.value = "ground.stiffness", "suspension.primary_damping"
    surrounded.do(view.ask)
    found = view.inquiry.result
    expected = tig.decide.design_map(
        *(SPRUNG, "ground.stiffness", "suspension.primary_damping", LIMITS),
        figures=["margin"],
        points=(5, 4),
        reference="stiff",
    )
    np.testing.assert_array_equal(found.figures["margin"], expected.figures["margin"])
    assert view.map.model.xaxis.axis_label == "Ground stiffness, kN/mm"
    assert view.map.model.yaxis.axis_label == "Primary damping, kN s/m"
    surrounded.do(view._tapped, found.x[1] / 1e6, found.y[2] / 1e3)
    taken = surrounded.inputs.to_design()
    assert taken.ground.stiffness == pytest.approx(found.x[1], rel=1e-5)
    assert taken.suspension.primary_damping == pytest.approx(found.y[2], rel=1e-5)
    # what is not on the map keeps all figures of the design that was asked about, and the answer is its own
    assert taken.ground.damping == SPRUNG.ground.damping
    answered = view.sentence.object
    surrounded.do(surrounded.outcome.param.update, summary=fake_picture(taken))
    assert view.sentence.object == answered


def test_a_ground_scatters_where_it_has_a_tolerance(surrounded):
    view = surrounded.view.how_sure
    view.samples.value = 1000
    for box in view.tolerances.boxes.values():
        box.value = "0"
    view.tolerances.boxes["ground.stiffness"].value = "30"
    surrounded.do(view.ask)
    expected = tig.decide.tolerance(
        SPRUNG, LIMITS, {"ground.stiffness": 0.3}, samples=1000, reference="stiff"
    )
    np.testing.assert_array_equal(view.inquiry.result.percentiles, expected.percentiles)
    assert "Ground stiffness" in view.table.object


def test_a_search_frees_a_suspension(surrounded, monkeypatch):
    view = surrounded.view.search
    view.free.value = ["suspension.bogie_mass"]
    settings = view.settings() | {"population": 8, "generations": 2}
    monkeypatch.setattr(view, "settings", lambda: settings)
    surrounded.do(view.ask)
    masses = view.inquiry.result.many.column("suspension.bogie_mass")
    assert masses.min() < masses.max()
    labels = view.cloud.fields.xaxis.major_label_overrides
    assert labels[0].startswith("Bogie mass per wheel\n200–15")
