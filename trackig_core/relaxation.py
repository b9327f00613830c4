"""Loss factor -> Boltzmann relaxation: damping that a time-stepping solver can integrate.

A pad or boot under strain e(t) answers with

    sigma(t) = k_inf e(t) - sum_j (k_j / tau_j) integral_0^inf e(t - s) exp(-s / tau_j) ds

so its dynamic stiffness is K(w) = k_inf - sum_j k_j / (1 + i w tau_j), three terms, and its loss
factor Im K / Re K. Such a material is causal, so it stiffens with frequency as much as its damping
demands. N/m, s, Hz. Source: the paper (see :mod:`trackig_core.design`), damping section.

The one rule: Re K at 50 Hz is exactly the dynamic stiffness that the designer stated.
"""

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from scipy.optimize import least_squares

from trackig_core.design import REFERENCE_FREQUENCY

FIT_FREQUENCIES = np.geomspace(5.0, 500.0, 100)
"""Frequencies at which the fitted loss factor is compared with its target (100,) [Hz]."""
FIT_FREQUENCIES.flags.writeable = False

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
        Largest relative error of the loss factor against its target, 5-500 Hz.
    """

    instantaneous: float
    strengths: tuple[float, ...]
    times: tuple[float, ...]
    worst_error: float

    def dynamic_stiffness(self, frequency):
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

    def stiffness(self, frequency):
        """Return Re K at one frequency [Hz]: the stiffness without its loss [N/m]."""
        angular = 2 * math.pi * frequency
        return self.instantaneous - sum(
            strength / (1 + (angular * time) ** 2)
            for strength, time in zip(self.strengths, self.times, strict=True)
        )

    def loss_factor(self, frequency):
        """Return the loss factor Im K / Re K at given frequencies [Hz]; same shape, [-]."""
        stiffness = self.dynamic_stiffness(frequency)
        return stiffness.imag / stiffness.real

    def recursion(self, time_step, order):
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


def _relaxed(frequency, instantaneous, strengths, times):
    """Return k_inf - sum_j k_j / (1 + i w tau_j)."""
    angular = 2j * np.pi * np.asarray(frequency, dtype=float)
    return instantaneous - sum(
        (strength / (1 + angular * time) for strength, time in zip(strengths, times, strict=True)),
        start=np.zeros_like(angular),
    )


def relaxation(stiffness, loss_factor):
    """Return the relaxation that has a stated stiffness at 50 Hz and a loss factor from 5 to 500 Hz.

    Parameters
    ----------
    stiffness : float
        Dynamic stiffness at 50 Hz [N/m].
    loss_factor : float
        Loss factor wanted [-]; zero gives a spring without memory.

    Returns
    -------
    Relaxation
        The fitted law.
    """
    strengths, times, worst_error = fit_terms(loss_factor)
    instantaneous = 1.0 - (_relaxed(REFERENCE_FREQUENCY, 0.0, strengths, times)).real
    return Relaxation(
        stiffness * instantaneous,
        tuple(stiffness * strength for strength in strengths),
        times,
        worst_error,
    )


def laws(design):
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
    pad = relaxation(design.pad_stiffness, design.pad_loss_factor)
    boot = relaxation(design.boot_stiffness, design.boot_loss_factor) if design.two_stage else None
    return pad, boot


@lru_cache(maxsize=256)
def fit_terms(loss_factor):
    """Fit three relaxation terms to a constant loss factor by least squares.

    The sum over :data:`FIT_FREQUENCIES` of squared relative errors of the loss factor is made
    smallest, over the logarithms of times and strengths so that both stay positive.

    Parameters
    ----------
    loss_factor : float
        Target loss factor [-], zero or more.

    Returns
    -------
    strengths : tuple of float
        Strength of each term relative to the stiffness at 50 Hz [-], slowest term first.
    times : tuple of float
        Relaxation times [s], slowest first.
    worst_error : float
        Largest relative error of the loss factor [-].
    """
    if loss_factor == 0:
        return (), (), 0.0

    def relative_errors(logarithms):
        strengths, times = np.exp(logarithms[:3]), np.exp(logarithms[3:])
        terms = _relaxed(FIT_FREQUENCIES, 0.0, strengths, times)
        at_reference = _relaxed(REFERENCE_FREQUENCY, 0.0, strengths, times).real
        # terms = -sum k_j/(1 + i w tau_j), normalised so that Re K(50 Hz) = 1
        return terms.imag / (1.0 - at_reference + terms.real) / loss_factor - 1.0

    start = np.log([1.2 * loss_factor, 1.2 * loss_factor, 2.0 * loss_factor, *_START_TIMES])
    fit = least_squares(relative_errors, start, method="lm", xtol=1e-12, ftol=1e-12, gtol=1e-12)
    strengths, times = np.exp(fit.x[:3]), np.exp(fit.x[3:])
    order = np.argsort(-times)
    return (
        tuple(float(value) for value in strengths[order]),
        tuple(float(value) for value in times[order]),
        float(np.max(np.abs(fit.fun))),
    )
