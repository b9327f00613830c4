"""Figures as plain data: what stands in their sources, and when axes move."""

import dataclasses
import html

import numpy as np
import pytest
from bokeh.events import RangesUpdate
from bokeh.models import HoverTool
from hypothesis import given, settings
from hypothesis import strategies as st

import trackig_core as tig
from dashboard import formats
from dashboard.figures.axes import nice_step, settled_range
from dashboard.figures.comparison import BaseDifferenceFigure, GainsFigure, ReceivedLevelFigure
from dashboard.figures.force import (
    POINTS_BEYOND,
    POINTS_IN_VIEW,
    TIME_AXIS,
    ForceFigure,
    outline,
    rounded_ends,
)
from dashboard.figures.insertion_gain import InsertionGainFigure
from dashboard.session.pins import current_design
from dashboard.session.results import DesignResult, SolutionSummary
from dashboard.theme import LINE_WIDTH, MOST_PINNED
from trackig_core.names import LONGEST_NAME

# the least floats that there are would be lost when divided by a step
ENDS = st.tuples(st.floats(-200, 200, allow_subnormal=False), st.floats(0.1, 200)).map(
    lambda pair: (pair[0], pair[0] + pair[1])
)


@given(current=ENDS, data=ENDS)
def test_axes_always_hold_the_data(current, data):
    low, high = settled_range(current, *data, step=5)
    assert low <= data[0]
    assert data[1] <= high


@given(current=ENDS, data=ENDS)
def test_axes_settle_at_once(current, data):
    settled = settled_range(current, *data, step=5)
    assert settled_range(settled, *data, step=5) == settled


def test_axes_stay_put_while_the_data_fill_half_of_them():
    assert settled_range((-40, 20), -21, 9, step=5) == (-40, 20)


def test_axes_grow_when_data_would_leave():
    assert settled_range((-40, 20), -41, 9, step=5) == (-45, 10)


def test_axes_shrink_when_the_data_fill_less_than_half():
    assert settled_range((-100, 20), -20, 9, step=5) == (-20, 10)


@pytest.mark.parametrize(("span", "step"), [(10, 1), (11, 2), (25, 5), (60, 10), (0.3, 0.05), (170, 20)])
def test_steps_are_one_two_or_five(span, step):
    assert nice_step(span) == pytest.approx(step)


@given(low=st.floats(-1e3, -1e-3), high=st.floats(1e-3, 1e3))
def test_rungs_hold_the_data_with_room_for_both_signs(low, high):
    bottom, top, step = rounded_ends(low, high)
    assert bottom <= low * (1 - 1e-12)
    assert high * (1 - 1e-12) <= top
    assert bottom / step == pytest.approx(round(bottom / step))
    assert top / step == pytest.approx(round(top / step))


def test_the_force_axis_moves_a_few_times_while_a_peak_grows_tenfold(summary):
    force, ends = ForceFigure(), []
    shown = summary("booted-block-low-mass")
    for factor in np.geomspace(1, 10, 40):
        louder = dataclasses.replace(
            shown,
            total_force=factor * shown.total_force,
            loaded_support_force=factor * shown.loaded_support_force,
        )
        force.show(current(louder))
        ends.append((force.model.y_range.start, force.model.y_range.end))
        assert ends[-1][0] <= factor * shown.total_force.min()
        assert factor * shown.total_force.max() <= ends[-1][1]
    assert len(set(ends)) <= 7


def current(summary, louder=0.0):
    """Return the result of a current design, its insertion gain raised [dB]."""
    gain = dataclasses.replace(summary.solution.gain, levels=summary.solution.insertion_gain + louder)
    return DesignResult(current_design(summary.design), summary, gain)


def pinned(summary, name, louder=0.0):
    """Return the result of a pinned design."""
    record = tig.PinnedDesign(name, summary.design, key=1)
    return dataclasses.replace(current(summary, louder), pinned=record)


@pytest.fixture
def gain():
    return InsertionGainFigure()


def changed(summary, **frequencies):
    """Return a picture with other natural frequencies."""
    natural = dataclasses.replace(summary.solution.natural_frequencies, **frequencies)
    return dataclasses.replace(
        summary, solution=dataclasses.replace(summary.solution, natural_frequencies=natural)
    )


