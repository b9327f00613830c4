"""Turns changed inputs into a new outcome, off the event loop.

While inputs move, each newest state is solved at live fidelity, in some milliseconds, and older ones that
still wait are dropped: pictures follow the hand. Where little is lost and a live run takes longer, the exact
curve is drawn at once, and the force when the run is there. Where many sessions share the server, drawing is
what takes long, and the exact curve is the one picture of a move. When inputs rest, the paper's run of the
same design takes the picture's place. A paper run under way gives way to newer inputs at once. Solutions come
from stores that all sessions share.

The last good picture stays until a better one is there, and no picture follows one of newer
inputs.
"""

import asyncio
import contextlib
import logging
import time

import param

import trackig_core as tig
from dashboard.compute.document import on_next_tick
from dashboard.compute.latest import Latest, publish, readable
from dashboard.compute.pacing import Pace
from dashboard.compute.workers import AT_ONCE, AT_REST, MOVING, compiled, key_of
from dashboard.fields import PHYSICAL

REST = 0.2
"""Seconds without a change after which inputs are at rest, unless pictures take longer than that."""

RESTS = 4
"""Times that a picture takes after which inputs are at rest: a busy server is no resting hand. The next move
waits for as many turns of the event loop as the picture did, and more."""

SOON = 0.06
"""Seconds for which a live run is waited for before the exact curve is drawn."""

PATIENCE = 0.5
"""Seconds of work after which a live run, under light damping, is given up for the paper's."""

LOOK_EVERY = 0.1
"""Seconds between looks at a solve under way."""

LONG = 1.0
"""Seconds of work after which a solve counts as long: it shows its progress and can be stopped. Time spent
waiting for a worker does not count: a busy server is not slow inputs."""

STOPPED = "Stopped. The pictures show the last track that was solved."
STOPPED_EXACT = "Stopped. The curve is the exact one of this track; its force was not solved."
STOPPED_LIVE = "Stopped. The pictures are a live run's of this track; the paper's run was not solved."
STOPPED_WORDS = {AT_ONCE: STOPPED_EXACT, MOVING: STOPPED_LIVE}
"""What to say of a stop, by the fidelity at which the design is drawn already."""

EXACT_ALL_THE_SAME = "The curve is the exact one of this track all the same."


log = logging.getLogger(__name__)


class _StoppedError(Exception):
    """The user stopped the solve."""


class _SupersededError(Exception):
    """Newer inputs arrived."""


class _SlowError(Exception):
    """A live run takes longer than the paper's would."""


