"""Production samples as a test house reports them: a table with a column for each number of a design."""

import re

import numpy as np

from dashboard.fields import FIELDS
from trackig_core.names import brief
from trackig_core.table_text import TableError
from trackig_core.typed_tables import read_table

MOST_SPECIMENS = 500
"""Rows that are read [-]."""


class SamplesError(ValueError):
    """A table holds no production samples; the message says why, and what to do."""


def read_samples(text):
    """Read production samples.

    Parameters
    ----------
    text : str
        A table as it was pasted: a row each specimen, above the columns what they hold, such as
        ``boot stiffness [kN/mm]``.

    Returns
    -------
    samples : dict of str to list of float
        Values by field [SI], row by row of the same specimen.
    notes : tuple of str
        What was not read.

    Raises
    ------
    SamplesError
        If no column is a number of a design, or a value is missing.
    """
    try:
        table = read_table(text)
        found, notes = {}, list(table.notes)
        for column in table.columns:
            name = _field(column.header)
            if name is None or name in found:
                notes.append(f"{column.words} is not read")
                continue
            unit = FIELDS[name].unit
            if unit and column.unit is None and not all(cell.unit for cell in column.cells):
                # a stiffness in another unit than is assumed would be wrong by a thousand, and look sound
                raise SamplesError(
                    f"{FIELDS[name].label} has no unit: head its column “{FIELDS[name].label} [{unit}]”."
                )
            values = column.values_in(unit) if unit else column.values
            found[name] = _checked(values * FIELDS[name].factor, column)
    except TableError as error:
        raise SamplesError(f"Not read: {error}.") from None
    if not found:
        raise SamplesError(
            f"No column is a number of a design: head each by one of {', '.join(_labels())}, with its unit "
            "in brackets."
        )
    return found, tuple(notes)


def _checked(values, column):
    if values.size > MOST_SPECIMENS:
        raise SamplesError(f"{values.size} specimens: give at most {MOST_SPECIMENS}.")
    for value, cell in zip(values, column.cells, strict=True):
        if not np.isfinite(value):
            raise SamplesError(
                f"Line {cell.line}: {brief(cell.text)} is no {column.header.lower() or 'number'}; each "
                "specimen needs every value."
            )
    return [float(value) for value in values]


def _field(header):
    """Return the field that a header names, or None."""
    words = " ".join(re.findall(r"[a-z]+", header.lower()))
    for name, field in FIELDS.items():
        if words.startswith((field.label.lower(), name.replace("_", " "))):
            return name
    return None


def _labels():
    return (field.label.lower() for field in FIELDS.values())
