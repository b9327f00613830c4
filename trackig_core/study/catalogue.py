"""A catalogue of named components that a company keeps: rails, pads, blocks and boots, each with its source.

One TOML file, SI units as the keys say. A pad or boot has a stiffness and a loss factor, or measured curves,
and its static stiffness where that is known. :func:`bundled_catalogue` holds the components of the paper's
Table 1 and the known rail sections.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from functools import cache
from importlib.resources import files
from typing import Any

import tomlkit
from tomlkit.items import Table

from trackig_core.names import LONGEST_TITLE, allowed, brief, is_name
from trackig_core.study.records import StudyError
from trackig_core.study.toml_format import (
    _RAIL_KEYS,
    _add_curve,
    _curve,
    _made,
    _number,
    _parsed,
    _Section,
)
from trackig_core.track.design import REFERENCE_FREQUENCY, TrackDesign
from trackig_core.track.fields import DesignError, check_number, values_in_words
from trackig_core.track.measured_curves import LossFactorCurve, StiffnessCurve
from trackig_core.track.rails import RAILS, STEEL_MODULUS, Rail
from trackig_core.track.viscoelastic_law import relaxation
from trackig_core.words import counted

FORMAT = "trackig catalogue"
"""What every file says it is."""

VERSION = 1
"""The version of the format that is written and read."""

KINDS = ("rail", "pad", "block", "boot")
"""Kinds of component, from the top down."""

LONGEST_SOURCE = 200
"""Characters that a source may have [-]."""

_SPRING_KEYS = {
    "stiffness": "stiffness_N_per_m",
    "loss_factor": "loss_factor",
    "static_stiffness": "static_stiffness_N_per_m",
}
"""Key of each number of a pad or boot, by the end of the design's field."""

_CURVE_KEYS: dict[str, tuple[str, type[StiffnessCurve] | type[LossFactorCurve]]] = {
    "stiffness": ("stiffness_measured", StiffnessCurve),
    "loss_factor": ("loss_factor_measured", LossFactorCurve),
}
"""Key and class of what may be given as measured over frequency."""

_PRELOAD_KEY = "preload_N"

_FREQUENCY_KEY = "stiffness_frequency_Hz"

_SECOND_MOMENT_KEY = "second_moment_cm4"


@dataclass(frozen=True)
class Component:
    """A rail, pad, block or boot with a name.

    Attributes
    ----------
    kind : str
        One of :data:`KINDS`.
    name : str
        What it is called.
    values : Mapping
        Values by field of a :class:`trackig_core.TrackDesign` [SI units].
    source : str
        Where its figures are from.
    stiffness_frequency : float
        Frequency at which its dynamic stiffness holds [Hz].
    """

    kind: str
    name: str
    values: Mapping[str, Any] = field(hash=False)
    source: str
    stiffness_frequency: float = REFERENCE_FREQUENCY

    def fitted_to(self, design: TrackDesign) -> TrackDesign:
        """Return a design with this component in it.

        A stiffness that is stated at another frequency than the design's is restated there, by the law of its
        loss factor.

        Parameters
        ----------
        design : TrackDesign
            The track.

        Returns
        -------
        TrackDesign
            The changed design.

        Raises
        ------
        DesignError
            If a block or boot is fitted to a single-stage track.
        """
        values = dict(self.values)
        if self.kind in ("block", "boot") and not design.two_stage:
            allowed_on = "a two-stage track: a single-stage one has no block or boot"
            raise DesignError(self.kind, self.name, allowed_on)
        name = f"{self.kind}_stiffness"
        stiffness = values.get(name)
        if isinstance(stiffness, float) and self.stiffness_frequency != design.stiffness_frequency:
            law = relaxation(stiffness, values[f"{self.kind}_loss_factor"], self.stiffness_frequency)
            values[name] = law.stiffness(design.stiffness_frequency)
        return design.replace(**values)

    def choice(self, design: TrackDesign) -> dict[str, Any]:
        """Return this component as one that :func:`trackig_core.decide.find` may choose for a design.

        Parameters
        ----------
        design : TrackDesign
            The track; a stiffness that is stated at another frequency than its own is restated there.

        Returns
        -------
        dict
            Plain values [SI units], as a question and its file hold them: the name as ``"component"``, fields
            that are known, curves as lists of rows, or as dicts of ``"points"`` and ``"preload"``, a known
            rail by its name.

        Raises
        ------
        DesignError
            If the track has no place for it.
        """
        fitted = self.fitted_to(design)
        given = {name: getattr(fitted, name) for name, value in self.values.items() if value is not None}
        return {"component": self.name, **{name: _plain(value) for name, value in given.items()}}

    def __str__(self) -> str:
        """Return kind, name, values with their units, and source."""
        return f"{self.kind} {self.name}: {', '.join(values_in_words(self.values))} ({self.source})"


