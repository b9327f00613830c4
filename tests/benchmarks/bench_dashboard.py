"""How soon the curve follows the hand, and what a frame costs the server. Needs a browser, and quiet.

Run with ``python -m pip install -e ".[dev]"`` and ``pytest tests/benchmarks/bench_dashboard.py``.
"""

import collections
import json
import subprocess
import sys
import time
import urllib.request

import numpy as np
import panel as pn
import pytest
from bokeh.document import Document
from bokeh.protocol import Protocol
from panel.io.state import set_curdoc

import trackig_core as tig
from dashboard import app
from dashboard.compute.document import gathering
from dashboard.compute.pinned import PinnedSummaries
from dashboard.compute.workers import AT_REST, MOVING, shared_live_store, shared_store, solve_summary
from dashboard.session.assessment import Assessment
from dashboard.session.inputs import DesignInputs, GainDefinition
from dashboard.session.pins import Pins
from dashboard.session.results import Outcome
from dashboard.views.explore import Explore
from dashboard.views.status import Status
from tests.browser.conftest import address, chromium, open_dashboard, reader  # noqa: F401  (fixtures)
from tests.browser.test_dashboard import drag

OPENING = tig.PRESETS["booted-block-low-mass"]
SLIDER = "Boot stiffness, kN/mm"
POSITIONS = 30

WATCH = """input => {
    const source = Bokeh.documents[0].get_model_by_name("insertion_gain")
    window.moves = []
    window.draws = []
    if (window.watching) return
    window.watching = true
    // a move is told by the value that the slider announces, a draw by the next painted frame
    const moved = () => window.moves.push([performance.now(), input.getAttribute("aria-valuetext")])
    new MutationObserver(moved).observe(input, {attributes: true, attributeFilter: ["aria-valuetext"]})
    source.properties.data.change.connect(() => {
        const level = Array.from(source.data.level)
        const painted = () => window.draws.push([performance.now(), level])
        requestAnimationFrame(() => requestAnimationFrame(painted))
    })
}"""


def picture_of(design, fidelity):
    return solve_summary((design, fidelity), lambda *_: None, lambda: False)


def test_a_frame_on_the_server(benchmark, tell):
    """From a new picture to the message for the browser: figures patched, words changed, serialised."""
    outcome, definition, pins = Outcome(), GainDefinition(), Pins()
    pinned = PinnedSummaries(pins, shared_store(), shared_live_store())
    assessment = Assessment(DesignInputs(), outcome, definition, pins, pinned)
    views = [Status(outcome, None, None), Explore(outcome, definition, pins, assessment)]
    document = Document()
    pn.Column(*views).server_doc(document, location=False)
    summaries = [picture_of(OPENING.replace(boot_stiffness=20e6 + 1e5 * k), MOVING) for k in range(20)]
    events, number = [], 0
    document.on_change(events.append)

    def frame():
        nonlocal number
        events.clear()
        number += 1
        outcome.summary = summaries[number % len(summaries)]
        Protocol().create("PATCH-DOC", events)

    benchmark(frame)
    tell(benchmark.stats["median"])


def opening(is_ahead):
    """Open a page as a session does, without one, and return the processor time of each piece [ms].

    Pieces are what the event loop does without a break; of a page that was made ahead, once somebody asks.
    """
    pieces, events = [], []

    def timed(action):
        began = time.process_time()
        result = action()
        pieces.append(1000 * (time.process_time() - began))
        return result

    def step(steps, end):
        events.clear()
        done = next(steps, end)
        if events:
            Protocol().create("PATCH-DOC", events)
        return done is not end

    document, end = Document(), object()
    with gathering(document) as steps, set_curdoc(document):
        page = timed(app.build)
        timed(lambda: page.server_doc(document, location=False))
        if is_ahead:
            collections.deque(steps, maxlen=0)
            pieces.clear()
        timed(document.to_json)
        document.on_change(events.append)
        while timed(lambda: step(steps, end)):
            pass
    return pieces


def openings(is_ahead, count=5):
    """Print the pieces of several openings in a fresh process, and the time of a paper run [ms]."""
    tig.compile_kernels()
    shared_store().request((OPENING, AT_REST)).future.result()
    found = [opening(is_ahead) for _ in range(count)]
    runs = []
    for _ in range(3):
        began = time.process_time()
        tig.solve(OPENING)
        runs.append(1000 * (time.process_time() - began))
    print(json.dumps([found, min(runs)]))  # noqa: T201


