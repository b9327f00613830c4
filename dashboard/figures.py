"""The pictures: built once with Bokeh, then fed by assigning each data source's ``data``.

Assigning a source costs a tenth of a millisecond where a new figure costs a hundred times more.
Sources carry names, so that tests can read in the browser what is drawn. Figures know data and
style, no widgets and no server.

The one rule: axes stay put while they can, so that the eye sees the change; they move when data
would leave them, or would fill less than half.
"""

import math

import numpy as np
from bokeh.events import RangesUpdate
from bokeh.models import (
    BoxZoomTool,
    ColumnDataSource,
    CustomJS,
    CustomJSHover,
    CustomJSTickFormatter,
    FixedTicker,
    HoverTool,
    Label,
    PanTool,
    Range1d,
    ResetTool,
    SaveTool,
    Span,
    WheelZoomTool,
)
from bokeh.plotting import figure
from tsdownsample import MinMaxDownsampler

import trackig_core as tig
from dashboard import style

LEVEL_STEP = 5.0
"""Grid of the ends of the level axis [dB]."""

LEVEL_ROOM = 2.0
"""Room between the curve and the ends of the level axis [dB]."""

LEAST_LEVELS = (-28.0, 18.0)
"""What the level axis shows at least, without the room [dB]."""

LABEL_FLIPS = 0.75
"""Part of the frequency axis from which on a marker's label stands to the left of its line."""

BAND_AXIS = (tig.BAND_EDGES[0], tig.BAND_EDGES[-1])
"""What the frequency axis shows: all bands, edge to edge [Hz]."""

TIME_AXIS = (-0.005, 0.25)
"""What the time axis shows at first [s]; the rest of the record is a pan or a zoom away."""

POINTS_IN_VIEW = 2400
"""Samples of a curve in view that are sent whole, and to which more are thinned [-]: two a column of a wide
screen's pixels."""

POINTS_BEYOND = 400
"""The same for what lies out of view on either side [-], until it is moved into view."""

SHOWN_AS_MILLISECONDS = 1.0
"""Span of the time axis below which it counts in ms [s]."""


def settled_range(current, low, high, step):
    """Return the ends of an axis that shows data from ``low`` to ``high``.

    Parameters
    ----------
    current : tuple of float
        The ends as they are.
    low, high : float
        What must be seen.
    step : float
        Ends are multiples of this.

    Returns
    -------
    tuple of float
        ``current`` while the data lie within it and fill half of it; else the nearest multiples
        around the data.
    """
    wanted = (math.floor(low / step) * step, math.ceil(high / step) * step)
    inside = current[0] <= low and high <= current[1]
    filled = wanted[1] - wanted[0] >= (current[1] - current[0]) / 2
    return current if inside and filled else wanted


def nice_step(span):
    """Return the 1, 2 or 5 times a power of ten that cuts a span into five to twelve parts."""
    rough = span / 10
    power = 10.0 ** math.floor(math.log10(rough))
    return next(factor * power for factor in (1, 2, 5, 10) if factor * power >= rough)


def rungs(low, high):
    """Return ends around data that lie on rungs 1, 2, 5, 10 ..., and a step that all of them share.

    Rungs are far apart, so that an axis moves a few times while a peak grows tenfold, not at each frame.

    Parameters
    ----------
    low, high : float
        Least and greatest value, below and above zero.

    Returns
    -------
    tuple of float
        Lower end, upper end and step.
    """
    sizes = [max(abs(low), abs(high) / 5), max(abs(high), abs(low) / 5)]
    powers = [10.0 ** math.floor(math.log10(size)) for size in sizes]
    ends = [
        next(factor * power for factor in (1, 2, 5, 10) if factor * power >= size)
        for size, power in zip(sizes, powers, strict=True)
    ]
    return -ends[0], ends[1], min(powers)


