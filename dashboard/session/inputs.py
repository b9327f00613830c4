"""What the user sets, as plain parameters.

:class:`DesignInputs` holds the design in display units (kN/mm, kg, m), :class:`GainDefinition` which
insertion gain is shown. Designs in SI units become display values here, and back.
"""

import re
from numbers import Real

import param

import trackig_core as tig
from dashboard.fields import (
    EVERY_FIELD,
    EXTRA_FIELDS,
    EXTRAS,
    INPUTS,
    LOAD,
    NUMBERS,
    OPENING_PRESET,
    PHYSICAL,
    PRESET_LABELS,
    SECOND_STAGE,
    SURROUNDINGS,
    six_figures,
    to_display,
    to_si,
)
from dashboard.formats import quantity_text
from dashboard.session import surroundings
from trackig_core.levels.insertion_gain import reference_for
from trackig_core.typed_numbers import NumberError, read_number


def design_of(values):
    """Return the design of display values, in SI units.

    Parameters
    ----------
    values : mapping
        Values of :data:`PHYSICAL` by name [display units]; the second stage's may stand there unused, and
        extra numbers and surroundings may be missing.

    Returns
    -------
    trackig_core.TrackDesign
        The design; equal values give equal designs, whatever path led there.

    Raises
    ------
    trackig_core.DesignError
        If the values do not make a track.
    """
    names = [name for name in _DESIGN_NUMBERS if values["two_stage"] or name not in SECOND_STAGE]
    given = {name: values[name] if name in NUMBERS else _extra(values, name) for name in names}
    return tig.TrackDesign(
        rail=tig.RAILS[values["rail"]],
        **{name: to_si(name, value) for name, value in given.items()},
        **{name: values[name] for name in SURROUNDINGS if name in values},
    )


_DESIGN_NUMBERS = tuple(name for name in EVERY_FIELD if name not in LOAD)


def _extra(values, name):
    return values.get(name, EXTRA_FIELDS[name].default)


def load_of(values):
    """Return the wheels that stand on the track (trackig_core.study.StaticLoad), in SI units.

    Parameters
    ----------
    values : mapping
        Values by name [display units]; those that are missing are as on a fresh page.
    """
    return tig.study.StaticLoad(**{name: to_si(name, _extra(values, name)) for name in LOAD})


def display_values(design):
    """Return the inputs that give a design, by name; a single-stage design leaves the second stage out.

    Parameters
    ----------
    design : trackig_core.TrackDesign
        A design whose rail is one of ``trackig_core.RAILS``.

    Returns
    -------
    dict
        Values for :class:`DesignInputs` [display units].
    """
    rail = next(key for key, rail in tig.RAILS.items() if rail == design.rail)
    names = [name for name in _DESIGN_NUMBERS if design.two_stage or name not in SECOND_STAGE]
    return {
        "two_stage": design.two_stage,
        "rail": rail,
        **{name: to_display(name, getattr(design, name)) for name in names},
        **{name: getattr(design, name) for name in SURROUNDINGS},
    }


def values_of(design, preset=None):
    """Return what puts a design on the sliders: what :meth:`DesignInputs.take` takes.

    Parameters
    ----------
    design : trackig_core.TrackDesign
        A design that sliders can show.
    preset : str, optional
        Key of ``trackig_core.PRESETS`` from which it departs; without one the sliders keep theirs.

    Returns
    -------
    dict
        Values by name of :data:`INPUTS` [display units]; a single-stage design leaves the second stage out.
    """
    return display_values(design) | ({} if preset is None else {"preset": preset})


def _number(name):
    """Return the parameter of a number, as the table of fields describes it."""
    field = EVERY_FIELD[name]
    opening = (
        field.to_display(getattr(tig.PRESETS[OPENING_PRESET], name)) if name in NUMBERS else field.default
    )
    return param.Number(
        default=opening,
        bounds=(field.low, field.high),
        step=field.step,
        label=field.labelled,
        doc=field.words,
        allow_None=bool(field.blank),
    )


class InputError(ValueError):
    """What a user gave is no value of an input; the message says why, and what is."""


RATIO = re.compile(r"[x×]\s*(?P<after>.+)|(?P<before>.+?)\s*[x×]", re.IGNORECASE)
"""How a dynamic over a static stiffness is typed: ``1.4x`` or ``× 1.4``."""


