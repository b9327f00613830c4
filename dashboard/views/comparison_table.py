"""Designs side by side as an HTML table: parameters, natural frequencies, levels, differences from a base.

Names come from users, so every text is escaped.
"""

import html

import trackig_core as tig
from dashboard import formats
from dashboard.fields import FIELDS, six_figures
from dashboard.figures.swatches import swatch_svg
from dashboard.session.inputs import DesignInputs
from dashboard.session.special import input_text, rail_text

NONE = "–"


def table_html(results, base, bands):
    """Return the table.

    Parameters
    ----------
    results : sequence of DesignResult
        The designs, in order; those without a solution have dashes for what it would say.
    base : DesignResult
        The one from which differences are taken.
    bands : iterable of int
        Which bands are listed.

    Returns
    -------
    str
        A table in a box that scrolls if it is too wide; names in it are escaped.
    """
    heads = "".join(_head(each, each is base) for each in results)
    groups = (
        ("Parameters", _parameter_rows(results, base)),
        ("Natural frequencies, Hz", _frequency_rows(results, base)),
        ("Insertion gain, dB", _band_rows(results, base, bands)),
    )
    body = "".join(_group(title, rows, len(results)) for title, rows in groups)
    return (
        '<div class="scroll" tabindex="0" role="region" aria-label="Designs side by side"><table>'
        "<caption>Designs side by side; below each value its difference from the base</caption>"
        f'<thead><tr><th scope="col">Design</th>{heads}</tr></thead>{body}</table></div>'
    )


def _head(result, is_base):
    note = '<span class="difference">base</span>' if is_base else ""
    swatch = swatch_svg(result.colour, result.dash)
    return f'<th scope="col">{swatch}<span class="name">{html.escape(result.name)}</span>{note}</th>'


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


def _parameter_rows(results, base):
    yield "Stages", [("two" if each.design.two_stage else "one", "") for each in results]
    for name, field in FIELDS.items():
        yield field.labelled, [_parameter_cell(name, each.design, base.design) for each in results]
    yield DesignInputs.param.rail.label, [(rail_text(each.design.rail), "") for each in results]


def _parameter_cell(name, design, base):
    text, values = input_text(design, name), [getattr(each, name) for each in (design, base)]
    if not all(isinstance(each, float) for each in values):
        return text, ""
    value, own = map(FIELDS[name].to_display, values)
    difference = six_figures(value - own)
    return text, f"{difference:+.6g}".replace("-", "−") if difference else ""


def _frequency_rows(results, base):
    for label, name in (("Loaded track", "loaded_track"), ("Coupled block", "coupled_block")):
        own = _frequency(base, name)
        cells = []
        for each in results:
            frequency = _frequency(each, name)
            text = NONE if frequency is None else formats.frequency_text(frequency).removesuffix(" Hz")
            differs = None not in (frequency, own) and each is not base
            cells.append((text, formats.signed_text(frequency - own) if differs else ""))
        yield label, cells


def _frequency(result, name):
    """Return a natural frequency [Hz], or None where there is no solution or no such frequency."""
    return None if result.summary is None else getattr(result.summary.solution.natural_frequencies, name)


def _band_rows(results, base, bands):
    for band in bands:
        cells = []
        for each in results:
            text = NONE if each.levels is None else formats.signed_text(each.levels[band])
            differs = each.levels is not None and base.levels is not None and each is not base
            difference = formats.signed_text(each.levels[band] - base.levels[band]) if differs else ""
            cells.append((text, difference))
        yield f"{tig.BAND_LABELS[band]} Hz", cells
