"""Figures by name: what they stand for, how they are written, and claims that are judged, not believed."""

from contextlib import suppress

import pytest
from hypothesis import given
from hypothesis import strategies as st

import trackig_core as tig
from dashboard.teaching.quantities import LONGEST, QuantityError, read_claim, read_placeholder

BLOCK, SLAB = tig.PRESETS["booted-block-low-mass"], tig.PRESETS["slab-track"]
SOFTER = BLOCK.replace(boot_stiffness=14e6)


def written(text, before=BLOCK, after=SOFTER):
    return read_placeholder(text)(before, after)


def test_figures_are_those_of_the_solver():
    solution = tig.solve(SOFTER, "exact")
    level = solution.insertion_gain[tig.BAND_LABELS.index("63")]
    assert written("insertion_gain(63)") == f"{level:.1f} dB"
    other = tig.solve(SOFTER, "exact", reference="rigid", summation="coherent").insertion_gain[15]
    assert written("insertion_gain(160, coherent, rigid)") == f"{other:.1f} dB"
    assert written("peak") == f"{solution.insertion_gain.max():.1f} dB"
    levels = solution.insertion_gain
    assert written("slope(200, 400)") == f"{levels[19] - levels[16]:.1f} dB/octave"
    frequencies = solution.natural_frequencies
    for name in ("loaded_track", "coupled_block", "block_on_boot"):
        assert written(name) == f"{getattr(frequencies, name):.3g} Hz"
    assert written("cut_on") == f"{frequencies.cut_on[0]:.3g} Hz"
    assert written("lumped_upper") == f"{tig.lumped_frequencies(SOFTER).coupled[1]:.3g} Hz"
    assert written("supports") == f"{tig.effective_supports(SOFTER):.3g}"
    boot = solution.boot_law
    assert written("stiffening(500)") == f"{boot.stiffness(500.0) / boot.stiffness(50.0):.3g}"


def test_decisions_are_those_of_the_library():
    limits = tig.Specification([(63, -1.5)])
    found = tig.decide.feasible_ranges(BLOCK, limits, fields=["boot_stiffness"])
    assert written("before at_most(boot_stiffness, 63, -1.5)") == (
        f"{found['boot_stiffness'][-1][1] / 1e6:.3g} kN/mm"
    )
    scatter = {"pad_stiffness": 0.15, "boot_stiffness": 0.15}
    sure = tig.decide.tolerance(BLOCK, limits, scatter, samples=2048)
    assert written("before production(63, -1.5, 15)") == f"{100 * sure.probability:.0f} %"
    slab = tig.decide.tolerance(SLAB, limits, {"pad_stiffness": 0.15}, samples=2048)
    assert written("production(63, -1.5, 15)", after=SLAB) == f"{100 * slab.probability:.0f} %"
    # a share of production changes by points, not by parts of itself
    assert read_claim("production(63, -1.5, 15) rises by at most 45 %")(BLOCK, SOFTER)


def test_sliders_are_written_in_their_own_units():
    assert written("boot_stiffness") == "14 kN/mm"
    assert written("before boot_stiffness") == "28 kN/mm"
    assert written("block_mass") == "45 kg"
    assert written("boot_loss_factor") == "0.2"
    assert written("fastener_spacing") == "0.6 m"


def test_words_follow_the_direction():
    assert written("change boot_stiffness") == "falls by 14 kN/mm"
    assert written("change boot_stiffness", SOFTER, BLOCK) == "rises by 14 kN/mm"
    assert written("difference boot_stiffness") == "14 kN/mm"
    assert written("percent boot_stiffness") == "falls by 50 %"
    assert written("change insertion_gain(63)", BLOCK, BLOCK) == "does not change"
    assert written("change block_mass") == "does not change"


@pytest.mark.parametrize(
    ("claim", "true"),
    [
        ("boot_stiffness falls by at least 14 kN/mm", True),
        ("boot_stiffness falls by at least 15 kN/mm", False),
        ("boot_stiffness rises by at least 1 kN/mm", False),
        ("boot_stiffness rises by at most 1 kN/mm", True),
        ("boot_stiffness changes by between 10 and 20 kN/mm", True),
        ("boot_stiffness falls by between 49 and 51 %", True),
        ("boot_stiffness is at most 14 kN/mm", True),
        ("before boot_stiffness is at most 14 kN/mm", False),
        ("boot_loss_factor is between 0.1 and 0.3", True),
        ("insertion_gain(63) is at most -20 dB", False),
    ],
)
def test_claims_are_judged(claim, true):
    assert read_claim(claim)(BLOCK, SOFTER) == true


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("", "cannot be read"),
        ("insertion_gains(63)", "give insertion_gain"),
        ("insertion_gain", "give a band"),
        ("insertion_gain(64)", "give a band"),
        ("at_most(63, -1.5)", "give a slider, a band and a limit"),
        ("at_most(boot_stiffness, 63, low)", "low is no number"),
        ("production(63)", "give a band"),
        ("production(63, -1.5)", "give a band"),
        ("production(63, -1.5, 150)", "give a tolerance above 0 and up to 90 %"),
        ("insertion_gain(63, loud)", "energy or coherent"),
        ("insertion_gain(63, line, rigid)", "not both"),
        ("insertion_gain(63, line, line)", "not both"),
        ("slope(400, 200)", "lower band first"),
        ("slope(200)", "give a band"),
        ("stiffening(5000)", "5 to 500"),
        ("stiffening(a)", "one frequency"),
        ("stiffening()", "one frequency"),
        ("loaded_track(3)", "nothing in brackets"),
        ("__import__('os')", "cannot be read"),
        ("change change peak", "cannot be read"),
        ("x" * (LONGEST + 1), "cannot be read"),
    ],
)
def test_what_cannot_be_read_is_told(text, says):
    with pytest.raises(QuantityError, match=says):
        read_placeholder(text)


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("peak falls", "cannot be read"),
        ("peak falls by at least 3 Hz", "in dB or %"),
        ("peak is at least 3 %", "in dB"),
        ("peak is at least 3", "in dB"),
        ("before peak falls by at least 3 dB", "goes with 'is'"),
        ("peak is at least 1e9 dB", "cannot be read"),
        ("peek is at least 1 dB", "give peak"),
    ],
)
def test_claims_that_cannot_be_read_are_told(text, says):
    with pytest.raises(QuantityError, match=says):
        read_claim(text)


@pytest.mark.parametrize("name", ["coupled_block", "block_on_boot", "lumped_upper", "block_mass"])
def test_what_a_single_stage_track_lacks_is_told(name):
    with pytest.raises(QuantityError, match="single-stage"):
        read_placeholder(name)(SLAB, SLAB)


def test_levels_have_no_percentage():
    with pytest.raises(QuantityError, match="percentage"):
        written("percent peak")


@given(st.text(max_size=200))
def test_no_text_does_anything_but_be_read_or_refused(text):
    for read in (read_placeholder, read_claim):
        with suppress(QuantityError):
            read(text)
