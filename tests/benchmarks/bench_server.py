"""A workshop: fairness, memory, nonsense, a crash; raw WebSocket clients and a browser, on loopback.

Run with ``python -m pip install -e ".[dev]"`` and ``pytest -n 0 tests/benchmarks/bench_server.py``; at full
size it takes half an hour. ``TRACKIG_BENCH_SCALE=0.1`` takes a tenth of the sessions and messages.
"""

import asyncio
import os
import signal
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest

import trackig_core as tig
from tests.browser.conftest import chromium, wait_until_solved  # noqa: F401  (a fixture)
from tests.dashboard.server.conftest import serving
from tests.dashboard.server.test_hostile import disturb
from tests.visitor import Visitor

SCALE = float(os.environ.get("TRACKIG_BENCH_SCALE", "1"))

SECONDS = 20 * min(1.0, 2 * SCALE)
"""Time for which sessions move their sliders [s]."""

PATIENCE = 120
"""Time that a picture may take [s]."""


def sized(count):
    return max(1, round(count * SCALE))


def run(coroutine):
    """Return what a coroutine returns; this thread's event loop is the browser's."""
    with ThreadPoolExecutor(1) as thread:
        return thread.submit(asyncio.run, coroutine).result()


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
    chance, end = np.random.default_rng(id(visitor)), time.monotonic() + SECONDS
    while time.monotonic() < end:
        await visitor.move(round(chance.uniform(10, 40), 2))
        waits.append(await visitor.picture(PATIENCE))
        await visitor.answer(PATIENCE)


async def drag_whatever_comes(visitor, waits):
    """Move ten times a second; a wait is from a picture, or the first move after it, to the next picture."""

    async def move():
        chance, end = np.random.default_rng(id(visitor)), time.monotonic() + SECONDS
        while time.monotonic() < end:
            await visitor.move(round(chance.uniform(10, 40), 2))
            await asyncio.sleep(0.1)

    moving = asyncio.create_task(move())
    while not moving.done():
        waits.append(await visitor.picture(PATIENCE))
    await moving


async def load(served, polite, flooding, drag=drag_politely, flood=drag_whatever_comes):
    visitors = await opened(served, polite + flooding)
    waits = [[] for _ in visitors]
    kinds = [drag] * polite + [flood] * flooding
    await asyncio.gather(*(kind(*each) for kind, *each in zip(kinds, visitors, waits, strict=True)))
    for visitor in visitors:
        visitor.close()
    return waits[:polite], waits[polite:]


def summary(waits):
    everybody = np.concatenate([each or [np.inf] for each in waits])
    median, late = np.percentile(everybody, [50, 95], method="inverted_cdf")
    without = sum(not each for each in waits)
    return f"median {1000 * median:.0f} ms, p95 {1000 * late:.0f} ms, {without} without a picture"


@pytest.mark.parametrize("count", [1, 10, 30])
def test_polite_sessions(served, remark, count):
    polite, _ = run(load(served, sized(count), 0))
    remark(f"{len(polite)} polite sessions: {summary(polite)}")


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


def test_opening(served, remark):
    async def come():
        beside = await Visitor(served.host + "/dashboard").open()
        await asyncio.sleep(3)
        spent, silences = [], []
        for _ in range(sized(10)):
            before = processor(served)
            coming = asyncio.create_task(Visitor(served.host + "/dashboard").open())
            silences.append(await longest_silence(beside, coming))
            await asyncio.sleep(2)
            spent.append(processor(served) - before)
            coming.result().close()
            await asyncio.sleep(1)
        beside.close()
        return min(spent), float(np.median(silences)), min(silences)

    cost, usual, least = run(come())
    remark(
        f"opening costs {cost / paper_run():.1f} paper runs of processor time; meanwhile another session "
        f"waits {1000 * usual:.0f} ms at most in the median, {1000 * least:.0f} ms at best"
    )


LIGHT = "?pad_loss_factor=0.02&boot_loss_factor=0.02"
"""A track whose live runs take the longest."""


@pytest.mark.parametrize("query", ["", LIGHT])
def test_frames_beside_another_session(served, remark, query):
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
    remark(f"beside a session that drags {what}, another keeps {shares} of its frames")


def test_flooding_sessions_and_a_polite_one_beside_them(served, remark):
    polite, flooding = run(load(served, 1, sized(10)))
    remark(f"{len(flooding)} flooding sessions: {summary(flooding)}; a polite one beside: {summary(polite)}")


def test_thirty_open_the_link_at_once(served, remark):
    async def come():
        async def one():
            began = time.monotonic()
            visitor = await Visitor(served.host + "/dashboard").open()
            visitor.close()
            return time.monotonic() - began

        return await asyncio.gather(*(one() for _ in range(sized(30))))

    waits = run(come())
    remark(f"{len(waits)} open at once: median {np.median(waits):.1f} s, last {max(waits):.1f} s")


def test_memory_comes_back(served, remark):
    async def come_and_go():
        (first,) = await opened(served, 1)
        first.close()
        await asyncio.sleep(60)
        before = memory(served)
        visitors = await opened(served, sized(30))
        most = memory(served)
        for visitor in visitors:
            visitor.close()
        await asyncio.sleep(60)
        return before, most, memory(served)

    before, most, after = run(come_and_go())
    remark(f"memory: {before:.0f} MB, {most:.0f} MB with {sized(30)} sessions, {after:.0f} MB a minute later")
    assert after < 1.15 * before


def test_churn_leaves_no_slope(served, remark):
    async def churn():
        seen = []
        for number in range(sized(300)):
            visitor = await Visitor(served.host + "/dashboard").open(pull=number % 3 > 0)
            visitor.close()
            seen.append(memory(served))
        await asyncio.sleep(60)
        return seen, memory(served)

    seen, after = run(churn())
    half = len(seen) // 2
    slope = np.polyfit(np.arange(half, len(seen)), seen[half:], 1)[0] if half > 1 else 0.0
    remark(f"churn of {len(seen)}: {slope:+.2f} MB a session in the second half, {after:.0f} MB after")


def test_nonsense(served, remark):
    count, before = sized(10_000), memory(served)
    said = len(served.log.read_text().splitlines())
    connections, answers = run(disturb(served.host + "/dashboard", 0, count))
    assert all(each["traceback"] is None for each in answers)
    log = served.log.read_text()
    assert "Traceback" not in log
    remark(
        f"{count} messages of nonsense: {connections} connections, {len(answers)} messages refused, "
        f"{len(log.splitlines()) - said} lines in the log; "
        f"memory {before:.0f} to {memory(served):.0f} MB"
    )


@pytest.mark.browser
def test_a_page_in_a_browser(served, remark, chromium):  # noqa: F811
    page = chromium.new_page()
    began = time.monotonic()
    page.goto(served.host + "/dashboard")
    wait_until_solved(page)
    remark(f"a browser opens the page in {time.monotonic() - began:.1f} s")
    page.close()


def test_thirty_come_back_after_a_crash(tmp_path, remark):
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
        remark(f"{sized(30)} pages come back after kill -9 in {run(crash(running)):.1f} s")
