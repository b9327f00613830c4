"""What stands in a slider's place is the design's, until a hand moves the slider; undo brings it back."""

import pytest

import trackig_core as tig
from dashboard.session.inputs import DesignInputs, values_of
from dashboard.session.special import OWN_RAIL, input_text, six_figures_of, special_values

BLOCK = tig.PRESETS["booted-block-low-mass"]
CURVE = tig.StiffnessCurve([(5, 20e6, 0.1), (500, 30e6, 0.2)])
LOSS = tig.LossFactorCurve([(5, 0.1), (500, 0.2)])
MEASURED = BLOCK.replace(boot_stiffness=CURVE, boot_loss_factor=None)
RAIL = tig.Rail("worn", 58.0, 6e6)


@pytest.fixture
def inputs():
    return DesignInputs()


def taken(inputs, **changes):
    """Let inputs hold the opening design, changed."""
    inputs.take(values_of(BLOCK.replace(**changes)))
    return inputs


@pytest.mark.parametrize("design", tig.PRESETS.values(), ids=tig.PRESETS)
def test_nothing_is_special_of_table_1(design):
    assert special_values(design) == {}


@pytest.mark.parametrize(
    ("changes", "moved", "left"),
    [
        ({"boot_stiffness": CURVE, "boot_loss_factor": None}, {"boot_stiffness": 30.0}, 0.2),
        ({"boot_stiffness": 300e6}, {"boot_stiffness": 30.0}, 0.2),
        ({"boot_stiffness": 30.1234567e6}, {"boot_stiffness": 30.0}, 0.2),
    ],
)
def test_a_slider_that_is_moved_takes_the_place_of_what_was_special(inputs, changes, moved, left):
    taken(inputs, **changes)
    assert inputs.to_design() == BLOCK.replace(**changes)
    assert inputs.modified
    inputs.take_given(moved)
    assert inputs.to_design() == BLOCK.replace(boot_stiffness=30e6, boot_loss_factor=left)


def test_other_sliders_leave_what_is_special_alone(inputs):
    taken(inputs, boot_stiffness=CURVE, boot_loss_factor=None, rail=RAIL).take_given({"wheel_mass": 700})
    assert inputs.to_design() == MEASURED.replace(rail=RAIL, wheel_mass=700.0)


def test_a_program_that_sets_a_slider_takes_its_place_too(inputs):
    taken(inputs, boot_stiffness=CURVE, boot_loss_factor=None).boot_stiffness = 31.0
    assert inputs.to_design() == BLOCK.replace(boot_stiffness=31e6)


@pytest.mark.parametrize("way_back", [lambda each: each.revert(), lambda each: each.take(values_of(BLOCK))])
def test_table_1_ends_all_that_is_special(inputs, way_back):
    way_back(taken(inputs, pad_loss_factor=LOSS, rail=RAIL, stiffness_frequency=10.0))
    assert inputs.to_design() == BLOCK
    assert not inputs.modified


def test_a_curve_of_the_boot_waits_while_there_is_no_boot(inputs):
    taken(inputs, boot_stiffness=CURVE, boot_loss_factor=None, boot_static_stiffness=9e6)
    inputs.take_given({"two_stage": False})
    assert inputs.to_design().boot_stiffness is None
    inputs.take_given({"two_stage": True})
    assert inputs.to_design() == MEASURED.replace(boot_static_stiffness=9e6)


def test_undo_brings_back_what_was_special(session):
    session.inputs.take(values_of(MEASURED))
    session.inputs.take_given({"boot_stiffness": "25"}, gesture=1)
    session.snapshot.steps.undo()
    assert session.inputs.to_design() == MEASURED
    session.snapshot.steps.redo()
    assert session.inputs.to_design() == BLOCK.replace(boot_stiffness=25e6)


def test_a_loss_factor_is_taken_up_to_two_and_the_slider_follows(inputs):
    inputs.take_given({"boot_loss_factor": "1.8"})
    assert inputs.to_design().boot_loss_factor == 1.8
    assert (inputs.to_shown()["boot_loss_factor"], inputs.refused) == (1.8, {})
    inputs.take_given({"boot_loss_factor": "2"})
    assert inputs.to_design().boot_loss_factor == 2.0
    inputs.take_given({"boot_loss_factor": "2.1"})
    assert inputs.to_design().boot_loss_factor == 2.0
    assert inputs.refused == {"boot_loss_factor": "give 0.01 to 2"}
    inputs.take_given({"boot_loss_factor": "0.3"})
    assert (inputs.to_design().boot_loss_factor, inputs.special, inputs.refused) == (0.3, {}, {})


def test_a_number_beyond_the_slider_extends_it_and_stays_within_reach(inputs):
    taken(inputs, boot_stiffness=300e6)
    assert inputs.to_shown()["boot_stiffness"] == 300
    inputs.take_given({"boot_stiffness": 250})
    assert inputs.to_design().boot_stiffness == 250e6
    inputs.take_given({"boot_stiffness": 299})
    assert (inputs.to_design().boot_stiffness, inputs.refused) == (299e6, {})
    inputs.take_given({"boot_stiffness": "301"})
    assert inputs.refused == {"boot_stiffness": "give 2 to 300 kN/mm"}
    assert inputs.to_design().boot_stiffness == 299e6


def test_a_rail_of_one_s_own_begins_as_the_one_that_was_chosen(inputs):
    inputs.take_given({"rail": "54E1"})
    inputs.take_given({"rail": OWN_RAIL})
    own, known = inputs.to_design().rail, tig.RAILS["54E1"]
    assert (own.mass_per_metre, own.bending_stiffness) == (known.mass_per_metre, known.bending_stiffness)
    assert inputs.to_shown()["rail"] == OWN_RAIL
    inputs.take_given({"mass_per_metre": "58 kg/m", "bending_stiffness": 6.25})
    assert inputs.to_design().rail == tig.Rail(OWN_RAIL, 58.0, 6.25e6)
    inputs.take_given({"rail": "49E1"})
    assert inputs.to_design().rail == tig.RAILS["49E1"]
    assert inputs.to_shown()["mass_per_metre"] == 49.39


def test_a_rail_keeps_its_name_when_its_numbers_change(inputs):
    taken(inputs, rail=RAIL).take_given({"mass_per_metre": 57})
    assert inputs.to_design().rail == tig.Rail("worn", 57.0, 6e6)


def test_a_rail_that_cannot_be_is_refused_with_advice(inputs):
    taken(inputs, rail=RAIL).take_given({"bending_stiffness": "0.1"})
    assert inputs.refused == {"bending_stiffness": "give 0.5 to 20 MN m²"}
    assert inputs.to_design().rail == RAIL


@pytest.mark.parametrize(
    ("field", "text"),
    [
        ("boot_stiffness", "measured at 2 frequencies, 5 to 500 Hz"),
        ("boot_loss_factor", "in the stiffness table"),
        ("pad_loss_factor", "measured at 2 frequencies, 5 to 500 Hz"),
        ("rail", "worn: 58 kg/m, 6 MN m²"),
    ],
)
def test_tables_say_what_is_special(field, text):
    assert input_text(MEASURED.replace(rail=RAIL, pad_loss_factor=LOSS), field) == text


def test_a_design_that_was_found_is_taken_to_six_figures():
    given = MEASURED.replace(block_mass=93.1234567)
    found = six_figures_of(given.replace(pad_stiffness=101.2345678e6, rail=RAIL), given)
    assert found == given.replace(pad_stiffness=101.235e6, rail=RAIL)
