"""Tables of numbers as people paste and save them: from a spreadsheet, a PDF, a letter, a test house.

:func:`read_table` finds which lines are titles, headers, units and remarks, whether the table lies on its
side, and the unit of each column. It leaves nothing out without a word: what was skipped stands in the notes.
It knows nothing of bands or stiffness: who asks for a table says what it has to hold.
"""

import re
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np

from trackig_core.arrays import RealArray
from trackig_core.names import brief
from trackig_core.table_text import Cell, Row, TableError, read_cells
from trackig_core.typed_numbers import Unit, find_unit

_FREQUENCY = re.compile(
    r"freq|frek|fréq|częst|czest|kmitoč|taaj|sıklık|周波数|频率|частот|συχν|terz|\bband|third|tiers|terts|mitten"
    r"|\bf(_?m)?\b(?!\()",
    re.IGNORECASE,
)
"""What a header says of frequencies, in the languages of the field."""


@dataclass(frozen=True)
class Column:
    """One column of a table, or one row of a table on its side.

    Attributes
    ----------
    header : str
        What stands above it; empty if nothing does.
    unit : Unit or None
        Unit of its numbers by its header, a row of units, or its cells; None if nothing is said.
    head : Cell
        The first cell of all, header or not.
    cells : tuple of Cell
        One cell a row.
    is_row : bool
        Whether it lies on its side.
    """

    header: str
    unit: Unit | None
    head: Cell
    cells: tuple[Cell, ...]
    is_row: bool = False

    @property
    def words(self) -> str:
        """Place in the file and header, for messages."""
        place = f"line {self.head.line}" if self.is_row else f"column {self.head.column}"
        return f"{place} ({brief(self.header)})" if self.header else place

    @property
    def is_numeric(self) -> bool:
        """Whether it holds more numbers than words."""
        held = [each.value is not None for each in self.cells]
        return sum(held) > sum(each.is_words for each in self.cells)

    @property
    def is_counting(self) -> bool:
        """Whether it numbers the rows."""
        return [each.value for each in self.cells] in [list(range(n, n + len(self.cells))) for n in (0, 1)]

    @cached_property
    def is_frequency(self) -> bool:
        """Whether its unit, or for want of one its header, says that it holds frequencies."""
        return names_frequency(self.header, self.unit)

    @property
    def values(self) -> RealArray:
        """Its numbers as they stand there (rows,), NaN where there is none."""
        return np.array([np.nan if each.value is None else each.value for each in self.cells])

    def values_in(self, unit: str) -> RealArray:
        """Return its numbers in a unit (rows,) [unit], NaN where there is none.

        Parameters
        ----------
        unit : str
            The unit wanted; numbers without a unit, of their own or of the column, are taken to be in it.

        Returns
        -------
        numpy.ndarray
            The numbers.

        Raises
        ------
        TableError
            If a number is in a unit of another quantity.
        """
        return np.array([self.value_in(each, unit) for each in self.cells])

    def value_in(self, cell: Cell, unit: str) -> float:
        """Return the number of one of its cells in a unit, as :meth:`values_in` does."""
        given, wanted = cell.unit or self.unit, find_unit(unit)
        if wanted is None:
            raise ValueError(f"{unit}: no unit of which anything is known")
        if cell.value is None:
            return np.nan
        if given is not None and given.quantity != wanted.quantity:
            kind = f"in {given.name}, a unit of {given.quantity}" if given.name else f"a {given.quantity}"
            message = f"{brief(cell.text)} is {kind}: give it in {unit}"
            raise TableError(message, cell.line, cell.column)
        return cell.value if given is None else given.convert(cell.value, wanted)


@dataclass(frozen=True)
class Table:
    """A table as it was read.

    Attributes
    ----------
    columns : tuple of Column
        Its columns, each with one cell a row.
    notes : tuple of str
        What was skipped, and where.
    """

    columns: tuple[Column, ...]
    notes: tuple[str, ...] = ()


