"""The exact twin: the same lattice solved frequency by frequency, without time stepping.

Blocks are eliminated from each support, and the supported rail is solved in closed form through
the two waves that decay from bay to bay (Floquet multipliers). What is solved is chosen by a
:class:`Lattice`: an infinite track or the ring, continuous time or the time-stepping scheme itself
(its z-transform), with either rule for the damping memory.

Time dependence exp(+i w t); SI units and Hz. Source of the model: the paper (see
:mod:`trackig_core.track.design`). The one rule: nothing here is stepped, sampled or fitted: for the lattice
that it is given, the answer is exact.
"""

import numbers
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from trackig_core.frequency_domain import kernels
from trackig_core.results import ForceSpectrum
from trackig_core.track.viscoelastic_law import laws

NEPER = 20 / np.log(10)
"""Decibels in a factor of e [dB]."""


@dataclass(frozen=True)
class Lattice:
    """Which discrete track the twin solves.

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

    Raises
    ------
    ValueError
        If there is no such lattice.
    """

    elements_per_bay: int = 3
    bays: int | None = None
    time_step: float | None = None
    memory_order: int = 1

    def __post_init__(self):
        """Check that there is such a lattice."""
        if not isinstance(self.elements_per_bay, numbers.Integral) or self.elements_per_bay < 2:
            raise ValueError(f"elements_per_bay = {self.elements_per_bay!r}: give a whole number, 2 or more")
        if self.bays is not None and (not isinstance(self.bays, numbers.Integral) or self.bays < 2):
            raise ValueError(f"bays = {self.bays!r}: give None or a whole number, 2 or more")
        if self.time_step is not None and not self.time_step > 0:
            raise ValueError(f"time_step = {self.time_step!r}: give None or a time greater than 0 s")
        if self.memory_order not in (1, 2):
            raise ValueError(f"memory_order = {self.memory_order!r}: give 1 or 2")

    def frequency_squared(self, frequency):
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


INFINITE = Lattice()
"""The infinite track in continuous time, three elements a bay."""


@dataclass(frozen=True, eq=False)
class Waves:
    """The supported rail at some frequencies, per unit force on the rail over support 0.

    Attributes
    ----------
    frequency : numpy.ndarray (frequencies,) [Hz]
        Frequencies.
    frequency_squared : numpy.ndarray (frequencies,) [1/s2]
        Square of the angular frequency, as the lattice's time stepping sees it.
    multipliers : numpy.ndarray of complex (2, frequencies) [-]
        Factor of each wave from bay to bay.
    amplitudes : numpy.ndarray of complex (2, frequencies) [m/N]
        Displacement at support s is the sum of amplitude times multiplier to the power |s|.
    transfer : numpy.ndarray of complex (frequencies,) [N/m]
        Force into the ground per displacement of the rail over a support.
    bays : int or None
        Supports around the ring, or None.
    """

    frequency: np.ndarray
    frequency_squared: np.ndarray
    multipliers: np.ndarray
    amplitudes: np.ndarray
    transfer: np.ndarray
    bays: int | None

    def receptance(self, support=0):
        """Return the rail displacement over a support per unit force over support 0.

        Parameters
        ----------
        support : int or numpy.ndarray of int (supports,)
            Number of the support, counted from the force.

        Returns
        -------
        numpy.ndarray of complex (frequencies,) or (supports, frequencies)
            Receptance [m/N].
        """
        away = np.abs(np.asarray(support))[..., None, None]
        if self.bays is None:
            return np.sum(self.amplitudes * self.multipliers**away, axis=-2)
        # waves that went round the ring the other way, and any number of times
        away = away % self.bays
        backwards = self.multipliers ** (self.bays - away) if away.any() else self.around
        shape = (self.multipliers**away + backwards) / (1 - self.around)
        return np.sum(self.amplitudes * shape, axis=-2)

    @cached_property
    def around(self):
        """Factor of each wave once around the ring (2, frequencies) [-]; zero on the infinite track."""
        return np.zeros(()) if self.bays is None else self.multipliers**self.bays

    def energy_sum(self):
        """Return the sum over all supports of the squared receptance (frequencies,) [m2/N2]."""
        first, second = self.amplitudes / (1 - self.around)
        pairs = np.abs(first) ** 2, np.abs(second) ** 2, 2 * first * second.conj()
        sums = (self._product_sum(*each) for each in ((0, 0), (1, 1), (0, 1)))
        return np.real(sum(pair * total for pair, total in zip(pairs, sums, strict=True)))

    def _product_sum(self, this, that):
        """Return the sum over all supports of one wave's shape times the conjugate of another's."""
        one, other = self.multipliers[this], self.multipliers[that].conj()
        if self.bays is None:
            return _two_sided(one * other)
        # shape at support s of the ring: m^s + m^(bays - s); four geometric sums, two of them alike
        around, back = self.around[this], self.around[that].conj()
        apart = other - one
        equal = np.abs(apart) < 1e-9
        opposite = np.where(equal, self.bays * around / one, (back - around) / np.where(equal, 1.0, apart))
        return _two_sided(one * other) * (1 - around * back) + (one + other) * opposite

    def coherent_sum(self):
        """Return the sum over all supports of the receptance (frequencies,) [m/N]; ring and line agree."""
        return np.sum(self.amplitudes * _two_sided(self.multipliers), axis=0)


def _two_sided(ratio):
    return (1 + ratio) / (1 - ratio)


def dynamic_stiffness(law, frequency, lattice=INFINITE):
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
    return stiffness - sum(
        (feed * delay / (1 - keep * delay) for keep, feed in zip(decay, gain, strict=True)),
        start=np.zeros_like(delay),
    )


