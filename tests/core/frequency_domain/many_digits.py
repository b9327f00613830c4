"""The closed form of the supported rail in arithmetic of sixty digits, which no rounding drowns."""

import mpmath as mp


def force_energy(track, frequency):
    """Return the energy of the force into the ground per unit step of roughness.

    Parameters
    ----------
    track : numpy.ndarray (19,)
        The track, see :mod:`trackig_core.frequency_domain.kernel_rows`.
    frequency : float
        Frequency [Hz].

    Returns
    -------
    mpmath.mpf
        Squared force summed over the supports [N2 s2/m2].
    """
    with mp.workdps(60):
        numbers = [mp.mpf(float(number)) for number in track]
        angular = 2 * mp.pi * mp.mpf(float(frequency))
        pad, boot = (
            law[0] - sum(k / (1 + 1j * angular * t) for k, t in zip(law[1:4], law[4:7], strict=True))
            for law in (numbers[0:7], numbers[7:14])
        )
        block, bending, element_mass, wheel, contact = numbers[14:]
        support = passed = pad
        if block:
            between = pad + boot - block * angular**2
            support, passed = pad - pad**2 / between, pad * boot / between
        # w = y - 2 of both waves, y = m + 1/m: the roots of a quadratic
        q, s = element_mass * angular**2 / bending, support / bending
        half = 6 * q - 2 * s
        root = mp.sqrt(half**2 - (9 - q) * (s * (3 - q) - q * (9 - q)))
        one, other = half + root, half - root
        waves = [wave(mine, its, q) for mine, its in ((one, other), (other, one))]
        receptance = sum(amplitude for _, amplitude in waves) / bending
        force = passed / (1 / contact + receptance - 1 / (wheel * angular**2)) / angular / bending
        energy = sum(
            amplitude * mp.conj(its) * (1 + m * mp.conj(n)) / (1 - m * mp.conj(n))
            for m, amplitude in waves
            for n, its in waves
        )
        return abs(force) ** 2 * mp.re(energy)


def wave(w, other, q):
    """Return factor from bay to bay and share in the receptance, times EI/dx^3, of the wave of w."""
    factor = 1 + w / 2 + mp.sqrt(w + w**2 / 4)
    factor = 1 / factor if abs(factor) > 1 else factor
    return factor, ((3 - q) * (9 - q) + 4 * w) / (w - other) / (factor - 1 / factor)
