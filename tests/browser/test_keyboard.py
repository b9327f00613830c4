"""The page without a mouse: all of it is reached by keys, operated by keys, and has a name."""

import re

import pytest
from playwright.sync_api import expect

from dashboard.views.learn import EXPLAINING
from tests.browser.conftest import WANDERED, wait_until_at_rest, wait_until_drawn, wait_until_solved
from tests.browser.test_decide import LIMITS
from tests.browser.test_workshop import open_tab

pytestmark = pytest.mark.browser

MOST_STOPS = 250
"""Stops of the Tab key that a part of the page may be away [-]."""

LAST_PARTS = {
    "Explore": "Natural frequencies and standing load",
    "Compare": "Measured insertion gain",
    "Specification": "Rail deflection",
    "Decide": "Kept answers",
    "Received level": "Source",
    "Track": "Catalogue",
    "Learn": "Lessons",
    "Verify": "What the assumptions cost this design",
    "Method": "Glossary",
    "Save & share": "Pictures",
}
"""What each tab shows last while it is made."""

MOST_SHOWN = 40
"""Stops that are told where a part is not reached [-]."""

FOCUSED = """() => {
    let found = document.activeElement
    while (found?.shadowRoot?.activeElement) found = found.shadowRoot.activeElement
    return found
}"""


class Told:
    """What assistive software is told of a page.

    Parameters
    ----------
    page : playwright.sync_api.Page
        The page.
    """

    def __init__(self, page):
        self._session = page.context.new_cdp_session(page)

    def focus(self):
        """Return role and name of what has the keyboard's focus."""
        found = self._session.send("Runtime.evaluate", {"expression": f"({FOCUSED})()"})
        asked = {"objectId": found["result"]["objectId"], "fetchRelatives": False}
        (node,) = self._session.send("Accessibility.getPartialAXTree", asked)["nodes"]
        return _role_and_name(node)

    def nameless(self):
        """Return HTML of what takes the focus and has no name."""
        nodes = self._session.send("Accessibility.getFullAXTree")["nodes"]
        return [self._html(node) for node in nodes if _is_focusable(node) and not _role_and_name(node)[1]]

    def _html(self, node):
        asked = {"backendNodeId": node["backendDOMNodeId"]}
        return self._session.send("DOM.getOuterHTML", asked)["outerHTML"][:300]


def _role_and_name(node):
    # Material puts a space without width before a button's words
    return tuple(node.get(key, {}).get("value", "").strip(" \u200b") for key in ("role", "name"))


def _is_focusable(node):
    return any(
        each["name"] == "focusable" and each["value"].get("value") for each in node.get("properties", [])
    )


def go(page, name, role=None, key="Tab"):
    """Press a key until what is called so, and is of a role, has the focus; return its name."""
    told, passed = Told(page), []
    for _ in range(MOST_STOPS):
        page.keyboard.press(key)
        passed.append(told.focus())
        if re.search(name, passed[-1][1]) and role in (None, passed[-1][0]):
            return passed[-1][1]
    raise AssertionError(f"{name} is not reached with {key}, but {passed[-MOST_SHOWN:]}")


def answer(page, words):
    """Wait for an answer that can be read aloud."""
    page.get_by_role("status").filter(has_text=re.compile(words)).first.wait_for()


def go_to_tab(page, name, key):
    """Open a tab of the page by keys."""
    go(page, "^(Explore|Specification|Decide|Map)$", "tab", key)
    go(page, f"^{name}$", "tab", "ArrowRight")
    page.keyboard.press("Enter")


def is_open(summary):
    """Return whether a group is unfolded, by its summary."""
    return summary.locator("xpath=..").get_attribute("open") is not None


