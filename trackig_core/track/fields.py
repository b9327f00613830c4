"""The numbers of a rail and of a design: name, unit, range, and key in a study's file, in one table.

SI units. Ranges are wide enough for any support that has been built and for the very stiff tracks that stand
in for a rigid one, narrow enough to catch a slip of units.
"""

import math
import numbers
from collections.abc import Mapping
from dataclasses import dataclass

from trackig_core.names import brief
from trackig_core.words import quantity


@dataclass(frozen=True)
class Field:
    """One number of a design or a rail.

    Attributes
    ----------
    name : str
        Name of the attribute; of a part of a design, such as its suspension, the path to it.
    unit : str
        SI unit; empty if it has none.
    low, high : float
        Lowest and highest value [unit].
    key : str
        Key in a study's file, which names the unit.
    """

    name: str
    unit: str
    low: float
    high: float
    key: str


RAIL_FIELDS = (
    Field("mass_per_metre", "kg/m", 10.0, 200.0, "mass_kg_per_m"),
    Field("bending_stiffness", "N m2", 1e5, 1e8, "bending_stiffness_N_m2"),
)
"""Numbers of a rail."""

DESIGN_FIELDS = (
    Field("pad_stiffness", "N/m", 1e5, 1e13, "pad_stiffness_N_per_m"),
    Field("pad_loss_factor", "", 0.0, 2.0, "pad_loss_factor"),
    Field("block_mass", "kg", 1.0, 1e4, "block_mass_kg"),
    Field("boot_stiffness", "N/m", 1e5, 1e13, "boot_stiffness_N_per_m"),
    Field("boot_loss_factor", "", 0.0, 2.0, "boot_loss_factor"),
    Field("fastener_spacing", "m", 0.1, 2.0, "fastener_spacing_m"),
    Field("wheel_mass", "kg", 10.0, 1e4, "wheel_mass_kg"),
    Field("contact_stiffness", "N/m", 1e6, 1e15, "contact_stiffness_N_per_m"),
    Field("pad_static_stiffness", "N/m", 1e5, 1e13, "pad_static_stiffness_N_per_m"),
    Field("boot_static_stiffness", "N/m", 1e5, 1e13, "boot_static_stiffness_N_per_m"),
    Field("stiffness_frequency", "Hz", 1.0, 1000.0, "stiffness_frequency_Hz"),
)
"""Numbers of a design."""

STATIC_FIELDS = (
    Field("wheel_load", "N", 1e3, 1e6, "wheel_load_N"),
    Field("rail_deflection_limit", "m", 1e-6, 0.1, "rail_deflection_max_m"),
)
"""Numbers of a standing wheel, and of what it may sink."""

WHEELBASE = Field("wheelbase", "m", 0.5, 100.0, "wheelbase_m")
"""Distance of a second standing wheel."""

DEFAULT_WHEEL_LOAD = 85e3
"""Static load of a wheel where none is given [N]: half an axle load of 17 t."""

SUSPENSION_FIELDS = (
    Field("suspension.primary_stiffness", "N/m", 1e3, 1e9, "primary_stiffness_N_per_m"),
    Field("suspension.primary_damping", "N s/m", 0.0, 1e7, "primary_damping_N_s_per_m"),
    Field("suspension.bogie_mass", "kg", 1.0, 1e5, "bogie_mass_kg"),
    Field("suspension.secondary_stiffness", "N/m", 1e3, 1e9, "secondary_stiffness_N_per_m"),
    Field("suspension.secondary_damping", "N s/m", 0.0, 1e7, "secondary_damping_N_s_per_m"),
    Field("suspension.body_mass", "kg", 1.0, 1e5, "body_mass_kg"),
)
"""Numbers of a suspension."""

GROUND_FIELDS = (
    Field("ground.stiffness", "N/m", 1e5, 1e13, "stiffness_N_per_m"),
    Field("ground.damping", "N s/m", 0.0, 1e9, "damping_N_s_per_m"),
    Field("ground.mass", "kg", 0.0, 1e5, "mass_kg"),
)
"""Numbers of the ground under a support."""

AXLE_FIELDS = (
    Field("axle_position", "m", -30.0, 30.0, "axle_positions_m"),
    Field("speed", "m/s", 1.0, 150.0, "speed_m_per_s"),
)
"""Numbers of the axles: position of each, in a list, and speed."""

_HALF_SPACE_FIELDS = (
    Field("radius", "m", 0.01, 10.0, "radius_m"),
    Field("shear_modulus", "Pa", 1e5, 1e12, "shear_modulus_Pa"),
    Field("poissons_ratio", "", 0.0, 0.5, "poissons_ratio"),
    Field("density", "kg/m3", 100.0, 1e4, "density_kg_per_m3"),
)

RANGES = {
    each.name: (each.low, each.high, each.unit)
    for each in (
        *RAIL_FIELDS,
        *DESIGN_FIELDS,
        *STATIC_FIELDS,
        WHEELBASE,
        *SUSPENSION_FIELDS,
        *GROUND_FIELDS,
        *AXLE_FIELDS,
        *_HALF_SPACE_FIELDS,
    )
}
"""Lowest and highest value, and unit, of each number by name."""

