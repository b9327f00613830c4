"""The tab that says what is computed: equations, assumptions, slips corrected, limits, glossary.

The text is ``assets/method.md``. Its Markdown is rendered with HTML disabled, its displayed equations by
KaTeX, which Panel brings along: nothing is fetched from elsewhere.
"""

import re

import panel as pn
import panel_material_ui as pmui

from dashboard import assets, theme
from dashboard.views.components import PAPER
from dashboard.views.tab import Tab

_EQUATION = re.compile(r"^\$\$\n(.*?)\n\$\$$", re.DOTALL | re.MULTILINE)

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
        self.parts = [_part(*each) for each in split(text)]

    def build(self):
        """Return what is put on the page."""
        return pmui.Paper(pmui.Column(*self.parts, max_width=theme.PROSE_WIDTH, margin=(4, 16)), **PAPER)


def split(text):
    """Return a text as parts in order.

    Parameters
    ----------
    text : str
        Markdown; a line ``$$`` stands before and after each displayed equation.

    Returns
    -------
    list of tuple
        Kind, ``"text"`` or ``"equation"``, and what it says.
    """
    kinds = ("text", "equation")
    pieces = _EQUATION.split(text)
    return [(kinds[number % 2], piece.strip()) for number, piece in enumerate(pieces) if piece.strip()]


def _part(kind, words):
    if kind == "equation":
        # one line: KaTeX takes line breaks as spaces, its finder of equations does not
        return pn.pane.LaTeX(
            f"$${' '.join(words.split())}$$",
            renderer="katex",
            sizing_mode="stretch_width",
            margin=(2, 0),
            stylesheets=[theme.EQUATION_CSS],
        )
    return pn.pane.Markdown(
        words,
        renderer_options={"html": False},
        sizing_mode="stretch_width",
        margin=0,
        stylesheets=[theme.PROSE_CSS],
    )
