"""The table of a design's numbers as they are shown: what they are called, units, sliders, help.

Sliders, report, comparison table, link, study and lessons read it. The ranges here are those of the sliders
[display units]: where a designer chooses the number, the core's ``SEARCHED_RANGES``, which its questions
cover too. What the core takes [SI] stands in ``RANGES`` of ``trackig_core.track.fields``.
"""

from dataclasses import dataclass

from trackig_core.decide.numbers import is_logarithmic
from trackig_core.track.fields import DEFAULT_WHEEL_LOAD, GIVEN, RANGES, SEARCHED_RANGES

OPENING_PRESET = "booted-block-low-mass"
"""The preset on which the dashboard opens."""

NEWTON_PER_METRE = 1e6
"""One kN/mm in N/m."""

KILONEWTON = 1e3
"""One kN in N."""

KILOMETRE_PER_HOUR = 1 / 3.6
"""One km/h in m/s."""

LOSS_FACTOR_MOST = RANGES["pad_loss_factor"][1]
"""Greatest loss factor that the law of damping is fitted to [-]."""

PRESET_LABELS = {
    "slab-track": "Slab track",
    "booted-sleeper": "Booted sleeper",
    "booted-block-low-mass": "Booted block, low mass",
    "booted-block-high-mass": "Booted block, high mass",
}
"""What the presets are called on the screen."""


def six_figures(value):
    """Return ``value`` without the float dust that sliders and unit conversion leave."""
    return float(f"{value:.6g}")


@dataclass(frozen=True)
class Field:
    """One number of a design as it is shown.

    Attributes
    ----------
    name : str
        Its name in ``trackig_core.TrackDesign``.
    label : str
        What it is called, without its unit.
    unit : str
        The unit that is shown; empty if it has none.
    factor : float
        What one display unit is in SI units.
    low, high : float
        Range of the slider [display units].
    step : float
        Step of the slider [display units].
    group : str
        Heading below which it stands in the sidebar; groups follow each other as they first occur here.
    words : str
        One line of physics.
    logarithmic : bool
        Whether the slider is: the range spans decades.
    second_stage : bool
        Whether a single-stage track lacks it.
    default : float or None
        What it is unless somebody says otherwise [display units]; None: nothing.
    blank : str
        What its box says where it may be left empty; empty: it may not.
    figures : int
        Figures of the core's value [-]: more where the units are no power of ten apart.
    most : float or None
        Greatest value that its box takes [display units], where the slider then reaches further; None: the
        slider's.
    """

    name: str
    label: str
    unit: str
    factor: float
    low: float
    high: float
    step: float
    group: str
    words: str
    logarithmic: bool = False
    second_stage: bool = False
    default: float | None = None
    blank: str = ""
    figures: int = 6
    most: float | None = None

    @property
    def taken(self):
        """Least and greatest value that its box takes [display units]."""
        return self.low, self.high if self.most is None else self.most

    @property
    def whose(self):
        """Whose the number is, such as the vehicle's; empty if it is the track's own."""
        return GIVEN.get(self.name, "")

    @property
    def marked(self):
        """Label, and whose the number is if it is not the track's: for where designs are chosen."""
        return f"{self.label} ({self.whose})" if self.whose else self.label

    @property
    def labelled(self):
        """Label and unit, as on the sliders."""
        return f"{self.label}, {self.unit}" if self.unit else self.label

    def to_si(self, value):
        """Return a display value in the core's unit; nothing stays nothing."""
        return None if value is None else float(f"{value * self.factor:.{self.figures}g}")

    def to_display(self, value):
        """Return a design's value in the unit that is shown; nothing stays nothing."""
        return None if value is None else six_figures(value / self.factor)


_STIFF = ("kN/mm", NEWTON_PER_METRE)


def _of_range(name, label, unit, factor, step, *rest, **options):
    """Return a number (Field) over the range that the core searches."""
    low, high = (six_figures(end / factor) for end in SEARCHED_RANGES[name])
    options.setdefault("logarithmic", is_logarithmic(name))
    return Field(name, label, unit, factor, low, high, step, *rest, **options)


