"""What a small window leaves to the pictures: legends, tabs and words make way for the data."""

import datetime

import pytest
from playwright.sync_api import expect

import trackig_core as tig
from dashboard.report.data_sheet import data_sheet
from dashboard.session.bands import gain_in
from dashboard.session.heading import Heading
from dashboard.session.results import DesignResult, SolutionSummary
from dashboard.theme import AXIS_SIZES, MOST_PINNED, TICK_SIZES
from tests.browser.conftest import SOLVED, wait_until_at_rest
from tests.browser.test_keyboard import LAST_PARTS
from tests.browser.test_workshop import open_file, open_tab, pages
from trackig_core.names import LONGEST_NAME, LONGEST_TITLE

pytestmark = pytest.mark.browser

LONG = f"{'Extraordinarily long name of a design':<{LONGEST_NAME - 1}}"

STUDY = tig.Study(
    tig.PRESETS["booted-block-low-mass"],
    [
        tig.PinnedDesign(f"{LONG}{place}", design, place)
        for place, design in enumerate((*tig.PRESETS.values(), *tig.PRESETS.values()))
    ],
    tig.Specification([(31.5, 3.0), (63, 0.0), (125, -12.0)], rail_deflection_limit=1.5e-3),
    source=tig.SourceSpectrum([(31.5, 60.0), (63, 70.0)]),
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


def test_long_names_of_pins_are_in_sight_and_short_ones_keep_to_one_line(small):
    open_tab(small, "Compare")
    boxes = small.get_by_role("textbox", name="Name of the design", exact=True)
    expect(boxes).to_have_count(MOST_PINNED)
    wait_until_at_rest(small)
    widest = "boxes => Math.max(...boxes.map(each => each.scrollWidth - each.clientWidth))"
    assert boxes.evaluate_all(widest) <= 0
    removes = small.get_by_role("button", name="Remove")
    box, remove = boxes.first.bounding_box(), removes.first.bounding_box()
    assert remove["y"] >= box["y"] + box["height"]
    assert remove["x"] + remove["width"] <= 1024
    name = boxes.first.input_value()
    boxes.first.fill("Short")
    box, remove = boxes.first.bounding_box(), removes.first.bounding_box()
    assert remove["y"] < box["y"] + box["height"]
    boxes.first.fill(name)


@pytest.mark.parametrize(
    ("tab", "heading"), [("Received level", "Level, dB(A)"), ("Specification", "Deflection")]
)
def test_figures_of_eight_long_names_fit_into_the_window(small, tab, heading):
    open_tab(small, tab)
    table = small.get_by_role("table").filter(has=small.get_by_role("columnheader", name=heading, exact=True))
    expect(table.get_by_role("row", name=LONG.strip())).to_have_count(MOST_PINNED)
    if tab == "Received level":
        small.get_by_role("combobox", name="Difference from").select_option(label=f"{LONG}0")
        expect(table.get_by_role("columnheader", name=f"re {LONG}0, dB(A)")).to_be_visible()
    wait_until_at_rest(small)
    assert table.evaluate("each => each.getBoundingClientRect().right") <= 1024
    row = table.get_by_role("rowheader").last
    row_box, name, swatch = (each.bounding_box() for each in (row, row.locator(".name"), row.locator("svg")))
    assert row_box["width"] > 200
    assert swatch["x"] + swatch["width"] <= name["x"]
    assert row_box["y"] <= swatch["y"] < row_box["y"] + 24


def test_all_tabs_are_in_sight(small):
    boxes = [tab.bounding_box() for tab in small.get_by_role("tab").all()]
    assert len(boxes) >= len(LAST_PARTS)
    for box in boxes:
        assert 0 <= box["x"] <= box["x"] + box["width"] <= 1024


WIDE = """() => {
    const wide = []
    const walk = root => root.querySelectorAll("*").forEach(each => {
        if (each.shadowRoot) walk(each.shadowRoot)
        const sideways = each.matches(".main-content") && each.scrollWidth > each.clientWidth
        const hidden = each.matches("button, input, select, textarea, h2, p, li")
            && each.getBoundingClientRect().right > innerWidth + 1
        if (sideways || hidden) wide.push(each.outerHTML.slice(0, 80))
    })
    walk(document)
    return wide
}"""


@pytest.mark.parametrize("tab", ["Explore", "Compare", "Specification", "Received level", "Save & share"])
def test_no_tab_scrolls_sideways(small, tab):
    open_tab(small, tab)
    expect(small.get_by_role("heading", level=2).filter(visible=True).first).to_be_visible()
    wait_until_at_rest(small)
    assert small.evaluate(WIDE) == []


def test_choices_beside_a_heading_leave_it_its_line(small):
    open_tab(small, "Explore")
    heading = small.get_by_role("heading", name="Insertion gain", exact=True).filter(visible=True)
    expect(heading).to_be_visible()
    chip = small.get_by_text("paper's run", exact=True)
    expect(chip).to_be_visible()
    wait_until_at_rest(small)
    words, beside = heading.bounding_box(), chip.bounding_box()
    assert words["height"] < 40
    assert words["x"] + words["width"] <= beside["x"]
    for name in ("Bands shown", "Over the supports", "Against"):
        box = small.get_by_role("combobox", name=name).bounding_box()
        is_beside = beside["x"] + beside["width"] <= box["x"]
        assert is_beside or words["y"] + words["height"] <= box["y"]
        assert box["x"] + box["width"] <= 1024


def test_long_verdicts_leave_room_for_names(small):
    open_tab(small, "Specification")
    names = small.get_by_role("listitem").locator(".name")
    expect(names).to_have_count(MOST_PINNED + 1)
    wait_until_at_rest(small)
    boxes = [name.bounding_box() for name in names.all()]
    assert min(box["width"] for box in boxes) > 150
    assert max(box["height"] for box in boxes) < 100


def test_arrows_that_a_narrower_window_needed_hide_no_tab_of_a_wider_one(small):
    arrows, tabs = small.locator(".MuiTabs-scrollButtons"), small.get_by_role("tab")
    small.set_viewport_size({"width": 800, "height": 768})
    expect(arrows.first).to_be_visible()
    small.set_viewport_size({"width": 1024, "height": 768})
    expect(arrows.first).to_be_hidden()
    wait_until_at_rest(small)
    assert tabs.first.bounding_box()["x"] >= small.locator(".MuiTabs-scroller").first.bounding_box()["x"]


TEXT_SIZES = """name => {
    const axes = Bokeh.documents[0].get_model_by_name(name).below
    return axes.map(axis => [axis.major_label_text_font_size, axis.axis_label_text_font_size]).flat()
}"""


def test_text_of_axes_follows_a_window_that_is_resized(small):
    open_tab(small, "Explore")
    for width, place in ((1024, 0), (1440, 1), (1024, 0)):
        small.set_viewport_size({"width": width, "height": 768})
        small.wait_for_function(
            f"([name, sizes]) => String(({TEXT_SIZES})(name)) === sizes",
            arg=["insertion_gain_figure", f"{TICK_SIZES[place]},{AXIS_SIZES[place]}"],
        )
    small.get_by_label("Toggle theme").click()
    wait_until_at_rest(small)
    assert small.evaluate(TEXT_SIZES, "insertion_gain_figure") == [TICK_SIZES[0], AXIS_SIZES[0]]
    small.get_by_label("Toggle theme").click()
    wait_until_at_rest(small)


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
    # ink and paper change in two steps
    small.wait_for_function(f"words => ({CONTRAST})(words) >= 4.5", arg=verdict.element_handle())
    small.get_by_label("Toggle theme").click()
    expect(verdict).to_have_css("color", before)


def test_figures_in_narrow_cells_are_turned(small):
    open_tab(small, "Learn")
    open_tab(small, "What was left out")
    expect(small.get_by_text("hardly matters")).to_be_visible()
    look = "() => Bokeh.documents[0].get_model_by_name('left_out_cells_figure').renderers[1].glyph.angle"
    small.wait_for_function(f"() => Math.abs(({look})().value - Math.PI / 2) < 1e-9")


TITLE = f"{'The extraordinarily long title of whatever may have one':<{LONGEST_TITLE - 1}}"
EVERYTHING = tig.PRESETS["booted-block-low-mass"].replace(
    pad_stiffness=tig.StiffnessCurve([(1, 90e6, 0.1), (10, 95e6, 0.12), (30, 110e6, 0.2)]),
    pad_loss_factor=None,
    boot_stiffness=tig.StiffnessCurve([(1, 15e6, 0.1), (20, 18e6, 0.12), (40, 21e6, 0.2)]),
    boot_loss_factor=None,
    rail=tig.Rail(f"{LONG}9", 60.2123, 6.41234e6),
    pad_static_stiffness=80e6,
    boot_static_stiffness=12e6,
    stiffness_frequency=20.0,
    suspension=tig.Suspension(1.23456e6, 34.5678e3, 1234.56, 0.234567e6, 12.3456e3, 7654.32),
    axle_positions=(0.0, 2.4, 7.0, 9.4, 14.0, 16.4, 21.0, 23.4),
    speed=22.3,
    ground=tig.Ground(123.456e6, 456.789e3, 234.567),
)


@pytest.mark.parametrize("bands", ["one-third-octave", "wide one-third-octave"])
def test_a_data_sheet_with_everything_on_prints_on_one_page(chromium, bands):
    every = list(map(float, tig.BAND_LABELS))
    measured = [
        tig.MeasuredGain([(band, -100.0) for band in every], name=f"{TITLE}{number}") for number in range(4)
    ]
    study = tig.Study(
        EVERYTHING,
        [tig.PinnedDesign(f"{LONG}9", EVERYTHING, 0)],
        tig.Specification([(band, -30.0) for band in every], f"{TITLE}9", rail_deflection_limit=1.5e-3),
        view=tig.View(reference="stiff", bands=bands),
        source=tig.SourceSpectrum([(band, 60.0) for band in every], f"{TITLE}9"),
        measured=measured,
        name=f"{TITLE}9",
    )
    summary = SolutionSummary.of(tig.solve(EVERYTHING, "exact"), 1.0)
    gain = summary.solution.gain_for("stiff", "energy")
    statics = tig.study.StaticLoad(wheelbase=2.4).response(EVERYTHING)
    result = DesignResult(
        study.pinned[0],
        summary,
        gain,
        study.specification.check(gain.levels, statics.rail_deflection),
        study.source.with_track(gain.levels),
        statics,
        gain_in(bands, summary.solution, "stiff", "energy"),
    )
    heading = Heading.of(study, [result], datetime.date(2026, 9, 30))
    sheet = data_sheet(result, heading, study.specification, study.source, measured)
    assert len(result.summary.solution.notes) > 1
    page = chromium.new_context().new_page()
    assert pages(page, sheet.encode()) == 1
    page.set_content(sheet)
    page.emulate_media(media="print")
    page.set_viewport_size({"width": 688, "height": 1032})
    too_wide = "cells => cells.filter(each => each.scrollWidth > each.clientWidth + 1).length"
    assert page.locator("th, td").evaluate_all(too_wide) == 0
    page.close()


def test_a_status_that_is_cut_unfolds_with_the_focus(small):
    open_tab(small, "Explore")
    status = small.get_by_role("status").filter(has_text=SOLVED).first
    expect(status).to_be_visible()
    status.evaluate("line => { line.textContent = 'Long words. '.repeat(60) }")
    line = small.get_by_text("Long words.").first
    assert line.evaluate("line => line.scrollWidth > line.clientWidth")
    line.focus()
    assert line.evaluate("line => line.scrollWidth <= line.clientWidth && line.clientHeight > 40")
    # its last line covers the tabs, and nothing covers it
    on_top = """line => {
        const {left, bottom} = line.getBoundingClientRect()
        return line.getRootNode().elementFromPoint(left + 2, bottom - 6) === line
    }"""
    assert line.evaluate(on_top)
    line.blur()
    assert line.evaluate("line => line.clientHeight <= 32")
