"""The pictures: built once with Bokeh, then fed by assigning each data source's ``data``.

Assigning a source costs a tenth of a millisecond where a new figure costs a hundred times more.
Sources carry names, so that tests can read in the browser what is drawn. Figures know data and
style, no widgets and no server.

The one rule: axes stay put while they can, so that the eye sees the change; they move when data
would leave them, or would fill less than half.
"""

import math

import numpy as np
from bokeh.core.properties import value
from bokeh.events import RangesUpdate
from bokeh.models import (
    BoxZoomTool,
    ColumnDataSource,
    CustomJS,
    CustomJSHover,
    CustomJSTickFormatter,
    FixedTicker,
    GlyphRenderer,
    HoverTool,
    Label,
    Legend,
    LegendItem,
    Line,
    PanTool,
    Quad,
    Range1d,
    ResetTool,
    SaveTool,
    Segment,
    Span,
    Text,
    WheelZoomTool,
)
from bokeh.plotting import figure
from tsdownsample import MinMaxDownsampler

import trackig_core as tig
from dashboard import style
from trackig_core.specification import TOLD_APART

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


def legend_entry(plot, words, *renderers):
    """Return what a legend says of curves.

    A legend is made anew whenever anything changes that it refers to, curves' data included; at each frame
    of a drag that would cost as much as drawing the figure. So it refers to twins of the curves: the same
    glyphs, and so the same colours and dashes, of a source that stays as it is.
    """
    columns = {column: [math.nan] for each in renderers for column in each.data_source.column_names}
    still = ColumnDataSource(data=columns)
    twins = [plot.add_glyph(still, each.glyph) for each in renderers]
    return LegendItem(label=value(words), renderers=twins)


class PinnedLines:
    """Lines for pinned designs, each with its entry in the legend; they are made when they are first needed.

    A figure pays at every frame for each line that it has, seen or not.

    Parameters
    ----------
    plot : bokeh.plotting.figure
        Where they are drawn.
    front : bokeh.models.GlyphRenderer
        What they are drawn behind.
    sources : sequence of bokeh.models.ColumnDataSource
        Where each line finds its curve.
    x : str
        Column of the horizontal axis.
    columns : sequence of str
        Each line's column of the vertical axis.
    """

    def __init__(self, plot, front, sources, x, columns):
        self.lines, self.entries = [], []
        self._plot, self._front, self._x = plot, front, x
        self._unmade = list(zip(sources, columns, strict=True))

    def _make(self, count):
        made, self._unmade = self._unmade[:count], self._unmade[count:]
        lines = [GlyphRenderer(data_source=source, glyph=self._glyph(column)) for source, column in made]
        renderers = self._plot.renderers
        behind = renderers.index(self._front)
        renderers[behind:behind] = lines
        self.lines += lines
        self.entries += [LegendItem(label=value(NO_LABEL), renderers=[line]) for line in lines]

    def _glyph(self, column):
        return Line(x=self._x, y=column, line_width=style.PINNED_LINE_WIDTH, line_alpha=1)

    def show(self, curves):
        """Give as many lines as there are curves their names, colours and dashes, and hide the rest."""
        missing = len(curves) - len(self.lines)
        if missing > 0:
            self._make(missing)
        for line, entry, curve in zip(self.lines, self.entries, curves, strict=False):
            line.glyph.update(line_color=curve.colour, line_dash=list(curve.dash))
            entry.label = value(style.name_text(curve.name, style.LEGEND_NAME))
        for place, line in enumerate(self.lines):
            line.visible = place < len(curves)

    @property
    def shown_entries(self):
        """Entries of the lines that are drawn."""
        return [entry for entry, line in zip(self.entries, self.lines, strict=True) if line.visible]


MOST_CURVES = len(style.DESIGN_COLOURS)
"""Pinned designs that a figure can draw: one for each colour."""


