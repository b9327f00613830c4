"""A solution compared with theory: how far it is from the exact answer, and why.

A run differs from the exact continuous-time answer of its lattice by what its time step costs, and from
the exact answer of its own scheme (the z-transform) by mistakes alone. Nothing but its grid is taken from the
run. Hz, dB, s. The theory is that of :mod:`trackig_core.frequency_domain.floquet_waves`.
"""

from dataclasses import dataclass, field

import numpy as np

from trackig_core.arrays import IntArray, RealArray
from trackig_core.frequency_domain.convergence import element_errors, time_step_errors
from trackig_core.frequency_domain.floquet_waves import exact_spectrum
from trackig_core.frequency_domain.lattice import Lattice
from trackig_core.frequency_domain.refinement import banded_spectrum
from trackig_core.frequency_domain.track_model import track_model
from trackig_core.results import ForceSpectrum
from trackig_core.solution import Solution
from trackig_core.time_domain.adaptive_grid import MEMORY_ORDER
from trackig_core.time_domain.grid import paper_memory_order, stable_time_step
from trackig_core.words import quantity

FACTORS = np.array([0.25, 0.5, 1.0, 2.0, 4.0, 8.0])
"""Time steps of the convergence study, in parts of the run's [-]; those that are unstable are left out."""

ELEMENTS = np.array([2, 3, 4, 6, 8, 12, 24])
"""Elements a bay of the convergence study [-]."""


@dataclass(frozen=True, eq=False)
class Verification:
    """The frequency-domain solutions that a run is compared with.

    Attributes
    ----------
    exact : ForceSpectrum
        Exact answer of the lattice: infinitely long, in continuous time.
    scheme : ForceSpectrum
        Exact answer of the run's own scheme, its z-transform on the ring, at the run's frequencies.
    time_steps : numpy.ndarray (steps,) [s]
        Time steps at which the scheme is stable.
    first_order_errors, second_order_errors : numpy.ndarray (steps,) [dB]
        Largest error of insertion gain in any band at each time step, by rule of the damping memory; NaN
        where the first order is unstable.
    memory_order : int
        Order of the run's own memory.
    elements_per_bay : numpy.ndarray (numbers,) [-]
        Elements a bay.
    element_errors : numpy.ndarray (numbers,) [dB]
        Largest error of insertion gain in any band at each number of elements.
    """

    exact: ForceSpectrum
    scheme: ForceSpectrum
    memory_order: int
    time_steps: RealArray = field(repr=False)
    first_order_errors: RealArray = field(repr=False)
    second_order_errors: RealArray = field(repr=False)
    elements_per_bay: IntArray = field(repr=False)
    element_errors: RealArray = field(repr=False)

    @property
    def run_errors(self) -> RealArray:
        """Largest error of insertion gain at each time step by the run's own memory (steps,) [dB]."""
        return self.first_order_errors if self.memory_order == 1 else self.second_order_errors

    def __str__(self) -> str:
        """Return what time step and elements cost the run, in words [dB]."""
        own = FACTORS.tolist().index(1.0)
        step, three = quantity(1e6 * self.time_steps[own], "µs", 3), self.elements_per_bay.tolist().index(3)
        return (
            f"time step {step} with damping memory of order {self.memory_order}: insertion gain within "
            f"{self.run_errors[own]:.2g} dB of continuous time in every band; 3 elements a bay: within "
            f"{self.element_errors[three]:.2g} dB of a rail without elements"
        )


def verify(solution: Solution) -> Verification:
    """Compare a time-stepped solution with the frequency-domain solution.

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
    grid = solution.grid
    if grid is None:
        raise ValueError(
            f"a solution of fidelity {solution.fidelity!r} was not stepped in time: give one that was"
        )
    model = track_model(solution.design)
    order = MEMORY_ORDER if solution.fidelity == "live" else paper_memory_order(model, grid.dt)
    lattice = Lattice(grid.elements_per_bay, grid.bays, grid.dt, memory_order=order)
    time_steps = grid.dt * FACTORS
    time_steps = time_steps[time_steps < stable_time_step(model, grid.dx)]
    first_order_errors = np.full(time_steps.shape, np.nan)
    holds = np.array([paper_memory_order(model, each) == 1 for each in time_steps], bool)
    first_order_errors[holds] = time_step_errors(model, time_steps[holds], memory_order=1)
    step = solution.spectrum.step
    return Verification(
        exact=banded_spectrum(model, step=step),
        scheme=exact_spectrum(model, solution.spectrum.frequency, step, lattice),
        time_steps=time_steps,
        memory_order=order,
        first_order_errors=first_order_errors,
        second_order_errors=time_step_errors(model, time_steps, memory_order=2),
        elements_per_bay=ELEMENTS,
        element_errors=element_errors(model, ELEMENTS),
    )
