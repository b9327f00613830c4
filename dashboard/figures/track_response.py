"""How tracks answer a hammer: point receptance or mobility, and track decay rate; built once, then fed.

Thick lines are over a support, thin ones half-way between two.
"""

import numpy as np
from bokeh.models import ColumnDataSource, HoverTool, Range1d

from dashboard import theme
from dashboard.figures.axes import blank_figure, show_one_two_five
from dashboard.figures.legends import Legend, more_width, pinned_entry, with_legend
from dashboard.figures.swatches import swatch_svg
from dashboard.figures.verification import NANOMETRES_PER_KILONEWTON

AXIS = (22.0, 1140.0)
"""Frequencies that are shown [Hz]: the bands from 25 Hz to 1 kHz, edge to edge."""

ROOM = 1.25
"""Factor of room at the ends of a logarithmic axis [-]."""

MOBILITY_UNIT = 1e6
"""One m/(N s) in mm/(s kN)."""

QUANTITIES = {"receptance": "Receptance, nm/kN", "mobility": "Mobility, mm/(s kN)"}
"""What may be drawn over frequency, and how its axis is called."""

COLUMNS = ("x", "y", "colour", "dash", "width", "name", "what")

SUPPORT, MIDSPAN = "over a support", "between supports"

LONGEST = "longest-lived wave"

NO_DASH = (1, 0)
"""A dash without gaps [px]: Bokeh takes no empty one for a line among several."""

DOTS = (2, 4)
"""Dash of the longest-lived wave [px]."""


class LinesFigure:
    """Lines of several designs on logarithmic axes.

    Attributes
    ----------
    model : bokeh.plotting.figure
        The figure.
    layout : bokeh.models.Column
        The figure, and its legend below it.
    lines : bokeh.models.ColumnDataSource
        Per line ``x``, ``y``, ``colour``, ``dash``, ``width``, ``name`` of the design, and ``what`` it is.
    """

    def __init__(self, name, label, aria_label, unit):
        self.lines = ColumnDataSource(name=name, data={column: [] for column in COLUMNS})
        self.model = blank_figure(
            name=f"{name}_figure",
            aria_label=aria_label,
            x_axis_type="log",
            y_axis_type="log",
            x_range=Range1d(*AXIS, bounds=AXIS),
            y_range=Range1d(1, 10),
            x_axis_label="Frequency, Hz",
            y_axis_label=label,
            stylesheets=[theme.MEDIUM],
        )
        for axis in (self.model.xaxis[0], self.model.yaxis[0]):
            show_one_two_five(axis)
        drawn = self.model.multi_line(
            xs="x", ys="y", line_color="colour", line_dash="dash", line_width="width", source=self.lines
        )
        tooltips = [("design", "@name"), ("", "@what"), ("frequency", "$x{0.0} Hz"), (unit, "$y{0.000}")]
        self.model.add_tools(HoverTool(renderers=[drawn], tooltips=tooltips))
        self.legend = Legend(f"{name}_figure")
        self.layout = with_legend(self.model, self.legend)

    def _draw(self, rows, results):
        """Draw rows (x, y, result, dash, width, what), and list the designs and what their lines are."""
        current = next((each for each in results if each.key is None), None)
        # what is drawn last is in front: the current design, a pinned copy of it seen on both sides
        columns = [
            (x, y, result.colour, list(dash or NO_DASH), width + extra, result.name, what)
            for x, y, result, dash, width, what in sorted(rows, key=lambda row: row[2].key is None)
            for extra in [0 if result is current else more_width(result, current)]
        ]
        self.lines.data = {column: [row[place] for row in columns] for place, column in enumerate(COLUMNS)}
        whats = {what: swatch_svg(theme.PRESET_GHOST, dash) for *_, dash, _, what in rows if what == LONGEST}
        self.legend.show([*map(pinned_entry, results), *whats.items()])
        if columns:
            every = np.concatenate([row[1] for row in columns])
            self.model.y_range.update(start=every.min() / ROOM, end=every.max() * ROOM)


class PointResponseFigure(LinesFigure):
    """Receptance or mobility of the rail, over a support and half-way between two."""

    def __init__(self):
        super().__init__(
            "point_response", QUANTITIES["receptance"], "Point response of the rail over frequency", "value"
        )

    def show(self, results, responses, quantity):
        """Draw designs.

        Parameters
        ----------
        results : sequence of DesignResult
            The designs.
        responses : mapping of TrackDesign to TrackResponse
            Their responses.
        quantity : str
            ``"receptance"`` or ``"mobility"``.
        """
        self.model.yaxis.axis_label = QUANTITIES[quantity]
        rows = []
        for each in results:
            response = responses[each.design]
            for place, width, what in (("support", 3, SUPPORT), ("midspan", 1.5, MIDSPAN)):
                values = point_response(response, quantity, place)
                rows.append((response.frequency, values, each, each.dash, width, what))
        self._draw(rows, results)


def point_response(response, quantity, place):
    """Return the magnitude of a point response in the unit that is shown (frequencies,).

    Parameters
    ----------
    response : trackig_core.analysis.TrackResponse
        The response.
    quantity : str
        ``"receptance"`` [nm/kN] or ``"mobility"`` [mm/(s kN)].
    place : str
        ``"support"`` or ``"midspan"``.
    """
    if quantity == "receptance":
        return NANOMETRES_PER_KILONEWTON * np.abs(getattr(response, place))
    return MOBILITY_UNIT * np.abs(getattr(response, f"{place}_mobility"))


class DecayRateFigure(LinesFigure):
    """Track decay rate per band: the sum of EN 15461, and the rate of the longest-lived wave."""

    def __init__(self):
        super().__init__(
            "decay_rate", "Track decay rate, dB/m", "Track decay rate per one-third-octave band", "dB/m"
        )

    def show(self, results, responses):
        """Draw designs (DesignResult) by their responses, a mapping by design."""
        rows = []
        for each in results:
            response = responses[each.design]
            centres = response.bands.centres
            rows += [
                (centres, response.support_decay_rate, each, each.dash, 3, f"EN 15461, {SUPPORT}"),
                (centres, response.midspan_decay_rate, each, each.dash, 1.5, f"EN 15461, {MIDSPAN}"),
                (centres, response.longest_wave, each, DOTS, 1.5, LONGEST),
            ]
        self._draw(rows, results)