SLIDER_RANGES = {
    "pad_stiffness": (10e6, 2000e6),
    "pad_loss_factor": (0.01, 0.5),
    "block_mass": (10.0, 500.0),
    "boot_stiffness": (2e6, 200e6),
    "boot_loss_factor": (0.01, 0.5),
    "fastener_spacing": (0.2, 1.0),
    "wheel_mass": (200.0, 1500.0),
    "contact_stiffness": (200e6, 5000e6),
}
"""Lowest and highest value of each number that a designer chooses from [SI]: what sliders offer."""

AROUND_RANGES = {
    "suspension.primary_stiffness": (300e3, 6e6),
    "suspension.primary_damping": (1e3, 100e3),
    "suspension.bogie_mass": (200.0, 15e3),
    "suspension.secondary_stiffness": (50e3, 2e6),
    "suspension.secondary_damping": (1e3, 100e3),
    "suspension.body_mass": (1e3, 15e3),
    "speed": (5.0, 100.0),
    "ground.stiffness": (10e6, 10e9),
    "ground.damping": (10e3, 5e6),
    "ground.mass": (1.0, 500.0),
}
"""The same of each number of what stands on and under a track [SI]: from vehicles softly sprung to laden
wagons, from less than soft clay to more than rock."""

SEARCHED_RANGES = SLIDER_RANGES | AROUND_RANGES
"""What is searched of each number unless other ranges are given [SI]."""

GIVEN = (
    {"wheel_mass": "vehicle", "contact_stiffness": "wheel and rail", "speed": "vehicle"}
    | {each.name: "vehicle" for each in SUSPENSION_FIELDS}
    | {each.name: "site" for each in GROUND_FIELDS}
)
"""Whose each number is that a track's supplier does not choose, by name."""

SCATTERED = (*SLIDER_RANGES, "pad_static_stiffness", "boot_static_stiffness", *AROUND_RANGES)
"""Numbers of a design that scatter, and that may be changed by a share of themselves."""


class DesignError(ValueError):
    """A design has a value that no track can have.

    Attributes
    ----------
    field : str
        Name of the field at fault.
    value : object
        The value that was given.
    allowed : str
        What may be given instead.
    row : int or tuple of int or None
        Place of the design among many; None when there is but one.
    """

    def __init__(
        self, field: str, value: object, allowed: str, row: int | tuple[int, ...] | None = None
    ) -> None:
        self.field, self.value, self.allowed, self.row = field, value, allowed, row
        message = f"{field} = {brief(value)}: give {allowed}"
        super().__init__(message if row is None else f"row {row}: {message}")

    def __reduce__(self) -> tuple[type, tuple[str, object, str, int | tuple[int, ...] | None]]:
        """Let the error pass between processes."""
        return type(self), (self.field, self.value, self.allowed, self.row)


def check_number(field: str, value: object) -> float:
    """Return ``value`` as a float if it is a number within the range of ``field``.

    Parameters
    ----------
    field : str
        A key of :data:`RANGES`.
    value : object
        Anything a caller may have given.

    Returns
    -------
    float
        The value [unit of the field].

    Raises
    ------
    DesignError
        If it is not a real, finite number within the range (a bool is not a number).
    """
    low, high, unit = RANGES[field]
    allowed = f"a number from {low:g} to {high:g} {unit}".rstrip()
    if not isinstance(value, numbers.Real) or isinstance(value, bool):
        raise DesignError(field, value, allowed)
    try:
        number = float(value)
    except OverflowError:
        raise DesignError(field, value, allowed) from None
    if not (math.isfinite(number) and low <= number <= high):
        raise DesignError(field, value, allowed)
    return number


def amount(field: str, value: float, figures: int = 4) -> str:
    """Return a value of a field with its unit, such as ``"10.85 kN/mm"``.

    Parameters
    ----------
    field : str
        A key of :data:`RANGES`.
    value : float
        Value [unit of the field].
    figures : int
        Figures that are shown [-].

    Returns
    -------
    str
        The value in words.
    """
    return quantity(value, RANGES[field][2], figures)


def values_in_words(values: Mapping[str, object]) -> list[str]:
    """Return what fields are called and their values with units, of those that there are (list of str).

    Parameters
    ----------
    values : mapping
        Values by field, or by path of a number of suspension or ground [unit of the field].

    Returns
    -------
    list of str
        Such as ``["boot stiffness 28 kN/mm"]``; what is no number says itself what it is,
        in brackets if that takes commas.
    """
    texts = {
        name: amount(name, value) if isinstance(value, float) else str(value)
        for name, value in values.items()
        if value is not None
    }
    return [
        f"{name.replace('.', ' ').replace('_', ' ')} {f'({text})' if ',' in text else text}"
        for name, text in texts.items()
    ]
