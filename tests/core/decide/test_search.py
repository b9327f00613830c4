"""Searches and maps against exact solutions and against every point of a fine grid."""

import dataclasses

import numpy as np
import pytest

import trackig_core as tig
from tests.core.decide.test_feasible import complies, limits_around
from trackig_core.decide import design_map, find

BLOCK, SLAB = tig.PRESETS["booted-block-low-mass"], tig.PRESETS["slab-track"]

FREE = {"boot_stiffness": (10e6, 60e6), "block_mass": (20.0, 200.0)}


@pytest.fixture(scope="module")
def specification():
    """Return limits that this design keeps with some 1.5 dB to spare, under a deflection limit."""
    return limits_around(BLOCK.replace(boot_stiffness=20e6, block_mass=100.0), 1.5, bands=range(8, 21))


@pytest.fixture(scope="module")
def found(specification):
    return find(BLOCK, specification, FREE, max_deflection=2e-3, population=40, generations=60, seed=1)


def test_what_is_found_complies_exactly(found, specification):
    best = found.best()
    assert len(best) >= 10
    for design, values in zip(best[::5], found.values[found.front][::5], strict=True):
        solution = tig.solve(design, "exact")
        assert complies(design, specification)
        margin = specification.check(solution.insertion_gain).worst_margin
        deflection = tig.static_response(design, 85e3).rail_deflection
        assert values == pytest.approx([margin, deflection], abs=0.01)
        assert deflection <= 2e-3
        assert design.pad_stiffness == BLOCK.pad_stiffness


def test_the_front_is_that_of_a_fine_grid(found, specification):
    """No design of a fine grid beats the front by more than 0.1 dB, and it ends where the front does."""
    seen = design_map(
        BLOCK,
        "boot_stiffness",
        "block_mass",
        specification,
        ranges=FREE,
        points=(150, 150),
        max_deflection=2e-3,
    )
    margin = np.where(seen.complies, seen.figures["margin"], -np.inf)
    front = found.values[found.front]
    assert front[:, 0].max() == pytest.approx(margin.max(), abs=0.05)
    least = seen.figures["deflection"][seen.complies].min()
    assert front[:, 1].min() == pytest.approx(least, rel=0.01)
    for best, sinks in front:
        assert margin[seen.figures["deflection"] <= sinks].max() <= best + 0.1
    assert np.all(np.diff(front[:, 0]) < 0)  # sorted by margin, and each pays for it in deflection
    assert np.all(np.diff(front[:, 1]) < 0)


def test_one_design_is_spoken_of_as_one(found):
    """Zero, one and many: an answer is read aloud."""

    def said(slack, front):
        values = np.array([[1.0, 2e-3], [2.0, 1e-3]])[: len(slack)]
        return str(
            dataclasses.replace(
                found,
                slack=np.array(slack),
                front=np.array(front, int),
                values=values,
                governed_by=("63", "80"),
            )
        )

    assert said([-1.0, -2.0], []) == "No design complies; the closest misses the limit at 63 Hz by 1.0 dB."
    assert said([1.0, -2.0], [0]) == "1 of 2 designs complies: margin 1.0 dB, deflection 2.00 mm."
    assert said([1.0, 2.0], [1]) == (
        "2 of 2 designs comply, and no other beats one of them: margin 2.0 dB, deflection 1.00 mm."
    )
    assert said([1.0, 2.0], [0, 1]) == (
        "2 of 2 designs comply, and no other beats 2 of them: "
        "margin from 1.0 dB to 2.0 dB, deflection from 1.00 mm to 2.00 mm."
    )


def test_a_search_without_a_limit_of_deflection_says_so_and_what_the_best_sink(specification, found):
    assert found.deflection_limit == 2e-3
    assert found.unlimited == ""
    free = find(BLOCK, specification, ["boot_stiffness"], population=8, generations=3)
    load = specification.wheel_load
    for row in free.front[:3]:
        expected = tig.static_response(free.many.design(int(row)), load).rail_deflection
        assert free.deflections[row] == pytest.approx(expected, rel=1e-6)
    least, most = (1e3 * end(free.deflections[free.front]) for end in (np.min, np.max))
    span = f"from {least:.2f} mm to {most:.2f} mm" if f"{least:.2f}" != f"{most:.2f}" else f"{least:.2f} mm"
    assert str(free).endswith(
        f" No limit of rail deflection is set: with the best designs the rail sinks {span}."
    )


def test_it_is_explained_what_no_other_beats(found):
    assert found.explained == (
        "No other beats a design: none that was tried is as good in margin and deflection, and better in one "
        "of them."
    )
    alone = dataclasses.replace(found, objectives=("margin",), values=found.values[:, :1])
    assert alone.explained.endswith("none that was tried is better in margin.")
    for row in found.front:
        margin, sinks = found.values[row]
        others = found.values[found.complies]
        better = (others[:, 0] >= margin) & (others[:, 1] <= sinks)
        assert not (better & ((others[:, 0] > margin) | (others[:, 1] < sinks))).any()


