"""The picture of differences between designs, band by band.

The one rule: the base is the zero line, and every design has the colour and dash that it has elsewhere.
"""

import numpy as np
from bokeh.models import ColumnDataSource, CustomJSHover, HoverTool

from dashboard import theme
from dashboard.figures.axes import LEVEL_STEP, AxisEnds, blank_figure, show_bands, zero_line
from dashboard.figures.insertion_gain import ALONE_TOOLTIPS, NO_LEVELS, PIN_HOVER, pin_columns
from dashboard.figures.legends import MOST_CURVES, PinnedLines, legend_entry, new_legend, update_legend

LEAST_REACH = 4.0
"""What the axis of differences shows at least on either side [dB]."""

CURRENT = MOST_CURVES
"""Place of the design at hand among the differences, behind those of the pins."""


class BaseDifferenceFigure:
    """Insertion gain less that of a base, for the design at hand and for pinned ones.

    Attributes
    ----------
    model : bokeh.plotting.figure
        The figure.
    differences : bokeh.models.ColumnDataSource
        Named ``pin_differences``: per band its ``label``, its ``centre`` [Hz], the differences of pins
        ``pin_0`` to ``pin_7`` and, as ``pin_8``, that of the design at hand [dB]; NaN where there is none.
    """

    def __init__(self):
        self.differences = ColumnDataSource(name="pin_differences", data=_columns((), None))
        self._ends = AxisEnds((-10.0, 10.0))
        self.model = blank_figure(
            name="pin_difference_figure",
            aria_label="Difference of insertion gain from the base per one-third-octave band",
            x_axis_type="log",
            y_range=self._ends.model,
            x_axis_label="One-third-octave band, Hz",
            y_axis_label="dB re base",
            stylesheets=[theme.MEDIUM],
        )
        show_bands(self.model)
        self.model.add_layout(zero_line())
        self._legend = new_legend(self.model, "bottom_left")
        self._hand = self.model.line(
            x="centre",
            y=f"pin_{CURRENT}",
            source=self.differences,
            line_color=theme.THIS_DESIGN,
            line_width=theme.LINE_WIDTH,
        )
        names = [f"pin_{place}" for place in range(MOST_CURVES)]
        self._pinned = PinnedLines(self.model, self._hand, [self.differences] * MOST_CURVES, "centre", names)
        self._entry = legend_entry(self.model, "this design", self._hand)
        told = CustomJSHover(args={"pins": self.differences}, code=PIN_HOVER)
        self._hover = HoverTool(
            renderers=[self._hand], mode="vline", tooltips=ALONE_TOOLTIPS, formatters={"@centre": told}
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
        hand = next((each.levels - base.levels for each in results if each.key is None), None)
        self.differences.data = _columns(differences, hand)
        self._pinned.show(pinned)
        self._hand.visible = hand is not None
        own = [] if hand is None else [self._entry]
        update_legend(self._legend, [self._entry, *self._pinned.entries], own + self._pinned.shown_entries)
        tooltips = [] if hand is None else [("this design", f"@centre{{{CURRENT}}}")]
        tooltips += [(each.name, f"@centre{{{place}}}") for place, each in enumerate(pinned)]
        self._hover.update(
            renderers=self._pinned.lines[:1] if hand is None else [self._hand],
            tooltips=ALONE_TOOLTIPS + tooltips,
        )
        drawn = [*differences, *([] if hand is None else [hand])]
        reach = max([LEAST_REACH, *(np.abs(each).max() for each in drawn)])
        self._ends.show(-reach, reach, LEVEL_STEP)


def _columns(differences, hand):
    own = NO_LEVELS if hand is None else hand
    return {**pin_columns(differences), f"pin_{CURRENT}": own}
