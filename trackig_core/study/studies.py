"""A study: what a workshop found, as one TOML file that people read and this module reads back exactly.

A study holds the current design, those pinned beside it, the specification, the source and how they are
looked at. SI units, named in the keys (``pad_stiffness_N_per_m``); levels in dB. Numbers are written with
as many figures as they have, so that what is opened equals what was saved.

A file is hostile until it has been read as a whole. Its size is bounded, what nobody knows is
refused rather than dropped, and an error says where it is and what to do.
"""

import difflib
import tomllib
from dataclasses import dataclass, field, fields
from decimal import Decimal

import tomlkit
from tomlkit.items import Float, Trivia

from trackig_core.levels.band_tables import BandTableError
from trackig_core.levels.insertion_gain import REFERENCES, SUMMATIONS
from trackig_core.levels.source import SourceSpectrum
from trackig_core.levels.specification import Specification
from trackig_core.names import LONGEST_TITLE, allowed, brief, is_name
from trackig_core.track.catalogue import PRESETS
from trackig_core.track.design import TrackDesign
from trackig_core.track.fields import DESIGN_FIELDS, RAIL_FIELDS, DesignError
from trackig_core.track.measured_curves import LossFactorCurve, MeasurementError, StiffnessCurve
from trackig_core.track.rails import Rail

FORMAT = "trackig study"
"""What every file says it is."""

VERSION = 1
"""The version of the format that is written, and the newest that is read."""

MOST_BYTES = 262_144
"""Size that a file may have [bytes]."""

LONGEST_LINE = 200
"""Characters that a line may have, unless it is a comment [-]. Dotted keys cost a reader the square of their
length; with this bound the worst file takes about a second."""

_DESIGN_KEYS = {each.name: each.key for each in DESIGN_FIELDS}
"""Key of each number of a design."""

_RAIL_KEYS = {"name": "name"} | {each.name: each.key for each in RAIL_FIELDS}
"""Key of the name and of each number of a rail."""

_CURVES = {
    "pad_stiffness": ("pad_stiffness_measured", StiffnessCurve),
    "pad_loss_factor": ("pad_loss_factor_measured", LossFactorCurve),
    "boot_stiffness": ("boot_stiffness_measured", StiffnessCurve),
    "boot_loss_factor": ("boot_loss_factor_measured", LossFactorCurve),
}
"""Key and class of what may be given as measured over frequency."""

_CURVE_ROWS = {
    StiffnessCurve: "rows of frequency [Hz], dynamic stiffness [N/m], loss factor [-]",
    LossFactorCurve: "rows of frequency [Hz], loss factor [-]",
}

_LEVEL_ROWS = "rows of one-third-octave band [Hz], level [dB]"

_TABLES = {"specification": (Specification, "ig_max_dB"), "source": (SourceSpectrum, "level_dB")}
"""Class of each table of levels, and the key of its rows."""


class StudyError(ValueError):
    """A study, or the file of one, cannot be used.

    Attributes
    ----------
    path : str
        Keys that lead to what is at fault, such as ``pinned[2].design.rail``; empty if the whole is.
    """

    def __init__(self, message, path=""):
        self.path = path
        self._message = message
        super().__init__(f"{path}: {message}" if path else message)

    def __reduce__(self):
        """Let the error pass between processes."""
        return type(self), (self._message, self.path)


@dataclass(frozen=True)
class View:
    """How insertion gain is computed and compared.

    Parameters
    ----------
    summation : str
        ``"energy"`` or ``"coherent"``.
    reference : str
        ``"line"`` or ``"rigid"``.
    base : int or None
        Number, from 0, of the pinned design from which differences are taken; None: from the current design.

    Raises
    ------
    StudyError
        If a choice is none of these.
    """

    summation: str = "energy"
    reference: str = "line"
    base: int | None = None

    def __post_init__(self):
        """Check every choice once."""
        for name, choices in (("summation", SUMMATIONS), ("reference", REFERENCES)):
            value = getattr(self, name)
            if value not in choices:
                raise StudyError(f"{brief(value)}: give {' or '.join(map(repr, choices))}", f"view.{name}")
        if self.base is not None:
            _check_count(self.base, "view.base")


