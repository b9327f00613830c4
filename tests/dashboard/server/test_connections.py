"""Connections that stop half-way, never read, or never end: each is cut off, and others are served."""

import asyncio
import contextlib
import socket

import pytest
from tornado.iostream import StreamClosedError
from tornado.websocket import WebSocketClosedError

from dashboard.server.serving import MOST_BODY_BYTES
from dashboard.server.sessions import MOST_MESSAGE_BYTES
from tests.dashboard.server.test_served import health
from tests.visitor import Visitor
from tests.waiting import WAIT, until

pytestmark = pytest.mark.slow

PAGE = b"/tools/dashboard"


def connect(served):
    return socket.create_connection(("127.0.0.1", served.port), timeout=WAIT)


def rest(connection):
    """Return all that the server still sends before it hangs up."""
    parts = []
    while part := connection.recv(65536):
        parts.append(part)
    return b"".join(parts)


@pytest.mark.parametrize("begun", [b"", b"GET /to", b"GET " + PAGE + b" HTTP/1.1\r\nHost: here\r\n"])
def test_a_request_that_stops_half_way_is_hung_up_on(served, begun):
    with connect(served) as connection:
        connection.sendall(begun)
        connection.shutdown(socket.SHUT_WR)
        assert rest(connection) == b""
    assert health(served)["status"] == "ok"


def test_a_page_whose_connection_is_half_closed_is_over(served):
    async def come():
        visitor = await Visitor(served.host + PAGE.decode()).open(drawn=False)
        await until(lambda: health(served)["sessions"] >= 1)
        visitor.socket.protocol.stream.socket.shutdown(socket.SHUT_WR)
        with pytest.raises(ConnectionError):
            await visitor.receive("NOTHING THAT A SERVER SENDS")

    asyncio.run(come())
    assert health(served)["status"] == "ok"


@pytest.mark.parametrize("kind", [b"Content-Length: %d\r\n" % 2**40, b"Transfer-Encoding: chunked\r\n"])
def test_an_upload_without_end_is_cut_off(served, kind):
    chunk = b"%x\r\n" % 2**14 + b"x" * 2**14 + b"\r\n"
    with connect(served) as connection:
        connection.sendall(b"POST " + PAGE + b" HTTP/1.1\r\nHost: here\r\n" + kind + b"\r\n")
        with pytest.raises(ConnectionError):
            connection.sendall(chunk * (1000 * MOST_BODY_BYTES // 2**14))
    assert health(served)["status"] == "ok"


def test_a_message_without_end_is_cut_off(served):
    async def come():
        visitor = await Visitor(served.host + PAGE.decode()).open(drawn=False)
        with contextlib.suppress(WebSocketClosedError, StreamClosedError):
            await visitor.socket.write_message("x" * (MOST_MESSAGE_BYTES + 1))
        # a connection that is reset ends without a word
        with pytest.raises((ConnectionError, StreamClosedError)):
            await visitor.receive("NOTHING THAT A SERVER SENDS")

    asyncio.run(come())
    assert health(served)["status"] == "ok"


def test_one_who_never_reads_keeps_nobody_from_a_picture(served):
    async def come():
        polite, deaf = [await Visitor(served.host + PAGE.decode()).open() for _ in range(2)]
        for number in range(200):
            await deaf.move(15 + number % 20)
        for number in range(3):
            await polite.move(20.0 + number)
            await polite.picture(WAIT)
        for visitor in (polite, deaf):
            visitor.close()

    asyncio.run(come())
