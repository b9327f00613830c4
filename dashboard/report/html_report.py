"""A report of a study: one HTML file that needs nothing else, asks for nothing and prints on A4.

Plots are vector drawings within the file. Units are those of the trade: kN/mm, kg, m, Hz, dB. Names come
from files and links, so the template escapes whatever it shows, plots hold no text of the user's, and the
file forbids scripts and requests to whoever opens it. A report never solves: a design without a solution is
named as left out.
"""

import io
import re
import threading
from dataclasses import replace

import jinja2
import numpy as np
from markupsafe import Markup
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.figure import Figure
from matplotlib.ticker import FixedFormatter, FixedLocator, NullLocator

import trackig_core as tig
from dashboard import formats, theme
from dashboard.fields import FIELDS, NEWTON_PER_METRE
from dashboard.session.pins import current_design, distinct_colours, shown_designs
from dashboard.session.results import DesignResult

PLOT_WIDTH = 7.3
"""Width of a plot [inch]: that of the text on A4."""

TIME_AXIS = (-0.005, 0.25)
"""What the time axis shows [s]: what follows is too quiet to be seen."""

LEVEL_ROOM = 2.0
"""Room between curves and the ends of a level axis [dB]."""

LEAST_DIFFERENCES = 3.0
"""What the axis of differences reaches at least, up and down [dB]."""

FREQUENCIES = (
    ("Loaded track", lambda natural: natural.loaded_track),
    ("observed in the run", lambda natural: natural.observed_loaded_track),
    ("Coupled block", lambda natural: natural.coupled_block),
    ("observed in the run", lambda natural: natural.observed_coupled_block),
    ("Wheel, blocks held", lambda natural: natural.wheel_on_rigid_blocks),
    ("Block on its boot alone", lambda natural: natural.block_on_boot),
    ("Cut-on of the free track", lambda natural: natural.cut_on),
)
"""Name of each row of the table of natural frequencies, and what stands in it."""

SUMMATIONS = {
    "energy": "energies of the supports summed, as in the paper",
    "coherent": "forces of the supports summed",
}
REFERENCES = {
    "line": "relative to the straight line through the track's own spectrum, as in the paper",
    "rigid": "relative to the exact rigid track",
    "stiff": "relative to a very stiff track on the same ground, under the same vehicle",
}
"""How each kind of insertion gain is named."""

_DRAWING = threading.Lock()
"""Matplotlib is not made for several threads at once."""

_TEMPLATES = jinja2.Environment(
    loader=jinja2.PackageLoader("dashboard.report", "templates"),
    autoescape=True,
    undefined=jinja2.StrictUndefined,
    trim_blocks=True,
    lstrip_blocks=True,
)


def html_report(study, summaries, *, date, version):
    """Return a report of a study.

    Parameters
    ----------
    study : trackig_core.Study
        What is reported: the current design and the pinned designs that are shown.
    summaries : mapping of TrackDesign to SolutionSummary
        Solutions; a shown design that has none is named as left out.
    date : datetime.date
        The day of the report.
    version : str
        Version of the software.

    Returns
    -------
    str
        An HTML file.

    Raises
    ------
    ValueError
        If there is no solution of any design that is shown.
    """
    every = _results(study, summaries)
    results = [each for each in every if each.shown and each.summary is not None]
    if not results:
        raise ValueError("there is no solution of any design to report: solve one first")
    base = every[0 if study.view.base is None else 1 + study.view.base]
    base = base if base.summary is not None else results[0]
    return _TEMPLATES.get_template("report.html").render(
        study=study,
        date=f"{date.day} {date:%B %Y}",
        version=version,
        results=results,
        base=base,
        left_out=[each.name for each in shown_designs(study) if each.design not in summaries],
        hidden=[each.name for each in study.pinned if not each.shown],
        kind=f"{SUMMATIONS[study.view.summation]}; {REFERENCES[study.view.reference]}",
        gain_plot=_gain_plot(results, study.specification),
        difference_plot=_difference_plot(results, base) if len(results) > 1 else None,
        force_plot=_force_plot(results),
        step=next((each.summary.step for each in results if each.summary.step), None),
        inputs=_inputs(results, base),
        frequencies=_frequencies(results),
        bands=_bands(results, study.specification),
        margins=_margins(results, study.specification),
        sources=_sources(results, base, study.source),
        fidelities=" and ".join(sorted({each.summary.solution.fidelity for each in results})),
        notes=[(each.name, each.summary.solution.notes) for each in results if each.summary.solution.notes],
        file=study.to_toml(),
        theme=theme,
    )


