"""Natural frequencies: of the loaded track, of the block, and of what they are coupled from.

All with the loss taken out and every stiffness at its dynamic value Re K(f), on the infinite track
with three elements a bay. Hz. Source: the paper (see :mod:`trackig_core.track.design`), which reports the
loaded-track and the coupled-block frequency of each track.

Every frequency is a root that is bracketed before it is sought. Relaxation stiffens with frequency, so the
frequency found with the static stiffness lies below the root, and the one found with the instantaneous
stiffness above.
"""

import math
from collections.abc import Callable, Sequence

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.optimize import bisect, brentq

from trackig_core.arrays import ComplexArray, RealArray
from trackig_core.frequency_domain import kernels
from trackig_core.frequency_domain.lattice import INFINITE
from trackig_core.frequency_domain.track_model import TrackModel, once_per_model
from trackig_core.results import NaturalFrequencies
from trackig_core.track.viscoelastic_law import Relaxation

PEAK_REACH = 1.7
"""How far above and below a computed natural frequency its peak is looked for [-]."""

_MARGIN = 1e-9
"""Relative margin around a bracket, so that a spring without memory has one too [-]."""

_EDGE = 1e-5
"""Relative distance from a frequency at which the rail's receptance has no bound, within which it drowns in
rounding [-]."""

_STILL = 1e-7
"""Decay from bay to bay below which a wave counts as running [-]: well above rounding."""


@once_per_model
def natural_frequencies(model: TrackModel) -> NaturalFrequencies:
    """Return the natural frequencies of a track.

    Parameters
    ----------
    model : TrackDesign or TrackModel
        The track.

    Returns
    -------
    NaturalFrequencies
        Frequencies [Hz]; None where a single-stage track has no such mode.
    """
    mass, boot = model.design.block_mass, model.boot
    return NaturalFrequencies(
        loaded_track=loaded_track(model),
        coupled_block=coupled_block(model),
        wheel_on_rigid_blocks=loaded_track(model.rigid_blocks),
        block_on_boot=None if mass is None or boot is None else _oscillator(mass, boot),
        cut_on=cut_on(model),
    )


@once_per_model
def coupled_block(model: TrackModel) -> float | None:
    """Return the frequency of the block between pad and boot, the rail held.

    Parameters
    ----------
    model : TrackDesign or TrackModel
        The track.

    Returns
    -------
    float or None
        Frequency [Hz]; None when single-stage.
    """
    mass = model.design.block_mass
    return None if mass is None else _oscillator(mass, *model.springs)


def _oscillator(mass: float, *laws: Relaxation) -> float:
    """Return the frequency of a mass [kg] between springs [Hz]: Re K(f) = mass w^2."""

    def natural(stiffnesses: Sequence[float]) -> float:
        return math.sqrt(sum(stiffnesses) / mass) / (2 * math.pi)

    return consistent(natural, laws)


@once_per_model
def cut_on(model: TrackModel) -> tuple[float, ...]:
    """Return the frequencies at which rail and block of every bay move as one, the wheel away.

    Parameters
    ----------
    model : TrackDesign or TrackModel
        The track.

    Returns
    -------
    tuple of float
        One frequency when single-stage, else two, ascending [Hz].
    """
    track = model.design
    rail_mass, block_mass = track.rail.mass_per_metre * track.fastener_spacing, track.block_mass
    if block_mass is None:
        return (_oscillator(rail_mass, model.pad),)

    def one_of_two(which: int) -> Callable[[Sequence[float]], float]:
        return lambda k: coupled_pair(k[0], k[1], rail_mass, block_mass)[which]

    return tuple(consistent(one_of_two(which), model.springs) for which in (0, 1))


def coupled_pair(
    upper_stiffness: float, lower_stiffness: float, upper_mass: float, lower_mass: float
) -> tuple[float, float]:
    """Return the natural frequencies of two masses in series: mass, spring, mass, spring, ground.

    Parameters
    ----------
    upper_stiffness, lower_stiffness : float
        Spring between the masses, spring on the ground [N/m].
    upper_mass, lower_mass : float
        Masses [kg].

    Returns
    -------
    tuple of float
        Two frequencies, ascending [Hz].
    """
    # the two roots of (k_u - m_u x)(k_u + k_l - m_l x) = k_u^2, x = w^2
    upper, lower = upper_stiffness / upper_mass, (upper_stiffness + lower_stiffness) / lower_mass
    larger = (upper + lower) / 2 + math.sqrt((upper - lower) ** 2 / 4 + upper * upper_stiffness / lower_mass)
    # the smaller from their product, which does not cancel
    smaller = upper * lower_stiffness / lower_mass / larger
    return math.sqrt(smaller) / (2 * math.pi), math.sqrt(larger) / (2 * math.pi)


def consistent(natural: Callable[[Sequence[float]], float], laws: Sequence[Relaxation]) -> float:
    """Return the frequency that belongs to the stiffnesses which springs have at that frequency.

    Parameters
    ----------
    natural : callable
        ``natural(stiffnesses)`` returns a natural frequency [Hz], the higher the stiffer any spring [N/m].
    laws : sequence of Relaxation
        Laws of the springs.

    Returns
    -------
    float
        The frequency f = natural(Re K(f)) [Hz]. There is but one: Re K(f) / f^2 falls with frequency.
    """
    low = natural([law.stiffness(0.0) for law in laws]) * (1 - _MARGIN)
    high = natural([law.instantaneous for law in laws]) * (1 + _MARGIN)
    root = brentq(lambda f: f - natural([law.stiffness(f) for law in laws]), low, high, xtol=1e-9)
    return float(root)


