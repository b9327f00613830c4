"""One process that serves, or several that share visitors out among themselves.

A session lives in the process that its socket reached; nothing else needs to be there: the page that is sent
before belongs to no session, links hold what they open, and studies are kept by the browser. So processes
share the sockets that they listen at, the secret that signs cookies, and how many sessions each has.

One that dies is replaced. Its pages load themselves again, and come back to what they showed.
"""

import contextlib
import mmap
import os
import secrets
import signal
import sys
import time

STOP = (signal.SIGTERM, signal.SIGINT)

PAUSE = 1.0
"""Time between the death of a process and its replacement [s]."""


class Shares:
    """How many sessions each process has, and how many connections wait there.

    Parameters
    ----------
    processes : int
        How many processes there are; none takes up connections before it notes what it has.
    """

    def __init__(self, processes):
        # forked processes see the same memory
        numbers = memoryview(mmap.mmap(-1, 2 * 8 * processes)).cast("q")
        self._sessions, self._waiting = numbers[:processes], numbers[processes:]
        for number in range(processes):
            self.leave(number)

    def note(self, number, sessions, waiting=0):
        """Note what a process has."""
        self._sessions[number], self._waiting[number] = sessions, waiting

    def leave(self, number):
        """Note that a process takes up no more connections."""
        self.note(number, -1)

    def is_turn_of(self, number):
        """Return whether no other process that serves has less to do."""
        loads = [
            sessions + waiting
            for sessions, waiting in zip(self._sessions, self._waiting, strict=True)
            if sessions >= 0
        ]
        return self._sessions[number] + self._waiting[number] <= min(loads, default=-1)

    def total(self):
        """Return how many sessions there are."""
        return sum(each for each in self._sessions if each > 0)


def run(site, listeners, processes, announce):
    """Serve until told to stop.

    Parameters
    ----------
    site : dashboard.server.command.Site
        Where, and to whom.
    listeners : list of socket.socket
        Sockets that listen already.
    processes : int
        How many processes serve.
    announce : callable
        Called once pages can be served.
    """
    shares, secret = Shares(processes), secrets.token_hex(32)
    if processes == 1:
        _serve(site, listeners, shares, 0, secret, announce)
    else:
        _supervise(site, listeners, shares, processes, secret, announce)


def _serve(site, listeners, shares, number, secret, announce):
    # each process loads the server, and starts its threads, for itself
    from dashboard.server import serving

    serving.run(site, listeners, shares, number, secret, announce)


def _supervise(site, listeners, shares, processes, secret, announce):
    """Start processes, replace those that die, and end all when told to."""
    stopped = []
    for each in STOP:
        signal.signal(each, lambda *_: stopped.append(True))
    numbers = {}

    def start(number, announce):
        identity = os.fork()
        if identity:
            numbers[identity] = number
            return
        for each in STOP:
            signal.signal(each, signal.default_int_handler if each == signal.SIGINT else signal.SIG_DFL)
        _serve(site, listeners, shares, number, secret, announce)
        sys.stdout.flush()
        os._exit(0)

    for number in range(processes):
        start(number, announce if number == 0 else lambda: None)
    while not stopped:
        identity, status = _dead()
        if identity is None:
            time.sleep(0.1)
            continue
        number = numbers.pop(identity)
        shares.leave(number)
        sys.stderr.write(f"trackig: process {identity} ended with {status}; another takes its place\n")
        time.sleep(PAUSE)
        start(number, lambda: None)
    for identity in numbers:
        with contextlib.suppress(ProcessLookupError):
            os.kill(identity, signal.SIGTERM)
    for identity in numbers:
        with contextlib.suppress(ChildProcessError):
            os.waitpid(identity, 0)


def _dead():
    """Return a process that has ended, and how, or None."""
    identity, status = os.waitpid(-1, os.WNOHANG)
    return (identity, os.waitstatus_to_exitcode(status)) if identity else (None, None)
