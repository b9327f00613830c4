"""One value per band, as a user gives it: typed into a table, pasted, or opened from a file.

What is given is taken as a whole, and what was set aside is said; or not at all, and then a message says
where it is at fault, and what was there stays.
"""

import html
from pathlib import Path
from typing import ClassVar

import panel as pn
import panel_material_ui as pmui
import param
from panel.viewable import Viewer

import trackig_core as tig
from dashboard import theme
from dashboard.client.exchange import Scripted, opening
from dashboard.formats import extent_text
from dashboard.persistence.exports import file_name
from trackig_core.levels.band_tables import MOST_BYTES, NOMINAL

SCRIPT = Path(__file__).parent.parent / "client" / "scripts" / "band_grid.js"


class BandGrid(Scripted):
    """The table: boxes for the values given, and columns of what came of them."""

    bands = param.List(default=list(tig.BAND_LABELS), doc="Names of the rows.")
    given = param.String(doc="Header of the column of boxes.")
    words = param.String(doc="Caption of the table.")
    most = param.Integer(default=MOST_BYTES, doc="Characters that may be pasted.")
    values = param.List(default=[""] * len(tig.BAND_LABELS), doc="Texts of the boxes.")
    designs = param.List(
        default=[],
        doc="Name, colour, dash and parts of each design; a part has words and (text, fails) per band.",
    )

    _esm = SCRIPT.read_text(encoding="utf-8")
    _stylesheets: ClassVar = [theme.BAND_GRID_CSS]

    on_typed = None
    on_pasted = None

    def handle_message(self, message):
        """Hand on what was typed or pasted."""
        last = len(self.bands) - 1
        match message:
            case {"kind": "typed", "band": int(band), "text": str(text)} if 0 <= band <= last:
                self.on_typed(band, text)
            case {"kind": "pasted", "band": int(band), "text": str(text)} if 0 <= band <= last:
                self.on_pasted(band, text)

    def refuse(self, band):
        """Mark the box of a band: what it holds was not taken."""
        self._send_msg({"kind": "refused", "band": band})

    def show_again(self):
        """Put the values back into the boxes, whatever was typed."""
        self._send_msg({"kind": "again"})


EXAMPLES = {"specification": "31.5\t-6\n40\t-8", "source": "31.5\t62\n40\t60"}
"""Rows that may be pasted, by what they are pasted for."""


