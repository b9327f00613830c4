"""What the questions of the tab Decide have in common: inquiry, progress, sentence, keeping, export."""

import asyncio
import datetime
import html
from dataclasses import replace
from functools import partial

import panel as pn
import panel_material_ui as pmui

import trackig_core as tig
from dashboard import theme
from dashboard.client.exchange import notify
from dashboard.compute.document import NextTick
from dashboard.compute.inquiries import QUICK, WAITING, Inquiry, InquiryRunner, question_of
from dashboard.compute.workers import workers
from dashboard.persistence.exports import answer_csv, file_name
from dashboard.session.answers import KeepError
from dashboard.session.heading import Heading
from dashboard.views.components import bokeh_pane
from trackig_core.levels.specification import not_judged_text

NO_SPECIFICATION = "Write a specification first, in the tab Specification: designs are compared with it."

BUTTON = {"size": "small", "variant": "outlined", "margin": (10, 8, 6, 0)}
SMALL_BUTTON = {"size": "small", "variant": "text", "margin": (0, 4, 4, 0)}
BOX = {"margin": (6, 12, 6, 0)}


class Asked:
    """A question, its progress, its answer in a sentence, and a hint what to do with it on the page.

    Parameters
    ----------
    snapshot : SessionSnapshot
        The session: current design, specification, definition, and the answers that are kept.
    exchange : Exchange
        Where files go.
    inquiry : Inquiry, optional
        One that is asked by somebody else; by default the question is asked here.
    """

    kind = ""
    hint = ""
    before = ""
    """What to do for an answer, said where it will be."""
    ages = False
    """Whether the answer stays as it is when the design or the boxes change of which it was asked, and says
    so."""

    def __init__(self, snapshot, exchange, inquiry=None):
        self.snapshot, self._exchange = snapshot, exchange
        self.assessment, self.definition = snapshot.assessment, snapshot.definition
        self.inquiry = Inquiry() if inquiry is None else inquiry
        self.runner = InquiryRunner(self.inquiry) if inquiry is None else inquiry.runner
        self.sentence = pn.pane.HTML(
            _paragraph(self.before, "note"),
            stylesheets=[theme.ANSWER_CSS],
            sizing_mode="stretch_width",
            margin=(2, 12, 2, 12),
        )
        self.progress = pmui.LinearProgress(
            value=0, variant="determinate", width=160, visible=False, margin=(16, 0, 0, 12)
        )
        self.stop = pmui.Button(label="Stop", icon="stop", on_click=self.runner.stop, visible=False, **BUTTON)
        self.button = pmui.Button(label="Compute", icon="play_arrow", on_click=self.ask, **BUTTON)
        self.keep = pmui.Button(
            label="Keep the answer", icon="bookmark_add", on_click=self._keep, **SMALL_BUTTON
        )
        self.export = pmui.Button(label="CSV", icon="download", on_click=self._export, **SMALL_BUTTON)
        self._is_dated, self.drawn = False, ()
        self.answered_row = pn.Row(self.keep, self.export, visible=False, margin=(0, 12))
        self.inquiry.param.watch(self._show_state, ["busy", "progress", "problem"])
        # figures may change only when the session's document may
        self._draw = NextTick(self._answered)
        self.inquiry.param.watch(self._draw, "result")

    def settings(self):
        """Return what is asked about the current design [SI units]."""
        return {}

    def varied(self, settings):  # noqa: ARG002
        """Return names of what the answer is about whatever the design has there (iterable of str).

        Parameters
        ----------
        settings : mapping
            What was asked.
        """
        return ()

    def ask(self, *_):
        """Ask the question as it stands."""
        try:
            settings = self.settings()
        except ValueError as error:
            self._say(str(error), "problem")
            return
        question = question_of(self.kind, settings, self.assessment, self.definition)
        if question is None:
            self._say(what_is_missing(self.assessment))
        elif question == self.inquiry.answered:
            self._draw()
        else:
            self.inquiry.asked = question

    def _show_state(self, *_):
        inquiry = self.inquiry
        self.progress.param.update(
            visible=inquiry.busy and inquiry.progress is not None, value=round(100 * (inquiry.progress or 0))
        )
        self.stop.visible = inquiry.busy
        if inquiry.problem:
            self._say(inquiry.problem, "problem")
        elif inquiry.busy and inquiry.progress is None and self.kind not in QUICK:
            self._say(WAITING)

    def _answered(self):
        result = self.inquiry.result
        self.answered_row.visible = result is not None
        if result is not None:
            self._date(self._is_of_another())
            self._say_answer(result)
            self.show(result)

    def note_age(self):
        """Say whether the answer is still that of the design, of the boxes and of the specification."""
        result, busy = self.inquiry.result, self.inquiry.busy
        if result is not None and not busy and self._is_of_another() != self._is_dated:
            self._date(not self._is_dated)
            self._say_answer(result)

    def _date(self, is_dated):
        self._is_dated = is_dated
        for part in self.drawn:
            part.styles = theme.STALE if is_dated else theme.FRESH

    def _is_of_another(self):
        """Return whether the answer ages, and would be one to another question if it were asked for now."""
        answered = self.inquiry.answered
        if not self.ages or answered is None:
            return False
        varied = {name: answered.design.value(name) for name in self.varied(answered.settings)}
        try:
            settings, design = self.settings(), self.assessment.current.design.replace(**varied)
        except ValueError:
            # what stands there now cannot be asked
            return True
        return answered != question_of(self.kind, settings, self.assessment, self.definition, design)

    def _say_answer(self, result):
        if self._is_dated:
            again = f"Press “{self.button.label}” to ask again."
            self._say(f"Before the last changes: {self.words(result)}", "note", again)
            return
        question = self.inquiry.answered
        specification = None if question is None else question.specification
        rest = "" if specification is None else not_judged_text(specification.not_judged)
        hints = (rest and f"Limits of the specification: {rest}.", self.hint)
        self._say(self.words(result), "fine", " ".join(filter(None, hints)))

    def _say(self, words, kind="note", hint=""):
        self.sentence.object = said(words, kind) + _paragraph(hint, "note")

    def words(self, result):
        """Return the answer in one sentence."""
        return str(result)

    def show(self, result):
        """Draw an answer."""
        raise NotImplementedError

    async def _keep(self, *_):
        """Keep the answer, with what the report shows of it."""
        await self._worked(self.keep, kept_answer, self._hold)

    async def _export(self, *_):
        """Save all figures of the answer."""
        write = partial(written_answer, self.snapshot.study(), datetime.date.today())
        await self._worked(self.export, write, self._save)

    async def _worked(self, pressed, work, then):
        """Do work on the answer off the event loop, a button at work meanwhile, and go on with it."""
        question, result = self.inquiry.answered, self.inquiry.result
        if question is None or result is None:
            return
        pressed.loading = True
        try:
            loop = asyncio.get_running_loop()
            made = await loop.run_in_executor(workers(), work, question, self.words(result), result)
        finally:
            pressed.loading = False
        then(made)

    def _hold(self, made):
        answer, page = made
        study = self.snapshot.study()
        try:
            # a study that could not be read back would lose the whole session
            replace(study, answers=(*study.answers, answer)).to_toml()
            self.snapshot.answers.keep(answer, page)
        except (KeepError, tig.StudyError) as problem:
            notify("warning", f"Not kept: {problem}")
        else:
            notify("success", "Kept: it is part of the study and of the report.")

    def _save(self, text):
        self._exchange.save(file_name(self.assessment.title, self.kind, "answer.csv"), text)


