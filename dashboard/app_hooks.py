"""What the server does before the first session, after each and after the last.

No session compiles anything; at a first start the page is there meanwhile, and says so.
"""

from functools import partial

from panel.config import config
from tornado.ioloop import IOLoop

import trackig_core as tig
from dashboard.app import TITLE, build
from dashboard.compute.workers import AT_REST, compiled, shared_live_store, shared_store
from dashboard.fields import OPENING_PRESET
from dashboard.figures import overlays
from dashboard.server import bokeh_shortcuts, first_page, sessions
from dashboard.server.garbage import SWEEPER, share_heap, sweep
from dashboard.server.reserve import RESERVE
from dashboard.server_log import leave_out_departures, leave_out_empty_places

# the server is made after its hooks are read
first_page.install()
bokeh_shortcuts.install()
share_heap()


def on_server_loaded(server_context):
    """Have kernels compiled and the presets solved while pages are served, the opening one first."""
    leave_out_departures()
    leave_out_empty_places()
    compiled()
    opening, *_ = [
        shared_store().request((tig.PRESETS[key], AT_REST))
        for key in sorted(tig.PRESETS, key=lambda key: key != OPENING_PRESET)
    ]
    # here and not on a thread: an import that sessions run into half-way fails for them
    overlays.load()
    first_page.prepare(server_context.application_context, TITLE)
    SWEEPER.install()
    sweep()
    if config.autoreload:
        # pages that are ready would be those of the code before it was edited
        return
    # a page that is made of the opening picture asks for no other; the first prepares classes and scripts
    loop = IOLoop.current()
    serve = partial(
        RESERVE.serve, server_context.application_context, opening_picture, build, TITLE, sessions.ahead()
    )
    opening.future.add_done_callback(lambda _: loop.add_callback(serve))


def opening_picture():
    """Return the future of the picture that pages open with: solved anew where others have pushed it out."""
    return shared_store().request((tig.PRESETS[OPENING_PRESET], AT_REST)).future


def on_session_created(session_context):  # noqa: ARG001
    """Have the objects of a new page set aside."""
    SWEEPER.note_come()


def on_session_destroyed(session_context):
    """Let go of what a session leaves behind."""
    sessions.forget(session_context._document)


def on_server_unloaded(server_context):  # noqa: ARG001
    """End whatever is being solved, so that the process can end."""
    shared_store().close()
    shared_live_store().close()
