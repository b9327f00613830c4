"""Verdicts in words: does a design comply, and if not, by how much and where.

Colour never stands alone; name, dash and words say the same.
"""

import html

import panel as pn
from panel.viewable import Viewer

from dashboard import theme
from dashboard.figures.swatches import swatch_svg

NONE_GIVEN = "No specification yet: type one below, paste it, or open a CSV file."


class ShortVerdict(Viewer):
    """One line on the current design; it is empty while nothing is specified.

    Parameters
    ----------
    assessment : Assessment
        Whose verdict is shown.
    """

    def __init__(self, assessment):
        super().__init__()
        self._assessment = assessment
        self.pane = pn.pane.HTML("", stylesheets=[theme.VERDICT_CSS], margin=(0, 12, 2, 12))
        assessment.param.watch(self._show, "results")
        self._show()

    def _show(self, *_):
        verdict = self._assessment.current.verdict
        self.pane.object = "" if verdict is None else f'<p class="short">{badge(verdict)}</p>'

    def __panel__(self):
        """Return what is put on the page."""
        return self.pane


def badge(verdict):
    """Return a verdict as HTML: a sign, and the words, of which each part keeps to one line."""
    kind, sign = ("complies", "✓") if verdict.complies else ("fails", "✗")
    words = html.escape(str(verdict)).replace("; ", ';</span> <span class="part">')
    sign = f'<b aria-hidden="true">{sign}</b>'
    return f'<span class="{kind}"><span class="part">{sign} {words}</span></span>'


def verdicts_html(results):
    """Return the verdicts on designs as HTML, whatever characters their names are made of.

    Parameters
    ----------
    results : iterable of DesignResult
        The designs; those without a verdict are left out.
    """
    rows = "".join(
        f"<li>{swatch_svg(each.colour, each.dash)}<span class='name'>{html.escape(each.name)}</span>"
        f"{badge(each.verdict)}</li>"
        for each in results
        if each.verdict is not None
    )
    return f'<ul role="list">{rows}</ul>' if rows else f"<p>{NONE_GIVEN}</p>"
