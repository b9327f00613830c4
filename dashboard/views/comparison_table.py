"""Designs side by side as an HTML table: parameters, natural frequencies, levels, differences from a base.

The one rule: names come from users, so every text is escaped.
"""

import html
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

import trackig_core as tig
from dashboard import formats
from dashboard.fields import NUMBERS, SECOND_STAGE, six_figures
from dashboard.session.inputs import DesignInputs
from dashboard.views.components import swatch_svg

NONE = "–"


@dataclass(frozen=True, eq=False)
class Column:
    """What the table says of one design.

    Attributes
    ----------
    key : int or None
        The pin's; None for the design at hand.
    name : str
        What it is called.
    values : mapping
        The inputs, by name of :data:`dashboard.fields.INPUTS` [display units].
    natural : trackig_core.NaturalFrequencies or None
        Natural frequencies [Hz]; None as long as there is no solution.
    levels : numpy.ndarray (21,) or None
        Insertion gain [dB].
    colour : str
        Its colour.
    dash : sequence of int
        Its dash [px].
    """

    key: int | None
    name: str
    values: Mapping
    natural: tig.NaturalFrequencies | None
    levels: np.ndarray | None
    colour: str
    dash: tuple


def table_html(columns, base, bands):
    """Return the table.

    Parameters
    ----------
    columns : sequence of Column
        The designs, in order.
    base : Column
        The one from which differences are taken.
    bands : iterable of int
        Which bands are listed.

    Returns
    -------
    str
        A table in a box that scrolls if it is too wide; names in it are escaped.
    """
    heads = "".join(_head(column, column.key == base.key) for column in columns)
    groups = (
        ("Parameters", _parameter_rows(columns, base)),
        ("Natural frequencies, Hz", _frequency_rows(columns, base)),
        ("Insertion gain, dB", _band_rows(columns, base, bands)),
    )
    body = "".join(_group(title, rows, len(columns)) for title, rows in groups)
    return (
        '<div class="scroll" tabindex="0" role="region" aria-label="Designs side by side"><table>'
        "<caption>Designs side by side; below each value its difference from the base</caption>"
        f'<thead><tr><th scope="col">Design</th>{heads}</tr></thead>{body}</table></div>'
    )


def _head(column, is_base):
    note = '<span class="difference">base</span>' if is_base else ""
    swatch = swatch_svg(column.colour, column.dash)
    return f'<th scope="col">{swatch}<span class="name">{html.escape(column.name)}</span>{note}</th>'


def _group(title, rows, count):
    head = f'<tr class="group"><th scope="rowgroup" colspan="{count + 1}">{html.escape(title)}</th></tr>'
    lines = "".join(
        f'<tr><th scope="row">{html.escape(label)}</th>{"".join(_cell(*cell) for cell in cells)}</tr>'
        for label, cells in rows
    )
    return f"<tbody>{head}{lines}</tbody>"


def _cell(text, difference):
    below = f'<span class="difference">{html.escape(difference)}</span>' if difference else ""
    return f"<td>{html.escape(text)}{below}</td>"


def _parameter_rows(columns, base):
    yield (
        "Stages",
        [("two" if column.values["two_stage"] else "one", "") for column in columns],
    )
    for name in NUMBERS:
        own = _parameter(base, name)
        yield (
            DesignInputs.param[name].label,
            [_parameter_cell(_parameter(column, name), own) for column in columns],
        )
    yield DesignInputs.param.rail.label, [(column.values["rail"], "") for column in columns]


def _parameter(column, name):
    """Return a value of a design [display units], or None if a track of one stage has no such thing."""
    return column.values[name] if column.values["two_stage"] or name not in SECOND_STAGE else None


def _parameter_cell(value, base):
    if value is None:
        return NONE, ""
    difference = 0.0 if base is None else six_figures(value - base)
    return formats.quantity_text(value), f"{difference:+.6g}".replace("-", "−") if difference else ""


def _frequency_rows(columns, base):
    for label, name in (("Loaded track", "loaded_track"), ("Coupled block", "coupled_block")):
        own = base.natural and getattr(base.natural, name)
        cells = []
        for column in columns:
            frequency = column.natural and getattr(column.natural, name)
            text = NONE if frequency is None else formats.frequency_text(frequency).removesuffix(" Hz")
            differs = None not in (frequency, own) and column.key != base.key
            cells.append((text, formats.signed_text(frequency - own) if differs else ""))
        yield label, cells


def _band_rows(columns, base, bands):
    for band in bands:
        cells = []
        for column in columns:
            text = NONE if column.levels is None else formats.signed_text(column.levels[band])
            differs = not any(each.levels is None for each in (column, base)) and column.key != base.key
            cells.append(
                (text, formats.signed_text(column.levels[band] - base.levels[band]) if differs else "")
            )
        yield f"{tig.BAND_LABELS[band]} Hz", cells
