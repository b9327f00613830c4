"""What designs are held against, and what one asks of many designs at once.

dB, Hz, m. The governing margin of a design is the least margin over the bands that have a limit: limit less
insertion gain, by the definition that is asked for. A design complies if its governing margin is not below
zero and its rail sinks no further than allowed.
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass, replace

import numpy as np

from trackig_core.arrays import BoolArray, RealArray
from trackig_core.bands import BAND_LABELS, decibels
from trackig_core.frequency_domain.batch import BatchSolution
from trackig_core.levels.insertion_gain import REFERENCES, SUMMATIONS, check_choice, check_reference
from trackig_core.levels.source import A_WEIGHTING, SourceSpectrum
from trackig_core.levels.specification import DEFLECTION_TOLERANCE, LEVEL_TOLERANCE, Specification
from trackig_core.track.design import TrackDesign

MARGIN, LEVEL, DEFLECTION = "margin", "level", "deflection"
FREQUENCIES = ("loaded_track", "coupled_block")

UNITS = {
    MARGIN: "dB",
    LEVEL: "dB(A)",
    DEFLECTION: "m",
    "loaded_track": "Hz",
    "coupled_block": "Hz",
} | dict.fromkeys(BAND_LABELS, "dB")
"""Unit of each figure by name; the name of a band is its nominal mid-band frequency, such as ``"63"``."""

WORDS = {
    MARGIN: "governing margin",
    LEVEL: "A-weighted level",
    DEFLECTION: "rail deflection",
    "loaded_track": "loaded-track frequency",
    "coupled_block": "coupled-block frequency",
} | {label: f"insertion gain at {label} Hz" for label in BAND_LABELS}
"""What each figure is called."""


@dataclass(frozen=True)
class Requirements:
    """What designs are held against, and by which definition of insertion gain.

    Parameters
    ----------
    specification : Specification or None
        Greatest insertion gain per band [dB].
    source : SourceSpectrum or None
        Levels on the reference track [dB], for A-weighted levels.
    reference, summation : str
        Definition of insertion gain, as for :func:`trackig_core.solve`.
    max_deflection : float or None
        Greatest rail deflection under the specification's wheel load, in place of its own limit [m].

    Raises
    ------
    SpecificationError
        If the greatest deflection is no number within its range.
    TypeError
        If the specification or the source is of another kind.
    ValueError
        If a choice is not allowed, or a deflection is limited without a specification.
    """

    specification: Specification | None = None
    source: SourceSpectrum | None = None
    reference: str = "line"
    summation: str = "energy"
    max_deflection: float | None = None

    def __post_init__(self) -> None:
        """Check every value once."""
        for name, kind in (("specification", Specification), ("source", SourceSpectrum)):
            value = getattr(self, name)
            if value is not None and not isinstance(value, kind):
                raise TypeError(f"{name} = {value!r}: give a {kind.__name__}")
        check_choice("reference", self.reference, REFERENCES)
        check_choice("summation", self.summation, SUMMATIONS)
        if self.max_deflection is not None:
            if self.specification is None:
                raise ValueError(f"max_deflection = {self.max_deflection!r}: {_MISSING[MARGIN]}")
            limited = replace(self.specification, rail_deflection_limit=self.max_deflection)
            object.__setattr__(self, "specification", limited)

    @property
    def names(self) -> tuple[str, ...]:
        """Bands that have a limit, by name: the columns of :meth:`margins`."""
        return tuple(label for label, limited in zip(BAND_LABELS, self._limited, strict=True) if limited)

    @property
    def _limited(self) -> BoolArray:
        if self.specification is None:
            raise ValueError(_MISSING[MARGIN])
        if self.specification.question:
            raise ValueError(self.specification.question)
        return np.isfinite(self.specification.levels)

    def levels(self, many: BatchSolution) -> RealArray:
        """Return insertion gain by this definition (..., 21) [dB]."""
        return many.gain_for(self.reference, self.summation)

    def margins(self, many: BatchSolution) -> RealArray:
        """Return limit less insertion gain in the bands that have a limit (..., limited) [dB]."""
        limited = self._limited
        assert self.specification is not None
        margins = self.specification.levels[limited] - self.levels(many)[..., limited]
        margins[np.abs(margins) < LEVEL_TOLERANCE] = 0.0
        return margins

    def governing_margin(self, many: BatchSolution) -> RealArray:
        """Return the least margin over the bands that have a limit (...) [dB].

        Where only the deflection has one, it is the slack of that: 20 lg of limit over deflection.
        """
        return (self.margins(many) if self.names else self.slacks(many)).min(axis=-1)

    @property
    def deflection_limit(self) -> float | None:
        """Greatest rail deflection allowed [m], or None."""
        return None if self.specification is None else self.specification.rail_deflection_limit

    def deflection(self, many: BatchSolution) -> RealArray:
        """Return the static rail deflection under the specification's wheel load (...) [m]."""
        load = many.wheel_load if self.specification is None else self.specification.wheel_load
        return many.rail_deflection * (load / many.wheel_load)

    def slacks(self, many: BatchSolution) -> RealArray:
        """Return how far designs keep each limit (..., limits) [dB]: the margins, and of a deflection 20 lg.

        A design complies where none is below zero; each is smooth in every field.
        """
        margins, limit = self.margins(many), self.deflection_limit
        if limit is None:
            return margins
        slack = 2 * decibels((limit + DEFLECTION_TOLERANCE) / self.deflection(many))
        return np.concatenate([margins, slack[..., None]], axis=-1)

    def complies(self, many: BatchSolution) -> BoolArray:
        """Return which designs comply (...)."""
        return self.slacks(many).min(axis=-1) >= 0

    def values(self, many: BatchSolution, figure: str) -> RealArray:
        """Return one figure of many designs.

        Parameters
        ----------
        many : BatchSolution
            The designs, solved.
        figure : str
            A key of :data:`UNITS`: ``"margin"`` (governing margin) [dB], ``"level"`` [dB(A)],
            ``"deflection"`` (of the rail, static) [m], ``"loaded_track"`` or ``"coupled_block"`` [Hz], or a
            band such as ``"63"``: insertion gain [dB].

        Returns
        -------
        numpy.ndarray (...)
            The figure [its unit].

        Raises
        ------
        ValueError
            If there is no specification or source from which to compute it.
        """
        if figure == MARGIN:
            return self.governing_margin(many)
        if figure == LEVEL:
            return self._a_weighted(many)
        if figure == DEFLECTION:
            return self.deflection(many)
        if figure in FREQUENCIES:
            return getattr(many, figure)
        return self.levels(many)[..., BAND_LABELS.index(figure)]

    def _a_weighted(self, many: BatchSolution) -> RealArray:
        if self.source is None:
            raise ValueError(_MISSING[LEVEL])
        bands = self.source.levels + A_WEIGHTING + self.levels(many)
        return decibels(np.nansum(10 ** (bands / 10), axis=-1))

    def figures(self, design: TrackDesign) -> tuple[str, ...]:
        """Return the names of the figures that can be computed, bands apart, the governing margin first."""
        known = {MARGIN: self.specification is not None, LEVEL: self.source is not None, DEFLECTION: True}
        known |= {"loaded_track": True, "coupled_block": design.two_stage}
        return tuple(name for name, there in known.items() if there)

    def check_figures(self, figures: Collection[str], design: TrackDesign) -> None:
        """Raise a ValueError that says what is missing if a figure of a design cannot be computed."""
        check_reference(design, self.reference)
        known = self.figures(design)
        for name in figures:
            if name in known or name in BAND_LABELS:
                continue
            if name in UNITS:
                raise ValueError(f"{name}: {_MISSING[name]}")
            raise ValueError(f"figure = {name!r}: give {', '.join(known)}, or a band such as '63'")


_MISSING = {
    MARGIN: "there is no specification to hold the designs against; give one",
    LEVEL: "there is no source spectrum from which to compute a level; give one",
    "coupled_block": "a single-stage track has no block",
}
"""What a figure is not computed for."""
