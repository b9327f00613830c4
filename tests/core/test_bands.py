"""Bands against IEC 61260-1."""

import numpy as np
import pytest

from trackig_core.bands import BAND_CENTRES, BAND_EDGES, BAND_LABELS, decibels


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
