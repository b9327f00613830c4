"""Comparing in the served dashboard: pins, names, differences, undo, Table 1 in one click, looks."""

import numpy as np
import pytest
from playwright.sync_api import expect

import trackig_core as tig
from tests.browser.conftest import hover_until_shown, wait_until_at_rest, wait_until_solved
from tests.browser.test_dashboard import (
    MARKUP,
    OPENING,
    box,
    choose,
    column,
    drag,
    slider,
    wait_for_levels,
)

pytestmark = pytest.mark.browser


def tab(page, name):
    page.get_by_role("tab", name=name).click()


def type_into(page, label, number):
    field = box(page, label)
    field.fill(number)
    field.press("Enter")


def pin(page, name=""):
    page.get_by_role("textbox", name="Name of the design to be pinned").fill(name)
    page.get_by_role("button", name="Pin this design").click()


def wait_until_listed(page, figure, names):
    page.wait_for_function(
        """([figure, names]) => {
            const legend = Bokeh.documents[0].get_model_by_name(`${figure}_legend`)
            const listed = [...Bokeh.index.find_one(legend).shadow_el.querySelectorAll("li")]
                .map(item => item.textContent)
            return JSON.stringify(listed) == JSON.stringify(names)
        }""",
        arg=[figure, names],
    )


def test_two_designs_are_pinned_renamed_hidden_and_compared(dashboard):
    pin(dashboard, "soft")
    wait_until_listed(dashboard, "insertion_gain_figure", ["this design", "soft"])
    type_into(dashboard, "Boot stiffness, kN/mm", "60")
    stiff = tig.solve(OPENING.replace(boot_stiffness=60e6)).insertion_gain
    wait_for_levels(dashboard, stiff)
    pin(dashboard, MARKUP)
    wait_until_listed(dashboard, "insertion_gain_figure", ["this design", "as in Table 1", "soft", MARKUP])
    wait_until_listed(dashboard, "force_figure", ["all supports", "support under the wheel", "soft", MARKUP])
    np.testing.assert_allclose(column(dashboard, "pins", "pin_1"), stiff, atol=1e-9)
    # where the pointer rests on a band, names are told as text, too
    told = dashboard.locator(".bk-Tooltip").get_by_text(MARKUP)  # the legend names it as well
    hover_until_shown(dashboard, "insertion_gain_figure", 100, told)

    tab(dashboard, "Compare")
    expect(dashboard.get_by_role("columnheader", name=MARKUP)).to_be_visible()
    choose(dashboard, "Differences from", "soft")
    soft = tig.solve(OPENING).insertion_gain
    dashboard.wait_for_function(
        """level => Math.abs(
            Bokeh.documents[0].get_model_by_name("pin_differences").data.pin_0[11] - level) < 1e-6""",
        arg=float((stiff - soft)[11]),
    )
    names = dashboard.get_by_role("textbox", name="Name of the design", exact=True)
    names.nth(1).fill("stiff")
    names.nth(1).press("Enter")
    wait_until_listed(dashboard, "pin_difference_figure", ["this design", "stiff"])
    expect(dashboard.get_by_role("columnheader", name="stiff")).to_be_visible()
    dashboard.get_by_role("checkbox", name="Show").nth(1).click()
    wait_until_listed(dashboard, "insertion_gain_figure", ["this design", "as in Table 1", "soft"])
    expect(dashboard.get_by_role("columnheader", name="stiff")).to_have_count(0)
    dashboard.get_by_role("button", name="Use").first.click()
    wait_for_levels(dashboard, soft)


def test_a_drag_is_undone_by_one_key_press_and_redone_by_another(dashboard):
    drag(dashboard, "Block mass, kg", 20)
    dashboard.mouse.up()
    expect(box(dashboard, "Block mass, kg")).not_to_have_value("45")
    handle = slider(dashboard, "Block mass, kg")
    handle.focus()
    dashboard.wait_for_function("() => Bokeh.documents[0].is_idle")
    expect(dashboard.get_by_text("paper's run", exact=True)).to_be_visible()
    mass = box(dashboard, "Block mass, kg").input_value()
    dashboard.keyboard.press("Control+z")
    wait_for_levels(dashboard, tig.solve(OPENING).insertion_gain)
    expect(box(dashboard, "Block mass, kg")).to_have_value("45")
    expect(dashboard.get_by_role("button", name="Undo (Ctrl+Z)")).to_be_disabled()
    dashboard.keyboard.press("Control+Shift+Z")
    expect(box(dashboard, "Block mass, kg")).to_have_value(mass)


def test_undo_keys_are_left_to_a_box_in_which_somebody_types(published_dashboard):
    dashboard = published_dashboard
    type_into(dashboard, "Block mass, kg", "100")
    wait_for_levels(dashboard, tig.solve(OPENING.replace(block_mass=100.0)).insertion_gain)
    name = dashboard.get_by_role("textbox", name="Name of the design to be pinned")
    name.focus()
    dashboard.keyboard.type("soft")
    dashboard.keyboard.press("Control+z")
    expect(name).not_to_have_value("soft")
    # had the keys undone anything, nothing would be left to undo, and this button disabled
    dashboard.get_by_role("button", name="Undo (Ctrl+Z)").click()
    expect(box(dashboard, "Block mass, kg")).to_have_value("45")
    wait_for_levels(dashboard, tig.solve(OPENING).insertion_gain)
    dashboard.get_by_role("button", name="Redo").click()
    expect(box(dashboard, "Block mass, kg")).to_have_value("100")


