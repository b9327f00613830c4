"""From a spectrum to insertion gain, and from insertion gain to levels and verdicts."""

from trackig_core.levels.band_tables import BandTableError
from trackig_core.levels.insertion_gain import insertion_gain
from trackig_core.levels.measured_gain import MeasuredGain, MeasuredGainError
from trackig_core.levels.source import (
    A_WEIGHTING,
    LevelDifference,
    SourceError,
    SourceSpectrum,
    TrackLevel,
    a_weighting,
)
from trackig_core.levels.specification import Specification, SpecificationError, Verdict

__all__ = [
    "A_WEIGHTING",
    "BandTableError",
    "LevelDifference",
    "MeasuredGain",
    "MeasuredGainError",
    "SourceError",
    "SourceSpectrum",
    "Specification",
    "SpecificationError",
    "TrackLevel",
    "Verdict",
    "a_weighting",
    "insertion_gain",
]
