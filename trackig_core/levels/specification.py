"""The curve that a track has to meet: the greatest insertion gain allowed per one-third-octave band.

dB, Hz. The verdict compares levels as they are, before any rounding: a margin of exactly zero complies,
and a margin that one decimal would show as zero is shown with as many decimals as it needs.

A track complies if it keeps every band that is specified; bands without a limit say nothing.
"""

import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike

from trackig_core.arrays import BoolArray, RealArray
from trackig_core.bands import BAND_CENTRES, BAND_LABELS
from trackig_core.levels.band_tables import BandTable, BandTableError, Quantity

LEVEL_TOLERANCE = 1e-6
"""Margin below which a level is taken to lie on its limit [dB]: floating-point arithmetic leaves as much."""


class SpecificationError(BandTableError):
    """A specification cannot be used; ``line`` and ``column`` say where it is at fault."""


@dataclass(frozen=True)
class Specification(BandTable):
    """Required insertion gain: the greatest level allowed, in some or all bands.

    Parameters
    ----------
    points : iterable of (float, float)
        Rows of mid-band frequency [Hz], nominal or exact, and greatest insertion gain [dB], in any order.
    name : str
        Name of the specification.

    Raises
    ------
    SpecificationError
        If a row is no pair of numbers within their ranges, or there is no row.
    """

    name: str = "Specification"

    quantity = Quantity(
        column="ig_max_db",
        words="Greatest insertion gain allowed",
        low=-100.0,
        high=100.0,
        error=SpecificationError,
        hints=r"limit|grenz|max|zul|allow|permit|requir|exig|anforder|soll|spec|insertion|einf|≤|<",
        is_bound=True,
    )

    @property
    def is_probably_loss(self) -> bool:
        """Whether no limit is below zero and one is above, as if they were insertion *losses*."""
        limits = [limit for _, limit in self.points]
        return min(limits) >= 0 and max(limits) > 0

    def turned(self) -> "Specification":
        """Return a specification of the same name with the sign of every limit turned (Specification)."""
        return Specification(tuple((frequency, -limit) for frequency, limit in self.points), self.name)

    def check(self, levels: ArrayLike) -> "Verdict":
        """Compare insertion gain with the specification.

        Parameters
        ----------
        levels : array_like (21,)
            Insertion gain per band [dB].

        Returns
        -------
        Verdict
            Margin per band, and whether the track complies.

        Raises
        ------
        ValueError
            If there are not 21 finite levels.
        """
        levels = np.asarray(levels, dtype=float)
        if levels.shape != BAND_CENTRES.shape or not np.isfinite(levels).all():
            raise ValueError(f"give {BAND_CENTRES.size} finite levels, one per band")
        margins = self.levels - levels
        margins[np.abs(margins) < LEVEL_TOLERANCE] = 0.0
        margins.flags.writeable = False
        return Verdict(margins)


@dataclass(frozen=True, eq=False)
class Verdict:
    """How a track fares against a specification.

    Attributes
    ----------
    margins : numpy.ndarray (21,) [dB]
        Limit less insertion gain: below zero where the track fails, NaN where nothing is specified.
    """

    margins: RealArray = field(repr=False)

    @property
    def complies(self) -> bool:
        """Whether no margin is below zero."""
        return self.worst_margin >= 0

    @property
    def worst_margin(self) -> float:
        """Least margin [dB]."""
        return float(np.nanmin(self.margins))

    @property
    def worst_band(self) -> str:
        """Nominal mid-band frequency, as text, of the band with the least margin [Hz]."""
        return BAND_LABELS[int(np.nanargmin(self.margins))]

    @property
    def fails(self) -> BoolArray:
        """Whether the track fails, per band (21,)."""
        return self.margins < 0

    def __str__(self) -> str:
        """Return the verdict in words."""
        amount = f"{margin_text(abs(self.worst_margin))} dB at {self.worst_band} Hz"
        if self.complies:
            return f"complies, least margin {amount}"
        count = int(self.fails.sum())
        return f"fails by {amount} ({count} {'band' if count == 1 else 'bands'})"


def margin_text(margin: float) -> str:
    """Return a margin [dB], zero or more, with one decimal, or as many as tell it from zero."""
    if margin == 0 or margin >= 0.05:
        return f"{margin:.1f}"
    return f"{margin:.{-math.floor(math.log10(margin))}f}"