def read_input(name, given, dynamic=None):
    """Return the value of an input that a user gave.

    Parameters
    ----------
    name : str
        One of :data:`PHYSICAL`.
    given : object
        A value, or text as it was typed, with or without unit.
    dynamic : float, optional
        The dynamic stiffness, where a static one may be given as a part of it [display unit].

    Returns
    -------
    float, bool, str or None
        The value [display unit]; None where nothing was given and nothing is allowed.

    Raises
    ------
    InputError
        If it is none, or lies beyond the range.
    """
    parameter = DesignInputs.param[name]
    if name not in EVERY_FIELD:
        values = parameter.objects if isinstance(parameter, param.Selector) else (True, False)
        if type(given) not in (bool, str) or given not in values:
            raise InputError("choose one of what is offered")
        return given
    if parameter.allow_None and (given is None or (isinstance(given, str) and not given.strip())):
        return None
    unit, (low, high) = EVERY_FIELD[name].unit, parameter.bounds
    takes = f"{quantity_text(low)} to {quantity_text(high)} {unit}".rstrip()
    if isinstance(given, str):
        ratio = None if dynamic is None else RATIO.fullmatch(given.strip())
        try:
            if ratio is None:
                given = read_number(given, unit)
            else:
                given = _part(dynamic, read_number(ratio["after"] or ratio["before"], ""))
        except NumberError as error:
            raise InputError(f"{error}; this box takes {takes}") from None
    if not isinstance(given, Real) or isinstance(given, bool) or not low <= given <= high:
        raise InputError(f"give {takes}")
    return float(given)


def _part(dynamic, ratio):
    """Return the static stiffness of which a dynamic one is a multiple."""
    return six_figures(dynamic / ratio) if ratio > 0 else ratio


def preset_values(key):
    """Return all inputs as they are when a preset has been chosen on a fresh page.

    Parameters
    ----------
    key : str
        Key of ``trackig_core.PRESETS``.

    Returns
    -------
    dict
        Values by name of :data:`INPUTS` [display units]; what a single-stage preset lacks is as it opens.
    """
    opening = {name: DesignInputs.param[name].default for name in INPUTS}
    return {**opening, "preset": key, **display_values(tig.PRESETS[key])}


