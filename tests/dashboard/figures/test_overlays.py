"""Pictures described with HoloViews look like those drawn with Bokeh, and end with their session."""

import gc
import weakref

import pytest
from bokeh.models import GlyphRenderer, Range1d, Span

import trackig_core as tig
from dashboard import theme
from dashboard.figures.axes import BAND_AXIS, blank_figure, show_bands
from dashboard.figures.comparison import CURRENT, REFERENCE, BaseDifferenceFigure, GainsFigure


@pytest.fixture(scope="module")
def rendered():
    return BaseDifferenceFigure().model


@pytest.fixture(scope="module")
def drawn():
    plot = blank_figure(
        x_axis_type="log",
        y_range=Range1d(-10, 10),
        x_axis_label="One-third-octave band, Hz",
        y_axis_label="dB re base",
    )
    show_bands(plot)
    return plot


def looks(model, *apart):
    """Return the properties of a model that are plain values, but for some."""
    values = model.properties_with_values(include_defaults=True)
    return {
        name: each
        for name, each in values.items()
        if isinstance(each, (str, int, float, type(None))) and name not in apart
    }


@pytest.mark.parametrize("part", ["xaxis", "yaxis", "xgrid", "ygrid", "toolbar"])
def test_a_rendered_description_looks_like_a_figure_drawn_with_bokeh(rendered, drawn, part):
    own, other = (getattr(plot, part) for plot in (rendered, drawn))
    own, other = (own, other) if part == "toolbar" else (own[0], other[0])
    assert looks(own, "ticker") == looks(other, "ticker")


def test_a_rendered_figure_is_laid_out_like_one_drawn_with_bokeh(rendered, drawn):
    apart = ("name", "width", "height", "match_aspect")
    assert looks(rendered, *apart) == looks(drawn, *apart)
    assert [type(tool) for tool in drawn.tools] == [type(tool) for tool in rendered.tools[:-1]]


def test_no_column_of_the_source_is_shown_as_a_title(rendered):
    assert rendered.title is None or not rendered.title.text


def test_every_band_is_on_the_axis_and_zero_is_a_line(rendered):
    assert (rendered.x_range.start, rendered.x_range.end) == BAND_AXIS
    assert list(rendered.xaxis[0].ticker.ticks) == list(tig.BAND_CENTRES)
    assert list(rendered.xaxis[0].major_label_overrides.values()) == list(tig.BAND_LABELS)
    (zero,) = rendered.select({"type": Span})
    assert (zero.location, zero.dimension, zero.line_color) == (0, "width", theme.PRESET_GHOST)


def test_a_figure_ends_with_its_session():
    figures = [weakref.ref(BaseDifferenceFigure().model) for _ in range(2)]
    gc.collect()
    assert [each() for each in figures] == [None, None]


def test_the_curve_of_the_current_design_is_never_taken_for_that_of_the_reference_track():
    for _ in range(6):  # models that a set holds come in another order each time
        figure = GainsFigure()
        figure.show([])
        lines = {each.glyph.y: each for each in figure.model.renderers if isinstance(each, GlyphRenderer)}
        assert (figure._current, figure._reference) == (lines[CURRENT], lines[REFERENCE])
