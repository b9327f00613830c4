"""One-third-octave bands and decibels.

Base-ten bands of IEC 61260-1:2014: exact mid-band frequencies (section 5.4), nominal
frequencies (annex E) and band edges (section 5.5). Frequencies in Hz, levels in dB.

Every band quantity in the package uses the arrays below, so that a band
means the same everywhere.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from trackig_core.arrays import RealArray

BAND_NUMBERS = np.arange(7, 28)
"""Numbers n of the bands from 5 Hz to 500 Hz (21,) [-]."""

BAND_CENTRES = 10.0 ** (BAND_NUMBERS / 10)
"""Exact mid-band frequencies, 10**(n/10) (21,) [Hz]; IEC 61260-1, 5.4 with b = 3."""

BAND_EDGES = 10.0 ** ((np.append(BAND_NUMBERS, BAND_NUMBERS[-1] + 1) - 0.5) / 10)
"""Edges between neighbouring bands, centre times 10**(+-1/20) (22,) [Hz]; IEC 61260-1, 5.5."""

BAND_LABELS = (
    "5", "6.3", "8", "10", "12.5", "16", "20", "25", "31.5", "40", "50",
    "63", "80", "100", "125", "160", "200", "250", "315", "400", "500",
)  # fmt: skip
"""Nominal mid-band frequencies as engineers write them [Hz]; IEC 61260-1, annex E."""

LINE_FRACTION = 0.1
"""Frequency at which the straight reference line touches the spectrum, in parts of the loaded-track frequency
[-]: well below the resonance, where every track still follows its wheel."""

for _array in (BAND_NUMBERS, BAND_CENTRES, BAND_EDGES):
    _array.flags.writeable = False


def decibels(ratio: ArrayLike) -> RealArray:
    """Return the level of a ratio of energies.

    Parameters
    ----------
    ratio : array_like
        Ratio of two energy-like quantities [-], greater than zero.

    Returns
    -------
    numpy.ndarray
        10 log10(ratio) [dB], of the same shape.
    """
    return 10 * np.log10(ratio)


_NOMINAL = (1.0, 1.25, 1.6, 2.0, 2.5, 3.15, 4.0, 5.0, 6.3, 8.0)
"""Nominal mid-band frequencies of one decade (10,) [Hz]; IEC 61260-1, annex E."""


@dataclass(frozen=True)
class Bands:
    """A row of neighbouring bands, base ten (IEC 61260-1).

    Attributes
    ----------
    first, last : int
        Numbers n of the first and the last band, whose exact mid-band frequencies are 10**(n/10) Hz.
    tenths : int
        Width of a band in tenths of a decade: 1 for one-third octaves, 3 for octaves.
    """

    first: int
    last: int
    tenths: int = 1

    @property
    def words(self) -> str:
        """What a band is, in words."""
        return "One-third-octave" if self.tenths == 1 else "Octave"

    @property
    def numbers(self) -> range:
        """Numbers n of the bands."""
        return range(self.first, self.last + 1, self.tenths)

    @cached_property
    def centres(self) -> RealArray:
        """Exact mid-band frequencies (bands,) [Hz]."""
        return 10.0 ** (np.array(self.numbers) / 10)

    @cached_property
    def edges(self) -> RealArray:
        """Edges between neighbouring bands (bands + 1,) [Hz]."""
        numbers = np.append(self.numbers, self.numbers[-1] + self.tenths)
        return 10.0 ** ((numbers - self.tenths / 2) / 10)

    @cached_property
    def labels(self) -> tuple[str, ...]:
        """Nominal mid-band frequencies, as text (bands,) [Hz]."""
        return tuple(f"{_NOMINAL[n % 10] * 10.0 ** (n // 10):g}" for n in self.numbers)

    def __str__(self) -> str:
        """Return width and range of the bands."""
        return f"{self.words} bands from {self.labels[0]} to {self.labels[-1]} Hz"


ONE_THIRD_OCTAVES = Bands(7, 27)
"""The paper's bands: one-third octaves from 5 Hz to 500 Hz."""

BANDS = {
    "one-third-octave": ONE_THIRD_OCTAVES,
    "octave": Bands(9, 24, 3),
    "wide one-third-octave": Bands(0, 30),
    "wide octave": Bands(0, 30, 3),
}
"""Bands that may be chosen: those of the paper, octaves within them (8 Hz to 250 Hz), and both kinds from
1 Hz to 1 kHz, where the model says less: below 5 Hz a real wheel follows its suspension, and above 500 Hz the
rail shears and three elements a bay are few."""

WIDEST = Bands(-1, 31)
"""One-third octaves whose edges are those of all bands that may be chosen."""


def chosen_bands(name: str) -> Bands:
    """Return the bands of a name.

    Parameters
    ----------
    name : str
        A key of :data:`BANDS`.

    Returns
    -------
    Bands
        The bands.

    Raises
    ------
    ValueError
        If there are none of that name.
    """
    if name not in BANDS:
        raise ValueError(f"bands = {name!r}: give {' or '.join(map(repr, BANDS))}")
    return BANDS[name]
