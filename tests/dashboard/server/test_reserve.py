"""Pages that are made ahead: when, for whom, and that nobody can tell them from others."""

import asyncio
import weakref
from concurrent.futures import Future
from pathlib import Path
from types import SimpleNamespace

import panel as pn
import pytest
from bokeh.application.handlers.document_lifecycle import DocumentLifecycleHandler
from bokeh.document import Document
from bokeh.server.contexts import ApplicationContext
from bokeh.util.token import generate_jwt_token
from panel.io.application import build_single_handler_application
from panel.io.state import set_curdoc, state
from tornado.ioloop import IOLoop

from dashboard import app
from dashboard.app_hooks import opening_picture
from dashboard.compute import pacing
from dashboard.compute.document import in_turns
from dashboard.compute.pacing import PACE, Pace
from dashboard.server import reserve, sessions
from dashboard.server.garbage import sweep
from dashboard.server.reserve import Reserve
from tests.dashboard.server.conftest import begin
from tests.waiting import WAIT

DASHBOARD = Path(app.__file__).parent


async def until(is_so):
    """Give other tasks their turns until something is so."""
    async with asyncio.timeout(WAIT):
        while not is_so():
            await asyncio.sleep(0.001)


@pytest.fixture(autouse=True)
def hurried(monkeypatch):
    """Have nobody wait long for idle times; plain documents are back after the test, and sessions over."""
    monkeypatch.setattr(pacing, "IDLE", 0.05)
    monkeypatch.setattr(reserve.contexts, "Document", Document)
    monkeypatch.setattr(sessions, "_open", set())
    yield
    assert sessions.count() == 0


@pytest.fixture
def context():
    """Return the application that the dashboard is; one that a test may serve from a reserve."""

    def make():
        application = build_single_handler_application(DASHBOARD)
        application.add(DocumentLifecycleHandler())
        return ApplicationContext(application, io_loop=IOLoop.current(), url="/dashboard")

    return make


def at_hand():
    """Return the future of a picture that is there."""
    future = Future()
    future.set_result("a picture")
    return future


def marked(made, steps=("first", "second")):
    """Return what makes pages of a word, with steps that are done later; what is done is noted."""

    def make():
        def later():
            for step in steps:
                made.append(step)
                yield

        made.append("page")
        in_turns(later(), None)
        return pn.pane.Markdown("made ahead")

    return make


def test_a_page_is_made_step_by_step_before_anybody_asks(context):
    async def story():
        pages, made = Reserve(Pace()), []
        pages.serve(context(), at_hand, marked(made), "ours", 2)
        assert made == []
        await until(lambda: made.count("second") == 2)
        await until(lambda: len(pages._ready) == 2)
        return made, pages.take()

    made, document = asyncio.run(story())
    assert made == ["page", "first", "second"] * 2
    assert document.title == "ours"
    assert "made ahead" in str(document.to_json())


def test_a_page_waits_for_its_picture(context):
    async def story():
        picture, made = Future(), []
        pages = Reserve(Pace())
        pages.serve(context(), lambda: picture, marked(made), "ours", 1)
        await asyncio.sleep(3 * pacing.IDLE)
        assert made == []
        picture.set_result("a picture")
        await until(lambda: made)

    asyncio.run(story())


def test_nothing_is_made_while_somebody_works(context):
    async def story():
        pace, made, page = Pace(), [], Document()
        pages = Reserve(pace)
        pace.hear(page)
        pages.serve(context(), at_hand, marked(made), "ours", 1)
        for _ in range(20):
            pace.hear(page)
            await asyncio.sleep(pacing.IDLE / 10)
        assert made == []
        await until(lambda: made)

    asyncio.run(story())


def test_steps_wait_for_who_begins_to_work_meanwhile(context):
    async def story():
        pace, made, page = Pace(), [], Document()
        pages = Reserve(pace)
        pages.serve(context(), at_hand, marked(made, range(50)), "ours", 1)
        await until(lambda: 3 in made)
        pace.hear(page)
        done = len(made)
        for _ in range(20):
            pace.hear(page)
            await asyncio.sleep(pacing.IDLE / 10)
        # the one that had begun to wait for its turn before
        assert len(made) <= done + 1
        await until(lambda: 49 in made)

    asyncio.run(story())


def test_what_is_taken_is_made_up_for(context):
    async def story():
        pages = Reserve(Pace())
        pages.serve(context(), at_hand, marked([]), "ours", 1)
        await until(lambda: pages._ready)
        first = pages.take()
        assert not pages._ready
        await until(lambda: pages._ready)
        return first is not pages.take()

    assert asyncio.run(story())


