"""Draws when drawing is allowed.

A click on a button is handled while nobody holds the document's lock; figures may change only under it, as
they do in a next-tick callback. The one rule: however many changes ask for it, it is drawn once.
"""

import logging
from functools import partial

import panel as pn

log = logging.getLogger(__name__)


class Later:
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
        """Ask for it; without a session, as in tests and while a page is made, it is done at once."""
        document = pn.state.curdoc
        if document is None or document.session_context is None or document.session_context.session is None:
            self._draw()
        elif not self._due:
            self._due = True
            document.add_next_tick_callback(partial(self._do, document))

    def _do(self, document):
        self._due = False
        try:
            # all that is drawn goes to the browser in one message
            with pn.io.hold(document):
                self._draw()
        except Exception:
            log.exception("A change could not be drawn")
