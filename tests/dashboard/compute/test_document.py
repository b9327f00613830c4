"""Drawing waits for the document's lock, and several changes are drawn once."""

import pytest
from bokeh.document import Document
from panel.io.state import set_curdoc

from dashboard.compute.document import NextTick


class Session:
    """A document as a server holds it; what is to be done next is kept."""

    def __init__(self, monkeypatch):
        self.document, self.next = Document(), []
        context = type("Context", (), {"session": object()})()
        monkeypatch.setattr(Document, "session_context", property(lambda _: context))
        monkeypatch.setattr(self.document, "add_next_tick_callback", self.next.append)


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
