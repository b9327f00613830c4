"""The panel of quantities: alone in a blank page, with a server that the test plays, and on the dashboard."""

import itertools
import json

import numpy as np
import pytest
from playwright.sync_api import expect

import trackig_core as tig
from dashboard.client.quantities import SCRIPT
from dashboard.fields import FIELDS
from dashboard.session.inputs import DesignInputs
from dashboard.session.results import Outcome
from dashboard.session.shelf import Shelf
from dashboard.theme import COMPLIES, QUANTITIES_CSS
from dashboard.views.sidebar import Controls
from tests.browser.test_dashboard import box, drag, levels, slider, thumb_of, wait_for_levels
from tests.waiting import WAIT

pytestmark = pytest.mark.browser

BOOT = "Boot stiffness, kN/mm"
MASS = "Block mass, kg"
OPENING = tig.PRESETS["booted-block-low-mass"]

SHOW = """async ([script, css, properties]) => {
    const {render} = await import(URL.createObjectURL(new Blob([script], {type: "text/javascript"})))
    const watchers = {}
    window.sent = []
    window.model = {
        ...properties,
        on: (name, watcher) => { watchers[name] = watcher },
        send_msg: (message) => { window.sent.push(structuredClone(message)) },
        set: (name, value) => { window.model[name] = value; watchers[name]() },
        answer: (number) => watchers["msg:custom"]({kind: "answered", number}),
    }
    const host = document.createElement("div")
    host.style.cssText = `width: 330px; --panel-background-color: white; --panel-on-background-color: black;
        --panel-primary-color: navy`
    document.body.append(host)
    const sheet = document.createElement("style")
    sheet.textContent = css
    host.attachShadow({mode: "open"}).append(sheet, render({model: window.model}))
}"""


PATIENCE = "const PATIENCE = 3000"
"""How long the panel waits for an answer [ms]."""


class Panel:
    """The panel in a page of its own; the test is its server, whose answers it awaits for some time [ms]."""

    def __init__(self, page, patience=1000 * WAIT, **changes):
        self.page, self.inputs = page, DesignInputs()
        self.state = Controls(self.inputs, Outcome(), Shelf()).quantities.state
        groups = Controls(self.inputs, Outcome(), Shelf()).quantities.groups
        properties = {
            "groups": groups,
            "state": self.state,
            "feasible": {},
            "chips": {},
            "catalogue": {},
            **changes,
        }
        script = SCRIPT.read_text(encoding="utf-8")
        assert script.count(PATIENCE) == 1
        # a slow machine may take longer for a drag than the panel waits for an answer
        script = script.replace(PATIENCE, f"const PATIENCE = {patience}")
        page.evaluate(SHOW, [script, QUANTITIES_CSS, properties])

    @property
    def sent(self):
        """What was sent: the values of each message."""
        return self.page.evaluate("() => window.sent.map(message => message.values)")

    @property
    def gestures(self):
        return self.page.evaluate("() => window.sent.map(message => message.gesture)")

    def set(self, name, value):
        self.page.evaluate("([name, value]) => window.model.set(name, value)", [name, value])

    def show(self, number, **changes):
        """Tell the panel the server's state after a message, some values changed."""
        self.state = {**self.state, "number": number, "values": {**self.state["values"], **changes}}
        self.set("state", self.state)

    def answer(self, number):
        self.page.evaluate("number => window.model.answer(number)", number)


@pytest.fixture
def blank(chromium):
    """Return a blank page that complains in the test."""
    page = chromium.new_page(viewport={"width": 400, "height": 900})
    page.set_default_timeout(1000 * WAIT)
    broken = []
    page.on("pageerror", lambda error: broken.append(str(error)))
    yield page
    page.close()
    assert broken == []


