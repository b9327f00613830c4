"""The track's response on the page: computed while somebody looks, drawn for all shown designs, saved."""

import io

import numpy as np
import pandas as pd
import pytest

import trackig_core as tig
from dashboard.compute.responses import TrackResponses
from dashboard.figures.track_response import MIDSPAN, SUPPORT
from dashboard.session.pins import current_design
from dashboard.session.results import DesignResult
from dashboard.views.track_response import TrackResponseView
from tests.waiting import on_a_loop
from trackig_core.track.fields import SEARCHED_RANGES


class FakeExchange:
    def __init__(self):
        self.saved = {}

    def save(self, name, data):
        self.saved[name] = data


@pytest.fixture
def view(session):
    session.show("booted-block-low-mass")
    session.pin("slab-track", "Slab")
    return view_of(session)


def view_of(session):
    responses = TrackResponses(session.assessment)
    return TrackResponseView(session.assessment, responses, session.snapshot, FakeExchange())


def look(view):
    """Look as a browser does, on an event loop, and wait for what is computed."""
    on_a_loop(view._responses.look, True)


def test_nothing_is_computed_while_nobody_looks(view):
    assert not view._responses.responses
    assert view.points.lines.data["x"] == []


def test_receptances_and_decay_rates_of_all_shown_designs_are_drawn(view):
    look(view)
    expected = tig.analysis.track_response(tig.PRESETS["slab-track"])
    drawn = view.points.lines.data
    places = {(name, what): y for name, what, y in zip(drawn["name"], drawn["what"], drawn["y"], strict=True)}
    assert len(places) == 4
    np.testing.assert_allclose(places["Slab", SUPPORT], 1e12 * np.abs(expected.support))
    np.testing.assert_allclose(places["Slab", MIDSPAN], 1e12 * np.abs(expected.midspan))
    rates = view.decay.lines.data
    assert len(rates["y"]) == 6
    row = [*zip(rates["name"], rates["what"], strict=True)].index(("Slab", f"EN 15461, {MIDSPAN}"))
    np.testing.assert_allclose(rates["y"][row], expected.midspan_decay_rate)
    assert [len(each) for each in rates["x"]] == [17] * 6


def test_mobility_is_drawn_by_choice(view):
    look(view)
    view.quantity.value = "mobility"
    expected = tig.analysis.track_response(tig.PRESETS["booted-block-low-mass"])
    row = view.points.lines.data["name"].index("This design")
    np.testing.assert_allclose(view.points.lines.data["y"][row], 1e6 * np.abs(expected.support_mobility))
    assert view.points.model.yaxis.axis_label == "Mobility, mm/(s kN)"


def test_a_pinned_copy_is_seen_on_both_sides_of_the_current_design_in_front(session):
    session.show("booted-block-low-mass")
    session.pin("booted-block-low-mass", "Copy")
    view = view_of(session)
    look(view)
    drawn = view.points.lines.data
    assert drawn["name"] == ["Copy", "Copy", "This design", "This design"]
    copy, own = (dict(zip(drawn["what"][each], drawn["width"][each], strict=True)) for each in HALVES)
    assert all(copy[what] >= own[what] + 4 for what in (SUPPORT, MIDSPAN))


HALVES = (slice(0, 2), slice(2, 4))


@pytest.mark.parametrize("quantity", ["receptance", "mobility"])
def test_ticks_reach_both_ends_of_the_axis_for_the_softest_and_the_stiffest_track(session, quantity):
    view = view_of(session)
    for end, loss in ((0, 0.05), (1, 0.5)):
        numbers = {name: SEARCHED_RANGES[name][end] for name in ("pad_stiffness", "boot_stiffness")}
        losses = dict.fromkeys(("pad_loss_factor", "boot_loss_factor"), loss)
        design = tig.PRESETS["booted-block-low-mass"].replace(**numbers, **losses)
        response = tig.analysis.track_response(design)
        result = DesignResult(current_design(design), None, None)
        view.points.show([result], {design: response}, quantity)
        ticks, ends = np.array(view.points.model.yaxis.ticker.ticks), view.points.model.y_range
        assert ticks.min() <= ends.start * 2.5
        assert ticks.max() >= ends.end / 2.5
        assert all("e" not in view.points.model.yaxis.major_label_overrides[tick] for tick in ticks)


def test_hidden_designs_are_not_drawn(session):
    session.show("booted-block-low-mass")
    session.pins.show(session.pin("slab-track", "Slab").key, False)
    view = view_of(session)
    look(view)
    assert set(view.decay.lines.data["name"]) == {"This design"}


def test_curves_are_saved_as_csv(view):
    view._save_decay()
    assert view._exchange.saved == {}, "nothing is there yet"
    look(view)
    view._save_decay()
    view._save_points()
    points, decay = (
        pd.read_csv(io.StringIO(text), comment="#")
        for text in sorted(view._exchange.saved.values(), key=lambda text: "db_per_m" in text)
    )
    expected = tig.analysis.track_response(tig.PRESETS["slab-track"])
    np.testing.assert_allclose(
        decay["support_decay_rate_db_per_m Slab"], expected.support_decay_rate, atol=6e-5
    )
    assert [float(each) for each in decay["frequency_hz"]] == [float(each) for each in expected.bands.labels]
    real, imaginary = (points[f"receptance_midspan_{part}_m_per_N Slab"] for part in ("real", "imag"))
    np.testing.assert_allclose(real + 1j * imaginary, expected.midspan, rtol=1e-5)
