"""Natural frequencies and statics as large figures, each with a sentence on what it is.

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
    assessment : Assessment, optional
        Whose statics of the current design are shown, too.
    """

    def __init__(self, outcome, assessment=None):
        super().__init__()
        self._outcome, self._assessment, self._in_sight = outcome, assessment, True
        self.pane = pn.pane.HTML(
            "", sizing_mode="stretch_width", stylesheets=[theme.FREQUENCIES_CSS], margin=0
        )
        if assessment is None:
            outcome.param.watch(self._show, "summary")
        else:  # which follows the outcome, and the wheels that stand on the track
            assessment.param.watch(self._show, "results")
        self._show()

    def look(self, in_sight):
        """Note whether the tab is in sight; if so, show what has changed meanwhile."""
        self._in_sight = in_sight
        self._show()

    def _show(self, *_):
        if not self._in_sight:
            return
        summary = self._outcome.summary
        statics = None if self._assessment is None else self._assessment.current.statics
        self.pane.object = (
            "" if summary is None else frequencies_html(summary.solution.natural_frequencies, statics)
        )

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


def frequencies_html(natural, statics=None):
    """Return the natural frequencies as HTML, made of numbers and of this module's own words.

    Parameters
    ----------
    natural : trackig_core.NaturalFrequencies
        Natural frequencies of a design [Hz].
    statics : trackig_core.StaticResponse, optional
        How it carries standing wheels.
    """
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
    below = "" if statics is None else f'<div class="mains statics">{statics_html(statics)}</div>'
    return f'<div class="mains">{mains}</div>{below}<dl>{rows}</dl>'


def statics_html(statics):
    """Return rail deflection and seat load as HTML, and why they are bounds if they are."""
    load = formats.load_text(statics.wheel_load)
    wheel = f"a wheel of {load}" if statics.wheelbase is None else f"the first of two wheels of {load}"
    reason = formats.unstated_text(statics)
    sinks = f"Of the rail under {wheel}, over a support."
    if reason:
        sinks += f" At least: {reason}; state it under Statics."
    worst = formats.millimetre_text(statics.largest_rail_deflection)
    seat = (
        f"The most that a support carries: {statics.seat_load_share:.0%} of a wheel's load. Between supports "
        f"the rail sinks {'at least ' if reason else ''}{worst} at the worst place."
    )
    figures = (
        ("rail-deflection", "Rail deflection", formats.millimetre_text(statics.rail_deflection), sinks),
        ("seat-load", "Seat load", formats.load_text(statics.largest_seat_load), seat),
    )
    bound = {"rail-deflection": "at least", "seat-load": "about"} if reason else {}
    return "".join(_figure(key, name, bound.get(key, ""), *rest) for key, name, *rest in figures)


def _figure(key, name, before, figure, words):
    """Return one static figure: large, what bounds it in small letters before it, then what it is."""
    small = f"<small>{before}</small> " if before else ""
    return (
        f'<section class="main {key}"><h3>{name}</h3><p class="figure">{small}{figure}</p>'
        f"<p>{words}</p></section>"
    )


def _card(key, computed, observed, name, words):
    """Return one main frequency: computed in large figures, then as observed in the run, then what it is."""
    figure = NONE if computed is None else formats.frequency_text(computed)
    seen = "" if observed is None else f"Observed in the run: {formats.frequency_text(observed)}"
    return (
        f'<section class="main {key}"><h3>{name}</h3><p class="figure">{figure}</p>'
        f'<p class="observed">{seen}</p><p>{words}</p></section>'
    )
