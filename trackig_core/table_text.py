"""From the bytes of a pasted or saved table to its cells: encoding, lines, what separates the cells, numbers.

What the rows and columns mean is found by :mod:`trackig_core.typed_tables`.
"""

import csv
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from itertools import pairwise

from trackig_core.names import brief
from trackig_core.typed_numbers import NumberError, Unit, decimal_mark, find_unit, read_quantity

MOST_BYTES = 65536
"""Size that a file may have [bytes]."""

MOST_LINES = 1000
"""Lines that a file may have [-]."""

LONGEST_LINE = 1000
"""Characters that a line may have [-]."""

MOST_CELLS = 6000
"""Cells that a table may have, or words of text between spaces [-]."""

SAMPLE = 30
"""Lines from which it is told what separates the cells [-]."""

SEPARATORS = ("\t", ";", "|", ",", ":", "=", " ")
"""What may separate cells, first what is least likely to be part of one."""

AT_MOST, AT_LEAST = "at most", "at least"
"""Bounds that a sign or word before a number makes of it."""

_BOUNDS = {
    **dict.fromkeys(("<=", "=<", "<", "≤", "≦", "⩽", "max", "max."), AT_MOST),
    **dict.fromkeys((">=", "=>", ">", "≥", "≧", "⩾", "min", "min."), AT_LEAST),
}

_BOUND = re.compile("(" + "|".join(map(re.escape, sorted(_BOUNDS, key=len, reverse=True))) + r")\s*(?=\S)")

_NOTHING = {"", ".", "..", "...", "…", "/", "n/a", "na", "n.a.", "k.a.", "k. a.", "none"}
"""What people write in a cell without a value, beside dashes."""

LINE_ENDS = re.compile("\r\n|[\r\n\u2028\u2029]")
"""What ends a line of a file."""

_ROW_ENDS = (re.compile(";"), re.compile(r",\s"))
"""What may end the rows of a table that is written in one line."""

_DASHES = re.compile("[-:\u2010-\u2015\u2212_]*")

_LIKE_A_NUMBER = re.compile(r"[-+.,\u2010-\u2015\u2212\u00ad]*\d")

_FORMATS = {b"PK\x03\x04": "an Excel workbook", b"\xd0\xcf\x11\xe0": "an Excel workbook", b"%PDF": "a PDF"}
"""How files begin that people take for tables."""


class TableError(ValueError):
    """A table cannot be used.

    Attributes
    ----------
    line, column : int or None
        Where, both counted from 1: the line of a file, or the row of a table; None if no place is at fault.
    """

    def __init__(
        self, message: str, line: int | None = None, column: int | None = None, counted: str = "line"
    ) -> None:
        self.line, self.column = line, column
        self.message, self._counted = message, counted
        places = ((counted, line), ("column", column))
        where = ", ".join(f"{word} {number}" for word, number in places if number is not None)
        super().__init__(f"{where}: {message}" if where else message)

    def __reduce__(self) -> tuple[type, tuple[str, int | None, int | None, str]]:
        """Let the error pass between processes."""
        return type(self), (self.message, self.line, self.column, self._counted)


@dataclass(frozen=True)
class Cell:
    """One cell of a table.

    Attributes
    ----------
    text : str
        What stands there.
    line, column : int
        Where in the file, both counted from 1.
    value : float or None
        Its number [unit]; None if it holds none.
    unit : Unit or None
        The unit that stands behind the number.
    bound : str
        :data:`AT_MOST` or :data:`AT_LEAST` if the number is one; else empty.
    fault : str
        Why text that looks like a number is none; else empty.
    """

    text: str
    line: int
    column: int
    value: float | None = None
    unit: Unit | None = None
    bound: str = ""
    fault: str = ""

    @property
    def is_blank(self) -> bool:
        """Whether nothing is given: no text, a dash, n/a."""
        return self.text.casefold() in _NOTHING or _DASHES.fullmatch(self.text) is not None

    @property
    def is_words(self) -> bool:
        """Whether the cell holds text that is meant as such."""
        return self.value is None and not self.is_blank and not self.fault


Row = tuple[Cell, ...]


