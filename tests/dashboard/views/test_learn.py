"""The Learn tab in process: what nobody looks at costs nothing, and what is drawn is the library's."""

import asyncio
import re

import numpy as np
import pytest

import trackig_core as tig
from dashboard import assets
from dashboard.compute import questions as teacher_module
from dashboard.compute.questions import Question, QuestionRunner
from dashboard.session.inputs import DesignInputs, GainDefinition
from dashboard.session.results import Outcome
from dashboard.teaching.lessons import load_lessons
from dashboard.views.ladder import LeftOut
from dashboard.views.learn import Learn
from dashboard.views.lessons import Lessons
from dashboard.views.method import Method, method_html
from dashboard.views.motion import Motion
from dashboard.views.subjects import Damping, Definitions, LumpedVsBeam, Resonances, Slopes
from tests.waiting import until

BLOCK = tig.PRESETS["booted-block-low-mass"]


@pytest.fixture(autouse=True)
def _one_loop(monkeypatch):
    """Let Panel see each question through in one loop, not in a new one that nobody closes."""
    loop = asyncio.new_event_loop()
    monkeypatch.setattr(asyncio, "new_event_loop", lambda: loop)
    yield
    asyncio.set_event_loop(None)
    loop.close()


@pytest.fixture
def outcome(summary):
    return Outcome(summary=summary("booted-block-low-mass"))


@pytest.fixture
def definition():
    return GainDefinition()


@pytest.fixture
def inputs():
    return DesignInputs()


def looked_at(subject):
    """Look at a subject; without a loop its question is answered before this returns."""
    subject.question.looked_at = True
    assert subject.question.problem == ""
    return subject


def test_nothing_is_worked_out_that_nobody_looks_at():
    asked = []

    async def session():
        question = Question()
        QuestionRunner(question)
        question.asked = (asked.append, "early")
        await asyncio.sleep(0.05)
        assert asked == []
        question.looked_at = True
        await until(lambda: asked)
        assert asked == ["early"]
        question.looked_at = False
        question.asked = (asked.append, "late")
        await asyncio.sleep(0.05)
        assert asked == ["early"]

    teacher_module.answer.cache_clear()
    asyncio.run(session())


def test_why_there_is_no_answer_is_told(outcome, definition, fake_picture):
    subject = Slopes(outcome, definition)
    outcome.summary = fake_picture(BLOCK.replace(boot_loss_factor=0.0))
    subject.question.looked_at = True
    assert "more than 0" in subject.problem.object
    assert subject.problem.visible
    outcome.summary = fake_picture(BLOCK)
    assert not subject.problem.visible


def test_subjects_are_made_and_put_on_the_page_when_first_looked_at(inputs, outcome, definition):
    learn = Learn(inputs, outcome, definition)
    places = list(learn.menu.objects)
    assert not any(place.objects for place in places)
    learn.look(True)
    assert isinstance(learn.subject, Lessons)
    assert learn.subject.question.looked_at
    lessons = learn.subject
    learn.menu.active = 2
    assert isinstance(learn.subject, Resonances)
    assert not lessons.question.looked_at
    assert [len(place.objects) for place in places] == [1, 0, 1, 0, 0, 0, 0, 0]
    learn.menu.active = 0
    assert learn.subject is lessons
    learn.look(False)
    assert not lessons.question.looked_at


def test_the_sweep_s_point_moves_with_the_design(outcome, definition, fake_picture, summary):
    subject = looked_at(Resonances(outcome, definition))
    natural = summary("booted-block-low-mass").solution.natural_frequencies
    assert subject.figure.present.data["value"] == [28.0, 28.0]
    assert subject.figure.present.data["frequency"] == [natural.loaded_track, natural.coupled_block]
    outcome.summary = fake_picture(BLOCK.replace(boot_stiffness=14e6))
    assert subject.figure.present.data["value"][0] == 14.0
    sweep = subject.figure.sweep.data
    # the beam's curve passes through the beam's own point
    at = np.interp(np.log(28.0), np.log(sweep["value"]), sweep["loaded_track"])
    assert at == pytest.approx(natural.loaded_track, rel=1e-3)
    subject.field.value = "wheel_mass"
    assert subject.figure.present.data["value"][0] == 880.0
    assert "wheel mass" in subject.figure.model.xaxis.axis_label


