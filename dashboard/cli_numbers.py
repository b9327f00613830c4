"""Numbers of the command line: of a field, a range or a cost, with a unit as a person writes it, or in SI.

Every number is read as in the boxes of the dashboard, by ``trackig_core.typed_numbers``; what comes out is in
SI units. A :class:`NumberError` says which numbers and units a field takes.
"""

import re

from trackig_core.names import brief
from trackig_core.track.fields import RANGES
from trackig_core.typed_numbers import NumberError, find_unit, read_number, read_quantity

_ENDS = re.compile(r"(.+?)\s*(?:\.\.|…|:|\bto\b)\s*(.+)")
"""Two ends of a range: ``5..40 kN/mm``, ``5kN/mm:40kN/mm``, ``5 to 40 kN/mm``."""

_COST = re.compile(r"([^/]+?)\s*(?:(?:/|\bper\b)\s*\(?([^()]+)\)?)?")
"""A number, and the unit per which it is meant: ``2.5/kg``, ``0.3 per kN/mm``."""


def field_number(field, text):
    """Return the number of a field that a text holds.

    Parameters
    ----------
    field : str
        A key of ``RANGES``.
    text : str
        Such as ``"20kN/mm"``; in SI if it has no unit.

    Returns
    -------
    float
        The number [SI unit of the field].

    Raises
    ------
    NumberError
        If it is no number, or in a unit of something else.
    """
    try:
        return read_number(text, RANGES[field][2])
    except NumberError as error:
        raise NumberError(f"{error}; {allowed_text(field)}") from None


def allowed_text(field):
    """Return which numbers a field takes, with their unit, in words."""
    low, high, unit = RANGES[field]
    return f"{field} is a number from {low:g} to {high:g} {unit}".rstrip()


def field_range(field, text):
    """Return both ends of a range of a field.

    Parameters
    ----------
    field : str
        A key of ``RANGES``.
    text : str
        Such as ``"5..40 kN/mm"``: a unit at one end holds for both; in SI if there is none.

    Returns
    -------
    list of float
        Its ends, as they are given [SI unit of the field].

    Raises
    ------
    NumberError
        If these are not two numbers, or one is in a unit of something else.
    """
    found = _ENDS.fullmatch(text.strip())
    if found is None:
        example = f"{field}=LOW..HIGH, with a unit or in SI"
        raise NumberError(f"{brief(text)}: write {example}; {allowed_text(field)}")
    ends = found.groups()
    try:
        units = [unit.name for unit in (read_quantity(end)[1] for end in ends) if unit is not None]
    except NumberError as error:
        raise NumberError(f"{error}; {allowed_text(field)}") from None
    shared = f" {units[0]}" if len(units) == 1 else ""
    return [
        field_number(field, end if read_quantity(end)[1] is not None else f"{end}{shared}") for end in ends
    ]


def field_cost(field, text):
    """Return a cost per unit of a field.

    Parameters
    ----------
    field : str
        A field; of one that there is not, the search says which there are.
    text : str
        Such as ``"2.5/kg"`` or ``"0.3 per kN/mm"``; per SI unit if none is given.

    Returns
    -------
    float
        The cost [1/SI unit of the field].

    Raises
    ------
    NumberError
        If it is no number, or per a unit of something else.
    """
    unit = RANGES[field][2] if field in RANGES else ""
    found = _COST.fullmatch(text.strip())
    if found is None:
        raise NumberError(f"{brief(text)} is no cost: write {field}=2.5/{unit or 'unit'}")
    cost = read_number(found[1], "")
    if found[2] is None:
        return cost
    per, wanted = find_unit(found[2]), find_unit(unit)
    if per is None or per.quantity != wanted.quantity:
        raise NumberError(f"{brief(text)}: {brief(found[2])} is no unit of {field}; give a cost per {unit}")
    return cost / float(per.factor / wanted.factor)


def read_share(text):
    """Return a share [-] given as ``10%``, ``±10 %`` or ``0.1``.

    Raises
    ------
    NumberError
        If it is no number, or has a unit.
    """
    return read_number(re.sub(r"^\s*(?:±|\+/?-)", "", text), "")
