"""Answers questions about many designs off the event loop: with progress, what is found so far, and a stop.

A question that takes seconds is answered in one thread that all sessions share, so that it slows nobody's
picture; one that takes milliseconds in those that solve pictures at rest. The newest question of a session
ends the one before it.
"""

import asyncio
import contextlib
import functools
import threading
from concurrent.futures import ThreadPoolExecutor

import param

import trackig_core as tig
from dashboard.compute.latest import Latest, publish, readable
from dashboard.compute.workers import workers

LOOK_EVERY = 0.2
"""Seconds between looks at a question under way."""

QUICK = ("range", "sensitivity")
"""Kinds of question that take milliseconds."""

REST = 0.06
"""Seconds without a newer question after which one that takes milliseconds is answered: while a slider moves,
nothing but its picture is computed."""

WAITING = "Waiting for a question of another session …"


class Inquiry(param.Parameterized):
    """What is asked, how far it is, and what came of it."""

    asked = param.Parameter(default=None, doc="A trackig_core.decide.Question, or None.")
    answered = param.Parameter(default=None, doc="The question that was last answered.")
    result = param.Parameter(default=None, doc="What it returned.")
    so_far = param.Parameter(default=None, doc="What a search has found until now.")
    busy = param.Boolean(default=False, doc="Whether an answer is awaited.")
    progress = param.Number(
        default=None, allow_None=True, doc="Part of the work that is done; None: waiting."
    )
    problem = param.String(default="", doc="Why there is no answer; else empty.")


@functools.cache
def questioners():
    """Return the thread that all sessions share for questions that take seconds."""
    return ThreadPoolExecutor(max_workers=1, thread_name_prefix="question")


class InquiryRunner:
    """Watches an inquiry and answers its newest question.

    Parameters
    ----------
    inquiry : Inquiry
        What is watched and answered.
    """

    def __init__(self, inquiry):
        self._inquiry = inquiry
        self._latest = Latest(self._answer)
        self._work = None
        inquiry.param.watch(self._latest.ask, "asked")

    def stop(self, *_):
        """End the work under way; a search keeps what it has found."""
        if self._work is not None:
            self._work.stopped.set()

    async def _answer(self, document):
        inquiry, question = self._inquiry, self._inquiry.asked
        if question is None or question == inquiry.answered:
            return
        if question.kind in QUICK and await self._latest.news_within(REST):
            return
        self._work = work = _Work(question)
        publish(inquiry, document, busy=True, progress=None, so_far=None, problem="")
        pool = workers() if question.kind in QUICK else questioners()
        future = asyncio.get_running_loop().run_in_executor(pool, work.do)
        try:
            await self._follow(future, work, document)
            result = future.result()
        except tig.SolveCancelled:
            publish(inquiry, document, busy=False, progress=None)
        except ValueError as error:
            publish(inquiry, document, busy=False, progress=None, problem=f"Not answered: {error}.")
        except Exception as error:
            publish(inquiry, document, busy=False, progress=None, problem=readable(error))
        else:
            if not self._latest.pending:
                done = {"busy": False, "progress": None, "so_far": None, "problem": ""}
                publish(inquiry, document, answered=question, result=result, **done)

    async def _follow(self, future, work, document):
        """Wait until a question is answered, and tell how far it is; a newer one ends it."""
        while not future.done():
            await self._latest.done_or_news(future, LOOK_EVERY)
            if self._latest.pending:
                work.stopped.set()
            elif not future.done() and work.fraction is not None:
                publish(self._inquiry, document, progress=work.fraction, so_far=work.found)


class _Work:
    """One question on its way, shared by the thread that answers it and the loop that looks."""

    def __init__(self, question):
        self.question = question
        self.stopped = threading.Event()
        self.fraction = None
        self.found = None

    def do(self):
        """Return the answer."""
        if self.stopped.is_set():
            raise tig.SolveCancelled("nobody waits for the answer any more")
        self.fraction = 0.0
        how = {"progress": self._note, "cancelled": self.stopped.is_set, "threads": 1}
        if self.question.kind == "find":
            how["so_far"] = self._keep
        return self.question.ask(**how)

    def _note(self, fraction):
        self.fraction = fraction

    def _keep(self, found):
        self.found = found


def question_of(kind, settings, assessment, definition, design=None):
    """Return a question about a design by the definition and requirements in force.

    Parameters
    ----------
    kind : str
        A key of ``trackig_core.decide.questions.KINDS``.
    settings : dict
        Its settings [SI units].
    assessment : Assessment
        Current design, specification and source.
    definition : GainDefinition
        Which insertion gain is meant.
    design : trackig_core.TrackDesign, optional
        The design; by default the current one as it was last solved.

    Returns
    -------
    trackig_core.decide.Question or None
        The question; None as long as it cannot be asked, for want of a specification in force or of a first
        solution.
    """
    design = assessment.current.design if design is None else design
    with contextlib.suppress(ValueError):
        return tig.decide.Question(
            kind,
            design,
            settings,
            specification=assessment.in_force,
            source=assessment.source,
            reference=definition.reference_of(design),
            summation=definition.summation,
        )
    return None
