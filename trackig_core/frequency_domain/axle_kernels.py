"""Compiled frequency-domain solution with suspension, several axles and ground that yields.

What :mod:`trackig_core.frequency_domain.axles` does for any lattice in NumPy, here for the infinite track in
continuous time, three elements a bay, in one call; the formulas stand there, in
:mod:`trackig_core.track.vehicle` and in :mod:`trackig_core.track.ground`. SI units and Hz.
"""

import math

import numpy as np

from trackig_core.arrays import ComplexArray, IntArray, RealArray
from trackig_core.compiling import njit
from trackig_core.frequency_domain.wave_kernels import (
    BENDING,
    BLOCK_MASS,
    CONTACT,
    ELEMENT_MASS,
    WHEEL_MASS,
    bay_waves,
)

PRIMARY, BOGIE_MASS, SECONDARY, BODY_MASS, FOOT, FOOT_MASS = 0, 2, 3, 5, 6, 8
SURROUNDINGS = 9
"""Columns of what stands around a track: stiffness and damping of the primary suspension [N/m, N s/m], bogie
mass [kg] (0: no suspension), the same of secondary suspension and body (0: none); stiffness, damping and mass
of the ground [N/m, N s/m, kg] (stiffness 0: rigid)."""


@njit(nogil=True, cache=True, error_model="numpy")
def relaxing(law: RealArray, angular: float) -> complex:
    """Return the dynamic stiffness of a pad's or boot's law (7,) at an angular frequency [N/m]."""
    stiffness = complex(law[0], 0.0)
    for term in range(1, 4):
        stiffness -= law[term] / complex(1.0, angular * law[3 + term])
    return stiffness


@njit(nogil=True, cache=True, error_model="numpy")
def in_series(spring: complex, beyond: complex) -> complex:
    """Return the dynamic stiffness of a spring and what stands beyond it [N/m]."""
    return spring * beyond / (spring + beyond)


@njit(nogil=True, cache=True, error_model="numpy")
def above(track: RealArray, surroundings: RealArray, angular: float) -> complex:
    """Return D, the force on a wheel per displacement of it [N/m]."""
    squared = angular * angular
    wheel = complex(-track[WHEEL_MASS] * squared, 0.0)
    if surroundings[BOGIE_MASS] == 0.0:
        return wheel
    bogie = complex(-surroundings[BOGIE_MASS] * squared, 0.0)
    if surroundings[BODY_MASS] > 0.0:
        secondary = complex(surroundings[SECONDARY], angular * surroundings[SECONDARY + 1])
        bogie += in_series(secondary, complex(-surroundings[BODY_MASS] * squared, 0.0))
    return wheel + in_series(complex(surroundings[PRIMARY], angular * surroundings[PRIMARY + 1]), bogie)


@njit(nogil=True, cache=True, error_model="numpy")
def supports(track: RealArray, surroundings: RealArray, angular: float) -> tuple[complex, complex]:
    """Return force on the rail and force into the ground proper per displacement of the rail [N/m]."""
    squared = angular * angular
    pad = relaxing(track[:7], angular)
    two_stage = track[BLOCK_MASS] > 0.0
    lowest = relaxing(track[7:14], angular) if two_stage else pad
    below = into_ground = lowest
    if surroundings[FOOT] > 0.0:
        spring = complex(surroundings[FOOT], angular * surroundings[FOOT + 1])
        foot = spring - surroundings[FOOT_MASS] * squared
        share = lowest / (lowest + foot)
        below, into_ground = share * foot, share * spring
    if not two_stage:
        return below, into_ground
    beyond = below - track[BLOCK_MASS] * squared
    over = pad / (pad + beyond)
    return over * beyond, over * into_ground


@njit(nogil=True, cache=True, error_model="numpy")
def bay_shape(multiplier: complex, q: float) -> tuple[complex, complex]:
    """Return a wave at the two elements between supports, 1 over the support before them.

    See :func:`trackig_core.frequency_domain.axles.bay_shapes`; ``q`` is m' dx w^2 / (EI/dx^3) [-].
    """
    back, on = 1.0 / multiplier - 4.0, multiplier - 4.0
    scale = 1.0 / ((6.0 - q) * (6.0 - q) - back * on)
    first, second = -on, 4.0 * multiplier - 1.0
    return ((6.0 - q) * first - back * second) * scale, ((6.0 - q) * second - on * first) * scale


@njit(nogil=True, cache=True, error_model="numpy")
def fill_shapes(multipliers: ComplexArray, q: float, on: ComplexArray, back: ComplexArray) -> None:
    """Fill in both waves element by element.

    Parameters
    ----------
    multipliers : numpy.ndarray of complex (2,)
        Factors of the waves from bay to bay [-].
    q : float
        m' dx w^2 / (EI/dx^3) [-].
    on : numpy.ndarray of complex (2, elements)
        Filled: the waves at elements from support 0 on, a multiple of three, 1 over support 0.
    back : numpy.ndarray of complex (2, 3)
        Filled: the waves at elements 0, -1 and -2.
    """
    for wave in range(2):
        multiplier, bay = multipliers[wave], 1.0 + 0.0j
        first, second = bay_shape(multiplier, q)
        back[wave, 0], back[wave, 1], back[wave, 2] = 1.0, second / multiplier, first / multiplier
        for element in range(0, on.shape[1], 3):
            on[wave, element] = bay
            on[wave, element + 1], on[wave, element + 2] = bay * first, bay * second
            bay *= multiplier


