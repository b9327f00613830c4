"""Designs side by side as an HTML table: parameters, natural frequencies, levels, differences from a base.

Names come from users, so every text is escaped.
"""

import html

import numpy as np

import trackig_core as tig
from dashboard import formats
from dashboard.fields import EVERY_FIELD, EXTRA_FIELDS, EXTRAS, LOAD, six_figures
from dashboard.figures.swatches import swatch_svg
from dashboard.session import surroundings
from dashboard.session.inputs import DesignInputs
from dashboard.session.special import input_text, rail_text

NONE = "–"


def table_html(results, base, bands, measured=()):
    """Return the table.

    Parameters
    ----------
    results : sequence of DesignResult
        The designs, in order; those without a solution have dashes for what it would say.
    base : DesignResult
        The one from which differences are taken.
    bands : sequence of int
        Which bands are listed.
    measured : iterable of trackig_core.levels.MeasuredGain
        Curves from elsewhere; by how much each design exceeds them is listed.

    Returns
    -------
    str
        A table in a box that scrolls if it is too wide; names in it are escaped.
    """
    heads = "".join(_head(each, each is base) for each in results)
    groups = (
        ("Parameters", _parameter_rows(results, base)),
        ("Natural frequencies, Hz", _frequency_rows(results, base)),
        (_static_title(results), _static_rows(results, base)),
        ("Insertion gain, dB", _band_rows(results, base, bands)),
        *(
            (f"Computed less measured: {each.name}, dB", _measured_rows(results, each, bands))
            for each in measured
        ),
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
    for name, field in EVERY_FIELD.items():
        if name not in LOAD and _is_told(name, results):
            yield field.labelled, [_parameter_cell(name, each.design, base.design) for each in results]
    yield DesignInputs.param.rail.label, [(rail_text(each.design.rail), "") for each in results]
    for name, label in surroundings.LABELS.items():
        if any(getattr(each.design, name) != surroundings.OFF[name] for each in results):
            yield label, [(surroundings.text(each.design, name), "") for each in results]


def _is_told(name, results):
    """Return whether a row says anything: an extra number only where a design has one."""
    if name not in EXTRAS:
        return True
    usual = EXTRA_FIELDS[name].to_si(EXTRA_FIELDS[name].default)
    return any(getattr(each.design, name) not in (None, usual) for each in results)


def _parameter_cell(name, design, base):
    text, values = input_text(design, name), [getattr(each, name) for each in (design, base)]
    if not all(isinstance(each, float) for each in values):
        return text, ""
    value, own = map(EVERY_FIELD[name].to_display, values)
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


def _measured_rows(results, curve, bands):
    """Yield differences from a curve from elsewhere: of all its bands, then of those listed that it has."""
    differences = [None if each.levels is None else curve.difference(each.levels) for each in results]
    yield "root mean square", [(NONE if each is None else f"{_rms(each):.1f}", "") for each in differences]
    for band in bands:
        if np.isfinite(curve.levels[band]):
            texts = [NONE if each is None else formats.signed_text(each[band]) for each in differences]
            yield f"{tig.BAND_LABELS[band]} Hz", [(text, "") for text in texts]


def _rms(difference):
    return np.sqrt(np.nanmean(difference**2))


def _static_title(results):
    statics = next((each.statics for each in results if each.statics is not None), None)
    return "Standing load" if statics is None else f"Under {formats.wheels_text(statics)}"


def _static_rows(results, base):
    """Yield deflection [mm] and seat load [kN]; "≥" where a static stiffness is not stated."""
    for label, name, factor in STATIC_ROWS:
        own = None if base.statics is None else getattr(base.statics, name) * factor
        cells = []
        for each in results:
            if each.statics is None:
                cells.append((NONE, ""))
                continue
            value = getattr(each.statics, name) * factor
            bound = "≥ " if each.statics.at_least and name.endswith("deflection") else ""
            differs = own is not None and each is not base
            difference = formats.signed_text(value - own, 2) if differs else ""
            cells.append((f"{bound}{value:.2f}", difference))
        yield label, cells


STATIC_ROWS = (
    ("Rail deflection, mm", "rail_deflection", 1e3),
    ("at the worst place, mm", "largest_rail_deflection", 1e3),
    ("Seat load, kN", "largest_seat_load", 1e-3),
)
"""Label of each row of the statics, its attribute, and what one SI unit is in the unit shown."""


def _band_rows(results, base, bands):
    for band in bands:
        cells = []
        for each in results:
            text = NONE if each.levels is None else formats.signed_text(each.levels[band])
            differs = each.levels is not None and base.levels is not None and each is not base
            difference = formats.signed_text(each.levels[band] - base.levels[band]) if differs else ""
            cells.append((text, difference))
        yield f"{tig.BAND_LABELS[band]} Hz", cells
