"""One level per one-third-octave band, as a user gives it: rows of a table, or a CSV file.

Hz, dB. A CSV file has two columns, ``frequency_hz`` and the level. It may have a header, lines that begin
with ``#``, and blank lines; an empty level leaves its band out. Commas, semicolons or tabs separate; after
semicolons or tabs a decimal comma is read too, as European spreadsheets write it. Bands: IEC 61260-1.

A table that exists is sound. A file is read as a whole or refused as a whole, and the
message names line and column.
"""

import csv
import io
import math
import numbers
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar, Self

import numpy as np

from trackig_core.arrays import RealArray
from trackig_core.bands import BAND_CENTRES, BAND_LABELS
from trackig_core.names import LONGEST_TITLE, allowed, brief, is_name

FREQUENCY_COLUMN = "frequency_hz"
"""Header of the first column."""

NOMINAL = tuple(float(label) for label in BAND_LABELS)
"""Nominal mid-band frequencies (21,) [Hz]."""

TOLERANCE = 0.02
"""Relative distance from the nominal or exact mid-band frequency within which a band is meant [-]: it lets
base-two centres pass, and bands lie 26 % apart."""

MOST_BYTES = 65536
"""Size that a CSV file may have [bytes]."""

MOST_LINES = 1000
"""Lines that a CSV file may have [-]."""

_NUMBER = re.compile(r"[+-]?(\d{1,20}(\.\d{0,20})?|\.\d{1,20})([eE][+-]?\d{1,3})?", re.ASCII)

_SPACED = re.compile("[ ]*[0-9.,]{0,19}[0-9][ ]+[-+\N{MINUS SIGN}]?[0-9.,]{1,20}[ ]*")
"""Two numbers with nothing but spaces between them, as copied from a letter or a PDF."""


class BandTableError(ValueError):
    """A table of levels per band cannot be used.

    Attributes
    ----------
    line, column : int or None
        Where, both counted from 1: the line of a file, or the row of a table; None if no place is at fault.
    """

    def __init__(
        self, message: str, line: int | None = None, column: int | None = None, counted: str = "line"
    ) -> None:
        self.line, self.column = line, column
        self._given = message, line, column, counted
        places = ((counted, line), ("column", column))
        where = ", ".join(f"{word} {number}" for word, number in places if number is not None)
        super().__init__(f"{where}: {message}" if where else message)

    def __reduce__(self) -> tuple[type, tuple[str, int | None, int | None, str]]:
        """Let the error pass between processes."""
        return type(self), self._given


@dataclass(frozen=True)
class Quantity:
    """What the levels of a table are.

    Attributes
    ----------
    column : str
        Header of its column in a CSV file.
    words : str
        What it is, for people.
    low, high : float
        Least and greatest level [dB].
    error : type
        The :class:`BandTableError` that is raised.
    """

    column: str
    words: str
    low: float
    high: float
    error: type[BandTableError]

    @property
    def allowed(self) -> str:
        """What may be given for a level."""
        return f"a number from {self.low:g} to {self.high:g} dB"


