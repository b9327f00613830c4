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

import trackig_core as tig
from tests.waiting import WAIT

ROOT = Path(__file__).parent.parent.parent

BROWSERS = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome")

START_LIMIT = 120
"""Seconds that the server may take to start on a slow machine with no compiled kernels."""

expect.set_options(timeout=1000 * WAIT)

SOLVED = re.compile("Paper's run|Live run")
"""What the status line says once there is something to see."""


def wait_until_solved(page, timeout=1000 * WAIT):
    """Wait until a page stands still, and shows its design solved."""
    page.wait_for_function("() => window.Bokeh?.documents?.[0]?.is_idle", timeout=timeout)
    # the status line comes last, after the view in the open tab; an assertion would read the whole page aloud
    # each time that it is not there yet
    page.get_by_role("status").filter(has_text=SOLVED).first.wait_for(timeout=timeout)
    page.wait_for_function("() => Bokeh.documents[0].is_idle", timeout=timeout)


def wait_until_at_rest(page):
    """Wait until a page stands still and its layout has been the same for twenty pictures on end."""
    page.wait_for_function("() => Bokeh.documents[0].is_idle")
    page.evaluate(
        """() => new Promise(done => {
            let last = "", same = 0
            const look = () => {
                const places = [...Bokeh.index.roots].map(root => root.el?.getBoundingClientRect())
                const {scrollWidth, scrollHeight, scrollTop} = document.scrollingElement
                const now = JSON.stringify([places, scrollWidth, scrollHeight, scrollTop])
                same = now == last && Bokeh.documents[0].is_idle ? same + 1 : 0
                last = now
                same == 20 ? done() : requestAnimationFrame(look)
            }
            look()
        })"""
    )


def wait_until_drawn(page, name):
    """Wait until a model of a name is drawn; one that is set or looked at before may not heed it."""
    page.wait_for_function(
        """name => {
            const model = Bokeh.documents[0].get_model_by_name(name)
            const view = model && Bokeh.index.find_one(model)
            return view != null && view.has_finished() && view.el.isConnected
        }""",
        arg=name,
    )


def wait_for_levels(page, *expected, source="insertion_gain"):
    """Wait until the curve in the browser is one of those expected, to the last digit shown."""
    page.wait_for_function(
        """([source, expected]) => {
            const level = Bokeh.documents[0].get_model_by_name(source)?.data.level ?? []
            return expected.some(curve => curve.every((value, band) => Math.abs(value - level[band]) < 1e-6))
        }""",
        arg=[source, [list(map(float, curve)) for curve in expected]],
    )


def resting_place(page, figure, x, down):
    """Return where a figure at rest shows a value of x, so many pixels below the top of its frame."""
    wait_until_drawn(page, figure)
    return page.evaluate(
        """([name, x, down]) => new Promise(done => {
            const view = Bokeh.index.find_one(Bokeh.documents[0].get_model_by_name(name))
            let last = "", same = 0
            const look = () => {
                const box = view.canvas_view.el.getBoundingClientRect()
                const place = [box.x + view.frame.x_scale.compute(x), box.y + view.frame.bbox.top + down]
                same = String(place) == last ? same + 1 : 0
                last = String(place)
                same == 20 ? done(place) : requestAnimationFrame(look)
            }
            look()
        })""",
        [figure, x, down],
    )


def hover_until_shown(page, figure, x, shown, patience=WAIT):
    """Rest the pointer on a figure until something is shown; a late layout may move the figure away."""
    deadline = time.monotonic() + patience
    while not shown.is_visible() and time.monotonic() < deadline:
        across, down = resting_place(page, figure, x, 20)
        page.mouse.move(across, down + 5)
        page.mouse.move(across, down)
        page.wait_for_timeout(100)
    expect(shown).to_be_visible()


def count_sent(page):
    """Have a page count its messages to the server in ``window.sent``, and wait until it has none to send."""
    page.evaluate(
        """() => new Promise(done => {
            window.sent = 0
            const send = WebSocket.prototype.send
            WebSocket.prototype.send = function (...data) { window.sent += 1; return send.apply(this, data) }
            let last = 0, quiet = 0
            const look = () => {
                quiet = window.sent == last && Bokeh.documents[0].is_idle ? quiet + 1 : 0
                last = window.sent
                if (quiet < 10) return setTimeout(look, 50)
                window.sent = 0
                done()
            }
            look()
        })"""
    )


@pytest.fixture(scope="package")
def chromium():
    """Start the system's browser, not one that Playwright would have to download.

    It ends with the last test in a browser: Playwright's event loop would not let others run theirs.
    """
    path = next(filter(None, map(shutil.which, BROWSERS)), None)
    if path is None:
        reason = f"no browser found (looked for {', '.join(BROWSERS)})"
        if os.environ.get("TRACKIG_REQUIRE_BROWSER") == "1":
            pytest.fail(reason)
        pytest.skip(reason)
    # containers lack the kernel features of the sandbox, and often a large /dev/shm;
    # pages of one process compile the scripts once, which otherwise takes each of them half of its opening
    flags = ["--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--process-per-site"]
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=path, args=flags)
        yield browser
        browser.close()