FIELDS = {
    field.name: field
    for field in (
        _of_range(
            *("pad_stiffness", "Pad stiffness", *_STIFF, 1, "Rail pad"),
            "Dynamic stiffness between rail and block, or ground; at 50 Hz unless stated.",
        ),
        _of_range(
            *("pad_loss_factor", "Pad loss factor", "", 1.0, 0.01, "Rail pad"),
            "Part of the pad's stiffness that damps: it limits the peak at the loaded track. Up to 2.",
            most=LOSS_FACTOR_MOST,
        ),
        _of_range(
            *("block_mass", "Block mass", "kg", 1.0, 1, "Block and boot"),
            "Mass between pad and boot; above the coupled-block frequency it isolates.",
            second_stage=True,
        ),
        _of_range(
            *("boot_stiffness", "Boot stiffness", *_STIFF, 0.5, "Block and boot"),
            "Dynamic stiffness under the block, at 50 Hz unless stated; the softer, the lower it isolates.",
            second_stage=True,
        ),
        _of_range(
            *("boot_loss_factor", "Boot loss factor", "", 1.0, 0.01, "Block and boot"),
            "Part of the boot's stiffness that damps. Up to 2.",
            most=LOSS_FACTOR_MOST,
            second_stage=True,
        ),
        _of_range(
            *("fastener_spacing", "Fastener spacing", "m", 1.0, 0.01, "Track"),
            "Distance between supports along the rail: the wider, the softer the track.",
        ),
        _of_range(
            *("wheel_mass", "Unsprung wheel mass", "kg", 1.0, 10, "Vehicle"),
            "Mass that bounces on the track below the primary suspension, of one wheel.",
        ),
        _of_range(
            *("contact_stiffness", "Contact stiffness", *_STIFF, 10, "Advanced"),
            "Hertzian spring between wheel and rail; in series with the track's stiffness.",
        ),
    )
}
"""Every number that each design needs by its name, in the order of the load path."""

RAIL_FIELDS = {
    field.name: field
    for field in (
        Field(
            *("mass_per_metre", "Rail mass", "kg/m", 1.0, 20, 100, 0.1, "Track"),
            "Mass per metre of a rail of one's own.",
        ),
        Field(
            *("bending_stiffness", "Rail EI", "MN m²", 1e6, 0.5, 20, 0.01, "Track"),
            "Young's modulus times second moment of area; a second moment alone (3038 cm4) is taken as "
            "steel's, E = 210 GPa.",
        ),
    )
}
"""The numbers of a rail by name; a known section has its own."""

SUSPENDED, GROUND = "Suspension and axles", "Ground"
"""Groups of what the simplified model leaves out."""

_STATIC_WORDS = (
    "Stiffness under a slow load, lower than the dynamic one; type 1.4x to give the dynamic over the static. "
    "Nothing but the rail's deflection depends on it."
)

EXTRA_FIELDS = {
    field.name: field
    for field in (
        Field(
            *("stiffness_frequency", "Stiffness stated at", "Hz", 1.0, 1, 200, 1, "Advanced"),
            "Frequency at which pad and boot have their dynamic stiffness: 50 Hz in the paper, 10 or 20 Hz "
            "in many test reports.",
            logarithmic=True,
            default=50.0,
        ),
        Field(
            *("speed", "Speed", "km/h", KILOMETRE_PER_HOUR, 20, 360, 5, SUSPENDED),
            "At which all wheels pass the same roughness, one after the other; empty: each has its own. One "
            "wheel meets its roughness alone, at any speed.",
            blank="independent roughness",
            figures=12,
        ),
        Field(
            *("pad_static_stiffness", "Pad static stiffness", *_STIFF, 4, 2000, 1, "Statics"),
            _STATIC_WORDS,
            logarithmic=True,
            blank="not stated",
        ),
        Field(
            *("boot_static_stiffness", "Boot static stiffness", *_STIFF, 0.8, 200, 0.5, "Statics"),
            _STATIC_WORDS,
            logarithmic=True,
            second_stage=True,
            blank="not stated",
        ),
        Field(
            *("wheel_load", "Wheel load", "kN", KILONEWTON, 10, 200, 1, "Statics"),
            "Load of a standing wheel that sinks the rail: half an axle load.",
            default=DEFAULT_WHEEL_LOAD / KILONEWTON,
        ),
        Field(
            *("wheelbase", "Second wheel at", "m", 1.0, 0.5, 20, 0.1, "Statics"),
            "Distance to a second wheel, rounded to a third of the fastener spacing; empty: one wheel.",
            blank="one wheel",
        ),
    )
}
"""Numbers that may be left as they are, by name: off, they change nothing."""

