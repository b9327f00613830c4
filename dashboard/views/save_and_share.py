"""The tab from which everything is taken home: link, study, report, data sheet, curves, pictures.

What is opened replaces everything, or nothing and says why.
"""

import asyncio
import datetime
import html
from functools import partial
from types import MappingProxyType

import panel as pn
import panel_material_ui as pmui

import trackig_core as tig
from dashboard import theme
from dashboard.client.exchange import COPYING, notify, opening
from dashboard.compute.workers import workers
from dashboard.persistence.exports import file_name, force_csv, gain_csv
from dashboard.session.heading import Heading
from dashboard.teaching import left_out
from dashboard.views.components import CURRENT, CURRENT_NAME, PAPER, caption
from dashboard.views.tab import Tab
from trackig_core.names import LONGEST_TITLE, allowed, is_name


class SaveAndShare(Tab):
    """Link, study, downloads and report.

    Parameters
    ----------
    snapshot : SessionSnapshot
        What is kept.
    exchange : Exchange
        Where it goes.
    """

    title = "Save & share"
    link_name = "keep"

    def __init__(self, snapshot, exchange):
        super().__init__()
        self._snapshot, self._exchange, self._assessment = snapshot, exchange, snapshot.assessment
        self.study_name = _name_box("Name of the study", self._assessment.title, width=320)
        self.message = pn.pane.HTML("", stylesheets=[theme.MESSAGE_CSS], margin=(0, 12, 4, 12))
        self.copy = copy_button()
        self.save = button("Save study", "save", on_click=self._save_study)
        self.open = button("Open study", "folder_open", js_on_click=opening("study"))
        self.gain = button("Insertion gain, CSV", "download", on_click=self._save_gain)
        self.force = button("Force, CSV", "download", on_click=self._save_force)
        self.report = button("Report, HTML", "description", on_click=self._save_report)
        self.left_out = pmui.Switch(label=LEFT_OUT_LABEL, value=False, margin=(6, 12))
        self.particulars = {
            name: _name_box(f"{name.capitalize()}, on the report") for name in ("project", "client", "author")
        }
        for box in self.particulars.values():
            box.param.watch(_check_name, "value")
        snapshot.boxes.keep(left_out=self.left_out, **self.particulars)
        self.sheet = button("Data sheet, HTML", "article", on_click=self._save_sheet)
        self.sheet_design = None
        self._sheet_place = pmui.Row(margin=0)
        self.pictures = {
            (kind, form): button(
                f"{words}, {form.upper()}", "image", on_click=partial(self._save_picture, kind, form)
            )
            for kind, words in PICTURES
            for form in MEDIA
        }
        self.study_name.param.watch(self._rename, "value")
        self._assessment.param.watch(self._show_name, "title")
        self._assessment.param.watch(self._offer, "results")
        exchange.on_file("study", self._open_study)
        self._offer()

    def _rename(self, event):
        title = event.new.strip()
        if _tell_whether_name(self.study_name, title):
            self._assessment.title = title

    def _show_name(self, *_):
        self.study_name.param.update(value=self._assessment.title, error_state=False, helper_text="")

    def _offer(self, *_):
        """Offer what can be saved of the designs that are solved and shown."""
        for each in (self.gain, self.force, self.report, self.sheet, *self.pictures.values()):
            each.disabled = not self._assessment.shown
        options = {
            CURRENT_NAME if each.key is None else each.name: each.key or CURRENT
            for each in self._assessment.shown
        }
        chosen = self.sheet_design
        if chosen is not None and chosen.options == options:
            return
        # made anew: the browser's select fails when its options change before its tab was ever seen
        kept = chosen is not None and chosen.value in options.values()
        self.sheet_design = pn.widgets.Select(
            label="Design",
            options=options,
            value=chosen.value if kept else next(iter(options.values()), None),
            width=SELECT_WIDTH,
            margin=(6, 12, 6, 0),
            stylesheets=[theme.SELECT_CSS],
        )
        self._sheet_place.objects = [self.sheet_design]

    @property
    def _drawn(self):
        """The results that the plots show: those of the pins alone, if they stand alone."""
        return self._assessment.shown_pins if self._snapshot.pins.alone else self._assessment.shown

    def _heading(self, results):
        return Heading.of(self._snapshot.study(), results, datetime.date.today())

    def _file(self, *parts):
        return file_name(self._assessment.title, *parts)

    def _save_study(self, *_):
        self._exchange.save(self._file(".toml"), self._snapshot.study().to_toml(), "application/toml")

    def _open_study(self, data):
        try:
            self._snapshot.open(data)
        except tig.StudyError as error:
            words = f"Not opened, nothing has changed: {error}."
            self.message.object = f'<div role="alert">{html.escape(words)}</div>'
        else:
            self.message.object = ""
            notify("success", "The study is open.")

    def _save_gain(self, *_):
        self._save_curves(partial(gain_csv, measured=self._assessment.measured), self._drawn, "gain.csv")

    def _save_force(self, *_):
        self._save_curves(
            force_csv, [each for each in self._drawn if each.summary.time is not None], "force.csv"
        )

    def _save_curves(self, write, results, suffix):
        if not results:
            notify("warning", NOT_SOLVED)
            return
        heading = self._heading(results)
        self._exchange.save(self._file(heading.design, suffix), write(results, heading))

    async def _save_report(self, *_):
        study = self._snapshot.study()
        solved = [each.summary for each in self._assessment.results if each.summary is not None]
        summaries = {summary.design: summary for summary in solved}
        await self._save_drawn(
            self.report,
            self._file("report.html"),
            "text/html",
            write_report,
            study,
            summaries,
            self._snapshot.answers.pages,
            self.left_out.value,
            {name: box.value.strip() for name, box in self.particulars.items() if not box.error_state},
        )

    async def _save_sheet(self, *_):
        chosen = self.sheet_design.value
        result = next((each for each in self._assessment.shown if (each.key or CURRENT) == chosen), None)
        if result is None:
            notify("warning", NOT_SOLVED)
            return
        heading, assessment = self._heading([result]), self._assessment
        await self._save_drawn(
            self.sheet,
            self._file(heading.design, "data-sheet.html"),
            "text/html",
            write_sheet,
            result,
            heading,
            assessment.specification,
            assessment.source,
            assessment.measured,
        )

    async def _save_picture(self, kind, form, *_):
        results, assessment = self._drawn, self._assessment
        if kind == "force":
            results = [each for each in results if each.summary.time is not None]
        if not results or (kind == "difference" and assessment.base.levels is None):
            notify("warning", NOT_SOLVED)
            return
        heading = self._heading(results)
        await self._save_drawn(
            self.pictures[kind, form],
            self._file(heading.design, f"{kind}.{form}"),
            MEDIA[form],
            draw_picture,
            kind,
            form,
            tuple(results),
            heading,
            assessment.base,
            assessment.in_force,
            assessment.measured,
        )

    async def _save_drawn(self, pressed, name, media, write, *arguments):
        """Save what takes a while to draw, off the event loop, its button at work meanwhile."""
        pressed.loading = True
        try:
            data = await asyncio.get_running_loop().run_in_executor(workers(), write, *arguments)
        except ValueError:
            notify("warning", NOT_SOLVED)
        else:
            self._exchange.save(name, data, media)
        finally:
            pressed.loading = False

    def build(self):
        """Return what is put on the page."""
        groups = (
            ("Share", LINK_WORDS, [self.copy], ()),
            ("Study", STUDY_WORDS, [self.study_name, self.save, self.open], [self.message]),
            (
                *("Report and curves", CURVE_WORDS),
                [self.report, self.gain, self.force, self.left_out, *self.particulars.values()],
                (),
            ),
            ("Data sheet", SHEET_WORDS, [self._sheet_place, self.sheet], ()),
            ("Pictures", PICTURE_WORDS, self.pictures.values(), ()),
        )
        return pmui.Column(
            *(
                pmui.Paper(
                    caption(title, words), pmui.FlexBox(*parts, margin=(0, 12, 10, 12)), *below, **PAPER
                )
                for title, words, parts, below in groups
            ),
            sizing_mode="stretch_width",
            margin=(0, 8, 8, 8),
        )


