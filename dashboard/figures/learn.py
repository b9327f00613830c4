"""The pictures of the tab in which a track is understood; built once, then fed.

One look for one thing: this design is blue, what theory says of it violet, what it is compared
with dashed or thin.
"""

from dataclasses import dataclass

import numpy as np
from bokeh.core.properties import value
from bokeh.events import Pan, Tap
from bokeh.models import ColumnDataSource, CustomJS, HoverTool, Range1d, Span

import trackig_core as tig
from dashboard import formats, theme
from dashboard.figures.axes import (
    BAND_AXIS,
    LEVEL_ROOM,
    LEVEL_STEP,
    AxisEnds,
    blank_figure,
    nice_step,
    show_bands,
    show_one_two_five,
    zero_line,
)
from dashboard.figures.legends import legend_above

LEAST_LEVELS = (-30.0, 15.0)
"""What a level axis shows at least [dB]."""

DEEPEST = -60.0
"""Level below which an axis does not follow a curve [dB]: a false dip may be deep."""


@dataclass(frozen=True)
class Curve:
    """How one curve looks.

    Attributes
    ----------
    column : str
        Column of the figure's source.
    words : str
        What the legend says.
    colour : str
        Its colour.
    dash : str or list of int
        Its dash.
    width : int
        Its width [px].
    """

    column: str
    words: str
    colour: str
    dash: str | list = "solid"
    width: int = theme.THIN_LINE_WIDTH


class BandsFigure:
    """Some curves of insertion gain per one-third-octave band.

    Parameters
    ----------
    name : str
        Name of the source; the figure's has ``_figure`` behind it.
    curves : sequence of Curve
        Curves.
    label : str
        What the value axis is called.

    Attributes
    ----------
    model : bokeh.plotting.figure
        The figure.
    bands : bokeh.models.ColumnDataSource
        ``label``, ``centre`` [Hz] and a column per curve [dB], NaN where there is none.
    """

    def __init__(self, name, curves, label="Insertion gain, dB"):
        self._columns = [curve.column for curve in curves]
        self.bands = ColumnDataSource(name=name, data=self._data({}))
        self._levels = AxisEnds(LEAST_LEVELS)
        self.model = blank_figure(
            name=f"{name}_figure",
            x_axis_type="log",
            y_range=self._levels.model,
            x_axis_label="One-third-octave band, Hz",
            y_axis_label=label,
            stylesheets=[theme.MEDIUM],
        )
        show_bands(self.model, every=2)
        self.model.add_layout(zero_line())
        for curve in curves:
            draw_curve(self.model, self.bands, "centre", curve)
        self._entries = dict(zip(self._columns, self.model.legend[0].items, strict=True))
        dots = self.model.scatter(
            x="centre",
            y=curves[0].column,
            source=self.bands,
            color=curves[0].colour,
            size=theme.DOT_SIZE - 2,
        )
        tooltips = [
            ("band", "@label Hz"),
            *((curve.words, f"@{curve.column}{{+0.0}} dB") for curve in curves),
        ]
        self.model.add_tools(HoverTool(renderers=[dots], mode="vline", tooltips=tooltips))
        legend_above(self.model)

    def name_axis(self, words):
        """Say on the axis which insertion gain is drawn."""
        self.model.yaxis.axis_label = words

    def show(self, also=(), **levels):
        """Draw levels per band by column (21,) [dB]; curves left out are not drawn; ``also`` must be seen."""
        seen = np.concatenate([*levels.values(), LEAST_LEVELS, also])
        seen = np.clip(seen[np.isfinite(seen)], DEEPEST, None)
        self._levels.show(seen.min() - LEVEL_ROOM, seen.max() + LEVEL_ROOM, LEVEL_STEP)
        self.bands.data = self._data(levels)
        for column, entry in self._entries.items():
            entry.visible = column in levels

    def _data(self, levels):
        nothing = np.full(tig.BAND_CENTRES.size, np.nan)
        return {
            "label": list(tig.BAND_LABELS),
            "centre": tig.BAND_CENTRES,
            "left": tig.BAND_EDGES[:-1],
            "right": tig.BAND_EDGES[1:],
            **{column: levels.get(column, nothing) for column in self._columns},
        }


def draw_curve(plot, source, x, curve):
    """Draw a curve of a source and name it in the legend."""
    return plot.line(
        x=x,
        y=curve.column,
        source=source,
        line_color=curve.colour,
        line_dash=curve.dash,
        line_width=curve.width,
        legend_label=curve.words,
    )


class PickFigure(BandsFigure):
    """Insertion gain with a cursor that is dragged, or put by a click, to a frequency.

    Attributes
    ----------
    cursor : bokeh.models.Span
        Named ``pick``; its ``location`` is the frequency [Hz], and follows the pointer in the browser.
    """

    def __init__(self, frequency):
        super().__init__("pick_bands", [Curve("level", "this design", theme.THIS_DESIGN)])
        # a drag moves the cursor, not the axis
        self.model.tools = [tool for tool in self.model.tools if isinstance(tool, HoverTool)]
        self.model.toolbar_location = None
        self.cursor = Span(
            name="pick",
            location=frequency,
            dimension="height",
            line_color=theme.LOADED_TRACK,
            line_width=theme.LINE_WIDTH,
        )
        self.model.add_layout(self.cursor)
        low, high = BAND_AXIS
        follow = CustomJS(
            args={"cursor": self.cursor},
            code=f"cursor.location = Math.min({high}, Math.max({low}, cb_obj.x))",
        )
        self.model.js_on_event(Tap, follow)
        self.model.js_on_event(Pan, follow)


