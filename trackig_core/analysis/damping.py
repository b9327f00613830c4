"""What damping does: stiffness and loss factor over frequency, and insertion gain at other loss factors.

A causal damper must stiffen with frequency: the stored part of its force cannot be had without the lost
part (Kramers and Kronig). So loss that tames a resonance costs isolation above it, where the stiffer spring
passes more. Hz, dB; stiffness as a ratio to that at 50 Hz. Source:
:mod:`trackig_core.track.viscoelastic_law`.

The one rule: what is shown are the laws that the solvers use, not the targets to which they were fitted.
"""

from dataclasses import dataclass, field

import numpy as np

from trackig_core.frequency_domain.natural_frequencies import loaded_track
from trackig_core.frequency_domain.refinement import banded_spectrum, require_damping
from trackig_core.levels.insertion_gain import insertion_gain
from trackig_core.track.design import REFERENCE_FREQUENCY
from trackig_core.track.viscoelastic_law import laws

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

    frequency: np.ndarray = field(repr=False)
    stiffness: np.ndarray = field(repr=False)
    loss_factor: np.ndarray = field(repr=False)


def damping_curves(design, frequency):
    """Return how stiff and how lossy pad and boot are over frequency.

    Parameters
    ----------
    design : TrackDesign
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
    pad, boot = (None if law is None else _curve(law, frequency) for law in laws(design))
    return pad, boot


def _curve(law, frequency):
    relative = law.dynamic_stiffness(frequency).real / law.stiffness(REFERENCE_FREQUENCY)
    return DampingCurve(frequency, relative, law.loss_factor(frequency))


def with_loss_factor(design, loss_factor):
    """Return a design whose pads and boots all have one loss factor, their stiffness at 50 Hz unchanged.

    Parameters
    ----------
    design : TrackDesign
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
    changes = {}
    for part, law in zip(("pad", "boot"), laws(design), strict=True):
        if law is not None:
            changes[f"{part}_stiffness"] = law.stiffness(REFERENCE_FREQUENCY)
            changes[f"{part}_loss_factor"] = loss_factor
    return design.replace(**changes)


def gain_by_loss_factor(design, loss_factors=LOSS_FACTORS, reference="line", summation="energy"):
    """Return the exact insertion gain of a design at several loss factors.

    Parameters
    ----------
    design : TrackDesign
        The track.
    loss_factors : sequence of float (factors,)
        Loss factors of pads and boots alike [-].
    reference, summation : str
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
    rows = []
    for loss_factor in loss_factors:
        changed = with_loss_factor(design, loss_factor)
        require_damping(changed)
        loaded = loaded_track(changed)
        rows.append(
            insertion_gain(banded_spectrum(changed, loaded), changed, loaded, reference, summation).levels
        )
    return np.array(rows)
