"""Draws when drawing is allowed.

A click on a button is handled while nobody holds the document's lock; figures may change only under it, as
they do in a next-tick callback. However many changes ask for it meanwhile, it is drawn once.
"""

import contextlib
import logging
from collections import deque
from functools import partial
from weakref import WeakKeyDictionary

import panel as pn

from dashboard.compute.pacing import PACE

log = logging.getLogger(__name__)

_open = []
"""Documents that may change now, since a next-tick callback holds their lock; it is released before any other
work of the event loop."""

_gathered = WeakKeyDictionary()
"""Steps of pages that nobody has asked for yet, by their documents."""


class NextTick:
    """Does a piece of drawing as soon as the session's document may change.

    Parameters
    ----------
    draw : callable
        Takes no arguments.
    """

    def __init__(self, draw):
        self._draw = draw
        self._due = False

    def __call__(self, *_):
        """Ask for it; it is done at once where the document may change already.

        So it is without a session, as in tests and while a page is made.
        """
        document = pn.state.curdoc
        if document in _open or not _has_session(document):
            self._draw()
        elif not self._due:
            self._due = True
            document.add_next_tick_callback(partial(self._do, document))

    def _do(self, document):
        self._due = False
        try:
            with one_message(document):
                self._draw()
        except Exception:
            log.exception("A change could not be drawn")


def _has_session(document):
    context = None if document is None else document.session_context
    return context is not None and context.session is not None


def on_next_tick(document, change):
    """Change what is drawn, when the session's document may change.

    Parameters
    ----------
    document : bokeh.document.Document or None
        The session's document; None, or one that nobody looks at, may change at once.
    change : callable
        Makes the change; it is called with the document.
    """
    if document is None or document.session_context is None:
        change(document)
    else:
        document.add_next_tick_callback(partial(change, document))


def in_turns(steps, on_error):
    """Do work of the current session step by step, each step on a turn of its own once the page has loaded.

    Between them the server does what other sessions wait for, as :mod:`dashboard.compute.pacing` has it.
    Without a session, as in tests, all is done at once.

    Parameters
    ----------
    steps : iterator
        Does a step whenever it is asked for the next item.
    on_error : callable
        Called with the exception of a step that failed; what follows it in the iterator is still done.
    """
    document = pn.state.curdoc
    if document in _gathered:
        _gathered[document].append(steps)
        return
    if document is None or document.session_context is None:
        for _ in steps:
            pass
        return
    begin = partial(_begin_turn, document, steps, on_error)
    begin() if pn.state.loaded else pn.state.onload(begin)


@contextlib.contextmanager
def gathering(document):
    """Have the steps of a page that nobody has asked for yet handed to whoever makes it.

    Parameters
    ----------
    document : bokeh.document.Document
        The page's.

    Yields
    ------
    iterator
        Does a step whenever it is asked for the next item; what fails raises.
    """
    queue = _gathered[document] = deque()
    try:
        yield _drained(queue)
    finally:
        del _gathered[document]


def _drained(queue):
    while queue:
        yield from queue.popleft()


def _begin_turn(document, steps, on_error):
    PACE.enter(document)
    take_turn = partial(_take_turn, document, steps, on_error)
    PACE.begin(partial(document.add_next_tick_callback, take_turn))


def _take_turn(document, steps, on_error):
    try:
        with one_message(document):
            next(steps)
    except StopIteration:
        PACE.leave(document)
        return
    except Exception as error:
        on_error(error)
    _begin_turn(document, steps, on_error)


@contextlib.contextmanager
def one_message(document):
    """Send all that changes within to the browser in one message, so that it is drawn in one frame.

    Parameters
    ----------
    document : bokeh.document.Document or None
        The session's document, its lock held by whoever asks.
    """
    _open.append(document)
    try:
        # before the page says that it is loaded, Panel drops what it holds, even if the browser has its
        # document
        with pn.io.hold(document) if pn.state.loaded else contextlib.nullcontext():
            yield
    finally:
        _open.pop()
