"""Sliders and boxes, both bound to the inputs."""

import math

import pytest

import trackig_core as tig
from dashboard.fields import NUMBERS, SECOND_STAGE, STIFFNESSES
from dashboard.session.inputs import DesignInputs
from dashboard.views.sidebar import Controls, QuantityControl


@pytest.fixture
def inputs():
    return DesignInputs()


@pytest.fixture
def control(inputs):
    return lambda name: QuantityControl(inputs, name)


@pytest.mark.parametrize("name", NUMBERS)
def test_slider_ends_are_the_bounds(inputs, control, name):
    quantity = control(name)
    for position, bound in zip(
        (quantity.slider.start, quantity.slider.end), inputs.param[name].bounds, strict=True
    ):
        quantity.slider.value = position
        assert getattr(inputs, name) == bound
        assert float(quantity.box.value) == bound


@pytest.mark.parametrize("name", STIFFNESSES)
def test_stiffness_sliders_are_logarithmic(inputs, control, name):
    quantity = control(name)
    low, high = inputs.param[name].bounds
    quantity.slider.value = (quantity.slider.start + quantity.slider.end) / 2
    assert getattr(inputs, name) == pytest.approx(math.sqrt(low * high), rel=0.005)


def test_logarithmic_sliders_say_the_value_itself(control):
    quantity = control("pad_stiffness")
    assert quantity.slider.value == pytest.approx(100)
    assert "10 * 10 ** (tick / 100)" in quantity.slider.format.code


def test_a_slider_under_the_thumb_is_not_moved(inputs, control):
    quantity = control("pad_stiffness")
    position = 112.345
    quantity.slider.value = position
    assert inputs.pad_stiffness == 133
    assert quantity.slider.value == position
    assert quantity.box.value == "133"


@pytest.mark.parametrize(("typed", "value"), [("123.45", 123.45), (" 60 ", 60), ("1e3", 1000), ("10", 10)])
def test_a_typed_number_is_taken_as_it_is(inputs, control, typed, value):
    quantity = control("pad_stiffness")
    quantity.box.value = typed
    assert inputs.pad_stiffness == value
    assert 10 * 10 ** (quantity.slider.value / 100) == pytest.approx(value)
    assert not quantity.box.error_state


NO_NUMBERS = ["abc", "", "880kg", "nan", "<img src=x onerror=alert(1)>"]
BEYOND_THE_RANGE = ["5,3", "9.9", "2001", "-100", "inf", "1e999"]


@pytest.mark.parametrize(
    ("typed", "advice"),
    [(typed, "give a number, 10 to 2000") for typed in NO_NUMBERS]
    + [(typed, "give 10 to 2000") for typed in BEYOND_THE_RANGE],
)
def test_nonsense_changes_nothing_and_is_told(inputs, control, typed, advice):
    quantity = control("pad_stiffness")
    quantity.box.value = typed
    assert inputs.pad_stiffness == 100
    assert quantity.box.error_state
    assert quantity.box.helper_text == advice


def test_a_number_clears_the_complaint(inputs, control):
    quantity = control("pad_stiffness")
    quantity.box.value = "abc"
    quantity.box.value = "250"
    assert inputs.pad_stiffness == 250
    assert not quantity.box.error_state
    assert quantity.box.helper_text == ""


def test_moving_the_slider_clears_the_complaint(control):
    quantity = control("pad_stiffness")
    quantity.box.value = "abc"
    quantity.slider.value = 150
    assert quantity.box.value == "316"
    assert not quantity.box.error_state


def test_reverting_clears_the_complaint(inputs):
    controls = Controls(inputs)
    box = controls.quantities["wheel_mass"].box
    inputs.pad_stiffness = 200
    box.value = "abc"
    controls.revert.param.trigger("clicks")
    assert (box.value, box.error_state) == ("880", False)


def test_boxes_have_a_name_for_screen_readers(inputs, control):
    for name in NUMBERS:
        assert inputs.param[name].label in control(name).box.label


def test_a_preset_moves_sliders_boxes_and_switch(inputs):
    controls = Controls(inputs)
    controls.preset.value = "booted-sleeper"
    assert inputs.to_design() == tig.PRESETS["booted-sleeper"]
    assert controls.quantities["block_mass"].box.value == "210"
    assert controls.quantities["block_mass"].slider.value == 200
    assert controls.quantities["boot_stiffness"].slider.value == pytest.approx(100 * math.log10(31.5 / 2))
    controls.preset.value = "slab-track"
    assert controls.two_stage.value is False


def test_single_stage_disables_block_and_boot_and_nothing_else(inputs):
    controls = Controls(inputs)
    controls.two_stage.value = False
    for name, quantity in controls.quantities.items():
        assert quantity.slider.disabled == (name in SECOND_STAGE)
        assert quantity.box.disabled == (name in SECOND_STAGE)
    controls.two_stage.value = True
    assert not any(quantity.slider.disabled for quantity in controls.quantities.values())


def test_modified_is_shown_with_a_way_back(inputs):
    controls = Controls(inputs)
    assert (controls.state.object, controls.revert.disabled) == ("As in Table 1", True)
    controls.quantities["block_mass"].slider.value = 50
    assert (controls.state.object, controls.revert.disabled) == ("Modified", False)
    controls.revert.param.trigger("clicks")
    assert inputs.to_design() == tig.PRESETS["booted-block-low-mass"]
    assert (controls.state.object, controls.revert.disabled) == ("As in Table 1", True)
    assert controls.quantities["block_mass"].slider.value == 35


def test_sliders_mark_the_preset_s_value(inputs):
    controls = Controls(inputs)
    slider = controls.quantities["boot_stiffness"].slider
    assert slider.marks == [{"value": pytest.approx(100 * math.log10(14))}]
    inputs.preset = "booted-block-high-mass"
    assert slider.marks == [{"value": pytest.approx(100 * math.log10(7))}]
    inputs.preset = "slab-track"
    assert slider.marks is False


def test_the_rail_section_can_be_chosen(inputs):
    controls = Controls(inputs)
    assert list(controls.rail.options.values()) == list(tig.RAILS)
    controls.rail.value = "49E1"
    assert inputs.to_design().rail == tig.RAILS["49E1"]


def test_contact_stiffness_is_advanced_but_there(inputs):
    controls = Controls(inputs)
    assert controls.advanced.active == []
    controls.quantities["contact_stiffness"].box.value = "2000"
    assert inputs.to_design().contact_stiffness == 2e9
