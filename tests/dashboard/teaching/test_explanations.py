"""What is taught: every figure in a sentence is that of the library, on any design."""

import re

import numpy as np
import pytest
from hypothesis import given, settings

import trackig_core as tig
from dashboard.fields import NUMBERS
from dashboard.session.inputs import DesignInputs
from dashboard.teaching import explanations
from tests.core.test_solver import ordinary_designs

BLOCK, SLAB = tig.PRESETS["booted-block-low-mass"], tig.PRESETS["slab-track"]

ALL = [
    (explanations.resonances, "pad_stiffness"),
    (explanations.slopes, "line", "energy"),
    (explanations.damping, "line", "energy"),
    (explanations.definitions,),
    (explanations.lumped_vs_beam, "rigid", "coherent"),
]


@given(ordinary_designs)
@settings(max_examples=8)
def test_every_lecture_has_something_to_say_of_any_design(design):
    for lecture, *arguments in ALL:
        told = lecture(design, *arguments)
        assert told.words
        assert not re.search(r"\b(nan|inf)\b", " ".join(told.words))


@pytest.mark.parametrize("name", NUMBERS)
def test_resonances_are_those_of_the_library_over_the_slider_s_range(name):
    told = explanations.resonances(BLOCK, name)
    low, high = DesignInputs.param[name].bounds
    assert (told.values[0], told.values[-1]) == (pytest.approx(low), pytest.approx(high))
    middle = told.values.size // 2
    changed = BLOCK.replace(**{name: told.sweep.values[middle]})
    assert told.sweep.lumped_coupled[:, middle] == pytest.approx(tig.lumped_frequencies(changed).coupled)
    assert told.sweep.loaded_track[middle] == pytest.approx(
        tig.solve(changed, "exact").natural_frequencies.loaded_track
    )


def test_what_is_said_of_resonances_is_computed():
    said = " ".join(explanations.resonances(BLOCK, "boot_stiffness").words)
    found = tig.lumped_frequencies(BLOCK)
    for frequency in (*found.coupled, *found.uncoupled):
        assert f"{frequency:.3g} Hz" in said
    assert "thin ones cross" in said
    assert "thin ones cross" not in " ".join(explanations.resonances(BLOCK, "pad_loss_factor").words)
    assert "nothing to couple" in explanations.resonances(SLAB, "pad_stiffness").words[0]


@pytest.mark.parametrize("choices", [("line", "energy"), ("rigid", "coherent")])
def test_slopes_are_drawn_with_and_without_blocks(choices):
    reference, summation = choices
    told = explanations.slopes(BLOCK, reference, summation)
    exact = tig.solve(BLOCK, "exact", reference=reference, summation=summation).insertion_gain
    np.testing.assert_allclose(told.levels, exact)
    assert told.asymptotes == tig.gain_asymptotes(BLOCK, reference, summation)
    assert len(told.one_stage_asymptotes) == 2
    bought, costs = re.search(r"buys most at \S+ Hz, ([\d.]+) dB, .*, ([\d.]+) dB", told.words[1]).groups()
    assert float(bought) == pytest.approx((told.one_stage_levels - told.levels).max(), abs=0.05)
    assert float(costs) == pytest.approx((told.levels - told.one_stage_levels).max(), abs=0.05)
    assert explanations.slopes(SLAB, reference, summation).one_stage_levels is None


def test_without_blocks_the_track_is_as_stiff_and_lossy_at_50_hz():
    both = explanations.without_blocks(BLOCK)
    pad, boot = 100e6 * (1 + 0.2j), 28e6 * (1 + 0.2j)
    assert both.pad_stiffness * (1 + 1j * both.pad_loss_factor) == pytest.approx(1 / (1 / pad + 1 / boot))
    assert not both.two_stage
    assert tig.effective_supports(both) == pytest.approx(tig.effective_supports(BLOCK), rel=0.01)


def test_rows_of_slopes_stand_for_each_asymptote():
    told = explanations.slopes(BLOCK, "line", "energy")
    rows = explanations.slope_rows(told.measured)
    assert [row[1] for row in rows] == ["level", "−12 dB per octave", "−24 dB per octave"]
    for row, measured in zip(rows, told.measured, strict=True):
        assert float(row[3].replace("−", "-")) == pytest.approx(measured.beam, abs=0.05)


def test_what_damping_buys_and_costs_is_computed():
    told = explanations.damping(BLOCK, "line", "energy")
    np.testing.assert_allclose(told.levels, tig.gain_by_loss_factor(BLOCK))
    bought, costs, band = re.search(
        r"falls by ([\d.]+) dB.*isolates: ([\d.]+) dB less of it at (\S+) Hz", told.words[1]
    ).groups()
    assert float(bought) == pytest.approx(told.levels[0].max() - told.levels[-1].max(), abs=0.05)
    at = tig.BAND_LABELS.index(band)
    assert told.levels[0][at] < 0
    assert float(costs) == pytest.approx(told.levels[-1][at] - told.levels[0][at], abs=0.05)
    assert f"{told.boot.stiffness[-1]:.2f} of it at 500 Hz" in told.words[0]


@pytest.mark.parametrize("preset", list(tig.PRESETS))
def test_definitions_are_the_library_s(preset):
    design = tig.PRESETS[preset]
    told = explanations.definitions(design)
    for key, levels in told.levels.items():
        summation, reference = key.split("_")
        exact = tig.solve(design, "exact", reference=reference, summation=summation).insertion_gain
        np.testing.assert_allclose(levels, exact, atol=1e-9)
    apart = np.abs(told.levels["energy_line"] - told.levels["coherent_line"]).max()
    assert f"by {apart:.1f} dB" in told.words[0]
    assert f"{told.stiff.contact_resonance:.0f} Hz" in told.stiff_words[0]
    assert "over a support" in told.words[-1]


