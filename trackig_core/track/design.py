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
from dataclasses import dataclass
from typing import Any

from trackig_core.track.fields import RANGES as RANGES
from trackig_core.track.fields import DesignError as DesignError
from trackig_core.track.fields import check_number
from trackig_core.track.measured_curves import LossFactorCurve, StiffnessCurve
from trackig_core.track.rails import PAPER_RAIL, RAILS
from trackig_core.track.rails import Rail as Rail

REFERENCE_FREQUENCY = 50.0
"""Frequency at which a pad's or boot's dynamic stiffness is stated unless the design says otherwise [Hz]; the
paper, section on damping."""

DEFAULT_STEP = 1e-4
"""Step of roughness that squeezes the contact spring [m]; insertion gain does not depend on it."""


def measured_curves(design: "TrackDesign") -> dict[str, StiffnessCurve | LossFactorCurve]:
    """Return what a design has as measured over frequency (dict of curves), by field."""
    values = {each.name: getattr(design, each.name) for each in dataclasses.fields(design)}
    return {name: each for name, each in values.items() if isinstance(each, StiffnessCurve | LossFactorCurve)}


@dataclass(frozen=True, kw_only=True)
class TrackDesign:
    """One wheel on one rail on a row of equal supports on rigid ground.

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
        for field in ("pad_static_stiffness", "boot_static_stiffness"):
            if getattr(self, field) is not None:
                self._check(field)

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

    @property
    def two_stage(self) -> bool:
        """Whether blocks and boots stand between pads and ground."""
        return self.block_mass is not None

    def replace(self, **changes: Any) -> "TrackDesign":
        """Return a copy of this design with some fields changed.

        Parameters
        ----------
        **changes
            New values by field name [unit of the field]. A static stiffness leaves with its boot.

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
        if changes.get("boot_stiffness", self.boot_stiffness) is None:
            changes.setdefault("boot_static_stiffness", None)
        return dataclasses.replace(self, **changes)
