"""How the track answers a hammer: point receptance over and between supports, and track decay rate.

Receptance is rail displacement over force [m/N], mobility velocity over force [m/(N s)]. Rolling noise and
EN 15461 look higher than insertion gain does, so the rail has 24 elements a bay here, and bands reach from
25 Hz to 1 kHz.

EN 15461:2008+A1:2010 defines the track decay rate by a sum over points x_n along the rail, one side of the
force,

    TDR = 4.343 / sum_n |A(x_n)|^2 / |A(x_0)|^2 dx_n    [dB/m],

A being the mobility at x_n, squared and averaged over the band, and dx_n the length that a point stands for,
half a step at x_0. The sum is carried to infinity here, where the standard ends at a fixed point. It is no
wave's rate of decay: on stiff pads, where most of the rail's movement stays near the force, it lies far above
the rate of the wave that lives longest, which is given beside it.
"""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike

from trackig_core.arrays import ComplexArray, RealArray
from trackig_core.bands import Bands
from trackig_core.frequency_domain.floquet_waves import NEPER, track_decay_rate
from trackig_core.frequency_domain.lattice import Lattice
from trackig_core.frequency_domain.point_force import RailWaves, rail_waves
from trackig_core.frequency_domain.track_model import Track, TrackModel, track_model
from trackig_core.levels.insertion_gain import check_choice
from trackig_core.words import span

FINE = Lattice(elements_per_bay=24)
"""The infinite track with elements short enough for 1 kHz."""

BANDS = Bands(14, 30)
"""One-third octaves from 25 Hz to 1 kHz."""

PLACES = ("support", "midspan")
"""Where the force acts: over a support, or half-way between two."""

POINTS_PER_BAY = 4
"""Points along the rail per bay [-], as the standard has them near the force."""

PER_BAND = 24
"""Frequencies per band over which squared mobility is averaged [-]."""

AXIS = np.geomspace(BANDS.edges[0], BANDS.edges[-1], 500)
"""Frequencies of the narrow-band curves (500,) [Hz]."""
AXIS.flags.writeable = False


@dataclass(frozen=True, eq=False)
class TrackResponse:
    """Receptance and decay rate of a track, the wheel away.

    Attributes
    ----------
    frequency : numpy.ndarray (frequencies,) [Hz]
        Frequencies of the receptances.
    support, midspan : numpy.ndarray of complex (frequencies,) [m/N]
        Point receptance of the rail over a support, and half-way between two.
    bands : Bands
        Bands of the decay rates.
    support_decay_rate, midspan_decay_rate : numpy.ndarray (bands,) [dB/m]
        Track decay rate by the sum of EN 15461, the force over a support and half-way between two.
    longest_wave : numpy.ndarray (bands,) [dB/m]
        Rate of the wave that lives longest, averaged over the band.
    """

    frequency: RealArray = field(repr=False)
    support: ComplexArray = field(repr=False)
    midspan: ComplexArray = field(repr=False)
    bands: Bands
    support_decay_rate: RealArray = field(repr=False)
    midspan_decay_rate: RealArray = field(repr=False)
    longest_wave: RealArray = field(repr=False)

    @property
    def support_mobility(self) -> ComplexArray:
        """Point mobility over a support (frequencies,) [m/(N s)]."""
        return 2j * np.pi * self.frequency * self.support

    @property
    def midspan_mobility(self) -> ComplexArray:
        """Point mobility half-way between supports (frequencies,) [m/(N s)]."""
        return 2j * np.pi * self.frequency * self.midspan

    def __str__(self) -> str:
        """Return the range of receptances and decay rates, with their units."""
        support, midspan = (span(np.abs(each), "m/N") for each in (self.support, self.midspan))
        rates = (span(each, "dB/m") for each in (self.support_decay_rate, self.midspan_decay_rate))
        return (
            f"{span(self.frequency, 'Hz')}: receptance {support} over a support, {midspan} between two; "
            f"decay rate {' and '.join(rates)}"
        )


def track_response(design: Track, frequency: ArrayLike = AXIS) -> TrackResponse:
    """Return point receptances and track decay rates of a track.

    Parameters
    ----------
    design : TrackDesign or TrackModel
        The track; its wheel plays no part.
    frequency : array_like (frequencies,)
        Frequencies of the receptances [Hz], greater than zero.

    Returns
    -------
    TrackResponse
        Curves, and decay rates per one-third-octave band from 25 Hz to 1 kHz.

    Raises
    ------
    ValueError
        If a frequency is not greater than zero.
    """
    model = track_model(design)
    frequency = np.atleast_1d(np.asarray(frequency, dtype=float))
    return TrackResponse(
        frequency=frequency,
        support=point_receptance(model, frequency, "support"),
        midspan=point_receptance(model, frequency, "midspan"),
        bands=BANDS,
        **_decay_rates(model),
    )


