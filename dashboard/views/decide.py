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
from dashboard.compute.inquiries import WAITING, Inquiry, InquiryRunner, question_of
from dashboard.fields import FIELDS
from dashboard.figures.decide import ChangeFigure, CloudFigure, MapFigure, PercentileFigure, TornadoFigure
from dashboard.session.inputs import design_of, values_of
from dashboard.session.pins import PinError
from dashboard.views.components import bokeh_pane, caption, panel
from dashboard.views.tab import Tab

FIGURE_WORDS = {
    "margin": ("Governing margin, dB", 1.0),
    "level": ("Received level, dB(A)", 1.0),
    "deflection": ("Rail deflection, mm", 1e3),
    "loaded_track": ("Loaded-track frequency, Hz", 1.0),
    "coupled_block": ("Coupled-block frequency, Hz", 1.0),
    "cost": ("Cost", 1.0),
}
"""What figures are called, with the unit in which they are shown, and what turns them into it."""

USUAL_TOLERANCES = {
    "pad_stiffness": 15.0,
    "pad_loss_factor": 20.0,
    "block_mass": 2.0,
    "boot_stiffness": 15.0,
    "boot_loss_factor": 20.0,
    "fastener_spacing": 2.0,
}
"""Tolerances at first [%]: generic ones, to be replaced by those of the supplier."""

NO_SPECIFICATION = "Write a specification first, in the tab Specification: designs are compared with it."


class Asked:
    """What the questions have in common: an inquiry, its progress, its answer in a sentence.

    Parameters
    ----------
    assessment : Assessment
        Current design, specification and source.
    definition : GainDefinition
        Which insertion gain is meant.
    """

    kind = ""

    def __init__(self, assessment, definition):
        self.assessment, self.definition = assessment, definition
        self.inquiry = Inquiry()
        self.runner = InquiryRunner(self.inquiry)
        self.sentence = pn.pane.HTML(
            "", stylesheets=[theme.ANSWER_CSS], sizing_mode="stretch_width", margin=(2, 12, 6, 12)
        )
        self.progress = pmui.LinearProgress(
            value=0, variant="determinate", width=160, visible=False, margin=(16, 0, 0, 12)
        )
        self.stop = pmui.Button(label="Stop", icon="stop", on_click=self.runner.stop, visible=False, **BUTTON)
        self.button = pmui.Button(label="Compute", icon="play_arrow", on_click=self.ask, **BUTTON)
        self.inquiry.param.watch(self._show_state, ["busy", "progress", "problem"])
        # figures may change only when the session's document may
        self._draw = NextTick(self._answered)
        self.inquiry.param.watch(self._draw, "result")

    def settings(self):
        """Return what is asked about the current design [SI units]."""
        return {}

    def ask(self, *_):
        """Ask the question as it stands."""
        try:
            settings = self.settings()
        except ValueError as error:
            self._say(str(error), "problem")
            return
        question = question_of(self.kind, settings, self.assessment, self.definition)
        if question is None:
            self._say(NO_SPECIFICATION)
        elif question == self.inquiry.answered:
            self._draw()
        else:
            self.inquiry.asked = question

    def _show_state(self, *_):
        inquiry = self.inquiry
        self.progress.param.update(
            visible=inquiry.busy and inquiry.progress is not None, value=round(100 * (inquiry.progress or 0))
        )
        self.stop.visible = inquiry.busy
        if inquiry.problem:
            self._say(inquiry.problem, "problem")
        elif inquiry.busy and inquiry.progress is None:
            self._say(WAITING)

    def _answered(self):
        if self.inquiry.result is not None:
            self._say(self.words(self.inquiry.result), "fine")
            self.show(self.inquiry.result)

    def _say(self, words, kind="note"):
        self.sentence.object = f'<p role="status" class="{kind}">{html.escape(words)}</p>'

    def words(self, result):
        """Return the answer in one sentence."""
        return str(result)

    def show(self, result):
        """Draw an answer."""
        raise NotImplementedError


class HowFar(Asked):
    """How far each number of the design may go, all others held."""

    kind = "range"

    def __init__(self, assessment, definition):
        super().__init__(assessment, definition)
        self.table = pn.pane.HTML("", stylesheets=[theme.TABLE_CSS], sizing_mode="stretch_width", margin=0)

    def settings(self):
        """Return what is asked about the current design."""
        return {"fields": [name for name in FIELDS if _is_number(self.assessment.current.design, name)]}

    def words(self, result):
        """Return the answer in one sentence, in the units of the sliders."""
        verdict = "complies" if result.complies else "fails"
        side = "within" if result.margin >= 0 else "beyond"
        said = (
            f"The design {verdict}, {abs(result.margin):.1f} dB {side} the limit at {result.governed_by} Hz"
        )
        if result.deflection_limit is not None:
            said += (
                f", its rail sinking {1e3 * result.deflection:.2f} of {1e3 * result.deflection_limit:.2f} mm"
            )
        ways = [f"{FIELDS[name].label.lower()} {where(result, name)}" for name in result if result[name]]
        if result.complies:
            return f"{said}."
        if not ways:
            return f"{said}; no change of a single number makes it comply."
        return f"{said}; it complies with {', or '.join(ways)}."

    def show(self, result):
        """List the ranges."""
        rows = "".join(
            f"<tr><th scope='row'>{html.escape(FIELDS[name].label)}</th>"
            f"<td>{_with_unit(name, getattr(result.design, name))}</td><td>{where(result, name)}</td></tr>"
            for name in result
        )
        self.table.object = (
            "<table><thead><tr><th>All others held</th><th>now</th><th>complies</th></tr></thead>"
            f"<tbody>{rows}</tbody></table>"
        )

    def build(self):
        """Return what is put on the page."""
        return panel(caption("How far?", HOW_FAR), self.sentence, self.table)


