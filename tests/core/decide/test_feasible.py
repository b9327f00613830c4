"""Edges of compliance against exact solutions on both sides of each, and against a far finer scan."""

import numpy as np
import pytest

import trackig_core as tig
from tests.core.frequency_domain.test_batch import CURVE, random_designs
from trackig_core.decide import feasible, solving
from trackig_core.decide.feasible import complying_stretches, feasible_ranges
from trackig_core.track.fields import SLIDER_RANGES

BLOCK, SLAB = tig.PRESETS["booted-block-low-mass"], tig.PRESETS["slab-track"]


def limits_around(design, above, bands=range(21), definition=("line", "energy")):
    """Return a specification that lies above the insertion gain of a design [dB]."""
    levels = tig.solve(design, "exact", reference=definition[0], summation=definition[1]).insertion_gain
    return tig.Specification([(tig.BAND_CENTRES[band], levels[band] + above) for band in bands])


def complies(design, specification, definition=("line", "energy")):
    solution = tig.solve(design, "exact", reference=definition[0], summation=definition[1])
    deflection = tig.analysis.limited_deflection(specification, design)
    return specification.check(solution.insertion_gain, deflection).complies


def edges(found):
    """Yield field, edge and whether the design complies just above it."""
    for field, intervals in found.items():
        for interval in intervals:
            for edge, end in zip(interval, found.ranges[field], strict=True):
                if edge != end:
                    yield field, edge, edge == interval[0]


@pytest.mark.parametrize("definition", [("line", "energy"), ("rigid", "energy"), ("line", "coherent")])
@pytest.mark.parametrize("design", [BLOCK, SLAB], ids=["two-stage", "single-stage"])
def test_exact_solutions_comply_on_one_side_of_each_edge_and_fail_on_the_other(design, definition):
    specification = limits_around(design, 1.0, definition=definition)
    reference, summation = definition
    names = [name for name in SLIDER_RANGES if getattr(design, name) is not None]
    found = feasible_ranges(design, specification, reference=reference, summation=summation, fields=names)
    assert found.complies
    assert list(found) == names
    checked = list(edges(found))
    assert len(checked) >= 8
    for field, edge, above in checked:
        for factor, expected in ((0.999, not above), (1.001, above)):
            moved = design.replace(**{field: edge * factor})
            assert complies(moved, specification, definition) == expected, (field, edge, factor)


def test_what_the_vehicle_gives_is_looked_at_only_when_asked_for():
    fails = limits_around(BLOCK, -1.0)
    own = SLIDER_RANGES.keys() - {"wheel_mass", "contact_stiffness"}
    found = feasible_ranges(BLOCK, fails)
    assert set(found) == own
    assert "vehicle" not in str(found)
    asked = feasible_ranges(BLOCK, fails, fields=["wheel_mass"])
    assert "wheel mass (vehicle) " in asked.sentence("wheel_mass")
    ranged = feasible_ranges(BLOCK, fails, ranges={"wheel_mass": (500.0, 900.0)})
    assert set(ranged) == own | {"wheel_mass"}


def test_a_deflection_limit_makes_an_edge_where_the_rail_sinks_so_far():
    specification = limits_around(BLOCK, 60.0)
    limit = tig.static_response(BLOCK.replace(boot_stiffness=11e6), 85e3).rail_deflection
    found = feasible_ranges(BLOCK, specification, max_deflection=limit)
    ((low, high),) = found["boot_stiffness"]
    assert low == pytest.approx(11e6, rel=1e-4)
    assert high == SLIDER_RANGES["boot_stiffness"][1]
    assert found.deflection_limit == limit
    assert "boot stiffness at least 11 kN/mm" in str(found)
    # the specification's own limit, under a load of its own, is kept too
    points = specification.points
    lighter = tig.Specification(points, rail_deflection_limit=limit, wheel_load=42.5e3)
    assert feasible_ranges(BLOCK, lighter)["boot_stiffness"][0][0] < low


