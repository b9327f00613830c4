"""What softness costs: how far a standing wheel sinks the rail, and what it puts on the supports.

The same three rail elements a bay, at rest, on the static stiffness of pad and boot, solved in closed form on
the infinite track. SI units; deflection and load are positive towards the ground, the bending moment is
positive where the rail sags.

Static and dynamic stiffness are different measurements (EN 13146-9 and EN 17495), and the static one is
lower. Where it is not stated the dynamic stiffness stands in, and the result says that the rail sinks *at
least* so far. The damping law's own limit at zero frequency is no substitute: it extrapolates a fit.

The check of the whole is Zimmermann's beam on a continuous foundation (H. Zimmermann, *Die Berechnung des
Eisenbahnoberbaues*, 1888).
"""

import math
import numbers
from dataclasses import dataclass, field

import numpy as np

from trackig_core.arrays import IntArray, RealArray
from trackig_core.frequency_domain.floquet_waves import Waves
from trackig_core.frequency_domain.point_force import RailWaves
from trackig_core.frequency_domain.static_lattice import (
    ELEMENTS_PER_BAY,
    bending_stiffness,
    static_waves,
    support_stiffness,
)
from trackig_core.levels.specification import Specification
from trackig_core.names import brief
from trackig_core.track.design import TrackDesign
from trackig_core.track.fields import DEFAULT_WHEEL_LOAD, check_number
from trackig_core.track.static_stiffness import static_stiffnesses, unstated
from trackig_core.words import quantity

LONGEST_WHEELBASE = 100.0
"""Greatest distance between two wheels [m]."""

DIED_AWAY = 1e-9
"""Part of the deflection under the wheel at which the line along the track ends [-]."""


@dataclass(frozen=True, eq=False)
class StaticResponse:
    """A track under one or two standing wheels.

    Attributes
    ----------
    wheel_load : float [N]
        Load of each wheel.
    wheelbase : float or None [m]
        Distance between the wheels, rounded to the nearest rail element; None with one wheel.
    pad_stiffness, boot_stiffness : float, float or None [N/m]
        Static stiffnesses that were used; ``boot_stiffness`` is None when single-stage.
    unstated : tuple of str
        Which of ``"pad"`` and ``"boot"`` have no static stiffness stated, so that the dynamic one stands in.
    rail_deflection : float [m]
        Deflection of the rail under the first wheel.
    largest_rail_deflection : float [m]
        Largest deflection of the rail, wherever between the supports the wheels stand.
    largest_seat_load : float [N]
        Largest load on a support.
    pad_compression, boot_compression : float, float or None [m]
        Compression of pad and boot under that load; ``boot_compression`` is None when single-stage.
    largest_uplift : float [m]
        How far the rail rises where it rises most.
    largest_bending_moment : float [N m]
        Largest bending moment of the rail; it sags there.
    position : numpy.ndarray (elements,) [m]
        Rail elements, counted from the first wheel.
    deflection : numpy.ndarray (elements,) [m]
        Deflection of the rail there.
    bending_moment : numpy.ndarray (elements,) [N m]
        Bending moment of the rail there, positive where it sags.
    support_position : numpy.ndarray (supports,) [m]
        Supports, counted from the first wheel.
    seat_load : numpy.ndarray (supports,) [N]
        Load on each support; below zero where the rail lifts.
    """

    wheel_load: float
    wheelbase: float | None
    pad_stiffness: float
    boot_stiffness: float | None
    unstated: tuple[str, ...]
    rail_deflection: float
    largest_rail_deflection: float
    largest_seat_load: float
    pad_compression: float
    boot_compression: float | None
    largest_uplift: float
    largest_bending_moment: float
    position: RealArray = field(repr=False)
    deflection: RealArray = field(repr=False)
    bending_moment: RealArray = field(repr=False)
    support_position: RealArray = field(repr=False)
    seat_load: RealArray = field(repr=False)

    @property
    def seat_load_share(self) -> float:
        """Largest load on a support over the load of one wheel [-]."""
        return self.largest_seat_load / self.wheel_load

    @property
    def at_least(self) -> bool:
        """Whether the rail sinks at least so far: a dynamic stiffness stands in for a static one."""
        return bool(self.unstated)

    def __str__(self) -> str:
        """Return deflection, loads and compressions with their units."""
        at_least = "at least " if self.at_least else ""
        wheels = quantity(self.wheel_load, "N", 3)
        if self.wheelbase is not None:
            wheels = f"two wheels of {wheels}, {quantity(self.wheelbase, 'm')} apart"
        else:
            wheels = f"one wheel of {wheels}"
        figures = {
            "seat load": quantity(self.largest_seat_load, "N", 3),
            "pad compression": quantity(self.pad_compression, "m", 3),
            "boot compression": None
            if self.boot_compression is None
            else quantity(self.boot_compression, "m", 3),
            "uplift": quantity(self.largest_uplift, "m", 3),
            "bending moment": quantity(self.largest_bending_moment, "N m", 3),
        }
        words = ", ".join(f"{name} {each}" for name, each in figures.items() if each is not None)
        stands_in = (
            f"; no static stiffness is stated of the {' and the '.join(self.unstated)}" if at_least else ""
        )
        sinks = quantity(self.rail_deflection, "m", 3)
        return f"rail deflection {at_least}{sinks} under {wheels}, {words}{stands_in}"


