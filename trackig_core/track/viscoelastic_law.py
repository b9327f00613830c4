"""Loss factor -> Boltzmann relaxation: damping that a time-stepping solver can integrate.

A pad or boot under strain e(t) answers with

    sigma(t) = k_inf e(t) - sum_j (k_j / tau_j) integral_0^inf e(t - s) exp(-s / tau_j) ds

so its dynamic stiffness is K(w) = k_inf - sum_j k_j / (1 + i w tau_j), three terms, and its loss
factor Im K / Re K. Such a material is causal, so it stiffens with frequency as much as its damping
demands. N/m, s, Hz. Source: the paper (see :mod:`trackig_core.track.design`), damping section.

Re K at the frequency that the design names, 50 Hz unless it says otherwise, is exactly the dynamic stiffness
that the designer stated; a table of measured stiffness is met as well as three terms can.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import least_squares

from trackig_core.arrays import ComplexArray, RealArray
from trackig_core.track.damping_table import interpolated_terms
from trackig_core.track.design import REFERENCE_FREQUENCY, TrackDesign
from trackig_core.track.measured_curves import LossFactorCurve, StiffnessCurve

FIT_FREQUENCIES = np.geomspace(5.0, 500.0, 100)
"""Frequencies at which the fitted loss factor is compared with its target (100,) [Hz]."""
FIT_FREQUENCIES.flags.writeable = False

SHORTEST_TIME = 1e-4
"""Least relaxation time [s]. A shorter one would lie above the bands, where it is but a stiffer spring, and
so near the time step that the paper's recursion of the memory turns unstable."""

LONGEST_TIME = 0.3
"""Greatest relaxation time [s]. A longer one would lie below the bands, where it is but a softer spring, and
outlast the record."""

_BOUNDS = (np.log([1e-9] * 3 + [SHORTEST_TIME] * 3), np.log([1e4] * 3 + [LONGEST_TIME] * 3))
"""Least and greatest logarithm of strengths over static stiffness and mean loss factor [-], of times [s]."""

NEGLIGIBLE = 1e-9
"""Loss factor below which a spring is taken to have no memory [-]."""

_START_TIMES = (2.2e-2, 2.8e-3, 3.5e-4)
"""Relaxation times from which every fit starts [s]: evenly spaced over the inverse of 5-500 Hz."""


@dataclass(frozen=True)
class Relaxation:
    """A pad's or boot's viscoelastic law.

    Attributes
    ----------
    instantaneous : float [N/m]
        Stiffness against a sudden strain, k_inf.
    strengths : tuple of float [N/m]
        Stiffness k_j that each term loses in time; empty without damping.
    times : tuple of float [s]
        Relaxation time tau_j of each term.
    worst_error : float [-]
        Largest relative error against what was stated, 5-500 Hz: of the loss factor, and of a measured
        stiffness.
    """

    instantaneous: float
    strengths: tuple[float, ...]
    times: tuple[float, ...]
    worst_error: float

    @property
    def lossless(self) -> bool:
        """Whether the spring loses no energy."""
        return not self.strengths

    @property
    def causal(self) -> bool:
        """Whether the spring answers only after it is pushed, so that it can be stepped in time."""
        return True

    def dynamic_stiffness(self, frequency: ArrayLike) -> ComplexArray:
        """Return the complex dynamic stiffness K(f), time dependence exp(+i w t).

        Parameters
        ----------
        frequency : array_like
            Frequencies [Hz].

        Returns
        -------
        numpy.ndarray of complex
            Dynamic stiffness [N/m], of the same shape.
        """
        return _relaxed(frequency, self.instantaneous, self.strengths, self.times)

    def stiffness(self, frequency: float) -> float:
        """Return Re K at one frequency [Hz]: the stiffness without its loss [N/m]."""
        angular = 2 * math.pi * frequency
        return self.instantaneous - sum(
            strength / (1 + (angular * time) ** 2)
            for strength, time in zip(self.strengths, self.times, strict=True)
        )

    def loss_factor(self, frequency: ArrayLike) -> RealArray:
        """Return the loss factor Im K / Re K at given frequencies [Hz]; same shape, [-]."""
        stiffness = self.dynamic_stiffness(frequency)
        return stiffness.imag / stiffness.real

    def recursion(self, time_step: float, order: int) -> tuple[float, RealArray, RealArray]:
        """Return the numbers that integrate the law step by step.

        With S_j the convolution of strain with exp(-s / tau_j), the force is
        k_inf e - sum_j k_j S_j / tau_j. First order (the paper): S_j <- S_j exp(-dt/tau_j) + e dt,
        the current strain included. Second order: the exponential is integrated exactly against
        strain that is linear between steps. Both are returned in one form, with memory terms
        R_j [N] that leave the current strain out:

            force = k_now e - sum_j R_j,    then    R_j <- decay_j R_j + gain_j e

        Parameters
        ----------
        time_step : float
            dt [s].
        order : int
            1 (the paper's recursion) or 2.

        Returns
        -------
        stiffness : float
            k_now, the factor of the current strain [N/m].
        decay, gain : numpy.ndarray (terms,)
            Factor per step [-] and feed [N/m] of the memory terms.
        """
        times, strengths = np.array(self.times), np.array(self.strengths)
        decay = np.exp(-time_step / times)
        if order == 1:
            now, before = np.full_like(times, time_step), np.zeros_like(times)
        else:
            mean = times * -np.expm1(-time_step / times) / time_step
            now, before = times * (1 - mean), times * (mean - decay)
        rate = strengths / times
        return self.instantaneous - float(rate @ now), decay, rate * (decay * now + before)