@dataclass(frozen=True)
class PinnedDesign:
    """A design with a name and a look: the one record of a design that is shown beside others.

    Parameters
    ----------
    name : str
        What it is called.
    design : TrackDesign
        The design.
    colour : int or None
        Number, from 0, of the colour in which an interface draws it; how many colours there are is for the
        interface to know. None: that of the current design.
    shown : bool
        Whether it is drawn, reported and checked.
    preset : str or None
        Key of ``PRESETS`` from which it departs, if from any.
    key : int or None
        Tells it from all others of its session, whatever their names; None for the current design. It is no
        part of a study's file.

    Raises
    ------
    StudyError
        If a value is not allowed.
    """

    name: str
    design: TrackDesign
    colour: int | None = 0
    shown: bool = True
    preset: str | None = None
    key: int | None = field(default=None, compare=False)

    def __post_init__(self):
        """Check every value once."""
        if not is_name(self.name):
            raise StudyError(f"{brief(self.name)}: give {allowed()}", "name")
        if not isinstance(self.design, TrackDesign):
            raise StudyError(f"{brief(self.design)}: give a TrackDesign", "design")
        if self.colour is not None:
            _check_count(self.colour, "colour")
        if not isinstance(self.shown, bool):
            raise StudyError(f"{brief(self.shown)}: give true or false", "shown")
        _check_preset(self.preset)


@dataclass(frozen=True)
class Study:
    """All that is kept and shared.

    Parameters
    ----------
    design : TrackDesign
        The current design.
    pinned : iterable of PinnedDesign
        Up to eight designs beside it.
    specification : Specification or None
        What the designs have to meet.
    source : SourceSpectrum or None
        Levels on the reference track.
    view : View
        How insertion gain is computed and compared.
    name : str
        What the study is called.
    preset : str or None
        Key of ``PRESETS`` from which the current design departs, if from any.

    Raises
    ------
    StudyError
        If a value is not allowed.
    """

    design: TrackDesign
    pinned: tuple[PinnedDesign, ...] = ()
    specification: Specification | None = None
    source: SourceSpectrum | None = None
    view: View = field(default_factory=View)
    name: str = "Study"
    preset: str | None = None

    def __post_init__(self):
        """Check every value once."""
        if not is_name(self.name, LONGEST_TITLE):
            raise StudyError(f"{brief(self.name)}: give {allowed(LONGEST_TITLE)}", "name")
        object.__setattr__(self, "pinned", tuple(self.pinned))
        for name, kind in (("design", TrackDesign), ("view", View)):
            _check_kind(getattr(self, name), kind, name)
        for number, pinned in enumerate(self.pinned):
            _check_kind(pinned, PinnedDesign, f"pinned[{number}]")
            if pinned.colour is None:
                raise StudyError(
                    "None: only the current design has no colour of its own", f"pinned[{number}].colour"
                )
        for name, (kind, _) in _TABLES.items():
            if getattr(self, name) is not None:
                _check_kind(getattr(self, name), kind, name)
        if self.view.base is not None and self.view.base >= len(self.pinned):
            raise StudyError(f"{self.view.base}: there is no such pinned design", "view.base")
        _check_preset(self.preset)

    @classmethod
    def from_toml(cls, data):
        """Read a file.

        Parameters
        ----------
        data : str or bytes
            What the file holds.

        Returns
        -------
        Study
            The study.

        Raises
        ------
        StudyError
            If the file cannot be used; the message says where and why.
        """
        return _study(_Section(_parsed(data)))

    def to_toml(self):
        """Return the study as a file (str), which :meth:`from_toml` reads back exactly.

        Raises
        ------
        StudyError
            If the file would be too large to be read back.
        """
        text = tomlkit.dumps(_document(self))
        size = len(text.encode())
        if size > MOST_BYTES:
            raise StudyError(
                f"the file would have {size // 1024} kB, and {MOST_BYTES // 1024} kB can be read back: "
                "thin out the measured tables, or pin fewer designs that have one"
            )
        return text


def _check_kind(value, kind, path):
    if not isinstance(value, kind):
        raise StudyError(f"{brief(value)}: give a {kind.__name__}", path)


def _check_preset(preset):
    if preset is not None and preset not in tuple(PRESETS):
        raise StudyError(f"{brief(preset)}: give {', '.join(PRESETS)}, or remove it", "preset")


def _check_count(value, path):
    if not isinstance(value, int) or isinstance(value, bool) or value < 0:
        raise StudyError(f"{brief(value)}: give a whole number, 0 or more", path)


