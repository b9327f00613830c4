"""Which design to choose: how far each number may go, what matters, how sure it is, and which complies.

Everything here is solved exactly, many designs at once, and gives the same figures again for the same seed.
"""

from trackig_core.decide.feasible import FeasibleRanges, feasible_ranges
from trackig_core.decide.jobs import Grid, Job, Samples, run_job
from trackig_core.decide.maps import DesignMap, design_map
from trackig_core.decide.production import ToleranceResult, tolerance
from trackig_core.decide.questions import Answer, Question
from trackig_core.decide.requirements import Requirements
from trackig_core.decide.search import FoundDesigns, find
from trackig_core.decide.sensitivities import Sensitivity, SobolIndices, sensitivity, sobol
from trackig_core.decide.solving import How
from trackig_core.decide.tolerances import Normal, Uniform

__all__ = [
    "Answer",
    "DesignMap",
    "FeasibleRanges",
    "FoundDesigns",
    "Grid",
    "How",
    "Job",
    "Normal",
    "Question",
    "Requirements",
    "Samples",
    "Sensitivity",
    "SobolIndices",
    "ToleranceResult",
    "Uniform",
    "design_map",
    "feasible_ranges",
    "find",
    "run_job",
    "sensitivity",
    "sobol",
    "tolerance",
]
