"""What computed a result: the versions on which its last digits depend."""

from importlib.metadata import PackageNotFoundError, version

PACKAGES = ("trackig", "numpy", "scipy", "numba", "pymoo")
"""Packages whose versions are kept with a result."""


def versions() -> dict[str, str]:
    """Return the version of each package that is installed, by name."""
    found = {}
    for name in PACKAGES:
        try:
            found[name] = version(name)
        except PackageNotFoundError:
            continue
    return found