class _Section:
    """A table of a file: what is taken is known, and what is left in the end is refused."""

    def __init__(self, values, path=""):
        if not isinstance(values, dict):
            raise StudyError(f"{brief(values)}: give a table of keys and values", path)
        self._values, self.path, self._known = values, path, []

    def under(self, key):
        """Return the path of a key."""
        return f"{self.path}.{key}" if self.path else key

    def take(self, key, otherwise=None):
        """Return the value of a key, or ``otherwise`` if it is not there."""
        self._known.append(key)
        return self._values.get(key, otherwise)

    def need(self, key):
        """Return the value of a key that must be there."""
        value = self.take(key)
        if value is None:
            raise StudyError("it is missing", self.under(key))
        return value

    def section(self, key):
        """Return the table of a key that must be there."""
        return _Section(self.need(key), self.under(key))

    def close(self):
        """Refuse keys that were not taken."""
        for key in self._values:
            if key not in self._known:
                near = difflib.get_close_matches(key, self._known, n=1)
                hint = f"write {near[0]!r}" if near else f"known are {', '.join(self._known)}"
                raise StudyError(f"there is no such key; {hint}, or remove it", self.under(brief(key)[1:-1]))


def _parsed(data):
    """Return a file's tables, or raise a StudyError."""
    if len(data) > MOST_BYTES:
        raise StudyError(f"the file is larger than {MOST_BYTES // 1024} kB: a study is not")
    if isinstance(data, bytes):
        try:
            data = data.decode("utf-8-sig")
        except UnicodeDecodeError as error:
            line = data.count(b"\n", 0, error.start) + 1
            raise StudyError(f"line {line}: this is not UTF-8 text; save the file as UTF-8") from None
    data = data.removeprefix("\N{BYTE ORDER MARK}")
    for number, line in enumerate(data.split("\n"), start=1):
        if len(line) > LONGEST_LINE and not line.lstrip().startswith("#"):
            raise StudyError(f"line {number} has more than {LONGEST_LINE} characters: break it at a comma")
    try:
        return tomllib.loads(data)
    except tomllib.TOMLDecodeError as error:
        raise StudyError(f"this is not TOML: {error}") from None
    except RecursionError:
        raise StudyError("brackets or braces are nested too deep: a study needs two levels") from None
    except ValueError:  # numbers and dates that are TOML, but that Python does not take
        raise StudyError("a number or date is out of all bounds: write numbers of up to 17 figures") from None


def _study(section):
    if section.take("format") != FORMAT:
        raise StudyError(f"this is no study: its first line would be format = {FORMAT!r}")
    _check_version(section.need("version"))
    view = _view(_Section(section.take("view", {}), "view"))
    tables = {name: _table(section, name, *kind) for name, kind in _TABLES.items()}
    pinned = section.take("pinned", [])
    if not isinstance(pinned, list):
        raise StudyError(f"{brief(pinned)}: write each pinned design under [[pinned]]", "pinned")
    study = Study(
        name=section.take("name", Study.name),
        preset=section.take("preset"),
        design=_design(section.section("design")),
        view=view,
        pinned=[_pinned(_Section(each, f"pinned[{number}]")) for number, each in enumerate(pinned)],
        **tables,
    )
    section.close()
    return study


def _check_version(version):
    if isinstance(version, int) and not isinstance(version, bool) and version > VERSION:
        raise StudyError(
            f"{brief(version)}: a newer trackig wrote this file, and this one reads version {VERSION}; "
            "update trackig to open it",
            "version",
        )
    if version != VERSION or not isinstance(version, int) or isinstance(version, bool):
        raise StudyError(f"{brief(version)}: give {VERSION}", "version")


def _view(section):
    view = View(**{each.name: section.take(each.name, each.default) for each in fields(View)})
    section.close()
    return view


def _pinned(section):
    name, design = section.need("name"), _design(section.section("design"))
    colour, shown, preset = section.take("colour", 0), section.take("shown", True), section.take("preset")
    section.close()
    try:
        return PinnedDesign(name, design, colour, shown, preset)
    except StudyError as error:
        raise StudyError(error._message, section.under(error.path)) from None


