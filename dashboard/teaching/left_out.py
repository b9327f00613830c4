"""What the simplified model leaves out: the ladder of :mod:`trackig_core.analysis.ladder`, in words.

As :mod:`dashboard.teaching.explanations`: a function takes a design and choices, all hashable, returns a
frozen record, and is called off the event loop. dB, Hz.
"""

from dataclasses import dataclass

import numpy as np

import trackig_core as tig
from dashboard.formats import frequency_text

OPENING_VEHICLE, OPENING_GROUND = "regional", "rock"
"""What fills in what a design does not say of vehicle and ground, unless others are chosen."""

WHAT_IT_IS_NOT = (
    "What no rung holds: supports do not feel each other through the ground or a tunnel, nothing is said of "
    "the way from there to a receptor, no load moves along the track, and there is no floating slab, a "
    "continuous third stage under the supports."
)
"""Limits of the fullest model."""


@dataclass(frozen=True, eq=False)
class LeftOut:
    """The ladder of a design.

    Attributes
    ----------
    ladder : trackig_core.analysis.Ladder
        Its rungs.
    words : tuple of str
        What the simplified model costs, and what no rung holds.
    """

    ladder: tig.analysis.Ladder
    words: tuple[str, ...]


def left_out(design, vehicle, ground, summation):
    """Return what the simplified model leaves out of a design.

    Parameters
    ----------
    design : trackig_core.TrackDesign
        The design.
    vehicle, ground : str
        Keys of ``trackig_core.VEHICLES`` and ``trackig_core.GROUNDS``, for what the design does not say.
    summation : str
        As for ``trackig_core.insertion_gain``.

    Returns
    -------
    LeftOut
        Rungs and sentences.
    """
    ladder = tig.analysis.ladder(design, vehicle, ground, summation)
    words = (ladder.sentence, _about_above(ladder), REFERENCE_WORDS, WHAT_IT_IS_NOT)
    return LeftOut(ladder, words)


REFERENCE_WORDS = (
    "Every rung is measured against the very stiff track on the same ground and under the same vehicle. On "
    "soft ground that track isolates too, and leaves the less to gain: the last rung then says more about "
    "what the track is compared with than about the track."
)
"""What stands below each rung, and what follows for soft ground."""


def _about_above(ladder):
    """Return how far the paper's Figure 1 holds for this design, above its loaded track."""
    above = ladder.loaded_track < tig.BAND_CENTRES
    vehicle, everything = (np.abs(rung.difference[above]) for rung in ladder.rungs[-2:])
    labels = np.array(tig.BAND_LABELS)[above]
    return (
        f"Above the loaded track's {frequency_text(ladder.loaded_track)} the paper finds that all this "
        f"hardly matters. On this track vehicle and axles move a band there by up to {vehicle.max():.1f} dB, "
        f"at {labels[int(vehicle.argmax())]} Hz; with the ground as well it is {everything.max():.1f} dB, at "
        f"{labels[int(everything.argmax())]} Hz."
    )
