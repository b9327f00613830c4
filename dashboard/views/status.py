"""The status line: what the solver does, what it noted, and what went wrong.

It says in words whatever the pictures cannot show, on one line whose height never
changes, so that the pictures below stay put. What does not fit is told when the pointer rests on the line,
and when it has the focus.
"""

import html

import panel as pn
import panel_material_ui as pmui
from panel.viewable import Viewer

from dashboard import formats, theme


class Status(Viewer):
    """One line of text, with a progress bar and a way to stop while a run is long.

    Parameters
    ----------
    outcome : Outcome
        What is told.
    on_stop, on_solve : callable
        Called when the user stops a long run, or wants what was not solved to be solved after all.
    """

    def __init__(self, outcome, on_stop, on_solve):
        super().__init__()
        self._outcome = outcome
        self.text = pn.pane.HTML("", stylesheets=[theme.STATUS_CSS], sizing_mode="stretch_width", margin=0)
        self.progress = pmui.LinearProgress(
            value=0, variant="determinate", width=160, visible=False, margin=(14, 0, 0, 12)
        )
        self.stop = _button("Stop", "stop", on_stop)
        self.solve = _button("Solve", "play_arrow", on_solve)
        shown = ["summary", "busy", "compiling", "progress", "from_cache", "problem"]
        outcome.param.watch(self._show, shown)
        self._show()

    def _show(self, *_):
        outcome = self._outcome
        self.text.object = status_html(outcome)
        long = outcome.busy and outcome.progress is not None
        self.progress.value = round(100 * (outcome.progress or 0))
        self.progress.visible = self.stop.visible = long
        self.solve.visible = bool(outcome.problem) and not outcome.busy

    def __panel__(self):
        """Return what is put on the page."""
        return pn.Row(
            self.text,
            self.progress,
            self.stop,
            self.solve,
            sizing_mode="stretch_width",
            height=theme.STATUS_HEIGHT,
            margin=0,
        )


def _button(label, icon, on_click):
    return pmui.Button(
        label=label,
        icon=icon,
        size="small",
        variant="text",
        visible=False,
        on_click=on_click,
        margin=(0, 0, 0, 8),
    )


def status_html(outcome):
    """Return what an outcome has to say as HTML, whatever characters it is made of."""
    kind = "problem" if outcome.problem and not outcome.busy else "fine"
    words = html.escape(status_words(outcome))
    # with the focus, by a finger or the Tab key, it unfolds over the pictures
    return f'<div role="status" aria-label="Status" tabindex="0" class="{kind}" title="{words}">{words}</div>'


COMPILING = "Compiling the solver for this computer; it takes some seconds, at the first start only …"


MORE_THAN_SIMPLIFIED = "vehicle, axles or ground stand here, so that its force takes longer"
"""Why a force takes longer than that of the simplified model."""


def status_words(outcome):
    """Return what an outcome has to say.

    Parameters
    ----------
    outcome : Outcome
        How the solver fares.
    """
    if outcome.compiling:
        return COMPILING
    if outcome.progress is not None:
        return "Solving a long record …"
    if outcome.problem and not outcome.busy:
        return outcome.problem
    if outcome.summary is None:
        return "Solving …" if outcome.busy else "Not solved yet"
    summary = outcome.summary
    took = formats.duration_text(summary.seconds)
    if summary.solution.fidelity == "exact":
        # where little is lost the force takes longer, and where many share the server drawing it does
        simple = summary.design == summary.design.simplified
        when = "its force follows when the inputs rest" if simple else MORE_THAN_SIMPLIFIED
        words = f"Exact curve; {when}"
    elif summary.solution.fidelity == "live":
        words = f"Live run, solved in {took}; the paper's run follows when the inputs rest"
    elif outcome.from_cache:
        words = "Paper's run, solved before"
    else:
        words = f"Paper's run, solved in {took}"
    return " · ".join((words, *summary.solution.notes))
