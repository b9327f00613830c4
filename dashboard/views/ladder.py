"""The subject of the *Learn* tab that puts back what the simplified model leaves out of a design."""

import html

import panel as pn

import trackig_core as tig
from dashboard import formats, theme
from dashboard.figures.ladder import RUNGS, DifferencesFigure, LadderFigure, every_model
from dashboard.teaching import left_out
from dashboard.views.components import bokeh_pane, words
from dashboard.views.subjects import Subject, panel_of, say

HEADINGS = ("Model", "Numbers from", "Moves most", "In band")


class LeftOut(Subject):
    """The paper's Figure 1 for the current design: vehicle, axles and ground put back one after the other."""

    title = "What was left out"

    def __init__(self, outcome, definition):
        super().__init__(outcome, definition)
        self.figure, self.differences, self.words = LadderFigure(), DifferencesFigure(), words()
        self.vehicle = _choice("Vehicle put back", tig.VEHICLES, left_out.OPENING_VEHICLE)
        self.ground = _choice("Ground put back", tig.GROUNDS, left_out.OPENING_GROUND)
        self.own = words(size=14, margin=(0, 14))
        self.table = pn.pane.HTML("", stylesheets=[theme.SLOPES_CSS], margin=(0, 14))
        for choice in (self.vehicle, self.ground):
            choice.param.watch(self._follow, "value")
        self._follow()

    def ask(self, design):
        """Return the question about a design."""
        self._offer(design)
        return left_out.left_out, design, self.vehicle.value, self.ground.value, self.definition.summation

    def _offer(self, design):
        """Offer what the design leaves open, and say what it does not."""
        axles = len(design.axle_positions) > 1
        self.vehicle.disabled = design.suspension is not None and axles
        self.ground.disabled = design.ground is not None
        given = {"suspension": design.suspension is not None, "axles": axles, "ground": self.ground.disabled}
        named = [name for name, is_given in given.items() if is_given]
        self.own.object = f"The design has its own: {', '.join(named)}." if named else ""

    def show(self, answer):
        """Draw the rungs, and say what they cost."""
        self.figure.show_ladder(answer.ladder)
        self.differences.show_ladder(answer.ladder)
        self.table.object = ladder_html(answer.ladder)
        say(self.words, answer.words)

    def __panel__(self):
        """Return what is put on the page."""
        return panel_of(
            "What the simplified model leaves out",
            pn.Row(self.vehicle, self.ground, margin=0),
            self.own,
            self.problem,
            bokeh_pane(self.figure.model),
            bokeh_pane(self.differences.model),
            self.table,
            self.words,
            explanation="put back one by one; below, what each moves from the simplified model, dB",
        )


def _choice(label, catalogue, value):
    return pn.widgets.Select(
        label=label,
        options=list(catalogue),
        value=value,
        width=220,
        margin=(0, 12, 0, 12),
        stylesheets=[theme.SELECT_CSS],
    )


def ladder_html(ladder):
    """Return the rungs as a table: what is put back, from where, and the band that it moves most."""
    head = "".join(f'<th scope="col">{each}</th>' for each in HEADINGS)
    rows = "".join(
        "<tr>" + "".join(f"<td>{html.escape(each)}</td>" for each in _row(rung)) + "</tr>"
        for rung in every_model(ladder)[1:]
    )
    return (
        "<table><caption>Largest difference from the simplified model, over all bands</caption>"
        f"<thead><tr>{head}</tr></thead><tbody>{rows}</tbody></table>"
    )


def _row(rung):
    return (
        RUNGS[rung.name].words,
        rung.source,
        formats.level_text(rung.largest),
        f"{rung.largest_band} Hz",
    )
