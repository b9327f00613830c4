"""The film: how rail, blocks, feet and wheels move after the step, from a run of its own.

A run as at live fidelity (see :mod:`trackig_core.time_domain.adaptive_grid`), short, that records every
rail element, every block and, where the ground yields, every foot near the wheel. Frames are samples of the
low-passed displacements, SI units,
positive towards the ground; the track to the left of one wheel is the mirror image of that to the right. The
step reaches several wheels each with its delay, or all at once where their roughness is independent.
The wheel begins one step below a rail at rest, squeezing the contact spring (see
:mod:`trackig_core.track.design`); the filter rounds that jump off over the millisecond around time zero.
Nothing is interpolated, in time or along the rail.
"""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from trackig_core.arrays import RealArray
from trackig_core.frequency_domain.axles import wheel_elements
from trackig_core.frequency_domain.track_model import Track, track_model
from trackig_core.time_domain import adaptive_grid
from trackig_core.time_domain.decimation import RECORD_RATE
from trackig_core.time_domain.grid import FEWEST_BAYS, Grid, fewest_bays, make_grid
from trackig_core.time_domain.time_stepping import Probes, Run
from trackig_core.track.design import DEFAULT_STEP
from trackig_core.words import quantity

DURATION = 0.3
"""Length of the film [s]: some ten periods of an ordinary loaded track."""

STRIDE = 2
"""Samples of the record per frame [-]: 2048 frames a second, three a period at the filter's edge."""

BAYS = 12
"""Bays shown to either side of the wheel unless others are asked for [-]."""

MOST_BAYS = 60
"""Bays that may be asked for [-]: a film stays below 2 MB."""


@dataclass(frozen=True, eq=False)
class Motion:
    """Displacements after the step: to one side of a wheel that stands alone over a support, else to both.

    Attributes
    ----------
    time : numpy.ndarray (frames,) [s]
        Time of each frame; it begins shortly before zero because the low-pass filter looks ahead.
    position : numpy.ndarray (elements,) [m]
        Rail elements, counted from support 0.
    support_position : numpy.ndarray (supports,) [m]
        Supports, counted from support 0.
    wheel_position : numpy.ndarray (wheels,) [m]
        Wheels, on the rail elements on which they stand.
    wheels : numpy.ndarray (frames, wheels) [m]
        Displacement of the wheels.
    rail : numpy.ndarray (frames, elements) [m]
        Displacement of the rail.
    block : numpy.ndarray (frames, supports) [m] or None
        Displacement of the blocks; None when single-stage.
    foot : numpy.ndarray (frames, supports) [m] or None
        Displacement of the supports' feet; None on rigid ground.
    step : float [m]
        Height of the step.
    """

    time: RealArray = field(repr=False)
    position: RealArray = field(repr=False)
    support_position: RealArray = field(repr=False)
    wheel_position: RealArray = field(repr=False)
    wheels: RealArray = field(repr=False)
    rail: RealArray = field(repr=False)
    block: RealArray | None = field(repr=False)
    foot: RealArray | None = field(repr=False)
    step: float

    @property
    def wheel(self) -> RealArray:
        """Displacement of the first wheel (frames,) [m]."""
        return self.wheels[:, 0]

    def __str__(self) -> str:
        """Return length and largest displacements of the film, with their units."""
        moves = quantity(float(np.abs(self.rail).max()), "m", 3)
        return (
            f"{self.time.size} frames from {quantity(float(self.time[0]), 's', 3)} to "
            f"{quantity(float(self.time[-1]), 's', 3)}, {self.support_position.size} supports: after a step "
            f"of {quantity(self.step, 'm')} the rail moves by up to {moves}"
        )


def film(
    design: Track,
    bays: int = BAYS,
    step: float = DEFAULT_STEP,
    cancelled: Callable[[], object] | None = None,
) -> Motion:
    """Return how a track moves in the first 0.3 s after the step.

    Parameters
    ----------
    design : TrackDesign or TrackModel
        The track.
    bays : int
        Bays to one side of the wheel, or to either side of the outermost, 1 to 60.
    step : float
        Step that squeezes the contact spring [m].
    cancelled : callable, optional
        Asked now and then; the run ends when it answers true.

    Returns
    -------
    Motion
        Some 600 frames.

    Raises
    ------
    DesignError
        If the exact answer has no bound, for want of any loss: no grid can then be chosen.
    RunTooLargeError
        If the run would need more than 2 GB or 60 s.
    SolveCancelled
        If ``cancelled`` answered true.
    ValueError
        If ``bays`` is not from 1 to 60.
    """
    if not 1 <= bays <= MOST_BAYS:
        raise ValueError(f"bays = {bays!r}: give a whole number from 1 to {MOST_BAYS}")
    model = track_model(design)
    grid = film_grid(model, bays)
    per_bay = grid.elements_per_bay
    on = np.array(wheel_elements(model.design, per_bay))
    first = 0 if grid.symmetric else on.min() // per_bay - bays
    supports = np.arange(first, -(-on.max() // per_bay) + bays + 1)
    elements = np.arange(supports[0] * per_bay, supports[-1] * per_bay + 1)
    two_stage, yields = model.design.two_stage, model.design.ground is not None
    probes = Probes(tuple(elements), *(tuple(supports) if there else () for there in (two_stage, yields)))
    run = Run(model, grid, memory_order=adaptive_grid.MEMORY_ORDER, step=step, probes=probes)
    samples = run.collect(grid.steps, cancelled=cancelled)
    moved = samples[::STRIDE, grid.stored_bays :]
    wheels, rail, below = np.split(moved, [on.size, on.size + elements.size], axis=1)
    return Motion(
        time=run.filter.times(len(samples))[::STRIDE],
        position=elements.astype(np.float64) * grid.dx,
        support_position=supports.astype(np.float64) * model.design.fastener_spacing,
        wheel_position=on * grid.dx,
        wheels=wheels,
        rail=rail,
        block=below[:, : supports.size] if two_stage else None,
        foot=below[:, -supports.size :] if yields else None,
        step=step,
    )


def film_grid(design: Track, bays: int) -> Grid:
    """Return the grid of a film: live fidelity's, its ring no shorter than what is shown.

    Parameters
    ----------
    design : TrackDesign or TrackModel
        The track.
    bays : int
        Bays to one side of the wheel.

    Returns
    -------
    Grid
        The grid; its steps are those of the film.

    Raises
    ------
    DesignError, RunTooLargeError
        As in :func:`film`.
    """
    model = track_model(design)
    chosen = adaptive_grid.plan(model).grid
    # the record is whole frames long, whatever the time step
    record = round(DURATION * RECORD_RATE) / RECORD_RATE
    shown = 2 * bays + fewest_bays(model) - FEWEST_BAYS
    return make_grid(model, chosen.dt, bays=max(chosen.bays, shown + 1), record=record)
