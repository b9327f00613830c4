"""What damping does: stiffness and loss factor over frequency, and insertion gain at other loss factors.

A causal damper must stiffen with frequency: the stored part of its force cannot be had without the lost
part (Kramers and Kronig). So loss that tames a resonance costs isolation above it, where the stiffer spring
passes more. What is shown are the laws that the solvers use, not the targets to which they were fitted. Hz,
dB; stiffness as a ratio to that at 50 Hz. Source: :mod:`trackig_core.track.viscoelastic_law`.
"""

from collections.abc import Iterable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike

from trackig_core.arrays import RealArray
from trackig_core.frequency_domain.refinement import banded_gain
from trackig_core.frequency_domain.track_model import Track, track_model
from trackig_core.track.design import REFERENCE_FREQUENCY, TrackDesign
from trackig_core.track.viscoelastic_law import Relaxation
from trackig_core.words import span

LOSS_FACTORS = (0.05, 0.2, 0.5)
"""Loss factors that are compared unless others are asked for [-]: a resilient, a common, a lossy material."""


@dataclass(frozen=True, eq=False)
class DampingCurve:
    """A pad's or boot's law over frequency.

    Attributes
    ----------
    frequency : numpy.ndarray (frequencies,) [Hz]
        Frequencies.
    stiffness : numpy.ndarray (frequencies,) [-]
        Re K(f) over Re K(50 Hz).
    loss_factor : numpy.ndarray (frequencies,) [-]
        Im K(f) over Re K(f).
    """

    frequency: RealArray = field(repr=False)
    stiffness: RealArray = field(repr=False)
    loss_factor: RealArray = field(repr=False)

    def __str__(self) -> str:
        """Return the range of loss factor and stiffness over frequency."""
        return (
            f"{span(self.frequency, 'Hz')}: loss factor {span(self.loss_factor, '')}, stiffness "
            f"{span(self.stiffness, '')} of that at {REFERENCE_FREQUENCY:g} Hz"
        )


def damping_curves(design: Track, frequency: ArrayLike) -> tuple[DampingCurve, DampingCurve | None]:
    """Return how stiff and how lossy pad and boot are over frequency.

    Parameters
    ----------
    design : TrackDesign or TrackModel
        The track.
    frequency : array_like (frequencies,)
        Frequencies [Hz].

    Returns
    -------
    pad : DampingCurve
        Of the pads.
    boot : DampingCurve or None
        Of the boots; None when single-stage.
    """
    frequency = np.atleast_1d(np.asarray(frequency, dtype=float))
    model = track_model(design)
    return _curve(model.pad, frequency), None if model.boot is None else _curve(model.boot, frequency)


def _curve(law: Relaxation, frequency: RealArray) -> DampingCurve:
    relative = law.dynamic_stiffness(frequency).real / law.stiffness(REFERENCE_FREQUENCY)
    return DampingCurve(frequency, relative, law.loss_factor(frequency))


def with_loss_factor(design: Track, loss_factor: float) -> TrackDesign:
    """Return a design whose pads and boots all have one loss factor, their stated stiffness unchanged.

    Parameters
    ----------
    design : TrackDesign or TrackModel
        The track.
    loss_factor : float
        Loss factor [-].

    Returns
    -------
    TrackDesign
        The changed design; measured curves give way to numbers.

    Raises
    ------
    DesignError
        If the loss factor is not allowed.
    """
    model = track_model(design)
    changes = {}
    for part, law in zip(("pad", "boot"), model.springs, strict=False):
        changes[f"{part}_stiffness"] = law.stiffness(model.design.stiffness_frequency)
        changes[f"{part}_loss_factor"] = loss_factor
    return model.design.replace(**changes)


def gain_by_loss_factor(
    design: Track,
    loss_factors: Iterable[float] = LOSS_FACTORS,
    reference: str | None = None,
    summation: str = "energy",
) -> RealArray:
    """Return the exact insertion gain of a design at several loss factors.

    Parameters
    ----------
    design : TrackDesign or TrackModel
        The track.
    loss_factors : sequence of float (factors,)
        Loss factors of pads and boots alike [-].
    reference : str, optional
        As for :func:`trackig_core.solve`.
    summation : str
        As for :func:`trackig_core.insertion_gain`.

    Returns
    -------
    numpy.ndarray (factors, 21)
        Insertion gain per band [dB].

    Raises
    ------
    DesignError
        If a loss factor is not allowed, or is zero.
    ValueError
        If ``reference`` or ``summation`` is not one of the choices.
    """
    model = track_model(design)
    changed = [with_loss_factor(model, loss_factor) for loss_factor in loss_factors]
    return np.array([banded_gain(each, reference=reference, summation=summation).levels for each in changed])
