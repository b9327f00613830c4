"""The TOML file of a study, which people read and this module reads back exactly.

SI units, named in the keys (``pad_stiffness_N_per_m``); levels in dB. Numbers are written with as many
figures as they have, so that what is opened equals what was saved.

A file is hostile until it has been read as a whole. Its size is bounded, what nobody knows is
refused rather than dropped, and an error says where it is and what to do.
"""

from __future__ import annotations

import difflib
import textwrap
import tomllib
from collections.abc import Callable, Iterable, Mapping
from dataclasses import fields, replace
from decimal import Decimal
from typing import TYPE_CHECKING, Any, TypeVar

import tomlkit
from tomlkit.items import Array, Float, Table, Trivia

from trackig_core.decide.questions import Answer, Question
from trackig_core.levels.band_tables import BandTable, BandTableError
from trackig_core.levels.measured_gain import MeasuredGain
from trackig_core.levels.source import SourceSpectrum
from trackig_core.levels.specification import UNSTATED, Specification
from trackig_core.names import brief
from trackig_core.study.records import PinnedDesign, StaticLoad, StudyError, View
from trackig_core.track.design import ONE_AXLE, REFERENCE_FREQUENCY, TrackDesign
from trackig_core.track.fields import (
    AXLE_FIELDS,
    DESIGN_FIELDS,
    GROUND_FIELDS,
    RAIL_FIELDS,
    STATIC_FIELDS,
    SUSPENSION_FIELDS,
    WHEELBASE,
    DesignError,
)
from trackig_core.track.ground import Ground
from trackig_core.track.measured_curves import LossFactorCurve, MeasurementError, StiffnessCurve
from trackig_core.track.rails import Rail
from trackig_core.track.vehicle import Suspension

if TYPE_CHECKING:
    from trackig_core.study.studies import Study

_Made = TypeVar("_Made")

FORMAT = "trackig study"
"""What every file says it is."""

UNTITLED = "Study"
"""What a study is called that has no name."""

VERSION = 1
"""The version of the format that is written, and the newest that is read."""

MOST_BYTES = 262_144
"""Size that a file may have [bytes]."""

LONGEST_LINE = 200
"""Characters that a line may have, unless it is a comment [-]. Dotted keys cost a reader the square of their
length; with this bound the worst file takes about a second."""

LONGEST_TEXT = 100
"""Characters of a sentence that are written on one line [-]."""

_DESIGN_KEYS = {each.name: each.key for each in DESIGN_FIELDS}
"""Key of each number of a design."""

_OPTIONAL = {"stiffness_frequency": REFERENCE_FREQUENCY}
"""What a number is that a file leaves out."""

_RAIL_KEYS = {"name": "name"} | {each.name: each.key for each in RAIL_FIELDS}
"""Key of the name and of each number of a rail."""

_AXLE_KEYS = dict(zip(("axle_positions", "speed"), (each.key for each in AXLE_FIELDS), strict=True))
"""Key of the axles' positions and of the speed."""

_PARTS: dict[str, tuple[type[Suspension] | type[Ground], dict[str, str]]] = {
    "suspension": (Suspension, {each.name: each.key for each in SUSPENSION_FIELDS}),
    "ground": (Ground, {each.name: each.key for each in GROUND_FIELDS}),
}
"""Class of what a design may stand under and on, and the key of each of its numbers."""

_LIMIT_KEYS = {each.name: each.key for each in STATIC_FIELDS}
"""Key of the limit of rail deflection, and of the load under which it holds."""

_LOAD_KEYS = {name: each for name, each in _LIMIT_KEYS.items() if name == "wheel_load"} | {
    WHEELBASE.name: WHEELBASE.key
}
"""Key of each number of the wheels that stand on the track."""

_CURVES: dict[str, tuple[str, type[StiffnessCurve] | type[LossFactorCurve]]] = {
    "pad_stiffness": ("pad_stiffness_measured", StiffnessCurve),
    "pad_loss_factor": ("pad_loss_factor_measured", LossFactorCurve),
    "boot_stiffness": ("boot_stiffness_measured", StiffnessCurve),
    "boot_loss_factor": ("boot_loss_factor_measured", LossFactorCurve),
}
"""Key and class of what may be given as measured over frequency."""

