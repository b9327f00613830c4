"""The same figures from a real cluster of two processes as from this one, even if one of them is killed."""

import os
import signal
import threading

import numpy as np
import pytest

import trackig_core as tig
from tests.core.decide.test_feasible import limits_around
from tests.waiting import WAIT
from trackig_core.decide import Grid, Normal, Samples, cluster, feasible_ranges, jobs, run_job, tolerance
from trackig_core.decide.cluster import computed, solve_on_cluster

distributed = pytest.importorskip("distributed")

BLOCK = tig.PRESETS["booted-block-low-mass"]

pytestmark = [
    # Dask itself leaves sockets to the collector, and warns of clusters that are slow to close
    pytest.mark.filterwarnings("ignore::ResourceWarning"),
    pytest.mark.filterwarnings("ignore::DeprecationWarning"),
    pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning"),
]


@pytest.fixture(scope="module")
def workers():
    """Start a cluster of two processes of one thread each; it ends with the tests."""
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address=":0", memory_limit=0
    ) as two:
        yield two


@pytest.fixture
def address(workers):
    return workers.scheduler_address


def test_designs_are_solved_to_the_same_bits(address):
    told = []
    columns = {"boot_stiffness": np.geomspace(5e6, 80e6, 2000), "rail": np.array([tig.RAILS["54E1"]] * 2000)}
    far = solve_on_cluster(BLOCK, columns, address, progress=told.append)
    here = tig.solve_many(BLOCK, **columns)
    for name in ("energy_ratio", "line_ratio", "loaded_track", "coupled_block", "rail_deflection"):
        assert np.array_equal(getattr(far, name), getattr(here, name)), name
    assert far.to_dataframe().equals(here.to_dataframe())
    assert told == [0.25, 0.5, 0.75, 1.0]


def test_answers_are_the_same(address):
    specification = limits_around(BLOCK, 1.0)
    tolerances = {"boot_stiffness": 0.1, "pad_stiffness": Normal(0.05)}
    far = tolerance(BLOCK, specification, tolerances, samples=2000, scheduler=address)
    here = tolerance(BLOCK, specification, tolerances, samples=2000)
    assert np.array_equal(far.margins, here.margins)
    assert str(far) == str(here)
    assert dict(feasible_ranges(BLOCK, specification, scheduler=address)) == dict(
        feasible_ranges(BLOCK, specification)
    )


def test_an_error_names_the_row_of_all(address):
    values = np.full(1500, 20e6)
    values[1200] = 1.0
    with pytest.raises(tig.DesignError, match="row 1200: boot_stiffness = 1"):
        solve_on_cluster(BLOCK, {"boot_stiffness": values}, address)


def test_it_stops_when_asked(address):
    with pytest.raises(tig.SolveCancelled):
        solve_on_cluster(BLOCK, {"boot_stiffness": np.full(5000, 20e6)}, address, cancelled=lambda: True)


def test_another_version_is_refused(address, monkeypatch):
    monkeypatch.setattr(cluster, "version", lambda _: "0.0.1")
    with pytest.raises(RuntimeError, match=r"and 0\.0\.1 is asked for: install one everywhere"):
        solve_on_cluster(BLOCK, {"boot_stiffness": np.full(10, 20e6)}, address)


def test_no_scheduler_is_said_so(monkeypatch):
    monkeypatch.setattr(cluster, "PATIENCE", 0.5)
    with pytest.raises(ConnectionError, match="no scheduler answers at tcp:"):
        solve_on_cluster(BLOCK, {"boot_stiffness": np.full(10, 20e6)}, "tcp://127.0.0.1:1")


def test_a_job_on_the_cluster_writes_what_it_writes_here(address, tmp_path):
    samples = Samples(BLOCK, {"boot_stiffness": 0.1, "block_mass": Normal(0.02)}, 1000, seed=3)
    far = run_job(samples, tmp_path / "far", part=300, scheduler=address)
    here = run_job(samples, tmp_path / "here", part=300)
    assert far.parts == here.parts == 4
    for number in range(4):
        assert far.part(number).equals(here.part(number))


def fatal_task(number, folder):
    """Note who begins; the first who begins number eight is killed at it."""
    (folder / f"{number}-{os.getpid()}").touch()
    if number == 8 and len([*folder.glob("8-*")]) == 1:
        os.kill(os.getpid(), signal.SIGKILL)
    return number, os.getpid()


