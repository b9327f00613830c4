"""How far insertion gain is from its limit as the grid is refined: in time, and along the rail.

dB over s and elements a bay. The frequency-domain solution is computed for the scheme with each time step
(its z-transform, which a run follows to 0.001 dB) or each number of elements, so a study takes milliseconds.
An error is the largest difference in any band from the same lattice in continuous time, or from the same
track with many more elements.
"""

from collections.abc import Iterable

import numpy as np

from trackig_core.arrays import RealArray
from trackig_core.frequency_domain.lattice import INFINITE, Lattice
from trackig_core.frequency_domain.refinement import banded_gain
from trackig_core.frequency_domain.track_model import Track, track_model

FINEST_ELEMENTS = 96
"""Elements a bay that stand for the continuous rail [-]: a thousand times more exact than three."""


def time_step_errors(design: Track, time_steps: Iterable[float], memory_order: int) -> RealArray:
    """Return the largest error of insertion gain in any band, for some time steps.

    Parameters
    ----------
    design : TrackDesign or TrackModel
        The track.
    time_steps : sequence of float (steps,)
        Time steps [s].
    memory_order : int
        1 for the paper's recursion of the damping memory, 2 for the second-order one.

    Returns
    -------
    numpy.ndarray (steps,)
        Largest difference in any band from continuous time [dB].

    Raises
    ------
    DesignError
        If the exact answer has no bound, for want of any loss.
    """
    lattices = [Lattice(time_step=step, memory_order=memory_order) for step in time_steps]
    return _errors(design, lattices, INFINITE)


def element_errors(design: Track, elements_per_bay: Iterable[int]) -> RealArray:
    """Return the largest error of insertion gain in any band, for some numbers of elements a bay.

    Parameters
    ----------
    design : TrackDesign or TrackModel
        The track.
    elements_per_bay : sequence of int (numbers,)
        Elements a bay, two or more.

    Returns
    -------
    numpy.ndarray (numbers,)
        Largest difference in any band from :data:`FINEST_ELEMENTS` [dB].

    Raises
    ------
    DesignError
        If the exact answer has no bound, for want of any loss.
    """
    lattices = [Lattice(elements_per_bay=number) for number in elements_per_bay]
    return _errors(design, lattices, Lattice(elements_per_bay=FINEST_ELEMENTS))


def _errors(design: Track, lattices: list[Lattice], limit: Lattice) -> RealArray:
    model = track_model(design)
    best = banded_gain(model, limit).levels
    return np.array([np.abs(banded_gain(model, lattice).levels - best).max() for lattice in lattices])
