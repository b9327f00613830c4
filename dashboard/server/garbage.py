"""Has garbage looked for while nobody works.

Looking through all objects of thirty open pages takes 0.4 s, in which no picture is drawn. Python does it
every ten seconds or so of such a workshop, and Panel five seconds after somebody has left. Here it is done
once pages have come or gone and nobody works, after twenty seconds at the latest, since pages that have gone
wait for it; what is left is then set aside, so that Python's own looks go through what has come since.
"""

import asyncio
import gc
from contextlib import suppress

from panel.io import document as panel_document

from dashboard.compute.pacing import PACE

LATEST = 20.0
"""Time after which it is done even though somebody works [s]."""


class Sweeper:
    """Looks for garbage when it is told that there may be some.

    Parameters
    ----------
    pace : Pace
        Knows whether somebody works.
    """

    def __init__(self, pace):
        self._pace, self._task = pace, None

    def install(self):
        """Have it take the place of what Panel does when a session has ended, in this process."""
        panel_document._garbage_collect = self.call

    def call(self):
        """Note, on the event loop, that a page has come or gone."""
        if self._task is None or self._task.done():
            self._task = asyncio.get_running_loop().create_task(self._sweep_at_leisure())

    async def _sweep_at_leisure(self):
        with suppress(TimeoutError):
            await asyncio.wait_for(self._pace.idle(), LATEST)
        sweep()


def sweep():
    """Free what nothing refers to any more, and set aside what is left."""
    gc.unfreeze()
    gc.collect()
    gc.freeze()


SWEEPER = Sweeper(PACE)
"""That of this process."""
