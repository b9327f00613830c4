"""Inputs in display units, and what they make."""

import dataclasses

import pytest

import trackig_core as tig
from dashboard.fields import INPUTS, LOAD, NUMBERS, PHYSICAL, PRESET_LABELS, to_display, to_si
from dashboard.session.inputs import DesignInputs, InputError, design_of, preset_values, read_input
from dashboard.session.results import SolutionSummary


@pytest.mark.parametrize("preset", tig.PRESETS)
def test_a_chosen_preset_is_the_published_design(preset):
    inputs = DesignInputs()
    inputs.preset = preset
    assert inputs.to_design() == tig.PRESETS[preset]
    assert not inputs.modified


def test_the_dashboard_opens_on_the_low_mass_block():
    assert DesignInputs().to_design() == tig.PRESETS["booted-block-low-mass"]


def test_every_preset_has_a_name_for_people():
    assert PRESET_LABELS.keys() == tig.PRESETS.keys()


@pytest.mark.parametrize(
    ("name", "shown", "si"),
    [
        ("pad_stiffness", 100, 100e6),
        ("boot_stiffness", 31.5, 31.5e6),
        ("contact_stiffness", 1200, 1.2e9),
        ("block_mass", 45, 45.0),
        ("fastener_spacing", 0.6, 0.6),
    ],
)
def test_stiffness_is_shown_in_kilonewton_per_millimetre(name, shown, si):
    assert to_si(name, shown) == si
    assert to_display(name, si) == shown


@pytest.mark.parametrize("name", NUMBERS)
def test_every_input_reaches_the_design(name):
    inputs = DesignInputs()
    low, high = inputs.param[name].bounds
    for bound in (low, high):
        setattr(inputs, name, bound)
        assert getattr(inputs.to_design(), name) == pytest.approx(to_si(name, bound))
        assert inputs.modified


@pytest.mark.parametrize("name", NUMBERS)
def test_table_1_lies_within_the_bounds(name):
    low, high = DesignInputs.param[name].bounds
    for design in tig.PRESETS.values():
        value = getattr(design, name)
        assert value is None or low <= to_display(name, value) <= high


@pytest.mark.parametrize("value", [9.99, 2000.1, float("nan"), float("inf"), "100"])
def test_values_out_of_bounds_are_refused(value):
    with pytest.raises(ValueError, match="pad_stiffness"):
        DesignInputs().pad_stiffness = value


def test_float_dust_makes_no_new_design():
    inputs = DesignInputs()
    inputs.fastener_spacing = 0.1 + 0.2
    clean = inputs.to_design()
    inputs.fastener_spacing = 0.3
    assert clean == inputs.to_design()
    assert clean.fastener_spacing == 0.3


def test_a_change_shows_as_modified_and_can_be_taken_back():
    inputs = DesignInputs(preset="booted-sleeper")
    inputs.boot_stiffness = 10
    inputs.rail = "49E1"
    assert inputs.modified
    inputs.revert()
    assert not inputs.modified
    assert inputs.to_design() == tig.PRESETS["booted-sleeper"]


def test_a_change_undone_by_hand_is_no_longer_modified():
    inputs = DesignInputs()
    inputs.block_mass = 46
    inputs.block_mass = 45
    assert not inputs.modified


def test_single_stage_leaves_the_second_stage_out_and_keeps_its_values():
    inputs = DesignInputs()
    inputs.block_mass = 77
    inputs.two_stage = False
    single = inputs.to_design()
    assert not single.two_stage
    assert single.boot_stiffness is None
    inputs.two_stage = True
    assert inputs.to_design().block_mass == 77


def test_a_single_stage_preset_keeps_block_and_boot_for_later():
    inputs = DesignInputs()
    inputs.preset = "slab-track"
    assert not inputs.two_stage
    inputs.two_stage = True
    assert inputs.to_design() == dataclasses.replace(
        tig.PRESETS["slab-track"], block_mass=45.0, boot_stiffness=28e6, boot_loss_factor=0.2
    )


def test_a_preset_arrives_as_one_change():
    inputs = DesignInputs()
    batches = []
    inputs.param.watch(lambda *events: batches.append({event.name for event in events}), list(NUMBERS))
    inputs.preset = "booted-block-high-mass"
    assert batches == [{"pad_stiffness", "block_mass", "boot_stiffness"}]


@pytest.mark.parametrize("preset", tig.PRESETS)
def test_values_of_a_preset_are_those_of_a_fresh_page_that_chose_it(preset):
    inputs = DesignInputs()
    inputs.preset = preset
    assert preset_values(preset) == inputs.to_values()
    assert design_of(preset_values(preset)) == tig.PRESETS[preset]


TUNED = {"two_stage": False, "rail": "49E1", "boot_stiffness": 12.5, "fastener_spacing": 0.65}


def test_values_taken_back_give_the_same_design_as_one_change():
    inputs = DesignInputs(preset="slab-track", **TUNED)
    values = inputs.to_values()
    other = DesignInputs()
    batches = []
    other.param.watch(lambda *events: batches.append({event.name for event in events}), list(INPUTS))
    other.take(values)
    assert other.to_values() == values
    assert other.to_design() == inputs.to_design()
    assert other.modified
    assert batches == [{"preset", *TUNED}]


def test_taking_a_preset_as_published_is_no_modification():
    inputs = DesignInputs()
    inputs.block_mass = 77
    inputs.take(preset_values("booted-sleeper"))
    assert not inputs.modified
    inputs.preset = "booted-block-low-mass"
    assert inputs.to_design() == tig.PRESETS["booted-block-low-mass"]


def test_values_carry_no_float_dust():
    inputs = DesignInputs()
    inputs.fastener_spacing = 0.1 + 0.2
    assert inputs.to_values()["fastener_spacing"] == 0.3


