"""The moving drawing: what the browser is sent is the film itself, and its first instant is drawn."""

import numpy as np
import pytest
from bokeh.models import Circle

import trackig_core as tig
from dashboard.figures import motion as figures
from dashboard.figures.motion import WHEEL_HEIGHT, FilmPlayer, ShapePlayer
from dashboard.theme import AXIS_SIZES, TICK_SIZES

BLOCK, SLAB = tig.PRESETS["booted-block-low-mass"], tig.PRESETS["slab-track"]


@pytest.mark.parametrize("design", [BLOCK, SLAB], ids=["two stages", "one stage"])
def test_a_film_is_sent_whole_and_bounded(design):
    player, motion = FilmPlayer(), tig.film(design)
    player.show(motion)
    sent = player.film.data
    np.testing.assert_allclose(sent["time"], 1000 * motion.time)
    np.testing.assert_allclose(sent["wheel_0"], 1e6 * motion.wheel, rtol=1e-6)
    for element in (0, 5, 36):
        np.testing.assert_allclose(sent[f"rail_{element}"], 1e6 * motion.rail[:, element], rtol=1e-6)
    if design.two_stage:
        np.testing.assert_allclose(sent["block_12"], 1e6 * motion.block[:, 12], rtol=1e-6)
    assert ("block_0" in sent) == design.two_stage
    assert sum(np.asarray(column).nbytes for column in sent.values()) < 300_000
    assert (player.slider.start, player.slider.end) == pytest.approx((sent["time"][0], sent["time"][-1]))


@pytest.mark.parametrize("player", [FilmPlayer, ShapePlayer])
def test_its_axis_is_as_legible_as_those_of_all_figures(player):
    (axis,) = player().view.model.xaxis
    assert (axis.major_label_text_font_size, axis.axis_label_text_font_size) == (TICK_SIZES[1], AXIS_SIZES[1])


@pytest.mark.parametrize("design", [BLOCK, SLAB], ids=["two stages", "one stage"])
def test_the_first_instant_is_drawn_to_scale(design):
    player, motion = FilmPlayer(), tig.film(design)
    player.show(motion)
    view, at = player.view, np.argmin(np.abs(motion.time))
    scale = view.facts.data["scale"][0]
    height, supports, wheel = view.rail.data["y"], view.supports.data, view.wheel.data
    np.testing.assert_allclose(-height[36:] / scale, 1e6 * motion.rail[at], atol=1e-9)
    np.testing.assert_array_equal(height, height[::-1])
    np.testing.assert_array_equal(supports["rail"], height[::3])
    assert (figures.WHEEL_AT - wheel["y"][0]) / scale == pytest.approx(1e6 * motion.wheel[at])
    assert wheel["rail"][0] == height[36]
    if design.two_stage:
        moved = (figures.BLOCK_AT - supports["block"][12:]) / scale
        np.testing.assert_allclose(moved, 1e6 * motion.block[at], atol=1e-9)
        np.testing.assert_allclose(supports["top"] - supports["bottom"], figures.BLOCK_HEIGHT)
    else:
        assert np.isnan(supports["block"]).all()
        np.testing.assert_array_equal(supports["top"], figures.FOOT_AT)


def test_the_scale_bar_is_as_long_as_it_says():
    player = FilmPlayer()
    player.show(tig.film(BLOCK))
    bar, scale = player.view.bar.data, player.view.facts.data["scale"][0]
    number, unit = bar["text"][0].split()
    assert unit == "µm"
    assert (bar["high"][0] - bar["low"][0]) / scale == pytest.approx(float(number))


def of_part(player, name):
    sent = player.parts[name].data
    return np.array(sent["real"]) + 1j * np.array(sent["imag"])


def test_a_shape_is_sent_as_the_library_has_it():
    player, shape = ShapePlayer(), tig.steady_shape(BLOCK, 80.0)
    player.show(shape)
    np.testing.assert_allclose(of_part(player, "rail"), shape.rail[:, 0])
    np.testing.assert_allclose(of_part(player, "block"), shape.block[:, 0])
    assert of_part(player, "foot").size == 0
    scale = player.view.facts.data["scale"][0]
    np.testing.assert_allclose(-player.view.rail.data["y"] / scale, shape.rail[:, 0].real, atol=1e-12)
    np.testing.assert_array_equal(player.view.supports.data["ground"], figures.FOOT_AT)
    player.show(tig.steady_shape(SLAB, 80.0))
    assert of_part(player, "block").size == 0


