"""The pictures of pinned designs, solved off the event loop, from the sessions' stores.

Each has its exact curve first, a matter of milliseconds; the paper's run, which brings the force, takes its
place when it is there. A session asks for one run at a time, so that its pins never take every worker from
the current designs. A pin whose run the store knows has its picture at once, and a pin that is gone has none.
"""

import asyncio
import contextlib
import logging
from functools import partial
from types import MappingProxyType

import param

import trackig_core as tig
from dashboard.compute.document import on_next_tick, one_message
from dashboard.compute.latest import Latest, readable
from dashboard.compute.runner import LOOK_EVERY
from dashboard.compute.workers import AT_ONCE, AT_REST, key_of

NOTHING = MappingProxyType({})

log = logging.getLogger(__name__)


class PinnedSummaries(param.Parameterized):
    """What is there of each pinned design.

    Parameters
    ----------
    pins : Pins
        What is watched; there are never more pictures than pins.
    store, live_store : SolutionStore
        Where pictures at rest come from, and exact curves.
    """

    summaries = param.Parameter(default=NOTHING, doc="Picture of each pin that has one, by the pin's key.")
    problems = param.Parameter(default=NOTHING, doc="Why a pin's run has failed, by its key.")

    def __init__(self, pins, store, live_store):
        super().__init__()
        self._pins = pins
        self._stores = {AT_REST: store, AT_ONCE: live_store}
        self._latest = Latest(self._obtain_missing)
        self._closed = False
        self._watchers = [
            pins.param.watch(self._take_what_is_kept, "pinned"),
            pins.param.watch(self._latest.ask, "pinned"),
        ]
        if pins.pinned:
            pins.param.trigger("pinned")

    def close(self, *_):
        """Stop watching and solving: the session is over."""
        self._closed = True
        for watcher in self._watchers:
            self._pins.param.unwatch(watcher)

    def _take_what_is_kept(self, *_):
        summaries, problems = self._of_pinned(self.summaries), self._of_pinned(self.problems)
        for pin in self._missing():
            kept = self._stores[AT_REST].kept(key_of(pin.design, AT_REST))
            if kept is not None:
                summaries[pin.key] = kept.of_design(pin.design)
        if summaries != self.summaries or problems != self.problems:
            self.param.update(summaries=MappingProxyType(summaries), problems=MappingProxyType(problems))

    def _of_pinned(self, by_key):
        """Return what there is of the pins that are still pinned."""
        return {pin.key: by_key[pin.key] for pin in self._pins.pinned if pin.key in by_key}

    def _missing(self):
        """Return the pins whose run is neither there nor has failed."""
        return [
            pin
            for pin in self._pins.pinned
            if pin.key not in self.problems and self._fidelity(pin) != AT_REST
        ]

    def _fidelity(self, pin):
        """Return the fidelity of a pin's picture, or None where there is none."""
        summary = self.summaries.get(pin.key)
        return None if summary is None else summary.solution.fidelity

    async def _obtain_missing(self, document):
        await self._draw_exact(document)
        for pin in self._missing():
            # what was pinned meanwhile is drawn before the next run, which may take long
            await self._draw_exact(document)
            if not self._wanted(pin):
                continue
            try:
                summary = await self._obtain(pin, AT_REST)
            except Exception as error:
                self._publish(document, pin, "problems", readable(error))
            else:
                self._publish(document, pin, "summaries", summary)

    async def _draw_exact(self, document):
        """Give the exact curve to pins that have no picture, if they have such a curve."""
        for pin in self._missing():
            if self._fidelity(pin) is None:
                # what has no exact curve is explained by its run
                with contextlib.suppress(tig.DesignError):
                    self._publish(document, pin, "summaries", await self._obtain(pin, AT_ONCE))

    async def _obtain(self, pin, fidelity):
        """Return a picture of a pin, or None if it was removed meanwhile."""
        store = self._stores[fidelity]
        job = store.request(key_of(pin.design, fidelity), owner=self, urgent=fidelity == AT_ONCE)
        try:
            future = asyncio.wrap_future(job.future)
            # an abandoned job may still raise; nobody is left to hear it
            future.add_done_callback(lambda done: done.cancelled() or done.exception())
            while self._wanted(pin) and not future.done():
                await asyncio.wait({future}, timeout=LOOK_EVERY)
            return future.result().of_design(pin.design) if future.done() else None
        finally:
            store.release(job)

    def _wanted(self, pin):
        return not self._closed and any(each.key == pin.key for each in self._pins.pinned)

    def _publish(self, document, pin, name, value):
        # what watches it may draw
        on_next_tick(document, partial(self._put, pin, name, value))

    def _put(self, pin, name, value, document):
        # a run that was kept may have come before the curve that was asked for
        if not self._wanted(pin) or self._fidelity(pin) == AT_REST:
            return
        try:
            with one_message(document):
                setattr(self, name, MappingProxyType({**getattr(self, name), pin.key: value}))
        except Exception:
            log.exception("A pinned design could not be drawn")
