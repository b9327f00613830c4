"""The curve that a track has to meet: the greatest insertion gain allowed per one-third-octave band.

dB, Hz. The verdict compares levels as they are, before any rounding: a margin of exactly zero complies,
and a margin that one decimal would show as zero is shown with as many decimals as it needs.

A track complies if it keeps every band that is specified, and the limit of rail deflection if there is one;
bands without a limit say nothing.
"""

import math
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import ArrayLike

from trackig_core.arrays import BoolArray, RealArray
from trackig_core.bands import BAND_CENTRES, BAND_LABELS
from trackig_core.levels.band_tables import BandTable, BandTableError, Quantity
from trackig_core.track.fields import DEFAULT_WHEEL_LOAD, DesignError, check_number
from trackig_core.words import quantity

LEVEL_TOLERANCE = 1e-6
"""Margin below which a level is taken to lie on its limit [dB]: floating-point arithmetic leaves as much."""


DEFLECTION_TOLERANCE = 1e-12
"""Margin below which a deflection is taken to lie on its limit [m]: floating-point error."""

MILLIMETRES = 1e3
"""One metre in millimetres."""


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
    rail_deflection_limit : float or None
        Greatest static deflection allowed of the rail under the wheel, over a support [m]; None: no limit.
        Where there is one, no band needs a limit.
    wheel_load : float
        Load of the wheel under which that limit holds [N]; the default where there is no limit.

    Raises
    ------
    SpecificationError
        If a row is no pair of numbers within their ranges, or there is no row, or limit or load is no number
        within its range.
    """

    name: str = "Specification"
    rail_deflection_limit: float | None = None
    wheel_load: float = DEFAULT_WHEEL_LOAD

    quantity = Quantity(
        column="ig_max_db",
        words="Greatest insertion gain allowed",
        name="limit",
        example=-3.0,
        low=-100.0,
        high=100.0,
        error=SpecificationError,
        hints=r"limit|grenz|max|zul|allow|permit|requir|exig|anforder|soll|spec|insertion|einf|≤|<",
        is_bound=True,
    )

    def __post_init__(self) -> None:
        """Check every value once."""
        super().__post_init__()
        load = _number("wheel_load", self.wheel_load)
        if self.rail_deflection_limit is None:
            load = DEFAULT_WHEEL_LOAD  # nothing depends on it
        else:
            limit = _number("rail_deflection_limit", self.rail_deflection_limit)
            object.__setattr__(self, "rail_deflection_limit", limit)
        object.__setattr__(self, "wheel_load", load)

    @property
    def may_be_empty(self) -> bool:
        """Whether the rail's deflection is limited, so that no band needs to be."""
        return self.rail_deflection_limit is not None

    @property
    def is_probably_loss(self) -> bool:
        """Whether no limit is below zero and one is above, as if they were insertion *losses*."""
        limits = [limit for _, limit in self.points]
        return bool(limits) and min(limits) >= 0 and max(limits) > 0

    def turned(self) -> "Specification":
        """Return the same specification with the sign of every level turned (Specification)."""
        return replace(self, points=tuple((frequency, -limit) for frequency, limit in self.points))

    def check(self, levels: ArrayLike, rail_deflection: float | None = None) -> "Verdict":
        """Compare a track with the specification.

        Parameters
        ----------
        levels : array_like (21,)
            Insertion gain per band [dB].
        rail_deflection : float, optional
            Static deflection of the rail under :attr:`wheel_load` [m]; it has to be given if it is limited.

        Returns
        -------
        Verdict
            Margin per band and of the deflection, and whether the track complies.

        Raises
        ------
        ValueError
            If there are not 21 finite levels, or the deflection is limited and no finite one is given.
        """
        levels = np.asarray(levels, dtype=float)
        if levels.shape != BAND_CENTRES.shape or not np.isfinite(levels).all():
            raise ValueError(f"give {BAND_CENTRES.size} finite levels, one per band")
        margins = self.levels - levels
        margins[np.abs(margins) < LEVEL_TOLERANCE] = 0.0
        margins.flags.writeable = False
        return Verdict(margins, self._deflection_margin(rail_deflection))

    def _deflection_margin(self, rail_deflection: float | None) -> float | None:
        """Return limit less deflection [m], or None if there is no limit."""
        if self.rail_deflection_limit is None:
            return None
        if rail_deflection is None or not math.isfinite(rail_deflection):
            load = self.wheel_load / 1e3
            raise ValueError(
                f"rail_deflection = {rail_deflection!r}: the specification limits it, so give that under "
                f"{load:g} kN, static_response(design, wheel_load).rail_deflection"
            )
        margin = self.rail_deflection_limit - float(rail_deflection)
        return 0.0 if abs(margin) < DEFLECTION_TOLERANCE else margin

    def __str__(self) -> str:
        """Return name, frequencies [Hz] and limits [dB], and that of the deflection."""
        limit = self.rail_deflection_limit
        if limit is None:
            return super().__str__()
        load = quantity(self.wheel_load, "N")
        return f"{super().__str__()}; rail deflection at most {quantity(limit, 'm')} under {load}"