EVERY_FIELD = FIELDS | EXTRA_FIELDS
"""Every number that the sidebar sets, by its name."""

AROUND_FIELDS = {
    field.name: field
    for field in (
        _of_range(
            *("suspension.primary_stiffness", "Primary stiffness", "kN/mm", NEWTON_PER_METRE, 0.1, SUSPENDED),
            "Of the springs between a wheel and the bogie.",
        ),
        _of_range(
            *("suspension.primary_damping", "Primary damping", "kN s/m", KILONEWTON, 1, SUSPENDED),
            "Of the dampers between a wheel and the bogie.",
        ),
        _of_range(
            *("suspension.bogie_mass", "Bogie mass per wheel", "kg", 1.0, 10, SUSPENDED),
            "Share of the bogie that one wheel carries.",
        ),
        _of_range(
            *("suspension.secondary_stiffness", "Secondary stiffness", "kN/mm", NEWTON_PER_METRE, 0.01),
            *(SUSPENDED, "Of the springs between bogie and body, per wheel."),
        ),
        _of_range(
            *("suspension.secondary_damping", "Secondary damping", "kN s/m", KILONEWTON, 1, SUSPENDED),
            "Of the dampers between bogie and body, per wheel.",
        ),
        _of_range(
            *("suspension.body_mass", "Body mass per wheel", "kg", 1.0, 10, SUSPENDED),
            "Share of the body that one wheel carries.",
        ),
        _of_range(
            *("ground.stiffness", "Ground stiffness", *_STIFF, 1, GROUND),
            "Of the ground under one support.",
        ),
        _of_range(
            *("ground.damping", "Ground damping", "kN s/m", KILONEWTON, 1, GROUND),
            "What the ground under one support radiates.",
        ),
        _of_range(
            *("ground.mass", "Ground mass", "kg", 1.0, 1, GROUND),
            "Of the ground that moves with a support.",
        ),
    )
}
"""Numbers of suspension and ground by path: they have no slider, and questions may be about them."""

ASKED_FIELDS = FIELDS | AROUND_FIELDS | {"speed": EXTRA_FIELDS["speed"]}
"""Every number about which the questions of the tab Decide may be, by name or path."""

GROUPS = ("Rail pad", "Block and boot", "Track", "Vehicle", SUSPENDED, GROUND, "Advanced", "Statics")
"""Groups of the sidebar, in its order."""

CLOSED_GROUPS = (SUSPENDED, GROUND, "Advanced", "Statics")
"""Groups of which the sidebar shows no more than the heading until somebody opens them."""

NUMBERS = tuple(FIELDS)
"""Inputs that are numbers, and that every design needs."""

EXTRAS = tuple(EXTRA_FIELDS)
"""Inputs that are numbers, and that may be left as they are."""

LOAD = ("wheel_load", "wheelbase")
"""Inputs that are no part of a design: the wheels that stand on it."""

SECOND_STAGE = tuple(name for name, field in EVERY_FIELD.items() if field.second_stage)
"""Inputs that a single-stage track does not have."""

STIFFNESSES = tuple(name for name, field in FIELDS.items() if field.logarithmic)
"""Inputs that span decades."""

CONTROLLED = (*NUMBERS, "two_stage", "rail")
"""Inputs of a design that have a slider, a switch or a choice, and that every design needs."""

SURROUNDINGS = ("suspension", "axle_positions", "ground")
"""Inputs that are off in the simplified model, in SI units, chosen from the catalogue or a study's own."""

PHYSICAL = (*CONTROLLED, *(name for name in EXTRAS if name not in LOAD), *SURROUNDINGS, "special")
"""Inputs that make the design: a change of any asks for a new solution. What is special stands in the place
of what has a control."""

SHOWN = ("preset", *CONTROLLED)
"""What every link holds of a design; extra numbers stand there where they are set."""

INPUTS = ("preset", *PHYSICAL, *LOAD)
"""All that a user sets of a design, and of the wheels that stand on it."""


def to_si(name, value):
    """Return an input's display value in the core's unit."""
    return EVERY_FIELD[name].to_si(value)


def to_display(name, value):
    """Return a design's value in the unit that is shown."""
    return EVERY_FIELD[name].to_display(value)
