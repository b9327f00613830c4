"""Fixtures of the dashboard's tests: real pictures, each solved once, and a store without a solver."""

import dataclasses
from functools import cache

import panel as pn
import param
import pytest

import trackig_core as tig
from dashboard.compute.fair import FairExecutor
from dashboard.compute.store import SolutionStore
from dashboard.compute.workers import AT_REST, solve_summary
from dashboard.persistence.snapshot import SessionSnapshot
from dashboard.session.assessment import Assessment
from dashboard.session.inputs import DesignInputs, GainDefinition
from dashboard.session.pins import Pins
from dashboard.session.results import Outcome


@cache
def _summary(preset):
    return solve_summary((tig.PRESETS[preset], AT_REST), lambda *_: None, lambda: False)


@pytest.fixture
def summary():
    """Return the picture of a preset by name."""
    return _summary


@pytest.fixture
def fake_picture(summary):
    """Return a function that makes a picture of any design without solving it."""
    real = summary("booted-block-low-mass")

    def fake(design, notes=(), fidelity=AT_REST):
        solution = dataclasses.replace(real.solution, design=design, notes=notes, fidelity=fidelity)
        return dataclasses.replace(real, solution=solution)

    return fake


class Pictures(param.Parameterized):
    """Pictures of pins, put there by a test."""

    summaries = param.Dict(default={})


@pytest.fixture
def make_pictures():
    """Return a function that makes pictures of pins, by their keys, that nobody solves."""
    return lambda **summaries: Pictures(**summaries)


@pytest.fixture
def make_store():
    """Return a function that makes stores, closed after the test."""
    stores = []

    def make(solve, capacity=8, workers=2, spare=0):
        stores.append(SolutionStore(solve, FairExecutor(workers, spare=spare), capacity))
        return stores[-1]

    yield make
    for store in stores:
        store.close()


@pytest.fixture
def instant_store(make_store, fake_picture):
    """Return a store that answers at once with pictures that were never solved."""
    return make_store(lambda key, *_: fake_picture(key[0], fidelity=key[1]))


@pytest.fixture
def session(summary):
    """Return the state of a session: its plain parts, with pictures that a test puts there."""
    return Session(summary)


@pytest.fixture
def measured_result(session, fake_picture):
    """Return the current design's result, its pad measured from 1 to 30 Hz only."""
    session.show("booted-block-low-mass")
    curve = tig.StiffnessCurve([(1, 90e6, 0.1), (30, 110e6, 0.2)])
    design = tig.PRESETS["booted-block-low-mass"].replace(pad_stiffness=curve, pad_loss_factor=None)
    session.outcome.summary = fake_picture(design)
    return session.assessment.current


class Session:
    """All plain parts of a session, put together as the page does."""

    def __init__(self, summary):
        self._summary = summary
        self.inputs, self.outcome, self.definition = DesignInputs(), Outcome(), GainDefinition()
        self.pins, self.pinned = Pins(), Pictures()
        self.assessment = Assessment(self.inputs, self.outcome, self.definition, self.pins, self.pinned)
        tabs = ("explore", "specification", "level", "keep")
        self.snapshot = SessionSnapshot(self.inputs, self.definition, self.pins, self.assessment, tabs)

    def show(self, preset):
        """Put a preset on the screen, solved."""
        self.inputs.preset = preset
        self.outcome.summary = self._summary(preset)

    def pin(self, preset, name=""):
        """Pin a preset, solved, and return the pin."""
        pin = self.pins.add(tig.PRESETS[preset], name, preset)
        self.pinned.summaries = {**self.pinned.summaries, pin.key: self._summary(preset)}
        return pin


@pytest.fixture(autouse=True)
def _fresh_panel():
    yield
    pn.state.reset()
