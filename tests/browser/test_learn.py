"""Learning in a real browser: what moves and what lessons reveal is the solver's, and nothing is fetched."""

import re

import numpy as np
import pytest
from playwright.sync_api import expect

import trackig_core as tig
from dashboard import assets
from dashboard.figures import motion as figures_motion
from dashboard.teaching.lessons import load_lessons, reveal
from tests.browser.conftest import WANDERED, count_sent, resting_place, wait_until_at_rest, wait_until_drawn
from tests.browser.test_dashboard import box, choose, column, wait_for_levels

pytestmark = pytest.mark.browser

OPENING = tig.PRESETS["booted-block-low-mass"]

LESSONS = load_lessons()[0]

METHOD = assets.read_text("method.md")


def look_at(page, subject):
    page.get_by_role("tab", name="Learn", exact=True).click()
    page.get_by_role("tab", name=subject, exact=True).click()


def model(page, name, attribute):
    """Read a property of a model in the browser; wait until the model is there."""
    page.wait_for_function("name => Bokeh.documents[0].get_model_by_name(name) != null", arg=name)
    return page.evaluate(
        "([name, attribute]) => Bokeh.documents[0].get_model_by_name(name)[attribute]", [name, attribute]
    )


def set_model(page, name, attribute, value):
    """Set a property of a model in the browser, once it has been drawn."""
    wait_until_drawn(page, name)
    page.evaluate(
        "([name, attribute, value]) => { Bokeh.documents[0].get_model_by_name(name)[attribute] = value }",
        [name, attribute, value],
    )


def wait_for_film(page, motion):
    """Wait until the browser holds a film, and stands still."""
    page.wait_for_function(
        """wheel => {
            const film = Bokeh.documents[0].get_model_by_name("film")
            const moved = film != null && Math.abs(film.data.wheel_0[40] - wheel) < 1e-3
            return moved && Bokeh.documents[0].is_idle
        }""",
        arg=float(1e6 * motion.wheel[40]),
    )


@pytest.mark.parametrize("frame", [0, 57, 300, 614])
def test_the_browser_draws_the_film_s_own_frames(published_dashboard, frame):
    dashboard = published_dashboard
    look_at(dashboard, "Motion")
    motion = tig.film(OPENING)
    wait_for_film(dashboard, motion)
    set_model(dashboard, "film_slider", "value", 1000 * motion.time[frame])
    scale = column(dashboard, "film_facts", "scale")[0]
    height = column(dashboard, "film_rail", "y")
    moved = -(height - figures_motion.RAIL_AT) / scale / 1e6
    np.testing.assert_allclose(moved[36:], motion.rail[frame], atol=1e-6 * motion.step)
    np.testing.assert_allclose(moved, moved[::-1])
    blocks = (figures_motion.BLOCK_AT - column(dashboard, "film_supports", "block")) / scale / 1e6
    np.testing.assert_allclose(blocks[12:], motion.block[frame], atol=1e-6 * motion.step)
    wheel = (figures_motion.WHEEL_AT - column(dashboard, "film_wheel", "y")[0]) / scale / 1e6
    assert wheel == pytest.approx(motion.wheel[frame], abs=1e-6 * motion.step)


NEXT_FRAMES = """count => new Promise(done => {
    const wait = left => left == 0 ? done() : requestAnimationFrame(() => wait(left - 1))
    wait(count)
})"""
"""Lets the browser paint some frames."""


def test_the_film_plays_in_the_browser_alone_and_pauses(published_dashboard):
    dashboard = published_dashboard
    look_at(dashboard, "Motion")
    wait_for_film(dashboard, tig.film(OPENING))
    set_model(dashboard, "film_slider", "value", 0)
    # the address bar is the last to follow
    dashboard.wait_for_function("() => new URLSearchParams(location.search).get('tab') === 'learn'")
    count_sent(dashboard)
    moment = "Bokeh.documents[0].get_model_by_name('film_slider').value"
    dashboard.get_by_role("button", name="Play").first.click()
    dashboard.wait_for_function(f"() => {moment} > 10")
    before, height = model(dashboard, "film_slider", "value"), column(dashboard, "film_rail", "y")
    dashboard.wait_for_function(f"before => Math.abs({moment} - before) > 20", arg=before)
    assert not np.array_equal(height, column(dashboard, "film_rail", "y"))
    assert dashboard.evaluate("() => window.sent") == 0
    dashboard.get_by_role("button", name="Pause").first.click()
    stands = model(dashboard, "film_slider", "value")
    dashboard.evaluate(NEXT_FRAMES, 30)
    assert model(dashboard, "film_slider", "value") == stands