def read_cells(data: str | bytes, undecided: str | None = None) -> list[Row]:
    """Return the cells of a table, line by line, without empty lines and comments.

    Parameters
    ----------
    data : str or bytes
        What the file holds.
    undecided : str, optional
        Decimal mark, ``","`` or ``"."``, of numbers such as ``1,200`` if no other number of the table tells.

    Returns
    -------
    list of tuple of Cell
        Rows, which need not be of one length.

    Raises
    ------
    TableError
        If the data are no text, or too much of it.
    """
    lines = _lines(decoded(data))
    if len(lines) == 1:
        lines = _rows_of(*lines[0])
    separator = _separator(lines[:SAMPLE])
    count = sum(len(line.split(separator or None)) for _, line in lines)
    if count > MOST_CELLS:
        raise TableError(f"{count} cells: give at most {MOST_CELLS}")
    rows = list(_split(lines, separator))
    if separator == " ":
        _check_loose_signs(rows)
    marks = {decimal_mark(cell.text) for row in rows for cell in row} - {None}
    decimal = marks.pop() if len(marks) == 1 else undecided
    return [tuple(parsed(cell, decimal) for cell in row) for row in rows]


def decoded(data: str | bytes) -> str:
    """Return a file's text.

    Parameters
    ----------
    data : str or bytes
        What the file holds, in UTF-8, UTF-16 or the code of Western Windows.

    Raises
    ------
    TableError
        If the data are no text, or too much of it.
    """
    if len(data) > MOST_BYTES:
        raise TableError(f"the file is larger than {MOST_BYTES // 1024} kB: give a table alone")
    text = data if isinstance(data, str) else _text(data)
    if text is None or "\0" in text:
        raise TableError("this is not a text file: save the table as CSV, or copy its cells")
    return text.removeprefix("\N{BYTE ORDER MARK}")


def _text(data: bytes) -> str | None:
    """Return what bytes say, or None if they are no text."""
    for begins, what in _FORMATS.items():
        if data.startswith(begins):
            raise TableError(f"this is {what}, not a text file: save the table as CSV, or copy its cells")
    # spreadsheets write UTF-16 with a mark, UTF-8, or the code of Western Windows
    wide = data[:2] in (b"\xff\xfe", b"\xfe\xff")
    for code in ("utf-16",) if wide else ("utf-8-sig", "cp1252", "latin-1"):
        try:
            return data.decode(code)
        except UnicodeDecodeError:
            continue
    return None


def _lines(text: str) -> list[tuple[int, str]]:
    """Return the lines that hold anything, with their numbers."""
    lines = LINE_ENDS.split(text)
    while lines and not lines[-1].strip():
        lines.pop()
    if len(lines) > MOST_LINES:
        raise TableError(f"{len(lines)} lines: give at most {MOST_LINES}")
    for number, line in enumerate(lines, start=1):
        if len(line) > LONGEST_LINE:
            raise TableError(f"{len(line)} characters: give at most {LONGEST_LINE} a line", number)
    # the first line of some spreadsheets' files names the separator
    return [
        (number, line)
        for number, line in enumerate(lines, start=1)
        if line.strip(" \t;,|") and not re.match(r'[ \t"]*#|sep=.$', line)
    ]


def _rows_of(number: int, line: str) -> list[tuple[int, str]]:
    """Return the rows that a lone line holds, such as ``31.5 3; 63 10``; as a rule it is one itself."""
    for end in _ROW_ENDS:
        rows = [(number, part) for part in end.split(line) if part.strip()]
        numbers = [_numbers_alone(row) for row in rows]
        if len(rows) > 1 and min(numbers) == max(numbers) > 1:
            return rows
    return [(number, line)]


def _numbers_alone(row: tuple[int, str]) -> int:
    """Return how many numbers a row is made of, none where it holds anything else."""
    cells = [parsed(cell, ",") for cell in next(_split([row], _separator([row])))]
    return len(cells) if all(cell.value is not None for cell in cells) else 0


def _separator(lines: list[tuple[int, str]]) -> str:
    """Return what separates the cells of lines; empty if there is one column."""
    found = {each: _evidence(lines, each) for each in SEPARATORS if any(each in line for _, line in lines)}
    best = max(found, key=lambda each: found[each], default="")
    return best if best and any(found[best]) else ""


