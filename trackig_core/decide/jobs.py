"""More designs than memory holds, or than one sitting solves: a folder of Parquet files, part by part.

SI units, Hz, dB. A part is written under another name and renamed when it is whole, so that a job that was
interrupted, however, goes on where it was when it is asked for again. Dask and pyarrow are an optional extra:
``pip install trackig[cluster]``.
"""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol, Unpack, cast

import numpy as np

from trackig_core.arrays import AnyArray, RealArray
from trackig_core.bands import BAND_LABELS
from trackig_core.decide.solving import How, solve_designs
from trackig_core.decide.tolerances import Factor, Tolerance, columns_of, drawn_shares, make_factors
from trackig_core.decide.versions import versions
from trackig_core.levels.insertion_gain import REFERENCES, SUMMATIONS, check_choice
from trackig_core.results import SolveCancelled
from trackig_core.solver import FIDELITIES, solve
from trackig_core.track.design import Rail, TrackDesign

if TYPE_CHECKING:
    import pandas
    from distributed import Client

PART = 32_768
"""Designs of a part that is solved exactly [-]: some 5 MB, and a second."""

STEPPED_PART = 64
"""Designs of a part that is stepped in time [-]: some minutes of one processor at paper fidelity."""

STEPPED_TASK = 4
"""Designs of a task that are stepped in time [-]."""

JOB_FILE = "_job.json"
"""What says of which job the parts are. What reads a folder of Parquet files passes over names like it."""


class Designs(Protocol):
    """Designs that are made when they are needed."""

    @property
    def base(self) -> TrackDesign:
        """The design of which fields are varied."""

    @property
    def size(self) -> int:
        """How many there are."""

    def columns(self, begin: int, end: int) -> dict[str, AnyArray]:
        """Return columns of some of them, from one place to before another."""

    def description(self) -> dict[str, Any]:
        """Return what makes them, as JSON takes it."""


@dataclass(frozen=True, eq=False)
class Grid:
    """Every combination of values of some fields, the last field varying fastest.

    Parameters
    ----------
    base : TrackDesign
        The design of which fields are varied.
    axes : dict of str to array_like
        Values by field [unit of the field].
    """

    base: TrackDesign
    axes: Mapping[str, Sequence[float] | RealArray]

    @property
    def shape(self) -> tuple[int, ...]:
        """How many values each field has."""
        return tuple(len(values) for values in self.axes.values())

    @property
    def size(self) -> int:
        """How many designs there are."""
        return int(np.prod(self.shape))

    def columns(self, begin: int, end: int) -> dict[str, AnyArray]:
        """Return columns of some of the designs."""
        places = np.unravel_index(np.arange(begin, end), self.shape)
        return {
            name: np.asarray(values, dtype=float)[place]
            for (name, values), place in zip(self.axes.items(), places, strict=True)
        }

    def description(self) -> dict[str, Any]:
        """Return what makes the designs."""
        axes = {name: np.asarray(values, dtype=float).tolist() for name, values in self.axes.items()}
        return {"axes": axes}


@dataclass(frozen=True, eq=False)
class Samples:
    """Samples of a design over its tolerances.

    Parameters
    ----------
    base : TrackDesign
        The design as it is stated.
    tolerances, production
        How fields scatter, as for :func:`tolerance`.
    size : int
        Samples [-].
    seed : int
        Seed of the sequence.
    """

    base: TrackDesign
    tolerances: Mapping[str, float | Tolerance]
    size: int
    production: Mapping[str, Sequence[Any]] | None = None
    seed: int = 0

    @property
    def factors(self) -> tuple[Factor, ...]:
        """What varies."""
        return make_factors(self.base, self.tolerances, self.production)

    def columns(self, begin: int, end: int) -> dict[str, AnyArray]:
        """Return columns of some of the designs."""
        factors = self.factors
        return columns_of(factors, drawn_shares(len(factors), end - begin, self.seed, first=begin))

    def description(self) -> dict[str, Any]:
        """Return what makes the designs."""
        table = self.production or {}
        return {
            "tolerances": {name: repr(each) for name, each in self.tolerances.items()},
            "production": {str(name): [repr(each) for each in table[name]] for name in table},
            "samples": self.size,
            "seed": self.seed,
        }


