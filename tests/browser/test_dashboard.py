"""The served dashboard, driven as a user drives it; what is drawn is compared with the library."""

import re

import numpy as np
import pytest
from playwright.sync_api import expect

import trackig_core as tig
from tests.browser.conftest import (
    hover_until_shown,
    wait_for_levels,
    wait_until_at_rest,
    wait_until_drawn,
    wait_until_solved,
)

pytestmark = pytest.mark.browser

OPENING = tig.PRESETS["booted-block-low-mass"]

MARKUP = "<img src=x onerror=console.error(1)>"
"""Complains in the console if it is ever taken for markup."""

STEPS_PER_DECADE = 100
"""Positions of a logarithmic slider."""


def column(page, source, name):
    """Read a column of a data source in the browser."""
    values = page.evaluate(
        "([source, name]) => Array.from(Bokeh.documents[0].get_model_by_name(source).data[name])",
        [source, name],
    )
    return np.array(values, dtype=float)


def levels(page):
    return column(page, "insertion_gain", "level")


def slider(page, label):
    return page.get_by_role("slider", name=label)


def choose(page, label, option):
    page.get_by_role("combobox", name=label, exact=True).select_option(option)


def box(page, label):
    return page.get_by_role("textbox", name=f"{label}: type a number")


def shown(page, label):
    """Read an input's value from its box."""
    return float(box(page, label).input_value())


def test_it_opens_on_the_low_mass_block_already_solved(untouched_dashboard):
    dashboard = untouched_dashboard
    solution = tig.solve(OPENING)
    np.testing.assert_allclose(levels(dashboard), solution.insertion_gain, atol=1e-9)
    at = np.searchsorted(solution.time, column(dashboard, "force", "time") - 1e-6)
    expected = solution.total_force[at] / 1000
    np.testing.assert_allclose(
        column(dashboard, "force", "total"), expected, atol=1e-6 * np.abs(expected).max()
    )
    natural = solution.natural_frequencies
    expect(dashboard.get_by_text(f"{natural.loaded_track:.1f} Hz", exact=True)).to_be_visible()
    expect(dashboard.get_by_text(f"{natural.coupled_block:.0f} Hz", exact=True)).to_be_visible()
    line = dashboard.evaluate("() => Bokeh.documents[0].get_model_by_name('loaded_track').location")
    assert line == pytest.approx(natural.loaded_track)
    expect(dashboard.get_by_role("status")).to_contain_text("olved")


def test_a_key_press_on_a_slider_changes_the_insertion_gain(published_dashboard):
    dashboard = published_dashboard
    handle = slider(dashboard, "Boot stiffness, kN/mm")
    assert handle.get_attribute("aria-valuetext") == "28"
    handle.focus()
    handle.press("PageUp")
    expect(box(dashboard, "Boot stiffness, kN/mm")).not_to_have_value("28")
    stiffness = shown(dashboard, "Boot stiffness, kN/mm")
    assert 30 < stiffness < 40
    assert handle.get_attribute("aria-valuetext") == f"{stiffness:g}"
    wait_for_levels(dashboard, tig.solve(OPENING.replace(boot_stiffness=stiffness * 1e6)).insertion_gain)
    expect(dashboard.get_by_text("Modified", exact=True)).to_be_visible()


WATCH = """() => {
    const source = Bokeh.documents[0].get_model_by_name("insertion_gain")
    window.frames_drawn = []
    window.labels_drawn = []
    source.properties.data.change.connect(() => {
        window.frames_drawn.push(Array.from(source.data.level))
        // of the frame before
        const labels = [...Bokeh.documents[0]._all_models.values()].map(model => model.data?.label)
        window.labels_drawn.push(...labels.filter(label => typeof label == "string"))
    })
}"""
"""Has a page note each curve that it draws, and what stood beside its title until then."""


def thumb_of(handle):
    """Return where a slider's thumb is."""
    handle.scroll_into_view_if_needed()
    return handle.evaluate(
        """input => {
            const {x, y, width, height} = input.getBoundingClientRect(), thumb = 14
            const share = input.valueAsNumber / input.max
            return [x + thumb / 2 + share * (width - thumb), y + height / 2]
        }"""
    )


def drag(page, label, positions, pixels=2, pause=20, pictures=0):
    """Drag a slider's thumb to the right by some positions, without letting go.

    A number of pictures may be given which a page that counts them (``WATCH``) must have drawn by the end:
    then the hand is no faster than a slow machine draws.
    """
    x, y = thumb_of(slider(page, label))
    page.mouse.move(x, y)
    page.mouse.down()
    for step in range(1, positions + 1):
        page.mouse.move(x + pixels * step, y)
        page.wait_for_timeout(pause)
        due = pictures * step // positions
        page.wait_for_function("due => due == 0 || window.frames_drawn.length >= due", arg=due)


