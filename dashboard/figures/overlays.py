"""Pictures that are described with HoloViews, rendered once and then fed.

For what is seen at rest: a description costs a tenth of a second to render, its data source a tenth of a
millisecond to assign.
"""

import numpy as np
from bokeh.core.properties import value

import trackig_core as tig
from dashboard import formats, theme
from dashboard.figures.axes import dress, show_bands
from dashboard.figures.legends import dress_legend, update_legend

LOOK = {
    "responsive": True,
    "show_grid": True,
    "active_tools": [],
    "legend_position": "bottom_left",
    "legend_opts": {"click_policy": "none"},
}
"""Options of every description, the legend's among them."""

LIKE_OTHERS = {"output_backend": "canvas", "align": "auto"} | {
    f"min_border_{side}": None for side in ("left", "right", "top", "bottom")
}
"""Properties of a rendered figure that HoloViews sets differently from figures drawn with Bokeh alone."""


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
    # imported here since it takes 0.4 s, which a dashboard that opens on another tab need not wait for
    import holoviews as hv

    hv.renderer("bokeh")
    empty = (tig.BAND_CENTRES, np.full(tig.BAND_CENTRES.size, np.nan))
    zero = hv.HLine(0).opts(line_color=theme.PRESET_GHOST, line_width=theme.THIN_LINE_WIDTH)
    curves = [hv.Curve(empty, "centre", name, label=name).opts(**look) for name, look in looks.items()]
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
    import holoviews as hv

    rendering = hv.renderer("bokeh").get_plot(overlay)
    plot = rendering.state
    # HoloViews keeps every figure, to update it from its streams; this one has none and ends with its session
    rendering.cleanup()
    plot.update(**LIKE_OTHERS, **options)
    dress(plot, aria_label)
    plot.toolbar.active_drag = "auto"
    return plot


def curve_name(each):
    """Return what a design (DesignResult) is called beside its curve."""
    return each.name if each.key is not None else "this design"


class BandCurves:
    """A figure with curves over the bands, one for each of so many designs, and their legend.

    Parameters
    ----------
    source : bokeh.models.ColumnDataSource
        The levels: a column for each curve, and ``centre`` [Hz].
    looks : mapping of str to dict
        As :func:`band_overlay` takes them.
    label, aria_label : str
        What the value axis says, and what screen readers say of the figure.
    options : dict
        Properties of the figure.

    Attributes
    ----------
    model : bokeh.plotting.figure
        The figure.
    lines : dict of str to bokeh.models.GlyphRenderer
        The curve of each column.
    """

    def __init__(self, source, looks, label, aria_label, **options):
        self.model = rendered(band_overlay(looks, label), aria_label, **options)
        show_bands(self.model)
        self._legend = self.model.legend[0]
        dress_legend(self._legend)
        self._entries = dict(zip(looks, self._legend.items, strict=True))
        self.lines = {name: entry.renderers[0] for name, entry in self._entries.items()}
        for line in self.lines.values():
            line.data_source = source

    def show(self, drawn):
        """Give curves their looks and names, and hide those that are not drawn.

        Parameters
        ----------
        drawn : mapping of str to DesignResult
            Column and design of each curve that is drawn, in the order of the legend.
        """
        for name, line in self.lines.items():
            line.visible = name in drawn
        for name, each in drawn.items():
            self.lines[name].glyph.update(line_color=each.colour, line_dash=list(each.dash))
            self._entries[name].label = value(formats.name_text(curve_name(each), theme.LEGEND_NAME))
        shown = [self._entries[name] for name in drawn]
        hidden = [entry for name, entry in self._entries.items() if name not in drawn]
        update_legend(self._legend, shown + hidden, shown)
