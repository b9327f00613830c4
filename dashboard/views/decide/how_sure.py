"""How sure the design is to comply when production scatters."""

import html

import numpy as np
import panel as pn
import panel_material_ui as pmui
import param

import trackig_core as tig
from dashboard import formats, theme
from dashboard.fields import FIELDS
from dashboard.figures.decide import PercentileFigure
from dashboard.persistence.samples import SamplesError, read_samples
from dashboard.views.components import bokeh_pane, caption, panel
from dashboard.views.decide.asked import BUTTON, Asked, scrolled
from dashboard.views.decide.inputs import ShareBoxes, choice, factor_label, is_number, seed_box

USUAL_TOLERANCES = {
    "pad_stiffness": 15.0,
    "pad_loss_factor": 20.0,
    "block_mass": 2.0,
    "boot_stiffness": 15.0,
    "boot_loss_factor": 20.0,
    "fastener_spacing": 2.0,
}
"""Tolerances at first [%]: generic ones, to be replaced by those of the supplier."""


MOST_PASTED = 5000
"""Characters of a table of specimens that a browser may paste [-]."""


class InUse(param.Parameterized):
    """The table of specimens that is in use, as it was pasted; empty if none is."""

    value = param.String(default="")
    max_length = MOST_PASTED


class HowSure(Asked):
    """How sure the design is to comply when production scatters."""

    kind = "tolerance"
    ages = True
    before = (
        "Give the tolerances of your products, then press “How sure?”: it says how much of production "
        "complies and draws its insertion gain. It takes a specification."
    )

    def __init__(self, snapshot, exchange, production):
        super().__init__(snapshot, exchange)
        self._production, self._specimens, self.in_use = production, {}, InUse()
        self.tolerances = ShareBoxes(USUAL_TOLERANCES, 0.0, exchange)
        self.shape = choice(
            label="Production",
            options={
                "even within the tolerances": "uniform",
                "bell curve, tolerance = 2 std. dev.": "normal",
            },
            width=290,
        )
        self.samples = choice(
            label="Samples",
            options={"1 000": 1000, "10 000": 10_000, "100 000": 100_000},
            value=10_000,
            width=120,
        )
        self.seed = seed_box()
        self.percentiles = PercentileFigure()
        self._pane = bokeh_pane(self.percentiles.model)
        self.place = pn.Column(sizing_mode="stretch_width", margin=0)
        self.table = pn.pane.HTML("", stylesheets=[theme.TABLE_CSS], sizing_mode="stretch_width", margin=0)
        self.drawn = (self.place, self.table)
        self.button.label = "How sure?"
        self.in_explore = pmui.Checkbox(
            label="Draw 5 to 95 % of production in Explore too", size="small", margin=(0, 12, 0, 8)
        )
        self.pasted = pmui.TextAreaInput(
            label="Measured specimens, one a row (paste from a spreadsheet, with headers)",
            placeholder="boot stiffness [kN/mm]; boot loss factor",
            rows=2,
            max_rows=6,
            max_length=MOST_PASTED,
            size="small",
            sizing_mode="stretch_width",
            margin=(6, 12, 0, 12),
        )
        self.read = pmui.Button(label="Use these specimens", icon="table_rows", on_click=self._read, **BUTTON)
        self.forget = pmui.Button(
            label="Use tolerances alone", icon="clear", visible=False, on_click=self._forget, **BUTTON
        )
        self.specimens = pn.pane.HTML(
            "", stylesheets=[theme.ANSWER_CSS], sizing_mode="stretch_width", margin=(0, 12)
        )
        self.in_explore.param.watch(self._draw_in_explore, "value")
        self.in_use.param.watch(self._use, "value")
        snapshot.boxes.keep(
            shape=self.shape,
            samples=self.samples,
            seed=self.seed,
            specimens=self.pasted,
            specimens_in_use=self.in_use,
            in_explore=self.in_explore,
        )
        self.tolerances.keep(snapshot.boxes, "tolerance")

    def _read(self, *_):
        """Take the table that was pasted in the place of the tolerances of what it holds."""
        table = self.pasted.value or ""
        try:
            read_samples(table)
        except SamplesError as problem:
            self._tell(str(problem), "problem")
        else:
            if table == self.in_use.value:
                # what was said of another table meanwhile goes away
                self._use()
            self.in_use.value = table

    def _use(self, *_):
        """Use the specimens of the table that is in use, as it was read or came back with the page."""
        try:
            self._specimens, notes = read_samples(self.in_use.value)
        except SamplesError:
            # none is in use, or the browser's memory holds none
            self._specimens = {}
            self._tell("", "note")
            self._show_boxes()
            return
        count = len(next(iter(self._specimens.values())))
        what = " and ".join(FIELDS[name].label.lower() for name in self._specimens)
        self._tell(". ".join([f"{what.capitalize()} scatter as in {count} specimens", *notes]) + ".", "fine")
        self._show_boxes()

    def _forget(self, *_):
        self.in_use.value = ""

    def _show_boxes(self):
        self.forget.visible = bool(self._specimens)
        for name, box in self.tolerances.boxes.items():
            box.disabled = name in self._specimens

    def _tell(self, words, kind):
        self.specimens.object = words and f'<p role="status" class="{kind}">{html.escape(words)}</p>'

    def _draw_in_explore(self, event):
        self._production.wanted = event.new

    def offer(self):
        """Offer a tolerance of each number that the current design has."""
        self.tolerances.offer(self.assessment.current.design)

    def settings(self):
        """Return what is asked about the current design."""
        design, kind = self.assessment.current.design, self.shape.value
        # of a bell curve a tolerance is two standard deviations, and it is cut off at three
        half, reach = (1.0, 1.0) if kind == "uniform" else (0.5, 1.5)
        given = {
            name: {kind: half * share}
            for name, share in self.tolerances.shares(design, reach).items()
            if is_number(design, name) and name not in self._specimens
        }
        if not given and not self._specimens:
            raise ValueError("Give one of the tolerances: with none, nothing scatters.")
        settings = {"tolerances": given, "samples": self.samples.value, "seed": self.seed.number}
        return settings | ({"production": self._specimens} if self._specimens else {})

    def show(self, result):
        """Draw the percentiles, and say what to tighten."""
        specification, current = self.assessment.in_force, self.assessment.current
        limit = np.full(tig.BAND_CENTRES.size, np.nan) if specification is None else specification.levels
        self.percentiles.show(result.percentiles, current.levels, limit)
        if not self.place.objects:
            self.place.objects = [self._pane]
            self._exchange.introduce()
        question = self.inquiry.answered
        self._production.computed = (
            *(result.design, question.reference, question.summation),
            result.percentiles,
        )
        low, _, high = result.margin_percentiles
        rows = "".join(
            f"<tr><th scope='row'>{html.escape(factor_label(name).capitalize())}</th>"
            f"<td>{100 * share:.1f} %</td></tr>"
            for name, share in result.tightened.items()
        )
        self.table.object = scrolled(
            "What halving a scatter does",
            f"<p>Governing margin of nine in ten: {formats.signed_text(low)} to "
            f"{formats.signed_text(high)} dB. "
            f"Worst corner of all tolerances: {formats.signed_text(result.worst_margin)} dB. "
            f"{result.samples} samples, seed {result.seed}.</p>"
            "<table><thead><tr><th>Half the scatter of</th><th>complies</th></tr></thead>"
            f"<tbody>{rows}</tbody></table>",
        )

    def build(self):
        """Return what is put on the page."""
        return panel(
            caption("How sure?", HOW_SURE),
            self.tolerances.row,
            self.pasted,
            pn.FlexBox(self.read, self.forget, margin=(0, 12)),
            self.specimens,
            pn.FlexBox(
                *(self.shape, self.samples, self.seed, self.button, self.progress, self.stop), margin=(0, 12)
            ),
            self.sentence,
            pn.FlexBox(self.answered_row, self.in_explore, margin=0),
            self.place,
            self.table,
        )


HOW_SURE = "how much of production complies, when numbers scatter by their tolerances"
