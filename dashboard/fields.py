"""The fields of a design as they are shown: names, units and the conversion between them and SI units."""

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
