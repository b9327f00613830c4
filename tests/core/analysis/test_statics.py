"""Standing wheels against golden results, a dense solution, equilibrium and Zimmermann's beam."""

import json

import numpy as np
import pytest
from scipy.linalg import solveh_banded

import trackig_core as tig
from tests.core.conftest import DATA
from trackig_core.analysis import limited_deflection, static_response, zimmermann_deflection

BLOCK, SLAB = tig.PRESETS["booted-block-low-mass"], tig.PRESETS["slab-track"]
CASES = json.loads((DATA / "golden_beyond.json").read_text())["static"]
DOUBLE = SLAB.rail.bending_stiffness / (0.75 / 3) ** 3 * 27 / 4
"""Support stiffness at which both shapes of the rail are one at a spacing of 0.75 m [N/m]."""


def golden_design(values):
    two_stage = values["kb"] is not None
    return tig.TrackDesign(
        pad_stiffness=values["kp"],
        pad_loss_factor=0.2,
        block_mass=values["mb"],
        boot_stiffness=values["kb"],
        boot_loss_factor=0.2 if two_stage else None,
        fastener_spacing=values["L"],
        wheel_mass=900.0,
    )


@pytest.mark.parametrize("case", CASES, ids=[case["name"] for case in CASES])
def test_golden_results_are_met(case):
    design = golden_design(case["design"])
    dx = design.fastener_spacing / 3
    first, *second = case["axle_elements"]
    wheelbase = (second[0] - first) * dx if second else None
    found = static_response(design, case["wheel_load_N"], wheelbase, wheel_element=first)
    support = np.argmin(np.abs(found.position + first * dx))
    expected = np.array(case["rail_deflection_mm_at_elements_0_to_12"])
    # the golden figures have six decimals
    np.testing.assert_allclose(
        1e3 * found.deflection[support : support + 13], expected, atol=max(6e-7, 1e-5 * expected.max())
    )
    assert 1e3 * found.rail_deflection == pytest.approx(expected[first], rel=1e-4)
    assert 1e3 * found.largest_uplift == pytest.approx(case["largest_uplift_mm"], abs=6e-7)
    assert found.largest_seat_load == pytest.approx(case["largest_seat_load_N"], rel=1e-6)
    assert 1e3 * found.pad_compression == pytest.approx(case["pad_compression_mm"], rel=1e-4)


def dense_deflection(design, loads, bays):
    """Return the rail of a long row of supports under loads by element, by a banded solve [m]."""
    count = 3 * bays
    dx = design.fastener_spacing / 3
    bending = design.rail.bending_stiffness / dx**3
    bands = np.zeros((3, count))
    bands[0], bands[1], bands[2] = bending, -4 * bending, 6 * bending
    compliance = 1 / design.pad_stiffness
    compliance += 1 / design.boot_stiffness if design.two_stage else 0.0
    bands[2, ::3] += 1 / compliance
    force = np.zeros(count)
    for element, load in loads:
        force[element] += load
    return solveh_banded(bands, force)


@pytest.mark.parametrize("wheel_element", [0, 1, 2])
@pytest.mark.parametrize("wheelbase", [None, 0.3, 2.5])
@pytest.mark.parametrize(
    "design",
    [
        BLOCK,
        SLAB.replace(pad_stiffness=3e7, fastener_spacing=0.9, rail="49E1"),
        SLAB.replace(pad_stiffness=4e9, fastener_spacing=1.2),
        SLAB.replace(pad_stiffness=DOUBLE, fastener_spacing=0.75),
    ],
    ids=["block", "soft", "stiff and wide", "both shapes alike"],
)
def test_a_dense_solution_agrees(design, wheelbase, wheel_element):
    found = static_response(design, 100e3, wheelbase, wheel_element=wheel_element)
    dx = design.fastener_spacing / 3
    middle, around = 3 * 200, 30
    wheels = [middle + wheel_element]
    if wheelbase is not None:
        assert found.wheelbase == pytest.approx(max(1, round(wheelbase / dx)) * dx)
        wheels.append(wheels[0] + round(found.wheelbase / dx))
    expected = dense_deflection(design, [(wheel, 100e3) for wheel in wheels], 400)
    place = np.argmin(np.abs(found.position))
    near = slice(place - around, place + around)
    dense = expected[wheels[0] - around : wheels[0] + around]
    np.testing.assert_allclose(found.deflection[near], dense, atol=3e-7 * dense.max())
    assert found.largest_uplift == pytest.approx(-expected.min(), rel=1e-5)
    moments = -design.rail.bending_stiffness * np.diff(expected, 2) / dx**2
    assert found.largest_bending_moment == pytest.approx(moments.max(), rel=1e-5)


