"""Pictures that are described with HoloViews, rendered once and then fed.

For what is seen at rest: a description of one curve costs 40 ms to render, its data source a tenth of a
millisecond to assign.
"""

import numpy as np

import trackig_core as tig
from dashboard import theme
from dashboard.figures.axes import dress

LOOK = {
    "responsive": True,
    "show_grid": True,
    "show_title": False,
    "show_legend": False,
    "active_tools": [],
}
"""Options of every description; legends stand outside the axes."""

LIKE_OTHERS = {"output_backend": "canvas", "align": "auto"} | {
    f"min_border_{side}": None for side in ("left", "right", "top", "bottom")
}
"""Properties of a rendered figure that HoloViews sets differently from figures drawn with Bokeh alone."""


def load():
    """Import HoloViews and its Bokeh backend: 0.4 s, for which neither first page nor command line need wait.

    Returns
    -------
    module
        ``holoviews``.
    """
    import holoviews as hv

    hv.renderer("bokeh")
    return hv


def band_overlay(looks, label):
    """Describe curves over the one-third-octave bands, a line at zero behind them.

    Parameters
    ----------
    looks : mapping of str to dict
        Per curve its column in the source that feeds it, and its ``line_`` options, back to front.
    label : str
        What the value axis says.

    Returns
    -------
    holoviews.Overlay
        The zero line and a curve for each column, as yet without levels.
    """
    hv = load()
    empty = (tig.BAND_CENTRES, np.full(tig.BAND_CENTRES.size, np.nan))
    zero = hv.HLine(0).opts(line_color=theme.PRESET_GHOST, line_width=theme.THIN_LINE_WIDTH)
    curves = [hv.Curve(empty, "centre", name).opts(**look) for name, look in looks.items()]
    return hv.Overlay([zero, *curves]).opts(
        logx=True, xlabel="One-third-octave band, Hz", ylabel=label, **LOOK
    )


def rendered(overlay, aria_label, **options):
    """Return the figure that shows a description, with the tools and the sizes of text that all have.

    Parameters
    ----------
    overlay : holoviews.Overlay
        What is shown.
    aria_label : str
        What screen readers say of it.
    options : dict
        Properties of the figure, such as its ``name``.

    Returns
    -------
    bokeh.plotting.figure
        The figure.
    """
    rendering = load().renderer("bokeh").get_plot(overlay)
    plot = rendering.state
    # HoloViews keeps every figure, to update it from its streams; this one has none and ends with its session
    rendering.cleanup()
    plot.update(**LIKE_OTHERS, **options)
    dress(plot, aria_label)
    plot.toolbar.active_drag = "auto"
    return plot
