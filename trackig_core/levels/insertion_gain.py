"""From a force spectrum to insertion gain: the reference track, and the bands.

Hz, N2 s2 and dB. Source: the paper (see :mod:`trackig_core.track.design`) for the straight reference line
and the energy sum; IEC 61260-1 for the bands.
"""

from collections.abc import Collection
from functools import lru_cache

import numpy as np
from scipy.integrate import simpson

from trackig_core.arrays import RealArray
from trackig_core.bands import BAND_EDGES, LINE_FRACTION, ONE_THIRD_OCTAVES, Bands, decibels
from trackig_core.levels import kernels
from trackig_core.results import ForceSpectrum, InsertionGain
from trackig_core.track.design import TrackDesign
from trackig_core.track.vehicle import rigid_energy

REFERENCES = ("line", "rigid", "stiff")
"""References: the paper's straight line, the exact rigid track, or a very stiff track on the same ground and
under the same vehicle."""

SUMMATIONS = ("energy", "coherent")
"""Sums over the supports: of squared forces (the paper), or of forces."""

FEWEST_KNOTS = 4
"""Frequencies that a spectrum needs for a spline through it [-]."""

PANELS = 64
"""Panels of Simpson's rule per band over the energy of a rigid track under a suspension [-]."""


def insertion_gain(
    spectrum: ForceSpectrum,
    design: TrackDesign,
    loaded_track: float,
    reference: str = "line",
    summation: str = "energy",
    bands: Bands = ONE_THIRD_OCTAVES,
    stiff: ForceSpectrum | None = None,
) -> InsertionGain:
    """Return the insertion gain of a track per band.

    Parameters
    ----------
    spectrum : ForceSpectrum
        Energy of the force into the ground.
    design : TrackDesign
        The track, for its wheels and what they carry.
    loaded_track : float
        Its loaded-track frequency [Hz].
    reference : str
        ``"line"``: the line through the track's own spectrum at a tenth of its loaded-track frequency, or at
        the nearest end of the spectrum; straight (9 dB per octave in bands) where the wheel has no
        suspension, else as the rigid track's rises. ``"rigid"``: what wheels and suspension pass into a
        rigid track, times the number of wheels. ``"stiff"``: the very stiff track on the same ground and
        under the same vehicle, the only reference where the ground yields.
    summation : str
        ``"energy"``: squared support forces are summed. ``"coherent"``: forces are summed.
    bands : Bands
        Bands, which the spectrum covers; by default one-third octaves from 5 Hz to 500 Hz.
    stiff : ForceSpectrum, optional
        Spectrum of the very stiff track; needed for ``"stiff"`` only.

    Returns
    -------
    InsertionGain
        Levels and the energies behind them.

    Raises
    ------
    ValueError
        If ``reference`` or ``summation`` is not one of the above, the reference has no meaning for the
        design, or the spectrum has fewer than four frequencies or an energy that is not finite.
    """
    check_choice("summation", summation, SUMMATIONS)
    check_reference(design, reference)
    energy = summed_energy(spectrum, summation)
    frequency = spectrum.frequency
    slopes = _slopes(frequency, energy)
    if reference == "stiff":
        if stiff is None:
            raise ValueError("reference = 'stiff': give stiff, or use solve(), which computes it")
        in_bands = integrate_bands(stiff.frequency, summed_energy(stiff, summation), bands.edges)
        reference_energy = in_bands * (spectrum.step / stiff.step) ** 2
    elif reference == "line":
        height = _line_height(design, frequency, energy, slopes, loaded_track)
        reference_energy = _rise_in_bands(design, height, bands)
    else:
        reference_energy = rigid_band_energy(design, spectrum.step, bands)
    band_energy = kernels.spline_integrals(frequency, energy, slopes, bands.edges)
    return InsertionGain(
        levels=decibels(band_energy / reference_energy),
        band_energy=band_energy,
        reference_energy=reference_energy,
        reference=reference,
        summation=summation,
        bands=bands,
    )


def check_reference(design: TrackDesign, reference: str) -> None:
    """Raise a ValueError if there is no such reference, or if it has no meaning for a design."""
    check_choice("reference", reference, REFERENCES)
    if design.ground is not None and reference != "stiff":
        raise ValueError(
            f"reference = {reference!r}: give 'stiff', for this design stands on ground that yields, and "
            "against a rigid track the ground's own amplification would count as the track's"
        )


