"""The hysteretic idealisation of damping: a stiffness and a loss factor that no frequency changes.

K(f) = k (1 + i eta), also called structural damping. It is what many other programs compute with and what
some suppliers state, and it is not causal: a spring that loses energy must stiffen with frequency, as
:mod:`trackig_core.track.viscoelastic_law` does, or it answers before it is pushed. So it stands in the
frequency domain alone, for comparison with other people's figures. N/m, Hz.
"""

from dataclasses import dataclass
from typing import NoReturn

import numpy as np
from numpy.typing import ArrayLike

from trackig_core.arrays import ComplexArray, RealArray
from trackig_core.track.design import DesignError, TrackDesign
from trackig_core.track.measured_curves import LossFactorCurve, StiffnessCurve
from trackig_core.track.viscoelastic_law import Relaxation


@dataclass(frozen=True)
class Hysteretic(Relaxation):
    """A pad's or boot's stiffness k (1 + i eta): a spring without memory that loses energy all the same.

    Attributes
    ----------
    loss : float or LossFactorCurve
        Loss factor [-], or as measured over frequency.
    """

    loss: float | LossFactorCurve

    @property
    def lossless(self) -> bool:
        """Whether the spring loses no energy."""
        return self.loss == 0.0

    @property
    def causal(self) -> bool:
        """Whether the spring answers only after it is pushed: it does not, if it loses energy."""
        return self.lossless

    def dynamic_stiffness(self, frequency: ArrayLike) -> ComplexArray:
        """Return the complex dynamic stiffness at given frequencies [Hz]; same shape, [N/m]."""
        return np.asarray(self.instantaneous * (1 + 1j * self.loss_factor(frequency)), dtype=complex)

    def loss_factor(self, frequency: ArrayLike) -> RealArray:
        """Return the loss factor at given frequencies [Hz]; same shape, [-]."""
        if isinstance(self.loss, LossFactorCurve):
            return self.loss.loss_factor(frequency)
        return np.full(np.shape(frequency), self.loss)

    def recursion(self, time_step: float, order: int) -> NoReturn:  # noqa: ARG002  (as any law)
        """Raise a ValueError: what is not causal cannot be stepped in time."""
        raise ValueError(
            "hysteretic damping is not causal and cannot be stepped in time: solve with fidelity 'exact', or "
            "with viscoelastic damping"
        )


def hysteretic_laws(design: TrackDesign) -> tuple[Hysteretic, Hysteretic | None]:
    """Return the hysteretic springs of a design's pads and boots.

    Parameters
    ----------
    design : TrackDesign
        The track.

    Returns
    -------
    pad : Hysteretic
        Spring of the pads.
    boot : Hysteretic or None
        Spring of the boots; None when single-stage.

    Raises
    ------
    DesignError
        If a stiffness is a measured curve, which says itself how it changes with frequency.
    """
    pad = _spring("pad_stiffness", design.pad_stiffness, design.pad_loss_factor)
    if design.boot_stiffness is None:
        return pad, None
    return pad, _spring("boot_stiffness", design.boot_stiffness, design.boot_loss_factor)


def _spring(
    field: str, stiffness: float | StiffnessCurve, loss_factor: float | LossFactorCurve | None
) -> Hysteretic:
    if isinstance(stiffness, StiffnessCurve) or loss_factor is None:
        raise DesignError(
            field, stiffness, "a number: hysteretic damping has one stiffness at all frequencies"
        )
    return Hysteretic(stiffness, (), (), 0.0, loss_factor)
