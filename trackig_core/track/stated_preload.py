"""The preload that a test house's table states: in a comment, a title, a header, or a column of its own.

Newtons. Stiffness of pads and boots is reported with the static load under which it was measured (EN 17495,
EN 13146-9). A curve is of one preload: a table of several is refused, since nothing says which is meant.
"""

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace

from trackig_core.table_text import LINE_ENDS
from trackig_core.track.measured_curves import COLUMNS, MeasurementError, StiffnessCurve
from trackig_core.typed_numbers import NumberError, Unit, find_unit, read_number
from trackig_core.typed_tables import Column, names_frequency, unit_of_header

_WORDS = re.compile(
    r"pre-?\s?load\w*|static load|vorlast|vorbelastung|statische last|pr[ée]charge|precarga|precarico"
    r"|voorbelasting",
    re.IGNORECASE,
)

_FIGURE = re.compile(
    r"(?<![\w.,])([-+\u2212]?(?:\d{1,3}(?:[ '\u00a0\u202f]\d{3})+|\d+)(?:[.,]\d+)*(?:[eE][+-]?\d+)?)"
    r"[\s;|,(\[\"]*([^\s;,|()\[\]\"\d]*)"
)
"""A number, and the word behind it that may be its unit."""

_KILONEWTON_BELOW = 1000.0
"""Figure without a unit below which it is taken to be in kN: no pad is tested under 1000 N or 1000 kN."""

MOST_LISTED = 4
"""Preloads that a message lists [-]."""

_EXAMPLE = "write it as in 'preload: 30 kN'"


@dataclass(frozen=True)
class StatedPreload:
    """A preload that a table states.

    Attributes
    ----------
    value : float
        The preload [N].
    place : str
        Where it stands.
    note : str
        What was assumed; empty if nothing was.
    """

    value: float
    place: str
    note: str = ""

    def put_on(self, curve: StiffnessCurve) -> StiffnessCurve:
        """Return a curve with this preload.

        Parameters
        ----------
        curve : StiffnessCurve
            What the table holds.

        Raises
        ------
        MeasurementError
            If no pad or boot has such a preload; the message names the place.
        """
        try:
            return replace(curve, preload=self.value)
        except MeasurementError as error:
            raise MeasurementError(f"{self.place}: {error.message}") from None


def take_preloads(text: str) -> tuple[str, list[StatedPreload], list[str]]:
    """Find preloads in lines beside a table: comments, titles, headers.

    Parameters
    ----------
    text : str
        The whole file.

    Returns
    -------
    text : str
        The file without lines that state nothing else: they are left empty, so that lines keep their numbers.
    found : list of StatedPreload
        Preloads in the order of the file.
    notes : list of str
        Comments that name a preload which cannot be read.
    """
    lines = LINE_ENDS.split(text)
    found: list[StatedPreload] = []
    notes: list[str] = []
    for number, line in enumerate(lines, start=1):
        before, *segments = _WORDS.split(line)
        stated = [_stated(each, f"line {number}") for each in segments]
        read = [each for each in stated if each is not None]
        found += read
        others = " ".join([before, *(_FIGURE.sub("", each, count=1) for each in segments)])
        if read and not _is_of_table(others):
            lines[number - 1] = ""
        elif segments and not read and line.lstrip(' \t"').startswith("#") and _FIGURE.search(segments[0]):
            notes.append(f"line {number}: the preload is not read; {_EXAMPLE}")
    return "\n".join(lines), found, notes


def _is_of_table(words: str) -> bool:
    """Return whether what else a line says is headers, or the figures of a row."""
    unit = unit_of_header(words)
    is_header = names_frequency(words, unit) or (unit is not None and unit.quantity == "stiffness")
    return is_header or len(_FIGURE.findall(words)) >= len(COLUMNS)


def _stated(words: str, place: str) -> StatedPreload | None:
    """Return the preload that the words behind its name give, or None if they do not give one for certain."""
    figures = [(each[1], each[2], each.start()) for each in _FIGURE.finditer(words)]
    if not figures:
        return None
    number, behind, start = figures[0]
    units = [find_unit(each) if each else None for _, each, _ in figures]
    forces = [each for each in units if each is not None and each.quantity == "force"]
    if len(forces) == 1 and forces[0] == units[0]:
        return _preload(number, units[0], place)
    if forces or behind or len(figures) > 1:
        return None
    unit = unit_of_header(words[:start])
    return _preload(number, unit, place) if unit is None or unit.quantity == "force" else None


def _preload(number: str, unit: Unit | None, place: str) -> StatedPreload | None:
    try:
        value = read_number(number)
    except NumberError:
        return None
    name, note = _unit(unit, [value])
    return StatedPreload(read_number(f"{number} {name}", "N"), place, note)


def _unit(unit: Unit | None, figures: Sequence[float]) -> tuple[str, str]:
    """Return the unit of preloads, and a note if it is assumed."""
    if unit is not None:
        return unit.name, ""
    name = "kN" if max(figures) < _KILONEWTON_BELOW else "N"
    return name, f"no unit of preload is given: {name} is assumed"


def is_preload(column: Column) -> bool:
    """Return whether a column holds preloads: forces, or numbers without a unit."""
    is_named = _WORDS.search(column.header) is not None and not column.is_frequency
    return is_named and (column.unit is None or column.unit.quantity in ("force", "ratio"))


def preloads_of(column: Column) -> list[StatedPreload]:
    """Return the preloads of a column, each once."""
    cells = [each for each in column.cells if each.value is not None]
    units = [column.unit, *(each.unit for each in cells)]
    figures = [each.value for each in cells if each.value is not None]
    name, note = _unit(next(filter(None, units), None), figures)
    values = [read_number(f"{column.value_in(each, name)!r} {name}", "N") for each in cells]
    return [StatedPreload(each, column.words, note) for each in dict.fromkeys(values)]


def one_preload(stated: Sequence[StatedPreload]) -> StatedPreload | None:
    """Return the preload of a table, or None if it states none.

    Parameters
    ----------
    stated : sequence of StatedPreload
        What was found.

    Raises
    ------
    MeasurementError
        If there are several.
    """
    each_once = list({each.value: each for each in stated}.values())
    if len(each_once) > 1:
        listed = [f"{each.value / 1e3:g} kN ({each.place})" for each in each_once]
        more = f" and {len(listed) - MOST_LISTED} more" if len(listed) > MOST_LISTED else ""
        raise MeasurementError(
            f"preloads of {', '.join(listed[:MOST_LISTED])}{more}: a curve is of one; "
            "leave the rows of one, or remove the preloads"
        )
    return stated[0] if stated else None
