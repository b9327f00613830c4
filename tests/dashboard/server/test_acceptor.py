"""Connections are handed on once they ask for something; health is answered whatever the server does."""

import select
import socket
import time

import pytest

from dashboard.server import acceptor as module
from dashboard.server.acceptor import Acceptor
from tests.waiting import WAIT, wait_until


class Door:
    """An acceptor at a port of its own, and what it handed on."""

    def __init__(self, is_our_turn):
        self.listener = socket.create_server(("127.0.0.1", 0))
        self.listener.setblocking(False)
        self.place = self.listener.getsockname()
        self.handed_on = []
        self.acceptor = Acceptor(
            [self.listener],
            "/tools/health",
            lambda: '{"status": "ok"}',
            lambda connection, address: self.handed_on.append((connection, address)),
            is_our_turn,
        )

    def knock(self, data=b""):
        """Return a connection that has sent something."""
        knocking = socket.create_connection(self.place, timeout=WAIT)
        knocking.sendall(data)
        return knocking

    def close(self):
        """Close all that is open."""
        self.acceptor.stop()
        for connection, _ in self.handed_on:
            connection.close()


@pytest.fixture
def door():
    made = []

    def make(is_our_turn=lambda: True):
        made.append(Door(is_our_turn))
        made[-1].acceptor.start()
        return made[-1]

    yield make
    for each in made:
        each.close()


@pytest.mark.parametrize("target", [b"/tools/health", b"/tools/health?who=proxy"])
def test_health_is_answered_though_nobody_takes_up_what_is_handed_on(door, target):
    with door().knock(b"GET " + target + b" HTTP/1.1\r\nHost: here\r\n\r\n") as knocking:
        answer = b"".join(iter(lambda: knocking.recv(4096), b""))
    head, _, body = answer.partition(b"\r\n\r\n")
    assert head.startswith(b"HTTP/1.1 200 OK\r\n")
    assert b"Content-Length: 16" in head
    assert body == b'{"status": "ok"}'


def test_a_question_for_the_head_alone_gets_no_body(door):
    with door().knock(b"HEAD /tools/health HTTP/1.1\r\n\r\n") as knocking:
        answer = b"".join(iter(lambda: knocking.recv(4096), b""))
    assert answer.endswith(b"\r\n\r\n")


@pytest.mark.parametrize(
    "data", [b"GET /tools/dashboard HTTP/1.1\r\n", b"GET /tools/healthy", b"\x16\x03\x01"]
)
def test_whatever_else_is_asked_is_handed_on_unread(door, data):
    opened = door()
    with opened.knock(data) as knocking:
        wait_until(lambda: opened.handed_on)
        connection, address = opened.handed_on[0]
        assert address == knocking.getsockname()
        assert connection.recv(100) == data


def test_a_question_that_comes_in_pieces_is_waited_for(door):
    opened = door()
    with opened.knock(b"GET /tools") as knocking:
        time.sleep(0.3)
        assert opened.handed_on == []
        knocking.sendall(b"/health HTTP/1.1\r\n\r\n")
        assert knocking.recv(4096).startswith(b"HTTP/1.1 200")


@pytest.mark.skipif(not hasattr(select, "POLLRDHUP"), reason="only Linux tells of half-closed connections")
def test_a_question_that_will_never_be_whole_is_closed_at_once(door, monkeypatch):
    monkeypatch.setattr(module, "LONGEST_SILENCE", 1000)
    opened = door()
    with opened.knock(b"GET /to") as knocking:
        knocking.shutdown(socket.SHUT_WR)
        assert knocking.recv(1) == b""
    assert opened.handed_on == []


def test_who_says_nothing_is_closed_after_a_while(door, monkeypatch):
    monkeypatch.setattr(module, "LONGEST_SILENCE", 0.1)
    with door().knock() as knocking:
        assert knocking.recv(1) == b""


def test_no_more_than_so_many_may_be_silent(door, monkeypatch):
    monkeypatch.setattr(module, "MOST_SILENT", 2)
    opened = door()
    silent = [opened.knock() for _ in range(4)]
    assert [each.recv(1) for each in silent[:2]] == [b"", b""]
    silent[3].sendall(b"GET /tools/health \r\n\r\n")
    assert silent[3].recv(4096).startswith(b"HTTP/1.1 200")
    for each in silent:
        each.close()


def test_a_process_whose_turn_it_is_not_leaves_connections_to_others(door):
    turn = []
    opened = door(lambda: bool(turn))
    with opened.knock(b"GET / HTTP/1.1\r\n"):
        time.sleep(0.3)
        assert opened.handed_on == []
        turn.append(True)
        wait_until(lambda: opened.handed_on)
