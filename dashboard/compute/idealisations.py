"""The frequency-domain solution on other assumptions, computed off the event loop while somebody looks."""

import asyncio
from dataclasses import dataclass
from functools import lru_cache, partial

import numpy as np
import param

import trackig_core as tig
from dashboard.compute.document import on_next_tick, one_message
from dashboard.compute.latest import Latest
from dashboard.compute.workers import workers
from trackig_core.bands import Bands, chosen_bands

CAPACITY = 64
"""Designs kept; one holds some 10 kB."""

CURVE_POINTS = 300
"""Points of the curve of the single-degree formula [-]."""

OTHERWISE = {"hysteretic": {"damping": "hysteretic"}, "timoshenko": {"rail": "timoshenko"}}
"""What is assumed otherwise, as arguments of ``trackig_core.solve``, by name."""


@dataclass(frozen=True, eq=False)
class Idealised:
    """Insertion gain of one design on several assumptions.

    Attributes
    ----------
    bands : trackig_core.bands.Bands
        Bands of the levels.
    levels : numpy.ndarray (bands,) [dB]
        The frequency-domain solution as everywhere else.
    otherwise : dict of str to numpy.ndarray (bands,) [dB]
        Levels on each of :data:`OTHERWISE`; one that the design does not allow is missing.
    frequency : numpy.ndarray (frequencies,) [Hz]
        Frequencies of the single-degree formula.
    single_degree : numpy.ndarray (frequencies,) [dB]
        The formula behind DIN 45673-4, with hysteretic damping where the design allows it.
    notes : tuple of str
        What is to be said of the bands.
    """

    bands: Bands
    levels: np.ndarray
    otherwise: dict
    frequency: np.ndarray
    single_degree: np.ndarray
    notes: tuple[str, ...]


@lru_cache(maxsize=CAPACITY)
def idealised(design, bands, reference, summation):
    """Return insertion gain of a design on several assumptions, computed once (Idealised).

    Parameters
    ----------
    design : trackig_core.TrackDesign
        The design.
    bands : str
        A key of ``trackig_core.bands.BANDS``.
    reference, summation : str
        Which insertion gain is meant.
    """
    solve = partial(tig.solve, design, "exact", reference=reference, summation=summation, bands=bands)
    usual, otherwise, model = solve(), {}, design
    for name, choice in OTHERWISE.items():
        try:
            otherwise[name] = solve(**choice).insertion_gain
        except tig.DesignError:  # a measured stiffness is no hysteretic one
            continue
    if "hysteretic" in otherwise:
        model = tig.analysis.track_model(design, "hysteretic")
    edges = chosen_bands(bands).edges
    frequency = np.geomspace(edges[0], edges[-1], CURVE_POINTS)
    single_degree = tig.analysis.single_degree_gain(model, frequency)
    return Idealised(
        chosen_bands(bands), usual.insertion_gain, otherwise, frequency, single_degree, usual.notes
    )


class Idealisations(param.Parameterized):
    """Keeps the idealisations of the current design up to date while they are looked at.

    Parameters
    ----------
    outcome : Outcome
        Whose design is meant.
    definition : GainDefinition
        Which insertion gain is meant.
    """

    looked_at = param.Boolean(default=False, doc="Whether anybody looks at them.")
    found = param.ClassSelector(class_=Idealised, default=None, allow_None=True, doc="What was found last.")

    def __init__(self, outcome, definition):
        super().__init__()
        self._outcome, self._definition = outcome, definition
        latest = Latest(self._find)
        outcome.param.watch(latest.ask, "summary")
        definition.param.watch(latest.ask, ["reference", "summation", "bands"])
        self.param.watch(latest.ask, "looked_at")

    async def _find(self, document):
        summary, definition = self._outcome.summary, self._definition
        if not self.looked_at or summary is None:
            return
        design = summary.solution.design
        reference = definition.reference_of(design)
        asked = (design, definition.bands, reference, definition.summation)
        found = await asyncio.get_running_loop().run_in_executor(workers(), idealised, *asked)
        if found is not self.found:
            on_next_tick(document, partial(self._put, found))

    def _put(self, found, document):
        with one_message(document):
            self.found = found
