"""One solve for all who wait, none for nobody."""

import threading
from concurrent.futures import CancelledError

import pytest

from tests.waiting import WAIT


class Gate:
    """A solver that waits to be let through, and notes what it was asked."""

    def __init__(self):
        self.open = threading.Event()
        self.begun = threading.Semaphore(0)
        self.asked = []
        self.gave_up = threading.Event()

    def solve(self, key, progress, cancelled):
        self.asked.append(key)
        progress(0.5)
        self.begun.release()
        while not self.open.wait(0.005):
            if cancelled():
                self.gave_up.set()
                raise InterruptedError
        return f"value of {key}"


@pytest.fixture
def gate():
    gate = Gate()
    yield gate
    gate.open.set()


def test_those_who_ask_for_the_same_share_one_solve(make_store, gate):
    store = make_store(gate.solve, workers=4)
    jobs = [store.request("a") for _ in range(8)]
    gate.open.set()
    assert {job.future.result(WAIT) for job in jobs} == {"value of a"}
    assert gate.asked == ["a"]


def test_many_threads_asking_at_once_cause_one_solve_a_key(make_store):
    asked = []
    store = make_store(lambda key, *_: asked.append(key) or key, capacity=64, workers=4)
    start = threading.Barrier(8)

    def ask():
        start.wait(WAIT)
        for key in range(50):
            job = store.request(key)
            assert job.future.result(WAIT) == key
            store.release(job)

    threads = [threading.Thread(target=ask) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(WAIT)
    assert sorted(asked) == list(range(50))


def test_a_kept_value_comes_from_the_cache(make_store, gate):
    gate.open.set()
    store = make_store(gate.solve)
    first = store.request("a")
    first.future.result(WAIT)
    again = store.request("a")
    assert again.future.done()
    assert (first.from_cache, again.from_cache) == (False, True)
    assert gate.asked == ["a"]


def test_the_value_asked_for_longest_ago_goes_first(make_store, gate):
    gate.open.set()
    store = make_store(gate.solve, capacity=2)
    for key in ("a", "b"):
        store.request(key).future.result(WAIT)
    assert store.kept("a") == "value of a"
    store.request("c").future.result(WAIT)
    assert store.kept("b") is None
    assert store.kept("a") is not None
    assert store.kept("c") is not None


def test_what_is_wanted_at_once_is_solved_by_who_asks_and_kept(make_store, gate):
    store = make_store(gate.solve, capacity=1, workers=1)
    store.request("long")
    gate.begun.acquire(timeout=WAIT)
    threads = []
    store._solve = lambda *words: threads.append(threading.current_thread()) or f"{words[0]}, solved"
    # the only worker is busy
    assert store.at_once("b") == ("b, solved", False)
    assert store.at_once("b") == ("b, solved", True)
    assert threads == [threading.current_thread()]
    assert store.request("b").from_cache
    store.at_once("c")
    assert store.kept("b") is None


def test_what_cannot_be_solved_at_once_raises_and_is_not_kept(make_store):
    def broken(*_):
        raise ValueError("no such track")

    store = make_store(broken)
    for _ in range(2):
        with pytest.raises(ValueError, match="no such track"):
            store.at_once("a")


def test_an_exception_reaches_all_who_wait_and_is_not_kept(make_store):
    fail = [True]
    entered = threading.Event()
    release = threading.Event()

    def solve(key, *_):
        entered.set()
        assert release.wait(WAIT)
        if fail[0]:
            raise ArithmeticError(key)
        return "fine"

    store = make_store(solve)
    first, second = store.request("a"), store.request("a")
    assert entered.wait(WAIT)
    release.set()
    for job in (first, second):
        with pytest.raises(ArithmeticError):
            job.future.result(WAIT)
    fail[0] = False
    assert store.request("a").future.result(WAIT) == "fine"


def test_a_job_ends_when_the_last_one_stops_waiting(make_store, gate):
    store = make_store(gate.solve)
    job, same = store.request("a"), store.request("a")
    assert gate.begun.acquire(timeout=WAIT)
    store.release(job)
    assert not job.is_abandoned()
    store.release(same)
    assert job.is_abandoned()
    assert gate.gave_up.wait(WAIT)


def test_a_job_that_has_not_begun_never_does_when_nobody_waits(make_store, gate):
    store = make_store(gate.solve, workers=1)
    store.request("a")
    assert gate.begun.acquire(timeout=WAIT)
    queued = store.request("b")
    store.release(queued)
    with pytest.raises(CancelledError):
        queued.future.result(WAIT)
    gate.open.set()
    assert store.request("c").future.result(WAIT) == "value of c"
    assert gate.asked == ["a", "c"]


def test_an_abandoned_key_is_solved_anew(make_store, gate):
    store = make_store(gate.solve)
    job = store.request("a")
    assert gate.begun.acquire(timeout=WAIT)
    store.release(job)
    again = store.request("a")
    assert again is not job
    assert gate.gave_up.wait(WAIT)
    gate.open.set()
    assert again.future.result(WAIT) == "value of a"
    assert store.kept("a") == "value of a"


def test_progress_can_be_read_from_outside(make_store, gate):
    store = make_store(gate.solve)
    job = store.request("a")
    assert gate.begun.acquire(timeout=WAIT)
    assert job.fraction == 0.5


def test_closing_ends_even_what_is_wanted(make_store, gate):
    store = make_store(gate.solve)
    store.request("a")
    assert gate.begun.acquire(timeout=WAIT)
    store.close()
    assert gate.gave_up.wait(WAIT)
