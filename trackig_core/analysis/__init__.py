"""What is computed of a design or a solution beside its gain: causes, errors, shapes, comparisons."""

from trackig_core.analysis.asymptotes import Asymptote, MeasuredSlope, gain_asymptotes, measured_slopes
from trackig_core.analysis.curve_fit import CurveFit, curve_fit
from trackig_core.analysis.damping import (
    LOSS_FACTORS,
    DampingCurve,
    damping_curves,
    gain_by_loss_factor,
    with_loss_factor,
)
from trackig_core.analysis.frequency_sweep import Departure, FrequencySweep, departure, frequency_sweep
from trackig_core.analysis.ladder import Ladder, Rung, ladder
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
from trackig_core.analysis.single_degree import single_degree_gain, single_degree_insertion_loss
from trackig_core.analysis.statics import (
    StaticResponse,
    limited_deflection,
    static_response,
    zimmermann_deflection,
)
from trackig_core.analysis.stiff_reference import StiffReferences, stiff_references
from trackig_core.analysis.track_response import (
    TrackResponse,
    point_receptance,
    summed_decay_rate,
    track_response,
)
from trackig_core.analysis.verification import Verification, verify
from trackig_core.frequency_domain.convergence import element_errors, time_step_errors
from trackig_core.frequency_domain.floquet_waves import receptance, track_decay_rate
from trackig_core.frequency_domain.lattice import Lattice
from trackig_core.frequency_domain.natural_frequencies import cut_on
from trackig_core.frequency_domain.operating_shapes import SteadyShape, steady_shape
from trackig_core.frequency_domain.track_model import track_model

__all__ = [
    "GOOD_ENOUGH",
    "LOSS_FACTORS",
    "Asymptote",
    "CurveFit",
    "DampingCurve",
    "Departure",
    "FrequencySweep",
    "Ladder",
    "Lattice",
    "LumpedComparison",
    "LumpedFrequencies",
    "MeasuredSlope",
    "Motion",
    "PeerReceptance",
    "Rung",
    "StaticResponse",
    "SteadyShape",
    "StiffReferences",
    "TrackResponse",
    "Verification",
    "compare_with_beam",
    "curve_fit",
    "cut_on",
    "damping_curves",
    "departure",
    "effective_supports",
    "element_errors",
    "film",
    "frequency_sweep",
    "gain_asymptotes",
    "gain_by_loss_factor",
    "ladder",
    "limited_deflection",
    "lumped_frequencies",
    "lumped_insertion_gain",
    "lumped_spectrum",
    "measured_slopes",
    "peer_receptances",
    "point_receptance",
    "receptance",
    "single_degree_gain",
    "single_degree_insertion_loss",
    "static_response",
    "steady_shape",
    "stiff_references",
    "summed_decay_rate",
    "time_step_errors",
    "track_decay_rate",
    "track_model",
    "track_response",
    "verify",
    "with_loss_factor",
    "zimmermann_deflection",
]