class SweepFigure:
    """Natural frequencies against one slider, lumped model beside beam.

    Attributes
    ----------
    model : bokeh.plotting.figure
        The figure.
    sweep : bokeh.models.ColumnDataSource
        Named ``sweep``: ``value`` [display unit] and a column per curve [Hz].
    present : bokeh.models.ColumnDataSource
        Named ``present``: ``value`` and ``frequency`` [Hz] of the current design.
    """

    CURVES = (
        Curve("uncoupled_wheel", "uncoupled wheel", theme.PRESET_GHOST, [2, 3], 1),
        Curve("uncoupled_block", "uncoupled block", theme.PRESET_GHOST, [7, 4], 1),
        Curve("lower", "lumped model, lower", theme.LOADED_TRACK, theme.SECOND_DASH),
        Curve("upper", "lumped model, upper", theme.COUPLED_BLOCK, theme.SECOND_DASH),
        Curve("loaded_track", "beam: loaded track", theme.LOADED_TRACK, width=theme.LINE_WIDTH),
        Curve("coupled_block", "beam: coupled block", theme.COUPLED_BLOCK, width=theme.LINE_WIDTH),
        Curve("cut_on", "beam: waves begin", theme.THEORY, [1, 3]),
    )

    def __init__(self):
        columns = ("value", *(curve.column for curve in self.CURVES))
        self.sweep = ColumnDataSource(name="sweep", data={key: [] for key in columns})
        self.present = ColumnDataSource(name="present", data={"value": [], "frequency": []})
        self._frequencies = Range1d(10, 1000)
        self.model = blank_figure(
            name="sweep_figure",
            x_axis_type="log",
            y_axis_type="log",
            x_range=Range1d(1, 10),
            y_range=self._frequencies,
            y_axis_label="Natural frequency, Hz",
            stylesheets=[theme.HIGH],
        )
        for axis in (self.model.xaxis[0], self.model.yaxis[0]):
            show_one_two_five(axis)
        self._now = Span(
            dimension="height", line_color=theme.PRESET_GHOST, line_width=1, name="present_value"
        )
        self.model.add_layout(self._now)
        lines = [draw_curve(self.model, self.sweep, "value", curve) for curve in self.CURVES]
        self.model.scatter(
            x="value",
            y="frequency",
            source=self.present,
            size=2 * theme.DOT_SIZE,
            line_color=theme.THIS_DESIGN,
            fill_color=theme.THIS_DESIGN,
            legend_label="this design",
        )
        tooltips = [("value", "@value"), *((c.words, f"@{c.column}{{0.0}} Hz") for c in self.CURVES)]
        self.model.add_tools(HoverTool(renderers=[lines[2]], mode="vline", tooltips=tooltips))
        legend_above(self.model, columns=3)

    def show(self, label, values, sweep):
        """Draw a sweep.

        Parameters
        ----------
        label : str
            What is varied, with its unit.
        values : numpy.ndarray (values,)
            Its values as they are shown.
        sweep : trackig_core.FrequencySweep
            The frequencies.
        """
        missing = np.full(values.size, np.nan)
        coupled, uncoupled = ([*rows, missing][:2] for rows in (sweep.lumped_coupled, sweep.lumped_uncoupled))
        data = {
            "value": values,
            "loaded_track": sweep.loaded_track,
            "coupled_block": sweep.coupled_block,
            "cut_on": sweep.cut_on,
            "lower": coupled[0],
            "upper": coupled[1],
            "uncoupled_wheel": uncoupled[0],
            "uncoupled_block": uncoupled[1],
        }
        drawn = np.concatenate([data[curve.column] for curve in self.CURVES])
        self.model.xaxis.axis_label = label
        self.model.x_range.update(start=values[0], end=values[-1])
        self._frequencies.update(start=np.nanmin(drawn) / 1.15, end=np.nanmax(drawn) * 1.15)
        self.sweep.data = data

    def point(self, value, frequencies):
        """Mark the current design: its value, and its natural frequencies [Hz]."""
        self._now.location = value
        self.present.data = {"value": [value] * len(frequencies), "frequency": list(frequencies)}


