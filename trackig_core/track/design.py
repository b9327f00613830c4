"""A track as its designer names it: one rail, one wheel, and a row of supports.

SI units: N/m, kg, m, N m2; loss factors have no unit. Stiffnesses are dynamic stiffnesses at
50 Hz unless the design states another frequency. Source of the model: Thornely-Taylor, Bewes and Sica
(2021), "A simplified model for calculating the insertion gain of track support systems using the finite
difference method".

A design that exists is valid: every value is checked when the object is made, the objects never change, and
equal designs are equal keys.
"""

import dataclasses
import difflib
import numbers
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

from trackig_core.track.fields import RANGES as RANGES
from trackig_core.track.fields import DesignError as DesignError
from trackig_core.track.fields import check_number, values_in_words
from trackig_core.track.ground import Ground as Ground
from trackig_core.track.measured_curves import LossFactorCurve, StiffnessCurve
from trackig_core.track.rails import PAPER_RAIL, RAILS
from trackig_core.track.rails import Rail as Rail
from trackig_core.track.vehicle import Suspension as Suspension

REFERENCE_FREQUENCY = 50.0
"""Frequency at which a pad's or boot's dynamic stiffness is stated unless the design says otherwise [Hz]; the
paper, section on damping."""

ONE_AXLE = (0.0,)
"""Positions of the axles [m] of which there is but one, over support 0."""

MOST_AXLES = 8
"""Axles that a design may have [-]: two cars' bogies that face each other."""

LONGEST_DELAY = 4.0
"""Longest time after which the last axle may follow the first over the same roughness [s]: a record must last
longer, and a spectrum show fringes as narrow as its inverse."""

ELEMENTS_PER_BAY = 3
"""Rail elements between supports [-]; the paper. Axles stand on elements."""

STATIC_STIFFNESSES = ("pad_static_stiffness", "boot_static_stiffness")
"""Fields on which nothing depends but the static response."""

DEFAULT_STEP = 1e-4
"""Step of roughness that squeezes the contact spring [m]; insertion gain does not depend on it."""


def check_axles(positions: object, spacing: float) -> tuple[float, ...]:
    """Return the positions of axles as floats if each has a rail element of its own.

    Parameters
    ----------
    positions : object
        Anything a caller may have given for positions [m].
    spacing : float
        Distance between supports [m].

    Returns
    -------
    tuple of float
        Positions [m].

    Raises
    ------
    DesignError
        If they are no numbers, too many, out of range, or closer than rail elements.
    """
    if positions is ONE_AXLE:
        return ONE_AXLE
    allowed = f"1 to {MOST_AXLES} positions in m, such as (0.0, 2.4)"
    if isinstance(positions, str | numbers.Number) or not isinstance(positions, Iterable):
        raise DesignError("axle_positions", positions, allowed)
    numbered = tuple(positions)
    if not 1 <= len(numbered) <= MOST_AXLES:
        raise DesignError("axle_positions", numbered, allowed)
    try:
        checked = tuple(check_number("axle_position", each) for each in numbered)
    except DesignError as error:
        raise DesignError("axle_positions", numbered, f"positions, each {error.allowed}") from None
    if len(set(axle_elements(checked, spacing))) < len(checked):
        apart = f"positions of which no two fall on the same rail element, {spacing / ELEMENTS_PER_BAY:.3g} m"
        raise DesignError("axle_positions", checked, apart)
    return checked


PATHS = tuple(name for name in RANGES if "." in name)
"""Paths of the numbers of a design's suspension and ground, such as ``"ground.stiffness"``."""


def numbers_by_part(values: Mapping[str, Any]) -> dict[str, dict[str, Any]]:
    """Return the values that are given by path, by part of a design and then by number."""
    found: dict[str, dict[str, Any]] = {}
    for path, value in values.items():
        part, _, number = path.partition(".")
        if number:
            found.setdefault(part, {})[number] = value
    return found


def with_numbers(whole: Any, part: str, numbers: Mapping[str, Any]) -> Any:
    """Return a suspension or a ground with some of its numbers changed.

    Parameters
    ----------
    whole : Suspension or Ground or None
        What the design has.
    part : str
        The design's field.
    numbers : dict
        Values by name of a number [its unit].

    Returns
    -------
    Suspension or Ground
        The changed, newly checked part.

    Raises
    ------
    DesignError
        If the design has no such part, or a value is not allowed.
    """
    if whole is None:
        number, value = next(iter(numbers.items()))
        raise DesignError(f"{part}.{number}", value, f"a {part} too: the design has none")
    return dataclasses.replace(whole, **numbers)


