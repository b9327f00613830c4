"""Insertion gain per one-third-octave band: the picture that follows the slider.

Built once with Bokeh, then fed by assigning each data source's ``data``. Hz and dB.
"""

import math

import numpy as np
from bokeh.core.properties import value
from bokeh.models import (
    ColumnDataSource,
    CustomJSHover,
    GlyphRenderer,
    HoverTool,
    Label,
    Quad,
    Segment,
    Span,
    Text,
    VArea,
)

import trackig_core as tig
from dashboard import formats, theme
from dashboard.figures.axes import (
    BAND_AXIS,
    LEVEL_ROOM,
    LEVEL_STEP,
    AxisEnds,
    blank_figure,
    show_bands,
    zero_line,
)
from dashboard.figures.legends import (
    NO_LABEL,
    Legend,
    PinnedLines,
    are_the_same,
    solved_entry,
    with_legend,
)
from dashboard.figures.swatches import (
    excess_svg,
    extrapolated_svg,
    limit_svg,
    point_svg,
    swatch_svg,
)
from trackig_core.bands import ONE_THIRD_OCTAVES
from trackig_core.levels.specification import LEVEL_TOLERANCE

LEAST_LEVELS = (-28.0, 18.0)
"""What the level axis shows at least, without the room [dB]."""

LABEL_FLIPS = 0.75
"""Part of the frequency axis from which on a marker's label stands to the left of its line."""


class _Marker:
    """A natural frequency as a vertical line, its label above the frame where no curve can reach it."""

    def __init__(self, plot, name, words, colour):
        self._words = words
        self.line = Span(
            name=name,
            location=BAND_AXIS[0],
            dimension="height",
            line_color=colour,
            line_width=theme.THIN_LINE_WIDTH,
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
            text_font=theme.FONT,
            text_font_size=theme.MARKER_LABEL_SIZE,
            text_font_style="bold",
        )
        plot.add_layout(self.line)
        plot.add_layout(self.label, "above")

    def show(self, frequency, ends=BAND_AXIS):
        if frequency is None:
            self.line.visible, self.label.text = False, NO_LABEL
            return
        low, high = ends
        place = math.log(frequency / low) / math.log(high / low)
        text = f"{self._words} {formats.frequency_text(frequency)}"
        self.line.update(location=frequency, visible=0 <= place <= 1)
        self.label.update(
            x=min(max(frequency, low), high),
            text=f"{text} →" if place > 1 else f"← {text}" if place < 0 else text,
            text_align="left" if place < LABEL_FLIPS else "right",
        )