@pytest.mark.slow
def test_no_stretch_wider_than_a_hundredth_is_missed_and_none_is_invented():
    """Random designs against limits that other designs just keep, as narrow as they come."""
    random = np.random.default_rng(3)
    stretches = 0
    for design in random_designs(12, seed=11):
        field = random.choice([name for name in SLIDER_RANGES if getattr(design, name) is not None])
        low, high = SLIDER_RANGES[field]
        values = np.geomspace(low, high, 8193)
        levels = tig.solve_many(design, **{field: values}).insertion_gain
        bands = np.sort(random.choice(21, 6, replace=False))
        limit = levels[random.integers(values.size)][bands] + random.normal(0, 2, 6)
        margins = (limit - levels[:, bands]).min(axis=1)
        # lift the limits so that the best place complies within about a hundredth of its value
        best = int(margins.argmax())
        lift = -min(margins[max(best - 8, 0)], margins[min(best + 8, 8192)])
        specification = tig.Specification(zip(tig.BAND_CENTRES[bands], limit + lift, strict=True))
        found = feasible_ranges(design, specification, fields=[field])
        inside = np.zeros(values.size, dtype=bool)
        for begin, end in found[field]:
            inside |= (values >= begin) & (values <= end)
        # float32 levels, and edges to a thousandth: a step or two of the fine scan
        wrong = np.flatnonzero(inside != (margins + lift >= 0))
        sure = np.abs(margins + lift)[wrong] > 0.01
        assert sure.sum() <= 2, (field, values[wrong])
        stretches += len(found[field])
    assert stretches >= 12


def test_stretches_of_known_functions():
    def evaluate(numbers, places):
        # complies within 0.00316 of the middle, where there is a node
        narrow = 1e-5 - (places - 0.5) ** 2
        wavy = np.sin(20 * places)
        never = np.full(places.shape, -1.0)
        rises, falls = 50 * (places - 0.3), 50 * (0.303 - places)  # both above zero between two nodes
        first = np.choose(numbers, [narrow, wavy, never, rises, -never])
        return np.stack([first, np.where(numbers == 3, falls, first)], axis=-1)

    narrow, wavy, never, kinked, always = complying_stretches(evaluate, 5)
    assert narrow == [pytest.approx((0.5 - 1e-5**0.5, 0.5 + 1e-5**0.5), abs=1e-6)]
    assert wavy == [
        pytest.approx((low, min(low + np.pi / 20, 1)), abs=1e-6) for low in np.arange(4) * np.pi / 10
    ]
    assert never == []
    assert kinked == [pytest.approx((0.30, 0.303), abs=1e-6)]
    assert always == [(0.0, 1.0)]


def test_what_is_measured_or_absent_has_no_range():
    measured = BLOCK.replace(boot_stiffness=CURVE, boot_loss_factor=None)
    found = feasible_ranges(measured, limits_around(measured, 1.0))
    assert "boot_stiffness" not in found
    assert "pad_stiffness" in found
    with pytest.raises(
        ValueError, match="'boot_stiffness' is not a single number of this design: give any of"
    ):
        feasible_ranges(measured, limits_around(measured, 1.0), fields=["boot_stiffness"])


def test_ranges_can_be_given_and_are_checked():
    specification = limits_around(BLOCK, 1.0)
    ranges = {"boot_stiffness": (27e6, 60e6)}
    found = feasible_ranges(BLOCK, specification, ranges=ranges, fields=["boot_stiffness"])
    ((low, high),) = found["boot_stiffness"]
    assert low == 27e6
    assert 28e6 < high < 60e6
    with pytest.raises(tig.DesignError, match="boot_stiffness = 1"):
        feasible_ranges(BLOCK, specification, ranges={"boot_stiffness": (1.0, 60e6)})
    with pytest.raises(ValueError, match="range of boot_stiffness"):
        feasible_ranges(BLOCK, specification, ranges={"boot_stiffness": (60e6, 27e6)})


def test_a_rail_of_the_catalogue_complies_where_its_design_does():
    specification = limits_around(BLOCK, 0.1)
    found = feasible_ranges(BLOCK, specification, fields=[])
    expected = {name: complies(BLOCK.replace(rail=rail), specification) for name, rail in tig.RAILS.items()}
    assert found.rails == expected
    assert {*expected.values()} == {True, False}