def test_one_click_draws_the_papers_figure_2(dashboard):
    tab(dashboard, "Compare")
    dashboard.get_by_role("button", name="Paper's Figure 2").click()
    names = ["Slab track", "Booted sleeper", "Booted block, low mass", "Booted block, high mass"]
    wait_until_listed(dashboard, "insertion_gain_figure", names)
    for place, design in enumerate(tig.PRESETS.values()):
        expected = tig.solve(design).insertion_gain
        np.testing.assert_allclose(column(dashboard, "pins", f"pin_{place}"), expected, atol=1e-9)
    expect(dashboard.get_by_role("tab", name="Explore")).to_have_attribute("aria-selected", "true")
    dashboard.get_by_role("button", name="Show this design").click()
    wait_until_listed(dashboard, "insertion_gain_figure", ["this design", *names])


def test_the_drawing_follows_a_drag(published_dashboard):
    dashboard = published_dashboard

    def drawn(words):
        return dashboard.locator(f"svg tspan:text-is('{words}')")

    tab(dashboard, "Track")
    expect(drawn("45 kg")).to_be_visible()
    drag(dashboard, "Block mass, kg", 20)
    expect(drawn("45 kg")).to_have_count(0)
    dashboard.mouse.up()
    mass = slider(dashboard, "Block mass, kg").get_attribute("aria-valuetext")
    expect(drawn(f"{mass} kg")).to_be_visible()


def test_the_theme_survives_a_reload(published_dashboard):
    dashboard = published_dashboard
    paper = "() => Bokeh.documents[0].get_model_by_name('insertion_gain_figure').background_fill_color"
    light = dashboard.evaluate(paper)
    dashboard.get_by_label("Toggle theme").click()
    dashboard.wait_for_function(f"() => ({paper})() == '#121212'")
    dashboard.reload()
    dashboard.wait_for_function(
        f"() => window.Bokeh?.documents?.[0]?.get_model_by_name('force_figure') && ({paper})() == '#121212'"
    )
    wait_until_solved(dashboard)
    dashboard.get_by_label("Toggle theme").click()
    dashboard.wait_for_function(f"light => ({paper})() == light", arg=light)


@pytest.mark.parametrize(("width", "least"), [(1024, 14), (1440, 16), (1920, 16)])
def test_axes_are_legible_in_both_themes(kept_dashboard, width, least):
    page = kept_dashboard(width, 768)
    sizes = """() => ["insertion_gain_figure", "force_figure"]
        .map(name => Bokeh.documents[0].get_model_by_name(name))
        .flatMap(figure => [...figure.left, ...figure.below])
        .flatMap(axis => [axis.major_label_text_font_size, axis.axis_label_text_font_size])"""
    background = "Bokeh.documents[0].get_model_by_name('insertion_gain_figure').background_fill_color"
    for _ in range(2):
        before = page.evaluate(f"() => {background}")
        page.wait_for_function(
            f"least => ({sizes})().every(size => size.endsWith('px') && parseFloat(size) >= least)", arg=least
        )
        page.get_by_label("Toggle theme").click()
        page.wait_for_function(f"before => {background} != before", arg=before)


def test_figures_and_buttons_have_names(untouched_dashboard):
    dashboard = untouched_dashboard
    for name in ("Insertion gain per one-third-octave band", "Force into the ground over time"):
        expect(dashboard.get_by_role("figure", name=name)).to_be_visible()
    dashboard.get_by_text("Advanced", exact=True).click()
    expect(slider(dashboard, "Contact stiffness, kN/mm")).to_be_visible()
    dashboard.get_by_text("Advanced", exact=True).click()
    expect(slider(dashboard, "Contact stiffness, kN/mm")).to_be_hidden()


@pytest.mark.parametrize("width", [1024, 1440])
def test_no_tab_is_wider_than_the_window(kept_dashboard, width):
    page = kept_dashboard(width, 768)
    for pinned in (False, True):
        for name in ("Compare", "Track", "Explore"):
            tab(page, name)
            expect(page.get_by_role("tab", name=name)).to_have_attribute("aria-selected", "true")
            wait_until_at_rest(page)
            assert page.evaluate("() => document.scrollingElement.scrollWidth") <= width
        for figure in ("insertion_gain_figure", "force_figure"):
            right = page.evaluate(
                """name => Bokeh.index.find_one(Bokeh.documents[0].get_model_by_name(name))
                    .el.getBoundingClientRect().right""",
                figure,
            )
            assert right <= width
        if not pinned:
            tab(page, "Compare")
            page.get_by_role("button", name="Pin Table 1").click()
            expect(page.get_by_role("columnheader", name="Booted sleeper")).to_be_visible()