class InsertionGainFigure:
    """Insertion gain per one-third-octave band, with the natural frequencies marked.

    Attributes
    ----------
    model : bokeh.plotting.figure
        The figure.
    legend : Legend
        What is drawn, in words.
    layout : bokeh.models.Column
        The figure, and its legend below it.
    bands : bokeh.models.ColumnDataSource
        Named ``insertion_gain``: per band its ``label``, ``centre``, ``left`` and ``right`` edge [Hz], the
        ``level`` of the design and that of its ``preset`` [dB], NaN when there is none to compare with.
    pins : bokeh.models.ColumnDataSource
        Named ``pins``: per band its ``label``, its ``centre`` [Hz] and levels ``pin_0`` to ``pin_7`` [dB],
        NaN when there are not so many.
    limit : bokeh.models.ColumnDataSource
        Named ``limit``: per band its edges, the required ``limit`` [dB], ``before``, that of the band to the
        left, and ``failing``, the level of the design where it exceeds the limit; NaN where there is none.
    extrapolated : bokeh.models.ColumnDataSource
        Named ``extrapolated``: edges of the bands of the design that rest on more than was measured [Hz].
    measured : bokeh.models.ColumnDataSource
        Named ``measured``: per band its ``centre`` [Hz] and levels ``curve_0`` to ``curve_3`` from elsewhere
        [dB], NaN where there is none.
    production : bokeh.models.ColumnDataSource
        Named ``production``: per band its ``centre`` [Hz], and the ``low`` and ``high`` end of insertion gain
        of nine in ten of production [dB]; empty when there is none.
    """

    def __init__(self):
        self.bands = ColumnDataSource(
            name="insertion_gain", data=_band_columns(ONE_THIRD_OCTAVES, NO_LEVELS, NO_LEVELS)
        )
        self.pins = ColumnDataSource(name="pins", data=pin_columns(()))
        self.limit = ColumnDataSource(name="limit", data=_limit_columns(NO_LEVELS, NO_LEVELS))
        self.extrapolated = ColumnDataSource(name="extrapolated", data={"left": [], "right": []})
        self.measured = ColumnDataSource(name="measured", data=_measured_columns(()))
        self.production = ColumnDataSource(name="production", data=NO_PRODUCTION)
        self._measured, self._points = (), []
        self._drawn, self._limited, self._limit_drawn, self._production_drawn = (), False, False, False
        self._beyond, self._beyond_drawn = (), False
        self._levels = AxisEnds((-30.0, 20.0))
        self.model = blank_figure(
            name="insertion_gain_figure",
            aria_label="Insertion gain per one-third-octave band",
            x_axis_type="log",
            y_range=self._levels.model,
            x_axis_label="One-third-octave band, Hz",
            y_axis_label="Insertion gain, dB",
            stylesheets=[theme.TALL],
        )
        self.legend = Legend("insertion_gain_figure")
        self.layout = with_legend(self.model, self.legend)
        self._draw_bands()
        self._loaded_track = _Marker(self.model, "loaded_track", "loaded track", theme.LOADED_TRACK)
        self._coupled_block = _Marker(self.model, "coupled_block", "coupled block", theme.COUPLED_BLOCK)

    def _draw_bands(self):
        plot = self.model
        self._axis = show_bands(plot)
        plot.add_layout(zero_line())
        self._fill = plot.quad(
            left="left",
            right="right",
            bottom=0,
            top="level",
            source=self.bands,
            fill_color=theme.THIS_DESIGN,
            fill_alpha=theme.FILL_ALPHA,
            line_color=None,
        )
        shared = {"source": self.bands, "x": "centre"}
        self._ghost = plot.line(
            y="preset",
            line_color=theme.PRESET_GHOST,
            line_width=theme.THIN_LINE_WIDTH,
            line_dash="dashed",
            **shared,
        )
        names = [f"pin_{place}" for place in range(theme.MOST_PINNED)]
        self._pinned = PinnedLines(plot, self._ghost, [self.pins] * theme.MOST_PINNED, "centre", names)
        self._line = plot.line(y="level", line_color=theme.THIS_DESIGN, line_width=theme.LINE_WIDTH, **shared)
        self._dots = plot.scatter(y="level", color=theme.THIS_DESIGN, size=theme.DOT_SIZE, **shared)
        pinned = CustomJSHover(args={"pins": self.pins}, code=PIN_HOVER)
        self._hover = HoverTool(
            renderers=[self._dots], mode="vline", tooltips=TOOLTIPS, formatters={"@centre": pinned}
        )
        plot.add_tools(self._hover)

    def _draw_limit(self):
        """Draw the limit and what exceeds it, behind all curves; without a limit there is nothing to draw."""
        plot, colour = self.model, theme.SPECIFICATION
        width = theme.LIMIT_LINE_WIDTH
        required = Segment(x0="left", x1="right", y0="limit", y1="limit", line_color=colour, line_width=width)
        riser = Segment(x0="left", x1="left", y0="before", y1="limit", line_color=colour, line_width=width)
        failing = Quad(
            left="left",
            right="right",
            bottom="limit",
            top="failing",
            fill_color=None,
            line_color=colour,
            line_width=theme.THIN_LINE_WIDTH,
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
            text_font_size=theme.FAILING_SIZE,
            y_offset=-3,
        )
        parts = [
            GlyphRenderer(data_source=self.limit, glyph=glyph) for glyph in (required, riser, failing, cross)
        ]
        behind = plot.renderers.index(self._fill) + 1
        plot.renderers[behind:behind] = parts
        self._limit_drawn = True

    def _show_extrapolated(self, bands):
        """Hatch bands that rest on extrapolation over the whole height, behind all else."""
        if bands == self._beyond:
            return
        self._beyond = bands
        if not self._beyond_drawn:
            self._draw_extrapolated()
        at = [tig.BAND_LABELS.index(band) for band in bands]
        self.extrapolated.data = {"left": tig.BAND_EDGES[:-1][at], "right": tig.BAND_EDGES[1:][at]}

    def _draw_extrapolated(self):
        hatching = Quad(
            left="left",
            right="right",
            bottom=-HIGHER_THAN_ANY,
            top=HIGHER_THAN_ANY,
            fill_color=None,
            line_color=None,
            hatch_pattern="left_diagonal_line",
            hatch_color=theme.EXTRAPOLATED,
            hatch_alpha=0.35,
            hatch_weight=1,
            hatch_scale=14,
        )
        self.model.renderers.insert(0, GlyphRenderer(data_source=self.extrapolated, glyph=hatching))
        self._beyond_drawn = True

    def _draw_production(self):
        """Draw the range of production behind all else; a figure pays at every frame for what it has."""
        area = VArea(
            x="centre",
            y1="low",
            y2="high",
            fill_color=theme.THIS_DESIGN,
            fill_alpha=theme.FILL_ALPHA,
            hatch_pattern="dot",
            hatch_color=theme.THIS_DESIGN,
            hatch_alpha=theme.BAR_ALPHA,
            hatch_scale=6,
        )
        self.model.renderers.insert(0, GlyphRenderer(data_source=self.production, glyph=area))
        self._production_drawn = True

    def name_axis(self, words):
        """Say on the axis which insertion gain is drawn."""
        self.model.yaxis.axis_label = words

    def show(self, current, pinned=(), preset=None, limit=None, alone=False, measured=(), production=None):
        """Draw insertion gain, and behind it that of the preset it departs from and of pinned designs.

        Parameters
        ----------
        current : DesignResult
            The current design, solved; its natural frequencies are marked, and bands hatched that rest on
            extrapolation of what was measured.
        pinned : tuple of DesignResult
            Pinned designs, solved; the same ones again are not sent again.
        preset : DesignResult or None
            The preset from which the current design departs, if it does.
        limit : numpy.ndarray (21,) or None
            Greatest insertion gain allowed [dB], NaN in bands that have no limit.
        alone : bool
            Whether the pinned designs stand alone: then of the current design nothing is drawn.
        measured : tuple of trackig_core.levels.MeasuredGain
            Up to four curves from elsewhere, drawn as points.
        production : numpy.ndarray (2, 21) or None
            Insertion gain below which 5 and 95 % of production lie [dB].
        """
        gain, natural = current.shown_gain, current.summary.solution.natural_frequencies
        levels, is_new = gain.levels, gain.bands != self._axis.bands
        self._axis.show(gain.bands)
        preset = np.full(levels.size, np.nan) if preset is None or alone else preset.shown_gain.levels
        self.bands.data = _band_columns(gain.bands, levels, preset)
        # limits, measured curves and production stay in the bands that they are given in
        self._show_limit(limit, NO_LEVELS if alone else current.levels)
        self._show_extrapolated(() if alone else current.extrapolated_bands)
        self._show_production(None if alone else production)
        for part in (self._fill, self._line, self._dots):
            part.visible = not alone
        self._loaded_track.show(None if alone else natural.loaded_track, self._axis.ends)
        self._coupled_block.show(None if alone else natural.coupled_block, self._axis.ends)
        self._show_pinned(pinned, is_new)
        self._pinned.set_off(None if alone else current)
        self._show_measured(measured)
        self._name_on_hover(pinned, alone)
        self._list_what_is_drawn(pinned)
        seen = [
            NO_LEVELS if alone else levels,
            preset,
            self.limit.data["limit"],
            self.production.data["low"],
            self.production.data["high"],
            *(each.shown_gain.levels for each in pinned),
            *(each.levels for each in measured),
            LEAST_LEVELS,
        ]
        every = np.concatenate(seen)
        self._levels.show(np.nanmin(every) - LEVEL_ROOM, np.nanmax(every) + LEVEL_ROOM, LEVEL_STEP)

    def _show_limit(self, limit, levels):
        if limit is None and not self._limited:
            return
        if limit is not None and not self._limit_drawn:
            self._draw_limit()
        self._limited = limit is not None
        self.limit.data = _limit_columns(NO_LEVELS if limit is None else limit, levels)

    def _show_production(self, production):
        if production is None and not len(self.production.data["low"]):
            return
        if production is not None and not self._production_drawn:
            self._draw_production()
        self.production.data = (
            NO_PRODUCTION
            if production is None
            else {"centre": tig.BAND_CENTRES, "low": production[0], "high": production[1]}
        )

    def _show_pinned(self, pinned, in_new_bands):
        if are_the_same(pinned, self._drawn) and not in_new_bands:
            return
        self._drawn = pinned
        self.pins.data = pin_columns([each.shown_gain.levels for each in pinned], self._axis.bands)
        self._pinned.show(pinned)

    def _show_measured(self, measured):
        if are_the_same(measured, self._measured):
            return
        self._measured = measured
        self.measured.data = _measured_columns(measured)
        for place in range(len(self._points), len(measured)):
            self._points.append(
                self.model.scatter(
                    x="centre",
                    y=f"curve_{place}",
                    source=self.measured,
                    marker=MEASURED_MARKERS[place],
                    size=theme.DOT_SIZE + 2,
                    line_color=theme.THEORY,
                    line_width=2,
                    fill_color=None,
                )
            )
        for place, points in enumerate(self._points):
            points.visible = place < len(measured)

    def _name_on_hover(self, pinned, alone):
        """Say what is drawn when the pointer rests on a band."""
        tooltips = ALONE_TOOLTIPS if alone else TOOLTIPS
        self._hover.update(
            renderers=self._pinned.lines[:1] if alone else [self._dots],
            tooltips=tooltips + [(each.name, f"@centre{{{place}}}") for place, each in enumerate(pinned)],
        )

    def _list_what_is_drawn(self, pinned):
        data, limit = self.bands.data, self.limit.data
        drawn = [
            (self._line.visible, THIS_DESIGN),
            (np.isfinite(data["preset"]).any(), AS_IN_TABLE_1),
            (len(self.production.data["low"]) > 0, PRODUCTION),
            (np.isfinite(limit["limit"]).any(), REQUIRED),
            (np.isfinite(limit["failing"]).any(), EXCEEDS),
            (bool(self._beyond), EXTRAPOLATED),
        ]
        points = zip(self._measured, MEASURED_MARKERS, strict=False)
        self.legend.show(
            [
                *(entry for there, entry in drawn if there),
                *map(solved_entry, pinned),
                *((f"{MEASURED} {each.name}", point_svg(shape, theme.THEORY)) for each, shape in points),
            ]
        )