@once_per_model
def loaded_track(model: TrackModel) -> float:
    """Return the bound mode of the wheel on the supported rail.

    The lowest root of 1/k_H + alpha(f) - 1/(m_w w^2) = 0, with alpha the point receptance over a
    support. It lies below the frequency at which waves begin to run along the track, where alpha
    grows without bound, so it always exists.

    Parameters
    ----------
    model : TrackDesign or TrackModel
        The track and its wheel.

    Returns
    -------
    float
        Frequency [Hz].
    """
    track, support = model.design, _Support(model)

    def balance(frequency: float) -> float:
        wheel = -1 / (track.wheel_mass * (2 * math.pi * frequency) ** 2)
        return 1 / track.contact_stiffness + support.receptance(frequency) + wheel

    waves_begin = support.waves_begin(cut_on(model)[0])
    top = waves_begin * (1 - _EDGE)
    if balance(top) <= 0:  # a wheel so light that its mode cannot be told from the cut-on
        return waves_begin
    bottom = 0.1 * waves_begin
    while balance(bottom) >= 0:
        bottom *= 0.1
    return float(brentq(balance, bottom, top, xtol=1e-9))


def peak_near(frequency: RealArray, magnitude: RealArray, near: float) -> float | None:
    """Return where a response peaks in the octave and a half around a frequency.

    Parameters
    ----------
    frequency : numpy.ndarray (frequencies,)
        Frequencies [Hz], ascending.
    magnitude : numpy.ndarray (frequencies,)
        Response at those frequencies, greater than zero.
    near : float
        Frequency around which to look [Hz].

    Returns
    -------
    float or None
        Frequency of the highest peak [Hz], refined between points; None if there is none inside.
    """
    inside = (frequency > near / PEAK_REACH) & (frequency < near * PEAK_REACH)
    if np.count_nonzero(inside) < 5:
        return None
    curve = CubicSpline(np.log(frequency[inside]), np.log(magnitude[inside]))
    peaks = [root for root in curve.derivative().roots(extrapolate=False) if curve(root, 2) < 0]
    return float(np.exp(max(peaks, key=curve))) if peaks else None


class _Support:
    """The supported rail without loss, one frequency at a time."""

    def __init__(self, model: TrackModel) -> None:
        design = model.design
        self._block_mass, self._pad, self._boot = design.block_mass, model.pad, model.boot
        dx = design.fastener_spacing / INFINITE.elements_per_bay
        self._bending = design.rail.bending_stiffness / dx**3
        self._element_mass = design.rail.mass_per_metre * dx
        self._per_bay = INFINITE.elements_per_bay

    def _stiffness(self, frequency: float) -> float:
        """Return the real dynamic stiffness of a support, block included [N/m]."""
        pad = self._pad.stiffness(frequency)
        if self._boot is None or self._block_mass is None:
            return pad
        inertia = self._block_mass * (2 * math.pi * frequency) ** 2
        below = self._boot.stiffness(frequency) - inertia
        return pad * below / (pad + below)

    def _waves(self, frequency: float) -> tuple[ComplexArray, ComplexArray]:
        """Return the multipliers and amplitudes (2, 1) of the two waves."""
        multipliers, amplitudes = np.empty((2, 1), dtype=complex), np.empty((2, 1), dtype=complex)
        kernels.bay_waves(
            np.array([(2 * math.pi * frequency) ** 2]),
            np.array([complex(self._stiffness(frequency))]),
            self._bending,
            self._element_mass,
            self._per_bay,
            multipliers,
            amplitudes,
        )
        return multipliers, amplitudes

    def receptance(self, frequency: float) -> float:
        """Return the point receptance over a support at a frequency at which no waves run [m/N]."""
        return float(self._waves(frequency)[1].sum().real)

    def dies_away(self, frequency: float) -> bool:
        """Return whether both waves decay from bay to bay."""
        return bool(np.abs(self._waves(frequency)[0]).max() < 1 - _STILL)

    def waves_begin(self, straight_rail: float) -> float:
        """Return the lowest frequency at which waves run along the track [Hz].

        On most tracks all bays then move as one. ``straight_rail`` is the same frequency for a rail that
        does not bend between supports: it is stiffer, so its frequency lies above [Hz]. On stiff supports
        far apart shorter waves begin to run before.
        """

        def surplus(frequency: float) -> float:
            squared = (2 * math.pi * frequency) ** 2
            rail = kernels.rail_compliance(squared, self._bending, self._element_mass, self._per_bay)
            return float(rail - 1 / self._stiffness(frequency))

        # the rail's first own wave that repeats in every bay: r = 2 - 2 cos(2 pi / elements per bay)
        own = 2 * (1 - math.cos(2 * math.pi / self._per_bay)) * math.sqrt(self._bending / self._element_mass)
        top = min(straight_rail * (1 + _MARGIN), own / (2 * math.pi) * (1 - _EDGE))
        as_one = float(brentq(surplus, 1e-3 * top, top, xtol=1e-12, rtol=1e-14))
        if self.dies_away(as_one * (1 - _EDGE)):
            return as_one
        low, high = 1e-3 * as_one, as_one * (1 - _EDGE)
        return float(bisect(lambda f: 1.0 if self.dies_away(f) else -1.0, low, high, rtol=1e-9))
