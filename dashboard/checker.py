"""Holds the picture against theory while somebody looks at the checks, off the event loop.

The one rule: nothing is checked that nobody looks at, and only the newest picture is.
"""

import asyncio
from functools import lru_cache

import panel as pn

import trackig_core as tig
from dashboard.runner import publish, readable, workers
from dashboard.state import Checked

CAPACITY = 64
"""Checked pictures kept; one holds some 0.2 MB."""


@lru_cache(maxsize=CAPACITY)
def check(picture):
    """Return a picture with what theory says of it.

    Parameters
    ----------
    picture : Picture
        What is checked.

    Returns
    -------
    Checked
        The exact answers, or why there are none.
    """
    try:
        return Checked(picture, tig.verify(picture.solution))
    except Exception as error:
        return Checked(picture, None, readable(error))


class Checker:
    """Watches an outcome and keeps its checks up to date while they are looked at.

    Parameters
    ----------
    outcome : Outcome
        What is watched and kept up to date.
    """

    def __init__(self, outcome):
        self._outcome = outcome
        self._pending = False
        self._running = False
        outcome.param.watch(self._on_change, ["picture", "checking"])

    async def _on_change(self, *_):
        self._pending = True
        if self._running:
            return
        self._running, document = True, pn.state.curdoc
        try:
            while self._pending:
                self._pending = False
                picture = self._outcome.picture
                if self._outcome.checking and picture is not None:
                    checked = await asyncio.get_running_loop().run_in_executor(workers(), check, picture)
                    publish(self._outcome, document, checked=checked)
        finally:
            self._running = False
