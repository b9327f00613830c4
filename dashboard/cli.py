"""The command line: solve a track, check and report a study, serve the dashboard.

SI units go in (N/m, kg, m), as everywhere in the core, or numbers with their unit (20kN/mm); Hz and dB come
out. Exit codes: 0 when all went well, 1 when a specification is not met, 2 when the input is at fault, which
is told in one line, 70 when the program is (see :mod:`dashboard.__main__`).

Nothing here computes; what is printed comes from the core, as anybody's script would have it.
"""

import argparse
import dataclasses
import datetime
import difflib
import json
import logging
import os
import sys
import time
from pathlib import Path

import trackig_core as tig
from dashboard import cli_decide, formats
from dashboard.cli_numbers import field_number
from dashboard.server.command import ServeError, add_arguments, serve
from dashboard.session.bands import WIDE, bands_text, gain_in
from dashboard.session.heading import Heading
from dashboard.session.measuring import fit_text
from dashboard.session.pins import base_design, current_design, shown_designs
from dashboard.session.results import DesignResult, SolutionSummary
from dashboard.session.special import curve_text
from dashboard.teaching import left_out
from trackig_core import table_text
from trackig_core.bands import BANDS
from trackig_core.levels import band_tables
from trackig_core.levels.insertion_gain import REFERENCES, SUMMATIONS, reference_for
from trackig_core.solver import FIDELITIES
from trackig_core.study import studies
from trackig_core.track.design import RANGES, measured_curves
from trackig_core.track.measured_tables import UNITS, read_stiffness
from trackig_core.typed_numbers import NumberError

FAILED, AT_FAULT, STOPPED, CUT_OFF = 1, 2, 130, 141
"""Exit codes: the specification is not met; the input is at fault; the user pressed Ctrl+C; who reads the
verdicts went away before all were told."""

STANDARD_OUTPUT = Path("-")
"""What stands for standard output where a file is written."""

PAGES = (".html", ".htm")
"""How the names of reports end."""

LIMITS = GAINS, LOSSES = ("insertion-gain", "insertion-loss")
"""What the limits of a specification may be."""

USER_ERRORS = (
    tig.BandTableError,
    tig.DesignError,
    tig.RunTooLargeError,
    tig.StudyError,
    cli_decide.DecideError,
    FloatingPointError,
    OSError,
)
"""What is told in one line: the input is at fault, or the place to write to."""

STATICS = (
    "wheel_load",
    "wheelbase",
    "unstated",
    "rail_deflection",
    "largest_rail_deflection",
    "largest_seat_load",
    "pad_compression",
    "boot_compression",
    "largest_uplift",
    "largest_bending_moment",
)
"""What of the static response stands in JSON, in SI."""

DESIGN_FIELDS = [field.name for field in dataclasses.fields(tig.TrackDesign)]


class CommandError(ValueError):
    """The command line asks for what there is not."""


def main(arguments=None):
    """Run one command.

    Parameters
    ----------
    arguments : list of str, optional
        Words of the command line; by default those of the process.

    Returns
    -------
    int
        Exit code.
    """
    for stream in (sys.stdout, sys.stderr):
        # names may hold characters that an old console does not have
        stream.reconfigure(errors="replace")
    options = _parser().parse_args(arguments)
    if options.run is not _serve and sys.stderr.isatty():
        _tell_of_compiling()
    try:
        code = options.run(options)
        sys.stdout.flush()
        return code
    except BrokenPipeError:
        # whoever reads the output has read enough; what is left must not fail at exit
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return options.cut_off
    except KeyboardInterrupt:
        return STOPPED
    except (CommandError, *USER_ERRORS) as error:
        sys.stderr.write(f"trackig: {_words(error)}\n")
        return AT_FAULT


