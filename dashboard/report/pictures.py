"""Plots as picture files for other people's reports: title, study, definition, legend and date are in them.

Names come from users: Matplotlib draws them as text, never as formulas.
"""

import io
import math

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from dashboard import formats, theme
from dashboard.report import plots

WIDTH, RESOLUTION = 10.0, 240
"""Width of a picture [inch] and its points per inch: 2400 points."""

LEAST_HEIGHT = 6.0
"""Height of a picture at least [inch]."""

AROUND, LEGEND_ROW = 1.75, 0.21
"""Height of titles and axis together, and of a row of the legend [inch]."""

DATA_PART = 2 / 3
"""Part of a picture's height that is left to the data [-]."""

SIDE, ENTRY, LETTER = 0.3, 0.55, 0.082
"""Widths: of the margin, of a legend's entry without its words, and of a letter of those [inch]."""

TITLES = {
    "gain": "Insertion gain",
    "difference": "Difference in insertion gain from {base}",
    "force": "Force into the ground, summed over all supports",
}
"""What each kind of picture is called."""


def picture(kind, form, results, heading, *, base=None, specification=None, measured=()):
    """Return a plot as a file.

    Parameters
    ----------
    kind : str
        ``"gain"``, ``"difference"`` or ``"force"``.
    form : str
        ``"png"`` or ``"svg"``.
    results : sequence of DesignResult
        Designs with a solution, front to back; for forces all are stepped in time.
    heading : Heading
        What the picture says of itself.
    base : DesignResult, optional
        The design from which differences are taken.
    specification : trackig_core.Specification, optional
        The limit that is drawn with insertion gain.
    measured : sequence of trackig_core.levels.MeasuredGain
        Curves from elsewhere that are drawn with insertion gain.

    Returns
    -------
    bytes
        The file.
    """
    with plots.DRAWING:
        figure = Figure(layout="constrained", facecolor=theme.LIGHT_PAPER)
        FigureCanvasAgg(figure)
        axes = figure.add_subplot()
        handles, names = _draw(kind, axes, results, heading, base, specification, measured)
        _write_words(figure, TITLES[kind].format(base=_name(base, heading) if base else ""), heading)
        _add_legend(figure, handles, names)
        file = io.BytesIO()
        nothing = {"Date": None} if form == "svg" else {}
        figure.savefig(file, format=form, dpi=RESOLUTION, metadata={"Title": heading.study, **nothing})
        return file.getvalue()


def _draw(kind, axes, results, heading, base, specification, measured):
    """Draw the curves, and return what the legend shows: handles and names."""
    names = [_name(each, heading) for each in results]
    if kind == "force":
        handles = plots.draw_force(axes, results)
        beyond = plots.beyond_texts(results)
        return handles, [name + words for name, words in zip(names, beyond, strict=True)]
    if kind == "difference":
        return plots.draw_difference(axes, results, base), names
    handles = plots.draw_gain(axes, results, specification, measured)
    for curve, marker in zip(measured, plots.MEASURED_MARKERS, strict=False):
        handles.append(Line2D([], [], marker=marker, **plots.POINTS))
        names.append(f"measured: {curve.name}")
    if specification is not None:
        handles.append(Patch(facecolor="none", edgecolor=theme.SPECIFICATION, linewidth=2))
        names.append(f"greatest allowed: {specification.name}")
    if results[0].extrapolated_bands:
        handles.append(Patch(**plots.EXTRAPOLATED))
        names.append(formats.extrapolated_text(names[0]))
    marked = results[0].summary.solution.natural_frequencies
    for words, frequency, colour in (
        ("loaded track", marked.loaded_track, theme.LOADED_TRACK),
        ("coupled block", marked.coupled_block, theme.COUPLED_BLOCK),
    ):
        if frequency is not None:
            axes.axvline(frequency, color=colour, linewidth=1.5, linestyle="dashdot", zorder=1)
            handles.append(Line2D([], [], color=colour, linewidth=1.5, linestyle="dashdot"))
            names.append(f"{words} {formats.frequency_text(frequency)}")
    return handles, names


def _name(result, heading):
    """Return what a design is called: the current one by what it comes from."""
    return heading.design if result.key is None else result.name


def _write_words(figure, title, heading):
    ink, faint = theme.REPORT_INK, theme.REPORT_FAINT
    figure.suptitle(
        f"{title}\n{heading.study} · {heading.design}",
        x=SIDE / WIDTH,
        ha="left",
        fontsize=14,
        fontweight="bold",
        color=ink,
        parse_math=False,
    )
    figure.axes[0].set_title(
        f"Insertion gain: {heading.definition}{heading.in_bands}\n"
        f"Solution: {heading.fidelity} · {heading.day} · trackig {heading.version}",
        loc="left",
        fontsize=8.5,
        color=faint,
        parse_math=False,
    )


def _add_legend(figure, handles, names):
    """Put the legend below the axes, and make the picture as high as leaves the data their part."""
    columns = max(1, min(4, int((WIDTH - 2 * SIDE) / (ENTRY + LETTER * max(map(len, names))))))
    rows = math.ceil(len(names) / columns)
    around = AROUND + LEGEND_ROW * rows
    figure.set_size_inches(WIDTH, max(LEAST_HEIGHT, around / (1 - DATA_PART)))
    legend = figure.legend(
        handles, names, loc="outside lower left", ncols=columns, fontsize=9, frameon=False, handlelength=3
    )
    for text in legend.get_texts():
        text.set_parse_math(False)
        text.set_color(theme.REPORT_INK)
