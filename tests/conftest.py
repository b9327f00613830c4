"""Order of the tests, and how Hypothesis draws examples.

Tests run in two processes. Those in a browser come first, since they take longest, and stay together by the
pages that they share, since opening one is dear; other slow ones come next, so that no process waits for the
other to end one. (A mark of pytest-xdist's would say so, too, but that of 3.8 means nothing to pytest 9.2.)

A run that decides whether a change may land draws the same examples every time; others explore. No example
has a deadline: the first may compile kernels, and machines are shared.
"""

import os

from hypothesis import settings
from xdist.scheduler import LoadScopeScheduling

import trackig_core as tig

ROOMS = (
    (
        "tests/browser/test_compare.py",
        "tests/browser/test_dashboard.py",
        "tests/browser/test_keyboard.py",
        "tests/browser/test_learn.py",
    ),
    ("tests/browser/",),
    ("tests/dashboard/server",),
    ("tests/core/decide/test_cluster.py",),
    ("tests/core/test_compiling.py",),
)
"""Modules, or folders of such, each of which stays in one process, by what it shares: browsers, servers,
clusters, caches, and pages whose tabs were made once are dear. The first that fits counts; tests in a browser
are two, of about the same length."""

settings.register_profile("explore", deadline=None)
settings.register_profile("ci", derandomize=True, deadline=None)
settings.load_profile("ci" if os.environ.get("CI") else "explore")


def pytest_sessionstart(session):
    """Compile the kernels once, before there are processes that would compile them at the same time."""
    if not hasattr(session.config, "workerinput"):
        tig.compile_kernels()


def pytest_collection_modifyitems(items):
    """Put tests in a browser first, then other slow ones."""
    items.sort(key=lambda item: [item.get_closest_marker(name) is None for name in ("browser", "slow")])


class Together(LoadScopeScheduling):
    """Gives what shares something dear to one process, and every other test to the first that is free."""

    def _split_scope(self, nodeid):
        return next((room[0] for room in ROOMS if nodeid.startswith(room)), nodeid)


def pytest_xdist_make_scheduler(config, log):
    """Return what shares tests out between the processes."""
    return Together(config, log)
