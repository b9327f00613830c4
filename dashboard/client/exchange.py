"""What passes between a session and its browser: address bar, clipboard, files, what outlives the server.

Panel's own file widgets are not used: a download of what was downloaded before does nothing, an upload is
not bounded in Python, and one that is refused in the browser ends in a traceback on the server.

Whatever comes from the browser is hostile. Messages of another form are dropped, files are
bounded before anybody reads them, and callbacks get plain bytes or text.
"""

import asyncio
import json
import logging
import secrets
from functools import partial
from pathlib import Path

import panel as pn
import param
from panel.io.state import set_curdoc

from dashboard.compute.document import on_next_tick, one_message
from dashboard.compute.pacing import Pace
from dashboard.session.shelf import Shelf
from trackig_core.levels import band_tables
from trackig_core.study import StudyError, studies

MOST = {
    "study": studies.MOST_BYTES,
    "specification": band_tables.MOST_BYTES,
    "source": band_tables.MOST_BYTES,
    "measured": band_tables.MOST_BYTES,
    "stiffness": band_tables.MOST_BYTES,
    "catalogue": studies.MOST_BYTES,
}
"""Size that a file may have [bytes], by what it is opened for."""

ACCEPTED = dict.fromkeys(MOST, ".csv,.txt,.tsv") | dict.fromkeys(("study", "catalogue"), ".toml")
"""What the browser's dialog offers, by what a file is opened for."""

REST = 0.3
"""Seconds without a change after which the address bar follows."""

BUSY_REST = 1.5
"""The same on a busy server, where pictures wait for whatever else is done."""

COPIED = "The link is copied: it holds the design, the pinned designs and the view."
NEEDS_FILE = (
    "The link is copied. It leaves out what only the study file holds: {}. "
    "Save the study (Save & share) and send it too."
)
NOT_COPIED = "The browser does not let the page copy. Copy the address from the address bar: it is the link."
HANDLING_FAILED = "Something went wrong; the server's log has the details."
NOT_RECALLED = "The catalogue that this browser remembered cannot be read any more; it is forgotten."
NOT_RESTORED = "What this page showed before the connection was lost could not be read back."

PLACE = "top-center"
"""Where notifications stand: over the header, where they cover no control of the sidebar and no figure."""

LASTING = {"success": 3000, "warning": 8000, "error": 8000}
"""How long a notification of each kind stays at least [ms]."""

READING = 60
"""Milliseconds that it takes to read a character, and a long notification stays for each."""

log = logging.getLogger(__name__)


class Scripted(pn.custom.JSComponent):
    """A component with a script of ours: its messages are handled when the document may change."""

    __abstract = True

    def handle_message(self, message):
        """Do what a message of the script asks for; one of another form asks for nothing."""

    def _handle_msg(self, message):
        handle_message = partial(on_next_tick, pn.state.curdoc, partial(self._handle_in_turn, message))
        # what changes before the page says that it is loaded would not reach it
        handle_message() if pn.state.loaded else pn.state.onload(handle_message)

    def _process_bokeh_event(self, doc, event):
        # Panel would note that it is busy, and look through all that is, three times
        with set_curdoc(doc):
            self._process_event(event)

    def _handle_in_turn(self, message, document):
        try:
            with one_message(document):
                self.handle_message(message)
        except Exception:
            log.exception("A message from the browser could not be handled")
            notify("error", HANDLING_FAILED)


