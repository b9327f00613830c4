"""What may be a name: of a rail, a design, a specification, a study.

A name that was accepted can be shown, printed and written to a file anywhere: it holds no control characters,
no line breaks and nothing that reorders the text around it.
"""

import difflib
from collections.abc import Mapping
from types import MappingProxyType
from typing import NoReturn, TypeVar

_Named = TypeVar("_Named")

LONGEST_NAME = 40
"""Characters that the name of a rail or a design may have [-]."""

LONGEST_TITLE = 60
"""Characters that the name of a specification, a source or a study may have [-]."""


def allowed(longest: int = LONGEST_NAME) -> str:
    """Return what to give for a name (str)."""
    return f"a name of 1 to {longest} printable characters, without a space at either end"


def is_name(value: object, longest: int = LONGEST_NAME) -> bool:
    """Return whether a value is text of 1 to ``longest`` printable characters, no space at either end.

    Parameters
    ----------
    value : object
        Anything a caller may have given.
    longest : int
        Characters allowed [-].

    Returns
    -------
    bool
        Whether it is a name.
    """
    if not isinstance(value, str):
        return False
    return 1 <= len(value) <= longest and value.isprintable() and value == value.strip()


def brief(value: object, longest: int = 60) -> str:
    """Return how a value that was refused is shown in a message: its ``repr``, cut if it is long."""
    try:
        shown = repr(value)
    except ValueError:  # an integer of more digits than Python writes
        shown = f"a number of more than {longest} digits"
    return shown if len(shown) <= longest else shown[: longest - 3] + "..."


class _Catalogue(dict[str, _Named]):
    """Things by name; a name that is not there is answered by the nearest that is."""

    def __missing__(self, name: object) -> NoReturn:
        """Raise a KeyError that says what to write."""
        near = difflib.get_close_matches(str(name), self, n=1)
        hint = f"did you mean {near[0]!r}?" if near else f"there are {', '.join(self)}"
        raise KeyError(f"no {brief(name)}: {hint}")


def named(things: dict[str, _Named]) -> Mapping[str, _Named]:
    """Return a mapping that cannot be changed, and whose KeyError names the nearest name.

    Parameters
    ----------
    things : dict
        Things by name.

    Returns
    -------
    Mapping
        The same things.
    """
    return MappingProxyType(_Catalogue(things))
