"""Questions about many designs: the newest is answered, and a search that is stopped keeps what it has."""

import asyncio
import threading

import pytest

import trackig_core as tig
from dashboard.compute import inquiries
from dashboard.compute.inquiries import Inquiry, InquiryRunner, question_of
from dashboard.session.assessment import Assessment
from dashboard.session.inputs import DesignInputs, GainDefinition
from dashboard.session.pins import Pins
from dashboard.session.results import Outcome
from tests.waiting import WAIT, until, until_at_rest

LIMITS = tig.Specification([(63, -4.0), (125, -6.0)])
BLOCK = tig.PRESETS["booted-block-low-mass"]


class Slow:
    """A question that is answered when a test lets it, and says how far it is."""

    kind = "tolerance"

    def __init__(self, answer="an answer"):
        self.answer = answer
        self.begun, self.go_on, self.cancelled = threading.Event(), threading.Event(), False

    def ask(self, *, progress, cancelled, threads):
        assert threads == 1
        self.begun.set()
        progress(0.5)
        while not self.go_on.wait(0.005):
            if cancelled():
                self.cancelled = True
                raise tig.SolveCancelled
        if isinstance(self.answer, Exception):
            raise self.answer
        return self.answer


@pytest.fixture
def inquiry(monkeypatch):
    monkeypatch.setattr(inquiries, "LOOK_EVERY", 0.005)
    return Inquiry()


def story(coroutine):
    async def told():
        await coroutine
        await until_at_rest()

    asyncio.run(told())


def test_progress_is_told_and_then_the_answer(inquiry):
    InquiryRunner(inquiry)
    question = Slow()

    async def ask():
        inquiry.asked = question
        await until(lambda: inquiry.progress == 0.5)
        assert inquiry.busy
        question.go_on.set()
        await until(lambda: inquiry.answered is question)

    story(ask())
    assert (inquiry.result, inquiry.busy, inquiry.progress, inquiry.problem) == ("an answer", False, None, "")


def test_a_newer_question_ends_the_one_before(inquiry):
    InquiryRunner(inquiry)
    old, new = Slow(), Slow("new answer")
    new.go_on.set()

    async def ask():
        inquiry.asked = old
        await until(old.begun.is_set)
        inquiry.asked = new
        await until(lambda: inquiry.answered is new)

    story(ask())
    assert old.cancelled
    assert inquiry.result == "new answer"


def test_what_is_stopped_has_no_answer_and_can_be_asked_again(inquiry):
    runner = InquiryRunner(inquiry)
    question = Slow()

    async def ask():
        inquiry.asked = question
        await until(question.begun.is_set)
        runner.stop()
        await until(lambda: not inquiry.busy)

    story(ask())
    assert question.cancelled
    assert inquiry.answered is None
    assert inquiry.problem == ""


def test_a_refusal_is_told_in_its_own_words_and_an_accident_is_not(inquiry, caplog):
    InquiryRunner(inquiry)
    refused, failed = Slow(ValueError("nothing is free")), Slow(RuntimeError("<b>"))

    async def ask(question):
        question.go_on.set()
        inquiry.asked = question
        await until(lambda: inquiry.problem)

    story(ask(refused))
    assert inquiry.problem == "Not answered: nothing is free."
    inquiry.problem = ""
    story(ask(failed))
    assert "<b>" not in inquiry.problem
    assert "<b>" in caplog.text


def test_while_a_slider_moves_quick_questions_wait(inquiry, monkeypatch):
    monkeypatch.setattr(inquiries, "REST", WAIT)
    InquiryRunner(inquiry)
    questions = [Slow() for _ in range(4)]
    for each in questions:
        each.kind = "range"
        each.go_on.set()

    async def drag():
        for each in questions[:-1]:
            inquiry.asked = each
            await asyncio.sleep(0.001)
        monkeypatch.setattr(inquiries, "REST", 0.01)
        inquiry.asked = questions[-1]
        await until(lambda: inquiry.answered is questions[-1])

    story(drag())
    assert [each.begun.is_set() for each in questions] == [False, False, False, True]


def test_a_search_shows_what_it_has_and_keeps_it_when_it_is_stopped(inquiry):
    runner = InquiryRunner(inquiry)
    grown = []
    inquiry.param.watch(lambda event: grown.append(event.new), "so_far")
    settings = {"free": ["boot_stiffness", "block_mass"], "population": 20, "generations": 2000}
    question = tig.decide.Question("find", BLOCK, settings, specification=LIMITS)

    async def search():
        inquiry.asked = question
        await until(lambda: len(grown) > 1)
        runner.stop()
        await until(lambda: not inquiry.busy)

    story(search())
    assert inquiry.result.stopped
    assert inquiry.result.slack.size >= grown[-2].slack.size > 0


def test_what_cannot_be_asked_is_no_question(make_pictures):
    inputs, definition, pins = DesignInputs(), GainDefinition(reference="rigid"), Pins()
    assessment = Assessment(inputs, Outcome(), definition, pins, make_pictures())
    assert question_of("range", {}, assessment, definition) is None
    assessment.specification = LIMITS
    question = question_of("range", {}, assessment, definition)
    assert (question.design, question.specification, question.reference) == (BLOCK, LIMITS, "rigid")


def test_the_reference_is_that_of_the_design_that_is_asked_about(make_pictures):
    """On ground that yields only a stiff track is a reference, whatever the current design stands on."""
    assessment = Assessment(DesignInputs(), Outcome(), GainDefinition(), Pins(), make_pictures())
    assessment.specification = LIMITS
    yielding = BLOCK.replace(ground=tig.Ground(stiffness=1e8, damping=1e5, mass=500.0))
    question = question_of("range", {}, assessment, GainDefinition(reference="rigid"), design=yielding)
    assert (question.design, question.reference) == (yielding, "stiff")
