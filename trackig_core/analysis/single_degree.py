"""One mass on one spring on a rigid base: the single-degree-of-freedom formula behind DIN 45673-4.

The insertion loss of a resilient track is estimated there as D_e = 20 lg |1 - w^2 M/s|, with M the mass above
the spring and s its complex stiffness. The formula knows no bending waves, no contact spring and no block, so
it is a line to compare with and no solution. Hz, dB; insertion gain is the negative of insertion loss.
"""

import numpy as np
from numpy.typing import ArrayLike

from trackig_core.analysis.lumped import effective_supports
from trackig_core.arrays import RealArray
from trackig_core.frequency_domain.track_model import Track, track_model


def single_degree_insertion_loss(frequency: ArrayLike, mass: float, stiffness: ArrayLike) -> RealArray:
    """Return the insertion loss of a mass on a spring.

    Parameters
    ----------
    frequency : array_like (frequencies,)
        Frequencies [Hz].
    mass : float
        Mass above the spring [kg].
    stiffness : array_like of complex (frequencies,)
        Complex dynamic stiffness of the spring, or one for all frequencies [N/m].

    Returns
    -------
    numpy.ndarray (frequencies,)
        Insertion loss, positive where the spring isolates [dB].
    """
    squared = (2 * np.pi * np.asarray(frequency, dtype=float)) ** 2
    return 20 * np.log10(np.abs(1 - squared * mass / np.asarray(stiffness)))


def single_degree_gain(design: Track, frequency: ArrayLike) -> RealArray:
    """Return the insertion gain of a design's wheel on its track's stiffness, by the single-degree formula.

    The spring is as many supports, pad and boot in series, as carry the wheel:
    :func:`trackig_core.analysis.effective_supports`.

    Parameters
    ----------
    design : TrackDesign or TrackModel
        The track; a model with hysteretic damping gives the formula as it is mostly used.
    frequency : array_like (frequencies,)
        Frequencies [Hz].

    Returns
    -------
    numpy.ndarray (frequencies,)
        Insertion gain against the rigid track, positive where the track amplifies [dB].
    """
    frequency = np.atleast_1d(np.asarray(frequency, dtype=float))
    model = track_model(design)
    support = 1 / sum(1 / law.dynamic_stiffness(frequency) for law in model.springs)
    stiffness = effective_supports(model) * support
    return -single_degree_insertion_loss(frequency, model.design.wheel_mass, stiffness)
