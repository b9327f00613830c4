"""Straight asymptotes of insertion gain: level below the resonances, so many decibels an octave above.

Without loss the force that the model of :mod:`trackig_core.analysis.lumped` passes into the ground, over
that which a rigid track would, has no zeros and one pole per natural frequency f_i:

    T(f) = 1 / product_i (1 - (f / f_i)^2)

so that its level is 0 dB below all of them and falls by 40 log10 2 = 12.04 dB per octave more above each:
12 above the resonance of one stage, 24 above the second of two stages. The straight lines meet at
the natural frequencies. Between two, the curve is exactly as steep as its asymptote at their geometric mean.

Against the straight reference line, which touches the spectrum at a tenth of the lowest frequency, all
lines lie lower by 20 log10 T there (0.09 dB); an energy sum against the rigid track, by the share of the
load's energy.

Real tracks differ: a causal damper stiffens with frequency, which flattens the slopes of the lumped model,
and in the beam waves run along the rail. :func:`measured_slopes` compares both with the straight lines.

Hz, dB, dB per octave.
"""

import itertools
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from trackig_core.analysis.lumped import energy_share, lumped_frequencies, lumped_spectrum
from trackig_core.arrays import RealArray
from trackig_core.bands import BAND_CENTRES, BAND_EDGES, LINE_FRACTION, decibels
from trackig_core.frequency_domain.floquet_waves import exact_spectrum
from trackig_core.frequency_domain.refinement import require_damping
from trackig_core.frequency_domain.track_model import Track, TrackModel, track_model
from trackig_core.levels.insertion_gain import REFERENCES, SUMMATIONS, check_choice, summed_energy
from trackig_core.results import ForceSpectrum
from trackig_core.track.design import DEFAULT_STEP
from trackig_core.words import hertz

PER_RESONANCE = -40 * math.log10(2)
"""What each natural frequency adds to the slope above it [dB per octave]."""

_SHORT = 2 ** (1 / 12)
"""Half the interval over which a slope is measured, as a ratio [-]: a sixth of an octave in all."""


@dataclass(frozen=True)
class Asymptote:
    """One straight line on axes of log frequency and decibels.

    Attributes
    ----------
    frequency : tuple of float
        Where it begins and ends [Hz].
    level : tuple of float
        Insertion gain at either end [dB].
    slope : float
        Its slope [dB per octave].
    """

    frequency: tuple[float, float]
    level: tuple[float, float]
    slope: float

    def __str__(self) -> str:
        """Return slope and ends, with their units."""
        low, high = (
            f"{level:.1f} dB at {hertz([each])}"
            for each, level in zip(self.frequency, self.level, strict=True)
        )
        return f"{self.slope:+.1f} dB per octave, from {low} to {high}"


@dataclass(frozen=True)
class MeasuredSlope:
    """Slope of the exact models where an asymptote should be followed best.

    Attributes
    ----------
    asymptote : Asymptote
        The straight line.
    frequency : float
        Where the slopes are measured [Hz]: midway between two resonances, else at the end of the bands.
    lumped, beam : float
        Slope of the damped lumped model and of the beam model there [dB per octave].
    """

    asymptote: Asymptote
    frequency: float
    lumped: float
    beam: float

    def __str__(self) -> str:
        """Return the slopes [dB per octave], and where they are measured."""
        return (
            f"at {hertz([self.frequency])}: asymptote {self.asymptote.slope:+.1f}, "
            f"lumped model {self.lumped:+.1f}, beam model {self.beam:+.1f} dB per octave"
        )


def gain_asymptotes(
    design: Track, reference: str = "line", summation: str = "energy"
) -> tuple[Asymptote, ...]:
    """Return the straight asymptotes of insertion gain over the bands.

    Parameters
    ----------
    design : TrackDesign or TrackModel
        The track.
    reference, summation : str
        As for :func:`trackig_core.insertion_gain`.

    Returns
    -------
    tuple of Asymptote
        Lines that join at the lumped model's natural frequencies, from the lowest to the highest band edge.

    Raises
    ------
    ValueError
        If ``reference`` or ``summation`` is not one of the choices.
    """
    check_choice("reference", reference, REFERENCES)
    check_choice("summation", summation, SUMMATIONS)
    model = track_model(design)
    corners = lumped_frequencies(model).coupled

    def level(frequency: float) -> float:
        falls = (max(0.0, math.log2(frequency / corner)) for corner in corners)
        return _level_below(model, corners, reference, summation) + PER_RESONANCE * sum(falls)

    low, high = float(BAND_EDGES[0]), float(BAND_EDGES[-1])
    ends = [low, *(corner for corner in corners if low < corner < high), high]
    return tuple(
        Asymptote(
            frequency=(start, end),
            level=(level(start), level(end)),
            slope=sum((PER_RESONANCE for corner in corners if corner <= start), start=0.0),
        )
        for start, end in itertools.pairwise(ends)
    )


def _level_below(model: TrackModel, corners: Sequence[float], reference: str, summation: str) -> float:
    """Return the insertion gain far below the resonances [dB]."""
    if reference == "line":
        anchor = LINE_FRACTION * corners[0]
        return 20 * sum(math.log10(1 - (anchor / corner) ** 2) for corner in corners)
    return 10 * math.log10(energy_share(model)) if summation == "energy" else 0.0


def measured_slopes(design: Track, summation: str = "energy") -> tuple[MeasuredSlope, ...]:
    """Return how steep the exact models are along each asymptote; the reference does not matter.

    Parameters
    ----------
    design : TrackDesign or TrackModel
        The track.
    summation : str
        As for :func:`trackig_core.insertion_gain`.

    Returns
    -------
    tuple of MeasuredSlope
        One per asymptote.

    Raises
    ------
    DesignError
        If the exact answer has no bound, for want of any loss.
    ValueError
        If ``summation`` is not one of the choices.
    """
    model = track_model(design).simplified
    require_damping(model)
    lines = gain_asymptotes(model, summation=summation)
    return tuple(
        MeasuredSlope(
            asymptote=line,
            frequency=at,
            lumped=_slope(lambda f: lumped_spectrum(model, f), at, summation),
            beam=_slope(lambda f: exact_spectrum(model, f, DEFAULT_STEP), at, summation),
        )
        for line, at in zip(lines, _midway(lines), strict=True)
    )


def _midway(lines: Sequence[Asymptote]) -> list[float]:
    """Return where each line is followed best [Hz]."""
    if len(lines) == 1:
        return [float(BAND_CENTRES[-1] if lines[0].slope else BAND_CENTRES[0])]
    between = [math.sqrt(line.frequency[0] * line.frequency[1]) for line in lines]
    if lines[0].slope == 0:
        between[0] = float(BAND_CENTRES[0])
    between[-1] = float(BAND_CENTRES[-1])
    return between


def _slope(spectrum_at: Callable[[RealArray], ForceSpectrum], frequency: float, summation: str) -> float:
    """Return the slope of energy over frequency squared: that of insertion gain [dB per octave]."""
    ends = np.array([frequency / _SHORT, frequency * _SHORT])
    levels = decibels(summed_energy(spectrum_at(ends), summation) / ends**2)
    return float(np.diff(levels)[0] / np.diff(np.log2(ends))[0])
