"""Probability of compliance against brute force; Sobol indices against a function with a closed form."""

import time

import numpy as np
import pytest

import trackig_core as tig
from tests.core.decide.test_feasible import limits_around
from tests.core.frequency_domain.test_batch import CURVE
from trackig_core.decide.production import _helpful, tolerance
from trackig_core.decide.sensitivities import indices_of, sensitivity, sobol
from trackig_core.decide.tolerances import Normal, Uniform, drawn_shares, make_factors
from trackig_core.decide.words import change_words
from trackig_core.track.fields import GIVEN

BLOCK = tig.PRESETS["booted-block-low-mass"]

TOLERANCES = {"boot_stiffness": 0.15, "boot_loss_factor": Normal(0.1), "pad_stiffness": 0.1}


@pytest.fixture(scope="module")
def specification():
    return limits_around(BLOCK, 1.0)


@pytest.fixture(scope="module")
def answer(specification):
    return tolerance(BLOCK, specification, TOLERANCES, samples=4096, seed=7)


def test_probability_is_that_of_independent_random_numbers(answer, specification):
    random = np.random.default_rng(1)
    count = 40_000
    normal = random.normal(0, 1, 2 * count)
    normal = normal[np.abs(normal) <= 3][:count]
    many = tig.solve_many(
        BLOCK,
        boot_stiffness=BLOCK.boot_stiffness * random.uniform(0.85, 1.15, count),
        boot_loss_factor=BLOCK.boot_loss_factor * (1 + 0.1 * normal),
        pad_stiffness=BLOCK.pad_stiffness * random.uniform(0.9, 1.1, count),
    )
    margins = (specification.levels - many.insertion_gain).min(axis=1)
    expected = (margins >= 0).mean()
    assert 0.2 < expected < 0.9
    low, high = answer.confidence_interval
    assert low < expected < high
    assert answer.probability == pytest.approx(expected, abs=0.008)  # three standard errors of brute force
    np.testing.assert_allclose(
        answer.percentiles, np.percentile(many.insertion_gain, (5, 50, 95), axis=0), atol=0.03
    )
    np.testing.assert_allclose(answer.margin_percentiles, np.percentile(margins, (5, 50, 95)), atol=0.05)


def test_the_interval_is_wilsons(answer):
    z, n, p = 1.959963984540054, answer.samples, answer.probability
    middle = (p + z**2 / 2 / n) / (1 + z**2 / n)
    half = z * np.sqrt(p * (1 - p) / n + z**2 / 4 / n**2) / (1 + z**2 / n)
    assert answer.confidence_interval == pytest.approx((middle - half, middle + half))


def test_the_worst_corner_is_the_worst_of_all(answer, specification):
    assert answer.worst_margin == pytest.approx(
        specification.check(tig.solve(answer.worst_corner, "exact").insertion_gain).worst_margin, abs=0.01
    )
    assert answer.worst_margin < answer.margin_percentiles[0]
    ratio = answer.worst_corner.boot_stiffness / BLOCK.boot_stiffness
    assert min(abs(ratio - 0.85), abs(ratio - 1.15)) < 1e-12
    ratio = answer.worst_corner.boot_loss_factor / BLOCK.boot_loss_factor
    assert min(abs(ratio - 0.8), abs(ratio - 1.2)) < 1e-12


def test_what_to_tighten_is_what_helps_most_when_tightened(answer, specification):
    assert set(answer.tightened) == set(TOLERANCES)
    halved = {"boot_stiffness": 0.075, "boot_loss_factor": Normal(0.05), "pad_stiffness": 0.05}
    by_hand = {
        name: tolerance(
            BLOCK, specification, {**TOLERANCES, name: halved[name]}, samples=2048, seed=7
        ).probability
        for name in halved
    }
    # the first samples of a sequence are the same, however many there are
    assert answer.tightened == pytest.approx(by_hand)
    assert answer.tighten_first == max(by_hand, key=by_hand.get)
    assert list(answer.tightened.values()) == sorted(by_hand.values(), reverse=True)
    assert str(answer).endswith(f"tighten the {answer.tighten_first.replace('_', ' ')} first.")


@pytest.mark.parametrize(("spare", "helpful"), [(0.5, ("boot_stiffness",)), (0.001, ()), (-8.0, ())])
def test_nothing_is_to_be_tightened_where_that_lets_no_more_comply(spare, helpful):
    """Half of a production complies whose design just does, however little scatters."""
    level = tig.solve(BLOCK, "exact").insertion_gain[tig.BAND_LABELS.index("63")]
    limit = tig.Specification([(63, float(level) + spare)])
    scatters = {"boot_stiffness": 0.15, "pad_loss_factor": 0.2, "block_mass": 0.02}
    found = tolerance(BLOCK, limit, scatters, samples=2048)
    assert found.helpful == helpful
    assert found.tighten_first == (helpful[0] if helpful else None)
    assert found.design_complies == (spare > 0)
    expected = {
        0.5: "; tighten the boot stiffness first.",
        0.001: ", and no more whichever scatter is halved.",
        -8.0: ", nor does the design.",
    }
    assert str(found).endswith(f" complies{expected[spare]}")


