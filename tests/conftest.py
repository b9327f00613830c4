"""Order of the tests, and how Hypothesis draws examples.

Tests in a browser come last, since Playwright leaves an event loop running. A run that decides whether a
change may land draws the same examples every time; others explore. No example has a deadline: the first
may compile kernels, and machines are shared.
"""

import os

from hypothesis import settings

settings.register_profile("explore", deadline=None)
settings.register_profile("ci", derandomize=True, deadline=None)
settings.load_profile("ci" if os.environ.get("CI") else "explore")


def pytest_collection_modifyitems(items):
    items.sort(key=lambda item: item.get_closest_marker("browser") is not None)