def _tell_of_compiling():
    """Have whoever waits at a screen told that a first run compiles; a page says so itself."""
    handler = logging.StreamHandler()
    handler.setFormatter(logging.Formatter("trackig: %(message)s"))
    log = logging.getLogger("trackig_core.compiling")
    log.handlers, log.propagate = [handler], False
    log.setLevel(logging.INFO)


def _words(error):
    """Return an error in one line."""
    if isinstance(error, OSError) and error.filename is not None:
        return f"{error.filename}: {error.strerror}"
    return str(error)


def _parser():
    parser = argparse.ArgumentParser(
        prog="trackig",
        description="Insertion gain of railway track supports.",
        epilog="Exit codes: 0 all went well; 1 the specification is not met; 2 the input is at fault; "
        "70 trackig itself is; 130 Ctrl+C was pressed; 141 nobody reads the verdicts any more.",
    )
    parser.add_argument("--version", action="version", version=f"trackig {tig.__version__}")
    commands = parser.add_subparsers(required=True, metavar="COMMAND")
    _add_solve(commands)
    _add_check(commands)
    _add_report(commands)
    cli_decide.add_commands(commands, cli_decide.Shell(_add, _add_study, _open, _refuse_to_lose, _write))
    _add_serve(commands)
    return parser


def _add(commands, name, run, **words):
    command = commands.add_parser(
        name, formatter_class=argparse.RawDescriptionHelpFormatter, description=words["help"], **words
    )
    command.set_defaults(run=run, cut_off=0)
    return command


def _add_study(command):
    """Add what a command is about: a preset or a study, and the specification that holds for it."""
    command.add_argument(
        "study",
        metavar="PRESET|FILE.toml",
        help=f"{', '.join(tig.PRESETS)}, or a study, as the dashboard and solve --study write it",
    )
    command.add_argument(
        "--specification",
        type=Path,
        metavar="FILE.csv",
        help="a table of bands [Hz] and greatest insertion gain [dB], in place of the study's specification",
    )
    command.add_argument(
        "--limits",
        choices=LIMITS,
        help="what the limits of the specification are, the answer if it is asked; the sign of insertion "
        "losses is turned",
    )


def _add_solve(commands):
    command = _add(
        commands,
        "solve",
        _solve,
        help="Print insertion gain per band [dB] and natural frequencies [Hz] of a track.",
        epilog=_fields_help(),
    )
    _add_study(command)
    command.add_argument(
        "--set",
        action="append",
        default=[],
        metavar="FIELD=VALUE",
        dest="changes",
        help="change a field, in SI units or with a unit, such as boot_stiffness=20kN/mm; may be given again",
    )
    command.add_argument(
        "--measured",
        action="append",
        default=[],
        metavar="PART=FILE.csv",
        help="the pad or boot is as this table of a test house has it: frequency, stiffness, loss factor, or "
        "real and imaginary part; may be given again",
    )
    command.add_argument(
        "--stiffness-unit",
        choices=UNITS,
        help="unit of the stiffness of these tables, whatever they say: the answer if it is asked",
    )
    _add_fidelity(command)
    command.add_argument(
        "--wheel-load",
        metavar="LOAD",
        help="load of a standing wheel [N, or with unit]; the study's, else 85kN",
    )
    command.add_argument(
        "--wheelbase",
        metavar="DISTANCE",
        help="distance to a second wheel [m, or with unit]; the study's, else none",
    )
    command.add_argument("--reference", choices=REFERENCES, help="the study's, else line")
    command.add_argument("--summation", choices=SUMMATIONS, help="the study's, else energy")
    command.add_argument(
        "--bands",
        choices=BANDS,
        help="bands to print and write, the study's, else the paper's; beyond 5 to 500 Hz they are of the "
        "frequency-domain solution",
    )
    command.add_argument(
        "--csv",
        type=Path,
        metavar="FILE",
        help="write the bands [Hz, dB] as CSV, to four decimals, - for standard output",
    )
    command.add_argument(
        "--json",
        type=Path,
        metavar="FILE",
        help="write design and results as JSON, in SI and in full, - for standard output",
    )
    command.add_argument(
        "--study",
        type=Path,
        metavar="FILE.toml",
        dest="saved",
        help="write the track, as it was changed, as a study for the other commands and the dashboard, - for "
        "standard output",
    )
    _add_force(command)


