"""Questions about what stands on and under a track: numbers of suspension and ground, by path."""

from dataclasses import replace

import numpy as np
import pytest

import trackig_core as tig
from trackig_core.decide.questions import Answer, Question
from trackig_core.decide.solving import joined
from trackig_core.frequency_domain.batch import solve_many
from trackig_core.track.design import PATHS
from trackig_core.track.fields import SEARCHED_RANGES, SLIDER_RANGES

METRO = tig.VEHICLES["metro"].suspension
CLAY = replace(tig.GROUNDS["soft clay"], mass=40.0)
BLOCK = tig.PRESETS["booted-block-low-mass"]
SPRUNG = BLOCK.replace(suspension=METRO)
BOGIE = SPRUNG.replace(ground=CLAY, axle_positions=(0.0, 2.1))
FOLLOWING = BLOCK.replace(axle_positions=(0.0, 2.4), speed=30.0)


def limits_of(design, above=1.0):
    """Return a specification that a design keeps by so many decibels, as far as its bands go."""
    levels = tig.solve(design, "exact").insertion_gain
    return tig.Specification(list(zip(tig.BAND_CENTRES, levels + above, strict=True)))


def changed(design, path, value):
    """Return a design with one number of a part changed, by hand."""
    part, _, number = path.partition(".")
    if not number:
        return design.replace(**{part: value})
    return design.replace(**{part: replace(getattr(design, part), **{number: value})})


def test_a_number_of_a_part_is_read_and_replaced_by_its_path():
    assert BOGIE.value("suspension.bogie_mass") == METRO.bogie_mass
    assert BOGIE.value("ground") == CLAY
    assert BLOCK.value("ground.mass") is None
    numbers = {"suspension.bogie_mass": 900.0, "suspension.primary_damping": 5e3, "block_mass": 60.0}
    found = BOGIE.replace(**numbers)
    assert found.suspension == replace(METRO, bogie_mass=900.0, primary_damping=5e3)
    assert (found.ground, found.block_mass) == (CLAY, 60.0)
    assert BLOCK.replace(ground=CLAY, **{"ground.mass": 7.0}).ground == replace(CLAY, mass=7.0)
    freight = BLOCK.replace(suspension=tig.VEHICLES["freight"].suspension)
    secondary = {"secondary_stiffness": 2e5, "secondary_damping": 1e4, "body_mass": 4e3}
    given = {f"suspension.{name}": value for name, value in secondary.items()}
    assert freight.replace(**given).suspension == replace(freight.suspension, **secondary)


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"ground.stifness": 1e8}, "'ground.stiffness'"),
        ({"ground.stiffness": 1.0}, r"ground\.stiffness = 1\.0: give a number from 100000"),
        (
            {"suspension.bogie_mass": 1e3},
            r"suspension\.bogie_mass = 1000.0: give a suspension too: the design",
        ),
        ({"rail.mass_per_metre": 60.0}, "a field that exists"),
    ],
)
def test_a_path_that_leads_nowhere_says_what_is_possible(changes, words):
    design = BLOCK.replace(ground=CLAY)
    with pytest.raises(tig.DesignError, match=words):
        design.replace(**changes)
    with pytest.raises(tig.DesignError, match=words):
        solve_many(design, **{name: [value, value] for name, value in changes.items()})


def test_many_designs_with_numbers_by_path_are_those_with_changed_objects():
    grounds, masses = np.geomspace(30e6, 300e6, 3), np.array([[500.0], [900.0]])
    many = solve_many(BOGIE, **{"ground.stiffness": grounds, "suspension.bogie_mass": masses})
    assert many.insertion_gain.shape == (2, 3, 21)
    for row in np.ndindex(2, 3):
        design = changed(BOGIE, "ground.stiffness", grounds[row[1]])
        design = changed(design, "suspension.bogie_mass", float(masses[row[0], 0]))
        assert many.design(row) == design
        alone = tig.solve(design, "exact")
        np.testing.assert_allclose(many.loaded_track[row], alone.natural_frequencies.loaded_track, rtol=1e-9)
        np.testing.assert_array_equal(many.insertion_gain[row], solve_many([design]).insertion_gain[0])
        # energies of many designs are kept in single precision
        np.testing.assert_allclose(many.insertion_gain[row], alone.insertion_gain, atol=1e-6)
    np.testing.assert_array_equal(many.column("ground.stiffness"), np.broadcast_to(grounds, (2, 3)))
    assert np.isnan(solve_many(BLOCK).column("ground.mass")).all()


