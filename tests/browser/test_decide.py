"""The tab Decide in the browser, and where a design complies on the sliders, whatever tab is open."""

import numpy as np
import pytest
from playwright.sync_api import expect

import trackig_core as tig
from dashboard.compute.feasibility import shown_stretches
from tests.browser.conftest import wait_until_at_rest, wait_until_drawn
from tests.browser.test_dashboard import OPENING, box, slider
from tests.browser.test_workshop import open_tab

pytestmark = pytest.mark.browser

LIMITS = tig.Specification(
    [(31.5, 15.0), (63, -4.0), (125, -6.0), (250, -14.0)], rail_deflection_limit=2.5e-3
)

PANEL = """() => [...Bokeh.documents[0]._all_models.values()].find(
    model => model.data?.properties?.feasible !== undefined).data"""


def paste(page, specification=LIMITS):
    """Paste a specification, and wait until it is taken."""
    open_tab(page, "Specification")
    page.get_by_role("textbox", name="Paste").fill(specification.to_csv().replace(",", "\t"))
    page.get_by_role("button", name="Take what is pasted").click()
    expect(page.get_by_role("textbox", name="Limit, dB, 63 Hz")).to_have_value("-4")


def expected_stretches(design, specification):
    found = tig.decide.feasible_ranges(design, specification)
    return {name: [list(each) for each in shown_stretches(found, name)] for name in found}


def wait_for_stretches(page, design, specification):
    """Wait until the sliders show where a design complies, none of it of an earlier design."""
    page.wait_for_function(
        f"""expected => {{
            const {{feasible, stale}} = ({PANEL})()
            return !stale && Object.entries(expected).every(
                ([name, stretches]) => JSON.stringify(feasible[name]) === JSON.stringify(stretches))
        }}""",
        arg=expected_stretches(design, specification),
    )


def opened_specification(page):
    """Return the specification of the page's own study."""
    page.wait_for_function(
        "() => JSON.parse(sessionStorage.getItem('trackig'))?.study.includes('specification')"
    )
    study = page.evaluate("() => JSON.parse(sessionStorage.getItem('trackig')).study")
    return tig.Study.from_toml(study).specification


@pytest.fixture
def limited(kept_dashboard):
    """Return a function that gives the page of a size that tests share which change its design at most."""

    def limited(width=1440, height=900):
        page = kept_dashboard(width, height, left="with the limits pasted")
        paste(page)
        back = page.get_by_role("button", name="Back to Table 1")
        if back.is_enabled():
            back.click()
        expect(back).to_be_disabled()
        return page

    return limited


def test_sliders_show_where_the_design_complies_in_every_tab(limited):
    page = limited()
    limits = opened_specification(page)
    wait_for_stretches(page, OPENING, limits)
    open_tab(page, "Explore")
    slider(page, "Block mass, kg").press("PageUp")
    heavier = OPENING.replace(block_mass=55.0)
    wait_for_stretches(page, heavier, limits)
    # the edge is a number to be taken, and what it gives complies
    edge = page.get_by_role("button", name="Set Boot stiffness to").first
    stiffness = float(edge.text_content())
    edge.click()
    expect(box(page, "Boot stiffness, kN/mm")).to_have_value(f"{stiffness:g}")
    taken = heavier.replace(boot_stiffness=stiffness * 1e6)
    assert tig.decide.Requirements(limits).complies(tig.solve_many([taken]))[0]
    wait_for_stretches(page, taken, limits)
    page.get_by_role("button", name="Undo (Ctrl+Z)").click()
    wait_for_stretches(page, heavier, limits)


PARTS = ("How far?", "What matters?", "How sure?", "Which tolerance?", "Which one?", "Kept answers")


@pytest.mark.parametrize(("width", "height"), [(1440, 900), (1024, 768)])
def test_all_parts_appear_when_the_tab_is_opened_by_click(limited, width, height):
    page = limited(width, height)
    open_tab(page, "Decide")
    for title in PARTS:
        expect(page.get_by_role("heading", name=title, exact=True)).to_be_visible()
    expect(page.get_by_text("The design fails")).to_be_visible()
    page.wait_for_function("() => Bokeh.documents[0].get_model_by_name('changes')?.data.change.length > 0")
    drawn = np.array(
        page.evaluate("() => Array.from(Bokeh.documents[0].get_model_by_name('changes').data.change)")
    )
    assert np.abs(drawn).max() > 0.5
    wait_until_at_rest(page)
    expect(page.get_by_text("then press “How sure?”")).to_be_visible()
    for name in ("change_figure", "tornado_figure", "percentile_figure"):
        if name == "percentile_figure":
            page.get_by_role("button", name="How sure?", exact=True).click()
        wait_until_drawn(page, name)
        wait_until_at_rest(page)
        size = page.evaluate(
            """name => {
                const view = Bokeh.index.find_one(Bokeh.documents[0].get_model_by_name(name))
                const {width, height} = view.el.getBoundingClientRect()
                return [width, height, view.frame.bbox.width]
            }""",
            name,
        )
        assert min(size) > 200, name
    # nothing is wider than the window
    assert page.evaluate("() => document.scrollingElement.scrollWidth <= innerWidth")


