"""Fixtures of the core's tests: the golden results, and each preset solved once."""

import json
from functools import cache
from pathlib import Path

import pytest

import trackig_core as tig

DATA = Path(__file__).parent.parent / "data"


@pytest.fixture(scope="session")
def golden():
    """Exact results of an independent z-domain solution of the same discrete scheme."""
    return json.loads((DATA / "golden.json").read_text())


@cache
def _solved(preset):
    return tig.solve(tig.PRESETS[preset])


@pytest.fixture(params=list(tig.PRESETS))
def preset(request):
    return request.param


@pytest.fixture
def solved():
    """Solve a preset by name at paper fidelity, each only once."""
    return _solved
