"""The server of one process: Bokeh's, with connections from :class:`Acceptor`, a login, and words that fit.

The login is Panel's: a name, which is not checked, and one password for all. It keeps passers-by out; without
TLS, which a proxy in front can give, whoever listens on the network reads the password.
"""

import asyncio
import contextlib
import json
import logging
import os
import sys
import time
from collections import deque
from pathlib import Path
from traceback import extract_tb
from urllib.parse import urlsplit

import tornado.web
from bokeh.server.auth_provider import NullAuth
from bokeh.server.server import BaseServer
from bokeh.server.tornado import BokehTornado
from bokeh.server.urls import per_app_patterns
from bokeh.server.util import check_allowlist
from panel.auth import BasicAuthProvider
from panel.config import config
from panel.io.application import build_single_handler_application
from panel.io.document import dispatch_tornado
from panel.io.resources import DIST_DIR
from panel.io.server import INDEX_HTML, WSHandler, get_static_routes
from panel.io.state import state
from tornado.httpserver import HTTPServer
from tornado.ioloop import IOLoop, PeriodicCallback
from tornado.websocket import WebSocketClosedError

import trackig_core as tig
from dashboard.compute.pacing import PACE
from dashboard.server import sessions
from dashboard.server.acceptor import HEALTH, Acceptor
from dashboard.server.command import PAGE
from dashboard.server.gathering import GatheringStream

DASHBOARD = Path(__file__).parent.parent
LIBRARY = Path(tig.__file__).parent
LOGIN = Path(__file__).parent / "templates" / "login.html"

BEAT = 0.5
"""Time between the beats by which one knows how long the event loop has been busy [s]."""

MOST_HEADER_BYTES, MOST_BODY_BYTES = 2**16, 2**16
"""What a request may hold; files and changes come through the socket."""

LONGEST_REQUEST = 60.0
"""Time that a request's body may take [s]."""


EXPECTED = ("PULL-DOC-REQ", "PATCH-DOC", "SERVER-INFO-REQ")
"""Messages that a page sends; Bokeh would also take a document that replaces the session's."""

MOST_FAULTS = 20
"""Messages that cannot be followed after which a connection is closed."""

LONGEST_LOGGED = 200
"""Characters of a message that are logged."""

HANDLERS, SOCKETS, BAD_HEADERS = "bokeh.server.protocol_handler", "bokeh.server.views.ws", "bokeh.protocol"
"""Loggers that say what is wrong with a message."""


class SocketHandler(WSHandler):
    """Refuses pages of other hosts with advice that fits ``trackig serve``, and bounds what a page may ask.

    Whoever sends what cannot be followed is told so without the server's traceback, and cut off in the end.
    """

    _faults = 0

    def check_origin(self, origin):
        """Return whether pages of an origin may open a socket."""
        host = urlsplit(origin).netloc.lower()
        if check_allowlist(host, self.application.websocket_origins):
            return True
        # the host is what somebody sent: nothing that would break the line
        shown = "".join(each for each in host[:200] if each.isalnum() or each in ".:-[]")
        _say(f"a page of {shown or 'no host'} was refused; if it is yours, add --allow-origin {shown}")
        return False

    def open(self):
        """Have the frames of each message sent in one go, and at once."""
        self.ws_connection.stream.gathers = True
        self.set_nodelay(True)
        return super().open()

    async def _async_open(self, token):
        """Begin a session when those who work and pages that have begun let it.

        Whoever has left meanwhile gets none: nothing would end it.
        """
        await PACE.turn()
        if self._is_open():
            await super()._async_open(token)
        if self.connection is not None:
            # what it says until all of it is there is no work at it
            PACE.enter(self.connection.session.document)

    def _is_open(self):
        return self.ws_connection is not None and not self.ws_connection.is_closing()

    async def on_message(self, fragment):
        """Take what a page sends, but nothing after what it was cut off for."""
        if self.connection is not None:
            PACE.hear(self.connection.session.document)
        if self._is_open():
            await super().on_message(fragment)

    async def _handle(self, message):
        if message.msgtype not in EXPECTED:
            self._protocol_error(f"{message.msgtype[:40]} is nothing that a page sends")
            return None
        return await super()._handle(message)

    async def send_message(self, message):
        """Send a message whole, as Panel sends pictures; one that says that something failed counts.

        Bokeh waits after each of its frames; those of a picture could get between them.
        """
        if message.msgtype == "ERROR":
            message.content["traceback"] = None
            self._faults += 1
        # whoever has left needs no answer
        with contextlib.suppress(WebSocketClosedError):
            await asyncio.gather(*dispatch_tornado(self.connection, msg=message))
        if self._faults > MOST_FAULTS:
            self._protocol_error("too many messages that cannot be followed")