def _relaxed(
    frequency: ArrayLike, instantaneous: float, strengths: Sequence[float], times: Sequence[float]
) -> ComplexArray:
    """Return k_inf - sum_j k_j / (1 + i w tau_j)."""
    angular = 2j * np.pi * np.asarray(frequency, dtype=float)
    return instantaneous - sum(
        (strength / (1 + angular * time) for strength, time in zip(strengths, times, strict=True)),
        start=np.zeros_like(angular),
    )


def relaxation(
    stiffness: float | StiffnessCurve,
    loss_factor: float | LossFactorCurve | None,
    frequency: float = REFERENCE_FREQUENCY,
) -> Relaxation:
    """Return the relaxation law of a pad or boot.

    Parameters
    ----------
    stiffness : float or StiffnessCurve
        Dynamic stiffness at the given frequency [N/m], or as measured over frequency.
    loss_factor : float or LossFactorCurve or None
        Loss factor wanted from 5 to 500 Hz [-]; zero gives a spring without memory. None with a
        StiffnessCurve.
    frequency : float
        Frequency at which a stiffness holds that is a number [Hz].

    Returns
    -------
    Relaxation
        The fitted law.
    """
    if isinstance(stiffness, StiffnessCurve):
        return _fit_stiffness(stiffness.without_preload)
    measured = isinstance(loss_factor, LossFactorCurve)
    law = fit_loss_factor(loss_factor) if measured else constant_loss_factor(loss_factor)
    return _scaled(law, stiffness, frequency)


def laws(design: TrackDesign) -> tuple[Relaxation, Relaxation | None]:
    """Return the laws of a design's pads and boots.

    Parameters
    ----------
    design : TrackDesign
        The track.

    Returns
    -------
    pad : Relaxation
        Law of the pads.
    boot : Relaxation or None
        Law of the boots; None when single-stage.
    """
    frequency = design.stiffness_frequency
    pad = relaxation(design.pad_stiffness, design.pad_loss_factor, frequency)
    if design.boot_stiffness is None:
        return pad, None
    return pad, relaxation(design.boot_stiffness, design.boot_loss_factor, frequency)


