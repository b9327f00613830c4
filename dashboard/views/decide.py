"""The tab that helps to decide: how far, what matters, how sure, which one.

Each answer ends in one sentence that can be read aloud. What takes milliseconds is answered by itself while
the tab is in sight and the design rests; what takes seconds is asked with a button, shows its progress, and
can be stopped.
"""

import html

import numpy as np
import panel as pn
import panel_material_ui as pmui

import trackig_core as tig
from dashboard import formats, theme
from dashboard.client.exchange import notify
from dashboard.compute.document import NextTick
from dashboard.compute.feasibility import where
from dashboard.fields import FIELDS
from dashboard.figures.decide import ChangeFigure, CloudFigure, MapFigure, PercentileFigure, TornadoFigure
from dashboard.persistence.samples import SamplesError, read_samples
from dashboard.session.answers import FIGURE_WORDS, with_unit
from dashboard.session.inputs import values_of
from dashboard.session.pins import PinError
from dashboard.session.special import six_figures_of
from dashboard.views.asked import BOX, BUTTON, NO_SPECIFICATION, Asked, beside
from dashboard.views.components import bokeh_pane, caption, panel
from dashboard.views.kept_answers import KeptAnswers
from dashboard.views.tab import Tab
from trackig_core.names import LONGEST_NAME
from trackig_core.track.fields import SCATTERED, SLIDER_RANGES

USUAL_TOLERANCES = {
    "pad_stiffness": 15.0,
    "pad_loss_factor": 20.0,
    "block_mass": 2.0,
    "boot_stiffness": 15.0,
    "boot_loss_factor": 20.0,
    "fastener_spacing": 2.0,
}
"""Tolerances at first [%]: generic ones, to be replaced by those of the supplier."""


class HowFar(Asked):
    """How far each number of the design may go, all others held."""

    kind = "range"

    def __init__(self, snapshot, exchange, feasibility):
        super().__init__(snapshot, exchange, feasibility)
        self.table = pn.pane.HTML("", stylesheets=[theme.TABLE_CSS], sizing_mode="stretch_width", margin=0)
        feasibility.param.watch(self._dim, "stale")
        self._answered()

    def _answered(self):
        super()._answered()
        if self.inquiry.result is None:
            self._say(self.inquiry.problem or NO_SPECIFICATION)
            self.table.object = ""

    def _dim(self, *_):
        self.table.styles = theme.STALE if self.inquiry.stale else theme.FRESH

    def words(self, result):
        """Return the answer in one sentence, in the units of the sliders."""
        verdict = "complies" if result.complies else "fails"
        side = "within" if result.margin >= 0 else "beyond"
        said = f"The design {verdict}"
        if result.governed_by != "deflection":
            said += f", {abs(result.margin):.1f} dB {side} the limit at {result.governed_by} Hz"
        if result.deflection_limit is not None:
            said += (
                f", its rail sinking {1e3 * result.deflection:.2f} of {1e3 * result.deflection_limit:.2f} mm"
            )
        ways = [
            f"{FIELDS[name].label.lower()} {where(result, name)}"
            for name in result
            if result[name] and name in FIELDS
        ]
        if result.complies:
            return f"{said}."
        if not ways:
            return f"{said}; no change of a single number makes it comply."
        return f"{said}; it complies with {', or '.join(ways)}."

    def show(self, result):
        """List the ranges."""
        rows = "".join(
            f"<tr><th scope='row'>{html.escape(FIELDS[name].label)}</th>"
            f"<td>{with_unit(name, getattr(result.design, name))}</td><td>{where(result, name)}</td></tr>"
            for name in result
            if name in FIELDS
        )
        self.table.object = (
            "<div class='scroll'><table>"
            "<thead><tr><th>All others held</th><th>now</th><th>complies</th></tr></thead>"
            f"<tbody>{rows}</tbody></table></div>"
        )

    def build(self):
        """Return what is put on the page."""
        return panel(caption("How far?", HOW_FAR), self.sentence, self.answered_row, self.table)