def test_dragging_a_slider_ends_on_the_paper_run_of_its_last_value(published_dashboard):
    dashboard = published_dashboard
    handle = slider(dashboard, "Block mass, kg")
    drag(dashboard, "Block mass, kg", 40)
    dashboard.mouse.up()
    expect(box(dashboard, "Block mass, kg")).to_have_value(re.compile(r"^[23]\d\d$"))
    mass = float(handle.get_attribute("aria-valuetext"))
    expect(box(dashboard, "Block mass, kg")).to_have_value(f"{mass:g}")
    wait_for_levels(dashboard, tig.solve(OPENING.replace(block_mass=mass)).insertion_gain)
    expect(dashboard.get_by_role("status")).to_contain_text("Paper's run")
    expect(dashboard.get_by_text("paper's run", exact=True)).to_be_visible()


def test_pictures_follow_the_hand_in_order(dashboard):
    """No picture is of a position that the slider had left before that of the picture before.

    A picture, exact or not, is of the position whose exact curve is nearest.
    """
    dashboard.evaluate(WATCH)
    drag(dashboard, "Boot stiffness, kN/mm", 30, pause=30, pictures=8)
    while_moving = dashboard.evaluate("() => window.frames_drawn")
    dashboard.mouse.up()
    stiffness = float(slider(dashboard, "Boot stiffness, kN/mm").get_attribute("aria-valuetext"))
    last = OPENING.replace(boot_stiffness=stiffness * 1e6)
    run = tig.solve(last).insertion_gain
    wait_for_levels(dashboard, run)
    steps = round(STEPS_PER_DECADE * np.log10(stiffness / 28))
    positions = 28e6 * 10 ** (np.arange(steps + 1) / STEPS_PER_DECADE)
    exact = tig.solve_many(OPENING, boot_stiffness=positions).insertion_gain
    drawn = [np.square(exact - levels).sum(axis=1).argmin() for levels in [*while_moving, run]]
    assert np.diff(drawn).min() >= 0
    assert drawn[-1] == len(positions) - 1
    frames = np.array(dashboard.evaluate("() => window.frames_drawn"))
    assert np.abs(frames[-1] - run).max() < 1e-6
    # looking for it on the page would be too late: the paper's run takes its place as soon as the hand rests;
    # a busy machine gives live runs up for the exact curve or for the paper's run
    assert {"live run", "exact curve"} & set(dashboard.evaluate("() => window.labels_drawn"))


def test_typed_numbers_are_taken_one_after_the_other(published_dashboard):
    dashboard = published_dashboard
    field = box(dashboard, "Pad stiffness, kN/mm")
    for typed in ("123.45", "250"):
        field.fill(typed)
        field.press("Enter")
        design = OPENING.replace(pad_stiffness=float(typed) * 1e6)
        wait_for_levels(dashboard, tig.solve(design).insertion_gain)
        expect(field).to_have_value(typed)


def test_nonsense_is_told_and_changes_nothing(untouched_dashboard):
    dashboard = untouched_dashboard
    before = levels(dashboard)
    field = box(dashboard, "Unsprung wheel mass, kg")
    complaint = dashboard.get_by_text(re.compile("(give|takes) 200 to 1500 kg"))
    for typed, key in (("abc", "Enter"), ("", "Tab"), ("99999", "Enter"), (MARKUP, "Tab")):
        field.fill(typed)
        field.press(key)
        expect(complaint).to_be_visible()
        np.testing.assert_array_equal(levels(dashboard), before)
        field.fill("880")
        field.press(key)
        expect(complaint).to_have_count(0)
    np.testing.assert_array_equal(levels(dashboard), before)


def test_a_preset_can_be_chosen_modified_and_come_back_to(published_dashboard):
    dashboard = published_dashboard
    choose(dashboard, "Track of Table 1", "Slab track")
    slab = tig.solve(tig.PRESETS["slab-track"]).insertion_gain
    wait_for_levels(dashboard, slab)
    expect(slider(dashboard, "Boot stiffness, kN/mm")).to_be_disabled()
    back = dashboard.get_by_role("button", name="Back to Table 1")
    expect(back).to_be_disabled()
    field = box(dashboard, "Pad loss factor")
    field.fill("0.3")
    field.press("Enter")
    modified = tig.PRESETS["slab-track"].replace(pad_loss_factor=0.3)
    wait_for_levels(dashboard, tig.solve(modified).insertion_gain)
    np.testing.assert_allclose(column(dashboard, "insertion_gain", "preset"), slab)
    back.click()
    wait_for_levels(dashboard, slab)
    expect(back).to_be_disabled()