@lru_cache(maxsize=256)
def constant_loss_factor(loss_factor: float) -> Relaxation:
    """Return the relaxation law of a constant loss factor, from the table of fits.

    Parameters
    ----------
    loss_factor : float
        Loss factor from 5 to 500 Hz [-], from zero to two.

    Returns
    -------
    Relaxation
        The law, for a stiffness of 1 N/m at 50 Hz; slowest term first. Without memory if the loss factor is
        below :data:`NEGLIGIBLE`.
    """
    if loss_factor < NEGLIGIBLE:
        return Relaxation(1.0, (), (), 0.0)
    strengths, times, worst_error = interpolated_terms(loss_factor)
    law = Relaxation(0.0, tuple(strengths.tolist()), tuple(times.tolist()), float(worst_error))
    return replace(law, instantaneous=1.0 - law.stiffness(REFERENCE_FREQUENCY))


@lru_cache(maxsize=256)
def fit_loss_factor(loss_factor: float | LossFactorCurve) -> Relaxation:
    """Fit three relaxation terms to a loss factor by least squares.

    The sum over :data:`FIT_FREQUENCIES` of squared relative errors of the loss factor is made smallest.

    Parameters
    ----------
    loss_factor : float or LossFactorCurve
        Target loss factor [-], greater than zero.

    Returns
    -------
    Relaxation
        The law, for a stiffness of 1 N/m at 50 Hz; slowest term first.
    """
    if isinstance(loss_factor, LossFactorCurve):
        target = loss_factor.loss_factor(FIT_FREQUENCIES)
    else:
        target = np.full_like(FIT_FREQUENCIES, loss_factor)
    return _scaled(_fit(lambda law: law.loss_factor(FIT_FREQUENCIES) / target - 1, target.mean()), 1.0)


@lru_cache(maxsize=256)
def _fit_stiffness(curve: StiffnessCurve) -> Relaxation:
    """Fit three relaxation terms to measured stiffness and loss factor, errors of both weighed alike.

    Beyond the measured frequencies stiffness is left to follow from the loss factor, as causality asks.
    """
    covered = FIT_FREQUENCIES[curve.covers(FIT_FREQUENCIES)]
    loss_factor = curve.loss_factor(FIT_FREQUENCIES)
    # A table wholly outside 5-500 Hz still says how stiff the spring is.
    at = covered if covered.size else np.array([curve.points[0][0]])
    stiffness = curve.stiffness(at)

    def relative_errors(law: Relaxation) -> RealArray:
        scale = np.exp(np.mean(np.log(stiffness / law.dynamic_stiffness(at).real)))
        return np.concatenate(
            [
                law.loss_factor(FIT_FREQUENCIES) / loss_factor - 1,
                scale * law.dynamic_stiffness(at).real / stiffness - 1,
            ]
        )

    law = _fit(relative_errors, loss_factor.mean())
    scale = np.exp(np.mean(np.log(stiffness / law.dynamic_stiffness(at).real)))
    return _scaled(law, float(scale * law.stiffness(REFERENCE_FREQUENCY)))


def _scaled(law: Relaxation, stiffness: float, frequency: float = REFERENCE_FREQUENCY) -> Relaxation:
    """Return a law scaled to have a given stiffness at a frequency [N/m]."""
    factor = stiffness / law.stiffness(frequency)
    return Relaxation(
        factor * law.instantaneous,
        tuple(factor * strength for strength in law.strengths),
        law.times,
        law.worst_error,
    )


def _fit(relative_errors: Callable[[Relaxation], RealArray], loss_factor: float) -> Relaxation:
    """Return the law of static stiffness 1 N/m that makes the sum of squared errors smallest.

    Times and strengths are sought by their logarithms, so that they stay positive.
    """

    def law(logarithms: RealArray, worst_error: float = 0.0) -> Relaxation:
        strengths, times = loss_factor * np.exp(logarithms[:3]), np.exp(logarithms[3:])
        order = np.argsort(-times)
        slowest_first, their_times = tuple(strengths[order].tolist()), tuple(times[order].tolist())
        return Relaxation(1.0 + sum(slowest_first), slowest_first, their_times, worst_error)

    start = np.log([1.6, 1.8, 3.0, *_START_TIMES])
    fit = least_squares(
        lambda x: relative_errors(law(x)), start, bounds=_BOUNDS, xtol=1e-12, ftol=1e-12, gtol=1e-12
    )
    return law(fit.x, float(np.max(np.abs(fit.fun))))