def _add_check(commands):
    command = _add(
        commands,
        "check",
        _check,
        help="Hold a study's designs against its specification; exit with 1 if any fails.",
        epilog="Checked are the current design and the pinned designs that are shown, not the hidden ones.",
    )
    _add_study(command)
    command.set_defaults(cut_off=CUT_OFF)
    _add_fidelity(command)


def _add_report(commands):
    command = _add(
        commands,
        "report",
        _report,
        help="Write a report of a study as one HTML file.",
        epilog="Reported are the current design and the pinned designs that are shown.",
    )
    _add_study(command)
    command.add_argument(
        "output", type=Path, metavar="OUT.html", help="where the report is written, - for standard output"
    )
    for name in ("project", "client", "author"):
        command.add_argument(
            f"--{name}", default="", metavar="NAME", help=f"name of the {name}, for the report's header"
        )
    command.add_argument(
        "--ladder",
        action="store_true",
        help="also report what the simplified model leaves out of the current design, put back step by step",
    )
    command.add_argument(
        "--vehicle",
        choices=tig.VEHICLES,
        help="generic vehicle of the ladder of a design that has none of its own; "
        f"{left_out.OPENING_VEHICLE} unless given",
    )
    command.add_argument(
        "--ground",
        choices=tig.GROUNDS,
        help=f"generic ground of the same; {left_out.OPENING_GROUND} unless given",
    )
    _add_fidelity(command)
    _add_force(command)


def _add_serve(commands):
    command = _add(commands, "serve", _serve, help="Serve the dashboard until stopped by Ctrl+C.")
    add_arguments(command, _count, _port)


def _add_fidelity(command):
    command.add_argument(
        "--fidelity", choices=FIDELITIES, default=FIDELITIES[0], help=f"{FIDELITIES[0]} unless given"
    )


def _add_force(command):
    command.add_argument("--force", action="store_true", help="write over files that exist")


def _fields_help():
    """Return the fields of a design with their ranges and units."""
    lines = ["fields for --set, in SI units unless a unit is given:"]
    for name in DESIGN_FIELDS:
        if name in RANGES:
            low, high, unit = RANGES[name]
            lines.append(f"  {name:18} {low:g} to {high:g} {unit}".rstrip())
    lines.append(f"  {'rail':18} {', '.join(tig.RAILS)}")
    lines.append("'none' for block_mass, boot_stiffness and boot_loss_factor makes a single-stage track")
    return "\n".join(lines)


def _count(text):
    number = int(text) if text.isascii() and text.isdecimal() and len(text) <= 4 else 0
    if number < 1:
        raise argparse.ArgumentTypeError(f"{text}: give a whole number of one or more")
    return number


def _port(text):
    number = int(text) if text.isascii() and text.isdecimal() and len(text) <= 5 else 0
    if not 1 <= number <= 65535:
        raise argparse.ArgumentTypeError(f"{text[:20]!r}: give a whole number from 1 to 65535")
    return number


