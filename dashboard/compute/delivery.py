"""Has Panel deliver every message to the browser, in the order in which they were made.

What a session changes while its socket is busy waits, behind a sign that something does. Whoever has written
what it took takes the sign down, even if more has come meanwhile; and without the sign nobody looks. The last
of several quick changes then stayed undelivered until the next: a curve of the track before, under the name
of the new one.

Bokeh sends a change once its document's lock is released, Panel before that, or later if the socket is busy.
The one overtook the other, and a browser that was told to change a part before it heard that there was one
complained of a reference that is not known. What Bokeh would send takes its place in Panel's queue.
"""

from bokeh.server.session import ServerSession
from panel.io import document as panel_document

_write_waiting = panel_document._dispatch_msgs


async def _write_all(document):
    await _write_waiting(document)
    # while the sign stands, somebody will look
    if document not in panel_document._WRITE_BLOCK and panel_document._WRITE_MSGS.get(document):
        panel_document._WRITE_BLOCK[document] = True
        panel_document._dispatch_write_task(document, _write_all, document)


def _take_its_place(session, event):
    """Queue a change of a session's document, under its lock, for all who did not make it themselves."""
    if session._pending_writes is None:
        # Panel tries again later
        raise RuntimeError("a document changed while nobody held its lock")
    told = session._current_patch_connection if event.setter is session else None
    others = session._subscribed_connections - {told}
    if others:
        panel_document.schedule_write_events(session.document, others, [event])


def install():
    """Have Panel deliver all messages, and all in order, in this process."""
    panel_document._dispatch_msgs = _write_all
    ServerSession._document_patched = _take_its_place