def _results(study, summaries):
    """Return the current design and every pinned one, with what is known of each (DesignResult)."""
    colours = distinct_colours(each.colour for each in study.pinned)
    pinned = (replace(each, colour=own) for each, own in zip(study.pinned, colours, strict=True))
    records = (current_design(study.design), *pinned)
    return [_result(study, record, summaries.get(record.design)) for record in records]


def _result(study, record, summary):
    if summary is None:
        return DesignResult(record)
    gain = summary.solution.gain_for(study.view.reference, study.view.summation)
    limits = study.specification
    deflection = tig.analysis.limited_deflection(limits, record.design)
    verdict = None if limits is None else limits.check(gain.levels, deflection)
    level = None if study.source is None else study.source.with_track(gain.levels)
    return DesignResult(record, summary, gain, verdict, level)


def _plot(height):
    """Return a figure of a given height [inch], and its axes."""
    figure = Figure(figsize=(PLOT_WIDTH, height), layout="constrained", facecolor="none")
    FigureCanvasSVG(figure)
    axes = figure.add_subplot(facecolor="none")
    axes.spines[["top", "right"]].set_visible(False)
    axes.spines[["left", "bottom"]].set_color(theme.REPORT_FAINT)
    axes.tick_params(colors=theme.REPORT_INK, labelsize=8, color=theme.REPORT_FAINT)
    axes.grid(color=theme.REPORT_RULE, linewidth=0.6)
    axes.set_axisbelow(True)
    return figure, axes


def _band_plot(height, label):
    """Return a figure with the bands along its axis."""
    figure, axes = _plot(height)
    axes.set_xscale("log")
    axes.set_xlim(tig.BAND_EDGES[0], tig.BAND_EDGES[-1])
    axes.xaxis.set_major_locator(FixedLocator(tig.BAND_CENTRES))
    axes.xaxis.set_major_formatter(FixedFormatter(tig.BAND_LABELS))
    axes.xaxis.set_minor_locator(NullLocator())
    _name_axes(axes, "One-third-octave band, Hz", label)
    axes.axhline(0, color=theme.REPORT_FAINT, linewidth=1)
    return figure, axes


def _name_axes(axes, x, y):
    axes.set_xlabel(x, fontsize=9, color=theme.REPORT_INK)
    axes.set_ylabel(y, fontsize=9, color=theme.REPORT_INK)


def _curve(axes, x, y, result, **kind):
    dash = {"dashes": result.dash} if result.dash else {}
    axes.plot(x, y, color=result.colour, linewidth=2, **dash, **kind)


def _gain_plot(results, specification):
    with _DRAWING:
        figure, axes = _band_plot(3.5, "Insertion gain, dB")
        for each in reversed(results):
            _curve(axes, tig.BAND_CENTRES, each.levels, each, marker="o", markersize=3.5)
        seen = np.concatenate([each.levels for each in results])
        if specification is not None:
            limits = specification.levels
            seen = np.concatenate([seen, limits[np.isfinite(limits)]])
            _draw_limits(axes, limits, seen.max() + LEVEL_ROOM)
            _mark_failing(axes, results)
        axes.set_ylim(seen.min() - LEVEL_ROOM, seen.max() + LEVEL_ROOM)
        return _svg(figure, "gain")


def _draw_limits(axes, limits, top):
    """Draw the limit as steps, edge to edge, what lies above it shaded."""
    axes.stairs(
        limits, tig.BAND_EDGES, baseline=top, fill=True, color=theme.SPECIFICATION, alpha=0.07, linewidth=0
    )
    axes.stairs(limits, tig.BAND_EDGES, baseline=None, color=theme.SPECIFICATION, linewidth=2.2)


def _mark_failing(axes, results):
    for each in results:
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


def _difference_plot(results, base):
    with _DRAWING:
        figure, axes = _band_plot(2.5, "Difference, dB")
        differences = [each.levels - base.levels for each in results]
        for each, difference in zip(reversed(results), reversed(differences), strict=True):
            _curve(axes, tig.BAND_CENTRES, difference, each, marker="o", markersize=3)
        reach = max(LEAST_DIFFERENCES, np.abs(differences).max()) + LEVEL_ROOM / 2
        axes.set_ylim(-reach, reach)
        return _svg(figure, "difference")


