"""The whole in process: the page is made, it is apart from other sessions, and it never stays white."""

import asyncio
import gc
import runpy
from concurrent.futures import Future
from functools import partial
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import panel as pn
import pytest
from bokeh.core.validation.check import check_integrity
from bokeh.core.validation.warnings import EMPTY_LAYOUT
from bokeh.document import Document
from panel.io import document as panel_document
from panel.util import edit_readonly
from panel.viewable import Viewable

import dashboard
import trackig_core as tig
from dashboard import app, app_hooks
from dashboard.compute.workers import AT_REST
from tests.waiting import WAIT, until_at_rest

MAIN = Path(dashboard.__file__).parent / "main.py"


@pytest.fixture
def store(instant_store):
    """Return a store that has the opening picture already."""
    instant_store.request((tig.PRESETS["booted-block-low-mass"], AT_REST)).future.result(WAIT)
    return instant_store


def test_the_page_opens_already_solved(store, summary):
    document = Document()
    app.build(store).server_doc(document, location=False)
    source = document.get_model_by_name("insertion_gain")
    expected = summary("booted-block-low-mass").solution.insertion_gain
    np.testing.assert_array_equal(source.data["level"], expected)
    assert document.get_model_by_name("force").data["time"].size > 1000


def test_a_page_has_none_of_the_faults_that_bokeh_looks_for(store):
    document = Document()
    app.build(store).server_doc(document, location=False)
    found = check_integrity({each for root in document.roots for each in root.references()})
    assert found.error == []
    # places that are filled when they are looked at
    assert {each.code for each in found.warning} <= {EMPTY_LAYOUT.code}


TABS = {
    "explore": "Explore",
    "compare": "Compare",
    "specification": "Specification",
    "decide": "Decide",
    "level": "Received level",
    "track": "Track",
    "learn": "Learn",
    "verify": "Verify",
    "method": "Method",
    "keep": "Save & share",
}
"""What links call the tabs, for ever, and what they are called on the page."""


def test_tabs_have_titles_of_their_own_and_keep_their_names_in_links():
    assert {tab.link_name: tab.title for tab in app.TABS} == TABS


def open_tabs(store, monkeypatch, name, *others):
    """Open the page by a link that names a tab, then others by name; return the first."""
    monkeypatch.setattr(type(pn.state), "session_args", {"tab": [name.encode()]})

    async def story():
        (_, shown) = app.build(store).main
        opened = shown.active
        for other in others:
            shown.active = list(TABS).index(other)
        await until_at_rest()
        return app.TABS[opened].link_name

    return asyncio.run(story())


@pytest.mark.parametrize("name", TABS)
def test_a_link_opens_its_tab_and_makes_no_other(store, monkeypatch, name):
    made = []
    for tab in app.TABS:
        start = tab.__init__

        def counting(self, *arguments, start=start):
            made.append(type(self).link_name)
            start(self, *arguments)

        monkeypatch.setattr(tab, "__init__", counting)
    assert open_tabs(store, monkeypatch, name) == name
    assert made == [name]


def test_a_tab_is_made_once(store, monkeypatch):
    made, start = [], app.Track.__init__
    monkeypatch.setattr(app.Track, "__init__", lambda self, *parts: made.append(1) or start(self, *parts))
    open_tabs(store, monkeypatch, "explore", "track", "explore", "track")
    assert made == [1]


def test_a_view_is_told_when_it_is_in_sight_and_when_it_is_not(store, monkeypatch):
    looks = []
    monkeypatch.setattr(app.Method, "look", lambda _, active: looks.append(active))
    open_tabs(store, monkeypatch, "method", "explore", "method")
    assert looks == [True, False, True]


def test_another_session_s_work_does_not_make_this_page_busy(store):
    page = app.build(store)
    with edit_readonly(pn.state):
        pn.state.busy = True
        try:
            assert not page.busy
        finally:
            pn.state.busy = False


def test_sessions_share_solutions_and_nothing_else(store):
    one, other = Document(), Document()
    app.build(store).server_doc(one, location=False)
    app.build(store).server_doc(other, location=False)
    assert one.get_model_by_name("insertion_gain") is not other.get_model_by_name("insertion_gain")


