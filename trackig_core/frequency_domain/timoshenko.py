"""A rail that shears and has rotary inertia: Timoshenko's beam, exact between supports.

Harmonic motion of the free beam has two pairs of waves, exp(-mu |x|) with

    mu^4 - c2 mu^2 + c3 = 0,    c2 = -(m'/S + rho I/EI) w^2,    c3 = (m' w^2/EI) (rho I w^2/S - 1),

S = kappa G A, and a unit force moves it by sum over both of f exp(-mu |x|),

    f = (mu^2 - c1) / (S (4 mu^3 - 2 c2 mu)),    c1 = (S - rho I w^2)/EI.

Over a row of supports a distance L apart that sum becomes a rational function of w = 2 cos(k L) - 2, of the
same form as that of the lattice (see :func:`trackig_core.frequency_domain.kernels.bay_waves`). Nothing is
divided into elements; the elements of the lattice only say where the rail is looked at. m, N, kg, s. Source:
S. P. Timoshenko, Phil. Mag. 41 (1921) 744.
"""

from dataclasses import dataclass

import numpy as np

from trackig_core.arrays import ComplexArray, RealArray
from trackig_core.track.rails import SHEAR_COEFFICIENT, SHEAR_MODULUS, STEEL_DENSITY, STEEL_MODULUS, Rail


@dataclass(frozen=True, eq=False)
class FreeBeam:
    """Waves of the free beam at some frequencies.

    Attributes
    ----------
    squared : numpy.ndarray (2, frequencies) [1/m2]
        mu^2: below zero for the wave that runs, above for the one that dies away near the force.
    strength : numpy.ndarray (2, frequencies) [1/N]
        f mu, even in mu and therefore real.
    """

    squared: RealArray
    strength: RealArray

    @classmethod
    def of(cls, rail: Rail, frequency_squared: RealArray) -> "FreeBeam":
        """Return the waves of a rail.

        Parameters
        ----------
        rail : Rail
            The rail; its section's area follows from its mass, its second moment from its bending stiffness.
        frequency_squared : numpy.ndarray (frequencies,)
            Angular frequency squared [1/s2].

        Returns
        -------
        FreeBeam
            The waves.
        """
        bending, mass = rail.bending_stiffness, rail.mass_per_metre
        shear = SHEAR_COEFFICIENT * SHEAR_MODULUS * mass / STEEL_DENSITY
        rotary = STEEL_DENSITY * bending / STEEL_MODULUS * frequency_squared
        inertia = mass * frequency_squared
        c1 = (shear - rotary) / bending
        c2 = -(inertia / shear + rotary / bending)
        c3 = inertia / bending * (rotary / shear - 1)
        root = np.sqrt(c2**2 - 4 * c3)
        squared = np.array([(c2 - root) / 2, (c2 + root) / 2])
        return cls(squared, (squared - c1) / (shear * (4 * squared - 2 * c2)))

    def over_supports(self, spacing: float) -> tuple[RealArray, RealArray]:
        """Return pole and strength of each wave's sum over supports.

        Parameters
        ----------
        spacing : float
            Distance between supports [m].

        Returns
        -------
        poles : numpy.ndarray (2, frequencies)
            2 cosh(mu L) - 2 [-].
        strengths : numpy.ndarray (2, frequencies)
            2 f sinh(mu L) [m/N].
        """
        mu = np.sqrt(self.squared + 0j)
        poles = 4 * np.sinh(mu * spacing / 2) ** 2
        return poles.real, 2 * self.strength * (np.sinh(mu * spacing) / mu).real

    def bay_shapes(self, spacing: float, multipliers: ComplexArray, per_bay: int) -> ComplexArray:
        """Return both waves of the supported rail within one bay, 1 over the support that it begins with.

        Parameters
        ----------
        spacing : float
            Distance between supports [m].
        multipliers : numpy.ndarray of complex (2, frequencies)
            Factor of each wave from bay to bay [-].
        per_bay : int
            Places per bay.

        Returns
        -------
        numpy.ndarray of complex (per_bay, 2, frequencies)
            Displacement [-].
        """
        mu = np.sqrt(self.squared + 0j)
        poles, _ = self.over_supports(spacing)
        outer = multipliers + 1 / multipliers - 2
        shapes = np.zeros((per_bay, *multipliers.shape), dtype=complex)
        # the force of support s is in proportion to multiplier^s; the sum over all of them, wave by wave
        for place in range(per_bay):
            x = spacing * place / per_bay
            for wave in range(2):
                bent = np.sinh(mu[wave] * (spacing - x)) + multipliers * np.sinh(mu[wave] * x)
                shapes[place] += self.strength[wave] / mu[wave] * bent / (poles[wave] - outer)
        return shapes / shapes[0]
