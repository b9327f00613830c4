"""How long a solve takes and how its cost grows. Not collected by ``pytest``: machines differ.

Run with ``python -m pip install -e ".[dev]"`` and ``pytest tests/benchmarks/bench_solver.py``.
"""

import os
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from numba import njit

import trackig_core as tig
from trackig_core.frequency_domain.floquet_waves import exact_spectrum
from trackig_core.frequency_domain.natural_frequencies import natural_frequencies
from trackig_core.frequency_domain.refinement import banded_spectrum
from trackig_core.time_domain import kernels
from trackig_core.time_domain.decimation import low_pass
from trackig_core.time_domain.grid import make_grid
from trackig_core.time_domain.memory_layout import Layout
from trackig_core.time_domain.spectrum import force_spectrum
from trackig_core.time_domain.time_stepping import at_rest, simulate

PRESETS = list(tig.PRESETS)
DESIGN = tig.PRESETS["booted-block-low-mass"]
LIGHT = tig.PRESETS["booted-sleeper"].replace(pad_loss_factor=0.01, boot_loss_factor=0.01)

FLOPS_PER_BAY = 3 * 10 + 34
"""Additions and multiplications per bay and time step of a two-stage track: three elements, one support."""


def fastest(work, *arguments, rounds=5):
    """Return the least of some durations [s]."""
    durations = []
    for _ in range(rounds):
        began = time.perf_counter()
        work(*arguments)
        durations.append(time.perf_counter() - began)
    return min(durations)


@pytest.mark.parametrize("preset", PRESETS)
def test_paper(benchmark, preset, tell):
    benchmark.pedantic(tig.solve, (tig.PRESETS[preset],), rounds=7, warmup_rounds=1)
    tell(benchmark.stats["min"])


@pytest.mark.parametrize("preset", PRESETS)
def test_live(benchmark, preset, tell):
    benchmark.pedantic(tig.solve, (tig.PRESETS[preset], "live"), rounds=50, warmup_rounds=5)
    tell(benchmark.stats["min"])


@pytest.mark.parametrize("preset", PRESETS)
def test_exact(benchmark, preset, tell):
    benchmark(tig.solve, tig.PRESETS[preset], "exact")
    tell(benchmark.stats["min"])


def test_exact_light_damping(benchmark, tell):
    benchmark(tig.solve, LIGHT, "exact")
    tell(benchmark.stats["min"])


def test_exact_spectrum_alone(benchmark, tell):
    benchmark(banded_spectrum, DESIGN)
    tell(benchmark.stats["min"])


def test_natural_frequencies_alone(benchmark, tell):
    benchmark(natural_frequencies, DESIGN)
    tell(benchmark.stats["min"])


def test_spectrum_of_a_run_alone(benchmark, tell):
    history = simulate(DESIGN, make_grid(DESIGN))
    benchmark.pedantic(force_spectrum, (history,), rounds=10, warmup_rounds=1)
    tell(benchmark.stats["min"])


def test_fit_of_a_loss_factor(benchmark, tell):
    """What a new loss factor costs once."""
    values = iter(np.linspace(0.05, 0.45, 1000))

    def solve_anew():
        tig.solve(DESIGN.replace(pad_loss_factor=float(next(values))), "exact")

    benchmark.pedantic(solve_anew, rounds=20, warmup_rounds=2)
    tell(benchmark.stats["min"])


@pytest.mark.parametrize("bays", [83, 167, 333, 667, 1333])
def test_growth_with_bays(bays, tell):
    tell(fastest(simulate, DESIGN, make_grid(DESIGN, bays=bays)), f"run, {bays} bays")


@pytest.mark.parametrize("record", [1.0, 2.0, 4.0])
def test_growth_with_steps(record, tell):
    grid = make_grid(DESIGN, record=record)
    tell(fastest(simulate, DESIGN, grid, rounds=3), f"run, {grid.steps} steps")