@dataclass(frozen=True, eq=False)
class Verdict:
    """How a track fares against a specification.

    Attributes
    ----------
    margins : numpy.ndarray (21,) [dB]
        Limit less insertion gain: below zero where the track fails, NaN where nothing is specified.
    deflection_margin : float or None [m]
        Limit less rail deflection: below zero if the track fails; None if it is not limited.
    """

    margins: RealArray = field(repr=False)
    deflection_margin: float | None = None

    @property
    def complies(self) -> bool:
        """Whether no margin is below zero."""
        return self.worst_margin >= 0 and not self.sinks_too_far

    @property
    def sinks_too_far(self) -> bool:
        """Whether the rail deflection is above its limit."""
        return self.deflection_margin is not None and self.deflection_margin < 0

    @property
    def worst_margin(self) -> float:
        """Least margin [dB]; infinite where no band has a limit."""
        return float(np.min(self.margins, where=np.isfinite(self.margins), initial=np.inf))

    @property
    def worst_band(self) -> str:
        """Nominal mid-band frequency, as text, of the band with the least margin [Hz]; empty without any."""
        return "" if np.isinf(self.worst_margin) else BAND_LABELS[int(np.nanargmin(self.margins))]

    @property
    def fails(self) -> BoolArray:
        """Whether the track fails, per band (21,)."""
        return self.margins < 0

    def __str__(self) -> str:
        """Return the verdict in words."""
        if np.isinf(self.worst_margin):
            return f"{'complies' if self.complies else 'fails'}; {self._deflection_words}"
        amount = f"{margin_text(abs(self.worst_margin))} dB at {self.worst_band} Hz"
        count = int(self.fails.sum())
        if not count:
            words = f"{'fails' if self.sinks_too_far else 'complies'}, least margin {amount}"
        else:
            words = f"fails by {amount} ({count} {'band' if count == 1 else 'bands'})"
        return words if self.deflection_margin is None else f"{words}; {self._deflection_words}"

    @property
    def _deflection_words(self) -> str:
        """The deflection against its limit, in words."""
        margin = (self.deflection_margin or 0.0) * MILLIMETRES
        beyond = "beyond" if self.sinks_too_far else "within"
        return f"rail deflection {margin_text(abs(margin))} mm {beyond} its limit"


def _number(field: str, value: object) -> float:
    """Return a value as a number of a field's range, or raise a SpecificationError."""
    try:
        return check_number(field, value)
    except DesignError as error:
        raise SpecificationError(str(error)) from None


def margin_text(margin: float) -> str:
    """Return a margin [dB or mm], zero or more, with one decimal, or as many as tell it from zero."""
    if margin == 0 or margin >= 0.05:
        return f"{margin:.1f}"
    return f"{margin:.{-math.floor(math.log10(margin))}f}"