def test_no_advice_is_given_to_a_design_that_itself_fails():
    """What scatters lets some of it comply, and the less it scatters, the fewer."""
    level = tig.solve(BLOCK, "exact").insertion_gain[tig.BAND_LABELS.index("63")]
    found = tolerance(BLOCK, tig.Specification([(63, float(level) - 0.5)]), TOLERANCES, samples=2048)
    assert 0 < found.tightened["boot_stiffness"] < found.probability < 0.5
    assert not found.design_complies
    assert str(found).endswith(" complies; the design as stated does not.")


def test_what_helps_as_much_as_the_best_is_named_beside_it():
    drawn = np.arange(1000) < 800
    best, close, less = (np.arange(1000) < 800 + gain for gain in (100, 99, 40))
    close[0] = False
    worse = np.arange(1000) < 700
    named = _helpful(drawn, {"best": best, "close": close, "less": less, "same": drawn, "worse": worse})
    assert named == ("best", "close")
    # three more of a thousand may be chance, nine are not
    for gain, expected in ((3, ()), (9, ("one",))):
        assert _helpful(drawn, {"one": np.arange(1000) < 800 + gain}) == expected
    assert _helpful(drawn, {}) == ()


def test_the_same_seed_gives_the_same_figures_and_another_gives_others(answer, specification):
    again = tolerance(BLOCK, specification, TOLERANCES, samples=4096, seed=7)
    other = tolerance(BLOCK, specification, TOLERANCES, samples=4096, seed=8)
    assert np.array_equal(again.margins, answer.margins)
    assert again.confidence_interval == answer.confidence_interval
    assert not np.array_equal(other.margins, answer.margins)


def test_all_complies_and_nothing_does():
    loose, hopeless = limits_around(BLOCK, 30.0), tig.Specification([(5.0, -40.0)])
    sure = tolerance(BLOCK, loose, {"boot_stiffness": 0.1}, samples=200)
    assert sure.probability == 1
    assert sure.tighten_first is None
    assert str(sure) == "All of production (98.1–100.0 %) complies."
    never = tolerance(BLOCK, hopeless, {"boot_stiffness": 0.1}, samples=200)
    assert never.probability == 0
    # what helps nothing is no advice
    assert never.tighten_first is None
    assert str(never) == "None of production (0.0–1.9 %) complies, nor does the design."


def test_a_deflection_limit_counts():
    loose = limits_around(BLOCK, 30.0)
    limit = tig.static_response(BLOCK, 85e3).rail_deflection
    half = tolerance(BLOCK, loose, {"boot_stiffness": 0.1}, samples=1024, max_deflection=limit)
    assert half.probability == pytest.approx(
        0.5, abs=0.01
    )  # it sinks less with the stiffer half of the boots


@pytest.mark.slow
def test_ten_thousand_samples_cost_less_than_five_paper_runs(specification):
    tolerances = dict.fromkeys(("pad_stiffness", "boot_stiffness", "boot_loss_factor", "block_mass"), 0.1)
    calls = {
        "paper": lambda: tig.solve(BLOCK, "paper"),
        "samples": lambda: tolerance(BLOCK, specification, tolerances, samples=10_000),
    }
    took = {name: [] for name in calls}
    for _ in range(3):
        for name, call in calls.items():
            begin = time.perf_counter()
            call()
            took[name].append(time.perf_counter() - begin)
    assert min(took["samples"]) < 5 * min(took["paper"])


def test_specimens_are_taken_whole(specification):
    stiffness, loss = [26e6, 28e6, 31e6], [0.25, 0.2, 0.15]
    table = {"boot_stiffness": stiffness, "boot_loss_factor": loss}
    found = tolerance(BLOCK, specification, {"pad_stiffness": 0.05}, production=table, samples=999)
    drawn = found.many.to_dataframe()[["boot_stiffness", "boot_loss_factor"]]
    counts = drawn.value_counts()
    assert {*counts.index} == {*zip(stiffness, loss, strict=True)}
    assert counts.min() > 320
    assert {*found.tightened} == {"pad_stiffness", "production"}


