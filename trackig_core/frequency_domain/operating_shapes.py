"""The steady shape: how rail, blocks and wheel move at one frequency, by the frequency-domain solution.

Complex displacements per unit roughness, time dependence exp(+i w t), positive towards the ground: at the
phase angle p the track stands at Re(displacement exp(i p)). SI units and Hz. Source of the model: the
paper (see :mod:`trackig_core.track.design`).

Between supports each of the two waves of :mod:`trackig_core.frequency_domain.floquet_waves` obeys the free
rail,

    u[i-2] - 4 u[i-1] + 6 u[i] - 4 u[i+1] + u[i+2] = r^2 u[i],    r^2 = m w^2 / (EI/dx^3),

with u[i + elements] = multiplier u[i] from bay to bay: as many linear equations as there are elements
between two supports. The solution decays from the wheel outwards, and two waves are all that decay. No
element is interpolated.
"""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

from trackig_core.arrays import ComplexArray, RealArray
from trackig_core.frequency_domain.axles import (
    LoadedRail,
    bay_shapes,
    contact_forces,
    loaded_rail,
    wheel_elements,
)
from trackig_core.frequency_domain.floquet_waves import Waves, contact_force, waves
from trackig_core.frequency_domain.lattice import INFINITE, Lattice
from trackig_core.frequency_domain.track_model import Track, track_model
from trackig_core.track.design import ONE_AXLE
from trackig_core.words import counted, span


@dataclass(frozen=True, eq=False)
class SteadyShape:
    """Displacements per unit roughness between wheel and rail, positive towards the ground.

    Attributes
    ----------
    frequency : numpy.ndarray (frequencies,) [Hz]
        Frequencies.
    position : numpy.ndarray (elements,) [m]
        Rail elements, counted from support 0, over which one wheel alone stands.
    rail : numpy.ndarray of complex (elements, frequencies) [-]
        Displacement of the rail, every element.
    support_position : numpy.ndarray (supports,) [m]
        Supports, counted from support 0.
    block : numpy.ndarray of complex (supports, frequencies) [-] or None
        Displacement of the blocks; None when single-stage.
    foot : numpy.ndarray of complex (supports, frequencies) [-] or None
        Displacement of the supports' feet; None on rigid ground.
    wheel_position : numpy.ndarray (wheels,) [m]
        Wheels, on the rail elements on which they stand.
    wheels : numpy.ndarray of complex (wheels, frequencies) [-]
        Displacement of the wheels.
    """

    frequency: RealArray = field(repr=False)
    position: RealArray = field(repr=False)
    rail: ComplexArray = field(repr=False)
    support_position: RealArray = field(repr=False)
    block: ComplexArray | None = field(repr=False)
    foot: ComplexArray | None = field(repr=False)
    wheel_position: RealArray = field(repr=False)
    wheels: ComplexArray = field(repr=False)

    @property
    def wheel(self) -> ComplexArray:
        """Displacement of the first wheel (frequencies,) [-]."""
        return self.wheels[0]

    def __str__(self) -> str:
        """Return frequencies, and how far rail and wheel move per unit roughness."""
        rail, wheel = (float(np.abs(each).max()) for each in (self.rail, self.wheels))
        return (
            f"{counted(self.frequency.size, 'shape')}, {span(self.frequency, 'Hz')}, of "
            f"{self.support_position.size} supports: per m of roughness the rail moves by up to {rail:.3g} "
            f"m, the wheel by {wheel:.3g} m"
        )


