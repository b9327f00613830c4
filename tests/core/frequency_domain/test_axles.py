"""Vehicle, axles and ground: golden results, a dense solution, and the references that have a meaning."""

import json

import numpy as np
import pytest

import trackig_core as tig
from tests.core.conftest import DATA
from tests.core.frequency_domain.plain_track import dense_energy
from trackig_core.frequency_domain.axles import wheel_elements
from trackig_core.frequency_domain.floquet_waves import exact_spectrum
from trackig_core.frequency_domain.lattice import Lattice
from trackig_core.frequency_domain.refinement import banded_gain, banded_spectrum, very_stiff
from trackig_core.levels.insertion_gain import rigid_band_energy
from trackig_core.track.viscoelastic_law import laws

BLOCK, SLAB = tig.PRESETS["booted-block-low-mass"], tig.PRESETS["slab-track"]
BOGIE = tig.Suspension(1.2e6, 15e3, 800.0, 250e3, 15e3, 4000.0)
PRIMARY = tig.Suspension(1.2e6, 15e3, 800.0)
CLAY = tig.Ground(300e6, 200e3, 150.0)

GOLDEN = json.loads((DATA / "golden_beyond.json").read_text())["cases"]


def golden_design(case):
    """Return the design of a golden case."""
    values, above, ground = case["design"], case["suspension"], case["ground"]
    return tig.TrackDesign(
        pad_stiffness=values["kp"],
        pad_loss_factor=values["ep"],
        block_mass=values["mb"],
        boot_stiffness=values["kb"],
        boot_loss_factor=values["eb"],
        fastener_spacing=values["L"],
        wheel_mass=values["mw"],
        rail=tig.Rail("golden", case["mr"], case["EI"]),
        contact_stiffness=case["kH"],
        suspension=above and tig.Suspension(*(above[each] for each in ("k1", "c1", "m1", "k2", "c2", "m2"))),
        axle_positions=[element * values["L"] / 3 for element in case["axle_elements"]],
        speed=case["speed_m_per_s"],
        ground=ground and tig.Ground(ground["k"], ground["c"], ground["m"]),
    )


@pytest.mark.parametrize("case", GOLDEN, ids=lambda case: case["name"])
def test_golden_insertion_gain(case):
    design = golden_design(case)
    references = [name for name in ("line", "rigid", "stiff") if f"ig_{name}_reference_db" in case]
    assert references
    many = tig.solve_many([design])
    for reference in references:
        expected = case[f"ig_{reference}_reference_db"]
        solution = tig.solve(design, "exact", reference=reference)
        assert np.abs(solution.insertion_gain - expected).max() < 0.02
        assert np.abs(many.gain_for(reference)[0] - expected).max() < 0.02
        assert solution.natural_frequencies.loaded_track == pytest.approx(case["loaded_track_hz"], abs=1e-3)


SURROUNDED = {
    "suspension": BLOCK.replace(suspension=BOGIE),
    "primary suspension": SLAB.replace(suspension=PRIMARY),
    "between supports": BLOCK.replace(axle_positions=(0.2,)),
    "bogie": BLOCK.replace(axle_positions=(0.0, 2.4), speed=30.0),
    "independent wheels": SLAB.replace(axle_positions=(-0.25, 0.5, 1.0)),
    "in one bay": BLOCK.replace(axle_positions=(0.2, 0.4), speed=3.0),
    "ground": BLOCK.replace(ground=CLAY),
    "ground without mass": SLAB.replace(ground=tig.GROUNDS["soft clay"]),
    "everything": BLOCK.replace(
        suspension=BOGIE, axle_positions=(-0.8, 0.2, 1.6), speed=20.0, ground=CLAY, rail="49E1"
    ),
}


@pytest.mark.parametrize("design", SURROUNDED.values(), ids=SURROUNDED)
@pytest.mark.parametrize(("bays", "per_bay"), [(31, 3), (23, 6)])
def test_closed_form_is_the_dense_solution_on_the_ring(design, bays, per_bay):
    frequency = np.array([3.0, 8.0, 31.5, 50.0, 120.0, 333.0, 500.0])
    found = exact_spectrum(design, frequency, 1.0, Lattice(per_bay, bays))
    energy, coherent = dense_energy(design, *laws(design), frequency, bays, per_bay)
    assert found.energy == pytest.approx(energy, rel=1e-9)
    assert found.coherent_energy == pytest.approx(coherent, rel=1e-9)


@pytest.mark.parametrize("design", SURROUNDED.values(), ids=SURROUNDED)
def test_a_long_ring_is_the_infinite_track(design):
    frequency = np.geomspace(3, 500, 60)
    infinite = exact_spectrum(design, frequency, 1.0)
    ring = exact_spectrum(design, frequency, 1.0, Lattice(bays=667))
    assert ring.energy == pytest.approx(infinite.energy, rel=1e-6)
    assert ring.coherent_energy == pytest.approx(infinite.coherent_energy, rel=1e-6)


def test_wheels_of_one_axle_may_be_given_as_any_support():
    """One wheel over a support, by the route of several axles and by that of one."""
    frequency = np.geomspace(3, 500, 40)
    one = exact_spectrum(BLOCK.replace(suspension=BOGIE), frequency, 1.0)
    moved = exact_spectrum(BLOCK.replace(suspension=BOGIE, axle_positions=(1.2,)), frequency, 1.0)
    assert moved.energy == pytest.approx(one.energy, rel=1e-10)
    assert moved.coherent_energy == pytest.approx(one.coherent_energy, rel=1e-10)


def test_axles_far_apart_are_as_many_single_ones():
    """Independent wheels 30 m apart do not feel each other: twice the energy, the same gain."""
    one = banded_gain(BLOCK, reference="rigid").levels
    two = banded_gain(BLOCK.replace(axle_positions=(0.0, 30.0)), reference="rigid").levels
    assert np.abs(two - one).max() < 0.02


