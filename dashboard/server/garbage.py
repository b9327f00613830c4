"""Has garbage looked for while nobody works.

Looking through all objects of thirty open pages takes 0.4 s, in which no picture is drawn. Python does it
every ten seconds or so of such a workshop, and Panel five seconds after somebody has left. Here it is done
once pages have gone and nobody works, after twenty seconds at the latest. What is left is then set aside, and
so is what pages are made of that have come: Python's own looks go through what is newer alone.

What is freed goes back to the system at the same time. glibc would keep it: each thread that solves has a
heap of its own, where the large arrays of a run leave their room behind.
"""

import asyncio
import ctypes
import gc
from contextlib import suppress

from panel.io import document as panel_document

from dashboard.compute.pacing import PACE

LATEST = 20.0
"""Time after which it is done even though somebody works [s]."""

_M_ARENA_MAX = -8
"""glibc's number of the option that says how many heaps there may be (malloc.h)."""


class Sweeper:
    """Looks for garbage, and sets aside what is none, when it is told that pages have come or gone.

    Parameters
    ----------
    pace : Pace
        Knows whether somebody works.
    """

    def __init__(self, pace):
        self._pace, self._task, self._is_due = pace, None, False

    def install(self):
        """Have it take the place of what Panel does when a session has ended, in this process."""
        panel_document._garbage_collect = self.note_gone

    def note_come(self):
        """Note, on the event loop, that a page has come."""
        if self._task is None or self._task.done():
            self._task = asyncio.get_running_loop().create_task(self._act_at_leisure())

    def note_gone(self):
        """Note, on the event loop, that a page has gone, which leaves garbage."""
        self._is_due = True
        self.note_come()

    async def _act_at_leisure(self):
        with suppress(TimeoutError):
            await asyncio.wait_for(self._pace.idle(), LATEST)
        # what a page is made of is set aside unseen: that takes no time, and what of it is garbage can wait
        sweep() if self._is_due else gc.freeze()
        self._is_due = False


def sweep():
    """Free what nothing refers to any more, give the system its memory back, set aside what is left."""
    gc.unfreeze()
    gc.collect()
    _c_library("malloc_trim", 0)
    gc.freeze()


def share_heap():
    """Have threads that begin from now on share one heap of the C library."""
    _c_library("mallopt", _M_ARENA_MAX, 1)


def _c_library(name, *arguments):
    """Call a function of glibc that takes whole numbers; nothing happens with another C library."""
    with suppress(AttributeError):
        getattr(ctypes.pythonapi, name)(*arguments)


SWEEPER = Sweeper(PACE)
"""That of this process."""
