"""A data sheet of one design: one page of A4 as an HTML file that needs nothing else and asks for nothing.

It holds what the report says of a design: verdict, insertion gain as plot and table, inputs, natural
frequencies, definition and version. The template escapes whatever it shows.
"""

import numpy as np

import trackig_core as tig
from dashboard import formats, theme
from dashboard.report import plots
from dashboard.report.html_report import (
    FREQUENCIES,
    INPUT_ROWS,
    TEMPLATES,
    hertz_text,
    is_told,
    level_text,
)
from dashboard.session.special import input_text
from trackig_core.bands import ONE_THIRD_OCTAVES

PLOT_HEIGHT, LEAST_PLOT_HEIGHT = 2.9, 2.0
"""Height of the plot of a design with few inputs, and at least [inch]."""

FEW_INPUTS, FEW_BAND_ROWS = 9, 4
"""Rows of inputs and of the table of bands with which the plot has its full height [-]."""

ROW_HEIGHT = 0.07
"""By how much every further row lowers the plot [inch]."""

MOST_COLUMNS = 21
"""Bands side by side in a table [-]; more go into two tables."""


def data_sheet(result, heading, specification=None, source=None, measured=()):
    """Return the data sheet of a design.

    Parameters
    ----------
    result : DesignResult
        The design, solved.
    heading : Heading
        What the sheet says of itself.
    specification : trackig_core.Specification, optional
        What the design has to meet; its verdict is that of the result.
    source : trackig_core.SourceSpectrum, optional
        Where the result's level comes from.
    measured : sequence of trackig_core.levels.MeasuredGain
        Curves from elsewhere that are drawn with the design's.

    Returns
    -------
    str
        An HTML file that prints on one page.
    """
    natural, level = result.summary.solution.natural_frequencies, result.level
    limits = None if specification is None else specification.in_force
    inputs, bands = _inputs(result.design), _bands(result, limits, measured)
    tables = _broken(bands)
    reference = None if source is None else source.with_track(np.zeros(tig.BAND_CENTRES.size))
    return TEMPLATES.get_template("data_sheet.html").render(
        theme=theme,
        heading=heading,
        result=result,
        specification=specification,
        limits=limits,
        plot=plots.gain_svg([result], limits, _plot_height(inputs, tables), measured),
        measured=measured,
        beyond_measured=formats.extrapolated_text(heading.design),
        limited=_is_limited(result, limits),
        tables=tables,
        longest_cell=max(len(text) for _, cells in bands for text, _ in cells),
        inputs=inputs,
        dense=len(inputs) > FEW_INPUTS,
        frequencies=[
            (name, hertz_text(take(natural))) for name, take in FREQUENCIES if take(natural) is not None
        ],
        wheels=formats.wheels_text(result.statics),
        deflection=formats.deflection_text(result.statics),
        seat=formats.load_text(result.statics.largest_seat_load),
        bound=formats.unstated_text(result.statics),
        source=source,
        reference=None if reference is None else _level_text(reference),
        level=None if level is None else _level_text(level),
        notes=result.summary.solution.notes,
    )


def _plot_height(inputs, tables):
    """Return the height of the plot [inch] that leaves room for all rows on the page."""
    rows = max(0, len(inputs) - FEW_INPUTS) + max(0, sum(map(len, tables)) - FEW_BAND_ROWS)
    return max(LEAST_PLOT_HEIGHT, PLOT_HEIGHT - ROW_HEIGHT * rows)


def _broken(rows):
    """Return rows of (name, cells) as tables of the page's width, of about as many columns each."""
    count = len(rows[0][1])
    width = -(-count // -(-count // MOST_COLUMNS))
    return [
        [(name, cells[first : first + width]) for name, cells in rows] for first in range(0, count, width)
    ]


def _bands(result, specification, measured):
    """Return rows of (name, cells) over the bands, a cell being (text, whether it exceeds the limit).

    Rows of limit and margin are there only in the paper's bands, for which they are given, and rows of
    measured levels only in one-third octaves.
    """
    verdict, gain = result.verdict, result.shown_gain
    limited = _is_limited(result, specification)
    fails = verdict.fails if limited else np.zeros(gain.levels.size, bool)
    rows = [
        ("Band, Hz", [(label, False) for label in gain.bands.labels]),
        ("Gain", _cells(gain.levels, fails)),
    ]
    if limited:
        rows += [
            ("Limit", _cells(specification.levels, np.zeros_like(fails))),
            ("Margin", _cells(verdict.margins, fails)),
        ]
    if gain.bands.tenths == 1:
        for number, curve in enumerate(measured, start=1):
            levels = dict(zip(tig.BAND_LABELS, curve.levels, strict=True))
            cells = [(level_text(levels.get(label, np.nan)), False) for label in gain.bands.labels]
            rows.append((f"Meas. {number}", cells))
    return rows


def _is_limited(result, specification):
    """Return whether limits are given for the bands that are shown."""
    return specification is not None and result.shown_gain.bands == ONE_THIRD_OCTAVES


def _cells(levels, fails):
    """Return cells for levels [dB], empty where there is none."""
    return list(zip(map(level_text, levels), map(bool, fails), strict=True))


def _inputs(design):
    """Return rows of (name, unit, text); a single-stage track has no rows for what it lacks."""
    rows = [
        (label, unit, input_text(design, name)) for name, label, unit in INPUT_ROWS if is_told(design, name)
    ]
    return [row for row in rows if row[2] != "–"]


def _level_text(level):
    return f"{formats.plain_text(level.unweighted)} dB, {formats.plain_text(level.a_weighted)} dB(A)"
