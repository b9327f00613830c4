"""What the user sets, as plain parameters.

:class:`DesignInputs` holds the design in display units (kN/mm, kg, m), :class:`GainDefinition` which
insertion gain is shown. Designs in SI units become display values here, and back.
"""

import re
from dataclasses import replace
from numbers import Real

import param

import trackig_core as tig
from dashboard.fields import (
    CONTROLLED,
    EVERY_FIELD,
    EXTRA_FIELDS,
    EXTRAS,
    FIELDS,
    INPUTS,
    LOAD,
    NUMBERS,
    OPENING_PRESET,
    PHYSICAL,
    PRESET_LABELS,
    RAIL_FIELDS,
    SECOND_STAGE,
    SHOWN,
    SURROUNDINGS,
    six_figures,
    to_display,
    to_si,
)
from dashboard.formats import quantity_text
from dashboard.session import surroundings
from dashboard.session.bands import CHOICES as BAND_CHOICES
from dashboard.session.bands import PAPER, gain_in
from dashboard.session.special import (
    OWN_RAIL,
    is_curve,
    is_on_slider,
    on_slider,
    special_values,
    with_special,
)
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
    fields = {name: to_si(name, value) for name, value in given.items()}
    fields |= {name: values[name] for name in SURROUNDINGS if name in values}
    fields["rail"] = tig.RAILS[values["rail"]]
    return tig.TrackDesign(**with_special(fields, values.get("special", {})))


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
        Any design. What sliders do not show is ``special``; below it a slider stands at its end that is
        nearest, and where that is no number, nothing is said of it.

    Returns
    -------
    dict
        Values for :class:`DesignInputs` [display units].
    """
    known = {rail: {"rail": key} for key, rail in tig.RAILS.items()}
    numbers = {name: getattr(design, name) for name in NUMBERS}
    extras = [name for name in EXTRAS if name in _DESIGN_NUMBERS]
    return {
        "two_stage": design.two_stage,
        **known.get(design.rail, {}),
        **{name: on_slider(name, value) for name, value in numbers.items() if isinstance(value, float)},
        **{
            name: None if getattr(design, name) is None else on_slider(name, getattr(design, name))
            for name in extras
            if design.two_stage or name not in SECOND_STAGE
        },
        **{name: getattr(design, name) for name in SURROUNDINGS},
        "special": special_values(design),
    }


def values_of(design, preset=None):
    """Return what puts a design on the sliders: what :meth:`DesignInputs.take` takes.

    Parameters
    ----------
    design : trackig_core.TrackDesign
        Any design.
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