def read_table(
    data: str | bytes,
    *,
    is_axis: Callable[[float], bool] | None = None,
    undecided: str | None = None,
) -> Table:
    """Read a table of numbers.

    Parameters
    ----------
    data : str or bytes
        What was pasted, or what a file holds, in UTF-8, UTF-16 or the code of Western Windows.
    is_axis : callable, optional
        Whether a number may be of the row of frequencies of a table on its side that has no headers.
    undecided : str, optional
        Decimal mark, ``","`` or ``"."``, of numbers such as ``1,200`` if no other number of the table tells;
        else they are at fault.

    Returns
    -------
    Table
        Columns with header, unit, place and cells, and notes of what was skipped.

    Raises
    ------
    TableError
        If this is no text, or its lines have different numbers of values.
    """
    rows = [row for row in read_cells(data, undecided) if not all(cell.is_blank for cell in row)]
    if _is_on_its_side(rows, is_axis):
        return _from_side(rows)
    first = next(
        (at for at, row in enumerate(rows) if any(cell.value is not None for cell in row)), len(rows)
    )
    body, notes = _body(rows[first:])
    width = _width(body, [len(row) for row in rows[:first]])
    heads, titles = _heads(rows[:first], width)
    width = max([width, *(len(head) for head in heads)])
    columns = (_column(heads, body, at) for at in range(width))
    return Table(tuple(each for each in columns if each is not None), (*titles, *notes))


def _body(rows: Sequence[Row]) -> tuple[list[Row], tuple[str, ...]]:
    """Return rows that hold numbers, or what was meant as such, and notes of the others."""
    body, notes = [], []
    for row in rows:
        if all(cell.is_words or cell.is_blank for cell in row):
            notes.append(_skipped(row))
        else:
            body.append(row)
    return body, tuple(notes)


def _skipped(row: Row) -> str:
    text = " ".join(cell.text for cell in row if not cell.is_blank)
    return f"line {row[0].line} is not read: {brief(text)}"


def _width(body: Sequence[Row], heads: Sequence[int]) -> int:
    """Return the number of columns, or raise a TableError where a line has values too many."""
    # what ends in words or has no value tells nothing of how many values a line should have
    lengths = [len(row) for row in body if len(row) > 1 and not any(cell.is_words for cell in row)]
    counts = Counter(lengths or [len(row) for row in body])
    usual = max([min(counts, key=lambda length: (-counts[length], length), default=0), *heads])
    for row in body:
        if len(row) > usual and row[usual].value is not None:
            message = (
                f"{sum(cell.value is not None for cell in row)} values where other lines have {usual}; "
                "if numbers have decimal commas, separate them by semicolons"
            )
            raise TableError(message, row[0].line, usual + 1)
    return max((len(row) for row in body), default=0)


def _heads(rows: Sequence[Row], width: int) -> tuple[list[Row], tuple[str, ...]]:
    """Return the rows that are headers, one cell a column, and notes of those that are titles."""
    heads = [row for row in rows if width == 1 or sum(not cell.is_blank for cell in row) > 1]
    titles = [row for row in rows if row not in heads]
    if titles and not heads:
        divided = _divided(titles[-1][0], width)
        if len(divided) == width:
            heads.append(divided)
            titles.pop()
    return heads, tuple(map(_skipped, titles))


def _divided(cell: Cell, width: int) -> Row:
    """Return the headers in a line that only spaces divide: after brackets, or word by word."""
    for pattern in (r"(?<=[\])])\s+", r"\s+"):
        texts = re.split(pattern, cell.text)
        if len(texts) == width:
            return tuple(Cell(text, cell.line, at) for at, text in enumerate(texts, start=1))
    return (cell,)


def _column(heads: Sequence[Row], body: Sequence[Row], at: int) -> Column | None:
    """Return a column, or None if it is empty."""
    cells = tuple(row[at] if at < len(row) else Cell("", row[0].line, at + 1) for row in body)
    over = [head[at] for head in heads if at < len(head) and not head[at].is_blank]
    if not over and all(cell.is_blank for cell in cells):
        return None
    texts = [cell.text for cell in over]
    return Column(" ".join(texts), _unit(texts, cells), [*over, *cells][0], cells)


def _unit(headers: Sequence[str], cells: Sequence[Cell]) -> Unit | None:
    """Return the unit that headers name, or else all numbers have."""
    for header in headers:
        unit = unit_of_header(header)
        if unit is not None:
            return unit
    units = {cell.unit for cell in cells if cell.value is not None}
    return units.pop() if len(units) == 1 else None


