"""A workshop in the browser: compare, hold against a specification, keep, share, come back."""

import csv
import datetime
import itertools
import re
from urllib.parse import parse_qs, urlsplit

import numpy as np
import pytest
from playwright.sync_api import expect

import trackig_core as tig
from tests.browser.conftest import wait_until_solved
from tests.browser.test_dashboard import MARKUP, box, drag, wait_for_levels
from tests.waiting import WAIT

pytestmark = pytest.mark.browser

SPECIFICATION = tig.Specification([(31.5, 12.0), (63, 2.0), (160, 0.0)])


def open_tab(page, name):
    page.get_by_role("tab", name=name, exact=True).click()


def pin(page, name):
    page.get_by_role("textbox", name="Name of the design to be pinned").fill(name)
    page.get_by_role("button", name="Pin this design").click()
    expect(page.get_by_text(f"Pinned as “{name}”").first).to_be_visible()


def open_file(page, button, name, data):
    with page.expect_file_chooser() as chooser:
        page.get_by_role("button", name=button).click()
    chooser.value.set_files({"name": name, "mimeType": "text/plain", "buffer": data})


def download(page, button):
    """Press a button and return the name and the bytes of the file that it saves."""
    with page.expect_download() as saved:
        page.get_by_role("button", name=button, exact=True).click()
    return saved.value.suggested_filename, saved.value.path().read_bytes()


def pages(page, document):
    """Return on how many pages of paper an HTML file prints."""
    printed = page.context.new_page()
    printed.set_content(document.decode())
    sheet = printed.pdf(prefer_css_page_size=True)
    printed.close()
    return len(re.findall(rb"/Type\s*/Page\b", sheet))


def link(page):
    """Return the arguments of the address bar."""
    return parse_qs(urlsplit(page.url).query)


def wait_for_link(page, **values):
    page.wait_for_function(
        """values => {
            const given = new URLSearchParams(location.search)
            return Object.entries(values).every(([key, value]) => given.get(key) === value)
        }""",
        arg=values,
    )


def verdict_lines(page):
    return page.get_by_role("list").get_by_role("listitem")


def expect_verdicts(page, told):
    """Wait for the words on each design; exact curves may stand in for runs to come."""
    expect(verdict_lines(page)).to_contain_text([*told.values()])
    assert verdicts(page) == told


def verdicts(page):
    """Return the words on each design, by its name."""
    lines = verdict_lines(page)
    return dict(re.split(r"\s*[✓✗]\s*", line, maxsplit=1) for line in lines.all_text_contents())


