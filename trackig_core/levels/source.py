"""From insertion gain to single numbers: what a source on the reference track becomes on this one.

Levels in dB re whatever the source is given in; Hz. A-weighting: IEC 61672-1:2013, annex E.

Only the bands that the source has are summed, so two levels compare only if they come of
one source.
"""

from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from trackig_core.arrays import RealArray
from trackig_core.bands import BAND_CENTRES, decibels
from trackig_core.levels.band_tables import BandTable, BandTableError, Quantity

_POLES = (20.598997, 107.65265, 737.86223, 12194.217)
"""Pole frequencies f1 to f4 of the A-weighting [Hz]; IEC 61672-1:2013, annex E."""


def a_weighting(frequency: ArrayLike) -> RealArray:
    """Return the A-weighting by its analytic formula.

    Parameters
    ----------
    frequency : array_like
        Frequencies [Hz], greater than zero. The standard tabulates 10 Hz and above; below, the formula
        goes on.

    Returns
    -------
    numpy.ndarray
        Weighting [dB], zero at 1 kHz, of the same shape.
    """
    return 20 * np.log10(_response(frequency) / _response(1000.0))


def _response(frequency: ArrayLike) -> RealArray:
    """Return the A-weighting's magnitude but for a factor; IEC 61672-1:2013, equation E.6."""
    squared = np.square(np.asarray(frequency, dtype=float))
    first, second, third, fourth = np.square(_POLES)
    simple = np.sqrt((squared + second) * (squared + third))
    return squared**2 / ((squared + first) * simple * (squared + fourth))


A_WEIGHTING = a_weighting(BAND_CENTRES)
"""A-weighting at the exact mid-band frequencies (21,) [dB]."""
A_WEIGHTING.flags.writeable = False


class SourceError(BandTableError):
    """A source spectrum cannot be used; ``line`` and ``column`` say where it is at fault."""


class LevelDifference(NamedTuple):
    """By how much one level exceeds another: ``unweighted`` [dB] and ``a_weighted`` [dB(A)]."""

    unweighted: float
    a_weighted: float

    def __str__(self) -> str:
        """Return both differences with their units."""
        return f"{self.unweighted:+.1f} dB, {self.a_weighted:+.1f} dB(A)"


@dataclass(frozen=True, eq=False)
class TrackLevel:
    """Level that a source has with a track.

    Attributes
    ----------
    bands : numpy.ndarray (21,) [dB]
        Level per band, NaN where the source has none.
    unweighted : float [dB]
        Sum of the energies of all bands.
    a_weighted : float [dB(A)]
        The same, A-weighted.
    """

    bands: RealArray = field(repr=False)
    unweighted: float
    a_weighted: float

    def relative_to(self, base: "TrackLevel") -> LevelDifference:
        """Return by how much this level exceeds another of the same source (LevelDifference)."""
        return LevelDifference(self.unweighted - base.unweighted, self.a_weighted - base.a_weighted)

    def __str__(self) -> str:
        """Return both levels with their units."""
        return f"{self.unweighted:.1f} dB, {self.a_weighted:.1f} dB(A)"


@dataclass(frozen=True)
class SourceSpectrum(BandTable):
    """Level per band that a source has on the reference track.

    Parameters
    ----------
    points : iterable of (float, float)
        Rows of mid-band frequency [Hz], nominal or exact, and level [dB], in any order.
    name : str
        Name of the source.

    Raises
    ------
    SourceError
        If a row is no pair of numbers within their ranges, or there is no row.
    """

    name: str = "Source"

    quantity = Quantity(
        column="level_db",
        words="Level on the reference track",
        name="level",
        example=60.0,
        low=-200.0,
        high=300.0,
        error=SourceError,
        hints=r"level|pegel|source|quelle|niveau|livell|nivel|\bL",
    )

    def with_track(self, insertion_gain: ArrayLike) -> TrackLevel:
        """Return the level with a track.

        Parameters
        ----------
        insertion_gain : array_like (21,)
            Insertion gain of the track per band [dB]; zeros give the level on the reference track.

        Returns
        -------
        TrackLevel
            Level per band and in sum.

        Raises
        ------
        ValueError
            If there are not 21 finite levels.
        """
        gain = np.asarray(insertion_gain, dtype=float)
        if gain.shape != BAND_CENTRES.shape or not np.isfinite(gain).all():
            raise ValueError(f"give {BAND_CENTRES.size} finite levels, one per band")
        bands = self.levels + gain
        return TrackLevel(bands, _summed(bands), _summed(bands + A_WEIGHTING))


def _summed(levels: RealArray) -> float:
    """Return the level of the summed energies of the bands that have one [dB]."""
    return float(decibels(np.nansum(10 ** (levels / 10))))
