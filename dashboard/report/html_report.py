"""A report of a study: one HTML file that needs nothing else, asks for nothing and prints on A4.

Plots are vector drawings within the file. Units are those of the trade: kN/mm, kg, m, Hz, dB. Names come
from files and links, so the template escapes whatever it shows, plots hold no text of the user's, and the
file forbids scripts and requests to whoever opens it. A report never solves: a design without a solution is
named as left out.
"""

from dataclasses import dataclass, fields, replace

import jinja2
import numpy as np

import trackig_core as tig
from dashboard import formats, theme
from dashboard.fields import EVERY_FIELD, EXTRA_FIELDS, LOAD
from dashboard.report import plots
from dashboard.session import surroundings
from dashboard.session.answers import question_lines
from dashboard.session.bands import bands_text, gain_in
from dashboard.session.pins import current_design, distinct_colours, shown_designs
from dashboard.session.results import DesignResult
from dashboard.session.special import input_text
from trackig_core.levels.insertion_gain import reference_for
from trackig_core.names import LONGEST_TITLE, allowed, brief, is_name

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

TEMPLATES = jinja2.Environment(
    loader=jinja2.PackageLoader("dashboard.report", "templates"),
    autoescape=True,
    undefined=jinja2.StrictUndefined,
    trim_blocks=True,
    lstrip_blocks=True,
)
"""Templates of what is printed; whatever they show is escaped."""


@dataclass(frozen=True)
class Particulars:
    """Whose report it is; what is empty is left out.

    Parameters
    ----------
    project, client, author : str
        Names, which the report's header shows.

    Raises
    ------
    ValueError
        If one is neither empty nor a name.
    """

    project: str = ""
    client: str = ""
    author: str = ""

    def __post_init__(self):
        """Check every name once."""
        for name, value in self.given:
            if not is_name(value, LONGEST_TITLE):
                raise ValueError(f"{name.lower()} = {brief(value)}: give {allowed(LONGEST_TITLE)}")

    @property
    def given(self):
        """What each is called that is not empty, and what it is (list of (str, str))."""
        values = ((each.name.capitalize(), getattr(self, each.name)) for each in fields(self))
        return [(name, value) for name, value in values if value != ""]


def html_report(study, summaries, *, date, version, pages=None, left_out=None, particulars=None):
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
    pages : mapping of str to (AnswerPage or str), optional
        What is shown of the study's answers by their digests, or why there is nothing; of others there are
        words alone.
    left_out : dashboard.teaching.left_out.LeftOut, optional
        What the simplified model leaves out of the current design, where that was asked for.
    particulars : Particulars, optional
        Project, client and author.

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
    limits = in_force(study)
    return TEMPLATES.get_template("report.html").render(
        study=study,
        particulars=[] if particulars is None else particulars.given,
        date=f"{date.day} {date:%B %Y}",
        version=version,
        results=results,
        base=base,
        limits=limits,
        left_out=[each.name for each in shown_designs(study) if each.design not in summaries],
        hidden=[each.name for each in study.pinned if not each.shown],
        kind=formats.definition_text(study.view.summation, study.view.reference),
        band_words=bands_text(study.view.bands),
        measured=study.measured if results[0].shown_gain.bands.tenths == 1 else (),
        yielding=[
            each.name
            for each in results
            if reference_for(each.design, study.view.reference) != study.view.reference
        ],
        beyond_measured=formats.extrapolated_text(results[0].name),
        gain_plot=plots.gain_svg(results, limits, measured=study.measured),
        difference_plot=plots.difference_svg(results, base) if len(results) > 1 else None,
        force_plot=plots.force_svg(results),
        beyond=_beyond(results),
        surroundings=_surroundings(results),
        step=next((each.summary.step for each in results if each.summary.step), None),
        inputs=_inputs(results, base),
        frequencies=_frequencies(results),
        wheels=formats.wheels_text(study.load),
        statics=_statics(results),
        bounds=_bounds(results),
        bands=_bands(results, limits, study.measured),
        margins=_margins(results, limits),
        sources=_sources(results, base, study.source),
        fidelities=formats.fidelities_text(each.summary.solution.fidelity for each in results),
        notes=[(each.name, each.summary.solution.notes) for each in results if each.summary.solution.notes],
        answers=[_answer(results, each, (pages or {}).get(each.digest)) for each in study.answers],
        ladder=None if left_out is None else _ladder(left_out, every[0].name),
        file=study.to_toml(),
        theme=theme,
    )


def _answer(results, answer, page):
    """Return an answer, its title, what was asked and of which design, a line of words each, and its page."""
    title, lines = question_lines(answer)
    names = [each.name for each in results if each.design == answer.question.design]
    whose = f"About “{names[0]}”." if names else "About a design that is none of this report."
    return answer, title, [whose, *lines], page


def in_force(study):
    """Return the specification by which designs are judged; None without one, or while it asks something."""
    return None if study.specification is None else study.specification.in_force


def _ladder(left_out, name):
    """Return what the report says of a design's ladder."""
    ladder = left_out.ladder
    rungs = (*ladder.rungs, ladder.one_dimensional)
    columns = [ladder.rungs[0].insertion_gain, *(rung.difference for rung in rungs[1:])]
    cells = [list(map(formats.signed_text, levels)) for levels in zip(*columns, strict=True)]
    return {
        "design": name,
        "rungs": rungs,
        "bands": list(zip(tig.BAND_LABELS, cells, strict=True)),
        "words": left_out.words,
    }


