"""The time step written out as plainly as it can be: the whole ring, element by element, in NumPy.

This is a transcription of the method's lines and shares no code with the kernel. It is slow and has
no tricks: no symmetry, no reordered memory, no fused loops.
"""

import numpy as np


def run_ring(design, pad, boot, bays, per_bay, time_step, steps, *, step=1e-4, frames=None):
    """Return support forces (steps, bays) [N], and the final rail, block and wheel displacements [m].

    ``pad`` and ``boot`` are relaxation laws, ``boot`` None when single-stage. A list ``frames`` takes wheel,
    rail and blocks in one row as they stand at each step.
    """
    dx, dt = design.fastener_spacing / per_bay, time_step
    m, EI = design.rail.mass_per_metre, design.rail.bending_stiffness
    a, v = np.zeros(bays * per_bay), np.zeros(bays * per_bay)
    b, vb = np.zeros(bays), np.zeros(bays)
    w, vw = step, 0.0
    pad_memory, boot_memory = np.zeros((3, bays)), np.zeros((3, bays))
    forces = np.empty((steps, bays))
    for n in range(steps):
        if frames is not None:
            frames.append(np.concatenate([[w], a, b]))
        fourth = np.roll(a, 2) - 4 * np.roll(a, 1) + 6 * a - 4 * np.roll(a, -1) + np.roll(a, -2)
        f = _spring(pad, a[::per_bay] - b, pad_memory, dt)
        c = design.contact_stiffness * (w - a[0])
        v -= dt * EI / (m * dx**4) * fourth
        v[::per_bay] -= dt * f / (m * dx)
        if boot is not None:
            g = _spring(boot, b, boot_memory, dt)
            vb += dt * (f - g) / design.block_mass
        vw -= dt * c / design.wheel_mass
        v[0] += dt * c / (m * dx)
        forces[n] = f if boot is None else g
        a += dt * v
        b += dt * vb
        w += dt * vw
    return forces, a, b, w


def _spring(law, strain, memory, dt):
    """Spring and memory force; the memory takes up the current strain first."""
    force = law.instantaneous * strain
    for j, (strength, time) in enumerate(zip(law.strengths, law.times, strict=True)):
        memory[j] = memory[j] * np.exp(-dt / time) + strain * dt
        force = force - strength * memory[j] / time
    return force