def outline(time, curves, start, end):
    """Return which samples draw curves as they look on a screen.

    Of every column of pixels in view, and of every wider one beyond, the highest and the lowest sample is
    kept: no peak is lost.

    Parameters
    ----------
    time : numpy.ndarray (samples,)
        Ascending [s].
    curves : sequence of numpy.ndarray (samples,)
        What is drawn.
    start, end : float
        What is in view [s].

    Returns
    -------
    numpy.ndarray of int
        Indices, ascending.
    """
    first, last = np.searchsorted(time, [start, end])
    parts = [(0, first, POINTS_BEYOND), (first, last, POINTS_IN_VIEW), (last, time.size, POINTS_BEYOND)]
    kept = [np.array([0, time.size - 1])]
    for begin, stop, points in parts:
        if stop - begin <= points:
            kept.append(np.arange(begin, stop))
        else:
            extremes = MinMaxDownsampler()
            kept += [begin + extremes.downsample(curve[begin:stop], n_out=points) for curve in curves]
    return np.unique(np.concatenate(kept).astype(np.int64))


class AxisEnds:
    """The ends of one axis: they move by :func:`settled_range`, unless the user has zoomed."""

    def __init__(self, ends):
        self.model = Range1d(*ends)
        self._home = ends

    def show(self, low, high, step):
        """Make sure that the axis shows what lies from ``low`` to ``high``."""
        home = settled_range(self._home, low, high, step)
        if home == self._home:
            return
        zoomed = (self.model.start, self.model.end) != self._home
        self._home = home
        self.model.reset_start, self.model.reset_end = home
        if not zoomed:
            self.model.start, self.model.end = home


class _Marker:
    """A natural frequency as a vertical line, its label above the frame where no curve can reach it."""

    def __init__(self, plot, name, words, colour):
        self._words = words
        self.line = Span(
            name=name,
            location=BAND_AXIS[0],
            dimension="height",
            line_color=colour,
            line_width=style.THIN_LINE_WIDTH,
            line_dash="dotdash",
            visible=False,
        )
        self.label = Label(
            name=f"{name}_label",
            x=BAND_AXIS[0],
            y=0,
            y_units="screen",
            text=NO_LABEL,
            text_baseline="bottom",
            text_color=colour,
            text_font=style.FONT,
            text_font_size=style.MARKER_LABEL_SIZE,
            text_font_style="bold",
        )
        plot.add_layout(self.line)
        plot.add_layout(self.label, "above")

    def show(self, frequency):
        if frequency is None:
            self.line.visible, self.label.text = False, NO_LABEL
            return
        low, high = BAND_AXIS
        place = math.log(frequency / low) / math.log(high / low)
        text = f"{self._words} {style.frequency_text(frequency)}"
        self.line.update(location=frequency, visible=0 <= place <= 1)
        self.label.update(
            x=min(max(frequency, low), high),
            text=f"{text} →" if place > 1 else f"← {text}" if place < 0 else text,
            text_align="left" if place < LABEL_FLIPS else "right",
        )


NO_LABEL = "\N{NO-BREAK SPACE}"
"""Keeps a label's row free, so that the frame stays put."""