def _force_plot(results):
    """Return the force over time of all designs that were stepped in time, or None."""
    stepped = [each for each in results if each.summary.time is not None]
    if not stepped:
        return None
    with _DRAWING:
        figure, axes = _plot(2.6)
        for each in reversed(stepped):
            summary = each.summary
            shown = (TIME_AXIS[0] <= summary.time) & (summary.time <= TIME_AXIS[1])
            _curve(axes, 1000 * summary.time[shown], summary.total_force[shown], each)
        axes.set_xlim(1000 * TIME_AXIS[0], 1000 * TIME_AXIS[1])
        axes.axhline(0, color=theme.REPORT_FAINT, linewidth=1)
        _name_axes(axes, "Time since the step, ms", "Force into the ground, kN")
        return _svg(figure, "force")


def _svg(figure, name):
    """Return a figure as SVG for a page; its identifiers begin with its name, since a page has several."""
    file = io.StringIO()
    nothing = dict.fromkeys(("Creator", "Date", "Format", "Type"))
    figure.savefig(file, format="svg", metadata=nothing)
    drawing = file.getvalue()
    drawing = re.sub(r'( id="|href="#|url\(#)', rf"\g<1>{name}-", drawing[drawing.index("<svg") :])
    return Markup(drawing)


def _inputs(results, base):
    """Return rows of (name, unit, cells), a cell being (text, whether it differs from the base)."""
    rows = [("rail", "Rail", ""), *((field.name, field.label, field.unit) for field in FIELDS.values())]
    return [
        (
            label,
            unit,
            [
                (_input(each.design, name), getattr(each.design, name) != getattr(base.design, name))
                for each in results
            ],
        )
        for name, label, unit in rows
    ]


def _input(design, field):
    """Return an input as the report shows it."""
    value = getattr(design, field)
    if value is None:
        return "in the stiffness table" if _has_own_loss(design, field) else "–"
    if isinstance(value, tig.Rail):
        bending = formats.quantity_text(value.bending_stiffness / NEWTON_PER_METRE)
        return f"{value.name}: {formats.quantity_text(value.mass_per_metre)} kg/m, {bending} MN m²"
    if isinstance(value, tig.StiffnessCurve | tig.LossFactorCurve):
        first, last = (formats.quantity_text(value.points[end][0]) for end in (0, -1))
        return f"measured at {len(value.points)} frequencies, {first} to {last} Hz"
    return formats.quantity_text(FIELDS[field].to_display(value))


def _has_own_loss(design, field):
    part = field.removesuffix("_loss_factor")
    return part != field and isinstance(getattr(design, f"{part}_stiffness"), tig.StiffnessCurve)


def _frequencies(results):
    """Return rows of (name, cells)."""
    return [
        (name, [_hertz(take(each.summary.solution.natural_frequencies)) for each in results])
        for name, take in FREQUENCIES
    ]


def _hertz(value):
    if value is None:
        return "–"
    values = value if isinstance(value, tuple) else (value,)
    return " and ".join(formats.frequency_text(each).removesuffix(" Hz") for each in values)


def _bands(results, specification):
    """Return rows of (label, limit, cells), a cell being (text, whether it exceeds the limit)."""
    limits = np.full(tig.BAND_CENTRES.size, np.nan) if specification is None else specification.levels
    return [
        (
            label,
            formats.signed_text(limits[band]) if np.isfinite(limits[band]) else "",
            [
                (formats.signed_text(each.levels[band]), bool(each.verdict and each.verdict.fails[band]))
                for each in results
            ],
        )
        for band, label in enumerate(tig.BAND_LABELS)
    ]


def _margins(results, specification):
    """Return rows of (label, cells) for the bands that are specified, a cell as in the table of bands."""
    if specification is None:
        return []
    return [
        (
            label,
            [
                (formats.signed_text(each.verdict.margins[band]), bool(each.verdict.fails[band]))
                for each in results
            ],
        )
        for band, label in enumerate(tig.BAND_LABELS)
        if np.isfinite(specification.levels[band])
    ]


def _sources(results, base, source):
    """Return rows of (result or None, four texts); the first is the reference track."""
    if source is None:
        return []
    reference = source.with_track(np.zeros(tig.BAND_CENTRES.size))
    levels = [(None, reference), *((each, each.level) for each in results)]
    return [
        (
            each,
            [
                formats.plain_text(level.unweighted),
                formats.plain_text(level.a_weighted),
                *map(formats.signed_text, level.relative_to(base.level)),
            ],
        )
        for each, level in levels
    ]
