"""Parts of pages that open come one at a time, and after those who work."""

import asyncio
import gc
from contextvars import ContextVar

import pytest
from bokeh.document import Document

from dashboard.compute import pacing
from dashboard.compute.pacing import Pace

TURNS = 12
"""Turns of the event loop that a message of a page takes."""


def test_a_message_waits_for_few_parts_of_pages_that_open():
    done = []

    async def message():
        """Take several turns, as a message of three frames does, and return how many parts came between."""
        before = len(done)
        pace.hear(open_page)
        for _ in range(TURNS):
            await asyncio.sleep(0)
        return len(done) - before

    async def open_pages():
        for page in range(5):
            for part in range(10):
                pace.begin(lambda each=(page, part): done.append(each))
        between = []
        while len(done) < 50:
            between.append(await message())
            await asyncio.sleep(pacing.QUIET)
        return between

    pace, open_page = Pace(), Document()
    between = asyncio.run(asyncio.wait_for(open_pages(), 30))
    assert max(between) <= 1
    assert len(done) == 50


def test_parts_do_not_wait_forever_for_those_who_work():
    async def work_on():
        while not done:
            pace.hear(open_page)
            await asyncio.sleep(0)

    async def both():
        pace.begin(lambda: done.append(True))
        await work_on()

    pace, open_page, done = Pace(), Document(), []
    asyncio.run(asyncio.wait_for(both(), 30))
    assert done == [True]


def test_pages_that_have_begun_come_before_new_ones():
    async def come():
        new = [asyncio.create_task(newcomer(number)) for number in range(2)]
        await asyncio.sleep(0)
        pace.begin(lambda: order.append("part"))
        await asyncio.gather(*new)

    async def newcomer(number):
        await pace.turn()
        order.append(number)

    pace, order = Pace(), []
    asyncio.run(asyncio.wait_for(come(), 30))
    assert order == ["part", 0, 1]


def test_what_opening_pages_say_holds_up_no_part(monkeypatch):
    monkeypatch.setattr(pacing, "PATIENCE", 1e6)
    pace, opening = Pace(), Document()

    async def come():
        pace.enter(opening)
        pace.hear(opening)
        await pace.turn()

    asyncio.run(asyncio.wait_for(come(), 30))
    pace.leave(opening)
    pace.hear(opening)
    with pytest.raises(TimeoutError):
        asyncio.run(asyncio.wait_for(hear_and_come(pace, opening), 0.2))


async def hear_and_come(pace, document):
    async def work():
        while True:
            pace.hear(document)
            await asyncio.sleep(0)

    working = asyncio.create_task(work())
    try:
        await pace.turn()
    finally:
        working.cancel()


def test_each_part_begins_for_the_page_that_asked():
    async def ask(name):
        page.set(name)
        pace.begin(lambda: begun.append((name, page.get())))

    async def come():
        await asyncio.gather(*(asyncio.create_task(ask(name)) for name in "abc"))
        await pace.turn()

    pace, begun, page = Pace(), [], ContextVar("page")
    asyncio.run(asyncio.wait_for(come(), 30))
    assert begun == [(name, name) for name in "abc"]


def test_a_part_that_cannot_begin_holds_up_nothing(caplog):
    def broken():
        raise ValueError("no room")

    async def come():
        pace.begin(broken)
        await pace.turn()

    pace = Pace()
    asyncio.run(asyncio.wait_for(come(), 30))
    assert "no room" in caplog.text


def test_a_page_that_has_gone_is_not_kept():
    pace, page = Pace(), Document()
    pace.enter(page)
    del page
    gc.collect()
    assert not len(pace._opening)
