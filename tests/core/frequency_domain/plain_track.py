"""The ring under any wheels, on any ground, written out as plainly as it can be: one dense matrix.

It shares no code with the closed form: no waves, no symmetry, no elimination; every rail element, block,
foot, wheel, bogie and body is an unknown of one system of equations per frequency.
"""

import numpy as np


def dense_energy(design, pad, boot, frequency, bays, per_bay=3):
    """Return the energy (frequencies,) and the coherent energy of the force into the ground per unit step.

    ``pad`` and ``boot`` are relaxation laws, ``boot`` None when single-stage.
    """
    energies = [_energies(design, pad, boot, each, bays, per_bay) for each in frequency]
    return np.array(energies).T


def _energies(design, pad, boot, frequency, bays, per_bay):
    w = 2 * np.pi * frequency
    dx, count = design.fastener_spacing / per_bay, bays * per_bay
    wheels = [
        round(position * 3 / design.fastener_spacing) * per_bay // 3 for position in design.axle_positions
    ]
    system = np.zeros((0, 0), dtype=complex)

    def add(number, mass):
        nonlocal system
        first = len(system)
        system = np.pad(system, (0, number))
        places = np.arange(first, first + number)
        system[places, places] -= mass * w**2
        return places

    def join(one, other, stiffness):
        for i, j in zip(one, other, strict=True):
            system[[i, j], [i, j]] += stiffness
            system[[i, j], [j, i]] -= stiffness

    rail = add(count, design.rail.mass_per_metre * dx)
    second = np.roll(np.eye(count), 1, axis=0) - 2 * np.eye(count) + np.roll(np.eye(count), -1, axis=0)
    system[:count, :count] += design.rail.bending_stiffness / dx**3 * second @ second
    lower, spring = rail[::per_bay], pad.dynamic_stiffness(frequency)
    if boot is not None:
        blocks = add(bays, design.block_mass)
        join(lower, blocks, spring)
        lower, spring = blocks, boot.dynamic_stiffness(frequency)
    proper = spring
    if design.ground is not None:
        feet = add(bays, design.ground.mass)
        join(lower, feet, spring)
        lower = feet
        proper = design.ground.stiffness + 1j * w * design.ground.damping
    system[lower, lower] += proper
    masses = add(len(wheels), design.wheel_mass)
    contact = design.contact_stiffness
    join(masses, [rail[each % count] for each in wheels], contact)
    above = design.suspension
    if above is not None:
        bogies = add(len(wheels), above.bogie_mass)
        join(masses, bogies, above.primary_stiffness + 1j * w * above.primary_damping)
        if above.body_mass is not None:
            bodies = add(len(wheels), above.body_mass)
            join(bogies, bodies, above.secondary_stiffness + 1j * w * above.secondary_damping)
    if design.speed is None:
        roughness = np.eye(len(wheels))
    else:
        roughness = np.exp(-1j * w * np.array(wheels) * dx / design.speed)[:, None]
    load = np.zeros((len(system), roughness.shape[1]), dtype=complex)
    for wheel, (mass, element) in enumerate(zip(masses, wheels, strict=True)):
        load[mass] -= contact * roughness[wheel]
        load[rail[element % count]] += contact * roughness[wheel]
    forces = proper * np.linalg.solve(system, load)[lower]
    return np.sum(np.abs(forces) ** 2) / w**2, np.sum(np.abs(forces.sum(axis=0)) ** 2) / w**2
