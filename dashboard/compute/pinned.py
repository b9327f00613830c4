"""The pictures of pinned designs: the paper's runs, solved off the event loop, from the sessions' store.

A session asks for one of them at a time, so that its pins never take every worker from the current designs.
A pin that the store knows has its picture at once, and a pin that is gone has none.
"""

import asyncio
import logging
from functools import partial
from types import MappingProxyType

import param

from dashboard.compute.document import one_message
from dashboard.compute.latest import Latest, readable
from dashboard.compute.runner import LOOK_EVERY
from dashboard.compute.workers import AT_REST, key_of

NOTHING = MappingProxyType({})

log = logging.getLogger(__name__)


class PinnedSummaries(param.Parameterized):
    """What is there of each pinned design.

    Parameters
    ----------
    pins : Pins
        What is watched; there are never more pictures than pins.
    store : SolutionStore
        Where pictures at rest come from.
    """

    summaries = param.Parameter(default=NOTHING, doc="Picture of each pin that has one, by the pin's key.")
    problems = param.Parameter(default=NOTHING, doc="Why a pin has none and will get none, by its key.")

    def __init__(self, pins, store):
        super().__init__()
        self._pins, self._store = pins, store
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
            kept = self._store.kept(key_of(pin.design, AT_REST))
            if kept is not None:
                summaries[pin.key] = kept.of_design(pin.design)
        if summaries != self.summaries or problems != self.problems:
            self.param.update(summaries=MappingProxyType(summaries), problems=MappingProxyType(problems))

    def _of_pinned(self, by_key):
        """Return what there is of the pins that are still pinned."""
        return {pin.key: by_key[pin.key] for pin in self._pins.pinned if pin.key in by_key}

    def _missing(self):
        return [
            pin for pin in self._pins.pinned if pin.key not in self.summaries and pin.key not in self.problems
        ]

    async def _obtain_missing(self, document):
        for pin in self._missing():
            if not self._wanted(pin):
                continue
            try:
                summary = await self._obtain(pin)
            except Exception as error:
                self._publish(document, pin, "problems", readable(error))
            else:
                if summary is not None:
                    self._publish(document, pin, "summaries", summary)

    async def _obtain(self, pin):
        """Return the picture of a pin, or None if it was removed meanwhile."""
        job = self._store.request(key_of(pin.design, AT_REST), owner=self)
        try:
            future = asyncio.wrap_future(job.future)
            # an abandoned job may still raise; nobody is left to hear it
            future.add_done_callback(lambda done: done.cancelled() or done.exception())
            while self._wanted(pin) and not future.done():
                await asyncio.wait({future}, timeout=LOOK_EVERY)
            return future.result().of_design(pin.design) if future.done() else None
        finally:
            self._store.release(job)

    def _wanted(self, pin):
        return not self._closed and any(each.key == pin.key for each in self._pins.pinned)

    def _publish(self, document, pin, name, value):
        # what watches may draw, and models change only under the lock that a next-tick callback holds
        if document is None or document.session_context is None:
            self._put(pin, name, value)
        else:
            document.add_next_tick_callback(partial(self._put, pin, name, value, document))

    def _put(self, pin, name, value, document=None):
        if not self._wanted(pin):
            return
        try:
            with one_message(document):
                setattr(self, name, MappingProxyType({**getattr(self, name), pin.key: value}))
        except Exception:
            log.exception("A pinned design could not be drawn")