def waves(design, frequency, lattice=INFINITE):
    """Solve the supported rail at given frequencies.

    Parameters
    ----------
    design : TrackDesign
        The track.
    frequency : array_like (frequencies,)
        Frequencies [Hz], greater than zero.
    lattice : Lattice
        What to solve.

    Returns
    -------
    Waves
        The two waves per frequency.

    Raises
    ------
    ValueError
        If a frequency is not greater than zero.
    """
    frequency = np.atleast_1d(np.asarray(frequency, dtype=float))
    if not (frequency > 0).all():
        raise ValueError("frequencies must be greater than 0 Hz")
    squared = lattice.frequency_squared(frequency)
    pad_law, boot_law = laws(design)
    pad = dynamic_stiffness(pad_law, frequency, lattice)
    support, transfer = pad, pad
    if design.two_stage:
        boot = dynamic_stiffness(boot_law, frequency, lattice)
        between = pad + boot - design.block_mass * squared
        support, transfer = pad - pad**2 / between, pad * boot / between

    dx = design.fastener_spacing / lattice.elements_per_bay
    multipliers = np.empty((2, frequency.size), dtype=complex)
    amplitudes = np.empty_like(multipliers)
    kernels.bay_waves(
        squared,
        support,
        design.rail.bending_stiffness / dx**3,
        design.rail.mass_per_metre * dx,
        lattice.elements_per_bay,
        multipliers,
        amplitudes,
    )
    return Waves(frequency, squared, multipliers, amplitudes, transfer, lattice.bays)


def receptance(design, frequency, support=0, lattice=INFINITE):
    """Return the rail displacement over a support per unit force on the rail over support 0.

    Parameters
    ----------
    design : TrackDesign
        The track.
    frequency : array_like (frequencies,)
        Frequencies [Hz].
    support : int or numpy.ndarray of int (supports,)
        Number of the support, counted from the force.
    lattice : Lattice
        What to solve.

    Returns
    -------
    numpy.ndarray of complex (frequencies,) or (supports, frequencies)
        Receptance [m/N].
    """
    return waves(design, frequency, lattice).receptance(support)


def contact_force(design, frequency, lattice=INFINITE):
    """Return the contact force per unit roughness between wheel and rail.

    Parameters
    ----------
    design : TrackDesign
        The track and its wheel.
    frequency : array_like (frequencies,)
        Frequencies [Hz].
    lattice : Lattice
        What to solve.

    Returns
    -------
    numpy.ndarray of complex (frequencies,)
        Contact force per unit roughness [N/m].
    """
    return _contact_force(design, waves(design, frequency, lattice))


def _contact_force(design, rail):
    wheel = -1 / (design.wheel_mass * rail.frequency_squared)
    return 1 / (1 / design.contact_stiffness + rail.receptance() + wheel)


def support_force(design, frequency, support=0, lattice=INFINITE):
    """Return the force that a support passes into the ground per unit roughness.

    Parameters
    ----------
    design : TrackDesign
        The track and its wheel.
    frequency : array_like (frequencies,)
        Frequencies [Hz].
    support : int or numpy.ndarray of int (supports,)
        Number of the support, counted from the wheel.
    lattice : Lattice
        What to solve.

    Returns
    -------
    numpy.ndarray of complex (frequencies,) or (supports, frequencies)
        Force per unit roughness [N/m].
    """
    rail = waves(design, frequency, lattice)
    return _contact_force(design, rail) * rail.transfer * rail.receptance(support)


def block_to_rail(design, frequency):
    """Return how much a block moves per movement of the rail above it, in continuous time.

    Parameters
    ----------
    design : TrackDesign
        A two-stage track.
    frequency : numpy.ndarray (frequencies,)
        Frequencies [Hz].

    Returns
    -------
    numpy.ndarray (frequencies,)
        Magnitude of block over rail displacement [-].
    """
    pad, boot = (law.dynamic_stiffness(frequency) for law in laws(design))
    return np.abs(pad / (pad + boot - design.block_mass * (2 * np.pi * frequency) ** 2))


def exact_spectrum(design, frequency, step, lattice=INFINITE):
    """Return the exact energy spectrum of the force into the ground after a step of roughness.

    Parameters
    ----------
    design : TrackDesign
        The track and its wheel.
    frequency : array_like (frequencies,)
        Frequencies [Hz], ascending and greater than zero.
    step : float
        Height of the step [m].
    lattice : Lattice
        What to solve.

    Returns
    -------
    ForceSpectrum
        Energy summed over all supports, at the given frequencies.
    """
    rail = waves(design, frequency, lattice)
    # the step's own spectrum is 1/(i w), in discrete time dt/(1 - exp(-i w dt)): both of magnitude 1/w
    per_receptance = np.abs(_contact_force(design, rail) * rail.transfer * step) ** 2 / rail.frequency_squared
    return ForceSpectrum(
        frequency=rail.frequency,
        energy=per_receptance * rail.energy_sum(),
        coherent_energy=per_receptance * np.abs(rail.coherent_sum()) ** 2,
        step=step,
    )


def track_decay_rate(design, frequency, lattice=INFINITE):
    """Return how fast vibration dies away along the rail: the rate of the wave that lives longest.

    Parameters
    ----------
    design : TrackDesign
        The track.
    frequency : array_like (frequencies,)
        Frequencies [Hz].
    lattice : Lattice
        What to solve.

    Returns
    -------
    numpy.ndarray (frequencies,)
        Track decay rate [dB/m].
    """
    longest = np.abs(waves(design, frequency, lattice).multipliers).max(axis=0)
    return -NEPER * np.log(longest) / design.fastener_spacing
