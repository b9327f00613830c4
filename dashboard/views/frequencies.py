"""Natural frequencies as large figures, each with a sentence on what it is.

A frequency is never shown without saying of what.
"""

import panel as pn
from panel.viewable import Viewer

from dashboard import formats, theme

LOADED_TRACK = (
    "Loaded track",
    "The wheel bounces on rail and supports. Around it the track amplifies; well above it, it isolates.",
)
COUPLED_BLOCK = (
    "Coupled block",
    "The block bounces between pad and boot, the rail still. Above it the block isolates, too.",
)
NO_BLOCK = "This track has one stage: there is no block to bounce."

NONE = "–"

CUT_ON_WORDS = {
    1: ("unloaded track: from here on waves run along the rail",),
    2: (
        "unloaded track, rail and blocks in step: waves begin",
        "unloaded track, rail against blocks: waves run again",
    ),
}
"""What the cut-on frequencies of a single-stage and of a two-stage track are."""


class Frequencies(Viewer):
    """The two natural frequencies that shape the insertion gain, and those that explain them.

    Parameters
    ----------
    outcome : Outcome
        Whose picture is shown.
    """

    def __init__(self, outcome):
        super().__init__()
        self._outcome, self._in_sight = outcome, True
        self.pane = pn.pane.HTML(
            "", sizing_mode="stretch_width", stylesheets=[theme.FREQUENCIES_CSS], margin=0
        )
        outcome.param.watch(self._show, "summary")
        self._show()

    def look(self, in_sight):
        """Note whether the tab is in sight; if so, show what has changed meanwhile."""
        self._in_sight = in_sight
        self._show()

    def _show(self, *_):
        if not self._in_sight:
            return
        summary = self._outcome.summary
        self.pane.object = "" if summary is None else frequencies_html(summary.solution.natural_frequencies)

    def __panel__(self):
        """Return what is put on the page."""
        return self.pane


def explanations(natural):
    """Return value and meaning of the frequencies that explain the main two.

    Parameters
    ----------
    natural : trackig_core.NaturalFrequencies
        Natural frequencies of a design [Hz].

    Returns
    -------
    list of tuple of str
        Frequency with its unit, and a sentence on what it is.
    """
    pairs = list(zip(natural.cut_on, CUT_ON_WORDS[len(natural.cut_on)], strict=True))
    if natural.block_on_boot is not None:
        pairs = [
            (natural.wheel_on_rigid_blocks, "wheel on the track if no block could move"),
            (natural.block_on_boot, "block on its boot alone, the pad taken away"),
            *pairs,
        ]
    return [(formats.frequency_text(frequency), words) for frequency, words in pairs]


def frequencies_html(natural):
    """Return the natural frequencies as HTML, made of numbers and of this module's own words."""
    block = natural.coupled_block
    cards = (
        ("loaded-track", natural.loaded_track, natural.observed_loaded_track, *LOADED_TRACK),
        (
            "coupled-block",
            block,
            natural.observed_coupled_block,
            COUPLED_BLOCK[0],
            NO_BLOCK if block is None else COUPLED_BLOCK[1],
        ),
    )
    mains = "".join(_card(*card) for card in cards)
    rows = "".join(f"<dt>{figure}</dt><dd>{words}</dd>" for figure, words in explanations(natural))
    return f'<div class="mains">{mains}</div><dl>{rows}</dl>'


def _card(key, computed, observed, name, words):
    """Return one main frequency: computed in large figures, then as observed in the run, then what it is."""
    figure = NONE if computed is None else formats.frequency_text(computed)
    seen = "" if observed is None else f"Observed in the run: {formats.frequency_text(observed)}"
    return (
        f'<section class="main {key}"><h3>{name}</h3><p class="figure">{figure}</p>'
        f'<p class="observed">{seen}</p><p>{words}</p></section>'
    )
