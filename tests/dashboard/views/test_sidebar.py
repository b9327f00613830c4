"""The sidebar: what it shows of the inputs, what it takes, and when it answers."""

import pytest

import trackig_core as tig
from dashboard.fields import (
    CLOSED_GROUPS,
    EVERY_FIELD,
    GROUPS,
    NUMBERS,
    RAIL_FIELDS,
    SECOND_STAGE,
    SURROUNDINGS,
)
from dashboard.session.inputs import DesignInputs, values_of
from dashboard.session.results import Outcome
from dashboard.session.shelf import Shelf
from dashboard.session.special import OWN_RAIL
from dashboard.views import sidebar
from dashboard.views.sidebar import Controls


@pytest.fixture
def inputs():
    return DesignInputs()


@pytest.fixture
def outcome(summary):
    return Outcome(summary=summary("booted-block-low-mass"))


@pytest.fixture
def panel(inputs, outcome, monkeypatch):
    """Return the panel; its answers are kept in ``answers``."""
    quantities = Controls(inputs, outcome, Shelf()).quantities
    answers = []
    monkeypatch.setattr(quantities, "_send_msg", answers.append)
    quantities.answers = answers
    return quantities


def give(panel, number=1, **values):
    """Send what the browser sends when the user sets values."""
    panel.handle_message({"kind": "set", "number": number, "values": values, "gesture": 1})


def test_every_field_has_a_row_in_its_group(panel):
    rows = {row["name"]: (group, row) for group in panel.groups for row in group["fields"] if "name" in row}
    assert set(rows) == {*EVERY_FIELD, *RAIL_FIELDS, *SURROUNDINGS, "preset", "two_stage", "rail"}
    assert [group["title"] for group in panel.groups] == ["", *GROUPS]
    for name, field in EVERY_FIELD.items():
        group, row = rows[name]
        assert group["title"] == field.group
        assert group["closed"] == (field.group in CLOSED_GROUPS)
        assert (row["low"], row["high"], row["unit"]) == (field.low, field.high, field.unit)
    assert [value for _, value in rows["preset"][1]["options"]] == list(tig.PRESETS)
    assert [value for _, value in rows["rail"][1]["options"]] == [*tig.RAILS, OWN_RAIL]


def test_what_is_set_becomes_one_change(panel, inputs):
    changes = []
    inputs.param.watch(lambda *events: changes.append({event.name for event in events}), list(NUMBERS))
    give(panel, 7, pad_stiffness=120, block_mass="0.1 t", rail="49E1", two_stage=True)
    assert changes == [{"pad_stiffness", "block_mass"}]
    assert (inputs.pad_stiffness, inputs.block_mass, inputs.rail) == (120, 100, "49E1")
    assert panel.state["number"] == 7
    assert panel.state["values"]["block_mass"] == 100
    assert panel.state["modified"]


def test_what_cannot_be_read_is_advised_upon_until_it_is_set(panel, inputs):
    give(panel, 1, block_mass="a lot", pad_stiffness=200)
    assert (inputs.block_mass, inputs.pad_stiffness) == (45, 200)
    assert panel.state["refused"] == {"block_mass": "'a lot' is no number; this box takes 10 to 500 kg"}
    give(panel, 2, pad_stiffness=300)
    assert set(panel.state["refused"]) == {"block_mass"}
    give(panel, 3, block_mass=60)
    assert panel.state["refused"] == {}


@pytest.mark.parametrize(
    "clear",
    [
        lambda inputs, _: inputs.take(inputs.to_values()),
        lambda inputs, _: setattr(inputs, "two_stage", False),
        lambda _, panel: give(panel, 2, preset="booted-sleeper"),
        lambda _, panel: panel.handle_message({"kind": "revert"}),
    ],
    ids=["undo", "single-stage", "preset", "revert"],
)
def test_a_complaint_ends_with_what_it_was_about(panel, inputs, clear):
    give(panel, 1, block_mass="a lot")
    clear(inputs, panel)
    assert panel.state["refused"] == {}


