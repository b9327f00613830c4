"""Which discrete track is solved: its elements, its ring, its time step and the rule of its damping memory.

A :class:`Lattice` is an infinite track or the ring, in continuous time or as the time-stepping scheme sees it
(its z-transform). Time dependence exp(+i w t); s and Hz.
"""

import numbers
from dataclasses import dataclass

import numpy as np

from trackig_core.arrays import ComplexArray, RealArray
from trackig_core.track.viscoelastic_law import Relaxation

RAIL_THEORIES = ("euler", "timoshenko")
"""Beams that a rail may be."""


@dataclass(frozen=True)
class Lattice:
    """Which discrete track the frequency-domain solution solves.

    Parameters
    ----------
    elements_per_bay : int
        Rail elements between supports.
    bays : int or None
        Supports around the ring; None for the infinite track.
    time_step : float or None
        Time step of the scheme whose z-transform is solved [s]; None for continuous time.
    memory_order : int
        Rule of the damping memory in discrete time: 1 (the paper's) or 2.
    rail : str
        ``"euler"``: a rail that only bends, made of elements. ``"timoshenko"``: a rail that also shears and
        has rotary inertia, exact between supports, in continuous time; elements only say where it is looked
        at.

    Raises
    ------
    ValueError
        If there is no such lattice.
    """

    elements_per_bay: int = 3
    bays: int | None = None
    time_step: float | None = None
    memory_order: int = 1
    rail: str = "euler"

    def __post_init__(self) -> None:
        """Check that there is such a lattice."""
        if not isinstance(self.elements_per_bay, numbers.Integral) or self.elements_per_bay < 2:
            raise ValueError(f"elements_per_bay = {self.elements_per_bay!r}: give a whole number, 2 or more")
        if self.bays is not None and (not isinstance(self.bays, numbers.Integral) or self.bays < 2):
            raise ValueError(f"bays = {self.bays!r}: give None or a whole number, 2 or more")
        if self.time_step is not None and not self.time_step > 0:
            raise ValueError(f"time_step = {self.time_step!r}: give None or a time greater than 0 s")
        if self.memory_order not in (1, 2):
            raise ValueError(f"memory_order = {self.memory_order!r}: give 1 or 2")
        if self.rail not in RAIL_THEORIES:
            raise ValueError(f"rail = {self.rail!r}: give {' or '.join(map(repr, RAIL_THEORIES))}")
        if self.rail != "euler" and self.time_step is not None:
            raise ValueError(
                f"rail = {self.rail!r} with a time step: only the rail that bends is stepped in time"
            )

    def frequency_squared(self, frequency: RealArray) -> RealArray:
        """Return the square of the angular frequency as the time stepping sees it.

        Parameters
        ----------
        frequency : numpy.ndarray (frequencies,)
            Frequencies [Hz].

        Returns
        -------
        numpy.ndarray (frequencies,)
            w^2 in continuous time, else (2/dt sin(w dt/2))^2 [1/s2].
        """
        if self.time_step is None:
            return (2 * np.pi * frequency) ** 2
        return (2 / self.time_step * np.sin(np.pi * frequency * self.time_step)) ** 2

    def derivative(self, frequency: RealArray) -> ComplexArray:
        """Return the velocity per displacement that a vehicle's dashpots feel (frequencies,) [1/s].

        In discrete time velocities stand half-way between displacements, and a dashpot feels the mean of the
        velocity before and the velocity after.
        """
        rate = 2 * np.pi * frequency
        if self.time_step is not None:
            rate = np.sin(rate * self.time_step) / self.time_step
        return np.asarray(1j * rate, dtype=complex)

    def foot_derivative(self, frequency: RealArray) -> ComplexArray:
        """Return the velocity per displacement at the foot of a support (frequencies,) [1/s].

        In discrete time the foot follows the trapezoidal rule, which needs no mass to be stable.
        """
        rate = 2 * np.pi * frequency
        if self.time_step is not None:
            rate = np.tan(rate * self.time_step / 2) * 2 / self.time_step
        return np.asarray(1j * rate, dtype=complex)

    def delay(self, frequency: RealArray, time: float) -> ComplexArray:
        """Return the factor by which roughness that comes later is delayed (frequencies,) [-].

        In discrete time a step of roughness that comes between two instants is shared out between them.
        """
        if self.time_step is None:
            return np.exp(-2j * np.pi * frequency * time)
        whole, part = divmod(time / self.time_step, 1.0)
        one = np.exp(-2j * np.pi * frequency * self.time_step)
        return one**whole * (1 - part + part * one)

    def __str__(self) -> str:
        """Return elements, ring and time step, in words."""
        ring = "infinite" if self.bays is None else f"a ring of {self.bays} bays"
        time = "continuous time" if self.time_step is None else f"time step {1e6 * self.time_step:.3g} µs"
        return f"{self.elements_per_bay} elements a bay, {ring}, {time}, {self.rail} rail"


INFINITE = Lattice()
"""The infinite track in continuous time, three elements a bay."""


def dynamic_stiffness(law: Relaxation, frequency: RealArray, lattice: Lattice = INFINITE) -> ComplexArray:
    """Return a pad's or boot's complex dynamic stiffness as the lattice sees it.

    Parameters
    ----------
    law : Relaxation
        The pad's or boot's law.
    frequency : numpy.ndarray (frequencies,)
        Frequencies [Hz].
    lattice : Lattice
        Continuous or discrete time, and the memory's rule.

    Returns
    -------
    numpy.ndarray of complex (frequencies,)
        Dynamic stiffness [N/m].
    """
    if lattice.time_step is None:
        return law.dynamic_stiffness(frequency)
    stiffness, decay, gain = law.recursion(lattice.time_step, lattice.memory_order)
    delay = np.exp(-2j * np.pi * frequency * lattice.time_step)
    # R_n = decay R_{n-1} + gain e_{n-1}
    memory: ComplexArray = sum(
        (feed * delay / (1 - keep * delay) for keep, feed in zip(decay, gain, strict=True)),
        start=np.zeros_like(delay),
    )
    return stiffness - memory
