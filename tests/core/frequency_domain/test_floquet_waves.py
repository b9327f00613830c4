"""The frequency-domain solution against brute force, physics, and an independent package."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import trackig_core as tig
from trackig_core.frequency_domain.floquet_waves import (
    contact_force,
    exact_spectrum,
    receptance,
    support_force,
    track_decay_rate,
    waves,
)
from trackig_core.frequency_domain.lattice import INFINITE, Lattice, dynamic_stiffness
from trackig_core.track.viscoelastic_law import laws

BLOCK, SLAB = tig.PRESETS["booted-block-low-mass"], tig.PRESETS["slab-track"]
FREQUENCIES = np.array([0.5, 5.0, 39.0, 70.0, 134.0, 250.0, 301.0, 500.0, 1200.0])


def dense_response(design, frequency, lattice):
    """Return every rail element's, every block's and the wheel's displacement per unit roughness.

    One dense solve of the whole ring. Unknowns: every rail element, every block, the wheel. Roughness
    squeezes the contact spring.
    """
    bays, per_bay = lattice.bays, lattice.elements_per_bay
    dx, count = design.fastener_spacing / per_bay, bays * per_bay
    squared = (2 * np.pi * frequency) ** 2
    if lattice.time_step:
        squared = abs((np.exp(2j * np.pi * frequency * lattice.time_step) - 1) / lattice.time_step) ** 2
    pad, boot = (
        None if law is None else dynamic_stiffness(law, np.array([frequency]), lattice)[0]
        for law in laws(design)
    )
    size = count + bays + 1
    matrix = np.zeros((size, size), dtype=complex)
    second = np.roll(np.eye(count), 1, axis=0) - 2 * np.eye(count) + np.roll(np.eye(count), -1, axis=0)
    matrix[:count, :count] = design.rail.bending_stiffness / dx**3 * second @ second
    matrix[:count, :count] -= squared * design.rail.mass_per_metre * dx * np.eye(count)
    for bay in range(bays):
        rail, block = bay * per_bay, count + bay
        matrix[np.ix_([rail, block], [rail, block])] += pad * np.array([[1, -1], [-1, 1]])
        matrix[block, block] += 1e30 if boot is None else boot - squared * design.block_mass
    k = design.contact_stiffness
    matrix[np.ix_([0, -1], [0, -1])] += k * np.array([[1, -1], [-1, 1]])
    matrix[-1, -1] -= squared * design.wheel_mass
    load = np.zeros(size, dtype=complex)
    load[0], load[-1] = k, -k
    response = np.linalg.solve(matrix, load)
    return response[:count], response[count:-1], response[-1]


def brute_force(design, frequency, lattice):
    """Return contact force, rail over supports and force into the ground per roughness, solved densely."""
    rail, block, wheel = dense_response(design, frequency, lattice)
    over_supports = rail[:: lattice.elements_per_bay]
    pad, boot = (
        None if law is None else dynamic_stiffness(law, np.array([frequency]), lattice)[0]
        for law in laws(design)
    )
    contact = design.contact_stiffness * (1 + wheel - rail[0])
    return contact, over_supports, pad * over_supports if boot is None else boot * block


@pytest.mark.parametrize("design", [BLOCK, SLAB], ids=["two-stage", "single-stage"])
@pytest.mark.parametrize(
    "lattice",
    [
        Lattice(3, bays=21),
        Lattice(2, bays=8),
        Lattice(4, bays=15),
        Lattice(3, 21, 1 / 131072, memory_order=1),
        Lattice(3, 21, 1 / 16384, memory_order=2),
    ],
    ids=["ring", "even ring", "fine ring", "first-order steps", "second-order steps"],
)
def test_closed_form_is_the_dense_solution_of_the_ring(design, lattice):
    supports = np.arange(lattice.bays)
    for frequency in FREQUENCIES:
        contact, rail, ground = brute_force(design, frequency, lattice)
        assert contact_force(design, [frequency], lattice)[0] == pytest.approx(contact, rel=1e-6)
        moved = receptance(design, [frequency], supports, lattice)[:, 0] * contact
        assert np.abs(moved - rail).max() <= 1e-6 * np.abs(rail).max()
        forces = support_force(design, [frequency], supports, lattice)[:, 0]
        assert np.abs(forces - ground).max() <= 1e-6 * np.abs(ground).max()
        spectrum = exact_spectrum(design, [frequency], 1.0, lattice)
        squared = waves(design, [frequency], lattice).frequency_squared[0]
        assert spectrum.energy[0] * squared == pytest.approx(np.sum(np.abs(ground) ** 2), rel=1e-6)
        assert spectrum.coherent_energy[0] * squared == pytest.approx(abs(ground.sum()) ** 2, rel=1e-6)


@pytest.mark.parametrize("design", [BLOCK, SLAB], ids=["two-stage", "single-stage"])
def test_a_long_ring_is_the_infinite_track(design):
    frequency = np.geomspace(1, 600, 200)
    infinite = exact_spectrum(design, frequency, 1.0)
    differences = []
    for bays in (11, 101, 667):
        ring = exact_spectrum(design, frequency, 1.0, Lattice(bays=bays))
        differences.append(np.abs(10 * np.log10(ring.energy / infinite.energy)).max())
    assert ring.coherent_energy == pytest.approx(infinite.coherent_energy, rel=1e-6)
    assert differences[0] > 10 * differences[2]
    assert differences[2] < 1e-6


def test_a_coarse_time_step_is_continuous_time_as_it_shrinks():
    frequency = np.array([10.0, 40.0, 100.0, 300.0])
    exact = exact_spectrum(BLOCK, frequency, 1.0).energy
    for order, slope in ((1, 1.0), (2, 2.0)):
        errors = [
            np.abs(exact_spectrum(BLOCK, frequency, 1.0, Lattice(3, None, dt, order)).energy / exact - 1)
            for dt in (1 / 65536, 1 / 131072, 1 / 262144)
        ]
        slopes = np.log2(np.array(errors[:-1]) / errors[1:])
        assert slopes == pytest.approx(np.full_like(slopes, slope), abs=0.15)


def test_elements_converge_to_the_beam_with_second_order():
    frequency = np.array([20.0, 100.0, 400.0])
    fine = receptance(BLOCK, frequency, lattice=Lattice(elements_per_bay=192))
    errors = [
        np.abs(receptance(BLOCK, frequency, lattice=Lattice(elements_per_bay=n)) / fine - 1)
        for n in (3, 6, 12)
    ]
    slopes = np.log2(np.array(errors[:-1]) / errors[1:])
    assert slopes == pytest.approx(np.full_like(slopes, 2.0), abs=0.1)


def test_golden_spectra(golden, preset):
    case = golden["cases"][preset]
    lattice = Lattice(3, 667, 1 / 131072, 1)
    spectrum = exact_spectrum(tig.PRESETS[preset], case["spectrum_hz"], 1e-4, lattice)
    expected = case["summed_force_energy_density_for_0p1mm_step"]
    assert spectrum.energy == pytest.approx(expected, rel=1e-6)


@pytest.mark.parametrize("design", [BLOCK, SLAB], ids=["two-stage", "single-stage"])
@given(frequency=st.floats(1, 600))
@settings(max_examples=50)
def test_power_in_is_power_dissipated(design, frequency):
    """Power in at the contact equals power lost in pads and boots, by their own compressions."""
    supports = np.arange(-3000, 3001)
    law_pad, law_boot = laws(design)
    pad = law_pad.dynamic_stiffness(frequency)
    contact = contact_force(design, [frequency])[0]
    rail = receptance(design, [frequency], supports)[:, 0] * contact
    angular = 2 * np.pi * frequency
    supplied = 0.5 * angular * np.imag(contact.conjugate() * -rail[3000])
    if design.two_stage:
        boot = law_boot.dynamic_stiffness(frequency)
        block = pad * rail / (pad + boot - design.block_mass * angular**2)
        strain = np.abs(rail - block) ** 2
        lost = 0.5 * angular * np.sum(pad.imag * strain + boot.imag * np.abs(block) ** 2)
    else:
        lost = 0.5 * angular * np.sum(pad.imag * np.abs(rail) ** 2)
    assert supplied == pytest.approx(lost, rel=1e-6)


def test_track_decay_rate_is_the_decay_far_from_the_force():
    frequency = np.array([150.0, 250.0, 400.0])
    near, far = np.abs(receptance(BLOCK, frequency, np.array([60, 110])))
    decay = 20 * np.log10(near / far) / (50 * BLOCK.fastener_spacing)
    assert track_decay_rate(BLOCK, frequency) == pytest.approx(decay, rel=1e-6)


def test_default_lattice_is_infinite_and_continuous():
    assert Lattice(3, None, None) == INFINITE


@pytest.mark.parametrize("design", [BLOCK, SLAB], ids=["two-stage", "single-stage"])
@pytest.mark.parametrize("support", [0, 1, 6])
def test_reciprocity(design, support):
    """Force on the ground per force on the rail is movement of the rail per movement of the ground."""
    bays, per_bay, frequency = 21, 3, 80.0
    dx, count, squared = design.fastener_spacing / 3, bays * per_bay, (2 * np.pi * frequency) ** 2
    pad, boot = (None if law is None else law.dynamic_stiffness(frequency) for law in laws(design))
    size = count + (bays if design.two_stage else 0)
    matrix, load = np.zeros((size, size), dtype=complex), np.zeros(size, dtype=complex)
    second = np.roll(np.eye(count), 1, axis=0) - 2 * np.eye(count) + np.roll(np.eye(count), -1, axis=0)
    matrix[:count, :count] = design.rail.bending_stiffness / dx**3 * second @ second
    matrix[:count, :count] -= squared * design.rail.mass_per_metre * dx * np.eye(count)
    for bay in range(bays):
        if design.two_stage:
            pair = [bay * per_bay, count + bay]
            matrix[np.ix_(pair, pair)] += pad * np.array([[1, -1], [-1, 1]])
            matrix[count + bay, count + bay] += boot - squared * design.block_mass
        else:
            matrix[bay * per_bay, bay * per_bay] += pad
    # the ground moves by one metre under one support
    if design.two_stage:
        load[count + support] = boot
    else:
        load[support * per_bay] = pad
    moved = np.linalg.solve(matrix, load)[0]
    track = waves(design, [frequency], Lattice(per_bay, bays))
    assert track.transfer[0] * track.receptance(support)[0] == pytest.approx(moved, rel=1e-9)


@pytest.mark.parametrize(
    "choice",
    [
        {"elements_per_bay": 1},
        {"elements_per_bay": 2.5},
        {"bays": 0},
        {"time_step": 0.0},
        {"time_step": float("nan")},
        {"memory_order": 3},
    ],
)
def test_lattices_that_do_not_exist(choice):
    with pytest.raises(ValueError, match=next(iter(choice))):
        Lattice(**choice)


@pytest.mark.parametrize("wrong", [0.0, -10.0, float("inf"), float("nan")])
def test_only_positive_frequencies_have_a_receptance(wrong):
    with pytest.raises(ValueError, match="finite and greater than 0 Hz"):
        receptance(BLOCK, [wrong, 10.0])


@pytest.mark.parametrize("wrong", [0.5, [0, 1.5], float("nan"), True, "1"])
def test_between_supports_there_is_no_support(wrong):
    with pytest.raises(ValueError, match="give whole numbers of supports"):
        receptance(BLOCK, [200.0], support=wrong)


def test_a_whole_number_of_any_type_is_a_support():
    assert receptance(BLOCK, [200.0], support=2.0) == receptance(BLOCK, [200.0], support=2)


def test_supports_of_a_ring_are_counted_round():
    lattice = Lattice(bays=21)
    found = receptance(BLOCK, [80.0], np.array([0, 1, 20, 21, 22, -1]), lattice)[:, 0]
    assert found[[1, 2, 4, 5]] == pytest.approx(np.full(4, found[1]), rel=1e-9)
    assert found[3] == pytest.approx(found[0])
