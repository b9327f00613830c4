"""The frequency-domain solution: the lattice solved frequency by frequency, without time stepping.

Blocks are eliminated from each support, and the supported rail is solved in closed form through
the two waves that decay from bay to bay (Floquet multipliers). What is solved is chosen by a
:class:`trackig_core.frequency_domain.lattice.Lattice`: an infinite track or the ring, continuous time or the
time-stepping scheme itself (its z-transform), with either rule for the damping memory. Nothing is stepped,
sampled or fitted: for the lattice that it is given, the answer is exact.

Time dependence exp(+i w t); SI units and Hz. Source of the model: the paper (see
:mod:`trackig_core.track.design`).
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from trackig_core.arrays import AnyArray, ComplexArray, RealArray
from trackig_core.frequency_domain import kernels
from trackig_core.frequency_domain.axle_kernels import axle_energy
from trackig_core.frequency_domain.axles import contact_forces, loaded_rail, wheel_delays
from trackig_core.frequency_domain.kernel_rows import surroundings_row, wheel_row
from trackig_core.frequency_domain.lattice import INFINITE, Lattice
from trackig_core.frequency_domain.timoshenko import FreeBeam
from trackig_core.frequency_domain.track_model import Track, TrackModel, track_model
from trackig_core.results import ForceSpectrum
from trackig_core.track.design import ONE_AXLE
from trackig_core.track.fields import DesignError

NEPER = 20 / np.log(10)
"""Decibels in a factor of e [dB]."""


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
    rail : str
        Beam that the rail is, as in the lattice.
    """

    frequency: RealArray
    frequency_squared: RealArray
    multipliers: ComplexArray
    amplitudes: ComplexArray
    transfer: ComplexArray
    bays: int | None
    rail: str = "euler"

    def receptance(self, support: ArrayLike = 0) -> ComplexArray:
        """Return the rail displacement over a support per unit force over support 0.

        Parameters
        ----------
        support : int or numpy.ndarray of int (supports,)
            Number of the support, counted from the force.

        Returns
        -------
        numpy.ndarray of complex (frequencies,) or (supports, frequencies)
            Receptance [m/N].

        Raises
        ------
        ValueError
            If a support is not a whole number.
        """
        away = np.abs(_supports(support))[..., None, None]
        if self.bays is None:
            return np.sum(self.amplitudes * self.multipliers**away, axis=-2)
        # waves that went round the ring the other way, and any number of times
        away = away % self.bays
        backwards = self.multipliers ** (self.bays - away) if away.any() else self.around
        shape = (self.multipliers**away + backwards) / (1 - self.around)
        return np.sum(self.amplitudes * shape, axis=-2)

    @cached_property
    def around(self) -> AnyArray:
        """Factor of each wave once around the ring (2, frequencies) [-]; zero on the infinite track."""
        return np.zeros(()) if self.bays is None else self.multipliers**self.bays

    def energy_sum(self) -> RealArray:
        """Return the sum over all supports of the squared receptance (frequencies,) [m2/N2]."""
        first, second = self.amplitudes / (1 - self.around)
        pairs = np.abs(first) ** 2, np.abs(second) ** 2, 2 * first * second.conj()
        sums = (self._product_sum(*each) for each in ((0, 0), (1, 1), (0, 1)))
        return np.real(sum(pair * total for pair, total in zip(pairs, sums, strict=True)))

    def _product_sum(self, this: int, that: int) -> ComplexArray:
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

    def coherent_sum(self) -> ComplexArray:
        """Return the sum over all supports of the receptance (frequencies,) [m/N]; ring and line agree."""
        return np.sum(self.amplitudes * _two_sided(self.multipliers), axis=0)


def _supports(support: ArrayLike) -> AnyArray:
    """Return numbers of supports as integers, or raise a ValueError."""
    numbers = np.asarray(support)
    if numbers.dtype.kind not in "iuf" or not np.isin(numbers % 1, 0).all():
        raise ValueError(f"support = {numbers}: give whole numbers of supports, counted from the force")
    return numbers.astype(int)


def _two_sided(ratio: ComplexArray) -> ComplexArray:
    return (1 + ratio) / (1 - ratio)


def waves(design: Track, frequency: ArrayLike, lattice: Lattice = INFINITE) -> Waves:
    """Solve the supported rail at given frequencies.

    Parameters
    ----------
    design : TrackDesign or TrackModel
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
        If a frequency is not finite and greater than zero.
    """
    frequency, model = _checked(frequency), track_model(design)
    squared, supports = lattice.frequency_squared(frequency), model.supports(frequency, lattice)
    rail, spacing = model.design.rail, model.design.fastener_spacing
    dx = spacing / lattice.elements_per_bay
    multipliers = np.empty((2, frequency.size), dtype=complex)
    amplitudes = np.empty_like(multipliers)
    if lattice.rail == "timoshenko":
        poles, strengths = FreeBeam.of(rail, squared).over_supports(spacing)
        kernels.beam_waves(poles, strengths, supports.stiffness, multipliers, amplitudes)
    else:
        kernels.bay_waves(
            squared,
            supports.stiffness,
            rail.bending_stiffness / dx**3,
            rail.mass_per_metre * dx,
            lattice.elements_per_bay,
            multipliers,
            amplitudes,
        )
    return Waves(frequency, squared, multipliers, amplitudes, supports.transfer, lattice.bays, lattice.rail)


