"""The pictures: built once with Bokeh, then fed by assigning each data source's ``data``.

Assigning a source costs a tenth of a millisecond where a new figure costs a hundred times more.
Sources carry names, so that tests can read in the browser what is drawn. Figures know data and
style, no widgets and no server.

Axes stay put while they can, so that the eye sees the change; they move when data
would leave them, or would fill less than half.
"""

import math

from bokeh.models import (
    BoxZoomTool,
    CustomJS,
    FixedTicker,
    PanTool,
    Range1d,
    ResetTool,
    SaveTool,
    Span,
    WheelZoomTool,
)
from bokeh.plotting import figure

import trackig_core as tig
from dashboard import theme
from trackig_core.bands import ONE_THIRD_OCTAVES

LEVEL_STEP = 5.0
"""Grid of the ends of the level axis [dB]."""

LEVEL_ROOM = 2.0
"""Room between the curve and the ends of the level axis [dB]."""


BAND_AXIS = (tig.BAND_EDGES[0], tig.BAND_EDGES[-1])
"""What the frequency axis shows: all bands, edge to edge [Hz]."""


def settled_range(current, low, high, step):
    """Return the ends of an axis that shows data from ``low`` to ``high``.

    Parameters
    ----------
    current : tuple of float
        The ends as they are.
    low, high : float
        What must be seen.
    step : float
        Ends are multiples of this.

    Returns
    -------
    tuple of float
        ``current`` while the data lie within it and fill half of it; else the nearest multiples
        around the data.
    """
    wanted = (math.floor(low / step) * step, math.ceil(high / step) * step)
    inside = current[0] <= low and high <= current[1]
    filled = wanted[1] - wanted[0] >= (current[1] - current[0]) / 2
    return current if inside and filled else wanted


def nice_step(span):
    """Return the 1, 2 or 5 times a power of ten that cuts a span into five to twelve parts."""
    rough = span / 10
    power = 10.0 ** math.floor(math.log10(rough))
    return next(factor * power for factor in (1, 2, 5, 10) if factor * power >= rough)


class AxisEnds:
    """The ends of one axis: they move by :func:`settled_range`, unless the user has zoomed."""

    def __init__(self, ends):
        self.model = Range1d(*ends)
        self._home = ends

    @property
    def home(self):
        """The ends of the axis as it is while nobody zooms, a tuple."""
        return self._home

    def show(self, low, high, step):
        """Make sure that the axis shows what lies from ``low`` to ``high``."""
        home = settled_range(self._home, low, high, step)
        if home == self._home:
            return
        zoomed = (self.model.start, self.model.end) != self._home
        self._home = home
        self.model.reset_start, self.model.reset_end = home
        if not zoomed:
            self.model.start, self.model.end = home


LABEL_AS_FIT = f"""
    const fit = Math.ceil({theme.BAND_LABEL_WIDTH} * centres.length / cb_obj.inner_width)
    const ticks = centres.filter((_, band) => band % Math.max(every, fit) == 0)
    if (ticks.length != ticker.ticks.length) {{ ticker.ticks = ticks }}
"""


class BandAxis:
    """The frequency axis of a figure over bands, edge to edge.

    Where labels would touch each other, as on a small screen, fewer bands are labelled.

    Parameters
    ----------
    plot : bokeh.plotting.figure
        The figure.
    every : int
        One band in so many is labelled.

    Attributes
    ----------
    bands : trackig_core.bands.Bands
        The bands that it has.
    """

    def __init__(self, plot, every=1):
        self.bands = ONE_THIRD_OCTAVES
        self._axis, self._every = plot.xaxis, every
        self._range = plot.x_range = Range1d(*BAND_AXIS, bounds=BAND_AXIS)
        self._ticker = plot.xaxis.ticker = FixedTicker(ticks=self._ticks, minor_ticks=[])
        everything = {"ticker": self._ticker, "centres": list(self.bands.centres), "every": every}
        self._fit = CustomJS(args=everything, code=LABEL_AS_FIT)
        plot.js_on_change("inner_width", self._fit)
        self._name()
        plot.xgrid.visible = False

    @property
    def _ticks(self):
        return list(self.bands.centres[:: self._every])

    @property
    def ends(self):
        """Edges of the outer bands [Hz], a tuple."""
        return tuple(map(float, self.bands.edges[[0, -1]]))

    def _name(self):
        self._axis.major_label_overrides = dict(zip(self.bands.centres, self.bands.labels, strict=True))

    def show(self, bands):
        """Give the axis other bands (trackig_core.bands.Bands); the same again change nothing."""
        if bands == self.bands:
            return
        self.bands = bands
        low, high = self.ends
        self._range.update(bounds=(low, high), start=low, end=high, reset_start=low, reset_end=high)
        self._ticker.ticks = self._ticks
        self._fit.args = {**self._fit.args, "centres": list(bands.centres)}
        self._name()
        self._axis.axis_label = f"{bands.words} band, Hz"


