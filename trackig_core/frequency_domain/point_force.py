"""The supported rail under a force on any of its elements, over a support or between two.

With phi(e) either of the two waves that decay along the rail (see
:mod:`trackig_core.frequency_domain.floquet_waves`), 1 over support 0, and a its share of the point receptance
over a support, reciprocity gives the displacement of element e per force on element l as

    G(e, l) = sum over both waves of a phi(-l) phi(e),    e >= l,

and G(e, l) = G(l, e). No element is interpolated. Time dependence exp(+i w t), or rest; SI units.
"""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike

from trackig_core.arrays import ComplexArray, IntArray, RealArray
from trackig_core.frequency_domain.axles import bay_shapes
from trackig_core.frequency_domain.floquet_waves import Waves, waves
from trackig_core.frequency_domain.lattice import Lattice
from trackig_core.frequency_domain.track_model import Track, track_model
from trackig_core.track.design import TrackDesign


@dataclass(frozen=True, eq=False)
class RailWaves:
    """Both waves on every element of an infinite rail.

    Attributes
    ----------
    track : Waves
        The waves from bay to bay.
    shapes : numpy.ndarray of complex (per_bay, 2, frequencies) [-]
        The waves within one bay, 1 over the support that it begins with.
    """

    track: Waves
    shapes: ComplexArray = field(repr=False)

    @classmethod
    def of(cls, design: TrackDesign, track: Waves, per_bay: int) -> "RailWaves":
        """Return the waves of a design on every element.

        Parameters
        ----------
        design : TrackDesign
            The track, for its rail and spacing.
        track : Waves
            The waves from bay to bay.
        per_bay : int
            Rail elements per bay.

        Returns
        -------
        RailWaves
            The waves.
        """
        return cls(track, bay_shapes(design, track, per_bay))

    @property
    def per_bay(self) -> int:
        """Rail elements per bay."""
        return len(self.shapes)

    def at(self, element: ArrayLike) -> ComplexArray:
        """Return both waves at elements, 0 over support 0 (..., 2, frequencies) [-]."""
        bay, within = np.divmod(np.asarray(element), self.per_bay)
        shape: ComplexArray = self.shapes[within] * self.track.multipliers ** bay[..., None, None]
        return shape

    def receptance(self, elements: IntArray, loaded: int) -> ComplexArray:
        """Return the displacement of elements per force on another.

        Parameters
        ----------
        elements : numpy.ndarray of int (elements,)
            Numbers of the elements, 0 over support 0.
        loaded : int
            Number of the element under the force.

        Returns
        -------
        numpy.ndarray of complex (elements, frequencies)
            Receptance [m/N].
        """
        bay, loaded = divmod(loaded, self.per_bay)
        elements = np.asarray(elements) - bay * self.per_bay
        outwards = self.at(-np.minimum(elements, loaded)) * self.at(np.maximum(elements, loaded))
        return np.sum(self.track.amplitudes * outwards, axis=-2)

    def energy_sum(self, begin: int, loaded: int) -> RealArray:
        """Return the squared receptance summed over an element and those one, two ... bays further.

        Parameters
        ----------
        begin, loaded : int
            Number of the first element, and of the element under the force, which lies not beyond it.

        Returns
        -------
        numpy.ndarray (frequencies,)
            Sum to infinity [m2/N2].
        """
        bay, loaded = divmod(loaded, self.per_bay)
        first = self.track.amplitudes * self.at(-loaded) * self.at(begin - bay * self.per_bay)
        both = self.track.multipliers
        series = first[:, None] * first.conj() / (1 - both[:, None] * both.conj())
        return series.sum(axis=(0, 1)).real


def rail_waves(design: Track, frequency: ArrayLike, lattice: Lattice) -> RailWaves:
    """Return both waves on every element of a track.

    Parameters
    ----------
    design : TrackDesign or TrackModel
        The track.
    frequency : array_like (frequencies,)
        Frequencies [Hz], greater than zero.
    lattice : Lattice
        What to solve; infinite.

    Returns
    -------
    RailWaves
        The waves.

    Raises
    ------
    ValueError
        If the lattice is a ring, or a frequency is not greater than zero.
    """
    if lattice.bays is not None:
        raise ValueError(f"bays = {lattice.bays}: give a lattice with bays=None, an infinite track")
    model = track_model(design)
    return RailWaves.of(model.design, waves(model, frequency, lattice), lattice.elements_per_bay)