def _solve(options):
    outputs = [path for path in (options.csv, options.json, options.saved) if path is not None]
    if outputs.count(STANDARD_OUTPUT) > 1:
        raise CommandError("--csv -, --json -, --study -: standard output takes one of them")
    for path in outputs:
        _refuse_to_lose(path, options.force, options.study)
    if options.saved is None and (options.specification or options.limits):
        raise CommandError("--specification and --limits go into the study that is written: give --study too")
    study = _open(options, judges=False)
    view, load = study.view, _load(study.load, options)
    changed = study.design.replace(**_changes(options))
    solution = tig.solve(
        changed,
        options.fidelity,
        reference=options.reference or reference_for(changed, view.reference),
        summation=options.summation or view.summation,
    )
    bands = options.bands or view.bands
    gain = gain_in(bands, solution, solution.gain.reference, solution.gain.summation)
    notes = (*solution.notes, *([bands_text(bands)] if bands in WIDE else []))
    statics = load.response(solution.design)
    if STANDARD_OUTPUT not in outputs:
        sys.stdout.write(_solution_text(solution, gain, notes, statics))
    if options.csv is not None:
        _write(options.csv, _solution_csv(study, solution, gain, bands, statics))
    if options.json is not None:
        _write(options.json, _solution_json(solution, gain, notes, statics))
    if options.saved is not None:
        _write(options.saved, _changed_study(study, solution, bands, load).to_toml())
    return 0


def _changed_study(study, solution, bands, load):
    """Return a study with the design, the definition, the bands and the wheels of the command line."""
    gain = solution.gain
    view = dataclasses.replace(study.view, reference=gain.reference, summation=gain.summation, bands=bands)
    return dataclasses.replace(study, design=solution.design, view=view, load=load)


def _load(load, options):
    """Return the wheels that stand on the track: a study's, but for what the command line says."""
    changes = {}
    for name, text in (("wheel_load", options.wheel_load), ("wheelbase", options.wheelbase)):
        if text is not None:
            try:
                changes[name] = field_number(name, text)
            except NumberError as error:
                raise CommandError(f"--{name.replace('_', '-')} {error}") from None
    return dataclasses.replace(load, **changes)


def _open(options, judges=True):
    """Return the study that a command is about, with the specification that its options give."""
    opened = _named_study(options.study)
    if options.specification is not None:
        specification = _open_specification(options.specification, options.limits)
        opened = dataclasses.replace(opened, specification=specification)
    elif opened.specification is not None and judges:
        specification = _judging(opened.specification, options.limits, options.study)
        opened = dataclasses.replace(opened, specification=specification)
    return opened


def _named_study(name):
    """Return the study that a preset's name or a study's path stands for."""
    if name in tig.PRESETS:
        return tig.Study(tig.PRESETS[name], preset=name)
    path = Path(name)
    if not path.exists():
        near = difflib.get_close_matches(name, tig.PRESETS, n=1)
        hint = f"did you mean {near[0]}?" if near else f"presets are {', '.join(tig.PRESETS)}"
        raise CommandError(f"{name}: no preset and no file; {hint}")
    return _open_study(path)


def _change(text):
    """Return the field and the value that ``FIELD=VALUE`` stands for."""
    field, equals, value = (part.strip() for part in text.partition("="))
    if not equals:
        raise CommandError(f"--set {text}: write FIELD=VALUE, such as boot_stiffness=20kN/mm")
    if field == "rail":
        if value not in tig.RAILS:
            raise CommandError(f"--set {text}: rails are {', '.join(tig.RAILS)}")
        return field, tig.RAILS[value]
    if value == "none":
        return field, None
    if field not in RANGES:
        # the design says which fields there are
        return field, value
    try:
        return field, field_number(field, value)
    except NumberError as error:
        raise CommandError(f"--set {text}: {error}") from None


def _changes(options):
    """Return the fields that the command line changes, by name."""
    found = dict(map(_change, options.changes))
    for text in options.measured:
        part, equals, path = (each.strip() for each in text.partition("="))
        if not equals or part not in ("pad", "boot"):
            raise CommandError(f"--measured {text}: write pad=FILE.csv or boot=FILE.csv")
        found[f"{part}_stiffness"] = _measured(Path(path), options.stiffness_unit)
        found[f"{part}_loss_factor"] = None
    return found


