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
from trackig_core.frequency_domain.axles import bay_shapes
from trackig_core.frequency_domain.floquet_waves import Waves, contact_force, waves
from trackig_core.frequency_domain.lattice import INFINITE, Lattice
from trackig_core.frequency_domain.track_model import Track, track_model


@dataclass(frozen=True, eq=False)
class SteadyShape:
    """Displacements per unit roughness between wheel and rail, positive towards the ground.

    Attributes
    ----------
    frequency : numpy.ndarray (frequencies,) [Hz]
        Frequencies.
    position : numpy.ndarray (elements,) [m]
        Rail elements, counted from the wheel.
    rail : numpy.ndarray of complex (elements, frequencies) [-]
        Displacement of the rail, every element.
    support_position : numpy.ndarray (supports,) [m]
        Supports, counted from the wheel.
    block : numpy.ndarray of complex (supports, frequencies) [-] or None
        Displacement of the blocks; None when single-stage.
    wheel : numpy.ndarray of complex (frequencies,) [-]
        Displacement of the wheel.
    """

    frequency: RealArray = field(repr=False)
    position: RealArray = field(repr=False)
    rail: ComplexArray = field(repr=False)
    support_position: RealArray = field(repr=False)
    block: ComplexArray | None = field(repr=False)
    wheel: ComplexArray = field(repr=False)


def steady_shape(
    design: Track, frequency: ArrayLike, bays: int = 12, lattice: Lattice = INFINITE
) -> SteadyShape:
    """Return how the track moves at given frequencies, some bays either side of the wheel.

    Parameters
    ----------
    design : TrackDesign or TrackModel
        The track and its wheel.
    frequency : array_like (frequencies,)
        Frequencies [Hz], greater than zero.
    bays : int
        Bays to either side of the wheel, one or more.
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
    elements = np.arange(-bays * per_bay, bays * per_bay + 1)
    frequency = np.atleast_1d(np.asarray(frequency, dtype=float))
    model = track_model(design)
    contact = contact_force(model, frequency, lattice)
    rail = contact * rail_receptance(model, frequency, elements, lattice)
    supports = model.supports(frequency, lattice)
    spacing, wheel_mass = model.design.fastener_spacing, model.design.wheel_mass
    return SteadyShape(
        frequency=frequency,
        position=elements * spacing / per_bay,
        rail=rail,
        support_position=(elements[::per_bay] // per_bay).astype(np.float64) * spacing,
        block=None if supports.block is None else rail[::per_bay] * supports.pad / supports.block,
        # the contact pushes the wheel up: -m w^2 W = -contact
        wheel=contact / (wheel_mass * lattice.frequency_squared(frequency)),
    )


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
