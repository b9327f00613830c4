"""Legends outside the axes, and the lines of pinned designs that they list."""

import html
import operator

from bokeh.layouts import column
from bokeh.models import Div, GlyphRenderer, Line

from dashboard import theme
from dashboard.figures.swatches import swatch_svg

NO_LABEL = "\N{NO-BREAK SPACE}"
"""Keeps a label's row free, so that the frame stays put."""


class Legend:
    """What a figure draws, in words below it: text of the page, which wraps and covers no curve.

    A legend of Bokeh's lies in the canvas, takes its height from the curves, wraps no name, and is made anew
    whenever a curve's data change.

    Parameters
    ----------
    figure : str
        Name of the figure that it belongs to.

    Attributes
    ----------
    model : bokeh.models.Div
        Named after the figure, with ``_legend`` behind it.
    listed : tuple of str
        What it says, in order.
    """

    def __init__(self, figure):
        self.model = Div(
            name=f"{figure}_legend",
            disable_math=True,
            sizing_mode="stretch_width",
            margin=0,
            stylesheets=[theme.LEGEND_CSS],
        )
        self.listed = ()

    def show(self, entries):
        """List what is drawn.

        Parameters
        ----------
        entries : sequence of (str, str)
            Words of each entry, which may be a name that somebody typed, and its swatch (SVG).
        """
        self.listed = tuple(words for words, _ in entries)
        items = "".join(f"<li>{swatch}<span>{html.escape(words)}</span></li>" for words, swatch in entries)
        text = f'<ul role="list" aria-label="Legend">{items}</ul>'
        # most frames of a drag change no word
        if text != self.model.text:
            self.model.text = text


def with_legend(plot, legend):
    """Return a figure and the legend below it, as one model of Bokeh."""
    return column(plot, legend.model, sizing_mode="stretch_width", margin=0)


def pinned_entry(result, remark=""):
    """Return what a legend says of a design's line (DesignResult): its name, and a remark behind it."""
    return result.name + remark, swatch_svg(result.colour, result.dash)


def solved_entry(result):
    """Return what a legend says of insertion gain (DesignResult): where it has no run yet, that too."""
    return pinned_entry(result, EXACT_CURVE if result.summary.solution.fidelity == "exact" else "")


EXACT_CURVE = " · exact curve"
"""Remark on a design whose run is not there."""

WITHOUT_FORCE = EXACT_CURVE + ", no force"
"""The same where its force would be drawn."""


def legend_above(plot, columns=2):
    """Put the legend of a figure whose curves never change above its frame, where it covers none."""
    legend = plot.legend[0]
    legend.update(orientation="horizontal", ncols=columns, border_line_color=None, background_fill_alpha=0.0)
    plot.add_layout(legend, "above")


class PinnedLines:
    """Lines for pinned designs; they are made when they are first needed.

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
        self.lines = []
        self._pinned = ()
        self._plot, self._front, self._x = plot, front, x
        self._unmade = list(zip(sources, columns, strict=True))

    def _make(self, count):
        made, self._unmade = self._unmade[:count], self._unmade[count:]
        lines = [GlyphRenderer(data_source=source, glyph=self._glyph(column)) for source, column in made]
        renderers = self._plot.renderers
        behind = renderers.index(self._front)
        renderers[behind:behind] = lines
        self.lines += lines

    def _glyph(self, column):
        return Line(x=self._x, y=column, line_width=theme.PINNED_LINE_WIDTH, line_alpha=1)

    def show(self, pinned):
        """Give as many lines as there are pinned designs their colours and dashes; hide the rest.

        Parameters
        ----------
        pinned : sequence of DesignResult
            The designs that are drawn.
        """
        missing = len(pinned) - len(self.lines)
        if missing > 0:
            self._make(missing)
        for line, each in zip(self.lines, pinned, strict=False):
            line.glyph.update(line_color=each.colour, line_dash=list(each.dash))
        for place, line in enumerate(self.lines):
            line.visible = place < len(pinned)
        self._pinned = tuple(pinned)

    def set_off(self, current):
        """Draw pinned designs whose curve lies below that of the current design so that both are seen.

        Parameters
        ----------
        current : DesignResult or None
            The current design, drawn in front of them; None: it is not drawn.
        """
        for line, each in zip(self.lines, self._pinned, strict=False):
            line.glyph.line_width = theme.PINNED_LINE_WIDTH + more_width(each, current)


def more_width(pinned, current):
    """Return by how much a pinned design's line is wider [px] so that it is seen below the current one's.

    Parameters
    ----------
    pinned, current : DesignResult
        The designs; current None: it is not drawn.
    """
    is_copy = current is not None and pinned.design.without_statics == current.design.without_statics
    return theme.COPY_MORE_WIDTH if is_copy else 0


def are_the_same(some, others):
    """Return whether two sequences hold the same objects in the same order: then nothing is to be sent."""
    return len(some) == len(others) and all(map(operator.is_, some, others))