def test_presets_and_rails_are_chosen_by_key(published_dashboard):
    dashboard = published_dashboard
    presets = dashboard.get_by_role("combobox", name="Track of Table 1", exact=True)
    presets.focus()
    presets.press("ArrowDown")
    high_mass = tig.PRESETS["booted-block-high-mass"]
    wait_for_levels(dashboard, tig.solve(high_mass).insertion_gain)
    rails = dashboard.get_by_role("combobox", name="Rail section")
    rails.focus()
    rails.press("ArrowDown")
    other = high_mass.replace(rail=tig.RAILS["49E1"])
    wait_for_levels(dashboard, tig.solve(other).insertion_gain)


def test_single_stage_takes_block_and_boot_out_and_puts_them_back(published_dashboard):
    dashboard = published_dashboard
    switch = dashboard.get_by_role("switch", name="Two-stage: blocks in boots")
    switch.click()
    single = OPENING.replace(block_mass=None, boot_stiffness=None, boot_loss_factor=None)
    wait_for_levels(dashboard, tig.solve(single).insertion_gain)
    for label in ("Block mass, kg", "Boot stiffness, kN/mm", "Boot loss factor"):
        expect(slider(dashboard, label)).to_be_disabled()
        expect(box(dashboard, label)).to_be_disabled()
    switch.click()
    wait_for_levels(dashboard, tig.solve(OPENING).insertion_gain)
    expect(slider(dashboard, "Block mass, kg")).to_be_enabled()


def test_a_long_run_can_be_stopped_and_leaves_the_last_picture(published_dashboard):
    dashboard = published_dashboard
    choose(dashboard, "Track of Table 1", "Slab track")
    before = tig.solve(tig.PRESETS["slab-track"]).insertion_gain
    wait_for_levels(dashboard, before)
    spacing = slider(dashboard, "Fastener spacing, m")
    spacing.press("Home")
    spaced = tig.PRESETS["slab-track"].replace(fastener_spacing=0.2)
    wait_for_levels(dashboard, tig.solve(spaced).insertion_gain)
    expect(dashboard.get_by_role("status")).to_contain_text("time step halved")
    slider(dashboard, "Pad loss factor").press("Home")
    dashboard.get_by_role("button", name="Stop").click()
    expect(dashboard.get_by_role("status")).to_contain_text("Stopped")
    # the live run is shown where it was fast enough, else the exact curve
    light = spaced.replace(pad_loss_factor=0.01)
    wait_for_levels(dashboard, *(tig.solve(light, each).insertion_gain for each in ("live", "exact")))
    dashboard.get_by_role("button", name="Solve").click()
    expect(dashboard.get_by_role("button", name="Stop")).to_be_visible()
    choose(dashboard, "Track of Table 1", "Booted sleeper")
    wait_for_levels(dashboard, tig.solve(tig.PRESETS["booted-sleeper"]).insertion_gain)


def test_the_pictures_stay_put_whatever_the_status_says(kept_dashboard):
    page = kept_dashboard(width=1024, height=768)
    page.get_by_role("tab", name="Explore", exact=True).click()
    wait_until_drawn(page, "insertion_gain_figure")
    wait_until_at_rest(page)
    top = """() => Bokeh.index.find_one(Bokeh.documents[0].get_model_by_name("insertion_gain_figure"))
        .el.getBoundingClientRect().top"""
    before = page.evaluate(top)
    field = box(page, "Fastener spacing, m")
    field.fill("0.2")
    field.press("Enter")
    expect(page.get_by_role("status")).to_contain_text("time step halved")
    slider(page, "Boot loss factor").press("Home")
    slider(page, "Pad loss factor").press("Home")
    expect(page.get_by_role("button", name="Stop")).to_be_visible()
    assert page.evaluate(top) == before
    page.get_by_role("button", name="Back to Table 1").click()


@pytest.mark.usefixtures("open_dashboard")
def test_all_that_a_link_gets_wrong_is_told_at_once_above_what_is_looked_at(reader):
    page = reader.open_at_once(1024, 768, "?pad_stiffness=-5&block_mass=1e9&tab=none&nothing=1")
    told = page.locator(".MuiAlert-root")
    expect(told).to_contain_text("Pad stiffness is -5 kN/mm, and its box takes 10 to 2000 kN/mm")
    expect(told).to_have_count(1)
    figure = page.get_by_text("Insertion gain", exact=True).first
    expect(figure).to_be_visible()
    toast = told.bounding_box()
    assert toast["y"] + toast["height"] < figure.bounding_box()["y"]
    wait_until_solved(page)
    assert (shown(page, "Pad stiffness, kN/mm"), shown(page, "Block mass, kg")) == (100, 45)