class SlopesFigure(BandsFigure):
    """Insertion gain, and on demand the straight asymptotes of its lumped model.

    Attributes
    ----------
    lines : bokeh.models.ColumnDataSource
        Named ``asymptotes``: ends ``x0``, ``y0``, ``x1``, ``y1`` [Hz and dB], the place and ``words`` of each
        label, empty for the track without blocks, and its ``colour``.
    """

    CURVES = (
        Curve("level", "this design", theme.THIS_DESIGN, width=theme.LINE_WIDTH),
        Curve("one_stage", "as stiff, without blocks", theme.LOADED_TRACK, theme.SECOND_DASH),
    )

    def __init__(self):
        super().__init__("slopes", self.CURVES)
        names = ("x0", "y0", "x1", "y1", "x", "y", "words", "colour")
        self.lines = ColumnDataSource(name="asymptotes", data={key: [] for key in names})
        self.drawn = [
            self.model.segment(
                x0="x0", y0="y0", x1="x1", y1="y1", source=self.lines, line_color="colour",
                line_width=theme.THIN_LINE_WIDTH, line_dash=[2, 3],
            ),
            self.model.text(
                x="x", y="y", text="words", source=self.lines, text_color="colour", x_offset=-8, y_offset=4,
                text_font=value(theme.FONT), text_font_size=theme.SIDE_VIEW_LABEL_SIZE, text_align="right",
                text_baseline="top",
            ),
        ]  # fmt: skip

    def draw_asymptotes(self, own, one_stage):
        """Draw asymptotes of this design, with their slopes, and of the track without blocks.

        Parameters
        ----------
        own, one_stage : sequence of trackig_core.Asymptote
            Straight lines.
        """
        rows = [
            *((theme.THIS_DESIGN, line) for line in own),
            *((theme.LOADED_TRACK, line) for line in one_stage),
        ]
        named = len(own)
        self.lines.data = {
            "x0": [line.frequency[0] for _, line in rows],
            "x1": [line.frequency[1] for _, line in rows],
            "y0": [line.level[0] for _, line in rows],
            "y1": [line.level[1] for _, line in rows],
            "x": [np.sqrt(line.frequency[0] * line.frequency[1]) for _, line in rows],
            "y": [(line.level[0] + line.level[1]) / 2 for _, line in rows],
            "words": [
                formats.slope_text(line.slope) if number < named else ""
                for number, (_, line) in enumerate(rows)
            ],
            "colour": [colour for colour, _ in rows],
        }

    def show_asymptotes(self, visible):
        """Show the asymptotes, or hide them."""
        for renderer in self.drawn:
            renderer.visible = visible


class StiffReferenceFigure:
    """Force of very stiff tracks over that of the rigid track, in narrow bands.

    Attributes
    ----------
    model : bokeh.plotting.figure
        The figure.
    levels : bokeh.models.ColumnDataSource
        Named ``stiff_reference``: ``frequency`` [Hz], ``real`` and ``stiffened`` [dB].
    """

    CURVES = (
        Curve("real", "very stiff, contact spring as it is", theme.SPECIFICATION, theme.SECOND_DASH),
        Curve("stiffened", "very stiff, contact stiffened too", theme.COUPLED_BLOCK, width=theme.LINE_WIDTH),
    )

    def __init__(self):
        columns = ("frequency", *(curve.column for curve in self.CURVES))
        self.levels = ColumnDataSource(name="stiff_reference", data={key: [] for key in columns})
        self._ends = AxisEnds((-20.0, 60.0))
        self.model = blank_figure(
            name="stiff_reference_figure",
            x_axis_type="log",
            y_range=self._ends.model,
            x_axis_label="Frequency, Hz",
            y_axis_label="Force over the rigid track's, dB",
            stylesheets=[theme.MEDIUM],
        )
        show_bands(self.model, every=2)
        self.model.add_layout(zero_line())
        for curve in self.CURVES:
            draw_curve(self.model, self.levels, "frequency", curve)
        legend_above(self.model)

    def show(self, references):
        """Draw the levels of both (trackig_core.StiffReferences)."""
        seen = np.concatenate([references.real, references.stiffened])
        low, high = seen.min() - LEVEL_ROOM, seen.max() + LEVEL_ROOM
        self._ends.show(low, high, nice_step(high - low))
        self.levels.data = {
            "frequency": references.frequency,
            "real": references.real,
            "stiffened": references.stiffened,
        }


class LumpedVsBeamFigure(BandsFigure):
    """Insertion gain of the lumped model beside that of the beam; where it will do, bands are shaded."""

    CURVES = (
        Curve("beam", "beam: rail, waves and all", theme.THIS_DESIGN, width=theme.LINE_WIDTH),
        Curve("lumped", "lumped model: wheel, block, springs", theme.LOADED_TRACK, theme.SECOND_DASH),
    )

    def __init__(self):
        super().__init__("ladder", self.CURVES)
        self.good = ColumnDataSource(name="good_enough", data={"left": [], "right": []})
        self.model.vstrip(
            x0="left",
            x1="right",
            source=self.good,
            fill_color=theme.COUPLED_BLOCK,
            fill_alpha=theme.FILL_ALPHA,
            line_color=None,
            level="underlay",
            legend_label=f"within {tig.GOOD_ENOUGH:g} dB",
        )

    def show_comparison(self, comparison):
        """Draw a trackig_core.LumpedComparison."""
        self.show(beam=comparison.beam, lumped=comparison.lumped)
        good = comparison.good_enough
        self.good.data = {"left": tig.BAND_EDGES[:-1][good], "right": tig.BAND_EDGES[1:][good]}
