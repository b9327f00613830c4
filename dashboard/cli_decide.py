"""Commands that choose between designs: range, sensitivity, tolerance, map and find.

They ask ``trackig_core.decide`` about the current design of a study, or a pinned one, and print a table and a
sentence to standard output. Numbers are taken with a unit, or in SI. How far they are goes to standard error.
Ctrl+C ends them; a search then leaves the best so far.

Exit codes are those of :mod:`dashboard.cli`: 1 when nothing complies.
"""

import argparse
import csv
import dataclasses
import datetime
import io
import json
import re
import signal
import sys
import threading
import time
from collections.abc import Callable
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import trackig_core as tig
from dashboard.cli_numbers import field_cost, field_number, field_range, read_share
from dashboard.fields import ASKED_FIELDS
from dashboard.session.heading import Heading, current_name
from trackig_core.levels.insertion_gain import reference_for
from trackig_core.levels.specification import not_judged_text
from trackig_core.names import brief
from trackig_core.solver import FIDELITIES
from trackig_core.study.catalogue import KINDS
from trackig_core.track.fields import RANGES, SEARCHED_RANGES
from trackig_core.typed_numbers import NumberError, find_unit, read_number

FAILED, STOPPED = 1, 130
"""Exit codes: nothing complies; the user pressed Ctrl+C."""

STANDARD_OUTPUT = Path("-")
"""What stands for standard output where a file is written."""

SAMPLES = 10_000
"""Samples that are drawn into a folder unless a number is given [-]."""

MOST_BYTES = 10_000_000
"""Size that a table of specimens or products may have [bytes]."""


SELDOM = 10.0
"""Time between two lines on how far it is, in a file or for another program [s]."""


class DecideError(ValueError):
    """A question cannot be asked."""


@dataclass(frozen=True)
class Shell:
    """What the commands need of the command line.

    Attributes
    ----------
    add : callable
        Adds a command: (commands, name, run, help=...).
    add_study : callable
        Adds to a command what it is about: (command).
    open_study : callable
        From the options of a command to the study that it is about.
    refuse_to_lose : callable
        Refuses to write over a file: (path, force, file that is read).
    write : callable
        Writes text to a path.
    """

    add: Callable
    add_study: Callable
    open_study: Callable
    refuse_to_lose: Callable
    write: Callable


def add_commands(commands, shell):
    """Add the commands to those of the command line.

    Parameters
    ----------
    commands : argparse._SubParsersAction
        Where commands are added.
    shell : Shell
        What they need of the command line.
    """
    for add in (_add_range, _add_sensitivity, _add_tolerance, _add_map, _add_find):
        add(partial(_command, commands, shell))


CURVES = "Answers are of exact curves; the verdict of check, on the paper's run, may differ by some 0.1 dB."


def _command(commands, shell, name, kind_of=None, **words):
    """Add a command that asks a question of its name, or of the kind that its options make it."""
    kind_of = kind_of or (lambda _: name)
    words["epilog"] = "\n\n".join([CURVES, *([words["epilog"]] if "epilog" in words else [])])
    command = shell.add(commands, name, lambda options: _run(shell, kind_of(options), options), **words)
    shell.add_study(command)
    command.add_argument("--design", metavar="NAME", help="a pinned design, in place of the current one")
    command.add_argument(
        "--max-deflection",
        type=_deflection,
        metavar="LENGTH",
        help="greatest rail deflection, such as 2mm, in place of the specification's own; in m unless said",
    )
    command.add_argument(
        "--scheduler", metavar="ADDRESS", help="solve on a Dask cluster, such as tcp://10.0.0.5:8786"
    )
    command.add_argument(
        "--csv", type=Path, metavar="FILE", help="write all figures as CSV, in SI, to six figures"
    )
    command.add_argument("--json", type=Path, metavar="FILE", help="write question and answer as JSON, in SI")
    command.add_argument("--force", action="store_true", help="write over files that exist")
    return command


