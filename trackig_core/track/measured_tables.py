"""Measured stiffness from the table of a test house: columns, units, what to ask, and the preload.

Read are frequency, stiffness (the real part of the complex stiffness, or its magnitude if the header says so)
and loss factor, or real and imaginary part. A unit of stiffness that is mistaken costs a factor of 1000 and
looks sound: the reading names the unit, and asks where the stiffness is one that no pad or boot has.
"""

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

from trackig_core.names import brief
from trackig_core.table_text import Cell, TableError, decoded
from trackig_core.track.measured_curves import COLUMNS, MeasurementError, StiffnessCurve
from trackig_core.track.stated_preload import is_preload, one_preload, preloads_of, take_preloads
from trackig_core.typed_numbers import Unit, find_unit
from trackig_core.typed_tables import Column, read_table

USUAL_STIFFNESS = (1e6, 1e10)
"""Dynamic stiffness that pads and boots have [N/m]: 1 to 10,000 kN/mm."""

UNITS = ("N/m", "N/mm", "kN/mm")
"""Units in which stiffness is reported."""

_LOSS = re.compile(r"loss|\beta\b|η|tan|verlust|perte|pérdida|perdita|dämpf|damp", re.IGNORECASE)
_IMAGINARY = re.compile(r"imag|\bim\b|loss stiff|''|\"|″", re.IGNORECASE)
_MAGNITUDE = re.compile(r"magn|betrag|\babs|\|", re.IGNORECASE)


@dataclass(frozen=True)
class StiffnessReading:
    """A measured stiffness as it was read from a table.

    Attributes
    ----------
    curve : StiffnessCurve
        The stiffness.
    unit : str
        Unit in which the table was taken to give it.
    is_assumed : bool
        Whether the unit is a guess: nothing in the table names one.
    question : str
        What to ask of the unit; empty if it seems right.
    suggestion : str
        The unit that would give a stiffness that pads have; empty if there is no question or no such unit.
    notes : tuple of str
        What was assumed, set aside or skipped.
    """

    curve: StiffnessCurve
    unit: str
    is_assumed: bool
    question: str
    suggestion: str
    notes: tuple[str, ...]

    def __str__(self) -> str:
        """Return the curve, the unit in which the table was read, and what is asked of it."""
        return " ".join([f"{self.curve}, read in {self.unit}.", *([self.question] if self.question else [])])


class _Columns(NamedTuple):
    frequency: Column
    stiffness: Column
    loss: Column

    @property
    def has_parts(self) -> bool:
        """Whether there is an imaginary part in place of a loss factor."""
        return _IMAGINARY.search(self.loss.header) is not None or (
            self.loss.unit is not None and self.loss.unit.quantity == "stiffness"
        )


def read_stiffness(data: str | bytes, unit: str | None = None) -> StiffnessReading:
    """Read a table of frequency, stiffness and loss factor, or of real and imaginary part; and its preload.

    Parameters
    ----------
    data : str or bytes
        What was pasted, or what the file holds; headers say what the columns are, else they are frequency,
        stiffness, loss factor in this order. A preload stands in a column, a header, a comment or a line of
        its own, such as ``preload: 30 kN``.
    unit : str, optional
        Unit of the stiffness, such as ``"N/mm"``, whatever the table says: the answer to a question.

    Returns
    -------
    StiffnessReading
        The stiffness, and what is to be said and asked of it.

    Raises
    ------
    MeasurementError
        If the table cannot be used; the message names line and column.
    """
    try:
        text, in_lines, remarks = take_preloads(decoded(data))
        table = read_table(text, is_axis=lambda frequency: frequency >= COLUMNS["frequency"][0])
        loads = [each for each in table.columns if is_preload(each)]
        in_columns = (stated for each in loads for stated in preloads_of(each))
        preload = one_preload([*in_lines, *in_columns])
        columns = _columns([each for each in table.columns if each not in loads])
        figures = [each.value for each in columns.stiffness.cells if each.value is not None]
        stated = columns.stiffness.unit
        chosen = unit or (stated.name if stated is not None else (_usual_units(figures) or UNITS)[-1])
        points, skipped = _points(columns, chosen, is_answer=unit is not None)
    except TableError as error:
        raise MeasurementError(str(error)) from None
    notes = [*table.notes, *remarks, *skipped]
    notes += [f"{each.words} is not read" for each in table.columns if each not in (*columns, *loads)]
    is_assumed = unit is None and stated is None
    if is_assumed:
        notes.append(f"no unit of stiffness is given: {chosen} is assumed")
    if preload is not None and preload.note:
        notes.append(preload.note)
    question, suggestion = ("", "") if unit else _question(list(points.values()), figures, chosen, is_assumed)
    try:
        curve = StiffnessCurve(tuple(points.values()))
    except MeasurementError as error:
        where = "" if error.row is None else f"{list(points)[error.row - 1]}: "
        asked = f"; {question}" if suggestion else ""
        raise MeasurementError(f"{where}{error.message}{asked}") from None
    if preload is not None:
        curve = preload.put_on(curve)
    return StiffnessReading(curve, chosen, is_assumed, question, suggestion, tuple(notes))