_PRELOAD_KEYS = {"pad_stiffness": "pad_preload_N", "boot_stiffness": "boot_preload_N"}
"""Key of the preload of a measured stiffness."""

_CURVE_ROWS = {
    StiffnessCurve: "rows of frequency [Hz], dynamic stiffness [N/m], loss factor [-]",
    LossFactorCurve: "rows of frequency [Hz], loss factor [-]",
}

_LEVEL_ROWS = "rows of one-third-octave band [Hz], level [dB]"

_MEASURED_ROWS = "ig_dB"
"""Key of the rows of a curve from elsewhere."""

_TABLES: dict[str, tuple[type[Specification] | type[SourceSpectrum], str]] = {
    "specification": (Specification, "ig_max_dB"),
    "source": (SourceSpectrum, "level_dB"),
}
"""Class of each table of levels, and the key of its rows."""


class _Section:
    """A table of a file: what is taken is known, and what is left in the end is refused."""

    def __init__(self, values: Any, path: str = "") -> None:
        if not isinstance(values, dict):
            raise StudyError(f"{brief(values)}: give a table of keys and values", path)
        self._values: dict[str, Any] = values
        self.path = path
        self._known: list[str] = []

    def under(self, key: str) -> str:
        """Return the path of a key."""
        return f"{self.path}.{key}" if self.path else key

    def take(self, key: str, otherwise: Any = None) -> Any:
        """Return the value of a key, or ``otherwise`` if it is not there."""
        if key not in self._known:
            self._known.append(key)
        return self._values.get(key, otherwise)

    def need(self, key: str) -> Any:
        """Return the value of a key that must be there."""
        value = self.take(key)
        if value is None:
            raise StudyError("it is missing", self.under(key))
        return value

    def section(self, key: str) -> _Section:
        """Return the table of a key that must be there."""
        return _Section(self.need(key), self.under(key))

    def close(self) -> None:
        """Refuse keys that were not taken."""
        for key in self._values:
            if key not in self._known:
                near = difflib.get_close_matches(key, self._known, n=1)
                hint = f"write {near[0]!r}" if near else f"known are {', '.join(self._known)}"
                raise StudyError(f"there is no such key; {hint}, or remove it", self.under(brief(key)[1:-1]))


def _parsed(data: str | bytes) -> dict[str, Any]:
    """Return a file's tables, or raise a StudyError."""
    if len(data) > MOST_BYTES:
        raise StudyError(f"the file is larger than {MOST_BYTES // 1024} kB: a study is not")
    text = _decoded(data).removeprefix("\N{BYTE ORDER MARK}")
    for number, line in enumerate(text.split("\n"), start=1):
        if len(line) > LONGEST_LINE and not line.lstrip().startswith("#"):
            raise StudyError(f"line {number} has more than {LONGEST_LINE} characters: break it at a comma")
    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise StudyError(f"this is not TOML: {error}") from None
    except RecursionError:
        raise StudyError("brackets or braces are nested too deep: a study needs two levels") from None
    except ValueError:  # numbers and dates that are TOML, but that Python does not take
        raise StudyError("a number or date is out of all bounds: write numbers of up to 17 figures") from None


def _decoded(data: str | bytes) -> str:
    if isinstance(data, str):
        return data
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        raise StudyError(f"line {line}: this is not UTF-8 text; save the file as UTF-8") from None


