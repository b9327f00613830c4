"""Undo and redo against a plain timeline, and with the inputs of a page."""

import pytest
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, invariant, precondition, rule

from dashboard.fields import INPUTS
from dashboard.session.history import History
from dashboard.session.inputs import DesignInputs

MOST = 5
PAUSE = 1.0


class Timeline(RuleBasedStateMachine):
    """All states in a row, and where on it the user stands."""

    def __init__(self):
        super().__init__()
        self.history = History(0, PAUSE, MOST)
        self.row, self.here = [0], 0
        self.now, self.last = 0.0, None

    @rule(state=st.integers(0, 3), names=st.sampled_from([("a",), ("b",), ("a", "b")]), wait=st.floats(0, 2))
    def note(self, state, names, wait):
        self.now += wait
        self.history.note(state, names, self.now)
        if state == self.row[self.here]:
            return
        kept = self.row[: self.here + 1]
        if self.last is not None and self.last[0] == {*names} and self.now - self.last[1] <= PAUSE:
            kept.pop()
        there_and_back = len(kept) < self.here + 1 and kept[-1] == state
        self.row = kept if there_and_back else [*kept, state]
        self.row = self.row[-MOST - 1 :]
        self.here = len(self.row) - 1
        self.last = None if there_and_back else ({*names}, self.now)

    @precondition(lambda self: self.here > 0)
    @rule()
    def undo(self):
        self.here, self.last = self.here - 1, None
        assert self.history.undo() == self.row[self.here]

    @precondition(lambda self: self.here < len(self.row) - 1)
    @rule()
    def redo(self):
        self.here, self.last = self.here + 1, None
        assert self.history.redo() == self.row[self.here]

    @invariant()
    def agree(self):
        assert self.history.state == self.row[self.here]
        assert self.history.can_undo == (self.here > 0)
        assert self.history.can_redo == (self.here < len(self.row) - 1)


TestTimeline = Timeline.TestCase


def test_a_drag_is_one_step():
    history = History(45)
    for count, value in enumerate((46, 47, 48, 60)):
        history.note(value, ["block_mass"], 0.1 * count)
    assert history.undo() == 45
    assert not history.can_undo
    assert history.redo() == 60


def test_a_pause_or_another_input_begins_a_step():
    history = History("start")
    history.note("a", ["block_mass"], 0.0)
    history.note("b", ["block_mass"], 5.0)
    history.note("c", ["pad_stiffness"], 5.1)
    assert [history.undo() for _ in range(3)] == ["b", "a", "start"]


def test_a_drag_after_undo_does_not_join_the_drag_before():
    history = History(1)
    history.note(2, ["x"], 0.0)
    history.undo()
    history.note(3, ["x"], 0.1)
    assert not history.can_redo
    assert history.undo() == 1


def test_nothing_to_undo_is_an_error_of_the_caller():
    with pytest.raises(IndexError):
        History(0).undo()


def page():
    """Return inputs and their history, as a page joins them; every change comes ten seconds later."""
    inputs = DesignInputs()
    history = History(inputs.to_values())
    clock = iter(range(0, 1000, 10))
    inputs.param.watch(
        lambda *events: history.note(inputs.to_values(), {each.name for each in events}, next(clock)),
        list(INPUTS),
    )
    return inputs, history


def test_inputs_go_back_and_forth():
    inputs, history = page()
    opening = inputs.to_values()
    inputs.boot_stiffness = 12
    inputs.two_stage = False
    changed = inputs.to_values()
    inputs.take(history.undo())
    inputs.take(history.undo())
    assert inputs.to_values() == opening
    assert not inputs.modified
    assert not history.can_undo
    inputs.take(history.redo())
    inputs.take(history.redo())
    assert inputs.to_values() == changed
    assert not history.can_redo


def test_a_preset_is_one_step():
    inputs, history = page()
    inputs.block_mass = 77
    tuned = inputs.to_values()
    inputs.preset = "slab-track"
    inputs.take(history.undo())
    assert inputs.to_values() == tuned
    assert inputs.modified


def test_a_gesture_is_one_step_however_slowly_it_is_told():
    history = History(0)
    for now, state in enumerate((1, 2, 3)):
        history.note(state, ["mass"], 10.0 * now, gesture=1)
    history.note(4, ["mass"], 100.0, gesture=2)
    assert history.undo() == 3
    assert history.undo() == 0
    assert not history.can_undo


def test_changes_of_no_gesture_are_told_apart_by_time():
    history = History(0)
    for now, state in enumerate((1, 2)):
        history.note(state, ["mass"], 10.0 * now)
    assert history.undo() == 1