class Exchange(Scripted):
    """What passes between the session and the browser that shows it.

    Parameters
    ----------
    snapshot : SessionSnapshot
        What the address bar follows.
    shelf : Shelf, optional
        The catalogue that the browser remembers, whatever study is open.
    pace : Pace, optional
        Whether the server is busy; by default it has this session alone.
    """

    kept = param.List(
        default=["", "", ""],
        doc="Query string of the link, the study as TOML, and what stands in boxes as JSON.",
    )
    session = param.String(default="", doc="Tells this session from all others.")

    _esm = (Path(__file__).parent / "scripts" / "exchange.js").read_text(encoding="utf-8")

    def __init__(self, snapshot, shelf=None, pace=None):
        super().__init__(
            session=secrets.token_hex(8), width=0, height=0, margin=0, styles={"position": "absolute"}
        )
        if pn.state.notifications is not None:
            # the browser heeds where notifications stand when it is first told, and never again
            pn.state.notifications.position = PLACE
        self._snapshot, self._shelf, self._pace = snapshot, shelf or Shelf(), pace or Pace()
        self._openers, self._key_listeners = {}, {}
        self._waiting = False
        self._changed = False
        self._copying = False
        self.note()
        snapshot.watch(self._follow)
        snapshot.param.watch(lambda *_: self.note(), "tab")
        self._shelf.param.watch(self._remember, "catalogue")

    def note(self):
        """Have the browser keep what there is now."""
        snapshot = self._snapshot
        self.kept = [snapshot.query(), snapshot.study().to_toml(), snapshot.boxes.typed]

    async def _follow(self, *_):
        """Note what is kept, once changes rest; the tab is noted at once."""
        self._changed = True
        if self._waiting:
            return
        self._waiting = True
        try:
            while self._changed:
                self._changed = False
                await asyncio.sleep(BUSY_REST if self._pace.is_busy else REST)
            self.note()
        finally:
            self._waiting = False

    def on_file(self, purpose, callback):
        """Hand the bytes of whatever file is opened for a purpose, one of :data:`MOST`, to a callback."""
        self._openers[purpose] = callback

    def on_key(self, figure, callback):
        """Hand the keys that a figure of a name is operated with to a callback: key, whether with Shift."""
        self._key_listeners[figure] = callback

    def save(self, name, data, kind="text/csv"):
        """Have the browser save a file.

        Parameters
        ----------
        name : str
            Name of the file.
        data : str or bytes
            What it holds.
        kind : str
            Its media type.
        """
        self._send_msg({"kind": "save", "name": name, "data": data, "type": kind})

    def reveal(self, name):
        """Have the browser bring the part of the page of a name into sight, once it is there."""
        self._send_msg({"kind": "reveal", "name": name})

    def introduce(self):
        """Have the browser answer, now that a part of the page was added.

        With its first message after that Bokeh sends back whatever was added and the message is about, and
        fails where this holds scripts: the first click in a new part would be lost. It also answers whenever
        it is told what to keep, as after a design was pinned.
        """
        self._send_msg({"kind": "introduce"})

    def handle_message(self, message):
        """Do what the browser asks for."""
        match message:
            case {"kind": "restore", "data": str(data)}:
                typed = message.get("typed")
                self._restore(data, typed if isinstance(typed, str) else "")
            case {"kind": "recalled", "data": str(data)}:
                self._recall(data)
            case {"kind": "copying"} if not self._copying:
                self._copying = True
                pn.state.execute(self._bring_link_up_to_date)
            case {"kind": "copied", "data": bool(copied)}:
                self._tell_of_link(copied)
            case {"kind": str(purpose), "data": bytes(data)} if purpose in self._openers:
                self._openers[purpose](data)
            case {"kind": "key", "figure": str(figure), "key": str(key), "shift": bool(shift)}:
                if figure in self._key_listeners:
                    self._key_listeners[figure](key, shift)

    async def _bring_link_up_to_date(self):
        """Have the browser look whether the link that it copied is still the one that it should have copied.

        What was set just before comes a little later: Panel gathers changes, and sliders send one at a time.
        """
        try:
            await asyncio.sleep(REST)
            while self._waiting:
                await asyncio.sleep(REST / 3)
        finally:
            self._copying = False
        self.note()
        self._send_msg({"kind": "copied"})

    def _tell_of_link(self, copied):
        left_out = self._snapshot.left_out
        if not copied:
            notify("warning", NOT_COPIED)
        elif left_out:
            notify("warning", NEEDS_FILE.format(left_out))
        else:
            notify("success", COPIED)

    def _remember(self, *_):
        """Have the browser remember the catalogue beyond this session, unless it is the bundled one."""
        own = self._shelf.catalogue.to_toml() if self._shelf.is_own else ""
        self._send_msg({"kind": "remember", "data": own})

    def _recall(self, data):
        try:
            self._shelf.open(data)
        except StudyError:
            # it was in the browser's memory, where anybody may have written
            log.info("A remembered catalogue was refused", exc_info=True)
            notify("warning", NOT_RECALLED)
            self._remember()

    def _restore(self, data, typed):
        try:
            self._snapshot.open(data)
        except ValueError:
            # it was in the browser's memory, where anybody may have written
            log.info("A page's memory was refused", exc_info=True)
            notify("warning", NOT_RESTORED)
        self._snapshot.boxes.put_back(typed)
        self._snapshot.steps.restart()
        self.note()
        self._send_msg({"kind": "keep"})


def notify(kind, words):
    """Show the user a notification of a kind: ``"success"``, ``"warning"`` or ``"error"``.

    A success takes away what was said before it.
    """
    area = pn.state.notifications
    if area is None:
        return
    if kind == "success":
        for earlier in [*area.notifications]:
            earlier.destroy()
    getattr(area, kind)(words, duration=max(LASTING[kind], READING * len(words)))


def opening(purpose):
    """Return what a button does in the browser to let the user choose a file for a purpose."""
    return f"window.trackig.choose({json.dumps(purpose)}, {json.dumps(ACCEPTED[purpose])}, {MOST[purpose]})"


COPYING = "window.trackig.copyLink()"
"""What a button does in the browser to copy the link."""
