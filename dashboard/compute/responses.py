"""Track responses of the designs that are shown, computed off the event loop while somebody looks."""

import asyncio
from functools import lru_cache, partial
from types import MappingProxyType

import param

import trackig_core as tig
from dashboard.compute.document import on_next_tick, one_message
from dashboard.compute.latest import Latest
from dashboard.compute.workers import workers

CAPACITY = 64
"""Responses kept; one holds some 40 kB."""


@lru_cache(maxsize=CAPACITY)
def respond(design):
    """Return the response of a design (trackig_core.analysis.TrackResponse), computed once."""
    return tig.analysis.track_response(design)


class TrackResponses(param.Parameterized):
    """Keeps the responses of all shown designs up to date while they are looked at.

    Parameters
    ----------
    assessment : Assessment
        Whose shown designs are meant.
    """

    looked_at = param.Boolean(default=False, doc="Whether anybody looks at them.")
    responses = param.Parameter(
        default=MappingProxyType({}), doc="Response of each design that was shown last, by design."
    )

    def __init__(self, assessment):
        super().__init__()
        self._assessment = assessment
        latest = Latest(self._respond)
        assessment.param.watch(latest.ask, "results")
        self.param.watch(latest.ask, "looked_at")

    def look(self, looked_at):
        """Note whether anybody looks; if so, compute what is missing."""
        self.looked_at = looked_at

    async def _respond(self, document):
        if not self.looked_at:
            return
        loop, found = asyncio.get_running_loop(), {}
        for design in [each.design for each in self._assessment.shown]:
            found[design] = await loop.run_in_executor(workers(), respond, design.without_statics)
        if found.keys() != self.responses.keys():
            on_next_tick(document, partial(self._put, found))

    def _put(self, found, document):
        with one_message(document):
            self.responses = MappingProxyType(found)
