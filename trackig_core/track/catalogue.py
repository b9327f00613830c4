"""Rail sections and the four tracks of the paper's Table 1, each with its source.

SI units. The one rule: nothing here without a source.
"""

from types import MappingProxyType

from trackig_core.track.design import PAPER_RAIL, Rail, TrackDesign

STEEL_MODULUS = 210e9
"""Young's modulus of rail steel [Pa]."""


def _section(name, mass_per_metre, second_moment_cm4):
    return Rail(name, mass_per_metre, STEEL_MODULUS * second_moment_cm4 * 1e-8)


RAILS = MappingProxyType(
    {
        rail.name: rail
        for rail in (
            PAPER_RAIL,
            _section("49E1", 49.39, 1816),
            _section("54E1", 54.77, 2338),
            _section("56E1", 56.30, 2321),
            _section("60E1", 60.21, 3038),
            _section("60E2", 60.03, 3022),
        )
    }
)
"""Rail sections by name: "60" is the paper's; the others are nominal figures of EN 13674-1 (kg/m, cm4)."""

PRESETS = MappingProxyType(
    {
        "slab-track": TrackDesign(
            pad_stiffness=1000e6,
            pad_loss_factor=0.15,
            fastener_spacing=0.25,
            wheel_mass=950.0,
        ),
        "booted-sleeper": TrackDesign(
            pad_stiffness=150e6,
            pad_loss_factor=0.2,
            block_mass=210.0,
            boot_stiffness=31.5e6,
            boot_loss_factor=0.2,
            fastener_spacing=0.75,
            wheel_mass=450.0,
        ),
        "booted-block-low-mass": TrackDesign(
            pad_stiffness=100e6,
            pad_loss_factor=0.2,
            block_mass=45.0,
            boot_stiffness=28e6,
            boot_loss_factor=0.2,
            fastener_spacing=0.6,
            wheel_mass=880.0,
        ),
        "booted-block-high-mass": TrackDesign(
            pad_stiffness=200e6,
            pad_loss_factor=0.2,
            block_mass=120.0,
            boot_stiffness=14e6,
            boot_loss_factor=0.2,
            fastener_spacing=0.6,
            wheel_mass=880.0,
        ),
    }
)
"""The paper's Table 1. Its stiffness columns are headed kN/m; the figures are kN/mm, since with kN/m every
resonance would fall by the square root of a thousand, far below those the paper's text reports."""
