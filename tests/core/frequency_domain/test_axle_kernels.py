"""Compiled solution of tracks with suspension, axles and ground against that of any lattice in NumPy."""

import itertools

import numpy as np
import pytest

import trackig_core as tig
from trackig_core.frequency_domain import axle_kernels, axles, floquet_waves
from trackig_core.frequency_domain.lattice import INFINITE
from trackig_core.frequency_domain.refinement import banded_spectrum, refined_spectrum, resolved_spectrum
from trackig_core.frequency_domain.track_model import track_model

FREQUENCY = np.geomspace(3, 560, 60)
AXLES = ((0.0,), (0.2,), (0.0, 2.1), (-0.4, 1.8, 14.2))


def surrounded():
    """Yield tracks of Table 1 under every vehicle, on every ground, with several axles."""
    vehicles, grounds = [None, *tig.VEHICLES.values()], [None, *tig.GROUNDS.values()]
    for preset, vehicle, ground, places in itertools.product(tig.PRESETS.values(), vehicles, grounds, AXLES):
        suspension = vehicle and vehicle.suspension
        yield preset.replace(suspension=suspension, ground=ground, axle_positions=places)


@pytest.mark.parametrize("speed", [None, 25.0])
def test_every_surrounding_is_solved_as_on_any_lattice(speed):
    for design in surrounded():
        model = track_model(design.replace(speed=speed))
        compiled = floquet_waves._compiled_spectrum(model, FREQUENCY, 1e-4)
        peer = floquet_waves._lattice_spectrum(model, FREQUENCY, 1e-4, INFINITE)
        np.testing.assert_allclose(compiled.energy, peer.energy, rtol=1e-10)
        np.testing.assert_allclose(compiled.coherent_energy, peer.coherent_energy, rtol=1e-10)


def test_the_simplified_model_is_one_of_its_cases():
    for design in tig.PRESETS.values():
        spectrum = banded_spectrum(design)
        again = floquet_waves.exact_spectrum(design, spectrum.frequency, spectrum.step)
        np.testing.assert_allclose(again.energy, spectrum.energy, rtol=1e-9)


def test_refinement_ends_at_the_same_frequencies_as_in_python():
    vehicle, ground = tig.VEHICLES["metro"], tig.GROUNDS["soft clay"]
    design = tig.PRESETS["booted-block-low-mass"].replace(
        suspension=vehicle.suspension, ground=ground, axle_positions=(0.0, vehicle.wheelbase)
    )
    model, compiled = track_model(design), banded_spectrum(design)
    first = compiled.frequency[[0, -1]]

    def spectrum_at(frequency):
        return floquet_waves._lattice_spectrum(model, frequency, 1e-4, INFINITE)

    from_ends = np.geomspace(*first, 200)
    peer = refined_spectrum(spectrum_at, from_ends)
    ours = floquet_waves.exact_spectrum(model, peer.frequency, 1e-4)
    np.testing.assert_allclose(ours.energy, peer.energy, rtol=1e-10)
    refined = resolved_spectrum(model, from_ends, 1e-4)
    np.testing.assert_allclose(refined.frequency, peer.frequency, rtol=1e-12)


def test_waves_within_a_bay_are_those_of_the_linear_equations():
    design = tig.PRESETS["slab-track"]
    rail = floquet_waves.waves(design, FREQUENCY)
    shapes = axles.bay_shapes(design, rail, 3)
    dx = design.fastener_spacing / 3
    for place, angular in enumerate(2 * np.pi * FREQUENCY):
        q = design.rail.mass_per_metre * dx**4 / design.rail.bending_stiffness * angular**2
        for wave in range(2):
            found = axle_kernels.bay_shape(complex(rail.multipliers[wave, place]), float(q))
            np.testing.assert_allclose(found, shapes[1:, wave, place], rtol=1e-9)
