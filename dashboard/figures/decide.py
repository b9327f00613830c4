"""The pictures of a decision: what matters, how sure it is, where designs comply, and which were found.

Built once with Bokeh, then fed by assigning each data source's ``data``. Quantities are in display units.
"""

import numpy as np
from bokeh.events import Tap
from bokeh.models import (
    BasicTicker,
    BoxSelectTool,
    ColorBar,
    ColumnDataSource,
    FactorRange,
    FixedTicker,
    HoverTool,
    LinearColorMapper,
    Range1d,
    Scatter,
    TapTool,
)
from bokeh.palettes import RdBu11, Viridis256
from bokeh.plotting import figure
from bokeh.plotting.contour import contour_data

import trackig_core as tig
from dashboard import theme
from dashboard.fields import ASKED_FIELDS
from dashboard.figures.axes import (
    KEYS,
    LEVEL_ROOM,
    LEVEL_STEP,
    AxisEnds,
    blank_figure,
    dress,
    show_bands,
    show_one_two_five,
    zero_line,
)
from dashboard.figures.legends import Legend, legend_above, with_legend
from dashboard.figures.swatches import marker_svg, swatch_svg
from dashboard.formats import change_text
from dashboard.session.answers import BETTER, scale_title

LESS, MORE = RdBu11[2], RdBu11[8]
"""Colours of less vibration, blue, and of more, red, seen on light and on dark paper and told apart by
colour-blind readers."""

DIVERGING = tuple(
    f"{LESS if step < 0 else MORE}{round(255 * abs(step)):02x}" for step in np.linspace(-1.0, 1.0, 11)
)
"""Colours from less to more, the paper itself between them: the less a change, the less is to be seen."""

CELL = 0.9
"""Height of a cell of a heat map, of the room that a field has [-]."""

LEAST_CHANGE = 0.1
"""What the scale of a heat map reaches at least on either side [dB]."""

TORNADO_TICKS = 4
"""Ticks that the axis of a tornado aims at [-]: labels such as −0.025 then fit into a narrow window."""

MOST_DRAWN = 1000
"""Designs of a search that are drawn [-]: the front, and of the rest as many as fit."""

MOST_CURVES = 40
"""Curves of selected designs that are drawn [-]."""


BANDS = {"centre": tig.BAND_CENTRES, "left": tig.BAND_EDGES[:-1], "right": tig.BAND_EDGES[1:]}
"""Columns that every source over bands has [Hz]."""


class ChangeFigure:
    """How insertion gain changes in each band with each field: a heat map of fields by bands.

    Attributes
    ----------
    model : bokeh.plotting.figure
        The figure.
    cells : bokeh.models.ColumnDataSource
        Named ``changes``: per cell its ``field``, its ``band``, its edges and the ``change`` of insertion
        gain [dB], also as ``text``.
    """

    COLUMNS = ("field", "band", "left", "right", "bottom", "top", "change", "text")

    def __init__(self):
        self.cells = ColumnDataSource(name="changes", data={name: [] for name in self.COLUMNS})
        self._fields = FactorRange(factors=[])
        self._colours = LinearColorMapper(palette=DIVERGING, low=-1.0, high=1.0)
        self.model = plot = figure(
            name="change_figure",
            x_axis_type="log",
            y_range=self._fields,
            x_axis_label="One-third-octave band, Hz",
            stylesheets=[theme.MEDIUM],
        )
        dress(plot, "Change of insertion gain per field and band")
        show_bands(plot)
        plot.ygrid.visible = False
        cells = plot.quad(
            left="left",
            right="right",
            bottom="bottom",
            top="top",
            source=self.cells,
            fill_color={"field": "change", "transform": self._colours},
            line_color=None,
        )
        plot.add_layout(ColorBar(color_mapper=self._colours, title="dB; blue: better", width=12), "right")
        plot.add_tools(
            HoverTool(
                renderers=[cells],
                tooltips=[("field", "@field"), ("band", "@band Hz"), ("change", "@text dB")],
            )
        )

    def show(self, labels, changes):
        """Draw changes.

        Parameters
        ----------
        labels : sequence of str
            What the fields are called, from the top down.
        changes : numpy.ndarray (fields, 21)
            Change of insertion gain [dB].
        """
        bands = len(tig.BAND_LABELS)
        self._fields.factors = list(labels)[::-1]
        reach = max(LEAST_CHANGE, float(np.abs(changes).max()))
        self._colours.update(low=-reach, high=reach)
        self.cells.data = {
            "field": np.repeat(labels, bands).tolist(),
            "band": list(tig.BAND_LABELS) * len(labels),
            "left": np.tile(tig.BAND_EDGES[:-1], len(labels)),
            "right": np.tile(tig.BAND_EDGES[1:], len(labels)),
            "bottom": [(label, -CELL / 2) for label in labels for _ in range(bands)],
            "top": [(label, CELL / 2) for label in labels for _ in range(bands)],
            "change": changes.ravel(),
            "text": list(map(change_text, changes.ravel())),
        }


