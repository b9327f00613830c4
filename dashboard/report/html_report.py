"""A report of a study: one HTML file that needs nothing else, asks for nothing and prints on A4.

Plots are vector drawings within the file. Units are those of the trade: kN/mm, kg, m, Hz, dB. Names come
from files and links, so the template escapes whatever it shows, plots hold no text of the user's, and the
file forbids scripts and requests to whoever opens it.

The one rule: a report shows solutions and never solves; a design without one is named as left out.
"""

import io
import re
import threading
from dataclasses import dataclass

import jinja2
import numpy as np
from markupsafe import Markup
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.figure import Figure
from matplotlib.ticker import FixedFormatter, FixedLocator, NullLocator

import trackig_core as tig
from dashboard import formats, theme
from dashboard.fields import NEWTON_PER_METRE, to_display
from dashboard.session.pins import THIS_DESIGN, distinct_colours, shown_designs
from dashboard.session.results import SolutionSummary

PLOT_WIDTH = 7.3
"""Width of a plot [inch]: that of the text on A4."""

TIME_AXIS = (-0.005, 0.25)
"""What the time axis shows [s]: what follows is too quiet to be seen."""

LEVEL_ROOM = 2.0
"""Room between curves and the ends of a level axis [dB]."""

LEAST_DIFFERENCES = 3.0
"""What the axis of differences reaches at least, up and down [dB]."""

ROWS = (
    ("pad_stiffness", "Pad stiffness", "kN/mm"),
    ("pad_loss_factor", "Pad loss factor", ""),
    ("block_mass", "Block mass", "kg"),
    ("boot_stiffness", "Boot stiffness", "kN/mm"),
    ("boot_loss_factor", "Boot loss factor", ""),
    ("fastener_spacing", "Fastener spacing", "m"),
    ("rail", "Rail", ""),
    ("wheel_mass", "Unsprung wheel mass", "kg"),
    ("contact_stiffness", "Contact stiffness", "kN/mm"),
)
"""Field, name and unit of the inputs, in the order of the load path."""

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
    "line": "against the straight line through the track's own spectrum, as in the paper",
    "rigid": "against the exact rigid track",
}
"""How the kinds of insertion gain are put in words."""

_DRAWING = threading.Lock()
"""Matplotlib is not made for several threads at once."""

_TEMPLATES = jinja2.Environment(
    loader=jinja2.PackageLoader("dashboard.report", "templates"),
    autoescape=True,
    undefined=jinja2.StrictUndefined,
    trim_blocks=True,
    lstrip_blocks=True,
)


@dataclass(frozen=True, eq=False)
class Line:
    """One design as the report shows it.

    Attributes
    ----------
    name : str
        What it is called.
    colour : str
        Colour of its curves.
    dash : tuple of float
        Dash of its curves; empty if solid.
    summary : SolutionSummary
        Its solution.
    levels : numpy.ndarray (21,) [dB]
        Its insertion gain, as the study reckons it.
    verdict : trackig_core.Verdict or None
        How it fares against the specification.
    """

    name: str
    colour: str
    dash: tuple[float, ...]
    summary: SolutionSummary
    levels: np.ndarray
    verdict: tig.Verdict | None

    @property
    def design(self):
        """The design."""
        return self.summary.design


