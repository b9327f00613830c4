"""Drawing waits for the document's lock, and several changes are drawn once."""

import itertools

import panel as pn
import pytest
from bokeh.document import Document
from panel.io.state import set_curdoc

from dashboard.compute.document import NextTick, in_turns
from dashboard.compute.pacing import PACE


class Session:
    """A document as a server holds it; what is to be done next is kept."""

    def __init__(self, monkeypatch):
        self.document, self.next = Document(), []
        context = type("Context", (), {"session": object()})()
        monkeypatch.setattr(Document, "session_context", property(lambda _: context))
        monkeypatch.setattr(self.document, "add_next_tick_callback", self.next.append)
        # parts of this page alone need no pacing, nor an event loop
        monkeypatch.setattr(PACE, "begin", lambda work: work())


@pytest.fixture
def session(monkeypatch):
    return Session(monkeypatch)


def test_without_a_session_it_is_drawn_at_once():
    drawn = []
    NextTick(lambda: drawn.append(True))()
    assert drawn == [True]


def test_several_changes_are_drawn_once_under_the_lock(session):
    drawn = []
    later = NextTick(lambda: drawn.append(True))
    with set_curdoc(session.document):
        later()
        later()
    assert drawn == []
    session.next.pop()()
    assert drawn == [True]
    assert session.next == []
    with set_curdoc(session.document):
        later()
    assert len(session.next) == 1


def test_what_cannot_be_drawn_is_logged(session, caplog):
    def broken():
        raise ValueError("no paint")

    with set_curdoc(session.document):
        NextTick(broken)()
    session.next.pop()()
    assert "no paint" in caplog.text


def steps(done, fails_at=None):
    for step in range(3):
        if step == fails_at:
            raise ValueError("a part that cannot be made")
        done.append(step)
        yield


def test_steps_without_a_session_are_done_at_once():
    done = []
    in_turns(steps(done), None)
    assert done == [0, 1, 2]


def test_each_step_has_a_turn_of_its_own_once_the_page_has_loaded(session, monkeypatch):
    done, loaded = [], []
    monkeypatch.setattr(type(pn.state), "loaded", property(lambda _: bool(loaded)))
    monkeypatch.setattr(type(pn.state), "onload", lambda _, begin: loaded.append(begin))
    with set_curdoc(session.document):
        in_turns(steps(done), None)
        assert (done, session.next) == ([], [])
        loaded[0]()
        for turn in range(3):
            session.next.pop()()
            assert done == list(range(turn + 1))
        session.next.pop()()
    assert session.next == []


def test_a_step_that_fails_is_reported_and_what_follows_is_done(session, monkeypatch):
    done, errors = [], []
    monkeypatch.setattr(type(pn.state), "loaded", property(lambda _: True))
    with set_curdoc(session.document):
        in_turns(itertools.chain(steps(done, fails_at=1), steps(done)), errors.append)
        while session.next:
            session.next.pop()()
    assert done == [0, 0, 1, 2]
    assert [str(error) for error in errors] == ["a part that cannot be made"]
