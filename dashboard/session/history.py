"""Undo and redo of what the user sets, step by step.

A drag moves an input many times; it is one step all the same. No clock and no inputs in
here; whoever notes a change says what changed and when, so that it can be tested without waiting.
"""

PAUSE = 1.0
"""Pause after which a further change of the same input is a step of its own [s]."""

MOST_STEPS = 100
"""Steps that can be undone; older ones are forgotten."""


class History:
    """The states that a user came through, and the one shown now.

    States can be anything that is not changed afterwards, such as the values of all inputs.

    Parameters
    ----------
    state : object
        What is shown at first.
    pause : float
        Pause after which a further change of the same input is a step of its own [s].
    most_steps : int
        Steps that can be undone, 1 or more.
    """

    def __init__(self, state, pause=PAUSE, most_steps=MOST_STEPS):
        self._state, self._pause, self._most_steps = state, pause, most_steps
        self._past, self._future = [], []
        self._moving, self._moved, self._gesture = None, None, None

    @property
    def state(self):
        """What is shown now."""
        return self._state

    @property
    def can_undo(self):
        """Whether there is a step to undo."""
        return bool(self._past)

    @property
    def can_redo(self):
        """Whether there is a step that was undone."""
        return bool(self._future)

    def note(self, state, names, now, gesture=None):
        """Note a change; what was undone before it cannot be redone any more.

        Parameters
        ----------
        state : object
            What is shown after the change; if it equals what was shown before, nothing is noted.
        names : iterable of str
            The inputs that changed. A change of the same inputs within the pause belongs to the same step.
        now : float
            When, by any clock that does not go back [s].
        gesture : int, optional
            Number of the gesture, such as a drag: one that goes on is one step, however slowly it is told.
        """
        if state == self._state:
            return
        names = frozenset(names)
        same_gesture = gesture is not None and gesture == self._gesture
        goes_on = names == self._moving and (same_gesture or now - self._moved <= self._pause)
        if not goes_on:
            self._past = [*self._past, self._state][-self._most_steps :]
        self._state, self._future = state, []
        self._moving, self._moved, self._gesture = names, now, gesture
        if goes_on and state == self._past[-1]:
            # moved there and back: no step at all
            self._past.pop()
            self._moving = None

    def undo(self):
        """Go back by a step, and return what is to be shown.

        Raises
        ------
        IndexError
            If there is none: ask :attr:`can_undo` first.
        """
        return self._step(self._past, self._future)

    def redo(self):
        """Go forward by a step that was undone, and return what is to be shown.

        Raises
        ------
        IndexError
            If there is none: ask :attr:`can_redo` first.
        """
        return self._step(self._future, self._past)

    def _step(self, origin, goal):
        target = origin.pop()
        goal.append(self._state)
        self._state, self._moving = target, None
        return target