class TornadoFigure:
    """How one figure changes with each field, the field that matters most on top.

    Attributes
    ----------
    model : bokeh.plotting.figure
        The figure.
    bars : bokeh.models.ColumnDataSource
        Named ``tornado``: per field its name, the change when it is ``less`` and when it is ``more``, and
        both as text.
    """

    COLUMNS = ("field", "less", "more", "less_text", "more_text")

    def __init__(self):
        self.bars = ColumnDataSource(name="tornado", data={name: [] for name in self.COLUMNS})
        self._fields = FactorRange(factors=[])
        self.model = plot = figure(
            name="tornado_figure",
            x_range=Range1d(-1.0, 1.0),
            y_range=self._fields,
            x_axis_label="Change",
            stylesheets=[theme.MEDIUM],
        )
        dress(plot, "Change of a figure with each field")
        plot.ygrid.visible = False
        # changes of a hundredth have long labels, which would run into each other
        plot.xaxis.ticker = plot.xgrid.ticker = BasicTicker(desired_num_ticks=TORNADO_TICKS)
        plot.add_layout(zero_line("height"))
        sides = (
            ("less", theme.PRESET_GHOST, "", 0.2),
            ("more", theme.THIS_DESIGN, "right_diagonal_line", -0.2),
        )
        for column, colour, hatch, _ in sides:
            plot.hbar(
                y="field",
                right=column,
                height=0.7,
                source=self.bars,
                fill_color=colour,
                fill_alpha=theme.BAR_ALPHA,
                line_color=colour,
                hatch_pattern=hatch or None,
                hatch_color=colour,
                legend_label=column,
            )
        legend_above(plot)
        plot.add_tools(
            HoverTool(tooltips=[("field", "@field"), ("less", "@less_text"), ("more", "@more_text")])
        )

    def show(self, labels, changes, axis):
        """Draw changes.

        Parameters
        ----------
        labels : sequence of str
            What the fields are called, the one that matters most first.
        changes : numpy.ndarray (fields, 2)
            Change of the figure when the field is less and when it is more.
        axis : str
            What is drawn, with its unit.
        """
        self._fields.factors = list(labels)[::-1]
        self.model.xaxis.axis_label = axis
        _fit(self.model.x_range, np.append(changes, 0.0))
        self.bars.data = {
            "field": list(labels),
            "less": changes[:, 0],
            "more": changes[:, 1],
            "less_text": list(map(change_text, changes[:, 0])),
            "more_text": list(map(change_text, changes[:, 1])),
        }