def draw(gain, summary, preset=None, louder=0.0):
    """Draw a solution's insertion gain, and that of a preset behind it."""
    gain.show(current(summary, louder), preset=None if preset is None else current(preset))


def listed(figure):
    """Return what the legend lists."""
    return list(figure.legend.listed)


@pytest.mark.parametrize("preset", ["slab-track", "booted-block-low-mass"])
def test_the_curve_is_the_solution(gain, summary, preset):
    draw(gain, summary(preset))
    data = gain.bands.data
    np.testing.assert_array_equal(data["level"], summary(preset).solution.insertion_gain)
    np.testing.assert_array_equal(data["centre"], tig.BAND_CENTRES)
    np.testing.assert_array_equal([*data["left"], data["right"][-1]], tig.BAND_EDGES)
    assert tuple(data["label"]) == tig.BAND_LABELS
    assert np.isnan(data["preset"]).all()


def test_the_ghost_is_the_preset(gain, summary):
    draw(gain, summary("slab-track"), summary("booted-sleeper"))
    ghost = summary("booted-sleeper").solution.insertion_gain
    np.testing.assert_array_equal(gain.bands.data["preset"], ghost)
    assert listed(gain) == ["this design", "as in Table 1"]
    draw(gain, summary("slab-track"))
    assert listed(gain) == ["this design"]


def test_bands_carry_nominal_labels(gain):
    axis = gain.model.xaxis[0]
    assert [axis.major_label_overrides[tick] for tick in axis.ticker.ticks] == list(tig.BAND_LABELS)


def test_hover_tells_band_and_value(gain, summary):
    draw(gain, summary("booted-block-low-mass"))
    (hover,) = gain.model.select({"type": HoverTool})
    assert [field for _, field in hover.tooltips] == ["@label Hz", "@level_text", "@preset_text"]
    shown = [float(text.removesuffix(" dB").replace("−", "-")) for text in gain.bands.data["level_text"]]
    np.testing.assert_allclose(shown, gain.bands.data["level"], atol=0.05001)


def marker(gain, name):
    return gain.model.select_one({"name": name}), gain.model.select_one({"name": f"{name}_label"})


def test_markers_stand_at_the_natural_frequencies(gain, summary):
    draw(gain, summary("booted-block-low-mass"))
    natural = summary("booted-block-low-mass").solution.natural_frequencies
    for name, frequency in (("loaded_track", natural.loaded_track), ("coupled_block", natural.coupled_block)):
        line, label = marker(gain, name)
        assert line.visible
        assert line.location == label.x == frequency
    assert marker(gain, "loaded_track")[1].text == f"loaded track {natural.loaded_track:.1f} Hz"


def test_a_single_stage_track_has_no_block_to_mark(gain, summary):
    draw(gain, summary("booted-block-low-mass"))
    draw(gain, summary("slab-track"))
    line, label = marker(gain, "coupled_block")
    assert not line.visible
    assert not label.text.strip()


def test_a_frequency_beyond_the_axis_is_told_at_its_end(gain, summary):
    draw(gain, changed(summary("booted-block-low-mass"), coupled_block=2251.0))
    line, label = marker(gain, "coupled_block")
    assert not line.visible
    assert label.x == tig.BAND_EDGES[-1]
    assert (label.text, label.text_align) == ("coupled block 2251 Hz →", "right")


def test_a_label_near_the_right_end_stands_left_of_its_line(gain, summary):
    draw(gain, changed(summary("booted-block-low-mass"), coupled_block=400.0, loaded_track=30.0))
    assert marker(gain, "coupled_block")[1].text_align == "right"
    assert marker(gain, "loaded_track")[1].text_align == "left"


def test_the_level_axis_holds_the_curve_and_then_stays(gain, summary):
    draw(gain, summary("booted-block-low-mass"))
    ends = (gain.model.y_range.start, gain.model.y_range.end)
    assert ends[0] < gain.bands.data["level"].min()
    assert gain.bands.data["level"].max() < ends[1]
    draw(gain, summary("booted-block-low-mass"), louder=2.0)
    assert (gain.model.y_range.start, gain.model.y_range.end) == ends


def test_a_zoomed_axis_is_left_alone(gain, summary):
    draw(gain, summary("slab-track"))
    gain.model.y_range.update(start=-5, end=5)
    draw(gain, summary("booted-block-high-mass"))
    assert (gain.model.y_range.start, gain.model.y_range.end) == (-5, 5)
    assert gain.model.y_range.reset_start < gain.bands.data["level"].min()


