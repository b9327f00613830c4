"""The run as a whole: what it records, when it ends, and how it can be ended."""

import numpy as np
import pytest

import trackig_core as tig
from tests.core.slow import run_ring
from trackig_core.frequency_domain.floquet_waves import receptance
from trackig_core.frequency_domain.lattice import Lattice
from trackig_core.time_domain import time_stepping as seam
from trackig_core.time_domain.decimation import low_pass
from trackig_core.time_domain.grid import make_grid
from trackig_core.time_domain.spectrum import force_spectrum
from trackig_core.time_domain.time_stepping import simulate
from trackig_core.track.viscoelastic_law import laws

BLOCK, SLAB = tig.PRESETS["booted-block-low-mass"], tig.PRESETS["slab-track"]


@pytest.mark.parametrize("time_step", [1 / 131072, 1 / 262144, 1 / 98304, 1 / 32768, 1 / 20480])
def test_the_low_pass_keeps_the_bands_and_stops_what_would_fold_onto_them(time_step):
    low = low_pass(time_step)
    kept_rate = 1 / time_step / (low.comb_factor * low.factor)
    assert kept_rate == pytest.approx(4096)
    passed = low.gain(np.linspace(0, 600, 601))
    assert np.abs(20 * np.log10(passed)).max() < 0.03
    folding = [np.linspace(n * kept_rate - 600, n * kept_rate + 600, 201) for n in (1, 2, 3)]
    assert np.abs(low.gain(np.concatenate(folding))).max() < 10 ** (-145 / 20)
    after_comb = 1 / time_step / low.comb_factor
    combed = [np.linspace(n * after_comb - 600, n * after_comb + 600, 201) for n in range(1, low.comb_factor)]
    if combed:
        assert np.abs(low.gain(np.concatenate(combed))).max() < 10 ** (-115 / 20)


@pytest.mark.parametrize("time_step", [1 / 131072, 1 / 98304])
def test_samples_are_the_filtered_forces_of_the_plain_transcription(time_step):
    grid = make_grid(SLAB, bays=17, record=0.0625, time_step=time_step)
    history = simulate(SLAB, grid)
    forces, *_ = run_ring(SLAB, *laws(SLAB), 17, 3, grid.dt, 4096)
    taps = history.low_pass.whole
    smooth = np.convolve(forces[:, 0], taps)[: len(forces)]
    newest = np.round((history.time / grid.dt) + (taps.size - 1) / 2).astype(int)
    newest = newest[newest < len(smooth)]
    assert newest.size > 100
    assert set(np.diff(newest)) == {round(1 / grid.dt / 4096)}
    kept = smooth[newest]
    assert history.support_force[: len(kept), 0] == pytest.approx(kept, abs=1e-9 * np.abs(kept).max())


def test_load_shares_are_static_when_the_wheel_moves_slowly():
    """A heavy wheel on a soft contact moves so slowly that supports share its load as at rest."""
    design = BLOCK.replace(wheel_mass=1e4, contact_stiffness=1e6, pad_loss_factor=0.0, boot_loss_factor=0.0)
    history = simulate(design, make_grid(design, bays=101))
    spectrum = np.fft.rfft(history.support_force, axis=0)
    slow = np.argmax(np.abs(spectrum[:, 0]))
    assert slow / history.time[-1] == pytest.approx(np.sqrt(1e6 / 1e4) / (2 * np.pi), rel=0.05)  # Hz
    shares = np.abs(spectrum[slow]) / np.abs(spectrum[slow] @ history.multiplicity)
    assert shares[:4] == pytest.approx(static_shares(design)[:4], rel=2e-3)


def static_shares(design, bays=101, per_bay=3):
    """Return each support's share of a load on the ring at rest, by solving its stiffness matrix."""
    count, dx = bays * per_bay, design.fastener_spacing / per_bay
    second = np.roll(np.eye(count), 1, axis=0) - 2 * np.eye(count) + np.roll(np.eye(count), -1, axis=0)
    stiffness = design.rail.bending_stiffness / dx**3 * second @ second
    support = 1 / (1 / design.pad_stiffness + 1 / design.boot_stiffness)
    supported = np.arange(0, count, per_bay)
    stiffness[supported, supported] += support
    load = np.zeros(count)
    load[0] = 1.0
    return support * np.linalg.solve(stiffness, load)[supported]


