"""Which design to choose: how far each number may go, what matters, how sure it is, and which complies.

Everything here is solved exactly, many designs at once, and gives the same figures again for the same seed.
Each name is imported when it is first used: a study holds questions and answers, and to open one takes none.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
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

_PLACES = {
    "feasible": ("FeasibleRanges", "feasible_ranges"),
    "jobs": ("Grid", "Job", "Samples", "run_job"),
    "maps": ("DesignMap", "design_map"),
    "production": ("ToleranceResult", "tolerance"),
    "questions": ("Answer", "Question"),
    "requirements": ("Requirements",),
    "search": ("FoundDesigns", "find"),
    "sensitivities": ("Sensitivity", "SobolIndices", "sensitivity", "sobol"),
    "solving": ("How",),
    "tolerances": ("Normal", "Uniform"),
}
"""Names by the module that has them."""

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


def __getattr__(name: str) -> Any:
    """Return a name of one of the modules."""
    for module, names in _PLACES.items():
        if name in names:
            return getattr(import_module(f"{__name__}.{module}"), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    """Return the names that there are."""
    return __all__