def test_a_whole_workshop(open_dashboard):
    page = open_dashboard()
    # choose, drag, pin two
    page.get_by_role("combobox", name="Track of Table 1", exact=True).select_option("Booted sleeper")
    sleeper = tig.PRESETS["booted-sleeper"]
    wait_for_levels(page, tig.solve(sleeper).insertion_gain)
    pin(page, "As published")
    drag(page, "Boot stiffness, kN/mm", 15)
    page.mouse.up()
    # what the thumb shows is known to the browser before the server hears of it
    stiffness = float(
        page.get_by_role("slider", name="Boot stiffness, kN/mm").get_attribute("aria-valuetext")
    )
    expect(box(page, "Boot stiffness, kN/mm")).to_have_value(f"{stiffness:g}")
    stiffer = sleeper.replace(boot_stiffness=stiffness * 1e6)
    wait_for_levels(page, tig.solve(stiffer).insertion_gain)
    pin(page, MARKUP)
    box(page, "Unsprung wheel mass, kg").fill("700")
    box(page, "Unsprung wheel mass, kg").press("Enter")
    lighter = stiffer.replace(wheel_mass=700)
    wait_for_levels(page, tig.solve(lighter).insertion_gain)
    designs = {"This design": lighter, "As published": sleeper, MARKUP: stiffer}
    solutions = {name: tig.solve(design) for name, design in designs.items()}

    # load a specification, read the verdict
    open_tab(page, "Specification")
    open_file(page, "Open CSV", "wrong.csv", b"frequency_hz,ig_max_db\n63,low\n")
    expect(page.get_by_role("alert").get_by_text("line 2, column 2")).to_be_visible()
    open_file(page, "Open CSV", "limits.csv", SPECIFICATION.to_csv().encode())
    expect(page.get_by_role("textbox", name="Limit, dB, 63 Hz")).to_have_value("2")
    # no limit is below zero: what they are has to be said before there is a verdict
    expect(page.get_by_text("No verdict yet. Answer first")).to_be_visible()
    expect(page.get_by_role("listitem")).to_have_count(0)
    page.get_by_role("button", name="Keep as insertion gain").click()
    told = {name: str(SPECIFICATION.check(each.insertion_gain)) for name, each in solutions.items()}
    expect_verdicts(page, told)
    page.wait_for_function("() => Bokeh.documents[0].get_model_by_name('limit') !== null")
    limit = page.evaluate("() => Array.from(Bokeh.documents[0].get_model_by_name('limit').data.limit)")
    np.testing.assert_array_equal(np.array(limit, dtype=float), SPECIFICATION.levels)

    # single number
    open_tab(page, "Received level")
    source = tig.SourceSpectrum([(31.5, 60.0), (63, 70.5)])
    page.get_by_role("textbox", name="Paste").fill(source.to_csv().replace(",", "\t"))
    page.get_by_role("button", name="Take what is pasted").click()
    level = source.with_track(solutions["This design"].insertion_gain)
    expect(page.get_by_role("row", name=re.compile("^This design"))).to_contain_text(
        f"{level.a_weighted:.1f}"
    )

    # save
    open_tab(page, "Save & share")
    page.get_by_role("textbox", name="Name of the study").fill("Tunnel 7")
    page.get_by_role("textbox", name="Name of the study").press("Enter")
    name, study_file = download(page, "Save study")
    # the name is sent before the button's press
    assert name == "trackig-tunnel-7.toml"
    study = tig.Study.from_toml(study_file)
    assert (study.design, study.specification, study.source) == (lighter, SPECIFICATION, source)
    assert [each.name for each in study.pinned] == ["As published", MARKUP]

    check_exports(page, solutions)

    # reload from the link, in a browser that remembers nothing
    wait_for_link(page, wheel_mass="700", tab="keep")
    other = open_dashboard(query="?" + urlsplit(page.url).query)
    expect(other.get_by_role("tab", name="Save & share")).to_have_attribute("aria-selected", "true")
    open_tab(other, "Explore")
    wait_for_levels(other, solutions["This design"].insertion_gain)
    assert len(link(other)["pin"]) == 2

    # open the saved file
    another = open_dashboard()
    open_tab(another, "Save & share")
    open_file(another, "Open study", "wrong.toml", study_file.replace(b"wheel_mass_kg = 700", b"x = 1"))
    expect(another.get_by_text("Not opened, nothing has changed")).to_be_visible()
    open_file(another, "Open study", "study.toml", study_file)
    expect(another.get_by_role("textbox", name="Name of the study")).to_have_value("Tunnel 7")
    wait_for_levels(another, solutions["This design"].insertion_gain)
    open_tab(another, "Specification")
    expect_verdicts(another, told)


def table(data):
    """Return comments, header and rows of a CSV file."""
    lines = data.decode().splitlines()
    comments = [line for line in lines if line.startswith("#")]
    header, *rows = csv.reader(lines[len(comments) :])
    return comments, header, rows


def check_exports(page, solutions):
    """Download each export and hold it against the library."""
    name, data = download(page, "Insertion gain, CSV")
    assert name == "trackig-tunnel-7-booted-sleeper-modified-gain.csv"
    comments, header, rows = table(data)
    assert comments[0] == "# study: Tunnel 7"
    assert header[1:] == [f"insertion_gain_db {each}" for each in solutions]
    gains = np.array(rows, dtype=float).T
    for column, solution in zip(gains[1:], solutions.values(), strict=True):
        np.testing.assert_allclose(column, solution.insertion_gain, atol=5.1e-5)

    name, data = download(page, "Force, CSV")
    assert name == "trackig-tunnel-7-booted-sleeper-modified-force.csv"
    _, header, rows = table(data)
    hand = np.array([row[:2] for row in rows], dtype=float).T
    np.testing.assert_allclose(hand[0], solutions["This design"].time, atol=1e-9)
    np.testing.assert_allclose(hand[1], solutions["This design"].total_force / 1000, rtol=5.1e-5, atol=1e-9)

    for button, start in (
        ("Insertion gain, PNG", b"\x89PNG\r\n"),
        ("Difference, PNG", b"\x89PNG\r\n"),
        ("Force, PNG", b"\x89PNG\r\n"),
        ("Insertion gain, SVG", b"<?xml "),
        ("Difference, SVG", b"<?xml "),
        ("Force, SVG", b"<?xml "),
    ):
        name, data = download(page, button)
        assert name.startswith("trackig-tunnel-7-booted-sleeper-modified-")
        assert name.endswith(button[-3:].lower())
        assert data.startswith(start)
        assert len(data) > 10_000
        assert MARKUP.encode() not in data

    name, data = download(page, "Data sheet, HTML")
    assert name == "trackig-tunnel-7-booted-sleeper-modified-data-sheet.html"
    assert b"Booted sleeper, modified" in data
    assert pages(page, data) == 1

    name, data = download(page, "Report, HTML")
    assert name == "trackig-tunnel-7-report.html"
    report = data.decode()
    today = datetime.date.today()
    for words in ("Tunnel 7", "As published", f"{today.day} {today:%B %Y}", tig.__version__):
        assert words in report
    assert MARKUP not in report


