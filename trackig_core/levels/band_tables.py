"""One level per one-third-octave band, as a user gives it: rows of numbers, or a table pasted or saved.

Hz, dB; bands: IEC 61260-1. What is written is a CSV file of two columns, ``frequency_hz`` and the level.
What is read may be any table that a person would understand (see :mod:`trackig_core.typed_tables`): headers
in any language, units, remarks, further columns of words, frequencies side by side; an empty level leaves its
band out.

A table that exists is sound. What is ambiguous is refused, and the message names line and column; what is
not needed (a band beyond 500 Hz, a remark) is set aside, and notes say so.
"""

import math
import numbers
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any, ClassVar, Generic, Self, TypeVar

import numpy as np

from trackig_core.arrays import RealArray
from trackig_core.bands import BAND_CENTRES, BAND_LABELS, BAND_NUMBERS
from trackig_core.names import LONGEST_TITLE, allowed, brief, is_name
from trackig_core.table_text import AT_LEAST, AT_MOST, Cell, TableError, parsed
from trackig_core.table_text import MOST_BYTES as MOST_BYTES
from trackig_core.typed_tables import Column, Table, read_table

_Kind = TypeVar("_Kind", bound="BandTable")

FREQUENCY_COLUMN = "frequency_hz"
"""Header of the first column."""

NOMINAL = tuple(float(label) for label in BAND_LABELS)
"""Nominal mid-band frequencies (21,) [Hz]."""

TOLERANCE = 0.02
"""Relative distance from the nominal or exact mid-band frequency within which a band is meant [-]: it lets
base-two centres pass, and bands lie 26 % apart."""

ROUNDING = 0.006
"""Relative distance from a mid-band frequency, nominal or exact, in base ten or two, that rounding makes [-]:
what is further away is said to be taken for its band."""

_USUAL = np.array([NOMINAL, BAND_CENTRES, 1000 * 2 ** (BAND_NUMBERS / 3 - 10)])
"""Mid-band frequencies: nominal, exact in base ten, exact in base two (3, 21) [Hz]."""

_LOSS = re.compile(
    r"loss|dämm|daemm|dämpf|daempf|minder|reduc|réduc|reduz|riduz|attenu|atténu|affaibl|perte|pérdida|perdita"
    r"|demping|\bD_?e\b|≥|>",
    re.IGNORECASE,
)
"""What a header says of insertion loss, which is insertion gain with the sign turned."""


MOST_SET_ASIDE, LONGEST_SET_ASIDE = 60, 40
"""Rows of no band that a table may have, and characters of what each is called [-]."""


class BandTableError(TableError):
    """A table of levels per band cannot be used; ``line`` and ``column`` say where it is at fault."""


@dataclass(frozen=True)
class Reading(Generic[_Kind]):
    """A table of levels that was read, and what is to be said of it.

    Attributes
    ----------
    table : BandTable
        The table.
    notes : tuple of str
        What was set aside or skipped, for people.
    """

    table: _Kind
    notes: tuple[str, ...]


