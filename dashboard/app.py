"""Composition root: the one place where inputs, runner, controls and views meet.

The one rule: parts are made here and handed to each other; no part looks another up.
"""

import logging

import panel as pn
import panel_material_ui as pmui
import param
from panel.util import edit_readonly

from dashboard import style
from dashboard.browser import Browser
from dashboard.checker import Checker
from dashboard.controls import Controls
from dashboard.curves import PinnedCurves
from dashboard.pinned import PinnedPictures
from dashboard.pins import Pins
from dashboard.runner import Runner, shared_live_store, shared_store
from dashboard.state import DesignInputs, Outcome, Presentation
from dashboard.views.compare import Compare
from dashboard.views.design_bar import DesignBar
from dashboard.views.explore import Explore
from dashboard.views.status import Status
from dashboard.views.track import Track
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
    pn.extension(notifications=True, reconnect=True, exception_handler=tell)
    inputs, outcome, presentation = DesignInputs(), Outcome(), Presentation()
    store = store or shared_store()
    runner = Runner(inputs, outcome, store, live_store or shared_live_store())
    runner.start()
    Checker(outcome)
    pins = Pins()
    pinned = PinnedPictures(pins, store)
    curves = PinnedCurves(pins, pinned, presentation)
    pn.state.on_session_destroyed(runner.close)
    pn.state.on_session_destroyed(pinned.close)
    browser = Browser(width=0, height=0, margin=0)

    def show_insertion_gain():
        shown.active = 0

    views = [
        Explore(outcome, presentation, pins, curves),
        Compare(inputs, outcome, presentation, pins, pinned, curves, show_insertion_gain),
        Track(inputs, outcome),
        Verify(outcome, presentation),
    ]
    shown = tabs(outcome, views)
    status = Status(outcome, runner.stop, runner.solve_again)
    return page([DesignBar(inputs, pins, browser), Controls(inputs)], status, shown, browser)


def tabs(outcome, views):
    """Return the views as tabs; those that work only while somebody looks are told when they are in sight."""
    shown = pmui.Tabs(*((view.title, view) for view in views), sizing_mode="stretch_width", margin=0)

    def tell_outcome(event):
        outcome.checking = isinstance(views[event.new], Verify)
        for view in views:
            if isinstance(view, (Compare, Track)):
                view.look(view is views[event.new])

    shown.param.watch(tell_outcome, "active")
    return shown


def page(sidebar, status, main, browser):
    """Return the page around sidebar, status line and tabs; its theme is the one that the browser keeps."""
    whole = pmui.Page(
        title=TITLE,
        header=[
            pmui.Typography(SUBTITLE, variant="body1", sx=style.SUBTITLE, margin=(4, 0, 0, 16)),
            browser,
        ],
        sidebar=sidebar,
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
