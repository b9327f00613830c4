"""The lumped model beside the beam: wheel and block on springs, one above the other.

The rail spreads the wheel's load over several supports. A beam on an even foundation of stiffness k' = K/L
(a support's stiffness over the spacing) yields by F beta / (2 k') under a force F, and by

    phi(x) = exp(-beta |x|) (cos beta x + sin beta |x|),    beta = (k' / (4 EI))^(1/4)

of that at a distance x (Hetenyi, "Beams on Elastic Foundation", 1946; Zimmermann, 1888). It is thus as
stiff as n = 2 / (beta L) supports side by side. The lumped model puts the wheel on that many supports:

    wheel m_w -- k_H -- n k_p -- block n m_b -- n k_b -- ground            (single-stage: no block, no boot)

Statically this is the beam on its foundation. The rail keeps the stiffness of beta but has no mass, so that
contact spring and pads are one spring, k_u, and two degrees of freedom remain. n is that of the
stiffnesses at 50 Hz, at every frequency; a load never stands on less than one support. Waves, which
carry vibration along the rail, have no place in it, nor have suspension, other axles and ground that
yields: a design is taken as the paper's simplified model of it. SI units, Hz, dB.

Coupled and uncoupled frequencies: with a = k_u/m_w, b = k_b/m_b and c = k_u/(n m_b), the coupled
pair solves p(x) = x^2 - (a + b + c) x + a b = 0, x = w^2. Since p(a) = -a c < 0 and p(b) = -b c < 0, both
a (wheel, the block held) and b (block on its boot, the wheel away) lie between the roots: the coupled
pair straddles the uncoupled, on every design. Springs that stiffen with frequency leave it true, since
each frequency is the one root of f = f(K(f)).

Nothing is fitted to the beam model: what sets the two apart is what the beam adds.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike

from trackig_core.arrays import BoolArray, ComplexArray, RealArray
from trackig_core.bands import BAND_LABELS
from trackig_core.frequency_domain.natural_frequencies import consistent, coupled_pair
from trackig_core.frequency_domain.refinement import (
    band_frequencies,
    banded_gain,
    refined_spectrum,
    require_damping,
    stiff_spectrum,
)
from trackig_core.frequency_domain.track_model import Track, TrackModel, once_per_model, track_model
from trackig_core.levels.insertion_gain import insertion_gain
from trackig_core.results import ForceSpectrum, InsertionGain
from trackig_core.track.design import DEFAULT_STEP, REFERENCE_FREQUENCY, TrackDesign
from trackig_core.words import hertz, largest

GOOD_ENOUGH = 3.0
"""Difference from the beam model up to which a band of the lumped model serves a first estimate [dB]: the
least step in level that listeners are commonly said to notice."""


@dataclass(frozen=True)
class LumpedFrequencies:
    """Natural frequencies of the lumped model [Hz].

    Attributes
    ----------
    coupled : tuple of float
        Wheel and block moving together, ascending; the wheel alone when single-stage.
    uncoupled : tuple of float
        Wheel with the block held still, block on its boot with the wheel away; the wheel alone when
        single-stage.
    """

    coupled: tuple[float, ...]
    uncoupled: tuple[float, ...]

    def __str__(self) -> str:
        """Return the frequencies [Hz]."""
        return f"coupled {hertz(self.coupled)}; uncoupled {hertz(self.uncoupled)}"


@dataclass(frozen=True, eq=False)
class LumpedComparison:
    """Insertion gain of the lumped model beside that of the beam model.

    Attributes
    ----------
    lumped, beam : numpy.ndarray (21,) [dB]
        Insertion gain per band.
    good_enough : numpy.ndarray of bool (21,)
        Where the two lie within :data:`GOOD_ENOUGH` of each other.
    """

    lumped: RealArray = field(repr=False)
    beam: RealArray = field(repr=False)
    good_enough: BoolArray = field(repr=False)

    @property
    def difference(self) -> RealArray:
        """Lumped less beam (21,) [dB]."""
        return self.lumped - self.beam

    def __str__(self) -> str:
        """Return in how many bands the models agree, and where they do least [dB]."""
        count = int(self.good_enough.sum())
        return (
            f"the lumped model is within {GOOD_ENOUGH:g} dB of the beam model in {count} of "
            f"{self.beam.size} bands; farthest from it by {largest(self.difference, BAND_LABELS)}"
        )


@once_per_model
def effective_supports(model: TrackModel) -> float:
    """Return how many supports side by side are as stiff as the track is under its wheel.

    Parameters
    ----------
    design : TrackDesign or TrackModel
        The track.

    Returns
    -------
    float
        n = 2 / (beta L), but one at least [-].
    """
    return max(1.0, _spread(model))


@once_per_model
def energy_share(model: TrackModel) -> float:
    """Return the sum of the supports' squared forces over their squared sum, the load shared out by phi.

    Parameters
    ----------
    design : TrackDesign or TrackModel
        The track.

    Returns
    -------
    float
        L (integral of phi^2) / (integral of phi)^2 = 3 / (4 n), but one at most [-].
    """
    return min(1.0, 0.75 / _spread(model))


def _spread(model: TrackModel) -> float:
    """Return 2 / (beta L), from the stiffnesses at 50 Hz [-]."""
    support = 1 / sum(1 / law.stiffness(REFERENCE_FREQUENCY) for law in model.springs)
    spacing = model.design.fastener_spacing
    beta: float = (support / spacing / (4 * model.design.rail.bending_stiffness)) ** 0.25
    return 2 / (beta * spacing)


@once_per_model
def lumped_frequencies(model: TrackModel) -> LumpedFrequencies:
    """Return the coupled and uncoupled natural frequencies of the lumped model, without loss.

    Parameters
    ----------
    design : TrackDesign or TrackModel
        The track.

    Returns
    -------
    LumpedFrequencies
        Frequencies, every stiffness at its dynamic value Re K(f) [Hz].
    """
    track, supports = model.design, effective_supports(model)
    block_mass, boot = track.block_mass, model.boot

    def wheel(stiffnesses: Sequence[float]) -> float:
        return math.sqrt(_upper(track, supports, stiffnesses[0]) / track.wheel_mass) / (2 * math.pi)

    alone = consistent(wheel, (model.pad,))
    if block_mass is None or boot is None:
        return LumpedFrequencies((alone,), (alone,))

    def block(stiffnesses: Sequence[float]) -> float:
        return math.sqrt(stiffnesses[0] / block_mass) / (2 * math.pi)

    def one_of_two(which: int) -> Callable[[Sequence[float]], float]:
        def coupled(stiffnesses: Sequence[float]) -> float:
            k_pad, k_boot = stiffnesses
            upper = _upper(track, supports, k_pad)
            return coupled_pair(upper, supports * k_boot, track.wheel_mass, supports * block_mass)[which]

        return coupled

    return LumpedFrequencies(
        coupled=tuple(consistent(one_of_two(which), model.springs) for which in (0, 1)),
        uncoupled=(alone, consistent(block, (boot,))),
    )


def _upper(design: TrackDesign, supports: float, pad: float) -> float:
    """Return the stiffness between wheel and block: contact spring and pads in series [N/m]."""
    return 1 / (1 / design.contact_stiffness + 1 / (supports * pad))


def lumped_spectrum(design: Track, frequency: ArrayLike, step: float = DEFAULT_STEP) -> ForceSpectrum:
    """Return the energy spectrum of the force that the lumped model passes into the ground after a step.

    Parameters
    ----------
    design : TrackDesign or TrackModel
        The track and its wheel.
    frequency : array_like (frequencies,)
        Frequencies [Hz], ascending and greater than zero.
    step : float
        Height of the step [m].

    Returns
    -------
    ForceSpectrum
        Energy at the given frequencies.
    """
    frequency = np.atleast_1d(np.asarray(frequency, dtype=float))
    squared = (2 * np.pi * frequency) ** 2
    model = track_model(design).simplified
    track, support = model.design, model.supports(frequency)
    passed: ComplexArray | float = 1.0
    if support.boot is not None and support.inertia is not None:
        passed = support.boot / (support.boot - support.inertia)
    on_supports = effective_supports(model) * support.stiffness
    contact = 1 / (1 / track.contact_stiffness + 1 / on_supports - 1 / (track.wheel_mass * squared))
    coherent = np.abs(contact * passed * step) ** 2 / squared
    return ForceSpectrum(
        frequency=frequency,
        energy=coherent * energy_share(model),
        coherent_energy=coherent,
        step=step,
    )


def lumped_insertion_gain(design: Track, reference: str = "line", summation: str = "energy") -> InsertionGain:
    """Return the insertion gain of the lumped model, on the same bands and references as the beam model.

    Parameters
    ----------
    design : TrackDesign or TrackModel
        The track.
    reference, summation : str
        As for :func:`trackig_core.insertion_gain`; the line is anchored by the lumped model's own lowest
        frequency.

    Returns
    -------
    InsertionGain
        Levels and the energies behind them.

    Raises
    ------
    DesignError
        If the spring on the ground has no loss.
    ValueError
        If ``reference`` or ``summation`` is not one of the choices.
    """
    model = track_model(design).simplified
    require_damping(model)
    lowest = lumped_frequencies(model).coupled[0]
    stiff = stiff_spectrum(model.design) if reference == "stiff" else None
    spectrum = refined_spectrum(lambda between: lumped_spectrum(model, between), band_frequencies(lowest))
    return insertion_gain(spectrum, model.design, lowest, reference, summation, stiff=stiff)


def compare_with_beam(design: Track, reference: str = "line", summation: str = "energy") -> LumpedComparison:
    """Return the lumped model's insertion gain beside that of the beam model, both in closed form.

    Parameters
    ----------
    design : TrackDesign or TrackModel
        The track.
    reference, summation : str
        As for :func:`trackig_core.insertion_gain`.

    Returns
    -------
    LumpedComparison
        Both, and where they agree.

    Raises
    ------
    DesignError
        If the exact answer has no bound, for want of any loss.
    ValueError
        If ``reference`` or ``summation`` is not one of the choices.
    """
    model = track_model(design).simplified
    lumped = lumped_insertion_gain(model, reference, summation).levels
    beam = banded_gain(model, reference=reference, summation=summation).levels
    return LumpedComparison(lumped, beam, np.abs(lumped - beam) <= GOOD_ENOUGH)