def html_report(study, summaries, *, date, version):
    """Return a report of a study.

    Parameters
    ----------
    study : trackig_core.Study
        What is reported: the design at hand and the pinned designs that are shown.
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
    every = _lines(study, summaries)
    shown = (True, *(each.shown for each in study.pinned))
    lines = [line for line, is_shown in zip(every, shown, strict=True) if line is not None and is_shown]
    if not lines:
        raise ValueError("there is no solution of any design to report: solve one first")
    base = every[0 if study.view.base is None else 1 + study.view.base] or lines[0]
    return _TEMPLATES.get_template("report.html").render(
        study=study,
        date=f"{date.day} {date:%B %Y}",
        version=version,
        lines=lines,
        base=base,
        left_out=[each.name for each in shown_designs(study) if each.design not in summaries],
        hidden=[each.name for each in study.pinned if not each.shown],
        kind=f"{SUMMATIONS[study.view.summation]}; {REFERENCES[study.view.reference]}",
        gain_plot=_gain_plot(lines, study.specification),
        difference_plot=_difference_plot(lines, base) if len(lines) > 1 else None,
        force_plot=_force_plot(lines),
        step=next((line.summary.step for line in lines if line.summary.step), None),
        inputs=_inputs(lines, base),
        frequencies=_frequencies(lines),
        bands=_bands(lines, study.specification),
        margins=_margins(lines, study.specification),
        sources=_sources(lines, base, study.source),
        fidelities=" and ".join(sorted({line.summary.solution.fidelity for line in lines})),
        notes=[(line.name, line.summary.solution.notes) for line in lines if line.summary.solution.notes],
        file=study.to_toml(),
        theme=theme,
    )


def _lines(study, summaries):
    """Return the design at hand and every pinned one, as :func:`_line` does."""
    at_hand = _line(study, THIS_DESIGN, study.design, (theme.THIS_DESIGN, ()), summaries)
    colours = distinct_colours(each.colour for each in study.pinned)
    looks = ((theme.DESIGN_COLOURS[colour], theme.DESIGN_DASHES[colour]) for colour in colours)
    pinned = zip(study.pinned, looks, strict=True)
    return [at_hand, *(_line(study, each.name, each.design, look, summaries) for each, look in pinned)]


def _line(study, name, design, look, summaries):
    """Return a design with its colour and dash, or None if it has not been solved."""
    summary = summaries.get(design)
    if summary is None:
        return None
    solution, view = summary.solution, study.view
    levels = tig.insertion_gain(
        solution.spectrum,
        solution.design,
        solution.natural_frequencies.loaded_track,
        reference=view.reference,
        summation=view.summation,
    ).levels
    return Line(
        name=name,
        colour=look[0],
        dash=look[1],
        summary=summary,
        levels=levels,
        verdict=study.specification.check(levels) if study.specification else None,
    )


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


def _curve(axes, x, y, line, **kind):
    dash = {"dashes": line.dash} if line.dash else {}
    axes.plot(x, y, color=line.colour, linewidth=2, **dash, **kind)


def _gain_plot(lines, specification):
    with _DRAWING:
        figure, axes = _band_plot(3.5, "Insertion gain, dB")
        for line in reversed(lines):
            _curve(axes, tig.BAND_CENTRES, line.levels, line, marker="o", markersize=3.5)
        seen = np.concatenate([line.levels for line in lines])
        if specification is not None:
            limits = specification.levels
            seen = np.concatenate([seen, limits[np.isfinite(limits)]])
            _draw_limits(axes, limits, seen.max() + LEVEL_ROOM)
            _mark_failing(axes, lines)
        axes.set_ylim(seen.min() - LEVEL_ROOM, seen.max() + LEVEL_ROOM)
        return _svg(figure, "gain")


def _draw_limits(axes, limits, top):
    """Draw the limit as steps, edge to edge, what lies above it shaded."""
    axes.stairs(
        limits, tig.BAND_EDGES, baseline=top, fill=True, color=theme.SPECIFICATION, alpha=0.07, linewidth=0
    )
    axes.stairs(limits, tig.BAND_EDGES, baseline=None, color=theme.SPECIFICATION, linewidth=2.2)


def _mark_failing(axes, lines):
    for line in lines:
        fails = line.verdict.fails
        axes.plot(
            tig.BAND_CENTRES[fails],
            line.levels[fails],
            linestyle="none",
            marker="X",
            markersize=9,
            color=line.colour,
            markeredgecolor=theme.LIGHT_PAPER,
            zorder=5,
        )
    for band in np.flatnonzero(np.any([line.verdict.fails for line in lines], axis=0)):
        axes.axvspan(
            *tig.BAND_EDGES[band : band + 2], color=theme.REPORT_BAD, alpha=0.07, linewidth=0, zorder=0
        )


def _difference_plot(lines, base):
    with _DRAWING:
        figure, axes = _band_plot(2.5, "Difference, dB")
        differences = [line.levels - base.levels for line in lines]
        for line, difference in zip(reversed(lines), reversed(differences), strict=True):
            _curve(axes, tig.BAND_CENTRES, difference, line, marker="o", markersize=3)
        reach = max(LEAST_DIFFERENCES, np.abs(differences).max()) + LEVEL_ROOM / 2
        axes.set_ylim(-reach, reach)
        return _svg(figure, "difference")


def _force_plot(lines):
    """Return the force over time of all designs that were stepped in time, or None."""
    stepped = [line for line in lines if line.summary.time is not None]
    if not stepped:
        return None
    with _DRAWING:
        figure, axes = _plot(2.6)
        for line in reversed(stepped):
            summary = line.summary
            shown = (TIME_AXIS[0] <= summary.time) & (summary.time <= TIME_AXIS[1])
            _curve(axes, 1000 * summary.time[shown], summary.total_force[shown], line)
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


def _inputs(lines, base):
    """Return rows of (name, unit, cells), a cell being (text, whether it differs from the base)."""
    return [
        (
            name,
            unit,
            [
                (_input(line.design, field), getattr(line.design, field) != getattr(base.design, field))
                for line in lines
            ],
        )
        for field, name, unit in ROWS
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
    return formats.quantity_text(to_display(field, value))


def _has_own_loss(design, field):
    part = field.removesuffix("_loss_factor")
    return part != field and isinstance(getattr(design, f"{part}_stiffness"), tig.StiffnessCurve)


def _frequencies(lines):
    """Return rows of (name, cells)."""
    return [
        (name, [_hertz(take(line.summary.solution.natural_frequencies)) for line in lines])
        for name, take in FREQUENCIES
    ]


def _hertz(value):
    if value is None:
        return "–"
    values = value if isinstance(value, tuple) else (value,)
    return " and ".join(formats.frequency_text(each).removesuffix(" Hz") for each in values)


def _bands(lines, specification):
    """Return rows of (label, limit, cells), a cell being (text, whether it exceeds the limit)."""
    limits = np.full(tig.BAND_CENTRES.size, np.nan) if specification is None else specification.levels
    return [
        (
            label,
            formats.signed_text(limits[band]) if np.isfinite(limits[band]) else "",
            [
                (formats.signed_text(line.levels[band]), bool(line.verdict and line.verdict.fails[band]))
                for line in lines
            ],
        )
        for band, label in enumerate(tig.BAND_LABELS)
    ]


def _margins(lines, specification):
    """Return rows of (label, cells) for the bands that are specified, a cell as in the table of bands."""
    if specification is None:
        return []
    return [
        (
            label,
            [
                (formats.signed_text(line.verdict.margins[band]), bool(line.verdict.fails[band]))
                for line in lines
            ],
        )
        for band, label in enumerate(tig.BAND_LABELS)
        if np.isfinite(specification.levels[band])
    ]


def _sources(lines, base, source):
    """Return rows of (line or None, four texts); the first is the reference track."""
    if source is None:
        return []
    reference = source.with_track(np.zeros(tig.BAND_CENTRES.size))
    against = source.with_track(base.levels)
    levels = [(None, reference), *((line, source.with_track(line.levels)) for line in lines)]
    return [
        (
            line,
            [
                formats.plain_text(level.unweighted),
                formats.plain_text(level.a_weighted),
                *map(formats.signed_text, level.relative_to(against)),
            ],
        )
        for line, level in levels
    ]