def read(data: str | bytes) -> dict[str, Any]:
    """Return what a file holds, as the arguments of a Study.

    Parameters
    ----------
    data : str or bytes
        What the file holds.

    Returns
    -------
    dict
        Checked records by field of :class:`trackig_core.study.studies.Study`.

    Raises
    ------
    StudyError
        If the file cannot be used; the message says where and why.
    """
    section = _Section(_parsed(data))
    if section.take("format") != FORMAT:
        raise StudyError(f"this is no study: its first line would be format = {FORMAT!r}")
    _check_version(section.need("version"))
    view = _view(_Section(section.take("view", {}), "view"))
    tables = {name: _table(section, name, *kind) for name, kind in _TABLES.items()}
    pinned = section.take("pinned", [])
    if not isinstance(pinned, list):
        raise StudyError(f"{brief(pinned)}: write each pinned design under [[pinned]]", "pinned")
    values = {
        "name": section.take("name", UNTITLED),
        "preset": section.take("preset"),
        "design": _design(section.section("design")),
        "view": view,
        "load": _load(_Section(section.take("load", {}), "load")),
        "measured": _measured(section),
        "pinned": [_pinned(_Section(each, f"pinned[{number}]")) for number, each in enumerate(pinned)],
        "answers": _answers(section),
        **tables,
    }
    section.close()
    return values


def _check_version(version: object) -> None:
    if isinstance(version, int) and not isinstance(version, bool) and version > VERSION:
        raise StudyError(
            f"{brief(version)}: a newer trackig wrote this file, and this one reads version {VERSION}; "
            "update trackig to open it",
            "version",
        )
    if version != VERSION or not isinstance(version, int) or isinstance(version, bool):
        raise StudyError(f"{brief(version)}: give {VERSION}", "version")


def _view(section: _Section) -> View:
    view = View(**{each.name: section.take(each.name, each.default) for each in fields(View)})
    section.close()
    return view


def _load(section: _Section) -> StaticLoad:
    given = {name: section.take(key) for name, key in _LOAD_KEYS.items()}
    section.close()
    try:
        return StaticLoad(**{name: value for name, value in given.items() if value is not None})
    except StudyError as error:
        raise StudyError(error.message, section.under(_LOAD_KEYS[error.path.rpartition(".")[2]])) from None


def _pinned(section: _Section) -> PinnedDesign:
    name, design = section.need("name"), _design(section.section("design"))
    colour, shown, preset = section.take("colour", 0), section.take("shown", True), section.take("preset")
    section.close()
    try:
        return PinnedDesign(name, design, colour, shown, preset)
    except StudyError as error:
        raise StudyError(error.message, section.under(error.path)) from None


def _table(
    study: _Section, name: str, kind: type[Specification] | type[SourceSpectrum], key: str
) -> BandTable | None:
    """Return a specification or source, or None if there is none."""
    if study.take(name) is None:
        return None
    section = study.section(name)
    title = section.take("name", kind.name)
    limits = _limits(section) | _meaning(section) if kind is Specification else {}
    # a limit of deflection may stand alone
    points = section.take(key, []) if limits.get("rail_deflection_limit") is not None else section.need(key)
    section.close()
    try:
        return kind(points, title, **limits)
    except BandTableError as error:
        path = section.path if error.line is None else section.under(key)
        raise StudyError(str(error), path) from None


def _measured(study: _Section) -> list[MeasuredGain]:
    """Return the curves from elsewhere."""
    given = study.take("measured", [])
    if not isinstance(given, list):
        raise StudyError(f"{brief(given)}: write each curve under [[measured]]", "measured")
    curves = []
    for number, each in enumerate(given):
        section = _Section(each, f"measured[{number}]")
        points, name = section.need(_MEASURED_ROWS), section.take("name", MeasuredGain.name)
        section.close()
        try:
            curves.append(MeasuredGain(points, name))
        except BandTableError as error:
            path = section.path if error.line is None else section.under(_MEASURED_ROWS)
            raise StudyError(str(error), path) from None
    return curves


def _limits(section: _Section) -> dict[str, Any]:
    """Return what a specification says of rail deflection, as arguments of it."""
    limits = {name: section.take(key) for name, key in _LIMIT_KEYS.items()}
    if limits["rail_deflection_limit"] is None and limits["wheel_load"] is not None:
        key = _LIMIT_KEYS["rail_deflection_limit"]
        raise StudyError(f"give {key} too, or remove it", section.under(_LIMIT_KEYS["wheel_load"]))
    return {name: value for name, value in limits.items() if value is not None}


