"""The answers that are kept, one a row: what was asked, the sentence, and whether it comes out again.

A row lives as long as its answer.
"""

import asyncio
import html

import panel as pn
import panel_material_ui as pmui
from panel.viewable import Viewer

from dashboard import theme
from dashboard.compute.document import NextTick
from dashboard.compute.inquiries import Inquiry, InquiryRunner
from dashboard.compute.workers import workers
from dashboard.session.answers import question_lines
from dashboard.views.components import words


class KeptRow(Viewer):
    """One answer.

    Parameters
    ----------
    answers : Answers
        The list that it is part of.
    answer : trackig_core.decide.Answer
        The answer.
    """

    def __init__(self, answers, answer):
        super().__init__()
        self._answers, self._answer = answers, answer
        self.inquiry = Inquiry()
        self.runner = InquiryRunner(self.inquiry)
        title, asked = question_lines(answer)
        self.words = pn.pane.HTML(
            f"<h3>{html.escape(title)}</h3><p>{html.escape(answer.sentence)}</p>"
            f"<p class='note'>{html.escape(' '.join(asked))}</p>",
            stylesheets=[theme.ANSWER_CSS],
            sizing_mode="stretch_width",
            margin=(2, 12, 0, 12),
        )
        self.again = pmui.Button(label="Ask again", icon="refresh", on_click=self._ask, **BUTTON)
        self.stop = pmui.Button(label="Stop", icon="stop", visible=False, on_click=self.runner.stop, **BUTTON)
        self.remove = pmui.Button(
            label="Remove", icon="delete", on_click=lambda _: answers.remove(answer), **BUTTON
        )
        self.outcome = pn.pane.HTML(
            "", stylesheets=[theme.ANSWER_CSS], sizing_mode="stretch_width", margin=(0, 12)
        )
        self.inquiry.param.watch(self._show_state, ["busy", "progress", "problem"])
        self.inquiry.param.watch(self._compare, "result")

    def _ask(self, *_):
        self.inquiry.param.update(answered=None, asked=None)
        self.inquiry.asked = self._answer.question

    def _show_state(self, *_):
        inquiry = self.inquiry
        self.stop.visible, self.again.disabled = inquiry.busy, inquiry.busy
        if inquiry.problem:
            self._say(inquiry.problem, "problem")
        elif inquiry.busy:
            done = "" if inquiry.progress is None else f", {100 * inquiry.progress:.0f} %"
            self._say(f"Asked again{done} …", "note")

    async def _compare(self, event):
        """Say whether the same figures came out, here and in the report."""
        loop = asyncio.get_running_loop()
        page = await loop.run_in_executor(workers(), page_of, self._answer, event.new)
        self._answers.note_page(self._answer, page)
        if isinstance(page, str):
            self._say(page, "problem")
        else:
            self._say("The same figures came out, to the last bit.", "fine")

    def _say(self, words, kind):
        self.outcome.object = f'<p role="status" class="{kind}">{html.escape(words)}</p>'

    def __panel__(self):
        """Return what is put on the page."""
        return pn.Column(
            self.words,
            pn.FlexBox(self.again, self.stop, self.remove, margin=(0, 8)),
            self.outcome,
            sizing_mode="stretch_width",
            margin=(0, 0, 8, 0),
        )


def page_of(answer, result):
    """Return what the report shows of an answer that was asked again."""
    # plots are slow to load
    from dashboard.report.answer_pages import page_again

    return page_again(answer, result)


class KeptAnswers(Viewer):
    """All answers that are kept.

    Parameters
    ----------
    answers : Answers
        What is listed.
    exchange : Exchange
        Prepares the browser for rows that are added.
    """

    def __init__(self, answers, exchange):
        super().__init__()
        self._answers, self._exchange = answers, exchange
        self.rows = ()
        self._column = pn.Column(sizing_mode="stretch_width", margin=0)
        answers.param.watch(NextTick(self._show), "kept")
        self._show()

    def _show(self):
        there = {id(answer): row for answer, row in self.rows}
        self.rows = tuple(
            (answer, there.get(id(answer)) or KeptRow(self._answers, answer)) for answer in self._answers.kept
        )
        self._column.objects = [row for _, row in self.rows] or [nothing_yet()]
        self._exchange.introduce()

    def __panel__(self):
        """Return what is put on the page."""
        return self._column


def nothing_yet():
    """Return what stands in the place of answers while there are none."""
    return words(NOTHING_YET, margin=(4, 12, 10, 12))


NOTHING_YET = "Nothing is kept yet: “Keep the answer” stands below each."

BUTTON = {"size": "small", "variant": "text", "margin": (0, 4, 0, 4)}