def _plain(value: Any) -> Any:
    """Return the value of a field as numbers, texts, and lists and dicts of them."""
    if isinstance(value, Rail):
        return value.name if RAILS.get(value.name) == value else asdict(value)
    if isinstance(value, StiffnessCurve | LossFactorCurve):
        rows = [list(row) for row in value.points]
        preload = getattr(value, "preload", None)
        return rows if preload is None else {"points": rows, "preload": preload}
    return value


@dataclass(frozen=True)
class Catalogue:
    """Named components.

    Parameters
    ----------
    name : str
        What the catalogue is called.
    components : iterable of Component
        Its components; names are unique within a kind.

    Raises
    ------
    StudyError
        If a name is none, or is given twice.
    """

    name: str
    components: tuple[Component, ...] = ()

    def __post_init__(self) -> None:
        """Check every name once."""
        _check_name(self.name, "name", LONGEST_TITLE)
        object.__setattr__(self, "components", tuple(self.components))
        seen: set[tuple[str, str]] = set()
        for component in self.components:
            key = component.kind, component.name
            if key in seen:
                message = f"{brief(component.name)}: there is a {component.kind} of that name already"
                raise StudyError(message, component.kind)
            seen.add(key)

    def of_kind(self, kind: str) -> dict[str, Component]:
        """Return the components of a kind by name, in order.

        Parameters
        ----------
        kind : str
            One of :data:`KINDS`.

        Returns
        -------
        dict of str to Component
            The components.

        Raises
        ------
        ValueError
            If there is no such kind.
        """
        if kind not in KINDS:
            raise ValueError(f"kind = {kind!r}: give {' or '.join(map(repr, KINDS))}")
        return {each.name: each for each in self.components if each.kind == kind}

    @classmethod
    def from_toml(cls, data: str | bytes) -> Catalogue:
        """Read a file.

        Parameters
        ----------
        data : str or bytes
            What the file holds.

        Returns
        -------
        Catalogue
            The catalogue.

        Raises
        ------
        StudyError
            If the file cannot be used; the message says where and why.
        """
        section = _Section(_parsed(data))
        if section.take("format") != FORMAT:
            raise StudyError(f"this is no catalogue: its first line would be format = {FORMAT!r}")
        version = section.need("version")
        if version != VERSION or isinstance(version, bool):
            raise StudyError(f"{brief(version)}: give {VERSION}, or update trackig", "version")
        name, components = section.need("name"), []
        for kind in KINDS:
            given = section.take(kind, [])
            if not isinstance(given, list):
                raise StudyError(f"{brief(given)}: write each {kind} under [[{kind}]]", kind)
            components += [_read(kind, _Section(each, f"{kind}[{i}]")) for i, each in enumerate(given)]
        section.close()
        return cls(name, tuple(components))

    def to_toml(self) -> str:
        """Return the catalogue as a file (str), which :meth:`from_toml` reads back exactly."""
        document = tomlkit.document()
        document.add(tomlkit.comment("A catalogue of trackig: components of track supports. SI units."))
        for key, value in (("format", FORMAT), ("version", VERSION), ("name", self.name)):
            document.add(key, value)
        for kind in KINDS:
            tables = tomlkit.aot()
            for component in self.of_kind(kind).values():
                tables.append(_written(component))
            if len(tables):
                document.add(kind, tables)
        return tomlkit.dumps(document)

    def __str__(self) -> str:
        """Return name, and how many components of each kind there are."""
        kinds = (counted(len(self.of_kind(kind)), kind) for kind in KINDS if self.of_kind(kind))
        return f"{self.name}: {', '.join(kinds) or 'no component'}"


@cache
def bundled_catalogue() -> Catalogue:
    """Return the catalogue that comes with the package: the paper's Table 1 and known rail sections."""
    return Catalogue.from_toml((files("trackig_core.study") / "data" / "catalogue.toml").read_bytes())


