"""Legends, and the lines of pinned designs that they list."""

import math
import operator

from bokeh.core.properties import value
from bokeh.models import (
    ColumnDataSource,
    GlyphRenderer,
    Legend,
    LegendItem,
    Line,
)

from dashboard import formats, theme
from dashboard.figures.axes import keep

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
        return Line(x=self._x, y=column, line_width=theme.PINNED_LINE_WIDTH, line_alpha=1)

    def show(self, pinned):
        """Give as many lines as there are pinned designs their names, colours and dashes; hide the rest.

        Parameters
        ----------
        pinned : sequence of DesignResult
            The designs that are drawn.
        """
        missing = len(pinned) - len(self.lines)
        if missing > 0:
            self._make(missing)
        for line, entry, each in zip(self.lines, self.entries, pinned, strict=False):
            line.glyph.update(line_color=each.colour, line_dash=list(each.dash))
            entry.label = value(formats.name_text(each.name, theme.LEGEND_NAME))
        for place, line in enumerate(self.lines):
            line.visible = place < len(pinned)

    @property
    def shown_entries(self):
        """Entries of the lines that are drawn."""
        return [entry for entry, line in zip(self.entries, self.lines, strict=True) if line.visible]


def are_the_same(some, others):
    """Return whether two sequences hold the same objects in the same order: then nothing is to be sent."""
    return len(some) == len(others) and all(map(operator.is_, some, others))


def new_legend(plot, location):
    """Return a figure's legend, empty as yet; it is made first, so that curves are drawn behind it."""
    legend = Legend(items=[], location=location)
    dress_legend(legend)
    plot.add_layout(legend)
    return legend


def dress_legend(legend):
    """Give a legend the sizes that all have."""
    keep(
        legend,
        label_text_font_size=theme.TICK_SIZES,
        glyph_width=(theme.LEGEND_LINE, theme.LEGEND_LINE),
        background_fill_alpha=(theme.LEGEND_ALPHA, theme.LEGEND_ALPHA),
    )


def update_legend(legend, entries, shown):
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
    legend.update(ncols=1 if len(shown) <= theme.LEGEND_ROWS else 2, visible=bool(shown))