@pytest.mark.parametrize(
    "message",
    [
        None,
        [],
        {"kind": "set"},
        {"kind": "set", "number": "1", "values": {"block_mass": 60}, "gesture": 1},
        {"kind": "set", "number": 1, "values": [["block_mass", 60]], "gesture": 1},
        {"kind": "set", "number": 1, "values": {"block_mass": 60}},
        {"kind": "chip", "name": "block_mass"},
        {"kind": "chip", "name": ["block_mass"]},
    ],
)
def test_messages_of_another_form_ask_for_nothing(panel, inputs, message):
    before = inputs.to_values()
    panel.handle_message(message)
    assert inputs.to_values() == before


@pytest.mark.parametrize(
    "value", [None, [], {}, True, float("nan"), float("inf"), -1, 1e400, 10**400, "9" * 40]
)
def test_hostile_values_change_nothing(panel, inputs, value):
    before = inputs.to_values()
    given = dict.fromkeys((*NUMBERS, "rail", "preset", "modified", "no such input"), value)
    give(panel, 1, **given, two_stage="yes")
    assert inputs.to_values() == before
    assert set(panel.state["refused"]) == {*NUMBERS, "rail", "two_stage"}


def test_an_answer_waits_for_the_picture(panel, inputs, outcome, fake_picture):
    give(panel, 1, block_mass=60)
    assert panel.answers == []
    outcome.summary = fake_picture(tig.PRESETS["slab-track"])
    assert panel.answers == [], "an older picture"
    outcome.summary = fake_picture(inputs.to_design(), fidelity="live")
    assert panel.answers == [{"kind": "answered", "number": 1}]
    outcome.summary = fake_picture(inputs.to_design())
    assert len(panel.answers) == 1


@pytest.mark.parametrize(
    "given_up",
    [{"problem": "Stopped."}, {"progress": 0.1}, {"compiling": True}],
    ids=lambda each: next(iter(each)),
)
def test_an_answer_does_not_wait_for_a_picture_that_is_not_to_come_soon(panel, outcome, given_up):
    give(panel, 1, block_mass=60)
    outcome.param.update(**given_up)
    assert panel.answers == [{"kind": "answered", "number": 1}]


@pytest.mark.parametrize("values", [{"block_mass": 45}, {"block_mass": "nonsense"}, {}])
def test_what_changes_nothing_is_answered_at_once(panel, values):
    give(panel, 4, **values)
    assert panel.answers == [{"kind": "answered", "number": 4}]


def test_only_the_newest_message_is_answered(panel, inputs, outcome, fake_picture):
    give(panel, 1, block_mass=60)
    give(panel, 2, block_mass=70)
    outcome.summary = fake_picture(inputs.to_design())
    assert panel.answers == [{"kind": "answered", "number": 2}]


def test_a_preset_sets_all_and_what_comes_with_it(panel, inputs):
    give(panel, 1, preset="booted-sleeper", pad_stiffness=50)
    assert inputs.to_design() == tig.PRESETS["booted-sleeper"].replace(pad_stiffness=50e6)
    give(panel, 2, preset="slab-track")
    assert panel.state["values"]["two_stage"] is False


def test_changes_from_elsewhere_reach_the_panel(panel, inputs):
    inputs.take({"boot_stiffness": 14.0, "rail": "49E1"})
    assert panel.state["values"]["boot_stiffness"] == 14
    assert panel.state["values"]["rail"] == "49E1"


def test_single_stage_disables_block_and_boot_and_one_wheel_its_speed(panel, inputs):
    inputs.two_stage = False
    assert panel.state["disabled"] == [*SECOND_STAGE, "speed"]
    inputs.two_stage = True
    assert panel.state["disabled"] == ["speed"]
    give(panel, 1, axle_positions="bogie")
    assert panel.state["disabled"] == []


def test_vehicle_axles_and_ground_are_shown_by_name_and_a_study_s_own_as_such(panel, inputs):
    give(panel, 1, suspension="metro", ground="stiff clay")
    shown = panel.state["values"]
    assert [shown[name] for name in SURROUNDINGS] == ["metro", "none", "stiff clay"]
    inputs.ground = tig.Ground(1e8, 1e4, 0.0)
    assert panel.state["values"]["ground"] == "own"