def test_all_four_questions_are_asked_by_keys_alone(open_dashboard):
    page = open_dashboard()
    go_to_tab(page, "Specification", "Tab")
    go(page, "^Paste", "textbox")
    page.keyboard.insert_text(LIMITS.to_csv().replace(",", "\t"))
    go(page, "Take what is pasted")
    page.keyboard.press("Enter")
    expect(page.get_by_role("textbox", name="Limit, dB, 63 Hz")).to_have_value("-4")
    go_to_tab(page, "Decide", "Shift+Tab")
    expect(page.get_by_role("heading", name="Kept answers", exact=True)).to_be_visible()

    # how far, what matters
    answer(page, "^The design fails")
    go(page, "^Change, ± %", "textbox")
    page.keyboard.press("Control+A")
    page.keyboard.type("20")
    page.keyboard.press("Enter")
    answer(page, "20 % less changes it by")

    # how sure, and of how many
    go(page, "^Samples", "combobox")
    page.keyboard.press("ArrowUp")
    go(page, "^How sure.$", "button")
    page.keyboard.press("Enter")
    answer(page, "compl.*of production|complies")
    go(page, "^Which tolerance.$", "button")
    page.keyboard.press("Enter")
    answer(page, "of the scatter of the governing margin is due to")

    # which one: on the map
    go(page, "^Draw the map$", "button")
    page.keyboard.press("Enter")
    answer(page, "of the designs over boot stiffness and block mass comply")
    wait_until_drawn(page, "map_figure")
    assert "Enter takes the design" in go(page, "over Boot stiffness and Block mass", "application")
    page.keyboard.press("Shift+ArrowRight")
    page.keyboard.press("ArrowUp")
    answer(page, "^Boot stiffness .* governing margin .* dB")
    page.keyboard.press("Enter")
    stiffness = page.get_by_role("textbox", name="Boot stiffness, kN/mm: type a number")
    expect(stiffness).not_to_have_value("28")

    # or by a search
    go_to_tab(page, "Search", "Shift+Tab")
    go(page, "^Pad stiffness$", "checkbox")
    page.keyboard.press("Space")
    go(page, "^Find designs$", "button")
    page.keyboard.press("Enter")
    answer(page, "and no other beats")
    expect(page.get_by_role("button", name="Stop", exact=True)).to_have_count(0)
    wait_until_drawn(page, "objectives_figure")
    go(page, "^Designs by their objectives", "application")
    page.keyboard.press("ArrowRight")
    answer(page, "^Governing margin .*boot stiffness")
    before = stiffness.input_value()
    page.keyboard.press("Enter")
    expect(stiffness).not_to_have_value(before)
    go(page, "^Name it$", "textbox", "Shift+Tab")
    page.keyboard.press("Control+A")
    page.keyboard.type("By keys")
    go(page, "^Pin$", "button")
    page.keyboard.press("Enter")
    expect(page.get_by_text("Pinned as “By keys”").first).to_be_visible()
    assert Told(page).nameless() == []


def test_tools_of_a_figure_are_reached_by_keys(untouched_dashboard):
    page = untouched_dashboard
    wait_until_drawn(page, "insertion_gain_figure")
    go(page, "^Insertion gain per", "group")
    go(page, "^Save$", "button")
    # it asks for the file's name
    page.once("dialog", lambda dialog: dialog.accept("picture"))
    with page.expect_download() as saved:
        page.keyboard.press("Enter")
    assert saved.value.suggested_filename.startswith("picture")


def test_the_status_line_keeps_the_focus_when_it_says_something_new(dashboard):
    mass = dashboard.get_by_role("textbox", name="Block mass, kg: type a number")
    mass.fill("103.7")
    mass.press("Enter")
    status = dashboard.get_by_role("status", name="Status")
    expect(status).to_contain_text("Paper's run, solved in")
    status.focus()
    dashboard.keyboard.press("Control+z")
    expect(mass).to_have_value("45")
    expect(status).to_contain_text("solved before")
    expect(status).to_be_focused()


def test_a_reload_keeps_what_is_there_and_says_that_it_forgets_the_steps(dashboard):
    undo = dashboard.get_by_role(
        "button",
        name="Undo (Ctrl+Z). Loading the page anew keeps all that a study holds, and what",
    )
    mass = dashboard.get_by_role("textbox", name="Block mass, kg: type a number")
    mass.fill("107")
    mass.press("Enter")
    expect(undo).to_be_enabled()
    open_tab(dashboard, "Specification")
    dashboard.get_by_role("textbox", name="Paste a table").fill("63\t-4")
    dashboard.get_by_role("button", name="Take what is pasted").click()
    limit = dashboard.get_by_role("textbox", name="Limit, dB, 63 Hz")
    expect(limit).to_have_value("-4")
    open_tab(dashboard, "Decide")
    tolerance = dashboard.get_by_role("textbox", name="Block mass, ± %").last
    tolerance.fill("3,5")
    tolerance.press("Enter")
    dashboard.wait_for_function(
        """() => {
            const {study, query, typed} = JSON.parse(sessionStorage.getItem("trackig"))
            return study.includes("[specification]") && query.includes("block_mass=107&") &&
                query.includes("tab=decide") && typed.includes("3,5")
        }"""
    )
    dashboard.reload()
    wait_until_solved(dashboard)
    expect(mass).to_have_value("107")
    expect(tolerance).to_have_value("3,5")
    open_tab(dashboard, "Specification")
    expect(limit).to_have_value("-4")
    expect(undo).to_be_disabled()


def test_whatever_takes_the_focus_has_a_name(kept_dashboard):
    page = kept_dashboard(left=WANDERED)
    told = Told(page)
    sidebar = page.get_by_role("navigation")
    folded = [each for each in sidebar.locator("summary").all() if not is_open(each)]
    assert folded
    for group in folded:
        group.click()
    for tab, last in LAST_PARTS.items():
        open_tab(page, tab)
        expect(page.get_by_role("heading", name=last, exact=True)).to_be_visible()
        wait_until_at_rest(page)
        assert told.nameless() == [], tab
    open_tab(page, "Learn")
    for subject in EXPLAINING:
        open_tab(page, subject.title)
        expect(page.get_by_role("tab", name=subject.title)).to_have_attribute("aria-selected", "true")
        expect(page.locator("h2:visible").first).to_be_visible()
        wait_until_at_rest(page)
        assert told.nameless() == [], subject.title
    for group in folded:
        group.click()
