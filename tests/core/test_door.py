"""The door: what it names, what it still answers to, and what it says to a newcomer."""

import doctest
import subprocess
import sys

import pytest

import trackig_core as tig

EARLIER = [
    "A_WEIGHTING",
    "BAND_CENTRES",
    "BAND_EDGES",
    "BAND_LABELS",
    "GOOD_ENOUGH",
    "LOSS_FACTORS",
    "PRESETS",
    "RAILS",
    "Asymptote",
    "BandTableError",
    "DampingCurve",
    "Departure",
    "DesignError",
    "ForceSpectrum",
    "FrequencySweep",
    "InsertionGain",
    "Lattice",
    "LevelDifference",
    "LossFactorCurve",
    "LumpedComparison",
    "LumpedFrequencies",
    "MeasuredSlope",
    "MeasurementError",
    "Motion",
    "NaturalFrequencies",
    "PeerReceptance",
    "PinnedDesign",
    "Rail",
    "RunTooLargeError",
    "Solution",
    "SolveCancelled",
    "SourceError",
    "SourceSpectrum",
    "Specification",
    "SpecificationError",
    "SteadyShape",
    "StiffReferences",
    "StiffnessCurve",
    "Study",
    "StudyError",
    "TimeHistory",
    "TrackDesign",
    "TrackLevel",
    "Verdict",
    "Verification",
    "View",
    "a_weighting",
    "compare_with_beam",
    "compile_kernels",
    "cut_on",
    "damping_curves",
    "departure",
    "effective_supports",
    "element_errors",
    "film",
    "frequency_sweep",
    "gain_asymptotes",
    "gain_by_loss_factor",
    "insertion_gain",
    "lumped_frequencies",
    "lumped_insertion_gain",
    "lumped_spectrum",
    "measured_slopes",
    "peer_receptances",
    "receptance",
    "solve",
    "steady_shape",
    "stiff_references",
    "time_step_errors",
    "track_decay_rate",
    "verify",
    "with_loss_factor",
]
"""Names that the door had before the parts had doors of their own."""


@pytest.mark.parametrize("name", EARLIER)
def test_every_earlier_name_still_works(name):
    assert getattr(tig, name) is not None
    exec(f"from trackig_core import {name}", {})


@pytest.mark.parametrize("part", [tig, tig.analysis, tig.levels, tig.study], ids=lambda part: part.__name__)
def test_every_name_listed_is_there_and_listed_once(part):
    assert len(set(part.__all__)) == len(part.__all__)
    assert all(hasattr(part, name) for name in part.__all__)


def test_the_door_is_small():
    assert len(tig.__all__) <= 36


def test_an_unknown_name_is_refused_and_the_right_one_is_offered():
    with pytest.raises(AttributeError, match="no attribute 'solv'"):
        tig.solv  # noqa: B018
    code = "import trackig_core as tig; tig.solv"
    typed = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert "no attribute 'solv'. Did you mean: 'solve'?" in typed.stderr


def test_what_can_be_chosen_from_is_the_door_and_all_of_its_parts():
    offered = [name for name in dir(tig) if not name.startswith("_")]
    assert offered == sorted({*tig.__all__, "decide"})


def test_the_first_example_runs():
    result = doctest.testmod(tig)
    assert result.attempted >= 4
    assert result.failed == 0


def test_a_misspelt_preset_is_answered_by_the_right_one():
    with pytest.raises(KeyError, match="did you mean 'slab-track'"):
        tig.PRESETS["slab_track"]
    assert "slab_track" not in tig.PRESETS
    assert tig.PRESETS.get("slab_track") is None
    with pytest.raises(TypeError):
        tig.PRESETS["mine"] = tig.PRESETS["slab-track"]


def test_a_rail_may_be_given_by_name():
    design = tig.PRESETS["slab-track"].replace(rail="49E1")
    assert design.rail is tig.RAILS["49E1"]
    with pytest.raises(tig.DesignError, match="rail = '49E': give a Rail, or the name of one: 60, 49E1"):
        design.replace(rail="49E")


def test_choices_between_designs_are_loaded_when_they_are_asked_for():
    code = (
        "import sys, trackig_core as tig; assert 'trackig_core.decide.feasible' not in sys.modules; "
        "assert 'pymoo' not in sys.modules; tig.decide.feasible_ranges; assert 'pymoo' not in sys.modules"
    )
    subprocess.run([sys.executable, "-c", code], check=True)
