"""Measured stiffness of a pad or boot: pasted or opened, looked at beside the law fitted to it, and used.

What is read is a preview until it is used. Where the unit is doubtful, nothing is used before somebody chose
it: a mistaken one costs a factor of 1000.
"""

import html

import numpy as np
import panel as pn
import panel_material_ui as pmui
from panel.viewable import Viewer

import trackig_core as tig
from dashboard import formats, theme
from dashboard.client.exchange import opening
from dashboard.compute.document import NextTick
from dashboard.fields import NEWTON_PER_METRE
from dashboard.figures.measured import MeasuredFigure
from dashboard.session.measuring import curve_of, extrapolated_words, fit_text, with_curve
from dashboard.session.special import curve_text
from dashboard.views.components import bokeh_pane, caption, panel
from trackig_core.table_text import MOST_BYTES
from trackig_core.track.measured_curves import MeasurementError
from trackig_core.track.measured_tables import UNITS, read_stiffness

AS_READ = ""
"""Choice of the unit that the table names, or that is guessed."""

DRAWN = (5.0, 500.0)
"""Frequencies over which the law is drawn at least [Hz]: where it is fitted."""

MOST_ROWS = 40
"""Points that the table on the page lists."""


class Measured(Viewer):
    """The editor of what was measured.

    Parameters
    ----------
    inputs : DesignInputs
        The current design, which the curve becomes part of.
    measuring : Measuring
        Which part it is of, and what was read.
    exchange : Exchange
        Opens files.

    Attributes
    ----------
    place : str
        Name of its part of the page.
    """

    place = "measured_panel"

    def __init__(self, inputs, measuring, exchange):
        super().__init__()
        self._inputs, self._measuring = inputs, measuring
        self._data = None
        self.part = pn.widgets.Select.from_param(
            measuring.param.part, width=150, margin=(4, 12, 0, 12), stylesheets=[theme.SELECT_CSS]
        )
        self.pasted = pmui.TextAreaInput(
            label="Paste a table: Hz, stiffness, loss factor; or real and imaginary part",
            placeholder=EXAMPLE,
            rows=5,
            max_length=MOST_BYTES,
            sizing_mode="stretch_width",
            margin=(4, 12, 4, 12),
        )
        self.read = _button("Read what is pasted", "content_paste_go", on_click=self._read_pasted)
        self.load = _button("Open table", "upload_file", js_on_click=opening("stiffness"))
        self.unit = pn.widgets.Select(
            label="Unit of stiffness",
            options={"as read": AS_READ, **{name: name for name in UNITS}},
            value=AS_READ,
            width=150,
            margin=(4, 12, 0, 12),
            stylesheets=[theme.SELECT_CSS],
        )
        self.use = pmui.Button(
            label="Use",
            icon="check",
            size="small",
            variant="contained",
            on_click=self._use,
            margin=(4, 8, 4, 12),
        )
        self.discard = _button("Discard", "close", on_click=self._discard)
        self.remove = _button("Remove", "delete", on_click=self._remove)
        self.message = pn.pane.HTML("", stylesheets=[theme.MESSAGE_CSS], margin=(4, 12, 4, 12))
        self.words = pn.pane.HTML("", stylesheets=[theme.PROSE_CSS], margin=(0, 12, 0, 12))
        self.table = pn.pane.HTML("", stylesheets=[theme.SLOPES_CSS], margin=(0, 14))
        self.stiffness = MeasuredFigure("measured_stiffness", "Dynamic stiffness, kN/mm")
        self.loss_factor = MeasuredFigure("measured_loss_factor", "Loss factor")
        self.panes = [bokeh_pane(each.model) for each in (self.stiffness, self.loss_factor)]
        self.unit.param.watch(self._read_again, "value")
        exchange.on_file("stiffness", self.take)
        show = NextTick(self._show)
        inputs.param.watch(show, ["special", "two_stage"])
        measuring.param.watch(show, ["part", "reading", "answered"])
        self._show()

    def take(self, data):
        """Read a table, as bytes or text, into the preview; or say why not, and leave what was there."""
        self._data = data
        if self.unit.value == AS_READ:
            self._read_again()
        else:
            self.unit.value = AS_READ

    def _read_pasted(self, *_):
        self.take(self.pasted.value)

    def _read_again(self, *_):
        if self._data is None:
            return
        try:
            reading = read_stiffness(self._data, self.unit.value or None)
        except MeasurementError as error:
            self._tell(f"Not read: {error}.")
        else:
            self._tell("")
            self._measuring.param.update(reading=reading, answered=self.unit.value != AS_READ)

    def _use(self, *_):
        part, reading = self._measuring.part, self._measuring.reading
        self._inputs.take({"special": with_curve(self._inputs, part, reading.curve)})
        self._discard()
        self._tell(f"The {part} is as measured.", "status")

    def _discard(self, *_):
        self._data, self.pasted.value = None, ""
        self._measuring.param.update(reading=None, answered=False)
        self.unit.value = AS_READ
        self._tell("")

    def _remove(self, *_):
        part = self._measuring.part
        self._inputs.take({"special": with_curve(self._inputs, part, None)})
        self._tell(f"The sliders stand for the {part} again.", "status")

    def _tell(self, words, role="alert"):
        self.message.object = f'<div role="{role}">{html.escape(words)}</div>'

    def _show(self):
        measuring, part = self._measuring, self._measuring.part
        in_use = curve_of(self._inputs.to_design(), part)
        is_preview = measuring.reading is not None
        curve = measuring.reading.curve if is_preview else in_use
        has_part = part == "pad" or self._inputs.two_stage
        self.use.param.update(
            label=f"Use for the {part}",
            visible=is_preview,
            disabled=measuring.is_open or not has_part,
        )
        self.discard.visible = is_preview
        self.remove.param.update(
            label=f"Remove from the {part}", visible=in_use is not None and not is_preview
        )
        fit = None if curve is None else tig.analysis.curve_fit(curve)
        paragraphs = [] if has_part else ["This track has one stage and no boots."]
        if is_preview:
            paragraphs += reading_words(measuring.reading, measuring.is_open, measuring.answered)
        if curve is None:
            paragraphs.append(f"Nothing is measured of the {part}: the sliders stand for it.")
        else:
            paragraphs += curve_words(curve, fit)
        self.words.object = "".join(f"<p>{html.escape(each)}</p>" for each in paragraphs)
        self.table.object = "" if curve is None else points_html(curve, fit)
        self._draw(curve, fit)

    def _draw(self, curve, fit):
        # Panel's pane takes its visibility from the figure, and not the other way
        for figure, visible in zip((self.stiffness, self.loss_factor), _has(curve), strict=True):
            figure.model.visible = visible
        if curve is None:
            return
        points = np.array(curve.points).T
        frequency = np.geomspace(min(points[0, 0], DRAWN[0]), max(points[0, -1], DRAWN[1]), 200)
        if isinstance(curve, tig.StiffnessCurve):
            law = fit.law.dynamic_stiffness(frequency).real / NEWTON_PER_METRE
            self.stiffness.show((points[0], points[1] / NEWTON_PER_METRE), (frequency, law))
        self.loss_factor.show((points[0], points[-1]), (frequency, fit.law.loss_factor(frequency)))

    def __panel__(self):
        """Return what is put on the page."""
        return panel(
            caption(TITLE, TITLE_WORDS),
            pn.Row(self.part, self.unit, margin=0),
            self.pasted,
            pn.FlexBox(self.read, self.load, self.use, self.discard, self.remove, margin=(0, 0, 0, 4)),
            self.message,
            self.words,
            pn.Column(*self.panes, stylesheets=[theme.FITTING_CSS], sizing_mode="stretch_width", margin=0),
            self.table,
            name=self.place,
        )