def shorten(record):
    """Leave one short line of what is logged of a message from a page (a filter of log records).

    Whoever sends what cannot be followed fills the log with tracebacks else. Errors of ours keep theirs.
    """
    error = record.exc_info[1] if record.exc_info else None
    if is_ours(error):
        return True
    if record.name == BAD_HEADERS or (error is not None and record.name == SOCKETS):
        # that the connection is closed, and why, is a line of its own
        return False
    text = record.getMessage() if error is None else f"a message was refused: {error!r}"
    text = " ".join(text.split())
    record.msg = text if len(text) <= LONGEST_LOGGED else f"{text[:LONGEST_LOGGED]}…"
    record.args = record.exc_info = record.exc_text = None
    return True


def is_ours(error):
    """Return whether an exception passed through code of the dashboard or its library."""
    files = [] if error is None else [Path(frame.filename) for frame in extract_tb(error.__traceback__)]
    return any(
        each.is_relative_to(place) and not each.is_relative_to(DASHBOARD / "server")
        for each in files
        for place in (DASHBOARD, LIBRARY)
    )


class HealthHandler(tornado.web.RequestHandler):
    """Answers on connections that a proxy keeps open."""

    def initialize(self, health):
        """Note what answers."""
        self._health = health

    def get(self):
        """Answer that the server is alive."""
        self.set_header("Content-Type", "application/json")
        self.set_header("Cache-Control", "no-store")
        self.write(self._health())

    head = get


def run(site, listeners, shares, number, secret, announce):
    """Serve until told to stop.

    Parameters
    ----------
    site : dashboard.server.command.Site
        Where, and to whom.
    listeners : list of socket.socket
        Sockets that listen already.
    shares : dashboard.server.processes.Shares
        How many sessions each process has.
    number : int
        Which of them this one is.
    secret : str
        Signs cookies, in all processes alike.
    announce : callable
        Called once pages can be served.
    """
    told = {sessions.MOST_VARIABLE: site.most_sessions, sessions.AHEAD_VARIABLE: site.pages_ahead}
    os.environ.update({name: str(number) for name, number in told.items() if number is not None})
    beats = [time.monotonic()]
    waiting = deque()

    def is_our_turn():
        # what the loop has not come to is work for it, too
        shares.note(number, sessions.count(), len(waiting))
        return shares.is_turn_of(number)

    def beat():
        beats[0] = time.monotonic()
        is_our_turn()

    def health():
        return json.dumps(
            {
                "status": "ok",
                "version": tig.__version__,
                "sessions": shares.total(),
                "busy_s": round(max(0.0, time.monotonic() - beats[0] - BEAT), 1),
            }
        )

    for name in (HANDLERS, SOCKETS, BAD_HEADERS):
        logging.getLogger(name).addFilter(shorten)
    loop = IOLoop.current()
    http, server = _server(site, secret, health, loop)

    def hand_on(connection, address):
        waiting.append((connection, address))
        loop.add_callback(take_up)

    def take_up():
        connection, address = waiting.popleft()
        http.handle_stream(GatheringStream(connection, max_buffer_size=sessions.MOST_MESSAGE_BYTES), address)

    acceptor = Acceptor(listeners, site.prefix + HEALTH, health, hand_on, is_our_turn)
    PeriodicCallback(beat, 1000 * BEAT).start()
    server.start()
    # after what is done before the first session
    loop.add_callback(acceptor.start)
    loop.add_callback(announce)
    loop.add_callback(beat)
    server.run_until_shutdown()
    if acceptor.is_alive():
        acceptor.stop()


def _server(site, secret, health, loop):
    """Return Bokeh's server, and the HTTP server that it answers through."""
    application = build_single_handler_application(DASHBOARD)
    routes = [
        (route, SocketHandler if handler is WSHandler else handler, *more)
        for route, handler, *more in per_app_patterns
    ]
    with _replaced(per_app_patterns, routes):
        bokeh = BokehTornado(
            {f"/{PAGE}": application},
            prefix=site.prefix,
            extra_websocket_origins=list(site.origins),
            extra_patterns=[*get_static_routes({}), (HEALTH, HealthHandler, {"health": health})],
            websocket_max_message_size_bytes=sessions.MOST_MESSAGE_BYTES,
            index=INDEX_HTML,
            ico_path=DIST_DIR / "images" / "favicon.ico",
            auth_provider=NullAuth() if site.password is None else BasicAuthProvider(login_template=LOGIN),
            cookie_secret=secret,
        )
    if site.password is not None:
        config.cookie_secret = secret
        state._server_config[bokeh] = {"basic_auth": site.password}
    http = HTTPServer(
        bokeh,
        max_header_size=MOST_HEADER_BYTES,
        max_body_size=MOST_BODY_BYTES,
        body_timeout=LONGEST_REQUEST,
        idle_connection_timeout=LONGEST_REQUEST,
    )
    return http, BaseServer(loop, bokeh, http)


@contextlib.contextmanager
def _replaced(patterns, now):
    before, patterns[:] = list(patterns), now
    try:
        yield
    finally:
        patterns[:] = before


def _say(words):
    sys.stderr.write(f"trackig: {words}\n")
    sys.stderr.flush()