# plots are slow to load, and nobody waits for them who wants none


def write_report(study, summaries, pages, with_left_out=False, particulars=MappingProxyType({})):
    """Return the report of a study, as of today (str), with what the simplified model leaves out or not.

    Particulars are names by what they are of: project, client, author.
    """
    from dashboard.report.html_report import Particulars, html_report

    found = None
    if with_left_out:
        found = left_out.left_out(
            study.design, left_out.OPENING_VEHICLE, left_out.OPENING_GROUND, study.view.summation
        )
    today = datetime.date.today()
    return html_report(
        study,
        summaries,
        date=today,
        version=tig.__version__,
        pages=pages,
        left_out=found,
        particulars=Particulars(**particulars),
    )


def write_sheet(result, heading, specification, source, measured):
    """Return the data sheet of a design (str)."""
    from dashboard.report.data_sheet import data_sheet

    return data_sheet(result, heading, specification, source, measured)


def draw_picture(kind, form, results, heading, base, specification, measured):
    """Return a picture as a file (bytes)."""
    from dashboard.report.pictures import picture

    return picture(kind, form, results, heading, base=base, specification=specification, measured=measured)


def _name_box(label, value="", width=200):
    """Return a box for a name."""
    return pmui.TextInput(
        label=label,
        value=value,
        max_length=LONGEST_TITLE,
        size="small",
        width=width,
        margin=(6, 12, 6, 0),
    )


def _check_name(event):
    """Mark a box that holds neither a name nor nothing."""
    _tell_whether_name(event.obj, event.new.strip(), may_be_empty=True)


def _tell_whether_name(box, text, may_be_empty=False):
    """Return whether a text is a name (bool), and say in its box what to give if it is none."""
    fine = (may_be_empty and not text) or is_name(text, LONGEST_TITLE)
    box.param.update(error_state=not fine, helper_text="" if fine else f"give {allowed(LONGEST_TITLE)}")
    return fine


def copy_button():
    """Return a button that copies the link."""
    return button("Copy link", "link", js_on_click=COPYING)


def button(label, icon, **kind):
    """Return one of the tab's buttons."""
    return pmui.Button(label=label, icon=icon, size="small", variant="outlined", margin=(6, 8, 6, 0), **kind)


PICTURES = (("gain", "Insertion gain"), ("difference", "Difference"), ("force", "Force"))
"""Kinds of pictures, and what each is called on its buttons."""

MEDIA = {"png": "image/png", "svg": "image/svg+xml"}
"""Media type of each form of picture."""

LEFT_OUT_LABEL = "Report with what the simplified model leaves out"

SELECT_WIDTH = 280

LINK_WORDS = (
    "the address bar holds the design, the pinned designs and the view; it leaves out "
    "specification, source, insertion gain from elsewhere, measured curves, kept answers"
)
STUDY_WORDS = "one file that people can read: what a link holds, and all that it leaves out"
CURVE_WORDS = "of this design and of the pinned designs that are shown"
SHEET_WORDS = "one page of A4 on one design: verdict, insertion gain, inputs, natural frequencies"
PICTURE_WORDS = "for other reports: title, study, definition, legend and date, 2400 points wide"
NOT_SOLVED = "There is nothing to report yet: wait until the current design is solved."