THIS_DESIGN = ("this design", swatch_svg(theme.THIS_DESIGN, dot=True))
AS_IN_TABLE_1 = ("as in Table 1", swatch_svg(theme.PRESET_GHOST, theme.SECOND_DASH))
PRODUCTION = ("5 to 95 % of production", swatch_svg(theme.THIS_DESIGN, (2, 2)))
REQUIRED, EXCEEDS = ("required maximum", limit_svg()), ("exceeds it", excess_svg())
EXTRAPOLATED = (formats.extrapolated_text("this design"), extrapolated_svg())
"""What the legend says beside the names of pinned designs."""

HIGHER_THAN_ANY = 1e3
"""A level that no axis reaches [dB]."""

MEASURED = "measured:"
"""What the legend says before the name of a curve from elsewhere, so that nobody takes it for a limit."""

MEASURED_MARKERS = tuple(theme.MARKERS)
"""Markers of curves from elsewhere, in their order."""

NO_LEVELS = np.full(tig.BAND_CENTRES.size, np.nan)

NO_LEVELS.flags.writeable = False

NO_PRODUCTION = {"centre": [], "low": [], "high": []}

ALONE_TOOLTIPS = [("band", "@label Hz")]

TOOLTIPS = [*ALONE_TOOLTIPS, ("this design", "@level_text"), ("as in Table 1", "@preset_text")]

