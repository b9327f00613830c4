"""The pictures of the tab in which a run is compared with theory; built once, then fed.

What comes from the run is drawn as dots or bars, what comes from theory as lines.
"""

import numpy as np
from bokeh.models import ColumnDataSource, HoverTool, Range1d, Span

import trackig_core as tig
from dashboard import theme
from dashboard.figures.axes import (
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

LEAST_DIFFERENCE = 0.02
"""What the difference axis shows at least, up and down [dB]."""

FEW_TICKS = 4
"""Ticks of the difference's axis, which is low [-]."""

FRAME_LEFT = 88
"""Room for the value axis [px], so that the bands of two figures stand above each other."""

LOG_ROOM = 0.05
"""Room at either end of a logarithmic axis, of the decades that are shown [-]: more than half a dot."""

NANOMETRES_PER_KILONEWTON = 1e12
"""One m/N in nm/kN."""

SLOPE_APART = 0.5
"""Factor by which a line of given slope is drawn below the errors it is compared with, to be seen [-]."""

SLOPE_ONE, SLOPE_TWO = "slope 1", "slope 2"


class ComparisonFigure:
    """Insertion gain of the run, and of the frequency-domain solution.

    Attributes
    ----------
    model : bokeh.plotting.figure
        The figure.
    bands : bokeh.models.ColumnDataSource
        Named ``comparison``: ``label``, ``centre`` [Hz], ``run``, ``exact`` and their ``difference`` [dB].
    """

    def __init__(self):
        nothing = np.full(tig.BAND_CENTRES.size, np.nan)
        self.bands = ColumnDataSource(name="comparison", data=_compared(nothing, nothing))
        self._levels = AxisEnds((-30.0, 20.0))
        self.model = blank_figure(
            name="comparison_figure",
            x_axis_type="log",
            y_range=self._levels.model,
            y_axis_label="Insertion gain, dB",
            min_border_left=FRAME_LEFT,
            stylesheets=[theme.MEDIUM],
        )
        show_bands(self.model)
        shared = {"source": self.bands, "x": "centre"}
        self.model.line(
            y="exact",
            line_color=theme.THEORY,
            line_width=theme.THIN_LINE_WIDTH,
            legend_label="exact",
            **shared,
        )
        dots = self.model.scatter(
            y="run", color=theme.THIS_DESIGN, size=theme.DOT_SIZE, legend_label="time stepping", **shared
        )
        tooltips = [
            ("band", "@label Hz"),
            ("time stepping", "@run{+0.000} dB"),
            ("exact", "@exact{+0.000} dB"),
            ("difference", "@difference{+0.0000} dB"),
        ]
        self.model.add_tools(HoverTool(renderers=[dots], mode="vline", tooltips=tooltips))
        legend_above(self.model)

    def name_axis(self, words):
        """Say on the axis which insertion gain is drawn."""
        self.model.yaxis.axis_label = words

    def show(self, run, exact):
        """Draw the levels of the run and of the frequency-domain solution (21,) [dB]."""
        seen = np.concatenate([run, exact])
        self._levels.show(seen.min() - LEVEL_ROOM, seen.max() + LEVEL_ROOM, LEVEL_STEP)
        self.bands.data = _compared(run, exact)


class DifferenceFigure:
    """How far the run is from the frequency-domain solution, band by band, on an axis of its own.

    Attributes
    ----------
    model : bokeh.plotting.figure
        The figure.
    """

    def __init__(self, bands):
        self._differences = AxisEnds((-0.2, 0.2))
        self.model = blank_figure(
            name="difference_figure",
            x_axis_type="log",
            y_range=self._differences.model,
            x_axis_label="One-third-octave band, Hz",
            y_axis_label="Difference, dB",
            min_border_left=FRAME_LEFT,
            stylesheets=[theme.SHORT],
        )
        show_bands(self.model)
        self.model.yaxis.ticker.desired_num_ticks = FEW_TICKS
        self.model.add_layout(zero_line())
        self.model.quad(
            left="left",
            right="right",
            bottom=0,
            top="difference",
            source=bands,
            fill_color=theme.THIS_DESIGN,
            line_color=None,
            fill_alpha=theme.BAR_ALPHA,
        )

    def show(self, difference):
        """Settle the axis around the differences (21,) [dB]."""
        reach = max(LEAST_DIFFERENCE, 1.1 * np.abs(difference).max())
        self._differences.show(-reach, reach, nice_step(2 * reach))


class ReceptanceFigure:
    """Point receptance of a preset: the frequency-domain solution, and an independent package.

    Attributes
    ----------
    model : bokeh.plotting.figure
        The figure.
    peer, solution : bokeh.models.ColumnDataSource
        Named ``peer`` and ``solution``: ``frequency`` [Hz] and magnitudes [nm/kN].
    """

    def __init__(self):
        self.peer = ColumnDataSource(name="peer", data={"frequency": [], "euler": [], "timoshenko": []})
        self.solution = ColumnDataSource(name="solution", data={"frequency": [], "receptance": []})
        self.model = blank_figure(
            name="receptance_figure",
            x_axis_type="log",
            y_axis_type="log",
            y_range=Range1d(1, 10),
            x_axis_label="Frequency, Hz",
            y_axis_label="Receptance, nm/kN",
            stylesheets=[theme.MEDIUM],
        )
        show_bands(self.model)
        self.model.line(
            x="frequency",
            y="receptance",
            source=self.solution,
            line_color=theme.THEORY,
            line_width=theme.THIN_LINE_WIDTH,
            legend_label="frequency-domain solution, 24 elements a bay",
        )
        dots = self.model.scatter(
            x="frequency",
            y="euler",
            source=self.peer,
            color=theme.LOADED_TRACK,
            size=theme.DOT_SIZE,
            legend_label="independent package, Euler rail",
        )
        self.model.scatter(
            x="frequency",
            y="timoshenko",
            source=self.peer,
            marker="triangle",
            line_color=theme.COUPLED_BLOCK,
            fill_color=None,
            size=theme.DOT_SIZE,
            legend_label="independent package, Timoshenko rail (with shear)",
        )
        tooltips = [
            ("frequency", "@frequency{0.0} Hz"),
            ("Euler", "@euler{0.000} nm/kN"),
            ("Timoshenko", "@timoshenko{0.000} nm/kN"),
        ]
        self.model.add_tools(HoverTool(renderers=[dots], mode="vline", tooltips=tooltips))
        legend_above(self.model, columns=1)

    def show(self, peer, frequency, receptance):
        """Draw the peer's receptance and the frequency-domain solution's, over its own frequencies."""
        scale = NANOMETRES_PER_KILONEWTON
        self.peer.data = {
            "frequency": peer.frequency,
            "euler": scale * np.abs(peer.euler),
            "timoshenko": scale * np.abs(peer.timoshenko),
        }
        self.solution.data = {"frequency": frequency, "receptance": scale * np.abs(receptance)}
        _hold(self.model.y_range, self.solution.data["receptance"], self.peer.data["timoshenko"])


class TimeStepFigure:
    """Error of insertion gain over the time step, by rule of the damping memory.

    Attributes
    ----------
    model : bokeh.plotting.figure
        The figure.
    errors : bokeh.models.ColumnDataSource
        Named ``time_step_errors``: ``step`` [µs], ``first`` and ``second`` [dB], and lines of slope 1 and 2.
    """

    def __init__(self):
        self.errors = ColumnDataSource(
            name="time_step_errors", data={key: [] for key in ("step", "first", "second", "one", "two")}
        )
        self.model = _convergence_figure("time_step_figure", "Time step, µs")
        _slope(self.model, self.errors, "step", "one", SLOPE_ONE)
        _slope(self.model, self.errors, "step", "two", SLOPE_TWO)
        _errors(
            self.model,
            self.errors,
            "step",
            "first",
            theme.THIS_DESIGN,
            "circle",
            "the paper's damping memory",
        )
        _errors(
            self.model, self.errors, "step", "second", theme.COUPLED_BLOCK, "square", "second-order memory"
        )
        legend_above(self.model)
        self._run = Span(
            dimension="height", line_color=theme.LOADED_TRACK, line_dash="dotdash", name="run_time_step"
        )
        self.model.add_layout(self._run)

    def show(self, theory, run_step):
        """Draw the errors, and mark the time step of the run [s]."""
        steps = 1e6 * theory.time_steps
        self.errors.data = {
            "step": steps,
            "first": theory.first_order_errors,
            "second": theory.second_order_errors,
            "one": SLOPE_APART * theory.first_order_errors[-1] * steps / steps[-1],
            "two": SLOPE_APART * theory.second_order_errors[-1] * (steps / steps[-1]) ** 2,
        }
        self._run.location = 1e6 * run_step
        _hold(self.model.x_range, steps)
        _hold(self.model.y_range, *(self.errors.data[key] for key in ("first", "one", "second", "two")))


class ElementFigure:
    """Error of insertion gain over the length of an element.

    Attributes
    ----------
    model : bokeh.plotting.figure
        The figure.
    errors : bokeh.models.ColumnDataSource
        Named ``element_errors``: ``length`` [m], ``error`` [dB] and a line of slope 2.
    """

    def __init__(self):
        self.errors = ColumnDataSource(
            name="element_errors", data={key: [] for key in ("length", "error", "two")}
        )
        self.model = _convergence_figure("element_figure", "Element length, mm")
        _slope(self.model, self.errors, "length", "two", SLOPE_TWO)
        words = "frequency-domain solution"
        _errors(self.model, self.errors, "length", "error", theme.THIS_DESIGN, "circle", words)
        legend_above(self.model)
        self._run = Span(
            dimension="height", line_color=theme.LOADED_TRACK, line_dash="dotdash", name="run_element"
        )
        self.model.add_layout(self._run)

    def show(self, theory, spacing, run_length):
        """Draw the errors for a fastener spacing [m], and mark the element length of the run [m]."""
        length = 1e3 * spacing / theory.elements_per_bay
        self.errors.data = {
            "length": length,
            "error": theory.element_errors,
            "two": SLOPE_APART * theory.element_errors[-1] * (length / length[-1]) ** 2,
        }
        self._run.location = 1e3 * run_length
        _hold(self.model.x_range, length)
        _hold(self.model.y_range, theory.element_errors, self.errors.data["two"])


class DampingFigure:
    """Dynamic stiffness or loss factor of pad and boot over frequency.

    Attributes
    ----------
    model : bokeh.plotting.figure
        The figure.
    values : bokeh.models.ColumnDataSource
        ``frequency`` [Hz], ``pad``, ``boot`` and what was stated of them: ``pad_stated``, ``boot_stated``.
    """

    def __init__(self, name, label):
        columns = ("frequency", "pad", "boot", "pad_stated", "boot_stated")
        self.values = ColumnDataSource(name=name, data={key: [] for key in columns})
        self._ends = AxisEnds((0.0, 2.0))
        self.model = blank_figure(
            name=f"{name}_figure",
            x_axis_type="log",
            y_range=self._ends.model,
            x_axis_label="Frequency, Hz",
            y_axis_label=label,
            stylesheets=[theme.MEDIUM],
        )
        show_bands(self.model, every=2)
        for part, colour, dash in (
            ("pad", theme.THIS_DESIGN, "solid"),
            ("boot", theme.LOADED_TRACK, "dashed"),
        ):
            shared = {"x": "frequency", "source": self.values, "line_color": colour}
            self.model.line(y=f"{part}_stated", line_width=1, **shared)
            self.model.line(y=part, line_width=theme.LINE_WIDTH, line_dash=dash, legend_label=part, **shared)
        legend_above(self.model)
        tooltips = [("frequency", "@frequency{0.0} Hz"), ("pad", "@pad{0.000}"), ("boot", "@boot{0.000}")]
        self.model.add_tools(HoverTool(renderers=[self.model.renderers[1]], mode="vline", tooltips=tooltips))

    def show(self, frequency, **values):
        """Draw values over frequency [Hz] by column; the boot's are NaN when single-stage."""
        high = 1.2 * np.nanmax(list(values.values()))
        self._ends.show(0.0, high, nice_step(high))
        self.values.data = {"frequency": frequency, **values}


def _hold(ends, *values):
    """Let a logarithmic axis show values, with room for the whole of the dots at its ends."""
    seen = np.concatenate(values)
    room = (seen.max() / seen.min()) ** LOG_ROOM
    ends.update(start=seen.min() / room, end=seen.max() * room)


def _compared(run, exact):
    return {
        "label": list(tig.BAND_LABELS),
        "centre": tig.BAND_CENTRES,
        "left": tig.BAND_EDGES[:-1],
        "right": tig.BAND_EDGES[1:],
        "run": run,
        "exact": exact,
        "difference": run - exact,
    }


def _convergence_figure(name, label):
    plot = blank_figure(
        name=name,
        x_axis_type="log",
        y_axis_type="log",
        x_range=Range1d(1, 10),
        y_range=Range1d(1, 10),
        x_axis_label=label,
        y_axis_label="Largest error, dB",
        stylesheets=[theme.MEDIUM],
    )
    show_one_two_five(plot.xaxis[0])
    return plot


def _errors(plot, source, x, y, colour, marker, words):
    plot.line(
        x=x, y=y, source=source, line_color=colour, line_width=theme.THIN_LINE_WIDTH, legend_label=words
    )
    dots = plot.scatter(
        x=x, y=y, source=source, marker=marker, color=colour, size=theme.DOT_SIZE, legend_label=words
    )
    label = plot.xaxis.axis_label
    plot.add_tools(
        HoverTool(renderers=[dots], tooltips=[(label, f"@{x}{{0.00}}"), (words, f"@{y}{{0.00000}} dB")])
    )


def _slope(plot, source, x, y, words):
    dash = "dotted" if words == SLOPE_ONE else "dashed"
    plot.line(x=x, y=y, source=source, line_color=theme.PRESET_GHOST, line_dash=dash, legend_label=words)
