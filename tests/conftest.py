"""Order of the tests, and how Hypothesis draws examples.

Tests run in two processes. Those in a browser come first, since they take longest, and stay together module
by module, since opening a browser is dear; other slow ones come next, so that no process waits for the other
to end one. A run that decides whether a change may land draws the same
examples every time; others explore. No example has a deadline: the first may compile kernels, and machines
are shared.
"""

import os

import pytest
from hypothesis import settings

import trackig_core as tig

settings.register_profile("explore", deadline=None)
settings.register_profile("ci", derandomize=True, deadline=None)
settings.load_profile("ci" if os.environ.get("CI") else "explore")


def pytest_sessionstart(session):
    """Compile the kernels once, before there are processes that would compile them at the same time."""
    if not hasattr(session.config, "workerinput"):
        tig.compile_kernels()


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items):
    """Put tests in a browser first, each of their modules into one process, then other slow ones."""
    items.sort(key=lambda item: [item.get_closest_marker(name) is None for name in ("browser", "slow")])
    for item in items:
        if item.get_closest_marker("browser") is not None:
            item.add_marker(pytest.mark.xdist_group(item.path.stem))
