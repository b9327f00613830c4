"""Has Panel deliver every message to the browser, also one that comes while another is being written.

What a session changes while its socket is busy waits, behind a sign that something does. Whoever has written
what it took takes the sign down, even if more has come meanwhile; and without the sign nobody looks. The last
of several quick changes then stayed undelivered until the next: a curve of the track before, under the name
of the new one.
"""

from panel.io import document as panel_document

_write_waiting = panel_document._dispatch_msgs


async def _write_all(document):
    await _write_waiting(document)
    # while the sign stands, somebody will look
    if document not in panel_document._WRITE_BLOCK and panel_document._WRITE_MSGS.get(document):
        panel_document._WRITE_BLOCK[document] = True
        panel_document._dispatch_write_task(document, _write_all, document)


def install():
    """Have Panel look for messages that came while it wrote others, in this process."""
    panel_document._dispatch_msgs = _write_all