def test_errors_of_numbers_by_path_name_the_row():
    with pytest.raises(tig.DesignError, match=r"row 1: ground\.mass = -1\.0: give a number from 0"):
        solve_many(BOGIE, **{"ground.mass": [1.0, -1.0]})
    with pytest.raises(tig.DesignError, match=r"row 1: ground\.stiffness = 100000000\.0: give a ground too"):
        solve_many(BLOCK, ground=[CLAY, None], **{"ground.stiffness": 1e8})


def test_a_table_has_a_column_for_each_number_that_there_is():
    table = solve_many([BOGIE, BLOCK], reference="stiff").to_dataframe()
    for path in PATHS:
        assert table[path][0] == BOGIE.value(path)
        assert np.isnan(table[path][1])
    freight = solve_many(BLOCK.replace(suspension=tig.VEHICLES["freight"].suspension)).to_dataframe()
    assert "suspension.bogie_mass" in freight
    assert not {"suspension", "suspension.body_mass", "ground.stiffness"} & {*freight}


@pytest.mark.parametrize(
    ("design", "x", "y"),
    [
        (SPRUNG, "suspension.primary_stiffness", "suspension.primary_damping"),
        (SPRUNG, "boot_stiffness", "suspension.bogie_mass"),
        (BOGIE, "ground.stiffness", "ground.damping"),
        (BOGIE, "ground.mass", "suspension.secondary_stiffness"),
        (FOLLOWING, "speed", "block_mass"),
    ],
)
def test_every_point_of_a_map_is_the_design_with_those_numbers(design, x, y):
    reference = "line" if design.ground is None else "stiff"
    found = tig.decide.design_map(
        design, x, y, limits_of(design), figures=["margin", "63"], points=(3, 2), reference=reference
    )
    assert (found.x[0], found.x[-1]) == SEARCHED_RANGES[x]
    specification = limits_of(design)
    for row, column in np.ndindex(2, 3):
        expected = changed(changed(design, x, float(found.x[column])), y, float(found.y[row]))
        assert found.design_at(found.x[column], found.y[row]) == expected
        alone = tig.solve(expected, "exact")
        np.testing.assert_allclose(found.figures["63"][row, column], alone.insertion_gain[11], atol=1e-6)
        margin = (specification.levels - alone.insertion_gain).min()
        np.testing.assert_allclose(found.figures["margin"][row, column], margin, atol=1e-6)


def test_changes_are_those_of_changed_objects_and_small_ones_the_slope():
    found = tig.decide.sensitivity(BOGIE, changes=0.1, reference="stiff")
    around = [path for path in PATHS if BOGIE.value(path)]
    assert [name for name in found.fields if name not in SLIDER_RANGES] == around
    own = tig.solve(BOGIE, "exact").insertion_gain
    for path in around:
        for side, factor in enumerate((0.9, 1.1)):
            alone = tig.solve(changed(BOGIE, path, BOGIE.value(path) * factor), "exact").insertion_gain
            row = found.bands[found.fields.index(path), side]
            np.testing.assert_allclose(row, alone - own, atol=1e-6)
    # halved changes are halved differences, but for what bends: a central difference of either is the slope
    halved = tig.decide.sensitivity(BOGIE, changes=dict.fromkeys(around, 0.05), reference="stiff")
    for row, path in enumerate(around):
        wide = found.bands[found.fields.index(path)]
        slopes = [
            (each[1] - each[0]) / (2 * share) for each, share in ((wide, 0.1), (halved.bands[row], 0.05))
        ]
        np.testing.assert_allclose(slopes[0], slopes[1], atol=0.03 * np.abs(slopes[1]).max() + 1e-4)


def test_what_is_nothing_or_does_not_matter_cannot_be_changed():
    massless = BLOCK.replace(ground=tig.GROUNDS["rock"])
    assert "ground.mass" not in tig.decide.sensitivity(massless, reference="stiff").fields
    with pytest.raises(
        ValueError, match=r"'ground\.mass' cannot be changed .* ground\.stiffness, ground\.damping"
    ):
        tig.decide.sensitivity(massless, changes={"ground.mass": 0.1}, reference="stiff")
    with pytest.raises(ValueError, match=r"'ground\.mass' is not a single number .* ground\.stiffness"):
        tig.decide.tolerance(massless, limits_of(massless), {"ground.mass": 0.1}, reference="stiff")
    with pytest.raises(ValueError, match="'speed' is not a single number"):
        tig.decide.design_map(BLOCK.replace(speed=30.0), "speed", "block_mass")
    freight = BLOCK.replace(suspension=tig.VEHICLES["freight"].suspension)
    with pytest.raises(ValueError, match=r"'suspension\.body_mass' is not .* suspension\.bogie_mass"):
        tig.decide.design_map(freight, "suspension.body_mass", "block_mass")


