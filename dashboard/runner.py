"""Turns changed inputs into a new outcome, off the event loop.

While one solve runs, the newest inputs wait in a single slot and all older ones are dropped, so a
dragged slider costs no more solves than fit. A solve that takes long gives way to newer inputs at
once; a short one is finished, so that pictures follow the slider. Solutions come from a store
that all sessions share.

The one rule: the last good picture stays until a better one is there.
"""

import asyncio
import functools
import logging
import os
import time
from concurrent.futures import ThreadPoolExecutor
from functools import partial

import panel as pn

import trackig_core as tig
from dashboard.state import PHYSICAL, Picture
from dashboard.store import SolutionStore

FIDELITY = "paper"
"""Which solver the pictures show."""

CAPACITY = 128
"""Pictures kept; one holds 0.2 MB for a record of 2 s, 1.6 MB for one of 16 s."""

LOOK_EVERY = 0.1
"""Seconds between looks at a solve under way."""

LONG = 2.0
"""Seconds of work after which a solve counts as long: it shows its progress, can be stopped, and gives way
to newer inputs. Time spent waiting for a worker does not count: else a busy server would finish none."""

STOPPED = "Stopped. The pictures show the last track that was solved."

NOT_DRAWN = "This solution could not be drawn; the server's log has the details."

log = logging.getLogger(__name__)


def take_picture(key, progress, cancelled):
    """Solve a design and keep what the views show.

    Parameters
    ----------
    key : tuple
        ``(design, fidelity)``.
    progress, cancelled : callable
        Handed on to :func:`trackig_core.solve`.

    Returns
    -------
    Picture
        The solution without its time history, and the two forces that are drawn; none of an exact one.
    """
    design, fidelity = key
    began = time.perf_counter()
    solution = tig.solve(design, fidelity=fidelity, progress=progress, cancelled=cancelled)
    return Picture.of(solution, time.perf_counter() - began)


@functools.cache
def workers():
    """Return the threads that all sessions of this process share."""
    return ThreadPoolExecutor(max_workers=os.cpu_count(), thread_name_prefix="solver")


@functools.cache
def shared_store():
    """Return the store that all sessions of this process share; the first call makes it."""
    return SolutionStore(take_picture, workers(), CAPACITY)


class _StoppedError(Exception):
    """The user stopped the solve."""


class _SupersededError(Exception):
    """Newer inputs arrived while a long solve ran."""


class Latest:
    """Does a piece of work whenever asked, one at a time; asked meanwhile, it does it once more after.

    Parameters
    ----------
    work : callable
        Coroutine function of the session's document; it takes its task as it stands when it begins.

    Attributes
    ----------
    pending : bool
        Whether it was asked for since it last began.
    """

    def __init__(self, work):
        self._work = work
        self._running = False
        self.pending = False

    async def ask(self, *_):
        """Ask for the work, and see it through unless it is under way already."""
        self.pending = True
        if self._running:
            return
        self._running, document = True, pn.state.curdoc
        try:
            while self.pending:
                self.pending = False
                await self._work(document)
        finally:
            self._running = False


class Runner:
    """Watches inputs and keeps an outcome up to date.

    Parameters
    ----------
    inputs : DesignInputs
        What is watched.
    outcome : Outcome
        What is kept up to date.
    store : SolutionStore
        Where solutions come from.
    """

    def __init__(self, inputs, outcome, store):
        self.inputs = inputs
        self.outcome = outcome
        self._store = store
        self._latest = Latest(self._solve)
        self._stopping = False
        self._watcher = inputs.param.watch(self._on_change, list(PHYSICAL))

    def start(self):
        """Show the picture of the inputs as they stand: at once if the store has it, else when solved."""
        design = self.inputs.to_design()
        picture = self._store.kept((design, FIDELITY))
        if picture is None:
            self.solve_again()
        else:
            self.outcome.param.update(**self._success(design, picture, from_cache=True))

    def stop(self, *_):
        """Give up the solve under way, and what waits behind it."""
        self._stopping = True
        self._latest.pending = False

    def solve_again(self, *_):
        """Solve the inputs as they stand, after a stop or a failure."""
        self.inputs.param.trigger(*PHYSICAL)

    def close(self, *_):
        """Stop watching and solving: the session is over."""
        self.inputs.param.unwatch(self._watcher)
        self.stop()

    async def _on_change(self, *_):
        self._stopping = False
        await self._latest.ask()

    async def _solve(self, document):
        self._publish(document, busy=True)
        try:
            design = self.inputs.to_design()
            picture, from_cache = await self._obtain(design, document)
            changes = self._success(design, picture, from_cache)
            self._publish(document, **changes)
            modified = design != self.inputs.preset_design
            if modified and changes["preset_picture"] is None and not self._latest.pending:
                ghost, _ = await self._obtain(self.inputs.preset_design, document)
                self._publish(document, preset_picture=ghost)
        except _SupersededError:
            self._publish(document, progress=None)
        except _StoppedError:
            self._publish(document, busy=False, progress=None, problem=STOPPED)
        except Exception as error:
            self._publish(document, busy=self._latest.pending, progress=None, problem=readable(error))

    def _success(self, design, picture, from_cache):
        modified = design != self.inputs.preset_design
        ghost = self._store.kept((self.inputs.preset_design, FIDELITY)) if modified else None
        return {
            "picture": picture,
            "preset_picture": ghost,
            "from_cache": from_cache,
            "busy": self._latest.pending,
            "progress": None,
            "problem": "",
        }

    async def _obtain(self, design, document):
        job = self._store.request((design, FIDELITY))
        try:
            await self._wait(job, document)
            return job.future.result(), job.from_cache
        finally:
            self._store.release(job)

    async def _wait(self, job, document):
        future = asyncio.wrap_future(job.future)
        # an abandoned job may still raise; nobody is left to hear it
        future.add_done_callback(lambda done: done.cancelled() or done.exception())
        while not future.done():
            await asyncio.wait({future}, timeout=LOOK_EVERY)
            if self._stopping and not future.done():
                raise _StoppedError
            if not future.done() and job.began is not None and time.monotonic() - job.began > LONG:
                if self._latest.pending:
                    raise _SupersededError
                self._publish(document, progress=job.fraction)

    def _publish(self, document, **changes):
        publish(self.outcome, document, **changes)


def publish(outcome, document, **changes):
    """Change an outcome from a coroutine; what watches it may then draw.

    Parameters
    ----------
    outcome : Outcome
        What changes.
    document : bokeh.document.Document or None
        The session's document: models may change only under its lock, which a next-tick callback holds.
    **changes
        New values by name.
    """
    if document is None or document.session_context is None:
        _apply(outcome, changes)
    else:
        document.add_next_tick_callback(partial(_apply, outcome, changes))


def _apply(outcome, changes):
    try:
        outcome.param.update(**changes)
    except Exception:
        log.exception("A solution could not be drawn")
        outcome.param.update(busy=False, progress=None, problem=NOT_DRAWN)


def readable(error):
    """Return what went wrong, for a reader who does not program.

    Parameters
    ----------
    error : Exception
        What a solve raised.

    Returns
    -------
    str
        The core's own words for a design or a run that it refuses; for anything else a plain sentence,
        the details being logged.
    """
    if isinstance(error, (tig.DesignError, tig.RunTooLargeError)):
        return f"Not solved: {error}."
    log.error("A solve failed", exc_info=error)
    return (
        f"The solver failed ({type(error).__name__}). The pictures show the last track that was solved; "
        "the server's log has the details."
    )