@pytest.fixture(scope="package")
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
            server.wait(30)
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


UNTOUCHED = "as it opened"
"""How tests leave the page that is kept all the time."""

WANDERED = "with any design in any tab"
"""How tests leave a page of which they change design and tab, and nothing else."""


class Reader:
    """A browser with one memory for scripts, which reads and compiles them once for all its pages.

    The process that has compiled them lives as long as any page of the dashboard: one is always kept.

    Parameters
    ----------
    chromium : playwright.sync_api.Browser
        The browser.
    address : str
        Where the dashboard is served.
    """

    def __init__(self, chromium, address):
        self._address = address
        self._context = chromium.new_context()
        self._kept = {}
        self._complaints, self._requested = [], []

    def open(self, width=1440, height=900, query=""):
        """Open the dashboard in a session of its own."""
        page = self.open_at_once(width, height, query)
        wait_until_solved(page)
        return page

    def open_at_once(self, width=1440, height=900, query=""):
        """Open the dashboard, and wait for nothing that it shows."""
        page = self._context.new_page()
        page.set_viewport_size({"width": width, "height": height})
        page.set_default_timeout(1000 * WAIT)
        page.on("request", lambda request: self._requested.append(request.url))
        page.on("websocket", lambda websocket: self._requested.append(websocket.url))
        page.on("pageerror", lambda error: self._complaints.append(str(error)))
        page.on("console", self._listen)
        page.goto(self._address + query, wait_until="commit")
        return page

    def keep(self, width=1440, height=900, left="anyhow"):
        """Return a page that tests of a kind share: what one leaves there the next one finds."""
        kind = (width, height, left)
        if kind not in self._kept:
            self._kept[kind] = self.open(width, height)
        self._kept[kind].bring_to_front()
        return self._kept[kind]

    def _listen(self, line):
        if line.type in ("error", "warning"):
            self._complaints.append(line.text)

    def forget(self):
        """Close what is not kept, with all that it left in the browser's memory."""
        for page in self._context.pages:
            if page not in self._kept.values():
                page.evaluate("() => localStorage.clear()")
                page.close()
        self._context.clear_permissions()
        self._context.clear_cookies()

    def check(self):
        """No page may have complained, nor asked for anything from elsewhere, since the last check."""
        complaints, requested = [*self._complaints], [*self._requested]
        self._complaints.clear()
        self._requested.clear()
        here = self._address.removeprefix("http://").removesuffix("dashboard")
        local = (f"http://{here}", f"ws://{here}", "data:", "blob:")
        assert [url for url in requested if not url.startswith(local)] == []
        assert complaints == []
        return requested

    def close(self):
        """Close all pages."""
        self._context.close()


@pytest.fixture(scope="package")
def reader(chromium, address):
    """Return a browser's reader of the dashboard."""
    one = Reader(chromium, address)
    one.keep(left=UNTOUCHED)
    yield one
    one.close()


@pytest.fixture
def open_dashboard(reader):
    """Return a function that opens the dashboard in a session of its own.

    Afterwards no page may have complained, nor asked for anything from elsewhere.
    """
    yield reader.open
    reader.forget()
    assert reader.check()


@pytest.fixture
def dashboard(open_dashboard):
    """Open the dashboard."""
    return open_dashboard()


@pytest.fixture
def untouched_dashboard(reader):
    """Open the dashboard once for all tests that leave its design, tab and theme as they found them."""
    yield reader.keep(left=UNTOUCHED)
    reader.check()


@pytest.fixture
def published_dashboard(reader):
    """Return a page that tests share which may change its design and its tab, and nothing else.

    It shows what the dashboard opens with, chosen anew after another track.
    """
    page = reader.keep(left=WANDERED)
    page.get_by_role("tab", name="Explore", exact=True).click()
    presets = page.get_by_role("combobox", name="Track of Table 1", exact=True)
    for name, preset in (
        ("Booted sleeper", "booted-sleeper"),
        ("Booted block, low mass", "booted-block-low-mass"),
    ):
        presets.select_option(name)
        wait_for_levels(page, tig.solve(tig.PRESETS[preset]).insertion_gain)
    wait_until_solved(page)
    yield page
    reader.check()


@pytest.fixture
def kept_dashboard(reader):
    """Return a function that gives the page of a size that tests share which set all that they look at.

    Afterwards no page may have complained, nor asked for anything from elsewhere.
    """
    yield reader.keep
    reader.check()
