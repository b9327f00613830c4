"""The "very stiff" track as a reference: the false peak that its contact spring puts there.

A promoter's reference is often a run of the same model on supports so stiff that they hardly move. The wheel
then still bounces on the contact spring, at sqrt(k_H/m_w)/2 pi, near 180 Hz for the wheels of the paper, and
nothing but the pads damps it. Used as it is, that peak puts a false dip into the insertion gain of every
track. The paper therefore stiffens the contact of its reference too, until the peak has left the bands:
what is left is the inertia of the wheel, the straight line of 9 dB per octave, which is the rigid track's.
Both references are computed by the frequency-domain solution and compared with the rigid track.

Hz, dB. Source: the paper (see :mod:`trackig_core.track.design`).
"""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike

from trackig_core.arrays import RealArray
from trackig_core.bands import BAND_EDGES, BAND_LABELS, decibels
from trackig_core.frequency_domain.floquet_waves import exact_spectrum
from trackig_core.frequency_domain.refinement import banded_spectrum, require_damping
from trackig_core.frequency_domain.track_model import Track, track_model
from trackig_core.levels.insertion_gain import integrate_bands
from trackig_core.track.design import DEFAULT_STEP, TrackDesign
from trackig_core.words import hertz, largest

STIFF = 1e12
"""Stiffness of a "very stiff" pad, and of a stiffened contact [N/m]: a thousand times an ordinary contact."""

STIFF_LOSS = 0.1
"""Loss factor of a "very stiff" pad [-]; it has next to nothing to lose."""


@dataclass(frozen=True, eq=False)
class StiffReferences:
    """Very stiff tracks with the real contact spring, and with one that is very stiff too.

    Attributes
    ----------
    frequency : numpy.ndarray (frequencies,) [Hz]
        Frequencies of the narrow-band levels.
    real, stiffened : numpy.ndarray (frequencies,) [dB]
        Energy of the force into the ground over that of the rigid track.
    contact_resonance : float [Hz]
        The wheel on the real contact spring alone, on ground that does not move.
    gain_real, gain_stiffened, gain_rigid : numpy.ndarray (21,) [dB]
        Insertion gain of the design per band against each of the two, and against the rigid track.
    """

    frequency: RealArray = field(repr=False)
    real: RealArray = field(repr=False)
    stiffened: RealArray = field(repr=False)
    contact_resonance: float
    gain_real: RealArray = field(repr=False)
    gain_stiffened: RealArray = field(repr=False)
    gain_rigid: RealArray = field(repr=False)

    def __str__(self) -> str:
        """Return what the reference changes of insertion gain [dB], and the contact resonance [Hz]."""
        real, stiffened = (
            largest(each - self.gain_rigid, BAND_LABELS) for each in (self.gain_real, self.gain_stiffened)
        )
        return (
            f"insertion gain against a very stiff track less that against the rigid one: {real} with the "
            f"real contact spring, which resonates at {hertz([self.contact_resonance])}; {stiffened} with a "
            "stiff one"
        )


def very_stiff(design: TrackDesign, stiffen_contact: bool) -> TrackDesign:
    """Return a design's rail and wheel on supports that hardly move.

    Parameters
    ----------
    design : TrackDesign or TrackModel
        The track whose rail, spacing, wheel and contact spring are kept.
    stiffen_contact : bool
        Whether the contact spring is made as stiff as the supports.

    Returns
    -------
    TrackDesign
        A single-stage track.
    """
    return design.replace(
        pad_stiffness=STIFF,
        pad_loss_factor=STIFF_LOSS,
        block_mass=None,
        boot_stiffness=None,
        boot_loss_factor=None,
        contact_stiffness=STIFF if stiffen_contact else design.contact_stiffness,
    )


def stiff_references(design: Track, frequency: ArrayLike) -> StiffReferences:
    """Compare a design with very stiff tracks, with and without their false peak.

    Parameters
    ----------
    design : TrackDesign or TrackModel
        The track.
    frequency : array_like (frequencies,)
        Frequencies of the narrow-band levels [Hz]; that of the contact resonance is added.

    Returns
    -------
    StiffReferences
        Levels of the references, and insertion gain against them, by summed energy.

    Raises
    ------
    DesignError
        If the design's exact answer has no bound, for want of any loss.
    """
    model = track_model(design).simplified
    require_damping(model)
    track = model.design
    resonance = float(np.sqrt(track.contact_stiffness / track.wheel_mass) / (2 * np.pi))
    frequency = np.union1d(np.asarray(frequency, dtype=float), resonance)
    rigid = (2 * np.pi * frequency * track.wheel_mass * DEFAULT_STEP) ** 2
    references = [track_model(very_stiff(track, stiffen_contact)) for stiffen_contact in (False, True)]
    real, stiffened = (
        decibels(exact_spectrum(each, frequency, DEFAULT_STEP).energy / rigid) for each in references
    )
    energies = [*(_band_energy(each) for each in references), _rigid_band_energy(track)]
    own = _band_energy(model)
    gain_real, gain_stiffened, gain_rigid = (decibels(own / energy) for energy in energies)
    return StiffReferences(frequency, real, stiffened, resonance, gain_real, gain_stiffened, gain_rigid)


def _rigid_band_energy(design: TrackDesign) -> RealArray:
    """Return the energy per band of the wheel's inertia force, (m_w w step)^2, integrated (21,) [N2 s]."""
    return (2 * np.pi * design.wheel_mass * DEFAULT_STEP) ** 2 * np.diff(BAND_EDGES**3) / 3


def _band_energy(design: Track) -> RealArray:
    """Return the energy of the force into the ground per band (21,) [N2 s]."""
    spectrum = banded_spectrum(design)
    return integrate_bands(spectrum.frequency, spectrum.energy)