def _measured(path, unit):
    """Return the stiffness that a test house's table holds; an open question on its unit is an error."""
    try:
        reading = read_stiffness(_read(path, table_text.MOST_BYTES), unit)
    except tig.MeasurementError as error:
        raise CommandError(f"{path}: {error}") from None
    if reading.question:
        unit = reading.suggestion or reading.unit
        raise CommandError(f"{path}: {reading.question} Give --stiffness-unit {unit}, or the unit that it is")
    for note in reading.notes:
        sys.stderr.write(f"trackig: {path}: {note}\n")
    return reading.curve


def _read(path, most):
    """Return what a file holds; of one that is too large, enough to tell."""
    if path.exists() and not path.is_file() and not path.is_dir():
        # reading a pipe would wait for whoever writes to it
        raise CommandError(f"{path}: this is not a regular file; save what it holds, and name that file")
    with path.open("rb") as file:
        return file.read(most + 1)


def _open_study(path):
    try:
        return tig.Study.from_toml(_read(path, studies.MOST_BYTES))
    except tig.StudyError as error:
        raise CommandError(f"{path}: {error}") from None


def _open_specification(path, limits):
    try:
        reading = tig.Specification.read(_read(path, band_tables.MOST_BYTES))
    except tig.SpecificationError as error:
        raise CommandError(f"{path}: {error}") from None
    for note in reading.notes:
        sys.stderr.write(f"trackig: {path}: {note}\n")
    return _judging(reading.table, limits, path)


def _judging(specification, limits, path):
    """Return a specification where it is known what its limits are; an open question is an error."""
    if limits is not None:
        return specification.turned() if limits == LOSSES else specification.kept()
    if specification.question:
        raise CommandError(
            f"{path}: no verdict: {specification.question} Give --limits {LOSSES} to turn their sign, or "
            f"--limits {GAINS} to take them as they are"
        )
    return specification


def _check(options):
    opened = _open(options)
    if opened.specification is None:
        raise CommandError(
            f"{options.study}: the study has no specification; add one, or give --specification FILE.csv"
        )
    complies = True
    for pinned in shown_designs(opened):
        view = opened.view
        solution = tig.solve(
            pinned.design,
            options.fidelity,
            reference=reference_for(pinned.design, view.reference),
            summation=view.summation,
        )
        deflection = tig.analysis.limited_deflection(opened.specification, pinned.design)
        verdict = opened.specification.check(solution.insertion_gain, deflection)
        statics = opened.load.response(pinned.design)
        sys.stdout.write(f"{pinned.name}: {verdict}\n    {_statics_text(statics)}\n")
        complies &= verdict.complies
    return 0 if complies else FAILED


def _report(options):
    # plots are slow to load, and no other command draws any
    from dashboard.report.html_report import Particulars, html_report

    try:
        particulars = Particulars(options.project, options.client, options.author)
    except ValueError as error:
        raise CommandError(f"--{error}") from None
    if options.output != STANDARD_OUTPUT and options.output.suffix.lower() not in PAGES:
        page = options.output.with_suffix(".html")
        raise CommandError(
            f"{options.output}: a report is an HTML file; write {page}, and print it to PDF from a browser"
        )
    if not options.ladder and (options.vehicle or options.ground):
        raise CommandError("--vehicle and --ground are those of the ladder: give --ladder too")
    opened = _open(options)
    _refuse_to_lose(options.output, options.force, options.study)
    ladder = _ladder(opened, options) if options.ladder else None
    summaries = {
        design: _summary(design, options.fidelity)
        for design in {each.design for each in (*shown_designs(opened), base_design(opened))}
    }
    try:
        pages = cli_decide.pages_of(opened.answers)
    except tig.SolveCancelled:
        return STOPPED
    report = html_report(
        opened,
        summaries,
        date=datetime.date.today(),
        version=tig.__version__,
        pages=pages,
        left_out=ladder,
        particulars=particulars,
    )
    _write(options.output, report)
    if options.output != STANDARD_OUTPUT:
        sys.stdout.write(f"{options.output}\n")
    return 0