def test_the_film_is_that_of_the_design_when_it_rests(published_dashboard):
    dashboard = published_dashboard
    look_at(dashboard, "Motion")
    model(dashboard, "film", "name")
    choose(dashboard, "Track of Table 1", "Slab track")
    wait_for_film(dashboard, tig.film(tig.PRESETS["slab-track"]))
    assert np.isnan(column(dashboard, "film_supports", "block")).all()


def test_a_click_or_a_drag_on_the_curve_chooses_the_frequency_of_the_shape(published_dashboard):
    dashboard = published_dashboard
    look_at(dashboard, "Motion")
    model(dashboard, "pick_bands", "name")
    figure = """() => Bokeh.index.find_one(Bokeh.documents[0].get_model_by_name("pick_bands_figure"))"""
    wait_until_drawn(dashboard, "pick_bands_figure")
    dashboard.evaluate(f"() => ({figure})().el.scrollIntoView()")
    x, y = resting_place(dashboard, "pick_bands_figure", 200, 40)
    dashboard.mouse.click(x, y)
    said = dashboard.get_by_text(re.compile(r"At (19\d|20\d) Hz the wheel moves"))
    expect(said).to_be_visible()
    frequency = model(dashboard, "pick", "location")
    assert frequency == pytest.approx(200, rel=0.03)
    shape = tig.steady_shape(OPENING, frequency)
    dashboard.wait_for_function(
        """real => Math.abs(
            Bokeh.documents[0].get_model_by_name("shape_of_wheel").data.real[0] - real) < 1e-9""",
        arg=float(shape.wheel[0].real),
    )
    dashboard.mouse.move(x, y)
    dashboard.mouse.down()
    for step in range(1, 11):
        dashboard.mouse.move(x - 10 * step, y)
    dashboard.mouse.up()
    dragged = model(dashboard, "pick", "location")
    assert dragged < 0.9 * frequency
    shape = tig.steady_shape(OPENING, dragged)
    dashboard.wait_for_function(
        """real => Math.abs(
            Bokeh.documents[0].get_model_by_name("shape_of_wheel").data.real[0] - real) < 1e-9""",
        arg=float(shape.wheel[0].real),
    )
    set_model(dashboard, "shape_slider", "value", 120)
    turned = (shape.rail[:, 0] * np.exp(1j * np.radians(120))).real
    scale = column(dashboard, "shape_facts", "scale")[0]
    moved = -column(dashboard, "shape_rail", "y") / scale
    np.testing.assert_allclose(moved, turned, atol=1e-6 * np.abs(turned).max())


def first_words(markdown):
    """Return the first paragraph of a text as a page shows it."""
    return re.sub(r"[*_]", "", markdown.split("\n\n")[0].replace("\n", " ").strip())


@pytest.mark.parametrize("number", range(len(LESSONS)), ids=[lesson.file for lesson in LESSONS])
def test_a_lesson_runs_and_reveals_what_the_solver_finds(kept_dashboard, number):
    dashboard = kept_dashboard(left=WANDERED)
    lesson = LESSONS[number]
    before, after = lesson.designs()
    revealed = reveal(lesson)
    assert revealed.problems == ()
    look_at(dashboard, "Lessons")
    choose(dashboard, "Lesson", f"{number + 1}. {lesson.title}")
    expect(dashboard.get_by_text(lesson.question)).to_be_visible()
    # what is to be revealed is there with the introduction, once it has been computed
    expect(dashboard.get_by_text(first_words(revealed.introduction))).to_be_visible()
    dashboard.get_by_role("button", name="Reveal").click()
    expect(dashboard.get_by_text("Choose an answer first")).to_be_visible()
    dashboard.get_by_role("button", name="Set where it starts").click()
    wait_for_levels(dashboard, tig.solve(before).insertion_gain)
    dashboard.get_by_role("button", name="Move the slider for me").click()
    wait_for_levels(dashboard, tig.solve(after).insertion_gain)
    wait_for_levels(dashboard, tig.solve(after).insertion_gain, source="lesson")
    np.testing.assert_allclose(column(dashboard, "lesson", "level"), tig.solve(after).insertion_gain)
    dashboard.get_by_role("radio", name=lesson.choices[revealed.right.index(True)].text, exact=True).check()
    dashboard.get_by_role("button", name="Reveal").click()
    expect(dashboard.get_by_text("Right.", exact=True)).to_be_visible()
    # the figures of the text, as computed here for the lesson's own two designs
    expect(dashboard.get_by_text(first_words(revealed.reveal))).to_be_visible()
    for control in dashboard.get_by_role("slider").all():
        if after.two_stage and control.get_attribute("aria-label"):
            expect(control).to_be_enabled()


