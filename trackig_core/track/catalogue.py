"""The four tracks of the paper's Table 1. SI units."""

from trackig_core.names import named
from trackig_core.track.design import TrackDesign

PRESETS = named(
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
