"""How many sessions there may be, how many pages are kept ready, and what is forgotten when a session ends.

One session holds some 3 MB as it opens and 28 MB once all tabs were looked at, and whatever its user makes it
hold is bounded: eight pinned designs, a hundred steps of undo, files and messages of
:data:`MOST_MESSAGE_BYTES` at most.
"""

import os

import panel as pn
from panel.io.state import state

MOST_VARIABLE = "TRACKIG_MOST_SESSIONS"
"""Environment variable by which ``trackig serve --most-sessions`` tells its processes."""

MOST_SESSIONS = 60
"""Sessions that a process serves at a time unless told otherwise: 0.6 to 2.1 GB."""

AHEAD_VARIABLE = "TRACKIG_PAGES_AHEAD"
"""Environment variable by which ``trackig serve --pages-ahead`` tells its processes."""

PAGES_AHEAD = 4
"""Pages that a process keeps ready for whoever comes next, unless told otherwise."""

MOST_MESSAGE_BYTES = 4 * 2**20
"""Size of a message from a browser [bytes]; the largest file that may be opened is far smaller."""

FULL = (
    "# trackig is full\n\n{count} pages are open, and no more can be served at a time. "
    "Close a page that nobody needs, then reload this one.\n\nWhoever runs the server can allow more with "
    "`trackig serve --most-sessions`, and serve them faster with `--processes`."
)
"""What one too many reads."""

_open = set()
"""Identities of the documents that count as sessions."""


def most():
    """Return how many sessions this process serves at a time."""
    return int(os.environ.get(MOST_VARIABLE, MOST_SESSIONS))


def ahead():
    """Return how many pages this process keeps ready."""
    return int(os.environ.get(AHEAD_VARIABLE, PAGES_AHEAD))


def count():
    """Return how many sessions are open in this process."""
    return len(_open)


def is_full():
    """Return whether there is no room for another."""
    return count() >= most()


def admit(document):
    """Count a session, unless there are too many.

    Parameters
    ----------
    document : bokeh.document.Document
        The session's document; it counts until it is handed to :func:`leave` or :func:`forget`.

    Returns
    -------
    bool
        Whether there is room for it.
    """
    if is_full():
        return False
    _open.add(id(document))
    return True


def full_page():
    """Return the page for one session too many."""
    return pn.pane.Markdown(FULL.format(count=count()))


def leave(document):
    """Count a session no longer."""
    _open.discard(id(document))


def forget(document):
    """Let go of a session that is over.

    Panel notes the area of notifications among its views when a session is made, and takes it out again for
    no session; with it the whole page would be kept wherever no browser had asked for the document.

    Parameters
    ----------
    document : bokeh.document.Document
        The session's document.
    """
    leave(document)
    for reference, (_, _, owner, _) in list(state._views.items()):
        if owner is document:
            del state._views[reference]