def test_the_forces_are_drawn_in_kilonewton(summary):
    force = ForceFigure()
    shown = summary("booted-block-low-mass")
    force.show(current(shown))
    solution = tig.solve(tig.PRESETS["booted-block-low-mass"])
    data = force.samples.data
    at = np.searchsorted(solution.time, data["time"].astype(float) - 1e-6)
    np.testing.assert_allclose(data["time"], solution.time[at], atol=1e-6)
    for name, expected in (
        ("total", solution.total_force / 1000),
        ("loaded_support", solution.loaded_support_force / 1000),
    ):
        np.testing.assert_allclose(data[name], expected[at], atol=1e-6 * np.abs(expected).max())
    assert force.model.y_range.start <= shown.total_force.min()
    assert shown.total_force.max() <= force.model.y_range.end


def test_what_is_in_view_is_sent_whole_and_of_the_rest_an_outline(summary):
    force = ForceFigure()
    shown = summary("booted-block-low-mass")
    force.show(current(shown))
    in_view = (shown.time >= TIME_AXIS[0]) & (shown.time <= TIME_AXIS[1])
    sent = force.samples.data["time"]
    assert np.count_nonzero((sent >= TIME_AXIS[0]) & (sent <= TIME_AXIS[1])) >= np.count_nonzero(in_view) - 1
    assert sent.size < shown.time.size / 4
    assert sent[[0, -1]] == pytest.approx(shown.time[[0, -1]], abs=1e-6)


def test_a_move_along_time_sends_what_comes_into_view(summary):
    force = ForceFigure()
    shown = summary("slab-track")
    force.show(current(shown))
    force.model._trigger_event(RangesUpdate(force.model, x0=1.0, x1=1.2, y0=0, y1=1))
    sent = force.samples.data["time"]
    expected = np.count_nonzero((shown.time >= 1.0) & (shown.time <= 1.2))
    assert np.count_nonzero((sent >= 1.0) & (sent <= 1.2)) >= expected - 1


@given(st.integers(3, 30_000), st.floats(-1, 9), st.floats(0.01, 9), st.integers(0, 10_000))
@settings(max_examples=50, deadline=None)
def test_an_outline_keeps_every_envelope_and_is_bounded(samples, start, width, seed):
    time = np.arange(samples) / 4096
    curves = [np.random.default_rng([seed, k]).normal(size=samples) for k in range(2)]
    kept = outline(time, curves, start, start + width)
    assert (np.diff(kept) > 0).all()
    assert kept.size <= 2 * (2 * POINTS_BEYOND + POINTS_IN_VIEW) + 2
    first, last = np.searchsorted(time, [start, start + width])
    for begin, stop, points in ((0, first, POINTS_BEYOND), (first, last, POINTS_IN_VIEW)):
        if stop - begin > points:
            for curve in curves:
                some = kept[(kept >= begin) & (kept < stop)]
                assert curve[some].max() == curve[begin:stop].max()
                assert curve[some].min() == curve[begin:stop].min()


def test_both_forces_have_a_name_and_a_hover():
    force = ForceFigure()
    assert listed(force) == ["all supports", "support under the wheel"]
    assert len(force.model.select({"type": HoverTool})) == 2


MARKUP = "<img src=x onerror=console.error(1)>"


def test_pinned_curves_are_drawn_and_named(gain, summary):
    hand = current(summary("booted-block-low-mass"))
    pins = (pinned(summary("slab-track"), "a"), pinned(summary("booted-sleeper"), MARKUP))
    gain.show(hand, pins)
    for place, each in enumerate(pins):
        np.testing.assert_array_equal(gain.pins.data[f"pin_{place}"], each.levels)
    assert np.isnan(gain.pins.data["pin_2"]).all()
    assert listed(gain) == ["this design", "a", MARKUP]
    (hover,) = gain.model.select({"type": HoverTool})
    assert [name for name, _ in hover.tooltips][-2:] == ["a", MARKUP]
    gain.show(hand)
    assert listed(gain) == ["this design"]
    assert np.isnan(gain.pins.data["pin_0"]).all()


