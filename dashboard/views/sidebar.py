"""The sidebar: every input of the design in one panel, in the order of the load path.

The panel draws what the table of fields holds. Whatever the user sets is answered once the picture of it has
been drawn or given up: then the browser sends what has been set meanwhile. A control changes inputs and
nothing else.
"""

from panel.viewable import Viewer

import trackig_core as tig
from dashboard.client.exchange import notify
from dashboard.client.quantities import Quantities
from dashboard.fields import (
    CLOSED_GROUPS,
    EVERY_FIELD,
    FIELDS,
    GROUND,
    GROUPS,
    INPUTS,
    NUMBERS,
    RAIL_FIELDS,
    SECOND_STAGE,
    SURROUNDINGS,
    SUSPENDED,
)
from dashboard.session import surroundings
from dashboard.session.inputs import display_values, values_of
from dashboard.session.special import OWN_RAIL, curve_text, is_curve, rail_text

FIRST_ROWS = {
    "Block and boot": ("two_stage",),
    SUSPENDED: ("suspension", "axle_positions"),
    GROUND: ("ground",),
}
LAST_ROWS = {"Track": ("rail",)}
"""Inputs that are no numbers, by the group that they begin or end."""

KINDS = {"Rail pad": ["pad"], "Block and boot": ["block", "boot"], "Track": ["rail"]}
"""Kinds of component of the catalogue that a group may be set from."""

OTHERS = {"rail": [["of its own mass and EI or I …", OWN_RAIL]]}
"""What may be chosen besides an input's own options, words first."""


class Controls(Viewer):
    """All controls of the sidebar.

    Parameters
    ----------
    inputs : DesignInputs
        What they change.
    outcome : Outcome
        Says when the picture of a change has been drawn.
    shelf : Shelf
        The catalogue from which components are chosen.
    on_curve : callable, optional
        Called with the name of an input whose curve is to be looked at.
    feasibility : Feasibility, optional
        Where the design complies along each slider; by default nothing is drawn on them.
    """

    def __init__(self, inputs, outcome, shelf, on_curve=None, feasibility=None):
        super().__init__()
        self._inputs, self._outcome, self._shelf = inputs, outcome, shelf
        self._number, self._due, self._taking = 0, False, False
        self.quantities = Quantities(groups=groups(inputs), sizing_mode="stretch_width", margin=0)
        self.quantities.on_set = self._take
        self.quantities.on_revert = inputs.revert
        self.quantities.on_chip = on_curve
        self.quantities.on_pick = self._pick
        inputs.param.watch(self._show, [*INPUTS, "modified", "refused"])
        outcome.param.watch(self._answer, ["summary", "busy", "progress", "problem", "compiling"])
        shelf.param.watch(self._offer, "catalogue")
        self._offer()
        self._show()
        self._feasibility = feasibility
        if feasibility is not None:
            feasibility.param.watch(self._show_feasible, ["result", "problem", "stale"])
            self._show_feasible()

    def _show_feasible(self, *_):
        known = self._feasibility
        self.quantities.param.update(feasible=known.stretches, stale=known.stale)

    def _offer(self, *_):
        catalogue = self._shelf.catalogue
        kinds = [kind for each in KINDS.values() for kind in each]
        self.quantities.catalogue = {kind: list(catalogue.of_kind(kind)) for kind in kinds}

    def _pick(self, kind, name):
        try:
            design = self._shelf.fitted(kind, name, self._inputs.to_design())
        except tig.DesignError as error:
            notify("warning", f"Nothing has changed: {error}.")
        else:
            if design is not None:
                self._inputs.take(values_of(design))

    def _take(self, number, given, gesture):
        self._number, self._due, self._taking = number, True, True
        try:
            self._inputs.take_given(given, gesture)
        finally:
            self._taking = False
            self._show()
            self._answer()

    def _show(self, *_):
        if self._taking:
            return
        inputs = self._inputs
        marks = display_values(inputs.preset_design)
        self.quantities.state = {
            "number": self._number,
            "values": shown_values(inputs),
            "refused": inputs.refused,
            "disabled": disabled(inputs),
            "words": {"rail": rail_text(inputs.special["rail"])} if "rail" in inputs.special else {},
            "hidden": [] if "rail" in inputs.special else list(RAIL_FIELDS),
            "marks": {name: marks[name] for name in NUMBERS if name in marks},
            "modified": inputs.modified,
        }
        self.quantities.chips = chips(inputs)

    def _answer(self, *_):
        if self._due and not self._taking and self._is_settled():
            self._due = False
            self.quantities.answer(self._number)

    def _is_settled(self):
        """Return whether the inputs' picture has been drawn, or will not be soon."""
        outcome = self._outcome
        if outcome.compiling or outcome.progress is not None or (outcome.problem and not outcome.busy):
            return True
        return outcome.summary is not None and outcome.summary.design == self._inputs.to_design()

    def __panel__(self):
        """Return what is put on the page."""
        return self.quantities


