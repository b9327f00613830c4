"""Threads that sessions share fairly: who has the least under way comes first, then who waited longest.

A common queue would have a session wait behind all that others have asked for.
"""

import threading
from collections import Counter, OrderedDict, deque
from concurrent.futures import Executor, Future, ThreadPoolExecutor


class FairExecutor(Executor):
    """Does jobs on threads, those of each owner in turn.

    Parameters
    ----------
    workers : int
        How many threads there are.
    name : str
        What their names begin with.
    spare : int
        Threads that only urgent jobs take; one is left for the others at least.
    """

    def __init__(self, workers, name="", spare=0):
        self._pool = ThreadPoolExecutor(max_workers=workers, thread_name_prefix=name)
        self._most = max(1, workers - spare)
        self._urgent = deque()
        # the owner who was served the longest ago comes first
        self._waiting = OrderedDict()
        self._under_way = Counter()
        self._lock = threading.Lock()

    def submit(self, function, /, *args, owner=None, urgent=False):
        """Have a function called.

        Parameters
        ----------
        function : callable
            What is called.
        *args
            Its arguments.
        owner : hashable, optional
            Who shares the threads with others.
        urgent : bool
            Whether it comes before all that is not; only what takes milliseconds should.

        Returns
        -------
        concurrent.futures.Future
            Its result.
        """
        future = Future()
        job = (future, function, args)
        with self._lock:
            # a pool that is shut down takes nothing
            self._pool.submit(self._work)
            if urgent:
                self._urgent.append(job)
            else:
                self._waiting.setdefault(owner, deque()).append(job)
        return future

    def is_crowded(self):
        """Return whether as many jobs wait as can be done at a time."""
        with self._lock:
            waiting = (job for jobs in self._waiting.values() for job in jobs)
            return sum(not future.cancelled() for future, *_ in waiting) >= self._most

    def shutdown(self, wait=True, *, cancel_futures=False):
        """Take no more jobs, and give up those that wait if told to."""
        if cancel_futures:
            with self._lock:
                for jobs in (self._urgent, *self._waiting.values()):
                    for future, *_ in jobs:
                        future.cancel()
        self._pool.shutdown(wait=wait)

    def _work(self):
        """Do jobs until none may be done; what is left then follows one that is under way."""
        while (found := self._next()) is not None:
            owner, (future, function, args) = found
            try:
                if future.set_running_or_notify_cancel():
                    _answer(future, function, args)
            finally:
                if owner is not _URGENT:
                    self._leave(owner)

    def _next(self):
        """Return the next job and its owner, or None."""
        with self._lock:
            if self._urgent:
                return _URGENT, self._urgent.popleft()
            if not self._waiting or self._under_way.total() >= self._most:
                return None
            owner = min(self._waiting, key=self._under_way.__getitem__)
            jobs = self._waiting[owner]
            job = jobs.popleft()
            self._waiting.move_to_end(owner)
            if not jobs:
                del self._waiting[owner]
            self._under_way[owner] += 1
            return owner, job

    def _leave(self, owner):
        with self._lock:
            self._under_way[owner] -= 1
            if not self._under_way[owner]:
                del self._under_way[owner]


_URGENT = object()
"""Owner of what is urgent."""


def _answer(future, function, args):
    try:
        result = function(*args)
    except BaseException as error:
        future.set_exception(error)
    else:
        future.set_result(result)