class DesignInputs(param.Parameterized):
    """A track design in display units, and the preset from which it departs."""

    preset = param.Selector(
        default=OPENING_PRESET,
        objects={PRESET_LABELS.get(key, key): key for key in tig.PRESETS},
        label="Track of Table 1",
    )
    two_stage = param.Boolean(default=True, label="Two-stage: blocks in boots")
    pad_stiffness = _number("pad_stiffness")
    pad_loss_factor = _number("pad_loss_factor")
    block_mass = _number("block_mass")
    boot_stiffness = _number("boot_stiffness")
    boot_loss_factor = _number("boot_loss_factor")
    fastener_spacing = _number("fastener_spacing")
    rail = param.Selector(
        default="60",
        objects={"60 (paper: 60 kg/m)" if key == "60" else key: key for key in tig.RAILS},
        label="Rail section",
    )
    wheel_mass = _number("wheel_mass")
    contact_stiffness = _number("contact_stiffness")
    stiffness_frequency = _number("stiffness_frequency")
    pad_static_stiffness = _number("pad_static_stiffness")
    boot_static_stiffness = _number("boot_static_stiffness")
    wheel_load = _number("wheel_load")
    wheelbase = _number("wheelbase")
    speed = _number("speed")
    suspension = param.ClassSelector(
        class_=tig.Suspension, default=None, allow_None=True, label=surroundings.LABELS["suspension"]
    )
    axle_positions = param.Parameter(
        default=surroundings.OFF["axle_positions"], label=surroundings.LABELS["axle_positions"]
    )
    ground = param.ClassSelector(
        class_=tig.Ground, default=None, allow_None=True, label=surroundings.LABELS["ground"]
    )
    modified = param.Boolean(default=False, doc="Whether the design differs from its preset.")
    refused = param.Dict(default={}, doc="Advice on what was given and not taken, by name of the input.")

    gesture = None
    """Number of the user's gesture to which a change belongs while it is noted; None: nobody says."""

    _taking = False

    @param.depends("preset", watch=True)
    def revert(self):
        """Set every input to the preset's value; inputs that the preset does not have keep theirs."""
        if not self._taking:
            self.param.update(**display_values(self.preset_design), refused={})
        self._note_modified()

    @property
    def preset_design(self):
        """The preset as published."""
        return tig.PRESETS[self.preset]

    def to_design(self):
        """Return the design in SI units.

        Returns
        -------
        trackig_core.TrackDesign
            The design; equal inputs give equal designs, whatever path led there.

        Raises
        ------
        trackig_core.DesignError
            If the inputs do not make a track.
        """
        return design_of(self.to_values())

    def to_values(self):
        """Return every input that a user sets, by name, float dust taken off: what :meth:`take` takes."""
        values = {name: getattr(self, name) for name in INPUTS}
        numbers = (name for name in (*NUMBERS, *EXTRAS) if values[name] is not None)
        return {**values, **{name: six_figures(values[name]) for name in numbers}}

    def to_load(self):
        """Return the wheels that stand on the track (trackig_core.study.StaticLoad), in SI units."""
        return load_of(self.to_values())

    def take(self, values):
        """Set several inputs as one change, the preset among them without reverting to it.

        Parameters
        ----------
        values : mapping
            Values by name of :data:`INPUTS`, such as :meth:`to_values` gave [display units].

        Raises
        ------
        ValueError
            If a value is not allowed; then nothing has changed.
        """
        check_values(values)
        self._taking = True
        try:
            self.param.update(**values, refused={})
        finally:
            self._taking = False

    def take_given(self, given, gesture=None):
        """Set what a user gave, as one change; what cannot be read stays as it was and is noted as refused.

        Parameters
        ----------
        given : mapping
            What was given, whatever it is, by name; names that are no inputs are passed over. A preset sets
            all other inputs first.
        gesture : int, optional
            Number of the gesture that gave it.
        """
        values, refused = self._surroundings(given)
        for name in (*PHYSICAL, *LOAD):
            if name in given and name not in SURROUNDINGS:
                dynamic = name.replace("_static", "") if "_static" in name else None
                try:
                    values[name] = read_input(name, given[name], dynamic and getattr(self, dynamic))
                except InputError as error:
                    refused[name] = str(error)
        self.gesture = gesture
        try:
            if given.get("preset") in tuple(tig.PRESETS):
                self.preset = given["preset"]
            self._refuse_apart(values, refused)
            earlier = {name: words for name, words in self.refused.items() if name not in values}
            self.param.update(**values, refused={**earlier, **refused})
        finally:
            self.gesture = None

    def _surroundings(self, given):
        """Return what was chosen of vehicle, axles and ground, and what was refused of it, by name."""
        values, refused = {}, {}
        for name in SURROUNDINGS:
            if name in given:
                if given[name] in surroundings.CHOICES[name].values():
                    now = {each: getattr(self, each) for each in SURROUNDINGS} | values
                    values |= surroundings.choose(name, given[name], now)
                elif given[name] != surroundings.OWN:
                    refused[name] = "choose one of what is offered"
        return values, refused

    def _refuse_apart(self, values, refused):
        """Refuse values, each of them allowed, that do not go with a study's own axles."""
        try:
            design_of(self.to_values() | values)
        except tig.DesignError as error:
            words = f"{surroundings.LABELS['axle_positions'].lower()} and speed then need {error.allowed}"
            for name in AXLES & values.keys():
                refused[name] = words
                del values[name]

    @param.depends("two_stage", watch=True)
    def _forget_second_stage(self):
        if not self.two_stage:
            self.refused = {name: words for name, words in self.refused.items() if name not in SECOND_STAGE}

    @param.depends(*PHYSICAL, watch=True)
    def _note_modified(self):
        self.modified = self.to_design() != self.preset_design


AXLES = {"axle_positions", "speed", "fastener_spacing"}
"""Inputs of which not all values go together."""


def check_values(values):
    """Raise a ValueError that says which, unless inputs can hold the values [display units]."""
    DesignInputs(**values)


class GainDefinition(param.Parameterized):
    """Which insertion gain is computed from a spectrum: a matter of looking, which needs no new solution."""

    summation = param.Selector(
        default="energy",
        objects={"Summed energy (paper)": "energy", "Coherent force": "coherent"},
        label="Over the supports",
    )
    reference = param.Selector(
        default="line",
        objects={
            "Straight line (paper)": "line",
            "Rigid track": "rigid",
            "Very stiff track, same ground": "stiff",
        },
        label="Against",
    )

    def gain(self, solution):
        """Return the insertion gain of a solution (trackig_core.InsertionGain), computed once."""
        return solution.gain_for(self.reference_of(solution.design), self.summation)

    def reference_of(self, design):
        """Return the reference of a design (str): the chosen one, or the one that its ground leaves."""
        return reference_for(design, self.reference)

    def levels_of(self, spectrum, solution):
        """Return the insertion gain of another spectrum of the design that was solved.

        Parameters
        ----------
        spectrum : trackig_core.ForceSpectrum
            The spectrum, such as that of the frequency-domain solution.
        solution : trackig_core.Solution
            A solution of the same design.

        Returns
        -------
        numpy.ndarray (21,)
            Insertion gain [dB].
        """
        reference = self.reference_of(solution.design)
        return tig.insertion_gain(
            spectrum,
            solution.design,
            solution.natural_frequencies.loaded_track,
            reference=reference,
            summation=self.summation,
            stiff=solution.stiff_spectrum(solution.design) if reference == "stiff" else None,
        ).levels