def _evidence(lines: list[tuple[int, str]], separator: str) -> tuple[int, int]:
    """Return how many lines have several numbers, and cells, if they are separated so."""
    rows = [[parsed(cell, ",") for cell in row] for row in _split(lines, separator)]
    clean = [row for row in rows if not any(cell.fault for cell in row)]
    numbers = sum(sum(cell.value is not None for cell in row) > 1 for row in clean)
    # colons, equals signs and spaces are part of plain text too
    return numbers, 0 if separator in ":= " else sum(len(row) > 1 for row in rows)


def _split(lines: list[tuple[int, str]], separator: str) -> Iterator[Row]:
    """Return the cells of lines, their numbers not yet read."""
    if separator == " ":
        for number, line in lines:
            yield _row(number, spaced(line))
    elif separator and any('"' in line for _, line in lines):
        # a quoted cell may run over several lines
        reader = csv.reader((line + "\n" for _, line in lines), delimiter=separator)
        first = 0
        for texts in reader:
            yield _row(lines[first][0], texts)
            first = reader.line_num
    else:
        for number, line in lines:
            yield _row(number, line.split(separator) if separator else [line.strip().strip('"')])


def _row(line: int, texts: Iterable[str]) -> Row:
    """Return the cells of a line without empty ones at its end."""
    cells = [Cell(" ".join(text.split()), line, column) for column, text in enumerate(texts, start=1)]
    while len(cells) > 1 and not cells[-1].text:
        cells.pop()
    return tuple(cells)


def parsed(cell: Cell, decimal: str | None) -> Cell:
    """Return a cell with the number that its text holds, or why it holds none."""
    if cell.is_blank:
        return cell
    bound = _BOUND.match(cell.text.casefold())
    text = cell.text[bound.end() :] if bound else cell.text
    try:
        value, unit = read_quantity(text, decimal=decimal)
    except NumberError as error:
        return replace(cell, fault=str(error)) if _LIKE_A_NUMBER.match(text) else cell
    return replace(cell, value=value, unit=unit, bound=_BOUNDS[bound[1]] if bound else "")


def spaced(line: str) -> list[str]:
    """Return the cells of a line in which nothing but spaces separates them.

    Units stay with their numbers, bounds too, and words with each other; a line without numbers is one cell,
    unless wide gaps divide it.
    """
    gaps = [each for each in re.split(r"\s{2,}|\t", line.strip()) if each]
    return [cell for gap in gaps for cell in _cells_of(gap.split())]


def _cells_of(tokens: list[str]) -> Iterator[str]:
    """Join tokens to cells."""
    cell, before = "", ""
    for token, following in zip(tokens, [*tokens[1:], ""], strict=True):
        kind = _kind(token, following)
        if cell and (before, kind) not in _JOINED:
            yield cell
            cell, before = "", ""
        cell = f"{cell} {token}".strip()
        before = _JOINED.get((before, kind), kind)
    if cell:
        yield cell


_JOINED = {
    ("words", "words"): "words",
    ("words", "unit"): "words",
    ("unit", "words"): "words",
    ("unit", "unit"): "words",
    ("number", "group"): "number",
    ("number", "unit"): "number with unit",
    ("bound", "number"): "number",
}
"""Kinds of neighbours that are of one cell, and what they are together."""


def _kind(token: str, following: str) -> str:
    """Return what a token between spaces is."""
    if re.fullmatch(r"0\d\d", token):
        return "group"
    if token.casefold() in _BOUNDS and _LIKE_A_NUMBER.match(following):
        return "bound"
    if Cell(token, 0, 0).is_blank:
        return "blank"
    if find_unit(token.strip("[]()")):
        return "unit"
    return "words" if parsed(Cell(token, 0, 0), ",").is_words else "number"


def _check_loose_signs(rows: Iterable[Row]) -> None:
    """Refuse a sign between spaces: it may belong to the number behind it, or stand for no value."""
    for row in rows:
        for sign, behind in pairwise(row):
            if _DASHES.fullmatch(sign.text) and re.match(r"[\d.,]", behind.text):
                either = f"{brief(f'{sign.text} {behind.text}')} may be one number, or no value and a number"
                raise TableError(f"{either}: write signs next to their numbers", sign.line, sign.column)
