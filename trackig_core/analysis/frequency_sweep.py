"""Where the resonances come from: natural frequencies against one varied field, lumped model beside beam.

SI units and Hz. The lumped model is that of :mod:`trackig_core.analysis.lumped`, the beam's frequencies are
those of :mod:`trackig_core.frequency_domain.natural_frequencies`. Where the two depart, :func:`departure`
says why, from the design's numbers and never from its name.

Against the block's frequency with the rail held, the lumped model's upper one departs for two reasons and no
other: its rail is held by the contact spring alone (lower), and the wheel that holds that spring recoils
(higher). Against the loaded track, the lumped model's lower one departs because its rail has no mass
(higher), because its blocks all move as much as the one under the wheel (lower), and because it has no
waves: a wheel has no mode of its own above the frequency at which they begin to run.
"""

import dataclasses
import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from trackig_core.analysis.lumped import effective_supports, lumped_frequencies
from trackig_core.arrays import RealArray
from trackig_core.frequency_domain import natural_frequencies as modes
from trackig_core.frequency_domain.track_model import Track, TrackModel, track_model
from trackig_core.track.fields import DESIGN_FIELDS, RANGES, DesignError
from trackig_core.words import span

_STATED = ("pad_static_stiffness", "boot_static_stiffness", "stiffness_frequency")
"""Numbers that say how a stiffness was measured, and are none of the track's own."""

FIELDS = tuple(each.name for each in DESIGN_FIELDS if each.name not in _STATED)
"""Fields of a design that can be varied: all numbers of the track itself."""

NOTABLE = 0.05
"""Relative difference of frequencies below which lumped model and beam are said to agree [-]."""

_MOVING_RAIL = 0.75
"""Part of the rail on n supports that moves with the wheel [-]: integral of phi^2 over that of phi."""


@dataclass(frozen=True, eq=False)
class FrequencySweep:
    """Natural frequencies against one field of a design.

    Attributes
    ----------
    field : str
        The field that is varied.
    values : numpy.ndarray (values,) [unit of the field]
        Its values.
    loaded_track, coupled_block, cut_on : numpy.ndarray (values,) [Hz]
        Of the beam model: the wheel's bound mode, the block with the rail held (NaN when single-stage), and
        where all bays move as one: no bound mode lies above it.
    lumped_coupled, lumped_uncoupled : numpy.ndarray (frequencies, values) [Hz]
        Of the lumped model: two rows, or one when single-stage. ``lumped_uncoupled`` is of the wheel with the
        block held still, and of the block on its boot.
    """

    field: str
    values: RealArray = dataclasses.field(repr=False)
    loaded_track: RealArray = dataclasses.field(repr=False)
    coupled_block: RealArray = dataclasses.field(repr=False)
    cut_on: RealArray = dataclasses.field(repr=False)
    lumped_coupled: RealArray = dataclasses.field(repr=False)
    lumped_uncoupled: RealArray = dataclasses.field(repr=False)

    def __str__(self) -> str:
        """Return the natural frequencies over the values of the field, with their units."""
        block = (
            "" if np.isnan(self.coupled_block).all() else f", coupled block {span(self.coupled_block, 'Hz')}"
        )
        over = f"{self.field} {span(self.values, RANGES[self.field][2])}"
        return f"over {over}: loaded track {span(self.loaded_track, 'Hz')}{block}"


@dataclass(frozen=True)
class Departure:
    """How far the lumped model's frequencies are from the beam's, and why.

    Attributes
    ----------
    loaded_track : float
        The lumped model's lower frequency over the beam's loaded-track frequency [-].
    coupled_block : float or None
        The lumped model's upper frequency over that of the block with the rail held [-]; None when
        single-stage.
    reasons : tuple of str
        One sentence for each that departs by more than :data:`NOTABLE`.
    """

    loaded_track: float
    coupled_block: float | None
    reasons: tuple[str, ...]

    def __str__(self) -> str:
        """Return the lumped model's frequencies over the beam's, in per cent, and why."""
        block = "" if self.coupled_block is None else f", coupled block {100 * self.coupled_block:.0f} %"
        said = f"the lumped model's loaded track is at {100 * self.loaded_track:.0f} % of the beam's{block}"
        return " ".join([f"{said}.", *self.reasons])


