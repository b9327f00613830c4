"""Insertion gain of railway track supports: one wheel, one rail, a row of pads, blocks and boots.

The model of Thornely-Taylor, Bewes and Sica (2021), "A simplified model for calculating the insertion
gain of track support systems using the finite difference method". SI units throughout.

The one rule: what a user may rely on is named here; the modules below may change.
"""

from importlib.metadata import version

from trackig_core.asymptotes import Asymptote, MeasuredSlope, gain_asymptotes, measured_slopes
from trackig_core.band_table import BandTableError
from trackig_core.bands import BAND_CENTRES, BAND_EDGES, BAND_LABELS
from trackig_core.catalogue import PRESETS, RAILS
from trackig_core.convergence import element_errors, time_step_errors
from trackig_core.damping import (
    LOSS_FACTORS,
    DampingCurve,
    damping_curves,
    gain_by_loss_factor,
    with_loss_factor,
)
from trackig_core.design import DesignError, Rail, TrackDesign
from trackig_core.gain import insertion_gain
from trackig_core.grid import RunTooLargeError
from trackig_core.harmonic import Lattice, receptance, track_decay_rate
from trackig_core.lumped import (
    GOOD_ENOUGH,
    LumpedComparison,
    LumpedFrequencies,
    compare_with_beam,
    effective_supports,
    lumped_frequencies,
    lumped_insertion_gain,
    lumped_spectrum,
)
from trackig_core.measured import LossFactorCurve, MeasurementError, StiffnessCurve
from trackig_core.modes import cut_on
from trackig_core.motion import Motion, film
from trackig_core.peer import PeerReceptance, peer_receptances
from trackig_core.results import (
    ForceSpectrum,
    InsertionGain,
    NaturalFrequencies,
    Solution,
    TimeHistory,
)
from trackig_core.shapes import SteadyShape, steady_shape
from trackig_core.simulate import SolveCancelled
from trackig_core.solver import compile_kernels, solve
from trackig_core.source import (
    A_WEIGHTING,
    LevelDifference,
    SourceError,
    SourceSpectrum,
    TrackLevel,
    a_weighting,
)
from trackig_core.specification import Specification, SpecificationError, Verdict
from trackig_core.stiff_reference import StiffReferences, stiff_references
from trackig_core.study import PinnedDesign, Study, StudyError, View
from trackig_core.sweep import Departure, FrequencySweep, departure, frequency_sweep
from trackig_core.verification import Verification, verify

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
    "steady_shape",
    "stiff_references",
    "time_step_errors",
    "track_decay_rate",
    "verify",
    "with_loss_factor",
]