class _ByField(argparse.Action):
    """Keeps what options of the form FIELD=VALUE give, by field."""

    def __call__(self, parser, options, values, option_string=None):  # noqa: ARG002
        """Note a pair of field and value."""
        field, value = values
        setattr(options, self.dest, {**(getattr(options, self.dest) or {}), field: value})


def _add_repeated(command, option, action="append", **words):
    """Add an option that may be given again."""
    words["help"] += "; may be given again"
    command.add_argument(option, action=action, **words)


def _fields_help():
    """Return the fields about which is asked, with the ranges that are searched of each."""
    lines = ["fields, and the range that is searched of each unless another is given:"]
    lines += [
        f"  {name:31}{field.low:g} to {field.high:g} {field.unit}".rstrip()
        for name, field in ASKED_FIELDS.items()
        if name in SEARCHED_RANGES
    ]
    lines.append("(of suspension and ground, if the design has them; of speed, if it has several axles)")
    return "\n".join(lines)


FIELD_HELP = "this field, such as boot_stiffness; of vehicle and site, such as wheel_mass, only when named"


def _add_range(add):
    command = add(
        "range",
        help="Print where the design complies along each field, all others held.",
        epilog=_fields_help(),
    )
    _add_repeated(command, "--field", dest="fields", metavar="FIELD", help=FIELD_HELP)
    _add_ranges(command)


def _add_sensitivity(add):
    command = add(
        "sensitivity",
        lambda options: "sobol" if options.tolerances or options.production else "sensitivity",
        help="Print what changes when each field does, or with tolerances, Sobol indices over these.",
    )
    command.add_argument(
        "--change",
        type=_share,
        dest="changes",
        metavar="SHARE",
        help="change of each field, 10%% unless given",
    )
    _add_scatter(command, "base samples, a power of two")
    _add_figures(command)


def _add_tolerance(add):
    command = add(
        "tolerance",
        help="Print how sure the design is to comply when its fields scatter; exit with 1 if it never does.",
    )
    _add_scatter(command, "samples that are drawn, 10000 by default")
    _add_parquet(command)


def _add_map(add):
    command = add(
        "map",
        help="Compute figures over two fields; exit with 1 if no design of the map complies.",
        epilog=f"The figures of all points go to --csv.\n\n{_fields_help()}",
    )
    command.add_argument("x_field", metavar="X_FIELD")
    command.add_argument("y_field", metavar="Y_FIELD")
    _add_figures(command)
    _add_ranges(command)
    command.add_argument(
        "--points", type=_points, metavar="NXxNY", help="points along x and y, 200x200 by default"
    )
    _add_parquet(command)


def _add_find(add):
    command = add(
        "find",
        help="Search for designs that comply, and the best of them; exit with 1 if none does.",
        epilog=_fields_help(),
    )
    _add_repeated(
        command,
        "--free",
        _ByField,
        type=_free,
        metavar="FIELD[=LOW..HIGH]",
        help="a field that is free, over its slider's range unless one is given: boot_stiffness=5..40kN/mm; "
        "in SI without a unit",
    )
    _add_repeated(
        command,
        "--choose",
        type=Path,
        default=[],
        metavar="FILE.csv",
        help="a catalogue: one product a row, fields and cost in columns, headed boot_stiffness [kN/mm]; in "
        "SI where the header names no unit",
    )
    _add_repeated(
        command,
        "--component",
        choices=KINDS,
        default=[],
        dest="components",
        help="choose from the catalogue's components of this kind",
    )
    command.add_argument(
        "--catalogue", type=Path, metavar="FILE.toml", help="that catalogue, in place of the bundled one"
    )
    command.add_argument("--rails", metavar="NAME,NAME", help="rails to choose from, such as 54E1,60E1")
    command.add_argument(
        "--all", action="store_true", help="print all best designs, not only ten of them, spread evenly"
    )
    _add_repeated(
        command,
        "--objective",
        dest="objectives",
        metavar="NAME",
        help="what is sought: margin, deflection, level, cost, or a field",
    )
    _add_repeated(
        command,
        "--cost",
        _ByField,
        type=_cost,
        metavar="FIELD=COST",
        help="cost per unit of a field, for the objective cost: block_mass=2.5/kg, boot_stiffness='0.3 per "
        "kN/mm'; per SI unit where none is named",
    )
    command.add_argument(
        "--population", type=int, metavar="N", help="designs of a generation, 100 by default"
    )
    command.add_argument("--generations", type=int, metavar="N", help="generations, 60 by default")
    _add_seed(command)


