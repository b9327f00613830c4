"""Pictures with one curve per design, band by band: gain, difference from a base, received level.

Every design has the colour and dash that it has elsewhere.
"""

import numpy as np
from bokeh.models import ColumnDataSource, CustomJSHover, GlyphRenderer, HoverTool

from dashboard import theme
from dashboard.figures.axes import LEVEL_ROOM, LEVEL_STEP, AxisEnds, show_bands
from dashboard.figures.insertion_gain import ALONE_TOOLTIPS, NO_LEVELS, PIN_HOVER, pin_columns
from dashboard.figures.legends import Legend, PinnedLines, solved_entry, with_legend
from dashboard.figures.overlays import band_overlay, rendered
from dashboard.figures.swatches import swatch_svg
from trackig_core.bands import BAND_CENTRES

LEAST_REACH = 4.0
"""What the axis of differences shows at least on either side [dB]."""

LEAST_SPAN = 10.0
"""What an axis of levels shows at least [dB]."""

CURRENT, REFERENCE = (f"pin_{theme.MOST_PINNED + place}" for place in (0, 1))
"""Columns of the current design and of the reference track, behind those of the pins."""

LOOKS = {
    REFERENCE: {
        "line_color": theme.PRESET_GHOST,
        "line_width": theme.THIN_LINE_WIDTH,
        "line_dash": theme.SECOND_DASH,
    },
    CURRENT: {"line_color": theme.THIS_DESIGN, "line_width": theme.LINE_WIDTH},
}
"""Looks of the curves that are always there; those of pinned designs are made when they are first needed."""

THIS_DESIGN = ("this design", swatch_svg(theme.THIS_DESIGN))
REFERENCE_TRACK = ("reference track", swatch_svg(theme.PRESET_GHOST, theme.SECOND_DASH))
"""What the legend says beside the names of pinned designs."""


class DesignsFigure:
    """A curve per design over the bands.

    Parameters
    ----------
    name : str
        Name of the source; the figure's is this without its last letter, an s, and ``_figure``.
    label : str
        What the value axis is called.
    aria_label : str
        What screen readers say of the figure.
    ends : tuple of float
        What the value axis shows at first [dB].

    Attributes
    ----------
    model : bokeh.plotting.figure
        The figure.
    legend : Legend
        What is drawn, in words.
    layout : bokeh.models.Column
        The figure, and its legend below it.
    curves : bokeh.models.ColumnDataSource
        Per band its ``label``, its ``centre`` [Hz], the levels of pins ``pin_0`` to ``pin_7``, as ``pin_8``
        those of the current design, as ``pin_9`` those of the reference track [dB]; NaN where there are none.
    """

    def __init__(self, name, label, aria_label, ends):
        figure = f"{name.removesuffix('s')}_figure"
        self.curves = ColumnDataSource(name=name, data=_columns([], None, None))
        self._ends = AxisEnds(ends)
        self.model = rendered(
            band_overlay(LOOKS, label),
            aria_label,
            name=figure,
            y_range=self._ends.model,
            stylesheets=[theme.MEDIUM],
        )
        show_bands(self.model)
        self.legend = Legend(figure)
        self.layout = with_legend(self.model, self.legend)
        # their order is that of the description; what `select` returns has none
        self._reference, self._current = (
            each for each in self.model.renderers if isinstance(each, GlyphRenderer)
        )
        self._reference.data_source = self._current.data_source = self.curves
        names = [f"pin_{place}" for place in range(theme.MOST_PINNED)]
        self._pinned = PinnedLines(
            self.model, self._current, [self.curves] * theme.MOST_PINNED, "centre", names
        )
        levels = CustomJSHover(args={"pins": self.curves}, code=PIN_HOVER)
        self._hover = HoverTool(
            renderers=[self._current], mode="vline", tooltips=ALONE_TOOLTIPS, formatters={"@centre": levels}
        )
        self.model.add_tools(self._hover)

    def name_axis(self, words):
        """Say on the axis what is drawn."""
        self.model.yaxis.axis_label = words

    def _draw(self, results, levels, reference=None):
        """Draw levels (21,) [dB] of results and of the reference track; return all that is drawn."""
        pairs = list(zip(results, levels, strict=True))
        pinned = [each for each, _ in pairs if each.key is not None]
        of_pins = [each for result, each in pairs if result.key is not None]
        current = next((each for result, each in pairs if result.key is None), None)
        self.curves.data = _columns(of_pins, current, reference)
        self._pinned.show(pinned)
        self._pinned.set_off(next((each for each, _ in pairs if each.key is None), None))
        self._current.visible = current is not None
        self._reference.visible = reference is not None
        own = [] if current is None else [THIS_DESIGN]
        own += [] if reference is None else [REFERENCE_TRACK]
        self.legend.show([*own, *map(solved_entry, pinned)])
        self._name_on_hover(pinned, current is not None)
        return [each for each in (*of_pins, current, reference) if each is not None]

    def _name_on_hover(self, pinned, with_current):
        tooltips = [("this design", f"@centre{{{theme.MOST_PINNED}}}")] if with_current else []
        tooltips += [(each.name, f"@centre{{{place}}}") for place, each in enumerate(pinned)]
        self._hover.update(
            renderers=[self._current] if with_current else self._pinned.lines[:1],
            tooltips=ALONE_TOOLTIPS + tooltips,
        )


