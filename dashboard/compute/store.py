"""One store of solutions for all sessions: bounded, safe among threads, and single-flight.

Sessions that ask for the same key wait for one job; a finished value is kept until newer ones
push it out. General-purpose caches make each waiter block a thread and cannot tell whether
anybody still waits. A job runs on as long as somebody waits for it, and no longer.
"""

import threading
import time
from collections import OrderedDict
from concurrent.futures import Future


class Job:
    """A value on its way: the future that will hold it, and how far it is.

    Parameters
    ----------
    key : hashable
        What is asked for.

    Attributes
    ----------
    future : concurrent.futures.Future
        Holds the value, or the exception that was raised instead.
    fraction : float
        Part of the work that is done, 0 to 1.
    began : float or None
        When a worker took it up, by ``time.monotonic`` [s]; None while it waits for one.
    from_cache : bool
        Whether the value was there when it was asked for.
    abandoned : bool
        Whether nobody waits any more.
    """

    def __init__(self, key):
        self.key = key
        self.future = Future()
        self.fraction = 0.0
        self.began = None
        self.from_cache = False
        self.abandoned = False
        self.waiting = 0

    def report(self, fraction):
        """Note how much of the work is done."""
        self.fraction = fraction

    def is_abandoned(self):
        """Return whether nobody waits any more."""
        return self.abandoned


class SolutionStore:
    """Solve each key once, on an executor, and keep the latest values.

    Parameters
    ----------
    solve : callable
        ``solve(key, progress, cancelled)`` returns the value of a key. It calls
        ``progress(fraction)`` now and then, and gives up by raising when ``cancelled()`` is true.
    executor : FairExecutor
        Where it runs.
    capacity : int
        How many values are kept; the one that was not asked for the longest goes first.
    """

    def __init__(self, solve, executor, capacity):
        self._solve = solve
        self._executor = executor
        self._capacity = capacity
        self._finished = OrderedDict()
        self._running = {}
        self._lock = threading.Lock()

    def kept(self, key):
        """Return the value of a key if it is there already, else None.

        Parameters
        ----------
        key : hashable
            What is asked for.
        """
        with self._lock:
            if key not in self._finished:
                return None
            self._finished.move_to_end(key)
            return self._finished[key]

    def at_once(self, key):
        """Return the value of a key, solved by who asks if it is not kept.

        Handing on what takes a millisecond, to a thread and back, takes several on a busy server.

        Parameters
        ----------
        key : hashable
            What is asked for.

        Returns
        -------
        value : object
            Its value.
        is_kept : bool
            Whether it was there already.
        """
        kept = self.kept(key)
        if kept is not None:
            return kept, True
        job = Job(key)
        value = self._solve(key, job.report, job.is_abandoned)
        with self._lock:
            self._keep(key, value)
        return value, False

    def is_crowded(self):
        """Return whether as many jobs wait as can be done at a time."""
        return self._executor.is_crowded()

    def request(self, key, owner=None, urgent=False):
        """Ask for a value; give the job back with :meth:`release` when done with it.

        Parameters
        ----------
        key : hashable
            What is asked for.
        owner : hashable, optional
            Who asks: owners are served in turn.
        urgent : bool
            Whether it comes before all that is not; only what takes milliseconds should.

        Returns
        -------
        Job
            Already done if the value is kept, shared with whoever else waits for it if not.
        """
        with self._lock:
            if key in self._finished:
                self._finished.move_to_end(key)
                job = Job(key)
                job.from_cache = True
                job.future.set_result(self._finished[key])
                return job
            job = self._running.get(key)
            if job is None:
                job = Job(key)
                job.future = self._executor.submit(self._work, job, owner=owner, urgent=urgent)
                self._running[key] = job
            job.waiting += 1
            return job

    def release(self, job):
        """Stop waiting for a job; the last to do so ends it.

        Parameters
        ----------
        job : Job
            What :meth:`request` returned.
        """
        with self._lock:
            job.waiting -= 1
            if job.waiting > 0 or job.future.done():
                return
            job.abandoned = True
            self._forget(job)
        job.future.cancel()

    def close(self):
        """End all jobs, wanted or not, and take no new ones."""
        self._executor.shutdown(wait=False, cancel_futures=True)
        with self._lock:
            for job in self._running.values():
                job.abandoned = True
            self._running.clear()

    def _work(self, job):
        job.began = time.monotonic()
        try:
            value = self._solve(job.key, job.report, job.is_abandoned)
        except BaseException:
            with self._lock:
                self._forget(job)
            raise
        with self._lock:
            self._forget(job)
            self._keep(job.key, value)
        return value

    def _keep(self, key, value):
        self._finished[key] = value
        while len(self._finished) > self._capacity:
            self._finished.popitem(last=False)

    def _forget(self, job):
        # another job may have taken the key since this one was abandoned
        if self._running.get(job.key) is job:
            del self._running[job.key]