class Runner(param.Parameterized):
    """Watches inputs and keeps an outcome up to date.

    Parameters
    ----------
    inputs : DesignInputs
        What is watched.
    outcome : Outcome
        What is kept up to date.
    store, live_store : SolutionStore
        Where pictures at rest come from, and those that follow the hand.
    pace : Pace, optional
        Whether the server is busy; by default it has this session alone.
    """

    requests = param.Integer(default=0, doc="How often the inputs were to be solved as they stand.")

    def __init__(self, inputs, outcome, store, live_store, pace=None):
        super().__init__()
        self._pace = pace or Pace()
        self.inputs = inputs
        self.outcome = outcome
        self._store = store
        self._live_store = live_store
        self._latest = Latest(self._solve)
        self._stopping = False
        self._live_is_slow = False
        self._changed = 0.0
        # noted at once; what is done waits for its turn
        self._watchers = []
        for each in (self._note_change, self._on_change):
            self._watchers.append(inputs.param.watch(each, list(PHYSICAL)))
            self.param.watch(each, "requests")

    def start(self):
        """Show the picture of the inputs as they stand: at once if the store has it, else when solved."""
        design = self.inputs.to_design()
        summary = self._store.kept(key_of(design, AT_REST))
        if summary is None:
            self.request()
        else:
            self.outcome.param.update(**self._success(design, summary, from_cache=True))

    def stop(self, *_):
        """Give up the solve under way, and what waits behind it."""
        self._stopping = True
        self._latest.news.clear()

    def request(self, *_):
        """Solve the inputs as they stand: at first, and after a stop or a failure."""
        self.requests += 1

    def close(self, *_):
        """Stop watching and solving: the session is over."""
        for each in self._watchers:
            self.inputs.param.unwatch(each)
        self.stop()

    def _note_change(self, *_):
        self._changed = time.monotonic()

    async def _on_change(self, *_):
        self._stopping = False
        await self._latest.ask()

    async def _solve(self, document):
        if self.outcome.summary is None or self.outcome.problem:
            self._publish(document, busy=True)
        design = None
        try:
            await self._wait_for_compiler(document)
            design = self.inputs.to_design()
            # the first picture of an ordinary track is the paper's; that of others would take too long
            first = self.outcome.summary is None and design == design.simplified
            if not first and self._store.kept(key_of(design, AT_REST)) is None:
                await self._follow(design, document)
            summary, from_cache = await self._obtain(design, AT_REST, document)
            changes = self._success(design, summary, from_cache)
            self._publish(document, **changes)
            modified = design != self.inputs.preset_design
            if modified and changes["preset_summary"] is None:
                ghost, _ = await self._obtain(self.inputs.preset_design, AT_REST, document)
                self._publish(document, preset_summary=ghost)
        except _SupersededError:
            self._publish(document, progress=None)
        except _StoppedError:
            words = STOPPED_WORDS.get(self._shown_fidelity(design), STOPPED)
            self._publish(document, busy=False, progress=None, problem=words, asked=design)
        except Exception as error:
            words = readable(error)
            if self._shown_fidelity(design) == AT_ONCE:
                words = f"{words} {EXACT_ALL_THE_SAME}"
            self._publish(document, busy=self._latest.pending, progress=None, problem=words, asked=design)

    def _shown_fidelity(self, design):
        """Return at which fidelity a design is drawn, or None where another is."""
        shown = self.outcome.summary
        return shown.solution.fidelity if shown is not None and shown.design == design else None

    async def _wait_for_compiler(self, document):
        if compiled().done():
            return
        self._publish(document, compiling=True)
        with contextlib.suppress(Exception):  # whatever is wrong will be told by the solve that meets it
            await asyncio.wrap_future(compiled())
        self._publish(document, compiling=False)

    async def _follow(self, design, document):
        """Show a design that may not stay, then wait until it does; what is newer ends the wait."""
        changed, began = self._changed, time.monotonic()
        is_busy = self._pace.is_busy or self._live_store.is_crowded()
        if not (is_busy and self._draw_exact(design, document)):
            await self._draw_live(design, document)
        solved = time.monotonic()
        await self._until_drawn(document)
        drawn = time.monotonic()
        self._pace.drew(began - changed + drawn - solved)
        if await self._latest.news_within(max(REST, RESTS * (drawn - changed))):
            raise _SupersededError

    async def _draw_live(self, design, document):
        """Draw a live run, or the exact curve before it."""
        live = asyncio.ensure_future(self._obtain(design, MOVING, document))
        try:
            await self._bridge(live, design, document)
            summary, _ = await live
            self._publish(document, **self._success(design, summary, from_cache=False))
        except (_SlowError, tig.DesignError, tig.RunTooLargeError):
            # what live fidelity refuses or gives up, the paper's run answers or explains, after a long while
            # where it is that of more than the simplified model
            if design != design.simplified:
                self._draw_exact(design, document)
        finally:
            _abandon(live)

    async def _until_drawn(self, document):
        """Wait until what was published is drawn; what is newer ends it.

        Where many sessions draw, it takes longer than the solve, and no hand moves on before it sees the
        picture.
        """
        drawn = asyncio.get_running_loop().create_future()
        on_next_tick(document, lambda _: drawn.done() or drawn.set_result(None))
        await self._latest.done_or_news(drawn, PATIENCE)

    def _draw_exact(self, design, document):
        """Draw the exact curve of a design, and return whether it has one."""
        with contextlib.suppress(tig.DesignError):
            summary, from_cache = self._live_store.at_once(key_of(design, AT_ONCE))
            self._publish(document, **self._success(design, summary, from_cache))
            return True
        return False

    async def _bridge(self, live, design, document):
        """Draw the exact curve while a live run is awaited for long; what is newer ends the wait.

        Where the last one took long, this one will: its exact curve is drawn without waiting. It stays where
        the live run is given up.
        """
        began = time.monotonic()
        await asyncio.wait({live}, timeout=0 if self._live_is_slow else SOON)
        if not live.done():
            self._draw_exact(design, document)
            await self._latest.done_or_news(live, PATIENCE)
            if not live.done() and self._latest.pending:
                raise _SupersededError
        self._live_is_slow = time.monotonic() - began > SOON

    def _success(self, design, summary, from_cache):
        return {
            "summary": summary.of_design(design),
            "preset_summary": self._ghost(design),
            "from_cache": from_cache,
            "busy": self._latest.pending,
            "progress": None,
            "problem": "",
        }

    def _ghost(self, design):
        """Return the picture of the preset that a design departs from, if it does and there is one."""
        preset, shown = self.inputs.preset_design, self.outcome.preset_summary
        if design == preset:
            return None
        if shown is not None and shown.design == preset:
            return shown
        return self._store.kept(key_of(preset, AT_REST))

    async def _obtain(self, design, fidelity, document):
        store = self._store if fidelity == AT_REST else self._live_store
        job = store.request(key_of(design, fidelity), owner=self)
        try:
            await self._wait(job, design, document)
            return job.future.result(), job.from_cache
        finally:
            store.release(job)

    async def _wait(self, job, design, document):
        future = asyncio.wrap_future(job.future)
        # an abandoned job may still raise; nobody is left to hear it
        future.add_done_callback(lambda done: done.cancelled() or done.exception())
        moving = job.key[1] != AT_REST
        while not future.done():
            if moving:
                await asyncio.wait({future}, timeout=LOOK_EVERY)
            else:
                await self._latest.done_or_news(future, LOOK_EVERY)
            if future.done():
                return
            if self._stopping:
                raise _StoppedError
            worked = 0.0 if job.began is None else time.monotonic() - job.began
            if job.key[1] == MOVING and worked > PATIENCE:
                raise _SlowError
            if not moving and self._latest.pending:
                raise _SupersededError
            if worked > LONG:
                self._publish(document, busy=True, progress=job.fraction, asked=design)

    def _publish(self, document, **changes):
        publish(self.outcome, document, **changes)


def _abandon(task):
    """Give a task up, or what it raised if nobody asked."""
    if not task.cancel() and not task.cancelled():
        task.exception()