def _columns(columns: Sequence[Column]) -> _Columns:
    """Return the columns that are needed, or raise a MeasurementError."""
    numeric = [each for each in columns if each.is_numeric]
    frequency = next((each for each in numeric if each.is_frequency), numeric[0] if numeric else None)
    others = [each for each in numeric if each is not frequency]
    losses = [each for each in others if _LOSS.search(each.header) or _IMAGINARY.search(each.header)]
    stiffnesses = [each for each in others if each not in losses]
    if not losses:
        # what has no header, or one that says nothing, stands in the usual order
        losses, stiffnesses = stiffnesses[1:], stiffnesses[:1]
    with_unit = [each for each in stiffnesses if each.unit is not None and each.unit.quantity == "stiffness"]
    stiffnesses = with_unit or stiffnesses
    if frequency is None or len(stiffnesses) != 1 or len(losses) != 1:
        found = ", ".join(each.words for each in columns) or "no columns"
        raise MeasurementError(
            f"{found}: give columns of frequency, stiffness and loss factor, or of real and imaginary part"
        )
    return _Columns(frequency, stiffnesses[0], losses[0])


def _points(
    columns: _Columns, unit: str, *, is_answer: bool
) -> tuple[dict[str, tuple[float, float, float]], list[str]]:
    """Return rows of frequency [Hz], stiffness [N/m], loss factor [-] by place, ascending, and notes."""
    points: dict[str, tuple[float, float, float]] = {}
    notes = []
    for cells in zip(*(each.cells for each in columns), strict=True):
        place = f"column {cells[0].column}" if columns.frequency.is_row else f"line {cells[0].line}"
        for cell in cells:
            if cell.fault or cell.is_words or cell.bound:
                raise TableError(cell.fault or f"{brief(cell.text)} is no number", cell.line, cell.column)
        if any(cell.value is None for cell in cells):
            notes.append(f"{place} is not read: a value is missing")
            continue
        frequency = columns.frequency.value_in(cells[0], "Hz")
        stiffness = _in_newtons(columns.stiffness, cells[1], unit, is_answer)
        if frequency == 0:
            notes.append(f"{place} is not read: 0 Hz has no dynamic stiffness")
            continue
        if columns.has_parts:
            imaginary = _in_newtons(columns.loss, cells[2], unit, is_answer)
            loss_factor = imaginary / stiffness if stiffness else math.inf
        else:
            loss_factor = columns.loss.value_in(cells[2], "")
        if _MAGNITUDE.search(columns.stiffness.header):
            stiffness /= math.sqrt(1 + loss_factor**2)
        points[place] = (frequency, stiffness, loss_factor)
    return dict(sorted(points.items(), key=lambda item: item[1])), notes


def _in_newtons(column: Column, cell: Cell, unit: str, is_answer: bool) -> float:
    """Return the stiffness of a cell [N/m]; a unit that a person answered outweighs the table's."""
    if cell.value is not None and (is_answer or (cell.unit is None and column.unit is None)):
        return _unit(unit).convert(cell.value, _unit("N/m"))
    return column.value_in(cell, "N/m")


def _unit(name: str) -> Unit:
    unit = find_unit(name)
    if unit is None or unit.quantity != "stiffness":
        raise ValueError(f"unit = {name!r}: give a unit of stiffness, such as {', '.join(UNITS)}")
    return unit


def _is_usual(stiffnesses: Sequence[float]) -> bool:
    low, high = USUAL_STIFFNESS
    return all(low <= each <= high for each in stiffnesses)


def _usual_units(figures: Sequence[float]) -> list[str]:
    """Return the units in which figures are stiffnesses that pads have."""
    factors = {name: float(_unit(name).factor) for name in UNITS}
    return [name for name, factor in factors.items() if _is_usual([each * factor for each in figures])]


def _question(
    points: Sequence[tuple[float, float, float]], figures: Sequence[float], unit: str, is_assumed: bool
) -> tuple[str, str]:
    """Return what to ask of the unit, and the unit that would be right."""
    usual = _usual_units(figures)
    stiffnesses = [stiffness for _, stiffness, _ in points]
    if not stiffnesses or (_is_usual(stiffnesses) and not (is_assumed and len(usual) > 1)):
        return "", ""
    words = f"in {unit}, the stiffness is {_range_text(stiffnesses)} kN/mm"
    if _is_usual(stiffnesses):
        return f"{words}: is it in {' or in '.join(usual)}?", ""
    suggestion = next((each for each in usual if each != unit), "")
    words += f", and pads have {_range_text(USUAL_STIFFNESS)}"
    return (
        f"{words}: are the figures in {suggestion}?" if suggestion else f"{words}: is that so?"
    ), suggestion


def _range_text(stiffnesses: Sequence[float]) -> str:
    """Return least and greatest of stiffnesses [N/m] in kN/mm."""
    low, high = (f"{float(f'{each / 1e6:.4g}'):,.12g}" for each in (min(stiffnesses), max(stiffnesses)))
    return low if low == high else f"{low} to {high}"
