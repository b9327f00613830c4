"""What a design costs in a batch, in parts of a paper run measured in the same run.

Not collected by ``pytest``: machines differ. Run ``pytest tests/benchmarks/bench_batch.py``.
"""

import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

import trackig_core as tig
from tests.benchmarks.bench_solver import fastest, multiply_add
from tests.core.slow import run_ring
from trackig_core.frequency_domain import batch_kernels as kernels
from trackig_core.frequency_domain.refinement import banded_spectrum
from trackig_core.frequency_domain.track_model import TrackModel, track_model
from trackig_core.time_domain import adaptive_grid
from trackig_core.time_domain.grid import make_grid
from trackig_core.track.viscoelastic_law import constant_loss_factor, laws

DESIGN = tig.PRESETS["booted-block-low-mass"]

DESIGNS = 10_000
"""Designs in the batch that is timed."""

FLOPS_PER_FREQUENCY = 313
"""Additions, multiplications, divisions and roots per frequency of a two-stage track, counted in the
machine code of ``force_energy``; a division or a root, of which there are 33, counts as one."""


def varied_in_all_fields(count):
    """Return values for all nine fields, over the ranges of the sliders [SI units]."""
    random = np.random.default_rng(3)
    rails = list(tig.RAILS.values())
    ends = {
        "pad_stiffness": (10e6, 2000e6),
        "pad_loss_factor": (0.01, 0.5),
        "block_mass": (10, 500),
        "boot_stiffness": (2e6, 200e6),
        "boot_loss_factor": (0.01, 0.5),
        "fastener_spacing": (0.2, 1.0),
        "wheel_mass": (200, 1500),
        "contact_stiffness": (200e6, 5000e6),
    }
    values = {name: np.exp(random.uniform(*np.log(pair), count)) for name, pair in ends.items()}
    return values | {"rail": [rails[number] for number in random.integers(len(rails), size=count)]}


@pytest.fixture(scope="module")
def paper_run():
    """Return how long a paper run takes on one core [s]."""
    tig.solve(DESIGN)
    return fastest(tig.solve, DESIGN, rounds=5)


@pytest.mark.parametrize(("threads", "most"), [(1, 6.0), (2, 3.0)])
def test_batch_of_designs(threads, most, paper_run, tell, remark):
    values = varied_in_all_fields(DESIGNS)
    tig.solve_many(DESIGN)
    seconds = fastest(lambda: tig.solve_many(DESIGN, threads=threads, **values), rounds=5)
    tell(seconds, f"{DESIGNS} designs varied in all fields, {threads} thread(s)")
    ratio = seconds / paper_run
    remark(f"batch: {DESIGNS} designs, {threads} thread(s): {ratio:.2f} paper runs (goal: {most:g})")


def test_exact_solve(paper_run, tell, remark):
    """Spectrum and natural frequencies of one design, and the whole of ``solve``."""
    seconds = fastest(banded_spectrum, DESIGN, rounds=200)
    tell(seconds, "exact spectrum and natural frequencies, compiled")
    remark(f"exact spectrum and natural frequencies: 1/{paper_run / seconds:.0f} of a paper run")
    whole = fastest(tig.solve, DESIGN, "exact", rounds=50)
    tell(whole, "solve(exact)")
    remark(f"solve(exact): 1/{paper_run / whole:.0f} of a paper run (goal: 1/400)")
    values = iter(np.linspace(0.05, 0.45, 1000))
    anew = fastest(lambda: constant_loss_factor(float(next(values))), rounds=500)
    tell(anew, "a new loss factor")
    remark(f"a new loss factor: {anew / whole:.2%} of solve(exact) (goal: 5 %)")


@pytest.mark.parametrize("preset", tig.PRESETS)
def test_live_run(preset, paper_run, tell, remark):
    """A live run, and what part of it is spent on choosing its grid."""
    design = tig.PRESETS[preset]
    whole = fastest(tig.solve, design, "live", rounds=30)
    tell(whole, f"solve(live), {preset}")
    chosen = fastest(lambda: adaptive_grid.plan(TrackModel(design, *laws(design))), rounds=50)
    remark(f"solve(live), {preset}: 1/{paper_run / whole:.0f} of a paper run (goal, two-stage: 1/60)")
    remark(f"solve(live), {preset}: {chosen / whole:.0%} of it chooses the grid")


def test_share_of_peak(tell, remark):
    """Floating-point rate of the closed form beside that of a loop of multiply-adds in registers."""
    count = 253
    frequency = np.geomspace(5, 500, count)
    energy, coherent = np.empty(count), np.empty(count)
    track = track_model(DESIGN).row
    seconds = fastest(kernels.force_energy, track, frequency, count, energy, coherent, rounds=2000) / count
    numbers = np.ones(96)
    multiply_add(1, numbers, 0.999, 0.1)
    most = 20_000 * 96 * 12 / fastest(multiply_add, 20_000, numbers, 0.999, 0.1, rounds=30) / 1e9
    rate = FLOPS_PER_FREQUENCY / seconds / 1e9
    tell(seconds, "one frequency of the closed form")
    remark(f"closed form: {rate:.1f} GFlop/s, {rate / most:.0%} of the {most:.0f} GFlop/s of multiply-adds")


@pytest.mark.skipif(shutil.which("g++") is None, reason="needs g++")
def test_plain_loops_in_cpp(paper_run, tell, remark, tmp_path):
    """A paper run beside a literal port of the paper's loops to C++."""
    source, program = Path(__file__).parent / "paper_loops.cpp", tmp_path / "paper_loops"
    subprocess.run(["g++", "-O3", "-march=native", "-o", str(program), str(source)], check=True)
    grid = make_grid(DESIGN)
    pad, boot = laws(DESIGN)

    def run(steps):
        def numbers(law):
            pairs = zip(law.strengths, law.times, strict=True)
            return [law.instantaneous, *(value for pair in pairs for value in pair)]

        dx = DESIGN.fastener_spacing / 3
        rail = [DESIGN.rail.mass_per_metre, DESIGN.rail.bending_stiffness]
        values = [grid.dt, dx, *rail, *numbers(pad), DESIGN.block_mass, *numbers(boot)]
        values += [DESIGN.wheel_mass, DESIGN.contact_stiffness]
        arguments = [str(grid.bays), str(steps), *(f"{value:.17g}" for value in values)]
        done = subprocess.run([str(program), *arguments], capture_output=True, text=True, check=True)
        return tuple(map(float, done.stdout.split()))

    _, energy, wheel = run(300)
    forces, _, _, expected = run_ring(DESIGN, pad, boot, grid.bays, 3, grid.dt, 300)
    assert energy == pytest.approx(np.sum(forces[-1] ** 2), rel=1e-9)
    assert wheel == pytest.approx(expected, rel=1e-9)
    seconds = run(grid.steps // 8)[0] * 8
    tell(seconds, "plain loops in C++ -O3")
    remark(f"a paper run takes {paper_run / seconds:.3f} of the plain loops in C++ -O3")