def test_a_single_stage_track_is_swept_by_what_it_has(outcome, definition, summary):
    subject = looked_at(Resonances(outcome, definition))
    outcome.summary = summary("slab-track")
    assert subject.field.value == "pad_stiffness"
    assert "boot_stiffness" not in subject.field.options.values()
    assert len(subject.figure.present.data["value"]) == 1
    assert np.isnan(subject.figure.sweep.data["upper"]).all()


def test_asymptotes_are_drawn_on_demand(outcome, definition):
    subject = looked_at(Slopes(outcome, definition))
    lines = subject.figure.lines.data
    own = tig.gain_asymptotes(BLOCK)
    assert lines["y1"][: len(own)] == [line.level[1] for line in own]
    assert lines["words"][: len(own)] == ["level", "−12 dB per octave", "−24 dB per octave"]
    assert all(renderer.visible for renderer in subject.figure.drawn)
    subject.toggle.value = False
    assert not any(renderer.visible for renderer in subject.figure.drawn)
    assert "<td>−24 dB per octave</td>" in subject.table.object
    definition.summation = "coherent"
    exact = tig.solve(BLOCK, "exact", summation="coherent").insertion_gain
    np.testing.assert_allclose(subject.figure.bands.data["level"], exact, atol=1e-9)


def test_three_loss_factors_are_overlaid(outcome, definition, summary):
    subject = looked_at(Damping(outcome, definition))
    expected = tig.gain_by_loss_factor(BLOCK)
    for number in range(3):
        np.testing.assert_allclose(subject.gain.bands.data[f"loss_{number}"], expected[number])
    pad, boot = tig.damping_curves(BLOCK, subject.stiffness.values.data["frequency"])
    np.testing.assert_allclose(subject.stiffness.values.data["boot"], boot.stiffness)
    np.testing.assert_allclose(subject.loss_factor.values.data["pad"], pad.loss_factor)
    outcome.summary = summary("slab-track")
    assert np.isnan(subject.stiffness.values.data["boot"]).all()


def test_four_definitions_and_the_false_peak_are_drawn(outcome, definition):
    subject = looked_at(Definitions(outcome, definition))
    rigid = tig.solve(BLOCK, "exact", reference="rigid").insertion_gain
    np.testing.assert_allclose(subject.four.bands.data["energy_rigid"], rigid, atol=1e-9)
    drawn = subject.references.levels.data
    peak = drawn["frequency"][np.argmax(drawn["real"])]
    assert peak == pytest.approx(np.sqrt(BLOCK.contact_stiffness / BLOCK.wheel_mass) / (2 * np.pi), rel=0.01)
    assert np.abs(drawn["stiffened"]).max() < 0.3


def test_the_ladder_shades_the_bands_that_agree(outcome, definition):
    subject = looked_at(LumpedVsBeam(outcome, definition))
    comparison = tig.compare_with_beam(BLOCK)
    np.testing.assert_allclose(subject.figure.bands.data["lumped"], comparison.lumped)
    np.testing.assert_allclose(subject.figure.good.data["left"], tig.BAND_EDGES[:-1][comparison.good_enough])


def test_what_was_left_out_is_the_library_s_ladder(outcome, definition):
    subject = looked_at(LeftOut(outcome, definition))
    ladder = tig.analysis.ladder(BLOCK, "regional", "rock")
    drawn = subject.figure.bands.data
    np.testing.assert_allclose(drawn["ground"], ladder.rungs[-1].insertion_gain)
    np.testing.assert_allclose(drawn["lumped"], ladder.one_dimensional.insertion_gain)
    assert np.isnan(drawn["damping"]).all()
    cells = subject.differences.cells.data
    expected = [*(rung.difference for rung in ladder.rungs[1:]), ladder.one_dimensional.difference]
    np.testing.assert_allclose(cells["difference"], np.concatenate(expected))
    assert subject.differences.rungs.factors[0] == "one-dimensional: no rail"
    assert ladder.sentence in subject.words.object
    assert "no load moves along the track" in subject.words.object
    assert "generic: rock" in subject.table.object
    subject.ground.value = "soft clay"
    soft = tig.analysis.ladder(BLOCK, "regional", "soft clay").rungs[-1].insertion_gain
    np.testing.assert_allclose(subject.figure.bands.data["ground"], soft)