def steady_shape(
    design: Track, frequency: ArrayLike, bays: int = 12, lattice: Lattice = INFINITE
) -> SteadyShape:
    """Return how the track moves at given frequencies, some bays either side of the wheels.

    Several wheels meet the same roughness, each with its delay; where theirs is independent, the first alone
    stands on roughness.

    Parameters
    ----------
    design : TrackDesign or TrackModel
        The track and its wheels.
    frequency : array_like (frequencies,)
        Frequencies [Hz], greater than zero.
    bays : int
        Bays to either side of the outermost wheels, one or more.
    lattice : Lattice
        What to solve.

    Returns
    -------
    SteadyShape
        Displacements per unit roughness.

    Raises
    ------
    ValueError
        If a frequency is not greater than zero, or ``bays`` is less than one.
    """
    if bays < 1:
        raise ValueError(f"bays = {bays!r}: give a whole number, 1 or more")
    per_bay = lattice.elements_per_bay
    frequency = np.atleast_1d(np.asarray(frequency, dtype=float))
    model = track_model(design)
    wheels = np.array(wheel_elements(model.design, per_bay))
    first, last = wheels.min() // per_bay - bays, -(-wheels.max() // per_bay) + bays
    elements = np.arange(first * per_bay, last * per_bay + 1)
    if model.design.axle_positions == ONE_AXLE:
        contact = contact_force(model, frequency, lattice)[None]
        rail = contact[0] * rail_receptance(model, frequency, elements, lattice)
    else:
        loaded = loaded_rail(model, waves(model, frequency, lattice), lattice)
        contact = contact_forces(model, loaded, lattice)[:, 0]
        rail = np.array([_under_wheels(loaded, int(element), contact) for element in elements])
    supports = model.supports(frequency, lattice)
    spacing, over = model.design.fastener_spacing, rail[::per_bay]
    return SteadyShape(
        frequency=frequency,
        position=elements * spacing / per_bay,
        rail=rail,
        support_position=(elements[::per_bay] // per_bay).astype(np.float64) * spacing,
        block=None if supports.block is None else over * supports.pad / supports.block,
        foot=None if supports.foot_to_rail is None else over * supports.foot_to_rail,
        wheel_position=wheels * spacing / per_bay,
        # the contact pushes the wheels up: D W = -contact
        wheels=-contact / model.above(frequency, lattice),
    )


def _under_wheels(loaded: LoadedRail, element: int, contact: ComplexArray) -> ComplexArray:
    """Return the displacement of an element under contact forces (wheels, frequencies) [N]."""
    receptances = np.array([loaded.receptance(element, wheel) for wheel in loaded.wheels])
    return np.sum(receptances * contact, axis=0)


def rail_receptance(
    design: Track, frequency: ArrayLike, element: ArrayLike = 0, lattice: Lattice = INFINITE
) -> ComplexArray:
    """Return the displacement of any rail element per unit force on the rail over support 0.

    Parameters
    ----------
    design : TrackDesign or TrackModel
        The track.
    frequency : array_like (frequencies,)
        Frequencies [Hz], greater than zero.
    element : int or numpy.ndarray of int (elements,)
        Number of the element, counted from the force; each ``elements_per_bay``-th is over a support.
    lattice : Lattice
        What to solve.

    Returns
    -------
    numpy.ndarray of complex (frequencies,) or (elements, frequencies)
        Receptance [m/N].

    Raises
    ------
    ValueError
        If a frequency is not greater than zero.
    """
    model = track_model(design)
    track = waves(model, frequency, lattice)
    shapes = bay_shapes(model.design, track, lattice.elements_per_bay)
    away = np.abs(np.asarray(element))
    if lattice.bays is None:
        shape = _wave(track, shapes, away)
    else:
        around = lattice.bays * lattice.elements_per_bay
        away = away % around
        # waves that went round the ring the other way, and any number of times
        shape = _wave(track, shapes, away) + _wave(track, shapes, around - away)
        shape = shape / (1 - track.multipliers**lattice.bays)
    return np.sum(track.amplitudes * shape, axis=-2)


def _wave(track: Waves, shapes: ComplexArray, element: NDArray[np.int_]) -> ComplexArray:
    """Return both waves at given elements (elements, 2, frequencies) [-]."""
    bay, within = np.divmod(element, len(shapes))
    return shapes[within] * track.multipliers ** bay[..., None, None]
