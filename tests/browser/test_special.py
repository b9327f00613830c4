"""What no slider shows, in the browser: a test house's table, a rail of one's own, a catalogue, a study."""

from pathlib import Path

import pytest
from playwright.sync_api import expect

import trackig_core as tig
from tests.browser.conftest import wait_until_at_rest
from tests.browser.test_dashboard import box, shown, slider, wait_for_levels
from tests.browser.test_workshop import open_file, open_tab

pytestmark = pytest.mark.browser

DATA = Path(__file__).parent.parent / "data"
PAD = (DATA / "measured_stiffness" / "pad_1_to_30_hz.csv").read_bytes()
FINITE_ELEMENT = (DATA / "measured_stiffness" / "finite_element_pad.csv").read_bytes()
CATALOGUE = (DATA / "company_catalogue.toml").read_bytes()
OPENING = tig.PRESETS["booted-block-low-mass"]

GROW_ABOVE = """(part, height) => {
  const up = (each) => each.assignedSlot ?? each.parentElement ?? each.getRootNode().host
  const scrolls = (each) => /auto|scroll/.test(getComputedStyle(each).overflowY)
  let box = part
  while (!scrolls(box) || box.scrollHeight === box.clientHeight) box = up(box)
  box.style.overflowAnchor = "none"
  box.firstElementChild.style.marginTop = height
}"""
"""A script that makes room of a height above a part of the page, which pushes it down as far."""


@pytest.fixture
def dashboard(kept_dashboard):
    """Return a page that the tests of this module share, as the one before left it."""
    return kept_dashboard(left="with what no slider shows")


def chip(page, label):
    return page.get_by_role("button", name=f"{label}: measured")


def test_a_table_becomes_the_pad_and_the_slider_comes_back(dashboard):
    open_tab(dashboard, "Track")
    open_file(dashboard, "Open table", "pad.csv", PAD)
    expect(dashboard.get_by_text("Bands from 31.5 Hz on rest on extrapolation")).to_be_visible()
    dashboard.get_by_role("button", name="Use for the pad").click()
    expect(chip(dashboard, "Pad stiffness")).to_have_text("measured at 3 frequencies, 1 to 30 Hz")
    expect(slider(dashboard, "Pad stiffness, kN/mm")).to_be_hidden()
    open_tab(dashboard, "Explore")
    expect(dashboard.get_by_text("beyond what was measured of this design")).to_be_visible()
    expect(dashboard.get_by_role("status").filter(has_text="rest on extrapolation").first).to_be_visible()
    chip(dashboard, "Pad stiffness").click()
    expect(dashboard.get_by_role("tab", name="Track")).to_have_attribute("aria-selected", "true")
    remove = dashboard.get_by_role("button", name="Remove from the pad")
    expect(remove).to_be_in_viewport()
    # what stands above may be drawn later, and must not push it out of sight again
    dashboard.get_by_role("button", name="Open table").evaluate(GROW_ABOVE, "3000px")
    expect(remove).to_be_in_viewport()
    remove.click()
    dashboard.get_by_role("button", name="Open table").evaluate(GROW_ABOVE, "0px")
    expect(slider(dashboard, "Pad stiffness, kN/mm")).to_be_visible()
    assert shown(dashboard, "Pad stiffness, kN/mm") == 100


def test_a_table_with_the_wrong_unit_is_asked_about_before_it_can_be_used(dashboard):
    open_tab(dashboard, "Track")
    open_file(dashboard, "Open table", "pad.csv", b"# preload: 30 kN\n" + FINITE_ELEMENT)
    expect(dashboard.get_by_text("are the figures in N/m?")).to_be_visible()
    use = dashboard.get_by_role("button", name="Use for the pad")
    expect(use).to_be_disabled()
    wait_until_at_rest(dashboard)
    dashboard.get_by_role("combobox", name="Unit of stiffness").select_option("N/m")
    expect(dashboard.get_by_text("Stiffness in N/m, as chosen.")).to_be_visible()
    expect(use).to_be_enabled()
    use.click()
    expect(chip(dashboard, "Pad stiffness")).to_have_text(
        "measured at 200 frequencies, 199.5 to 3162 Hz, preload 30 kN"
    )
    expect(dashboard.get_by_text("Bands up to 160 Hz rest on extrapolation (")).to_be_visible()


def test_a_loss_factor_beyond_the_slider_is_typed_solved_and_its_fit_told(published_dashboard):
    dashboard = published_dashboard
    box(dashboard, "Boot loss factor").fill("2.5")
    box(dashboard, "Boot loss factor").press("Enter")
    expect(dashboard.get_by_text("give 0.01 to 2", exact=True)).to_be_visible()
    box(dashboard, "Boot loss factor").fill("1.8")
    box(dashboard, "Boot loss factor").press("Enter")
    wait_for_levels(dashboard, tig.solve(OPENING.replace(boot_loss_factor=1.8)).insertion_gain)
    expect(slider(dashboard, "Boot loss factor")).to_have_attribute("aria-valuetext", "1.8")
    status = dashboard.get_by_role("status").filter(has_text="one of second order is used")
    expect(status.first).to_be_visible()
    open_tab(dashboard, "Verify")
    expect(dashboard.get_by_text("Three relaxation terms keep the loss factor within 4.9%")).to_be_visible()


def test_a_study_beyond_the_sliders_opens_and_a_hand_takes_over(dashboard):
    rail = tig.Rail("worn", 58.0, 6e6)
    study = tig.Study(OPENING.replace(boot_stiffness=300e6, rail=rail))
    open_tab(dashboard, "Save & share")
    open_file(dashboard, "Open study", "odd.toml", study.to_toml().encode())
    expect(box(dashboard, "Boot stiffness, kN/mm")).to_have_value("300")
    handle = slider(dashboard, "Boot stiffness, kN/mm")
    assert handle.evaluate("handle => handle.valueAsNumber >= Number(handle.max) - 1e-6")
    choice = dashboard.get_by_role("combobox", name="Rail section")
    expect(choice).to_have_value("own")
    assert choice.evaluate("each => each.selectedOptions[0].textContent") == "worn: 58 kg/m, 6 MN m²"
    expect(box(dashboard, "Rail mass, kg/m")).to_have_value("58")
    choice.select_option("49E1")
    expect(box(dashboard, "Rail mass, kg/m")).to_be_hidden()
    dashboard.get_by_role("button", name="Undo").click()
    expect(box(dashboard, "Rail mass, kg/m")).to_have_value("58")
    handle.press("ArrowLeft")
    expect(box(dashboard, "Boot stiffness, kN/mm")).to_have_value("293")


def test_a_catalogue_is_chosen_from_and_remembered(dashboard, open_dashboard):
    open_tab(dashboard, "Track")
    open_file(dashboard, "Open catalogue", "ours.toml", CATALOGUE)
    expect(dashboard.get_by_text("this browser remembers it")).to_be_visible()
    pads = dashboard.get_by_role("combobox", name="Rail pad: from the catalogue")
    expect(pads.get_by_role("option", name="<b>Soft</b>")).to_have_count(1)
    pads.select_option("<b>Soft</b>")
    expect(box(dashboard, "Pad stiffness, kN/mm")).to_have_value("3000")
    later = open_dashboard()
    again = later.get_by_role("combobox", name="Rail pad: from the catalogue")
    expect(again.get_by_role("option", name="<b>Soft</b>")).to_have_count(1)
    open_tab(later, "Track")
    later.get_by_role("button", name="Back to the bundled one").click()
    expect(again.get_by_role("option", name="<b>Soft</b>")).to_have_count(0)
