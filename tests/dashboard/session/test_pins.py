"""Pinned designs: bounded, told apart, and the same when they are put back."""

import pytest

import trackig_core as tig
from dashboard.session.inputs import DesignInputs, values_of
from dashboard.session.pins import PinError, Pins, distinct_colours
from dashboard.theme import MOST_PINNED
from trackig_core.names import LONGEST_NAME

SLEEPER = tig.PRESETS["booted-sleeper"]


def changes(pins):
    """Return a list that grows with every change."""
    seen = []
    pins.param.watch(lambda *events: seen.append({each.name for each in events}), ["pinned", "base"])
    return seen


def names(pins):
    return [pin.name for pin in pins.pinned]


def test_a_pin_is_solved_and_put_back_as_it_was():
    inputs = DesignInputs()
    inputs.two_stage = False
    inputs.fastener_spacing = 0.65
    pin = Pins().add(inputs.to_design(), "Wide slab", inputs.preset)
    assert pin.design == inputs.to_design()
    other = DesignInputs()
    other.take(values_of(pin.design, pin.preset))
    assert other.to_values() == inputs.to_values()


def test_what_a_single_stage_pin_lacks_stays_as_the_sliders_have_it():
    inputs = DesignInputs(block_mass=77.0, boot_stiffness=13.0)
    inputs.take(values_of(tig.PRESETS["slab-track"], "slab-track"))
    assert inputs.to_design() == tig.PRESETS["slab-track"]
    assert not inputs.modified
    assert (inputs.block_mass, inputs.boot_stiffness) == (77.0, 13.0)


def test_eight_designs_have_eight_colours_and_a_ninth_is_refused():
    pins = Pins()
    for _ in range(MOST_PINNED):
        pins.add(SLEEPER)
    assert {pin.colour for pin in pins.pinned} == {*range(MOST_PINNED)}
    assert len({*names(pins)}) == MOST_PINNED == 8
    before, seen = pins.pinned, changes(pins)
    with pytest.raises(PinError, match="8 designs are pinned, and 8 can be: remove 1 to pin 1 more"):
        pins.add(SLEEPER)
    assert pins.pinned == before
    assert seen == []


def test_a_colour_that_became_free_is_used_again_but_a_key_never():
    pins = Pins()
    first, second = pins.add(SLEEPER), pins.add(SLEEPER)
    pins.remove(first.key)
    third = pins.add(SLEEPER)
    assert third.colour == first.colour
    assert third.key not in (first.key, second.key)


def test_names_are_told_apart():
    pins = Pins()
    for name in ("Softer", "Softer", " Softer ", "", "x" * LONGEST_NAME, "x" * LONGEST_NAME):
        pins.add(SLEEPER, name)
    long = "x" * (LONGEST_NAME - 4)
    assert names(pins) == ["Softer", "Softer 2", "Softer 3", "Design 1", "x" * LONGEST_NAME, f"{long} 2"]


@pytest.mark.parametrize("name", ["x" * (LONGEST_NAME + 1), "two\nlines", "nul\0", "   ", "\u202egnirts"])
def test_names_that_cannot_be_shown_are_refused(name):
    pins = Pins()
    pin = pins.add(SLEEPER, "First")
    with pytest.raises(PinError, match="printable characters"):
        pins.rename(pin.key, name)
    assert names(pins) == ["First"]


def test_renaming():
    pins = Pins()
    first, second = pins.add(SLEEPER, "First"), pins.add(SLEEPER, "Second")
    pins.rename(first.key, " Best ")
    pins.rename(first.key, "Best")
    assert names(pins) == ["Best", "Second"]
    with pytest.raises(PinError, match="give another name"):
        pins.rename(second.key, "Best")


def test_recolouring_exchanges_colours():
    pins = Pins()
    first, second = pins.add(SLEEPER), pins.add(SLEEPER)
    seen = changes(pins)
    pins.recolour(first.key, second.colour)
    assert [pin.colour for pin in pins.pinned] == [second.colour, first.colour]
    pins.recolour(first.key, 7)
    assert [pin.colour for pin in pins.pinned] == [7, first.colour]
    assert len(seen) == 2
    with pytest.raises(PinError, match="no colour 8"):
        pins.recolour(first.key, 8)


