"""Insertion gain of railway track supports: one wheel, one rail, a row of pads, blocks and boots.

>>> import trackig_core as tig
>>> design = tig.PRESETS["booted-block-low-mass"].replace(boot_stiffness=20e6, rail="60E1")
>>> solution = tig.solve(design, "exact")
>>> solution.insertion_gain.shape  # one level per one-third-octave band, 5 Hz to 500 Hz [dB]
(21,)

``solution.plot()`` draws the insertion gain, ``solution.to_dataframe()`` gives it as a table. Analyses of a
design stand in ``tig.analysis``, choices between many designs in ``tig.decide``, studies in ``tig.study``,
levels and verdicts in ``tig.levels``.

The model of Thornely-Taylor, Bewes and Sica (2021), "A simplified model for calculating the insertion
gain of track support systems using the finite difference method". SI units throughout.
"""

import sys
from importlib import import_module
from importlib.metadata import version

from trackig_core import analysis, levels, results, study
from trackig_core.analysis import receptance, static_response, verify
from trackig_core.bands import BAND_CENTRES, BAND_EDGES, BAND_LABELS
from trackig_core.frequency_domain.batch import BatchSolution, solve_many
from trackig_core.levels import SourceSpectrum, Specification, insertion_gain
from trackig_core.results import InsertionGain, NaturalFrequencies, SolveCancelled
from trackig_core.solution import Solution
from trackig_core.solver import compile_kernels, solve
from trackig_core.study import PinnedDesign, Study, View
from trackig_core.time_domain.grid import RunTooLargeError
from trackig_core.track.catalogue import PRESETS
from trackig_core.track.design import TrackDesign
from trackig_core.track.fields import DesignError
from trackig_core.track.ground import GROUNDS, Ground
from trackig_core.track.measured_curves import LossFactorCurve, MeasurementError, StiffnessCurve
from trackig_core.track.rails import RAILS, Rail
from trackig_core.track.vehicle import VEHICLES, Suspension

__version__ = version("trackig")

__all__ = [
    "BAND_CENTRES",
    "BAND_EDGES",
    "BAND_LABELS",
    "GROUNDS",
    "PRESETS",
    "RAILS",
    "VEHICLES",
    "BatchSolution",
    "DesignError",
    "Ground",
    "InsertionGain",
    "LossFactorCurve",
    "MeasurementError",
    "NaturalFrequencies",
    "PinnedDesign",
    "Rail",
    "RunTooLargeError",
    "Solution",
    "SolveCancelled",
    "SourceSpectrum",
    "Specification",
    "StiffnessCurve",
    "Study",
    "Suspension",
    "TrackDesign",
    "View",
    "analysis",
    "compile_kernels",
    "insertion_gain",
    "levels",
    "receptance",
    "solve",
    "solve_many",
    "static_response",
    "study",
    "verify",
]

_PARTS = (analysis, levels, results, study)


def __getattr__(name: str) -> object:
    """Return a name of one of the parts, such as ``tig.film`` for ``tig.analysis.film``."""
    if name == "decide":  # what it imports takes a while, and to solve a design needs none of it
        return import_module("trackig_core.decide")
    for part in _PARTS:
        if name in part.__all__:
            return getattr(part, name)
    # with the module, Python says which name may have been meant
    raise AttributeError(
        f"module {__name__!r} has no attribute {name!r}", name=name, obj=sys.modules[__name__]
    )


def __dir__() -> list[str]:
    """Return what is offered to choose from: the door and, not yet loaded, ``decide``."""
    return sorted({*__all__, *(name for name in globals() if name.startswith("__")), "decide"})
