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
        assessment.param.watch(self._show, ["results", "specification"])
        self._show()

    def _show(self, *_):
        verdict, specification = self._assessment.current.verdict, self._assessment.specification
        if specification is not None and specification.question:
            words = f"No verdict yet; answer first, in the tab Specification: {specification.question}"
            self.pane.object = f'<p class="short open">{html.escape(words)}</p>'
        else:
            self.pane.object = "" if verdict is None else f'<p class="short">{badge(verdict)}</p>'

    def __panel__(self):
        """Return what is put on the page."""
        return self.pane


def badge(verdict):
    """Return a verdict as HTML: a sign, and the words, of which each part keeps to one line."""
    kind, sign = ("complies", "✓") if verdict.complies else ("fails", "✗")
    judged = html.escape(verdict.judged_words).replace("; ", ';</span> <span class="part">')
    sign = f'<b aria-hidden="true">{sign}</b>'
    words = f'<span class="{kind}"><span class="part">{sign} {judged}</span></span>'
    rest = html.escape(verdict.not_judged_words)
    # one element, since each has a column of its own where verdicts stand below each other
    return f'<span>{words}; <span class="open">{rest}</span></span>' if rest else words


def verdicts_html(results, specification=None):
    """Return the verdicts on designs as HTML, whatever characters their names are made of.

    Parameters
    ----------
    results : iterable of DesignResult
        The designs; those without a verdict are left out.
    specification : trackig_core.Specification, optional
        What they are held against; where it leaves a question open, that stands in the place of verdicts.
    """
    if specification is not None and specification.question:
        words = f"No verdict yet. Answer first, below: {specification.question}"
        return f'<p class="open">{html.escape(words)}</p>'
    rows = "".join(
        f"<li>{swatch_svg(each.colour, each.dash)}<span class='name'>{html.escape(each.name)}</span>"
        f"{badge(each.verdict)}</li>"
        for each in results
        if each.verdict is not None
    )
    return f'<ul role="list">{rows}</ul>' if rows else f"<p>{NONE_GIVEN}</p>"
