"""What the report shows of an answer: tables, and a plot where one says more.

Made when an answer is kept, so that a session need not hold thousands of designs until somebody prints it.
Units are those of the sliders. Plots hold no text of the user's.
"""

from dataclasses import dataclass

import numpy as np
from markupsafe import Markup

import trackig_core as tig
from dashboard import formats, theme
from dashboard.compute.feasibility import where
from dashboard.fields import ASKED_FIELDS
from dashboard.report import plots
from dashboard.session.answers import (
    BETTER,
    FIGURE_WORDS,
    field_label,
    scale_title,
    with_unit,
)
from trackig_core.decide.questions import digest
from trackig_core.decide.versions import versions

MOST_ROWS = 24
"""Designs of a front that are listed [-]: what fits on a page; the CSV has all."""

MAP_LEVELS = 12
"""Colours of a map [-]."""


@dataclass(frozen=True)
class AnswerTable:
    """A table of texts.

    Attributes
    ----------
    heads : tuple of str
        Its header.
    rows : tuple of tuple of str
        Its rows, what they are about first.
    """

    heads: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]


@dataclass(frozen=True)
class AnswerPage:
    """What is shown of an answer.

    Attributes
    ----------
    tables : tuple of AnswerTable
        Tables.
    plot : markupsafe.Markup or None
        A drawing (SVG).
    remarks : tuple of str
        What belongs to them.
    """

    tables: tuple[AnswerTable, ...] = ()
    plot: Markup | None = None
    remarks: tuple[str, ...] = ()


def answer_page(answer, result):
    """Return what the report shows of an answer.

    Parameters
    ----------
    answer : trackig_core.decide.Answer
        What was asked, and what came out.
    result : object
        What came out.

    Returns
    -------
    AnswerPage
        Tables and a plot.
    """
    return PAGES[answer.question.kind](answer, result)


def page_again(answer, result):
    """Return what the report shows of an answer to a question that was asked again.

    Parameters
    ----------
    answer : trackig_core.decide.Answer
        The answer as it was kept.
    result : object
        What comes out now.

    Returns
    -------
    AnswerPage or str
        Tables and a plot; where other figures came out, words that say so, and what the answer is now.
    """
    if digest(result) == answer.digest:
        return answer_page(answer, result)
    changed = [
        f"{name} {was}, now {versions().get(name, 'none')}"
        for name, was in answer.versions.items()
        if versions().get(name) != was
    ]
    because = f": it was computed with {'; '.join(changed)}" if changed else " on this machine"
    return f"Other figures came out{because}. The answer is now: {result}"


def _range(_, result):
    rows = tuple(
        (ASKED_FIELDS[name].marked, with_unit(name, result.design.value(name)), where(result, name))
        for name in result
        if name in ASKED_FIELDS
    )
    return AnswerPage((AnswerTable(("All others held", "as asked", "complies"), rows),))


def _sensitivity(_, result):
    names = tuple(result.figures)
    heads = ("Field", *(FIGURE_WORDS[name][0] for name in names))
    rows = tuple(
        (
            f"{field_label(field)} ∓ {100 * result.changes[field]:.3g} %",
            *(_less_and_more(result, name, row) for name in names),
        )
        for row, field in enumerate(result.fields)
    )
    return AnswerPage(
        (AnswerTable(heads, rows),), remarks=("Change of each figure: with less of the field / with more.",)
    )


def _less_and_more(result, name, row):
    less, more = (formats.change_text(FIGURE_WORDS[name][1] * each) for each in result.differences[name][row])
    return f"{less} / {more}"


def _sobol(_, result):
    heads = ("Of the variance of", *map(field_label, result.factors))
    rows = tuple(
        (
            FIGURE_WORDS[figure][0].partition(",")[0],
            *(share_text(result.total_order[row, column]) for column in range(len(result.factors))),
        )
        for row, figure in enumerate(result.figures)
    )
    return AnswerPage(
        (AnswerTable(heads, rows),), remarks=("Total-order Sobol indices, interactions included.",)
    )


def share_text(share):
    """Return a part of a variance in per cent; of what does not vary there is none."""
    return "–" if np.isnan(share) else f"{100 * max(share, 0.0):.0f} %"


def _tolerance(answer, result):
    specification = answer.question.specification
    low, median, high = map(formats.signed_text, result.margin_percentiles)
    rows = tuple(
        (ASKED_FIELDS[name].marked if name in ASKED_FIELDS else name, f"{100 * share:.1f} %")
        for name, share in result.tightened.items()
    )
    worst = (
        f"Governing margin of 5, 50 and 95 % of production: {low}, {median} and {high} dB; "
        f"of the worst corner {formats.signed_text(result.worst_margin)} dB."
    )
    with plots.DRAWING:
        figure, axes = plots.blank(3.2)
        plots.dress_bands(axes, "Insertion gain, dB")
        least, middle, most = result.percentiles
        axes.fill_between(
            tig.BAND_CENTRES, least, most, color=theme.THIS_DESIGN, alpha=theme.FILL_ALPHA, linewidth=0
        )
        axes.plot(tig.BAND_CENTRES, middle, color=theme.THIS_DESIGN, linewidth=2)
        axes.stairs(
            specification.levels, tig.BAND_EDGES, baseline=None, color=theme.SPECIFICATION, linewidth=2.2
        )
        drawing = plots.svg(figure, _name(answer))
    words = "Median of production, and the range from 5 to 95 % of it, band by band, with the limit."
    return AnswerPage((AnswerTable(("With half the scatter of", "complies"), rows),), drawing, (words, worst))