@dataclass(frozen=True)
class BandTable:
    """Levels of some of the bands; its subclasses say of what.

    Parameters
    ----------
    points : iterable of (float, float)
        Rows of mid-band frequency [Hz], nominal or exact, and level [dB], in any order; one band or more,
        each once.
    name : str
        Name of the table.

    Raises
    ------
    BandTableError
        If a row is no pair of numbers within their ranges, or there is no row.
    """

    points: tuple[tuple[float, float], ...]
    name: str

    quantity: ClassVar[Quantity]

    def __post_init__(self) -> None:
        """Check every row once; frequencies become nominal, rows ascend."""
        error = self.quantity.error
        if not is_name(self.name, LONGEST_TITLE):
            raise error(f"name = {brief(self.name)}: give {allowed(LONGEST_TITLE)}")
        object.__setattr__(self, "points", _checked(_rows(self.points, self.quantity), self.quantity, "row"))

    @classmethod
    def from_csv(cls, data: str | bytes, name: str | None = None) -> Self:
        """Read a CSV file.

        Parameters
        ----------
        data : str or bytes
            What the file holds.
        name : str, optional
            Name of the table.

        Returns
        -------
        BandTable
            An object of this class.

        Raises
        ------
        BandTableError
            If the file cannot be used; its ``line`` and ``column`` say where.
        """
        points = _checked(_read(data, cls.quantity), cls.quantity, "line")
        return cls(points) if name is None else cls(points, name)  # type: ignore[call-arg]  # subclasses name themselves

    def to_csv(self) -> str:
        """Return the table as a CSV file (str), which :meth:`from_csv` reads back exactly."""
        return _written(self.quantity, self.points)

    @classmethod
    def template_csv(cls) -> str:
        """Return a CSV file (str) of all bands, their levels left to be filled in."""
        quantity = cls.quantity
        explained = (
            f"# {quantity.words}, dB, per one-third-octave band (IEC 61260-1)\n"
            "# Fill in the second column; bands without a value are left out.\n"
        )
        return explained + _written(quantity, [(frequency, "") for frequency in NOMINAL])

    @property
    def levels(self) -> RealArray:
        """Level per band (21,) [dB], NaN where there is none."""
        levels = np.full(BAND_CENTRES.size, np.nan)
        for frequency, level in self.points:
            levels[NOMINAL.index(frequency)] = level
        return levels


def _written(quantity: Quantity, points: Iterable[tuple[float, float | str]]) -> str:
    lines = [f"{FREQUENCY_COLUMN},{quantity.column}"]
    lines += [f"{frequency:g},{level}" for frequency, level in points]
    return "\n".join(lines) + "\n"


def _rows(points: Iterable[Iterable[Any]], quantity: Quantity) -> list[tuple[int, Any, Any]]:
    """Return given rows as (number, frequency, level)."""
    columns = f"{FREQUENCY_COLUMN}, {quantity.column}"
    try:
        rows = [tuple(row) for row in points]
    except TypeError:
        raise quantity.error(f"give rows of {columns}") from None
    for number, row in enumerate(rows, start=1):
        if len(row) != 2:
            raise quantity.error(f"{len(row)} values: give {columns}", number, counted="row")
    return [(number, *row) for number, row in enumerate(rows, start=1)]


def _checked(
    rows: Iterable[tuple[int, Any, Any]], quantity: Quantity, counted: str
) -> tuple[tuple[float, float], ...]:
    """Return (line, frequency, level) as points in the order of the bands, or raise the quantity's error."""
    found: dict[int, tuple[int, float]] = {}
    for line, frequency, level in rows:
        band = _band(frequency)
        if band is None:
            raise quantity.error(_unknown_band(frequency), line, 1, counted)
        verified = _number(level)
        if verified is None or not quantity.low <= verified <= quantity.high:
            message = f"{quantity.column} = {brief(level)}: give {quantity.allowed}"
            raise quantity.error(message, line, 2, counted)
        if band in found:
            message = (
                f"the band {BAND_LABELS[band]} Hz stands in {counted} {found[band][0]} already: "
                "give each band once"
            )
            raise quantity.error(message, line, 1, counted)
        found[band] = line, verified
    if not found:
        raise quantity.error(f"no band has a value: give at least one row of {FREQUENCY_COLUMN} and level")
    return tuple((NOMINAL[band], found[band][1]) for band in sorted(found))


def _number(value: object) -> float | None:
    """Return a real, finite number as a float, else None; a bool is not a number."""
    if not isinstance(value, numbers.Real) or isinstance(value, bool):
        return None
    try:
        number = float(value)
    except OverflowError:
        return None
    return number if math.isfinite(number) else None


def _band(frequency: object) -> int | None:
    """Return the index of the band that a frequency [Hz] names, or None."""
    number = _number(frequency)
    if number is None:
        return None
    for band, centres in enumerate(zip(NOMINAL, BAND_CENTRES, strict=True)):
        if any(abs(number / centre - 1) <= TOLERANCE for centre in centres):
            return band
    return None