def _add_ranges(command):
    _add_repeated(
        command,
        "--range",
        _ByField,
        type=_range,
        dest="ranges",
        metavar="FIELD=LOW..HIGH",
        help="range of a field, in place of its slider's: boot_stiffness=5..40kN/mm; in SI without a unit",
    )


def _add_scatter(command, samples):
    """Add what scatters, and how it is drawn; ``samples`` says what their number is."""
    _add_repeated(
        command,
        "--tolerance",
        _ByField,
        type=_tolerance,
        dest="tolerances",
        metavar="FIELD=SHARE",
        help="10%% or 0.1: even within ±10 %%; normal:5%%: bell curve of that standard deviation",
    )
    command.add_argument(
        "--production",
        type=Path,
        metavar="FILE.csv",
        help="measured values, one specimen a row, fields in columns, headed boot_stiffness [kN/mm]; in SI "
        "where the header names no unit",
    )
    command.add_argument("--samples", type=int, metavar="N", help=samples)
    _add_seed(command)


def _add_figures(command):
    _add_repeated(
        command,
        "--figure",
        dest="figures",
        metavar="NAME",
        help="margin, level, deflection, loaded_track, coupled_block or a band, as 63",
    )


def _add_seed(command):
    command.add_argument("--seed", type=int, metavar="N", help="seed, 0 unless given")


def _add_parquet(command):
    command.add_argument(
        "--parquet",
        type=Path,
        metavar="FOLDER",
        help="solve into a folder of Parquet files instead, any number of designs; go on where that ended",
    )
    command.add_argument(
        "--fidelity", choices=FIDELITIES, default="exact", help="with --parquet: exact unless given"
    )


def _settings(study, kind, options):
    """Return the settings of a question that were given: options go by the names of what they set."""
    # slow to load, and no other command needs it
    from trackig_core.decide import questions

    given = {name: getattr(options, name, None) for name in questions.KINDS[kind].settings}
    if given.get("production") is not None:
        given["production"] = _table(options.production)
    if "choices" in given:
        given["choices"] = _choices(study, options)
    return {name: value for name, value in given.items() if value not in (None, {}, [])}


def _run(shell, kind, options):
    outputs = [path for path in (options.csv, options.json) if path is not None]
    if outputs.count(STANDARD_OUTPUT) > 1:
        raise DecideError("--csv - --json -: standard output takes one of them")
    for path in outputs:
        shell.refuse_to_lose(path, options.force, options.study)
    try:
        study = shell.open_study(options)
        return _answer(shell, study, kind, _settings(study, kind, options), options)
    except tig.SolveCancelled:
        return STOPPED
    except (tig.DesignError, tig.StudyError, DecideError):
        raise
    # what the core refuses; its message names what is at fault
    except (ValueError, KeyError, ConnectionError, ImportError) as error:
        raise DecideError(error.args[0]) from error


def _answer(shell, study, kind, settings, options):
    # slow to load, and no other command needs them
    from dashboard.cli_tables import answer_rows
    from dashboard.persistence.exports import answer_csv
    from trackig_core.decide import Answer, Question
    from trackig_core.decide.questions import KINDS as QUESTIONS

    if getattr(options, "parquet", None) is not None:
        return _job(study, kind, settings, options)
    if options.max_deflection is not None:
        settings["max_deflection"] = options.max_deflection
    if study.specification is None and QUESTIONS[kind].needs_specification:
        raise DecideError(
            f"{options.study}: no specification to hold designs against; give --specification FILE.csv"
        )
    design = _design(study, options.design)
    question = Question(
        kind=kind,
        design=design,
        settings=settings,
        specification=study.specification,
        source=study.source,
        reference=reference_for(design, study.view.reference),
        summation=study.view.summation,
    )
    if kind == "find" and _is_unlimited(question):
        sys.stderr.write(f"trackig: {UNLIMITED}\n")
    with watched(options.scheduler) as how:
        result = question.ask(**how)
    table, answer = result.to_dataframe(), Answer.of(question, result)
    if STANDARD_OUTPUT not in (options.csv, options.json):
        rows = answer_rows(result, getattr(options, "all", False))
        sentences = "\n".join(filter(None, _sentences(result, study.specification)))
        sys.stdout.write(f"{rows}\n\n{sentences}\n")
    if options.csv is not None:
        name = current_name(study) if options.design is None else options.design
        heading = Heading.of_question(study, question, name, datetime.date.today())
        shell.write(options.csv, answer_csv(answer, result, heading))
    if options.json is not None:
        shell.write(options.json, _json(answer, table))
    if getattr(result, "stopped", False):
        return STOPPED
    return 0 if _anything_complies(result) else FAILED


