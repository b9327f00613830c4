"""Compares the solution with theory while somebody looks at the checks, off the event loop.

Nothing is checked that nobody looks at, and only the newest solution is.
"""

import asyncio
from functools import lru_cache

import param

import trackig_core as tig
from dashboard.compute.latest import Latest, publish, readable
from dashboard.compute.workers import workers
from dashboard.session.results import VerifiedSummary

CAPACITY = 64
"""Checked solutions kept; one holds some 0.2 MB."""


def check(summary):
    """Return a solution with what theory says of it.

    Parameters
    ----------
    summary : SolutionSummary
        What is checked.

    Returns
    -------
    VerifiedSummary
        The frequency-domain solution, or why there are none.
    """
    return VerifiedSummary(summary, *_theory(summary.solution))


@lru_cache(maxsize=CAPACITY)
def _theory(solution):
    """Return what theory says of a solution, or None and why there is nothing."""
    try:
        return tig.verify(solution), ""
    except Exception as error:
        return None, readable(error)


class VerificationRunner(param.Parameterized):
    """Watches an outcome and keeps its checks up to date while they are looked at.

    Parameters
    ----------
    outcome : Outcome
        What is watched and kept up to date.
    """

    looked_at = param.Boolean(default=False, doc="Whether anybody looks at the checks.")

    def __init__(self, outcome):
        super().__init__()
        self._outcome = outcome
        latest = Latest(self._check)
        outcome.param.watch(latest.ask, "summary")
        self.param.watch(latest.ask, "looked_at")

    def look(self, looked_at):
        """Note whether anybody looks; if so, check what there is."""
        self.looked_at = looked_at

    async def _check(self, document):
        summary = self._outcome.summary
        # an exact curve has no run to be checked; its run follows
        if self.looked_at and summary is not None and summary.time is not None:
            verified = await asyncio.get_running_loop().run_in_executor(workers(), check, summary)
            publish(self._outcome, document, verified=verified)