def unit_of_header(header: str) -> Unit | None:
    """Return the unit that a header names: in brackets, alone, or as one of its words.

    Parameters
    ----------
    header : str
        Such as ``"Steifigkeit [kN/mm]"``, ``"f / Hz"``, ``"stiffness_N_per_m"``.

    Returns
    -------
    Unit or None
        The unit, or None if there is none.
    """
    bracketed = re.findall(r"[\[(]([^\])]*)[\])]", header)
    words = re.split(r"[\s,;:_()\[\]]+", re.sub("_per_", "/", header, flags=re.IGNORECASE))
    # letters alone are symbols of what is measured rather than units
    words = [word for word in words if len(word) > 1 or word == "%"]
    candidates = [*bracketed, *([header] if len(header) > 1 else []), *words]
    return next((unit for unit in map(find_unit, candidates) if unit is not None), None)


def _is_on_its_side(rows: Sequence[Row], is_axis: Callable[[float], bool] | None) -> bool:
    """Return whether frequencies stand side by side, in the first row that has numbers."""
    series = [row for row in rows if sum(cell.value is not None for cell in row) > 1]
    if len(series) < 2:
        return False
    if _begins_side(series[0]):
        return True
    first = [cell.value for cell in series[0] if cell.value is not None]
    down = [row[0].value for row in series if row[0].value is not None]
    if is_axis is None or _first(series[0]).is_words or len(first) < max(3, len(series) + 1):
        return False
    is_upright = len(down) == len(series) and _ascends(down, is_axis)
    return _ascends(first, is_axis) and not is_upright


def _ascends(values: Sequence[float], is_axis: Callable[[float], bool]) -> bool:
    return all(map(is_axis, values)) and all(low < high for low, high in pairwise(values))


def _begins_side(row: Row) -> bool:
    """Return whether a row begins by words on frequency."""
    first = _first(row)
    return first.is_words and names_frequency(first.text, unit_of_header(first.text))


def _first(row: Row) -> Cell:
    return next(cell for cell in row if not cell.is_blank)


def names_frequency(header: str, unit: Unit | None) -> bool:
    """Return whether a unit, or for want of one a header, says that numbers are frequencies.

    Parameters
    ----------
    header : str
        What stands above or beside them.
    unit : Unit or None
        The unit that it names.
    """
    return unit.quantity == "frequency" if unit is not None else _FREQUENCY.search(header) is not None


def _from_side(rows: Sequence[Row]) -> Table:
    """Return a table whose frequencies stand side by side; it may be broken into several blocks."""
    # a row of words and blanks holds a part of the table without values
    series = [row for row in rows if len(row) > 1 and not any(cell.is_words for cell in row[2:])]
    notes = tuple(_skipped(row) for row in rows if row not in series)
    # the first row may lack words, and it begins the first block in any case
    starts = [at for at, row in enumerate(series) if _begins_side(row)] or [0]
    blocks = [series[start:end] for start, end in pairwise([*starts, len(series)])]
    for block in blocks:
        if len(block) != len(blocks[0]):
            message = f"{len(block)} rows from here on where the first part of the table has {len(blocks[0])}"
            raise TableError(message, block[0][0].line)
    parts = [_part(block) for block in blocks]
    columns = []
    for at, row in enumerate(blocks[0]):
        header = parts[0][at][0]
        cells = tuple(cell for part in parts for cell in part[at][1])
        columns.append(Column(header, _unit([header], cells), _first(row), cells, is_row=True))
    return Table(tuple(columns), notes)


def _part(block: Sequence[Row]) -> list[tuple[str, Row]]:
    """Return the header and the cells of each row of a block, as many as there are frequencies."""
    frequencies = block[0]
    begin = next(at for at, cell in enumerate(frequencies) if cell.value is not None)
    found = []
    for row in block:
        wrong = [cell for cell in row[:begin] if cell.value is not None] + [*row[len(frequencies) :]]
        if wrong:
            message = f"{brief(wrong[0].text)} does not stand below a frequency of line {frequencies[0].line}"
            raise TableError(message, wrong[0].line, wrong[0].column)
        blanks = (Cell("", row[0].line, at) for at in range(len(row) + 1, len(frequencies) + 1))
        header = " ".join(cell.text for cell in row[:begin] if not cell.is_blank)
        found.append((header, (*row, *blanks)[begin:]))
    return found
