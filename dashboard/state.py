"""What the user sets and what came of it, as plain parameters.

:class:`DesignInputs` holds the design in display units (kN/mm, kg, m), :class:`Outcome` the last
picture and how the solver fares. The one rule: units are converted here and nowhere else, and
nothing here knows how it is shown.
"""

import dataclasses
from dataclasses import dataclass

import numpy as np
import param

import trackig_core as tig

OPENING_PRESET = "booted-block-low-mass"
"""The preset on which the dashboard opens."""

NEWTON_PER_METRE = 1e6
"""One kN/mm in N/m."""

KILONEWTON = 1e3
"""One kN in N."""

PRESET_LABELS = {
    "slab-track": "Slab track",
    "booted-sleeper": "Booted sleeper",
    "booted-block-low-mass": "Booted block, low mass",
    "booted-block-high-mass": "Booted block, high mass",
}
"""What the presets are called on the screen."""

SECOND_STAGE = ("block_mass", "boot_stiffness", "boot_loss_factor")
"""Inputs that a single-stage track does not have."""

STIFFNESSES = ("pad_stiffness", "boot_stiffness", "contact_stiffness")
"""Inputs shown in kN/mm that the core takes in N/m; they span decades, so their sliders are logarithmic."""


def six_figures(value):
    """Return ``value`` without the float dust that sliders and unit conversion leave."""
    return float(f"{value:.6g}")


NUMBERS = (
    "pad_stiffness",
    "pad_loss_factor",
    "block_mass",
    "boot_stiffness",
    "boot_loss_factor",
    "fastener_spacing",
    "wheel_mass",
    "contact_stiffness",
)
"""Inputs that are numbers."""

PHYSICAL = (*NUMBERS, "two_stage", "rail")
"""Inputs that make the design: a change of any asks for a new solution."""

INPUTS = ("preset", *PHYSICAL)
"""All that a user sets of a design."""


def to_si(name, value):
    """Return an input's display value in the core's unit."""
    return six_figures(value * NEWTON_PER_METRE if name in STIFFNESSES else value)


def to_display(name, value):
    """Return a design's value in the unit that is shown."""
    return six_figures(value / NEWTON_PER_METRE if name in STIFFNESSES else value)


def design_of(values):
    """Return the design of display values, in SI units.

    Parameters
    ----------
    values : mapping
        Values of :data:`PHYSICAL` by name [display units]; the second stage's may stand there unused.

    Returns
    -------
    trackig_core.TrackDesign
        The design; equal values give equal designs, whatever path led there.

    Raises
    ------
    trackig_core.DesignError
        If the values do not make a track.
    """
    names = [name for name in NUMBERS if values["two_stage"] or name not in SECOND_STAGE]
    return tig.TrackDesign(
        rail=tig.RAILS[values["rail"]], **{name: to_si(name, values[name]) for name in names}
    )


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
    numbers = {name: getattr(design, name) for name in NUMBERS}
    return {
        "two_stage": design.two_stage,
        "rail": rail,
        **{name: to_display(name, value) for name, value in numbers.items() if value is not None},
    }


def _number(name, low, high, step, label):
    opening = to_display(name, getattr(tig.PRESETS[OPENING_PRESET], name))
    return param.Number(default=opening, bounds=(low, high), step=step, label=label)


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
    pad_stiffness = _number("pad_stiffness", 10, 2000, 1, "Pad stiffness, kN/mm")
    pad_loss_factor = _number("pad_loss_factor", 0.01, 0.5, 0.01, "Pad loss factor")
    block_mass = _number("block_mass", 10, 500, 1, "Block mass, kg")
    boot_stiffness = _number("boot_stiffness", 2, 200, 0.5, "Boot stiffness, kN/mm")
    boot_loss_factor = _number("boot_loss_factor", 0.01, 0.5, 0.01, "Boot loss factor")
    fastener_spacing = _number("fastener_spacing", 0.2, 1.0, 0.01, "Fastener spacing, m")
    rail = param.Selector(
        default="60",
        objects={"60 (paper: 60 kg/m)" if key == "60" else key: key for key in tig.RAILS},
        label="Rail section",
    )
    wheel_mass = _number("wheel_mass", 200, 1500, 10, "Unsprung wheel mass, kg")
    contact_stiffness = _number("contact_stiffness", 200, 5000, 10, "Contact stiffness, kN/mm")
    modified = param.Boolean(default=False, doc="Whether the design differs from its preset.")

    _taking = False

    @param.depends("preset", watch=True)
    def revert(self):
        """Set every input to the preset's value; inputs that the preset does not have keep theirs."""
        if not self._taking:
            self.param.update(**display_values(self.preset_design))
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
        return {**values, **{name: six_figures(values[name]) for name in NUMBERS}}

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
            self.param.update(**values)
        finally:
            self._taking = False

    @param.depends(*PHYSICAL, watch=True)
    def _note_modified(self):
        self.modified = self.to_design() != self.preset_design