def static_response(
    design: TrackDesign,
    wheel_load: float = DEFAULT_WHEEL_LOAD,
    wheelbase: float | None = None,
    *,
    wheel_element: int = 0,
) -> StaticResponse:
    """Return how a track carries one or two standing wheels.

    Parameters
    ----------
    design : TrackDesign
        The track.
    wheel_load : float
        Load of each wheel [N].
    wheelbase : float, optional
        Distance to a second wheel [m], rounded to the nearest rail element; by default there is one wheel.
    wheel_element : int
        Rail element on which the first wheel stands: 0 over a support, 1 or 2 a third or two thirds of a
        spacing beyond it.

    Returns
    -------
    StaticResponse
        Deflections, loads and compressions, in less than a millisecond.

    Raises
    ------
    DesignError
        If the load is not a number from 1 kN to 1 MN.
    ValueError
        If the wheelbase is less than one rail element or more than 100 m, or there is no such element.
    """
    load = check_number("wheel_load", wheel_load)
    dx = design.fastener_spacing / ELEMENTS_PER_BAY
    apart = None if wheelbase is None else _elements_apart(wheelbase, dx)
    if wheel_element not in range(ELEMENTS_PER_BAY) or not isinstance(wheel_element, numbers.Integral):
        raise ValueError(f"wheel_element = {brief(wheel_element)}: give 0 (over a support), 1 or 2")
    pad, boot = static_stiffnesses(design)
    support = float(support_stiffness(pad, boot))
    bending = float(bending_stiffness(design.rail.bending_stiffness, design.fastener_spacing))
    rail = _Line(design, support / bending)
    offsets = (0,) if apart is None else (0, apart)
    first, last = -rail.reach, offsets[-1] + wheel_element + rail.reach
    elements = np.arange(first * ELEMENTS_PER_BAY, ELEMENTS_PER_BAY * (last + 1))
    around = np.arange(
        -ELEMENTS_PER_BAY, offsets[-1] + 2 * ELEMENTS_PER_BAY
    )  # the wheels, wherever they stand
    line = load / bending * rail.deflection(wheel_element, offsets, elements)
    worst = max(rail.deflection(start, offsets, around).max() for start in range(ELEMENTS_PER_BAY))
    seats = support * line[::ELEMENTS_PER_BAY]
    moment = np.zeros_like(line)
    moment[1:-1] = -bending * dx * np.diff(line, 2)
    position = (elements - wheel_element) * dx
    largest_seat_load = float(seats.max())
    return StaticResponse(
        wheel_load=load,
        wheelbase=None if apart is None else apart * dx,
        pad_stiffness=pad,
        boot_stiffness=boot,
        unstated=unstated(design),
        rail_deflection=float(line[np.searchsorted(elements, wheel_element)]),
        largest_rail_deflection=float(load / bending * worst),
        largest_seat_load=largest_seat_load,
        pad_compression=largest_seat_load / pad,
        boot_compression=None if boot is None else largest_seat_load / boot,
        largest_uplift=max(0.0, -float(line.min())),
        largest_bending_moment=float(moment.max()),
        position=position,
        deflection=line,
        bending_moment=moment,
        support_position=position[::ELEMENTS_PER_BAY],
        seat_load=seats,
    )


def limited_deflection(specification: Specification | None, design: TrackDesign) -> float | None:
    """Return the rail deflection that a specification limits, for :meth:`Specification.check`.

    Parameters
    ----------
    specification : Specification or None
        What the track has to meet.
    design : TrackDesign
        The track.

    Returns
    -------
    float or None
        Deflection under the specification's wheel load, over a support [m]; None if it is not limited.
    """
    if specification is None or specification.rail_deflection_limit is None:
        return None
    return static_response(design, specification.wheel_load).rail_deflection


def zimmermann_deflection(design: TrackDesign, wheel_load: float = DEFAULT_WHEEL_LOAD) -> float:
    """Return how far one wheel sinks the rail if the supports are smeared out: Zimmermann's formula.

    Parameters
    ----------
    design : TrackDesign
        The track.
    wheel_load : float
        Load of the wheel [N].

    Returns
    -------
    float
        Q beta / (2 k'), beta = (k' / 4 EI)^(1/4), k' the static stiffness of a support over the spacing [m].

    Raises
    ------
    DesignError
        If the load is not a number from 1 kN to 1 MN.
    """
    foundation = float(support_stiffness(*static_stiffnesses(design))) / design.fastener_spacing
    beta = (foundation / (4 * design.rail.bending_stiffness)) ** 0.25
    return float(check_number("wheel_load", wheel_load) * beta / (2 * foundation))


def _elements_apart(wheelbase: float, dx: float) -> int:
    """Return the distance of two wheels in rail elements, or raise a ValueError."""
    allowed = f"a distance from one rail element, {dx:.3g} m, to {LONGEST_WHEELBASE:g} m"
    if not isinstance(wheelbase, numbers.Real) or isinstance(wheelbase, bool):
        raise ValueError(f"wheelbase = {brief(wheelbase)}: give None or {allowed}")
    if not dx / 2 < wheelbase <= LONGEST_WHEELBASE:
        raise ValueError(f"wheelbase = {brief(wheelbase)} m: give {allowed}")
    return max(1, round(wheelbase / dx))


class _Line:
    """Deflection of the rail under unit loads, EI/dx^3 being one, wherever they stand."""

    def __init__(self, design: TrackDesign, stiffness: float) -> None:
        multipliers, amplitudes = static_waves([stiffness])
        at_rest, support = np.zeros(1), np.array([stiffness], dtype=complex)
        self._waves = RailWaves.of(
            design, Waves(at_rest, at_rest, multipliers, amplitudes, support, None), ELEMENTS_PER_BAY
        )
        self.reach = 2 + math.ceil(math.log(DIED_AWAY) / math.log(np.abs(multipliers).max()))

    def deflection(self, first: int, offsets: tuple[int, ...], elements: IntArray) -> RealArray:
        """Return the deflection of elements under wheels at offsets from an element (elements,) [-]."""
        wheels = [self._waves.receptance(elements, first + offset) for offset in offsets]
        return np.sum(wheels, axis=0)[:, 0].real
