"""What may be a name: of a rail, a design, a specification, a study.

The one rule: a name that was accepted can be shown, printed and written to a file anywhere, so it holds
no control characters, no line breaks and nothing that reorders the text around it.
"""

LONGEST_NAME = 40
"""Characters that the name of a rail or a design may have [-]."""

LONGEST_TITLE = 60
"""Characters that the name of a specification, a source or a study may have [-]."""


def allowed(longest=LONGEST_NAME):
    """Return what to give for a name (str)."""
    return f"a name of 1 to {longest} printable characters, without a space at either end"


def is_name(value, longest=LONGEST_NAME):
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


def brief(value, longest=60):
    """Return how a value that was refused is shown in a message: its ``repr``, cut if it is long."""
    try:
        shown = repr(value)
    except ValueError:  # an integer of more digits than Python writes
        shown = f"a number of more than {longest} digits"
    return shown if len(shown) <= longest else shown[: longest - 3] + "..."