def _meaning(section: _Section) -> dict[str, Any]:
    """Return what a specification says of its limits, as arguments of it; files of old say nothing."""
    not_judged = section.take("not_judged", [])
    if not isinstance(not_judged, list):
        raise StudyError(f"{brief(not_judged)}: give a list of texts", section.under("not_judged"))
    return {"limits": section.take("limits", UNSTATED), "not_judged": tuple(not_judged)}


def _answers(study: _Section) -> list[Answer]:
    """Return the questions that were asked, and what came out."""
    given = study.take("answers", [])
    if not isinstance(given, list):
        raise StudyError(f"{brief(given)}: write each answer under [[answers]]", "answers")
    return [_answer(_Section(each, f"answers[{number}]")) for number, each in enumerate(given)]


def _answer(section: _Section) -> Answer:
    values = {
        "kind": section.need("question"),
        "design": _design(section.section("design")),
        "settings": section.take("settings", {}),
        "reference": section.take("reference", "line"),
        "summation": section.take("summation", "energy"),
        **{name: _table(section, name, *kind) for name, kind in _TABLES.items()},
    }
    lines, digest, versions = (section.need(key) for key in ("sentence", "digest", "versions"))
    section.close()
    for key, value, kind, words in (
        ("settings", values["settings"], dict, "a table of keys and values"),
        ("sentence", lines, list, "a list of its lines"),
        ("digest", digest, str, "a text"),
        ("versions", versions, dict, "a table of names and versions"),
    ):
        if not isinstance(value, kind):
            raise StudyError(f"{brief(value)}: give {words}", section.under(key))
    try:
        return Answer(Question(**values), " ".join(map(str, lines)), digest, versions)
    except (TypeError, ValueError) as error:
        raise StudyError(str(error), section.path) from None


def _design(section: _Section) -> TrackDesign:
    values = {name: section.take(key, _OPTIONAL.get(name)) for name, key in _DESIGN_KEYS.items()}
    for name, (key, kind) in _CURVES.items():
        curve = _curve(section, key, kind, _PRELOAD_KEYS.get(name))
        if curve is not None and values[name] is not None:
            raise StudyError(f"give this or {_DESIGN_KEYS[name]}, not both", section.under(key))
        values[name] = values[name] if curve is None else curve
    for part in ("pad", "boot"):
        if (
            isinstance(values[f"{part}_stiffness"], StiffnessCurve)
            and values[f"{part}_loss_factor"] is not None
        ):
            message = f"remove it: {part}_stiffness_measured has loss factors of its own"
            raise StudyError(message, section.under(f"{part}_loss_factor"))
    rail_section = section.section("rail")
    rail_values = {name: rail_section.need(key) for name, key in _RAIL_KEYS.items()}
    rail_section.close()
    around = {name: section.take(key) for name, key in _AXLE_KEYS.items()}
    around |= {name: _part(section, name, *kind) for name, kind in _PARTS.items()}
    section.close()
    rail = _made(Rail, rail_values, _RAIL_KEYS, rail_section)
    given = {name: value for name, value in around.items() if value is not None}
    return _made(TrackDesign, {**values, **given, "rail": rail}, _DESIGN_KEYS | _AXLE_KEYS, section)


def _curve(
    section: _Section,
    key: str,
    kind: type[StiffnessCurve] | type[LossFactorCurve],
    preload_key: str | None = None,
) -> StiffnessCurve | LossFactorCurve | None:
    """Return what was measured, with its preload if it may have one, or None if nothing was."""
    points = section.take(key)
    preload = None if preload_key is None else section.take(preload_key)
    if points is None:
        if preload is not None:
            message = f"remove it, or give {key}: a preload is that of a measurement"
            raise StudyError(message, section.under(str(preload_key)))
        return None
    at = key
    try:
        curve = kind(points)
        if isinstance(curve, StiffnessCurve) and preload is not None:
            at = str(preload_key)
            curve = replace(curve, preload=preload)
    except MeasurementError as error:
        raise StudyError(str(error), section.under(at)) from None
    return curve