def check_values(values):
    """Raise a ValueError that says which, unless inputs can hold the values [display units]."""
    DesignInputs(**values)


@dataclass(frozen=True, eq=False)
class Picture:
    """What the views show of one solution: all of it but the force under every single support.

    Attributes
    ----------
    solution : trackig_core.Solution
        The solution without its time history, which is a hundred times larger than the rest.
    time : numpy.ndarray (samples,) or None [s]
        Time since the step in contact compression; None, as are the next three, when nothing was stepped
        in time.
    loaded_support_force, total_force : numpy.ndarray (samples,) or None [kN]
        Force into the ground under the wheel, and summed over all supports.
    step : float or None [mm]
        Height of the step.
    seconds : float [s]
        How long the solver took.
    """

    solution: tig.Solution
    time: np.ndarray | None
    loaded_support_force: np.ndarray | None
    total_force: np.ndarray | None
    step: float | None
    seconds: float

    @classmethod
    def of(cls, solution, seconds):
        """Return what is shown of a solution that took some time [s]."""
        if solution.history is None:
            return cls(solution, None, None, None, None, seconds)
        return cls(
            solution=dataclasses.replace(solution, history=None),
            time=solution.time,
            loaded_support_force=solution.loaded_support_force / KILONEWTON,
            total_force=solution.total_force / KILONEWTON,
            step=1000 * solution.history.step,
            seconds=seconds,
        )

    @property
    def design(self):
        """The design that was solved."""
        return self.solution.design


@dataclass(frozen=True, eq=False)
class Checked:
    """A picture, and what theory says of it.

    Attributes
    ----------
    picture : Picture
        What was checked.
    theory : trackig_core.Verification or None
        Exact answers and convergence studies; None if there are none.
    problem : str
        Why there are none, else empty.
    """

    picture: Picture
    theory: tig.Verification | None
    problem: str = ""


class Presentation(param.Parameterized):
    """How insertion gain is reckoned from a spectrum: a matter of looking, which needs no new solution."""

    summation = param.Selector(
        default="energy",
        objects={"Summed energy (paper)": "energy", "Coherent force": "coherent"},
        label="Over the supports",
    )
    reference = param.Selector(
        default="line",
        objects={"Straight line (paper)": "line", "Rigid track": "rigid"},
        label="Against",
    )

    def levels(self, solution, spectrum=None):
        """Return the insertion gain of a solution, as chosen.

        Parameters
        ----------
        solution : trackig_core.Solution
            The solution.
        spectrum : trackig_core.ForceSpectrum, optional
            Another spectrum of the same design, in place of the solution's own.

        Returns
        -------
        numpy.ndarray (21,)
            Insertion gain [dB].
        """
        return tig.insertion_gain(
            solution.spectrum if spectrum is None else spectrum,
            solution.design,
            solution.natural_frequencies.loaded_track,
            reference=self.reference,
            summation=self.summation,
        ).levels


class Outcome(param.Parameterized):
    """The last good picture, how the solver fares, and what theory says of the picture."""

    picture = param.ClassSelector(class_=Picture, default=None, allow_None=True, doc="Last good solution.")
    preset_picture = param.ClassSelector(
        class_=Picture, default=None, allow_None=True, doc="The preset's, while the design is modified."
    )
    busy = param.Boolean(default=False, doc="Whether a solution is awaited.")
    compiling = param.Boolean(default=False, doc="Whether the solver is still being compiled.")
    progress = param.Number(
        default=None, bounds=(0, 1), allow_None=True, doc="Part of a long run that is done; None when short."
    )
    from_cache = param.Boolean(default=False, doc="Whether the picture was there already.")
    checking = param.Boolean(default=False, doc="Whether anybody looks at the checks.")
    checked = param.ClassSelector(
        class_=Checked, default=None, allow_None=True, doc="The picture that was last held against theory."
    )
    problem = param.String(default="", doc="Why the picture is not that of the inputs; empty when it is.")

    @property
    def stale(self):
        """Whether the picture is that of earlier inputs, and will be for a while."""
        return bool(self.problem) or self.progress is not None