def _table(study, name, kind, key):
    """Return a specification or source, or None if there is none."""
    if study.take(name) is None:
        return None
    section = study.section(name)
    points, title = section.need(key), section.take("name", kind.name)
    section.close()
    try:
        return kind(points, title)
    except BandTableError as error:
        path = section.path if error.line is None else section.under(key)
        raise StudyError(str(error), path) from None


def _design(section):
    values = {name: section.take(key) for name, key in _DESIGN_KEYS.items()}
    for name, (key, kind) in _CURVES.items():
        points = section.take(key)
        if points is None:
            continue
        if values[name] is not None:
            raise StudyError(f"give this or {_DESIGN_KEYS[name]}, not both", section.under(key))
        try:
            values[name] = kind(points)
        except MeasurementError as error:
            raise StudyError(str(error), section.under(key)) from None
    for part in ("pad", "boot"):
        if (
            isinstance(values[f"{part}_stiffness"], StiffnessCurve)
            and values[f"{part}_loss_factor"] is not None
        ):
            message = f"remove it: {part}_stiffness_measured has loss factors of its own"
            raise StudyError(message, section.under(f"{part}_loss_factor"))
    rail = section.section("rail")
    rail_values = {name: rail.need(key) for name, key in _RAIL_KEYS.items()}
    rail.close()
    section.close()
    rail = _made(Rail, rail_values, _RAIL_KEYS, rail)
    return _made(TrackDesign, {**values, "rail": rail}, _DESIGN_KEYS, section)


def _made(kind, values, keys, section):
    """Return an object of the core, its errors named by the key that the file has for the field."""
    try:
        return kind(**values)
    except DesignError as error:
        what = "it is missing" if error.value is None else brief(error.value)
        raise StudyError(f"{what}: give {error.allowed}", section.under(keys[error.field])) from None


def _document(study):
    document = tomlkit.document()
    document.add(tomlkit.comment("A study of trackig: insertion gain of railway track supports."))
    document.add(tomlkit.comment("SI units, as the keys say; stiffnesses are dynamic stiffnesses at 50 Hz."))
    for key, value in (("format", FORMAT), ("version", VERSION), ("name", study.name)):
        document.add(key, value)
    if study.preset is not None:
        document.add("preset", study.preset)
    document.add("view", _written_view(study.view))
    document.add("design", _written_design(study.design))
    for name, (_, key) in _TABLES.items():
        if getattr(study, name) is not None:
            document.add(name, _written_table(getattr(study, name), key))
    if study.pinned:
        pinned = tomlkit.aot()
        for each in study.pinned:
            pinned.append(_written_pinned(each))
        document.add("pinned", pinned)
    return document


def _written_view(view):
    table = tomlkit.table()
    for each in fields(View):
        if getattr(view, each.name) is not None:
            table.add(each.name, getattr(view, each.name))
    return table


def _written_pinned(pinned):
    table = tomlkit.table()
    for key in ("name", "colour", "shown", "preset"):
        if getattr(pinned, key) is not None:
            table.add(key, getattr(pinned, key))
    table.add("design", _written_design(pinned.design))
    return table


def _written_design(design):
    table = tomlkit.table()
    for name, key in _DESIGN_KEYS.items():
        value = getattr(design, name)
        if isinstance(value, StiffnessCurve | LossFactorCurve):
            _add_rows(table, _CURVES[name][0], value.points, _CURVE_ROWS[type(value)])
        elif value is not None:
            table.add(key, _number(value))
    rail = tomlkit.table()
    for name, key in _RAIL_KEYS.items():
        value = getattr(design.rail, name)
        rail.add(key, value if name == "name" else _number(value))
    table.add("rail", rail)
    return table


def _written_table(levels, key):
    table = tomlkit.table()
    table.add("name", levels.name)
    _add_rows(table, key, levels.points, _LEVEL_ROWS)
    return table


def _add_rows(table, key, points, comment):
    rows = tomlkit.array()
    for point in points:
        row = tomlkit.array()
        row.extend(_number(value) for value in point)
        rows.add_line(row)
    rows.add_line(indent="")
    table.add(tomlkit.comment(comment))
    table.add(key, rows)


def _number(value):
    """Return a float as TOML, exactly, in the form that engineers read: 28e6, not 28000000.0."""
    text = repr(value)
    if not 1e-4 <= abs(value) < 1e5 and value:
        text = Decimal(text).normalize().to_eng_string().replace("E+", "e").replace("E", "e")
    return Float(value, Trivia(), text)