def test_sessions_do_not_disturb_each_other(published_dashboard, open_dashboard):
    one, other = published_dashboard, open_dashboard()
    slider(one, "Pad stiffness, kN/mm").press("End")
    wait_for_levels(one, tig.solve(OPENING.replace(pad_stiffness=2000e6)).insertion_gain)
    np.testing.assert_allclose(levels(other), tig.solve(OPENING).insertion_gain)
    slider(other, "Pad stiffness, kN/mm").press("End")
    wait_for_levels(other, levels(one))
    expect(other.get_by_role("status")).to_contain_text("solved before")


def test_time_is_counted_in_ms_or_s_as_zoom_asks(untouched_dashboard):
    dashboard = untouched_dashboard
    zoom = "end => { Bokeh.documents[0].get_model_by_name('force_figure').x_range.end = end }"
    axis = """expected => {
        const axis = Bokeh.documents[0].get_model_by_name("force_figure").below[0]
        return axis.axis_label == expected[0] && axis.formatter.doFormat([0.1], {})[0] == expected[1]
    }"""
    for end, expected in ((0.3, ["Time, ms", "100"]), (2.0, ["Time, s", "0.1"]), (0.9, ["Time, ms", "100"])):
        dashboard.evaluate(zoom, end)
        dashboard.wait_for_function(axis, arg=expected)


def test_hover_tells_band_and_value(untouched_dashboard):
    dashboard = untouched_dashboard
    band = dashboard.get_by_text("100 Hz", exact=True)
    level = f"{tig.solve(OPENING).insertion_gain[13]:+.1f} dB".replace("-", "−")
    hover_until_shown(dashboard, "insertion_gain_figure", 100, band)
    expect(dashboard.get_by_text(level, exact=True)).to_be_visible()


def test_the_dark_theme_reaches_figures_and_text(untouched_dashboard):
    dashboard = untouched_dashboard
    background = "() => Bokeh.documents[0].get_model_by_name('insertion_gain_figure').background_fill_color"
    light = dashboard.evaluate(background)
    dashboard.get_by_label("Toggle theme").click()
    dashboard.wait_for_function(f"light => ({background})() != light", arg=light)
    colour = dashboard.get_by_role("status").evaluate("element => getComputedStyle(element).color")
    assert min(map(int, re.findall(r"\d+", colour)[:3])) > 150
    dashboard.get_by_label("Toggle theme").click()
    dashboard.wait_for_function(f"light => ({background})() == light", arg=light)


def test_the_choice_of_sum_and_reference_is_drawn_and_named(published_dashboard):
    dashboard = published_dashboard
    choose(dashboard, "Over the supports", "Coherent force")
    choose(dashboard, "Against", "Rigid track")
    wait_for_levels(dashboard, tig.solve(OPENING, reference="rigid", summation="coherent").insertion_gain)
    label = "() => Bokeh.documents[0].get_model_by_name('insertion_gain_figure').left[0].axis_label"
    assert dashboard.evaluate(label) == "IG, dB (coherent / rigid)"
    choose(dashboard, "Over the supports", "Summed energy (paper)")
    choose(dashboard, "Against", "Straight line (paper)")
    wait_for_levels(dashboard, tig.solve(OPENING).insertion_gain)


def test_the_run_is_held_against_theory_while_the_tab_is_open(published_dashboard):
    dashboard = published_dashboard
    dashboard.get_by_role("tab", name="Verify").click()
    expect(dashboard.get_by_text("Largest difference 0.11 dB at 315 Hz")).to_be_visible()
    stepped, exact = tig.solve(OPENING), tig.solve(OPENING, "exact")
    np.testing.assert_allclose(column(dashboard, "comparison", "run"), stepped.insertion_gain)
    np.testing.assert_allclose(column(dashboard, "comparison", "exact"), exact.insertion_gain, atol=1e-9)
    handle = slider(dashboard, "Boot stiffness, kN/mm")
    handle.press("PageUp")
    expect(box(dashboard, "Boot stiffness, kN/mm")).not_to_have_value("28")
    stiffer = OPENING.replace(boot_stiffness=shown(dashboard, "Boot stiffness, kN/mm") * 1e6)
    dashboard.wait_for_function(
        """level => Math.abs(
            Bokeh.documents[0].get_model_by_name("comparison").data.exact[9] - level) < 1e-6""",
        arg=float(tig.solve(stiffer, "exact").insertion_gain[9]),
    )
    size = """name => {
        const view = Bokeh.index.find_one(Bokeh.documents[0].get_model_by_name(name))
        const box = view.el.getBoundingClientRect()
        return [box.width, box.height]
    }"""
    for name in (
        "comparison",
        "difference",
        "receptance",
        "time_step",
        "element",
        "stiffness",
        "loss_factor",
    ):
        width, height = dashboard.evaluate(size, f"{name}_figure")
        assert width > 300
        assert height > 150
