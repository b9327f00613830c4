"""The limit of rail deflection: what a specification allows, and how far the rail sinks with each design.

It is part of the specification and of its verdict. mm and kN on the page.
"""

import dataclasses
import html

import panel as pn
import panel_material_ui as pmui
from panel.viewable import Viewer

import trackig_core as tig
from dashboard import formats, theme
from dashboard.figures.swatches import swatch_svg
from trackig_core.track.fields import DEFAULT_WHEEL_LOAD
from trackig_core.typed_numbers import NumberError, read_number

BOXES = {
    "rail_deflection_limit": ("Rail deflection at most, mm", "mm", 1e-3),
    "wheel_load": ("under a wheel load of, kN", "kN", 1e3),
}
"""Label, unit that is shown, and what one of it is in SI, of each number of the limit."""

NOT_LIMITED = "The rail's deflection is not limited."


class DeflectionLimit(Viewer):
    """Boxes for limit and load, and a row for each design.

    Parameters
    ----------
    assessment : Assessment
        Whose specification is edited.
    """

    def __init__(self, assessment):
        super().__init__()
        self._assessment = assessment
        self.boxes = {
            name: pmui.TextInput(
                label=label, size="small", variant="outlined", width=230, max_length=40, margin=(8, 8, 4, 12)
            )
            for name, (label, _, _) in BOXES.items()
        }
        self.message = pn.pane.HTML("", stylesheets=[theme.MESSAGE_CSS], margin=(0, 12, 4, 12))
        self.table = pn.pane.HTML(
            "", stylesheets=[theme.LEVELS_CSS], sizing_mode="stretch_width", margin=(0, 12, 8, 12)
        )
        self._showing = False
        for name, box in self.boxes.items():
            box.param.watch(lambda event, name=name: self._take(name, event.new), "value")
        assessment.param.watch(self._show_limit, "specification")
        self._show_limit()

    def _take(self, name, text):
        """Take a number that was typed; an empty box takes the limit away, or puts the load back."""
        specification = self._assessment.specification
        if self._showing or (specification is None and not text.strip()):
            return
        _, unit, factor = BOXES[name]
        try:
            value = factor * read_number(text, unit) if text.strip() else EMPTY[name]
            self._assessment.specification = _with(specification, name, value)
        except (NumberError, tig.SpecificationError) as error:
            self.boxes[name].error_state = True
            self._tell(f"Not taken: {error}.")
        else:
            self._show_limit()

    def _tell(self, words):
        self.message.object = f'<div role="alert">{html.escape(words)}</div>' if words else ""

    def _show_limit(self, *_):
        specification = self._assessment.specification
        limit = None if specification is None else specification.rail_deflection_limit
        self._showing = True
        try:
            for name, (_, _, factor) in BOXES.items():
                value = None if limit is None else getattr(specification, name)
                text = "" if value is None else formats.quantity_text(value / factor)
                self.boxes[name].param.update(value=text, error_state=False)
            self.boxes["wheel_load"].disabled = limit is None
        finally:
            self._showing = False
        self._tell("")
        self.show()

    def show(self):
        """Show how far the rail sinks with each design that is shown."""
        self.table.object = deflections_html(self._assessment.shown, self._assessment.specification)

    def __panel__(self):
        """Return what is put on the page."""
        return pmui.Column(
            pmui.FlexBox(*self.boxes.values(), margin=0),
            self.message,
            self.table,
            sizing_mode="stretch_width",
            margin=0,
        )


def _with(specification, name, value):
    """Return a specification with another number; without limit of any band or of the deflection, None."""
    if specification is None:
        return tig.Specification((), **{name: value})
    if not specification.points and name == "rail_deflection_limit" and value is None:
        return None
    return dataclasses.replace(specification, **{name: value})


EMPTY = {"rail_deflection_limit": None, "wheel_load": DEFAULT_WHEEL_LOAD}
"""What an empty box stands for."""


def deflections_html(results, specification):
    """Return deflection and margin of designs as HTML, whatever characters their names are made of.

    Parameters
    ----------
    results : iterable of DesignResult
        Designs with a solution.
    specification : trackig_core.Specification or None
        What limits the deflection, if anything does.
    """
    if specification is None or specification.rail_deflection_limit is None:
        return f"<p>{NOT_LIMITED}</p>"
    limit = formats.millimetre_text(specification.rail_deflection_limit)
    rows = "".join(_row(each, specification, limit) for each in results if each.verdict is not None)
    heads = "".join(f'<th scope="col">{words}</th>' for words in ("Design", "Deflection", "Limit", "Margin"))
    return f"<table><thead><tr>{heads}</tr></thead><tbody>{rows}</tbody></table>"


def _row(result, specification, limit):
    verdict = result.verdict
    sinks = specification.rail_deflection_limit - verdict.deflection_margin
    at_least = "at least " if result.statics.at_least else ""
    margin = f"{1e3 * verdict.deflection_margin:+.2f} mm".replace("-", "−")
    kind, sign = ("fails", "✗ ") if verdict.sinks_too_far else ("complies", "✓ ")
    swatch = swatch_svg(result.colour, result.dash)
    return (
        f'<tr><th scope="row">{swatch}<span class="name">{html.escape(result.name)}</span></th>'
        f"<td>{at_least}{formats.millimetre_text(sinks)}</td><td>{limit}</td>"
        f'<td class="{kind}">{sign}{margin}</td></tr>'
    )