def _name(answer):
    """Return what identifiers within a drawing begin with: a report may have several of a kind."""
    return f"answer-{answer.digest[:8]}"


def _map(answer, result):
    name, values = next(iter(result.figures.items()))
    words, scale = figure_words(name)
    x_field, y_field = ASKED_FIELDS[result.x_field], ASKED_FIELDS[result.y_field]
    with plots.DRAWING:
        figure, axes = plots.blank(4.2)
        # areas between levels: an image would be fetched from outside the drawing, which the file forbids
        x, y = result.x / x_field.factor, result.y / y_field.factor
        colours = "viridis_r" if BETTER.get(name) == "low" else "viridis"
        areas = axes.contourf(x, y, values * scale, levels=MAP_LEVELS, cmap=colours)
        figure.colorbar(areas, ax=axes, label=scale_title(name, words))
        if result.complies is not None and "margin" in result.figures:
            axes.contour(
                x, y, result.figures["margin"], levels=[0.0], colors=[theme.SPECIFICATION], linewidths=2.2
            )
        axes.set_xscale("log" if x_field.logarithmic else "linear")
        axes.set_yscale("log" if y_field.logarithmic else "linear")
        axes.set_xlabel(x_field.labelled)
        axes.set_ylabel(y_field.labelled)
        place = [result.design.value(each.name) / each.factor for each in (x_field, y_field)]
        axes.plot(*place, "o", color=theme.THIS_DESIGN, markeredgecolor=theme.LIGHT_PAPER, markersize=9)
        drawing = plots.svg(figure, _name(answer))
    remark = "Dot: the design that was asked about."
    if result.complies is not None:
        remark += " Line: designs that just comply."
    return AnswerPage((), drawing, (remark,))


def figure_words(name):
    """Return what a figure is called, with the unit that is shown, and what turns SI into it."""
    if name in ASKED_FIELDS:
        return ASKED_FIELDS[name].labelled, 1 / ASKED_FIELDS[name].factor
    return FIGURE_WORDS.get(name, (f"Insertion gain at {name} Hz, dB", 1.0))


def _find(_, result):
    fields = [name for name in ASKED_FIELDS if _numbers_vary(result, name)]
    objectives = [name for name in result.objectives if name not in fields]
    with_rail = "rail" not in result.chosen and _varies(result, "rail")
    with_deflection = "deflection" not in objectives
    heads = (
        *(ASKED_FIELDS[name].labelled for name in fields),
        *(["Rail"] if with_rail else []),
        *(kind.capitalize() for kind in result.chosen),
        *(figure_words(name)[0] for name in objectives),
        *([FIGURE_WORDS["deflection"][0]] if with_deflection else []),
    )
    best = result.front[:: max(1, -(-result.front.size // MOST_ROWS))]
    rows = []
    for place in best if best.size else [result.closest]:
        design = result.many.design(int(place))
        cells = [
            formats.quantity_text(float(f"{design.value(n) / ASKED_FIELDS[n].factor:.4g}")) for n in fields
        ]
        cells += [design.rail.name] if with_rail else []
        cells += [names[place] for names in result.chosen.values()]
        for name in objectives:
            value = result.values[place, result.objectives.index(name)] * figure_words(name)[1]
            cells.append(f"{value:.2f}")
        cells += [f"{1e3 * result.deflections[place]:.2f}"] if with_deflection else []
        rows.append(tuple(cells))
    words = "Designs of the front" if best.size else "No design complies; this one comes closest"
    listed = f"{words}, {len(rows)} of {max(result.front.size, 1)}. Seed {result.seed}."
    remarks = (listed, *filter(None, (result.explained, result.unlimited)))
    return AnswerPage((AnswerTable(heads, tuple(rows)),), remarks=remarks)


def _numbers_vary(result, name):
    """Return whether a field has several values, none of which is missing or measured over frequency."""
    column = result.many.column(name)
    return column.dtype == float and bool(column.min() < column.max())


def _varies(result, name):
    column = result.many.column(name)
    return any(each != column.flat[0] for each in column.flat)


PAGES = {
    "range": _range,
    "sensitivity": _sensitivity,
    "sobol": _sobol,
    "tolerance": _tolerance,
    "map": _map,
    "find": _find,
}
"""What makes the page of each kind of answer."""