class PercentileFigure:
    """Insertion gain of production, band by band: median and the range of nine in ten, beside the limit.

    Attributes
    ----------
    model : bokeh.plotting.figure
        The figure.
    bands : bokeh.models.ColumnDataSource
        Named ``percentiles``: per band its ``centre`` [Hz], ``low``, ``median``, ``high``, ``stated`` and
        ``limit`` [dB].
    """

    COLUMNS = ("low", "median", "high", "stated", "limit")

    def __init__(self):
        none = np.full(tig.BAND_CENTRES.size, np.nan)
        self.bands = ColumnDataSource(name="percentiles", data=BANDS | dict.fromkeys(self.COLUMNS, none))
        self._ends = AxisEnds((-30.0, 20.0))
        self.model = plot = blank_figure(
            name="percentile_figure",
            aria_label="Insertion gain of production per one-third-octave band",
            x_axis_type="log",
            y_range=self._ends.model,
            x_axis_label="One-third-octave band, Hz",
            y_axis_label="Insertion gain, dB",
            stylesheets=[theme.MEDIUM],
        )
        show_bands(plot)
        plot.add_layout(zero_line())
        shared = {"x": "centre", "source": self.bands}
        plot.varea(
            y1="low",
            y2="high",
            fill_color=theme.THIS_DESIGN,
            fill_alpha=theme.FILL_ALPHA,
            legend_label="5 % to 95 % of production",
            **shared,
        )
        lines = (
            ("median", "median", theme.THIS_DESIGN, "solid"),
            ("stated", "as stated", theme.PRESET_GHOST, "dashed"),
        )
        for column, words, colour, dash in lines:
            plot.line(
                y=column,
                line_color=colour,
                line_dash=dash,
                line_width=theme.THIN_LINE_WIDTH,
                legend_label=words,
                **shared,
            )
        _draw_limit(plot, self.bands, legend_label="required maximum")
        legend_above(plot)

    def show(self, percentiles, stated, limit):
        """Draw insertion gain at 5, 50, 95 % of production (3, 21), as stated (21,), and the limit [dB]."""
        self.bands.data = BANDS | dict(zip(self.COLUMNS, (*percentiles, stated, limit), strict=True))
        seen = np.concatenate([*percentiles, stated, limit])
        self._ends.show(np.nanmin(seen) - LEVEL_ROOM, np.nanmax(seen) + LEVEL_ROOM, LEVEL_STEP)