@dataclass(frozen=True)
class Quantity:
    """What the levels of a table are.

    Attributes
    ----------
    column : str
        Header of its column in a CSV file.
    words : str
        What it is, for people.
    name : str
        The same in one word, which may stand above a column.
    example : float
        One of its levels [dB].
    low, high : float
        Least and greatest level [dB].
    error : type
        The :class:`BandTableError` that is raised.
    hints : str
        Regular expression of what a header may say of it, where several columns hold levels.
    is_bound : bool
        Whether each level is one, so that ``<=`` may stand before it.
    """

    column: str
    words: str
    name: str
    example: float
    low: float
    high: float
    error: type[BandTableError]
    hints: str
    is_bound: bool = False

    @property
    def allowed(self) -> str:
        """What may be given for a level."""
        return f"a number from {self.low:g} to {self.high:g} dB"

    @property
    def row(self) -> str:
        """What a line of a table may be, with an example."""
        return f"a line per band, frequency in Hz and {self.name} in dB, such as 63 {self.example:g}"

    @property
    def nothing(self) -> str:
        """Why a table is refused of which nothing can be read."""
        return f"no frequency with its {self.name} is found: give {self.row}"

    def read(self, text: str) -> float | None:
        """Return the level that was typed for one band.

        Parameters
        ----------
        text : str
            What was typed, such as ``"-6,5"`` or ``"<= -6 dB"``.

        Returns
        -------
        float or None
            The level [dB]; None if nothing was given.

        Raises
        ------
        BandTableError
            If the text is no level.
        """
        cell = parsed(Cell(" ".join(text.split()), 1, 1), ",")
        if cell.is_blank:
            return None
        in_decibels = cell.unit is None or cell.unit.quantity == "level"
        bounded = cell.bound and not (self.is_bound and cell.bound == AT_MOST)
        if cell.value is None or bounded or not in_decibels or not self.low <= cell.value <= self.high:
            raise self.error(f"{brief(text)}: give {self.allowed}, or nothing")
        return cell.value


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
        rows = _rows(self.points, self.quantity)
        points = () if not rows and self.may_be_empty else _checked(rows, self.quantity, "row")
        object.__setattr__(self, "points", points)

    @property
    def may_be_empty(self) -> bool:
        """Whether the table says something without any level."""
        return False

    @classmethod
    def from_csv(cls, data: str | bytes, name: str | None = None) -> Self:
        """Return the table of :meth:`read`, without its notes."""
        return cls.read(data, name).table

    @classmethod
    def read(cls, data: str | bytes, name: str | None = None) -> Reading[Self]:
        """Read a table that was pasted or saved.

        Parameters
        ----------
        data : str or bytes
            What was pasted, or what the file holds.
        name : str, optional
            Name of the table.

        Returns
        -------
        Reading
            An object of this class, and what is to be said of it.

        Raises
        ------
        BandTableError
            If the table cannot be used; its ``line`` and ``column`` say where.
        """
        try:
            found = _read(data, cls.quantity)
        except BandTableError:
            raise
        except TableError as error:
            raise cls.quantity.error(error.message, error.line, error.column) from None
        table = cls.given(found.points, name, found.says_loss, found.set_aside)
        return Reading(table, found.notes)

    @classmethod
    def given(
        cls,
        points: Iterable[Iterable[Any]],
        name: str | None = None,
        says_loss: bool = False,
        set_aside: Sequence[str] = (),
    ) -> Self:
        """Return the table that somebody typed, pasted or saved, who may not have said all that it means.

        Parameters
        ----------
        points : iterable of (float, float)
            Rows of mid-band frequency [Hz] and level [dB].
        name : str, optional
            Name of the table.
        says_loss : bool
            Whether header or signs (``>= 6``) say that the levels count what is lost: insertion loss.
        set_aside : sequence of str
            What rows with a level are called that are of no band of the table, such as ``"630 Hz"``.

        Returns
        -------
        BandTable
            The table; of these two, a specification takes note.
        """
        del says_loss, set_aside
        return cls(points) if name is None else cls(points, name)  # type: ignore[arg-type,call-arg]

    def with_points(self, points: Iterable[Iterable[Any]]) -> Self:
        """Return the table with other rows, as they are typed one after the other."""
        return replace(self, points=points)  # type: ignore[arg-type]  # rows of any kind are checked

    def beside(self, other: Self) -> Self:
        """Return this table in the place of another, with what that says besides its levels."""
        del other
        return self

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

    def __str__(self) -> str:
        """Return name, frequencies [Hz] and levels [dB]."""
        levels = ", ".join(f"{level:g} dB at {frequency:g} Hz" for frequency, level in self.points)
        return f"{self.name}: {levels or 'no band'}"


def _written(quantity: Quantity, points: Iterable[tuple[float, float | str]]) -> str:
    lines = [f"{FREQUENCY_COLUMN},{quantity.column}"]
    lines += [f"{frequency:g},{level}" for frequency, level in points]
    return "\n".join(lines) + "\n"


_Place = tuple[int, int, int]
"""Line, column of the frequency and column of the level."""


def _rows(points: Iterable[Iterable[Any]], quantity: Quantity) -> list[tuple[_Place, Any, Any]]:
    """Return given rows as (place, frequency, level)."""
    columns = f"frequency, {quantity.name}"
    try:
        rows = [tuple(row) for row in points]
    except TypeError:
        raise quantity.error(f"give rows of {columns}") from None
    for number, row in enumerate(rows, start=1):
        if len(row) != 2:
            raise quantity.error(f"{len(row)} values: give {columns}", number, counted="row")
    return [((number, 1, 2), *row) for number, row in enumerate(rows, start=1)]


def _checked(
    rows: Iterable[tuple[_Place, Any, Any]], quantity: Quantity, counted: str
) -> tuple[tuple[float, float], ...]:
    """Return (place, frequency, level) as points in the order of the bands, or raise the quantity's error."""
    found: dict[int, tuple[int, float]] = {}
    for (line, first, second), frequency, level in rows:
        band = _band(frequency)
        if band is None:
            raise quantity.error(_unknown_band(frequency), line, first, counted)
        verified = _number(level)
        if verified is None or not quantity.low <= verified <= quantity.high:
            message = f"{quantity.name} {brief(level)}: give {quantity.allowed}"
            raise quantity.error(message, line, second, counted)
        if band in found:
            message = (
                f"the band {BAND_LABELS[band]} Hz stands in {counted} {found[band][0]} already: "
                "give each band once"
            )
            raise quantity.error(message, line, first, counted)
        found[band] = line, verified
    if not found:
        raise quantity.error(quantity.nothing)
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