def _job(study, kind, settings, options):
    """Solve what a question is about into a folder, part by part."""
    from trackig_core.decide import Grid, Samples, run_job
    from trackig_core.decide.maps import map_axes
    from trackig_core.decide.questions import arguments

    design, given = _design(study, options.design), arguments(settings)
    if kind == "map":
        given.pop("figures", None)
        x, y = map_axes(design, **given)
        designs = Grid(design, {given["y_field"]: y, given["x_field"]: x})
    else:
        size = given.pop("samples", SAMPLES)
        designs = Samples(design, given.pop("tolerances", {}), size, **given)
    view = study.view
    with watched(options.scheduler) as how:
        job = run_job(
            designs,
            options.parquet,
            fidelity=options.fidelity,
            reference=reference_for(design, view.reference),
            summation=view.summation,
            **how,
        )
    sys.stdout.write(f"{job}\n")
    return 0


def _design(study, name):
    """Return the current design of a study, or the pinned one of a name."""
    if name is None:
        return study.design
    for pinned in study.pinned:
        if pinned.name == name:
            return pinned.design
    there = ", ".join(repr(pinned.name) for pinned in study.pinned) or "none"
    raise DecideError(f"--design {name}: there is no such pinned design; pinned are {there}")


def _anything_complies(result):
    """Return whether anything complies, or nothing was held against a specification."""
    from trackig_core import decide

    if isinstance(result, decide.FeasibleRanges):
        return result.complies or any(result.values())
    if isinstance(result, decide.ToleranceResult):
        return result.complying > 0
    if isinstance(result, decide.DesignMap):
        return result.complies is None or bool(result.complies.any())
    return not isinstance(result, decide.FoundDesigns) or result.front.size > 0


UNLIMITED = (
    "no limit of rail deflection is set, and softer always isolates more, so that the search runs to the "
    "softest designs of its ranges; give --max-deflection, or limit it in the specification"
)


def _is_unlimited(question):
    """Return whether nothing limits how far the rail may sink in a search."""
    specification = question.specification
    limited = specification is not None and specification.rail_deflection_limit is not None
    return not limited and "max_deflection" not in question.settings


def _sentences(result, specification):
    """Return what is said of an answer: its sentence, what it means, and limits that are not judged."""
    rest = "" if specification is None else not_judged_text(specification.not_judged)
    return str(result), getattr(result, "explained", ""), rest and f"Limits of the specification: {rest}."


def _json(answer, table):
    question = answer.question
    found = {
        "question": question.kind,
        "settings": dict(question.settings),
        "reference": question.reference,
        "summation": question.summation,
        "sentence": answer.sentence,
        "digest": answer.digest,
        "versions": dict(answer.versions),
        "rows": json.loads(_with_plain_records(table).to_json(orient="records", double_precision=15)),
    }
    return json.dumps(found, indent=2, ensure_ascii=False) + "\n"


def _with_plain_records(table):
    """Return a table whose curves, suspensions and grounds are dicts of their fields."""
    records = {name: values for name, values in table.items() if values.dtype == object}
    return table.assign(
        **{
            name: [dataclasses.asdict(each) if dataclasses.is_dataclass(each) else each for each in values]
            for name, values in records.items()
        }
    )


