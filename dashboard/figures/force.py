"""Force into the ground over time: the picture that follows the slider.

Built once with Bokeh, then fed by assigning each data source's ``data``. s and kN. The current design sets
the scale: a pinned design that exceeds it is cut off at the frame, and the legend says how far it reaches.
"""

import math

import numpy as np
from bokeh.events import RangesUpdate
from bokeh.models import (
    ColumnDataSource,
    CustomJS,
    CustomJSHover,
    CustomJSTickFormatter,
    HoverTool,
    Range1d,
)
from tsdownsample import MinMaxDownsampler

from dashboard import formats, theme
from dashboard.figures.axes import AxisEnds, blank_figure
from dashboard.figures.legends import (
    WITHOUT_FORCE,
    Legend,
    PinnedLines,
    are_the_same,
    pinned_entry,
    with_legend,
)
from dashboard.figures.swatches import swatch_svg

TIME_AXIS = (-0.005, 0.25)
"""What the time axis shows at first [s]; the rest of the record is a pan or a zoom away."""

POINTS_IN_VIEW = 2400
"""Samples of a curve in view that are sent whole, and to which more are thinned [-]: two a column of a wide
screen's pixels."""

POINTS_BEYOND = 400
"""The same for what lies out of view on either side [-], until it is moved into view."""

SHOWN_AS_MILLISECONDS = 1.0
"""Span of the time axis below which it counts in ms [s]."""


def rounded_ends(low, high):
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


class ForceFigure:
    """Force into the ground over time, under the loaded support and summed over all.

    Attributes
    ----------
    model : bokeh.plotting.figure
        The figure.
    legend : Legend
        What is drawn, in words.
    layout : bokeh.models.Column
        The figure, and its legend below it.
    samples : bokeh.models.ColumnDataSource
        Named ``force``: ``time`` [s], ``loaded_support`` and ``total`` [kN].
    pins : list of bokeh.models.ColumnDataSource
        Named ``pinned_force_0`` to ``pinned_force_7``: ``time`` [s] and ``total`` [kN] of pinned designs,
        whose records differ in length.
    """

    def __init__(self):
        self.pins = [
            ColumnDataSource(name=f"pinned_force_{place}", data={"time": [], "total": []})
            for place in range(theme.MOST_PINNED)
        ]
        self.samples = ColumnDataSource(name="force", data={"time": [], "loaded_support": [], "total": []})
        self._forces = AxisEnds((-1.0, 1.0))
        self.model = blank_figure(
            name="force_figure",
            aria_label="Force into the ground over time",
            x_range=Range1d(*TIME_AXIS),
            y_range=self._forces.model,
            x_axis_label=TIME_LABELS[0],
            y_axis_label="Force into the ground, kN",
            stylesheets=[theme.LOW],
        )
        self.legend = Legend("force_figure")
        self.layout = with_legend(self.model, self.legend)
        self._summary, self._drawn, self._reach = None, (), []
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
        self._draw_force("total", *ALL_SUPPORTS)
        self._draw_force("loaded_support", *UNDER_THE_WHEEL)
        self._pinned = PinnedLines(plot, plot.renderers[0], self.pins, "time", ["total"] * theme.MOST_PINNED)
        self._list_what_is_drawn()

    def _draw_force(self, column, words, colour, dash):
        """Draw a force of the current design."""
        plot = self.model
        line = plot.line(
            x="time",
            y=column,
            source=self.samples,
            line_color=colour,
            line_width=theme.THIN_LINE_WIDTH,
            line_dash=list(dash),
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

    def show(self, current, pinned=()):
        """Draw the forces of the current design, and behind them the total force of pinned ones.

        Parameters
        ----------
        current : DesignResult
            The current design, stepped in time.
        pinned : tuple of DesignResult
            Pinned designs, solved; those not stepped in time are listed without a line. The same ones again
            are not sent again.
        """
        stepped = tuple(each for each in pinned if each.summary.time is not None)
        new = not are_the_same(stepped, self._drawn)
        self._summary, self._drawn = current.summary, stepped
        forces = [self._summary.total_force, self._summary.loaded_support_force]
        self._forces.show(
            *rounded_ends(min(each.min() for each in forces), max(each.max() for each in forces))
        )
        ends = (self.model.x_range.start, self.model.x_range.end)
        self._send(*ends)
        if new:
            self._send_pinned(*ends)
            self._pinned.show(stepped)
            totals = [each.summary.total_force for each in stepped]
            self._reach = [(total.min(), total.max()) for total in totals]
        self._pinned.set_off(current)
        self._list_what_is_drawn([each for each in pinned if each not in stepped])

    def _list_what_is_drawn(self, without_force=()):
        """List what is drawn, and how far those reach that leave the frame."""
        own = [(words, swatch_svg(colour, dash)) for words, colour, dash in (ALL_SUPPORTS, UNDER_THE_WHEEL)]
        pinned = [
            pinned_entry(each, formats.beyond_text(*reach, *self._forces.home))
            for each, reach in zip(self._drawn, self._reach, strict=True)
        ]
        self.legend.show(own + pinned + [pinned_entry(each, WITHOUT_FORCE) for each in without_force])

    def _zoomed(self, event):
        if self._summary is not None:
            self._send(event.x0, event.x1)
            self._send_pinned(event.x0, event.x1)

    def _send(self, start, end):
        """Send as much of the record as can be seen: all that lies in view, an outline of the rest."""
        summary = self._summary
        forces = {"loaded_support": summary.loaded_support_force, "total": summary.total_force}
        self.samples.data = _in_view(summary.time, forces, start, end)

    def _send_pinned(self, start, end):
        for source, each in zip(self.pins, self._drawn, strict=False):
            forces = {"total": each.summary.total_force}
            source.data = _in_view(each.summary.time, forces, start, end)
        for source in self.pins[len(self._drawn) :]:
            if len(source.data["time"]):
                source.data = {"time": [], "total": []}


ALL_SUPPORTS = ("all supports", theme.THIS_DESIGN, ())
UNDER_THE_WHEEL = ("support under the wheel", theme.LOADED_TRACK, tuple(theme.SECOND_DASH))
"""Name, colour and dash of both forces of the current design."""


def _in_view(time, forces, start, end):
    some = outline(time, tuple(forces.values()), start, end)
    return {name: each[some].astype(np.float32) for name, each in {"time": time, **forces}.items()}


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