def new_legend(plot, location):
    """Return a figure's legend, empty as yet; it is made first, so that curves are drawn behind it."""
    legend = Legend(items=[], location=location)
    keep(
        legend,
        label_text_font_size=style.TICK_SIZES,
        glyph_width=(style.LEGEND_LINE, style.LEGEND_LINE),
        background_fill_alpha=(style.LEGEND_ALPHA, style.LEGEND_ALPHA),
    )
    plot.add_layout(legend)
    return legend


def list_in(legend, entries, shown):
    """List in a legend what is drawn, in two columns when one would be long.

    Parameters
    ----------
    legend : bokeh.models.Legend
        The legend.
    entries, shown : list of bokeh.models.LegendItem
        All that there are, in order, and those of what is drawn. The others are hidden, not taken out: at
        every change of a list of models Bokeh walks through the whole document.
    """
    if entries != legend.items:
        legend.items = entries
    for entry in entries:
        entry.visible = entry in shown
    legend.update(ncols=1 if len(shown) <= style.LEGEND_ROWS else 2, visible=bool(shown))


class InsertionGainFigure:
    """Insertion gain per one-third-octave band, with the natural frequencies marked.

    Attributes
    ----------
    model : bokeh.plotting.figure
        The figure.
    bands : bokeh.models.ColumnDataSource
        Named ``insertion_gain``: per band its ``label``, ``centre``, ``left`` and ``right`` edge [Hz], the
        ``level`` of the design and that of its ``preset`` [dB], NaN when there is none to compare with.
    pins : bokeh.models.ColumnDataSource
        Named ``pins``: per band its ``label``, its ``centre`` [Hz] and levels ``pin_0`` to ``pin_7`` [dB],
        NaN when there are not so many.
    limit : bokeh.models.ColumnDataSource
        Named ``limit``: per band its edges, the required ``limit`` [dB], ``before``, that of the band to the
        left, and ``failing``, the level of the design where it exceeds the limit; NaN where there is none.
    """

    def __init__(self):
        self.bands = ColumnDataSource(name="insertion_gain", data=_band_columns(NO_LEVELS, NO_LEVELS))
        self.pins = ColumnDataSource(name="pins", data=pin_columns(()))
        self.limit = ColumnDataSource(name="limit", data=_limit_columns(NO_LEVELS, NO_LEVELS))
        self._curves, self._limited = (), False
        self._levels = AxisEnds((-30.0, 20.0))
        self.model = blank_figure(
            name="insertion_gain_figure",
            aria_label="Insertion gain per one-third-octave band",
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
        self._legend = new_legend(plot, "bottom_left")
        self._fill = plot.quad(
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
        self._ghost = plot.line(
            y="preset",
            line_color=style.PRESET_GHOST,
            line_width=style.THIN_LINE_WIDTH,
            line_dash="dashed",
            **shared,
        )
        names = [f"pin_{place}" for place in range(MOST_CURVES)]
        self._pinned = PinnedLines(plot, self._ghost, [self.pins] * MOST_CURVES, "centre", names)
        self._line = plot.line(y="level", line_color=style.THIS_DESIGN, line_width=style.LINE_WIDTH, **shared)
        self._dots = plot.scatter(y="level", color=style.THIS_DESIGN, size=style.DOT_SIZE, **shared)
        pinned = CustomJSHover(args={"pins": self.pins}, code=PIN_HOVER)
        self._hover = HoverTool(
            renderers=[self._dots], mode="vline", tooltips=TOOLTIPS, formatters={"@centre": pinned}
        )
        plot.add_tools(self._hover)
        self._entries = {
            "this design": legend_entry(plot, "this design", self._line, self._dots),
            "as in Table 1": legend_entry(plot, "as in Table 1", self._ghost),
        }

    def _draw_limit(self):
        """Draw the limit and what exceeds it, behind all curves; without a limit there is nothing to draw."""
        plot, colour = self.model, style.SPECIFICATION
        width = style.LIMIT_LINE_WIDTH
        required = Segment(x0="left", x1="right", y0="limit", y1="limit", line_color=colour, line_width=width)
        riser = Segment(x0="left", x1="left", y0="before", y1="limit", line_color=colour, line_width=width)
        failing = Quad(
            left="left",
            right="right",
            bottom="limit",
            top="failing",
            fill_color=None,
            line_color=colour,
            line_width=style.THIN_LINE_WIDTH,
            hatch_pattern="right_diagonal_line",
            hatch_color=colour,
            hatch_weight=2,
            hatch_scale=10,
        )
        cross = Text(
            x="centre",
            y="failing",
            text=value("✗"),
            text_align="center",
            text_baseline="bottom",
            text_color=colour,
            text_font_size=style.FAILING_SIZE,
            y_offset=-3,
        )
        parts = [
            GlyphRenderer(data_source=self.limit, glyph=glyph) for glyph in (required, riser, failing, cross)
        ]
        behind = plot.renderers.index(self._fill) + 1
        plot.renderers[behind:behind] = parts
        self._entries["required maximum"] = legend_entry(plot, "required maximum", parts[0])
        self._entries["exceeds it"] = legend_entry(plot, "exceeds it", parts[2])

    def name_axis(self, words):
        """Say on the axis which insertion gain is drawn."""
        self.model.yaxis.axis_label = words

    def show(self, levels, preset_levels, natural, curves=(), limit=None, alone=False):
        """Draw insertion gain, and behind it that of the preset it departs from and of pinned designs.

        Parameters
        ----------
        levels : numpy.ndarray (21,)
            Insertion gain [dB].
        preset_levels : numpy.ndarray (21,) or None
            What it is compared with [dB].
        natural : trackig_core.NaturalFrequencies
            What is marked.
        curves : tuple of Curve
            Up to eight pinned designs; the same tuple again is not sent again.
        limit : numpy.ndarray (21,) or None
            Greatest insertion gain allowed [dB], NaN in bands that have no limit.
        alone : bool
            Whether the curves stand alone: then of the design at hand nothing is drawn.
        """
        preset = NO_LEVELS if preset_levels is None or alone else preset_levels
        self.bands.data = _band_columns(levels, preset)
        self._show_limit(limit, NO_LEVELS if alone else levels)
        for part in (self._fill, self._line, self._dots):
            part.visible = not alone
        self._loaded_track.show(None if alone else natural.loaded_track)
        self._coupled_block.show(None if alone else natural.coupled_block)
        self._show_curves(curves)
        self._tell(curves, alone)
        self._list_what_is_drawn()
        seen = [
            NO_LEVELS if alone else levels,
            preset,
            self.limit.data["limit"],
            *(curve.drawn for curve in curves),
            LEAST_LEVELS,
        ]
        every = np.concatenate(seen)
        self._levels.show(np.nanmin(every) - LEVEL_ROOM, np.nanmax(every) + LEVEL_ROOM, LEVEL_STEP)

    def _show_limit(self, limit, levels):
        if limit is None and not self._limited:
            return
        if limit is not None and "required maximum" not in self._entries:
            self._draw_limit()
        self._limited = limit is not None
        self.limit.data = _limit_columns(NO_LEVELS if limit is None else limit, levels)

    def _show_curves(self, curves):
        if curves is self._curves:
            return
        self._curves = curves
        self.pins.data = pin_columns(curves)
        self._pinned.show(curves)

    def _tell(self, curves, alone):
        """Tell what is drawn when the pointer rests on a band."""
        tooltips = ALONE_TOOLTIPS if alone else TOOLTIPS
        self._hover.update(
            renderers=self._pinned.lines[:1] if alone else [self._dots],
            tooltips=tooltips + [(curve.name, f"@centre{{{place}}}") for place, curve in enumerate(curves)],
        )

    def _list_what_is_drawn(self):
        data, limit = self.bands.data, self.limit.data
        drawn = {
            "this design": self._line.visible,
            "as in Table 1": np.isfinite(data["preset"]).any(),
            "required maximum": np.isfinite(limit["limit"]).any(),
            "exceeds it": np.isfinite(limit["failing"]).any(),
        }
        shown = [entry for words, entry in self._entries.items() if drawn[words]]
        entries = [*self._entries.values(), *self._pinned.entries]
        list_in(self._legend, entries, shown + self._pinned.shown_entries)


NO_LEVELS = np.full(tig.BAND_CENTRES.size, np.nan)
NO_LEVELS.flags.writeable = False

ALONE_TOOLTIPS = [("band", "@label Hz")]
TOOLTIPS = [*ALONE_TOOLTIPS, ("this design", "@level_text"), ("as in Table 1", "@preset_text")]

PIN_HOVER = """
    const level = pins.data["pin_" + format][special_vars.index]
    return (level < 0 ? "\u2212" : "+") + Math.abs(level).toFixed(1) + " dB"
"""


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


def pin_columns(curves):
    """Return the columns of a source that holds a level per band of each curve, NaN for those missing."""
    missing = MOST_CURVES - len(curves)
    levels = [curve.drawn for curve in curves] + [NO_LEVELS] * missing
    columns = {f"pin_{place}": each for place, each in enumerate(levels)}
    return {"label": list(tig.BAND_LABELS), "centre": tig.BAND_CENTRES, **columns}


def _limit_columns(limit, levels):
    # comparing with NaN is false, as it is meant to be
    exceeded = levels - limit > TOLD_APART
    return {
        "centre": tig.BAND_CENTRES,
        "left": tig.BAND_EDGES[:-1],
        "right": tig.BAND_EDGES[1:],
        "limit": limit,
        "before": np.concatenate([[np.nan], limit[:-1]]),
        "failing": np.where(exceeded, levels, np.nan),
    }


class ForceFigure:
    """Force into the ground over time, under the loaded support and summed over all.

    Attributes
    ----------
    model : bokeh.plotting.figure
        The figure.
    samples : bokeh.models.ColumnDataSource
        Named ``force``: ``time`` [s], ``loaded_support`` and ``total`` [kN].
    pins : list of bokeh.models.ColumnDataSource
        Named ``pinned_force_0`` to ``pinned_force_7``: ``time`` [s] and ``total`` [kN] of pinned designs,
        whose records differ in length.
    """

    def __init__(self):
        self.pins = [
            ColumnDataSource(name=f"pinned_force_{place}", data={"time": [], "total": []})
            for place in range(MOST_CURVES)
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
            stylesheets=[style.LOW],
        )
        self._picture, self._curves = None, ()
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
        self._legend = new_legend(plot, "top_right")
        self._entries = [
            self._draw_force("total", "all supports", style.THIS_DESIGN, "solid"),
            self._draw_force(
                "loaded_support", "support under the wheel", style.LOADED_TRACK, style.SECOND_DASH
            ),
        ]
        self._pinned = PinnedLines(plot, plot.renderers[0], self.pins, "time", ["total"] * MOST_CURVES)
        list_in(self._legend, self._entries, self._entries)

    def _draw_force(self, column, words, colour, dash):
        """Draw a force of the design at hand, and return its entry in the legend."""
        plot = self.model
        line = plot.line(
            x="time",
            y=column,
            source=self.samples,
            line_color=colour,
            line_width=style.THIN_LINE_WIDTH,
            line_dash=dash,
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
        return legend_entry(plot, words, line)

    def show(self, picture, curves=()):
        """Draw a picture, and behind it the total force of pinned designs.

        Parameters
        ----------
        picture : Picture
            What is drawn.
        curves : tuple of Curve
            Up to eight pinned designs; the same tuple again is not sent again.
        """
        new = curves is not self._curves
        self._picture, self._curves = picture, curves
        forces = [picture.total_force, picture.loaded_support_force]
        forces += [curve.drawn.total_force for curve in curves]
        self._forces.show(*rungs(min(each.min() for each in forces), max(each.max() for each in forces)))
        ends = (self.model.x_range.start, self.model.x_range.end)
        self._send(*ends)
        if new:
            self._send_pinned(*ends)
            self._pinned.show(curves)
            entries = self._entries + self._pinned.entries
            list_in(self._legend, entries, self._entries + self._pinned.shown_entries)

    def _zoomed(self, event):
        if self._picture is not None:
            self._send(event.x0, event.x1)
            self._send_pinned(event.x0, event.x1)

    def _send(self, start, end):
        """Send as much of the record as can be seen: all that lies in view, an outline of the rest."""
        picture = self._picture
        forces = {"loaded_support": picture.loaded_support_force, "total": picture.total_force}
        self.samples.data = _in_view(picture.time, forces, start, end)

    def _send_pinned(self, start, end):
        for source, curve in zip(self.pins, self._curves, strict=False):
            source.data = _in_view(curve.drawn.time, {"total": curve.drawn.total_force}, start, end)
        for source in self.pins[len(self._curves) :]:
            if len(source.data["time"]):
                source.data = {"time": [], "total": []}


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


LABEL_AS_FIT = f"""
    const fit = Math.ceil({style.BAND_LABEL_WIDTH} * centres.length / cb_obj.inner_width)
    const ticks = centres.filter((_, band) => band % Math.max(every, fit) == 0)
    if (ticks.length != ticker.ticks.length) {{ ticker.ticks = ticks }}
"""


def show_bands(plot, every=1):
    """Give a figure's frequency axis all bands, edge to edge; label every band, or one in some.

    Where labels would touch each other, as on a small screen, fewer bands are labelled.
    """
    plot.x_range = Range1d(*BAND_AXIS, bounds=BAND_AXIS)
    ticker = FixedTicker(ticks=list(tig.BAND_CENTRES[::every]), minor_ticks=[])
    plot.xaxis.ticker = ticker
    everything = {"ticker": ticker, "centres": list(tig.BAND_CENTRES), "every": every}
    plot.js_on_change("inner_width", CustomJS(args=everything, code=LABEL_AS_FIT))
    plot.xaxis.major_label_overrides = dict(zip(tig.BAND_CENTRES, tig.BAND_LABELS, strict=True))
    plot.xgrid.visible = False


def zero_line():
    """Return a line at zero on the value axis."""
    return Span(
        location=0, dimension="width", line_color=style.PRESET_GHOST, line_width=style.THIN_LINE_WIDTH
    )


def blank_figure(aria_label="", **options):
    """Return an empty figure with the tools that all have, and a name that screen readers tell."""
    plot = figure(
        html_attributes={
            "role": "figure",
            "aria-label": aria_label or options["y_axis_label"],
        },
        tools=[PanTool(), BoxZoomTool(), WheelZoomTool(dimensions="width"), ResetTool(), SaveTool()],
        toolbar_location="right",
        sizing_mode="stretch_width",
        **options,
    )
    plot.toolbar.logo = None
    plot.toolbar.autohide = True
    for axis in plot.axis:
        keep(axis, major_label_text_font_size=style.TICK_SIZES, axis_label_text_font_size=style.AXIS_SIZES)
    return plot


def keep(model, **looks):
    """Keep looks of a model that the page's theme would change, each for narrow and for wide windows."""
    for name, (narrow, wide) in looks.items():
        setattr(model, name, wide)
        model.js_on_change(name, CustomJS(args={"name": name, "narrow": narrow, "wide": wide}, code=KEEP))


KEEP = f"""
    const wanted = window.innerWidth < {style.NARROW_WINDOW} ? narrow : wide
    if (cb_obj[name] !== wanted) {{ cb_obj.setv({{[name]: wanted}}, {{sync: false}}) }}
"""
