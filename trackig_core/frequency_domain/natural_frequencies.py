"""Natural frequencies: of the loaded track, of the block, and of what they are coupled from.

All with the loss taken out and every stiffness at its dynamic value Re K(f), on the infinite track
with three elements a bay. Hz. Source: the paper (see :mod:`trackig_core.track.design`), which reports the
loaded-track and the coupled-block frequency of each track.

Every frequency is a root that is bracketed before it is sought. Relaxation stiffens with frequency, so the
frequency found with the static stiffness lies below the root, and the one found with the instantaneous
stiffness above.
"""

import math
from collections.abc import Callable, Sequence

import numpy as np
from scipy.optimize import brentq

from trackig_core.arrays import RealArray
from trackig_core.frequency_domain import batch_kernels
from trackig_core.frequency_domain.track_model import Track, TrackModel, once_per_model
from trackig_core.levels.kernels import highest_peak
from trackig_core.results import NaturalFrequencies
from trackig_core.track.viscoelastic_law import Relaxation

PEAK_REACH = 1.7
"""How far above and below a computed natural frequency its peak is looked for [-]."""

_MARGIN = 1e-9
"""Relative margin around a bracket, so that a spring without memory has one too [-]."""


@once_per_model
def natural_frequencies(model: TrackModel) -> NaturalFrequencies:
    """Return the natural frequencies of a track.

    Parameters
    ----------
    model : TrackDesign or TrackModel
        The track.

    Returns
    -------
    NaturalFrequencies
        Frequencies [Hz]; None where a single-stage track has no such mode.
    """
    found = np.empty(batch_kernels.FREQUENCIES)
    batch_kernels.natural_frequencies(model.row, found, True)
    loaded, block, rigid_blocks, on_boot, *cut_on = found.tolist()
    return NaturalFrequencies(
        loaded_track=loaded,
        coupled_block=None if math.isnan(block) else block,
        wheel_on_rigid_blocks=rigid_blocks,
        block_on_boot=None if math.isnan(on_boot) else on_boot,
        cut_on=tuple(each for each in cut_on if not math.isnan(each)),
    )


def loaded_track(design: Track) -> float:
    """Return the bound mode of the wheel on the supported rail.

    The lowest root of 1/k_H + alpha(f) - 1/(m_w w^2) = 0, with alpha the point receptance over a
    support. It lies below the frequency at which waves begin to run along the track, where alpha
    grows without bound, so it always exists.

    Parameters
    ----------
    design : TrackDesign or TrackModel
        The track and its wheel.

    Returns
    -------
    float
        Frequency [Hz].
    """
    return natural_frequencies(design).loaded_track


def coupled_block(design: Track) -> float | None:
    """Return the frequency of the block between pad and boot, the rail held.

    Parameters
    ----------
    design : TrackDesign or TrackModel
        The track.

    Returns
    -------
    float or None
        Frequency [Hz]; None when single-stage.
    """
    return natural_frequencies(design).coupled_block


def cut_on(design: Track) -> tuple[float, ...]:
    """Return the frequencies at which rail and block of every bay move as one, the wheel away.

    Parameters
    ----------
    design : TrackDesign or TrackModel
        The track.

    Returns
    -------
    tuple of float
        One frequency when single-stage, else two, ascending [Hz].
    """
    return natural_frequencies(design).cut_on


def coupled_pair(
    upper_stiffness: float, lower_stiffness: float, upper_mass: float, lower_mass: float
) -> tuple[float, float]:
    """Return the natural frequencies of two masses in series: mass, spring, mass, spring, ground.

    Parameters
    ----------
    upper_stiffness, lower_stiffness : float
        Spring between the masses, spring on the ground [N/m].
    upper_mass, lower_mass : float
        Masses [kg].

    Returns
    -------
    tuple of float
        Two frequencies, ascending [Hz].
    """
    # the two roots of (k_u - m_u x)(k_u + k_l - m_l x) = k_u^2, x = w^2
    upper, lower = upper_stiffness / upper_mass, (upper_stiffness + lower_stiffness) / lower_mass
    larger = (upper + lower) / 2 + math.sqrt((upper - lower) ** 2 / 4 + upper * upper_stiffness / lower_mass)
    # the smaller from their product, which does not cancel
    smaller = upper * lower_stiffness / lower_mass / larger
    return math.sqrt(smaller) / (2 * math.pi), math.sqrt(larger) / (2 * math.pi)


def consistent(natural: Callable[[Sequence[float]], float], laws: Sequence[Relaxation]) -> float:
    """Return the frequency that belongs to the stiffnesses which springs have at that frequency.

    Parameters
    ----------
    natural : callable
        ``natural(stiffnesses)`` returns a natural frequency [Hz], the higher the stiffer any spring [N/m].
    laws : sequence of Relaxation
        Laws of the springs.

    Returns
    -------
    float
        The frequency f = natural(Re K(f)) [Hz]. There is but one: Re K(f) / f^2 falls with frequency.
    """
    low = natural([law.stiffness(0.0) for law in laws]) * (1 - _MARGIN)
    high = natural([law.instantaneous for law in laws]) * (1 + _MARGIN)
    root = brentq(lambda f: f - natural([law.stiffness(f) for law in laws]), low, high, xtol=1e-9)
    return float(root)


def peak_near(frequency: RealArray, magnitude: RealArray, near: float) -> float | None:
    """Return where a response peaks in the octave and a half around a frequency.

    Parameters
    ----------
    frequency : numpy.ndarray (frequencies,)
        Frequencies [Hz], ascending.
    magnitude : numpy.ndarray (frequencies,)
        Response at those frequencies, greater than zero.
    near : float
        Frequency around which to look [Hz].

    Returns
    -------
    float or None
        Frequency of the highest peak [Hz], refined between points; None if there is none inside.
    """
    first = np.searchsorted(frequency, near / PEAK_REACH, side="right")
    inside = slice(first, np.searchsorted(frequency, near * PEAK_REACH))
    if frequency[inside].size < 5:
        return None
    peak = highest_peak(np.log(frequency[inside]), np.log(magnitude[inside]))
    return None if math.isnan(peak) else math.exp(peak)
