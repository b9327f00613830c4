"""The curve that a track has to meet: the greatest insertion gain allowed per one-third-octave band.

dB, Hz. The verdict compares levels as they are, before any rounding: a margin of exactly zero complies,
and a margin that one decimal would show as zero is shown with as many decimals as it needs.

A track complies if it keeps every band that is specified, and the limit of rail deflection if there is one;
bands without a limit say nothing. There is no verdict as long as it is open what the limits are: insertion
gains, or insertion losses, which have the opposite sign. Limits that were given for no band of the model are
named with the verdict.
"""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, Self

import numpy as np
from numpy.typing import ArrayLike

from trackig_core.arrays import BoolArray, RealArray
from trackig_core.bands import BAND_CENTRES, BAND_LABELS
from trackig_core.levels.band_tables import (
    LONGEST_SET_ASIDE,
    MOST_SET_ASIDE,
    BandTable,
    BandTableError,
    Quantity,
)
from trackig_core.names import brief, is_name
from trackig_core.track.fields import DEFAULT_WHEEL_LOAD, DesignError, check_number
from trackig_core.words import quantity

LEVEL_TOLERANCE = 1e-6
"""Margin below which a level is taken to lie on its limit [dB]: floating-point arithmetic leaves as much."""


DEFLECTION_TOLERANCE = 1e-12
"""Margin below which a deflection is taken to lie on its limit [m]: floating-point error."""

MILLIMETRES = 1e3
"""One metre in millimetres."""

GAIN, UNSTATED, CALLED_LOSS = KINDS_OF_LIMIT = ("insertion gain", "unstated", "called insertion loss")
"""What the limits of a specification are: said to be insertion gains; nobody said; or where they come from,
they are called insertion losses."""