def test_a_reference_without_meaning_is_refused_before_anything_is_solved():
    def asked(_):
        raise AssertionError("designs were solved")

    with pytest.raises(ValueError, match="give 'stiff'"):
        tig.decide.design_map(BOGIE, "ground.stiffness", "block_mass", progress=asked)


def test_tolerances_of_a_ground_scatter_its_numbers():
    share = {"ground.stiffness": 0.3, "suspension.primary_stiffness": 0.1}
    found = tig.decide.tolerance(BOGIE, limits_of(BOGIE, 0.2), share, samples=100, reference="stiff")
    for path, most in share.items():
        ratio = found.many.column(path) / BOGIE.value(path)
        assert 1 - most <= ratio.min() < 1 - 0.9 * most
        assert 1 + 0.9 * most < ratio.max() <= 1 + most
        assert abs(found.worst_corner.value(path) / BOGIE.value(path) - 1) == pytest.approx(most)
    assert {*found.tightened} == {*share}
    for row in (0, 57):
        alone = tig.solve(found.many.design(row), "exact").insertion_gain
        np.testing.assert_allclose(found.many.gain_for("stiff")[row], alone, atol=1e-6)
    assert "ground.stiffness" in found.to_dataframe()


def test_more_tolerances_than_corners_can_be_solved_are_refused():
    many = dict.fromkeys((*SLIDER_RANGES, *PATHS), 0.1)
    with pytest.raises(ValueError, match="17 tolerances: give at most 12"):
        tig.decide.tolerance(BOGIE, limits_of(BOGIE), many, reference="stiff")


def test_ranges_along_a_ground_end_where_designs_just_comply():
    specification = limits_of(BLOCK.replace(ground=CLAY), 0.3)
    design = BLOCK.replace(ground=CLAY)
    assert {*tig.decide.feasible_ranges(design, specification, reference="stiff", fields=["block_mass"])} == {
        "block_mass"
    }
    found = tig.decide.feasible_ranges(
        design,
        specification,
        reference="stiff",
        fields=["ground.stiffness"],
        ranges={"ground.stiffness": (20e6, 200e6)},
    )
    inner = [edge for ends in found["ground.stiffness"] for edge in ends if 20e6 < edge < 200e6]
    assert inner
    for edge in inner:
        around = [changed(design, "ground.stiffness", factor * edge) for factor in (0.998, 1.002)]
        checks = [specification.check(tig.solve(each, "exact").insertion_gain) for each in around]
        complying = [check.worst_margin >= 0 for check in checks]
        assert complying.count(True) == 1
    assert "ground stiffness" in str(found)


def test_a_search_may_free_a_suspension_and_seek_a_number_of_it():
    found = tig.decide.find(
        SPRUNG,
        limits_of(SPRUNG, 0.5),
        {"suspension.bogie_mass": (300.0, 2000.0), "boot_stiffness": (10e6, 40e6)},
        objectives=["margin", "suspension.bogie_mass"],
        population=8,
        generations=2,
    )
    masses = found.many.column("suspension.bogie_mass")
    assert masses.min() >= 300.0
    assert masses.max() <= 2000.0
    np.testing.assert_array_equal(found.values[:, 1], masses)


def test_kept_answers_about_a_ground_come_out_of_a_study_again():
    settings = {
        "x_field": "ground.stiffness",
        "y_field": "suspension.bogie_mass",
        "ranges": {"ground.stiffness": [20e6, 200e6]},
        "points": [3, 3],
    }
    asked = Question("map", BOGIE, settings, reference="stiff")
    answer = Answer.of(asked, asked.ask())
    study = tig.Study.from_toml(tig.Study(BOGIE, answers=(answer,)).to_toml())
    assert study.answers == (answer,)
    assert study.answers[0].holds()


def test_parts_solved_apart_are_joined_with_their_references():
    apart = [solve_many([BLOCK, SPRUNG]), solve_many([BOGIE])]
    assert [part.stiff_ratio is None for part in apart] == [True, False]
    together = solve_many([BLOCK, SPRUNG, BOGIE])
    np.testing.assert_array_equal(joined(apart).gain_for("stiff"), together.gain_for("stiff"))
