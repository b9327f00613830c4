"""What a small window leaves to the pictures: legends, tabs and words make way for the data."""

import pytest
from playwright.sync_api import expect

import trackig_core as tig
from dashboard.theme import MOST_PINNED
from tests.browser.conftest import wait_until_at_rest
from tests.browser.test_workshop import open_file, open_tab
from trackig_core.names import LONGEST_NAME

pytestmark = pytest.mark.browser

LONG = f"{'Extraordinarily long name of a design':<{LONGEST_NAME - 1}}"

STUDY = tig.Study(
    tig.PRESETS["booted-block-low-mass"],
    [
        tig.PinnedDesign(f"{LONG}{place}", design, place)
        for place, design in enumerate((*tig.PRESETS.values(), *tig.PRESETS.values()))
    ],
    tig.Specification([(31.5, 3.0), (63, 0.0), (125, -12.0)]),
)

BOXES = """name => {
    const view = Bokeh.index.find_one(Bokeh.documents[0].get_model_by_name(name))
    const legend = Bokeh.index.find_one(Bokeh.documents[0].get_model_by_name(`${name}_legend`))
    const figure = view.el.getBoundingClientRect(), words = legend.el.getBoundingClientRect()
    return [view.frame.bbox.height / figure.height, figure.bottom, words.top, words.right]
}"""


@pytest.fixture(scope="module")
def small(reader):
    """Return a small page with as many designs as can be pinned, under the longest names."""
    page = reader.open(width=1024, height=768)
    open_tab(page, "Save & share")
    open_file(page, "Open study", "study.toml", STUDY.to_toml().encode())
    expect(page.get_by_text("The study is open.")).to_be_visible()
    yield page
    page.close()
    reader.check()


@pytest.mark.parametrize(
    ("tab", "figure"),
    [("Explore", "insertion_gain_figure"), ("Explore", "force_figure"), ("Compare", "compared_gain_figure")],
)
def test_eight_long_names_leave_two_thirds_of_a_figure_to_the_data(small, tab, figure):
    open_tab(small, tab)
    small.wait_for_function(
        """([figure, count]) => {
            const legend = Bokeh.documents[0].get_model_by_name(`${figure}_legend`)
            const view = legend && Bokeh.index.find_one(legend)
            return view && view.shadow_el.querySelectorAll("li").length > count
        }""",
        arg=[figure, MOST_PINNED],
    )
    wait_until_at_rest(small)
    part, bottom, top, right = small.evaluate(BOXES, figure)
    assert part >= 2 / 3
    assert bottom <= top + 1
    assert right <= 1024


def test_all_tabs_are_in_sight_and_none_scrolls_sideways(small):
    for tab in small.get_by_role("tab").all():
        box = tab.bounding_box()
        assert 0 <= box["x"] <= box["x"] + box["width"] <= 1024
    open_tab(small, "Save & share")
    wait_until_at_rest(small)
    wide = """() => {
        const wide = []
        const walk = root => root.querySelectorAll("*").forEach(each => {
            if (each.shadowRoot) walk(each.shadowRoot)
            if (each.getBoundingClientRect().right > innerWidth + 1) wide.push(each.outerHTML.slice(0, 80))
        })
        walk(document)
        return wide
    }"""
    assert small.evaluate(wide) == []


def test_arrows_that_a_narrower_window_needed_hide_no_tab_of_a_wider_one(small):
    arrows, tabs = small.locator(".MuiTabs-scrollButtons"), small.get_by_role("tab")
    small.set_viewport_size({"width": 800, "height": 768})
    expect(arrows.first).to_be_visible()
    small.set_viewport_size({"width": 1024, "height": 768})
    expect(arrows.first).to_be_hidden()
    wait_until_at_rest(small)
    assert tabs.first.bounding_box()["x"] >= small.locator(".MuiTabs-scroller").first.bounding_box()["x"]


def test_formulas_are_set_and_none_has_a_scroll_bar(small):
    open_tab(small, "Method")
    formulas = """() => {
        const found = []
        const walk = root => root.querySelectorAll("*").forEach(each => {
            if (each.shadowRoot) walk(each.shadowRoot)
            if (each.classList.contains("katex-display"))
                found.push([each.scrollWidth - each.clientWidth, each.scrollHeight - each.clientHeight])
        })
        walk(document)
        return found
    }"""
    small.wait_for_function(f"() => ({formulas})().length > 10")
    wait_until_at_rest(small)
    assert all(across <= 0 and down <= 2 for across, down in small.evaluate(formulas))


CONTRAST = """words => {
    const light = colour => {
        const figures = colour.match(/[\\d.]+/g).slice(0, 3).map(Number)
        const [r, g, b] = figures
            .map(each => colour.startsWith("rgb") ? each / 255 : each)
            .map(each => each <= 0.04045 ? each / 12.92 : ((each + 0.055) / 1.055) ** 2.4)
        return 0.2126 * r + 0.7152 * g + 0.0722 * b + 0.05
    }
    const paper = light(getComputedStyle(document.querySelector(".main, main, body")).backgroundColor)
    const ink = light(getComputedStyle(words).color)
    return Math.max(paper, ink) / Math.min(paper, ink)
}"""


def test_words_of_a_verdict_are_legible_in_both_themes(small):
    open_tab(small, "Specification")
    verdict = small.get_by_role("listitem").locator(".fails").first
    expect(verdict).to_be_visible()
    assert verdict.evaluate(CONTRAST) >= 4.5
    before = verdict.evaluate("words => getComputedStyle(words).color")
    small.get_by_label("Toggle theme").click()
    expect(verdict).not_to_have_css("color", before)
    wait_until_at_rest(small)
    assert verdict.evaluate(CONTRAST) >= 4.5
    small.get_by_label("Toggle theme").click()
    expect(verdict).to_have_css("color", before)


def test_figures_in_narrow_cells_are_turned(small):
    open_tab(small, "Learn")
    open_tab(small, "What was left out")
    expect(small.get_by_text("hardly matters")).to_be_visible()
    look = "() => Bokeh.documents[0].get_model_by_name('left_out_cells_figure').renderers[1].glyph.angle"
    small.wait_for_function(f"() => Math.abs(({look})().value - Math.PI / 2) < 1e-9")
