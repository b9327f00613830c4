"""What stands in a slider's place: measured curves, rails of one's own, numbers that no slider shows exactly.

By field of a :class:`trackig_core.TrackDesign`, in SI units and to the last digit. A field is missing where
the slider's own value is the design's.
"""

import dataclasses

import trackig_core as tig
from dashboard.fields import (
    ASKED_FIELDS,
    EVERY_FIELD,
    EXTRAS,
    KILONEWTON,
    NEWTON_PER_METRE,
    NUMBERS,
    SECOND_STAGE,
    SURROUNDINGS,
    to_display,
    to_si,
)
from dashboard.formats import quantity_text
from dashboard.session import surroundings
from trackig_core.track.design import measured_curves

OWN_RAIL = "own"
"""Stands for a rail that is none of the known sections where one of those is chosen."""

DEFAULTS = {
    each.name: each.default
    for each in dataclasses.fields(tig.TrackDesign)
    if each.name not in (*NUMBERS, *SURROUNDINGS, "rail")
}
"""What a design has beside its usual numbers, and what it is unless somebody says otherwise."""


def is_curve(value):
    """Return whether a value is measured over frequency."""
    return isinstance(value, tig.StiffnessCurve | tig.LossFactorCurve)


def special_values(design):
    """Return what of a design sliders and choices do not show exactly.

    Parameters
    ----------
    design : trackig_core.TrackDesign
        Any design.

    Returns
    -------
    dict
        A StiffnessCurve, LossFactorCurve, Rail, or number [SI units] by field.
    """
    found = dict(measured_curves(design))
    if design.rail not in tig.RAILS.values():
        found["rail"] = design.rail
    for name in NUMBERS:
        value = getattr(design, name)
        if isinstance(value, float) and not is_on_slider(name, value):
            found[name] = value
    for name, default in DEFAULTS.items():
        value = getattr(design, name)
        if value != default and not (name in EXTRAS and is_on_slider(name, value)):
            found[name] = value
    return found


def is_on_slider(name, value):
    """Return whether a slider shows a number of a design [SI unit] exactly."""
    field, shown = EVERY_FIELD[name], to_display(name, value)
    return field.low <= shown <= field.high and to_si(name, shown) == value


def six_figures_of(design, given):
    """Return a design that was found for another, with six figures in what was found, as sliders have.

    Parameters
    ----------
    design : trackig_core.TrackDesign
        What was found.
    given : trackig_core.TrackDesign
        The design from which that departed: what is still as there was given, and has all its figures.

    Returns
    -------
    trackig_core.TrackDesign
        The design.
    """
    numbers = {name: design.value(name) for name in ASKED_FIELDS}
    return design.replace(
        **{
            name: ASKED_FIELDS[name].to_si(ASKED_FIELDS[name].to_display(value))
            for name, value in numbers.items()
            if isinstance(value, float) and value != given.value(name)
        }
    )


def on_slider(name, value):
    """Return where a slider stands for a number of a design [display unit]: at its nearest end if beyond."""
    field = EVERY_FIELD[name]
    return min(max(to_display(name, value), field.low), field.high)


def with_special(fields, special):
    """Return the fields of a design, those with special values by these.

    Parameters
    ----------
    fields : mapping
        Fields of a design as sliders and choices give them [SI units].
    special : mapping
        Such as :func:`special_values` gives.

    Returns
    -------
    dict
        Fields of a :class:`trackig_core.TrackDesign`; those of a stage that is not there are left out.
    """
    two_stage = "block_mass" in fields
    there = {name: value for name, value in special.items() if two_stage or name not in SECOND_STAGE}
    found = {**fields, **there}
    for part in ("pad", "boot"):
        if isinstance(found.get(f"{part}_stiffness"), tig.StiffnessCurve):
            found[f"{part}_loss_factor"] = None
    return found


def input_text(design, field):
    """Return a field of a design as reports and tables show it, its unit left to the label."""
    if field in surroundings.OFF:
        return surroundings.text(design, field)
    value = getattr(design, field)
    if value is None:
        return "in the stiffness table" if _has_own_loss(design, field) else "–"
    if isinstance(value, tig.Rail):
        return _rail_figures(value)
    return curve_text(value) if is_curve(value) else quantity_text(EVERY_FIELD[field].to_display(value))


def rail_text(rail):
    """Return what a rail is called, and of one that is no known section its numbers too."""
    return rail.name if rail in tig.RAILS.values() else _rail_figures(rail)


def _rail_figures(rail):
    bending = quantity_text(rail.bending_stiffness / NEWTON_PER_METRE)
    return f"{rail.name}: {quantity_text(rail.mass_per_metre)} kg/m, {bending} MN m²"


def curve_text(curve):
    """Return what a curve is in words: how many points, where, and under which preload if it is stated."""
    first, last = (quantity_text(curve.points[end][0]) for end in (0, -1))
    words = f"measured at {len(curve.points)} frequencies, {first} to {last} Hz"
    preload = getattr(curve, "preload", None)
    return words if preload is None else f"{words}, preload {quantity_text(preload / KILONEWTON)} kN"


def _has_own_loss(design, field):
    part = field.removesuffix("_loss_factor")
    return part != field and isinstance(getattr(design, f"{part}_stiffness"), tig.StiffnessCurve)
