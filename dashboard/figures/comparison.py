"""The picture of differences between designs, band by band.

The base is the zero line, and every design has the colour and dash that it has elsewhere.
"""

import numpy as np
from bokeh.models import ColumnDataSource, CustomJSHover, HoverTool

from dashboard import theme
from dashboard.figures.axes import LEVEL_STEP, AxisEnds
from dashboard.figures.insertion_gain import ALONE_TOOLTIPS, NO_LEVELS, PIN_HOVER, pin_columns
from dashboard.figures.legends import MOST_CURVES
from dashboard.figures.overlays import BandCurves, curve_name

LEAST_REACH = 4.0
"""What the axis of differences shows at least on either side [dB]."""

CURRENT = f"pin_{MOST_CURVES}"
"""Column of the current design among the differences, behind those of the pins."""

LOOKS = {f"pin_{place}": {"line_width": theme.PINNED_LINE_WIDTH} for place in range(MOST_CURVES)} | {
    CURRENT: {"line_width": theme.LINE_WIDTH}
}
"""Look of each curve that no design changes."""


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
        self.differences = ColumnDataSource(name="pin_differences", data=_columns({}))
        self._ends = AxisEnds((-10.0, 10.0))
        self._curves = BandCurves(
            self.differences,
            LOOKS,
            "dB re base",
            "Difference of insertion gain from the base per one-third-octave band",
            name="pin_difference_figure",
            y_range=self._ends.model,
            stylesheets=[theme.MEDIUM],
        )
        self.model = self._curves.model
        differences = CustomJSHover(args={"pins": self.differences}, code=PIN_HOVER)
        self._hover = HoverTool(renderers=[], mode="vline", formatters={"@centre": differences})
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
        columns = [CURRENT, *LOOKS] if any(each.key is None for each in results) else LOOKS
        drawn = dict(zip(columns, results, strict=False))
        differences = {name: each.levels - base.levels for name, each in drawn.items()}
        self.differences.data = _columns(differences)
        self._curves.show(drawn)
        values = [
            (curve_name(each), f"@centre{{{name.removeprefix('pin_')}}}") for name, each in drawn.items()
        ]
        self._hover.update(
            renderers=[self._curves.lines[name] for name in drawn][:1], tooltips=ALONE_TOOLTIPS + values
        )
        reach = max([LEAST_REACH, *(np.abs(each).max() for each in differences.values())])
        self._ends.show(-reach, reach, LEVEL_STEP)


def _columns(differences):
    return {**pin_columns(()), CURRENT: NO_LEVELS, **differences}
