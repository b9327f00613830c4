"""The solution on other assumptions: computed while somebody looks, drawn by choice, its cost in words."""

import numpy as np
import pytest

import trackig_core as tig
from dashboard.compute.idealisations import idealised
from dashboard.session.bands import CHOICES as BAND_CHOICES
from dashboard.views.idealisations import CHOICES, IdealisationsView, cost_words
from tests.waiting import on_a_loop
from trackig_core.bands import BANDS

BLOCK = tig.PRESETS["booted-block-low-mass"]


@pytest.fixture
def view(session):
    session.show("booted-block-low-mass")
    return IdealisationsView(session.outcome, session.definition)


def test_nothing_is_computed_while_nobody_looks(view):
    assert view.idealisations.found is None


def test_levels_are_those_of_the_core(view):
    on_a_loop(view.look, True)
    data = view.figure.levels.data
    np.testing.assert_allclose(data["usual"], tig.solve(BLOCK, "exact").insertion_gain)
    for name, choice in (("hysteretic", {"damping": "hysteretic"}), ("timoshenko", {"rail": "timoshenko"})):
        np.testing.assert_allclose(data[name], tig.solve(BLOCK, "exact", **choice).insertion_gain)
    assert not any(line.visible for line in view.figure.lines.values())
    view.chosen.value = list(CHOICES.values())
    assert all(line.visible for line in view.figure.lines.values())
    assert len(view.figure.legend.listed) == 4


def test_on_ground_that_yields_levels_are_against_the_stiff_track(view, session, fake_picture):
    design = BLOCK.replace(ground=tig.GROUNDS["soft clay"])
    session.outcome.summary = fake_picture(design)
    on_a_loop(view.look, True)
    np.testing.assert_allclose(
        view.figure.levels.data["usual"], tig.solve(design, "exact", reference="stiff").insertion_gain
    )


def test_other_bands_are_shown_by_choice(view):
    on_a_loop(view.look, True)
    on_a_loop(view.bands.param.update, value="wide octave")
    assert list(view.figure.levels.data["label"]) == list(BANDS["wide octave"].labels)
    assert "read the outer bands with care" in view.words.object


def test_every_choice_of_bands_is_offered():
    assert set(BAND_CHOICES.values()) == set(BANDS)


def test_the_cost_is_that_of_the_worst_band():
    found = idealised(BLOCK, "one-third-octave", "line", "energy")
    change = found.otherwise["timoshenko"] - found.levels
    worst = np.argmax(np.abs(change))
    words = f"{change[worst]:+.1f} dB".replace("-", "−")
    assert f"rotary inertia changes it by up to {words} at {tig.BAND_LABELS[worst]} Hz" in cost_words(found)


def test_a_measured_stiffness_has_no_hysteretic_idealisation():
    curve = tig.StiffnessCurve([(5, 90e6, 0.1), (500, 150e6, 0.2)])
    found = idealised(BLOCK.replace(pad_stiffness=curve, pad_loss_factor=None), "octave", "line", "energy")
    assert set(found.otherwise) == {"timoshenko"}
    assert np.isfinite(found.single_degree).all()