def _is_usual(frequency: float) -> bool:
    """Return whether a frequency [Hz] is written for a band as standards do, to three figures."""
    return bool((np.abs(_USUAL / frequency - 1) < ROUNDING).any())


def _unknown_band(frequency: object) -> str:
    shown = f"frequency {brief(frequency)}"
    number = _number(frequency)
    if number is None or not NOMINAL[0] <= number <= NOMINAL[-1]:
        bands = f"{BAND_LABELS[0]} to {BAND_LABELS[-1]} Hz"
        return f"{shown}: give the mid-band frequency of a one-third-octave band, {bands}"
    near = BAND_LABELS[int(np.argmin(np.abs(np.log(BAND_CENTRES / number))))]
    return f"{shown} is the middle of no one-third-octave band: the nearest is {near} Hz"


def _is_band_of_any_range(frequency: float) -> bool:
    """Return whether a frequency [Hz] names a one-third-octave band from 0.8 Hz to 20 kHz."""
    if not 0.79 < frequency < 20_400:
        return False
    decade = 10.0 ** math.floor(math.log10(frequency / 4.9))
    return _band(frequency / decade) is not None


@dataclass(frozen=True)
class _Found:
    """What was read: rows, notes, whether levels are said to count what is lost, rows that are of no band."""

    points: tuple[tuple[float, float], ...]
    notes: tuple[str, ...]
    says_loss: bool
    set_aside: tuple[str, ...]


def _read(data: str | bytes, quantity: Quantity) -> _Found:
    """Return what a table holds."""
    # no level has thousands of decibels, so that a comma is decimal unless the table shows otherwise
    table = _paired(read_table(data, is_axis=_is_band_of_any_range, undecided=","))
    frequencies = _frequencies(table, quantity)
    levels = _levels(table, frequencies, quantity)
    notes = [f"{each.words} is not read" for each in table.columns if each not in (frequencies, levels)]
    rows, outside, blank = [], [], []
    set_aside: dict[str, None] = {}
    for cell, given in zip(frequencies.cells, levels.cells, strict=True):
        if cell.is_blank and given.value is None:
            continue
        if cell.is_words:
            notes.append(f"line {cell.line} is not read: {brief(cell.text)} is no frequency")
            if given.value is not None:
                set_aside[brief(cell.text, LONGEST_SET_ASIDE)] = None
            continue
        frequency = _frequency(frequencies, cell, quantity)
        if _band(frequency) is None:
            outside.append(f"{frequency:g}")
            if not given.is_blank:
                set_aside[f"{frequency:g} Hz"] = None
        elif given.is_blank:
            blank.append(BAND_LABELS[_band(frequency) or 0])
        else:
            level = levels.value_in(given, "dB") if given.value is not None else given.text
            rows.append(((given.line, cell.column, given.column), frequency, level))
    if outside:
        bands = f"{BAND_LABELS[0]} to {BAND_LABELS[-1]} Hz"
        notes.append(f"set aside, outside {bands}: {', '.join(outside)} Hz")
    moved = [each for _, each, _ in rows if not _is_usual(each)]
    if moved:
        pairs = [f"{each:g} Hz as {BAND_LABELS[_band(each) or 0]} Hz" for each in moved]
        notes.append(f"taken for the nearest band: {', '.join(pairs)}")
    if blank:
        notes.append(f"no value at {', '.join(blank)} Hz")
    if len(set_aside) > MOST_SET_ASIDE:
        raise quantity.error(f"{len(set_aside)} rows are of no band: give at most {MOST_SET_ASIDE}")
    points = _checked(rows, quantity, "line")
    if _are_octaves(points):
        notes.append("only octave bands are given: each is taken as its one-third-octave band")
    return _Found(points, (*table.notes, *notes), _says_loss(levels, quantity), tuple(set_aside))


def _paired(table: Table) -> Table:
    """Return a table of one line of frequencies and levels in turn as two columns, any other as it is.

    It is such a line only where every other number, and not each of those between, is a band higher than the
    one before.
    """
    columns = table.columns
    if len(columns) < 4 or len(columns) % 2 or any(each.header or len(each.cells) != 1 for each in columns):
        return table
    cells = [each.cells[0] for each in columns]
    frequencies, levels = cells[::2], cells[1::2]
    in_turn = _are_ascending_bands(frequencies) and not _are_ascending_bands(levels)
    if not in_turn or any(each.value is None for each in levels):
        return table
    pair = tuple(Column("", None, each[0], tuple(each)) for each in (frequencies, levels))
    return Table(pair, (*table.notes, "the line is read as frequency and level in turn"))