def own_reference(design: TrackDesign) -> str:
    """Return the reference where none is asked for (str): the line, on ground that yields the stiff track."""
    return "line" if design.ground is None else "stiff"


def reference_for(design: TrackDesign, wanted: str) -> str:
    """Return the reference that is wanted (str), or on ground that yields the only one that has a meaning."""
    return wanted if design.ground is None else "stiff"


def rigid_band_energy(design: TrackDesign, step: float, bands: Bands = ONE_THIRD_OCTAVES) -> RealArray:
    """Return the energy that a rigid track passes in each band after a step of roughness.

    Parameters
    ----------
    design : TrackDesign
        The track, for its wheels and what they carry.
    step : float
        Height of the step [m].
    bands : Bands
        Bands.

    Returns
    -------
    numpy.ndarray (bands,)
        Energy [N2 s].
    """
    return _rise_in_bands(design, _rigid_height(design, step), bands)


def line_over_rigid(
    spectrum: ForceSpectrum, design: TrackDesign, loaded_track: float, summation: str
) -> float:
    """Return the height of the line in parts of that of the rigid track [-], which is the same in every band.

    Parameters
    ----------
    spectrum, design, loaded_track, summation
        As for :func:`insertion_gain`.

    Returns
    -------
    float
        Energy of the line over that of the rigid track.
    """
    energy = summed_energy(spectrum, summation)
    slopes = _slopes(spectrum.frequency, energy)
    line = _line_height(design, spectrum.frequency, energy, slopes, loaded_track)
    return line / _rigid_height(design, spectrum.step)


def _line_height(
    design: TrackDesign, frequency: RealArray, energy: RealArray, slopes: RealArray, loaded_track: float
) -> float:
    """Return the energy of the line over :func:`_rise`."""
    # E grows as that of a rigid track here, which a cubic spline follows between bins
    anchor = np.clip(LINE_FRACTION * loaded_track, frequency[0], frequency[-1])
    return float(kernels.spline_value(frequency, energy, slopes, anchor) / _rise(design, anchor))


def _rigid_height(design: TrackDesign, step: float) -> float:
    """Return the energy of a rigid track over :func:`_rise`."""
    # E = (m_w w^2 step)^2 / w^2 under a wheel without suspension
    return float(2 * np.pi * design.wheel_mass * step if design.one_unsprung_wheel else step) ** 2


def _rise(design: TrackDesign, frequency: RealArray) -> RealArray:
    """Return what the energy of a rigid track is proportional to (frequencies,)."""
    return frequency**2 if design.one_unsprung_wheel else rigid_energy(design, frequency)


def _rise_in_bands(design: TrackDesign, height: float, bands: Bands) -> RealArray:
    """Return ``height`` times :func:`_rise` integrated over the bands (bands,)."""
    if design.one_unsprung_wheel:
        cubes: RealArray = height * np.diff(bands.edges**3) / 3
        return cubes
    nodes = _nodes(bands)
    return height * np.asarray(simpson(_rise(design, nodes), nodes, axis=0))


@lru_cache(maxsize=8)
def _nodes(bands: Bands) -> RealArray:
    """Return where Simpson's rule looks at each band (nodes, bands) [Hz]."""
    return np.linspace(bands.edges[:-1], bands.edges[1:], 2 * PANELS + 1)


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

    Raises
    ------
    ValueError
        If there are fewer than four frequencies, they do not ascend, or a density is not finite.
    """
    slopes = _slopes(frequency, density)
    return np.asarray(kernels.spline_integrals(frequency, density, slopes, edges))


def _slopes(frequency: RealArray, density: RealArray) -> RealArray:
    """Return the slopes of the spline through a spectrum, or raise a ValueError that says what it is not."""
    if frequency.size < FEWEST_KNOTS or not (np.diff(frequency) > 0).all():
        raise ValueError(f"frequency: give at least {FEWEST_KNOTS} frequencies, in ascending order")
    if density.shape != frequency.shape or not np.isfinite(density).all():
        raise ValueError("energy: give a finite number per frequency")
    return np.asarray(kernels.spline_slopes(frequency, density))
