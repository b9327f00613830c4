"""The plots of report, data sheet and pictures, drawn with Matplotlib: dark on white in every theme.

Plots for HTML hold no text of the user's: names stand in the page around them.
"""

import io
import re
import threading

import numpy as np
from markupsafe import Markup
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.figure import Figure
from matplotlib.ticker import FixedFormatter, FixedLocator, NullLocator

import trackig_core as tig
from dashboard import formats, theme
from trackig_core.bands import ONE_THIRD_OCTAVES

PLOT_WIDTH = 7.3
"""Width of a plot [inch]: that of the text on A4."""

TIME_AXIS = (-0.005, 0.25)
"""What the time axis shows [s]: what follows is too quiet to be seen."""

LEVEL_ROOM = 2.0
"""Room between curves and the ends of a level axis [dB]."""

FORCE_ROOM = 1.1
"""The same for forces: factor of the extremes [-]."""

EXTRAPOLATED = {"facecolor": "none", "edgecolor": (theme.EXTRAPOLATED, 0.5), "hatch": r"\\\\", "linewidth": 0}
"""Look of bands that rest on extrapolation, in plots and their legends."""

MOST_UPRIGHT = 21
"""Bands whose labels find room side by side [-]; those of more are turned."""

LEAST_DIFFERENCES = 3.0
"""What the axis of differences reaches at least, up and down [dB]."""

MEASURED_MARKERS = ("D", "s", "^", "v")
"""Markers of measured curves, in their order: what Matplotlib calls those of the page."""

POINTS = {"linestyle": "none", "markersize": 6, "markerfacecolor": "none", "color": theme.THEORY, "zorder": 4}
"""How measured levels are drawn."""

DRAWING = threading.Lock()
"""Matplotlib is not made for several threads at once."""


def gain_svg(results, specification, height=3.5, measured=()):
    """Return insertion gain as :func:`draw_gain` draws it as a drawing (SVG), of a height [inch]."""
    with DRAWING:
        figure, axes = blank(height)
        draw_gain(axes, results, specification, measured)
        return svg(figure, "gain")


def difference_svg(results, base):
    """Return the differences of insertion gain from a base as a drawing (SVG)."""
    with DRAWING:
        figure, axes = blank(2.5)
        draw_difference(axes, results, base)
        return svg(figure, "difference")


def force_svg(results):
    """Return the force over time of all results that were stepped in time as a drawing (SVG), or None."""
    stepped = stepped_in_time(results)
    if not stepped:
        return None
    with DRAWING:
        figure, axes = blank(2.6)
        draw_force(axes, stepped)
        return svg(figure, "force")


def stepped_in_time(results):
    """Return those results that have a force over time."""
    return [each for each in results if each.summary.time is not None]


def blank(height):
    """Return a figure of a given height [inch], and its axes."""
    figure = Figure(figsize=(PLOT_WIDTH, height), layout="constrained", facecolor="none")
    FigureCanvasSVG(figure)
    return figure, figure.add_subplot(facecolor="none")


def _dress(axes, x, y):
    """Give axes the look that all have, and names."""
    axes.spines[["top", "right"]].set_visible(False)
    axes.spines[["left", "bottom"]].set_color(theme.REPORT_FAINT)
    axes.tick_params(colors=theme.REPORT_INK, labelsize=8, color=theme.REPORT_FAINT)
    axes.grid(color=theme.REPORT_RULE, linewidth=0.6)
    axes.set_axisbelow(True)
    axes.set_xlabel(x, fontsize=9, color=theme.REPORT_INK)
    axes.set_ylabel(y, fontsize=9, color=theme.REPORT_INK)
    axes.axhline(0, color=theme.REPORT_FAINT, linewidth=1)


def dress_bands(axes, label, bands=ONE_THIRD_OCTAVES):
    """Put bands (trackig_core.bands.Bands) along the axis."""
    axes.set_xscale("log")
    axes.set_xlim(bands.edges[0], bands.edges[-1])
    axes.xaxis.set_major_locator(FixedLocator(bands.centres))
    axes.xaxis.set_major_formatter(FixedFormatter(bands.labels))
    axes.xaxis.set_minor_locator(NullLocator())
    _dress(axes, f"{bands.words} band, Hz", label)
    if len(bands.labels) > MOST_UPRIGHT:
        axes.tick_params(axis="x", labelrotation=90)


def _curve(axes, x, y, result, **kind):
    dash = {"dashes": result.dash} if result.dash else {}
    (line,) = axes.plot(x, y, color=result.colour, linewidth=2, **dash, **kind)
    return line