@dataclass(frozen=True, repr=False)
class Job:
    """A folder of solved designs.

    Attributes
    ----------
    folder : pathlib.Path
        Where the parts are: one Parquet file each, in order of their names, one row a design.
    designs : int
        How many designs there are.
    parts, skipped : int
        Parts there are, and those that were there already.
    """

    folder: Path
    designs: int
    parts: int
    skipped: int

    def part(self, number: int) -> pandas.DataFrame:
        """Return one part as a pandas.DataFrame: fields [SI], frequencies [Hz], bands [dB]."""
        import pandas as pd

        return pd.read_parquet(self.folder / part_name(number))

    def __repr__(self) -> str:
        """Return the gist."""
        return f"Job({str(self.folder)!r}, designs={self.designs}, parts={self.parts})"

    def __str__(self) -> str:
        """Return one sentence."""
        parts = f"{self.parts} part{'' if self.parts == 1 else 's'}"
        return f"{self.designs} designs are solved, in {parts} of which {self.skipped} were there."


def part_name(number: int) -> str:
    """Return the name of the file of a part."""
    return f"part-{number:06d}.parquet"


def run_job(
    designs: Designs,
    folder: str | Path,
    *,
    fidelity: str = "exact",
    part: int | None = None,
    reference: str = "line",
    summation: str = "energy",
    **how: Unpack[How],
) -> Job:
    """Solve any number of designs into a folder of Parquet files; go on where an earlier run of it ended.

    Parameters
    ----------
    designs : Grid or Samples
        The designs.
    folder : str or pathlib.Path
        Where the parts are written; made if it is not there.
    fidelity : str
        As for :func:`trackig_core.solve`.
    part : int, optional
        Designs of a part [-].
    reference, summation : str
        Definition of insertion gain, as for :func:`trackig_core.solve`.
    **how
        Where the designs are solved, and who is told; see :class:`How`.

    Returns
    -------
    Job
        The folder.

    Raises
    ------
    FileExistsError
        If the folder holds another job, or other versions began it.
    ImportError
        If pyarrow is not installed.
    SolveCancelled
        If ``cancelled`` answered true; whole parts stay.
    ValueError
        If a choice is not one of the above.
    """
    check_choice("fidelity", fidelity, FIDELITIES)
    check_choice("reference", reference, REFERENCES)
    check_choice("summation", summation, SUMMATIONS)
    if find_spec("pyarrow") is None:
        raise ImportError("a folder of Parquet files needs pyarrow: pip install trackig[cluster]")
    rows = part or (PART if fidelity == "exact" else STEPPED_PART)
    folder = Path(folder)
    _claim(
        folder,
        {
            "design": repr(designs.base),
            **designs.description(),
            "fidelity": fidelity,
            "reference": reference,
            "summation": summation,
            "rows_per_part": rows,
            "versions": versions(),
        },
    )
    begins = range(0, designs.size, rows)
    there = {number for number in range(len(begins)) if (folder / part_name(number)).exists()}
    with _workers(how) as within:
        for done, number in enumerate(sorted(set(range(len(begins))) - there), start=len(there) + 1):
            columns = designs.columns(begins[number], min(begins[number] + rows, designs.size))
            table = _table(designs.base, columns, fidelity, reference, summation, within)
            _replace(folder / part_name(number), table.to_parquet)
            _report(how, done / len(begins))
    return Job(folder, designs.size, len(begins), len(there))


@contextmanager
def _workers(how: How) -> Iterator[How]:
    """Connect once for all parts; of a part's progress nobody is told."""
    scheduler = how.get("scheduler")
    if scheduler is None:
        yield {**how, "progress": None}
        return
    from trackig_core.decide.cluster import connected

    with connected(scheduler) as client:
        yield {**how, "progress": None, "scheduler": client}


def _report(how: How, done: float) -> None:
    """Tell how much is done, and end if that is asked for."""
    progress, cancelled = how.get("progress"), how.get("cancelled")
    if progress is not None:
        progress(done)
    if done < 1 and cancelled is not None and cancelled():
        raise SolveCancelled("the run was cancelled; whole parts stay, and the same call goes on")


