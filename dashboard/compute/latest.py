"""Work that only the newest request matters to, and what it publishes."""

import asyncio
import contextlib
import logging
from functools import partial

import panel as pn

import trackig_core as tig
from dashboard.compute.document import on_next_tick, one_message

log = logging.getLogger(__name__)

NOT_DRAWN = "This solution could not be drawn; the server's log has the details."


class Latest:
    """Does a piece of work whenever asked, one at a time; asked meanwhile, it does it once more after.

    Parameters
    ----------
    work : callable
        Coroutine function of the session's document; it takes its task as it stands when it begins.

    Attributes
    ----------
    news : asyncio.Event
        Set while it was asked for since it last began.
    """

    def __init__(self, work):
        self._work = work
        self._running = False
        self.news = asyncio.Event()

    @property
    def pending(self):
        """Whether it was asked for since it last began."""
        return self.news.is_set()

    async def news_within(self, seconds):
        """Wait some time at most, and return whether it was asked for since it last began."""
        with contextlib.suppress(TimeoutError):
            await asyncio.wait_for(self.news.wait(), seconds)
        return self.pending

    async def done_or_news(self, future, seconds):
        """Wait until something is done or the work is asked for anew, some time [s] at most."""
        news = asyncio.ensure_future(self.news.wait())
        try:
            await asyncio.wait({future, news}, timeout=seconds, return_when=asyncio.FIRST_COMPLETED)
        finally:
            news.cancel()

    async def ask(self, *_):
        """Ask for the work, and see it through unless it is under way already."""
        if self._running:
            self.news.set()
            return
        # an event belongs to the loop in which it is first waited for
        self.news = asyncio.Event()
        self.news.set()
        self._running, document = True, pn.state.curdoc
        try:
            while self.pending:
                self.news.clear()
                await self._work(document)
        finally:
            self._running = False


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
    on_next_tick(document, partial(_apply, outcome, changes))


def _apply(outcome, changes, document):
    try:
        with one_message(document):
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