def read_input(name, given, reach=None, dynamic=None):
    """Return the value of an input that a user gave.

    Parameters
    ----------
    name : str
        One of :data:`CONTROLLED`, or a number of a rail.
    given : object
        A value, or text as it was typed, with or without unit.
    reach : tuple of float, optional
        Least and greatest value [display unit]; by default those that the box takes.
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
    field = EVERY_FIELD.get(name) or RAIL_FIELDS.get(name)
    if field is None:
        parameter = DesignInputs.param[name]
        values = parameter.objects if isinstance(parameter, param.Selector) else (True, False)
        if type(given) not in (bool, str) or given not in values:
            raise InputError("choose one of what is offered")
        return given
    if field.blank and (given is None or (isinstance(given, str) and not given.strip())):
        return None
    unit, (low, high) = field.unit, reach or field.taken
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
    special = param.Dict(
        default={},
        doc="What stands in the place of a slider or choice, by field [SI units]; never changed in place.",
    )
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

    def __init__(self, **params):
        super().__init__(**params)
        self._as_whole = False
        self._reach = {}
        self.param.watch(self._give_way, [*NUMBERS, *EXTRAS, "rail"])

    @param.depends("preset", watch=True)
    def revert(self):
        """Set every input to the preset's value; inputs that the preset does not have keep theirs."""
        if not self._as_whole:
            self._set(display_values(self.preset_design), {})
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

    def to_shown(self):
        """Return what the controls show, by name [display units].

        Numbers beyond a slider are there as they are, a rail of one's own as :data:`OWN_RAIL`, and the
        numbers of the rail whichever it is.
        """
        values = {name: getattr(self, name) for name in (*SHOWN, *EXTRAS)}
        numbers = {name: value for name, value in self.special.items() if name in EVERY_FIELD}
        for name, value in numbers.items():
            if not is_curve(value):
                values[name] = to_display(name, value)
        rail = self.to_design().rail
        of_rail = {name: field.to_display(getattr(rail, name)) for name, field in RAIL_FIELDS.items()}
        return {**values, **of_rail, "rail": OWN_RAIL if "rail" in self.special else self.rail}

    def take(self, values):
        """Set several inputs as one change, the preset among them without reverting to it.

        Parameters
        ----------
        values : mapping
            Values by name of :data:`INPUTS`, such as :meth:`to_values` gave [display units]. Unless they say
            what is special, it gives way where they set something else.

        Raises
        ------
        ValueError
            If a value is not allowed; then nothing has changed.
        """
        check_values(values)
        self._set({"special": self._special_without(values), **values}, {})

    def take_given(self, given, gesture=None):
        """Set what a user gave, as one change; what cannot be read stays as it was and is noted as refused.

        Parameters
        ----------
        given : mapping
            What was given, whatever it is, by name; names that are no inputs are passed over. A preset sets
            all other inputs first. A number beyond a slider is taken where its box takes more, or the slider
            has been extended.
        gesture : int, optional
            Number of the gesture that gave it.
        """
        values, refused = self._surroundings(given)
        for name in (*CONTROLLED, *EXTRAS, *RAIL_FIELDS):
            if name in given and (name, given[name]) != ("rail", OWN_RAIL):
                dynamic = name.replace("_static", "") if "_static" in name else None
                try:
                    values[name] = read_input(
                        name, given[name], self._reach.get(name), dynamic and getattr(self, dynamic)
                    )
                except InputError as error:
                    refused[name] = str(error)
        self.gesture = gesture
        try:
            if given.get("preset") in tuple(tig.PRESETS):
                self.preset = given["preset"]
            self._refuse_apart(values, refused)
            earlier = {name: words for name, words in self.refused.items() if name not in values}
            self._set(self._with_special(values, given.get("rail")), {**earlier, **refused})
        finally:
            self.gesture = None

    def _set(self, values, refused):
        """Set inputs as one change, as they are."""
        self._as_whole = True
        try:
            self.param.update(**values, refused=refused)
        finally:
            self._as_whole = False

    def _with_special(self, values, rail):
        """Return what was given as inputs, what no control holds as special."""
        special = self._special_without(values)
        of_rail = {name: values.pop(name) for name in RAIL_FIELDS if name in values}
        if of_rail or rail == OWN_RAIL:
            special["rail"] = self._own_rail(of_rail)
        for name in FIELDS.keys() & values.keys():
            if not is_on_slider(name, exact := to_si(name, values[name])):
                special[name], values[name] = exact, on_slider(name, exact)
        return {**values, "special": special}

    def _own_rail(self, changes):
        """Return the rail as one of its own, with other numbers [display units]."""
        rail = self.to_design().rail
        name = OWN_RAIL if rail in tig.RAILS.values() else rail.name
        numbers = {each: RAIL_FIELDS[each].to_si(value) for each, value in changes.items()}
        return replace(rail, name=name, **numbers)

    def _special_without(self, values):
        """Return what is special, but of the inputs that are set."""
        return {name: value for name, value in self.special.items() if name not in values}

    def _give_way(self, *events):
        """Let what is special give way to what is set one by one."""
        if not self._as_whole:
            self.special = self._special_without({event.name for event in events})

    @param.depends("special", watch=True)
    def _extend(self):
        """Note how far sliders reach that were extended."""
        fields = {**EVERY_FIELD, **RAIL_FIELDS}
        special = self.special.items()
        numbers = {name: each for name, each in special if name in EVERY_FIELD and not is_curve(each)}
        if rail := self.special.get("rail"):
            numbers |= {name: getattr(rail, name) for name in RAIL_FIELDS}
        for name, value in numbers.items():
            field, shown = fields[name], fields[name].to_display(value)
            low, high = self._reach.get(name, field.taken)
            self._reach[name] = min(low, shown), max(high, shown)

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
    bands = param.Selector(default=PAPER, objects=BAND_CHOICES, label="Bands shown")

    def gain(self, solution):
        """Return the insertion gain of a solution (trackig_core.InsertionGain), computed once."""
        return solution.gain_for(self.reference_of(solution.design), self.summation)

    def gain_shown(self, solution):
        """Return the insertion gain of a solution in the bands that are shown (InsertionGain)."""
        return gain_in(self.bands, solution, self.reference_of(solution.design), self.summation)

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