TITLE = "Measured over frequency"
TITLE_WORDS = "a test house's table in the place of stiffness and loss factor"
EXAMPLE = "f [Hz]\tk [kN/mm]\tη\n5\t24.1\t0.16\n50\t28.0\t0.20"


def reading_words(reading, is_open, is_answered):
    """Return what is to be said of a table that was read, as sentences: unit, question, notes."""
    source = "assumed: the table names none" if reading.is_assumed else "as the table says"
    said = [f"Stiffness in {reading.unit}, {'as chosen' if is_answered else source}."]
    if is_open:
        said.append(f"Is that so? {_sentence(reading.question)} Choose the unit to go on.")
    return [*said, *(_sentence(each) for each in reading.notes)]


def _sentence(words):
    return f"{words[:1].upper()}{words[1:]}{'' if words.endswith(('.', '?')) else '.'}"


def curve_words(curve, fit):
    """Return what is to be said of a curve and its law: what was measured, fit error, extrapolated bands."""
    said = [_sentence(curve_text(curve)), _sentence(fit_text(fit))]
    return [*said, *filter(None, [extrapolated_words(curve)])]


def points_html(curve, fit):
    """Return the points of a curve beside the law as a table, made of numbers and this module's words."""
    has_stiffness = fit.stiffness_error is not None
    head = ["Hz", *(["kN/mm", "law, ±%"] if has_stiffness else []), "loss factor", "law, ±%"]
    rows = []
    for number, point in enumerate(curve.points[:MOST_ROWS]):
        within = fit.is_fitted[number]
        cells = [formats.quantity_text(point[0])]
        if has_stiffness:
            cells += [
                formats.quantity_text(point[1] / NEWTON_PER_METRE),
                _error(fit.stiffness_error[number], within),
            ]
        cells += [formats.quantity_text(point[-1]), _error(fit.loss_factor_error[number], within)]
        rows.append("".join(f"<td>{each}</td>" for each in cells))
    more = len(curve.points) - MOST_ROWS
    note = f", the first {MOST_ROWS} of {len(curve.points)}" if more > 0 else ""
    body = "".join(f"<tr>{row}</tr>" for row in rows)
    heads = "".join(f'<th scope="col">{each}</th>' for each in head)
    return f"<table><caption>Points as measured{note}</caption><thead><tr>{heads}</tr></thead>{body}</table>"


def _error(error, within):
    text = f"{100 * error:+.1f}".replace("-", "−")
    return text if within else f"({text})"


def _has(curve):
    """Return whether there is stiffness to draw, and loss factor."""
    return isinstance(curve, tig.StiffnessCurve), curve is not None


def _button(label, icon, **kind):
    return pmui.Button(label=label, icon=icon, size="small", variant="outlined", margin=(4, 8, 4, 8), **kind)
