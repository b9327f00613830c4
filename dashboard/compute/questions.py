"""Works out what a subject of teaching shows while somebody looks at it, off the event loop.

A subject asks a :class:`Question`: a function of :mod:`dashboard.teaching.explanations` with its arguments.
The newest question is answered in the threads that all sessions share, and answers are kept, since students
ask alike.

Nothing is worked out that nobody looks at, and only the newest question is.
"""

import asyncio
from functools import lru_cache

import param

from dashboard.compute.latest import Latest, publish, readable
from dashboard.compute.workers import workers

CAPACITY = 128
"""Answers kept; a film, the largest, has some 0.3 MB."""


class Question(param.Parameterized):
    """What one subject wants to know, and what came of it."""

    asked = param.Parameter(default=None, doc="A function and its arguments, all hashable.")
    looked_at = param.Boolean(default=False, doc="Whether anybody looks at the subject.")
    answered = param.Parameter(default=None, doc="The question that was last answered.")
    answer = param.Parameter(default=None, doc="What the function returned; None if it could not.")
    problem = param.String(default="", doc="Why there is no answer; else empty.")
    # what the publisher sets when an answer cannot be drawn
    busy = param.Boolean(default=False)
    progress = param.Number(default=None, allow_None=True)


@lru_cache(maxsize=CAPACITY)
def answer(asked):
    """Return the answer to a question, and why there is none.

    Parameters
    ----------
    asked : tuple
        A function and its arguments, all hashable.

    Returns
    -------
    tuple
        What the function returned or None, and the problem or an empty text.
    """
    function, *arguments = asked
    try:
        return function(*arguments), ""
    except Exception as error:
        return None, readable(error)


class QuestionRunner:
    """Watches a question and answers it while it is looked at.

    Parameters
    ----------
    question : Question
        What is watched and answered.
    """

    def __init__(self, question):
        self._question = question
        question.param.watch(Latest(self._answer).ask, ["asked", "looked_at"])

    async def _answer(self, document):
        question, asked = self._question, self._question.asked
        if not question.looked_at or asked is None or asked == question.answered:
            return
        found, problem = await asyncio.get_running_loop().run_in_executor(workers(), answer, asked)
        publish(question, document, answered=asked, answer=found, problem=problem)
