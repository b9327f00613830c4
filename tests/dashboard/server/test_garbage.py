"""Garbage is looked for when nobody works, and what is left is not looked through again."""

import asyncio
import gc
import weakref

import pytest
from bokeh.document import Document
from panel.io import document as panel_document

from dashboard.compute import pacing
from dashboard.compute.pacing import Pace
from dashboard.server import garbage
from dashboard.server.garbage import Sweeper, sweep
from tests.waiting import until_at_rest


class Ring:
    """Refers to itself: only a look through all objects frees it."""

    def __init__(self):
        self.itself = self


@pytest.fixture(autouse=True)
def thawed():
    """Have nothing set aside after the test, as before."""
    yield
    gc.unfreeze()


@pytest.fixture
def swept(monkeypatch):
    times = []
    monkeypatch.setattr(garbage, "sweep", lambda: times.append(asyncio.get_running_loop().time()))
    return times


def test_what_was_set_aside_is_freed_at_the_next_sweep():
    ring = Ring()
    sweep()
    gone = weakref.ref(ring)
    del ring
    gc.collect()
    assert gone() is not None, "it is set aside: Python's own looks do not go through it"
    sweep()
    assert gone() is None
    assert gc.get_freeze_count() > 10_000


def test_it_waits_until_nobody_works_and_is_done_once_for_all_who_came_and_went(swept, monkeypatch):
    monkeypatch.setattr(pacing, "IDLE", 0.05)

    async def run():
        pace, document = Pace(), Document()
        sweeper = Sweeper(pace)
        for _ in range(20):
            pace.hear(document)
            sweeper.note_gone()
            await asyncio.sleep(0.005)
            assert swept == []
        last = asyncio.get_running_loop().time()
        await sweeper._task
        assert len(swept) == 1
        assert swept[0] - last >= 0.04
        sweeper.note_gone()
        await sweeper._task
        assert len(swept) == 2

    asyncio.run(run())


def test_a_page_that_has_come_is_set_aside_and_nothing_is_looked_through(swept, monkeypatch):
    monkeypatch.setattr(pacing, "IDLE", 0.0)

    async def run():
        sweeper, page = Sweeper(Pace()), Ring()
        sweeper.note_come()
        await sweeper._task
        gone = weakref.ref(page)
        del page
        gc.collect()
        assert gone() is not None
        assert swept == []
        sweeper.note_come()
        sweeper.note_gone()
        await sweeper._task
        assert len(swept) == 1, "once is enough for both"
        sweeper.note_come()
        await sweeper._task
        assert len(swept) == 1

    asyncio.run(run())


def test_it_is_not_put_off_for_ever(swept, monkeypatch):
    monkeypatch.setattr(garbage, "LATEST", 0.05)

    async def run():
        pace, document = Pace(), Document()
        sweeper = Sweeper(pace)
        sweeper.note_gone()
        while not swept:
            pace.hear(document)
            await asyncio.sleep(0.001)

    async def bounded():
        async with asyncio.timeout(60):
            await run()

    asyncio.run(bounded())


def test_a_session_that_ends_has_it_done_at_leisure(swept, monkeypatch):
    monkeypatch.setattr(panel_document, "_garbage_collect", panel_document._garbage_collect)

    async def run():
        sweeper = Sweeper(Pace())
        sweeper.install()
        panel_document._garbage_collect()
        await until_at_rest()
        assert len(swept) == 1

    asyncio.run(run())