@pytest.mark.parametrize("wheelbase", [None, 2.5])
def test_the_supports_carry_the_wheels(preset, wheelbase):
    found = static_response(tig.PRESETS[preset], 85e3, wheelbase, wheel_element=1)
    wheels = [0.0] if wheelbase is None else [0.0, found.wheelbase]
    assert found.seat_load.sum() == pytest.approx(85e3 * len(wheels), rel=1e-8)
    assert found.seat_load @ found.support_position == pytest.approx(85e3 * sum(wheels), abs=0.1)
    assert found.seat_load_share == found.seat_load.max() / 85e3


def test_zimmermann_agrees(preset):
    design = tig.PRESETS[preset]
    assert static_response(design).rail_deflection == pytest.approx(zimmermann_deflection(design), rel=0.015)


def test_close_supports_tend_to_zimmermanns_foundation():
    close = SLAB.replace(fastener_spacing=0.1, pad_stiffness=1e6)
    assert static_response(close).rail_deflection == pytest.approx(zimmermann_deflection(close), rel=2e-4)


def test_the_worst_place_is_the_worst_of_the_places(preset):
    design = tig.PRESETS[preset]
    found = [static_response(design, wheelbase=2.5, wheel_element=element) for element in range(3)]
    worst = max(each.deflection.max() for each in found)
    for each in found:
        assert each.largest_rail_deflection == pytest.approx(worst, rel=1e-9)
    assert static_response(design).largest_rail_deflection > static_response(design).rail_deflection


def test_compressions_add_up_to_the_deflection_over_a_support():
    found = static_response(BLOCK)
    assert found.pad_compression + found.boot_compression == pytest.approx(found.rail_deflection)


def test_only_a_stated_static_stiffness_is_exact():
    assert static_response(BLOCK).unstated == ("pad", "boot")
    half = BLOCK.replace(boot_static_stiffness=20e6)
    assert static_response(half).unstated == ("pad",)
    assert static_response(half).at_least
    whole = half.replace(pad_static_stiffness=60e6)
    found = static_response(whole)
    assert not found.at_least
    assert (found.pad_stiffness, found.boot_stiffness) == (60e6, 20e6)
    dynamic = BLOCK.replace(pad_stiffness=60e6, boot_stiffness=20e6)
    assert found.rail_deflection == static_response(dynamic).rail_deflection
    assert found.rail_deflection > 1.2 * static_response(BLOCK).rail_deflection


def test_a_measured_stiffness_stands_in_at_50_hz():
    curve = tig.StiffnessCurve(((1, 310.4e6, 0.151), (10, 605.7e6, 0.151), (30, 671.0e6, 0.151)))
    measured = static_response(SLAB.replace(pad_stiffness=curve, pad_loss_factor=None))
    assert (measured.pad_stiffness, measured.at_least) == (671.0e6, True)


def test_statics_leave_insertion_gain_alone():
    stated = BLOCK.replace(pad_static_stiffness=60e6, boot_static_stiffness=20e6)
    expected = tig.solve(BLOCK, "exact").insertion_gain
    np.testing.assert_array_equal(tig.solve(stated, "exact").insertion_gain, expected)