def _claim(folder: Path, description: dict[str, Any]) -> None:
    """Make a folder the folder of a job, or raise a FileExistsError if it is that of another."""
    folder.mkdir(parents=True, exist_ok=True)
    text = json.dumps(description, indent=2, ensure_ascii=False) + "\n"
    file = folder / JOB_FILE
    if file.exists():
        if file.read_text(encoding="utf-8") != text:
            raise FileExistsError(
                f"{folder} holds another job, or one of other versions: give another folder"
            )
        return
    if any(folder.iterdir()):
        raise FileExistsError(f"{folder} is not empty and holds no job: give another folder")
    _replace(file, lambda path: path.write_text(text, encoding="utf-8"))


def _replace(file: Path, write: Callable[[Path], object]) -> None:
    """Write a file that is either whole or not there."""
    unfinished = file.with_name(f"_{file.name}.{os.getpid()}.unfinished")
    try:
        write(unfinished)
        os.replace(unfinished, file)
    finally:
        unfinished.unlink(missing_ok=True)


def _table(
    base: TrackDesign, columns: dict[str, AnyArray], fidelity: str, reference: str, summation: str, how: How
) -> pandas.DataFrame:
    """Return a part: varied fields [SI], frequencies [Hz], deflection [m] of exact solutions, bands [dB]."""
    import pandas as pd

    if fidelity == "exact":
        many = solve_designs(base, columns, how)
        figures = {name: getattr(many, name) for name in ("loaded_track", "coupled_block", "rail_deflection")}
        levels = many.gain_for(reference, summation)
    else:
        stepped = _stepped(base, columns, (fidelity, reference, summation), how)
        figures, levels = {"loaded_track": stepped[:, 0], "coupled_block": stepped[:, 1]}, stepped[:, 2:]
    named = {name: _plain(values) for name, values in columns.items()}
    return pd.DataFrame(named | figures | dict(zip(BAND_LABELS, levels.T, strict=True)))


def _plain(values: AnyArray) -> AnyArray:
    """Return numbers as they are, rails by name and measured curves in words."""
    if values.dtype != object:
        return values
    return np.array([each.name if isinstance(each, Rail) else repr(each) for each in values])


def _stepped(
    base: TrackDesign, columns: dict[str, AnyArray], how_each: tuple[str, str, str], how: How
) -> RealArray:
    """Return natural frequencies [Hz] and bands [dB] of designs that are stepped in time (n, 23)."""
    count = next(iter(columns.values())).size
    rows = [{name: values[row] for name, values in columns.items()} for row in range(count)]
    tasks = [(base, rows[begin : begin + STEPPED_TASK], how_each) for begin in range(0, count, STEPPED_TASK)]
    cancelled = how.get("cancelled")
    parts: dict[int, RealArray] = {}

    def take(number: int, part: RealArray) -> None:
        parts[number] = part
        if cancelled is not None and cancelled():
            raise SolveCancelled("the run was cancelled")

    client = how.get("scheduler")
    if client is not None:
        from trackig_core.decide.cluster import computed

        for number, part in computed(cast("Client", client), step_task, tasks):
            take(number, part)
    else:
        with ThreadPoolExecutor(how.get("threads") or os.cpu_count()) as pool:
            try:
                for number, part in enumerate(pool.map(lambda task: step_task(*task), tasks)):
                    take(number, part)
            except BaseException:
                pool.shutdown(wait=True, cancel_futures=True)
                raise
    return np.concatenate([parts[number] for number in sorted(parts)])


def step_task(
    base: TrackDesign, rows: Sequence[Mapping[str, Any]], how_each: tuple[str, str, str]
) -> RealArray:
    """Return natural frequencies [Hz] and bands [dB] of the designs of a task (n, 23)."""
    fidelity, reference, summation = how_each
    found = []
    for row in rows:
        plain = {
            name: value.item() if isinstance(value, np.generic) else value for name, value in row.items()
        }
        solution = solve(base.replace(**plain), fidelity, reference=reference, summation=summation)
        natural = solution.natural_frequencies
        block = np.nan if natural.coupled_block is None else natural.coupled_block
        found.append([natural.loaded_track, block, *solution.insertion_gain])
    return np.array(found)
