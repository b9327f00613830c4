"""Which numbers of a design a question may be about: its fields, and by path those of suspension and ground.

A speed counts where several axles follow each other.
"""

from trackig_core.track.design import TrackDesign
from trackig_core.track.fields import RANGES, SCATTERED, SEARCHED_RANGES

_DECADES = ("N/m", "N s/m")


def single_numbers(design: TrackDesign) -> tuple[str, ...]:
    """Return what is a single number of a design (names): not absent, and not measured over frequency."""
    return tuple(
        name for name in SEARCHED_RANGES if isinstance(design.value(name), float) and _counts(design, name)
    )


def changeable_numbers(design: TrackDesign) -> tuple[str, ...]:
    """Return what a share of itself changes (names): numbers and measured curves, but neither None nor 0."""
    return tuple(name for name in SCATTERED if design.value(name) and _counts(design, name))


def is_logarithmic(field: str) -> bool:
    """Return whether a field spans decades, as stiffnesses and dashpots do."""
    return RANGES[field][2] in _DECADES


def _counts(design: TrackDesign, name: str) -> bool:
    return name != "speed" or len(design.axle_positions) > 1