def pages_of(answers):
    """Return what the report shows of a study's answers, each asked again.

    Parameters
    ----------
    answers : sequence of trackig_core.decide.Answer
        The answers as they were kept.

    Returns
    -------
    dict of str to (AnswerPage or str)
        Tables and plots by digest. Of an answer to which other figures come out, or none, there are words
        that say so, as standard error does.

    Raises
    ------
    trackig_core.SolveCancelled
        If the user pressed Ctrl+C.
    """
    # plots are slow to load
    from dashboard.report.answer_pages import page_again

    pages = {}
    for answer in answers:
        said = f"kept answer {answer.sentence[:60]!r}"
        try:
            with watched(None) as how:
                result = answer.question.ask(**how)
                if how["cancelled"]():  # a search returns what it has found until then
                    raise tig.SolveCancelled("the report was cancelled")
                page = page_again(answer, result)
        except (ValueError, KeyError) as error:
            page = f"It could not be asked again: {error.args[0]}"
        pages[answer.digest] = page
        if isinstance(page, str):
            sys.stderr.write(f"{said}, in the report by its words alone: {page}\n")
    return pages


class _Progress:
    """Tells how far something is: on a screen in one line that is written over, elsewhere seldom.

    Parameters
    ----------
    stream : file
        Where it is told.
    """

    def __init__(self, stream):
        self._stream, self._is_screen = stream, stream.isatty()
        self._shown, self._last = None, time.monotonic()

    def __call__(self, done):
        """Tell how much is done, 0 to 1."""
        text = f"{10 * int(10 * done)} %"
        if text == self._shown:
            return
        if self._is_screen:
            self._stream.write(f"\r{text}")
        elif time.monotonic() - self._last >= SELDOM:
            self._stream.write(f"{text}\n")
        else:
            return
        self._stream.flush()
        self._shown, self._last = text, time.monotonic()

    def end(self):
        """End the line on a screen, so that what follows stands below it."""
        if self._is_screen and self._shown is not None:
            self._stream.write("\n")


@contextmanager
def watched(scheduler):
    """Tell on standard error how far it is, and let Ctrl+C ask it to end; a second Ctrl+C ends it at once."""
    stop = threading.Event()

    def interrupted(_signal, _frame):
        if stop.is_set():
            raise KeyboardInterrupt
        stop.set()

    progress = _Progress(sys.stderr)
    before = signal.signal(signal.SIGINT, interrupted)
    try:
        yield {"progress": progress, "cancelled": stop.is_set, "scheduler": scheduler}
    finally:
        signal.signal(signal.SIGINT, before)
        progress.end()


def _in_argument(read, *given):
    """Return what a reader makes of an option's text; where it makes none, argparse says so."""
    try:
        return read(*given)
    except NumberError as error:
        raise argparse.ArgumentTypeError(str(error)) from None


def _deflection(text):
    """Return the greatest deflection [m]."""
    return _in_argument(field_number, "rail_deflection_limit", text)


def _share(text):
    """Return a share [-] given as 0.1 or as 10%."""
    return _in_argument(read_share, text)


def _pair(text, example):
    """Return the field and the rest of FIELD=REST."""
    field, equals, rest = (part.strip() for part in text.partition("="))
    if not equals:
        raise argparse.ArgumentTypeError(f"{text[:40]!r}: write {example}")
    return field, rest


def _cost(text):
    field, given = _pair(text, "FIELD=COST, such as block_mass=2.5/kg")
    return field, _in_argument(field_cost, field, given)


def _tolerance(text):
    """Return a field, and its tolerance as plain values."""
    field, given = _pair(text, "FIELD=SHARE, such as boot_stiffness=10%")
    kind, colon, share = given.rpartition(":")
    try:
        value = read_share(share)
    except NumberError as error:
        raise argparse.ArgumentTypeError(f"{error}; a tolerance is a share, such as 10% or 0.1") from None
    return field, {kind.strip(): value} if colon else value


def _range(text):
    """Return a field, and both ends of its range [SI]."""
    field, ends = _pair(text, "FIELD=LOW..HIGH, such as boot_stiffness=5..40 kN/mm")
    _check_searched(field)
    return field, _in_argument(field_range, field, ends)