def test_the_link_is_copied(dashboard):
    dashboard.context.grant_permissions(["clipboard-read", "clipboard-write"])
    field = box(dashboard, "Block mass, kg")
    field.fill("120")
    field.press("Enter")
    wait_for_link(dashboard, block_mass="120")
    dashboard.get_by_role("button", name="Copy link").first.click()
    expect(dashboard.get_by_text("The link is copied").first).to_be_visible()
    assert dashboard.evaluate("() => navigator.clipboard.readText()") == dashboard.url
    assert dashboard.evaluate("() => history.length") == 2, "changes do not fill the history"
    dashboard.evaluate(
        """() => {
            window.copies = []
            const {clipboard} = navigator
            const write = clipboard.writeText.bind(clipboard)
            clipboard.writeText = text => { window.copies.push(text); return write(text) }
        }"""
    )
    # a change that the address bar has not followed yet is in the link once that is said to be copied
    dashboard.get_by_role("tab", name="Compare", exact=True).click()
    dashboard.get_by_role("button", name="Copy link").first.click()
    dashboard.wait_for_function("() => window.copies.at(-1)?.includes('tab=compare')")
    assert dashboard.evaluate("() => window.copies.length") <= 2


@pytest.mark.usefixtures("open_dashboard")
def test_a_hostile_link_opens_what_it_can_and_tells_the_rest(reader):
    query = (
        f"?pad_stiffness={'9' * 5000}&boot_stiffness=1e999&block_mass=77&rail=../../etc/passwd"
        f"&tab={MARKUP}&{MARKUP}=1&pin={MARKUP}&theme={MARKUP}"
    )
    page = reader.open_at_once(query=query.replace("<", "%3C").replace(">", "%3E").replace(" ", "%20"))
    expect(page.get_by_text("Pad stiffness is no number; it stays at 100 kN/mm.")).to_be_visible()
    opening = tig.PRESETS["booted-block-low-mass"]
    wait_for_levels(page, tig.solve(opening.replace(block_mass=77)).insertion_gain)
    wait_for_link(page, boot_stiffness="28", pad_stiffness="100", tab="explore")
    assert "passwd" not in page.url


def test_a_restarted_server_loses_nothing(chromium, serve, port, tmp_path):
    logs = (tmp_path / f"log{number}.txt" for number in itertools.count())
    context = chromium.new_context(viewport={"width": 1440, "height": 900})
    page = context.new_page()
    page.set_default_timeout(1000 * WAIT)
    broken = []
    page.on("pageerror", lambda error: broken.append(str(error)))
    try:
        with serve(port, next(logs)) as url:
            page.goto(url)
            wait_until_solved(page)
            field = box(page, "Block mass, kg")
            field.fill("120")
            field.press("Enter")
            pin(page, "Heavier")
            open_tab(page, "Specification")
            limit = page.get_by_role("textbox", name="Limit, dB, 63 Hz")
            limit.fill("-3")
            limit.press("Enter")
            expect(page.get_by_role("listitem")).to_have_count(2)
            wait_for_link(page, block_mass="120", tab="specification")
            page.wait_for_function("() => sessionStorage.getItem('trackig').includes('ig_max_dB')")
            wait_until_solved(page)
            before, told = page.url, verdicts(page)
            page.evaluate("() => { window.old = true }")
        expect(page.get_by_text("The connection to the server is lost")).to_be_visible()
        with serve(port, next(logs)):
            page.wait_for_function("() => window.old === undefined")
            expect(page.get_by_role("textbox", name="Limit, dB, 63 Hz")).to_have_value("-3")
            expect_verdicts(page, told)
            wait_until_solved(page)
            assert page.url == before
            open_tab(page, "Explore")
            heavier = tig.PRESETS["booted-block-low-mass"].replace(block_mass=120)
            wait_for_levels(page, tig.solve(heavier).insertion_gain)
    finally:
        context.close()
    assert broken == []
