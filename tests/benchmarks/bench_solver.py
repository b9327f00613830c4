"""How long a solve takes, by pytest-benchmark. Not collected by ``pytest``: machines differ.

Run with ``python -m pip install -e ".[dev]"`` and ``pytest tests/benchmarks/bench_solver.py``.
"""

import numpy as np
import pytest

import trackig_core as tig
from trackig_core.grid import make_grid
from trackig_core.harmonic import banded_spectrum
from trackig_core.modes import natural_frequencies
from trackig_core.simulate import simulate
from trackig_core.spectrum import force_spectrum

PRESETS = list(tig.PRESETS)
LIGHT = tig.PRESETS["booted-sleeper"].replace(pad_loss_factor=0.01, boot_loss_factor=0.01)


@pytest.fixture(autouse=True, scope="module")
def _compiled():
    tig.compile_kernels()
    tig.solve(LIGHT, "exact")


@pytest.mark.parametrize("preset", PRESETS)
def test_paper(benchmark, preset):
    benchmark.pedantic(tig.solve, (tig.PRESETS[preset],), rounds=5, warmup_rounds=1)


@pytest.mark.parametrize("preset", PRESETS)
def test_exact(benchmark, preset):
    benchmark(tig.solve, tig.PRESETS[preset], "exact")


def test_exact_light_damping(benchmark):
    benchmark(tig.solve, LIGHT, "exact")


def test_exact_spectrum_alone(benchmark):
    benchmark(banded_spectrum, tig.PRESETS["booted-block-low-mass"], 39.0)


def test_natural_frequencies_alone(benchmark):
    benchmark(natural_frequencies, tig.PRESETS["booted-block-low-mass"])


def test_spectrum_of_a_run_alone(benchmark):
    design = tig.PRESETS["booted-block-low-mass"]
    history = simulate(design, make_grid(design))
    benchmark.pedantic(force_spectrum, (history,), rounds=10, warmup_rounds=1)


def test_frequency_sweep_of_sixty_points(benchmark):
    values = np.geomspace(2e6, 2e8, 60)
    benchmark(tig.frequency_sweep, tig.PRESETS["booted-block-low-mass"], "boot_stiffness", values)


def test_steady_shape_of_one_frequency(benchmark):
    benchmark(tig.steady_shape, tig.PRESETS["booted-block-low-mass"], 63.0)