def test_a_map_is_drawn_kept_and_listed(open_dashboard):
    page = open_dashboard(query="?tab=decide")
    for title in PARTS:
        expect(page.get_by_role("heading", name=title, exact=True)).to_be_visible()
    paste(page)
    open_tab(page, "Decide")
    page.get_by_role("button", name="Draw the map").click()
    expect(page.get_by_text("of the designs over boot stiffness and block mass comply")).to_be_visible()
    wait_until_drawn(page, "map_figure")
    page.get_by_role("button", name="Keep the answer").last.click()
    expect(page.get_by_role("heading", name="Which designs comply over two numbers?")).to_be_visible()
    page.get_by_role("button", name="Ask again").click()
    expect(page.get_by_text("The same figures came out, to the last bit.")).to_be_visible()


def test_a_box_drawn_by_mouse_brushes_all_pictures_of_a_search(limited):
    page = limited()
    open_tab(page, "Decide")
    page.get_by_role("tab", name="Search", exact=True).click()
    page.get_by_role("button", name="Find designs").click()
    expect(page.get_by_text("and no other beats")).to_be_visible()
    # a search that grows draws its pictures anew
    expect(page.get_by_role("button", name="Stop", exact=True)).to_have_count(0)
    take = page.get_by_role("button", name="Take to the sliders")
    expect(take).to_be_disabled()
    wait_until_drawn(page, "objectives_figure")
    wait_until_at_rest(page)
    frame = page.evaluate(
        """() => {
            const plot = Bokeh.documents[0].get_model_by_name("objectives_figure")
            const view = Bokeh.index.find_one(plot)
            view.el.scrollIntoView({block: "center"})
            const {x, y} = view.canvas_view.el.getBoundingClientRect()
            const {left, top, width, height} = view.frame.bbox
            plot.toolbar.active_drag = plot.toolbar.tools.find(tool => tool.type == "BoxSelectTool")
            return [x + left, y + top, width, height]
        }"""
    )
    left, top, width, height = frame
    page.mouse.move(left + 2, top + height / 2)
    page.mouse.down()
    page.mouse.move(left + width / 4, top + 0.8 * height, steps=5)
    page.mouse.move(left + width / 2, top + height - 2, steps=5)
    page.mouse.up()
    # what is in the box is selected in the pictures of objectives and fields alike, and drawn in the third
    page.wait_for_function("() => Bokeh.documents[0].get_model_by_name('found').selected.indices.length > 0")
    expect(take).to_be_enabled()
    page.wait_for_function("() => Bokeh.documents[0].is_idle")
    wrong, inside, curves = page.evaluate(
        """() => {
            const byName = name => Bokeh.documents[0].get_model_by_name(name)
            const found = byName("found"), plot = byName("objectives_figure"), {x, y} = found.data
            const middle = (plot.x_range.start + plot.x_range.end) / 2
            const half = (plot.y_range.start + plot.y_range.end) / 2
            const wrong = found.selected.indices.filter(row => x[row] > middle || y[row] > half)
            const shared = byName("fields_figure").renderers.some(each => each.data_source == found)
            const {length} = byName("found_gains").data.xs
            return [wrong.length + !shared, found.selected.indices.length, length]
        }"""
    )
    assert wrong == 0
    assert 0 < curves <= inside


def test_numbers_of_the_ground_are_offered_and_answered(open_dashboard):
    page = open_dashboard(query="?ground=rock")
    open_tab(page, "Decide")
    for title in PARTS:
        expect(page.get_by_role("heading", name=title, exact=True)).to_be_visible()
    offered = page.get_by_label("Across").locator("option")
    expect(offered.filter(has_text="Ground stiffness")).to_have_count(1)
    page.wait_for_function("() => Bokeh.documents[0].get_model_by_name('changes')?.data.change.length > 0")
    wait_until_at_rest(page)
    page.get_by_role("checkbox", name="A change for each field").click()
    share = page.get_by_label("Ground stiffness, ± %").first
    expect(share).to_have_value("10")
    # boxes that come push others aside and are drawn anew, which loses what is typed meanwhile
    wait_until_at_rest(page)
    share.fill("20")
    share.press("Enter")
    design = OPENING.replace(ground=tig.GROUNDS["rock"])
    changes = dict.fromkeys(tig.decide.sensitivity(design, reference="stiff").fields, 0.1)
    expected = tig.decide.sensitivity(design, changes=changes | {"ground.stiffness": 0.2}, reference="stiff")
    row = expected.bands[expected.fields.index("ground.stiffness"), 1]
    page.wait_for_function(
        """expected => {
            const {field, change} = Bokeh.documents[0].get_model_by_name("changes").data
            const drawn = Array.from(change).filter((_, place) => field[place] == "Ground stiffness *")
            return drawn.length == expected.length
                && drawn.every((each, band) => Math.abs(each - expected[band]) < 1e-6)
        }""",
        arg=row.tolist(),
    )