def test_nothing_complies_and_it_says_what_stands_in_the_way(specification):
    hopeless = tig.Specification([(5.0, -20.0), (63.0, 50.0)])
    found = find(BLOCK, hopeless, ["boot_stiffness"], population=8, generations=3)
    assert not found.complies.any()
    assert found.best() == []
    assert found.in_the_way == "5"
    assert str(found).startswith("No design complies; the closest misses the limit at 5 Hz by ")
    closest = found.many.design(found.closest)
    miss = -hopeless.check(tig.solve(closest, "exact").insertion_gain).worst_margin
    assert str(found).endswith(f" by {miss:.1f} dB.")
    stiff = find(BLOCK, specification, ["boot_stiffness"], max_deflection=1e-5, population=8, generations=3)
    assert stiff.in_the_way == "deflection"
    assert "more than allowed" in str(stiff)


def test_catalogue_choices_are_taken_whole(specification):
    boots = [
        {"boot_stiffness": 20e6, "boot_loss_factor": 0.15, "cost": 30.0},
        {"boot_stiffness": 28e6, "boot_loss_factor": 0.25, "cost": 20.0},
    ]
    rails = [tig.RAILS["60"], tig.RAILS["54E1"]]
    found = find(
        BLOCK,
        specification,
        ["block_mass"],
        choices={"boot": boots, "rail": rails},
        objectives=("margin", "cost", "block_mass"),
        cost={"block_mass": 0.5},
        population=20,
        generations=8,
    )
    pairs = {*zip(found.many.columns["boot_stiffness"], found.many.columns["boot_loss_factor"], strict=True)}
    assert pairs == {(20e6, 0.15), (28e6, 0.25)}
    assert {*found.many.columns["rail"]} == {*rails}
    price = np.where(found.many.columns["boot_stiffness"] == 20e6, 30.0, 20.0)
    np.testing.assert_allclose(found.values[:, 1], price + 0.5 * found.many.columns["block_mass"])
    np.testing.assert_array_equal(found.values[:, 2], found.many.columns["block_mass"])


def test_a_static_stiffness_keeps_its_ratio(specification):
    stated = BLOCK.replace(boot_static_stiffness=14e6, pad_static_stiffness=60e6)
    found = find(stated, specification, ["boot_stiffness"], population=8, generations=2)
    columns = found.many.columns
    np.testing.assert_allclose(columns["boot_static_stiffness"], columns["boot_stiffness"] / 2)
    assert {*columns["pad_static_stiffness"]} == {60e6}


def test_the_same_seed_finds_the_same(found, specification):
    again = find(BLOCK, specification, FREE, max_deflection=2e-3, population=40, generations=60, seed=1)
    assert np.array_equal(again.values, found.values)
    assert np.array_equal(again.front, found.front)


def test_it_tells_how_far_it_is_and_stops_with_the_best_so_far(specification):
    told, seen = [], []
    found = find(
        BLOCK,
        specification,
        FREE,
        population=12,
        generations=50,
        progress=told.append,
        so_far=seen.append,
        cancelled=lambda: len(seen) >= 4,
    )
    assert found.stopped
    assert found.generations == 4
    assert told == pytest.approx([0.02, 0.04, 0.06, 0.08])
    assert [each.slack.size for each in seen][:3] == [12, 24, 36]


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"free": []}, "nothing is free"),
        ({"free": ["rail"]}, "'rail' is not a single number"),
        ({"choices": {"boot_stiffness": [1e7]}}, "boot_stiffness: free in two ways"),
        ({"choices": {"boot": []}}, "boot: give one or more"),
        (
            {"choices": {"pad": [{"pad_stiffness": 1e8}, {"pad_loss_factor": 0.1}]}},
            "pad: give the same fields",
        ),
        ({"objectives": ["cost"]}, "cost: give a cost per unit"),
        ({"objectives": ["level"]}, "level: there is no source"),
        ({"objectives": []}, "objectives: give one or more"),
        ({"cost": {"colour": 1.0}}, "cost of 'colour'"),
        ({"population": 2}, "population of 4 or more"),
    ],
)
def test_what_cannot_be_sought_is_refused(specification, changes, message):
    arguments = {"free": ["boot_stiffness"], **changes}
    with pytest.raises(ValueError, match=message):
        find(BLOCK, specification, **arguments)


def test_every_point_of_a_map_is_the_exact_design(specification):
    source = tig.SourceSpectrum([(each, 60.0) for each in tig.BAND_CENTRES])
    figures = ("margin", "level", "deflection", "loaded_track", "63")
    seen = design_map(
        BLOCK,
        "boot_stiffness",
        "fastener_spacing",
        specification,
        source=source,
        figures=figures,
        points=(9, 7),
    )
    row, column = 5, 2
    design = BLOCK.replace(boot_stiffness=seen.x[column], fastener_spacing=seen.y[row])
    assert seen.design_at(seen.x[column] * 1.01, seen.y[row] + 0.001) == design
    solution = tig.solve(design, "exact")
    expected = {
        "margin": specification.check(solution.insertion_gain).worst_margin,
        "level": source.with_track(solution.insertion_gain).a_weighted,
        "deflection": tig.static_response(design, 85e3).rail_deflection,
        "loaded_track": solution.natural_frequencies.loaded_track,
        "63": solution.insertion_gain[11],
    }
    for name, value in expected.items():
        assert seen.figures[name].shape == (7, 9)
        assert seen.figures[name][row, column] == pytest.approx(value, abs=0.01), name
    assert seen.complies[row, column] == (expected["margin"] >= 0)
    assert seen.to_dataframe().shape == (63, 2 + 5 + 1)
    # stiffnesses on a logarithmic axis, all else on a linear one, ends and all
    assert seen.x[[0, -1]].tolist() == [2e6, 200e6]
    assert np.allclose(np.diff(np.log(seen.x)), np.log(100) / 8)
    assert np.allclose(np.diff(seen.y), 0.8 / 6)