def test_modified_is_shown_with_a_way_back(panel, inputs):
    assert not panel.state["modified"]
    give(panel, 1, block_mass=50)
    assert panel.state["modified"]
    panel.handle_message({"kind": "revert"})
    assert inputs.to_design() == tig.PRESETS["booted-block-low-mass"]
    assert not panel.state["modified"]
    assert panel.state["values"]["block_mass"] == 45


def test_sliders_mark_the_preset_s_value(panel, inputs):
    assert panel.state["marks"]["boot_stiffness"] == 28
    inputs.preset = "booted-block-high-mass"
    assert panel.state["marks"]["boot_stiffness"] == 14
    inputs.preset = "slab-track"
    assert "boot_stiffness" not in panel.state["marks"]


def test_a_click_on_a_chip_is_handed_on(panel):
    clicked = []
    panel.on_chip = clicked.append
    panel.handle_message({"kind": "chip", "name": "boot_stiffness"})
    panel.chips = {"boot_stiffness": "measured"}
    panel.handle_message({"kind": "chip", "name": "boot_stiffness"})
    assert clicked == ["boot_stiffness"]


CURVE = tig.StiffnessCurve([(5, 20e6, 0.1), (30, 30e6, 0.2)])


def test_a_curve_stands_as_a_chip_in_the_place_of_its_sliders(panel, inputs):
    assert panel.chips == {}
    inputs.take(values_of(inputs.to_design().replace(boot_stiffness=CURVE, boot_loss_factor=None)))
    assert panel.chips == {
        "boot_stiffness": "measured at 2 frequencies, 5 to 30 Hz",
        "boot_loss_factor": "measured with the stiffness",
    }
    give(panel, two_stage=False)
    assert panel.chips == {}


def test_a_number_beyond_a_slider_is_shown_as_it_is(panel, inputs):
    inputs.take(values_of(inputs.to_design().replace(boot_stiffness=300e6)))
    assert panel.state["values"]["boot_stiffness"] == 300
    assert panel.chips == {}


def test_a_rail_of_one_s_own_shows_its_sliders(panel, inputs):
    assert panel.state["hidden"] == [*RAIL_FIELDS]
    give(panel, rail=OWN_RAIL)
    assert (panel.state["hidden"], panel.state["values"]["rail"]) == ([], OWN_RAIL)
    give(panel, number=2, mass_per_metre=58)
    assert inputs.to_design().rail.mass_per_metre == 58
    assert panel.state["values"]["mass_per_metre"] == 58


def pick(panel, kind, name):
    """Send what the browser sends when a component is chosen."""
    panel.handle_message({"kind": "pick", "of": kind, "name": name})


def test_components_of_the_catalogue_are_offered_in_their_groups(panel):
    assert {group["title"]: group["kinds"] for group in panel.groups if group["kinds"]} == {
        "Rail pad": ["pad"],
        "Block and boot": ["block", "boot"],
        "Track": ["rail"],
    }
    for kind in ("rail", "pad", "block", "boot"):
        assert panel.catalogue[kind] == [*tig.study.bundled_catalogue().of_kind(kind)]


def test_a_chosen_component_becomes_the_design_s(panel, inputs):
    before = inputs.to_design()
    component = list(tig.study.bundled_catalogue().of_kind("pad").values())[-1]
    pick(panel, "pad", component.name)
    assert inputs.to_design() == component.fitted_to(before) != before
    pick(panel, "rail", "49E1")
    assert inputs.to_design().rail == tig.RAILS["49E1"]


@pytest.mark.parametrize("sent", [("pad", "none such"), ("wheel", "60"), ("rail", ""), ("", "60")])
def test_a_component_that_there_is_not_changes_nothing(panel, inputs, sent):
    before = inputs.to_design()
    pick(panel, *sent)
    assert inputs.to_design() == before


def test_a_boot_finds_no_place_on_a_single_stage_track(panel, inputs, monkeypatch):
    told = []
    monkeypatch.setattr(sidebar, "notify", lambda kind, words: told.append((kind, words)))
    inputs.preset = "slab-track"
    pick(panel, "boot", next(iter(tig.study.bundled_catalogue().of_kind("boot"))))
    ((kind, words),) = told
    assert kind == "warning"
    assert "two-stage" in words
    assert inputs.to_design() == tig.PRESETS["slab-track"]
