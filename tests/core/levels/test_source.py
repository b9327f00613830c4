"""Source spectra: the A-weighting against the standard, sums against their definition."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import trackig_core as tig

TABLE = {
    "10": -70.4, "12.5": -63.4, "16": -56.7, "20": -50.5, "25": -44.7, "31.5": -39.4, "40": -34.6,
    "50": -30.2, "63": -26.2, "80": -22.5, "100": -19.1, "125": -16.1, "160": -13.4, "200": -10.9,
    "250": -8.6, "315": -6.6, "400": -4.8, "500": -3.2,
}  # fmt: skip
"""IEC 61672-1:2013, table 3."""

FLAT = tig.SourceSpectrum([(float(label), 60.0) for label in tig.BAND_LABELS])
PARTIAL = tig.SourceSpectrum([(31.5, 70.0), (63, 65.0), (125, 50.0)], name="Metro")

gains = st.lists(st.floats(-60, 40), min_size=21, max_size=21).map(np.array)


@pytest.mark.parametrize("label", TABLE)
def test_a_weighting_is_that_of_the_standard(label):
    weighting = tig.A_WEIGHTING[tig.BAND_LABELS.index(label)]
    assert abs(weighting - TABLE[label]) <= 0.05 + 1e-9


def test_a_weighting_is_zero_at_a_kilohertz_and_follows_the_standards_poles():
    low, high, knee, half = 10**1.5, 10**3.9, 10**2.45, np.sqrt(0.5)
    b = (1e6 + low**2 * high**2 / 1e6 - half * (low**2 + high**2)) / (1 - half)
    root = np.sqrt(b**2 - 4 * low**2 * high**2)
    poles = [
        np.sqrt((-b - root) / 2),
        (3 - np.sqrt(5)) / 2 * knee,
        (3 + np.sqrt(5)) / 2 * knee,
        np.sqrt((-b + root) / 2),
    ]
    f = np.geomspace(1, 20e3, 50)
    s = 2j * np.pi * np.append(f, 1000.0)
    w1, w2, w3, w4 = (2 * np.pi * pole for pole in poles)
    magnitude = np.abs(s**4 / ((s + w1) ** 2 * (s + w2) * (s + w3) * (s + w4) ** 2))
    np.testing.assert_allclose(tig.a_weighting(f), 20 * np.log10(magnitude[:-1] / magnitude[-1]), atol=1e-5)
    assert tig.a_weighting(1000.0) == 0


def test_equal_bands_sum_by_their_number():
    level = FLAT.with_track(np.zeros(21))
    assert level.unweighted == pytest.approx(60 + 10 * np.log10(21))


def test_one_band_is_its_own_sum():
    level = tig.SourceSpectrum([(63, 70.0)]).with_track(np.full(21, -12.0))
    assert level.unweighted == pytest.approx(58)
    assert level.a_weighted == pytest.approx(58 - 26.2, abs=0.05)


def test_bands_without_a_level_do_not_count():
    gain = np.linspace(-20, 20, 21)
    level = PARTIAL.with_track(gain)
    assert np.isfinite(level.bands).sum() == 3
    energy = sum(
        10 ** ((value + gain[tig.BAND_LABELS.index(f"{frequency:g}")]) / 10)
        for frequency, value in PARTIAL.points
    )
    assert level.unweighted == pytest.approx(10 * np.log10(energy))


@given(gains, st.floats(-30, 30))
def test_a_louder_track_is_louder_by_as_much(gain, louder):
    difference = PARTIAL.with_track(gain + louder).relative_to(PARTIAL.with_track(gain))
    assert difference.unweighted == pytest.approx(louder, abs=1e-9)
    assert difference.a_weighted == pytest.approx(louder, abs=1e-9)


@given(gains)
def test_the_sum_exceeds_every_band_and_weighting_takes_away(gain):
    level = FLAT.with_track(gain)
    assert level.unweighted >= np.nanmax(level.bands)
    assert level.a_weighted < level.unweighted


@pytest.mark.parametrize("wrong", [np.zeros(20), np.full(21, np.nan), 3.0])
def test_gains_must_be_one_per_band(wrong):
    with pytest.raises(ValueError, match="21 finite levels"):
        FLAT.with_track(wrong)


def test_files_round_trip():
    assert tig.SourceSpectrum.from_csv(PARTIAL.to_csv(), "Metro") == PARTIAL


def test_errors_are_those_of_a_source():
    with pytest.raises(tig.SourceError, match="line 1, column 2: 'ig_max_db' where 'level_db' is due"):
        tig.SourceSpectrum.from_csv("frequency_hz,ig_max_db\n8,1\n")
    with pytest.raises(tig.SourceError, match="from -200 to 300 dB"):
        tig.SourceSpectrum([(8, 301)])


def test_a_source_is_no_specification():
    same = tig.Specification(PARTIAL.points, name="Metro")
    assert same != PARTIAL
