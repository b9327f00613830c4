"""How the track answers a hammer: receptance or mobility, and track decay rate, of all shown designs."""

import datetime

import panel as pn
import panel_material_ui as pmui
from panel.viewable import Viewer

from dashboard import theme
from dashboard.compute.document import NextTick
from dashboard.figures.track_response import DecayRateFigure, PointResponseFigure
from dashboard.persistence.exports import decay_rate_csv, file_name, point_response_csv
from dashboard.session.heading import Heading
from dashboard.views.components import bokeh_pane, caption, panel


class TrackResponseView(Viewer):
    """Two figures, and their curves as files.

    Parameters
    ----------
    assessment : Assessment
        Whose shown designs are drawn.
    responses : TrackResponses
        Their responses.
    snapshot : SessionSnapshot
        What files say of the study.
    exchange : Exchange
        Saves files.
    """

    def __init__(self, assessment, responses, snapshot, exchange):
        super().__init__()
        self._assessment, self._responses = assessment, responses
        self._snapshot, self._exchange = snapshot, exchange
        self.points, self.decay = PointResponseFigure(), DecayRateFigure()
        self.quantity = pn.widgets.Select(
            label="Over frequency",
            options={"Receptance": "receptance", "Mobility": "mobility"},
            width=160,
            margin=(0, 12, 0, 12),
            stylesheets=[theme.SELECT_CSS],
        )
        self.save_points = _button("Curves (CSV)", self._save_points)
        self.save_decay = _button("Decay rates (CSV)", self._save_decay)
        show = NextTick(self._show)
        responses.param.watch(show, "responses")
        assessment.param.watch(show, "results")
        self.quantity.param.watch(show, "value")
        show()

    @property
    def _drawn(self):
        """The results that are shown and whose responses are there."""
        known = self._responses.responses
        return tuple(each for each in self._assessment.shown if each.design in known)

    def _show(self):
        drawn = self._drawn
        if not self._responses.looked_at or not drawn:
            return
        self.points.show(drawn, self._responses.responses, self.quantity.value)
        self.decay.show(drawn, self._responses.responses)

    def _save_points(self, *_):
        self._save("track-response.csv", point_response_csv)

    def _save_decay(self, *_):
        self._save("decay-rate.csv", decay_rate_csv)

    def _save(self, suffix, write):
        drawn = self._drawn
        if drawn:
            heading = Heading.of(self._snapshot.study(), drawn, datetime.date.today())
            pairs = [(each.name, self._responses.responses[each.design]) for each in drawn]
            name = file_name(self._assessment.title, heading.design, suffix)
            self._exchange.save(name, write(pairs, heading))

    def __panel__(self):
        """Return what is put on the page."""
        parts = (
            ("Track response", POINT_WORDS, (self.quantity, self.save_points), self.points),
            ("Track decay rate", DECAY_WORDS, (self.save_decay,), self.decay),
        )
        panels = (
            panel(
                pn.Row(caption(title, words), pn.HSpacer(), *controls, sizing_mode="stretch_width"),
                bokeh_pane(figure.layout),
            )
            for title, words, controls, figure in parts
        )
        return pn.Column(*panels, stylesheets=[theme.FITTING_CSS], sizing_mode="stretch_width", margin=0)


POINT_WORDS = "the wheel away, 24 elements a bay; thick over a support, thin half-way between two"
DECAY_WORDS = "EN 15461, 25 Hz to 1 kHz; thick over a support, thin between two; dotted: longest-lived wave"


def _button(label, on_click):
    return pmui.Button(
        label=label,
        icon="download",
        size="small",
        variant="outlined",
        on_click=on_click,
        margin=(4, 12, 4, 0),
    )