def test_a_map_without_a_specification_has_no_margin():
    seen = design_map(SLAB, "pad_stiffness", "wheel_mass", points=(4, 3))
    assert seen.complies is None
    assert tuple(seen.figures) == ("deflection", "loaded_track")
    with pytest.raises(ValueError, match="margin: there is no specification"):
        design_map(SLAB, "pad_stiffness", "wheel_mass", figures=["margin"])
    with pytest.raises(ValueError, match="coupled_block: a single-stage track has no block"):
        design_map(SLAB, "pad_stiffness", "wheel_mass", figures=["coupled_block"])
    with pytest.raises(ValueError, match="both fields are wheel_mass"):
        design_map(SLAB, "wheel_mass", "wheel_mass")
    with pytest.raises(ValueError, match="points = "):
        design_map(SLAB, "pad_stiffness", "wheel_mass", points=(1, 3))


CATALOGUE = tig.study.Catalogue.from_toml("""
format = "trackig catalogue"
version = 1
name = "A company's own"

[[rail]]
name = "Own"
mass_kg_per_m = 61.0
second_moment_cm4 = 3000
source = "works drawing"

[[rail]]
name = "60"
mass_kg_per_m = 60.0
second_moment_cm4 = 3038
source = "Table 1"

[[pad]]
name = "Plain"
stiffness_N_per_m = 2e8
loss_factor = 0.2
source = "data sheet"

[[pad]]
name = "Measured"
stiffness_measured = [[10.0, 6e7, 0.1], [100.0, 8e7, 0.15], [1000.0, 1e8, 0.2]]
preload_N = 30e3
static_stiffness_N_per_m = 5e7
source = "test house"

[[boot]]
name = "Damping measured"
stiffness_N_per_m = 2e7
loss_factor_measured = [[10.0, 0.1], [500.0, 0.3]]
source = "test house"
""")


def test_measured_components_are_chosen_with_their_curves_and_kept(specification):
    stated = BLOCK.replace(pad_static_stiffness=9e7)
    choices = {
        kind: [each.choice(stated) for each in CATALOGUE.of_kind(kind).values()]
        for kind in ("pad", "boot", "rail")
    }
    found = find(stated, specification, ["block_mass"], choices=choices, population=16, generations=3, seed=1)
    table = found.to_dataframe()
    assert {*table["pad"]} == {"Plain", "Measured"}
    assert {*table["boot"]} == {"Damping measured"}
    assert {*table["rail"]} == {"Own", "60"}
    assert choices["pad"][1]["pad_stiffness"]["preload"] == 30e3
    for row in range(0, 48, 7):
        design, chosen = found.many.design(row), {kind: table[kind][row] for kind in choices}
        expected = stated.replace(block_mass=design.block_mass)
        for kind, name in chosen.items():
            expected = CATALOGUE.of_kind(kind)[name].fitted_to(expected)
        assert design == expected  # static stiffness of the pad and all
        gain = tig.solve(design, "exact").insertion_gain
        np.testing.assert_allclose(found.many.insertion_gain[row], gain, atol=0.01)
    question = tig.decide.Question(
        "find",
        stated,
        {"free": ["block_mass"], "choices": choices, "population": 16, "generations": 3, "seed": 1},
        specification,
    )
    answer = tig.decide.Answer.of(question, found)
    (kept,) = tig.Study.from_toml(tig.Study(stated, answers=[answer]).to_toml()).answers
    assert kept == answer
    assert kept.holds()


def test_what_has_no_single_value_is_no_objective(specification):
    pads = [each.choice(BLOCK) for each in CATALOGUE.of_kind("pad").values()]
    with pytest.raises(ValueError, match="pad_stiffness: a component that is measured over frequency"):
        find(BLOCK, specification, choices={"pad": pads}, objectives=("margin", "pad_stiffness"))
    with pytest.raises(ValueError, match=r"pad_stiffness .*: give points and preload"):
        find(BLOCK, specification, choices={"pad_stiffness": [{"rows": []}]})
    with pytest.raises(ValueError, match="rail 'Wood': give one of 60, "):
        find(BLOCK, specification, choices={"rail": ["Wood"]})
    with pytest.raises(ValueError, match=r"rail .*: give name, mass_per_metre, bending_stiffness"):
        find(BLOCK, specification, choices={"rail": [{"rail": {"name": "Wood"}}]})
