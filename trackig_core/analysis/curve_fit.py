"""How well the law of a pad or boot follows what was measured of it, point by point.

Relative errors of stiffness and loss factor. The law is fitted from 5 to 500 Hz; points outside are compared
too, and count in no figure. Source of the law: :mod:`trackig_core.track.viscoelastic_law`.
"""

from dataclasses import dataclass, field

import numpy as np

from trackig_core.arrays import BoolArray, RealArray
from trackig_core.track.measured_curves import LossFactorCurve, StiffnessCurve
from trackig_core.track.viscoelastic_law import FIT_FREQUENCIES, Relaxation, relaxation


@dataclass(frozen=True, eq=False)
class CurveFit:
    """The law that stands for a measured curve, beside its points.

    Attributes
    ----------
    law : Relaxation
        The law [N/m]; of a loss factor alone, for a stiffness of 1 N/m at 50 Hz.
    frequency : numpy.ndarray (points,) [Hz]
        Where was measured.
    stiffness_error : numpy.ndarray (points,) [-] or None
        Stiffness of the law over that measured, less one; None where no stiffness was measured.
    loss_factor_error : numpy.ndarray (points,) [-]
        Loss factor of the law over that measured, less one.
    """

    law: Relaxation
    frequency: RealArray = field(repr=False)
    stiffness_error: RealArray | None = field(repr=False)
    loss_factor_error: RealArray = field(repr=False)

    @property
    def is_fitted(self) -> BoolArray:
        """Whether each point lies where the law is fitted (points,)."""
        low, high = FIT_FREQUENCIES[[0, -1]]
        return (self.frequency > low * (1 - _NEAR)) & (self.frequency < high * (1 + _NEAR))

    @property
    def error_at_points(self) -> float | None:
        """Largest relative error at the points from 5 to 500 Hz [-]; None if there is none."""
        errors = [self.loss_factor_error, *([] if self.stiffness_error is None else [self.stiffness_error])]
        at = self.is_fitted
        return float(np.abs([each[at] for each in errors]).max()) if at.any() else None

    @property
    def error_between(self) -> float:
        """Largest relative error from 5 to 500 Hz against straight lines over log frequency [-].

        Beyond the points the loss factor counts as it is at the last one; stiffness does not count there.
        """
        return self.law.worst_error

    def __str__(self) -> str:
        """Return how far the law is from what was measured, in per cent."""
        at_points = self.error_at_points
        said = "no point" if at_points is None else f"{100 * at_points:.2g} % at the points"
        return f"fitted law, 5 to 500 Hz: largest error {said}, {100 * self.error_between:.2g} % between them"


_NEAR = 1e-9


def curve_fit(curve: StiffnessCurve | LossFactorCurve) -> CurveFit:
    """Return the law that stands for a measured curve, and how far it is from every point.

    Parameters
    ----------
    curve : StiffnessCurve or LossFactorCurve
        What was measured.

    Returns
    -------
    CurveFit
        Law and errors; some 10 ms the first time.
    """
    points = np.array(curve.points)
    frequency, stated = points[:, 0], points[:, -1]
    if isinstance(curve, StiffnessCurve):
        law = relaxation(curve, None)
        stiffness_error = law.dynamic_stiffness(frequency).real / points[:, 1] - 1
    else:
        law, stiffness_error = relaxation(1.0, curve), None
    return CurveFit(law, frequency, stiffness_error, law.loss_factor(frequency) / stated - 1)
