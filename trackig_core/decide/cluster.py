"""Designs solved by the workers of a Dask cluster.

A worker that is lost takes nothing with it: the scheduler gives what it held to another. Every worker must
have the same version of trackig as this process, or it refuses.

Dask is an optional extra: ``pip install trackig[cluster]``. Start ``dask scheduler`` on one machine and
``dask worker tcp://HOST:8786`` on each that is to work.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from importlib.metadata import version
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from trackig_core.arrays import AnyArray
from trackig_core.decide.solving import joined
from trackig_core.frequency_domain.batch import BatchSolution, solve_many
from trackig_core.results import SolveCancelled
from trackig_core.track.design import DesignError, TrackDesign

if TYPE_CHECKING:
    from distributed import Client

TASK = 512
"""Designs of a task [-]: some 15 ms of one processor, several times what it costs to send them."""

PATIENCE = 10
"""Time that a scheduler has to answer [s]."""

IN_FLIGHT = 4
"""Tasks that are handed out for each thread of the workers [-]: enough that none waits, and few in memory."""

Result = TypeVar("Result")


@contextmanager
def connected(scheduler: str | Client) -> Iterator[Client]:
    """Connect to a scheduler, unless already connected.

    Parameters
    ----------
    scheduler : str or distributed.Client
        Address, such as ``"tcp://10.0.0.5:8786"``, or a client.

    Yields
    ------
    distributed.Client
        The client; closed in the end if it was opened here.

    Raises
    ------
    ConnectionError
        If no scheduler answers.
    ImportError
        If Dask is not installed.
    """
    try:
        from distributed import Client
    except ImportError:
        raise ImportError("a scheduler needs Dask: pip install trackig[cluster]") from None
    if isinstance(scheduler, Client):
        yield scheduler
        return
    try:
        client = Client(scheduler, timeout=PATIENCE, set_as_default=False)
    except (OSError, ValueError) as error:
        message = f"no scheduler answers at {scheduler}: start one with 'dask scheduler', or leave it out"
        raise ConnectionError(message) from error
    with client:
        yield client


def solve_on_cluster(
    base: TrackDesign,
    columns: Mapping[str, Any],
    scheduler: str | Client,
    progress: Callable[[float], object] | None = None,
    cancelled: Callable[[], bool] | None = None,
) -> BatchSolution:
    """Solve designs as :func:`trackig_core.solve_many` does, bit for bit, on a cluster.

    Parameters
    ----------
    base : TrackDesign
        The design whose fields are varied.
    columns : dict of str to numpy.ndarray (n,)
        Values by field.
    scheduler : str or distributed.Client
        Address of the scheduler, or a client of it.
    progress, cancelled : callable, optional
        As for :func:`trackig_core.solve_many`.

    Returns
    -------
    BatchSolution
        The designs, solved.

    Raises
    ------
    ConnectionError
        If no scheduler answers.
    DesignError
        If a value is not allowed; the message names row and field.
    SolveCancelled
        If ``cancelled`` answered true.
    """
    arrays = {name: np.atleast_1d(values) for name, values in columns.items()}
    (count,) = np.broadcast_shapes((1,), *(values.shape for values in arrays.values()))
    arrays = {name: np.broadcast_to(values, (count,)) for name, values in arrays.items()}
    begins = range(0, count, TASK)
    tasks = (
        (base, {name: values[begin : begin + TASK] for name, values in arrays.items()}, begin)
        for begin in begins
    )
    parts: list[BatchSolution | None] = [None] * len(begins)
    with connected(scheduler) as client:
        for done, (number, part) in enumerate(computed(client, solve_task, tasks), start=1):
            parts[number] = part
            if progress is not None:
                progress(done / len(begins))
            if cancelled is not None and cancelled():
                raise SolveCancelled("the run was cancelled")
    return joined([part for part in parts if part is not None])


def solve_task(base: TrackDesign, columns: Mapping[str, AnyArray], begin: int) -> BatchSolution:
    """Solve the designs of a task, in one thread; errors count rows from where it begins."""
    try:
        return solve_many(base, threads=1, **columns)  # type: ignore[arg-type]
    except DesignError as error:
        row = begin + (error.row if isinstance(error.row, int) else 0)
        raise DesignError(error.field, error.value, error.allowed, row) from None


def computed(
    client: Client, work: Callable[..., Result], tasks: Iterable[tuple[Any, ...]]
) -> Iterator[tuple[int, Result]]:
    """Have tasks computed by workers, a few at a time for each, and yield results as they come.

    Parameters
    ----------
    client : distributed.Client
        Connection to the cluster.
    work : callable
        What is called with each task.
    tasks : iterable of tuple
        Arguments of each call; taken from when there is room.

    Yields
    ------
    (int, object)
        Number of a task, and its result.
    """
    from distributed import as_completed

    numbered = enumerate(tasks)
    numbers = {}
    waiting = as_completed(loop=client.loop)

    def hand_out() -> bool:
        for number, task in numbered:
            future = client.submit(checked, version("trackig"), work, *task, pure=False)
            numbers[future.key] = number
            waiting.add(future)
            return True
        return False

    room = IN_FLIGHT * max(1, sum(client.nthreads().values()))
    try:
        while len(numbers) < room and hand_out():
            pass
        for future in waiting:
            yield numbers.pop(future.key), future.result()
            hand_out()
    finally:
        client.cancel(list(waiting.futures))


def checked(wanted: str, work: Callable[..., Result], *task: Any) -> Result:
    """Do a task, or raise a RuntimeError if this worker has another version of trackig."""
    here = version("trackig")
    if here != wanted:
        raise RuntimeError(f"a worker has trackig {here}, and {wanted} is asked for: install one everywhere")
    return work(*task)