class MapFigure:
    """A figure of designs over two of their fields, with the edge of compliance.

    Designs are chosen by a tap, or by keys that move a cross over the points of the map.

    Parameters
    ----------
    on_tap : callable
        Called with the values of both fields [display units] where the user taps.

    Attributes
    ----------
    model : bokeh.plotting.figure or None
        The figure; a new one for other fields, since an axis is logarithmic or it is not.
    legend : Legend or None
        What is drawn, in words.
    layout : bokeh.models.Column or None
        The figure, and its legend below it.
    marks : bokeh.models.ColumnDataSource
        Named ``map_marks``: where the current design and the pinned ones lie [display units].
    cross : bokeh.models.ColumnDataSource
        Named ``map_cross``: where keys have moved the cross [display units]; nowhere as long as none has.
    """

    def __init__(self, on_tap):
        self._on_tap = on_tap
        self.model = self.legend = self.layout = None
        self._found, self._edges, self._place = None, [], None
        self.marks = ColumnDataSource(name="map_marks", data={name: [] for name in MARK_COLUMNS})
        self.cross = ColumnDataSource(name="map_cross", data={"x": [], "y": []})

    def show(self, found, figure_name, words, designs, limits):
        """Draw a map anew.

        Parameters
        ----------
        found : trackig_core.decide.DesignMap
            The map.
        figure_name : str
            Which of its figures.
        words : str
            What that is called, with its unit.
        designs : sequence of DesignResult
            Designs that are marked: the current one, and pinned ones.
        limits : dict of str to float or None
            Limit by name of a figure [SI], along which designs just comply.
        """
        x_field, y_field = ASKED_FIELDS[found.x_field], ASKED_FIELDS[found.y_field]
        x, y = found.x / x_field.factor, found.y / y_field.factor
        values = found.figures[figure_name] * SCALES.get(figure_name, 1.0)
        plot = self.model = figure(
            name="map_figure",
            x_axis_type="log" if x_field.logarithmic else "linear",
            y_axis_type="log" if y_field.logarithmic else "linear",
            x_range=Range1d(x[0], x[-1], bounds="auto"),
            y_range=Range1d(y[0], y[-1], bounds="auto"),
            x_axis_label=x_field.labelled,
            y_axis_label=y_field.labelled,
            stylesheets=[theme.TALL],
        )
        dress(plot, f"{words} over {x_field.label} and {y_field.label}; {MAP_KEYS}", KEYS)
        for axis, field in ((plot.xaxis, x_field), (plot.yaxis, y_field)):
            if field.logarithmic:
                show_one_two_five(axis)
        colours = LinearColorMapper(
            palette=Viridis256[::-1] if BETTER.get(figure_name) == "low" else Viridis256,
            low=float(np.nanmin(values)),
            high=float(np.nanmax(values)),
        )
        # the axes are those along which the points are evenly spaced, so that an image of them is not bent
        image = plot.image(
            image=[values], x=x[0], y=y[0], dw=x[-1] - x[0], dh=y[-1] - y[0], color_mapper=colours
        )
        title = scale_title(figure_name, words)
        plot.add_layout(ColorBar(color_mapper=colours, title=title, width=14), "right")
        plot.add_tools(
            HoverTool(renderers=[image], tooltips=[("x", "$x"), ("y", "$y"), (words, "@image{0.00}")])
        )
        self._found, self._edges, self._place = found, [], None
        for name, limit in limits.items():
            if limit is not None and name in found.figures:
                self._edges.append(_draw_edge(plot, x, y, found.figures[name] - limit, *EDGES[name]))
        plot.scatter(
            source=self.marks, size=14, marker="marker", fill_color="colour", line_color="white", line_width=2
        )
        for colour, width in CROSS_STROKES:
            plot.scatter(source=self.cross, size=26, marker="cross", line_color=colour, line_width=width)
        self.cross.data = {"x": [], "y": []}
        self.legend = Legend("map_figure")
        self.mark(designs)
        self.layout = with_legend(plot, self.legend)
        plot.on_event(Tap, lambda event: self._on_tap(event.x, event.y))

    def mark(self, designs):
        """Mark where designs (DesignResult) lie on a map that is drawn; others have no place on it."""
        found = self._found
        if found is None:
            return
        names = (found.x_field, found.y_field)
        placed = [each for each in designs if _is_placed(each.design, names)]
        x, y = ([each.design.value(name) / ASKED_FIELDS[name].factor for each in placed] for name in names)
        markers = ["circle" if each.key is None else "diamond" for each in placed]
        self.marks.data = {"x": x, "y": y, "marker": markers, "colour": [each.colour for each in placed]}
        entries = [
            (each.name, marker_svg(each.colour, marker)) for each, marker in zip(placed, markers, strict=True)
        ]
        self.legend.show([*self._edges, *entries])

    def move(self, key, far):
        """Move the cross by a key, by one point of the map or, far, by ten.

        Returns
        -------
        (int, int) or None
            Column and row of the point where it is; None as long as there is no map.
        """
        found = self._found
        if found is None:
            return None
        across, up = STEPS.get(key, (0, 0))
        column, row = self._place or self._first_place()
        points = STRIDE if far else 1
        self._place = column, row = (
            min(max(column + points * across, 0), found.x.size - 1),
            min(max(row + points * up, 0), found.y.size - 1),
        )
        self.cross.data = {
            "x": [found.x[column] / ASKED_FIELDS[found.x_field].factor],
            "y": [found.y[row] / ASKED_FIELDS[found.y_field].factor],
        }
        return self._place

    def _first_place(self):
        """Return column and row of the map that are nearest to the current design, else its middle."""
        found = self._found
        return tuple(
            int(np.abs(values - value).argmin()) if isinstance(value, float) else values.size // 2
            for values, value in (
                (found.x, found.design.value(found.x_field)),
                (found.y, found.design.value(found.y_field)),
            )
        )


def _draw_edge(plot, x, y, over, words, dash):
    """Draw where a figure is at its limit; return what the legend says of it."""
    lines = contour_data(x, y, over, levels=[0.0], want_fill=False).line_data
    edge = plot.multi_line(
        xs=lines.xs, ys=lines.ys, line_color=theme.SPECIFICATION, line_width=theme.LIMIT_LINE_WIDTH
    )
    edge.glyph.line_dash = list(dash)
    return words, swatch_svg(theme.SPECIFICATION, dash)


