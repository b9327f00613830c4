"""Threads that sessions share: each in turn, none takes all, and what is urgent waits for no long job."""

import threading
from concurrent.futures import CancelledError

import pytest

from dashboard.compute.fair import FairExecutor
from tests.waiting import WAIT


class Jobs:
    """Jobs that each wait to be let go, and what was begun, in order."""

    def __init__(self, executor):
        self.executor = executor
        self.begun, self._count = [], threading.Semaphore(0)
        self._gates = {}

    def add(self, name, **how):
        self._gates[name] = threading.Event()
        return self.executor.submit(self._do, name, **how)

    def _do(self, name):
        self.begun.append(name)
        self._count.release()
        assert self._gates[name].wait(WAIT)
        return name

    def wait(self, count):
        for _ in range(count):
            assert self._count.acquire(timeout=WAIT)

    def end(self, *names):
        for name in names or self._gates:
            self._gates[name].set()


@pytest.fixture
def make_jobs():
    made = []

    def make(workers, spare=0):
        made.append(Jobs(FairExecutor(workers, spare=spare)))
        return made[-1]

    yield make
    for jobs in made:
        jobs.end()
        jobs.executor.shutdown(cancel_futures=True)


def test_sessions_are_served_in_turn_however_much_one_asks_for(make_jobs):
    jobs = make_jobs(workers=1)
    jobs.add("first", owner="other")
    jobs.wait(1)
    futures = [jobs.add(f"greedy {number}", owner="greedy") for number in range(4)]
    futures += [jobs.add(f"modest {number}", owner="modest") for number in range(2)]
    jobs.end()
    assert {each.result(WAIT) for each in futures} == set(jobs.begun) - {"first"}
    assert jobs.begun == ["first", "greedy 0", "modest 0", "greedy 1", "modest 1", "greedy 2", "greedy 3"]


def test_who_has_less_under_way_comes_first(make_jobs):
    jobs = make_jobs(workers=2)
    jobs.add("long", owner="greedy")
    jobs.add("short", owner="other")
    jobs.wait(2)
    jobs.add("another", owner="greedy")
    jobs.add("modest", owner="modest")
    jobs.end("short")
    jobs.wait(1)
    assert jobs.begun[-1] == "modest"


def test_what_is_urgent_waits_for_no_other_job(make_jobs):
    jobs = make_jobs(workers=3, spare=1)
    for number in range(5):
        jobs.add(f"long {number}", owner=number)
    jobs.wait(2)
    assert jobs.executor.is_crowded()
    jobs.add("quick", urgent=True)
    jobs.wait(1)
    assert sorted(jobs.begun) == ["long 0", "long 1", "quick"]
    # a thread that was kept from long jobs takes one as soon as another ends
    jobs.end("quick", "long 0")
    jobs.wait(1)
    assert jobs.begun[-1] == "long 2"


def test_what_nobody_waits_for_is_left_out(make_jobs):
    jobs = make_jobs(workers=1)
    jobs.add("first")
    jobs.wait(1)
    left = jobs.add("left")
    assert jobs.executor.is_crowded()
    assert left.cancel()
    assert not jobs.executor.is_crowded()
    last = jobs.add("last")
    jobs.end()
    assert last.result(WAIT) == "last"
    assert jobs.begun == ["first", "last"]


def test_what_a_job_raises_is_its_result_and_others_follow(make_jobs):
    jobs = make_jobs(workers=1)
    with pytest.raises(ZeroDivisionError):
        jobs.executor.submit(lambda: 1 / 0).result(WAIT)
    assert jobs.executor.submit(int, "7").result(WAIT) == 7


def test_nothing_begins_after_the_end(make_jobs):
    jobs = make_jobs(workers=1)
    jobs.add("first")
    jobs.wait(1)
    waiting = jobs.add("waiting")
    jobs.executor.shutdown(wait=False, cancel_futures=True)
    jobs.end()
    with pytest.raises(CancelledError):
        waiting.result(WAIT)
    with pytest.raises(RuntimeError):
        jobs.add("late")