class BandEditor(Viewer):
    """A table of levels per band, and the ways to fill it.

    Parameters
    ----------
    assessment : Assessment
        Where the table is kept.
    name : str
        Which of its tables: ``"specification"`` or ``"source"``.
    exchange : Exchange
        Saves the template, and opens files.
    given : str
        What is given per band, as a header.
    words : str
        Caption of the table.
    """

    refused = param.String(default="", doc="Why what was given last was not taken; else empty.")

    def __init__(self, assessment, name, exchange, given, words):
        super().__init__()
        self._assessment, self._name, self._exchange = assessment, name, exchange
        self.on_read = lambda _: ()
        self._kind = assessment.param[name].class_
        self.grid = BandGrid(given=given, words=words, margin=(0, 12, 12, 12), styles=WITHIN)
        self.grid.on_typed, self.grid.on_pasted = self._take_typed, self._take_pasted
        self.message = pn.pane.HTML("", stylesheets=[theme.MESSAGE_CSS], margin=(0, 12, 4, 12))
        # where the table is higher than the window, the first message is out of sight of who pastes below it
        self.answer = pn.pane.HTML("", stylesheets=[theme.MESSAGE_CSS], margin=(4, 12, 4, 12))
        self.pasted = pmui.TextAreaInput(
            label="Paste a table of Hz and dB",
            placeholder=EXAMPLES[name],
            rows=8,
            max_length=MOST_BYTES,
            sizing_mode="stretch_width",
            margin=(4, 12, 4, 12),
        )
        self.apply = _button(
            "Take what is pasted", "content_paste_go", margin=(4, 12, 4, 12), on_click=self._take_area
        )
        self.load = _button("Open CSV", "upload_file", js_on_click=opening(name))
        self.template = _button("Template", "download", on_click=self._save_template)
        self.save = _button("Save CSV", "download", on_click=self._save)
        self.clear = _button("Clear", "delete", on_click=self._clear)
        exchange.on_file(name, self.take)
        assessment.param.watch(self._show, name)
        self._show()

    @property
    def table(self):
        """The table as it is kept, or None."""
        return getattr(self._assessment, self._name)

    def take(self, data, message=None):
        """Take a whole table, as bytes or text, or say why not in a pane, by default that of the table."""
        try:
            reading = self._kind.read(data)
        except tig.BandTableError as error:
            self._tell(f"Not taken: {error}.", pane=message)
            return False
        self._keep(reading.table if self.table is None else reading.table.beside(self.table))
        notes = [f"Taken: {extent_text(self.table.points)}", *reading.notes, *self.on_read(reading)]
        self._tell(f"{'; '.join(notes)}.", "status", message)
        return True

    def _take_area(self, *_):
        if self.take(self.pasted.value, self.answer):
            self.pasted.value = ""

    def _take_pasted(self, band, text):
        """Take what was pasted into a box: a table, or a single column that begins at the box."""
        values = self._column(text.strip("\r\n"))
        if values is None:
            self.take(text)
        elif band + len(values) > len(NOMINAL):
            self._tell(
                f"Not taken: give one number a line, {len(NOMINAL) - band} at most from "
                f"{tig.BAND_LABELS[band]} Hz on, or two columns, Hz and dB."
            )
        else:
            self._change(dict(zip(NOMINAL[band:], values, strict=False)))
            rows = "1 number" if len(values) == 1 else f"{len(values)} numbers"
            self._tell(f"Taken: {rows}, from {tig.BAND_LABELS[band]} Hz on.", "status")

    def _column(self, text):
        """Return the levels of a column, None where there is none; or None if a line is no level."""
        try:
            # a tab stands between cells even where the numbers beside it could be read as one
            return None if "\t" in text else [self._kind.quantity.read(line) for line in text.splitlines()]
        except tig.BandTableError:
            return None

    def _take_typed(self, band, text):
        try:
            self._change({NOMINAL[band]: self._kind.quantity.read(text)})
        except tig.BandTableError as error:
            self._tell(f"Not taken: {tig.BAND_LABELS[band]} Hz: {error}.")
            self.grid.refuse(band)

    def _change(self, levels):
        """Set levels by frequency, None to take one out."""
        points = {**dict(self.table.points if self.table is not None else ()), **levels}
        points = [(frequency, level) for frequency, level in points.items() if level is not None]
        if self.table is None:
            self._keep(self._kind.given(points) if points else None)
        else:
            self._keep(self.table.with_points(points) if points or self.table.may_be_empty else None)

    def _keep(self, table):
        self._tell("")
        setattr(self._assessment, self._name, table)
        # the box of a number that was typed in another form, or refused, shows the number as it is kept
        self.grid.show_again()

    def _tell(self, words, role="alert", pane=None):
        self.refused = words if role == "alert" else ""
        for each in (self.message, self.answer):
            shown = words if each is (pane or self.message) else ""
            each.object = f'<div role="{role}">{html.escape(shown)}</div>'

    def clear_message(self):
        """Take away what was said of a table that was read."""
        self._tell("")

    def _show(self, *_):
        levels = dict(self.table.points) if self.table is not None else {}
        self.grid.values = [f"{levels[each]:.10g}" if each in levels else "" for each in NOMINAL]
        self.clear.disabled, self.save.disabled = self.table is None, not levels

    def _save_template(self, *_):
        self._exchange.save(file_name(self._name, "template.csv"), self._kind.template_csv())

    def _save(self, *_):
        self._exchange.save(file_name(self._assessment.title, f"{self._name}.csv"), self.table.to_csv())

    def _clear(self, *_):
        self._keep(None)

    def __panel__(self):
        """Return what is put on the page."""
        return pmui.Column(
            pmui.FlexBox(self.load, self.template, self.save, self.clear, margin=(0, 12, 0, 12), gap="4px"),
            self.message,
            pmui.FlexBox(
                self.grid,
                pmui.Column(self.pasted, self.apply, self.answer, styles=BESIDE, margin=0),
                sizing_mode="stretch_width",
                margin=0,
            ),
            sizing_mode="stretch_width",
            margin=0,
        )


WITHIN = {"flex": "0 1 auto", "max-width": "100%", "box-sizing": "border-box"}
"""A table is as wide as its columns, and scrolls where there is no room for them."""

BESIDE = {"flex": "1 1 240px", "max-width": "520px"}
"""What stands beside the table, or below where there is no room."""


def _button(label, icon, margin=(4, 8, 4, 0), **kind):
    return pmui.Button(label=label, icon=icon, size="small", variant="outlined", margin=margin, **kind)