def _are_ascending_bands(cells: Sequence[Cell]) -> bool:
    """Return whether cells hold the frequencies of bands, each higher than the one before."""
    if any(each.unit is not None and each.unit.name != "Hz" for each in cells):
        return False
    bands = [_band(each.value) for each in cells if not each.bound]
    known = [each for each in bands if each is not None]
    return len(known) == len(cells) and all(low < high for low, high in pairwise(known))


def _frequencies(table: Table, quantity: Quantity) -> Column:
    """Return the column that holds the frequencies."""
    if len(table.columns) < 2:
        raise quantity.error(quantity.nothing)
    named = [each for each in table.columns if each.is_frequency]
    several = [each for each in named if _are_bands(each)] or named
    if several:
        return several[0]
    able = [each for each in _uncounted(table.columns) if each.unit is None]
    return next((each for each in able if np.isfinite(each.values).any()), table.columns[0])


def _uncounted(columns: Sequence[Column]) -> list[Column]:
    """Return columns without one that numbers the rows of a table of three or more."""
    return [each for each in columns if len(columns) < 3 or not each.is_counting]


def _are_bands(column: Column) -> bool:
    """Return whether all numbers of a column of frequencies name bands, as band edges do not."""
    values = column.values_in("Hz")
    return all(_band(each) is not None or _is_band_of_any_range(each) for each in values[np.isfinite(values)])


def _levels(table: Table, frequencies: Column, quantity: Quantity) -> Column:
    """Return the column that holds the levels, or raise the quantity's error if several may."""
    beside = [each for each in table.columns if each is not frequencies]
    others = [each for each in _uncounted(table.columns) if each is not frequencies] or beside
    if not others:
        message = f"no column holds the {quantity.name}: add one beside the frequencies"
        raise quantity.error(message, frequencies.head.line, frequencies.head.column)
    named = [each for each in others if each.header.casefold() == quantity.column]
    able = [each for each in others if each.unit is None or each.unit.quantity == "level"]
    in_decibels = [each for each in able if each.unit is not None]
    numeric = [each for each in able if each.is_numeric]
    hinted = [each for each in numeric if re.search(quantity.hints, each.header, re.IGNORECASE)]
    for choice in (named, in_decibels, numeric, hinted, able, others):
        if len(choice) == 1:
            return _of_quantity(choice[0], quantity)
    if len(table.columns[0].cells) == 1 and not any(each.header for each in table.columns):
        message = f"{len(table.columns)} values in one line: give {quantity.row}"
        raise quantity.error(message, frequencies.head.line)
    several = hinted or numeric or able or others
    words = " and ".join(each.words for each in several[:2])
    commas = "" if several[0].header else "; if numbers have decimal commas, separate them by semicolons"
    message = (
        f"{words} may both hold the {quantity.name}: keep one, or write {quantity.name} above it{commas}"
    )
    raise quantity.error(message, several[1].head.line, several[1].head.column)


def _of_quantity(column: Column, quantity: Quantity) -> Column:
    """Return a column unless its header is that of another quantity."""
    header = column.header.casefold()
    if header in _COLUMNS and header != quantity.column:
        message = (
            f"{brief(column.header)} where {quantity.column!r} is due: this table is of another quantity"
        )
        raise quantity.error(message, column.head.line, column.head.column)
    return column


_COLUMNS = ("ig_max_db", "level_db", "ig_db")
"""Headers of levels in the files that are written."""


def _frequency(column: Column, cell: Cell, quantity: Quantity) -> float:
    """Return the frequency [Hz] of a cell that names a band of any range, or raise the quantity's error."""
    if cell.value is None or cell.bound:
        raise quantity.error(_unknown_band(cell.text), cell.line, cell.column)
    frequency = column.value_in(cell, "Hz")
    if _band(frequency) is None and not _is_band_of_any_range(frequency):
        raise quantity.error(_unknown_band(frequency), cell.line, cell.column)
    return frequency


def _says_loss(levels: Column, quantity: Quantity) -> bool:
    """Return whether levels are said to count what is lost; what contradicts itself is refused."""
    bounded = [each for each in levels.cells if each.bound]
    for cell in bounded:
        if not quantity.is_bound:
            raise quantity.error(f"{brief(cell.text)}: give the level alone", cell.line, cell.column)
        if cell.bound != bounded[0].bound or (cell.bound == AT_LEAST and (cell.value or 0) < 0):
            message = f"{brief(cell.text)}: give {quantity.words.lower()}, or the least insertion loss"
            raise quantity.error(message, cell.line, cell.column)
    if bounded:
        return bounded[0].bound == AT_LEAST
    return quantity.is_bound and _LOSS.search(levels.header) is not None


def _are_octaves(points: Sequence[tuple[float, float]]) -> bool:
    """Return whether three or more bands lie an octave apart each."""
    bands = [NOMINAL.index(frequency) for frequency, _ in points]
    return len(bands) > 2 and all(second - first == 3 for first, second in pairwise(bands))
