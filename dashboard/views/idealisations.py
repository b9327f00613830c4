"""What the assumptions behind insertion gain cost a design: damping, the rail, and the choice of bands."""

import numpy as np
import panel as pn
import panel_material_ui as pmui
from panel.viewable import Viewer

from dashboard import formats, theme
from dashboard.compute.document import NextTick
from dashboard.compute.idealisations import Idealisations
from dashboard.figures.idealisations import LOOKS, IdealisationFigure
from dashboard.views.components import PAPER, bokeh_pane, caption, gain_axis, words

CHOICES = {words[0].upper() + words[1:]: name for name, (_, _, words) in LOOKS.items()}
"""What may be drawn beside the solution, by its words."""


class IdealisationsView(Viewer):
    """A figure, what is drawn in it, and what each assumption changes in words.

    Parameters
    ----------
    outcome : Outcome
        Whose design is meant.
    definition : GainDefinition
        Which insertion gain is meant.
    """

    def __init__(self, outcome, definition):
        super().__init__()
        self._definition = definition
        self.idealisations = Idealisations(outcome, definition)
        self.figure = IdealisationFigure()
        self.chosen = pn.widgets.CheckBoxGroup(
            label="Drawn beside it",
            options=CHOICES,
            value=[],
            inline=True,
            sizing_mode="stretch_width",
            margin=(0, 12, 4, 12),
            stylesheets=[theme.CHECKS_CSS],
        )
        self.bands = pn.widgets.Select.from_param(
            definition.param.bands,
            width=320,
            margin=(0, 12, 0, 12),
            stylesheets=[theme.SELECT_CSS],
        )
        self.words = words()
        show = NextTick(self._show)
        self.chosen.param.watch(show, "value")
        self.idealisations.param.watch(show, "found")

    def look(self, in_sight):
        """Note whether anybody looks: only then is anything computed."""
        self.idealisations.looked_at = in_sight

    def _show(self):
        found = self.idealisations.found
        if found is not None:
            self.figure.name_axis(gain_axis(self._definition))
            self.figure.show(found, self.chosen.value)
            self.words.object = cost_words(found)

    def __panel__(self):
        """Return what is put on the page."""
        return pmui.Paper(
            pmui.Row(
                caption("What the assumptions cost this design", ""),
                pn.HSpacer(),
                self.bands,
                sizing_mode="stretch_width",
            ),
            self.chosen,
            bokeh_pane(self.figure.layout),
            self.words,
            **PAPER,
        )


def cost_words(found):
    """Return by how much each other assumption changes the insertion gain, in words (Idealised)."""
    parts = [
        f"{COSTS[name]} changes it by up to {_largest(levels - found.levels, found.bands.labels)}"
        for name, levels in found.otherwise.items()
    ]
    sentence = f"{parts[0][0].upper()}{'; '.join(parts)[1:]}. " if parts else ""
    notes = "".join(f" {note[0].upper()}{note[1:]}." for note in found.notes)
    return (
        f"{sentence}Neither is in the figures of the other tabs. The single-degree formula puts the wheel on "
        "as many supports as carry it, against a rigid track: it knows no waves along the rail, no contact "
        f"spring and no block.{notes}"
    )


COSTS = {
    "hysteretic": "damping that no frequency changes, k (1 + i η), which is not causal,",
    "timoshenko": "a rail that shears and has rotary inertia",
}
"""Each other assumption in words."""


def _largest(differences, labels):
    place = int(np.argmax(np.abs(differences)))
    return f"{formats.level_text(differences[place])} at {labels[place]} Hz"