def show_bands(plot, every=1):
    """Give a figure's frequency axis the paper's bands (:class:`BandAxis`)."""
    return BandAxis(plot, every)


TICKS = [factor * 10.0**power for power in range(-2, 7) for factor in (1, 2, 5)]
"""Ticks of a logarithmic axis of any input, of frequencies, or of the receptance of the softest track."""


def show_one_two_five(axis):
    """Give a logarithmic axis ticks at 1, 2 and 5 times the powers of ten, as plain numbers."""
    axis.ticker = FixedTicker(ticks=TICKS)
    axis.major_label_overrides = {tick: f"{tick:.7g}" for tick in TICKS}


def zero_line(dimension="width"):
    """Return a line at zero: on the vertical axis, or with ``"height"`` on the horizontal one."""
    return Span(
        location=0, dimension=dimension, line_color=theme.PRESET_GHOST, line_width=theme.THIN_LINE_WIDTH
    )


def blank_figure(aria_label="", **options):
    """Return an empty figure with the tools that all have, and a name that screen readers tell."""
    plot = figure(**options)
    dress(plot, aria_label or options["y_axis_label"])
    return plot


KEYS = ("ArrowLeft", "ArrowRight", "ArrowUp", "ArrowDown", "Enter")
"""Keys by which a place is chosen in a figure, as browsers call them."""


def dress(plot, aria_label, keys=()):
    """Give a figure the tools and the sizes of text that all have, and a name that screen readers tell.

    Keys are those that it is operated with while it has the keyboard's focus.
    """
    plot.html_attributes = {"role": "figure", "aria-label": aria_label}
    if keys:
        plot.html_attributes |= {"aria-keyshortcuts": " ".join(keys)}
    plot.tools = [PanTool(), BoxZoomTool(), WheelZoomTool(dimensions="width"), ResetTool(), SaveTool()]
    plot.update(toolbar_location="right", sizing_mode="stretch_width")
    plot.toolbar.logo = None
    plot.toolbar.autohide = True
    keep_sizes(plot)


def keep_sizes(plot):
    """Give the text of a figure's axes the sizes of narrow or wide windows, whatever the theme says."""
    narrow, wide = SIZES
    axes = list(plot.axis)
    fit = CustomJS(args={"axes": axes, "narrow": narrow, "wide": wide}, code=FIT_SIZES)
    # a window that is resized is told by the width that it leaves to the frame
    plot.js_on_change("inner_width", fit)
    for axis in axes:
        axis.update(**wide)
        for name in wide:
            axis.js_on_change(name, fit)


SIZES = [
    {"major_label_text_font_size": ticks, "axis_label_text_font_size": axis}
    for ticks, axis in zip(theme.TICK_SIZES, theme.AXIS_SIZES, strict=True)
]
"""Sizes of an axis' text in narrow windows, and in wide ones."""

FIT_SIZES = f"""
    const wanted = window.innerWidth < {theme.NARROW_WINDOW} ? narrow : wide
    for (const axis of axes) {{
        if (Object.keys(wanted).some(name => axis[name] !== wanted[name])) {{
            axis.setv(wanted, {{sync: false}})
        }}
    }}
"""