class InsertionGainFigure:
    """Insertion gain per one-third-octave band, with the natural frequencies marked.

    Attributes
    ----------
    model : bokeh.plotting.figure
        The figure.
    bands : bokeh.models.ColumnDataSource
        Named ``insertion_gain``: per band its ``label``, ``centre``, ``left`` and ``right`` edge [Hz], the
        ``level`` of the design and that of its ``preset`` [dB], NaN when there is none to compare with.
    """

    def __init__(self):
        nothing = np.full(tig.BAND_CENTRES.size, np.nan)
        self.bands = ColumnDataSource(name="insertion_gain", data=_band_columns(nothing, nothing))
        self._levels = AxisEnds((-30.0, 20.0))
        self.model = blank_figure(
            name="insertion_gain_figure",
            x_axis_type="log",
            y_range=self._levels.model,
            x_axis_label="One-third-octave band, Hz",
            y_axis_label="Insertion gain, dB",
            stylesheets=[style.TALL],
        )
        self._draw_bands()
        self._loaded_track = _Marker(self.model, "loaded_track", "loaded track", style.LOADED_TRACK)
        self._coupled_block = _Marker(self.model, "coupled_block", "coupled block", style.COUPLED_BLOCK)

    def _draw_bands(self):
        plot = self.model
        show_bands(plot)
        plot.add_layout(zero_line())
        plot.quad(
            left="left",
            right="right",
            bottom=0,
            top="level",
            source=self.bands,
            fill_color=style.THIS_DESIGN,
            fill_alpha=style.FILL_ALPHA,
            line_color=None,
        )
        shared = {"source": self.bands, "x": "centre"}
        plot.line(
            y="preset",
            line_color=style.PRESET_GHOST,
            line_width=style.THIN_LINE_WIDTH,
            line_dash="dashed",
            legend_label="as in Table 1",
            **shared,
        )
        self._preset_entry = plot.legend[0].items[0]
        plot.line(
            y="level",
            line_color=style.THIS_DESIGN,
            line_width=style.LINE_WIDTH,
            legend_label="this design",
            **shared,
        )
        dots = plot.scatter(y="level", color=style.THIS_DESIGN, size=style.DOT_SIZE, **shared)
        tooltips = [("band", "@label Hz"), ("this design", "@level_text"), ("as in Table 1", "@preset_text")]
        plot.add_tools(HoverTool(renderers=[dots], mode="vline", tooltips=tooltips))
        plot.legend.location = "bottom_left"

    def name_axis(self, words):
        """Say on the axis which insertion gain is drawn."""
        self.model.yaxis.axis_label = words

    def show(self, levels, preset_levels, natural):
        """Draw insertion gain, and behind it that of the preset it departs from.

        Parameters
        ----------
        levels : numpy.ndarray (21,)
            Insertion gain [dB].
        preset_levels : numpy.ndarray (21,) or None
            What it is compared with [dB].
        natural : trackig_core.NaturalFrequencies
            What is marked.
        """
        preset = np.full_like(levels, np.nan) if preset_levels is None else preset_levels
        seen = np.concatenate([levels, preset[np.isfinite(preset)], LEAST_LEVELS])
        self._levels.show(seen.min() - LEVEL_ROOM, seen.max() + LEVEL_ROOM, LEVEL_STEP)
        self.bands.data = _band_columns(levels, preset)
        self._preset_entry.visible = preset_levels is not None
        self._loaded_track.show(natural.loaded_track)
        self._coupled_block.show(natural.coupled_block)


def _band_columns(levels, preset):
    return {
        "label": list(tig.BAND_LABELS),
        "centre": tig.BAND_CENTRES,
        "left": tig.BAND_EDGES[:-1],
        "right": tig.BAND_EDGES[1:],
        "level": levels,
        "preset": preset,
        "level_text": [style.level_text(level) for level in levels],
        "preset_text": [style.level_text(level) if np.isfinite(level) else "–" for level in preset],
    }


