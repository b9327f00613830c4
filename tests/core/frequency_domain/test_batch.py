"""Many designs at once against one exact solve after the other, and against the Python route's own parts."""

import numpy as np
import pytest

import trackig_core as tig
from tests.core.frequency_domain.many_digits import force_energy
from tests.core.frequency_domain.plain_natural_frequencies import plain_natural_frequencies
from trackig_core.bands import BAND_EDGES
from trackig_core.frequency_domain import batch_kernels as kernels
from trackig_core.frequency_domain.batch import CHUNK, solve_many
from trackig_core.frequency_domain.floquet_waves import exact_spectrum
from trackig_core.frequency_domain.natural_frequencies import loaded_track, natural_frequencies
from trackig_core.frequency_domain.refinement import (
    band_frequencies,
    banded_spectrum,
    refined_spectrum,
    resolved_spectrum,
)
from trackig_core.frequency_domain.track_model import track_model
from trackig_core.levels.insertion_gain import REFERENCES, SUMMATIONS, integrate_bands
from trackig_core.track.design import DEFAULT_STEP

BLOCK, SLAB = tig.PRESETS["booted-block-low-mass"], tig.PRESETS["slab-track"]

CURVE = tig.StiffnessCurve(((5.0, 20e6, 0.1), (50.0, 25e6, 0.15), (500.0, 40e6, 0.3)))
LOSS = tig.LossFactorCurve(((5.0, 0.1), (500.0, 0.3)))

SLIDERS = {
    "pad_stiffness": (10e6, 2000e6),
    "pad_loss_factor": (0.01, 0.5),
    "block_mass": (10, 500),
    "boot_stiffness": (2e6, 200e6),
    "boot_loss_factor": (0.01, 0.5),
    "wheel_mass": (200, 1500),
    "contact_stiffness": (200e6, 5000e6),
}
"""Ranges of the sliders, each over the logarithm [SI units]; spacing runs from 0.2 to 1.0 m."""


def random_designs(count, single_stage=0.3, seed=1):
    """Return designs from all over the ranges of the sliders."""
    random = np.random.default_rng(seed)
    rails = list(tig.RAILS.values())
    designs = []
    for _ in range(count):
        values = {name: float(np.exp(random.uniform(*np.log(ends)))) for name, ends in SLIDERS.items()}
        values |= {"fastener_spacing": random.uniform(0.2, 1.0), "rail": rails[random.integers(len(rails))]}
        if random.random() < single_stage:
            values |= {"block_mass": None, "boot_stiffness": None, "boot_loss_factor": None}
        designs.append(tig.TrackDesign(**values))
    return designs


@pytest.fixture(scope="module")
def one_by_one():
    designs = random_designs(2000)
    return designs, [tig.solve(design, "exact") for design in designs]


def levels_of(solutions, reference, summation):
    return np.array([each.gain_for(reference, summation).levels for each in solutions])


def test_a_batch_is_within_a_hundredth_of_a_decibel_of_exact_solves(one_by_one):
    designs, solutions = one_by_one
    many = solve_many(designs)
    assert many.insertion_gain.shape == (2000, 21)
    assert np.abs(many.insertion_gain - [each.insertion_gain for each in solutions]).max() < 0.01
    assert many.resolved.all()
    every_tenth = solve_many(designs[::10])
    assert many.gain_for("line", "energy") == pytest.approx(many.insertion_gain)
    for reference in REFERENCES:
        for summation in SUMMATIONS:
            expected = levels_of(solutions[::10], reference, summation)
            assert np.abs(every_tenth.gain_for(reference, summation) - expected).max() < 0.01


def test_natural_frequencies_are_those_of_exact_solves(one_by_one):
    designs, solutions = one_by_one
    many = solve_many(designs)
    found = [each.natural_frequencies for each in solutions]
    assert many.loaded_track == pytest.approx(np.array([each.loaded_track for each in found]), rel=1e-9)
    block = np.array([each.coupled_block or np.nan for each in found])
    assert many.coupled_block == pytest.approx(block, rel=1e-9, nan_ok=True)


def test_far_apart_supports_are_refined_at_the_pinned_pinned_frequency():
    spacing = np.linspace(0.9, 1.0, 41)
    many = solve_many(BLOCK, fastener_spacing=spacing, pad_loss_factor=0.01, boot_loss_factor=0.01)
    light = BLOCK.replace(pad_loss_factor=0.01, boot_loss_factor=0.01)
    expected = [tig.solve(light.replace(fastener_spacing=each), "exact").insertion_gain for each in spacing]
    assert np.abs(many.insertion_gain - expected).max() < 0.01


