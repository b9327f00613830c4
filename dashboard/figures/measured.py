"""A measured stiffness or loss factor over frequency: its points, and the law that is fitted to them.

Built once with Bokeh, then fed by assigning each data source's ``data``. Hz; kN/mm or no unit.
"""

import numpy as np
from bokeh.models import ColumnDataSource, HoverTool, Range1d

from dashboard import theme
from dashboard.figures.axes import AxisEnds, blank_figure, nice_step, show_one_two_five
from dashboard.figures.legends import legend_above

ROOM = 1.25
"""Factor by which a frequency axis reaches beyond what it shows."""


class MeasuredFigure:
    """Points as they were measured, and the fitted law as a line.

    Parameters
    ----------
    name : str
        Name of its points; that of the figure ends in ``_figure``.
    label : str
        What is drawn, as the axis is called.

    Attributes
    ----------
    model : bokeh.plotting.figure
        The figure.
    points : bokeh.models.ColumnDataSource
        ``frequency`` [Hz] and ``value`` of each point.
    law : bokeh.models.ColumnDataSource
        ``frequency`` [Hz] and ``value`` of the law.
    """

    def __init__(self, name, label):
        self.points, self.law = (
            ColumnDataSource(name=each, data={"frequency": [], "value": []}) for each in (name, f"{name}_law")
        )
        self._ends = AxisEnds((0.0, 1.0))
        self.model = blank_figure(
            name=f"{name}_figure",
            aria_label=f"{label} over frequency, measured and fitted",
            x_axis_type="log",
            x_range=Range1d(1.0, 1000.0),
            y_range=self._ends.model,
            x_axis_label="Frequency, Hz",
            y_axis_label=label,
            stylesheets=[theme.MEDIUM],
        )
        show_one_two_five(self.model.xaxis[0])
        shared = {"x": "frequency", "y": "value"}
        self.model.line(
            **shared,
            source=self.law,
            line_color=theme.THEORY,
            line_width=theme.LINE_WIDTH,
            legend_label="fitted law",
        )
        dots = self.model.scatter(
            **shared,
            source=self.points,
            color=theme.THIS_DESIGN,
            size=theme.DOT_SIZE,
            legend_label="measured",
        )
        legend_above(self.model)
        tooltips = [("frequency", "@frequency{0.0} Hz"), ("measured", "@value{0.0000}")]
        self.model.add_tools(HoverTool(renderers=[dots], tooltips=tooltips))

    def show(self, points, law):
        """Draw points and law, rows of frequency [Hz] and value (2, count) each."""
        self.points.data, self.law.data = (
            dict(zip(("frequency", "value"), each, strict=True)) for each in (points, law)
        )
        reached = np.concatenate([points[0], law[0]])
        if reached.size:
            self.model.x_range.update(start=reached.min() / ROOM, end=reached.max() * ROOM)
            high = 1.15 * max(points[1].max(), law[1].max())
            self._ends.show(0.0, high, nice_step(high))