class WhatMatters(Asked):
    """What changes when each number does: band by band, and one figure at a time."""

    kind = "sensitivity"

    def __init__(self, assessment, definition):
        super().__init__(assessment, definition)
        self.change = pmui.FloatInput(
            label="Change, %", value=10.0, start=0.1, end=90.0, step=1.0, size="small", width=130, **BOX
        )
        self.figure = pn.widgets.Select(
            label="Figure",
            options=["margin"],
            width=230,
            stylesheets=[theme.SELECT_CSS],
            margin=(0, 12, 0, 0),
        )
        self.changes, self.tornado = ChangeFigure(), TornadoFigure()
        self.change.param.watch(self.ask, "value")
        self.figure.param.watch(self._draw, "value")

    def settings(self):
        """Return what is asked about the current design."""
        share = (self.change.value or 0) / 100
        design = self.assessment.current.design
        return {"changes": {name: share for name in FIELDS if getattr(design, name) is not None}}

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
            pn.FlexBox(self.change, self.figure, margin=(0, 12)),
            self.sentence,
            beside(self.changes.model, self.tornado.model),
        )


class HowSure(Asked):
    """How sure the design is to comply when production scatters."""

    kind = "tolerance"

    def __init__(self, assessment, definition):
        super().__init__(assessment, definition)
        self.tolerances = {
            name: pmui.FloatInput(
                label=f"{FIELDS[name].label}, ± %",
                value=share,
                start=0.0,
                end=90.0,
                step=1.0,
                size="small",
                width=190,
                **BOX,
            )
            for name, share in USUAL_TOLERANCES.items()
        }
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

    def settings(self):
        """Return what is asked about the current design."""
        design, kind = self.assessment.current.design, self.shape.value
        half = 1.0 if kind == "uniform" else 0.5
        given = {
            name: {kind: half * box.value / 100}
            for name, box in self.tolerances.items()
            if box.value and _is_number(design, name)
        }
        if not given:
            raise ValueError("Give one of the tolerances: with none, nothing scatters.")
        return {"tolerances": given, "samples": self.samples.value, "seed": self.seed.value or 0}

    def show(self, result):
        """Draw the percentiles, and say what to tighten."""
        specification, current = self.assessment.specification, self.assessment.current
        limit = np.full(tig.BAND_CENTRES.size, np.nan) if specification is None else specification.levels
        self.percentiles.show(result.percentiles, current.levels, limit)
        low, _, high = result.margin_percentiles
        rows = "".join(
            f"<tr><th scope='row'>{html.escape(FIELDS[name].label)}</th><td>{100 * share:.1f} %</td></tr>"
            for name, share in result.tightened.items()
        )
        self.table.object = (
            f"<p>Governing margin of nine in ten: {formats.signed_text(low)} to "
            f"{formats.signed_text(high)} dB. "
            f"Worst corner of all tolerances: {formats.signed_text(result.worst_margin)} dB. "
            f"{result.samples} samples, seed {result.seed}.</p>"
            "<table><thead><tr><th>With half the scatter of</th><th>complies</th></tr></thead>"
            f"<tbody>{rows}</tbody></table>"
        )

    def build(self):
        """Return what is put on the page."""
        return panel(
            caption("How sure?", HOW_SURE),
            pn.FlexBox(*self.tolerances.values(), margin=(0, 12)),
            pn.FlexBox(
                *(self.shape, self.samples, self.seed, self.button, self.progress, self.stop), margin=(0, 12)
            ),
            self.sentence,
            bokeh_pane(self.percentiles.model),
            self.table,
        )


class Map(Asked):
    """A figure over two fields, with the edge of compliance; a tap takes the design."""

    kind = "map"

    def __init__(self, assessment, definition, take):
        super().__init__(assessment, definition)
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
            self.place,
            sizing_mode="stretch_width",
            margin=0,
        )


