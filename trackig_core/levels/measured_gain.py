"""Insertion gain from elsewhere, to be held beside what is computed: measured on site, or from a paper.

dB per one-third-octave band. It is no limit and demands nothing: a
:class:`trackig_core.levels.specification.Specification` is another class, with another column and another
place in a study.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from trackig_core.arrays import RealArray
from trackig_core.bands import BAND_CENTRES
from trackig_core.levels.band_tables import BandTable, BandTableError, Quantity


class MeasuredGainError(BandTableError):
    """A measured insertion gain cannot be used; ``line`` and ``column`` say where it is at fault."""


@dataclass(frozen=True)
class MeasuredGain(BandTable):
    """Insertion gain that was measured, or that somebody else computed.

    Parameters
    ----------
    points : iterable of (float, float)
        Rows of mid-band frequency [Hz], nominal or exact, and insertion gain [dB], in any order.
    name : str
        What it is, and where it is from.

    Raises
    ------
    MeasuredGainError
        If a row is no pair of numbers within their ranges, or there is no row.
    """

    name: str = "Measured"

    quantity = Quantity(
        column="ig_db",
        words="Insertion gain, measured or from elsewhere",
        name="gain",
        example=-3.0,
        low=-150.0,
        high=150.0,
        error=MeasuredGainError,
        hints=r"insertion|einf|\big\b|gain|measured|gemess|level|pegel",
    )

    def difference(self, levels: ArrayLike) -> RealArray:
        """Return by how much a computed insertion gain exceeds this one.

        Parameters
        ----------
        levels : array_like (21,)
            Insertion gain per band [dB].

        Returns
        -------
        numpy.ndarray (21,)
            Computed less measured [dB]; NaN in bands without a measured level.

        Raises
        ------
        ValueError
            If there are not 21 finite levels.
        """
        levels = np.asarray(levels, dtype=float)
        if levels.shape != BAND_CENTRES.shape or not np.isfinite(levels).all():
            raise ValueError(f"give {BAND_CENTRES.size} finite levels, one per band")
        difference: RealArray = levels - self.levels
        return difference