def test_all_pinned_curves_are_seen(gain, summary):
    shown = summary("booted-block-low-mass")
    high = pinned(shown, "loud", louder=40.0)
    gain.show(current(shown), (high,))
    assert gain.model.y_range.end >= high.levels.max()


@pytest.mark.parametrize("figure", [InsertionGainFigure, ForceFigure, GainsFigure])
def test_a_pinned_copy_of_the_current_design_is_seen_beside_its_curve(figure, summary):
    drawn, same = figure(), summary("booted-block-low-mass")
    pins = (pinned(same, "copy"), pinned(summary("slab-track"), "other"))

    def widths():
        return [line.glyph.line_width for line in drawn._pinned.lines]

    show = (lambda *designs: drawn.show(designs)) if figure is GainsFigure else drawn.show
    arguments = pins if figure is GainsFigure else (pins,)
    show(current(same), *arguments)
    copy, other = widths()
    assert copy >= LINE_WIDTH + 4, "on both sides of the line in front of it"
    assert other < LINE_WIDTH
    show(current(summary("slab-track")), *arguments)
    assert widths() == [other, copy]
    if figure is InsertionGainFigure:
        drawn.show(current(same), pins, alone=True)
        assert widths() == [other, other]


def limits(**levels):
    """Return a limit by nominal band, NaN elsewhere."""
    return np.array([levels.get(f"at_{label.replace('.', '_')}", np.nan) for label in tig.BAND_LABELS])


def test_a_limit_is_drawn_where_there_is_one_and_failing_bands_are_marked(gain, summary):
    hand = current(summary("booted-block-low-mass"))
    levels = hand.levels
    bands = {label: tig.BAND_LABELS.index(label) for label in ("40", "50", "100")}
    limit = limits(at_40=levels[bands["40"]] - 3, at_50=levels[bands["50"]] + 1, at_100=levels[bands["100"]])
    gain.show(hand, limit=limit)
    data = gain.limit.data
    np.testing.assert_array_equal(data["limit"], limit)
    assert data["before"][bands["50"]] == limit[bands["40"]]
    assert np.isnan(data["before"][bands["40"]])
    assert list(np.flatnonzero(np.isfinite(data["failing"]))) == [bands["40"]]
    assert data["failing"][bands["40"]] == levels[bands["40"]]
    assert listed(gain) == ["this design", "required maximum", "exceeds it"]
    gain.show(hand)
    assert listed(gain) == ["this design"]


def test_pins_alone_leave_the_current_design_out(gain, summary):
    hand, pins = current(summary("booted-block-low-mass")), (pinned(summary("slab-track"), "a"),)
    gain.show(hand, pins, alone=True)
    assert listed(gain) == ["a"]
    assert not marker(gain, "loaded_track")[0].visible
    gain.show(hand, pins)
    assert listed(gain) == ["this design", "a"]


def test_pinned_forces_are_drawn_and_follow_a_zoom(summary):
    force = ForceFigure()
    hand = current(summary("booted-block-low-mass"))
    force.show(hand, (pinned(summary("slab-track"), "slab"),))
    data, shown = force.pins[0].data, summary("slab-track")
    at = np.searchsorted(shown.time, data["time"].astype(float) - 1e-6)
    np.testing.assert_allclose(data["total"], shown.total_force[at], rtol=1e-5, atol=1e-6)
    assert listed(force)[:2] == ["all supports", "support under the wheel"]
    force.model._trigger_event(RangesUpdate(force.model, x0=1.0, x1=1.2, y0=0, y1=1))
    sent = force.pins[0].data["time"]
    expected = np.count_nonzero((shown.time >= 1.0) & (shown.time <= 1.2))
    assert np.count_nonzero((sent >= 1.0) & (sent <= 1.2)) >= expected - 1
    force.show(hand)
    assert not len(force.pins[0].data["time"])


def test_a_pin_without_a_run_says_so_wherever_it_is_listed(gain, summary):
    hand, slab = current(summary("booted-block-low-mass")), summary("slab-track")
    exact = SolutionSummary.of(tig.solve(slab.design, "exact"), 0.1)
    pins, force = (pinned(exact, "early"), pinned(slab, "late")), ForceFigure()
    for figure in (gain, force):
        figure.show(hand, pins)
    assert listed(gain)[1:] == ["early · exact curve", "late"]
    assert [words.split(" (")[0] for words in listed(force)[2:]] == ["late", "early · exact curve, no force"]
    np.testing.assert_allclose(force.pins[0].data["total"][-1], slab.total_force[-1], rtol=1e-5)
    assert not len(force.pins[1].data["time"])