@pytest.mark.parametrize("preset", list(tig.PRESETS))
def test_the_ladder_s_words_are_those_of_its_bands(preset):
    told = explanations.lumped_vs_beam(tig.PRESETS[preset], "line", "energy")
    good = told.comparison.good_enough
    assert f"in {good.sum()} of 21 bands: {explanations.band_ranges(good)}." in told.words[0]
    worst = np.argmax(np.abs(told.comparison.difference))
    assert f"off at {tig.BAND_LABELS[worst]} Hz" in told.words[1]
    assert f"{abs(told.comparison.difference[worst]):.1f} dB" in told.words[1]


def test_bands_are_told_as_ranges():
    chosen = np.zeros(21, dtype=bool)
    assert explanations.band_ranges(chosen) == ""
    chosen[[0, 1, 2, 12, 20]] = True
    assert explanations.band_ranges(chosen) == "5 to 8 Hz, 80 Hz, 500 Hz"


@pytest.mark.parametrize(
    ("factor", "wheel_and_rail", "rail_and_block"), [(0.3, "in step", "in step"), (1.0, None, "in step")]
)
def test_a_steady_shape_is_told_in_words(factor, wheel_and_rail, rail_and_block):
    natural = tig.solve(BLOCK, "exact").natural_frequencies
    shape = tig.steady_shape(BLOCK, factor * natural.loaded_track)
    said = explanations.shape_words(shape)
    assert f"the wheel moves {abs(shape.wheel[0]):.2g} times" in said
    if wheel_and_rail:
        assert f"Wheel and rail move {wheel_and_rail}" in said
    assert f"rail and block {rail_and_block}" in said
    above = explanations.shape_words(tig.steady_shape(BLOCK, 500.0))
    assert "rail and block in step" not in above
    assert "block" not in explanations.shape_words(tig.steady_shape(SLAB, 50.0))


@pytest.mark.parametrize(
    ("ratio", "apart"),
    [(1.45, "close together"), (1.55, "far apart"), (1 / 1.45, "close together"), (1 / 1.55, "far apart")],
)
def test_uncoupled_frequencies_are_called_close_below_a_ratio_of_one_and_a_half(ratio, apart):
    design = BLOCK
    # stiffness depends on frequency a little, so a few steps are needed
    for _ in range(5):
        wheel, block = tig.lumped_frequencies(design).uncoupled
        design = design.replace(block_mass=design.block_mass * (block / (ratio * wheel)) ** 2)
    assert block / wheel == pytest.approx(ratio, rel=0.01)
    assert f"its boot alone: {apart}" in explanations.resonances(design, "pad_loss_factor").words[0]


def steepness(asymptote=-24.0, lumped=-24.0, beam=-24.0, frequency=500.0):
    """Return what is said of slopes at a frequency of a track whose waves run from about 100 Hz on."""
    line = tig.Asymptote((400.0, 600.0), (0.0, 0.0), asymptote)
    return explanations._about_steepness(BLOCK, tig.MeasuredSlope(line, frequency, lumped, beam))


def test_the_beam_is_explained_by_waves_where_they_run_and_it_is_notably_less_steep():
    waves = "waves along the rail pass what"
    assert waves in steepness(lumped=-24.0, beam=-22.9)
    assert waves not in steepness(lumped=-24.0, beam=-23.1)
    below = 0.9 * tig.cut_on(BLOCK)[0]
    assert waves not in steepness(lumped=-24.0, beam=-10.0, frequency=below)


def test_the_lumped_model_is_steeper_than_its_asymptote_as_long_as_it_comes_down_from_its_resonance():
    resonance = tig.lumped_frequencies(BLOCK).coupled[-1]
    assert f"steeper, since it still comes down from its resonance at {resonance:.3g} Hz" in steepness(
        asymptote=-24.0, lumped=-24.1
    )
    assert "less, since its dampers stiffen" in steepness(asymptote=-24.0, lumped=-23.9)


def levels_by_loss(**changed):
    """Return insertion gain at three loss factors (3, 21) [dB]: a peak in band 8, isolation from 12 on."""
    levels = np.tile(np.where(np.arange(21) < 12, 1.0, -10.0), (3, 1))
    levels[0, 8] = 12.0
    for place, level in changed.items():
        levels[-1, int(place.removeprefix("band_"))] = level
    return levels


def test_the_price_of_damping_is_looked_for_above_the_peak_where_the_track_isolates():
    assert "3.0 dB less of it at 315 Hz" in explanations._price(levels_by_loss(band_18=-7.0, band_15=-8.0))
    nothing = "nothing is lost"
    assert nothing in explanations._price(levels_by_loss())
    assert nothing in explanations._price(levels_by_loss(band_18=-11.0))
    assert nothing in explanations._price(levels_by_loss(band_10=9.0))
    below = levels_by_loss(band_3=9.0)
    below[0, 3] = -1.0
    assert nothing in explanations._price(below)


def test_sums_differ_by_waves_if_these_run_within_the_bands():
    apart = np.linspace(0.0, 2.0, 21)
    assert "begin to run along the rail at 600 Hz only" in explanations._about_sums(apart, 600.0)
    said = explanations._about_sums(apart, 500.0)
    assert "farthest apart at 500 Hz, by 2.0 dB: waves, which run along the rail from about 500 Hz" in said


@pytest.mark.parametrize(
    ("degrees", "said"),
    [(44, "in step"), (46, "out of step"), (134, "out of step"), (136, "against each other")],
)
def test_phases_are_named_by_their_angle(degrees, said):
    assert explanations._phase(np.exp(1j * np.radians(degrees)), 1.0).startswith(said)
    assert explanations._phase(1.0, np.exp(1j * np.radians(degrees))).startswith(said)
