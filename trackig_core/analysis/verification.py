"""A solution held against theory: how far it is from the exact answer, and why.

A run differs from the exact continuous-time answer of its lattice by what its time step costs, and from
the exact answer of its own scheme (the z-transform) by mistakes alone. Hz, dB, s. The theory is that of
:mod:`trackig_core.frequency_domain.floquet_waves`.

The one rule: nothing here is taken from the run but its grid; the run is only compared.
"""

from dataclasses import dataclass, field

import numpy as np

from trackig_core.frequency_domain.convergence import element_errors, time_step_errors
from trackig_core.frequency_domain.floquet_waves import Lattice, exact_spectrum
from trackig_core.frequency_domain.refinement import banded_spectrum, require_damping
from trackig_core.results import ForceSpectrum, Solution
from trackig_core.time_domain.grid import stable_time_step

FACTORS = np.array([0.25, 0.5, 1.0, 2.0, 4.0, 8.0])
"""Time steps of the convergence study, in parts of the run's [-]; those that are unstable are left out."""

ELEMENTS = np.array([2, 3, 4, 6, 8, 12, 24])
"""Elements a bay of the convergence study [-]."""


@dataclass(frozen=True, eq=False)
class Verification:
    """What theory says of a run.

    Attributes
    ----------
    exact : ForceSpectrum
        Exact answer of the lattice: infinitely long, in continuous time.
    scheme : ForceSpectrum
        Exact answer of the run's own scheme, its z-transform on the ring, at the run's frequencies.
    time_steps : numpy.ndarray (steps,) [s]
        Time steps at which the scheme is stable.
    first_order_errors, second_order_errors : numpy.ndarray (steps,) [dB]
        Largest error of insertion gain in any band at each time step, by rule of the damping memory.
    elements_per_bay : numpy.ndarray (numbers,) [-]
        Elements a bay.
    element_errors : numpy.ndarray (numbers,) [dB]
        Largest error of insertion gain in any band at each number of elements.
    """

    exact: ForceSpectrum
    scheme: ForceSpectrum
    time_steps: np.ndarray = field(repr=False)
    first_order_errors: np.ndarray = field(repr=False)
    second_order_errors: np.ndarray = field(repr=False)
    elements_per_bay: np.ndarray = field(repr=False)
    element_errors: np.ndarray = field(repr=False)


def verify(solution):
    """Compute what theory says of a time-stepped solution.

    Parameters
    ----------
    solution : Solution
        A solution with a grid; its time history is not needed.

    Returns
    -------
    Verification
        Exact spectra and convergence studies of the same design, in some tens of milliseconds.

    Raises
    ------
    TypeError
        If it is no solution.
    ValueError
        If the solution was not stepped in time.
    DesignError
        If the exact answer has no bound, for want of any loss.
    """
    if not isinstance(solution, Solution):
        raise TypeError(f"{type(solution).__name__} is no Solution: give what solve() returned")
    grid, design = solution.grid, solution.design
    if grid is None:
        raise ValueError(
            f"a solution of fidelity {solution.fidelity!r} was not stepped in time: give one that was"
        )
    require_damping(design)
    lattice = Lattice(grid.elements_per_bay, grid.bays, grid.dt)
    time_steps = grid.dt * FACTORS
    time_steps = time_steps[time_steps < stable_time_step(design, grid.dx)]
    step = solution.spectrum.step
    return Verification(
        exact=banded_spectrum(design, solution.natural_frequencies.loaded_track, step=step),
        scheme=exact_spectrum(design, solution.spectrum.frequency, step, lattice),
        time_steps=time_steps,
        first_order_errors=time_step_errors(design, time_steps, memory_order=1),
        second_order_errors=time_step_errors(design, time_steps, memory_order=2),
        elements_per_bay=ELEMENTS,
        element_errors=element_errors(design, ELEMENTS),
    )
