"""``trackig serve`` as a process, for tests that need the whole of it."""

import contextlib
import os
import socket
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path
from types import SimpleNamespace

import pytest

ROOT = Path(__file__).parents[3]

START_LIMIT = 180
"""Seconds that the server may take to start on a slow machine."""


@dataclass(frozen=True)
class Served:
    """A server that runs.

    Attributes
    ----------
    process : subprocess.Popen
        Its process, or that which watches over several.
    port : int
        Where it listens.
    log : pathlib.Path
        What it says.
    """

    process: subprocess.Popen
    port: int
    log: Path

    @property
    def host(self):
        """What stands before the path in its address."""
        return f"http://127.0.0.1:{self.port}"

    def children(self):
        """Return the processes that it started."""
        found = Path(f"/proc/{self.process.pid}/task/{self.process.pid}/children").read_text()
        return [int(each) for each in found.split()]


@contextlib.contextmanager
def serving(folder, *words):
    """Serve as long as the context lasts; nothing may be left of it then."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    log = folder / "log.txt"
    command = [sys.executable, "-m", "dashboard", "serve", "--port", str(port), *words]
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    with log.open("w") as output:
        process = subprocess.Popen(
            command, cwd=folder, env=environment, stdout=output, stderr=subprocess.STDOUT
        )
    try:
        deadline = time.monotonic() + START_LIMIT
        while "serving at" not in log.read_text():
            if process.poll() is not None or time.monotonic() > deadline:
                pytest.fail(f"the server did not start:\n{log.read_text()}")
            time.sleep(0.05)
        yield Served(process, port, log)
    finally:
        process.terminate()
        try:
            process.wait(60)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()
            raise


@pytest.fixture(scope="package")
def served(tmp_path_factory):
    """Serve from two processes below a prefix, to pages of a proxy."""
    words = ("--prefix", "/tools", "--processes", "2", "--allow-origin", "trackig.example")
    with serving(tmp_path_factory.mktemp("served"), *words) as running:
        yield running


async def begin(context, name, **arguments):
    """Make a session as the socket does, and return it."""
    request = SimpleNamespace(path="/dashboard/ws", arguments=arguments, cookies={}, headers={})
    return await context.create_session_if_needed(name, request)
