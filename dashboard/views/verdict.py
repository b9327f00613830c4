"""Verdicts in words: does a design comply, and if not, by how much and where.

The one rule: colour never stands alone; name, dash and words say the same.
"""

import html

import panel as pn
from panel.viewable import Viewer

from dashboard import style

NONE_GIVEN = "No specification yet: type one below, paste it, or open a CSV file."


class ShortVerdict(Viewer):
    """One line on the design at hand; it is empty while nothing is specified.

    Parameters
    ----------
    workshop : Workshop
        What is told.
    """

    def __init__(self, workshop):
        super().__init__()
        self._workshop = workshop
        self.pane = pn.pane.HTML("", stylesheets=[style.VERDICT_CSS], margin=(0, 12, 2, 12))
        workshop.param.watch(self._show, "assessed")
        self._show()

    def _show(self, *_):
        there = self._workshop.assessed
        verdict = there[0].verdict if there else None
        self.pane.object = "" if verdict is None else f'<p class="short">{badge(verdict)}</p>'

    def __panel__(self):
        """Return what is put on the page."""
        return self.pane


def badge(verdict):
    """Return a verdict as HTML: a sign, and the words, those of the outcome in large letters."""
    kind, sign = ("complies", "✓") if verdict.complies else ("fails", "✗")
    return f'<span class="{kind}"><b aria-hidden="true">{sign}</b> {html.escape(str(verdict))}</span>'


def verdicts_html(assessed):
    """Return the verdicts on designs as HTML, whatever characters their names are made of.

    Parameters
    ----------
    assessed : iterable of Assessed
        The designs; those without a verdict are left out.
    """
    rows = "".join(
        f"<li>{swatch_svg(each.colour, each.dash)}<span class='name'>{html.escape(each.name)}</span>"
        f"{badge(each.verdict)}</li>"
        for each in assessed
        if each.verdict is not None
    )
    return f'<ul role="list">{rows}</ul>' if rows else f"<p>{NONE_GIVEN}</p>"


def swatch_svg(colour, dash):
    """Return a short line in a design's colour and dash."""
    pattern = " ".join(map(str, dash))
    line = f'<line x1="0" x2="34" y1="3" y2="3" stroke="{colour}" stroke-width="4"'
    drawing = '<svg viewBox="0 0 34 6" width="34" height="6" aria-hidden="true">'
    return f'{drawing}{line} stroke-dasharray="{pattern}"/></svg>'
