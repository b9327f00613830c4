"""A workshop: fairness, memory, nonsense, a crash; raw WebSocket clients and a browser, on loopback.

Run with ``python -m pip install -e ".[dev]"`` and ``pytest -n 0 tests/benchmarks/bench_server.py``. At full
size it takes half an hour; each part is ended after ten minutes at most, but for the nonsense. Figures are
said as they come, and once more as a table at the end. ``TRACKIG_BENCH_SCALE=0.1`` takes a tenth of the
sessions and messages.
"""

import asyncio
import itertools
import os
import signal
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest

import trackig_core as tig
from dashboard.compute import pacing
from dashboard.server import sessions
from tests.browser.conftest import chromium, wait_until_solved  # noqa: F401  (a fixture)
from tests.dashboard.server.conftest import serving
from tests.dashboard.server.test_hostile import disturb
from tests.visitor import Visitor, told

SCALE = float(os.environ.get("TRACKIG_BENCH_SCALE", "1"))

SECONDS = 20 * min(1.0, 2 * SCALE)
"""Time for which sessions move their sliders [s]."""

SETTLED = 3
"""Time after which pages that have their pictures are there whole [s]."""

PATIENCE = 120
"""Time that a picture may take [s]."""


LIMIT = 600
"""Time after which a part is ended [s]."""

NONSENSE_LIMIT = 1800
"""Time after which the nonsense is ended [s]; its sender is cut off and comes back some hundred times."""

CHURN_TIME = 420
"""Time after which no more sessions come and go [s]."""


SEEDS = itertools.count()
"""A new one for each drag: one that began where the last had ended would move nothing, and get no picture."""


def stiffnesses():
    """Yield boot stiffnesses [kN/mm], each another than the one before: there is no picture of no move."""
    chance, last = np.random.default_rng(next(SEEDS)), None
    while True:
        value = round(chance.uniform(10, 40), 2)
        if value != last:
            yield value
        last = value


def sized(count):
    return max(1, round(count * SCALE))


def run(coroutine, limit=LIMIT):
    """Return what a coroutine returns; this thread's event loop is the browser's."""
    with ThreadPoolExecutor(1) as thread:
        return thread.submit(asyncio.run, asyncio.wait_for(coroutine, limit)).result()


