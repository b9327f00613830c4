"""Boxes and options from which several of the questions are put together."""

import math

import panel as pn
import panel_material_ui as pmui

from dashboard import theme
from dashboard.fields import ASKED_FIELDS, FIELDS
from dashboard.formats import quantity_text
from dashboard.views.decide.asked import BOX
from trackig_core.decide.numbers import changeable_numbers, single_numbers
from trackig_core.names import brief
from trackig_core.track.fields import RANGES
from trackig_core.typed_numbers import NumberError, read_number


class NumberBox(pmui.TextInput):
    """A box for a number, read as anywhere: with a decimal comma, or with its unit behind it.

    Panel's own boxes for numbers have buttons without a name beside them, and lose what is typed after Enter.

    Parameters
    ----------
    label : str
        What the box is called; its end says the unit.
    value : float or str
        The number at first [unit], or the text that stands for it.
    unit : str
        Unit of the number; empty if it has none.
    most : float
        The greatest number that may be given [unit]; the least is 0, as is an empty box.
    whole : bool
        Whether it must be a whole number.
    """

    def __init__(self, label, value, unit="", most=math.inf, whole=False, **look):
        text = value if isinstance(value, str) else quantity_text(value)
        super().__init__(label=label, value=text, max_length=40, size="small", **BOX, **look)
        self._unit, self._most, self._whole = unit, most, whole
        self.param.watch(self._mark, "value")

    @property
    def number(self):
        """The number as it was typed [unit]; a ValueError says why there is none."""
        text = self.value.strip()
        try:
            number = read_number(text, self._unit) if text else 0.0
        except NumberError as error:
            raise ValueError(f"{self.label}: {error}.") from None
        if not 0 <= number <= self._most:
            span = "or more" if self._most == math.inf else f"to {quantity_text(self._most)} {self._unit}"
            raise ValueError(f"{self.label}: {brief(text)}: give 0 {span.rstrip()}.")
        if self._whole and number != int(number):
            raise ValueError(f"{self.label}: {brief(text)}: give a whole number.")
        return int(number) if self._whole else number

    def _mark(self, *_):
        """Say at the box itself why it holds no number."""
        try:
            _ = self.number
        except ValueError as error:
            said = str(error).removeprefix(f"{self.label}: ")
        else:
            said = ""
        self.param.update(error_state=bool(said), helper_text=said)


def percent_box(name, value):
    """Return a box for a share of a field [%]."""
    return NumberBox(f"{ASKED_FIELDS[name].label}, ± %", value, "%", most=MOST_CHANGE, width=190)


MOST_CHANGE = 90.0
"""How far a field may be changed, or scatter [%]."""


def seed_box():
    """Return a box for the seed of what is drawn by chance."""
    return NumberBox("Seed", 0, whole=True, most=MOST_SEED, width=110)


MOST_SEED = 2**31 - 1
"""A seed beyond which figures would not fit into a study file."""


def choice(label, options, width, **words):
    """Return a box to choose one of several options."""
    return pn.widgets.Select(
        label=label,
        options=options,
        width=width,
        stylesheets=[theme.SELECT_CSS],
        margin=(0, 12, 0, 0),
        **words,
    )


def titled(title, boxes):
    """Return boxes to tick below what they are called together."""
    name = pn.pane.HTML(f"<h3>{title}</h3>", stylesheets=[theme.ANSWER_CSS], margin=(0, 12))
    boxes.margin = (0, 12)
    return pn.Column(name, boxes, sizing_mode="stretch_width", margin=0)


def factor_label(name):
    """Return what scatters, as it is spoken."""
    return ASKED_FIELDS[name].marked.lower() if name in ASKED_FIELDS else "measured specimens"


def number_options(design, given=True):
    """Return the numbers that have a slider, and those of vehicle and ground that a design has, by label.

    Parameters
    ----------
    design : trackig_core.TrackDesign
        The design.
    given : bool
        Whether numbers are offered that no track's supplier chooses.

    Returns
    -------
    dict of str to str
        Name by label, which says whose a number is.
    """
    around = [name for name in single_numbers(design) if name not in FIELDS]
    fields = [ASKED_FIELDS[name] for name in (*FIELDS, *around)]
    return {each.marked: each.name for each in fields if given or not each.whose}