def frequency_sweep(design: Track, field: str, values: ArrayLike) -> FrequencySweep:
    """Return natural frequencies of a design as one of its fields takes other values.

    Parameters
    ----------
    design : TrackDesign or TrackModel
        The track.
    field : str
        One of :data:`FIELDS`.
    values : array_like (values,)
        Values of the field [its unit].

    Returns
    -------
    FrequencySweep
        Frequencies, in some 20 ms for 60 values; a loss factor takes 7 ms a value for the fit of its law.

    Raises
    ------
    DesignError
        If there is no such field, or a value is not allowed.
    """
    if field not in FIELDS:
        raise DesignError("field", field, f"one of {', '.join(FIELDS)}")
    values = np.atleast_1d(np.asarray(values, dtype=float))
    track = track_model(design).design
    rows = [_frequencies(track.replace(**{field: value})) for value in values]
    beam, coupled, uncoupled = (np.array(column).T for column in zip(*rows, strict=True))
    loaded, block, waves_begin = beam
    return FrequencySweep(field, values, loaded, block, waves_begin, coupled, uncoupled)


def _frequencies(design: Track) -> tuple[tuple[float, ...], tuple[float, ...], tuple[float, ...]]:
    model = track_model(design)
    lumped = lumped_frequencies(model)
    beam = modes.loaded_track(model), modes.coupled_block(model) or math.nan, modes.cut_on(model)[0]
    return beam, lumped.coupled, lumped.uncoupled


def departure(design: Track) -> Departure:
    """Return how far the lumped model's frequencies are from the beam's, and why.

    Parameters
    ----------
    design : TrackDesign or TrackModel
        The track.

    Returns
    -------
    Departure
        Ratios, and sentences made from the design's numbers.
    """
    model = track_model(design)
    lumped = lumped_frequencies(model).coupled
    loaded, block = modes.loaded_track(model), modes.coupled_block(model)
    reasons = []
    if abs(lumped[0] / loaded - 1) > NOTABLE:
        reasons.append(_why_loaded_track(model, lumped[0], loaded))
    if block is None:
        return Departure(lumped[0] / loaded, None, tuple(reasons))
    if abs(lumped[1] / block - 1) > NOTABLE:
        reasons.append(_why_coupled_block(model, lumped[1], block))
    return Departure(lumped[0] / loaded, lumped[1] / block, tuple(reasons))


def _why_loaded_track(model: TrackModel, lumped: float, beam: float) -> str:
    """Return why the lumped model's lower frequency is not the beam's loaded-track frequency [Hz]."""
    design, begin, supports = model.design, modes.cut_on(model)[0], effective_supports(model)
    says = f"The lumped model puts the loaded track at {lumped:.0f} Hz, the beam at {beam:.0f} Hz: "
    if lumped > begin * (1 - NOTABLE):
        return (
            f"{says}waves begin to run along the track at {begin:.0f} Hz, and no wheel, however light, has "
            "a mode of its own above that. The lumped model has no waves."
        )
    if lumped > beam:
        rail = _MOVING_RAIL * supports * design.fastener_spacing * design.rail.mass_per_metre
        return (
            f"{says}the lumped model's rail has no mass, but some {rail:.0f} kg of rail move with the wheel, "
            f"{rail / design.wheel_mass:.0%} of its mass."
        )
    if design.two_stage:
        return (
            f"{says}the lumped model lets {supports:.1f} blocks of {design.block_mass:.0f} kg move as "
            "much as the one under the wheel. In the beam those farther out move less, and weigh less on the "
            "wheel."
        )
    return (
        f"{says}the rail spreads the load over {supports:.1f} supports only, too few to pass for "
        "the even foundation of the lumped model."
    )


def _why_coupled_block(model: TrackModel, lumped: float, beam: float) -> str:
    """Return why the lumped model's upper frequency is not that of the block with the rail held [Hz]."""
    supports, design, block_mass = effective_supports(model), model.design, model.design.block_mass or 0.0
    says = f"The lumped model puts the block at {lumped:.0f} Hz, with the rail held it is at {beam:.0f} Hz: "
    if lumped < beam:
        pads = supports * model.pad.stiffness(beam) / design.contact_stiffness
        return (
            f"{says}the lumped model's rail is held by the contact spring alone, and the pads under it are "
            f"{pads:.0%} as stiff as that spring, so that it gives way."
        )
    blocks = supports * block_mass / design.wheel_mass
    return (
        f"{says}the blocks that move weigh {blocks:.0%} of the wheel, which recoils and so does not hold "
        "the rail. The beam's figure is that of a block under a rail that does not move."
    )
