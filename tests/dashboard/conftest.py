"""Fixtures of the dashboard's tests: real pictures, each solved once, and a store without a solver."""

import dataclasses
from concurrent.futures import ThreadPoolExecutor
from functools import cache

import panel as pn
import param
import pytest

import trackig_core as tig
from dashboard.runner import AT_REST, take_picture
from dashboard.store import SolutionStore


@cache
def _picture(preset):
    return take_picture((tig.PRESETS[preset], AT_REST), lambda *_: None, lambda: False)


@pytest.fixture
def picture():
    """Return the picture of a preset by name."""
    return _picture


@pytest.fixture
def fake_picture(picture):
    """Return a function that makes a picture of any design without solving it."""
    real = picture("booted-block-low-mass")

    def fake(design, notes=(), fidelity=AT_REST):
        solution = dataclasses.replace(real.solution, design=design, notes=notes, fidelity=fidelity)
        return dataclasses.replace(real, solution=solution)

    return fake


class Pictures(param.Parameterized):
    """Pictures of pins, put there by a test."""

    pictures = param.Dict(default={})


@pytest.fixture
def make_pictures():
    """Return a function that makes pictures of pins, by their keys, that nobody solves."""
    return lambda **pictures: Pictures(**pictures)


@pytest.fixture
def make_store():
    """Return a function that makes stores, closed after the test."""
    stores = []

    def make(solve, capacity=8, workers=2):
        stores.append(SolutionStore(solve, ThreadPoolExecutor(max_workers=workers), capacity))
        return stores[-1]

    yield make
    for store in stores:
        store.close()


@pytest.fixture
def instant_store(make_store, fake_picture):
    """Return a store that answers at once with pictures that were never solved."""
    return make_store(lambda key, *_: fake_picture(key[0], fidelity=key[1]))


@pytest.fixture(autouse=True)
def _fresh_panel():
    yield
    pn.state.reset()
