"""What changes when each number of the design does."""

import panel as pn
import panel_material_ui as pmui

from dashboard import formats
from dashboard.fields import ASKED_FIELDS, FIELDS
from dashboard.figures.decide import ChangeFigure, TornadoFigure
from dashboard.session.answers import FIGURE_WORDS
from dashboard.views.components import caption, panel
from dashboard.views.decide.asked import Asked, beside
from dashboard.views.decide.inputs import MOST_CHANGE, NumberBox, ShareBoxes, choice


class WhatMatters(Asked):
    """What changes when each number does: band by band, and one figure at a time."""

    kind = "sensitivity"

    def __init__(self, snapshot, exchange):
        super().__init__(snapshot, exchange)
        self.change = NumberBox("Change, ± %", 10.0, "%", most=MOST_CHANGE, width=130)
        self.one_by_one = pmui.Checkbox(label="A change for each field", size="small", margin=(8, 12, 0, 0))
        self.changes_of = ShareBoxes(
            dict.fromkeys(FIELDS, 10.0), 10.0, exchange, changed=self.ask, visible=False
        )
        self.figure = choice(
            label="Figure",
            options={FIGURE_WORDS["margin"][0]: "margin"},
            width=230,
        )
        self.changes, self.tornado = ChangeFigure(), TornadoFigure()
        self.change.param.watch(self._change_all, "value")
        self.one_by_one.param.watch(self._offer_boxes, "value")
        self.figure.param.watch(self._draw, "value")
        snapshot.boxes.keep(change=self.change, one_by_one=self.one_by_one, change_of=self.figure)
        self.changes_of.keep(snapshot.boxes, "change")

    def _change_all(self, event):
        self.changes_of.change_all(event.new)
        self.ask()

    def _offer_boxes(self, event):
        self.changes_of.row.visible = event.new

    def offer(self):
        """Offer a change of each number that the current design has."""
        self.changes_of.offer(self.assessment.current.design)

    def settings(self):
        """Return what is asked about the current design."""
        changes = self.changes_of.shares(self.assessment.current.design)
        if not changes:
            raise ValueError("Give one change or more: with none, nothing changes.")
        return {"changes": changes}

    def show(self, result):
        """Draw the changes."""
        options = {FIGURE_WORDS[name][0]: name for name in result.figures}
        if list(self.figure.options) != list(options):
            self.figure.param.update(options=options, value=next(iter(options.values())))
            self.snapshot.boxes.put_waiting()
        labels = list(map(starred, result.fields))
        self.changes.show(labels, result.bands[:, 1])
        ranked = result.ranked(self.figure.value)
        rows = [result.fields.index(name) for name in ranked]
        words, scale = FIGURE_WORDS[self.figure.value]
        changes = result.differences[self.figure.value][rows] * scale
        self.tornado.show(list(map(starred, ranked)), changes, f"Change of: {words}")

    def words(self, result):
        """Return the answer in one sentence."""
        first = next(iter(result.figures))
        name, given = result.first(first)
        words, scale = FIGURE_WORDS[first]
        quantity, _, unit = words.partition(", ")
        less, more = scale * result.differences[first][result.fields.index(name)]
        change, label = f"{100 * result.changes[name]:.3g} %", ASKED_FIELDS[name].marked.lower()
        whose = "Of the track's own numbers, the" if given else "The"
        more_so = given and ASKED_FIELDS[given].marked.lower()
        rest = given and f" It depends more on the {more_so}, which no supplier of a track chooses."
        return (
            f"{whose} {quantity.lower()} depends most on the {label}: {change} less changes it "
            f"by {formats.change_text(less)} {unit}, {change} more by {formats.change_text(more)} {unit}."
            f"{rest}"
        )

    def build(self):
        """Return what is put on the page."""
        return panel(
            caption("What matters?", WHAT_MATTERS),
            pn.FlexBox(self.change, self.one_by_one, self.figure, margin=(0, 12)),
            self.changes_of.row,
            self.sentence,
            self.answered_row,
            beside(self.changes.model, self.tornado.model),
        )


def starred(name):
    """Return what a number is called beside a picture, with a star if it is not the track's own."""
    field = ASKED_FIELDS[name]
    return f"{field.label} *" if field.whose else field.label


WHAT_MATTERS = (
    "what changes when a number does; the map shows the change of insertion gain when it is more; "
    "* is the vehicle's or the site's"
)