@pytest.mark.parametrize("is_ahead", [False, True], ids=["while somebody waits", "ahead"])
def test_opening(is_ahead, tell, remark):
    """What a page costs the server until all of it is there: the first of a process, and later ones."""
    code = f"from tests.benchmarks.bench_dashboard import openings; openings({is_ahead})"
    output = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True).stdout
    found, run = json.loads(output.splitlines()[-1])
    warm = [min(pieces) for pieces in zip(*found[1:], strict=True)]
    for name, pieces in (("first", found[0]), ("later", warm)):
        which = f"opening, {name} page, made {'ahead' if is_ahead else 'while somebody waits'}"
        tell(sum(pieces) / 1000, which)
        remark(
            f"{which}: {sum(pieces):.0f} ms, {sum(pieces) / run:.2f} paper runs, "
            f"at a stretch {max(pieces):.0f} ms"
        )


@pytest.mark.browser
def test_a_drag(open_dashboard, tell, remark):  # noqa: F811
    """From the slider's value to the painted curve, over a drag of thirty positions."""
    page = open_dashboard()
    handle = page.get_by_role("slider", name=SLIDER)
    latencies, frames = [], 0
    for _ in range(3):
        page.get_by_role("button", name="Back to Table 1").click(force=True)
        page.wait_for_timeout(1500)
        handle.evaluate(WATCH)
        drag(page, SLIDER, POSITIONS, pixels=3, pause=30)
        page.mouse.up()
        page.wait_for_timeout(1500)
        moves, draws = page.evaluate("() => [window.moves, window.draws]")
        live = {
            value: tig.solve(OPENING.replace(boot_stiffness=float(value) * 1e6), "live").insertion_gain
            for _, value in moves
        }
        announced = {value: when for when, value in moves}
        for when, level in draws:
            drawn = [value for value, levels in live.items() if np.abs(levels - level).max() < 1e-6]
            if drawn:
                latencies.append((when - announced[drawn[0]]) / 1000)
                frames += 1
        assert draws, "nothing was drawn"
        last = tig.solve(OPENING.replace(boot_stiffness=float(moves[-1][1]) * 1e6)).insertion_gain
        assert np.abs(np.array(draws[-1][1]) - last).max() < 1e-6, "a drag ends on the paper's run"
    tell(float(np.median(latencies)), "slider to painted curve, median")
    tell(float(np.percentile(latencies, 95)), "slider to painted curve, 95 of 100")
    remark(f"drag: {frames} live frames for {3 * POSITIONS} positions")


def test_first_page(tell):
    """From the command to the first page, kernels in the cache on disk."""
    began = time.perf_counter()
    command = [sys.executable, "-m", "panel", "serve", "dashboard", "--port", "5077"]
    with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as server:
        try:
            while time.perf_counter() - began < 60:
                try:
                    urllib.request.urlopen("http://127.0.0.1:5077/dashboard", timeout=30).read()
                    break
                except OSError:
                    time.sleep(0.02)
            tell(time.perf_counter() - began, "panel serve to first page")
        finally:
            server.terminate()


COMPLYING = tig.Specification([(31.5, 15.0), (63, -4.0), (125, -6.0), (250, -14.0)])

WATCH_STRETCHES = """input => {
    const {data} = [...Bokeh.documents[0]._all_models.values()].find(
        model => model.data?.properties?.feasible !== undefined)
    window.last_move = window.in_place = 0
    const moved = () => { window.last_move = performance.now() }
    new MutationObserver(moved).observe(input, {attributes: true, attributeFilter: ["aria-valuetext"]})
    const placed = () => {
        if (!data.stale) requestAnimationFrame(() => { window.in_place = performance.now() })
    }
    data.properties.stale.change.connect(placed)
    data.properties.feasible.change.connect(placed)
}"""


@pytest.mark.browser
def test_sliders_that_know_the_answer(open_dashboard, tell):  # noqa: F811
    """From the last move of a drag to the stretches of compliance on all sliders."""
    page = open_dashboard()
    page.get_by_role("tab", name="Specification", exact=True).click()
    page.get_by_role("textbox", name="Paste").fill(COMPLYING.to_csv().replace(",", "\t"))
    page.get_by_role("button", name="Take what is pasted").click()
    page.get_by_role("tab", name="Explore", exact=True).click()
    page.wait_for_timeout(2000)
    handle = page.get_by_role("slider", name=SLIDER)
    handle.evaluate(WATCH_STRETCHES)
    waits = []
    for _ in range(20):
        drag(page, SLIDER, 10, pixels=2, pause=30)
        # stretches of the moves before may come after the last one; those that come last are its own
        page.wait_for_timeout(1500)
        waits.append(page.evaluate("() => window.in_place - window.last_move") / 1000)
        page.mouse.up()
        page.get_by_role("button", name="Undo (Ctrl+Z)").click()
        page.wait_for_timeout(1500)
    assert min(waits) > 0
    tell(float(np.median(waits)), "last move to stretches on all sliders, median")
    tell(min(waits), "last move to stretches on all sliders, least")