def memory(served):
    """Return the resident memory of a server [MB]."""
    pages = int(Path(f"/proc/{served.process.pid}/statm").read_text().split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE") / 1e6


@pytest.fixture(scope="module")
def served(tmp_path_factory):
    with serving(tmp_path_factory.mktemp("bench"), "--most-sessions", "400") as running:
        yield running


async def opened(served, count):
    """Return so many visitors, who came one after the other."""
    return [await Visitor(served.host + "/dashboard").open() for _ in range(count)]


async def drag_politely(visitor, waits):
    """Move, and move again when the picture came."""
    values, end = stiffnesses(), time.monotonic() + SECONDS
    while time.monotonic() < end:
        await visitor.move(next(values))
        waits.append(await visitor.picture(PATIENCE))
        await visitor.answer(PATIENCE)


async def drag_whatever_comes(visitor, waits):
    """Move ten times a second; a wait is from a picture, or the first move after it, to the next picture."""

    async def move():
        values, end = stiffnesses(), time.monotonic() + SECONDS
        while time.monotonic() < end:
            await visitor.move(next(values))
            await asyncio.sleep(0.1)

    moving = asyncio.create_task(move())
    while not moving.done():
        waits.append(await visitor.picture(PATIENCE))
    await moving


async def load(served, polite, flooding):
    """Return the waits of polite and of flooding sessions [s], and the processor time of a picture [s]."""
    visitors = await opened(served, polite + flooding)
    # what is below the picture is still put on the page
    await asyncio.sleep(SETTLED)
    waits = [[] for _ in visitors]
    kinds = [drag_politely] * polite + [drag_whatever_comes] * flooding
    before = processor(served)
    await asyncio.gather(*(kind(*each) for kind, *each in zip(kinds, visitors, waits, strict=True)))
    cost = (processor(served) - before) / max(1, sum(map(len, waits)))
    for visitor in visitors:
        visitor.close()
    return waits[:polite], waits[polite:], cost


def summary(waits):
    everybody = np.concatenate([each or [np.inf] for each in waits])
    median, late = np.percentile(everybody, [50, 95], method="inverted_cdf")
    without = sum(not each for each in waits)
    return f"median {1000 * median:.0f} ms, p95 {1000 * late:.0f} ms, {without} without a picture"


@pytest.mark.parametrize("count", [1, 10, 30])
def test_polite_sessions(served, row, count):
    polite, _, cost = run(load(served, sized(count), 0))
    row(
        f"{len(polite)} drag politely",
        f"{summary(polite)}; {1000 * cost:.0f} ms of a processor a picture, {paper_run():.2f} s a paper run",
        "p95 below 1 s, nobody without" if count == 30 else "",
    )


def processor(served):
    """Return the time for which a server has had a processor [s]."""
    fields = Path(f"/proc/{served.process.pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def paper_run():
    """Return the processor time of one paper run, the least of three [s]."""
    spent = []
    for _ in range(3):
        began = time.process_time()
        tig.solve(tig.PRESETS["booted-block-low-mass"])
        spent.append(time.process_time() - began)
    return min(spent)


async def longest_silence(visitor, until):
    """Return the longest that a visitor's questions went without an answer until something is done [s]."""
    longest = 0.0
    while not until.done():
        began = time.perf_counter()
        await visitor.send("SERVER-INFO-REQ", {})
        await visitor.receive("SERVER-INFO-REPLY")
        longest = max(longest, time.perf_counter() - began)
        await asyncio.sleep(0.005)
    return longest


REFILLED = 4
"""Time in which a page that was taken is made up for [s]."""


def test_opening(served, row):
    async def come():
        beside = await Visitor(served.host + "/dashboard").open()
        await asyncio.sleep(sessions.ahead() * REFILLED)
        spent, later, silences = [], [], []
        for _ in range(sized(10)):
            before = processor(served)
            alone = await Visitor(served.host + "/dashboard").open()
            # what follows the picture, but not what is made ahead once nobody works
            await asyncio.sleep(pacing.IDLE / 2)
            spent.append(processor(served) - before)
            await asyncio.sleep(REFILLED)
            later.append(processor(served) - before - spent[-1])
            alone.close()
            await asyncio.sleep(REFILLED)
            coming = asyncio.create_task(Visitor(served.host + "/dashboard").open())
            silences.append(await longest_silence(beside, coming))
            await asyncio.sleep(REFILLED)
            coming.result().close()
        beside.close()
        return min(spent), min(later), float(np.median(silences)), min(silences)

    cost, later, usual, least = run(come())
    run_of_the_paper = paper_run()
    row(
        "opening a page that is ready",
        f"{cost:.2f} s of a processor, {cost / run_of_the_paper:.1f} paper runs of {run_of_the_paper:.2f} s; "
        f"{later:.2f} s to make the next, while nobody works",
        "1.3 paper runs",
    )
    row(
        "longest that such an opening holds another session up",
        f"{1000 * usual:.0f} ms in the median, {1000 * least:.0f} ms at best",
        "100 ms",
    )


def test_opening_when_no_page_is_ready(served, row):
    async def come():
        beside = await Visitor(served.host + "/dashboard").open()
        done = asyncio.Event()

        async def work():
            """Be heard, so that nothing is made ahead."""
            while not done.is_set():
                await beside.send("SERVER-INFO-REQ", {})
                await beside.receive("SERVER-INFO-REPLY")
                await asyncio.sleep(0.2)

        working = asyncio.create_task(work())
        for _ in range(sessions.ahead()):
            (await Visitor(served.host + "/dashboard").open()).close()
        spent = []
        for _ in range(sized(5)):
            await asyncio.sleep(1)
            before = processor(served)
            visitor = await Visitor(served.host + "/dashboard").open()
            await asyncio.sleep(1)
            spent.append(processor(served) - before)
            visitor.close()
        done.set()
        await working
        silences = []
        for _ in range(sized(5)):
            coming = asyncio.create_task(Visitor(served.host + "/dashboard").open())
            silences.append(await longest_silence(beside, coming))
            coming.result().close()
        beside.close()
        return min(spent), float(np.median(silences))

    cost, silence = run(come())
    run_of_the_paper = paper_run()
    row(
        "opening when none is ready",
        f"{cost:.2f} s of a processor, {cost / run_of_the_paper:.1f} paper runs; "
        f"holds another session up for {1000 * silence:.0f} ms in the median",
    )


LIGHT = "?pad_loss_factor=0.02&boot_loss_factor=0.02"
"""A track whose live runs take the longest."""


@pytest.mark.parametrize("query", ["", LIGHT])
def test_frames_beside_another_session(served, row, query):
    async def drag():
        visitor = await Visitor(served.host + "/dashboard").open()
        other = await Visitor(served.host + "/dashboard" + query).open()
        shares = []
        for _ in range(3):
            alone, beside, others = [], [], []
            await drag_politely(visitor, alone)
            await asyncio.gather(drag_politely(visitor, beside), drag_politely(other, others))
            shares.append(len(beside) / len(alone))
        visitor.close()
        other.close()
        return shares

    what = "a lightly damped track" if query else "an ordinary track"
    shares = ", ".join(f"{share:.0%}" for share in run(drag()))
    row(f"frames kept beside a session that drags {what}", shares, "two thirds")


DEMAND = tig.Specification([(63.0, -3.0), (80.0, -6.0)])
"""What a session demands that asks which track is the one."""


@pytest.mark.parametrize("button", ["Draw the map", "Find designs"])
def test_frames_beside_a_long_question(served, row, button):
    async def ask(visitor, done):
        """Ask anew, of another track each time, as long as the other one drags."""
        values = stiffnesses()
        while not done.done():
            await visitor.move(next(values))
            await visitor.answer(PATIENCE)
            await visitor.click(button)
            await asyncio.sleep(3)

    async def drag():
        visitor = await Visitor(served.host + "/dashboard").open()
        other = await Visitor(served.host + "/dashboard?tab=decide").open(drawn=False)
        study = tig.Study(tig.PRESETS["booted-block-low-mass"], specification=DEMAND)
        await other.patch(
            told(other.component("kept"), {"kind": "restore", "data": study.to_toml(), "typed": ""})
        )
        shares = []
        for _ in range(3):
            alone, beside = [], []
            await drag_politely(visitor, alone)
            dragging = asyncio.create_task(drag_politely(visitor, beside))
            await ask(other, dragging)
            await dragging
            shares.append(len(beside) / len(alone))
        visitor.close()
        other.close()
        return shares

    shares = ", ".join(f"{share:.0%}" for share in run(drag()))
    row(f"frames kept beside “{button}”", shares, "two thirds")


def test_flooding_sessions_and_a_polite_one_beside_them(served, row):
    polite, flooding, _ = run(load(served, 1, sized(10)))
    row(f"{len(flooding)} flood", summary(flooding), "p95 below 1.5 s")
    row("a polite one beside them", summary(polite), "p95 below 2 s")


def test_thirty_open_the_link_at_once(served, row):
    async def come():
        async def one():
            began = time.monotonic()
            visitor = await Visitor(served.host + "/dashboard").open()
            visitor.close()
            return time.monotonic() - began

        return await asyncio.gather(*(one() for _ in range(sized(30))))

    waits = run(come())
    row(f"{len(waits)} open the link at once", f"median {np.median(waits):.1f} s, last {max(waits):.1f} s")


def test_memory_comes_back(served, row):
    """What the first thirty leave is what allocators keep of their peak, and the next thirty use again."""

    async def come_and_go():
        levels = [memory(served)]
        for _ in range(2):
            visitors = await opened(served, sized(30))
            levels.append(memory(served))
            for visitor in visitors:
                visitor.close()
            await asyncio.sleep(60)
            levels.append(memory(served))
        return levels

    levels = run(come_and_go())
    for which, (before, most, after) in (("the first", levels[:3]), ("the next", levels[2:])):
        row(
            f"memory before, with and a minute after {which} {sized(30)} sessions",
            f"{before:.0f}, {most:.0f}, {after:.0f} MB",
            "after: at most 15 % more than before",
        )
    assert levels[4] < 1.15 * levels[2]


def test_churn_leaves_no_slope(served, row):
    async def churn():
        seen, end = [], time.monotonic() + CHURN_TIME
        for number in range(sized(300)):
            if time.monotonic() > end:
                break
            visitor = await Visitor(served.host + "/dashboard").open(pull=number % 3 > 0)
            visitor.close()
            seen.append(memory(served))
        await asyncio.sleep(60)
        return seen, memory(served)

    seen, after = run(churn())
    half = len(seen) // 2
    slope = np.polyfit(np.arange(half, len(seen)), seen[half:], 1)[0] if half > 1 else 0.0
    row(
        f"memory while {len(seen)} sessions come and go in turn",
        f"{slope:+.2f} MB a session in the second half, {after:.0f} MB after",
        "no slope",
    )


def test_nonsense(served, row):
    count, before = sized(10_000), memory(served)
    said = len(served.log.read_text().splitlines())
    connections, answers = run(disturb(served.host + "/dashboard", 0, count), limit=NONSENSE_LIMIT)
    # sessions that were cut off are kept for a while, since a browser may come back
    time.sleep(60)
    assert all(each["traceback"] is None for each in answers)
    log = served.log.read_text()
    assert "Traceback" not in log
    row(
        f"{count} messages of nonsense",
        f"{connections} connections, {len(answers)} messages refused, no traceback, "
        f"{len(log.splitlines()) - said} lines in the log, memory {before:.0f} to {memory(served):.0f} MB",
        "no traceback, no growth",
    )


@pytest.mark.browser
def test_a_page_in_a_browser(served, row, chromium):  # noqa: F811
    page = chromium.new_page()
    began = time.monotonic()
    page.goto(served.host + "/dashboard")
    wait_until_solved(page)
    row("a browser opens the page", f"{time.monotonic() - began:.1f} s")
    page.close()


def test_thirty_come_back_after_a_crash(tmp_path, row):
    async def crash(running):
        visitors = await opened(running, sized(30))
        for process in running.children():
            os.kill(process, signal.SIGKILL)
        for visitor in visitors:
            visitor.close()
        began = time.monotonic()
        back = await asyncio.gather(*(Visitor(running.host + "/dashboard").open() for _ in visitors))
        for visitor in back:
            visitor.close()
        return time.monotonic() - began

    with serving(tmp_path, "--processes", "2") as running:
        row(f"{sized(30)} pages come back after kill -9 of two processes", f"{run(crash(running)):.1f} s")