def test_the_newest_value_leaves_when_the_answer_to_the_last_has_come(blank):
    panel = Panel(blank)
    drag(blank, BOOT, 20, pause=1)
    assert len(panel.sent) == 1, "at once when idle, and no second before an answer"
    newest = float(slider(blank, BOOT).get_attribute("aria-valuetext"))
    assert box(blank, BOOT).input_value() == f"{newest:g}", "the box follows without the server"
    panel.show(1, **panel.sent[0])
    assert box(blank, BOOT).input_value() == f"{newest:g}", "an older state moves nothing under the hand"
    panel.answer(1)
    assert panel.sent[1:] == [{"boot_stiffness": newest}]
    panel.answer(1)
    blank.mouse.move(*np.add(thumb_of(slider(blank, BOOT)), [30, 0]))
    assert len(panel.sent) == 2, "the answer to an older message frees nothing"
    blank.mouse.up()
    assert len(panel.sent) == 3, "what the hand lets go of leaves at once"
    assert len(set(panel.gestures)) == 1, "a drag is one gesture"


def test_a_lost_answer_stops_nothing_for_long(blank):
    panel = Panel(blank, patience=1000)
    drag(blank, BOOT, 10, pause=1)
    newest = float(slider(blank, BOOT).get_attribute("aria-valuetext"))
    assert panel.sent[0] != {"boot_stiffness": newest}
    blank.wait_for_function("newest => window.sent.at(-1).values.boot_stiffness === newest", arg=newest)


def test_what_the_server_changes_is_shown(blank):
    panel = Panel(blank)
    panel.show(0, boot_stiffness=14.0, block_mass=120.0, rail="49E1", two_stage=False)
    expect(box(blank, BOOT)).to_have_value("14")
    assert slider(blank, BOOT).get_attribute("aria-valuetext") == "14"
    expect(blank.get_by_role("combobox", name="Rail section")).to_have_value("49E1")
    expect(blank.get_by_role("switch")).not_to_be_checked()
    drag(blank, BOOT, 5, pause=1)
    blank.mouse.up()
    # undone before the picture came: the state is as new as the last message
    panel.show(len(panel.sent), boot_stiffness=14.0)
    expect(box(blank, BOOT)).to_have_value("14")


def test_keys_move_by_steps_and_to_the_ends(blank):
    panel = Panel(blank)
    handle = slider(blank, MASS)
    for key, mass in {
        "ArrowUp": 46,
        "ArrowLeft": 45,
        "PageUp": 55,
        "PageDown": 45,
        "Shift+ArrowRight": 55,
        "Home": 10,
        "End": 500,
    }.items():
        handle.press(key)
        assert panel.sent[-1] == {"block_mass": mass}
        assert handle.get_attribute("aria-valuetext") == str(mass)
    # a value that no step meets is left by whole steps
    slider(blank, BOOT).press("PageUp")
    slider(blank, BOOT).press("PageDown")
    assert panel.sent[-1] == {"boot_stiffness": 28}


def test_text_goes_to_the_server_and_advice_is_seen_whole(blank):
    panel = Panel(blank)
    field = box(blank, MASS)
    field.fill("880 kN, or thereabouts")
    field.press("Enter")
    assert panel.sent == [{"block_mass": "880 kN, or thereabouts"}]
    advice = "'880 kN, or thereabouts': " + "a_word_that_does_not_end" * 4
    panel.set("state", {**panel.state, "number": 1, "refused": {"block_mass": advice}})
    words = blank.get_by_text(advice)
    expect(words).to_be_visible()
    assert words.evaluate("e => [e.scrollWidth <= e.clientWidth, e.scrollHeight <= e.clientHeight + 1]") == [
        True,
        True,
    ]
    assert words.bounding_box()["width"] <= 330
    expect(field).to_have_value("880 kN, or thereabouts")
    expect(field).to_have_attribute("aria-invalid", "true")
    assert field.evaluate(
        "e => e.getRootNode().getElementById(e.getAttribute('aria-describedby')).textContent"
    ) == (advice)
    field.press("Escape")
    assert panel.sent[-1] == {"block_mass": "45"}
    expect(words).to_have_count(0)


def test_the_slider_follows_a_plain_number_at_once(blank):
    panel = Panel(blank)
    field = box(blank, BOOT)
    field.fill("123.45")
    field.press("Enter")
    assert slider(blank, BOOT).get_attribute("aria-valuetext") == "123.45"
    assert panel.sent == [{"boot_stiffness": "123.45"}]