def _unknown_band(frequency: object) -> str:
    shown = f"{FREQUENCY_COLUMN} = {brief(frequency)}"
    number = _number(frequency)
    if number is None or not NOMINAL[0] <= number <= NOMINAL[-1]:
        bands = f"{BAND_LABELS[0]} to {BAND_LABELS[-1]} Hz"
        return f"{shown}: give the mid-band frequency of a one-third-octave band, {bands}"
    near = BAND_LABELS[int(np.argmin(np.abs(np.log(BAND_CENTRES / number))))]
    return f"{shown} is the middle of no one-third-octave band: the nearest is {near} Hz"


def _read(data: str | bytes, quantity: Quantity) -> list[tuple[int, Any, Any]]:
    """Return the rows of a CSV file as (line, frequency, level), those without a level left out."""
    lines = re.split("\r\n|\r|\n", _decoded(data, quantity.error))
    if len(lines) > MOST_LINES:
        raise quantity.error(f"{len(lines)} lines: give at most {MOST_LINES}")
    full = [(number, line) for number, line in enumerate(lines, start=1) if not _is_empty(line)]
    separator = _separator(full[0][1]) if full else ","
    cells = [(number, _cells(line, separator)) for number, line in full]
    if cells and _parsed(cells[0][1][0], separator) is None:
        _check_header(*cells.pop(0), quantity)
    rows: list[tuple[int, Any, Any]] = []
    for number, row in cells:
        if len(row) > 2:
            message = (
                f"{len(row)} values: give {FREQUENCY_COLUMN} and {quantity.column} alone; "
                "if numbers have decimal commas, separate them by semicolons"
            )
            raise quantity.error(message, number, 3)
        frequency, *level = (_parsed(cell, separator, cell) for cell in row)
        if _band(frequency) is None:
            raise quantity.error(_unknown_band(frequency), number, 1)
        if level:
            rows.append((number, frequency, level[0]))
    return rows


def _separator(line: str) -> str:
    """Return what separates the columns of a table that begins with a line."""
    if _SPACED.fullmatch(line):
        return " "
    return next((each for each in "\t;" if each in line), ",")


def _decoded(data: str | bytes, error: type[BandTableError]) -> str:
    """Return a file's text."""
    if len(data) > MOST_BYTES:
        raise error(f"the file is larger than {MOST_BYTES // 1024} kB: a table has one short line per band")
    text = data if isinstance(data, str) else _text(data)
    if text is None or "\0" in text:
        raise error("this is not a text file: save the table as CSV")
    return text.removeprefix("\N{BYTE ORDER MARK}")


def _text(data: bytes) -> str | None:
    """Return what bytes say, or None if they are no text."""
    # spreadsheets write UTF-16 with a mark, or a national code, whose figures are plain all the same
    for code in ("utf-16",) if data[:2] in (b"\xff\xfe", b"\xfe\xff") else ("utf-8-sig", "latin-1"):
        try:
            return data.decode(code)
        except UnicodeDecodeError:
            continue
    return None


def _is_empty(line: str) -> bool:
    """Return whether a line is blank or a comment."""
    return not line.strip(" \t;,") or line.lstrip(' \t"').startswith("#")


def _cells(line: str, separator: str) -> list[str]:
    """Return the cells of a line without empty ones at its end; the first stays."""
    if separator == " ":
        return line.split()
    cells = [cell.strip() for cell in next(csv.reader(io.StringIO(line), delimiter=separator))]
    while len(cells) > 1 and not cells[-1]:
        cells.pop()
    return cells


def _parsed(cell: str, separator: str, otherwise: str | None = None) -> float | str | None:
    """Return the number that a cell holds, else ``otherwise``."""
    text = cell.replace("\N{MINUS SIGN}", "-")
    if separator != "," and "." not in text:
        text = text.replace(",", ".")
    return float(text) if _NUMBER.fullmatch(text) else otherwise


def _check_header(line: int, cells: Sequence[str], quantity: Quantity) -> None:
    wanted = (FREQUENCY_COLUMN, quantity.column)
    for column, name in enumerate(wanted, start=1):
        given = cells[column - 1] if len(cells) >= column else ""
        if given.casefold() != name:
            message = f"{brief(given)} where {name!r} is due: begin the file with {','.join(wanted)}"
            raise quantity.error(message, line, column)