def _beyond(results):
    """Return which forces are cut off at the axis, and how far they reach (list of str)."""
    stepped = plots.stepped_in_time(results)
    return [
        each.name + words
        for each, words in zip(stepped, plots.beyond_texts(stepped) if stepped else (), strict=True)
        if words
    ]


def _surroundings(results):
    """Return what stands on and under the designs, as (words, names of those); no names: of all of them."""
    names = {}
    for each in results:
        names.setdefault(surroundings.sentence(each.design), []).append(each.name)
    return [(words, of if len(names) > 1 else ()) for words, of in names.items()]


def _results(study, summaries):
    """Return the current design and every pinned one, with what is known of each (DesignResult)."""
    colours = distinct_colours(each.colour for each in study.pinned)
    pinned = (replace(each, colour=own) for each, own in zip(study.pinned, colours, strict=True))
    records = (current_design(study.design), *pinned)
    return [_result(study, record, summaries.get(record.design)) for record in records]


def _result(study, record, summary):
    if summary is None:
        return DesignResult(record)
    reference = reference_for(record.design, study.view.reference)
    gain = summary.solution.gain_for(reference, study.view.summation)
    limits = in_force(study)
    deflection = tig.analysis.limited_deflection(limits, record.design)
    verdict = None if limits is None else limits.check(gain.levels, deflection)
    level = None if study.source is None else study.source.with_track(gain.levels)
    shown = gain_in(study.view.bands, summary.solution, reference, study.view.summation)
    return DesignResult(record, summary, gain, verdict, level, study.load.response(record.design), shown)


def _inputs(results, base):
    """Return rows of (name, unit, cells), a cell being (text, whether it differs from the base)."""
    rows = [row for row in INPUT_ROWS if any(is_told(each.design, row[0]) for each in results)]
    return [
        (
            label,
            unit,
            [
                (input_text(each.design, name), getattr(each.design, name) != getattr(base.design, name))
                for each in results
            ],
        )
        for name, label, unit in rows
    ]


INPUT_ROWS = (
    ("rail", "Rail", ""),
    *((name, field.label, field.unit) for name, field in EVERY_FIELD.items() if name not in LOAD),
    *((name, label, "") for name, label in surroundings.LABELS.items()),
)
"""Attribute, label and unit of each input of a design."""


def is_told(design, name):
    """Return whether an input of a design is reported: an extra one only where it is set."""
    if name in surroundings.OFF:
        return getattr(design, name) != surroundings.OFF[name]
    if name not in EXTRA_FIELDS:
        return True
    field = EXTRA_FIELDS[name]
    return getattr(design, name) != field.to_si(field.default)


STATIC_ROWS = (
    ("Rail deflection, over a support", formats.deflection_text),
    ("at the worst place", lambda statics: formats.millimetre_text(statics.largest_rail_deflection)),
    ("Seat load", lambda statics: formats.load_text(statics.largest_seat_load)),
    ("Compression of the pad", lambda statics: formats.millimetre_text(statics.pad_compression)),
    ("Compression of the boot", lambda statics: _length_text(statics.boot_compression)),
    ("Uplift", lambda statics: formats.millimetre_text(statics.largest_uplift)),
)
"""Name of each row of the table of statics, and what stands in it."""


def _statics(results):
    """Return rows of (name, cells)."""
    return [(name, [take(each.statics) for each in results]) for name, take in STATIC_ROWS]


def _length_text(length):
    return "–" if length is None else formats.millimetre_text(length)


def _bounds(results):
    """Return why deflections are lower bounds, a sentence a design (list of str)."""
    return [
        f"{each.name}: {formats.unstated_text(each.statics)}" for each in results if each.statics.at_least
    ]


def _frequencies(results):
    """Return rows of (name, cells)."""
    return [
        (name, [hertz_text(take(each.summary.solution.natural_frequencies)) for each in results])
        for name, take in FREQUENCIES
    ]


def hertz_text(value):
    """Return natural frequencies [Hz], one, several or None, as the report shows them."""
    if value is None:
        return "–"
    values = value if isinstance(value, tuple) else (value,)
    return " and ".join(formats.frequency_text(each).removesuffix(" Hz") for each in values)


def _bands(results, specification, measured=()):
    """Return rows of (label, limit, cells, measured cells) over the bands that are shown.

    A cell is (text, whether it exceeds the limit). Limits and measured levels are of one-third octaves, and
    stand in no row of an octave.
    """
    bands = results[0].shown_gain.bands
    place = dict(zip(tig.BAND_LABELS, range(len(tig.BAND_LABELS)), strict=True)) if bands.tenths == 1 else {}

    def cell(levels, band):
        return level_text(np.nan if band is None or levels is None else levels[band])

    limits = None if specification is None else specification.levels
    rows = []
    for number, label in enumerate(bands.labels):
        band = place.get(label)
        cells = [
            (
                level_text(each.shown_gain.levels[number]),
                band is not None and bool(each.verdict and each.verdict.fails[band]),
            )
            for each in results
        ]
        rows.append((label, cell(limits, band), cells, [cell(each.levels, band) for each in measured]))
    return rows


def level_text(level):
    """Return a level [dB] for a column of a table, empty where there is none."""
    return formats.signed_text(level) if np.isfinite(level) else ""


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
