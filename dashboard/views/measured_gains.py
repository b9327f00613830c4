"""Insertion gain from elsewhere: pasted or opened, named, and taken away again.

It is held beside what is computed, and demands nothing: limits are given in another tab.
"""

import dataclasses
import html

import panel as pn
import panel_material_ui as pmui
from panel.viewable import Viewer

import trackig_core as tig
from dashboard import theme
from dashboard.client.exchange import opening
from dashboard.figures.insertion_gain import MEASURED_MARKERS
from dashboard.figures.swatches import point_svg
from dashboard.formats import extent_text
from trackig_core.levels.band_tables import MOST_BYTES
from trackig_core.names import LONGEST_TITLE, allowed, is_name
from trackig_core.study.studies import MOST_MEASURED

MANY = f"{MOST_MEASURED} curves are there: remove one to take another."


class MeasuredGains(Viewer):
    """The curves, one a row, and the ways to give another.

    Parameters
    ----------
    assessment : Assessment
        Where they are kept.
    exchange : Exchange or None
        Opens files.
    """

    def __init__(self, assessment, exchange=None):
        super().__init__()
        self._assessment = assessment
        self.name_box = pmui.TextInput(
            label="Name of the curve",
            max_length=LONGEST_TITLE,
            size="small",
            variant="outlined",
            width=300,
            margin=(8, 8, 4, 12),
        )
        self.pasted = pmui.TextAreaInput(
            label="Paste a table of Hz and dB",
            placeholder="31.5\t-6\n40\t-8",
            rows=4,
            max_length=MOST_BYTES,
            sizing_mode="stretch_width",
            margin=(4, 12, 4, 12),
        )
        self.apply = pmui.Button(
            label="Take what is pasted", icon="content_paste_go", on_click=self._take_area, **BUTTON
        )
        self.load = pmui.Button(
            label="Open CSV", icon="upload_file", js_on_click=opening("measured"), **BUTTON
        )
        self.message = pn.pane.HTML("", stylesheets=[theme.MESSAGE_CSS], margin=(0, 12, 4, 12))
        self._rows = pmui.Column(sizing_mode="stretch_width", margin=(0, 0, 6, 0))
        if exchange is not None:
            exchange.on_file("measured", self.take)
        assessment.param.watch(self._show, "measured")
        self._show()

    def take(self, data):
        """Take a table, as bytes or text, as one more curve, or say why not; return whether it was taken."""
        kept, name = self._assessment.measured, self.name_box.value.strip()
        if len(kept) >= MOST_MEASURED:
            return self._refuse(MANY)
        if name and not is_name(name, LONGEST_TITLE):
            return self._refuse(f"Not taken: as a name give {allowed(LONGEST_TITLE)}.")
        try:
            reading = tig.levels.MeasuredGain.read(data)
        except tig.BandTableError as error:
            return self._refuse(f"Not taken: {error}.")
        curve = dataclasses.replace(reading.table, name=_free(name or reading.table.name, kept))
        self.name_box.value = ""
        self._assessment.measured = (*kept, curve)
        self._tell(f"{'; '.join((f'Taken: {extent_text(curve.points)}', *reading.notes))}.", "status")
        return True

    def remove(self, curve):
        """Take a curve away."""
        self._tell("")
        self._assessment.measured = tuple(each for each in self._assessment.measured if each is not curve)

    def _take_area(self, *_):
        if self.take(self.pasted.value):
            self.pasted.value = ""

    def _refuse(self, words):
        self._tell(words)
        return False

    def _tell(self, words, role="alert"):
        self.message.object = f'<div role="{role}">{html.escape(words)}</div>'

    def _show(self, *_):
        curves = zip(self._assessment.measured, MEASURED_MARKERS, strict=False)
        self._rows.objects = [self._row(curve, shape) for curve, shape in curves]

    def _row(self, curve, shape):
        words = html.escape(f"{curve.name}: {extent_text(curve.points)}")
        words = f"<p>{point_svg(shape, theme.THEORY)} {words}</p>"
        remove = pmui.Button(
            label="Remove", size="small", variant="text", on_click=lambda _: self.remove(curve)
        )
        return pmui.Row(
            pn.pane.HTML(words, stylesheets=[theme.CAPTION_CSS], margin=(8, 8, 0, 12)), remove, margin=0
        )

    def __panel__(self):
        """Return what is put on the page."""
        return pmui.Column(
            self._rows,
            pmui.FlexBox(self.name_box, self.load, margin=0),
            self.pasted,
            self.apply,
            self.message,
            sizing_mode="stretch_width",
            margin=(0, 0, 8, 0),
        )


BUTTON = {"size": "small", "variant": "outlined", "margin": (8, 8, 4, 12)}


def _free(name, kept):
    """Return a name that none of some curves has: the given one, or with a number."""
    taken = {each.name for each in kept}
    stem = name[: LONGEST_TITLE - 2]
    return next(each for each in (name, *(f"{stem} {number}" for number in range(2, 9))) if each not in taken)
