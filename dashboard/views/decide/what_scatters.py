"""Which tolerance the scatter of each figure is due to."""

import html

import numpy as np
import panel as pn

from dashboard import theme
from dashboard.session.answers import FIGURE_WORDS
from dashboard.views.decide.asked import Asked, scrolled
from dashboard.views.decide.inputs import factor_label


class WhatScatters(Asked):
    """Which tolerance the scatter of a figure is due to: Sobol indices over those of “How sure?”.

    Parameters
    ----------
    snapshot, exchange
        As for all questions.
    how_sure : HowSure
        Has the tolerances.
    """

    kind = "sobol"
    ages = True
    before = "Press “Which tolerance?”: it says how much of the scatter is due to each tolerance given above."

    def __init__(self, snapshot, exchange, how_sure):
        super().__init__(snapshot, exchange)
        self._how_sure = how_sure
        self.table = pn.pane.HTML("", stylesheets=[theme.SHARES_CSS], sizing_mode="stretch_width", margin=0)
        self.drawn = (self.table,)
        self.button.label = "Which tolerance?"

    def settings(self):
        """Return what is asked about the current design."""
        given = {name: each for name, each in self._how_sure.settings().items() if name != "samples"}
        design, figures = self.assessment.current.design, ["deflection", "loaded_track"]
        if self.assessment.source is not None:
            figures.insert(0, "level")
        if self.assessment.in_force is not None:
            figures.insert(0, "margin")
        if design.two_stage:
            figures.append("coupled_block")
        return given | {"figures": figures}

    def words(self, result):
        """Return the answer in one sentence."""
        words = FIGURE_WORDS[result.figures[0]][0].partition(",")[0].lower()
        place = int(np.nan_to_num(result.total_order[0]).argmax())
        total, alone = (100 * order[0, place] for order in (result.total_order, result.first_order))
        return (
            f"{total:.0f} % of the scatter of the {words} is due to the "
            f"{factor_label(result.factors[place])}, {alone:.0f} % to it alone."
        )

    def show(self, result):
        """List the parts of each figure's variance, as bars."""
        heads = "".join(
            f"<th scope='col'>{html.escape(FIGURE_WORDS[name][0].partition(',')[0])}</th>"
            for name in result.figures
        )
        rows = "".join(
            f"<tr><th scope='row'>{html.escape(factor_label(factor).capitalize())}</th>"
            + "".join(
                share_cell(result.total_order[row, column], *result.total_order_interval[row, column])
                for row in range(len(result.figures))
            )
            + "</tr>"
            for column, factor in enumerate(result.factors)
        )
        self.table.object = scrolled(
            "What the scatter is due to",
            f"<table><thead><tr><th>Part of the scatter of</th>{heads}</tr></thead>"
            f"<tbody>{rows}</tbody></table>"
            f"<p>Total-order Sobol indices with their 95 % intervals: interactions count for each that takes "
            f"part, so that a column may come to more than all. {result.samples} base samples, seed "
            f"{result.seed}.</p>",
        )

    def build(self):
        """Return what is put on the page."""
        return pn.Column(
            pn.FlexBox(self.button, self.progress, self.stop, margin=(0, 12)),
            self.sentence,
            self.answered_row,
            self.table,
            sizing_mode="stretch_width",
            margin=0,
        )


def share_cell(share, low, high):
    """Return a cell of a table that shows a part of a variance as a bar, with its interval."""
    if np.isnan(share):
        return "<td>–</td>"
    width = 100 * min(max(share, 0.0), 1.0)
    return (
        f"<td title='{100 * low:.0f} to {100 * high:.0f} %'><span class='bar' style='width: {width:.0f}px'>"
        f"</span>{100 * max(share, 0.0):.0f} %<br><small>{100 * low:.0f} to {100 * high:.0f}</small></td>"
    )
