"""Insertion gain of the frequency-domain solution on other assumptions; built once, then fed."""

import numpy as np
from bokeh.models import ColumnDataSource, HoverTool, Range1d

from dashboard import theme
from dashboard.figures.axes import (
    LEVEL_ROOM,
    LEVEL_STEP,
    AxisEnds,
    blank_figure,
    show_one_two_five,
    zero_line,
)
from dashboard.figures.legends import Legend, with_legend
from dashboard.figures.swatches import swatch_svg

LOOKS = {
    "hysteretic": (theme.LOADED_TRACK, (10, 5), "hysteretic damping (not causal)"),
    "timoshenko": (theme.COUPLED_BLOCK, (3, 3), "a rail that shears (Timoshenko)"),
    "single_degree": (theme.PRESET_GHOST, (6, 4), "single-degree formula of DIN 45673-4"),
}
"""Colour, dash and words of each line beside the solution itself."""

USUAL = "frequency-domain solution"


class IdealisationFigure:
    """The solution as everywhere else, and beside it what was asked for.

    Attributes
    ----------
    model : bokeh.plotting.figure
        The figure.
    layout : bokeh.models.Column
        The figure, and its legend below it.
    levels : bokeh.models.ColumnDataSource
        Per band ``label``, ``centre`` [Hz], ``usual``, ``hysteretic`` and ``timoshenko`` [dB].
    curve : bokeh.models.ColumnDataSource
        ``frequency`` [Hz] and ``single_degree`` [dB].
    """

    def __init__(self):
        columns = ("label", "centre", "usual", "hysteretic", "timoshenko")
        self.levels = ColumnDataSource(name="idealisations", data={column: [] for column in columns})
        self.curve = ColumnDataSource(name="single_degree", data={"frequency": [], "single_degree": []})
        self._ends = AxisEnds((-30.0, 20.0))
        self.model = blank_figure(
            name="idealisation_figure",
            aria_label="Insertion gain on other assumptions",
            x_axis_type="log",
            x_range=Range1d(4.5, 560.0),
            y_range=self._ends.model,
            x_axis_label="Band, Hz",
            y_axis_label="Insertion gain, dB",
            stylesheets=[theme.MEDIUM],
        )
        show_one_two_five(self.model.xaxis[0])
        self.model.add_layout(zero_line())
        shared = {"x": "centre", "y": "usual", "source": self.levels, "color": theme.THIS_DESIGN}
        self.model.line(line_width=theme.LINE_WIDTH, **shared)
        dots = self.model.scatter(size=theme.DOT_SIZE, **shared)
        self.lines = {name: self._line(name) for name in LOOKS}
        tooltips = [("band", "@label Hz"), (USUAL, "@usual{+0.0} dB")]
        tooltips += [(LOOKS[name][2], f"@{name}{{+0.0}} dB") for name in ("hysteretic", "timoshenko")]
        self.model.add_tools(HoverTool(renderers=[dots], mode="vline", tooltips=tooltips))
        self.legend = Legend("idealisation_figure")
        self.layout = with_legend(self.model, self.legend)

    def _line(self, name):
        colour, dash, _ = LOOKS[name]
        source, x = (self.curve, "frequency") if name == "single_degree" else (self.levels, "centre")
        return self.model.line(
            x=x, y=name, source=source, line_color=colour, line_dash=list(dash), line_width=2.5
        )

    def name_axis(self, words):
        """Say on the axis which insertion gain is drawn."""
        self.model.yaxis.axis_label = words

    def show(self, found, chosen):
        """Draw what was found (Idealised), and of the other assumptions those that are chosen (names)."""
        nothing = np.full(found.levels.size, np.nan)
        levels = {name: found.otherwise.get(name, nothing) for name in ("hysteretic", "timoshenko")}
        self.levels.data = {
            "label": list(found.bands.labels), "centre": found.bands.centres, "usual": found.levels, **levels
        }  # fmt: skip
        self.curve.data = {"frequency": found.frequency, "single_degree": found.single_degree}
        self.model.x_range.update(start=found.bands.edges[0], end=found.bands.edges[-1])
        known = [name for name in chosen if name == "single_degree" or name in found.otherwise]
        for name, line in self.lines.items():
            line.visible = name in known
        entries = [(LOOKS[name][2], swatch_svg(*LOOKS[name][:2])) for name in known]
        self.legend.show([(USUAL, swatch_svg(theme.THIS_DESIGN, dot=True)), *entries])
        drawn = [levels.get(name, found.single_degree) for name in known]
        every = np.concatenate([found.levels, *drawn])
        low, high = max(np.nanmin(every), found.levels.min() - DEEPEST), np.nanmax(every)
        self._ends.show(low - LEVEL_ROOM, high + LEVEL_ROOM, LEVEL_STEP)


DEEPEST = 20.0
"""How far below the solution's lowest level the axis follows the single-degree formula [dB]."""
