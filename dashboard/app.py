"""Composition root: the one place where inputs, runner, controls and views meet.

Parts are made here and handed to each other; no part looks another up.
"""

import logging
from functools import partial
from itertools import chain

import panel as pn
import panel_material_ui as pmui
import param
from panel.util import edit_readonly

from dashboard import theme
from dashboard.client.browser import Browser
from dashboard.client.exchange import HANDLING_FAILED, Exchange, notify
from dashboard.compute import delivery
from dashboard.compute.checker import VerificationRunner
from dashboard.compute.document import in_turns
from dashboard.compute.feasibility import Feasibility
from dashboard.compute.pacing import PACE
from dashboard.compute.pinned import PinnedSummaries
from dashboard.compute.responses import TrackResponses
from dashboard.compute.runner import Runner
from dashboard.compute.workers import shared_live_store, shared_store
from dashboard.persistence.snapshot import SessionSnapshot
from dashboard.session.assessment import Assessment
from dashboard.session.inputs import DesignInputs, GainDefinition
from dashboard.session.measuring import Measuring
from dashboard.session.pins import Pins
from dashboard.session.production import Production
from dashboard.session.results import Outcome
from dashboard.session.shelf import Shelf
from dashboard.views.compare import Compare
from dashboard.views.decide.tab import Decide
from dashboard.views.design_bar import DesignBar
from dashboard.views.explore import Explore
from dashboard.views.learn import Learn
from dashboard.views.measured import Measured
from dashboard.views.method import Method
from dashboard.views.received_level import ReceivedLevel
from dashboard.views.save_and_share import SaveAndShare, copy_button
from dashboard.views.sidebar import Controls
from dashboard.views.specification import SpecificationView
from dashboard.views.status import Status
from dashboard.views.track import Track
from dashboard.views.track_response import TrackResponseView
from dashboard.views.verify import Verify

TITLE = "trackig"
SUBTITLE = "insertion gain of railway track supports, after Thornely-Taylor, Bewes and Sica (2021)"

CONNECTION_LOST = (
    "The connection to the server is lost. The design, the pins, all else that a study holds and what stands "
    "in the boxes of Decide and of the report come back with the server. What you change until then does "
    "not, nor do answers that were not kept."
)

log = logging.getLogger(__name__)

delivery.install()


class Busy(param.Parameterized):
    """Whether this session is busy."""

    value = param.Boolean(default=False)


def build(store=None, live_store=None):
    """Make the page of one session.

    Parameters
    ----------
    store, live_store : SolutionStore, optional
        Where solutions come from, at rest and moving; by default those that all sessions share.

    Returns
    -------
    panel_material_ui.Page
        The page, its first design solved or being solved.
    """
    pn.extension(
        "katex",
        notifications=True,
        reconnect=False,
        exception_handler=report_error,
        disconnect_notification=CONNECTION_LOST,
    )
    inputs, outcome, definition, pins = DesignInputs(), Outcome(), GainDefinition(), Pins()
    store, live_store = store or shared_store(), live_store or shared_live_store()
    pinned = PinnedSummaries(pins, store, live_store)
    assessment = Assessment(inputs, outcome, definition, pins, pinned)
    snapshot = SessionSnapshot(inputs, definition, pins, assessment, [tab.link_name for tab in TABS])
    problems = snapshot.follow(pn.state.session_args)
    runner = Runner(inputs, outcome, store, live_store, PACE)
    runner.start()
    checker = VerificationRunner(outcome)
    feasibility, production = Feasibility(inputs, definition, assessment), Production()
    pn.state.on_session_destroyed(runner.close)
    pn.state.on_session_destroyed(pinned.close)
    measuring, shelf = Measuring(), Shelf()
    browser, exchange = Browser(width=0, height=0, margin=0), Exchange(snapshot, shelf, PACE)

    def edit_curve(name):
        measuring.param.update(part=name.split("_")[0], reading=None, answered=False)
        snapshot.tab = Track.link_name
        exchange.reveal(Measured.place)

    def show_insertion_gain():
        snapshot.tab = Explore.link_name

    responses = TrackResponses(assessment)

    def show_track():
        response = TrackResponseView(assessment, responses, snapshot, exchange)
        return Track(inputs, outcome, measuring, shelf, exchange, response, responses.look)

    makers = {
        Explore: partial(Explore, outcome, definition, pins, assessment, production),
        Compare: partial(Compare, inputs, pins, definition, assessment, show_insertion_gain, exchange),
        SpecificationView: partial(SpecificationView, assessment, exchange),
        Decide: partial(Decide, snapshot, exchange, feasibility, production, shelf),
        ReceivedLevel: partial(ReceivedLevel, assessment, pins, exchange),
        Track: show_track,
        Learn: partial(Learn, inputs, outcome, definition),
        Verify: partial(Verify, outcome, definition, checker.look),
        Method: Method,
        SaveAndShare: partial(SaveAndShare, snapshot, exchange),
    }
    bar_place = pn.Column(sizing_mode="stretch_width", min_height=theme.DESIGN_BAR_HEIGHT, margin=0)
    status_place = pn.Column(sizing_mode="stretch_width", min_height=theme.STATUS_HEIGHT, margin=(4, 8, 0, 8))
    bar = partial(DesignBar, inputs, pins, snapshot.steps, browser)
    status = partial(Status, outcome, runner.stop, runner.request)
    in_turns(put(exchange, bar_place, bar), report_error)
    last = chain(put(exchange, status_place, status), notify_of_problems(problems))
    shown = tabs(snapshot, makers, exchange, last)
    controls = Controls(inputs, outcome, shelf, edit_curve, feasibility)
    # what is said before there is a browser is lost: that of a page that was made ahead
    pn.state.onload(exchange.introduce)
    return page([bar_place, controls], status_place, shown, browser, exchange)