def given_box(changed):
    """Return a box to tick where numbers that the track's supplier does not choose are to take part."""
    box = pmui.Checkbox(label="Vehicle and site too", size="small", margin=(8, 12, 0, 8))
    box.param.watch(changed, "value")
    return box


def offer(box, options, taken=None):
    """Have a box offer some options, and keep what is chosen as far as it is still among them.

    Where it is not, the first of the options is chosen that is not taken by another box.
    """
    if box.options == options:
        return
    there = list(options.values())
    if isinstance(box.value, list):
        value = [each for each in box.value if each in there]
    else:
        value = box.value if box.value in there else next(each for each in there if each != taken)
    box.param.update(options=options, value=value)


def is_number(design, name):
    """Return whether a field of a design is a single number: neither absent nor measured over frequency."""
    return isinstance(design.value(name), float)


class ShareBoxes:
    """Boxes for a share of each number: of some that have a slider, of vehicle and ground of what is there.

    Parameters
    ----------
    shares : dict of str to float
        What stands in the boxes of numbers with a slider at first, by name [%].
    around : float
        What stands at first in those of vehicle and ground [%].
    exchange : Exchange
        Prepares the browser for boxes that are added.
    changed : callable, optional
        Called when a share changes.
    **words
        Of the row that holds the boxes.

    Attributes
    ----------
    boxes : dict of str to NumberBox
        The boxes by name of the number.
    row : panel.FlexBox
        All of them.
    """

    def __init__(self, shares, around, exchange, changed=None, **words):
        self._around, self._exchange, self._changed = around, exchange, changed
        self._keep, self.boxes = None, {}
        self.row = pn.FlexBox(margin=(0, 12), **words)
        self._add(shares)

    def _add(self, shares):
        for name, share in shares.items():
            box = self.boxes[name] = percent_box(name, share)
            if self._changed is not None:
                box.param.watch(self._changed, "value")
        self.row.objects = list(self.boxes.values())
        if self._keep is not None:
            self._keep(shares)

    def keep(self, boxes, what):
        """Keep what stands in all of them, and in those that are added.

        Parameters
        ----------
        boxes : Boxes
            Where it is kept.
        what : str
            What the shares are, by which they are kept.
        """
        self._keep = lambda names: boxes.keep(**{f"{what} of {name}": self.boxes[name] for name in names})
        self._keep(self.boxes)

    def offer(self, design):
        """Have boxes for those numbers of vehicle and ground that a design has."""
        there = [name for name in changeable_numbers(design) if name in AROUND]
        added = [name for name in there if name not in self.boxes]
        if added:
            self._add(dict.fromkeys(added, self._around))
            self._exchange.introduce()
        for name in AROUND & self.boxes.keys():
            self.boxes[name].visible = name in there

    def change_all(self, share):
        """Have the same share in all boxes, and in those that are added: text, as it was typed [%]."""
        self._around = share
        for box in self.boxes.values():
            box.value = share

    def shares(self, design, reach=1.0):
        """Return the shares of what a design has, none of which is zero, by name [-].

        Parameters
        ----------
        design : trackig_core.TrackDesign
            The design.
        reach : float
            How many times its share a number may be away from what is stated [-].

        Raises
        ------
        ValueError
            If a box holds no share, or one with which its number would leave what a track can have.
        """
        there = changeable_numbers(design)
        given = {name: box.number for name, box in self.boxes.items() if name in there}
        for name, share in given.items():
            if share > (most := _largest_share(design, name) / reach):
                raise ValueError(
                    f"{self.boxes[name].label}: {quantity_text(share)}: give 0 to "
                    f"{quantity_text(math.floor(10 * most) / 10)} %; {_span_words(name)}."
                )
        return {name: share / 100 for name, share in given.items() if share}


def _largest_share(design, name):
    """Return how far a number of a design may be away from what is stated [%]."""
    stated = design.value(name)
    if not isinstance(stated, float):
        return MOST_CHANGE
    low, high, _ = RANGES[name]
    return 100 * min(MOST_CHANGE / 100, 1 - low / stated, high / stated - 1)


def _span_words(name):
    """Return what a track can have of a number, in words and in the unit that is shown."""
    field = ASKED_FIELDS[name]
    low, high = (quantity_text(end / field.factor) for end in RANGES[name][:2])
    return f"a track has a {field.label.lower()} of {low} to {high} {field.unit}".rstrip()


AROUND = ASKED_FIELDS.keys() - FIELDS.keys()
"""Numbers of vehicle and ground."""