@pytest.mark.parametrize("design", random_designs(40, seed=2))
def test_one_compiled_call_gives_the_spectrum_and_the_axis_of_the_python_route(design):
    model = track_model(design)
    frequencies = plain_natural_frequencies(model)
    spectrum = banded_spectrum(model)
    expected = refined_spectrum(
        lambda between: exact_spectrum(model, between, DEFAULT_STEP), band_frequencies(loaded_track(model))
    )
    assert np.array_equal(spectrum.frequency, expected.frequency)
    # beside the pinned-pinned frequency the waves nearly cancel: rounding shows, in either route
    assert spectrum.energy == pytest.approx(expected.energy, rel=3e-5)
    assert spectrum.coherent_energy == pytest.approx(expected.coherent_energy, rel=3e-5)
    assert np.quantile(np.abs(spectrum.energy / expected.energy - 1), 0.8) < 1e-9
    assert spectrum.step == expected.step
    found = natural_frequencies(model)
    for name in ("loaded_track", "coupled_block", "wheel_on_rigid_blocks", "block_on_boot", "cut_on"):
        value, expected = getattr(found, name), getattr(frequencies, name)
        assert value is None if expected is None else value == pytest.approx(expected, rel=1e-9)


def test_the_kernel_is_the_closed_form_to_rounding(preset):
    design = tig.PRESETS[preset]
    frequency = np.geomspace(5, 500, 301)
    energy, coherent = np.empty(301), np.empty(301)
    kernels.force_energy(track_model(design).row, frequency, 301, energy, coherent)
    expected = exact_spectrum(design, frequency, 1.0)
    assert energy == pytest.approx(expected.energy, rel=1e-12)
    assert coherent == pytest.approx(expected.coherent_energy, rel=1e-12)


HARDLY_DAMPED = {
    "as published": (BLOCK, 1e-12),
    "single-stage": (SLAB, 1e-12),
    "boots of hardly any loss": (BLOCK.replace(pad_loss_factor=0.0, boot_loss_factor=1e-7), 1e-10),
    "blocks that hide the loss": (
        tig.TrackDesign(
            pad_stiffness=1.037e5,
            pad_loss_factor=0.0,
            block_mass=8043.0,
            boot_stiffness=4.42e5,
            boot_loss_factor=0.02,
            fastener_spacing=0.1548,
            wheel_mass=341.0,
            contact_stiffness=8.337e8,
            rail=tig.Rail("light", 10.53, 1.852e6),
        ),
        1e-9,
    ),
}


@pytest.mark.parametrize(("design", "tolerance"), HARDLY_DAMPED.values(), ids=HARDLY_DAMPED)
def test_the_kernel_agrees_with_arithmetic_of_sixty_digits(design, tolerance):
    frequency = np.geomspace(5, 500, 25)
    energy, coherent = np.empty(25), np.empty(25)
    row = track_model(design).row
    kernels.force_energy(row, frequency, 25, energy, coherent)
    expected = np.array([float(force_energy(row, each)) for each in frequency])
    assert energy == pytest.approx(expected, rel=tolerance)


def test_bands_are_integrated_like_those_of_one_spectrum():
    spectrum = banded_spectrum(BLOCK)
    count, found = spectrum.frequency.size, np.empty(21)
    first = int(np.searchsorted(spectrum.frequency, BAND_EDGES[0]))
    work = np.empty((2, count))
    kernels.band_integrals(spectrum.frequency, spectrum.energy, count, first, BAND_EDGES, *work, found)
    assert found == pytest.approx(integrate_bands(spectrum.frequency, spectrum.energy), rel=1e-6)


@pytest.mark.parametrize(
    "design", [BLOCK, SLAB, random_designs(1, 0.0, seed=3)[0]], ids=["block", "slab", "any"]
)
@pytest.mark.parametrize(
    "lattice",
    [
        tig.Lattice(time_step=1 / 20480, memory_order=2),
        tig.Lattice(bays=61, time_step=1 / 20480, memory_order=2),
        tig.Lattice(bays=20, time_step=1 / 20480, memory_order=2),
        tig.Lattice(bays=667, time_step=1 / 131072),
    ],
    ids=str,
)
def test_the_schemes_own_spectrum_is_the_plain_ones(design, lattice):
    start = band_frequencies(loaded_track(design))
    compiled = resolved_spectrum(design, start, 1.0, lattice)
    plain = refined_spectrum(lambda frequency: exact_spectrum(design, frequency, 1.0, lattice), start)
    assert compiled.frequency == pytest.approx(plain.frequency, rel=1e-12)
    assert compiled.energy == pytest.approx(plain.energy, rel=1e-8)
    assert compiled.coherent_energy == pytest.approx(plain.coherent_energy, rel=1e-8)