def test_measured_curves_are_specimens_too(specification):
    stiffer = tig.StiffnessCurve([(hz, 1.3 * k, loss) for hz, k, loss in CURVE.points])
    measured = BLOCK.replace(boot_stiffness=CURVE, boot_loss_factor=None)
    found = tolerance(
        measured, specification, {"pad_stiffness": 0.05}, production={"boot_stiffness": [CURVE, stiffer]}
    )
    expected = tolerance(measured, specification, {"pad_stiffness": 0.05}).complying / 2
    expected += (
        tolerance(measured.replace(boot_stiffness=stiffer), specification, {"pad_stiffness": 0.05}).complying
        / 2
    )
    assert found.complying == pytest.approx(expected, abs=100)
    assert {*found.tightened} == {"pad_stiffness"}


@pytest.mark.parametrize(
    ("tolerances", "production", "error", "message"),
    [
        ({}, None, ValueError, "nothing varies: give a tolerance"),
        ({"boot_stifness": 0.1}, None, ValueError, "'boot_stifness' is not a single number of this design"),
        ({"rail": 0.1}, None, ValueError, "'rail' is not a single number"),
        ({"boot_stiffness": 10}, None, ValueError, r"tolerance = 10: give a share above 0 and up to 0.9"),
        ({"boot_stiffness": -0.1}, None, ValueError, "tolerance = -0.1"),
        ({"boot_stiffness": 0.1}, {"boot_stiffness": [1e7]}, ValueError, "has a tolerance and production"),
        ({}, {"boot_stiffness": [1e7], "block_mass": [1.0, 2.0]}, ValueError, "columns of the same length"),
        ({}, {"boot_stiffness": [1e7, 3.0]}, tig.DesignError, "row 1: boot_stiffness = 3"),
    ],
)
def test_what_cannot_be_drawn_is_refused(tolerances, production, error, message):
    with pytest.raises(error, match=message):
        make_factors(BLOCK, tolerances, production)


def test_a_tolerance_beyond_what_a_track_can_have_is_refused():
    soft = BLOCK.replace(pad_loss_factor=1.95)
    with pytest.raises(
        tig.DesignError, match=r"pad_loss_factor = 2\.14.*a tolerance that stays within 0 to 2"
    ):
        make_factors(soft, {"pad_loss_factor": 0.1})


def test_shares_go_on_where_they_were_left():
    whole = drawn_shares(3, 1000, seed=5)
    assert np.array_equal(drawn_shares(3, 400, seed=5, first=600), whole[600:])
    assert whole.min() >= 0
    assert whole.max() < 1
    assert np.abs(whole.mean(axis=0) - 0.5).max() < 0.01


def test_a_normal_tolerance_has_its_deviation_and_is_cut_off():
    factors = Normal(0.1).factors(np.linspace(0, 1, 100_001))
    assert factors[0] == pytest.approx(0.7)
    assert factors[-1] == pytest.approx(1.3)
    assert factors.std() == pytest.approx(0.1 * 0.9866, rel=1e-3)  # of a normal cut at three deviations
    assert Uniform(0.1).factors(np.array([0.0, 0.5, 1.0])) == pytest.approx([0.9, 1.0, 1.1])


def test_indices_of_the_ishigami_function():
    """Closed form: Ishigami and Homma (1990), with a = 7, b = 0.1."""

    def ishigami(shares):
        x = np.pi * (2 * shares - 1)
        value = np.sin(x[0]) + 7 * np.sin(x[1]) ** 2 + 0.1 * x[2] ** 4 * np.sin(x[0])
        return np.stack([value, 3.0 * x[0]])

    found = indices_of(ishigami, ("a", "b", "c"), ("one", "two"), 4096, seed=0)
    a, b, pi = 7.0, 0.1, np.pi
    parts = np.array([0.5 * (1 + b * pi**4 / 5) ** 2, a**2 / 8, 0.0])
    together = b**2 * pi**8 * (1 / 18 - 1 / 50)
    variance = parts.sum() + together
    np.testing.assert_allclose(found.first_order[0], parts / variance, atol=0.01)
    np.testing.assert_allclose(
        found.total_order[0], (parts + np.array([together, 0, together])) / variance, atol=0.01
    )
    np.testing.assert_allclose(found.first_order[1], [1, 0, 0], atol=0.01)
    low, high = np.moveaxis(found.total_order_interval, -1, 0)
    assert (low <= found.total_order + 1e-9).all()
    assert (high >= found.total_order - 1e-9).all()


