"""The tab in which designs are compared with a specification: limit, level and margin per band."""

import html

import numpy as np
import panel as pn
import panel_material_ui as pmui

from dashboard import formats, theme
from dashboard.views.band_editor import BandEditor
from dashboard.views.components import PAPER, caption
from dashboard.views.deflection_limit import DeflectionLimit
from dashboard.views.tab import Tab
from dashboard.views.verdict import verdicts_html


class SpecificationView(Tab):
    """The required insertion gain, and how the designs fare.

    Parameters
    ----------
    assessment : Assessment
        What is edited and shown.
    exchange : Exchange
        Opens and saves files.
    """

    title = "Specification"
    link_name = "specification"

    def __init__(self, assessment, exchange):
        super().__init__()
        self._assessment = assessment
        self.verdict = pn.pane.HTML(
            "", stylesheets=[theme.VERDICT_CSS], sizing_mode="stretch_width", margin=(0, 12, 8, 12)
        )
        self.editor = BandEditor(
            assessment,
            "specification",
            exchange,
            "Limit, dB",
            "Greatest insertion gain allowed, and the designs",
        )
        self.editor.on_read = self._note_reading
        self.editor.param.watch(self._show, "refused")
        self.deflection = DeflectionLimit(assessment)
        turn = pmui.Button(label="Turn the sign", size="small", variant="contained", on_click=self._turn)
        keep = pmui.Button(label="Keep as insertion gain", size="small", variant="text", on_click=self._keep)
        self.question = pmui.Column(
            pmui.Alert(
                object=QUESTION, severity="warning", sizing_mode="stretch_width", margin=(0, 12, 4, 12)
            ),
            pmui.Row(turn, keep, margin=(0, 12, 8, 12)),
            visible=False,
            sizing_mode="stretch_width",
            margin=0,
        )
        assessment.param.watch(self._show, "results")
        assessment.param.watch(self._ask, "specification")
        self._ask()

    def refresh(self):
        """Show what has changed while nobody looked."""
        self._show()

    def _show(self, *_):
        if not self.in_sight:
            return
        verdicts = verdicts_html(self._assessment.results, self._assessment.specification)
        if self.editor.refused:
            there = self._assessment.specification is not None
            words = html.escape(f"{REFUSED} {STANDS}" if there else REFUSED)
            verdicts = f'<p role="status" class="refused">{words}</p><div class="before">{verdicts}</div>'
        self.verdict.object = verdicts
        self.editor.grid.designs = [_design(each) for each in self._assessment.shown]
        self.deflection.show()

    def _note_reading(self, reading):
        """Return what to say of a table that was read."""
        return (NOTE,) if reading.table.question else ()

    def _ask(self, *_):
        """Ask what the limits are while they look like insertion losses and nobody has answered."""
        specification = self._assessment.specification
        self.question.visible = specification is not None and bool(specification.question)
        self._show()

    def _turn(self, *_):
        self._assessment.specification = self._assessment.specification.turned()
        self.editor.clear_message()

    def _keep(self, *_):
        self._assessment.specification = self._assessment.specification.kept()
        self.editor.clear_message()

    def build(self):
        """Return what is put on the page."""
        return pmui.Column(
            pmui.Paper(caption("Verdict", WORDS), self.verdict, **PAPER),
            pmui.Paper(caption("Required insertion gain", ""), self.question, self.editor, **PAPER),
            pmui.Paper(caption("Rail deflection", DEFLECTION_WORDS), self.deflection, **PAPER),
            sizing_mode="stretch_width",
            margin=(0, 8, 8, 8),
        )


REFUSED = "What was given last was not taken: see below why."

STANDS = "The specification before it is still in force, and this is its verdict:"

QUESTION = (
    "Answer this before there is a verdict. "
    "These limits look like an <b>insertion loss</b>, which counts what is taken away: the more, the better. "
    "Insertion gain has the opposite sign: −10 dB asks for more than −5 dB, and limits above 0 dB ask for no "
    "isolation at all."
)

NOTE = "the limits look like an insertion loss: answer the question above the table"

DEFLECTION_WORDS = "static, over a support, under one wheel; part of the verdict like any band"

WORDS = "bands without a limit are not assessed; a margin of exactly 0 dB complies"


def _design(result):
    """Return the columns of a design: its insertion gain, and its margin if there is a limit."""
    verdict = result.verdict
    fails = np.zeros(result.levels.size, bool) if verdict is None else verdict.fails
    gains = [
        [formats.signed_text(level), bool(failing)]
        for level, failing in zip(result.levels, fails, strict=True)
    ]
    parts = [{"words": "gain", "cells": gains}]
    if verdict is not None:
        parts.append({"words": "margin", "cells": [_margin_cell(margin) for margin in verdict.margins]})
    return {"name": result.name, "colour": result.colour, "dash": list(result.dash), "parts": parts}


def _margin_cell(margin):
    if np.isnan(margin):
        return ["", False]
    # a margin that rounds to nothing but fails must not be read as nothing
    text = formats.signed_text(margin)
    return [
        f"✗ {'−' if margin < 0 and text == '0.0' else ''}{text}" if margin < 0 else text,
        bool(margin < 0),
    ]
