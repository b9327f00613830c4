"""The status line: what the solver does, what it noted, and what went wrong.

The one rule: it says in words whatever the pictures cannot show, and it is never taller than it
needs to be, so that the pictures below stay put.
"""

import html

import panel as pn
import panel_material_ui as pmui
from panel.viewable import Viewer

from dashboard import style


class Status(Viewer):
    """One line of text, with a progress bar and a way to stop while a run is long.

    Parameters
    ----------
    outcome : Outcome
        What is told.
    on_stop : callable
        Called when the user stops a long run.
    """

    def __init__(self, outcome, on_stop):
        super().__init__()
        self._outcome = outcome
        self.text = pn.pane.HTML("", stylesheets=[style.STATUS_CSS], margin=0)
        self.progress = pmui.LinearProgress(
            value=0, variant="determinate", width=160, visible=False, margin=(15, 0, 0, 12)
        )
        self.stop = pmui.Button(
            label="Stop",
            icon="stop",
            size="small",
            variant="text",
            visible=False,
            on_click=on_stop,
            margin=(0, 0, 0, 8),
        )
        outcome.param.watch(self._show, ["picture", "busy", "progress", "from_cache", "problem"])
        self._show()

    def _show(self, *_):
        outcome = self._outcome
        self.text.object = status_html(outcome)
        long = outcome.busy and outcome.progress is not None
        self.progress.param.update(value=round(100 * (outcome.progress or 0)), visible=long)
        self.stop.visible = long

    def __panel__(self):
        """Return what is put on the page."""
        return pmui.Row(
            self.text,
            self.progress,
            self.stop,
            sizing_mode="stretch_width",
            min_height=30,
            margin=(4, 8, 0, 8),
        )


def status_html(outcome):
    """Return what an outcome has to say as HTML, whatever characters it is made of."""
    kind = "problem" if outcome.problem and not outcome.busy else "fine"
    return f'<span role="status" class="{kind}">{html.escape(status_words(outcome))}</span>'


def status_words(outcome):
    """Return what an outcome has to say.

    Parameters
    ----------
    outcome : Outcome
        How the solver fares.
    """
    if outcome.busy:
        return "Solving a long record …" if outcome.progress is not None else "Solving …"
    if outcome.problem:
        return outcome.problem
    if outcome.picture is None:
        return "Not solved yet"
    took = style.duration_text(outcome.picture.seconds)
    words = f"From cache (solved before in {took})" if outcome.from_cache else f"Solved in {took}"
    return " · ".join((words, *outcome.picture.solution.notes))
