"""The one-dimensional model beside the beam: wheel and block in a chain of springs.

The rail spreads the wheel's load over several supports. A beam on an even foundation of stiffness k' = K/L
(a support's stiffness over the spacing) yields by F beta / (2 k') under a force F, and by

    phi(x) = exp(-beta |x|) (cos beta x + sin beta |x|),    beta = (k' / (4 EI))^(1/4)

of that at a distance x (Hetenyi, "Beams on Elastic Foundation", 1946; Zimmermann, 1888). It is thus as
stiff as n = 2 / (beta L) supports side by side. The chain puts the wheel on that many supports:

    wheel m_w -- k_H -- n k_p -- block n m_b -- n k_b -- ground            (single-stage: no block, no boot)

Statically this is the beam on its foundation. The rail keeps the stiffness of beta but has no mass, so that
contact spring and pads are one spring, k_u, and two degrees of freedom remain. n is that of the
stiffnesses at 50 Hz, at every frequency; a load never stands on less than one support. Waves, which
carry vibration along the rail, have no place in it. SI units, Hz, dB.

Coupled and uncoupled frequencies: with a = k_u/m_w, b = k_b/m_b and c = k_u/(n m_b), the coupled
pair solves p(x) = x^2 - (a + b + c) x + a b = 0, x = w^2. Since p(a) = -a c < 0 and p(b) = -b c < 0, both
a (wheel, the block held) and b (block on its boot, the wheel away) lie between the roots: the coupled
pair straddles the uncoupled, on every design. Springs that stiffen with frequency leave it true, since
each frequency is the one root of f = f(K(f)).

The one rule: nothing is fitted to the beam model, so that what the two share is understood and what
parts them is what the beam adds.
"""

import math
from dataclasses import dataclass, field

import numpy as np

from trackig_core.frequency_domain.natural_frequencies import consistent, coupled_pair, loaded_track
from trackig_core.frequency_domain.refinement import (
    band_frequencies,
    banded_spectrum,
    refined_spectrum,
    require_damping,
)
from trackig_core.levels.insertion_gain import insertion_gain
from trackig_core.results import ForceSpectrum
from trackig_core.track.design import DEFAULT_STEP, REFERENCE_FREQUENCY
from trackig_core.track.viscoelastic_law import laws

GOOD_ENOUGH = 3.0
"""Difference from the beam model up to which a band of the lumped model serves a first estimate [dB]: the
least step in level that listeners are commonly said to notice."""


@dataclass(frozen=True)
class LumpedFrequencies:
    """Natural frequencies of the chain [Hz].

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


@dataclass(frozen=True, eq=False)
class LumpedComparison:
    """Insertion gain of the chain beside that of the beam model.

    Attributes
    ----------
    lumped, beam : numpy.ndarray (21,) [dB]
        Insertion gain per band.
    good_enough : numpy.ndarray of bool (21,)
        Where the two lie within :data:`GOOD_ENOUGH` of each other.
    """

    lumped: np.ndarray = field(repr=False)
    beam: np.ndarray = field(repr=False)
    good_enough: np.ndarray = field(repr=False)

    @property
    def difference(self):
        """Lumped less beam (21,) [dB]."""
        return self.lumped - self.beam


def effective_supports(design):
    """Return how many supports side by side are as stiff as the track is under its wheel.

    Parameters
    ----------
    design : TrackDesign
        The track.

    Returns
    -------
    float
        n = 2 / (beta L), but one at least [-].
    """
    return max(1.0, _spread(design))


def energy_share(design):
    """Return the sum of the supports' squared forces over their squared sum, the load shared out by phi.

    Parameters
    ----------
    design : TrackDesign
        The track.

    Returns
    -------
    float
        L (integral of phi^2) / (integral of phi)^2 = 3 / (4 n), but one at most [-].
    """
    return min(1.0, 0.75 / _spread(design))


def _spread(design):
    """Return 2 / (beta L), from the stiffnesses at 50 Hz [-]."""
    support = 1 / sum(1 / law.stiffness(REFERENCE_FREQUENCY) for law in laws(design) if law)
    spacing = design.fastener_spacing
    beta = (support / spacing / (4 * design.rail.bending_stiffness)) ** 0.25
    return 2 / (beta * spacing)


def lumped_frequencies(design):
    """Return the coupled and uncoupled natural frequencies of the chain, without loss.

    Parameters
    ----------
    design : TrackDesign
        The track.

    Returns
    -------
    LumpedFrequencies
        Frequencies, every stiffness at its dynamic value Re K(f) [Hz].
    """
    supports = effective_supports(design)
    pad, boot = laws(design)

    def wheel(stiffnesses):
        return math.sqrt(_upper(design, supports, stiffnesses[0]) / design.wheel_mass) / (2 * math.pi)

    def block(stiffnesses):
        return math.sqrt(stiffnesses[0] / design.block_mass) / (2 * math.pi)

    def coupled(stiffnesses, which):
        k_pad, k_boot = stiffnesses
        upper = _upper(design, supports, k_pad)
        return coupled_pair(upper, supports * k_boot, design.wheel_mass, supports * design.block_mass)[which]

    alone = consistent(wheel, (pad,))
    if boot is None:
        return LumpedFrequencies((alone,), (alone,))
    return LumpedFrequencies(
        coupled=tuple(consistent(lambda k, which=which: coupled(k, which), (pad, boot)) for which in (0, 1)),
        uncoupled=(alone, consistent(block, (boot,))),
    )


def _upper(design, supports, pad):
    """Return the stiffness between wheel and block: contact spring and pads in series [N/m]."""
    return 1 / (1 / design.contact_stiffness + 1 / (supports * pad))


def lumped_spectrum(design, frequency, step=DEFAULT_STEP):
    """Return the energy spectrum of the force that the chain passes into the ground after a step.

    Parameters
    ----------
    design : TrackDesign
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
    supports = effective_supports(design)
    pad, boot = (law.dynamic_stiffness(frequency) if law else None for law in laws(design))
    support, passed = pad, 1.0
    if design.two_stage:
        between = pad + boot - design.block_mass * squared
        support, passed = pad - pad**2 / between, boot / (boot - design.block_mass * squared)
    contact = 1 / (
        1 / design.contact_stiffness + 1 / (supports * support) - 1 / (design.wheel_mass * squared)
    )
    coherent = np.abs(contact * passed * step) ** 2 / squared
    return ForceSpectrum(
        frequency=frequency,
        energy=coherent * energy_share(design),
        coherent_energy=coherent,
        step=step,
    )


def lumped_insertion_gain(design, reference="line", summation="energy"):
    """Return the insertion gain of the chain, on the same bands and references as the beam model.

    Parameters
    ----------
    design : TrackDesign
        The track.
    reference, summation : str
        As for :func:`trackig_core.insertion_gain`; the line is anchored by the chain's own lowest frequency.

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
    require_damping(design)
    lowest = lumped_frequencies(design).coupled[0]
    spectrum = refined_spectrum(lambda between: lumped_spectrum(design, between), band_frequencies(lowest))
    return insertion_gain(spectrum, design, lowest, reference, summation)


def compare_with_beam(design, reference="line", summation="energy"):
    """Lay the chain's insertion gain beside that of the beam model, both exact.

    Parameters
    ----------
    design : TrackDesign
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
    lumped = lumped_insertion_gain(design, reference, summation).levels
    loaded = loaded_track(design)
    beam = insertion_gain(banded_spectrum(design, loaded), design, loaded, reference, summation).levels
    return LumpedComparison(lumped, beam, np.abs(lumped - beam) <= GOOD_ENOUGH)
