"""The picture of differences between designs, band by band.

The base is the zero line, and every design has the colour and dash that it has elsewhere.
"""

import numpy as np
from bokeh.models import ColumnDataSource, CustomJSHover, GlyphRenderer, HoverTool

from dashboard import theme
from dashboard.figures.axes import LEVEL_STEP, AxisEnds, show_bands
from dashboard.figures.insertion_gain import ALONE_TOOLTIPS, NO_LEVELS, PIN_HOVER, pin_columns
from dashboard.figures.legends import PinnedLines, dress_legend, legend_entry, update_legend
from dashboard.figures.overlays import band_overlay, rendered

LEAST_REACH = 4.0
"""What the axis of differences shows at least on either side [dB]."""

CURRENT = f"pin_{theme.MOST_PINNED}"
"""Column of the current design among the differences, behind those of the pins."""

LOOKS = {CURRENT: {"line_color": theme.THIS_DESIGN, "line_width": theme.LINE_WIDTH}}
"""Look of the curve that is always there; those of pinned designs are made when they are first needed."""


class BaseDifferenceFigure:
    """Insertion gain less that of a base, for the current design and for pinned ones.

    Attributes
    ----------
    model : bokeh.plotting.figure
        The figure.
    differences : bokeh.models.ColumnDataSource
        Named ``pin_differences``: per band its ``label``, its ``centre`` [Hz], the differences of pins
        ``pin_0`` to ``pin_7`` and, as ``pin_8``, that of the current design [dB]; NaN where there is none.
    """

    def __init__(self):
        self.differences = ColumnDataSource(name="pin_differences", data=_columns((), None))
        self._ends = AxisEnds((-10.0, 10.0))
        self.model = rendered(
            band_overlay(LOOKS, "dB re base"),
            "Difference of insertion gain from the base per one-third-octave band",
            name="pin_difference_figure",
            y_range=self._ends.model,
            stylesheets=[theme.MEDIUM],
        )
        show_bands(self.model)
        self._legend = self.model.legend[0]
        dress_legend(self._legend)
        (self._current,) = self.model.select({"type": GlyphRenderer})
        self._current.data_source = self.differences
        self._entry = legend_entry(self.model, "this design", self._current)
        names = [f"pin_{place}" for place in range(theme.MOST_PINNED)]
        sources = [self.differences] * theme.MOST_PINNED
        self._pinned = PinnedLines(self.model, self._current, sources, "centre", names)
        differences = CustomJSHover(args={"pins": self.differences}, code=PIN_HOVER)
        self._hover = HoverTool(
            renderers=[self._current],
            mode="vline",
            tooltips=ALONE_TOOLTIPS,
            formatters={"@centre": differences},
        )
        self.model.add_tools(self._hover)

    def show(self, base, results):
        """Draw differences.

        Parameters
        ----------
        base : DesignResult
            The design from which differences are taken; nothing is drawn as long as it has no solution.
        results : sequence of DesignResult
            Designs with a solution, the base not among them; the current design, if there, is the first.
        """
        results = () if base.levels is None else results
        pinned = [each for each in results if each.key is not None]
        differences = [each.levels - base.levels for each in pinned]
        current = next((each.levels - base.levels for each in results if each.key is None), None)
        self.differences.data = _columns(differences, current)
        self._pinned.show(pinned)
        self._current.visible = current is not None
        own = [] if current is None else [self._entry]
        update_legend(self._legend, [self._entry, *self._pinned.entries], own + self._pinned.shown_entries)
        tooltips = [] if current is None else [("this design", f"@centre{{{theme.MOST_PINNED}}}")]
        tooltips += [(each.name, f"@centre{{{place}}}") for place, each in enumerate(pinned)]
        self._hover.update(
            renderers=self._pinned.lines[:1] if current is None else [self._current],
            tooltips=ALONE_TOOLTIPS + tooltips,
        )
        drawn = [*differences, *([] if current is None else [current])]
        reach = max([LEAST_REACH, *(np.abs(each).max() for each in drawn)])
        self._ends.show(-reach, reach, LEVEL_STEP)


def _columns(differences, current):
    return {**pin_columns(differences), CURRENT: NO_LEVELS if current is None else current}
