"""What may be a name: of a rail, a design, a specification, a study.

The one rule: a name that was accepted can be shown, printed and written to a file anywhere, so it holds
no control characters, no line breaks and nothing that reorders the text around it.
"""

LONGEST = 60
"""Characters that a name may have [-]."""

ALLOWED = f"a name of 1 to {LONGEST} printable characters"
"""What to give for a name."""


def is_name(value, longest=LONGEST):
    """Return whether a value is text of 1 to ``longest`` printable characters, not all of them spaces.

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
    return isinstance(value, str) and len(value) <= longest and value.isprintable() and bool(value.strip())


def brief(value, longest=60):
    """Return how a value that was refused is shown in a message: its ``repr``, cut if it is long."""
    try:
        shown = repr(value)
    except ValueError:  # an integer of more digits than Python writes
        shown = f"a number of more than {longest} digits"
    return shown if len(shown) <= longest else shown[: longest - 3] + "..."
