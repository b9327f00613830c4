"""Reference and bands: exact on densities whose integral is known."""

import numpy as np
import pytest

import trackig_core as tig
from trackig_core.levels.insertion_gain import insertion_gain, integrate_bands
from trackig_core.results import ForceSpectrum

BLOCK = tig.PRESETS["booted-block-low-mass"]
AXES = [np.arange(1, 1200) * 0.5, np.geomspace(4.0, 600.0, 700)]


@pytest.mark.parametrize("frequency", AXES, ids=["even", "logarithmic"])
def test_polynomials_are_integrated_to_the_exact_edges(frequency):
    edges = tig.BAND_EDGES
    assert integrate_bands(frequency, np.ones_like(frequency)) == pytest.approx(np.diff(edges))
    assert integrate_bands(frequency, frequency**2) == pytest.approx(np.diff(edges**3) / 3)


@pytest.mark.parametrize("frequency", AXES, ids=["even", "logarithmic"])
def test_a_resonance_is_integrated_to_a_thousandth_of_a_decibel(frequency):
    centre, half_width = 63.1, 1.5
    density = 1 / (1 + ((frequency - centre) / half_width) ** 2)
    exact = half_width * np.diff(np.arctan((tig.BAND_EDGES - centre) / half_width))
    assert np.abs(10 * np.log10(integrate_bands(frequency, density) / exact)).max() < 1e-3


def test_bands_160_db_below_others_are_not_lost():
    frequency = AXES[1]
    density = frequency**-12.0
    exact = -np.diff(tig.BAND_EDGES**-11.0) / 11
    assert integrate_bands(frequency, density) == pytest.approx(exact, rel=1e-4)


def spectrum_of(energy, coherent=None):
    return ForceSpectrum(AXES[0], energy, energy if coherent is None else coherent, step=1e-4)


def test_a_track_that_follows_the_line_gains_nothing():
    line = 7.0 * AXES[0] ** 2
    assert insertion_gain(spectrum_of(line), BLOCK, 40.0).levels == pytest.approx(np.zeros(21), abs=1e-9)


def test_the_line_touches_the_spectrum_at_a_tenth_of_the_loaded_track_frequency():
    frequency = AXES[0]
    energy = frequency**2 * (1 + frequency)  # E / f^2 is a straight line: at 4.1 Hz it is 5.1
    gain = insertion_gain(spectrum_of(energy), BLOCK, 41.0)
    assert gain.reference_energy == pytest.approx(5.1 * np.diff(tig.BAND_EDGES**3) / 3)


def test_the_rigid_track_passes_the_wheels_inertia_force():
    frequency = AXES[0]
    angular = 2 * np.pi * frequency
    inertia = (BLOCK.wheel_mass * angular**2 * 1e-4) ** 2 / angular**2
    gain = insertion_gain(spectrum_of(inertia), BLOCK, 40.0, reference="rigid")
    assert gain.levels == pytest.approx(np.zeros(21), abs=1e-9)
    assert gain.reference == "rigid"


def test_the_summation_chooses_the_energy():
    line = AXES[0] ** 2
    spectrum = spectrum_of(line, coherent=100 * line)
    assert insertion_gain(spectrum, BLOCK, 40.0, "rigid", "coherent").levels == pytest.approx(
        insertion_gain(spectrum, BLOCK, 40.0, "rigid").levels + 20
    )


@pytest.mark.parametrize("choice", [{"reference": "flat"}, {"summation": None}, {"fidelity": "best"}])
def test_unknown_choices_name_the_known(choice):
    with pytest.raises(ValueError, match=f"{next(iter(choice))} = .*: give '"):
        tig.solve(BLOCK, **choice)