def test_positions_are_rounded_to_elements_and_the_solution_says_so():
    solution = tig.solve(BLOCK.replace(axle_positions=(0.0, 2.47)), "exact")
    assert solution.notes == ("axles stand on the nearest rail elements, 0.2 m apart: at 0, 2.4 m",)
    assert wheel_elements(solution.design, 3) == (0, 12)
    assert wheel_elements(solution.design, 12) == (0, 48)
    assert tig.solve(BLOCK.replace(axle_positions=(0.0, 2.4)), "exact").notes == ()


def test_a_ring_shorter_than_the_axles_is_refused():
    with pytest.raises(ValueError, match=r"bays = 17: give \d+ or more"):
        exact_spectrum(BLOCK.replace(axle_positions=(0.0, 12.0)), [50.0], 1.0, Lattice(bays=17))


def test_fringes_of_wheels_that_follow_each_other_are_resolved():
    """Against the same gain from eighty times as many frequencies, 4 s and 0.1 s apart."""
    for speed in (0.6 * 5 / 4, 30.0):
        design = BLOCK.replace(axle_positions=(0.0, 3.0), speed=max(speed, 1.0))
        levels = banded_gain(design, reference="rigid").levels
        dense = exact_spectrum(design, np.linspace(4.0, 570, 60_001), 1e-4)
        loaded = tig.solve(BLOCK, "exact").natural_frequencies.loaded_track
        assert np.abs(levels - tig.insertion_gain(dense, design, loaded, "rigid").levels).max() < 0.005
        assert banded_spectrum(design).frequency.size < 20_000


@pytest.mark.parametrize("design", [BLOCK, SLAB.replace(suspension=BOGIE, axle_positions=(0.1, 0.6))])
def test_the_stiff_reference_on_rigid_ground_is_the_rigid_track(design):
    stiff, rigid = (banded_gain(design, reference=name).levels for name in ("stiff", "rigid"))
    assert np.abs(stiff - rigid).max() < 0.01
    assert very_stiff(design).axle_positions == (0.0,)


def test_the_stiff_reference_is_finite_where_waves_run_between_supports():
    """The pinned-pinned frequency of supports a metre apart lies in the 400 Hz band."""
    wide = BLOCK.replace(fastener_spacing=1.0)
    difference = banded_gain(wide, reference="stiff").levels - banded_gain(wide, reference="rigid").levels
    assert np.abs(difference).max() < 0.01


def test_rigid_ground_is_the_limit_of_very_stiff_ground():
    hard = BLOCK.replace(ground=tig.Ground(1e13, 1e3, 0.0))
    frequency = np.geomspace(5, 500, 50)
    rigid = exact_spectrum(BLOCK, frequency, 1.0)
    assert exact_spectrum(hard, frequency, 1.0).energy == pytest.approx(rigid.energy, rel=1e-4)
    assert np.abs(banded_gain(hard).levels - banded_gain(BLOCK, reference="rigid").levels).max() < 0.02


def test_a_hardly_sprung_bogie_is_no_bogie():
    soft = BLOCK.replace(suspension=tig.Suspension(1e3, 0.0, 1e5))
    for reference in ("line", "rigid"):
        levels = banded_gain(soft, reference=reference).levels
        assert np.abs(levels - banded_gain(BLOCK, reference=reference).levels).max() < 0.01


def test_rigid_band_energy_of_an_unsprung_wheel_is_the_same_by_either_route():
    two = rigid_band_energy(BLOCK.replace(axle_positions=(0.0, 2.4)), 1e-4)
    assert two == pytest.approx(2 * rigid_band_energy(BLOCK, 1e-4), rel=1e-9)


def test_on_ground_that_yields_only_the_stiff_reference_has_a_meaning():
    design = BLOCK.replace(ground=CLAY)
    for reference in ("line", "rigid"):
        with pytest.raises(ValueError, match=r"give 'stiff', .* ground that yields"):
            tig.solve(design, "exact", reference=reference)
    solution = tig.solve(design, "exact")
    assert solution.gain.reference == "stiff"
    with pytest.raises(ValueError, match="give 'stiff'"):
        solution.gain_for("line")
    with pytest.raises(ValueError, match="give stiff, or use solve"):
        tig.insertion_gain(solution.spectrum, BLOCK, 39.0, "stiff")


@pytest.mark.parametrize(
    ("design", "field"),
    [
        (BLOCK.replace(ground=tig.Ground(300e6, 0.0, 150.0)), "ground.damping"),
        (BLOCK.replace(ground=tig.Ground(300e6, 0.0, 0.0), boot_loss_factor=0.0), "boot_loss_factor"),
    ],
)
def test_ground_without_loss_has_no_exact_spectrum(design, field):
    with pytest.raises(tig.DesignError, match=field):
        tig.solve(design, "exact")


def test_lossy_ground_makes_up_for_boots_without_loss():
    design = BLOCK.replace(ground=CLAY, pad_loss_factor=0.0, boot_loss_factor=0.0)
    assert np.isfinite(tig.solve(design, "exact").insertion_gain).all()


@pytest.mark.parametrize(
    "design", [BLOCK, SURROUNDED["bogie"], SURROUNDED["ground"]], ids=["one", "two", "ground"]
)
def test_a_rail_that_shears_is_solved_under_any_wheels(design):
    """It yields more between the supports: insertion gain moves, and by less than 3 dB."""
    shearing = tig.solve(design, "exact", rail="timoshenko").insertion_gain
    moved = np.abs(shearing - tig.solve(design, "exact").insertion_gain).max()
    assert 0.05 < moved < 3.0