def draw_gain(axes, results, specification, measured=()):
    """Draw insertion gain in the bands that are shown, the limit, where it is exceeded, and measured points.

    Limits and measured levels are of one-third octaves, whichever bands are shown; so are the bands that are
    hatched because they rest on extrapolation.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
        Where it is drawn.
    results : sequence of DesignResult
        Designs with a solution, front to back; bands beyond what was measured of the first are hatched.
    specification : trackig_core.Specification or None
        The limit.
    measured : sequence of trackig_core.levels.MeasuredGain
        Curves from elsewhere, drawn as points.

    Returns
    -------
    list of matplotlib.lines.Line2D
        The curve of each result, in their order.
    """
    bands = results[0].shown_gain.bands
    dress_bands(axes, "Insertion gain, dB", bands)
    lines = [
        _curve(axes, bands.centres, each.shown_gain.levels, each, marker="o", markersize=3.5)
        for each in reversed(results)
    ]
    for curve, marker in zip(measured, MEASURED_MARKERS, strict=False):
        axes.plot(tig.BAND_CENTRES, curve.levels, marker=marker, **POINTS)
    seen = np.concatenate([each.levels for each in (*(each.shown_gain for each in results), *measured)])
    seen = seen[np.isfinite(seen)] if np.isfinite(seen).any() else np.zeros(1)
    if specification is not None:
        limits = specification.levels
        seen = np.concatenate([seen, limits[np.isfinite(limits)]])
        _draw_limits(axes, limits, seen.max() + LEVEL_ROOM)
        _mark_failing(axes, results)
    _hatch_extrapolated(axes, results[0].extrapolated_bands)
    axes.set_ylim(seen.min() - LEVEL_ROOM, seen.max() + LEVEL_ROOM)
    return lines[::-1]


def _hatch_extrapolated(axes, bands):
    """Hatch bands, given by their labels, over the whole height and behind all else."""
    for band in map(tig.BAND_LABELS.index, bands):
        axes.axvspan(*tig.BAND_EDGES[band : band + 2], zorder=0, **EXTRAPOLATED)


def _draw_limits(axes, limits, top):
    """Draw the limit as steps, edge to edge, what lies above it shaded."""
    axes.stairs(
        limits, tig.BAND_EDGES, baseline=top, fill=True, color=theme.SPECIFICATION, alpha=0.07, linewidth=0
    )
    axes.stairs(limits, tig.BAND_EDGES, baseline=None, color=theme.SPECIFICATION, linewidth=2.2)


def _mark_failing(axes, results):
    # in other bands there are no points of one-third octaves to be crossed
    for each in results if results[0].shown_gain.bands == ONE_THIRD_OCTAVES else ():
        fails = each.verdict.fails
        axes.plot(
            tig.BAND_CENTRES[fails],
            each.levels[fails],
            linestyle="none",
            marker="X",
            markersize=9,
            color=each.colour,
            markeredgecolor=theme.LIGHT_PAPER,
            zorder=5,
        )
    for band in np.flatnonzero(np.any([each.verdict.fails for each in results], axis=0)):
        axes.axvspan(
            *tig.BAND_EDGES[band : band + 2], color=theme.REPORT_BAD, alpha=0.07, linewidth=0, zorder=0
        )


def draw_difference(axes, results, base):
    """Draw insertion gain less that of a base, as :func:`draw_gain` does; return the curves."""
    bands = base.shown_gain.bands
    dress_bands(axes, "Difference, dB", bands)
    differences = [each.shown_gain.levels - base.shown_gain.levels for each in results]
    lines = [
        _curve(axes, bands.centres, difference, each, marker="o", markersize=3)
        for each, difference in zip(reversed(results), reversed(differences), strict=True)
    ]
    reach = np.nanmax([LEAST_DIFFERENCES, *np.abs(differences).ravel()]) + LEVEL_ROOM / 2
    axes.set_ylim(-reach, reach)
    return lines[::-1]


def draw_force(axes, results):
    """Draw the force over time, the first result setting the scale, as :func:`draw_gain` does."""
    _dress(axes, "Time since the step, ms", "Force into the ground, kN")
    lines = []
    for each in reversed(results):
        summary = each.summary
        shown = (TIME_AXIS[0] <= summary.time) & (summary.time <= TIME_AXIS[1])
        lines.append(_curve(axes, 1000 * summary.time[shown], summary.total_force[shown], each))
    axes.set_xlim(1000 * TIME_AXIS[0], 1000 * TIME_AXIS[1])
    axes.set_ylim(*_force_ends(results))
    return lines[::-1]


def _force_ends(results):
    first = results[0].summary.total_force
    return FORCE_ROOM * first.min(), FORCE_ROOM * first.max()


def beyond_texts(results):
    """Return how far each force reaches beyond the axis, in words (list of str); empty if it does not.

    Parameters
    ----------
    results : sequence of DesignResult
        Designs that were stepped in time, as they are drawn.
    """
    ends = _force_ends(results)
    totals = [each.summary.total_force for each in results]
    return [formats.beyond_text(total.min(), total.max(), *ends) for total in totals]


def svg(figure, name):
    """Return a figure as SVG for a page; its identifiers begin with its name, since a page has several."""
    file = io.StringIO()
    nothing = dict.fromkeys(("Creator", "Date", "Format", "Type"))
    figure.savefig(file, format="svg", metadata=nothing)
    drawing = file.getvalue()
    drawing = re.sub(r'( id="|href="#|url\(#)', rf"\g<1>{name}-", drawing[drawing.index("<svg") :])
    return Markup(drawing)
