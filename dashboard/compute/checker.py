"""Holds the picture against theory while somebody looks at the checks, off the event loop.

The one rule: nothing is checked that nobody looks at, and only the newest picture is.
"""

import asyncio
from functools import lru_cache

import trackig_core as tig
from dashboard.compute.latest import Latest, publish, readable
from dashboard.compute.workers import workers
from dashboard.session.results import VerifiedSummary

CAPACITY = 64
"""Checked pictures kept; one holds some 0.2 MB."""


@lru_cache(maxsize=CAPACITY)
def check(summary):
    """Return a picture with what theory says of it.

    Parameters
    ----------
    summary : SolutionSummary
        What is checked.

    Returns
    -------
    Checked
        The exact answers, or why there are none.
    """
    try:
        return VerifiedSummary(summary, tig.verify(summary.solution))
    except Exception as error:
        return VerifiedSummary(summary, None, readable(error))


class VerificationRunner:
    """Watches an outcome and keeps its checks up to date while they are looked at.

    Parameters
    ----------
    outcome : Outcome
        What is watched and kept up to date.
    """

    def __init__(self, outcome):
        self._outcome = outcome
        outcome.param.watch(Latest(self._check).ask, ["summary", "verifying"])

    async def _check(self, document):
        summary = self._outcome.summary
        if self._outcome.verifying and summary is not None:
            verified = await asyncio.get_running_loop().run_in_executor(workers(), check, summary)
            publish(self._outcome, document, verified=verified)
