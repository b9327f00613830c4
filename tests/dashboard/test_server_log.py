"""What the server's log leaves out, and what it keeps."""

import asyncio
import logging

import pytest
from bokeh.server.connection import ServerConnection
from tornado.websocket import WebSocketClosedError

from dashboard.server_log import LOGGERS, is_departure, leave_out_departures


@pytest.fixture(autouse=True)
def _filtered():
    leave_out_departures()


def left():
    """Return what Bokeh raises when it handles a message of a connection that has gone."""
    connection = ServerConnection.__new__(ServerConnection)
    connection._session = None
    with pytest.raises(AssertionError) as caught:
        connection.session  # noqa: B018  (the property raises)
    return caught.value


def mistake():
    """Return an assertion that fails elsewhere."""
    with pytest.raises(AssertionError) as caught:
        raise AssertionError("a mistake")
    return caught.value


def test_messages_of_a_reader_who_has_left_are_no_errors():
    assert is_departure(left())
    assert is_departure(WebSocketClosedError())
    assert not is_departure(mistake())
    assert not is_departure(AssertionError("never raised"))
    assert not is_departure(None)


@pytest.mark.parametrize("name", LOGGERS)
def test_only_departures_are_left_out_of_the_log(name, caplog):
    logger = logging.getLogger(name)
    logger.error("message of a closed page", exc_info=left())
    assert caplog.text == ""
    logger.error("message of an open page", exc_info=mistake())
    logger.error("without an exception")
    assert "a mistake" in caplog.text
    assert "without an exception" in caplog.text


def test_messages_that_were_on_their_way_to_a_closed_page_are_left_out(caplog):
    logger = logging.getLogger("panel.io.document")
    logger.warning("Failed sending message as connection was closed")
    assert caplog.text == ""
    logger.warning("Failed sending message due to following error: no paint")
    assert "no paint" in caplog.text


def test_tasks_that_nobody_awaits_are_logged_alike(caplog):
    async def fail(error):
        asyncio.get_running_loop().call_exception_handler({"message": "a task failed", "exception": error})

    asyncio.run(fail(left()))
    assert caplog.text == ""
    asyncio.run(fail(mistake()))
    assert "a mistake" in caplog.text


def test_asking_twice_filters_once():
    leave_out_departures()
    assert all(len(logging.getLogger(name).filters) == 1 for name in LOGGERS)
