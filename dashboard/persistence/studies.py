"""What the dashboard holds, as a study, and a study as what the dashboard holds.

A study may hold more than sliders show: rails of one's own, springs as measured, numbers beyond a slider or
of more figures. These are special inputs. Numbers of sliders are in display units, those of a study in SI
units. Nothing is rounded, clamped or dropped: what was saved opens as it was.
"""

from dataclasses import dataclass, replace

import trackig_core as tig
from dashboard.fields import LOAD, OPENING_PRESET, to_display, to_si
from dashboard.formats import quantity_text
from dashboard.session.inputs import DesignInputs, design_of, load_of, preset_values, values_of
from dashboard.session.pins import current_design, distinct_colours
from dashboard.theme import MOST_PINNED


@dataclass(frozen=True)
class Opened:
    """What a study sets in the dashboard.

    Attributes
    ----------
    values : dict
        All inputs, by name of :data:`dashboard.fields.INPUTS` [display units], as DesignInputs takes them.
    pins : tuple of trackig_core.PinnedDesign
        Pinned designs, of different names and colours, each with a preset, in their order.
    base : int or None
        Number of the pin from which differences are taken, counted from 0, as Pins takes it.
    view : dict
        ``summation``, ``reference`` and ``bands``.
    specification : trackig_core.Specification or None
        What the designs have to meet.
    source : trackig_core.SourceSpectrum or None
        Levels on the reference track.
    name : str
        What the study is called.
    measured : tuple of trackig_core.levels.MeasuredGain
        Insertion gain from elsewhere.
    answers : tuple of trackig_core.decide.Answer
        Questions that were asked, and what came out.
    """

    values: dict
    pins: tuple[tig.PinnedDesign, ...]
    base: int | None
    view: dict
    specification: tig.Specification | None
    source: tig.SourceSpectrum | None
    name: str
    measured: tuple[tig.levels.MeasuredGain, ...] = ()
    answers: tuple[tig.decide.Answer, ...] = ()


def to_study(
    values,
    view=None,
    pins=(),
    base=None,
    specification=None,
    source=None,
    name=tig.Study.name,
    measured=(),
    answers=(),
):
    """Return a study of what the dashboard holds.

    Parameters
    ----------
    values : mapping
        All inputs, by name of :data:`dashboard.fields.INPUTS`, as DesignInputs gives them [display units].
    view : mapping, optional
        ``summation``, ``reference`` and ``bands``; what is missing is as in the paper.
    pins : iterable of trackig_core.PinnedDesign
        Pinned designs.
    base : int, optional
        Number of the pin from which differences are taken, counted from 0.
    specification : trackig_core.Specification, optional
        What the designs have to meet.
    source : trackig_core.SourceSpectrum, optional
        Levels on the reference track.
    name : str
        What the study is called.
    measured : iterable of trackig_core.levels.MeasuredGain
        Insertion gain from elsewhere.
    answers : iterable of trackig_core.decide.Answer
        Questions that were asked, and what came out.

    Returns
    -------
    trackig_core.Study
        The study. Inputs that a single-stage track does not have are not kept.

    Raises
    ------
    trackig_core.StudyError
        If the name is not allowed.
    trackig_core.DesignError
        If the values do not make a track.
    """
    return tig.Study(
        design=design_of(values),
        pinned=pins,
        specification=specification,
        source=source,
        view=tig.View(**(view or {}), base=base),
        name=name,
        preset=values["preset"],
        load=load_of(values),
        measured=measured,
        answers=answers,
    )


def from_study(study):
    """Return what a study sets in the dashboard.

    Parameters
    ----------
    study : trackig_core.Study
        The study. Where it says no preset, the one is taken that its design is, else the one on which the
        dashboard opens; where pinned designs share a colour, the later ones get colours of their own.

    Returns
    -------
    Opened
        Values that inputs take, and that give exactly the study's designs.

    Raises
    ------
    trackig_core.StudyError
        If there are more pinned designs than the page shows, or two of them have one name.
    """
    if len(study.pinned) > MOST_PINNED:
        raise tig.StudyError(f"{len(study.pinned)} designs: the page shows at most {MOST_PINNED}", "pinned")
    current = current_design(study.design, study.preset)
    preset = _preset(current)
    return Opened(
        values=preset_values(preset) | values_of(study.design, preset) | _load(study.load),
        pins=_pins(study.pinned),
        base=study.view.base,
        view={name: getattr(study.view, name) for name in ("summation", "reference", "bands")},
        specification=study.specification,
        source=study.source,
        name=study.name,
        measured=study.measured,
        answers=study.answers,
    )


def _load(load):
    """Return the wheels that stand on the track as inputs, or raise a StudyError."""
    for name in LOAD:
        if getattr(load, name) is not None:
            _check_number(load, name, "the study", "load")
    return {name: to_display(name, getattr(load, name)) for name in LOAD}


def _pins(pinned):
    """Return pinned designs as they are shown here, or raise a StudyError that names one and its path."""
    colours = distinct_colours(each.colour for each in pinned)
    for number, each in enumerate(pinned):
        path = f"pinned[{number}]"
        if any(each.name == other.name for other in pinned[:number]):
            raise tig.StudyError(f"two designs are called “{each.name}”; give each its own", f"{path}.name")
    return tuple(
        replace(each, colour=colour, preset=_preset(each))
        for each, colour in zip(pinned, colours, strict=True)
    )


def _preset(pinned):
    """Return the preset from which a design departs: the one that it says, that it is, or the opening one."""
    same = (key for key, published in tig.PRESETS.items() if published == pinned.design)
    return pinned.preset or next(same, OPENING_PRESET)


def _check_number(load, field, whose, path):
    """Raise a StudyError unless a slider shows a number of the standing wheels exactly."""
    value, (low, high) = getattr(load, field), DesignInputs.param[field].bounds
    takes = f"one number from {quantity_text(low)} to {quantity_text(high)}"
    shown = to_display(field, value)
    if not low <= shown <= high:
        raise _refused(whose, path, field, quantity_text(shown), takes)
    if to_si(field, shown) != value:
        raise _refused(whose, path, field, f"{value!r} in SI units", f"six figures, such as {shown!r}")


def _refused(whose, path, field, found, takes):
    label = DesignInputs.param[field].label
    return tig.StudyError(f"{whose}: “{label}” is {found}; the sidebar takes {takes}", f"{path}.{field}")
