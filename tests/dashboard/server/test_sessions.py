"""Sessions that end leave nothing behind, and there are never more than there is room for."""

import asyncio
import weakref
from pathlib import Path
from types import SimpleNamespace

import pytest
from bokeh.application.handlers.document_lifecycle import DocumentLifecycleHandler
from bokeh.document import Document
from bokeh.server.contexts import ApplicationContext
from panel.io.application import build_single_handler_application
from panel.io.server import WSHandler
from panel.io.state import state
from tornado.ioloop import IOLoop

from dashboard.compute.pacing import PACE
from dashboard.server import sessions
from dashboard.server.garbage import sweep
from dashboard.server.serving import SocketHandler
from tests.dashboard.server.conftest import begin

DASHBOARD = Path(__file__).parents[3] / "dashboard"


@pytest.fixture(autouse=True)
def nobody(monkeypatch):
    """Count the sessions of each test alone."""
    monkeypatch.setattr(sessions, "_open", set())


@pytest.fixture
def application():
    made = build_single_handler_application(DASHBOARD)
    made.add(DocumentLifecycleHandler())
    return made


def test_a_session_that_no_browser_drew_is_let_go_of(application):
    async def come_and_go():
        context = ApplicationContext(application, io_loop=IOLoop.current(), url="/dashboard")
        left = []
        for number in range(2):
            session = await begin(context, f"visitor-{number}")
            left += [weakref.ref(session.document), *map(weakref.ref, session.document.roots)]
            del session
        assert sessions.count() == 2
        await context._cleanup_sessions(-1)
        return left

    views = set(state._views)
    left = asyncio.run(come_and_go())
    sweep()
    assert [each() for each in left if each() is not None] == []
    assert set(state._views) == views
    assert sessions.count() == 0


def test_one_session_too_many_gets_a_page_that_says_so(application, monkeypatch):
    monkeypatch.setenv(sessions.MOST_VARIABLE, "1")

    async def come():
        context = ApplicationContext(application, io_loop=IOLoop.current(), url="/dashboard")
        first, second = await begin(context, "one"), await begin(context, "two")
        titles = first.document.title, second.document.title
        words = [model.text for model in second.document.select({"name": None}) if hasattr(model, "text")]
        first.request_expiration()
        await context._cleanup_sessions(10**6)
        third = await begin(context, "three")
        titles += (third.document.title,)
        await context._cleanup_sessions(-1)
        return titles, " ".join(words)

    titles, words = asyncio.run(come())
    assert titles == ("trackig", "trackig is full", "trackig")
    assert "1 pages are open" in words


def test_a_document_counts_until_it_is_forgotten():
    document = Document()
    before = sessions.count()
    assert sessions.admit(document)
    assert sessions.count() == before + 1
    sessions.forget(document)
    assert sessions.count() == before


@pytest.mark.parametrize("is_there", [True, False])
def test_whoever_leaves_while_waiting_gets_no_session(monkeypatch, is_there):
    async def begin_session(_, token):
        begun.append(token)

    async def come():
        handler = SocketHandler.__new__(SocketHandler)
        handler.ws_connection, handler.connection = SimpleNamespace(is_closing=lambda: False), None
        opening = asyncio.create_task(handler._async_open("a token"))
        await asyncio.sleep(0)
        if not is_there:
            # as Tornado does when a socket closes
            handler.ws_connection = None
        await opening

    begun = []
    monkeypatch.setattr(WSHandler, "_async_open", begin_session)
    asyncio.run(come())
    assert begun == ["a token"] * is_there


def test_what_a_page_says_as_it_opens_is_no_work_at_it(monkeypatch):
    document = Document()

    async def begin_session(handler, _):
        handler.connection = SimpleNamespace(session=SimpleNamespace(document=document))

    async def come():
        handler = SocketHandler.__new__(SocketHandler)
        handler.ws_connection, handler.connection = SimpleNamespace(is_closing=lambda: False), None
        await handler._async_open("a token")

    monkeypatch.setattr(WSHandler, "_async_open", begin_session)
    asyncio.run(come())
    heard = PACE._heard
    PACE.hear(document)
    assert PACE._heard == heard
    PACE.leave(document)
    PACE.hear(document)
    assert PACE._heard > heard