def test_a_page_that_cannot_be_made_ahead_leaves_sessions_as_they_are(context, caplog):
    def broken():
        raise RuntimeError("no fonts")

    async def story():
        pages, ours = Reserve(Pace()), context()
        pages.serve(ours, at_hand, broken, "ours", 1)
        await until(lambda: "could not be made ahead" in caplog.text)
        session = await begin(ours, "one")
        title = session.document.title
        await ours._cleanup_sessions(-1)
        return title

    assert asyncio.run(story()) == app.TITLE


@pytest.fixture
def dashboard(context, monkeypatch):
    """Return an application with two pages of the dashboard ready, and their reserve."""

    async def make():
        ours, pages = context(), Reserve(PACE)
        monkeypatch.setattr(reserve, "RESERVE", pages)
        pages.serve(ours, opening_picture, app.build, app.TITLE, 2)
        await until(lambda: len(pages._ready) == 2)
        pages._size = 0
        return ours, pages

    return make


def boot_stiffness(document):
    """Return what the sidebar says of the boot [kN/mm]."""
    found = (getattr(each, "data", None) for each in document.models)
    (state,) = [each.state for each in found if hasattr(each, "groups")]
    return state["values"]["boot_stiffness"]


def test_a_session_begins_with_the_page_that_is_ready_unless_it_comes_by_a_link(dashboard):
    async def story():
        ours, pages = await dashboard()
        ready = pages._ready[0].document
        linked = await begin(ours, "linked", boot_stiffness=[b"33.5"], tab=[b"track"])
        plain = await begin(ours, "plain")
        documents = [each.document for each in (linked, plain)]
        found = [boot_stiffness(each) for each in documents]
        titles = [each.title for each in documents]
        curves = [each.get_model_by_name("insertion_gain") is not None for each in documents]
        told = plain.document in pn.state._onload
        counted = sessions.count()
        await ours._cleanup_sessions(-1)
        return documents[1] is ready, found, titles, curves, told, counted

    was_ready, found, titles, curves, told, counted = asyncio.run(story())
    assert was_ready
    assert found[0] == 33.5 != found[1]
    assert titles == [app.TITLE] * 2
    # the first is made while it waits, part by part
    assert curves == [False, True]
    # the browser is prepared for what it is given whole
    assert told
    assert counted == 2


def test_arguments_are_those_of_the_page_s_request():
    token = generate_jwt_token("a session", extra_payload={"arguments": {"tab": [b"track"]}})
    assert reserve._arguments(SimpleNamespace(arguments={}), token)
    plain = generate_jwt_token("a session", extra_payload={"arguments": {}})
    assert not reserve._arguments(SimpleNamespace(arguments={"tab": [b"track"]}), plain)


def test_a_page_that_was_ready_is_let_go_of(dashboard):
    async def come_and_go():
        ours, _ = await dashboard()
        left = []
        for number in range(2):
            session = await begin(ours, f"visitor-{number}")
            left += [weakref.ref(session.document), *map(weakref.ref, session.document.roots)]
            del session
        await ours._cleanup_sessions(-1)
        return left

    views = set(state._views)
    left = asyncio.run(come_and_go())
    sweep()
    assert [each() for each in left if each() is not None] == []
    assert set(state._views) == views


def test_one_session_too_many_takes_no_page(dashboard, monkeypatch):
    async def story():
        ours, pages = await dashboard()
        monkeypatch.setenv(sessions.MOST_VARIABLE, "0")
        session = await begin(ours, "too many")
        title = session.document.title
        await ours._cleanup_sessions(-1)
        return title, len(pages._ready)

    assert asyncio.run(story()) == ("trackig is full", 2)


def test_other_applications_of_the_process_get_documents_of_their_own(dashboard, context):
    async def story():
        _, pages = await dashboard()
        other = context()
        await begin(other, "elsewhere")
        left = len(pages._ready)
        await other._cleanup_sessions(-1)
        return left

    assert asyncio.run(story()) == 2


def test_steps_of_pages_that_nobody_asked_for_are_handed_over_in_their_order():
    from dashboard.compute.document import gathering

    def numbered(*numbers):
        for number in numbers:
            done.append(number)
            yield

    done, document = [], Document()
    with gathering(document) as steps, set_curdoc(document):
        in_turns(numbered(1, 2), None)
        in_turns(numbered(3), None)
        assert done == []
        next(steps)
        assert done == [1]
        assert len(list(steps)) == 2
    assert done == [1, 2, 3]
    with set_curdoc(document):
        in_turns(numbered(4), None)
    assert done == [1, 2, 3, 4]