def _is_placed(design, names):
    """Return whether a design has single numbers there: a curve or a missing block has no place on a map."""
    return all(isinstance(design.value(name), float) for name in names)


MARK_COLUMNS = ("x", "y", "marker", "colour")

CROSS_STROKES = (("white", 5), ("black", 2))
"""A cross that is seen on any colour: its strokes from back to front, with their widths [px]."""

STEPS = {"ArrowLeft": (-1, 0), "ArrowRight": (1, 0), "ArrowUp": (0, 1), "ArrowDown": (0, -1)}
"""Points across and up that a key moves by."""

STRIDE = 10
"""Points that a key moves by with Shift [-]."""

CHOSEN_SIZE = 15
"""Size of the dot of a design that is chosen [px]."""

MOST_PLAIN = 3
"""Curves that are told apart without being seen through [-]."""

DOTS = {
    "no other beats it": theme.COUPLED_BLOCK,
    "complies": theme.COMPLYING,
    "fails": theme.PRESET_GHOST,
    "chosen": theme.THIS_DESIGN,
}
"""Colours of the designs of a search, by what they are."""

CLOUD_KEYS = "arrow keys go through the best designs, with Shift several are chosen, Enter takes one"
"""What screen readers say of the keys of a search's pictures."""

MAP_KEYS = "arrow keys move a cross, Enter takes the design under it"
"""What screen readers say of the map's keys."""

EDGES = {"margin": ("just complies", ()), "deflection": ("sinks just as far as allowed", theme.SECOND_DASH)}
"""What the edges of compliance are called, and their dashes, by the figure that is limited."""

SCALES = {"deflection": 1e3}
"""What turns a figure into the unit that is shown [mm/m]."""


