"""The natural frequencies of a track in plain Python: what the compiled search is compared with.

Each frequency is a root that is bracketed before SciPy seeks it; see
:mod:`trackig_core.frequency_domain.natural_frequencies`.
"""

import math

import numpy as np
from scipy.optimize import bisect, brentq

from trackig_core.frequency_domain import kernels
from trackig_core.frequency_domain.lattice import INFINITE
from trackig_core.frequency_domain.natural_frequencies import consistent, coupled_pair
from trackig_core.results import NaturalFrequencies

MARGIN, EDGE, STILL = 1e-9, 1e-5, 1e-7


def plain_natural_frequencies(model):
    """Return the natural frequencies of a TrackModel (NaturalFrequencies)."""
    mass, boot = model.design.block_mass, model.boot
    return NaturalFrequencies(
        loaded_track=loaded_track(model),
        coupled_block=None if mass is None else oscillator(mass, *model.springs),
        wheel_on_rigid_blocks=loaded_track(model.rigid_blocks),
        block_on_boot=None if mass is None else oscillator(mass, boot),
        cut_on=cut_on(model),
    )


def oscillator(mass, *laws):
    return consistent(lambda stiffnesses: math.sqrt(sum(stiffnesses) / mass) / (2 * math.pi), laws)


def cut_on(model):
    track = model.design
    rail_mass, block_mass = track.rail.mass_per_metre * track.fastener_spacing, track.block_mass
    if block_mass is None:
        return (oscillator(rail_mass, model.pad),)

    def one_of_two(which):
        return lambda k: coupled_pair(k[0], k[1], rail_mass, block_mass)[which]

    return tuple(consistent(one_of_two(which), model.springs) for which in (0, 1))


def loaded_track(model):
    track, support = model.design, Support(model)

    def balance(frequency):
        wheel = -1 / (track.wheel_mass * (2 * math.pi * frequency) ** 2)
        return 1 / track.contact_stiffness + support.receptance(frequency) + wheel

    waves_begin = support.waves_begin(cut_on(model)[0])
    top = waves_begin * (1 - EDGE)
    if balance(top) <= 0:  # a wheel so light that its mode cannot be told from the cut-on
        return waves_begin
    bottom = 0.1 * waves_begin
    while balance(bottom) >= 0:
        bottom *= 0.1
    return float(brentq(balance, bottom, top, xtol=1e-9))


class Support:
    """The supported rail without loss, one frequency at a time."""

    def __init__(self, model):
        design = model.design
        self._block_mass, self._pad, self._boot = design.block_mass, model.pad, model.boot
        dx = design.fastener_spacing / INFINITE.elements_per_bay
        self._bending = design.rail.bending_stiffness / dx**3
        self._element_mass = design.rail.mass_per_metre * dx
        self._per_bay = INFINITE.elements_per_bay

    def _stiffness(self, frequency):
        """Return the real dynamic stiffness of a support, block included [N/m]."""
        pad = self._pad.stiffness(frequency)
        if self._boot is None or self._block_mass is None:
            return pad
        inertia = self._block_mass * (2 * math.pi * frequency) ** 2
        below = self._boot.stiffness(frequency) - inertia
        return pad * below / (pad + below)

    def _waves(self, frequency):
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

    def rail_compliance(self, squared):
        """Return the displacement of the rail per force, equal over every support [m/N]."""
        r = (self._element_mass * squared / self._bending) ** 0.5
        c1, u1 = kernels.chebyshev_excess(0.5 * r, self._per_bay)
        c2, u2 = kernels.chebyshev_excess(-0.5 * r, self._per_bay)
        return (u1 / c1 - u2 / c2) / (2 * r * self._bending)

    def receptance(self, frequency):
        """Return the point receptance over a support at a frequency at which no waves run [m/N]."""
        return float(self._waves(frequency)[1].sum().real)

    def dies_away(self, frequency):
        """Return whether both waves decay from bay to bay."""
        return bool(np.abs(self._waves(frequency)[0]).max() < 1 - STILL)

    def waves_begin(self, straight_rail):
        """Return the lowest frequency at which waves run along the track [Hz].

        On most tracks all bays then move as one. ``straight_rail`` is the same frequency for a rail that
        does not bend between supports: it is stiffer, so its frequency lies above [Hz]. On stiff supports
        far apart shorter waves begin to run before.
        """

        def surplus(frequency):
            squared = (2 * math.pi * frequency) ** 2
            rail = self.rail_compliance(squared)
            return float(rail - 1 / self._stiffness(frequency))

        # the rail's first own wave that repeats in every bay: r = 2 - 2 cos(2 pi / elements per bay)
        own = 2 * (1 - math.cos(2 * math.pi / self._per_bay)) * math.sqrt(self._bending / self._element_mass)
        top = min(straight_rail * (1 + MARGIN), own / (2 * math.pi) * (1 - EDGE))
        as_one = float(brentq(surplus, 1e-3 * top, top, xtol=1e-12, rtol=1e-14))
        if self.dies_away(as_one * (1 - EDGE)):
            return as_one
        low, high = 1e-3 * as_one, as_one * (1 - EDGE)
        return float(bisect(lambda f: 1.0 if self.dies_away(f) else -1.0, low, high, rtol=1e-9))
