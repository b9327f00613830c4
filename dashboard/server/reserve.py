"""Pages that are ready before anybody asks for them.

Most of what a page costs the server does not depend on who asks: parts, figures, models. It is done ahead,
while nobody works and no page opens, a step at a time. Whoever comes by the plain address is given a page
that is ready; where none is left, and for a link to a design, it is made while they wait. A page that is
ready could not follow a link: what changes between its way to the browser and its being drawn is lost.
"""

import asyncio
import logging
import weakref
from collections import deque
from contextvars import ContextVar
from dataclasses import dataclass
from types import SimpleNamespace

from bokeh.document import Document
from bokeh.server import contexts
from bokeh.util.token import get_token_payload
from panel.io.document import init_doc
from panel.io.state import set_curdoc

from dashboard.compute.document import gathering
from dashboard.compute.pacing import BREATH, PACE
from dashboard.server import first_page, sessions

log = logging.getLogger(__name__)


@dataclass(frozen=True)
class _Ready:
    """A page that is ready, and what it needs until it is taken."""

    document: Document
    context: contexts.BokehSessionContext


class Reserve:
    """A few pages that are ready, and made up for when one is taken.

    Parameters
    ----------
    pace : dashboard.compute.pacing.Pace
        Whether anybody works.
    """

    def __init__(self, pace):
        self._pace = pace
        self._prepare = self._make = self._context = None
        self._title, self._size = "", 0
        self._ready, self._taken = deque(), weakref.WeakSet()
        self._task = None

    def serve(self, application_context, prepare, make, title, size):
        """Have the sessions of an application begin with pages that are ready.

        Parameters
        ----------
        application_context : bokeh.server.contexts.ApplicationContext
            The application.
        prepare : callable
            Returns a future (concurrent.futures.Future) of what a page is made of, such as its first picture:
            one that came later could be lost as well.
        make : callable
            Returns a page.
        title : str
            Title of the page.
        size : int
            Pages that are ready.
        """
        self._prepare, self._make = prepare, make
        self._context, self._title, self._size = application_context, title, size
        plain = application_context.create_session_if_needed

        async def create_session_if_needed(session_id, request=None, token=None):
            offered = _offered.set(None if _arguments(request, token) else self)
            try:
                return await plain(session_id, request, token)
            finally:
                _offered.reset(offered)

        application_context.create_session_if_needed = create_session_if_needed
        contexts.Document = _document
        self._fill()

    def take(self):
        """Return a document whose page is ready, or an empty one."""
        if not self._ready or sessions.is_full():
            return Document()
        ready = self._ready.popleft()
        self._taken.add(ready.document)
        self._fill()
        return ready.document

    def open(self, document):
        """Begin a session with the page in its document, if it was ready.

        Parameters
        ----------
        document : bokeh.document.Document or None
            A session's document; None without a session.

        Returns
        -------
        bool
            Whether it was.
        """
        if document not in self._taken:
            return False
        self._taken.discard(document)
        init_doc(document)
        return True

    def _fill(self):
        if self._task is None or self._task.done():
            self._task = asyncio.get_running_loop().create_task(self._make_pages())

    async def _make_pages(self):
        while len(self._ready) < self._size:
            try:
                self._ready.append(await self._make_page())
            except Exception:
                # whoever comes next has one made as ever, and is told what goes wrong
                log.exception("A page could not be made ahead")
                return

    async def _make_page(self):
        await asyncio.wrap_future(self._prepare())
        document, context = self._blank()
        with gathering(document) as steps:
            with await self._turn(document):
                first_page.use_own_files(document)
                page = self._make()
            with await self._turn(document):
                page.server_doc(document, title=self._title, location=False)
            left = True
            while left:
                with await self._turn(document):
                    left = next(steps, steps) is not steps
        return _Ready(document, context)

    def _blank(self):
        """Return an empty document, and the context that stands in for that of its session.

        Pages without a session hold their files, those of a session name their addresses.
        """
        document = Document()
        context = contexts.BokehSessionContext("ahead", self._context.server_context, document)
        context._request = SimpleNamespace(arguments={}, cookies={}, headers={})
        document._session_context = weakref.ref(context)
        return document, context

    async def _turn(self, document):
        """Wait until nobody works, and return a context in which a document is the current one."""
        # whoever has just sent something is heard first
        await asyncio.sleep(BREATH)
        await self._pace.idle()
        return set_curdoc(document)


_offered = ContextVar("_offered", default=None)
"""The reserve from which a session that begins may take its page."""


def _arguments(request, token):
    """Return the arguments of the link by which somebody comes, as the session will have them."""
    payload = get_token_payload(token) if token else {}
    return payload.get("arguments", getattr(request, "arguments", None))


def _document():
    """Return the document of a session that begins."""
    reserve = _offered.get()
    return Document() if reserve is None else reserve.take()


RESERVE = Reserve(PACE)
"""That of this process."""
