"""The tab in which a track is understood: a menu of subjects, of which one is looked at.

A subject is made when it is first looked at, and its questions are answered only while it is.
"""

from functools import partial

import panel as pn
import panel_material_ui as pmui

from dashboard import theme
from dashboard.views.ladder import LeftOut
from dashboard.views.lessons import Lessons
from dashboard.views.motion import Motion
from dashboard.views.subjects import Damping, Definitions, LumpedVsBeam, Resonances, Slopes
from dashboard.views.tab import Tab

EXPLAINING = (Motion, Resonances, Slopes, Damping, Definitions, LumpedVsBeam, LeftOut)
"""Subjects beside the lessons, in the order of the menu."""


class Learn(Tab):
    """Lessons, and the subjects behind them.

    Parameters
    ----------
    inputs : DesignInputs
        The sliders that lessons set.
    outcome : Outcome
        Whose design is explained.
    definition : GainDefinition
        How insertion gain is computed.
    """

    title = "Learn"
    link_name = "learn"

    def __init__(self, inputs, outcome, definition):
        super().__init__()
        self._makers = {
            "Lessons": partial(Lessons, outcome, definition, inputs),
            **{kind.title: partial(kind, outcome, definition) for kind in EXPLAINING},
        }
        self._made = {}
        self._places = {
            title: pn.Column(stylesheets=[theme.OPENING_CSS], sizing_mode="stretch_width", margin=0)
            for title in self._makers
        }
        self.menu = pmui.Tabs(
            *self._places.items(), sizing_mode="stretch_width", margin=(0, 8, 8, 8), sx=theme.TABS
        )
        self.menu.param.watch(self._turn, "active")

    @property
    def subject(self):
        """The subject that the menu stands at, made if it has not been."""
        title = list(self._makers)[self.menu.active]
        if title not in self._made:
            self._made[title] = made = self._makers[title]()
            # drawn before it is put on the page: the browser lays it out once
            made.question.param.watch(partial(self._put, self._places[title], made), "answered")
        return self._made[title]

    def refresh(self):
        """Have the subject's question answered while the tab is in sight, and none out of sight."""
        self._turn()

    def _turn(self, *_):
        seen = self.subject if self.in_sight else None
        for subject in self._made.values():
            subject.question.looked_at = subject is seen

    def _put(self, place, subject, _):
        if not place.objects:
            place.stylesheets = []
            place.append(subject)

    def build(self):
        """Return what is put on the page."""
        return self.menu
