"""Messages to the browser: all of them, in order, however busy its socket is."""

import asyncio
from types import SimpleNamespace

import panel as pn
import pytest
from bokeh.document import Document
from bokeh.models import Column, Div
from bokeh.protocol import Protocol
from bokeh.server.session import ServerSession
from panel.io import document as panel_document
from panel.io.state import set_curdoc
from tornado.ioloop import IOLoop

from dashboard.compute import delivery
from dashboard.compute.document import one_message
from tests.waiting import until


class Connection:
    """A connection whose socket takes a message at a time, and as long as the test says."""

    protocol = SimpleNamespace(create=lambda _, events: events)

    def __init__(self):
        self.taken, self.writing = [], None
        self._socket = self
        self.write_lock = SimpleNamespace(_block=SimpleNamespace(_value=1))

    def take(self, _, msg):
        self.taken.append(msg)
        self.write_lock._block._value = 0
        self.writing = asyncio.get_running_loop().create_future()
        return [self.writing]

    def finish(self):
        self.write_lock._block._value = 1
        self.writing.set_result(None)


@pytest.fixture
def connection(monkeypatch):
    monkeypatch.setattr(panel_document, "_dispatch_msgs", panel_document._dispatch_msgs)
    monkeypatch.setattr(ServerSession, "_document_patched", ServerSession._document_patched)
    delivery.install()
    made = Connection()
    monkeypatch.setitem(panel_document.extra_socket_handlers, Connection, made.take)
    return made


def send(document, connection, words):
    panel_document.schedule_write_events(document, [connection], words)


def test_what_comes_while_another_message_is_written_is_delivered_after_it(connection):
    async def act():
        document = Document()
        send(document, connection, "first")
        await until(lambda: connection.taken == ["first"])
        send(document, connection, "second")
        # it has been looked at, and left where it was
        await asyncio.sleep(0)
        await asyncio.sleep(0)
        connection.finish()
        await until(lambda: connection.taken == ["first", "second"])
        connection.finish()
        await until(lambda: document not in panel_document._WRITE_BLOCK)
        assert not panel_document._WRITE_MSGS.get(document)

    asyncio.run(act())


def test_what_comes_as_another_message_is_written_whole_is_delivered(connection):
    async def act():
        document = Document()
        send(document, connection, "first")
        await until(lambda: connection.taken == ["first"])
        connection.finish()
        # its writer has not heard of it yet, and will take down the sign that this puts up
        send(document, connection, "second")
        await until(lambda: connection.taken == ["first", "second"])
        connection.finish()
        await until(lambda: document not in panel_document._WRITE_BLOCK)

    asyncio.run(act())


class Browser:
    """A connection, and the document that a browser has by what it was told."""

    protocol = Protocol()

    def __init__(self, document):
        self.document = Document.from_json(document.to_json())
        self._socket = self
        self.write_lock = SimpleNamespace(_block=SimpleNamespace(_value=1))

    def take(self, _, events=None, msg=None):
        """Hear of changes as Panel sends them; what is unknown raises."""
        message = msg or self.protocol.create("PATCH-DOC", events)
        message.apply_to_document(self.document)
        return []

    async def send_message(self, message):
        self.take(self, msg=message)

    def send_patch_document(self, event):
        return self.send_message(self.protocol.create("PATCH-DOC", [event]))


def told_of(changes, monkeypatch):
    """Return the words in a browser once it was told of changes that are made under a document's lock."""

    async def act():
        document = Document()
        column = Column()
        document.add_root(column)
        browser = Browser(document)
        monkeypatch.setitem(panel_document.extra_socket_handlers, Browser, browser.take)
        monkeypatch.setitem(pn.state._loaded, document, True)
        monkeypatch.setitem(pn.state._connected, document, True)
        session = ServerSession("one", document, IOLoop.current())
        context = SimpleNamespace(session=session, server_context=None)
        document._session_context = lambda: context
        session._subscribed_connections.add(browser)
        with set_curdoc(document):
            await session.with_document_locked(changes, document, column)
        await until(lambda: document not in panel_document._WRITE_BLOCK)
        return [each.text for each in browser.document.roots[0].children]

    return asyncio.run(act())


def in_one_message(document, column):
    """Add a part as Bokeh has it, and change that as Panel has it, before the lock is released."""
    column.children = [Div(text="new")]
    with one_message(document):
        column.children[0].text = "changed"


@pytest.mark.usefixtures("connection")
def test_a_change_of_a_new_part_comes_after_the_part(monkeypatch):
    assert told_of(in_one_message, monkeypatch) == ["changed"]