@pytest.mark.slow
def test_a_killed_worker_loses_nothing(workers, tmp_path):
    """One of two processes is killed half-way; what it held is done again, and the figures are the same."""
    columns = {"boot_stiffness": np.geomspace(5e6, 80e6, 40 * cluster.TASK)}
    here = tig.solve_many(BLOCK, **columns)
    with distributed.Client(workers) as client:
        victim = next(iter(client.run(os.getpid).values()))
        killed = threading.Event()

        def kill_half_way(done):
            if done >= 0.4 and not killed.is_set():
                os.kill(victim, signal.SIGKILL)
                killed.set()

        far = solve_on_cluster(BLOCK, columns, client, progress=kill_half_way)
        assert killed.is_set()
        assert np.array_equal(far.energy_ratio, here.energy_ratio)
        assert np.array_equal(far.loaded_track, here.loaded_track)
        # a task that a process was killed at is done by another
        results = dict(computed(client, fatal_task, ((number, tmp_path) for number in range(30))))
        assert {number: task for number, (task, _) in results.items()} == {n: n for n in range(30)}
        begun = {int(each.name.partition("-")[2]) for each in tmp_path.glob("8-*")}
        assert len(begun) == 2
        assert results[8][1] in begun
        client.wait_for_workers(2, WAIT)  # others have been started for them, with which the next test works


def test_a_restarted_job_skips_the_parts_that_are_there(tmp_path, monkeypatch):
    grid = Grid(BLOCK, {"boot_stiffness": np.geomspace(5e6, 80e6, 30), "block_mass": np.linspace(30, 90, 20)})
    told = []
    with pytest.raises(tig.SolveCancelled, match="whole parts stay"):
        run_job(grid, tmp_path, part=100, progress=told.append, cancelled=lambda: len(told) >= 2)
    there = sorted(tmp_path.glob("part-*.parquet"))
    assert [each.name for each in there] == ["part-000000.parquet", "part-000001.parquet"]
    written = [each.stat().st_mtime_ns for each in there]
    solved = []
    solve = jobs.solve_designs
    monkeypatch.setattr(jobs, "solve_designs", lambda *given: solved.append(1) or solve(*given))
    job = run_job(grid, tmp_path, part=100)
    assert len(solved) == 4
    assert (job.parts, job.skipped) == (6, 2)
    assert [each.stat().st_mtime_ns for each in there] == written
    # what came out is what one call gives, the last field varying fastest
    import pandas as pd

    table = pd.concat([job.part(number) for number in range(6)], ignore_index=True)
    k, m = (each.ravel() for each in np.meshgrid(*grid.axes.values(), indexing="ij"))
    many = tig.solve_many(BLOCK, boot_stiffness=k, block_mass=m)
    assert np.array_equal(table["boot_stiffness"], k)
    assert np.array_equal(table["63"], many.insertion_gain[:, 11])
    assert np.array_equal(table["rail_deflection"], many.rail_deflection)
    assert not list(tmp_path.glob("*.unfinished"))


def test_a_job_that_breaks_off_leaves_no_half_part(tmp_path, monkeypatch):
    grid = Grid(BLOCK, {"boot_stiffness": np.geomspace(5e6, 80e6, 30)})

    def torn(path):
        path.write_bytes(b"half a part")
        raise OSError("disk full")

    import pandas as pd

    monkeypatch.setattr(pd.DataFrame, "to_parquet", lambda _, path: torn(path))
    with pytest.raises(OSError, match="disk full"):
        run_job(grid, tmp_path)
    assert [each.name for each in tmp_path.iterdir()] == ["_job.json"]


def test_a_folder_of_another_job_is_refused(tmp_path):
    run_job(Grid(BLOCK, {"boot_stiffness": [20e6]}), tmp_path / "one")
    with pytest.raises(FileExistsError, match="holds another job"):
        run_job(Grid(BLOCK, {"boot_stiffness": [21e6]}), tmp_path / "one")
    (tmp_path / "two").mkdir()
    (tmp_path / "two" / "letter.txt").write_text("dear")
    with pytest.raises(FileExistsError, match="is not empty and holds no job"):
        run_job(Grid(BLOCK, {"boot_stiffness": [20e6]}), tmp_path / "two")


def test_designs_are_stepped_in_time_too(tmp_path):
    grid = Grid(BLOCK, {"boot_stiffness": [20e6, 28e6, 40e6]})
    job = run_job(grid, tmp_path, fidelity="live", part=2)
    assert job.parts == 2
    expected = tig.solve(BLOCK, "live")
    row = job.part(0).iloc[1]
    assert row["boot_stiffness"] == 28e6
    assert np.array_equal(row.iloc[3:].to_numpy(), expected.insertion_gain)


def test_samples_are_those_of_one_draw():
    samples = Samples(BLOCK, {"boot_stiffness": 0.1, "pad_stiffness": Normal(0.05)}, 1000, seed=3)
    whole, part = samples.columns(0, 1000), samples.columns(512, 600)
    assert list(part) == list(whole) == ["boot_stiffness", "pad_stiffness"]
    for name, values in part.items():
        assert np.array_equal(values, whole[name][512:600])


def test_without_pyarrow_it_is_said_what_to_install(tmp_path, monkeypatch):
    monkeypatch.setattr(jobs, "find_spec", lambda _: None)
    with pytest.raises(ImportError, match="needs pyarrow: pip install"):
        run_job(Grid(BLOCK, {"boot_stiffness": [10e6, 20e6]}), tmp_path / "job")
    assert not (tmp_path / "job").exists()