def test_sobol_indices_of_a_track(specification):
    found = sobol(BLOCK, TOLERANCES, specification, figures=("margin", "coupled_block", "63"), samples=256)
    # the coupled block swings on pad and boot in parallel, nearly linearly: shares as of k^2 tol^2
    pad, boot = BLOCK.pad_stiffness * 0.1, BLOCK.boot_stiffness * 0.15
    expected = np.array([boot**2, 0.0, pad**2]) / (boot**2 + pad**2)
    np.testing.assert_allclose(found.first_order[1], expected, atol=0.05)
    assert found.to_dataframe().shape == (9, 8)
    assert str(found).startswith("Of the scatter of the governing margin, ")
    with pytest.raises(ValueError, match="samples = 100: give a power of two"):
        sobol(BLOCK, TOLERANCES, specification, samples=100)
    with pytest.raises(ValueError, match="margin: there is no specification"):
        sobol(BLOCK, TOLERANCES)


def test_all_that_scatters_is_due_to_what_scatters_alone(specification):
    found = sobol(BLOCK, {"boot_stiffness": 0.2}, specification, samples=256)
    np.testing.assert_allclose([found.first_order, found.total_order], 1, atol=0.03)
    for low, high in (found.first_order_interval[0, 0], found.total_order_interval[0, 0]):
        assert low < 1 < high


def test_differences_are_those_of_exact_solutions(specification):
    source = tig.SourceSpectrum([(each, 60.0) for each in tig.BAND_CENTRES])
    found = sensitivity(BLOCK, specification, source=source)
    base, softer = (
        tig.solve(design, "exact")
        for design in (BLOCK, BLOCK.replace(boot_stiffness=0.9 * BLOCK.boot_stiffness))
    )
    row = found.fields.index("boot_stiffness")
    np.testing.assert_allclose(found.bands[row, 0], softer.insertion_gain - base.insertion_gain, atol=0.005)
    level = source.with_track(softer.insertion_gain).relative_to(source.with_track(base.insertion_gain))
    assert found.differences["level"][row, 0] == pytest.approx(level.a_weighted, abs=0.005)
    margins = [specification.check(each.insertion_gain).worst_margin for each in (base, softer)]
    assert found.differences["margin"][row, 0] == pytest.approx(margins[1] - margins[0], abs=0.005)
    sinks = [tig.static_response(each.design, 85e3).rail_deflection for each in (base, softer)]
    assert found.differences["deflection"][row, 0] == pytest.approx(sinks[1] - sinks[0], rel=1e-9)
    tracks = [each.natural_frequencies.loaded_track for each in (base, softer)]
    assert found.differences["loaded_track"][row, 0] == pytest.approx(tracks[1] - tracks[0], rel=1e-6)
    assert found.ranked("margin")[0] in str(found).replace(" ", "_")
    own = next(name for name in found.ranked("margin") if name not in GIVEN)
    assert f"depends most on {own.replace('_', ' ')}: 10 % less" in str(found)
    assert str(found).startswith("Of the track's own numbers, the ")
    # of the loaded track's mass, the wheel is nearly all
    assert found.ranked("loaded_track")[0] == "wheel_mass"
    assert found.first("loaded_track") == ("fastener_spacing", "wheel_mass")
    assert sensitivity(BLOCK, changes={"wheel_mass": 0.1}).first("loaded_track") == ("wheel_mass", "")
    assert found.to_dataframe().shape == (16, 2 + 5 + 21)


@pytest.mark.parametrize(
    ("value", "words"),
    [
        *((0.0, "0"), (-3e-17, "0"), (0.34, "+0.34"), (-0.0999, "-0.10"), (0.00213, "+0.0021")),
        *((-12.4, "-12"), (9.96, "+10"), (123.4, "+120"), (1.0, "+1.0"), (5e-6, "+0.0000050")),
    ],
)
def test_a_change_has_two_figures_however_small(value, words):
    assert change_words(value) == words


def test_a_small_change_of_deflection_is_told_in_millimetres():
    found = sensitivity(BLOCK, changes={"pad_stiffness": 0.01})
    less, more = 1e3 * found.differences["deflection"][0]
    assert 0 < less < 0.05
    assert f"by {less:+.2g} mm, 1 % more by {more:+.2g} mm." in str(found)


def test_a_measured_curve_changes_as_a_whole():
    measured = BLOCK.replace(boot_stiffness=CURVE, boot_loss_factor=None)
    found = sensitivity(measured, changes={"boot_stiffness": 0.2})
    softer = measured.replace(
        boot_stiffness=tig.StiffnessCurve([(hz, 0.8 * k, loss) for hz, k, loss in CURVE.points])
    )
    expected = tig.solve_many([softer]).insertion_gain[0] - tig.solve_many([measured]).insertion_gain[0]
    np.testing.assert_allclose(found.bands[0, 0], expected, atol=1e-6)
    with pytest.raises(ValueError, match="'boot_loss_factor' cannot be changed in this design"):
        sensitivity(measured, changes={"boot_loss_factor": 0.2})
    with pytest.raises(ValueError, match="change of block_mass = 2"):
        sensitivity(measured, changes={"block_mass": 2})
