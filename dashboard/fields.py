"""The table of a design's numbers as they are shown: what they are called, units, sliders, help.

Sliders, report, comparison table, link, study and lessons read it. The ranges here are those of the sliders
[display units]; what the core takes [SI] stands in ``trackig_core.track.design.RANGES``.
"""

from dataclasses import dataclass

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

    @property
    def labelled(self):
        """Label and unit, as on the sliders."""
        return f"{self.label}, {self.unit}" if self.unit else self.label

    def to_si(self, value):
        """Return a display value in the core's unit."""
        return six_figures(value * self.factor)

    def to_display(self, value):
        """Return a design's value in the unit that is shown."""
        return six_figures(value / self.factor)


_STIFF = ("kN/mm", NEWTON_PER_METRE)

FIELDS = {
    field.name: field
    for field in (
        Field(
            *("pad_stiffness", "Pad stiffness", *_STIFF, 10, 2000, 1, "Rail pad"),
            "Dynamic stiffness at 50 Hz between rail and block, or ground where there is none.",
            logarithmic=True,
        ),
        Field(
            *("pad_loss_factor", "Pad loss factor", "", 1.0, 0.01, 0.5, 0.01, "Rail pad"),
            "Part of the pad's stiffness that damps: it limits the peak at the loaded-track frequency.",
        ),
        Field(
            *("block_mass", "Block mass", "kg", 1.0, 10, 500, 1, "Block and boot"),
            "Mass between pad and boot; above the coupled-block frequency it isolates.",
            second_stage=True,
        ),
        Field(
            *("boot_stiffness", "Boot stiffness", *_STIFF, 2, 200, 0.5, "Block and boot"),
            "Dynamic stiffness at 50 Hz under the block; the softer, the lower isolation begins.",
            logarithmic=True,
            second_stage=True,
        ),
        Field(
            *("boot_loss_factor", "Boot loss factor", "", 1.0, 0.01, 0.5, 0.01, "Block and boot"),
            "Part of the boot's stiffness that damps.",
            second_stage=True,
        ),
        Field(
            *("fastener_spacing", "Fastener spacing", "m", 1.0, 0.2, 1.0, 0.01, "Track"),
            "Distance between supports along the rail: the wider, the softer the track.",
        ),
        Field(
            *("wheel_mass", "Unsprung wheel mass", "kg", 1.0, 200, 1500, 10, "Vehicle"),
            "Mass that bounces on the track below the primary suspension, of one wheel.",
        ),
        Field(
            *("contact_stiffness", "Contact stiffness", *_STIFF, 200, 5000, 10, "Advanced"),
            "Hertzian spring between wheel and rail; in series with the track's stiffness.",
            logarithmic=True,
        ),
    )
}
"""Every number of a design by its name, in the order of the load path."""

RAIL_FIELDS = {
    field.name: field
    for field in (
        Field(
            *("mass_per_metre", "Rail mass", "kg/m", 1.0, 20, 100, 0.1, "Track"),
            "Mass per metre of a rail of one's own.",
        ),
        Field(
            *("bending_stiffness", "Rail EI", "MN m²", 1e6, 0.5, 20, 0.01, "Track"),
            "Young's modulus times second moment of area; for steel, 0.0021 MN m² for each cm⁴.",
        ),
    )
}
"""The numbers of a rail by name; a known section has its own."""

CLOSED_GROUPS = ("Advanced",)
"""Groups of which the sidebar shows no more than the heading until somebody opens them."""

NUMBERS = tuple(FIELDS)
"""Inputs that are numbers."""

SECOND_STAGE = tuple(name for name, field in FIELDS.items() if field.second_stage)
"""Inputs that a single-stage track does not have."""

STIFFNESSES = tuple(name for name, field in FIELDS.items() if field.logarithmic)
"""Inputs that span decades."""

CONTROLLED = (*NUMBERS, "two_stage", "rail")
"""Inputs of a design that have a slider, a switch or a choice."""

PHYSICAL = (*CONTROLLED, "special")
"""Inputs that make the design: a change of any asks for a new solution. What is special stands in the place
of what has a control."""

SHOWN = ("preset", *CONTROLLED)
"""What the sidebar shows of a design, and what a link holds."""

INPUTS = ("preset", *PHYSICAL)
"""All that a user sets of a design."""


def to_si(name, value):
    """Return an input's display value in the core's unit."""
    return FIELDS[name].to_si(value)


def to_display(name, value):
    """Return a design's value in the unit that is shown."""
    return FIELDS[name].to_display(value)
