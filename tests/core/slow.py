"""The time step written out as plainly as it can be: the whole ring, element by element, in NumPy.

Wheels stand on any element and may carry a bogie and a body; the supports may stand on ground that yields.

This is a transcription of the method's lines and shares no code with the kernel. It is slow and has
no tricks: no symmetry, no reordered memory, no fused loops.
"""

import numpy as np


def run_ring(design, pad, boot, bays, per_bay, time_step, steps, *, step=1e-4, frames=None, rough_wheel=None):
    """Return support forces (steps, bays) [N], and the final rail, block and wheel displacements [m].

    ``pad`` and ``boot`` are relaxation laws, ``boot`` None when single-stage. A list ``frames`` takes wheels,
    rail, blocks and, of what is more than the simplified model, feet
    in one row as they stand at each step. ``rough_wheel`` is the only one that meets the
    step.
    """
    if design.simplified != design:
        return _run_surrounded(design, pad, boot, bays, per_bay, time_step, steps, step, rough_wheel, frames)
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


def _run_surrounded(design, pad, boot, bays, per_bay, dt, steps, step, rough_wheel, frames):
    """As :func:`run_ring`, of wheels, bogies, bodies and feet; the last returned are the wheels [m]."""
    dx, m, EI = design.fastener_spacing / per_bay, design.rail.mass_per_metre, design.rail.bending_stiffness
    at = [round(x * 3 / design.fastener_spacing) * per_bay // 3 for x in design.axle_positions]
    late = np.zeros(len(at)) if design.speed is None else (np.array(at) - min(at)) * dx / design.speed / dt
    a, v = np.zeros(bays * per_bay), np.zeros(bays * per_bay)
    b, vb = np.zeros(bays), np.zeros(bays)
    axles, speeds = np.zeros((len(at), 3)), np.zeros((len(at), 3))
    mass, dashpot, spring = np.diag([design.wheel_mass, 1.0, 1.0]), np.zeros((3, 3)), np.zeros((3, 3))
    above, pair = design.suspension, np.array([[1.0, -1.0], [-1.0, 1.0]])
    if above is not None:
        mass[1, 1] = above.bogie_mass
        spring[:2, :2] += above.primary_stiffness * pair
        dashpot[:2, :2] += above.primary_damping * pair
        if above.body_mass is not None:
            mass[2, 2] = above.body_mass
            spring[1:, 1:] += above.secondary_stiffness * pair
            dashpot[1:, 1:] += above.secondary_damping * pair
    u, y, z = np.zeros(bays), np.zeros(bays), np.zeros(bays)
    pad_memory, boot_memory = np.zeros((3, bays)), np.zeros((3, bays))
    forces = np.empty((steps, bays))
    for n in range(steps):
        rough = [
            step * min(max(n + 1 - late[j], 0.0), 1.0) * (rough_wheel is None or j == rough_wheel)
            for j in range(len(at))
        ]
        before = np.concatenate([axles[:, 0] + rough, a, b])
        fourth = np.roll(a, 2) - 4 * np.roll(a, 1) + 6 * a - 4 * np.roll(a, -1) + np.roll(a, -2)
        if boot is None:
            u, y, z = _foot(design.ground, pad, a[::per_bay], pad_memory, u, y, z, dt)
            f = g = _spring(pad, a[::per_bay] - u, pad_memory, dt)
        else:
            f = _spring(pad, a[::per_bay] - b, pad_memory, dt)
            u, y, z = _foot(design.ground, boot, b, boot_memory, u, y, z, dt)
            g = _spring(boot, b - u, boot_memory, dt)
            vb += dt * (f - g) / design.block_mass
        if frames is not None:
            frames.append(np.concatenate([before, u]))
        v -= dt * EI / (m * dx**4) * fourth
        v[::per_bay] -= dt * f / (m * dx)
        for j, element in enumerate(at):
            c = design.contact_stiffness * (axles[j, 0] + rough[j] - a[element % len(a)])
            load = np.array([-c, 0.0, 0.0]) - spring @ axles[j]
            momentum = (mass - dashpot * dt / 2) @ speeds[j] + dt * load
            speeds[j] = np.linalg.solve(mass + dashpot * dt / 2, momentum)
            v[element % len(a)] += dt * c / (m * dx)
        forces[n] = g if design.ground is None else design.ground.stiffness * u + design.ground.damping * y
        a += dt * v
        b += dt * vb
        axles += dt * speeds
    return forces, a, b, axles[:, 0]


def _foot(ground, law, above, memory, u, y, z, dt):
    """Return displacement, velocity and acceleration of the feet, each by the trapezoidal rule from the last.

    The spring above gives k_inf (above - u) less what it remembers, the current strain included; spring,
    dashpot and mass of the foot take it up.
    """
    if ground is None:
        return u, y, z
    now = law.instantaneous - sum(dt * k / t for k, t in zip(law.strengths, law.times, strict=True))
    terms = enumerate(zip(law.strengths, law.times, strict=True))
    past = sum(k / t * memory[j] * np.exp(-dt / t) for j, (k, t) in terms)
    T = 2 / dt
    # y' = T (u' - u) - y, z' = T (y' - y) - z
    y_without_u = -T * u - y
    z_without_u = T * (y_without_u - y) - z
    stiff = ground.stiffness + ground.damping * T + ground.mass * T**2
    load = now * above - past - ground.damping * y_without_u - ground.mass * z_without_u
    after = load / (now + stiff)
    return after, T * after + y_without_u, T**2 * after + z_without_u


def _spring(law, strain, memory, dt):
    """Spring and memory force; the memory takes up the current strain first."""
    force = law.instantaneous * strain
    for j, (strength, time) in enumerate(zip(law.strengths, law.times, strict=True)):
        memory[j] = memory[j] * np.exp(-dt / time) + strain * dt
        force = force - strength * memory[j] / time
    return force