def test_where_a_design_complies_is_drawn_and_its_edges_can_be_set(blank):
    panel = Panel(blank)
    panel.set("feasible", {"boot_stiffness": [[2, 8.5], [40, 60]], "block_mass": []})
    edges = blank.get_by_role("button", name="edge of what complies")
    assert edges.all_text_contents() == ["8.5", "40", "60"], "no button where the slider itself ends"
    drawn = blank.locator(".stretch")
    expect(drawn).to_have_count(2)
    colour = "rgb({}, {}, {})".format(*bytes.fromhex(COMPLIES.removeprefix("#")))
    assert drawn.first.evaluate("e => getComputedStyle(e).backgroundColor") == colour
    hatched = blank.locator(".stretches:visible")
    expect(hatched).to_have_count(2)
    assert "repeating-linear-gradient" in hatched.first.evaluate("e => getComputedStyle(e).backgroundImage")
    edge = edges.nth(0).bounding_box()
    boxes = [each.bounding_box() for each in edges.all()]
    for left, right in itertools.pairwise(boxes):
        assert left["x"] + left["width"] <= right["x"], "no button covers another"
    edges.nth(0).click()
    assert panel.sent == [{"boot_stiffness": 8.5}]
    expect(box(blank, BOOT)).to_have_value("8.5")
    across, _ = thumb_of(slider(blank, BOOT))
    assert across == pytest.approx(edge["x"] + edge["width"] / 2, abs=1)
    panel.set("feasible", {})
    expect(drawn).to_have_count(0)
    expect(edges).to_have_count(0)


def test_nothing_moves_when_it_comes_out_where_a_design_complies(blank):
    panel = Panel(blank)
    blank.get_by_text("Advanced", exact=True).click()
    expect(slider(blank, "Contact stiffness, kN/mm")).to_be_visible()
    parts = blank.locator("input:visible, select:visible, summary:visible")
    before = [each.bounding_box() for each in parts.all()]
    numbers = {name: (field.low, field.high) for name, field in FIELDS.items()}
    panel.set("feasible", {name: [[low, (low * high) ** 0.5]] for name, (low, high) in numbers.items()})
    edges = blank.locator(".edge:visible")
    expect(edges).to_have_count(len(FIELDS))
    assert [each.bounding_box() for each in parts.all()] == before
    covered = blank.evaluate(
        """() => [...document.querySelector("div").shadowRoot.querySelectorAll(".edge")].map(edge => {
            const {bottom} = edge.getBoundingClientRect()
            return bottom - edge.closest(".quantity").getBoundingClientRect().bottom
        })"""
    )
    assert max(covered) <= 0, "no edge stands on the number below"


def test_what_the_catalogue_offers_is_said_in_full(blank):
    Panel(blank, catalogue={"pad": ["Soft"]})
    pick = blank.get_by_role("combobox", name="Rail pad: from the catalogue")
    room = pick.evaluate(
        """e => {
            const pen = document.createElement("canvas").getContext("2d")
            const {font, paddingLeft, paddingRight} = getComputedStyle(e)
            pen.font = font
            const words = pen.measureText(e.selectedOptions[0].textContent).width
            return e.clientWidth - parseFloat(paddingLeft) - parseFloat(paddingRight) - words
        }"""
    )
    assert room >= 0


def test_a_chip_stands_for_a_slider(blank):
    panel = Panel(blank, chips={"boot_stiffness": "measured at 4 frequencies"})
    expect(slider(blank, BOOT)).to_have_count(0)
    expect(box(blank, BOOT)).to_have_count(0)
    blank.get_by_role("button", name="Boot stiffness: measured").click()
    assert blank.evaluate("() => window.sent") == [{"kind": "chip", "name": "boot_stiffness"}]
    panel.set("chips", {})
    expect(slider(blank, BOOT)).to_be_visible()