def point_receptance(
    design: Track, frequency: ArrayLike, place: str = "support", lattice: Lattice = FINE
) -> ComplexArray:
    """Return the rail displacement under a unit force.

    Parameters
    ----------
    design : TrackDesign or TrackModel
        The track.
    frequency : array_like (frequencies,)
        Frequencies [Hz], greater than zero.
    place : str
        Where: ``"support"`` or ``"midspan"``.
    lattice : Lattice
        What to solve: an infinite track, for ``"midspan"`` with an even number of elements a bay.

    Returns
    -------
    numpy.ndarray of complex (frequencies,)
        Point receptance [m/N].

    Raises
    ------
    ValueError
        If there is no such place on that lattice, or a frequency is not greater than zero.
    """
    loaded = _loaded(place, lattice)
    return rail_waves(design, frequency, lattice).receptance(np.array([loaded]), loaded)[0]


def summed_decay_rate(
    design: Track,
    frequency: ArrayLike,
    place: str = "support",
    points_per_bay: int = POINTS_PER_BAY,
    lattice: Lattice = FINE,
) -> RealArray:
    """Return the track decay rate by the sum of EN 15461, frequency by frequency.

    Parameters
    ----------
    design : TrackDesign or TrackModel
        The track.
    frequency : array_like (frequencies,)
        Frequencies [Hz], greater than zero.
    place : str
        Where the force acts: ``"support"`` or ``"midspan"``.
    points_per_bay : int
        Points along the rail per bay; a divisor of the elements per bay.
    lattice : Lattice
        What to solve: an infinite track, for ``"midspan"`` with an even number of elements a bay.

    Returns
    -------
    numpy.ndarray (frequencies,)
        Track decay rate [dB/m].

    Raises
    ------
    ValueError
        If there is no such place or point on that lattice, or a frequency is not greater than zero.
    """
    model = track_model(design)
    at_force, along = _squares(rail_waves(model, frequency, lattice), _loaded(place, lattice), points_per_bay)
    return NEPER / 2 * at_force / (along * model.design.fastener_spacing / points_per_bay)


def _loaded(place: str, lattice: Lattice) -> int:
    """Return the element at a place."""
    check_choice("place", place, PLACES)
    if place == "support":
        return 0
    if lattice.elements_per_bay % 2:
        raise ValueError(
            f"elements_per_bay = {lattice.elements_per_bay}: no element stands half-way between supports; "
            "give an even number"
        )
    return lattice.elements_per_bay // 2


def _squares(rail: RailWaves, loaded: int, points_per_bay: int) -> tuple[RealArray, RealArray]:
    """Return the squared receptance at the force, and summed over points to one side, half at the force."""
    if points_per_bay < 1 or rail.per_bay % points_per_bay:
        raise ValueError(f"points_per_bay = {points_per_bay!r}: give a divisor of {rail.per_bay}")
    step = rail.per_bay // points_per_bay
    at_force = np.abs(rail.receptance(np.array([loaded]), loaded)[0]) ** 2
    along = sum(
        (rail.energy_sum(loaded + point * step, loaded) for point in range(points_per_bay)),
        start=-0.5 * at_force,
    )
    return at_force, along


def _decay_rates(model: TrackModel) -> dict[str, RealArray]:
    """Return the decay rates per band [dB/m], by field of the response."""
    steps = (np.arange(PER_BAND) + 0.5) / PER_BAND
    within = BANDS.edges[:-1, None] * (BANDS.edges[1:] / BANDS.edges[:-1])[:, None] ** steps
    frequency = within.ravel()
    rail = rail_waves(model, frequency, FINE)
    # mobility squared is receptance squared times frequency squared; even steps of ln f weigh by f once more
    weight = frequency**3
    length = model.design.fastener_spacing / POINTS_PER_BAY
    rates = {}
    for place in PLACES:
        squares = _squares(rail, _loaded(place, FINE), POINTS_PER_BAY)
        at_force, along = ((weight * each).reshape(within.shape).sum(axis=1) for each in squares)
        rates[f"{place}_decay_rate"] = NEPER / 2 * at_force / (along * length)
    longest = track_decay_rate(model, frequency, FINE)
    return rates | {"longest_wave": longest.reshape(within.shape).mean(axis=1)}
