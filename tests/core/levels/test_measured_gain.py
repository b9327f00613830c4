"""Insertion gain from elsewhere: its table, its difference, its place in a study."""

import numpy as np
import pytest

import trackig_core as tig

SITE = tig.MeasuredGain([(31.5, 4.0), (63, -8.5), (125, -16.0)], name="Tunnel, March")


def test_the_difference_is_computed_less_measured_where_there_is_one():
    solution = tig.solve(tig.PRESETS["booted-block-low-mass"], "exact")
    difference = SITE.difference(solution.insertion_gain)
    assert np.isfinite(difference).sum() == 3
    assert difference[8] == solution.insertion_gain[8] - 4.0
    with pytest.raises(ValueError, match="21 finite levels"):
        SITE.difference(np.zeros(20))


def test_it_is_read_as_its_own_and_never_as_a_specification():
    text = SITE.to_csv()
    assert text.startswith("frequency_hz,ig_db\n")
    assert tig.MeasuredGain.from_csv(text, "Tunnel, March") == SITE
    with pytest.raises(tig.SpecificationError, match="'ig_max_db' is due"):
        tig.Specification.from_csv(text)
    with pytest.raises(tig.levels.MeasuredGainError, match="'ig_db' is due"):
        tig.MeasuredGain.from_csv(tig.Specification([(63, 0.0)]).to_csv())


def test_a_study_keeps_up_to_four():
    study = tig.Study(tig.PRESETS["slab-track"], measured=[SITE] * 4)
    text = study.to_toml()
    assert text.count("[[measured]]") == 4
    assert tig.Study.from_toml(text) == study
    assert "measured" not in tig.Study(tig.PRESETS["slab-track"]).to_toml()
    with pytest.raises(tig.StudyError, match="measured: 5 curves: give at most 4"):
        tig.Study(tig.PRESETS["slab-track"], measured=[SITE] * 5)
    with pytest.raises(tig.StudyError, match=r"measured\[0\]: .*give a MeasuredGain"):
        tig.Study(tig.PRESETS["slab-track"], measured=[tig.Specification([(63, 0.0)])])


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("ig_dB = [", "ig_max_dB = [", r"measured\[0\]\.ig_dB: it is missing"),
        ("[63.0, -8.5]", "[64.9, -8.5]", r"measured\[0\]\.ig_dB: row 2, column 1"),
        ('name = "Tunnel, March"', 'name = ""', r"measured\[0\]: name = ''"),
        ("[[measured]]", "[measured]", "measured: .*write each curve under"),
        ('name = "Tunnel, March"', "nam = 1", r"measured\[0\]\.nam: there is no such key; write 'name'"),
    ],
)
def test_a_wrong_file_says_where(old, new, words):
    text = tig.Study(tig.PRESETS["slab-track"], measured=[SITE]).to_toml()
    assert old in text
    with pytest.raises(tig.StudyError, match=words):
        tig.Study.from_toml(text.replace(old, new))