def test_fields_broadcast_as_numpy_does():
    boots, pads = np.array([10e6, 20e6, 40e6]), np.array([80e6, 160e6])
    many = solve_many(BLOCK, boot_stiffness=boots[:, None], pad_stiffness=pads)
    assert many.insertion_gain.shape == (3, 2, 21)
    assert many.loaded_track.shape == many.coupled_block.shape == many.resolved.shape == (3, 2)
    design = BLOCK.replace(boot_stiffness=40e6, pad_stiffness=80e6)
    assert many.design((2, 0)) == design
    assert many.insertion_gain[2, 0] == pytest.approx(tig.solve(design, "exact").insertion_gain, abs=0.01)
    with pytest.raises(ValueError, match="shape"):
        solve_many(BLOCK, boot_stiffness=np.ones(3) * 1e7, pad_stiffness=np.ones(2) * 1e8)
    assert solve_many(BLOCK).insertion_gain.shape == (1, 21)
    assert solve_many([]).insertion_gain.shape == (0, 21)


def test_rails_and_measured_curves_may_vary():
    rails = [tig.RAILS["49E1"], tig.RAILS["60E1"]]
    many = solve_many(BLOCK, rail=rails)
    assert [many.design(row).rail for row in range(2)] == rails
    measured = [
        BLOCK.replace(boot_stiffness=CURVE, boot_loss_factor=None),
        BLOCK.replace(pad_loss_factor=LOSS),
        SLAB,
        SLAB.replace(pad_stiffness=CURVE, pad_loss_factor=None),
    ]
    from_curves = solve_many(BLOCK, pad_loss_factor=np.array([LOSS, 0.2], dtype=object))
    from_base = solve_many(measured[0], pad_stiffness=[100e6, 150e6])
    for many, designs in (
        (solve_many(designs=measured), measured),
        (from_curves, [measured[1], BLOCK]),
        (from_base, [measured[0], measured[0].replace(pad_stiffness=150e6)]),
    ):
        expected = [tig.solve(design, "exact").insertion_gain for design in designs]
        assert np.abs(many.insertion_gain - expected).max() < 0.01


def test_threads_and_chunks_change_nothing():
    boots = np.geomspace(5e6, 50e6, 2 * CHUNK + 3)
    one, two = (solve_many(BLOCK, boot_stiffness=boots, threads=threads) for threads in (1, 2))
    assert np.array_equal(one.insertion_gain, two.insertion_gain)
    alone = solve_many(BLOCK, boot_stiffness=boots[-1])
    assert alone.insertion_gain == pytest.approx(one.insertion_gain[-1:], abs=1e-5)


@pytest.mark.parametrize(
    ("base", "arrays", "row", "field"),
    [
        (BLOCK, {"boot_stiffness": [28e6, -1.0]}, 1, "boot_stiffness"),
        (BLOCK, {"wheel_mass": [500.0, 600.0, np.nan]}, 2, "wheel_mass"),
        (BLOCK, {"boot_loss_factor": [0.1, 0.0]}, 1, "boot_loss_factor"),
        (SLAB, {"pad_loss_factor": [[0.1, 0.2], [0.0, 0.1]]}, (1, 0), "pad_loss_factor"),
        (SLAB, {"boot_stiffness": [28e6, 30e6]}, 0, "block_mass"),
        (BLOCK, {"rail": [tig.RAILS["60"], "60E1"]}, 1, "rail"),
        (BLOCK, {"pad_stiffness": ["soft", "hard"]}, 0, "pad_stiffness"),
        (BLOCK, {"pad_stiffness": [1e8, None]}, 1, "pad_stiffness"),
        (BLOCK, {"boot_stifness": [28e6, 30e6]}, 0, "boot_stifness"),
        ([BLOCK, "slab"], {}, 1, "design"),
    ],
)
def test_a_value_that_is_not_allowed_is_named_by_row_and_field(base, arrays, row, field):
    with pytest.raises(tig.DesignError, match=f"row .*{field}") as caught:
        solve_many(base, **arrays)
    assert (caught.value.row, caught.value.field) == (row, field)


def test_a_row_far_into_a_batch_is_named():
    losses = np.full(3 * CHUNK, 0.2)
    losses[2 * CHUNK + 5] = 0.0
    with pytest.raises(tig.DesignError, match=f"row {2 * CHUNK + 5}: boot_loss_factor"):
        solve_many(BLOCK, boot_loss_factor=losses)


