"""A track as its designer names it: one rail, one wheel, and a row of supports.

SI units: N/m, kg, m, N m2; loss factors have no unit. Stiffnesses are dynamic stiffnesses at
50 Hz. Source of the model: Thornely-Taylor, Bewes and Sica (2021), "A simplified model for
calculating the insertion gain of track support systems using the finite difference method".

The one rule: a design that exists is valid. Every value is checked when the object is made, the
objects never change, and equal designs are equal keys.
"""

import dataclasses
import difflib
import math
import numbers
from dataclasses import dataclass

from trackig_core.names import allowed, brief, is_name
from trackig_core.track.measured_curves import LossFactorCurve, StiffnessCurve

REFERENCE_FREQUENCY = 50.0
"""Frequency at which a pad's or boot's dynamic stiffness is stated [Hz]; the paper, section on damping."""

DEFAULT_STEP = 1e-4
"""Step of roughness that squeezes the contact spring [m]; insertion gain does not depend on it."""

RANGES = {
    "mass_per_metre": (10.0, 200.0, "kg/m"),
    "bending_stiffness": (1e5, 1e8, "N m2"),
    "pad_stiffness": (1e5, 1e13, "N/m"),
    "pad_loss_factor": (0.0, 1.0, ""),
    "block_mass": (1.0, 1e4, "kg"),
    "boot_stiffness": (1e5, 1e13, "N/m"),
    "boot_loss_factor": (0.0, 1.0, ""),
    "fastener_spacing": (0.1, 2.0, "m"),
    "wheel_mass": (10.0, 1e4, "kg"),
    "contact_stiffness": (1e6, 1e14, "N/m"),
}
"""Lowest and highest value, and unit, of each number: wide enough for any support that has been built and
for the very stiff tracks that stand in for a rigid one, narrow enough to catch a slip of units."""


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

    def __init__(self, field, value, allowed, row=None):
        self.field, self.value, self.allowed, self.row = field, value, allowed, row
        message = f"{field} = {brief(value)}: give {allowed}"
        super().__init__(message if row is None else f"row {row}: {message}")

    def __reduce__(self):
        """Let the error pass between processes."""
        return type(self), (self.field, self.value, self.allowed, self.row)


def check_number(field, value):
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

    def __post_init__(self):
        """Check every value once."""
        if not is_name(self.name):
            raise DesignError("name", self.name, allowed())
        for field in ("mass_per_metre", "bending_stiffness"):
            object.__setattr__(self, field, check_number(field, getattr(self, field)))


PAPER_RAIL = Rail("60", mass_per_metre=60.0, bending_stiffness=210e9 * 3038e-8)
"""The paper's rail: 60 kg/m (Table 1) with the second moment of 60E1, 3038 cm4, and E = 210 GPa."""


@dataclass(frozen=True, kw_only=True)
class TrackDesign:
    """One wheel on one rail on a row of equal supports on rigid ground.

    A two-stage track has pads, blocks (or sleeper ends) and boots; a single-stage track has pads
    only, and None for ``block_mass``, ``boot_stiffness`` and ``boot_loss_factor``.

    Parameters
    ----------
    pad_stiffness : float or StiffnessCurve
        Dynamic stiffness of a rail pad at 50 Hz [N/m], or as measured over frequency.
    pad_loss_factor : float or LossFactorCurve or None
        Loss factor of the rail pad [-], or as measured over frequency; None with a StiffnessCurve, which
        has its own.
    block_mass : float or None
        Mass of a block or sleeper end [kg].
    boot_stiffness : float or StiffnessCurve or None
        Dynamic stiffness of a boot at 50 Hz [N/m], or as measured over frequency.
    boot_loss_factor : float or LossFactorCurve or None
        Loss factor of the boot, as for the pad.
    fastener_spacing : float
        Distance between supports [m].
    wheel_mass : float
        Unsprung mass on one rail [kg].
    rail : Rail
        Rail section.
    contact_stiffness : float
        Linearised Hertzian contact stiffness [N/m].

    Raises
    ------
    DesignError
        If a value is not a number within its range, or a block comes without a boot.
    """

    pad_stiffness: float | StiffnessCurve
    pad_loss_factor: float | LossFactorCurve | None
    block_mass: float | None = None
    boot_stiffness: float | StiffnessCurve | None = None
    boot_loss_factor: float | LossFactorCurve | None = None
    fastener_spacing: float
    wheel_mass: float
    rail: Rail = PAPER_RAIL
    contact_stiffness: float = 1.2e9

    def __post_init__(self):
        """Check every value once."""
        self._check_stages()
        if not isinstance(self.rail, Rail):
            raise DesignError("rail", self.rail, "a Rail, such as RAILS['60']")
        for field in ("fastener_spacing", "wheel_mass", "contact_stiffness"):
            self._check(field)
        self._check_spring("pad")
        if self.two_stage:
            self._check("block_mass")
            self._check_spring("boot")

    def _check(self, field):
        object.__setattr__(self, field, check_number(field, getattr(self, field)))

    def _check_spring(self, part):
        """Check stiffness and loss factor of the pad or the boot."""
        stiffness, loss_factor = f"{part}_stiffness", f"{part}_loss_factor"
        if isinstance(getattr(self, stiffness), StiffnessCurve):
            if getattr(self, loss_factor) is not None:
                allowed = f"None: the measured {part} stiffness has loss factors of its own"
                raise DesignError(loss_factor, getattr(self, loss_factor), allowed)
            return
        self._check(stiffness)
        if not isinstance(getattr(self, loss_factor), LossFactorCurve):
            self._check(loss_factor)

    def _check_stages(self):
        """Check that block and boot come together or not at all."""
        given = {field: getattr(self, field) is not None for field in ("block_mass", "boot_stiffness")}
        if any(given.values()) or self.boot_loss_factor is not None:
            given["boot_loss_factor"] = self.boot_loss_factor is not None or isinstance(
                self.boot_stiffness, StiffnessCurve
            )
        if any(given.values()) and not all(given.values()):
            missing = next(field for field, is_given in given.items() if not is_given)
            others = " and ".join(field for field, is_given in given.items() if is_given)
            together = "block mass, boot stiffness and boot loss factor come together"
            raise DesignError(missing, None, f"a value too, or leave out {others}: {together}")

    @property
    def two_stage(self) -> bool:
        """Whether blocks and boots stand between pads and ground."""
        return self.block_mass is not None

    def replace(self, **changes):
        """Return a copy of this design with some fields changed.

        Parameters
        ----------
        **changes
            New values by field name [unit of the field].

        Returns
        -------
        TrackDesign
            The changed, newly checked design.

        Raises
        ------
        DesignError
            If a field does not exist or a value is not allowed.
        """
        names = [each.name for each in dataclasses.fields(self)]
        for field, value in changes.items():
            if field not in names:
                near = difflib.get_close_matches(field, names, n=1)
                hint = f"'{near[0]}'" if near else f"one of {', '.join(names)}"
                raise DesignError(field, value, f"a field that exists: {hint}")
        return dataclasses.replace(self, **changes)
