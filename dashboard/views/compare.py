"""The tab in which pinned designs and the current one are compared.

Nothing is drawn here while nobody looks.
"""

import panel as pn
import panel_material_ui as pmui

import trackig_core as tig
from dashboard import theme
from dashboard.client.exchange import notify
from dashboard.compute.document import NextTick
from dashboard.figures.comparison import BaseDifferenceFigure, GainsFigure
from dashboard.session.pins import PinError
from dashboard.views.comparison_table import table_html
from dashboard.views.components import (
    CURRENT,
    CURRENT_NAME,
    PAPER,
    bokeh_pane,
    caption,
    gain_axis,
    panel,
    words,
)
from dashboard.views.likeness import Likeness
from dashboard.views.measured_gains import MeasuredGains
from dashboard.views.pin_list import PinList
from dashboard.views.tab import Tab

FEW_BANDS = ("16", "31.5", "63", "125", "250")
"""Bands that are listed at first: an octave apart [Hz]."""


class Compare(Tab):
    """List of pins, insertion gains, their difference from a base, and a table side by side.

    Parameters
    ----------
    inputs : DesignInputs
        Where a pin's values are put back.
    pins : Pins
        The pins.
    definition : GainDefinition
        Which insertion gain is shown.
    assessment : Assessment
        The results of all designs.
    on_figure_2 : callable
        Called when the paper's four tracks alone are to be seen in the plot of insertion gain.
    exchange : Exchange, optional
        Opens files of insertion gain from elsewhere.
    """

    title = "Compare"
    link_name = "compare"

    def __init__(self, inputs, pins, definition, assessment, on_figure_2, exchange=None):
        super().__init__()
        self._pins, self._definition, self._assessment = pins, definition, assessment
        self._on_figure_2 = on_figure_2
        self.list, self.likeness = PinList(inputs, pins), Likeness(pins, assessment)
        self.measured = MeasuredGains(assessment, exchange)
        self.table_1 = pmui.Button(label="Pin Table 1", icon="push_pin", on_click=self._pin_table_1, **BUTTON)
        self.figure_2 = pmui.Button(
            label="Paper's Figure 2", icon="show_chart", on_click=self._show_figure_2, **BUTTON
        )
        self.base = None
        self._base_place = pmui.Row(margin=0)
        self.bands = pn.widgets.CheckBoxGroup(
            label="Bands in the table, Hz",
            options=list(tig.BAND_LABELS),
            value=list(FEW_BANDS),
            inline=True,
            sizing_mode="stretch_width",
            margin=(0, 12, 4, 12),
            stylesheets=[theme.CHECKS_CSS],
        )
        self.gains, self.differences = GainsFigure(), BaseDifferenceFigure()
        self._difference_pane = bokeh_pane(self.differences.layout)
        self._nothing_to_compare = words(NOTHING_TO_COMPARE)
        self._difference_place = pn.Column(self._nothing_to_compare, sizing_mode="stretch_width", margin=0)
        self.table = pn.pane.HTML("", sizing_mode="stretch_width", stylesheets=[theme.TABLE_CSS], margin=0)
        self._show_later = NextTick(self._show)
        self.bands.param.watch(self._show_later, "value")
        assessment.param.watch(self._show_later, ["results", "base", "measured"])
        pins.param.watch(self._offer_bases, ["pinned", "base"])
        self._offer_bases()

    def refresh(self):
        """Show what has changed while nobody looked."""
        self._show_later()

    def _pin_table_1(self, _):
        try:
            self._pins.add_table_1()
        except PinError as problem:
            notify("warning", str(problem))

    def _show_figure_2(self, _):
        try:
            self._pins.show_table_1()
        except PinError as problem:
            notify("warning", str(problem))
        else:
            self._on_figure_2()

    def _offer_bases(self, *_):
        options = {CURRENT_NAME: CURRENT} | {pin.name: pin.key for pin in self._pins.pinned}
        value = self._pins.base or CURRENT
        if self.base is not None and (self.base.options, self.base.value) == (options, value):
            return
        # made anew: the browser's select fails when its options change before its tab was ever seen
        self.base = pn.widgets.Select(
            label="Differences from",
            options=options,
            value=value,
            width=BASE_WIDTH,
            margin=(0, 12, 4, 12),
            stylesheets=[theme.SELECT_CSS],
        )
        self.base.param.watch(self._choose_base, "value")
        self._base_place.objects = [self.base]

    def _choose_base(self, event):
        self._pins.choose_base(event.new or None)

    def _show(self, *_):
        assessment = self._assessment
        if not self.in_sight or assessment.current.summary is None:
            return
        base = assessment.base
        self.likeness.show()
        self.gains.name_axis(gain_axis(self._definition, *(each.design for each in assessment.shown)))
        self.gains.show(assessment.shown)
        others = [each for each in assessment.shown if each is not base]
        self.differences.show(base, others)
        shown = [self._difference_pane if others else self._nothing_to_compare]
        if self._difference_place.objects != shown:
            self._difference_place.objects = shown
        self.table.object = table_html(
            [each for each in assessment.results if each.shown or each is base],
            base,
            [band for band, label in enumerate(tig.BAND_LABELS) if label in self.bands.value],
            assessment.measured,
        )

    def build(self):
        """Return what is put on the page."""
        pinned = pmui.Paper(
            pmui.Row(
                caption("Pinned designs", ""),
                pn.HSpacer(),
                self.table_1,
                self.figure_2,
                sizing_mode="stretch_width",
            ),
            self.list,
            self.likeness,
            **PAPER,
        )
        gains = pmui.Paper(caption("Insertion gain", ""), bokeh_pane(self.gains.layout), **PAPER)
        difference = panel(
            pmui.Row(
                caption("Difference in insertion gain", ""),
                pn.HSpacer(),
                self._base_place,
                sizing_mode="stretch_width",
            ),
            self._difference_place,
        )
        table = pmui.Paper(caption("Side by side", ""), self.bands, self.table, **PAPER)
        return pmui.Grid(
            pmui.Grid(pinned, size=12),
            pmui.Grid(gains, size=12),
            pmui.Grid(difference, size=12),
            pmui.Grid(
                pmui.Paper(caption("Measured insertion gain", MEASURED_WORDS), self.measured, **PAPER),
                size=12,
            ),
            pmui.Grid(table, size=12),
            container=True,
            spacing=1,
            sizing_mode="stretch_width",
            margin=(0, 8, 8, 8),
        )


NOTHING_TO_COMPARE = (
    "Nothing to compare yet: pin a design with the button above the sliders, then change the sliders, or "
    "choose another base."
)

MEASURED_WORDS = "from site, from a paper, from another program: points in Explore, differences in the table"

BASE_WIDTH = 300

BUTTON = {"size": "small", "variant": "outlined", "margin": (6, 8, 4, 0)}
