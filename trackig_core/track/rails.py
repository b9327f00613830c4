"""Rails: a section bending vertically, and the sections that are known by name, each with its source.

SI units.
"""

from dataclasses import dataclass

from trackig_core.names import allowed, is_name, named
from trackig_core.track.fields import RAIL_FIELDS, DesignError, check_number
from trackig_core.words import quantity

STEEL_MODULUS = 210e9
"""Young's modulus of rail steel [Pa]."""

SHEAR_MODULUS = 81e9
"""Shear modulus of rail steel [Pa]."""

STEEL_DENSITY = 7850.0
"""Density of rail steel [kg/m3]."""

SHEAR_COEFFICIENT = 0.4
"""Part of a rail's section that carries shear, kappa [-]: flat-bottom rails, D. J. Thompson, *Railway Noise
and Vibration* (2009), chapter 3."""


@dataclass(frozen=True)
class Rail:
    """A rail section, bending vertically.

    Parameters
    ----------
    name : str
        Name of the section.
    mass_per_metre : float
        Mass per metre [kg/m].
    bending_stiffness : float
        Young's modulus times second moment of area, EI [N m2].

    Raises
    ------
    DesignError
        If a value is out of its range.
    """

    name: str
    mass_per_metre: float
    bending_stiffness: float

    def __post_init__(self) -> None:
        """Check every value once."""
        if not is_name(self.name):
            raise DesignError("name", self.name, allowed())
        for field in RAIL_FIELDS:
            object.__setattr__(self, field.name, check_number(field.name, getattr(self, field.name)))

    def __str__(self) -> str:
        """Return name, mass and bending stiffness with their units."""
        return f"{self.name} ({self.mass_per_metre:.4g} kg/m and {quantity(self.bending_stiffness, 'N m2')})"


PAPER_RAIL = Rail("60", mass_per_metre=60.0, bending_stiffness=210e9 * 3038e-8)
"""The paper's rail: 60 kg/m (Table 1) with the second moment of 60E1, 3038 cm4, and E = 210 GPa."""


def _section(name: str, mass_per_metre: float, second_moment_cm4: float) -> Rail:
    return Rail(name, mass_per_metre, STEEL_MODULUS * second_moment_cm4 * 1e-8)


RAILS = named(
    {
        rail.name: rail
        for rail in (
            PAPER_RAIL,
            _section("49E1", 49.39, 1816),
            _section("54E1", 54.77, 2338),
            _section("56E1", 56.30, 2321),
            _section("60E1", 60.21, 3038),
            _section("60E2", 60.03, 3022),
        )
    }
)
"""Rail sections by name: "60" is the paper's; the others are nominal figures of EN 13674-1 (kg/m, cm4)."""
