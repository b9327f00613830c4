"""A served dashboard and a real headless Chromium; no request may leave this machine."""

import contextlib
import os
import re
import shutil
import socket
import subprocess
import sys
import time
import urllib.error
import urllib.request
from pathlib import Path

import pytest
from playwright.sync_api import expect, sync_playwright

ROOT = Path(__file__).parent.parent.parent

BROWSERS = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome")

START_LIMIT = 120
"""Seconds that the server may take to start on a slow machine with no compiled kernels."""

SOLVED = re.compile("Paper's run|Live run")
"""What the status line says once there is something to see."""


def wait_until_solved(page, timeout=60_000):
    """Wait until a page stands still, and shows its design solved."""
    page.wait_for_function("() => window.Bokeh?.documents?.[0]?.is_idle", timeout=timeout)
    expect(page.get_by_role("status").filter(has_text=SOLVED).first).to_be_visible(timeout=timeout)


@pytest.fixture(scope="session")
def chromium():
    """Start the system's browser, not one that Playwright would have to download."""
    path = next(filter(None, map(shutil.which, BROWSERS)), None)
    if path is None:
        reason = f"no browser found (looked for {', '.join(BROWSERS)})"
        if os.environ.get("TRACKIG_REQUIRE_BROWSER") == "1":
            pytest.fail(reason)
        pytest.skip(reason)
    # containers lack the kernel features of the sandbox, and often a large /dev/shm
    flags = ["--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage"]
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=path, args=flags)
        yield browser
        browser.close()


@pytest.fixture(scope="session")
def address(chromium, tmp_path_factory):  # noqa: ARG001  (no browser, no server)
    """Serve the dashboard as a user does, and return its address."""
    with serving(free_port(), tmp_path_factory.mktemp("server") / "log.txt") as url:
        yield url


@pytest.fixture
def serve():
    """Return a function that serves the dashboard at a port, as long as its context lasts, with a log."""
    return serving


@pytest.fixture
def port():
    """Return a port that nobody serves at."""
    return free_port()


def free_port():
    """Return a port that nobody serves at."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        return free.getsockname()[1]


@contextlib.contextmanager
def serving(port, log):
    """Serve the dashboard at a port, and give its address; its log may hold no traceback in the end."""
    command = [sys.executable, "-m", "panel", "serve", "dashboard", "--address", "127.0.0.1"]
    command += ["--port", str(port), "--allow-websocket-origin", f"127.0.0.1:{port}"]
    with log.open("w") as output:
        server = subprocess.Popen(command, cwd=ROOT, stdout=output, stderr=subprocess.STDOUT)
    try:
        url = f"http://127.0.0.1:{port}/dashboard"
        _wait_until_served(url, server, log)
        yield url
    finally:
        server.terminate()
        with contextlib.suppress(subprocess.TimeoutExpired):
            server.wait(10)
        server.kill()
        server.wait()
    assert "Traceback" not in log.read_text(), log.read_text()


def _wait_until_served(url, server, log):
    deadline = time.monotonic() + START_LIMIT
    while server.poll() is None and time.monotonic() < deadline:
        try:
            with urllib.request.urlopen(url, timeout=START_LIMIT) as answer:
                answer.read()
                return
        except (urllib.error.URLError, ConnectionError):
            time.sleep(0.1)
    pytest.fail(f"the server did not start:\n{log.read_text()}")


@pytest.fixture
def open_dashboard(address, chromium):
    """Return a function that opens the dashboard in a session of its own.

    Afterwards no page may have complained, nor asked for anything from elsewhere.
    """
    complaints, requested, contexts = [], [], []

    def open_page(width=1440, height=900, query=""):
        contexts.append(chromium.new_context(viewport={"width": width, "height": height}))
        page = contexts[-1].new_page()
        page.set_default_timeout(60_000)
        page.on("request", lambda request: requested.append(request.url))
        page.on("websocket", lambda websocket: requested.append(websocket.url))
        page.on("pageerror", lambda error: complaints.append(str(error)))
        page.on("console", lambda line: line.type in ("error", "warning") and complaints.append(line.text))
        page.goto(address + query)
        wait_until_solved(page)
        return page

    yield open_page
    for context in contexts:
        context.close()
    here = address.removeprefix("http://").removesuffix("dashboard")
    local = (f"http://{here}", f"ws://{here}", "data:", "blob:")
    assert requested
    assert [url for url in requested if not url.startswith(local)] == []
    assert complaints == []


@pytest.fixture
def dashboard(open_dashboard):
    """Open the dashboard."""
    return open_dashboard()