class WhatMatters(Asked):
    """What changes when each number does: band by band, and one figure at a time."""

    kind = "sensitivity"

    def __init__(self, snapshot, exchange):
        super().__init__(snapshot, exchange)
        self.change = pmui.FloatInput(
            label="Change, ± %", value=10.0, start=0.1, end=90.0, step=1.0, size="small", width=130, **BOX
        )
        self.one_by_one = pmui.Checkbox(label="A change for each field", size="small", margin=(8, 12, 0, 0))
        self.changes_of = {name: _percent_box(name, 10.0, 0.1) for name in SLIDER_RANGES}
        self.boxes = pn.FlexBox(*self.changes_of.values(), visible=False, margin=(0, 12))
        self.figure = pn.widgets.Select(
            label="Figure",
            options={FIGURE_WORDS["margin"][0]: "margin"},
            width=230,
            stylesheets=[theme.SELECT_CSS],
            margin=(0, 12, 0, 0),
        )
        self.changes, self.tornado = ChangeFigure(), TornadoFigure()
        self.change.param.watch(self._change_all, "value")
        self.one_by_one.param.watch(self._offer_boxes, "value")
        for box in self.changes_of.values():
            box.param.watch(self.ask, "value")
        self.figure.param.watch(self._draw, "value")

    def _change_all(self, event):
        for box in self.changes_of.values():
            box.value = event.new
        self.ask()

    def _offer_boxes(self, event):
        self.boxes.visible = event.new

    def settings(self):
        """Return what is asked about the current design."""
        design = self.assessment.current.design
        return {
            "changes": {
                name: box.value / 100
                for name, box in self.changes_of.items()
                if box.value and getattr(design, name) is not None
            }
        }

    def show(self, result):
        """Draw the changes."""
        options = {FIGURE_WORDS[name][0]: name for name in result.figures}
        if list(self.figure.options) != list(options):
            self.figure.param.update(options=options, value=next(iter(options.values())))
        labels = [FIELDS[name].label for name in result.fields]
        self.changes.show(labels, result.bands[:, 1])
        ranked = result.ranked(self.figure.value)
        rows = [result.fields.index(name) for name in ranked]
        words, scale = FIGURE_WORDS[self.figure.value]
        changes = result.differences[self.figure.value][rows] * scale
        self.tornado.show([FIELDS[name].label for name in ranked], changes, f"Change of: {words}")

    def words(self, result):
        """Return the answer in one sentence."""
        first = next(iter(result.figures))
        name = result.ranked(first)[0]
        words, scale = FIGURE_WORDS[first]
        quantity, _, unit = words.partition(", ")
        less, more = scale * result.differences[first][result.fields.index(name)]
        change = f"{100 * result.changes[name]:.3g} %"
        return (
            f"The {quantity.lower()} depends most on the {FIELDS[name].label.lower()}: {change} less changes "
            f"it by {formats.signed_text(less)} {unit}, {change} more by {formats.signed_text(more)} {unit}."
        )

    def build(self):
        """Return what is put on the page."""
        return panel(
            caption("What matters?", WHAT_MATTERS),
            pn.FlexBox(self.change, self.one_by_one, self.figure, margin=(0, 12)),
            self.boxes,
            self.sentence,
            self.answered_row,
            beside(self.changes.model, self.tornado.model),
        )


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

    def __init__(self, snapshot, exchange, how_sure):
        super().__init__(snapshot, exchange)
        self._how_sure = how_sure
        self.table = pn.pane.HTML("", stylesheets=[theme.SHARES_CSS], sizing_mode="stretch_width", margin=0)
        self.button.label = "Over the tolerances"

    def settings(self):
        """Return what is asked about the current design."""
        given = {name: each for name, each in self._how_sure.settings().items() if name != "samples"}
        design, figures = self.assessment.current.design, ["deflection", "loaded_track"]
        if self.assessment.source is not None:
            figures.insert(0, "level")
        if self.assessment.specification is not None:
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
            f"{total:.0f} % of the scatter of the {words} is due to the {_factor(result.factors[place])}, "
            f"{alone:.0f} % to it alone."
        )

    def show(self, result):
        """List the parts of each figure's variance, as bars."""
        heads = "".join(
            f"<th scope='col'>{html.escape(FIGURE_WORDS[name][0].partition(',')[0])}</th>"
            for name in result.figures
        )
        rows = "".join(
            f"<tr><th scope='row'>{html.escape(_factor(factor).capitalize())}</th>"
            + "".join(
                share_cell(result.total_order[row, column], *result.total_order_interval[row, column])
                for row in range(len(result.figures))
            )
            + "</tr>"
            for column, factor in enumerate(result.factors)
        )
        self.table.object = (
            f"<div class='scroll'><table><thead><tr><th>Part of the scatter of</th>{heads}</tr></thead>"
            f"<tbody>{rows}</tbody></table>"
            f"<p>Total-order Sobol indices with their 95 % intervals: interactions count for each that takes "
            f"part, so that a column may come to more than all. {result.samples} base samples, seed "
            f"{result.seed}.</p></div>"
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


class HowSure(Asked):
    """How sure the design is to comply when production scatters."""

    kind = "tolerance"

    def __init__(self, snapshot, exchange, production):
        super().__init__(snapshot, exchange)
        self._production, self._specimens = production, {}
        self.tolerances = {name: _percent_box(name, share) for name, share in USUAL_TOLERANCES.items()}
        self.shape = pn.widgets.Select(
            label="Production",
            options={"anything within": "uniform", "bell curve, ± two deviations": "normal"},
            width=250,
            stylesheets=[theme.SELECT_CSS],
            margin=(0, 12, 0, 0),
        )
        self.samples = pn.widgets.Select(
            label="Samples",
            options={"1 000": 1000, "10 000": 10_000, "100 000": 100_000},
            value=10_000,
            width=120,
            stylesheets=[theme.SELECT_CSS],
            margin=(0, 12, 0, 0),
        )
        self.seed = pmui.IntInput(label="Seed", value=0, start=0, size="small", width=110, **BOX)
        self.percentiles = PercentileFigure()
        self.table = pn.pane.HTML("", stylesheets=[theme.TABLE_CSS], sizing_mode="stretch_width", margin=0)
        self.button.label = "How sure?"
        self.in_explore = pmui.Checkbox(
            label="Draw 5 to 95 % of production in Explore too", size="small", margin=(0, 12, 0, 8)
        )
        self.pasted = pmui.TextAreaInput(
            label="Measured specimens, one a row (paste from a spreadsheet, with headers)",
            placeholder="boot stiffness [kN/mm]; boot loss factor",
            rows=2,
            max_rows=6,
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

    def _read(self, *_):
        """Take the table that was pasted in the place of the tolerances of what it holds."""
        try:
            self._specimens, notes = read_samples(self.pasted.value or "")
        except SamplesError as problem:
            self._tell(str(problem), "problem")
            return
        count = len(next(iter(self._specimens.values())))
        what = " and ".join(FIELDS[name].label.lower() for name in self._specimens)
        self._tell(". ".join([f"{what.capitalize()} scatter as in {count} specimens", *notes]) + ".", "fine")
        self._show_boxes()

    def _forget(self, *_):
        self._specimens = {}
        self._tell("", "note")
        self._show_boxes()

    def _show_boxes(self):
        self.forget.visible = bool(self._specimens)
        for name, box in self.tolerances.items():
            box.disabled = name in self._specimens

    def _tell(self, words, kind):
        self.specimens.object = words and f'<p role="status" class="{kind}">{html.escape(words)}</p>'

    def _draw_in_explore(self, event):
        self._production.wanted = event.new

    def settings(self):
        """Return what is asked about the current design."""
        design, kind = self.assessment.current.design, self.shape.value
        half = 1.0 if kind == "uniform" else 0.5
        given = {
            name: {kind: half * box.value / 100}
            for name, box in self.tolerances.items()
            if box.value and _is_number(design, name) and name not in self._specimens
        }
        if not given and not self._specimens:
            raise ValueError("Give one of the tolerances: with none, nothing scatters.")
        settings = {"tolerances": given, "samples": self.samples.value, "seed": self.seed.value or 0}
        return settings | ({"production": self._specimens} if self._specimens else {})

    def show(self, result):
        """Draw the percentiles, and say what to tighten."""
        specification, current = self.assessment.specification, self.assessment.current
        limit = np.full(tig.BAND_CENTRES.size, np.nan) if specification is None else specification.levels
        self.percentiles.show(result.percentiles, current.levels, limit)
        question = self.inquiry.answered
        self._production.computed = (
            *(result.design, question.reference, question.summation),
            result.percentiles,
        )
        low, _, high = result.margin_percentiles
        rows = "".join(
            f"<tr><th scope='row'>{html.escape(_factor(name).capitalize())}</th>"
            f"<td>{100 * share:.1f} %</td></tr>"
            for name, share in result.tightened.items()
        )
        self.table.object = (
            f"<div class='scroll'><p>Governing margin of nine in ten: {formats.signed_text(low)} to "
            f"{formats.signed_text(high)} dB. "
            f"Worst corner of all tolerances: {formats.signed_text(result.worst_margin)} dB. "
            f"{result.samples} samples, seed {result.seed}.</p>"
            "<table><thead><tr><th>Half the scatter of</th><th>complies</th></tr></thead>"
            f"<tbody>{rows}</tbody></table></div>"
        )

    def build(self):
        """Return what is put on the page."""
        return panel(
            caption("How sure?", HOW_SURE),
            pn.FlexBox(*self.tolerances.values(), margin=(0, 12)),
            self.pasted,
            pn.FlexBox(self.read, self.forget, margin=(0, 12)),
            self.specimens,
            pn.FlexBox(
                *(self.shape, self.samples, self.seed, self.button, self.progress, self.stop), margin=(0, 12)
            ),
            self.sentence,
            pn.FlexBox(self.answered_row, self.in_explore, margin=0),
            bokeh_pane(self.percentiles.model),
            self.table,
        )


class Map(Asked):
    """A figure over two fields, with the edge of compliance; a tap takes the design."""

    kind = "map"

    def __init__(self, snapshot, exchange, take):
        super().__init__(snapshot, exchange)
        self._take = take
        self.x, self.y = (
            pn.widgets.Select(
                label=words,
                options=_numbers(),
                value=name,
                width=200,
                stylesheets=[theme.SELECT_CSS],
                margin=(0, 12, 0, 0),
            )
            for words, name in (("Across", "boot_stiffness"), ("Up", "block_mass"))
        )
        self.figure = pn.widgets.Select(
            label="Figure",
            options={words: name for name, (words, _) in FIGURE_WORDS.items() if name != "cost"}
            | {f"Insertion gain at {label} Hz, dB": label for label in tig.BAND_LABELS},
            width=250,
            stylesheets=[theme.SELECT_CSS],
            margin=(0, 12, 0, 0),
        )
        self.map = MapFigure(self._tapped)
        self.place = pn.Column(sizing_mode="stretch_width", margin=0)
        self.button.label = "Draw the map"
        self.figure.param.watch(self.ask_again, "value")

    def ask_again(self, *_):
        """Draw another figure of a map that was asked for."""
        if self.inquiry.asked is not None:
            self.ask()

    def settings(self):
        """Return what is asked about the current design."""
        specification = self.assessment.specification
        if specification is None and self.figure.value == "margin":
            raise ValueError(NO_SPECIFICATION)
        edges = [] if specification is None else ["margin"]
        if specification is not None and specification.rail_deflection_limit is not None:
            edges.append("deflection")
        figures = list(dict.fromkeys([self.figure.value, *edges]))
        return {"x_field": self.x.value, "y_field": self.y.value, "figures": figures}

    def show(self, result):
        """Draw the map."""
        name = next(iter(result.figures))
        words = next(words for words, each in self.figure.options.items() if each == name)
        designs = [self.assessment.current, *self.assessment.shown_pins]
        specification = self.assessment.specification
        limits = {} if specification is None else {"margin": 0.0}
        if "deflection" in result.figures and specification is not None:
            limits["deflection"] = specification.rail_deflection_limit
        self.map.show(result, name, words, designs, limits)
        self.place.objects = [bokeh_pane(self.map.layout)]

    def words(self, result):
        """Return the answer in one sentence."""
        x, y = (FIELDS[name].label.lower() for name in (result.x_field, result.y_field))
        if result.complies is None:
            return f"{result.x.size} times {result.y.size} designs over {x} and {y}. Tap one to take it."
        return (
            f"{100 * result.complies.mean():.0f} % of the designs over {x} and {y} comply. "
            "Tap one to take it to the sliders; Ctrl+Z brings the old one back."
        )

    def _tapped(self, x, y):
        result = self.inquiry.result
        if result is not None and x is not None and y is not None:
            values = (FIELDS[result.x_field].factor * x, FIELDS[result.y_field].factor * y)
            self._take(result.design_at(*values))

    def build(self):
        """Return what is put on the page."""
        return pn.Column(
            pn.FlexBox(self.x, self.y, self.figure, self.button, self.progress, self.stop, margin=(0, 12)),
            self.sentence,
            self.answered_row,
            self.place,
            sizing_mode="stretch_width",
            margin=0,
        )


class Search(Asked):
    """Designs that comply, on the front of margin against what else counts."""

    kind = "find"

    def __init__(self, snapshot, exchange, take, pin):
        super().__init__(snapshot, exchange)
        self._take, self._pin, self._chosen = take, pin, None
        self.free = pn.widgets.CheckBoxGroup(
            label="Free",
            options=_numbers(),
            value=["pad_stiffness", "block_mass", "boot_stiffness"],
            inline=True,
            stylesheets=[theme.CHECKS_CSS],
            margin=(0, 12, 0, 0),
        )
        self.against = pn.widgets.Select(
            label="Greatest margin against least",
            options={
                "rail deflection": "deflection",
                "block mass": "block_mass",
                "boot stiffness": "boot_stiffness",
                "cost": "cost",
            },
            width=220,
            stylesheets=[theme.SELECT_CSS],
            margin=(0, 12, 0, 0),
        )
        self.prices = {
            name: pmui.FloatInput(
                label=words, value=price, start=0.0, size="small", width=200, visible=False, **BOX
            )
            for name, words, price in (
                ("block_mass", "Cost per kg of block", 1.0),
                ("fastener_spacing", "Saving per metre of spacing", 0.0),
            )
        }
        self.chosen = pn.widgets.CheckBoxGroup(
            label="From the catalogue",
            options={words: kind for kind, words in CATALOGUED.items()},
            value=[],
            inline=True,
            stylesheets=[theme.CHECKS_CSS],
            margin=(0, 12, 0, 0),
        )
        self.deflection = pmui.FloatInput(
            label="Rail sinks at most, mm (0: as specified)",
            value=0.0,
            start=0.0,
            end=100.0,
            step=0.1,
            size="small",
            width=290,
            **BOX,
        )
        self.seed = pmui.IntInput(label="Seed", value=0, start=0, size="small", width=110, **BOX)
        self.button.label = "Find designs"
        self.take = pmui.Button(
            label="Take to the sliders", icon="tune", disabled=True, on_click=self._take_chosen, **BUTTON
        )
        self.pin = pmui.Button(
            label="Pin", icon="push_pin", disabled=True, on_click=self._pin_chosen, **BUTTON
        )
        self.pin_name = pmui.TextInput(
            label="Name it", value="Found", max_length=LONGEST_NAME, size="small", width=220, **BOX
        )
        self.cloud = CloudFigure(self._choose)
        self.against.param.watch(self._offer_prices, "value")
        self.inquiry.param.watch(NextTick(self._grow), "so_far")

    def settings(self):
        """Return what is asked about the current design."""
        design = self.assessment.current.design
        choices = {kind: catalogued(kind, design) for kind in self.chosen.value}
        choices = {kind: offered for kind, offered in choices.items() if offered}
        taken = {name for kind, offered in choices.items() if kind != "rail" for name in offered[0]}
        free = [name for name in self.free.value if _is_number(design, name) and name not in taken]
        if not free and not choices:
            raise ValueError("Choose which numbers are free.")
        settings = {"free": free, "objectives": ["margin", self.against.value], "seed": self.seed.value or 0}
        if choices:
            settings["choices"] = choices
        if self.deflection.value:
            settings["max_deflection"] = self.deflection.value / 1e3
        if self.against.value == "cost":
            prices = {name: box.value or 0.0 for name, box in self.prices.items()}
            prices["fastener_spacing"] *= -1
            settings["cost"] = {name: price for name, price in prices.items() if price}
        return settings

    def _offer_prices(self, *_):
        for box in self.prices.values():
            box.visible = self.against.value == "cost"

    def _grow(self):
        if self.inquiry.so_far is not None:
            self._say(self.words(self.inquiry.so_far))
            self.show(self.inquiry.so_far)

    def show(self, found):
        """Draw what was found."""
        specification = self.assessment.specification
        names = [name for name in FIELDS if name in found.free or _varies(found.many, name)]
        ends = {
            name: (FIELDS[name].low * FIELDS[name].factor, FIELDS[name].high * FIELDS[name].factor)
            for name in names
        }
        labels = [
            f"{FIELDS[name].label}\n{formats.quantity_text(FIELDS[name].low)}–"
            f"{formats.quantity_text(FIELDS[name].high)} {FIELDS[name].unit}"
            for name in names
        ]
        axes = [_axis(name) for name in found.objectives]
        reference = self.definition.reference_of(found.many.design(0))
        levels = found.many.gain_for(reference, self.definition.summation)
        self.cloud.show(
            found,
            levels,
            labels,
            ends,
            (axes[0][0], axes[-1][0]),
            np.full(tig.BAND_CENTRES.size, np.nan) if specification is None else specification.levels,
            (axes[0][1], axes[-1][1]),
        )

    def words(self, found):
        """Return the answer in one sentence."""
        tried = f"{found.slack.size} designs"
        if not found.front.size:
            miss = -float(found.slack[found.closest])
            if found.in_the_way == "deflection":
                by = f"sinks {10 ** (miss / 20) - 1:.0%} more than allowed"
            else:
                by = f"misses the limit at {found.in_the_way} Hz by {miss:.1f} dB"
            return f"None of {tried} complies; the closest {by}."
        return (
            f"{int(found.complies.sum())} of {tried} comply; {found.front.size} of them no other beats. "
            "Brush the pictures to see their insertion gain; tap a design to take or pin it."
        )

    def _choose(self, row):
        self._chosen = row
        for button in (self.take, self.pin):
            button.disabled = row is None

    def _design(self):
        found = self.inquiry.result if self.inquiry.so_far is None else self.inquiry.so_far
        return found.many.design(self._chosen)

    def _take_chosen(self, *_):
        self._take(self._design())

    def _pin_chosen(self, *_):
        self._pin(self._design(), self.pin_name.value.strip() or "Found")

    def build(self):
        """Return what is put on the page."""
        pictures = (self.cloud.objectives, self.cloud.fields, self.cloud.gains)
        return pn.Column(
            pn.FlexBox(self.free, margin=(0, 12)),
            pn.FlexBox(self.chosen, margin=(0, 12)),
            pn.FlexBox(
                self.against,
                *self.prices.values(),
                self.deflection,
                self.seed,
                self.button,
                self.progress,
                self.stop,
                margin=(0, 12),
            ),
            self.sentence,
            self.answered_row,
            pn.FlexBox(self.take, self.pin_name, self.pin, margin=(0, 12)),
            beside(*pictures),
            sizing_mode="stretch_width",
            margin=0,
        )


class Decide(Tab):
    """Four questions about the current design.

    Parameters
    ----------
    snapshot : SessionSnapshot
        The session: what is asked about, and what a design that is found is taken to.
    exchange : Exchange
        Where files go.
    feasibility : Feasibility
        Where the current design complies, which the sliders show too.
    production : Production
        Where insertion gain of production is left for others to draw.
    """

    title = "Decide"
    link_name = "decide"

    def __init__(self, snapshot, exchange, feasibility, production):
        super().__init__()
        self._inputs, self._pins = snapshot.inputs, snapshot.pins
        self.how_far = HowFar(snapshot, exchange, feasibility)
        self.what_matters = WhatMatters(snapshot, exchange)
        self.how_sure = HowSure(snapshot, exchange, production)
        self.what_scatters = WhatScatters(snapshot, exchange, self.how_sure)
        self.map = Map(snapshot, exchange, self._take)
        self.search = Search(snapshot, exchange, self._take, self._pin)
        self.kept = KeptAnswers(snapshot.answers, exchange)
        snapshot.assessment.param.watch(self.refresh, "results")

    def refresh(self, *_):
        """Answer for the current design what takes milliseconds."""
        if self.in_sight:
            self.what_matters.ask()

    def _take(self, design):
        self._inputs.take(values_of(six_figures_of(design)))

    def _pin(self, design, name):
        try:
            # as the sliders show it: a study of it opens as it was saved
            pin = self._pins.add(six_figures_of(design), name, self._inputs.preset)
        except PinError as problem:
            notify("warning", str(problem))
        else:
            notify("success", f"Pinned as “{pin.name}”. See the tab Compare.")

    def fill(self, place):
        """Put one question after the other into its place."""
        which = pmui.Tabs(
            *(("Map", self.map.build()), ("Search", self.search.build())),
            sizing_mode="stretch_width",
            margin=(0, 8),
            sx=theme.TABS,
        )
        parts = (
            self.how_far.build(),
            self.what_matters.build(),
            self.how_sure.build(),
            panel(caption("Which tolerance?", WHICH_TOLERANCE), self.what_scatters.build()),
            panel(caption("Which one?", WHICH_ONE), which),
            panel(caption("Kept answers", KEPT), self.kept),
        )
        for part in parts:
            part.margin = (0, 8, 8, 8)
            place.append(part)
            yield


HOW_FAR = "where the design complies along each number, all others held"
WHAT_MATTERS = "what changes when a number does; the map shows the change of insertion gain when it is more"
HOW_SURE = "how much of production complies, when numbers scatter by their tolerances"
WHICH_TOLERANCE = "what the scatter is due to, each with all that it does together with others"
KEPT = "part of the study and of the report, a page each"
WHICH_ONE = "designs over two numbers, or a search over several"


CATALOGUED = {
    "rail": "rail sections",
    "pad": "pads of the catalogue",
    "block": "blocks of the catalogue",
    "boot": "boots of the catalogue",
}
"""What may be chosen from the bundled catalogue, by its kind of component."""


def catalogued(kind, design):
    """Return what a search may choose from the catalogue: plain values, as a question takes them.

    Parameters
    ----------
    kind : str
        A kind of component.
    design : trackig_core.TrackDesign
        The design; a single-stage one has no block or boot to choose.

    Returns
    -------
    list of dict of str to float, or of str
        Values by field of each component that has the same fields as the first; rails by their names.
    """
    if kind == "rail":
        return list(tig.RAILS)
    if kind in ("block", "boot") and not design.two_stage:
        return []
    components = tig.study.bundled_catalogue().of_kind(kind).values()
    fitted = [(each.fitted_to(design), each.values) for each in components]
    fields = [name for name in SCATTERED if name.startswith(f"{kind}_") and name in SLIDER_RANGES]
    return [
        {name: getattr(made, name) for name in fields}
        for made, values in fitted
        if all(isinstance(values.get(name), float) for name in fields)
    ]


def share_cell(share, low, high):
    """Return a cell of a table that shows a part of a variance as a bar, with its interval."""
    if np.isnan(share):
        return "<td>–</td>"
    width = 100 * min(max(share, 0.0), 1.0)
    return (
        f"<td title='{100 * low:.0f} to {100 * high:.0f} %'><span class='bar' style='width: {width:.0f}px'>"
        f"</span>{100 * max(share, 0.0):.0f} %<br><small>{100 * low:.0f} to {100 * high:.0f}</small></td>"
    )


def _percent_box(name, value, low=0.0):
    return pmui.FloatInput(
        label=f"{FIELDS[name].label}, ± %",
        value=value,
        start=low,
        end=90.0,
        step=1.0,
        size="small",
        width=190,
        **BOX,
    )


def _factor(name):
    """Return what scatters, as it is spoken."""
    return FIELDS[name].label.lower() if name in FIELDS else "measured specimens"


def _varies(many, name):
    column = many.columns[name]
    return column.dtype == float and column.min() < column.max()


def _numbers():
    return {FIELDS[name].label: name for name in SLIDER_RANGES}


def _is_number(design, name):
    return isinstance(getattr(design, name), float)


def _axis(name):
    """Return what an objective is called, and what turns it into the unit that is shown."""
    if name in FIELDS:
        return FIELDS[name].labelled, 1 / FIELDS[name].factor
    return FIGURE_WORDS[name]