def _free(text):
    """Return a field, and its range or that of its slider [SI]."""
    if "=" in text:
        return _range(text)
    _check_searched(text)
    return text, list(SEARCHED_RANGES[text])


def _check_searched(field):
    if field not in SEARCHED_RANGES:
        raise argparse.ArgumentTypeError(f"{field[:40]!r}: fields are {', '.join(SEARCHED_RANGES)}")


def _points(text):
    x, _, y = text.partition("x")
    try:
        return [int(x), int(y)]
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text[:40]!r}: write NXxNY, such as 200x200") from None


def _choices(study, options):
    """Return what is chosen from tables of products, a catalogue and rails."""
    choices = {path.stem: _products(path) for path in options.choose}
    if options.catalogue is not None and not options.components:
        raise DecideError(f"--catalogue: name with --component what is chosen: {', '.join(KINDS)}")
    if options.components:
        design = _design(study, options.design)
        catalogue = _catalogue(options.catalogue)
        choices |= {
            kind: [each.choice(design) for each in catalogue.of_kind(kind).values()]
            for kind in options.components
        }
    if options.rails is not None:
        choices["rail"] = options.rails.split(",")
    return choices


def _catalogue(path):
    """Return the catalogue of a file, or the bundled one."""
    if path is None:
        return tig.study.bundled_catalogue()
    try:
        return tig.study.Catalogue.from_toml(_read(path))
    except tig.StudyError as error:
        raise DecideError(f"{path}: {error}") from None


def _products(path):
    """Return the rows of a catalogue, each a dict."""
    columns = _table(path)
    return [dict(zip(columns, row, strict=True)) for row in zip(*columns.values(), strict=True)]


def _read(path):
    """Return what a file holds (bytes)."""
    with path.open("rb") as file:
        data = file.read(MOST_BYTES + 1)
    if len(data) > MOST_BYTES:
        raise DecideError(f"{path}: the file is larger than {MOST_BYTES // 10**6} MB")
    return data


def _table(path):
    """Return the columns of a CSV file with a header; lines that begin with # are comments."""
    rows = list(csv.reader(io.StringIO(_read(path).decode("utf-8-sig", errors="replace"))))
    rows = [row for row in rows if any(cell.strip() for cell in row) and not row[0].startswith("#")]
    if len(rows) < 2:
        raise DecideError(f"{path}: give a header of fields and one row or more")
    header = [_column(path, cell) for cell in rows[0]]
    columns = {field: [] for field, _ in header}
    for number, row in enumerate(rows[1:], start=2):
        if len(row) != len(header):
            raise DecideError(
                f"{path}, row {number}: {len(row)} values, and {len(header)} fields in the header"
            )
        for (field, unit), cell in zip(header, row, strict=True):
            columns[field].append(_cell(path, number, field, unit, cell.strip()))
    return columns


def _column(path, head):
    """Return the field that a header names, and the unit of its numbers, in SI where none is named."""
    name, written = re.fullmatch(r"([^\[(,]*)[\[(,]?(.*?)[\])]?", head.strip()).groups()
    field = name.strip().lower().replace(" ", "_")
    if field not in RANGES:  # a rail, a cost in any currency, or what the core refuses
        return name.strip(), find_unit("")
    wanted = find_unit(RANGES[field][2])
    unit = find_unit(written.strip()) if written.strip() else wanted
    if unit is None or unit.quantity != wanted.quantity:
        like = f", such as {wanted.name}" if wanted.name else ": it has none"
        raise DecideError(f"{path}: {brief(head)} names no unit of {field}{like}")
    return field, unit


def _cell(path, number, field, unit, cell):
    """Return a cell as a number in SI, or a rail's name as it is."""
    if field == "rail":
        return cell
    try:
        given = read_number(cell, unit.name)
    except NumberError as error:
        raise DecideError(f"{path}, row {number}, {field}: {error}") from None
    return unit.convert(given, find_unit(RANGES[field][2] if field in RANGES else ""))
