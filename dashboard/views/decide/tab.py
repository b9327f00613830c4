"""The tab that helps to decide: how far, what matters, how sure, which one.

Each answer ends in one sentence that can be read aloud. What takes milliseconds is answered by itself while
the tab is in sight and the design rests; what takes seconds is asked with a button, shows its progress, and
can be stopped.
"""

import panel_material_ui as pmui

from dashboard import theme
from dashboard.client.exchange import notify
from dashboard.session.inputs import values_of
from dashboard.session.pins import PinError
from dashboard.session.special import six_figures_of
from dashboard.views.components import caption, panel
from dashboard.views.decide.design_map import Map
from dashboard.views.decide.how_far import HowFar
from dashboard.views.decide.how_sure import HowSure
from dashboard.views.decide.kept_answers import KeptAnswers
from dashboard.views.decide.search import Search
from dashboard.views.decide.what_matters import WhatMatters
from dashboard.views.decide.what_scatters import WhatScatters
from dashboard.views.tab import Tab


class Decide(Tab):
    """Four questions about the current design.

    Parameters
    ----------
    snapshot : SessionSnapshot
        The session: what is asked about, and what a design that is found is taken to.
    exchange : Exchange
        Where files go.
    feasibility : Feasibility
        Where the current design complies, which the sliders show too.
    production : Production
        Where insertion gain of production is left for others to draw.
    shelf : Shelf
        The catalogue from which a search may choose.
    """

    title = "Decide"
    link_name = "decide"

    def __init__(self, snapshot, exchange, feasibility, production, shelf):
        super().__init__()
        self._inputs, self._pins, self._boxes = snapshot.inputs, snapshot.pins, snapshot.boxes
        self.how_far = HowFar(snapshot, exchange, feasibility)
        self.what_matters = WhatMatters(snapshot, exchange)
        self.how_sure = HowSure(snapshot, exchange, production)
        self.what_scatters = WhatScatters(snapshot, exchange, self.how_sure)
        self.map = Map(snapshot, exchange, self._take)
        self.search = Search(snapshot, exchange, self._take, self._pin, shelf)
        self.kept = KeptAnswers(snapshot.answers, exchange)
        snapshot.assessment.param.watch(self.refresh, "results")
        snapshot.boxes.param.watch(self._note_ages, "typed")

    def refresh(self, *_):
        """Offer what the current design has, and answer for it what takes milliseconds."""
        if self.in_sight:
            for part in (self.what_matters, self.how_sure, self.map, self.search):
                part.offer()
            self._boxes.put_waiting()
            self.what_matters.ask()
            self._note_ages()

    def _note_ages(self, *_):
        for part in (self.what_matters, self.how_sure, self.what_scatters, self.map, self.search):
            part.note_age()

    def _take(self, design, given):
        self._inputs.take(values_of(six_figures_of(design, given)))

    def _pin(self, design, given, name):
        try:
            # as the sliders show it: a study of it opens as it was saved
            pin = self._pins.add(six_figures_of(design, given), name, self._inputs.preset)
        except PinError as problem:
            notify("warning", str(problem))
        else:
            notify("success", f"Pinned as “{pin.name}”. See the tab Compare.")

    def fill(self, place):
        """Put one question after the other into its place."""
        which = pmui.Tabs(
            *(("Map", self.map.build()), ("Search", self.search.build())),
            sizing_mode="stretch_width",
            margin=(0, 8),
            sx=theme.TABS,
        )
        parts = (
            self.how_far.build(),
            self.what_matters.build(),
            self.how_sure.build(),
            panel(caption("Which tolerance?", WHICH_TOLERANCE), self.what_scatters.build()),
            panel(caption("Which one?", WHICH_ONE), which),
            panel(caption("Kept answers", KEPT), self.kept),
        )
        for part in parts:
            part.margin = (0, 8, 8, 8)
            place.append(part)
            yield


WHICH_TOLERANCE = "what the scatter is due to, each with all that it does together with others"
KEPT = "part of the study and of the report, a page each"
WHICH_ONE = "designs over two numbers, or a search over several"
