"""Designs that comply, and the best of them."""

import dataclasses
import math

import numpy as np
import panel as pn
import panel_material_ui as pmui

import trackig_core as tig
from dashboard import formats, theme
from dashboard.compute.document import NextTick
from dashboard.fields import ASKED_FIELDS
from dashboard.figures.decide import CloudFigure
from dashboard.figures.legends import with_legend
from dashboard.session.answers import FIGURE_WORDS, field_label, with_unit
from dashboard.views.decide.asked import BOX, BUTTON, SMALL_BUTTON, Asked, beside, said
from dashboard.views.decide.inputs import (
    NumberBox,
    choice,
    given_box,
    is_number,
    number_options,
    offer,
    seed_box,
    titled,
)
from trackig_core.decide.words import away, sentence
from trackig_core.names import LONGEST_NAME
from trackig_core.track.fields import DEFAULT_WHEEL_LOAD


class Search(Asked):
    """Designs that comply, on the front of margin against what else counts."""

    kind = "find"
    ages = True
    before = (
        "Choose which numbers are free, then press “Find designs”: the best ones come as pictures while it "
        "searches. It takes a specification."
    )
    hint = (
        "Brush the pictures to see insertion gain of several; tap a design to take or pin it, or go through "
        "the best ones with the arrow keys and press Enter."
    )

    def __init__(self, snapshot, exchange, take, pin, shelf):
        super().__init__(snapshot, exchange)
        self._shelf = shelf
        self._take, self._pin, self._chosen = take, pin, None
        self.free = pn.widgets.CheckBoxGroup(
            label="Free",
            options=number_options(self.assessment.current.design, given=False),
            value=["pad_stiffness", "block_mass", "boot_stiffness"],
            inline=True,
            stylesheets=[theme.CHECKS_CSS],
            margin=(0, 12, 0, 0),
        )
        self.given = given_box(self.offer)
        self.against = choice(
            label="Greatest margin against least",
            options={
                "rail deflection": "deflection",
                "block mass": "block_mass",
                "boot stiffness": "boot_stiffness",
                "cost": "cost",
            },
            width=220,
        )
        self.prices = {
            name: NumberBox(words, price, width=200, visible=False)
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
        self.deflection = NumberBox(
            "Rail sinks at most, mm (0: as specified)", 0.0, "mm", most=100.0, width=290
        )
        self.limit = pmui.Button(
            label="Limit it to what this design sinks",
            icon="vertical_align_top",
            on_click=self._limit,
            **SMALL_BUTTON,
        )
        self.unlimited = pn.Column(
            pn.pane.HTML(
                said(UNLIMITED, "note"), stylesheets=[theme.ANSWER_CSS], sizing_mode="stretch_width", margin=0
            ),
            self.limit,
            sizing_mode="stretch_width",
            margin=(0, 12),
        )
        self.explained = pn.pane.HTML(
            "", stylesheets=[theme.ANSWER_CSS], sizing_mode="stretch_width", margin=(0, 12)
        )
        self.seed = seed_box()
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
        self.parts = pn.pane.HTML(
            "", stylesheets=[theme.ANSWER_CSS], sizing_mode="stretch_width", margin=(0, 12)
        )
        self.cloud = CloudFigure(self._choose)
        objectives = with_legend(self.cloud.objectives, self.cloud.legend)
        self._pictures = beside(objectives, self.cloud.fields, self.cloud.gains)
        self.place = pn.Column(sizing_mode="stretch_width", margin=0)
        self.drawn = (self.place,)
        for figure in (self.cloud.objectives, self.cloud.fields):
            exchange.on_key(figure.name, self._key)
        self.against.param.watch(self._offer_prices, "value")
        self.deflection.param.watch(self._warn, "value")
        self.assessment.param.watch(self._warn, "specification")
        self._offer_prices()
        self._warn()
        self.inquiry.param.watch(NextTick(self._grow), "so_far")
        snapshot.boxes.keep(
            vehicle_and_site=self.given,
            free=self.free,
            chosen=self.chosen,
            against=self.against,
            sinks_at_most=self.deflection,
            search_seed=self.seed,
            name_of_found=self.pin_name,
            **{f"price of {name}": box for name, box in self.prices.items()},
        )

    def offer(self, *_):
        """Offer the numbers that the current design has, those of vehicle and site only when asked for."""
        offer(self.free, number_options(self.assessment.current.design, self.given.value))

    def settings(self):
        """Return what is asked about the current design."""
        design = self.assessment.current.design
        choices = {kind: catalogued(kind, design, self._shelf.catalogue) for kind in self.chosen.value}
        choices = {kind: offered for kind, offered in choices.items() if offered}
        taken = {name for offered in choices.values() for each in offered for name in each}
        free = [name for name in self.free.value if is_number(design, name) and name not in taken]
        if not free and not choices:
            raise ValueError("Choose which numbers are free.")
        settings = {"free": free, "objectives": ["margin", self.against.value], "seed": self.seed.number}
        if choices:
            settings["choices"] = choices
        if self.deflection.number:
            settings["max_deflection"] = self.deflection.number / 1e3
        if self.against.value == "cost":
            prices = {name: box.number for name, box in self.prices.items()}
            prices["fastener_spacing"] *= -1
            settings["cost"] = {name: price for name, price in prices.items() if price}
        return settings

    def varied(self, settings):
        """Return what was free, and all fields of parts that were chosen from the catalogue."""
        fields = [each.name for each in dataclasses.fields(tig.TrackDesign)]
        kinds = settings.get("choices", {})
        chosen = [name for name in fields if name.partition("_")[0] in kinds]
        return (*settings["free"], *chosen)

    def _offer_prices(self, *_):
        for box in self.prices.values():
            box.visible = self.against.value == "cost"
        words = next(words for words, name in self.against.options.items() if name == self.against.value)
        self.explained.object = said(EXPLAINED.format(words), "note")

    def _warn(self, *_):
        """Say that a search without a limit of deflection runs to soft corners."""
        specification = self.assessment.in_force
        limited = specification is not None and specification.rail_deflection_limit is not None
        self.unlimited.visible = not limited and self.deflection.value.strip() in ("", "0")

    def _limit(self, *_):
        """Limit the deflection to that of the current design."""
        specification = self.assessment.in_force
        load = DEFAULT_WHEEL_LOAD if specification is None else specification.wheel_load
        sinks = tig.static_response(self.assessment.current.design, load).rail_deflection
        # up, so that the design itself keeps it
        self.deflection.value = formats.quantity_text(math.ceil(1e6 * sinks) / 1e3)

    def _grow(self):
        if self.inquiry.so_far is not None:
            self._say(self.words(self.inquiry.so_far))
            self.show(self.inquiry.so_far)

    def show(self, found):
        """Draw what was found."""
        specification = self.assessment.in_force
        names = [name for name in ASKED_FIELDS if name in found.free or _varies(found.many, name)]
        fields = [ASKED_FIELDS[name] for name in names]
        ends = {field.name: (field.low * field.factor, field.high * field.factor) for field in fields}
        labels = [
            f"{field.label}\n{formats.quantity_text(field.low)}–"
            f"{formats.quantity_text(field.high)} {field.unit}"
            for field in fields
        ] + [f"{kind.capitalize()}\nby name" for kind in found.chosen]
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
        if not self.place.objects:
            self.place.objects = [self._pictures]
            self._exchange.introduce()

    def words(self, found):
        """Return the answer in one sentence."""
        tried = f"{found.slack.size} designs"
        if not found.front.size:
            miss = -float(found.slack[found.closest])
            if found.in_the_way == "deflection":
                by = f"sinks {10 ** (miss / 20) - 1:.0%} more than allowed"
            else:
                by = f"misses the limit at {found.in_the_way} Hz by {away(miss)}"
            return f"None of {tried} complies; the closest {by}."
        return " ".join(filter(None, (f"{found.summary}.", found.unlimited)))

    def _choose(self, row):
        self._chosen = row
        self.parts.object = "" if row is None else said(chosen_words(self._found(), row), "note")
        for button in (self.take, self.pin):
            button.disabled = row is None

    def _key(self, key, far):
        """Go through the best designs by a key, or take the one that is chosen."""
        self.cloud.move(key, far)
        if key == "Enter" and self._chosen is not None:
            self._take_chosen()

    def _found(self):
        return self.inquiry.result if self.inquiry.so_far is None else self.inquiry.so_far

    def _design(self):
        return self._found().many.design(self._chosen)

    def _take_chosen(self, *_):
        self._take(self._design(), self._found().design)

    def _pin_chosen(self, *_):
        self._pin(self._design(), self._found().design, self.pin_name.value.strip() or "Found")

    def build(self):
        """Return what is put on the page."""
        return pn.Column(
            titled("Free", self.free),
            self.given,
            titled("From the catalogue", self.chosen),
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
            self.unlimited,
            self.sentence,
            self.answered_row,
            pn.FlexBox(self.take, self.pin_name, self.pin, margin=(0, 12)),
            self.parts,
            self.explained,
            self.place,
            sizing_mode="stretch_width",
            margin=0,
        )


UNLIMITED = (
    "No limit of rail deflection is set. Softer always isolates more, so that the search runs to the softest "
    "corner of what is free; set a limit in the box above, or in the tab Specification."
)

EXPLAINED = (
    "“No other beats it”: none of the designs that were tried has as much margin and as little {}, and is "
    "better in one of the two. Which of these is best is for you to weigh."
)

CATALOGUED = {
    "rail": "rail sections",
    "pad": "pads of the catalogue",
    "block": "blocks of the catalogue",
    "boot": "boots of the catalogue",
}
"""What may be chosen from the catalogue that is open, by its kind of component."""


def catalogued(kind, design, catalogue):
    """Return what a search may choose from the catalogue: plain values, as a question takes them.

    Parameters
    ----------
    kind : str
        A kind of component.
    design : trackig_core.TrackDesign
        The design; a single-stage one has no block or boot to choose.
    catalogue : trackig_core.study.Catalogue
        The catalogue.

    Returns
    -------
    list of dict
        Each component with its name and values, measured ones with their curves.
    """
    if kind in ("block", "boot") and not design.two_stage:
        return []
    return [each.choice(design) for each in catalogue.of_kind(kind).values()]


def chosen_words(found, row):
    """Return what a design that was found is and does, in words.

    Parameters
    ----------
    found : trackig_core.decide.FoundDesigns
        What was found.
    row : int
        Which design.

    Returns
    -------
    str
        Its objectives, then what was free and what was chosen from.
    """
    does = []
    for name, value in zip(found.objectives, found.values[row], strict=True):
        words, scale = _axis(name)
        quantity, _, unit = words.partition(", ")
        does.append(f"{quantity.lower()} {scale * value:.4g} {unit}".rstrip())
    if "deflection" not in found.objectives:
        does.append(f"rail deflection {formats.millimetre_text(found.deflections[row])}")
    design = found.many.design(row)
    numbers = [name for name in found.free if name in ASKED_FIELDS]
    parts = [f"{field_label(name)} {with_unit(name, design.value(name))}" for name in numbers]
    parts += [f"{kind} {names[row]}" for kind, names in found.chosen.items()]
    return sentence(f"{', '.join(does)}: {', '.join(parts)}.")


def _varies(many, name):
    column = many.column(name)
    return column.dtype == float and column.min() < column.max()


def _axis(name):
    """Return what an objective is called, and what turns it into the unit that is shown."""
    if name in ASKED_FIELDS:
        return ASKED_FIELDS[name].labelled, 1 / ASKED_FIELDS[name].factor
    return FIGURE_WORDS[name]