def test_it_says_so_when_nothing_helps():
    hopeless = tig.Specification([(5.0, -40.0)])
    found = feasible_ranges(BLOCK, hopeless)
    assert not found.complies
    assert all(intervals == () for intervals in found.values())
    assert str(found).endswith("at 5 Hz; no change of a single field makes it comply.")
    assert found.to_dataframe().empty


@pytest.mark.parametrize("above", [0.1, 2.0])
def test_the_coarse_scan_moves_no_edge(monkeypatch, above):
    """What is left to the spline, far from just complying, is solved too: the same stretches come out."""
    designs = random_designs(4, seed=31)
    limits = [limits_around(each, above, bands=range(4, 21, 3)) for each in designs]
    found = [feasible_ranges(*each) for each in zip(designs, limits, strict=True)]
    monkeypatch.setattr(feasible, "CLEAR", np.inf)
    for design, specification, coarse in zip(designs, limits, found, strict=True):
        fine = feasible_ranges(design, specification)
        assert [len(fine[name]) for name in fine] == [len(coarse[name]) for name in fine]
        for name in fine:
            np.testing.assert_allclose(coarse[name], fine[name], rtol=1e-4)


@pytest.mark.parametrize("above", [0.3, 1.0, 3.0])
def test_all_fields_cost_some_nine_hundred_designs(monkeypatch, above):
    """At 30 us each on two processors: right again well within 200 ms of the last move of a slider."""
    solved = []

    def count(base, columns, how):
        many = solving.solve_designs(base, columns, how)
        solved.append(many.loaded_track.size)
        return many

    monkeypatch.setattr(feasible, "solve_designs", count)
    for preset in tig.PRESETS.values():
        feasible_ranges(preset, limits_around(preset, above), max_deflection=0.003)
        assert len(solved) <= 5
        assert sum(solved) <= 1300
        solved.clear()


def test_a_limit_of_deflection_alone_bounds_stiffness():
    """Where no band has a limit, the rail sinks just as far as allowed at the edge."""
    design = tig.PRESETS["slab-track"]
    sinks = tig.static_response(design).rail_deflection
    alone = tig.Specification((), rail_deflection_limit=1.2 * sinks)
    found = tig.decide.feasible_ranges(design, alone, fields=["pad_stiffness"])
    assert found.complies
    assert found.governed_by == "deflection"
    assert found.margin == pytest.approx(20 * np.log10(1.2), abs=1e-4)
    ((low, high),) = found["pad_stiffness"]
    assert high == found.ranges["pad_stiffness"][1]
    edge = tig.static_response(design.replace(pad_stiffness=low)).rail_deflection
    assert edge == pytest.approx(1.2 * sinks, rel=1e-3)
    assert "its rail sinking" in str(found)
    assert "Hz" not in str(found).split(";")[0]


def test_every_other_question_takes_a_limit_of_deflection_alone():
    design = tig.PRESETS["slab-track"]
    alone = tig.Specification((), rail_deflection_limit=5e-4)
    produced = tig.decide.tolerance(design, alone, {"pad_stiffness": 0.2}, samples=128, seed=1)
    assert 0 <= produced.probability <= 1
    ranges = {"pad_stiffness": (5e6, 2e8)}
    found = tig.decide.find(design, alone, ranges, population=16, generations=2, seed=1)
    assert found.front.size
    assert tig.decide.sensitivity(design, specification=alone)


@pytest.mark.parametrize(
    ("spare", "words"),
    [
        (0.004, "complies, under 0.1 dB within"),
        (-0.004, "fails, under 0.1 dB beyond"),
        (0.06, "complies, 0.1 dB within"),
    ],
)
def test_who_just_fails_is_not_said_to_fail_by_nothing(spare, words):
    level = tig.solve_many(BLOCK).insertion_gain[0, tig.BAND_LABELS.index("63")]
    found = feasible_ranges(BLOCK, tig.Specification([(63, float(level) + spare)]), fields=["block_mass"])
    assert f"{words} the limit at 63 Hz" in str(found)
