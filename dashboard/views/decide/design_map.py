"""A figure over two numbers of the design, with the edge of compliance."""

import panel as pn

import trackig_core as tig
from dashboard import theme
from dashboard.compute.document import NextTick
from dashboard.fields import ASKED_FIELDS
from dashboard.figures.decide import MapFigure
from dashboard.session.answers import FIGURE_WORDS, field_label, with_unit
from dashboard.session.surroundings import is_simplified
from dashboard.views.components import bokeh_pane
from dashboard.views.decide.asked import Asked, said, what_is_missing
from dashboard.views.decide.inputs import choice, number_options, offer
from trackig_core.decide.words import how_much, sentence

SURROUNDED_POINTS = [80, 80]
"""Points along both fields of a design with a vehicle, several axles or ground that yields [-]: each takes 1
to 2 ms of a processor, where one of the simplified model takes 0.05 ms."""


class Map(Asked):
    """A figure over two fields, with the edge of compliance; a tap takes the design."""

    kind = "map"
    ages = True
    before = "Choose two numbers and a figure, then press “Draw the map”: it shows where designs comply."
    hint = (
        "Tap a design to take it to the sliders, or move to it with the arrow keys and press Enter; "
        "Ctrl+Z brings the old one back."
    )

    def __init__(self, snapshot, exchange, take):
        super().__init__(snapshot, exchange)
        self._take = take
        self.x, self.y = (
            choice(
                label=words,
                options=number_options(self.assessment.current.design),
                value=name,
                width=200,
            )
            for words, name in (("Across", "boot_stiffness"), ("Up", "block_mass"))
        )
        self.figure = choice(
            label="Figure",
            options={words: name for name, (words, _) in FIGURE_WORDS.items() if name != "cost"}
            | {f"Insertion gain at {label} Hz, dB": label for label in tig.BAND_LABELS},
            width=250,
        )
        self.map = MapFigure(self._tapped)
        self.place = pn.Column(sizing_mode="stretch_width", margin=0)
        self.drawn = (self.place,)
        self.under_cross = pn.pane.HTML(
            "", stylesheets=[theme.ANSWER_CSS], sizing_mode="stretch_width", margin=(0, 12)
        )
        exchange.on_key("map_figure", self._key)
        self.assessment.param.watch(NextTick(self._mark), "results")
        self.button.label = "Draw the map"
        self.figure.param.watch(self.ask_again, "value")
        snapshot.boxes.keep(across=self.x, up=self.y, map_figure=self.figure)

    def offer(self):
        """Offer the numbers that the current design has; two axes are never given the same."""
        options = number_options(self.assessment.current.design)
        offer(self.x, options)
        offer(self.y, options, taken=self.x.value)

    def ask_again(self, *_):
        """Draw another figure of a map that was asked for."""
        if self.inquiry.asked is not None:
            self.ask()

    def settings(self):
        """Return what is asked about the current design."""
        if self.x.value == self.y.value:
            raise ValueError(f"Across and up are both {field_label(self.x.value)}: choose two numbers.")
        specification = self.assessment.in_force
        if specification is None and self.figure.value == "margin":
            raise ValueError(what_is_missing(self.assessment))
        edges = [] if specification is None else ["margin"]
        if specification is not None and specification.rail_deflection_limit is not None:
            edges.append("deflection")
        figures = list(dict.fromkeys([self.figure.value, *edges]))
        settings = {"x_field": self.x.value, "y_field": self.y.value, "figures": figures}
        simplified = is_simplified(self.assessment.current.design)
        return settings if simplified else settings | {"points": SURROUNDED_POINTS}

    def varied(self, settings):
        """Return both fields: the map is of all that they may be."""
        return (settings["x_field"], settings["y_field"])

    def show(self, result):
        """Draw the map."""
        name = next(iter(result.figures))
        words = next(words for words, each in self.figure.options.items() if each == name)
        specification = self.assessment.in_force
        limits = {} if specification is None else {"margin": 0.0}
        if "deflection" in result.figures and specification is not None:
            limits["deflection"] = specification.rail_deflection_limit
        self.map.show(result, name, words, self._designs, limits)
        self.under_cross.object = ""
        self.place.objects = [bokeh_pane(self.map.layout)]

    def words(self, result):
        """Return the answer in one sentence."""
        x, y = (ASKED_FIELDS[name].marked.lower() for name in (result.x_field, result.y_field))
        if result.complies is None:
            return f"{result.x.size} times {result.y.size} designs over {x} and {y}."
        share = float(result.complies.mean())
        verb = "complies" if share == 0 else "comply"
        return sentence(f"{how_much(share)} of the designs over {x} and {y} {verb}.")

    @property
    def _designs(self):
        return [self.assessment.current, *self.assessment.shown_pins]

    def _mark(self, *_):
        if self.assessment.current is not None:
            self.map.mark(self._designs)

    def _key(self, key, far):
        """Move the cross by a key and say what is under it, or take it."""
        result, place = self.inquiry.result, self.map.move(key, far)
        if place is None:
            return
        column, row = place
        x, y = float(result.x[column]), float(result.y[row])
        if key == "Enter":
            self._take(result.design_at(x, y), result.design)
        name, values = next(iter(result.figures.items()))
        words, scale = FIGURE_WORDS.get(name, (f"Insertion gain at {name} Hz, dB", 1.0))
        quantity, _, unit = words.partition(", ")
        verdict = "" if result.complies is None else "complies" if result.complies[row, column] else "fails"
        where = f"{field_label(result.x_field)} {with_unit(result.x_field, x)}"
        where += f", {field_label(result.y_field)} {with_unit(result.y_field, y)}"
        found = f"{quantity.lower()} {scale * values[row, column]:.4g} {unit}"
        self.under_cross.object = said(
            sentence(f"{where}: {'; '.join(filter(None, (found, verdict)))}."), "note"
        )

    def _tapped(self, x, y):
        result = self.inquiry.result
        if result is not None and x is not None and y is not None:
            values = (ASKED_FIELDS[result.x_field].factor * x, ASKED_FIELDS[result.y_field].factor * y)
            self._take(result.design_at(*values), result.design)

    def build(self):
        """Return what is put on the page."""
        return pn.Column(
            pn.FlexBox(self.x, self.y, self.figure, self.button, self.progress, self.stop, margin=(0, 12)),
            self.sentence,
            self.answered_row,
            self.under_cross,
            self.place,
            sizing_mode="stretch_width",
            margin=0,
        )
