"""Paces what pages are made of, so that an open page is hardly held up by those that open.

The server's event loop does one thing at a time, and a message of a page takes a dozen of its turns: if a
page that opens took every other turn for one of its parts, each message would wait for a dozen parts. So
parts begin one at a time for all pages of the process, and whoever works at an open page comes first, for a
while. How long drawing takes says whether the server is busy; some work is then left for later.
"""

import asyncio
import logging
import time
from contextvars import copy_context
from heapq import heappop, heappush
from itertools import count
from weakref import WeakSet

QUIET = 0.02
"""Time without a message from an open page after which the next part begins [s]."""

PATIENCE = 0.15
"""Time that a part waits for those who work, at most [s]."""

BREATH = 0.002
"""Time after a part began in which the event loop comes to it [s]."""

IDLE = 1.0
"""Time in which nobody works and no page opens after which something is done that nobody waits for [s]."""

BUSY = 0.1
"""Time that a picture waits for its turns on a server that is busy with others; alone a third of that [s]."""

CALMING = 0.8
"""What is left of the longest wait for a picture after each one that came sooner [-]."""

log = logging.getLogger(__name__)


class Pace:
    """Has pieces of work begin one after the other, each when nobody at an open page is heard."""

    def __init__(self):
        self._waiting, self._order = [], count()
        self._opening = WeakSet()
        self._heard = -PATIENCE
        self._worked = -IDLE
        self._drawing = 0.0
        self._task = None

    @property
    def is_busy(self):
        """Whether pages wait for their pictures longer than one would alone."""
        return self._drawing > BUSY

    def drew(self, seconds):
        """Note how long a picture waited for its turns [s]; a server is busy until several came soon."""
        self._drawing = max(seconds, CALMING * self._drawing)

    def hear(self, document):
        """Note that a page sent something; one that opens does not count as one where somebody works.

        Parameters
        ----------
        document : bokeh.document.Document
            The session's.
        """
        self._worked = time.monotonic()
        if document not in self._opening:
            self._heard = self._worked

    def enter(self, document):
        """Note that a page, or a part of it, opens."""
        self._worked = time.monotonic()
        self._opening.add(document)

    def leave(self, document):
        """Note that all of it is there."""
        self._opening.discard(document)

    def begin(self, work, is_new=False):
        """Have work begin in its turn, on the running event loop.

        Parameters
        ----------
        work : callable
            Takes no arguments; it only has something begin.
        is_new : bool
            Whether it is for a page that has not begun; those that have begun come first.
        """
        # it is done for who asked: the context says whose document is current
        heappush(self._waiting, (is_new, next(self._order), copy_context(), work))
        # an event loop that has ended leaves a task that is done
        if self._task is None or self._task.done():
            self._task = asyncio.get_running_loop().create_task(self._pace())

    async def turn(self):
        """Wait until a page that is new may begin."""
        turn = asyncio.get_running_loop().create_future()
        self.begin(lambda: turn.done() or turn.set_result(None), is_new=True)
        await turn

    async def idle(self):
        """Wait until nobody has worked and no page has opened for a while."""
        while (left := self._worked + IDLE - time.monotonic()) > 0:
            await asyncio.sleep(left)

    async def _pace(self):
        while self._waiting:
            await self._until_quiet()
            *_, context, work = heappop(self._waiting)
            try:
                context.run(work)
            except Exception:
                log.exception("A part of a page could not begin")
            await asyncio.sleep(BREATH)

    async def _until_quiet(self):
        now = began = time.monotonic()
        while now - self._heard < QUIET and now - began < PATIENCE:
            await asyncio.sleep(QUIET / 4)
            now = time.monotonic()


PACE = Pace()
"""That of this process."""