def test_static_receptance_is_that_of_a_beam_on_an_elastic_foundation():
    """Winkler: a point load on closely spaced supports sinks by beta / (2 k'), beta^4 = k' / (4 EI)."""
    design = SLAB.replace(pad_stiffness=10e6, pad_loss_factor=0.0)
    foundation = design.pad_stiffness / design.fastener_spacing
    beta = (foundation / (4 * design.rail.bending_stiffness)) ** 0.25
    fine = receptance(design, [0.01], lattice=Lattice(elements_per_bay=24))[0].real
    assert fine == pytest.approx(beta / (2 * foundation), rel=2e-3)


def test_light_damping_extends_the_record_and_says_so():
    solution = tig.solve(BLOCK.replace(pad_loss_factor=0.03, boot_loss_factor=0.03))
    record = solution.history.steps * solution.grid.dt
    assert record in (4.0, 8.0)
    assert solution.history.decayed
    assert any(f"extended to {record:g} s" in note for note in solution.notes)


def test_a_record_that_never_decays_ends_at_16_s_and_says_so():
    history = simulate(BLOCK.replace(pad_loss_factor=0.0, boot_loss_factor=0.0), make_grid(BLOCK, bays=17))
    assert history.steps * history.time_step == 16.0
    assert not history.decayed


def test_an_extended_record_is_one_run():
    design = BLOCK.replace(pad_loss_factor=0.05, boot_loss_factor=0.05)
    pieces = simulate(design, make_grid(design, bays=31, record=0.5))
    whole = simulate(design, make_grid(design, bays=31, record=4.0))
    assert pieces.steps > make_grid(design, record=0.5).steps
    count = len(pieces.time)
    assert np.array_equal(pieces.support_force, whole.support_force[:count])


def test_a_run_reports_progress_and_can_be_cancelled():
    fractions = []
    with pytest.raises(tig.SolveCancelled):
        tig.solve(BLOCK, progress=fractions.append, cancelled=lambda: len(fractions) >= 3)
    assert len(fractions) == 3
    assert fractions == sorted(fractions)
    assert 0 < fractions[0] < fractions[-1] < 0.1


def test_progress_never_runs_back_while_the_record_is_extended():
    fractions = []
    design = BLOCK.replace(pad_loss_factor=0.05, boot_loss_factor=0.05)
    history = simulate(design, make_grid(design, bays=31, record=0.5), progress=fractions.append)
    assert history.steps > make_grid(design, record=0.5).steps
    assert (np.diff(fractions) > 0).all()
    assert fractions[-1] == 1.0


def test_nothing_that_is_not_finite_gets_out(monkeypatch):
    def spoil(*arguments):
        arguments[-1][:] = np.nan

    monkeypatch.setattr(seam.kernels, "advance", spoil)
    with pytest.raises(FloatingPointError, match="left the finite numbers"):
        simulate(BLOCK, make_grid(BLOCK, bays=17))


def test_energy_does_not_depend_on_rate_or_length_of_the_record():
    """The Fourier integral of one run, sampled by two records of different length and rate."""
    short = force_spectrum(simulate(SLAB, make_grid(SLAB, bays=31, record=1.0), memory_order=2))
    grid = make_grid(SLAB, bays=31, record=2.0, time_step=1 / 262144)
    long = force_spectrum(simulate(SLAB, grid, memory_order=2))
    assert long.frequency[1::2][: len(short.frequency)] == pytest.approx(short.frequency)
    band = short.frequency < 500
    ratio = long.energy[1::2][: len(band)][band] / short.energy[band]
    assert np.abs(10 * np.log10(ratio)).max() < 0.02
