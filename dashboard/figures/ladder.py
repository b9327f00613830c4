"""The ladder of simplification: insertion gain rung by rung, and what each rung moves per band.

Blue is the simplified model, whose insertion gain the page shows while nothing else is chosen; what is put
back has colours of its own, and the one-dimensional model is dashed. dB, Hz.
"""

import numpy as np
from bokeh.models import ColumnDataSource, CustomJS, FactorRange, HoverTool, LinearColorMapper
from bokeh.palettes import RdBu11

import trackig_core as tig
from dashboard import formats, theme
from dashboard.figures.axes import blank_figure, show_bands
from dashboard.figures.learn import BandsFigure, Curve

SIMPLIFIED, ONE_DIMENSIONAL = "the simplified model", "the rail left out"
"""Names of the first rung and of the model beside the ladder, as the core calls them."""

RUNGS = {
    SIMPLIFIED: Curve("simplified", "simplified model", theme.THIS_DESIGN, width=theme.LINE_WIDTH),
    "measured damping": Curve("damping", "+ measured damping", theme.COUPLED_BLOCK, [2, 3]),
    "suspension": Curve("suspension", "+ suspension", theme.THEORY),
    "other axles": Curve("axles", "+ other axles", theme.COUPLED_BLOCK),
    "ground": Curve("ground", "+ ground", theme.LOADED_TRACK, width=theme.LINE_WIDTH),
    ONE_DIMENSIONAL: Curve("lumped", "one-dimensional: no rail", theme.PRESET_GHOST, theme.SECOND_DASH),
}
"""How each rung looks, by the name that the core gives it."""

FULL = 6.0
"""Difference from which a cell has its full colour [dB]."""

DARK = 0.7
"""Part of the full colour from which the figure in a cell is white [-]."""

LABEL_ROOM = 190
"""Room for the names of the rungs, so that both figures have their bands below each other [px]."""

UPRIGHT = 34
"""Width of a cell in which its figure stands upright; in a narrower one it is turned [px]."""

HEAT_HEIGHT = 38
"""Height of a row of cells [px]."""


class LadderFigure(BandsFigure):
    """Insertion gain of every rung; its source is named ``left_out``."""

    def __init__(self):
        super().__init__("left_out", list(RUNGS.values()), "IG, dB (stiff)")

        self.model.min_border_left = LABEL_ROOM

    def show_ladder(self, ladder):
        """Draw a trackig_core.analysis.Ladder."""
        self.show(**{RUNGS[rung.name].column: rung.insertion_gain for rung in every_model(ladder)})


class DifferencesFigure:
    """What each rung moves from the simplified model, per band: a row of cells a rung.

    Attributes
    ----------
    model : bokeh.plotting.figure
        The figure.
    cells : bokeh.models.ColumnDataSource
        Named ``left_out_cells``: ``rung``, ``band``, ``left`` and ``right`` and ``centre`` [Hz],
        ``difference`` [dB], ``text`` and ``ink``, the colour of the text.
    """

    def __init__(self):
        columns = ("rung", "band", "left", "right", "centre", "difference", "text", "ink")
        self.cells = ColumnDataSource(name="left_out_cells", data={each: [] for each in columns})
        self.rungs = FactorRange()
        self.model = blank_figure(
            name="left_out_cells_figure",
            x_axis_type="log",
            y_range=self.rungs,
            x_axis_label="One-third-octave band, Hz",
            y_axis_label="",
            aria_label="Difference of each rung from the simplified model, dB, per band",
        )
        show_bands(self.model, every=2)
        self.model.min_border_left = LABEL_ROOM
        self.model.ygrid.visible = False
        colours = LinearColorMapper(palette=RdBu11, low=-FULL, high=FULL)
        drawn = self.model.hbar(
            y="rung",
            left="left",
            right="right",
            height=0.94,
            source=self.cells,
            fill_color={"field": "difference", "transform": colours},
            line_color=None,
        )
        figures = self.model.text(
            x="centre",
            y="rung",
            text="text",
            source=self.cells,
            text_color="ink",
            text_align="center",
            text_baseline="middle",
            text_font_size=theme.CELL_SIZE,
        )
        turning = f"glyph.angle = cb_obj.inner_width < {UPRIGHT * len(tig.BAND_LABELS)} ? Math.PI / 2 : 0"
        self.model.js_on_change("inner_width", CustomJS(args={"glyph": figures.glyph}, code=turning))
        self.model.add_tools(
            HoverTool(
                renderers=[drawn],
                tooltips=[("rung", "@rung"), ("band", "@band Hz"), ("moves by", "@difference{+0.00} dB")],
            )
        )

    def show_ladder(self, ladder):
        """Draw the cells of a trackig_core.analysis.Ladder, the first thing put back on top."""
        rungs = [rung for rung in every_model(ladder) if rung.name != SIMPLIFIED]
        bands, difference = len(tig.BAND_LABELS), np.concatenate([rung.difference for rung in rungs])
        names = [RUNGS[rung.name].words for rung in rungs]
        self.rungs.factors = names[::-1]
        self.model.height = HEAT_HEIGHT * len(rungs) + 70
        self.cells.data = {
            "rung": np.repeat(names, bands).tolist(),
            "band": list(tig.BAND_LABELS) * len(rungs),
            "left": np.tile(tig.BAND_EDGES[:-1], len(rungs)),
            "right": np.tile(tig.BAND_EDGES[1:], len(rungs)),
            "centre": np.tile(tig.BAND_CENTRES, len(rungs)),
            "difference": difference,
            "text": [formats.signed_text(each) for each in difference],
            "ink": np.where(np.abs(difference) > DARK * FULL, theme.LIGHT_PAPER, theme.REPORT_INK).tolist(),
        }


def every_model(ladder):
    """Return every rung, and the one-dimensional model as the last (tuple of Rung)."""
    return (*ladder.rungs, ladder.one_dimensional)