def _ladder(study, options):
    """Return what the simplified model leaves out of a study's current design."""
    return left_out.left_out(
        study.design,
        options.vehicle or left_out.OPENING_VEHICLE,
        options.ground or left_out.OPENING_GROUND,
        study.view.summation,
    )


def _summary(design, fidelity):
    began = time.perf_counter()
    return SolutionSummary.of(tig.solve(design, fidelity), time.perf_counter() - began)


def _serve(options):
    try:
        serve(options)
    except ServeError as error:
        raise CommandError(str(error)) from None
    return 0


def _refuse_to_lose(path, force, read):
    """Refuse to write over the file that is read, and, unless forced, over any that exists."""
    if path == STANDARD_OUTPUT:
        return
    if path.exists() and Path(read).exists() and path.samefile(read):
        raise CommandError(f"{path}: this is the file that is read; write to another")
    if path.exists() and not force:
        raise CommandError(f"{path}: this file exists; give --force to write over it")


def _write(path, text):
    if path == STANDARD_OUTPUT:
        sys.stdout.write(text)
    else:
        path.write_text(text, encoding="utf-8", newline="")


def _statics_text(statics):
    """Return deflection and seat load in one line."""
    words = (
        f"rail deflection {formats.deflection_text(statics)}, "
        f"seat load {formats.load_text(statics.largest_seat_load)}, under {formats.wheels_text(statics)}"
    )
    reason = formats.unstated_text(statics)
    return f"{words} ({reason})" if reason else words


def _solution_text(solution, gain, notes, statics):
    """Return bands and natural frequencies as lines for the console."""
    natural = solution.natural_frequencies
    lines = [
        f"fidelity {solution.fidelity}, reference {gain.reference}, summation {gain.summation}",
        "",
        "band, Hz   insertion gain, dB",
    ]
    lines += [
        f"{label:>8}   {level:+18.1f}" for label, level in zip(gain.bands.labels, gain.levels, strict=True)
    ]
    lines += ["", f"loaded track    {formats.frequency_text(natural.loaded_track)}"]
    if natural.coupled_block is not None:
        lines.append(f"coupled block   {formats.frequency_text(natural.coupled_block)}")
    lines.append(_statics_text(statics))
    lines += [
        f"{name.replace('_', ' ')} {curve_text(curve)}; {fit_text(tig.analysis.curve_fit(curve))}"
        for name, curve in measured_curves(solution.design).items()
    ]
    lines += [f"note: {note}" for note in notes]
    return "\n".join(lines) + "\n"


def _solution_csv(study, solution, gain, bands, statics):
    """Return the bands as the dashboard saves them, of a study's current design as it was changed."""
    # slow to load, and nobody waits for it who writes no table
    from dashboard.persistence.exports import gain_csv

    study = _changed_study(study, solution, bands, study.load)
    result = DesignResult(
        current_design(study.design),
        SolutionSummary.of(solution, 0.0),
        solution.gain,
        statics=statics,
        gain_shown=gain,
    )
    return gain_csv([result], Heading.of(study, [result], datetime.date.today()), study.measured)


def _solution_json(solution, gain, notes, statics):
    found = {
        "trackig": tig.__version__,
        "fidelity": solution.fidelity,
        "reference": gain.reference,
        "summation": gain.summation,
        "design": dataclasses.asdict(solution.design),
        "band_hz": [float(label) for label in gain.bands.labels],
        "band_centre_hz": gain.bands.centres.tolist(),
        "insertion_gain_db": gain.levels.tolist(),
        "natural_frequencies_hz": dataclasses.asdict(solution.natural_frequencies),
        "static_response": {
            name: getattr(statics, name) for name in STATICS if getattr(statics, name) is not None
        },
        "notes": list(notes),
    }
    return json.dumps(found, indent=2, ensure_ascii=False) + "\n"
