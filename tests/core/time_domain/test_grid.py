"""The grid: counts, stability, and runs that are refused before they begin."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import trackig_core as tig
from tests.core.slow import run_ring
from trackig_core.time_domain.grid import PAPER_TIME_STEP, make_grid, stable_time_step
from trackig_core.track.viscoelastic_law import laws

BLOCK = tig.PRESETS["booted-block-low-mass"]


def test_presets_use_the_papers_grid(preset):
    design = tig.PRESETS[preset]
    grid = make_grid(design)
    assert (grid.bays, grid.elements, grid.steps) == (667, 2001, 262144)
    assert grid.dt == 1 / 131072
    assert grid.dx == pytest.approx(design.fastener_spacing / 3)
    assert grid.notes == ()


def highest_frequency(design, bays=7, per_bay=3):
    """Return omega_max of the undamped ring with instantaneous springs, by eigenvalues [1/s]."""
    dx = design.fastener_spacing / per_bay
    pad, boot = laws(design)
    count = bays * per_bay
    size = count + bays + 1
    stiffness, mass = np.zeros((size, size)), np.zeros(size)
    second = np.roll(np.eye(count), 1, axis=0) - 2 * np.eye(count) + np.roll(np.eye(count), -1, axis=0)
    stiffness[:count, :count] = design.rail.bending_stiffness / dx**3 * second @ second
    mass[:count] = design.rail.mass_per_metre * dx
    mass[count:] = design.block_mass or 1.0
    mass[-1] = design.wheel_mass
    springs = [(0, size - 1, design.contact_stiffness)]
    for bay in range(bays):
        springs.append((bay * per_bay, count + bay, pad.instantaneous))
        stiffness[count + bay, count + bay] += boot.instantaneous if boot else 0.0
    for i, j, k in springs:
        stiffness[np.ix_([i, j], [i, j])] += k * np.array([[1, -1], [-1, 1]])
    root = np.sqrt(mass)
    return np.sqrt(np.linalg.eigvalsh(stiffness / np.outer(root, root))[-1])


designs = st.builds(
    tig.TrackDesign,
    pad_stiffness=st.floats(1e6, 1e12),
    pad_loss_factor=st.floats(0, 0.5),
    block_mass=st.floats(5, 500),
    boot_stiffness=st.floats(1e6, 1e10),
    boot_loss_factor=st.floats(0, 0.5),
    fastener_spacing=st.floats(0.1, 1.0),
    wheel_mass=st.floats(20, 2000),
    contact_stiffness=st.floats(1e7, 1e12),
)


@given(designs)
def test_the_bound_lies_below_the_true_limit_of_stability_but_near_it(design):
    limit = 2 / highest_frequency(design)
    bound = stable_time_step(design, design.fastener_spacing / 3)
    assert 0.45 * limit < bound <= limit * (1 + 1e-9)


def test_the_bound_is_needed():
    """At the true limit a run stays bounded, a little beyond it explodes."""
    design = BLOCK.replace(pad_loss_factor=0.0, boot_loss_factor=0.0)
    limit = 2 / highest_frequency(design)
    calm, _, _, _ = run_ring(design, *laws(design), 7, 3, 0.99 * limit, 3000)
    with np.errstate(all="ignore"):
        wild, _, _, _ = run_ring(design, *laws(design), 7, 3, 1.02 * limit, 3000)
    assert np.abs(calm).max() < 1e6
    assert not np.abs(wild).max() < 1e12


def test_a_spacing_of_200_mm_halves_the_time_step_and_says_so():
    grid = make_grid(BLOCK.replace(fastener_spacing=0.2))
    assert grid.dt == PAPER_TIME_STEP / 2
    assert grid.steps == 2 * 262144
    assert len(grid.notes) == 1
    assert "halved once to 1/262144 s" in grid.notes[0]
    assert "stable only below 6.79 µs" in grid.notes[0]


def test_runs_that_would_take_too_long_are_refused():
    with pytest.raises(tig.RunTooLargeError, match=r"about [\d.e+]+ s .* more than the 60 s allowed"):
        tig.solve(
            BLOCK.replace(fastener_spacing=0.1, contact_stiffness=1e14, rail=tig.Rail("light", 10.0, 1e8))
        )


def test_runs_that_would_need_too_much_memory_are_refused():
    with pytest.raises(tig.RunTooLargeError, match="GB"):
        make_grid(BLOCK, time_step=6e-5, bays=22001)


@pytest.mark.parametrize(
    "choice", [{"bays": 666}, {"bays": 1}, {"elements_per_bay": 1}, {"time_step": 0.0}, {"record": 0.0}]
)
def test_rings_that_cannot_be_made(choice):
    with pytest.raises(ValueError, match=next(iter(choice))):
        make_grid(BLOCK, **choice)
