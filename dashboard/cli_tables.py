"""Tables of answers as the command line prints them: columns name their units, those of the page."""

import numpy as np
import pandas as pd

import trackig_core as tig
from dashboard.fields import AROUND_FIELDS, EVERY_FIELD
from trackig_core import decide
from trackig_core.decide.requirements import DEFLECTION, UNITS
from trackig_core.track.fields import GIVEN

FEW = 10
"""Designs that are printed of what a search found [-], unless all are asked for."""

_FIELDS = EVERY_FIELD | AROUND_FIELDS

_SHARES = (5, 50, 95)
"""Percentiles of production [%]."""


def shown_unit(name):
    """Return the unit in which a field or figure is printed, and what turns SI into it (str, float)."""
    if name in _FIELDS:
        return _FIELDS[name].unit, 1 / _FIELDS[name].factor
    if name == DEFLECTION:
        return "mm", 1e3
    return ("dB" if name == "slack" else UNITS.get(name, "")), 1.0


def answer_rows(result, everything=False):
    """Return the rows of an answer that a person reads, and what has to be said of them.

    Parameters
    ----------
    result : object
        A result of ``trackig_core.decide``.
    everything : bool
        Whether all designs of a search's front are wanted, rather than a few.

    Returns
    -------
    str
        Lines of text.
    """
    return _KINDS[type(result)](result, everything)


def _table(columns):
    """Return columns of texts and numbers, by heading, as lines."""
    table = pd.DataFrame(columns)
    return "(no row)" if table.empty else table.to_string(index=False)


def _heading(name):
    """Return the heading of a column: what stands in it, and its unit."""
    unit, _ = shown_unit(name)
    what = f"{name} Hz" if name in tig.BAND_LABELS else name
    return f"{what}, {unit}" if unit else what


def _texts(name, values):
    """Return values [SI] of a field or figure in the unit of its column; what is no number as it is."""
    unit, scale = shown_unit(name)
    decimals = {"dB": 2, "dB(A)": 2, "mm": 3, "Hz": 1}.get(unit) if name not in _FIELDS else None
    return [_text(each, scale, decimals) for each in values]


def _text(value, scale, decimals):
    if not isinstance(value, int | float | np.number):
        return "measured" if isinstance(value, tig.StiffnessCurve | tig.LossFactorCurve) else str(value)
    if not np.isfinite(value):
        return "-"
    # zero has no sign
    return f"{value * scale:.4g}" if decimals is None else f"{value * scale:z.{decimals}f}"


def _marked(name):
    """Return the name of a field, and whose it is if not the track's."""
    return f"{name} ({GIVEN[name]})" if name in GIVEN else name


def _range(result, _):
    ends = {"from": 0, "to": 1}
    rows = [(field, interval) for field, intervals in result.items() for interval in intervals]
    columns = {"field": [_marked(field) for field, _ in rows]}
    columns |= {
        heading: [_texts(field, interval)[end] for field, interval in rows] for heading, end in ends.items()
    }
    columns |= {
        f"searched {heading}": [_texts(field, result.ranges[field])[end] for field, _ in rows]
        for heading, end in ends.items()
    }
    columns["unit"] = [shown_unit(field)[0] or "-" for field, _ in rows]
    return _table(columns)


def _sensitivity(result, _):
    columns = {
        "field": np.repeat([_marked(field) for field in result.fields], 2),
        "changed by, %": [
            f"{100 * sign * each:+.3g}" for each in result.changes.values() for sign in (-1, 1)
        ],
    }
    for name in result.figures:
        columns[_heading(name)] = _texts(name, result.differences[name].ravel())
    return f"Change of each figure when one field changes:\n{_table(columns)}"


def _sobol(result, _):
    orders = {
        "alone, %": (result.first_order, result.first_order_interval),
        "with interactions, %": (result.total_order, result.total_order_interval),
    }
    columns = {
        "figure": np.repeat(result.figures, len(result.factors)),
        "factor": np.tile(result.factors, len(result.figures)),
    }
    for heading, (order, interval) in orders.items():
        parts = np.column_stack([order.ravel(), interval.reshape(-1, 2)])
        columns[heading] = ["{:.0f} ({:.0f} to {:.0f})".format(*100 * each) for each in parts]
    return f"Part of a figure's variance that is due to a factor (95 % confidence):\n{_table(columns)}"


def _tolerance(result, _):
    columns = {"band, Hz": tig.BAND_LABELS}
    columns |= {
        f"{share} %, dB": _texts("slack", levels)
        for share, levels in zip(_SHARES, result.percentiles, strict=True)
    }
    return f"Insertion gain below which 5, 50 and 95 % of production lie:\n{_table(columns)}"


def _map(result, _):
    columns = {"over the map": ["least", "median", "greatest"]}
    for name, values in result.figures.items():
        columns[_heading(name)] = _texts(name, np.nanpercentile(values, (0, 50, 100)))
    return _table(columns)


def _find(result, everything):
    table = result.to_dataframe()
    fields = [
        name
        for name in table
        if name in (*result.free, *result.objectives) or (name in _FIELDS and _varies(table[name]))
    ]
    places = result.front if result.front.size else np.array([result.closest])
    shown = places if everything else _spread(places, FEW)
    columns = {_heading(name): _texts(name, table[name].iloc[shown]) for name in [*fields, "slack"]}
    if DEFLECTION not in result.objectives:
        columns[_heading(DEFLECTION)] = _texts(DEFLECTION, result.deflections[shown])
    columns["kept least"] = [_limit(result.governed_by[place]) for place in shown]
    said = _table(columns)
    if shown.size == places.size:
        return said
    first = "greatest" if result.objectives[0] == "margin" else "least"
    return (
        f"{said}\n{shown.size} of the {places.size} best designs, spread evenly over them, {first} "
        f"{result.objectives[0]} first; --all prints them all, --csv FILE writes all that were tried"
    )


def _varies(column):
    """Return whether a field has several values, none of which is missing or measured over frequency."""
    return column.dtype == float and column.min() < column.max()


def _limit(name):
    return f"{name} Hz" if name in tig.BAND_LABELS else name


def _spread(places, count):
    """Return at most so many of some places, evenly spread, the first and the last among them."""
    if places.size <= count:
        return places
    return places[np.linspace(0, places.size - 1, count).round().astype(int)]


_KINDS = {
    decide.FeasibleRanges: _range,
    decide.Sensitivity: _sensitivity,
    decide.SobolIndices: _sobol,
    decide.ToleranceResult: _tolerance,
    decide.DesignMap: _map,
    decide.FoundDesigns: _find,
}