def _part(
    design: _Section, name: str, kind: type[Suspension] | type[Ground], keys: Mapping[str, str]
) -> Suspension | Ground | None:
    """Return a design's suspension or ground, or None if there is none."""
    if design.take(name) is None:
        return None
    section = design.section(name)
    values = {field: section.take(key) for field, key in keys.items()}
    section.close()
    return _made(lambda **numbers: kind(*numbers.values()), values, keys, section)


def _made(
    kind: Callable[..., _Made], values: Mapping[str, Any], keys: Mapping[str, str], section: _Section
) -> _Made:
    """Return an object of the core, its errors named by the key that the file has for the field."""
    try:
        return kind(**values)
    except DesignError as error:
        what = "it is missing" if error.value is None else brief(error.value)
        raise StudyError(f"{what}: give {error.allowed}", section.under(keys[error.field])) from None


def written(study: Study) -> str:
    """Return a study as the text of a file."""
    document = tomlkit.document()
    document.add(tomlkit.comment("A study of trackig: insertion gain of railway track supports."))
    document.add(
        tomlkit.comment("SI units, as the keys say; stiffnesses are dynamic, at 50 Hz unless stated.")
    )
    for key, value in (("format", FORMAT), ("version", VERSION), ("name", study.name)):
        document.add(key, value)
    if study.preset is not None:
        document.add("preset", study.preset)
    document.add("view", _written_view(study.view))
    if study.load != StaticLoad():
        document.add("load", _written_load(study.load))
    document.add("design", _written_design(study.design))
    for name, (_, key) in _TABLES.items():
        if getattr(study, name) is not None:
            document.add(name, _written_table(getattr(study, name), key))
    if study.measured:
        measured = tomlkit.aot()
        for curve in study.measured:
            measured.append(_written_table(curve, _MEASURED_ROWS))
        document.add("measured", measured)
    if study.pinned:
        pinned = tomlkit.aot()
        for each in study.pinned:
            pinned.append(_written_pinned(each))
        document.add("pinned", pinned)
    if study.answers:
        answers = tomlkit.aot()
        for answer in study.answers:
            answers.append(_written_answer(answer))
        document.add("answers", answers)
    return tomlkit.dumps(document)


def _written_view(view: View) -> Table:
    table = tomlkit.table()
    for each in fields(View):
        # what is as the paper has it needs no line, and an earlier version reads on
        if getattr(view, each.name) is not None and (each.name != "bands" or view.bands != each.default):
            table.add(each.name, getattr(view, each.name))
    return table


def _written_load(load: StaticLoad) -> Table:
    table = tomlkit.table()
    for name, key in _LOAD_KEYS.items():
        if getattr(load, name) is not None:
            table.add(key, _number(getattr(load, name)))
    return table


def _written_pinned(pinned: PinnedDesign) -> Table:
    table = tomlkit.table()
    for key in ("name", "colour", "shown", "preset"):
        if getattr(pinned, key) is not None:
            table.add(key, getattr(pinned, key))
    table.add("design", _written_design(pinned.design))
    return table


def _written_answer(answer: Answer) -> Table:
    question, table = answer.question, tomlkit.table()
    table.add("question", question.kind)
    table.add("sentence", _list(textwrap.wrap(answer.sentence, LONGEST_TEXT)))
    for key in ("digest", "versions"):
        table.add(key, getattr(answer, key))
    for key in ("reference", "summation"):
        table.add(key, getattr(question, key))
    if question.settings:
        table.add("settings", _written_settings(question.settings))
    table.add("design", _written_design(question.design))
    for name, (_, key) in _TABLES.items():
        if getattr(question, name) is not None:
            table.add(name, _written_table(getattr(question, name), key))
    return table


