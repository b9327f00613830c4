"""Ground that yields under the supports: each stands on its own spring, dashpot and mass. SI units.

Neighbouring supports do not feel each other through it, and nothing travels on to a receptor: it is no model
of a tunnel. The force that reaches the ground proper is that of spring and dashpot.
"""

import math
from dataclasses import dataclass

from trackig_core.names import named
from trackig_core.track.fields import check_number, values_in_words


@dataclass(frozen=True)
class Ground:
    """Ground under one support.

    Parameters
    ----------
    stiffness : float
        Stiffness [N/m].
    damping : float
        Dashpot [N s/m].
    mass : float
        Mass that moves with the foot of the support [kg]; may be zero.

    Raises
    ------
    DesignError
        If a value is not a number within its range.
    """

    stiffness: float
    damping: float
    mass: float

    def __post_init__(self) -> None:
        """Check every value once."""
        for name in ("stiffness", "damping", "mass"):
            object.__setattr__(self, name, check_number(f"ground.{name}", getattr(self, name)))

    @classmethod
    def half_space(
        cls, radius: float, shear_modulus: float, poissons_ratio: float, density: float
    ) -> "Ground":
        """Return the ground under a round, rigid foot on an elastic half-space, by Lysmer's analogue.

        k = 4 G r / (1 - nu) and c = 3.4 r^2 sqrt(rho G) / (1 - nu); the analogue has no mass of its own.
        Source: Lysmer and Richart (1966), "Dynamic response of footings to vertical loading".

        Parameters
        ----------
        radius : float
            Radius of the foot [m].
        shear_modulus : float
            Shear modulus of the half-space [Pa].
        poissons_ratio : float
            Its Poisson's ratio [-].
        density : float
            Its density [kg/m3].

        Returns
        -------
        Ground
            Stiffness and dashpot; the mass is zero.

        Raises
        ------
        DesignError
            If a value is not a number within its range.
        """
        given = {
            "radius": radius,
            "shear_modulus": shear_modulus,
            "poissons_ratio": poissons_ratio,
            "density": density,
        }
        r, G, nu, rho = (check_number(name, value) for name, value in given.items())
        return cls(4 * G * r / (1 - nu), 3.4 * r**2 * math.sqrt(rho * G) / (1 - nu), 0.0)

    def __str__(self) -> str:
        """Return what there is with its unit."""
        words = values_in_words({f"ground.{name}": value for name, value in vars(self).items()})
        return ", ".join(each.removeprefix("ground ") for each in words)


FOOT_RADIUS = 0.3
"""Radius of the foot of a support for the grounds below [m]: a round foot as large as half a metre square."""

GROUNDS = named(
    {
        "rock": Ground.half_space(FOOT_RADIUS, 2e9, 0.25, 2400.0),
        "stiff clay": Ground.half_space(FOOT_RADIUS, 150e6, 0.45, 2000.0),
        "soft clay": Ground.half_space(FOOT_RADIUS, 20e6, 0.49, 1700.0),
    }
)
"""Grounds by name, by the half-space formula for :data:`FOOT_RADIUS`. Modulus, Poisson's ratio and density
are generic: round figures of the kind (shear waves at 910, 270 and 110 m/s), not those of a site."""
