"""Takes connections up on a thread of its own, and answers there whether the server is alive.

``/health`` answers while the event loop makes a page. Among several processes a connection goes to one that
has no more to do than the others.
"""

import contextlib
import select
import selectors
import socket
import threading
import time

HEALTH = "/health"
"""What is asked whether the server is alive."""

LONGEST_SILENCE = 30.0
"""Time after which a connection that asks for nothing is closed [s]; browsers open some in advance."""

MOST_SILENT = 256
"""Connections that may be silent at a time; further ones replace the oldest."""

PAUSE = 0.02
"""Time between looks whether it is this process's turn [s]."""

ANSWER = "HTTP/1.1 200 OK\r\nContent-Type: application/json\r\nContent-Length: {length}\r\n"
ANSWER += "Cache-Control: no-store\r\nConnection: close\r\n\r\n{text}"


class Acceptor(threading.Thread):
    """Hands connections on once they ask for something; questions for health it answers itself.

    Parameters
    ----------
    listeners : iterable of socket.socket
        Where connections come in; they do not block.
    path : str
        The question for health, such as ``"/health"``.
    health : callable
        Returns the answer as JSON (str).
    hand_on : callable
        Called on this thread with a connection and its address.
    is_our_turn : callable
        Returns whether this process should take up a connection now.
    """

    def __init__(self, listeners, path, health, hand_on, is_our_turn=lambda: True):
        super().__init__(name="acceptor", daemon=True)
        self._listeners = list(listeners)
        self._questions = tuple(f"{method} {path}".encode("ascii") for method in ("GET", "HEAD"))
        self._health, self._hand_on, self._is_our_turn = health, hand_on, is_our_turn
        self._silent = {}
        self._stopping = threading.Event()
        self._selector = selectors.DefaultSelector()

    def stop(self):
        """Take up no more connections."""
        self._stopping.set()
        self.join()

    def run(self):
        """Take up connections until stopped."""
        for listener in self._listeners:
            self._selector.register(listener, selectors.EVENT_READ)
        while not self._stopping.is_set():
            is_waiting = False
            ready = [key.fileobj for key, _ in self._selector.select(timeout=0.2)]
            for each in ready:
                if each not in self._listeners:
                    is_waiting |= self._look(each)
                elif self._is_our_turn():
                    self._accept(each)
            # what is only looked at stays to be read, and would have this thread look without a pause
            if is_waiting or (ready and not self._is_our_turn()):
                self._stopping.wait(PAUSE)
            self._close_silent()
        for connection in list(self._silent):
            self._close(connection)
        for listener in self._listeners:
            listener.close()
        self._selector.close()

    def _accept(self, listener):
        # another process may have been quicker, and a visitor may have left
        with contextlib.suppress(OSError):
            connection, address = listener.accept()
            connection.setblocking(False)
            self._silent[connection] = (time.monotonic(), address)
            self._selector.register(connection, selectors.EVENT_READ)

    def _look(self, connection):
        """Hand a connection on, or answer it; return whether it has yet to say which."""
        try:
            begun = connection.recv(max(map(len, self._questions)) + 1, socket.MSG_PEEK)
        except BlockingIOError:
            return False
        except OSError:
            begun = b""
        is_ours = any(each.startswith(begun) for each in self._questions)
        if not begun:
            self._close(connection)
        elif is_ours and _will_say_no_more(connection):
            # what is left unread would have the connection reset
            connection.recv(len(begun))
            self._close(connection)
        elif any(
            begun.startswith(each) and begun[len(each) :][:1] in (b" ", b"?") for each in self._questions
        ):
            self._answer(connection, begun.startswith(b"HEAD"))
        elif not is_ours:
            _, address = self._silent.pop(connection)
            self._selector.unregister(connection)
            self._hand_on(connection, address)
        return connection in self._silent

    def _answer(self, connection, head_only):
        text = self._health()
        answer = ANSWER.format(length=len(text), text="" if head_only else text)
        with contextlib.suppress(OSError):
            # what is left unread would have the answer thrown away
            connection.recv(65536)
            connection.send(answer.encode("ascii"))
        self._close(connection)

    def _close_silent(self):
        now = time.monotonic()
        for connection, (since, _) in list(self._silent.items()):
            if now - since > LONGEST_SILENCE or len(self._silent) > MOST_SILENT:
                self._close(connection)

    def _close(self, connection):
        del self._silent[connection]
        self._selector.unregister(connection)
        connection.close()


def _will_say_no_more(connection):
    """Return whether the other side has closed its half, what it sent before being still unread.

    Only Linux tells; elsewhere such a connection counts as silent.
    """
    if not hasattr(select, "POLLRDHUP"):
        return False
    poll = select.poll()
    poll.register(connection, select.POLLRDHUP)
    return bool(poll.poll(0))
