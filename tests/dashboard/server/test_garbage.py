"""Garbage is looked for when nobody works, and what is left is not looked through again."""

import asyncio
import gc
import platform
import subprocess
import sys
import weakref
from types import SimpleNamespace

import pytest
from bokeh.document import Document
from panel.io import document as panel_document

from dashboard.compute import pacing
from dashboard.compute.pacing import Pace
from dashboard.server import garbage
from dashboard.server.garbage import Sweeper, sweep
from tests.waiting import WAIT, until_at_rest


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


@pytest.fixture
def act(monkeypatch):
    """Return a function that has notes taken, and then nobody work; what was swept by then is returned."""
    times = []
    monkeypatch.setattr(garbage, "sweep", lambda: times.append("swept"))

    def act(sequence):
        async def run():
            counts, nobody_works = [], asyncio.Event()
            sweeper = Sweeper(SimpleNamespace(idle=nobody_works.wait))
            for notes in sequence:
                nobody_works.clear()
                for note in notes:
                    getattr(sweeper, note)()
                    await asyncio.sleep(0)
                before = len(times)
                nobody_works.set()
                await sweeper._task
                counts.append((before, len(times)))
            return counts

        return asyncio.run(run())

    return act


def test_it_waits_until_nobody_works_and_is_done_once_for_all_who_came_and_went(act):
    assert act([["note_gone"] * 20, ["note_gone"]]) == [(0, 1), (1, 2)]
    page = Ring()
    assert act([["note_come"]]) == [(2, 2)]
    gone = weakref.ref(page)
    del page
    gc.collect()
    assert gone() is not None, "a page that has come is set aside, and nothing is looked through"
    assert act([["note_come", "note_gone"], ["note_come"]]) == [(2, 3), (3, 3)]


def test_nobody_works_once_all_pages_were_silent_for_a_while(swept, monkeypatch):
    monkeypatch.setattr(pacing, "IDLE", 0.05)

    async def run():
        pace, document = Pace(), Document()
        sweeper = Sweeper(pace)
        pace.hear(document)
        last = asyncio.get_running_loop().time()
        sweeper.note_gone()
        await sweeper._task
        return last

    last = asyncio.run(run())
    assert len(swept) == 1
    assert swept[0] - last >= 0.04


def test_it_is_not_put_off_for_ever(swept, monkeypatch):
    monkeypatch.setattr(garbage, "LATEST", 0.05)

    async def run():
        sweeper = Sweeper(SimpleNamespace(idle=asyncio.Event().wait))
        sweeper.note_gone()
        async with asyncio.timeout(WAIT):
            await sweeper._task

    asyncio.run(run())
    assert len(swept) == 1


def test_a_session_that_ends_has_it_done_at_leisure(swept, monkeypatch):
    monkeypatch.setattr(panel_document, "_garbage_collect", panel_document._garbage_collect)

    async def run():
        sweeper = Sweeper(Pace())
        sweeper.install()
        panel_document._garbage_collect()
        await until_at_rest()
        assert len(swept) == 1

    asyncio.run(run())


ON_GLIBC = pytest.mark.skipif(
    platform.libc_ver()[0] != "glibc", reason="only glibc gives memory back when asked"
)

FREED = """
from pathlib import Path
import numpy as np
from dashboard.server.garbage import sweep

def resident():
    return int(Path("/proc/self/statm").read_text().split()[1]) * 4096

arrays = [np.ones(8000) for _ in range(2000)]
newest = arrays[-1]  # stands at the end of the heap, which could shrink there
arrays.clear()
before = resident()
sweep()
print(before - resident())
"""
"""Prints how much memory a sweep gives back after 128 MB have been freed."""

HEAPS = """
import ctypes, sys, threading
from dashboard.server.garbage import share_heap

if sys.argv[1] == "shared":
    share_heap()
begun = threading.Barrier(5)
library = ctypes.CDLL(None)

def act():
    library.malloc(100)
    begun.wait()

threads = [threading.Thread(target=act) for _ in range(4)]
for thread in threads:
    thread.start()
begun.wait()
library.fdopen.restype = ctypes.c_void_p
output = ctypes.c_void_p(library.fdopen(1, b"w"))
library.malloc_info(0, output)
library.fflush(output)
"""
"""Has four threads allocate, and prints what the C library says of its heaps."""


def printed_by(script, *arguments):
    command = [sys.executable, "-c", script, *arguments]
    return subprocess.run(command, capture_output=True, text=True, check=True, timeout=WAIT).stdout


@ON_GLIBC
def test_what_is_freed_goes_back_to_the_system():
    assert int(printed_by(FREED)) > 100e6


@ON_GLIBC
def test_threads_share_one_heap():
    assert printed_by(HEAPS, "apart").count("<heap nr=") > 1
    assert printed_by(HEAPS, "shared").count("<heap nr=") == 1
