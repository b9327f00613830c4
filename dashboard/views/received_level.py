"""The tab in which insertion gain becomes single numbers: the level of a source with each design.

Levels are compared within one source; the table says which design they are compared with.
"""

import html

import numpy as np
import panel as pn
import panel_material_ui as pmui

from dashboard import formats, theme
from dashboard.compute.document import NextTick
from dashboard.figures.comparison import ReceivedLevelFigure
from dashboard.figures.swatches import swatch_svg
from dashboard.views.band_editor import BandEditor
from dashboard.views.components import CURRENT, CURRENT_NAME, PAPER, bokeh_pane, caption
from dashboard.views.tab import Tab


class ReceivedLevel(Tab):
    """A source on the reference track, and its level with every design.

    Parameters
    ----------
    assessment : Assessment
        What is edited and shown.
    pins : Pins
        Whose base of differences is chosen.
    exchange : Exchange
        Opens and saves files.
    """

    title = "Received level"
    link_name = "level"

    def __init__(self, assessment, pins, exchange):
        super().__init__()
        self._assessment, self._pins = assessment, pins
        self._own = REFERENCE
        self.base = pn.widgets.Select(
            label="Difference from",
            options={REFERENCE_NAME: REFERENCE, CURRENT_NAME: CURRENT},
            width=240,
            margin=(4, 12, 6, 12),
            stylesheets=[theme.SELECT_CSS],
        )
        self.table = pn.pane.HTML(
            "", stylesheets=[theme.LEVELS_CSS], sizing_mode="stretch_width", margin=(0, 12, 8, 12)
        )
        self.figure = ReceivedLevelFigure()
        self.plot = pn.Column(bokeh_pane(self.figure.layout), sizing_mode="stretch_width", margin=0)
        self.editor = BandEditor(
            assessment, "source", exchange, "Source, dB", "Level on the reference track, and with the designs"
        )
        self.base.param.watch(self._choose, "value")
        # figures are models of Bokeh, which may change only when the document may
        self._show_later = NextTick(self._show)
        assessment.param.watch(self._show_later, ["results", "base", "preset"])
        pins.param.watch(self._follow_base, "base")
        self._follow_base()

    def _follow_base(self, *_):
        """Compare with the base that was chosen elsewhere, as long as there is one."""
        if self._pins.base is not None:
            self._own = None

    def _offer(self):
        preset = self._assessment.preset
        options = {REFERENCE_NAME: REFERENCE, CURRENT_NAME: CURRENT}
        options |= {} if preset is None else {f"preset: {preset.name}": PRESET}
        options |= {pin.name: pin.key for pin in self._pins.pinned}
        if self._own not in options.values():
            self._own = None
        value = (self._pins.base or CURRENT) if self._own is None else self._own
        self.base.param.update(options=options, value=value)

    def _choose(self, event):
        if event.new in (REFERENCE, PRESET):
            self._own = event.new
            self._show_later()
            return
        was, self._own = self._own, None
        self._pins.choose_base(event.new or None)
        if was is not None:
            self._show_later()

    @property
    def _compared(self):
        """What differences are taken from: its name, and its level or None."""
        if self._own == REFERENCE:
            source = self._assessment.source
            return REFERENCE_NAME, None if source is None else reference_level(source)
        base = self._assessment.preset if self._own == PRESET else self._assessment.base
        return base.name, base.level

    def refresh(self):
        """Show what has changed while nobody looked."""
        # before the tab is drawn: a select that is there but not drawn yet cannot take new options
        if self.in_sight:
            self._offer()
        self._show_later()

    def _show(self):
        if not self.in_sight:
            return
        self._offer()
        self.table.object = levels_html(self._assessment.shown, self._assessment.source, *self._compared)
        received = [each for each in self._assessment.shown if each.level is not None]
        self.editor.grid.designs = [_design(each) for each in received]
        self.plot.visible = bool(received)
        if received:
            self.figure.show(self._assessment.source, received)

    def build(self):
        """Return what is put on the page."""
        return pmui.Column(
            pmui.Paper(caption("Level with the track", WORDS), self.base, self.table, self.plot, **PAPER),
            pmui.Paper(caption("Source", SOURCE_WORDS), self.editor, **PAPER),
            sizing_mode="stretch_width",
            margin=(0, 8, 8, 8),
        )


REFERENCE, PRESET = -1, -2
"""Stand for the reference track and for the preset where keys of pins are chosen from, which count from 1."""

REFERENCE_NAME = "reference\N{NO-BREAK SPACE}track"
"""What the track of the source is called; no pin can be called so, since names hold no such space."""

WORDS = (
    "energies of the bands summed, as they are and A-weighted (IEC 61672-1); dB re what the source's dB are"
)
SOURCE_WORDS = "level per band with the reference track; only bands that have one are summed"
NONE_GIVEN = "No source yet: type one below, paste it, or open a CSV file."


def reference_level(source):
    """Return the level of a source on the reference track (trackig_core.TrackLevel)."""
    return source.with_track(np.zeros_like(source.levels))


def levels_html(results, source, name, base):
    """Return the levels of a source with designs as HTML, whatever characters their names are made of.

    Parameters
    ----------
    results : iterable of DesignResult
        Designs with a solution.
    source : trackig_core.SourceSpectrum or None
        The source.
    name : str
        What differences are taken from.
    base : trackig_core.TrackLevel or None
        Level with that; None while there is none.
    """
    if source is None or base is None:
        return f"<p>{NONE_GIVEN}</p>"
    rows = [("", "Reference track", reference_level(source))]
    rows += [(swatch_svg(each.colour, each.dash), html.escape(each.name), each.level) for each in results]
    name = html.escape(name)
    head = "".join(
        f'<th scope="col">{words}</th>'
        for words in ("Design", "Level, dB", "Level, dB(A)", f"re {name}, dB", f"re {name}, dB(A)")
    )
    body = "".join(_row(mark, words, level, base) for mark, words, level in rows)
    return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"


def _row(mark, name, level, base):
    difference = level.relative_to(base)
    texts = (
        formats.plain_text(level.unweighted),
        formats.plain_text(level.a_weighted),
        formats.signed_text(difference.unweighted),
        formats.signed_text(difference.a_weighted),
    )
    cells = "".join(f"<td>{text}</td>" for text in texts)
    return f'<tr><th scope="row">{mark}<span class="name">{name}</span></th>{cells}</tr>'


def _design(result):
    cells = [["" if np.isnan(level) else formats.plain_text(level), False] for level in result.level.bands]
    parts = [{"words": "level", "cells": cells}]
    return {"name": result.name, "colour": result.colour, "dash": list(result.dash), "parts": parts}
