"""The ladder: every rung is the design it says, and its differences are what they say."""

import numpy as np
import pytest

import trackig_core as tig
from trackig_core.analysis.ladder import ladder

BLOCK, SLAB = tig.PRESETS["booted-block-low-mass"], tig.PRESETS["slab-track"]
MEASURED = tig.StiffnessCurve([(5, 22e6, 0.18), (50, 28e6, 0.2), (500, 38e6, 0.3)])


def test_rungs_put_back_one_thing_after_the_other(preset):
    design = tig.PRESETS[preset]
    found = ladder(design)
    names = [rung.name for rung in found.rungs]
    assert names == ["the simplified model", "suspension", "other axles", "ground"]
    assert found.rungs[0].design == design
    assert found.rungs[1].design == design.replace(suspension=tig.VEHICLES["regional"].suspension)
    assert found.rungs[2].design.axle_positions == (0.0, tig.VEHICLES["regional"].wheelbase)
    assert found.rungs[3].design.ground == tig.GROUNDS["stiff clay"]
    assert [rung.source for rung in found.rungs] == [
        "the design",
        *["generic: regional"] * 2,
        "generic: stiff clay",
    ]


def test_what_the_design_says_is_taken_from_it():
    design = BLOCK.replace(
        boot_stiffness=MEASURED,
        boot_loss_factor=None,
        suspension=tig.VEHICLES["metro"].suspension,
        axle_positions=(0.0, 1.8),
        speed=20.0,
        ground=tig.GROUNDS["rock"],
    )
    found = ladder(design)
    assert [rung.name for rung in found.rungs][1] == "measured damping"
    assert {rung.source for rung in found.rungs} == {"the design"}
    assert found.rungs[-1].design == design
    constant = found.rungs[0].design
    assert constant.boot_stiffness == pytest.approx(28e6, rel=0.05)
    assert constant.boot_loss_factor == pytest.approx(0.2, abs=0.03)
    solved = tig.solve(design, "exact")
    assert found.rungs[-1].insertion_gain == pytest.approx(solved.insertion_gain, abs=1e-9)


def test_every_rung_is_compared_with_the_first():
    found = ladder(SLAB, vehicle="metro", ground="soft clay")
    first = found.rungs[0]
    assert not first.difference.any()
    rigid = tig.solve(SLAB, "exact", reference="rigid").insertion_gain
    assert np.abs(first.insertion_gain - rigid).max() < 0.01
    for rung in (*found.rungs, found.one_dimensional):
        assert rung.difference == pytest.approx(rung.insertion_gain - first.insertion_gain)
        worst = np.abs(rung.difference).max()
        assert abs(rung.largest) == worst
        assert abs(rung.difference[tig.BAND_LABELS.index(rung.largest_band)]) == worst
    beam = tig.analysis.compare_with_beam(SLAB, "rigid").difference
    assert np.abs(found.one_dimensional.difference - beam).max() < 0.01


@pytest.mark.parametrize("design", [BLOCK, SLAB])
def test_suspension_and_axles_hardly_matter_above_the_loaded_track(design):
    """The paper's message, on its own tracks: within 2 dB from 1.5 times the loaded-track frequency on."""
    found = ladder(design)
    above = 1.5 * found.loaded_track < tig.BAND_CENTRES
    for rung in found.rungs[1:3]:
        assert np.abs(rung.difference[above]).max() < 2.0
    suspension = found.rungs[1].difference[above]
    assert np.abs(suspension).max() < 0.2


def test_the_sentence_says_what_each_rung_costs_and_where():
    found = ladder(BLOCK)
    noise = slice(tig.BAND_LABELS.index("16"), tig.BAND_LABELS.index("250") + 1)
    assert found.cost == np.abs(found.rungs[-1].difference[noise]).max()
    assert found.sentence.startswith(
        "Between 16 and 250 Hz the simplified model of this design moves, step by step, by up to 0."
    )
    for before, after in zip(found.rungs, found.rungs[1:], strict=False):
        step = np.abs(after.insertion_gain - before.insertion_gain)[noise].max()
        assert f"{step:.1f} dB (" in found.sentence
        assert f"with {after.name}" in found.sentence
    assert found.sentence.endswith("from it.")
    assert "(generic: stiff clay)" in found.sentence


def test_a_missing_vehicle_is_answered_by_the_nearest():
    with pytest.raises(KeyError, match="did you mean 'metro'"):
        ladder(BLOCK, vehicle="metros")
    with pytest.raises(KeyError, match="did you mean 'rock'"):
        ladder(BLOCK, ground="rocks")


def test_coherent_sums_have_a_ladder_too():
    energy, coherent = ladder(BLOCK), ladder(BLOCK, summation="coherent")
    assert np.abs(energy.rungs[0].insertion_gain - coherent.rungs[0].insertion_gain).max() > 3.0
