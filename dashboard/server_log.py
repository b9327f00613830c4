"""What the log leaves out: readers who leave in the middle of a message, and places yet to be filled.

A page that is closed while its messages are handled, or while a picture is on its way to it, makes Bokeh and
Tornado log a traceback each time, although nothing went wrong. Every other error stays in the log.
"""

import logging
from pathlib import PurePath
from traceback import extract_tb

from bokeh.core.validation import silence
from bokeh.core.validation.warnings import EMPTY_LAYOUT
from tornado.websocket import WebSocketClosedError

log = logging.getLogger(__name__)

LOGGERS = ("bokeh.server.protocol_handler", "tornado.application", "asyncio", "panel.io.document")
"""Loggers that say so."""

_CLOSED = "Failed sending message as connection was closed"
"""What Panel says of each message that was on its way."""

_CONNECTION = "bokeh/server/connection.py"
"""Where Bokeh asserts that a connection still has its session, also for messages after the last."""


def is_departure(error):
    """Return whether an exception says no more than that a reader has left.

    Parameters
    ----------
    error : BaseException or None
        The exception.
    """
    if isinstance(error, WebSocketClosedError):
        return True
    frames = extract_tb(error.__traceback__) if isinstance(error, AssertionError) else []
    if not frames or frames[-1].name != "session":
        return False
    return PurePath(frames[-1].filename).match(_CONNECTION)


def leave_out_departures():
    """Keep departures out of the log, for the life of the process."""
    for name in LOGGERS:
        logger = logging.getLogger(name)
        if _is_worth_logging not in logger.filters:
            logger.addFilter(_is_worth_logging)


def leave_out_empty_places():
    """Keep warnings of layouts without children out of the log: each tab is a place until it is opened."""
    silence(EMPTY_LAYOUT, True)


def _is_worth_logging(record):
    error = record.exc_info[1] if record.exc_info else None
    if not is_departure(error) and record.msg != _CLOSED:
        return True
    log.debug("A reader left in the middle of a message")
    return False
