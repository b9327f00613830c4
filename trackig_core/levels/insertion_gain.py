"""From a force spectrum to insertion gain: the reference track, and the bands.

Hz, N2 s2 and dB. Source: the paper (see :mod:`trackig_core.track.design`) for the straight reference line
and the energy sum; IEC 61260-1 for the bands.
"""

from collections.abc import Collection

import numpy as np
from scipy.interpolate import CubicSpline

from trackig_core.arrays import RealArray
from trackig_core.bands import BAND_EDGES, LINE_FRACTION, ONE_THIRD_OCTAVES, Bands, decibels
from trackig_core.results import ForceSpectrum, InsertionGain
from trackig_core.track.design import TrackDesign

REFERENCES = ("line", "rigid")
"""References: the paper's straight line, or the exact rigid track."""

SUMMATIONS = ("energy", "coherent")
"""Sums over the supports: of squared forces (the paper), or of forces."""


def insertion_gain(
    spectrum: ForceSpectrum,
    design: TrackDesign,
    loaded_track: float,
    reference: str = "line",
    summation: str = "energy",
    bands: Bands = ONE_THIRD_OCTAVES,
) -> InsertionGain:
    """Return the insertion gain of a track per band.

    Parameters
    ----------
    spectrum : ForceSpectrum
        Energy of the force into the ground.
    design : TrackDesign
        The track, for the mass of its wheel.
    loaded_track : float
        Its loaded-track frequency [Hz].
    reference : str
        ``"line"``: the straight line (9 dB per octave in bands) through the track's own spectrum at a
        tenth of its loaded-track frequency, or at the nearest end of the spectrum. ``"rigid"``: the
        inertia force of the wheel alone.
    summation : str
        ``"energy"``: squared support forces are summed. ``"coherent"``: forces are summed.
    bands : Bands
        Bands, which the spectrum covers; by default one-third octaves from 5 Hz to 500 Hz.

    Returns
    -------
    InsertionGain
        Levels and the energies behind them.

    Raises
    ------
    ValueError
        If ``reference`` or ``summation`` is not one of the above.
    """
    check_choice("reference", reference, REFERENCES)
    check_choice("summation", summation, SUMMATIONS)
    energy = summed_energy(spectrum, summation)
    frequency = spectrum.frequency
    density = CubicSpline(frequency, energy)
    if reference == "line":
        # E grows as f^2 here, which a cubic spline follows between bins
        anchor = np.clip(LINE_FRACTION * loaded_track, frequency[0], frequency[-1])
        height = float(density(anchor)) / anchor**2
    else:
        # E = (m_w w^2 step)^2 / w^2
        height = (2 * np.pi * design.wheel_mass * spectrum.step) ** 2
    band_energy = _over_bands(density, bands.edges)
    reference_energy = height * np.diff(bands.edges**3) / 3
    return InsertionGain(
        levels=decibels(band_energy / reference_energy),
        band_energy=band_energy,
        reference_energy=reference_energy,
        reference=reference,
        summation=summation,
        bands=bands,
    )


def summed_energy(spectrum: ForceSpectrum, summation: str) -> RealArray:
    """Return the energy of a spectrum by the chosen sum over the supports (frequencies,) [N2 s2]."""
    return spectrum.energy if summation == "energy" else spectrum.coherent_energy


def check_choice(name: str, value: object, choices: Collection[str]) -> None:
    """Raise a ValueError that names the choices if ``value`` is none of them."""
    if value not in choices:
        raise ValueError(f"{name} = {value!r}: give {' or '.join(repr(choice) for choice in choices)}")


def integrate_bands(frequency: RealArray, density: RealArray, edges: RealArray = BAND_EDGES) -> RealArray:
    """Integrate a spectral density over neighbouring bands.

    The density is joined by a cubic spline, which is integrated to the exact band edges: a resonance
    three points wide is then still within 0.001 dB, where weighted bins miss by ten times as much.

    Parameters
    ----------
    frequency : numpy.ndarray (frequencies,)
        Frequencies [Hz], ascending, evenly spaced or not, covering the bands.
    density : numpy.ndarray (frequencies,)
        Density at those frequencies [unit/Hz].
    edges : numpy.ndarray (bands + 1,)
        Edges of the bands [Hz]; by default those of the one-third octaves from 5 Hz to 500 Hz.

    Returns
    -------
    numpy.ndarray (bands,)
        Integral over each band [unit].
    """
    return _over_bands(CubicSpline(frequency, density), edges)


def _over_bands(spline: CubicSpline, edges: RealArray) -> RealArray:
    inner = (spline.x > edges[0]) & (spline.x < edges[-1])
    nodes = np.sort(np.concatenate([spline.x[inner], edges]))
    at_nodes, between = spline(nodes), spline((nodes[:-1] + nodes[1:]) / 2)
    # Simpson's rule is exact for cubics. Panels are summed band by band: the difference of one running sum
    # would lose bands that lie 160 dB below others.
    panels = np.diff(nodes) * (at_nodes[:-1] + 4 * between + at_nodes[1:]) / 6
    energy: RealArray = np.add.reduceat(panels, np.searchsorted(nodes, edges[:-1]))
    return energy