def test_a_value_beyond_its_range_extends_the_slider(blank):
    panel = Panel(blank)
    slider(blank, BOOT).press("End")
    end, _ = thumb_of(slider(blank, BOOT))
    panel.show(1, boot_stiffness=1200.0)
    expect(box(blank, BOOT)).to_have_value("1200")
    assert thumb_of(slider(blank, BOOT))[0] == pytest.approx(end, abs=1)
    slider(blank, BOOT).press("PageDown")
    assert 900 < panel.sent[-1]["boot_stiffness"] < 1000
    panel.show(len(panel.sent), boot_stiffness=100.0)
    slider(blank, BOOT).press("End")
    assert panel.sent[-1] == {"boot_stiffness": 200}


def test_all_can_be_reached_and_is_named(blank):
    Panel(blank)
    for control in blank.locator("input, select, button").all():
        if control.is_visible():
            named = control.evaluate("e => e.ariaLabel ?? e.labels?.[0]?.textContent ?? e.textContent")
            assert named
    expect(slider(blank, "Contact stiffness, kN/mm")).to_be_hidden()
    blank.get_by_text("Advanced", exact=True).click()
    expect(slider(blank, "Contact stiffness, kN/mm")).to_be_visible()
    blank.get_by_role("button", name="About Boot stiffness").click()
    expect(blank.get_by_text("the softer, the lower it isolates")).to_be_visible()


def test_a_drag_sends_no_more_than_is_answered(published_dashboard):
    dashboard = published_dashboard
    dashboard.evaluate(
        """() => {
            window.sets = 0
            window.answers = 0
            const send = WebSocket.prototype.send
            WebSocket.prototype.send = function (data) {
                if (typeof data === "string" && data.includes('"gesture"')) window.sets += 1
                return send.call(this, data)
            }
            const source = Bokeh.documents[0].get_model_by_name("insertion_gain")
            source.properties.data.change.connect(() => { window.answers += 1 })
        }"""
    )
    drag(dashboard, BOOT, 60, pixels=1, pause=5)
    dashboard.mouse.up()
    stiffness = float(slider(dashboard, BOOT).get_attribute("aria-valuetext"))
    wait_for_levels(dashboard, tig.solve(OPENING.replace(boot_stiffness=stiffness * 1e6)).insertion_gain)
    sent, drawn = dashboard.evaluate("() => [window.sets, window.answers]")
    # one at once, one for each picture, one when the hand lets go
    assert 2 <= sent <= drawn + 2


def test_what_is_set_as_soon_as_the_page_appears_counts(reader):
    """Before the page says that it has loaded, the server sends it nothing; nothing may be lost by it."""
    page = reader.open_at_once()
    handle = slider(page, MASS)
    handle.wait_for(state="visible")
    handle.press("End")
    wait_for_levels(page, tig.solve(OPENING.replace(block_mass=500.0)).insertion_gain)
    expect(box(page, MASS)).to_have_value("500")
    expect(page.get_by_text("Modified", exact=True)).to_be_visible()
    page.get_by_role("button", name="Undo (Ctrl+Z)").click()
    expect(box(page, MASS)).to_have_value("45")
    wait_for_levels(page, tig.solve(OPENING).insertion_gain)
    page.close()


def test_nothing_is_pinned_while_a_box_is_wrong(dashboard):
    field = box(dashboard, MASS)
    field.fill("a lot")
    dashboard.get_by_role("button", name="Pin this design").click()
    expect(
        dashboard.get_by_text("Nothing is pinned: what stands in Block mass, kg was not taken")
    ).to_be_visible()
    expect(dashboard.get_by_text("Pinned as")).to_have_count(0)
    field.fill("0,12 t")
    dashboard.get_by_role("button", name="Pin this design").click()
    expect(dashboard.get_by_text("Pinned as").first).to_be_visible()
    expect(field).to_have_value("120")
    wait_for_levels(dashboard, tig.solve(OPENING.replace(block_mass=120.0)).insertion_gain)
    # what was typed last is what was pinned
    dashboard.wait_for_function(
        "() => JSON.parse(sessionStorage.getItem('trackig')).study.includes('pinned')"
    )
    study = tig.Study.from_toml(
        json.loads(dashboard.evaluate("() => sessionStorage.getItem('trackig')"))["study"]
    )
    assert [each.design.block_mass for each in study.pinned] == [120.0]
    np.testing.assert_allclose(levels(dashboard), tig.solve(study.design).insertion_gain, atol=1e-9)