def test_progress_is_reported_and_a_batch_can_be_cancelled():
    boots, seen = np.geomspace(5e6, 50e6, 6 * CHUNK), []
    solve_many(BLOCK, boot_stiffness=boots, progress=seen.append)
    assert seen == pytest.approx(np.arange(1, 7) / 6)
    with pytest.raises(tig.SolveCancelled):
        solve_many(BLOCK, boot_stiffness=boots, cancelled=lambda: True)


def test_choices_are_checked():
    with pytest.raises(ValueError, match="reference"):
        solve_many(BLOCK, reference="soft")
    with pytest.raises(ValueError, match="summation"):
        solve_many(BLOCK).gain_for(summation="loud")
    with pytest.raises(ValueError, match="base"):
        solve_many([BLOCK], pad_stiffness=[1e8])


def test_many_designs_are_shown_on_one_line():
    many = solve_many([BLOCK, SLAB], reference="rigid", summation="coherent")
    low, high = sorted(many.loaded_track)
    assert repr(many) == (
        f"<BatchSolution: 2 designs, loaded track {low:.1f} to {high:.1f} Hz, "
        "reference rigid, summation coherent>"
    )
    assert repr(solve_many(BLOCK)).startswith("<BatchSolution: 1 design, ")
    assert repr(solve_many(BLOCK, pad_stiffness=np.array([]))).startswith("<BatchSolution: 0 designs, ref")


def test_a_data_frame_has_a_row_per_design():
    pandas = pytest.importorskip("pandas")
    frame = solve_many([BLOCK, SLAB]).to_dataframe()
    assert isinstance(frame, pandas.DataFrame)
    assert frame.shape == (2, 12 + 3 + 21)
    assert frame["rail"].tolist() == ["60", "60"]
    assert frame["coupled_block"].isna().tolist() == [False, True]
    assert frame["31.5"][1] == pytest.approx(tig.solve(SLAB, "exact").insertion_gain[8], abs=0.01)


SURROUNDED = [
    BLOCK.replace(suspension=tig.VEHICLES["metro"].suspension),
    BLOCK,
    BLOCK.replace(axle_positions=(0.0, 2.4), speed=30.0),
    SLAB.replace(axle_positions=(0.0, 2.1), suspension=tig.VEHICLES["freight"].suspension),
    SLAB,
]


def test_vehicles_and_axles_are_solved_as_one_exact_solve_after_the_other():
    many = solve_many(SURROUNDED)
    solutions = [tig.solve(design, "exact") for design in SURROUNDED]
    for reference in REFERENCES:
        for summation in SUMMATIONS:
            expected = levels_of(solutions, reference, summation)
            assert np.abs(many.gain_for(reference, summation) - expected).max() < 0.01
    found = [each.natural_frequencies.loaded_track for each in solutions]
    assert many.loaded_track == pytest.approx(np.array(found), rel=1e-9)
    assert "suspension.bogie_mass" in many.to_dataframe()
    assert "suspension.bogie_mass" not in solve_many(BLOCK).to_dataframe()


def test_grounds_broadcast_and_have_the_stiff_reference():
    boots = np.array([[20e6], [30e6]])
    many = solve_many(
        BLOCK, ground=[tig.GROUNDS["rock"], None, tig.GROUNDS["soft clay"]], boot_stiffness=boots
    )
    assert many.reference == "stiff"
    assert many.insertion_gain.shape == (2, 3, 21)
    for row in ((0, 0), (1, 1), (1, 2)):
        expected = tig.solve(many.design(row), "exact", reference="stiff").insertion_gain
        assert np.abs(many.insertion_gain[row] - expected).max() < 0.01
    with pytest.raises(ValueError, match="give 'stiff', for row 0 stands on ground"):
        many.gain_for("rigid")
    with pytest.raises(ValueError, match="give 'stiff'"):
        solve_many(BLOCK, ground=[tig.GROUNDS["rock"]], reference="line")


def test_errors_of_vehicles_name_the_row():
    with pytest.raises(tig.DesignError, match=r"row 1: speed = 2.0: give 5 m/s or more"):
        solve_many(BLOCK, axle_positions=[(0.0,), (0.0, 20.0)], speed=[30.0, 2.0])
    with pytest.raises(tig.DesignError, match=r"row 2: ground\.damping"):
        solve_many([BLOCK, BLOCK, BLOCK.replace(ground=tig.Ground(3e8, 0.0, 100.0))])
    with pytest.raises(tig.DesignError, match="row 1: boot_loss_factor"):
        solve_many([SURROUNDED[0], BLOCK.replace(boot_loss_factor=0.0)])
