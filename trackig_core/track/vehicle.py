"""What stands above and beside the wheel: suspension, bogie and body, other axles. SI units, Hz.

Per wheel: unsprung mass m_w, primary suspension k1, c1, its share m1 of the bogie, secondary suspension
k2, c2 and its share m2 of the body. Looking up from the contact, with s = k + i w c (time dependence
exp(+i w t)),

    D(w) = -m_w w^2 + s1 A / (s1 + A),    A = -m1 w^2 + s2 B / (s2 + B),    B = -m2 w^2

is the force on the wheel per displacement of it. Without suspension D = -m_w w^2.

Figures of whole vehicles are shared out by wheel: an axlebox's primary suspension, a quarter of a bogie
frame, half of one side's secondary suspension, an eighth of a body on two bogies.
"""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import TYPE_CHECKING

import numpy as np

from trackig_core.names import named
from trackig_core.track.fields import DesignError, check_number, values_in_words
from trackig_core.words import quantity

if TYPE_CHECKING:
    from trackig_core.arrays import AnyArray, RealArray
    from trackig_core.track.design import TrackDesign


@dataclass(frozen=True)
class Suspension:
    """Suspension of one wheel, and what it carries.

    Parameters
    ----------
    primary_stiffness : float
        Stiffness between wheel and bogie [N/m].
    primary_damping : float
        Dashpot between wheel and bogie [N s/m].
    bogie_mass : float
        Share of the bogie that one wheel carries [kg].
    secondary_stiffness, secondary_damping, body_mass : float or None
        The same between bogie and body [N/m, N s/m], and the share of the body [kg]; None, all three, where
        the body is left out.

    Raises
    ------
    DesignError
        If a value is not a number within its range, or some but not all of the last three are given.
    """

    primary_stiffness: float
    primary_damping: float
    bogie_mass: float
    secondary_stiffness: float | None = None
    secondary_damping: float | None = None
    body_mass: float | None = None

    def __post_init__(self) -> None:
        """Check every value once."""
        names = [each.name for each in fields(self)]
        missing = [name for name in names[3:] if getattr(self, name) is None]
        if len(missing) in (1, 2):
            together = "secondary stiffness, secondary damping and body mass come together"
            raise DesignError(
                f"suspension.{missing[0]}", None, f"a value too, or leave out all three: {together}"
            )
        for name in names[:3] if missing else names:
            object.__setattr__(self, name, check_number(f"suspension.{name}", getattr(self, name)))

    @property
    def secondary(self) -> tuple[float, float, float]:
        """Secondary stiffness [N/m], damping [N s/m] and body mass [kg]; zeros where the body is left out."""
        return self.secondary_stiffness or 0.0, self.secondary_damping or 0.0, self.body_mass or 0.0

    def __str__(self) -> str:
        """Return what there is with its unit."""
        given = {f"suspension.{each.name}": getattr(self, each.name) for each in fields(self)}
        return ", ".join(each.removeprefix("suspension ") for each in values_in_words(given))


@dataclass(frozen=True)
class Vehicle:
    """A vehicle as tracks feel it.

    Attributes
    ----------
    name : str
        What it is called.
    wheel_mass : float
        Unsprung mass on one rail: half a wheelset and what is fixed to it [kg].
    suspension : Suspension
        What one wheel carries.
    wheelbase : float
        Distance between the axles of a bogie [m].
    source : str
        Where the numbers come from; "generic" where they are round figures of the kind.
    """

    name: str
    wheel_mass: float
    suspension: Suspension
    wheelbase: float
    source: str

    def __str__(self) -> str:
        """Return name, masses, suspension and wheelbase with their units."""
        wheel, apart = quantity(self.wheel_mass, "kg"), quantity(self.wheelbase, "m")
        words = f"wheel mass {wheel}, suspension ({self.suspension}), wheelbase {apart}"
        return f"{self.name}: {words} ({self.source})"


_GENERIC = "generic: round figures of the kind, not those of a vehicle"

VEHICLES = named(
    {
        vehicle.name: vehicle
        for vehicle in (
            Vehicle("metro", 750.0, Suspension(1.2e6, 10e3, 750.0, 250e3, 10e3, 3500.0), 2.1, _GENERIC),
            Vehicle("regional", 900.0, Suspension(1.2e6, 4e3, 650.0, 220e3, 10e3, 4000.0), 2.5, _GENERIC),
            Vehicle("high speed", 950.0, Suspension(1.0e6, 10e3, 650.0, 150e3, 12e3, 5000.0), 2.5, _GENERIC),
            Vehicle("freight", 650.0, Suspension(1.5e6, 15e3, 10500.0), 1.8, _GENERIC),
        )
    }
)
"""Vehicles by name. The freight wagon, laden, has no secondary suspension: its springs carry bogie frame and
body as one, and friction damps them, which a dashpot only stands in for."""


def dynamic_stiffness_above(
    design: TrackDesign, frequency_squared: RealArray, derivative: AnyArray
) -> AnyArray:
    """Return D, the force on a wheel per displacement of it.

    Parameters
    ----------
    design : TrackDesign
        The track, for its wheel and suspension.
    frequency_squared : numpy.ndarray (frequencies,)
        Square of the angular frequency, as the masses feel it [1/s2].
    derivative : numpy.ndarray of complex (frequencies,)
        Velocity per displacement as the dashpots feel it: i w in continuous time [1/s].

    Returns
    -------
    numpy.ndarray (frequencies,)
        Dynamic stiffness [N/m]; complex with a suspension, real without.
    """
    wheel: RealArray = -design.wheel_mass * frequency_squared
    suspension = design.suspension
    if suspension is None:
        return wheel
    stiffness, damping, body_mass = suspension.secondary
    bogie = -suspension.bogie_mass * frequency_squared
    if body_mass:
        bogie = bogie + _in_series(stiffness + derivative * damping, -body_mass * frequency_squared)
    primary = suspension.primary_stiffness + derivative * suspension.primary_damping
    return wheel + _in_series(primary, bogie)


def _in_series(spring: AnyArray, beyond: AnyArray) -> AnyArray:
    return spring * beyond / (spring + beyond)


def rigid_energy(design: TrackDesign, frequency: RealArray) -> RealArray:
    """Return the energy that a rigid track passes after a step of roughness of 1 m under every wheel.

    Parameters
    ----------
    design : TrackDesign
        The track, for its wheels and their suspension.
    frequency : numpy.ndarray (frequencies,)
        Frequencies [Hz].

    Returns
    -------
    numpy.ndarray (frequencies,)
        Number of wheels times |D|^2/w^2 [N2 s2/m2].
    """
    angular = 2 * np.pi * frequency
    above = np.abs(dynamic_stiffness_above(design, angular**2, 1j * angular))
    return len(design.axle_positions) * (above / angular) ** 2
