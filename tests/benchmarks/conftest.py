"""What benchmarks share: compiled kernels, the plain transcription as a yardstick, a table at the end."""

import time

import pytest

import trackig_core as tig
from tests.core.slow import run_ring
from trackig_core.time_domain.grid import make_grid
from trackig_core.track.viscoelastic_law import laws

DESIGN = tig.PRESETS["booted-block-low-mass"]

STEPS = 1000
"""Time steps of the transcription that are timed; the whole run is computed from them."""

_rows = []
_remarks = []
_table = []


@pytest.fixture(autouse=True, scope="session")
def _compiled():
    tig.compile_kernels()


@pytest.fixture(scope="session")
def transcription():
    """Return how long the plain transcription would take for one run of the paper [s]."""
    grid = make_grid(DESIGN)
    began = time.perf_counter()
    run_ring(DESIGN, *laws(DESIGN), grid.bays, grid.elements_per_bay, grid.dt, STEPS)
    return (time.perf_counter() - began) / STEPS * grid.steps


@pytest.fixture
def tell(transcription, request):
    """Return a function that notes a duration [s] for the table at the end."""

    def note(seconds, what=None):
        _rows.append((what or request.node.name, seconds, transcription / seconds))

    return note


@pytest.fixture
def remark(pytestconfig):
    """Return a function that says a sentence at once, and again at the end.

    What was measured is not lost where a long benchmark is ended early.
    """
    capture = pytestconfig.pluginmanager.getplugin("capturemanager")

    def say(sentence):
        _remarks.append(sentence)
        with capture.global_and_fixture_disabled():
            print(f"\n{sentence}", flush=True)  # noqa: T201

    return say


@pytest.fixture
def row(remark):
    """Return a function that notes a row of a table in Markdown: what was measured, the figure, the goal."""

    def note(what, figure, goal=""):
        _table.append(f"| {what} | {figure} | {goal} |")
        remark(f"{what}: {figure}" + (f" (goal: {goal})" if goal else ""))

    return note


def pytest_terminal_summary(terminalreporter):
    """Print every duration noted beside its ratio to the transcription, measured in the same run."""
    if _rows:
        terminalreporter.section("beside the plain transcription of one paper run")
        for what, seconds, ratio in _rows:
            terminalreporter.write_line(f"{what:<58}{1000 * seconds:12.3f} ms {ratio:12.1f} x")
    for sentence in _remarks:
        terminalreporter.write_line(sentence)
    if _table:
        for line in ("", "| measured | figure | goal |", "|---|---|---|", *_table):
            terminalreporter.write_line(line)