def groups(inputs):
    """Return what the panel shows, from the table of fields.

    Parameters
    ----------
    inputs : DesignInputs
        Labels and options of choices.

    Returns
    -------
    list of dict
        Title, fields, kinds of component, and whether closed at first, of each group.
    """
    track = [_choice(inputs, "preset", replaces=True), {"kind": "departure", "label": "Back to Table 1"}]
    found = [{"title": "", "closed": False, "kinds": [], "fields": track}]
    for title in GROUPS:
        rows = [_other(inputs, name) for name in FIRST_ROWS.get(title, ())]
        rows += [_number(field) for field in EVERY_FIELD.values() if field.group == title]
        rows += [_other(inputs, name) for name in LAST_ROWS.get(title, ())]
        rows += [_number(field) for field in RAIL_FIELDS.values() if field.group == title]
        found.append(
            {
                "title": title,
                "closed": title in CLOSED_GROUPS,
                "kinds": KINDS.get(title, []),
                "fields": rows,
            }
        )
    return found


def chips(inputs):
    """Return what stands in the place of sliders, in words by name: curves as measured.

    Parameters
    ----------
    inputs : DesignInputs
        The current design.

    Returns
    -------
    dict of str to str
        Words of each chip.
    """
    curves = {name: each for name, each in inputs.special.items() if is_curve(each)}
    found = {name: curve_text(curve) for name, curve in curves.items()}
    for name, curve in curves.items():
        if isinstance(curve, tig.StiffnessCurve):
            found[name.replace("stiffness", "loss_factor")] = "measured with the stiffness"
    return {name: words for name, words in found.items() if inputs.two_stage or name not in SECOND_STAGE}


def shown_values(inputs):
    """Return what the controls show, by name: numbers [display units], switches, and keys of choices."""
    around = {name: getattr(inputs, name) for name in SURROUNDINGS}
    return inputs.to_shown() | {name: surroundings.chosen(name, around) for name in SURROUNDINGS}


def disabled(inputs):
    """Return the names of inputs that mean nothing for the design (list of str).

    A single-stage track has no second stage, and one wheel follows no other at any speed.
    """
    second_stage = [] if inputs.two_stage else [*SECOND_STAGE]
    return [*second_stage, *([] if len(inputs.axle_positions) > 1 else ["speed"])]


def _number(field):
    shown = ("name", "label", "labelled", "unit", "low", "high", "step", "logarithmic", "words", "blank")
    given = {name: getattr(field, name) for name in shown}
    return {"kind": "number", "ranged": field.name in FIELDS, **given}


def _other(inputs, name):
    if name in SURROUNDINGS:
        return _surroundings(name)
    if isinstance(getattr(inputs, name), bool):
        return {"kind": "switch", "name": name, "label": inputs.param[name].label}
    return _choice(inputs, name)


def _surroundings(name):
    """Return a choice from the catalogue, which says a study's own values too while there are any."""
    return {
        "kind": "choice",
        "name": name,
        "label": surroundings.LABELS[name],
        "options": [*map(list, surroundings.CHOICES[name].items()), ["the study's own", surroundings.OWN]],
        "given": surroundings.OWN,
        "words": surroundings.WORDS[name],
        "replaces": False,
    }


def _choice(inputs, name, replaces=False):
    """Return a choice; one that replaces sets all other inputs too."""
    parameter = inputs.param[name]
    options = [list(each) for each in parameter.names.items()] + OTHERS.get(name, [])
    return {
        "kind": "choice",
        "name": name,
        "label": parameter.label,
        "options": options,
        "replaces": replaces,
    }