@pytest.mark.parametrize("frequencies", [21, 210, 2100])
def test_growth_with_frequencies(frequencies, tell):
    axis = np.geomspace(5, 500, frequencies)
    tell(fastest(exact_spectrum, DESIGN, axis, 1e-4, rounds=50), f"exact, {frequencies} frequencies")


@pytest.mark.parametrize("fidelity", ["paper", "live"])
def test_designs_in_parallel(fidelity, tell):
    """Kernels let go of the interpreter's lock: threads solve side by side."""
    threads = os.cpu_count()
    each = 4 if fidelity == "paper" else 60
    designs = [DESIGN.replace(wheel_mass=600 + 2.0 * number) for number in range(threads * each)]

    def all_of_them(pool):
        list(pool.map(lambda design: tig.solve(design, fidelity), designs))

    durations = []
    for workers in (1, threads):
        with ThreadPoolExecutor(workers) as pool:
            durations.append(fastest(all_of_them, pool, rounds=3) / len(designs))
    one, many = durations
    tell(one, f"{fidelity}, one thread")
    tell(many, f"{fidelity}, {threads} threads: {one / many:.2f} times as many a second")


def test_kernel_against_multiply_adds(tell, remark):
    """Floating-point rate of the time step beside that of a loop of multiply-adds in registers."""
    grid, low = make_grid(DESIGN), low_pass(1 / 131072)
    state, constants = at_rest(DESIGN, grid, comb=low.comb, comb_factor=low.comb_factor)
    rows = np.empty((512, Layout(grid).columns(3)))
    kernels.advance(*state, *constants, rows)
    seconds = fastest(kernels.advance, *state, *constants, rows, rounds=30) / 512 / low.comb_factor
    filter_flops = 2 * low.comb.size / low.comb_factor
    step = grid.half_bays * (FLOPS_PER_BAY + filter_flops) / seconds / 1e9
    numbers = np.ones(96)
    multiply_add(1, numbers, 0.999, 0.1)
    most = 20_000 * 96 * 12 / fastest(multiply_add, 20_000, numbers, 0.999, 0.1, rounds=30) / 1e9
    tell(seconds, "one time step of the paper's ring")
    remark(f"kernel: {step:.0f} GFlop/s, {step / most:.0%} of the {most:.0f} GFlop/s of multiply-adds")


@njit(fastmath={"contract"})
def multiply_add(rounds, numbers, factor, term):
    """Multiply and add in registers, six times over 96 numbers a round."""
    kept = np.empty(96)
    for i in range(96):
        kept[i] = numbers[i]
    for _ in range(rounds):
        for i in range(96):
            kept[i] = ((kept[i] * factor + term) * factor + term) * factor + term
            kept[i] = ((kept[i] * factor + term) * factor + term) * factor + term
    for i in range(96):
        numbers[i] = kept[i]


COLD = """
import time; began = time.perf_counter()
import trackig_core as tig
imported = time.perf_counter()
tig.compile_kernels()
print(imported - began, time.perf_counter() - imported)
"""


@pytest.mark.parametrize("start", ["first", "later"])
def test_start(start, tell, tmp_path_factory):
    """Import and compilation in a fresh interpreter, with an empty and with a filled cache on disk."""
    cache = tmp_path_factory.getbasetemp() / "numba"
    environment = os.environ | {"NUMBA_CACHE_DIR": str(cache)}
    command = [sys.executable, "-c", COLD]
    run = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
    imported, compiled = map(float, run.stdout.split())
    tell(imported, f"import, {start} start")
    tell(compiled, f"kernels ready, {start} start")


def test_memory(remark):
    """Peak memory of a paper run beyond what the imported and compiled library takes."""
    code = """
import re
import trackig_core as tig
tig.compile_kernels()
peak = lambda: int(re.search(r"VmHWM:\\s+(\\d+)", open("/proc/self/status").read())[1]) / 1024
before = peak()
tig.solve(tig.PRESETS["booted-block-low-mass"])
print(before, peak() - before)
"""
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    before, more = map(float, run.stdout.split())
    remark(f"memory: {before:.0f} MB imported and compiled, {more:.0f} MB more for a paper run")