@pytest.mark.parametrize("design", [BLOCK, SLAB], ids=["two stages", "one stage"])
def test_every_axle_stands_on_its_element_and_every_foot_on_its_spring(design):
    design = design.replace(axle_positions=(0.0, 2.1), speed=20.0, ground=tig.GROUNDS["soft clay"])
    player, shape = ShapePlayer(), tig.steady_shape(design, 40.0)
    player.show(shape)
    view = player.view
    scale, supports, wheels = view.facts.data["scale"][0], view.supports.data, view.wheel.data
    np.testing.assert_allclose(wheels["x"], shape.wheel_position)
    np.testing.assert_allclose((figures.WHEEL_AT - wheels["y"]) / scale, shape.wheels[:, 0].real)
    elements = np.searchsorted(shape.position, shape.wheel_position - 1e-9)
    np.testing.assert_allclose(-wheels["rail"] / scale, shape.rail[elements, 0].real)
    np.testing.assert_allclose((figures.FOOT_AT - supports["ground"]) / scale, shape.foot[:, 0].real)
    assert view.floor.location == figures.FLOOR_AT < supports["ground"].min()
    if not design.two_stage:
        np.testing.assert_array_equal(supports["top"], supports["ground"])
    player.show(tig.steady_shape(BLOCK, 40.0))
    assert view.floor.location == figures.FOOT_AT


def test_a_film_of_several_wheels_is_sent_whole_and_drawn_unmirrored():
    player = FilmPlayer()
    motion = tig.film(BLOCK.replace(axle_positions=(0.0, 2.1), speed=20.0))
    player.show(motion)
    view, at = player.view, np.argmin(np.abs(motion.time))
    np.testing.assert_allclose(player.film.data["wheel_1"], 1e6 * motion.wheels[:, 1], rtol=1e-5, atol=1e-4)
    scale = view.facts.data["scale"][0]
    np.testing.assert_allclose(-view.rail.data["y"] / scale, 1e6 * motion.rail[at], atol=1e-9)
    np.testing.assert_allclose(view.wheel.data["x"], motion.wheel_position)


@pytest.mark.parametrize("design", [BLOCK, SLAB], ids=["two stages", "one stage"])
@pytest.mark.parametrize("axles", [(0.0,), (0.0, 2.1)], ids=["one wheel", "both of a bogie"])
def test_a_film_shows_feet_on_ground_that_yields(design, axles):
    player, ground = FilmPlayer(), tig.GROUNDS["soft clay"]
    motion = tig.film(design.replace(axle_positions=axles, speed=20.0, ground=ground))
    player.show(motion)
    view, at = player.view, np.argmin(np.abs(motion.time))
    np.testing.assert_allclose(player.film.data["foot_3"], 1e6 * motion.foot[:, 3], rtol=1e-5, atol=1e-4)
    scale, ground = view.facts.data["scale"][0], view.supports.data["ground"]
    feet = (figures.FOOT_AT - ground[-motion.foot.shape[1] :]) / scale
    np.testing.assert_allclose(feet, 1e6 * motion.foot[at], atol=1e-9)
    assert view.floor.location == figures.FLOOR_AT
    player.show(tig.film(design))
    assert "foot_0" not in player.film.data
    np.testing.assert_array_equal(view.supports.data["ground"], figures.FOOT_AT)


def test_nothing_that_the_browser_moves_comes_back():
    for player in (FilmPlayer(), ShapePlayer()):
        moved = [player.slider, player.play, player.view.rail, player.view.supports, player.view.wheel]
        assert not any(model.syncable for model in moved)


def test_the_largest_movement_stays_in_the_drawing():
    player = FilmPlayer()
    for design in tig.PRESETS.values():
        motion = tig.film(design)
        player.show(motion)
        reach = player.view.facts.data["scale"][0] * 1e6 * np.abs(motion.wheel).max()
        assert reach <= figures.LARGEST * (1 + 1e-9)
        assert figures.WHEEL_AT + figures.WHEEL_HEIGHT / 2 + reach <= figures.SEEN[1] + 0.05


def test_the_wheel_is_round_in_every_window():
    """Its radius is a height; a width along the track would be as wide as the window lets it."""
    glyphs = [each.glyph for each in FilmPlayer().view.model.renderers]
    (wheel,) = [glyph for glyph in glyphs if isinstance(glyph, Circle)]
    assert (wheel.radius, wheel.radius_dimension) == (WHEEL_HEIGHT / 2, "y")