def axle_elements(positions: Iterable[float], spacing: float) -> tuple[int, ...]:
    """Return the rail elements nearest to positions [m], three to a bay, 0 over support 0."""
    return tuple(round(each * ELEMENTS_PER_BAY / spacing) for each in positions)


def measured_curves(design: "TrackDesign") -> dict[str, StiffnessCurve | LossFactorCurve]:
    """Return what a design has as measured over frequency (dict of curves), by field."""
    values = {each.name: getattr(design, each.name) for each in dataclasses.fields(design)}
    return {name: each for name, each in values.items() if isinstance(each, StiffnessCurve | LossFactorCurve)}


@dataclass(frozen=True, kw_only=True)
class TrackDesign:
    """Wheels on one rail on a row of equal supports: by default one wheel, and rigid ground.

    A two-stage track has pads, blocks (or sleeper ends) and boots; a single-stage track has pads
    only, and None for ``block_mass``, ``boot_stiffness`` and ``boot_loss_factor``.

    Parameters
    ----------
    pad_stiffness : float or StiffnessCurve
        Dynamic stiffness of a rail pad at the stiffness frequency [N/m], or as measured over frequency.
    pad_loss_factor : float or LossFactorCurve or None
        Loss factor of the rail pad [-], or as measured over frequency; None with a StiffnessCurve, which
        has its own.
    block_mass : float or None
        Mass of a block or sleeper end [kg].
    boot_stiffness : float or StiffnessCurve or None
        Dynamic stiffness of a boot at the stiffness frequency [N/m], or as measured over frequency.
    boot_loss_factor : float or LossFactorCurve or None
        Loss factor of the boot, as for the pad.
    fastener_spacing : float
        Distance between supports [m].
    wheel_mass : float
        Unsprung mass on one rail [kg].
    rail : Rail
        Rail section; the name of one of ``RAILS`` stands for it.
    contact_stiffness : float
        Linearised Hertzian contact stiffness [N/m].
    pad_static_stiffness, boot_static_stiffness : float or None
        Static stiffness of a rail pad and of a boot [N/m]; None if it is not stated. Nothing but statics
        depends on them.
    stiffness_frequency : float
        Frequency at which the dynamic stiffnesses hold that are numbers [Hz]: 50 Hz in the paper, 10 Hz or
        20 Hz in many test reports (DIN 45673-5).
    suspension : Suspension or None
        What every wheel carries; None: nothing but its unsprung mass.
    axle_positions : iterable of float
        Where the wheels stand, from support 0 on [m]; solvers round them to rail elements.
    speed : float or None
        Speed at which the wheels follow each other over the same roughness, each with the delay of its
        position [m/s]; None: their roughness is independent. It does not matter for one wheel.
    ground : Ground or None
        What the supports stand on; None: rigid ground.

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
    pad_static_stiffness: float | None = None
    boot_static_stiffness: float | None = None
    stiffness_frequency: float = REFERENCE_FREQUENCY
    suspension: Suspension | None = None
    axle_positions: tuple[float, ...] = ONE_AXLE
    speed: float | None = None
    ground: Ground | None = None

    def __post_init__(self) -> None:
        """Check every value once."""
        self._check_stages()
        if isinstance(self.rail, str) and self.rail in RAILS:
            object.__setattr__(self, "rail", RAILS[self.rail])
        if not isinstance(self.rail, Rail):
            raise DesignError("rail", self.rail, f"a Rail, or the name of one: {', '.join(RAILS)}")
        for field in ("fastener_spacing", "wheel_mass", "contact_stiffness", "stiffness_frequency"):
            self._check(field)
        self._check_spring("pad")
        if self.two_stage:
            self._check("block_mass")
            self._check_spring("boot")
        elif self.boot_static_stiffness is not None:
            raise DesignError("boot_static_stiffness", self.boot_static_stiffness, "None: there is no boot")
        for field in STATIC_STIFFNESSES:
            if getattr(self, field) is not None:
                self._check(field)
        self._check_surroundings()

    def _check(self, field: str) -> None:
        object.__setattr__(self, field, check_number(field, getattr(self, field)))

    def _check_spring(self, part: str) -> None:
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

    def _check_stages(self) -> None:
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

    def _check_surroundings(self) -> None:
        """Check vehicle, axles and ground."""
        for field, kind in (("suspension", Suspension), ("ground", Ground)):
            value = getattr(self, field)
            if value is not None and not isinstance(value, kind):
                raise DesignError(field, value, f"None or a {kind.__name__}")
        object.__setattr__(self, "axle_positions", check_axles(self.axle_positions, self.fastener_spacing))
        if self.speed is not None:
            self._check("speed")
            span = max(self.axle_positions) - min(self.axle_positions)
            if span > LONGEST_DELAY * self.speed:
                allowed = (
                    f"{span / LONGEST_DELAY:.3g} m/s or more, or None: axles that pass a place more than "
                    f"{LONGEST_DELAY:g} s apart are as good as independent"
                )
                raise DesignError("speed", self.speed, allowed)

    @property
    def simplified(self) -> "TrackDesign":
        """The paper's simplified model of it: one wheel over a support, unsprung mass only, rigid ground."""
        if self.one_unsprung_wheel and self.ground is None:
            return self
        return dataclasses.replace(self, suspension=None, axle_positions=ONE_AXLE, speed=None, ground=None)

    @property
    def without_statics(self) -> "TrackDesign":
        """The design without its static stiffnesses and preloads, on which no vibration depends."""
        changes: dict[str, Any] = dict.fromkeys(STATIC_STIFFNESSES)
        changes |= {
            name: curve.without_preload
            for name, curve in measured_curves(self).items()
            if isinstance(curve, StiffnessCurve)
        }
        if all(getattr(self, name) is value for name, value in changes.items()):
            return self
        return dataclasses.replace(self, **changes)

    @property
    def one_unsprung_wheel(self) -> bool:
        """Whether one wheel without suspension stands over a support."""
        return self.suspension is None and self.axle_positions == ONE_AXLE

    @property
    def two_stage(self) -> bool:
        """Whether blocks and boots stand between pads and ground."""
        return self.block_mass is not None

    def value(self, name: str) -> Any:
        """Return a field, or a number of the suspension or the ground.

        Parameters
        ----------
        name : str
            Name of a field, or path of a number, such as ``"suspension.bogie_mass"``.

        Returns
        -------
        object
            The value [unit of the field]; None where the design has no such part.

        Raises
        ------
        DesignError
            If there is no such field or number.
        """
        self._check_name(name, None)
        field, _, number = name.partition(".")
        found = getattr(self, field)
        return getattr(found, number) if number and found is not None else found

    def _check_name(self, name: str, value: object) -> None:
        """Raise a DesignError if a name is none of a field or of a part's number."""
        fields = [each.name for each in dataclasses.fields(self)]
        if name not in fields and name not in PATHS:
            near = difflib.get_close_matches(name, [*fields, *PATHS], n=1)
            hint = f"'{near[0]}'" if near else f"one of {', '.join((*fields, *PATHS))}"
            raise DesignError(name, value, f"a field that exists: {hint}")

    def replace(self, **changes: Any) -> "TrackDesign":
        """Return a copy of this design with some fields changed.

        Parameters
        ----------
        **changes
            New values by field name, or by path of a number of the suspension or the ground, as in
            ``replace(**{"ground.stiffness": 100e6})`` [unit of the field]. A static stiffness leaves with its
            boot.

        Returns
        -------
        TrackDesign
            The changed, newly checked design.

        Raises
        ------
        DesignError
            If a field does not exist, a value is not allowed, or the design has no part with such a number.
        """
        for name, value in changes.items():
            self._check_name(name, value)
        for part, values in numbers_by_part(changes).items():
            for number in values:
                del changes[f"{part}.{number}"]
            changes[part] = with_numbers(changes.get(part, getattr(self, part)), part, values)
        if changes.get("boot_stiffness", self.boot_stiffness) is None:
            changes.setdefault("boot_static_stiffness", None)
        return dataclasses.replace(self, **changes)

    def __str__(self) -> str:
        """Return all that there is, with its units."""
        given = {each.name: getattr(self, each.name) for each in dataclasses.fields(self)}
        given["axle_positions"] = None
        words = values_in_words(given)
        if self.axle_positions != ONE_AXLE:
            words.append(f"axles at {' and '.join(f'{each:g}' for each in self.axle_positions)} m")
        return ", ".join(words)