def test_many_designs_sink_as_one_does():
    boots, pads = np.array([14e6, 28e6, 50e6]), np.array([[50e6], [100e6]])
    many = tig.solve_many(BLOCK, boot_stiffness=boots, pad_stiffness=pads, wheel_load=100e3)
    assert many.rail_deflection.shape == (2, 3)
    expected = [
        [static_response(many.design((i, j)), 100e3).rail_deflection for j in range(3)] for i in range(2)
    ]
    np.testing.assert_allclose(many.rail_deflection, expected, rtol=1e-9)
    assert many.deflection_at_least.all()


def test_many_designs_of_every_kind_sink_as_one_does():
    curve = tig.StiffnessCurve(((5, 20e6, 0.1), (500, 40e6, 0.3)))
    designs = [
        BLOCK,
        SLAB,
        SLAB.replace(pad_static_stiffness=500e6),
        BLOCK.replace(pad_static_stiffness=60e6, boot_static_stiffness=20e6),
        BLOCK.replace(boot_stiffness=curve, boot_loss_factor=None, rail="54E1"),
        SLAB.replace(pad_stiffness=DOUBLE, fastener_spacing=0.75),
    ]
    many = tig.solve_many(designs)
    expected = [static_response(design) for design in designs]
    np.testing.assert_allclose(many.rail_deflection, [each.rail_deflection for each in expected], rtol=1e-6)
    assert many.deflection_at_least.tolist() == [each.at_least for each in expected]


def test_a_varied_static_stiffness_moves_statics_alone():
    many = tig.solve_many(BLOCK, boot_static_stiffness=np.array([10e6, 20e6]), pad_static_stiffness=50e6)
    assert many.rail_deflection[0] > many.rail_deflection[1]
    np.testing.assert_array_equal(many.insertion_gain[0], many.insertion_gain[1])
    assert not many.deflection_at_least.any()


def test_a_static_stiffness_leaves_with_its_boot():
    stated = BLOCK.replace(boot_static_stiffness=20e6)
    single = {"block_mass": None, "boot_stiffness": None, "boot_loss_factor": None}
    assert stated.replace(**single).boot_static_stiffness is None
    many = tig.solve_many(stated, **{name: [None, getattr(BLOCK, name)] for name in single})
    assert [many.design(row).boot_static_stiffness for row in range(2)] == [None, 20e6]
    with pytest.raises(tig.DesignError, match="there is no boot"):
        SLAB.replace(boot_static_stiffness=20e6)


@pytest.mark.parametrize("load", [0.0, -1.0, float("nan"), "85 kN", True, 85e6])
def test_wrong_loads_are_refused(load):
    with pytest.raises(tig.DesignError, match=r"wheel_load = .*: give a number from 1000 to 1e\+06 N"):
        static_response(BLOCK, load)
    with pytest.raises(tig.DesignError, match="wheel_load"):
        tig.solve_many(BLOCK, wheel_load=load)


@pytest.mark.parametrize("wheelbase", [0.0, -2.5, 0.05, 101.0, float("nan"), "2.5", True])
def test_wrong_wheelbases_are_refused(wheelbase):
    with pytest.raises(ValueError, match=r"wheelbase = .*0\.2 m, to 100 m"):
        static_response(BLOCK, wheelbase=wheelbase)


@pytest.mark.parametrize("element", [-1, 3, 0.5, None])
def test_the_first_wheel_stands_in_the_first_bay(element):
    with pytest.raises(ValueError, match="wheel_element"):
        static_response(BLOCK, wheel_element=element)


def test_a_specification_asks_for_the_deflection_that_it_limits():
    limited = tig.Specification([(63, 0.0)], rail_deflection_limit=2.5e-3, wheel_load=100e3)
    assert limited_deflection(limited, BLOCK) == static_response(BLOCK, 100e3).rail_deflection
    assert limited_deflection(tig.Specification([(63, 0.0)]), BLOCK) is None
    assert limited_deflection(None, BLOCK) is None
