"""Receptances of the paper's tracks as an independent package computes them.

Point receptance of the rail over a support, from the open-source package Rolland 26.08a1 (a
semi-analytical, discretely supported beam on 241 supports), with the support's dynamic stiffness at
each frequency from the three-term relaxation fit. Rail 60 kg/m, EI = 6.3798e6 N m2; for the
Timoshenko rail G = 81 GPa and kappa = 0.4. Hz and m/N. The file is data from elsewhere, and nothing here
changes it.
"""

from dataclasses import dataclass, field
from functools import cache
from importlib.resources import files

import numpy as np

from trackig_core.arrays import ComplexArray, RealArray
from trackig_core.words import span


@dataclass(frozen=True, eq=False)
class PeerReceptance:
    """Point receptance of one track, by an independent package.

    Attributes
    ----------
    frequency : numpy.ndarray (21,) [Hz]
        Mid-band frequencies from 5 Hz to 500 Hz.
    euler : numpy.ndarray of complex (21,) [m/N]
        Receptance with a rail that does not shear, as in this package.
    timoshenko : numpy.ndarray of complex (21,) [m/N]
        Receptance with a rail that shears and has rotational inertia.
    """

    frequency: RealArray = field(repr=False)
    euler: ComplexArray = field(repr=False)
    timoshenko: ComplexArray = field(repr=False)

    def __str__(self) -> str:
        """Return the range of both receptances, with their units."""
        euler, timoshenko = (span(np.abs(each), "m/N") for each in (self.euler, self.timoshenko))
        at = span(self.frequency, "Hz")
        return f"point receptance, {at}: Euler rail {euler}, Timoshenko rail {timoshenko}"


@cache
def peer_receptances() -> dict[str, PeerReceptance]:
    """Return the independent package's receptances.

    Returns
    -------
    dict of str to PeerReceptance
        By name of the preset.
    """
    with (files("trackig_core.analysis") / "data" / "peer_receptance.csv").open() as lines:
        table = np.genfromtxt(lines, delimiter=",", names=True, skip_header=2, dtype=None, encoding="ascii")
    return {
        str(case): PeerReceptance(
            rows["frequency_hz"],
            rows["euler_re"] + 1j * rows["euler_im"],
            rows["timoshenko_re"] + 1j * rows["timoshenko_im"],
        )
        for case in dict.fromkeys(table["case"])
        for rows in [table[table["case"] == case]]
    }
