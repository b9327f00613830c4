"""A track and its laws as rows of numbers: as compiled code takes them. SI units and s."""

import numpy as np

from trackig_core.arrays import IntArray, RealArray
from trackig_core.frequency_domain import axle_kernels
from trackig_core.track.design import ELEMENTS_PER_BAY, TrackDesign, axle_elements
from trackig_core.track.viscoelastic_law import Relaxation


def law_row(law: Relaxation | None) -> list[float]:
    """Return a pad's or boot's law as the kernels take it (7,): k_inf, strengths [N/m], times [s].

    Parameters
    ----------
    law : Relaxation or None
        The law; None where there is no such spring.

    Returns
    -------
    list of float
        Seven numbers; without memory the strengths are zero.
    """
    if law is None:
        return [0.0] * 7
    none = (0.0,) * (3 - len(law.strengths))
    return [law.instantaneous, *law.strengths, *none, *law.times, *none]


def recursion_row(law: Relaxation | None, time_step: float, order: int) -> RealArray:
    """Return a pad's or boot's law as it is stepped (7,): stiffness [N/m], decays [-], feeds [N/m].

    Parameters
    ----------
    law : Relaxation or None
        The law; None where there is no such spring.
    time_step : float
        Time step [s].
    order : int
        1 for the paper's recursion of the damping memory, 2 for the second-order one.

    Returns
    -------
    numpy.ndarray (7,)
        Zero for no spring; without memory decays and feeds are zero.
    """
    row = np.zeros(7)
    if law is not None:
        terms = len(law.times)
        row[0], row[1 : 1 + terms], row[4 : 4 + terms] = law.recursion(time_step, order)
    return row


def track_row(design: TrackDesign, pad: Relaxation, boot: Relaxation | None) -> RealArray:
    """Return a design as the kernels take it.

    Parameters
    ----------
    design : TrackDesign
        The track.
    pad, boot : Relaxation
        Laws of its pads and boots; ``boot`` is None when single-stage.

    Returns
    -------
    numpy.ndarray (19,)
        See :data:`trackig_core.frequency_domain.wave_kernels.COLUMNS`.
    """
    dx = design.fastener_spacing / ELEMENTS_PER_BAY
    return np.array(
        [
            *law_row(pad),
            *law_row(boot),
            design.block_mass or 0.0,
            design.rail.bending_stiffness / dx**3,
            design.rail.mass_per_metre * dx,
            design.wheel_mass,
            design.contact_stiffness,
        ]
    )


def surroundings_row(design: TrackDesign) -> RealArray:
    """Return suspension and ground of a design as the kernels take them.

    Parameters
    ----------
    design : TrackDesign
        The track.

    Returns
    -------
    numpy.ndarray (9,)
        See :data:`trackig_core.frequency_domain.axle_kernels.SURROUNDINGS`.
    """
    row = np.zeros(axle_kernels.SURROUNDINGS)
    suspension, ground = design.suspension, design.ground
    if suspension is not None:
        primary = suspension.primary_stiffness, suspension.primary_damping, suspension.bogie_mass
        row[: axle_kernels.FOOT] = *primary, *suspension.secondary
    if ground is not None:
        row[axle_kernels.FOOT :] = ground.stiffness, ground.damping, ground.mass
    return row


def wheel_row(design: TrackDesign) -> IntArray:
    """Return the rail elements on which wheels stand (wheels,), 0 over support 0."""
    return np.array(axle_elements(design.axle_positions, design.fastener_spacing))