def _check_name(name: object, path: str, longest: int) -> None:
    if not is_name(name, longest):
        raise StudyError(f"{brief(name)}: give {allowed(longest)}", path)


def _read(kind: str, section: _Section) -> Component:
    """Return the component of a table."""
    name, source = section.need("name"), section.need("source")
    _check_name(name, section.under("name"), LONGEST_TITLE)
    _check_name(source, section.under("source"), LONGEST_SOURCE)
    frequency = REFERENCE_FREQUENCY
    if kind == "rail":
        values: dict[str, Any] = {"rail": _rail(name, section)}
    elif kind == "block":
        values = {"block_mass": _checked("block_mass", "mass_kg", section.need("mass_kg"), section)}
    else:
        values = _spring(kind, section)
        stated = section.take(_FREQUENCY_KEY)
        if stated is not None:
            frequency = _checked("stiffness_frequency", _FREQUENCY_KEY, stated, section)
    section.close()
    return Component(kind, name, values, source, frequency)


def _rail(name: str, section: _Section) -> Rail:
    """Return a rail by its bending stiffness, or by the second moment of its steel section."""
    values = {field: section.take(key) for field, key in _RAIL_KEYS.items()} | {"name": name}
    moment = section.take(_SECOND_MOMENT_KEY)
    if moment is not None:
        if values["bending_stiffness"] is not None:
            message = f"give this or {_RAIL_KEYS['bending_stiffness']}, not both"
            raise StudyError(message, section.under(_SECOND_MOMENT_KEY))
        if isinstance(moment, bool) or not isinstance(moment, int | float):
            raise StudyError(f"{brief(moment)}: give a number of cm4", section.under(_SECOND_MOMENT_KEY))
        values["bending_stiffness"] = STEEL_MODULUS * moment * 1e-8
    return _made(Rail, values, _RAIL_KEYS, section)


def _spring(kind: str, section: _Section) -> dict[str, Any]:
    """Return the fields of a pad or boot."""
    values: dict[str, Any] = {}
    for name, key in _SPRING_KEYS.items():
        value = section.take(key)
        if name in _CURVE_KEYS:
            curve_key, curve_kind = _CURVE_KEYS[name]
            curve = _curve(section, curve_key, curve_kind, _PRELOAD_KEY if name == "stiffness" else None)
            if curve is not None and value is not None:
                raise StudyError(f"give this or {key}, not both", section.under(curve_key))
            value = curve or value
        is_number = value is not None and not isinstance(value, StiffnessCurve | LossFactorCurve)
        values[f"{kind}_{name}"] = _checked(f"{kind}_{name}", key, value, section) if is_number else value
    measured = isinstance(values[f"{kind}_stiffness"], StiffnessCurve)
    if values[f"{kind}_stiffness"] is None:
        raise StudyError("it is missing", section.under(_SPRING_KEYS["stiffness"]))
    if measured == (values[f"{kind}_loss_factor"] is not None):
        what = "remove it: stiffness_measured has loss factors of its own" if measured else "it is missing"
        raise StudyError(what, section.under(_SPRING_KEYS["loss_factor"]))
    return values


def _checked(field_name: str, key: str, value: object, section: _Section) -> float:
    """Return a number of a field, its error named by the key that the file has for it."""
    try:
        return check_number(field_name, value)
    except DesignError as error:
        raise StudyError(f"{brief(value)}: give {error.allowed}", section.under(key)) from None


def _written(component: Component) -> Table:
    table = tomlkit.table()
    table.add("name", component.name)
    values = component.values
    if component.kind == "rail":
        for name, key in _RAIL_KEYS.items():
            if name != "name":
                table.add(key, _number(getattr(values["rail"], name)))
    elif component.kind == "block":
        table.add("mass_kg", _number(values["block_mass"]))
    else:
        for name, key in _SPRING_KEYS.items():
            value = values[f"{component.kind}_{name}"]
            if isinstance(value, StiffnessCurve | LossFactorCurve):
                _add_curve(table, _CURVE_KEYS[name][0], value, _PRELOAD_KEY)
            elif value is not None:
                table.add(key, _number(value))
        if component.stiffness_frequency != REFERENCE_FREQUENCY:
            table.add(_FREQUENCY_KEY, _number(component.stiffness_frequency))
    table.add("source", component.source)
    return table
