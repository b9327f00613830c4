"""Order of the tests: those in a browser come last, since Playwright leaves an event loop running."""


def pytest_collection_modifyitems(items):
    items.sort(key=lambda item: item.get_closest_marker("browser") is not None)