def what_is_missing(assessment):
    """Return what a user has to do before designs can be held against a specification."""
    specification = assessment.specification
    if specification is None or not specification.question:
        return NO_SPECIFICATION
    return f"Answer first, in the tab Specification: {specification.question}"


def _paragraph(words, kind):
    """Return words of a kind as a paragraph, if there are any (HTML)."""
    return words and f'<p class="{kind}">{html.escape(words)}</p>'


def said(words, kind):
    """Return words of a kind that a reader's software says as soon as they are there (HTML)."""
    return words and f'<p role="status" class="{kind}">{html.escape(words)}</p>'


def scrolled(name, content):
    """Return HTML that keys can scroll where it is wider than its place, with a name."""
    return f'<div class="scroll" tabindex="0" role="region" aria-label="{name}">{content}</div>'


def kept_answer(question, words, result):
    """Return the record of an answer, and what the report shows of it."""
    # plots are slow to load, and nobody waits for them who keeps nothing
    from dashboard.report.answer_pages import answer_page

    answer = replace(tig.decide.Answer.of(question, result), sentence=words)
    return answer, answer_page(answer, result)


def written_answer(study, date, question, words, result):
    """Return an answer as CSV (str)."""
    heading = Heading.of_question(study, question, THAT_DESIGN, date)
    answer = replace(tig.decide.Answer.of(question, result), sentence=words)
    return answer_csv(answer, result, heading)


THAT_DESIGN = "as asked, see below"


def beside(*figures):
    """Return figures side by side, or below each other where there is no room."""
    panes = [bokeh_pane(each) for each in figures]
    return pn.Column(*panes, stylesheets=[theme.FITTING_CSS], sizing_mode="stretch_width", margin=0)
