"""Undo and redo of all that a user makes: each destructive act is a step, and comes back whole."""

import pytest

import trackig_core as tig
from dashboard.session.assessment import Assessment
from dashboard.session.inputs import DesignInputs, GainDefinition
from dashboard.session.pins import Pins
from dashboard.session.results import Outcome
from dashboard.session.steps import Steps

LIMITS = tig.Specification([(63, -3.0), (125, -5.0)], "Tunnel")
SOURCE = tig.SourceSpectrum([(31.5, 60.0)])


class Session:
    """What a user makes, and a clock that a test sets."""

    def __init__(self, make_pictures):
        self.inputs, self.definition, self.pins, self.now = DesignInputs(), GainDefinition(), Pins(), 0.0
        self.assessment = Assessment(self.inputs, Outcome(), self.definition, self.pins, make_pictures())
        self.steps = Steps(self.inputs, self.definition, self.pins, self.assessment, lambda: self.now)

    def state(self):
        """Return all that a user made."""
        kept = self.assessment.specification, self.assessment.source, self.assessment.title
        view = self.definition.reference, self.definition.summation, self.pins.alone
        return self.inputs.to_values(), self.pins.pinned, self.pins.base, kept, view


@pytest.fixture
def session(make_pictures):
    session = Session(make_pictures)
    session.pins.add_table_1()
    session.pins.choose_base(session.pins.pinned[1].key)
    session.assessment.param.update(specification=LIMITS, source=SOURCE)
    session.steps.restart()
    return session


ACTS = {
    "removing a pin": lambda each: each.pins.remove(each.pins.pinned[0].key),
    "removing the base": lambda each: each.pins.remove(each.pins.base),
    "renaming": lambda each: each.pins.rename(each.pins.pinned[0].key, "Another"),
    "hiding": lambda each: each.pins.show(each.pins.pinned[0].key, shown=False),
    "Figure 2 alone": lambda each: each.pins.show_table_1(),
    "clearing the specification": lambda each: each.assessment.param.update(specification=None),
    "clearing the source": lambda each: each.assessment.param.update(source=None),
    "another definition": lambda each: each.definition.param.update(reference="rigid"),
    "a preset": lambda each: each.inputs.param.update(preset="slab-track"),
}


@pytest.mark.parametrize("act", ACTS.values(), ids=ACTS)
def test_each_act_is_one_step_and_comes_back_whole(session, act):
    before = session.state()
    act(session)
    after = session.state()
    assert after != before
    assert (session.steps.can_undo, session.steps.can_redo) == (True, False)
    session.steps.undo()
    assert session.state() == before
    assert (session.steps.can_undo, session.steps.can_redo) == (False, True)
    session.steps.redo()
    assert session.state() == after


def test_two_pins_removed_at_once_come_back_one_by_one(session):
    first, second, *_ = session.pins.pinned
    session.pins.remove(first.key)
    session.pins.remove(second.key)
    session.steps.undo()
    assert session.pins.pinned[0].key == second.key
    session.steps.undo()
    assert [pin.key for pin in session.pins.pinned][:2] == [first.key, second.key]


def test_a_pin_that_came_back_does_not_share_its_key_with_a_later_one(session):
    gone = session.pins.pinned[3]
    session.pins.remove(gone.key)
    new = session.pins.add(tig.PRESETS["slab-track"], "Late")
    assert new.key != gone.key
    session.steps.undo()
    session.steps.undo()
    assert session.pins[gone.key] == gone


def test_all_that_a_file_changes_is_one_step(session):
    before = session.state()
    with session.steps.as_one():
        session.pins.replace_all(())
        session.assessment.param.update(specification=None, source=None, title="Other")
        session.inputs.preset = "slab-track"
    session.steps.undo()
    assert session.state() == before
    assert not session.steps.can_undo


def test_a_drag_after_an_act_is_a_step_of_its_own(session):
    session.pins.remove(session.pins.pinned[0].key)
    removed = session.state()
    for mass in (50.0, 60.0):
        session.now += 0.1
        session.inputs.block_mass = mass
    session.steps.undo()
    assert session.state() == removed


def test_with_nothing_to_undo_nothing_happens(session):
    before = session.state()
    session.steps.undo()
    session.steps.redo()
    assert session.state() == before