class Search(Asked):
    """Designs that comply, on the front of margin against what else counts."""

    kind = "find"

    def __init__(self, assessment, definition, take, pin):
        super().__init__(assessment, definition)
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
        self.seed = pmui.IntInput(label="Seed", value=0, start=0, size="small", width=110, **BOX)
        self.button.label = "Find designs"
        self.take = pmui.Button(
            label="Take to the sliders", icon="tune", disabled=True, on_click=self._take_chosen, **BUTTON
        )
        self.pin = pmui.Button(
            label="Pin", icon="push_pin", disabled=True, on_click=self._pin_chosen, **BUTTON
        )
        self.cloud = CloudFigure(self._choose)
        self.against.param.watch(self._offer_prices, "value")
        self.inquiry.param.watch(NextTick(self._grow), "so_far")

    def settings(self):
        """Return what is asked about the current design."""
        design = self.assessment.current.design
        free = [name for name in self.free.value if _is_number(design, name)]
        if not free:
            raise ValueError("Choose which numbers are free.")
        settings = {"free": free, "objectives": ["margin", self.against.value], "seed": self.seed.value or 0}
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
        names = [name for name in found.free if name in FIELDS]
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
        self._pin(self._design())

    def build(self):
        """Return what is put on the page."""
        pictures = (self.cloud.objectives, self.cloud.fields, self.cloud.gains)
        return pn.Column(
            pn.FlexBox(self.free, margin=(0, 12)),
            pn.FlexBox(
                self.against,
                *self.prices.values(),
                self.seed,
                self.button,
                self.progress,
                self.stop,
                margin=(0, 12),
            ),
            self.sentence,
            pn.Row(self.take, self.pin, margin=(0, 12)),
            beside(*pictures),
            sizing_mode="stretch_width",
            margin=0,
        )


class Decide(Tab):
    """Four questions about the current design.

    Parameters
    ----------
    inputs : DesignInputs
        Where a design that is found is taken to.
    definition : GainDefinition
        Which insertion gain is meant.
    pins : Pins
        Where it is pinned.
    assessment : Assessment
        Current design, specification and source.
    """

    title = "Decide"
    link_name = "decide"

    def __init__(self, inputs, definition, pins, assessment):
        super().__init__()
        self._inputs, self._pins = inputs, pins
        self.how_far = HowFar(assessment, definition)
        self.what_matters = WhatMatters(assessment, definition)
        self.how_sure = HowSure(assessment, definition)
        self.map = Map(assessment, definition, self._take)
        self.search = Search(assessment, definition, self._take, self._pin)
        assessment.param.watch(self.refresh, "results")

    def refresh(self, *_):
        """Answer for the current design what takes milliseconds."""
        if self.in_sight:
            self.how_far.ask()
            self.what_matters.ask()

    def _take(self, design):
        self._inputs.take(values_of(design))

    def _pin(self, design):
        try:
            # as the sliders show it: a study of it opens as it was saved
            shown = design_of(self._inputs.to_values() | values_of(design))
            pin = self._pins.add(shown, "Found", self._inputs.preset)
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
        )
        parts = (each.build() for each in (self.how_far, self.what_matters, self.how_sure))
        for part in (*parts, panel(caption("Which one?", WHICH_ONE), which)):
            part.margin = (0, 8, 8, 8)
            place.append(part)
            yield


BUTTON = {"size": "small", "variant": "outlined", "margin": (10, 8, 6, 0)}
BOX = {"margin": (6, 12, 6, 0)}

HOW_FAR = "where the design complies along each number, all others held"
WHAT_MATTERS = "what changes when a number does; the map shows the change of insertion gain when it is more"
HOW_SURE = "how much of production complies, when numbers scatter by their tolerances"
WHICH_ONE = "designs over two numbers, or a search over several"


def beside(*figures):
    """Return figures side by side, or below each other where there is no room."""
    panes = [bokeh_pane(each) for each in figures]
    return pn.Column(*panes, stylesheets=[theme.FITTING_CSS], sizing_mode="stretch_width", margin=0)


def where(result, name):
    """Return where a design complies along a field, in the slider's unit."""
    intervals, (least, greatest) = result[name], result.ranges[name]
    if not intervals:
        return "nowhere"
    texts = []
    for low, high in intervals:
        if low == least and high == greatest:
            return "everywhere"
        if low == least:
            texts.append(f"at most {_with_unit(name, high)}")
        elif high == greatest:
            texts.append(f"at least {_with_unit(name, low)}")
        else:
            texts.append(f"{_with_unit(name, low)} to {_with_unit(name, high)}")
    return " or ".join(texts)


def _with_unit(name, value):
    field = FIELDS[name]
    return f"{value / field.factor:.4g} {field.unit}".rstrip()


def _numbers():
    return {field.label: name for name, field in FIELDS.items()}


def _is_number(design, name):
    return isinstance(getattr(design, name), float)


def _axis(name):
    """Return what an objective is called, and what turns it into the unit that is shown."""
    if name in FIELDS:
        return FIELDS[name].labelled, 1 / FIELDS[name].factor
    return FIGURE_WORDS[name]
