"""The frequency-domain solution against an independent package."""

import numpy as np
import pytest
from scipy.sparse import csc_array, diags_array
from scipy.sparse.linalg import spsolve

import trackig_core as tig
from trackig_core.track.viscoelastic_law import laws

FINE = tig.Lattice(elements_per_bay=24)
STEEL_DENSITY = 7850.0
SECOND_MOMENT = 3038e-8


def misfit(found, peer):
    return np.abs(20 * np.log10(np.abs(found / peer)))


def test_the_fine_lattice_is_the_peers_euler_rail(preset):
    """Within 0.03 dB to 250 Hz; above, what is left is the peer's rotary inertia (next test)."""
    peer = tig.peer_receptances()[preset]
    assert peer.frequency == pytest.approx(tig.BAND_CENTRES, rel=1e-6)
    found = tig.receptance(tig.PRESETS[preset], peer.frequency, lattice=FINE)
    assert misfit(found, peer.euler)[peer.frequency < 252].max() < 0.03
    assert misfit(found, peer.euler)[peer.frequency < 317].max() < 0.07
    assert np.abs(np.angle(found / peer.euler))[peer.frequency < 317].max() < 0.01


def test_with_rotary_inertia_the_peers_euler_rail_is_met_up_to_315_hz(preset):
    """The peer makes shear rigid but keeps rotary inertia; a beam that has it agrees to 0.01 dB."""
    peer = tig.peer_receptances()[preset]
    for frequency, expected in zip(peer.frequency[:19], peer.euler[:19], strict=True):
        found = rotating_beam_receptance(tig.PRESETS[preset], frequency)
        assert misfit(found, expected) < 0.01


def rotating_beam_receptance(design, frequency, bays=241, per_bay=24):
    """Return the point receptance over a support of a ring with rotary inertia, by a sparse solve [m/N]."""
    dx, count = design.fastener_spacing / per_bay, bays * per_bay
    squared = (2 * np.pi * frequency) ** 2
    offsets = [-count + 1, -1, 0, 1, count - 1]
    second = diags_array([1.0, 1.0, -2.0, 1.0, 1.0], offsets=offsets, shape=(count, count))
    dynamic = design.rail.bending_stiffness / dx**3 * second @ second
    dynamic = dynamic + squared * STEEL_DENSITY * SECOND_MOMENT / dx * second
    pad, boot = (None if law is None else law.dynamic_stiffness(frequency) for law in laws(design))
    support = pad if boot is None else pad - pad**2 / (pad + boot - design.block_mass * squared)
    diagonal = np.full(count, -squared * design.rail.mass_per_metre * dx, dtype=complex)
    diagonal[::per_bay] += support
    dynamic = csc_array(dynamic, dtype=complex)
    load = np.zeros(count, dtype=complex)
    load[0] = 1.0
    return spsolve(csc_array(dynamic + diags_array(diagonal)), load)[0]


def test_three_elements_a_bay_are_near_and_twentyfour_nearer(preset):
    peer = tig.peer_receptances()[preset]
    frequency = peer.frequency[:19]
    coarse = misfit(tig.receptance(tig.PRESETS[preset], frequency), peer.euler[:19]).max()
    fine = misfit(tig.receptance(tig.PRESETS[preset], frequency, lattice=FINE), peer.euler[:19]).max()
    assert fine < coarse / 6
    assert coarse < 0.6


def test_shear_softens_the_rail_most_on_stiff_supports():
    """The peer's Timoshenko rail: the frequency-domain solution leaves shear out."""
    softer = {
        name: 20 * np.log10(np.abs(peer.timoshenko / peer.euler))[:5].mean()
        for name, peer in tig.peer_receptances().items()
    }
    assert softer.pop("slab-track") == pytest.approx(2.1, abs=0.1)
    assert all(0.2 < value < 0.35 for value in softer.values())


def test_peers_are_read_whole():
    assert set(tig.peer_receptances()) == set(tig.PRESETS)
    first = tig.peer_receptances()["slab-track"]
    assert first.euler[0] == pytest.approx(5.190616e-10 - 5.580911e-11j)
    assert first.timoshenko[0] == pytest.approx(6.614219e-10 - 6.667756e-11j)
