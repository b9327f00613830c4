"""Vehicle, axles and ground in a real browser: chosen in the sidebar, drawn at once, and stopped at will."""

import re

import numpy as np
import pytest
from playwright.sync_api import expect

import trackig_core as tig
from dashboard.figures import motion as figures_motion
from tests.browser.test_dashboard import box, choose, column, wait_for_levels
from tests.browser.test_learn import look_at, set_model

pytestmark = pytest.mark.browser

OPENING = tig.PRESETS["booted-block-low-mass"]

METRO = OPENING.replace(
    suspension=tig.VEHICLES["metro"].suspension,
    axle_positions=(0.0, tig.VEHICLES["metro"].wheelbase),
    speed=float(f"{80 / 3.6:.12g}"),
    ground=tig.GROUNDS["soft clay"],
)


def test_what_is_chosen_is_drawn_exactly_while_its_run_goes_on_and_after_it_was_stopped(dashboard):
    dashboard.get_by_text("Suspension and axles", exact=True).click()
    dashboard.locator("summary", has_text="Ground").click()
    expect(box(dashboard, "Speed, km/h")).to_be_disabled()
    choose(dashboard, "Vehicle", "metro, generic")
    choose(dashboard, "Axles", "both of a bogie")
    choose(dashboard, "Ground", "soft clay, generic")
    speed = box(dashboard, "Speed, km/h")
    speed.fill("80")
    speed.press("Enter")
    wait_for_levels(dashboard, tig.solve(METRO, "exact").insertion_gain)
    expect(dashboard.get_by_text("This design: against a very stiff track")).to_be_visible()
    dashboard.get_by_role("button", name="Stop").click()
    # a quick machine has drawn a live run by now, a slow one the exact curve only
    kept = re.compile("Stopped. The (curve is the exact one|pictures are a live run's) of this track")
    expect(dashboard.get_by_text(kept).first).to_be_visible()
    dashboard.get_by_role("button", name="Back to Table 1").click()
    wait_for_levels(dashboard, tig.solve(OPENING).insertion_gain)


def test_every_wheel_and_foot_moves_as_the_library_says(open_dashboard):
    page = open_dashboard(query="?axle_positions=0.0_2.1&ground=rock")
    look_at(page, "Motion")
    page.wait_for_function(
        "() => Bokeh.documents[0].get_model_by_name('shape_wheel')?.data.x.length == 2", timeout=60_000
    )
    design = OPENING.replace(axle_positions=(0.0, 2.1), ground=tig.GROUNDS["rock"])
    frequency = page.evaluate("() => Bokeh.documents[0].get_model_by_name('pick').location")
    shape = tig.steady_shape(design, frequency)
    set_model(page, "shape_slider", "value", 90)
    scale = column(page, "shape_facts", "scale")[0]
    wheels = (figures_motion.WHEEL_AT - column(page, "shape_wheel", "y")) / scale
    feet = (figures_motion.FOOT_AT - column(page, "shape_supports", "ground")) / scale
    np.testing.assert_allclose(wheels, -shape.wheels[:, 0].imag, atol=1e-9)
    np.testing.assert_allclose(feet, -shape.foot[:, 0].imag, atol=1e-9)