def test_values_out_of_bounds_change_nothing():
    inputs = DesignInputs()
    before = inputs.to_values()
    with pytest.raises(ValueError, match="block_mass"):
        inputs.take({**before, "pad_stiffness": 200, "block_mass": 9999})
    assert inputs.to_values() == before
    assert set(before) == {"preset", *PHYSICAL, *LOAD}


def test_labels_carry_units():
    for name in ("pad_stiffness", "boot_stiffness", "contact_stiffness"):
        assert DesignInputs.param[name].label.endswith(", kN/mm")
    for name in ("block_mass", "wheel_mass"):
        assert DesignInputs.param[name].label.endswith(", kg")
    assert DesignInputs.param.fastener_spacing.label.endswith(", m")


def test_a_picture_is_a_solution_in_display_units_without_its_history():
    solution = tig.solve(tig.PRESETS["booted-block-low-mass"], "live")
    summary = SolutionSummary.of(solution, 0.25)
    assert summary.design == solution.design
    assert summary.solution.history is None
    assert summary.solution.insertion_gain == pytest.approx(solution.insertion_gain, abs=0)
    assert 1000 * summary.total_force == pytest.approx(solution.total_force)
    assert 1000 * summary.loaded_support_force == pytest.approx(solution.loaded_support_force)
    assert summary.time is solution.time
    assert summary.step / 1000 == pytest.approx(solution.history.step)
    assert summary.seconds == 0.25


def test_an_exact_picture_has_no_forces_over_time():
    summary = SolutionSummary.of(tig.solve(tig.PRESETS["slab-track"], "exact"), 0.001)
    assert summary.solution.insertion_gain.shape == (21,)
    assert [summary.time, summary.loaded_support_force, summary.total_force, summary.step] == [None] * 4


@pytest.mark.parametrize(
    ("name", "given", "value"),
    [
        ("pad_stiffness", "1e3", 1000),
        ("pad_stiffness", "1_000", 1000),
        ("pad_stiffness", "１２０", 120),
        ("pad_stiffness", "120\N{NO-BREAK SPACE}MN/m", 120),
        ("pad_stiffness", 123.45, 123.45),
        ("boot_stiffness", "31,5", 31.5),
        ("wheel_mass", "880kg", 880),
        ("wheel_mass", "0.88 t", 880),
        ("fastener_spacing", "600 mm", 0.6),
        ("pad_loss_factor", "20 %", 0.2),
        ("two_stage", False, False),
        ("rail", "49E1", "49E1"),
    ],
)
def test_what_people_type_is_read(name, given, value):
    assert read_input(name, given) == value


@pytest.mark.parametrize(
    ("name", "given", "words"),
    [
        ("wheel_mass", "", "give a number; this box takes 200 to 1500 kg"),
        ("wheel_mass", "heavy", "'heavy' is no number; this box takes 200 to 1500 kg"),
        ("wheel_mass", "880 kN", "kN is a unit of force; give kg"),
        ("wheel_mass", "\N{MINUS SIGN}880", "give 200 to 1500 kg"),
        ("wheel_mass", 1501, "give 200 to 1500 kg"),
        ("wheel_mass", True, "give 200 to 1500 kg"),
        ("pad_stiffness", "1,200", "may be 1200 or 1.200"),
        ("pad_loss_factor", "2.1", "give 0.01 to 2"),
        ("two_stage", 1, "choose one of what is offered"),
        ("rail", "no rail", "choose one of what is offered"),
    ],
)
def test_what_cannot_be_read_is_refused_with_advice(name, given, words):
    with pytest.raises(InputError) as refusal:
        read_input(name, given)
    assert words in str(refusal.value)


def test_a_gesture_is_known_while_its_change_is_noted():
    inputs, seen = DesignInputs(), []
    inputs.param.watch(lambda *_: seen.append(inputs.gesture), "block_mass")
    inputs.take_given({"block_mass": 60}, gesture=3)
    inputs.block_mass = 70
    assert seen == [3, None]


@pytest.mark.parametrize("text", ["1.25x", "x 1.25", "1,25 ×", "× 1.25"])
def test_a_static_stiffness_may_be_given_by_its_ratio(text):
    inputs = DesignInputs()
    inputs.take_given({"pad_static_stiffness": text})
    assert inputs.pad_static_stiffness == 80
    assert inputs.to_design().pad_static_stiffness == 80e6


@pytest.mark.parametrize("text", ["0x", "-2x", "x", "1.25y", "1e9x"])
def test_what_is_no_ratio_is_refused(text):
    inputs = DesignInputs()
    inputs.take_given({"pad_static_stiffness": text})
    assert inputs.pad_static_stiffness is None
    assert set(inputs.refused) == {"pad_static_stiffness"}


@pytest.mark.parametrize("nothing", [None, "", "  "])
def test_an_empty_box_takes_an_extra_number_back(nothing):
    inputs = DesignInputs()
    before = inputs.to_design()
    inputs.take_given({"boot_static_stiffness": "20", "wheelbase": 2.5, "wheel_load": "100 kN"})
    assert inputs.to_load() == tig.study.StaticLoad(100e3, 2.5)
    assert inputs.to_design() == before.replace(boot_static_stiffness=20e6)
    assert inputs.modified
    inputs.take_given({"boot_static_stiffness": nothing, "wheelbase": nothing, "wheel_load": nothing})
    assert inputs.to_design() == before
    assert inputs.to_load().wheelbase is None
    assert set(inputs.refused) == {"wheel_load"}


def test_the_standing_wheels_are_no_part_of_a_design():
    inputs = DesignInputs()
    inputs.take_given({"wheel_load": 100, "wheelbase": 2.5})
    assert not inputs.modified
    inputs.revert()
    assert inputs.wheel_load == 100