class ForceFigure:
    """Force into the ground over time, under the loaded support and summed over all.

    Attributes
    ----------
    model : bokeh.plotting.figure
        The figure.
    samples : bokeh.models.ColumnDataSource
        Named ``force``: ``time`` [s], ``loaded_support`` and ``total`` [kN].
    """

    def __init__(self):
        self.samples = ColumnDataSource(name="force", data={"time": [], "loaded_support": [], "total": []})
        self._forces = AxisEnds((-1.0, 1.0))
        self.model = blank_figure(
            name="force_figure",
            x_range=Range1d(*TIME_AXIS),
            y_range=self._forces.model,
            x_axis_label=TIME_LABELS[0],
            y_axis_label="Force into the ground, kN",
            stylesheets=[style.LOW],
        )
        self._picture = None
        self._count_time_as_zoom_asks()
        self._draw_forces()
        self.model.on_event(RangesUpdate, self._zoomed)

    def _count_time_as_zoom_asks(self):
        axis, ends = self.model.xaxis[0], self.model.x_range
        axis.formatter = CustomJSTickFormatter(args={"ends": ends}, code=TIME_TICK)
        relabel = CustomJS(args={"ends": ends, "axis": axis}, code=TIME_LABEL)
        ends.js_on_change("start", relabel)
        ends.js_on_change("end", relabel)

    def _draw_forces(self):
        plot = self.model
        for column, words, colour, dash in (
            ("total", "all supports", style.THIS_DESIGN, "solid"),
            ("loaded_support", "support under the wheel", style.LOADED_TRACK, style.SECOND_DASH),
        ):
            line = plot.line(
                x="time",
                y=column,
                source=self.samples,
                line_color=colour,
                line_width=style.THIN_LINE_WIDTH,
                line_dash=dash,
                legend_label=words,
            )
            time = CustomJSHover(args={"ends": plot.x_range}, code=TIME_HOVER)
            plot.add_tools(
                HoverTool(
                    renderers=[line],
                    mode="vline" if column == "total" else "mouse",
                    tooltips=[("time", "@time{custom}"), (words, f"@{column}{{+0.00}} kN")],
                    formatters={"@time": time},
                    description=f"Values: {words}",
                )
            )
        plot.legend.location = "top_right"

    def show(self, picture):
        """Draw a picture.

        Parameters
        ----------
        picture : Picture
            What is drawn.
        """
        low = min(picture.total_force.min(), picture.loaded_support_force.min())
        high = max(picture.total_force.max(), picture.loaded_support_force.max())
        self._forces.show(*rungs(low, high))
        self._picture = picture
        self._send(self.model.x_range.start, self.model.x_range.end)

    def _zoomed(self, event):
        if self._picture is not None:
            self._send(event.x0, event.x1)

    def _send(self, start, end):
        """Send as much of the record as can be seen: all that lies in view, an outline of the rest."""
        time, curves = self._picture.time, (self._picture.loaded_support_force, self._picture.total_force)
        some = outline(time, curves, start, end)
        loaded_support, total = (curve[some].astype(np.float32) for curve in curves)
        self.samples.data = {
            "time": time[some].astype(np.float32),
            "loaded_support": loaded_support,
            "total": total,
        }


TIME_LABELS = ("Time, ms", "Time, s")

TIME_TICK = f"""
    const scale = ends.end - ends.start < {SHOWN_AS_MILLISECONDS} ? 1000 : 1
    return String(Number((scale * tick).toPrecision(6)))
"""

TIME_LABEL = f"""
    axis.axis_label = ends.end - ends.start < {SHOWN_AS_MILLISECONDS}
        ? "{TIME_LABELS[0]}" : "{TIME_LABELS[1]}"
"""

TIME_HOVER = f"""
    return ends.end - ends.start < {SHOWN_AS_MILLISECONDS}
        ? (1000 * value).toFixed(1) + " ms" : value.toFixed(4) + " s"
"""


def show_bands(plot, every=1):
    """Give a figure's frequency axis all bands, edge to edge; label every band, or one in some."""
    plot.x_range = Range1d(*BAND_AXIS, bounds=BAND_AXIS)
    plot.xaxis.ticker = FixedTicker(ticks=list(tig.BAND_CENTRES[::every]), minor_ticks=[])
    plot.xaxis.major_label_overrides = dict(zip(tig.BAND_CENTRES, tig.BAND_LABELS, strict=True))
    plot.xgrid.visible = False


def zero_line():
    """Return a line at zero on the value axis."""
    return Span(
        location=0, dimension="width", line_color=style.PRESET_GHOST, line_width=style.THIN_LINE_WIDTH
    )


def blank_figure(**options):
    """Return an empty figure with the tools that all have."""
    plot = figure(
        tools=[PanTool(), BoxZoomTool(), WheelZoomTool(dimensions="width"), ResetTool(), SaveTool()],
        toolbar_location="right",
        sizing_mode="stretch_width",
        **options,
    )
    plot.toolbar.logo = None
    plot.toolbar.autohide = True
    return plot
