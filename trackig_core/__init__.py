"""Insertion gain of railway track supports: one wheel, one rail, a row of pads, blocks and boots.

The model of Thornely-Taylor, Bewes and Sica (2021), "A simplified model for calculating the insertion
gain of track support systems using the finite difference method". SI units throughout.

The one rule: what a user may rely on is named here; the modules below may change.
"""

from importlib.metadata import version

from trackig_core.analysis.asymptotes import Asymptote, MeasuredSlope, gain_asymptotes, measured_slopes
from trackig_core.analysis.damping import (
    LOSS_FACTORS,
    DampingCurve,
    damping_curves,
    gain_by_loss_factor,
    with_loss_factor,
)
from trackig_core.analysis.frequency_sweep import Departure, FrequencySweep, departure, frequency_sweep
from trackig_core.analysis.lumped import (
    GOOD_ENOUGH,
    LumpedComparison,
    LumpedFrequencies,
    compare_with_beam,
    effective_supports,
    lumped_frequencies,
    lumped_insertion_gain,
    lumped_spectrum,
)
from trackig_core.analysis.motion import Motion, film
from trackig_core.analysis.rolland import PeerReceptance, peer_receptances
from trackig_core.analysis.stiff_reference import StiffReferences, stiff_references
from trackig_core.analysis.verification import Verification, verify
from trackig_core.bands import BAND_CENTRES, BAND_EDGES, BAND_LABELS
from trackig_core.frequency_domain.batch import BatchSolution, solve_many
from trackig_core.frequency_domain.convergence import element_errors, time_step_errors
from trackig_core.frequency_domain.floquet_waves import Lattice, receptance, track_decay_rate
from trackig_core.frequency_domain.natural_frequencies import cut_on
from trackig_core.frequency_domain.operating_shapes import SteadyShape, steady_shape
from trackig_core.levels.band_tables import BandTableError
from trackig_core.levels.insertion_gain import insertion_gain
from trackig_core.levels.source import (
    A_WEIGHTING,
    LevelDifference,
    SourceError,
    SourceSpectrum,
    TrackLevel,
    a_weighting,
)
from trackig_core.levels.specification import Specification, SpecificationError, Verdict
from trackig_core.results import (
    ForceSpectrum,
    InsertionGain,
    NaturalFrequencies,
    Solution,
    SolveCancelled,
    TimeHistory,
)
from trackig_core.solver import compile_kernels, solve
from trackig_core.study.studies import PinnedDesign, Study, StudyError, View
from trackig_core.time_domain.grid import RunTooLargeError
from trackig_core.track.catalogue import PRESETS, RAILS
from trackig_core.track.design import DesignError, Rail, TrackDesign
from trackig_core.track.measured_curves import LossFactorCurve, MeasurementError, StiffnessCurve

__version__ = version("trackig")

__all__ = [
    "A_WEIGHTING",
    "BAND_CENTRES",
    "BAND_EDGES",
    "BAND_LABELS",
    "GOOD_ENOUGH",
    "LOSS_FACTORS",
    "PRESETS",
    "RAILS",
    "Asymptote",
    "BandTableError",
    "BatchSolution",
    "DampingCurve",
    "Departure",
    "DesignError",
    "ForceSpectrum",
    "FrequencySweep",
    "InsertionGain",
    "Lattice",
    "LevelDifference",
    "LossFactorCurve",
    "LumpedComparison",
    "LumpedFrequencies",
    "MeasuredSlope",
    "MeasurementError",
    "Motion",
    "NaturalFrequencies",
    "PeerReceptance",
    "PinnedDesign",
    "Rail",
    "RunTooLargeError",
    "Solution",
    "SolveCancelled",
    "SourceError",
    "SourceSpectrum",
    "Specification",
    "SpecificationError",
    "SteadyShape",
    "StiffReferences",
    "StiffnessCurve",
    "Study",
    "StudyError",
    "TimeHistory",
    "TrackDesign",
    "TrackLevel",
    "Verdict",
    "Verification",
    "View",
    "a_weighting",
    "compare_with_beam",
    "compile_kernels",
    "cut_on",
    "damping_curves",
    "departure",
    "effective_supports",
    "element_errors",
    "film",
    "frequency_sweep",
    "gain_asymptotes",
    "gain_by_loss_factor",
    "insertion_gain",
    "lumped_frequencies",
    "lumped_insertion_gain",
    "lumped_spectrum",
    "measured_slopes",
    "peer_receptances",
    "receptance",
    "solve",
    "solve_many",
    "steady_shape",
    "stiff_references",
    "time_step_errors",
    "track_decay_rate",
    "verify",
    "with_loss_factor",
]