MOST_NAMED = 8
"""Limits that a verdict names one by one because they are not judged [-]."""


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
    limits : str
        One of :data:`KINDS_OF_LIMIT`: what the limits of the bands are known to be.
    not_judged : tuple of str
        What limits are called that were given for no band of the model, such as ``"630 Hz"``.

    Raises
    ------
    SpecificationError
        If a row is no pair of numbers within their ranges, or there is no row, or another value is not
        allowed.
    """

    name: str = "Specification"
    rail_deflection_limit: float | None = None
    wheel_load: float = DEFAULT_WHEEL_LOAD
    limits: str = GAIN
    not_judged: tuple[str, ...] = ()

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
        if self.limits not in KINDS_OF_LIMIT:
            allowed = ", ".join(map(repr, KINDS_OF_LIMIT))
            raise SpecificationError(f"limits = {brief(self.limits)}: give one of {allowed}")
        if self.limits == UNSTATED and not self.is_probably_loss:
            object.__setattr__(self, "limits", GAIN)  # some limit is below zero, as no loss is
        object.__setattr__(self, "not_judged", _names(self.not_judged))

    @classmethod
    def given(
        cls,
        points: Iterable[Iterable[Any]],
        name: str | None = None,
        says_loss: bool = False,
        set_aside: Sequence[str] = (),
    ) -> Self:
        """Return the specification that somebody typed, pasted or saved, see :meth:`BandTable.given`."""
        return cls(
            points,  # type: ignore[arg-type]  # rows of any kind are checked
            cls.name if name is None else name,
            limits=CALLED_LOSS if says_loss else UNSTATED,
            not_judged=tuple(set_aside),
        )

    def beside(self, other: Self) -> Self:
        """Return this specification in the place of another, whose limit of deflection stays."""
        return replace(self, rail_deflection_limit=other.rail_deflection_limit, wheel_load=other.wheel_load)

    @property
    def question(self) -> str:
        """What has to be answered before there is a verdict, for people; empty if nothing has."""
        if self.limits == CALLED_LOSS:
            return f"the limits are called insertion losses: {_WHICH}"
        if self.limits == UNSTATED:
            return f"no limit is below 0 dB, as if they were insertion losses: {_WHICH}"
        return ""

    @property
    def in_force(self) -> Self | None:
        """The specification where designs can be held against it, None while :attr:`question` is open."""
        return None if self.question else self

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
        """Return that of insertion gain where the limits are losses: signs are turned (Specification)."""
        points = tuple((frequency, -limit) for frequency, limit in self.points)
        return replace(self, points=points, limits=GAIN)

    def with_points(self, points: Iterable[Iterable[Any]]) -> Self:
        """Return the specification with other limits of bands, as they are typed one after the other.

        What was said of the limits holds as long as they look alike.
        """
        same = self.is_probably_loss or self.limits == CALLED_LOSS
        return replace(self, points=points, limits=self.limits if same else UNSTATED)  # type: ignore[arg-type]

    def kept(self) -> "Specification":
        """Return the same specification where the limits are said to be insertion gains (Specification)."""
        return replace(self, limits=GAIN)

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
        SpecificationError
            If it is open what the limits are, see :attr:`question`.
        ValueError
            If there are not 21 finite levels, or the deflection is limited and no finite one is given.
        """
        if self.question:
            raise SpecificationError(f"{self.question} turned() or kept() says which")
        levels = np.asarray(levels, dtype=float)
        if levels.shape != BAND_CENTRES.shape or not np.isfinite(levels).all():
            raise ValueError(f"give {BAND_CENTRES.size} finite levels, one per band")
        margins = self.levels - levels
        margins[np.abs(margins) < LEVEL_TOLERANCE] = 0.0
        margins.flags.writeable = False
        return Verdict(margins, self._deflection_margin(rail_deflection), self.not_judged)

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
    not_judged : tuple of str
        What limits are called that the track was not held against.
    """

    margins: RealArray = field(repr=False)
    deflection_margin: float | None = None
    not_judged: tuple[str, ...] = ()

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
        return "; ".join(filter(None, (self.judged_words, self.not_judged_words)))

    @property
    def judged_words(self) -> str:
        """What was judged, in words."""
        complies = "complies"
        if self.not_judged:
            judged = int(np.isfinite(self.margins).sum()) + (self.deflection_margin is not None)
            complies = f"complies in {judged} of {judged + len(self.not_judged)} limits"
        if np.isinf(self.worst_margin):
            return f"{complies if self.complies else 'fails'}; {self._deflection_words}"
        amount = f"{margin_text(abs(self.worst_margin))} dB at {self.worst_band} Hz"
        count = int(self.fails.sum())
        if not count:
            words = f"{'fails' if self.sinks_too_far else complies}, least margin {amount}"
        else:
            words = f"fails by {amount} ({count} {'band' if count == 1 else 'bands'})"
        return words if self.deflection_margin is None else f"{words}; {self._deflection_words}"

    @property
    def not_judged_words(self) -> str:
        """Which limits the track was not held against, in words; empty if against all."""
        return not_judged_text(self.not_judged)

    @property
    def _deflection_words(self) -> str:
        """The deflection against its limit, in words."""
        margin = (self.deflection_margin or 0.0) * MILLIMETRES
        side = "above" if self.sinks_too_far else "below"
        return f"rail deflection {margin_text(abs(margin))} mm {side} its limit"


_WHICH = "are they insertion gains, or losses, which have the opposite sign?"
"""What is asked of limits."""


def _names(given: Iterable[str]) -> tuple[str, ...]:
    """Return what limits are called that are not judged, checked."""
    names = tuple(given)
    if len(names) > MOST_SET_ASIDE or not all(is_name(each, LONGEST_SET_ASIDE) for each in names):
        raise SpecificationError(
            f"not_judged = {brief(names)}: give at most {MOST_SET_ASIDE} texts of at most "
            f"{LONGEST_SET_ASIDE} characters"
        )
    return names


def not_judged_text(names: Sequence[str]) -> str:
    """Return which limits are not judged and why, in words; empty if there is none."""
    if not names:
        return ""
    rest = len(names) - MOST_NAMED
    listed = ", ".join(names[:MOST_NAMED]) + (f" and {rest} more" if rest > 0 else "")
    return f"{len(names)} not judged, of no band from {BAND_LABELS[0]} to {BAND_LABELS[-1]} Hz: {listed}"


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