PIN_HOVER = """
    const level = pins.data["pin_" + format][special_vars.index]
    return (level < 0 ? "\u2212" : "+") + Math.abs(level).toFixed(1) + " dB"
"""


def _band_columns(bands, levels, preset):
    return {
        "label": list(bands.labels),
        "centre": bands.centres,
        "left": bands.edges[:-1],
        "right": bands.edges[1:],
        "level": levels,
        "preset": preset,
        "level_text": list(map(_level_text, levels)),
        "preset_text": list(map(_level_text, preset)),
    }


def _level_text(level):
    return formats.level_text(level) if np.isfinite(level) else "–"


def pin_columns(levels, bands=ONE_THIRD_OCTAVES):
    """Return the columns of a source that holds levels (bands,) [dB] of each pin, NaN for those missing."""
    nothing = [np.full(bands.centres.size, np.nan)] * (theme.MOST_PINNED - len(levels))
    columns = {f"pin_{place}": each for place, each in enumerate([*levels, *nothing])}
    return {"label": list(bands.labels), "centre": bands.centres, **columns}


def _measured_columns(measured):
    missing = len(MEASURED_MARKERS) - len(measured)
    levels = [*(each.levels for each in measured), *[NO_LEVELS] * missing]
    return {"centre": tig.BAND_CENTRES} | {f"curve_{place}": each for place, each in enumerate(levels)}


def _limit_columns(limit, levels):
    # comparing with NaN is false, as it is meant to be
    exceeded = levels - limit > LEVEL_TOLERANCE
    return {
        "centre": tig.BAND_CENTRES,
        "left": tig.BAND_EDGES[:-1],
        "right": tig.BAND_EDGES[1:],
        "limit": limit,
        "before": np.concatenate([[np.nan], limit[:-1]]),
        "failing": np.where(exceeded, levels, np.nan),
    }
