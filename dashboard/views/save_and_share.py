"""The tab from which everything is taken home: link, study, curves, plots, report.

What is opened replaces everything, or nothing and says why.
"""

import asyncio
import datetime
import html

import panel as pn
import panel_material_ui as pmui

import trackig_core as tig
from dashboard import theme
from dashboard.client.exchange import COPYING, notify, opening, saving
from dashboard.compute.workers import workers
from dashboard.persistence.exports import file_name, force_csv, gain_csv
from dashboard.views.components import PAPER, caption
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
        self.study_name = pmui.TextInput(
            label="Name of the study",
            value=self._assessment.title,
            max_length=LONGEST_TITLE,
            size="small",
            width=320,
            margin=(6, 12, 6, 0),
        )
        self.message = pn.pane.HTML("", stylesheets=[theme.MESSAGE_CSS], margin=(0, 12, 4, 12))
        self.copy = copy_button()
        self.save = button("Save study", "save", on_click=self._save_study)
        self.open = button("Open study", "folder_open", js_on_click=opening("study"))
        self.gain = button("Insertion gain, CSV", "download", on_click=self._save_gain)
        self.force = button("Force, CSV", "download", on_click=self._save_force)
        self.report = button("Report, HTML", "description", on_click=self._save_report)
        self.plots = [
            button(
                f"{words}, {form.upper()}", "image", js_on_click=saving(plot, form, f"trackig-{stem}.{form}")
            )
            for plot, words, stem in PLOTS
            for form in ("png", "svg")
        ]
        self.study_name.param.watch(self._rename, "value")
        self._assessment.param.watch(self._show_name, "title")
        self._assessment.param.watch(self._enable, "results")
        exchange.on_file("study", self._open_study)
        self._enable()

    def _rename(self, event):
        title = event.new.strip()
        if is_name(title, LONGEST_TITLE):
            self.study_name.param.update(error_state=False, helper_text="")
            self._assessment.title = title
        else:
            self.study_name.param.update(error_state=True, helper_text=f"give {allowed(LONGEST_TITLE)}")

    def _show_name(self, *_):
        self.study_name.param.update(value=self._assessment.title, error_state=False, helper_text="")

    def _enable(self, *_):
        for each in (self.gain, self.force, self.report):
            each.disabled = not self._assessment.shown

    def _file(self, suffix):
        return file_name(self._assessment.title, suffix)

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
        self._exchange.save(self._file("gain.csv"), gain_csv(self._assessment.shown))

    def _save_force(self, *_):
        self._exchange.save(self._file("force.csv"), force_csv(self._assessment.shown))

    async def _save_report(self, *_):
        study, title = self._snapshot.study(), self._file("report.html")
        solved = [each.summary for each in self._assessment.results if each.summary is not None]
        summaries = {summary.design: summary for summary in solved}
        self.report.loading = True
        try:
            loop = asyncio.get_running_loop()
            report = await loop.run_in_executor(workers(), write_report, study, summaries)
        except ValueError:
            notify("warning", NOT_SOLVED)
        else:
            self._exchange.save(title, report, "text/html")
        finally:
            self.report.loading = False

    def build(self):
        """Return what is put on the page."""
        groups = (
            ("Share", LINK_WORDS, [self.copy]),
            ("Study", STUDY_WORDS, [self.study_name, self.save, self.open]),
            ("Report and curves", CURVE_WORDS, [self.report, self.gain, self.force]),
            ("Plots", PLOT_WORDS, self.plots),
        )
        return pmui.Column(
            *(
                pmui.Paper(caption(title, words), pmui.FlexBox(*parts, margin=(0, 12, 10, 12)), **PAPER)
                for title, words, parts in groups
            ),
            self.message,
            sizing_mode="stretch_width",
            margin=(0, 8, 8, 8),
        )


def write_report(study, summaries):
    """Return the report of a study, as of today (str)."""
    # plots are slow to load, and nobody waits for them who wants no report
    from dashboard.report.html_report import html_report

    return html_report(study, summaries, date=datetime.date.today(), version=tig.__version__)


def copy_button():
    """Return a button that copies the link."""
    return button("Copy link", "link", js_on_click=COPYING)


def button(label, icon, **kind):
    """Return one of the tab's buttons."""
    return pmui.Button(label=label, icon=icon, size="small", variant="outlined", margin=(6, 8, 6, 0), **kind)


PLOTS = (
    ("insertion_gain_figure", "Insertion gain", "gain"),
    ("force_figure", "Force", "force"),
)
"""Name of each plot's figure, what it is called, and how its file is named."""

LINK_WORDS = (
    "the address bar holds the design, the pinned designs and the view; "
    "specification and source travel in a study"
)
STUDY_WORDS = "one file that people can read: designs, pinned designs, specification, source"
CURVE_WORDS = "of this design and of the pinned designs that are shown"
PLOT_WORDS = "as they are on the screen"
NOT_SOLVED = "There is nothing to report yet: wait until the current design is solved."