class CloudFigure:
    """Designs that a search tried, in three linked pictures: objectives, fields, insertion gain.

    What is brushed in the first or the second is drawn in all three.

    Attributes
    ----------
    designs : bokeh.models.ColumnDataSource
        Named ``found``: per design the ``row`` of the search, both objectives ``x`` and ``y``, places ``xs``
        and ``ys`` along its fields, 0 to 1, and ``colour``.
    curves : bokeh.models.ColumnDataSource
        Named ``found_gains``: insertion gain of the designs that are selected.
    objectives, fields, gains : bokeh.plotting.figure
        The pictures.
    legend : Legend
        What the colours of the first two mean.
    """

    def __init__(self, on_select):
        self._on_select = on_select
        self._found = self._levels = None
        self.designs = ColumnDataSource(
            name="found", data={name: [] for name in ("row", "x", "y", "xs", "ys", "colour", "size")}
        )
        self.curves = ColumnDataSource(name="found_gains", data={"xs": [], "ys": []})
        self.objectives = self._picture("objectives_figure", "Designs by their objectives", theme.MEDIUM)
        self.legend = Legend("objectives_figure")
        self.fields = self._picture("fields_figure", "Designs by their fields", theme.MEDIUM)
        self.gains = blank_figure(
            name="found_gain_figure",
            aria_label="Insertion gain of the selected designs",
            x_axis_type="log",
            y_range=Range1d(-30.0, 20.0),
            x_axis_label="One-third-octave band, Hz",
            y_axis_label="Insertion gain, dB",
            stylesheets=[theme.MEDIUM],
        )
        show_bands(self.gains)
        self.gains.add_layout(zero_line())
        self._draw()
        self.designs.selected.on_change("indices", self._selected)

    def _picture(self, name, words, height):
        plot = figure(
            name=name,
            x_range=Range1d(0.0, 1.0),
            y_range=Range1d(0.0, 1.0),
            x_axis_label="",
            y_axis_label="",
            stylesheets=[height],
        )
        dress(plot, f"{words}; {CLOUD_KEYS}", KEYS)
        plot.add_tools(TapTool(), BoxSelectTool(persistent=False))
        return plot

    def _draw(self):
        dots = self.objectives.scatter(
            x="x",
            y="y",
            size="size",
            source=self.designs,
            fill_color="colour",
            line_color=None,
            nonselection_fill_alpha=0.1,
        )
        # among hundreds of dots, the one that is chosen is found by its size and its ring
        dots.selection_glyph = Scatter(
            x="x", y="y", size=CHOSEN_SIZE, fill_color=theme.THIS_DESIGN, line_color="white", line_width=2
        )
        self.objectives.add_tools(
            HoverTool(renderers=[dots], tooltips=[("x", "@x{0.00}"), ("y", "@y{0.00}")])
        )
        self.fields.multi_line(
            xs="xs",
            ys="ys",
            source=self.designs,
            line_color="colour",
            line_alpha=0.35,
            selection_line_alpha=1,
            selection_line_color=theme.THIS_DESIGN,
            selection_line_width=theme.THIN_LINE_WIDTH,
            nonselection_line_alpha=0.04,
        )
        _fit(self.fields.y_range, np.array([0.0, 1.0]))
        self.fields.yaxis.visible = False
        self.fields.ygrid.visible = False
        self._curves = self.gains.multi_line(
            xs="xs", ys="ys", source=self.curves, line_width=theme.THIN_LINE_WIDTH
        )
        self.legend.show([(words, marker_svg(colour, "circle")) for words, colour in DOTS.items()])
        self.limit = ColumnDataSource(name="found_limit", data=BANDS | {"limit": NO_LIMIT})
        _draw_limit(self.gains, self.limit)

    def show(self, found, levels, labels, ends, axes, limit, scales):
        """Draw what a search found.

        Parameters
        ----------
        found : trackig_core.decide.FoundDesigns
            What was found.
        levels : numpy.ndarray (tried, 21)
            Insertion gain of all designs that were tried [dB].
        labels : sequence of str
            What its free fields are called, with their ranges, and then what was chosen between.
        ends : dict of str to (float, float)
            Range of each free field that is a number [SI].
        axes : (str, str)
            What the two objectives are called, with their units.
        limit : numpy.ndarray (21,)
            Greatest insertion gain allowed [dB], NaN in bands that have no limit.
        scales : (float, float)
            What turns the objectives into display units.
        """
        chosen = self._chosen_rows()
        kept = chosen[_still_there(self._found, found, chosen)]
        self._found, self._levels = found, levels
        rows = _drawn_rows(found, kept)
        x, y = found.values[rows, 0] * scales[0], found.values[rows, -1] * scales[1]
        front = np.isin(rows, found.front)
        along = [_places(found, name, rows, *each) for name, each in ends.items()]
        along += [_places_by_name(names)[rows] for names in found.chosen.values()]
        places = np.stack(along, axis=-1)
        axis = list(range(places.shape[1]))
        if not kept.size:
            self.designs.selected.indices = []
        self.designs.data = {
            "row": rows,
            "x": x,
            "y": y,
            "xs": [axis] * len(rows),
            "ys": list(places),
            "colour": [
                DOTS["no other beats it" if best else "complies" if complies else "fails"]
                for best, complies in zip(front, found.complies[rows], strict=True)
            ],
            "size": np.where(front, 9, 5),
        }
        self.objectives.xaxis.axis_label, self.objectives.yaxis.axis_label = axes
        _fit(self.objectives.x_range, x)
        _fit(self.objectives.y_range, y)
        _fit(self.fields.x_range, np.array([0.0, max(1.0, len(axis) - 1.0)]))
        shown = np.append(levels[found.front if found.front.size else [found.closest]], limit)
        _fit(self.gains.y_range, shown[np.isfinite(shown)])
        self.fields.xaxis.ticker = FixedTicker(ticks=axis)
        self.fields.xaxis.major_label_overrides = dict(zip(axis, _staggered(labels), strict=True))
        self.limit.data = BANDS | {"limit": limit}
        self._select([int(np.flatnonzero(rows == row)[0]) for row in kept])

    def _select(self, places):
        """Select designs by their places; a document that holds changes back does not tell of them."""
        self.designs.selected.indices = places
        self._selected(None, None, places)

    def _chosen_rows(self):
        """Return which designs of the search are selected (selected,)."""
        return np.asarray(self.designs.data["row"], dtype=int)[self.designs.selected.indices]

    def move(self, key, far):
        """Choose the next of the best designs by a key, from left to right; far, keep the others too."""
        across, up = STEPS.get(key, (0, 0))
        if self._found is None or not (across or up):
            return
        rows, chosen = self.designs.data["row"], self.designs.selected.indices
        best = self._found.front if self._found.front.size else [self._found.closest]
        places = np.flatnonzero(np.isin(rows, best))
        order = places[self.designs.data["x"][places].argsort(kind="stable")].tolist()
        if chosen and chosen[0] in order:
            place = min(max(order.index(chosen[0]) + across + up, 0), len(order) - 1)
        else:
            place = 0 if across + up > 0 else len(order) - 1
        others = [each for each in chosen if each != order[place]] if far else []
        self._select([order[place], *others])

    def _selected(self, _attribute, _old, indices):
        """Draw insertion gain of what is selected, of the front if nothing is."""
        if self._found is None:
            return
        rows = self.designs.data["row"]
        chosen = rows[indices] if len(indices) else self._found.front
        chosen = chosen[:: max(1, -(-len(chosen) // MOST_CURVES))]
        levels = self._levels[chosen]
        self._curves.glyph.update(
            line_color=DOTS["chosen"] if len(indices) else DOTS["no other beats it"],
            line_alpha=1.0 if len(levels) <= MOST_PLAIN else 0.4,
        )
        self.curves.data = {"xs": [tig.BAND_CENTRES] * len(levels), "ys": list(levels)}
        self._on_select(int(rows[indices[0]]) if len(indices) else None)


def _fit(ends, values):
    """Have an axis show values, with some room; an axis that has nothing to show yet would complain."""
    low, high = float(np.min(values)), float(np.max(values))
    room = ROOM * ((high - low) or 1.0)
    ends.update(start=low - room, end=high + room, reset_start=low - room, reset_end=high + room)


ROOM = 0.05
"""Room between data and the ends of an axis, of what they span [-]."""


def _draw_limit(plot, source, **legend):
    """Draw the limit of each band from edge to edge."""
    plot.segment(
        x0="left",
        x1="right",
        y0="limit",
        y1="limit",
        source=source,
        line_color=theme.SPECIFICATION,
        line_width=theme.LIMIT_LINE_WIDTH,
        **legend,
    )


NO_LIMIT = np.full(tig.BAND_CENTRES.size, np.nan)


def _drawn_rows(found, kept):
    """Return which designs are drawn: those that comply before those that do not, the front among them.

    Those that are kept are drawn wherever they stand.
    """
    order = np.argsort(-found.slack, kind="stable")
    rest = order[~np.isin(order, found.front)]
    room = max(0, MOST_DRAWN - found.front.size)
    every = max(1, -(-rest.size // max(room, 1)))
    drawn = np.concatenate([rest[::every], found.front]).astype(int)
    return np.concatenate([kept[~np.isin(kept, drawn)], drawn])


def _still_there(before, now, rows):
    """Return which rows of what was found before are the same designs now (rows,)."""
    if before is None:
        return np.zeros(rows.size, bool)
    there = rows < now.slack.size
    inside = np.where(there, rows, 0)
    for name, column in before.many.columns.items():
        there &= (column[rows] == now.many.columns[name][inside]).astype(bool)
    return there


def _staggered(labels):
    """Return labels of two lines, every other one below its neighbours, where several would run together."""
    if len(labels) <= MOST_IN_A_ROW:
        return list(labels)
    return [f"\n\n{label}" if place % 2 else label for place, label in enumerate(labels)]


MOST_IN_A_ROW = 3
"""Labels that stand beside each other in a picture of half a page [-]."""


def _places_by_name(names):
    """Return places of components, 0 to 1, in the order of their names."""
    different, places = np.unique(names.astype(str), return_inverse=True)
    return places / max(1, different.size - 1)


def _places(found, name, rows, low, high):
    values = found.many.column(name)[rows].astype(float)
    if ASKED_FIELDS[name].logarithmic:
        return np.log(values / low) / np.log(high / low)
    return (values - low) / (high - low)