def _written_settings(settings: Mapping[str, Any]) -> Table:
    """Return plain values as a table; lists stand one entry a line."""
    table = tomlkit.table()
    for key, value in settings.items():
        if isinstance(value, Mapping):
            table.add(key, _written_settings(value))
        elif isinstance(value, list | tuple) and value and isinstance(value[0], Mapping):
            rows = tomlkit.aot()
            for each in value:
                rows.append(_written_settings(each))
            table.add(key, rows)
        elif isinstance(value, list | tuple):
            table.add(key, _list(value))
        else:
            table.add(key, value)
    return table


def _list(values: Iterable[Any]) -> Array:
    array = tomlkit.array()
    array.extend(values)
    return array.multiline(True)


def _written_design(design: TrackDesign) -> Table:
    table = tomlkit.table()
    for name, key in _DESIGN_KEYS.items():
        value = getattr(design, name)
        if isinstance(value, StiffnessCurve | LossFactorCurve):
            _add_curve(table, _CURVES[name][0], value, _PRELOAD_KEYS.get(name, ""))
        elif value is not None and value != _OPTIONAL.get(name):
            table.add(key, _number(value))
    rail = tomlkit.table()
    for name, key in _RAIL_KEYS.items():
        value = getattr(design.rail, name)
        rail.add(key, value if name == "name" else _number(value))
    _write_axles(table, design)
    table.add("rail", rail)
    for name, (kind, keys) in _PARTS.items():
        part = getattr(design, name)
        if part is not None:
            numbers = zip(keys.values(), (getattr(part, each.name) for each in fields(kind)), strict=True)
            section = tomlkit.table()
            for key, value in numbers:
                if value is not None:
                    section.add(key, _number(value))
            table.add(name, section)
    return table


def _write_axles(table: Table, design: TrackDesign) -> None:
    """Write the axles' positions and the speed, if they are not those of one wheel over a support."""
    if design.axle_positions != ONE_AXLE:
        positions = tomlkit.array()
        positions.extend(_number(each) for each in design.axle_positions)
        table.add(_AXLE_KEYS["axle_positions"], positions)
    if design.speed is not None:
        table.add(_AXLE_KEYS["speed"], _number(design.speed))


def _written_table(levels: BandTable, key: str) -> Table:
    table = tomlkit.table()
    table.add("name", levels.name)
    if levels.points:
        _add_rows(table, key, levels.points, _LEVEL_ROWS)
    if isinstance(levels, Specification):
        _write_meaning(table, levels)
    return table


def _write_meaning(table: Table, specification: Specification) -> None:
    """Write what a specification says beside its levels, as far as it says more than a file without it."""
    if specification.limits != UNSTATED and (specification.is_probably_loss or specification.question):
        table.add("limits", specification.limits)
    if specification.not_judged:
        table.add("not_judged", _list(specification.not_judged))
    if specification.rail_deflection_limit is not None:
        for name, limit in _LIMIT_KEYS.items():
            table.add(limit, _number(getattr(specification, name)))


def _add_rows(table: Table, key: str, points: Iterable[Iterable[float]], comment: str) -> None:
    rows = tomlkit.array()
    for point in points:
        row = tomlkit.array()
        row.extend(_number(value) for value in point)
        rows.add_line(row)
    rows.add_line(indent="")
    table.add(tomlkit.comment(comment))
    table.add(key, rows)


def _add_curve(table: Table, key: str, curve: StiffnessCurve | LossFactorCurve, preload_key: str) -> None:
    """Write what was measured, and its preload if one is stated."""
    _add_rows(table, key, curve.points, _CURVE_ROWS[type(curve)])
    if isinstance(curve, StiffnessCurve) and curve.preload is not None:
        table.add(preload_key, _number(curve.preload))


def _number(value: float) -> Float:
    """Return a float as TOML, exactly, in the form that engineers read: 28e6, not 28000000.0."""
    text = repr(value)
    if not 1e-4 <= abs(value) < 1e5 and value:
        text = Decimal(text).normalize().to_eng_string().replace("E+", "e").replace("E", "e")
    return Float(value, Trivia(), text)
