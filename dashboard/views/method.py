"""The tab that says what is computed: equations, assumptions, slips corrected, limits, glossary.

The text is ``assets/method.md``: Markdown with HTML disabled, formulas between dollar signs. KaTeX, which
Panel brings along, sets them: nothing is fetched from elsewhere.
"""

import html

import panel as pn
import panel_material_ui as pmui
from markdown_it import MarkdownIt
from mdit_py_plugins.dollarmath import dollarmath_plugin

from dashboard import assets, theme
from dashboard.views.components import PAPER
from dashboard.views.tab import Tab

MISSING = "This installation lacks the text of the method, `assets/method.md`. Install trackig again."


class Method(Tab):
    """The method, written for readers."""

    title = "Method"
    link_name = "method"

    def __init__(self):
        super().__init__()
        try:
            text = assets.read_text(assets.METHOD)
        except OSError:
            text = MISSING
        self.text = pn.pane.LaTeX(
            method_html(text),
            renderer="katex",
            sizing_mode="stretch_width",
            margin=0,
            stylesheets=[theme.PROSE_CSS, theme.EQUATION_CSS],
        )

    def build(self):
        """Return what is put on the page."""
        return pmui.Paper(pmui.Column(self.text, max_width=theme.PROSE_WIDTH, margin=(4, 16)), **PAPER)


def method_html(text):
    """Return a text as HTML in which KaTeX finds the formulas.

    Parameters
    ----------
    text : str
        Markdown: ``$`` around formulas within a line, lines ``$$`` before and after those that are displayed.

    Returns
    -------
    str
        HTML; formulas are as they were, on one line each, between their dollar signs.
    """
    markdown = MarkdownIt("commonmark", {"html": False}).enable("table")
    return markdown.use(dollarmath_plugin, renderer=_formula).render(text)


def _formula(formula, options):
    sign = "$$" if options["display_mode"] else "$"
    # one line: KaTeX takes line breaks as spaces, its finder of formulas does not
    return html.escape(f"{sign}{' '.join(formula.split())}{sign}")
