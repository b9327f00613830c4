"""Undo and redo of all that a user makes: design, pinned designs, specification, source, definition, name.

A step is what a hand did in one go, whether it dragged, typed, chose, pinned, removed or opened a file.
"""

import contextlib
import time

import param

from dashboard.fields import INPUTS
from dashboard.session.history import History


class Steps(param.Parameterized):
    """Watches what a user makes, and takes it back step by step.

    Parameters
    ----------
    inputs : DesignInputs
        The current design.
    definition : GainDefinition
        Which insertion gain is shown.
    pins : Pins
        The pinned designs.
    assessment : Assessment
        Specification, source and the study's name.
    clock : callable
        Any clock that does not go back [s].
    """

    can_undo = param.Boolean(default=False, doc="Whether there is a step to undo.")
    can_redo = param.Boolean(default=False, doc="Whether there is a step that was undone.")

    def __init__(self, inputs, definition, pins, assessment, clock=time.monotonic):
        super().__init__()
        self._inputs, self._clock = inputs, clock
        self._kept = (
            (definition, ("reference", "summation", "bands")),
            (pins, ("pinned", "base", "alone")),
            (assessment, ("specification", "source", "measured", "title")),
        )
        self._held = False
        self._history = History(self._state())
        inputs.param.watch(self._note_move, list(INPUTS))
        definition.param.watch(self._note_act, list(self._kept[0][1]))
        pins.param.watch(self._note_act, list(self._kept[1][1]))
        assessment.param.watch(self._note_move, list(self._kept[2][1]))

    def undo(self, *_):
        """Go back by a step, if there is one."""
        if self._history.can_undo:
            self._restore(self._history.undo())

    def redo(self, *_):
        """Go forward by a step that was undone, if there is one."""
        if self._history.can_redo:
            self._restore(self._history.redo())

    @contextlib.contextmanager
    def as_one(self):
        """Make one step of all that changes meanwhile, such as by a study that is opened."""
        with self._holding():
            yield
        self._note_act()

    def restart(self):
        """Take what there is now as the beginning, before which nothing is undone."""
        self._history = History(self._state())
        self._show()

    def _state(self):
        kept = ({name: getattr(part, name) for name in names} for part, names in self._kept)
        return (self._inputs.to_values(), *kept)

    def _restore(self, state):
        values, *kept = state
        with self._holding():
            for (part, _), each in zip(self._kept, kept, strict=True):
                part.param.update(**each)
            self._inputs.take(values)
        self._show()

    @contextlib.contextmanager
    def _holding(self):
        held, self._held = self._held, True
        try:
            yield
        finally:
            self._held = held

    def _note_move(self, *events):
        """Note a change that may go on: of a slider, or of a table as it is typed.

        What is special and of no gesture was chosen: a curve was used, or removed.
        """
        names, gesture = {event.name for event in events}, self._inputs.gesture
        if "special" in names and gesture is None:
            self._note_act()
        else:
            self._note(names, gesture)

    def _note_act(self, *_):
        """Note a change that is a step of its own."""
        self._note({object()})

    def _note(self, names, gesture=None):
        if not self._held:
            self._history.note(self._state(), names, self._clock(), gesture)
            self._show()

    def _show(self):
        self.param.update(can_undo=self._history.can_undo, can_redo=self._history.can_redo)
