"""The model of a track: derived once, passed on, and remembered."""

import pytest

import trackig_core as tig
from trackig_core.frequency_domain.natural_frequencies import cut_on, loaded_track, natural_frequencies
from trackig_core.frequency_domain.refinement import banded_gain
from trackig_core.frequency_domain.track_model import DAMPINGS, once_per_model, track_model

BLOCK, SLAB = tig.PRESETS["booted-block-low-mass"], tig.PRESETS["slab-track"]

ANALYSES = {
    "receptance": lambda design: tig.receptance(design, [20.0, 200.0]),
    "time_step_errors": lambda design: tig.time_step_errors(design, [1e-5, 2e-5], 1),
    "element_errors": lambda design: tig.element_errors(design, [2, 4]),
    "compare_with_beam": tig.compare_with_beam,
    "departure": tig.departure,
    "measured_slopes": tig.measured_slopes,
    "damping_curves": lambda design: tig.damping_curves(design, [50.0]),
    "steady_shape": lambda design: tig.steady_shape(design, [50.0]),
    "film": tig.film,
}


@pytest.fixture
def derived(monkeypatch):
    """Designs whose laws were derived."""
    designs = []

    def counted(design, laws=DAMPINGS["viscoelastic"]):
        designs.append(design)
        return laws(design)

    monkeypatch.setitem(DAMPINGS, "viscoelastic", counted)
    return designs


@pytest.mark.parametrize("fidelity", ["paper", "live", "exact"])
@pytest.mark.parametrize("design", [BLOCK, SLAB], ids=["two-stage", "single-stage"])
def test_the_laws_of_a_design_are_derived_once_per_solve(derived, design, fidelity):
    tig.solve(design, fidelity)
    assert derived == [design]


@pytest.mark.parametrize("analysis", ANALYSES.values(), ids=ANALYSES.keys())
def test_the_laws_of_a_design_are_derived_once_per_analysis(derived, analysis):
    analysis(BLOCK)
    assert derived == [BLOCK]


def test_verifying_derives_the_laws_of_its_own_accord_and_once(derived):
    solution = tig.solve(BLOCK, "live")
    derived.clear()
    tig.verify(solution)
    assert derived == [BLOCK]


def test_a_model_serves_as_its_design_does():
    model = track_model(BLOCK)
    assert track_model(model) is model
    assert natural_frequencies(model) == natural_frequencies(BLOCK)
    assert (banded_gain(model).levels == tig.solve(BLOCK, "exact").insertion_gain).all()
    assert (tig.solve(model, "exact").insertion_gain == tig.solve(BLOCK, "exact").insertion_gain).all()


def test_what_is_computed_of_a_model_is_remembered_with_it():
    calls = []
    counted = once_per_model(lambda model: calls.append(model))
    model = track_model(BLOCK)
    assert counted(model) is counted(model) is None
    assert calls == [model]
    counted(BLOCK)
    assert len(calls) == 2


def test_the_blocks_held_still_leave_the_pads_on_rigid_ground():
    model = track_model(BLOCK).rigid_blocks
    changed = BLOCK.replace(block_mass=None, boot_stiffness=None, boot_loss_factor=None)
    assert model.design == changed
    assert loaded_track(model) == loaded_track(changed)
    assert cut_on(model) == cut_on(changed)
    assert model.rigid_blocks is model


def test_what_is_no_track_is_refused():
    with pytest.raises(tig.DesignError, match="TrackDesign"):
        loaded_track("slab-track")
