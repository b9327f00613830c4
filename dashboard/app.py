"""Composition root: the one place where inputs, runner, controls and views meet.

The one rule: parts are made here and handed to each other; no part looks another up.
"""

import logging

import panel as pn
import panel_material_ui as pmui
import param
from panel.util import edit_readonly

from dashboard import style
from dashboard.checker import Checker
from dashboard.controls import Controls
from dashboard.runner import Runner, shared_live_store, shared_store
from dashboard.state import DesignInputs, Outcome, Presentation
from dashboard.views.explore import Explore
from dashboard.views.learn import Learn
from dashboard.views.method import Method
from dashboard.views.status import Status
from dashboard.views.verify import Verify

TITLE = "trackig"
SUBTITLE = "insertion gain of railway track supports, after Thornely-Taylor, Bewes and Sica (2021)"

log = logging.getLogger(__name__)


class Busy(param.Parameterized):
    """Whether this session is busy."""

    value = param.Boolean(default=False)


def build(store=None, live_store=None):
    """Make the page of one session.

    Parameters
    ----------
    store, live_store : SolutionStore, optional
        Where pictures come from, at rest and moving; by default those that all sessions share.

    Returns
    -------
    panel_material_ui.Page
        The page, its first design solved or being solved.
    """
    pn.extension("katex", notifications=True, reconnect=True, exception_handler=tell)
    inputs, outcome, presentation = DesignInputs(), Outcome(), Presentation()
    runner = Runner(inputs, outcome, store or shared_store(), live_store or shared_live_store())
    runner.start()
    Checker(outcome)
    pn.state.on_session_destroyed(runner.close)
    views = [
        Explore(outcome, presentation),
        Learn(inputs, outcome, presentation),
        Verify(outcome, presentation),
        Method(),
    ]
    return page(Controls(inputs), Status(outcome, runner.stop, runner.solve_again), tabs(outcome, views))


def tabs(outcome, views):
    """Return the views as tabs; what is worked out only while looked at is told when it comes into sight."""
    shown = pmui.Tabs(*((view.title, view) for view in views), sizing_mode="stretch_width", margin=0)

    def tell_views(event):
        outcome.checking = isinstance(views[event.new], Verify)
        for view in views:
            if isinstance(view, Learn):
                view.look(view is views[event.new])

    shown.param.watch(tell_views, "active")
    return shown


def page(controls, status, main):
    """Return the page around controls, status line and tabs."""
    whole = pmui.Page(
        title=TITLE,
        header=[pmui.Typography(SUBTITLE, variant="body1", sx=style.SUBTITLE, margin=(4, 0, 0, 16))],
        sidebar=[controls],
        main=[status, main],
        sidebar_width=style.SIDEBAR_WIDTH,
        theme_config=style.THEME,
        sx=style.PAGE,
        meta_description=f"{TITLE}: {SUBTITLE}",
    )
    # the page would follow a flag that all sessions of the process share, and would never let go of it
    with edit_readonly(whole):
        whole.busy = Busy().param.value
    return whole


def tell(error):
    """Log an exception that escaped a callback, and tell the user so in plain words."""
    log.error("A callback failed", exc_info=error)
    if pn.state.notifications is not None:
        pn.state.notifications.error("Something went wrong; the server's log has the details.", duration=8000)
