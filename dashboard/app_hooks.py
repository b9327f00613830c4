"""What the server does before the first session and after the last.

No session compiles anything; at a first start the page is there meanwhile, and says so.
"""

import gc
import logging

from tornado.ioloop import IOLoop
from tornado.websocket import WebSocketClosedError

import trackig_core as tig
from dashboard.app import rehearse
from dashboard.compute.workers import AT_REST, compiled, shared_live_store, shared_store
from dashboard.fields import OPENING_PRESET
from dashboard.figures import overlays

log = logging.getLogger(__name__)


def on_server_loaded(server_context):  # noqa: ARG001  (the server calls it so)
    """Have kernels compiled and the presets solved while pages are served, the opening one first."""
    IOLoop.current().asyncio_loop.set_exception_handler(handle_exception)
    compiled()
    # here and not on a thread: an import that sessions run into half-way fails for them
    overlays.load()
    # what is imported stays: looking through it for garbage would stop every session for 0.1 s now and then
    gc.freeze()
    opening, *_ = [
        shared_store().request((tig.PRESETS[key], AT_REST))
        for key in sorted(tig.PRESETS, key=lambda key: key != OPENING_PRESET)
    ]
    # a page that is made of the opening picture asks for no other
    loop = IOLoop.current()
    opening.future.add_done_callback(lambda _: loop.add_callback(rehearse))


def handle_exception(loop, context):
    """Log an exception that nobody caught; a reader who left while a picture was on its way is none.

    Parameters
    ----------
    loop : asyncio.AbstractEventLoop
        The server's loop.
    context : dict
        What it knows of the exception.
    """
    if isinstance(context.get("exception"), WebSocketClosedError):
        log.debug("A browser left before its message was sent")
    else:
        loop.default_exception_handler(context)


def on_server_unloaded(server_context):  # noqa: ARG001
    """End whatever is being solved, so that the process can end."""
    shared_store().close()
    shared_live_store().close()