class GainsFigure(DesignsFigure):
    """Insertion gain of the current design and of pinned ones."""

    def __init__(self):
        super().__init__(
            "compared_gains",
            "Insertion gain, dB",
            "Insertion gain of the designs per one-third-octave band",
            (-30.0, 20.0),
        )

    def show(self, results):
        """Draw insertion gain of designs with a solution (DesignResult); the current one is the first."""
        _span(self._ends, self._draw(results, [each.levels for each in results]))


class BaseDifferenceFigure(DesignsFigure):
    """Insertion gain less that of a base, for the current design and for pinned ones; the base is zero."""

    def __init__(self):
        super().__init__(
            "pin_differences",
            "dB re base",
            "Difference of insertion gain from the base per one-third-octave band",
            (-10.0, 10.0),
        )

    def show(self, base, results):
        """Draw differences.

        Parameters
        ----------
        base : DesignResult
            The design from which differences are taken; nothing is drawn as long as it has no solution.
        results : sequence of DesignResult
            Designs with a solution, the base not among them; the current design, if there, is the first.
        """
        results = () if base.levels is None else results
        drawn = self._draw(results, [each.levels - base.levels for each in results])
        reach = max([LEAST_REACH, *(np.abs(each).max() for each in drawn)])
        self._ends.show(-reach, reach, LEVEL_STEP)


class ReceivedLevelFigure(DesignsFigure):
    """Level of a source per band, with the reference track and with every design.

    Attributes
    ----------
    alone : bokeh.models.ColumnDataSource
        The levels of bands whose neighbours have none, which no line would show.
    """

    def __init__(self):
        super().__init__(
            "received_levels",
            "Received level, dB re as the source",
            "Level of the source with the designs per one-third-octave band",
            (0.0, 100.0),
        )
        self.alone = ColumnDataSource(data=_standing_alone([]))
        self.model.scatter("centre", "level", color="colour", size=theme.DOT_SIZE, source=self.alone)

    def show(self, source, results):
        """Draw levels.

        Parameters
        ----------
        source : trackig_core.SourceSpectrum
            The source; bands that it does not give have no level.
        results : sequence of DesignResult
            Designs with a level; the current one is the first.
        """
        drawn = self._draw(results, [each.level.bands for each in results], source.levels)
        curves = [(source.levels, theme.PRESET_GHOST), *((each.level.bands, each.colour) for each in results)]
        self.alone.data = _standing_alone(curves)
        _span(self._ends, drawn)


def _standing_alone(curves):
    """Return the levels (21,) [dB] of curves, given with their colours, whose neighbours are missing."""
    found = {"centre": [], "level": [], "colour": []}
    for levels, colour in curves:
        there = np.isfinite(np.pad(levels, 1, constant_values=np.nan))
        alone = there[1:-1] & ~there[:-2] & ~there[2:]
        found["centre"] += [*BAND_CENTRES[alone]]
        found["level"] += [*levels[alone]]
        found["colour"] += [colour] * alone.sum()
    return found


def _span(ends, drawn):
    """Let an axis show levels [dB], with a little room around them."""
    seen = np.concatenate([*drawn, NO_LEVELS])
    seen = seen[np.isfinite(seen)]
    if seen.size:
        low, high = seen.min() - LEVEL_ROOM, seen.max() + LEVEL_ROOM
        ends.show(low, max(high, low + LEAST_SPAN), LEVEL_STEP)


def _columns(pinned, current, reference):
    """Return the columns of the source, NaN for levels (21,) [dB] that are missing."""
    own = {CURRENT: current, REFERENCE: reference}
    missing = {column: NO_LEVELS if levels is None else levels for column, levels in own.items()}
    return {**pin_columns(pinned), **missing}
