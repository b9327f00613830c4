"""Bands against IEC 61260-1."""

import numpy as np
import pytest

import trackig_core as tig
from trackig_core.bands import (
    BAND_CENTRES,
    BAND_EDGES,
    BAND_LABELS,
    ONE_THIRD_OCTAVES,
    WIDEST,
    chosen_bands,
    decibels,
)


def test_bands_run_from_5_to_500_hz_in_base_ten():
    assert BAND_CENTRES[0] == pytest.approx(5.011872)
    assert BAND_CENTRES[13] == pytest.approx(100.0)
    assert BAND_CENTRES[-1] == pytest.approx(501.187234)
    assert np.allclose(BAND_CENTRES[10:] / BAND_CENTRES[:-10], 10)


def test_each_band_ends_where_the_next_begins_at_the_geometric_mean():
    assert np.allclose(np.sqrt(BAND_EDGES[1:] * BAND_EDGES[:-1]), BAND_CENTRES)
    assert BAND_EDGES[[0, -1]] == pytest.approx([4.466836, 562.341325])


def test_labels_are_the_nominal_frequencies_nearest_to_the_exact_ones():
    assert len(BAND_LABELS) == 21
    assert np.allclose([float(label) for label in BAND_LABELS], BAND_CENTRES, rtol=0.012)


def test_shared_arrays_cannot_be_changed():
    with pytest.raises(ValueError, match="read-only"):
        BAND_CENTRES[0] = 1.0


def test_decibels_of_energy_ratios():
    assert decibels([1.0, 10.0, 0.5]) == pytest.approx([0, 10, -3.0103], abs=1e-4)


def test_the_default_bands_are_those_of_the_paper():
    np.testing.assert_array_equal(ONE_THIRD_OCTAVES.centres, tig.BAND_CENTRES)
    np.testing.assert_array_equal(ONE_THIRD_OCTAVES.edges, tig.BAND_EDGES)
    assert ONE_THIRD_OCTAVES.labels == tig.BAND_LABELS


def test_octaves_are_three_thirds():
    octaves, thirds = chosen_bands("octave"), chosen_bands("one-third-octave")
    assert octaves.labels == ("8", "16", "31.5", "63", "125", "250")
    np.testing.assert_allclose(octaves.edges, thirds.edges[1:-1:3])
    wide = chosen_bands("wide octave")
    assert wide.labels == ("1", "2", "4", "8", "16", "31.5", "63", "125", "250", "500", "1000")
    np.testing.assert_allclose(wide.edges, WIDEST.edges[::3], rtol=1e-12)
    assert chosen_bands("wide one-third-octave").labels[:5] == ("1", "1.25", "1.6", "2", "2.5")
    with pytest.raises(ValueError, match="bands = 'thirds': give 'one-third-octave' or 'octave' or"):
        chosen_bands("thirds")


BLOCK = tig.PRESETS["booted-block-low-mass"]


@pytest.mark.parametrize("reference", ["line", "rigid"])
def test_an_octave_has_the_energy_of_its_thirds(reference):
    solution = tig.solve(BLOCK, "exact")
    thirds, octaves = solution.gain_for(reference), solution.gain_for(reference, bands="octave")
    assert octaves is solution.gain_for(reference, bands="octave")
    for name in ("band_energy", "reference_energy"):
        in_thirds = getattr(thirds, name)[1:-2].reshape(6, 3).sum(axis=1)
        np.testing.assert_allclose(getattr(octaves, name), in_thirds, rtol=1e-6)


def test_wide_bands_hold_the_default_ones():
    narrow, wide = tig.solve(BLOCK, "exact"), tig.solve(BLOCK, "exact", bands="wide one-third-octave")
    assert wide.insertion_gain.shape == wide.band_centres.shape == (31,)
    np.testing.assert_allclose(wide.insertion_gain[7:28], narrow.insertion_gain, atol=2e-3)
    np.testing.assert_allclose(wide.gain_for().levels, narrow.insertion_gain, atol=2e-3)
    # far below its resonance the track is its own reference line, which is anchored at 3.9 Hz
    assert wide.insertion_gain[6] == pytest.approx(0.0, abs=0.02)
    assert np.abs(wide.insertion_gain[:7]).max() < 0.25
    assert any("follows its suspension" in note for note in wide.notes)
    assert not any("follows its suspension" in note for note in narrow.notes)
    assert wide.gain_for(bands="wide octave").levels.shape == (11,)
    assert wide.to_dataframe().index[0] == "1"


def test_a_run_has_octaves_but_no_wide_bands():
    run = tig.solve(BLOCK, "live", bands="octave")
    exact = tig.solve(BLOCK, "exact", bands="octave")
    assert run.band_labels == ("8", "16", "31.5", "63", "125", "250")
    np.testing.assert_allclose(run.insertion_gain, exact.insertion_gain, atol=0.06)
    with pytest.raises(ValueError, match=r"bands = 'wide octave' reach beyond a run's record"):
        tig.solve(BLOCK, "live", bands="wide octave")
    for solution in (run, exact):
        with pytest.raises(ValueError, match=r"bands = 'wide octave': they reach from 0.708 to 1413 Hz"):
            solution.gain_for(bands="wide octave")