def test_the_current_design_sets_the_scale_of_force_and_the_legend_says_what_leaves_it(summary):
    force, alone = ForceFigure(), ForceFigure()
    block, slab = summary("booted-block-low-mass"), summary("slab-track")
    alone.show(current(block))
    pins = (pinned(slab, "slab"), pinned(block, "the same"))
    force.show(current(block), pins)
    ends = (force.model.y_range.start, force.model.y_range.end)
    assert ends == (alone.model.y_range.start, alone.model.y_range.end)
    assert slab.total_force.max() > ends[1]
    greatest, least = (formats.force_text(each) for each in (slab.total_force.max(), slab.total_force.min()))
    assert listed(force)[2:] == [f"slab (cut off: reaches {greatest} and {least})", "the same"]
    force.show(current(slab), pins)
    assert listed(force)[2:] == ["slab", "the same"]


def test_a_legend_stands_below_its_figure_with_whole_names_as_text(gain, summary):
    name = "<b>forty characters of name, and no less"
    assert len(name) == LONGEST_NAME
    gain.show(current(summary("booted-block-low-mass")), (pinned(summary("slab-track"), name),))
    assert list(gain.layout.children) == [gain.model, gain.legend.model]
    assert f"<span>{html.escape(name)}</span>" in gain.legend.model.text
    assert "<b>" not in gain.legend.model.text


def test_no_legend_lies_over_curves(gain):
    for figure in (gain, ForceFigure(), GainsFigure(), BaseDifferenceFigure(), ReceivedLevelFigure()):
        assert not figure.model.legend


def test_a_frame_sends_nothing_of_the_pins(gain, summary):
    force, shown = ForceFigure(), summary("booted-block-low-mass")
    pins = [pinned(summary("slab-track"), str(place)) for place in range(MOST_PINNED)]
    gain.show(current(shown), tuple(pins))
    force.show(current(shown), tuple(pins))
    sources = (gain.pins, *force.pins)
    sent = [source.data for source in sources]
    gain.show(current(shown, louder=1.0), tuple(pins))
    force.show(current(shown, louder=1.0), tuple(pins))
    assert all(source.data is before for source, before in zip(sources, sent, strict=True))


def test_every_figure_has_a_name_for_screen_readers(gain):
    for figure in (gain, ForceFigure()):
        assert figure.model.html_attributes["role"] == "figure"
        assert len(figure.model.html_attributes["aria-label"]) > 10


def measured(summary, *points):
    """Return a picture of a design whose pad was measured at frequencies [Hz]."""
    curve = tig.StiffnessCurve([(each, 100e6, 0.2) for each in points])
    design = summary.design.replace(pad_stiffness=curve, pad_loss_factor=None)
    return dataclasses.replace(summary, solution=dataclasses.replace(summary.solution, design=design))


def test_bands_that_rest_on_extrapolation_are_hatched_and_listed(gain, summary):
    table_1 = summary("slab-track")
    draw(gain, measured(table_1, 1, 30))
    np.testing.assert_allclose(gain.extrapolated.data["left"], tig.BAND_EDGES[8:-1])
    np.testing.assert_allclose(gain.extrapolated.data["right"], tig.BAND_EDGES[9:])
    assert tig.BAND_LABELS[8] == "31.5"
    assert listed(gain) == ["this design", "beyond what was measured of this design"]
    assert gain.model.renderers[0].data_source is gain.extrapolated
    draw(gain, measured(table_1, 5, 500))
    assert listed(gain) == ["this design"]
    assert len(gain.extrapolated.data["left"]) == 0


def test_nothing_is_hatched_of_table_1(gain, summary):
    draw(gain, summary("slab-track"))
    assert len(gain.extrapolated.data["left"]) == 0
    assert gain.model.select({"name": "extrapolated"}) == []


def test_a_design_that_is_not_drawn_is_not_hatched(gain, summary):
    picture = measured(summary("slab-track"), 1, 30)
    gain.show(current(picture), (pinned(summary("slab-track"), "Slab"),), alone=True)
    assert len(gain.extrapolated.data["left"]) == 0