def test_a_page_that_cannot_be_made_says_so(monkeypatch, caplog):
    def broken():
        raise RuntimeError("no <b>fonts</b>")

    monkeypatch.setattr(app, "build", broken)
    page = runpy.run_path(str(MAIN))["page"]
    assert "could not start" in page.object
    assert "fonts" not in page.object
    assert "no <b>fonts</b>" in caplog.text


def test_all_problems_of_a_link_are_one_message(monkeypatch):
    told = []
    monkeypatch.setattr(app, "notify", lambda *message: told.append(message))
    assert [*app.notify_of_problems(())] == told == []
    assert [*app.notify_of_problems(("One thing.", "Another."))] == [None]
    assert told == [("warning", "One thing. Another.")]


def test_an_escaped_exception_is_logged_and_told_without_its_text(caplog):
    pn.extension(notifications=True)
    app.report_error(ValueError("<script>alert(1)</script>"))
    assert "alert(1)" in caplog.text


class FakeStore:
    """Notes what it is asked."""

    def __init__(self):
        self.requested, self.futures, self.closed = [], [], False

    def request(self, key):
        self.requested.append(key)
        self.futures.append(Future())
        return SimpleNamespace(future=self.futures[-1])

    def close(self):
        self.closed = True


def test_what_is_added_is_looked_through_alone_and_its_clicks_are_heard(monkeypatch):
    seen = []
    hooks = [*Viewable._preprocessing_hooks, lambda view, _: seen.append(view)]
    monkeypatch.setattr(Viewable, "_preprocessing_hooks", hooks)
    part, button = pn.Column(), pn.widgets.Button()
    button.js_on_click(code="window.heard = true")
    whole = pn.Column(pn.pane.HTML("large"), part)
    whole._preprocess = partial(app.look_through, whole)
    root = whole.get_root(Document())
    assert seen == [whole]
    part.append(button)
    assert seen == [whole, part]
    (shown,) = root.children[1].children
    ((callback,),) = shown.js_event_callbacks.values()
    assert "window.heard" in callback.code
    part.append(pn.pane.HTML("more"))
    ((callback,),) = shown.js_event_callbacks.values()


@pytest.fixture
def own_garbage(monkeypatch):
    """Have Panel look for garbage as ever after the test, and nothing set aside from it."""
    monkeypatch.setattr(panel_document, "_garbage_collect", panel_document._garbage_collect)
    yield
    gc.unfreeze()


@pytest.mark.usefixtures("own_garbage")
def test_the_server_begins_with_the_opening_preset(monkeypatch):
    fake = FakeStore()
    begun, prepared = [], []
    monkeypatch.setattr(app_hooks, "shared_store", lambda: fake)
    monkeypatch.setattr(app_hooks, "shared_live_store", lambda: fake)
    monkeypatch.setattr(app_hooks, "compiled", lambda: begun.append(True))
    monkeypatch.setattr(app_hooks.first_page, "prepare", lambda *words: prepared.append(words))
    app_hooks.on_server_loaded(SimpleNamespace(application_context="ours"))
    assert begun
    assert prepared == [("ours", app.TITLE)]
    assert fake.requested[0] == (tig.PRESETS["booted-block-low-mass"], AT_REST)
    assert {design for design, _ in fake.requested} == set(tig.PRESETS.values())
    assert panel_document._garbage_collect == app_hooks.SWEEPER.note_gone
    assert gc.get_freeze_count() > 0
    app_hooks.on_server_unloaded(None)
    assert fake.closed


@pytest.mark.usefixtures("own_garbage")
def test_pages_are_made_ahead_of_the_opening_picture(monkeypatch):
    fake, served = FakeStore(), []
    monkeypatch.setattr(app_hooks, "shared_store", lambda: fake)
    monkeypatch.setattr(app_hooks, "compiled", lambda: None)
    monkeypatch.setattr(app_hooks.first_page, "prepare", lambda *_: None)
    monkeypatch.setattr(app_hooks.RESERVE, "serve", lambda *words: served.append(words))
    monkeypatch.setenv(app_hooks.sessions.AHEAD_VARIABLE, "3")

    async def solve_the_first():
        app_hooks.on_server_loaded(SimpleNamespace(application_context="ours"))
        assert served == []
        fake.futures[0].set_result("the opening picture")
        await until_at_rest()

    asyncio.run(solve_the_first())
    assert served == [("ours", app_hooks.opening_picture, app.build, app.TITLE, 3)]
