"""Messages to the browser: all of them, in order, however busy its socket is."""

import asyncio
from types import SimpleNamespace

import pytest
from bokeh.document import Document
from panel.io import document as panel_document

from dashboard.compute import delivery
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
