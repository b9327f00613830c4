"""Compiled code and where it is kept: beside the source, in a private folder, or nowhere; damaged files."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import trackig_core

pytestmark = pytest.mark.slow

SOLVE = """
import sys, tempfile
if sys.argv[1:]:
    tempfile.tempdir = sys.argv[1]
import trackig_core as tig
print(abs(tig.receptance(tig.PRESETS["slab-track"], [50.0])[0]))
"""

EXPECTED = abs(trackig_core.receptance(trackig_core.PRESETS["slab-track"], [50.0])[0])


@pytest.fixture(scope="module")
def installed(tmp_path_factory):
    """Return a copy of the package whose folders of kernels cannot hold a cache, whoever runs the test."""
    copy = tmp_path_factory.mktemp("installed") / "trackig_core"
    shutil.copytree(
        Path(trackig_core.__file__).parent, copy, ignore=shutil.ignore_patterns("__pycache__", "*.nb?")
    )
    for kernels in copy.rglob("*kernels.py"):
        (kernels.parent / "__pycache__").touch()
    return copy.parent


def run(installed, *arguments, script=SOLVE, **more):
    """Solve a track in a process of its own that has no home; return what it says."""
    passed = {
        name: os.environ[name] for name in ("PATH", "SYSTEMROOT", "LD_LIBRARY_PATH") if name in os.environ
    }
    done = subprocess.run(
        [sys.executable, "-c", script, *map(str, arguments)],
        cwd=installed,
        env={**passed, "PYTHONPATH": str(installed), "HOME": os.devnull, **more},
        capture_output=True,
        text=True,
        check=False,
        timeout=300,
    )
    assert done.returncode == 0, done.stderr
    assert float(done.stdout) == pytest.approx(EXPECTED, rel=1e-12)
    return done.stderr


def test_an_installation_that_cannot_be_written_to_caches_in_a_private_folder(installed, tmp_path):
    said = run(installed, tmp_path)
    (private,) = tmp_path.glob("trackig-*")
    assert said == f"this installation cannot be written to; compiled code is kept in {private}\n"
    assert list(private.rglob("*.nbi"))
    assert private.stat().st_mode & 0o077 == 0


@pytest.mark.skipif(not hasattr(os, "getuid"), reason="permissions of folders are those of POSIX")
def test_a_first_run_says_that_it_compiles_and_others_do_not(installed, tmp_path):
    loud = f"import logging; logging.basicConfig(level=20, format='%(message)s')\n{SOLVE}"
    first, again = (run(installed, script=loud, NUMBA_CACHE_DIR=str(tmp_path)) for _ in range(2))
    assert "kernels are compiled, as at every first run: about a minute of one processor, once\n" in first
    assert "compiled" not in again


def test_a_folder_that_others_may_write_to_is_not_trusted(installed, tmp_path):
    folder = tmp_path / f"trackig-{os.getuid()}"
    folder.mkdir()
    folder.chmod(0o777)
    assert "compiled code cannot be kept" in run(installed, tmp_path)
    assert not list(folder.iterdir())


def test_where_nothing_can_be_written_kernels_are_compiled_in_memory(installed):
    said = run(installed, Path(os.devnull) / "none")
    assert (
        said
        == "compiled code cannot be kept, and every start compiles anew; set NUMBA_CACHE_DIR to a folder\n"
    )


@pytest.fixture(scope="module")
def cached(installed, tmp_path_factory):
    """Return a folder of compiled code."""
    folder = tmp_path_factory.mktemp("cache")
    assert run(installed, NUMBA_CACHE_DIR=str(folder)) == ""
    return folder


@pytest.mark.parametrize(
    ("kind", "damaged"),
    [
        ("nbi", lambda _: b""),
        ("nbi", lambda data: data[: len(data) // 2]),
        ("nbc", lambda data: data[: len(data) // 2]),
        ("nbc", lambda data: bytes(len(data))),
    ],
)
def test_a_damaged_file_is_compiled_anew(installed, cached, tmp_path, kind, damaged):
    folder = tmp_path / "cache"
    shutil.copytree(cached, folder)
    files = list(folder.rglob(f"*.{kind}"))
    assert files
    for file in files:
        file.write_bytes(damaged(file.read_bytes()))
    said = run(installed, NUMBA_CACHE_DIR=str(folder))
    assert "cannot be read and is made anew" in said
    assert said.count("\n") == 1
    assert run(installed, NUMBA_CACHE_DIR=str(folder)) == ""


EXACTLY = """
import json, sys
import trackig_core as tig
design = tig.PRESETS[sys.argv[1]]
solution = tig.solve(design, "exact")
many = tig.solve_many(design)
receptance = tig.receptance(design, [20.0, 50.0, 300.0])
print(json.dumps([
    solution.insertion_gain.tolist(),
    [solution.natural_frequencies.loaded_track, solution.natural_frequencies.observed_loaded_track],
    many.insertion_gain[0].tolist(),
    abs(receptance).tolist(),
]))
"""


@pytest.mark.parametrize("preset", ["slab-track", "booted-block-low-mass"])
def test_compiled_and_interpreted_kernels_give_the_same_exact_answers(preset):
    """Splines, batch and closed form, also as Python runs them: a debugger steps through what is compiled."""
    answers = []
    for disabled in ("0", "1"):
        done = subprocess.run(
            [sys.executable, "-c", EXACTLY, preset],
            env=os.environ | {"NUMBA_DISABLE_JIT": disabled},
            capture_output=True,
            text=True,
            check=False,
            timeout=300,
        )
        assert done.returncode == 0, done.stderr
        answers.append(json.loads(done.stdout))
    for compiled, interpreted in zip(*answers, strict=True):
        assert interpreted == pytest.approx(compiled, rel=1e-9, abs=0.0)