@njit(nogil=True, cache=True, error_model="numpy")
def receptance(
    on: ComplexArray, back: ComplexArray, amplitudes: ComplexArray, element: int, load: int
) -> complex:
    """Return the displacement of an element per force on another, by reciprocity [m/N]."""
    low, high = min(element, load), max(element, load)
    past = low % 3  # how far the one to the left stands beyond its support
    far = high - low + past
    return amplitudes[0] * back[0, past] * on[0, far] + amplitudes[1] * back[1, past] * on[1, far]


@njit(nogil=True, cache=True, error_model="numpy")
def axle_energy(
    track: RealArray,
    surroundings: RealArray,
    wheels: IntArray,
    delays: RealArray,
    frequency: RealArray,
    energy: RealArray,
    coherent: RealArray,
) -> None:
    """Compute the energy of the force into the ground per unit step of roughness under every wheel.

    Parameters
    ----------
    track : numpy.ndarray (19,)
        The track.
    surroundings : numpy.ndarray (9,)
        What stands around it.
    wheels : numpy.ndarray of int (wheels,)
        Elements on which wheels stand, 0 over support 0.
    delays : numpy.ndarray (wheels,) or (0,)
        How much later than the first each wheel meets the same roughness [s]; empty where theirs is
        independent.
    frequency : numpy.ndarray (frequencies,)
        Frequencies [Hz].
    energy, coherent : numpy.ndarray (frequencies,)
        Filled: squared force summed over the supports, and square of the summed force, summed over columns of
        roughness [N2 s2/m2].
    """
    count, bending = wheels.size, track[BENDING]
    columns = 1 if delays.size else count
    before = wheels.min() // 3
    beyond = max(-(-wheels.max() // 3), before + 1)
    multipliers, amplitudes, lost = np.empty(2, np.complex128), np.empty(2, np.complex128), np.empty(2)
    on, back = np.empty((2, 3 * (beyond - before + 1)), np.complex128), np.empty((2, 3), np.complex128)
    matrix = np.empty((count, count), np.complex128)
    roughness = np.eye(count, columns).astype(np.complex128)
    forces, outwards = np.empty((count, columns), np.complex128), np.empty((2, 2), np.complex128)
    for i in range(frequency.size):
        angular = 2.0 * math.pi * frequency[i]
        support, passed = supports(track, surroundings, angular)
        q = track[ELEMENT_MASS] * angular * angular / bending
        waves = bay_waves(q, support.real / bending, support.imag / bending)
        for wave in range(2):
            multipliers[wave] = complex(waves[2 * wave], waves[2 * wave + 1])
            amplitudes[wave] = complex(waves[4 + 2 * wave], waves[5 + 2 * wave]) / bending
            lost[wave] = waves[8 + wave]
        fill_shapes(multipliers, q, on, back)
        contact = 1.0 / track[CONTACT] + 1.0 / above(track, surroundings, angular)
        for row in range(count):
            for column in range(row + 1):
                here = receptance(on, back, amplitudes, wheels[row], wheels[column])
                matrix[row, column] = matrix[column, row] = here
            matrix[row, row] += contact
        for row in range(delays.size):
            angle = angular * delays[row]
            roughness[row, 0] = complex(math.cos(angle), -math.sin(angle))
        if count == 1:
            forces[0, 0] = roughness[0, 0] / matrix[0, 0]
        else:
            forces[:] = np.linalg.solve(matrix, roughness)
        total, summed = 0.0, 0.0
        for column in range(columns):
            outwards[:] = 0.0
            for wave in range(2):
                for wheel in range(count):
                    force = amplitudes[wave] * forces[wheel, column]
                    outwards[0, wave] += force * on[wave, 3 * beyond - wheels[wheel]]
                    outwards[1, wave] += force * on[wave, wheels[wheel] - 3 * before]
            displaced = 0.0j
            for side in range(2):
                first, second = outwards[side, 0], outwards[side, 1]
                total += abs(first) ** 2 / lost[0] + abs(second) ** 2 / lost[1]
                crossed = first * second.conjugate()
                total += 2.0 * (crossed / (1.0 - multipliers[0] * multipliers[1].conjugate())).real
                displaced += first / (1.0 - multipliers[0]) + second / (1.0 - multipliers[1])
            for place in range(before + 1, beyond):
                here = 0.0j
                for wheel in range(count):
                    here += receptance(on, back, amplitudes, 3 * place, wheels[wheel]) * forces[wheel, column]
                total += abs(here) ** 2
                displaced += here
            summed += abs(displaced) ** 2
        scale = abs(passed) ** 2 / (angular * angular)
        energy[i], coherent[i] = scale * total, scale * summed