def test_hidden_pins_stay():
    pins = Pins()
    first, second = pins.add(SLEEPER), pins.add(SLEEPER)
    pins.show(first.key, False)
    assert [pin.key for pin in pins.shown] == [second.key]
    assert len(pins.pinned) == 2
    pins.show(first.key)
    assert len(pins.shown) == 2


def test_the_base_of_differences_goes_with_its_pin():
    pins = Pins()
    pin = pins.add(SLEEPER)
    pins.choose_base(pin.key)
    assert pins[pins.base] == pin
    seen = changes(pins)
    pins.remove(pin.key)
    assert pins.base is None
    assert seen == [{"pinned", "base"}]


def test_a_removed_pin_is_missed_in_words():
    pins = Pins()
    key = pins.add(SLEEPER).key
    pins.remove(key)
    for act in (pins.remove, pins.show, pins.choose_base, lambda key: pins.rename(key, "x")):
        with pytest.raises(PinError, match="pinned no longer"):
            act(key)


def test_table_1_is_pinned_once_and_as_published():
    pins = Pins()
    seen = changes(pins)
    pins.add_table_1()
    assert [pin.design for pin in pins.pinned] == [*tig.PRESETS.values()]
    assert pins.add_table_1() == ()
    pins.remove(pins.pinned[1].key)
    (again,) = pins.add_table_1()
    assert again.design == tig.PRESETS["booted-sleeper"]
    assert len(seen) == 3


def test_when_no_pin_is_left_the_current_design_is_drawn_again():
    pins = Pins()
    pins.show_table_1()
    for pin in pins.pinned:
        assert pins.alone
        pins.remove(pin.key)
    assert not pins.alone


def test_table_1_is_pinned_whole_or_not_at_all():
    pins = Pins()
    for _ in range(6):
        pins.add(SLEEPER.replace(block_mass=99.0))
    with pytest.raises(PinError, match="6 designs are pinned, and 8 can be: remove 2 to pin 4 more"):
        pins.add_table_1()
    assert len(pins.pinned) == 6


def test_pins_from_elsewhere_replace_all_as_one_change():
    pins, other = Pins(), Pins()
    old = pins.add(SLEEPER, "Old")
    other.add_table_1()
    seen = changes(pins)
    pins.replace_all(other.pinned, base=2)
    assert names(pins) == names(other)
    assert pins[pins.base].name == other.pinned[2].name
    assert old.key not in [pin.key for pin in pins.pinned]
    assert seen == [{"pinned", "base"}]


def test_pins_from_elsewhere_must_differ():
    pins = Pins()
    pins.add(SLEEPER, "Old")
    one, two = tig.PinnedDesign("One", SLEEPER), tig.PinnedDesign("Two", SLEEPER)
    with pytest.raises(PinError, match="one colour"):
        pins.replace_all([one, two])
    with pytest.raises(PinError, match="too many"):
        pins.replace_all([one] * 9)
    assert names(pins) == ["Old"]


@pytest.mark.parametrize(
    "changes",
    [
        {"block_mass": 9e3},
        {"boot_stiffness": tig.StiffnessCurve([(5, 9e6, 0.1), (500, 15e6, 0.2)]), "boot_loss_factor": None},
        {"rail": tig.Rail("worn", 58.0, 6e6)},
        {"stiffness_frequency": 10.0},
    ],
    ids=str,
)
def test_a_design_that_no_slider_shows_is_put_back_as_it_was_pinned(changes):
    inputs = DesignInputs()
    pin = Pins().add(SLEEPER.replace(**changes))
    inputs.take(values_of(pin.design, pin.preset))
    assert inputs.to_design() == pin.design
    inputs.take(values_of(SLEEPER))
    assert inputs.to_design() == SLEEPER


@pytest.mark.parametrize(
    ("wanted", "given"),
    [((), ()), ((4, 1), (4, 1)), ((0, 0, 1), (0, 2, 1)), ((7,) * MOST_PINNED, (7, *range(MOST_PINNED - 1)))],
)
def test_designs_that_want_one_colour_get_their_own(wanted, given):
    assert distinct_colours(wanted) == given
