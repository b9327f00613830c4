"""The threads and the stores of solutions that all sessions of a process share."""

import functools
import os
import time

import trackig_core as tig
from dashboard.compute.fair import FairExecutor
from dashboard.compute.store import SolutionStore
from dashboard.session.results import SolutionSummary

AT_REST = "paper"
"""Fidelity of the pictures that stay."""

MOVING = "live"
"""Fidelity of the pictures that follow the hand."""

AT_ONCE = "exact"
"""Fidelity of the curves that are drawn where a live run takes too long to follow the hand."""

CAPACITY = 128
"""Pictures kept; one holds 0.2 MB for a record of 2 s, 1.6 MB for one of 16 s."""

LIVE_CAPACITY = 32
"""Live pictures kept: a slider drawn to and fro asks for the same ones again."""


def key_of(design, fidelity):
    """Return the key of a picture in a store: designs of other static stiffnesses share one solution.

    Parameters
    ----------
    design : trackig_core.TrackDesign
        The design.
    fidelity : str
        :data:`AT_REST`, :data:`MOVING` or :data:`AT_ONCE`.
    """
    return design.without_statics, fidelity


def solve_summary(key, progress, cancelled):
    """Solve a design and keep what the views show.

    Parameters
    ----------
    key : tuple
        ``(design, fidelity)``, of :func:`key_of`.
    progress, cancelled : callable
        Handed on to :func:`trackig_core.solve`.

    Returns
    -------
    SolutionSummary
        The solution without its time history, and the two forces that are drawn; none of an exact one.
    """
    design, fidelity = key
    began = time.perf_counter()
    solution = tig.solve(design, fidelity=fidelity, progress=progress, cancelled=cancelled)
    return SolutionSummary.of(solution, time.perf_counter() - began)


@functools.cache
def workers():
    """Return the threads that all sessions of this process share for work that takes its time."""
    return FairExecutor(os.cpu_count() or 1, "solver")


@functools.cache
def compiled():
    """Return the future of the compiled kernels; the first call has them compiled, or read from disk."""
    return workers().submit(tig.compile_kernels)


@functools.cache
def shared_store():
    """Return the store of pictures at rest that all sessions of this process share."""
    return SolutionStore(solve_summary, workers(), CAPACITY)


@functools.cache
def shared_live_store():
    """Return the store of pictures that follow the hand; its own threads wait for nobody's paper run."""
    # one more than there are processors: an exact curve, a matter of milliseconds, waits for no live run
    threads = FairExecutor(1 + (os.cpu_count() or 1), "live", spare=1)
    return SolutionStore(solve_summary, threads, LIVE_CAPACITY)