def _checked(frequency: ArrayLike) -> RealArray:
    """Return frequencies as an array [Hz], or raise a ValueError."""
    checked = np.atleast_1d(np.asarray(frequency, dtype=float))
    if not (np.isfinite(checked) & (checked > 0)).all():
        raise ValueError("frequencies must be finite and greater than 0 Hz")
    return checked


def receptance(
    design: Track, frequency: ArrayLike, support: ArrayLike = 0, lattice: Lattice = INFINITE
) -> ComplexArray:
    """Return the rail displacement over a support per unit force on the rail over support 0.

    Parameters
    ----------
    design : TrackDesign or TrackModel
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


def contact_force(design: Track, frequency: ArrayLike, lattice: Lattice = INFINITE) -> ComplexArray:
    """Return the contact force per unit roughness between rail and one wheel over support 0.

    A design's other axles are left out; see :func:`trackig_core.frequency_domain.axles.contact_forces`.

    Parameters
    ----------
    design : TrackDesign or TrackModel
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
    model = track_model(design)
    return _contact_force(model, waves(model, frequency, lattice), lattice)


def _contact_force(model: TrackModel, rail: Waves, lattice: Lattice) -> ComplexArray:
    wheel = 1 / model.above(rail.frequency, lattice)
    return 1 / (1 / model.design.contact_stiffness + rail.receptance() + wheel)


def support_force(
    design: Track, frequency: ArrayLike, support: ArrayLike = 0, lattice: Lattice = INFINITE
) -> ComplexArray:
    """Return the force that a support passes into the ground per unit roughness under one wheel.

    The wheel stands over support 0; a design's other axles are left out.

    Parameters
    ----------
    design : TrackDesign or TrackModel
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
    model = track_model(design)
    rail = waves(model, frequency, lattice)
    return _contact_force(model, rail, lattice) * rail.transfer * rail.receptance(support)


def block_to_rail(design: Track, frequency: RealArray) -> RealArray:
    """Return how much a block moves per movement of the rail above it, in continuous time.

    Parameters
    ----------
    design : TrackDesign or TrackModel
        A two-stage track.
    frequency : numpy.ndarray (frequencies,)
        Frequencies [Hz].

    Returns
    -------
    numpy.ndarray (frequencies,)
        Magnitude of block over rail displacement [-].

    Raises
    ------
    DesignError
        If the track is single-stage.
    """
    supports = track_model(design).supports(frequency)
    if supports.block is None:
        raise DesignError("block_mass", None, "a two-stage track: a single-stage one has no blocks")
    return np.abs(supports.pad / supports.block)


def exact_spectrum(
    design: Track, frequency: ArrayLike, step: float, lattice: Lattice = INFINITE
) -> ForceSpectrum:
    """Return the exact energy spectrum of the force into the ground after a step of roughness.

    Parameters
    ----------
    design : TrackDesign or TrackModel
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
    model, frequency = track_model(design), _checked(frequency)
    if lattice == INFINITE and model.causal:
        return _compiled_spectrum(model, frequency, step)
    return _lattice_spectrum(model, frequency, step, lattice)


def _compiled_spectrum(model: TrackModel, frequency: RealArray, step: float) -> ForceSpectrum:
    """Return the spectrum on the infinite track in continuous time, solved by compiled code."""
    design, delays = model.design, wheel_delays(model.design)
    energy, coherent = np.empty_like(frequency), np.empty_like(frequency)
    delays = np.empty(0) if delays is None else delays
    axle_energy(model.row, surroundings_row(design), wheel_row(design), delays, frequency, energy, coherent)
    return ForceSpectrum(frequency, energy * step**2, coherent * step**2, step)


def _lattice_spectrum(
    model: TrackModel, frequency: RealArray, step: float, lattice: Lattice
) -> ForceSpectrum:
    """Return the spectrum on any lattice."""
    rail = waves(model, frequency, lattice)
    # the step's own spectrum is 1/(i w), in discrete time dt/(1 - exp(-i w dt)): both of magnitude 1/w
    if model.design.axle_positions != ONE_AXLE:
        loaded = loaded_rail(model, rail, lattice)
        forces = contact_forces(model, loaded, lattice)
        per_displacement = np.abs(rail.transfer * step) ** 2 / rail.frequency_squared
        return ForceSpectrum(
            frequency=rail.frequency,
            energy=per_displacement * loaded.energy_sum(forces),
            coherent_energy=per_displacement * np.sum(np.abs(loaded.coherent_sum(forces)) ** 2, axis=0),
            step=step,
        )
    per_receptance = np.abs(_contact_force(model, rail, lattice) * rail.transfer * step) ** 2
    per_receptance = per_receptance / rail.frequency_squared
    return ForceSpectrum(
        frequency=rail.frequency,
        energy=per_receptance * rail.energy_sum(),
        coherent_energy=per_receptance * np.abs(rail.coherent_sum()) ** 2,
        step=step,
    )


def track_decay_rate(design: Track, frequency: ArrayLike, lattice: Lattice = INFINITE) -> RealArray:
    """Return how fast vibration dies away along the rail: the rate of the wave that lives longest.

    Parameters
    ----------
    design : TrackDesign or TrackModel
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
    model = track_model(design)
    longest = np.abs(waves(model, frequency, lattice).multipliers).max(axis=0)
    return -NEPER * np.log(longest) / model.design.fastener_spacing