def put(exchange, place, make):
    """Make a part in its place, as one step, and prepare the browser for it.

    Parameters
    ----------
    exchange : Exchange
        Prepares the browser.
    place : panel.Column
        Where the part goes.
    make : callable
        Makes it.
    """
    place.objects = [make()]
    exchange.introduce()
    yield


TABS = (
    Explore,
    Compare,
    SpecificationView,
    Decide,
    ReceivedLevel,
    Track,
    Learn,
    Verify,
    Method,
    SaveAndShare,
)
"""The tabs, in their order."""


def tabs(snapshot, makers, exchange, last):
    """Return the tabs; each view is made when it is first looked at, and told whether it is in sight.

    A page with all of them would take several times as long to open.

    Parameters
    ----------
    snapshot : SessionSnapshot
        Which tab is open.
    makers : mapping of type to callable
        How each of :data:`TABS` is made.
    exchange : Exchange
        Prepares the browser for what is added.
    last : iterator
        Steps that follow when the first view is there.
    """
    places = [pn.Column(stylesheets=[theme.OPENING_CSS], sizing_mode="stretch_width", margin=0) for _ in TABS]
    titled = zip((tab.title for tab in TABS), places, strict=True)
    shown = pmui.Tabs(*titled, sizing_mode="stretch_width", margin=0, sx=theme.TABS)
    # Panel makes a pane of each title that is plain text, and shows none of them
    shown._headers = []
    views, begun = {}, set()

    def look(*_, steps_after=()):
        kind = TABS[shown.active]
        snapshot.tab = kind.link_name
        for each, view in views.items():
            view.look(each is kind)
        if kind not in begun:
            begun.add(kind)
            in_turns(chain(open_view(kind, places[shown.active]), steps_after), report_error)

    def open_view(kind, place):
        view = views[kind] = makers[kind]()
        view.look(kind is TABS[shown.active])
        yield
        place.stylesheets = []
        for _ in view.fill(place):
            exchange.introduce()
            yield

    def open_tab(*_):
        shown.active = [tab.link_name for tab in TABS].index(snapshot.tab)

    open_tab()
    look(steps_after=last)
    shown.param.watch(look, "active")
    snapshot.param.watch(open_tab, "tab")
    return shown


def notify_of_problems(problems):
    """Say what of a link could not be followed, as a step: in one message, since more would cover plots."""
    if problems:
        notify("warning", " ".join(problems))
        yield


def page(sidebar, status, main, browser, exchange):
    """Return the page around sidebar, status line and tabs; its theme is the one that the browser keeps."""
    whole = pmui.Page(
        title=TITLE,
        header=[
            pmui.Typography(SUBTITLE, variant="body1", sx=theme.SUBTITLE, margin=(10, 0, 0, 16)),
            pn.HSpacer(),
            copy_button(),
            browser,
            exchange,
        ],
        sidebar=sidebar,
        main=[status, main],
        sidebar_width=theme.SIDEBAR_WIDTH,
        theme_config=theme.THEME,
        sx=theme.PAGE,
        meta_description=f"{TITLE}: {SUBTITLE}",
    )
    # the page would follow a flag that all sessions of the process share, and would never let go of it
    with edit_readonly(whole):
        whole.busy = Busy().param.value
    whole._preprocess = partial(look_through, whole)
    return whole


def look_through(whole, root, changed=None, old_models=None):
    """Look through what was added to the page for callbacks in the browser, and not the whole page each time.

    Parameters
    ----------
    whole : panel.viewable.Viewable
        The page, looked through before it is shown.
    root : bokeh.model.Model
        Its model.
    changed : panel.viewable.Viewable, optional
        The part that something was added to.
    old_models : list of bokeh.model.Model, optional
        Models that the part had before.
    """
    part = whole if changed is None else changed
    type(part)._preprocess(part, root, part, old_models)


def report_error(error):
    """Log an exception that escaped a callback, and say so in plain words."""
    log.error("A callback failed", exc_info=error)
    notify("error", HANDLING_FAILED)