def test_what_a_design_has_of_its_own_is_not_chosen(outcome, definition, fake_picture):
    subject = looked_at(LeftOut(outcome, definition))
    assert not subject.ground.disabled
    outcome.summary = fake_picture(BLOCK.replace(ground=tig.GROUNDS["stiff clay"]))
    assert subject.ground.disabled
    assert not subject.vehicle.disabled
    assert "its own: ground" in subject.own.object


def test_motion_is_shown_while_a_long_run_goes_on(outcome, definition, fake_picture):
    subject = looked_at(Motion(outcome, definition))
    two = BLOCK.replace(axle_positions=(0.0, 2.1), ground=tig.GROUNDS["rock"])
    outcome.summary = fake_picture(two, fidelity="exact")
    assert "wheel_1" not in subject.film.film.data
    outcome.asked = two
    np.testing.assert_allclose(
        subject.film.film.data["wheel_1"], 1e6 * tig.film(two).wheels[:, 1], rtol=1e-5, atol=1e-4
    )
    assert len(subject.film.film.data["foot_0"]) > 0


def test_motion_follows_the_design_when_it_rests(outcome, definition, fake_picture):
    subject = looked_at(Motion(outcome, definition))
    np.testing.assert_allclose(subject.film.film.data["wheel_0"], 1e6 * tig.film(BLOCK).wheel, rtol=1e-6)
    softer = BLOCK.replace(boot_stiffness=14e6)
    outcome.summary = fake_picture(softer, fidelity="live")
    np.testing.assert_allclose(subject.film.film.data["wheel_0"], 1e6 * tig.film(BLOCK).wheel, rtol=1e-6)
    moving = tig.steady_shape(softer, subject.pick.cursor.location)
    np.testing.assert_allclose(subject.shape.parts["wheel"].data["real"], moving.wheel.real)
    outcome.summary = fake_picture(softer)
    np.testing.assert_allclose(subject.film.film.data["wheel_0"], 1e6 * tig.film(softer).wheel, rtol=1e-6)


def test_the_shape_follows_cursor_slider_and_buttons(outcome, definition):
    subject = looked_at(Motion(outcome, definition))
    subject.pick.cursor.location = 63.0
    np.testing.assert_allclose(
        subject.shape.parts["wheel"].data["imag"], tig.steady_shape(BLOCK, 63.0).wheel.imag
    )
    assert "At 63.0 Hz" in subject.shape_words.object
    subject.frequency.value = 150
    assert subject.pick.cursor.location == pytest.approx(tig.BAND_EDGES[0] * 10**1.5)
    subject.jumps[1].clicks += 1
    natural = outcome.summary.solution.natural_frequencies
    assert subject.pick.cursor.location == natural.loaded_track
    subject.jumps[2].clicks += 1
    assert subject.pick.cursor.location == natural.coupled_block


def test_nothing_can_be_revealed_before_there_is_an_answer(outcome, definition, inputs):
    subject = Lessons(outcome, definition, inputs)
    assert subject.reveal.disabled
    assert not looked_at(subject).reveal.disabled


@pytest.mark.parametrize("number", range(6))
def test_each_lesson_asks_and_reveals(outcome, definition, inputs, number):
    subject = looked_at(Lessons(outcome, definition, inputs))
    lesson = load_lessons()[0][number]
    subject.menu.value = lesson
    assert subject.answers.options == [choice.text for choice in lesson.choices]
    assert "{{" not in subject.introduction.object
    assert not subject.reveal.disabled
    subject.reveal.clicks += 1
    assert not subject.revealed.visible
    assert "Choose" in subject.verdict.object
    before = tig.solve(lesson.designs()[0], "exact").insertion_gain
    np.testing.assert_allclose(subject.figure.bands.data["start"], before, atol=1e-9)
    revealed, _ = subject.question.answer
    for choice, right in zip(lesson.choices, revealed.right, strict=True):
        subject.answers.value = choice.text
        subject.reveal.clicks += 1
        assert subject.verdict.object.startswith("Right." if right else "Not quite.")
    assert subject.revealed.visible
    assert subject.revealed.object == revealed.reveal
    assert not subject.broken.visible


