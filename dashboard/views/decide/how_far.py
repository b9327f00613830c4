"""How far each number of the design may go, all others held."""

import html

import panel as pn

from dashboard import theme
from dashboard.compute.feasibility import where
from dashboard.fields import ASKED_FIELDS
from dashboard.session.answers import with_unit
from dashboard.views.components import caption, panel
from dashboard.views.decide.asked import Asked, scrolled, what_is_missing
from dashboard.views.decide.inputs import given_box
from trackig_core.decide.words import away


class HowFar(Asked):
    """How far each number of the design may go, all others held."""

    kind = "range"

    def __init__(self, snapshot, exchange, feasibility):
        super().__init__(snapshot, exchange, feasibility)
        self.table = pn.pane.HTML("", stylesheets=[theme.TABLE_CSS], sizing_mode="stretch_width", margin=0)
        self.given = given_box(self._look_at_given)
        snapshot.boxes.keep(range_of_vehicle_and_site=self.given)
        feasibility.param.watch(self._dim, "stale")
        self._answered()

    def _answered(self):
        super()._answered()
        if self.inquiry.result is None:
            self._say(self.inquiry.problem or what_is_missing(self.assessment))
            self.table.object = ""

    def _look_at_given(self, event):
        self.inquiry.given = event.new

    def _dim(self, *_):
        self.table.styles = theme.STALE if self.inquiry.stale else theme.FRESH

    def words(self, result):
        """Return the answer in one sentence, in the units of the sliders."""
        verdict = "complies" if result.complies else "fails"
        side = "within" if result.margin >= 0 else "beyond"
        said = f"The design {verdict}"
        if result.governed_by != "deflection":
            said += f", {away(result.margin)} {side} the limit at {result.governed_by} Hz"
        if result.deflection_limit is not None:
            said += (
                f", its rail sinking {1e3 * result.deflection:.2f} of {1e3 * result.deflection_limit:.2f} mm"
            )
        ways = [
            f"{ASKED_FIELDS[name].marked.lower()} {where(result, name)}"
            for name in result
            if result[name] and name in ASKED_FIELDS
        ]
        if result.complies:
            return f"{said}."
        if not ways:
            return f"{said}; no change of a single number makes it comply."
        return f"{said}; it complies with {', or '.join(ways)}."

    def show(self, result):
        """List the ranges."""
        rows = "".join(
            f"<tr><th scope='row'>{html.escape(ASKED_FIELDS[name].marked)}</th>"
            f"<td>{with_unit(name, result.design.value(name))}</td><td>{where(result, name)}</td></tr>"
            for name in result
            if name in ASKED_FIELDS
        )
        heads = "<tr><th>All others held</th><th>now</th><th>complies</th></tr>"
        self.table.object = scrolled(
            "Where the design complies", f"<table><thead>{heads}</thead><tbody>{rows}</tbody></table>"
        )

    def build(self):
        """Return what is put on the page."""
        return panel(caption("How far?", HOW_FAR), self.given, self.sentence, self.answered_row, self.table)


HOW_FAR = (
    "where the design complies along each number, all others held; all answers of this tab are of exact "
    "curves, from which a verdict on the paper's run may differ by some 0.1 dB"
)
