"""Where many designs are solved: threads of this process, or the workers of a Dask cluster.

The results are the same to the last bit: every design is solved by itself, wherever that is.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, TypedDict

import numpy as np

from trackig_core.frequency_domain.batch import BatchSolution, solve_many
from trackig_core.track.design import TrackDesign

if TYPE_CHECKING:
    from distributed import Client


class How(TypedDict, total=False):
    """How many designs are solved.

    Attributes
    ----------
    threads : int or None
        Threads that solve side by side in this process; by default one for each processor.
    scheduler : str or distributed.Client or None
        Address of the scheduler of a Dask cluster, such as ``"tcp://10.0.0.5:8786"``, whose workers solve; by
        default this process does.
    progress : callable or None
        Called now and then with the fraction done, 0 to 1, from the calling thread.
    cancelled : callable or None
        Asked now and then; the work ends with ``SolveCancelled`` when it answers true.
    """

    threads: int | None
    scheduler: str | Client | None
    progress: Callable[[float], object] | None
    cancelled: Callable[[], bool] | None


def solve_designs(base: TrackDesign, columns: Mapping[str, object], how: How) -> BatchSolution:
    """Solve designs that differ from a base in some columns.

    Parameters
    ----------
    base : TrackDesign
        The design whose fields are varied.
    columns : dict of str to array_like
        Values by field, as for :func:`trackig_core.solve_many`; not of more than one axis on a cluster.
    how : How
        Where they are solved, and who is told.

    Returns
    -------
    BatchSolution
        The designs, solved.
    """
    scheduler = how.get("scheduler")
    if scheduler is None:
        return solve_many(
            base,
            threads=how.get("threads"),
            progress=how.get("progress"),
            cancelled=how.get("cancelled"),
            **columns,  # type: ignore[arg-type]  # fields of a design, none of which is named like an option
        )
    # Dask is an optional extra
    from trackig_core.decide.cluster import solve_on_cluster

    return solve_on_cluster(base, columns, scheduler, how.get("progress"), how.get("cancelled"))


def part_of(how: How, begin: float, end: float) -> How:
    """Return how a part of some work is done whose progress runs from one fraction to another."""
    progress = how.get("progress")
    if progress is None:
        return how
    return {**how, "progress": lambda done: progress(begin + (end - begin) * done)}


def joined(parts: Sequence[BatchSolution]) -> BatchSolution:
    """Return solved designs, part after part along the first axis, as one."""
    values: dict[str, Any] = {}
    if any(part.stiff_ratio is not None for part in parts):
        parts = [dataclasses.replace(part, stiff_ratio=part._stiff_ratio) for part in parts]
    for field in dataclasses.fields(BatchSolution):
        first = getattr(parts[0], field.name)
        if isinstance(first, np.ndarray):
            values[field.name] = np.concatenate([getattr(part, field.name) for part in parts])
        elif isinstance(first, dict):
            values[field.name] = {
                name: np.concatenate([part.columns[name] for part in parts]) for name in first
            }
        else:
            values[field.name] = first
    return BatchSolution(**values)