def test_a_lesson_sets_sliders_and_locks_none(outcome, definition, inputs):
    subject = looked_at(Lessons(outcome, definition, inputs))
    lesson = subject.menu.value
    inputs.preset = "slab-track"
    subject.begin.clicks += 1
    assert inputs.to_design() == lesson.designs()[0]
    subject.change.clicks += 1
    assert inputs.to_design() == lesson.designs()[1]
    inputs.boot_stiffness = 50
    assert inputs.boot_stiffness == 50


def test_a_broken_lesson_is_told_and_the_rest_can_be_read(outcome, definition, inputs, tmp_path):
    (tmp_path / "1-bad.md").write_text("no front matter <script>alert(1)</script>")
    good = next(path for path in sorted(assets.LESSONS.glob("*.md")))
    (tmp_path / "2-good.md").write_text(good.read_text(encoding="utf-8"), encoding="utf-8")
    (tmp_path / "<img src=x onerror=alert(1)>.md").write_text("+++\n")
    subject = looked_at(Lessons(outcome, definition, inputs, tmp_path))
    assert len(subject.menu.options) == 1
    assert subject.broken.visible
    assert "1&#45;bad.md, line 1" in subject.broken.object
    assert "<img" not in subject.broken.object
    assert "<script" not in subject.broken.object


def test_what_a_lesson_holds_is_text_and_fetches_nothing(outcome, definition, inputs, tmp_path):
    text = sorted(assets.LESSONS.glob("*.md"))[0].read_text(encoding="utf-8")
    hostile = text.replace("## Reveal", "![x](https://example.org/x.png) <b onclick=x>b</b>\n\n## Reveal")
    (tmp_path / "x.md").write_text(re.sub('question = ".', 'question = "![x](//e.org) <i>', hostile), "utf-8")
    subject = looked_at(Lessons(outcome, definition, inputs, tmp_path))
    assert "![" not in subject.introduction.object
    assert subject.introduction.renderer_options == {"html": False}
    assert not set("<[") & set(subject.asked.object)


def test_no_lessons_at_all_give_a_message(outcome, definition, inputs, tmp_path):
    subject = looked_at(Lessons(outcome, definition, inputs, tmp_path))
    assert "no lessons here" in subject.broken.object
    assert subject.reveal.disabled


def test_a_lesson_that_the_solver_contradicts_says_so(outcome, definition, inputs, tmp_path):
    good = sorted(assets.LESSONS.glob("*.md"))[0].read_text(encoding="utf-8")
    wrong = re.sub(
        r'"insertion_gain\(63\) falls by [^"]*"', '"insertion_gain(63) rises by at least 3 dB"', good
    )
    assert wrong != good
    (tmp_path / "wrong.md").write_text(wrong, encoding="utf-8")
    subject = looked_at(Lessons(outcome, definition, inputs, tmp_path))
    assert "finds this claim false" in subject.broken.object


def test_the_method_keeps_every_formula_as_it_was_for_katex_to_find():
    shown = Method().text.object
    assert shown.count("$$") >= 20
    assert "\\frac{\\partial^4 u}{\\partial x^4}" in shown
    assert "$m_w$" in shown
    assert "<em>paper</em>" in shown


def test_formulas_survive_markdown_and_markup_does_not():
    shown = method_html(
        "a $x_i * y_i$ b\n\n$$\na_1\n= b_2 < c\n$$\n\n<img src=x onerror=alert(1)> | costs 5 $"
    )
    assert "$x_i * y_i$" in shown
    assert "$$a_1 = b_2 &lt; c$$" in shown
    assert "<img" not in shown
    assert "<table>" in method_html("| term | meaning |\n|---|---|\n| bay | $L$ |")