def test_lessons_leave_the_sliders_to_the_hand(kept_dashboard):
    dashboard = kept_dashboard(left=WANDERED)
    look_at(dashboard, "Lessons")
    choose(dashboard, "Lesson", f"1. {LESSONS[0].title}")
    expect(dashboard.get_by_text(LESSONS[0].question)).to_be_visible()
    dashboard.get_by_role("button", name="Move the slider for me").click()
    expect(box(dashboard, "Boot stiffness, kN/mm")).to_have_value("14")
    field = box(dashboard, "Boot stiffness, kN/mm")
    field.fill("50")
    field.press("Enter")
    wait_for_levels(dashboard, tig.solve(OPENING.replace(boot_stiffness=50e6)).insertion_gain)


@pytest.mark.parametrize(
    ("subject", "words"),
    [
        ("Resonances", "one below"),
        ("Slopes", "The damped lumped model has"),
        ("Damping", "No material can lose energy"),
        ("Definitions", "The two sums are farthest apart"),
        ("Lumped vs beam", "It is within 3 dB of the beam"),
        ("What was left out", "hardly matters"),
    ],
)
@pytest.mark.parametrize("width", [1024, 1920])
def test_every_subject_is_told_within_the_window(kept_dashboard, subject, words, width):
    page = kept_dashboard(width=width, height=768)
    look_at(page, subject)
    expect(page.get_by_text(words)).to_be_visible()
    wait_until_at_rest(page)
    assert page.evaluate("() => document.scrollingElement.scrollWidth") <= width


def test_the_resonances_point_follows_the_slider(dashboard):
    look_at(dashboard, "Resonances")
    model(dashboard, "present", "name")
    field = box(dashboard, "Boot stiffness, kN/mm")
    field.fill("14")
    field.press("Enter")
    natural = tig.solve(OPENING.replace(boot_stiffness=14e6), "exact").natural_frequencies
    dashboard.wait_for_function(
        """expected => {
            const {value, frequency} = Bokeh.documents[0].get_model_by_name("present").data
            return value[0] == 14 && expected.every((each, i) => Math.abs(frequency[i] - each) < 1e-6)
        }""",
        arg=[natural.loaded_track, natural.coupled_block],
    )


def test_the_method_s_equations_are_shown_and_nothing_is_fetched(kept_dashboard):
    """What is requested from elsewhere fails every test that opens a page."""
    dashboard = kept_dashboard(left=WANDERED)
    dashboard.get_by_role("tab", name="Method").click()
    expect(dashboard.get_by_role("heading", name="Glossary")).to_be_attached()
    expect(dashboard.locator("math").first).to_be_visible()
    displayed = dashboard.locator(".katex-display math")
    assert displayed.count() == METHOD.count("\n$$\n") / 2
    assert dashboard.locator("math").count() > 2 * displayed.count(), "symbols within a line are maths too"
    for formulas, least in ((displayed, 30), (dashboard.locator("math"), 5)):
        widths = formulas.evaluate_all("all => all.map(each => each.getBoundingClientRect().width)")
        assert min(widths) > least
    assert dashboard.get_by_text("$$").count() == 0
    # TeX stands there only as the annotation that browsers hide
    raw = dashboard.get_by_text("\\frac").evaluate_all("all => all.map(each => each.localName)")
    assert set(raw) <= {"annotation"}
