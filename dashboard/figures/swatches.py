"""Short pieces of what is drawn, as it is drawn, for legends, lists and tables."""

from dashboard import theme

WIDTH, HEIGHT = 34, 12
"""Size of a swatch [px]."""


def swatch_svg(colour, dash=(), *, dot=False):
    """Return a short piece of a design's line, as it is drawn in every plot.

    Parameters
    ----------
    colour : str
        Its colour.
    dash : sequence of int
        Its dash [px]; empty: solid.
    dot : bool
        Whether the line has a dot at each band.

    Returns
    -------
    str
        A drawing (SVG) that screen readers skip.
    """
    dashes = " ".join(str(length) for length in dash) or "none"
    line = f'<path d="M1 6H33" stroke="{colour}" stroke-width="4" stroke-dasharray="{dashes}"/>'
    return _drawing(line + (f'<circle cx="17" cy="6" r="5.5" fill="{colour}"/>' if dot else ""))


def marker_svg(colour, marker):
    """Return a design's marker, ``"circle"`` or ``"diamond"``, as a map has it."""
    shape = {"circle": '<circle cx="17" cy="6" r="5"', "diamond": '<path d="M17 0L21 6L17 12L13 6Z"'}[marker]
    return _drawing(f'{shape} fill="{colour}"/>')


def limit_svg():
    """Return a short piece of a limit, which steps from band to band."""
    return _drawing(f'<path d="M1 9H17V3H33" fill="none" stroke="{theme.SPECIFICATION}" stroke-width="3"/>')


def excess_svg():
    """Return a piece of the hatching where a design exceeds its limit."""
    hatching = " ".join(f"M{x} 11L{x + 10} 1" for x in range(2, 24, 7))
    return _drawing(
        f'<g fill="none" stroke="{theme.SPECIFICATION}" stroke-width="1.5">'
        f'<rect x="1" y="1" width="32" height="10"/><path d="{hatching}"/></g>'
    )


def point_svg(shape, colour):
    """Return a point of a curve that is drawn as points: one of Bokeh's markers of :data:`MARKERS`."""
    return _drawing(f'<path d="{MARKERS[shape]}" fill="none" stroke="{colour}" stroke-width="2"/>')


MARKERS = {
    "diamond": "M17 1L22 6L17 11L12 6Z",
    "square": "M12.5 1.5H21.5V10.5H12.5Z",
    "triangle": "M17 1L22.5 10.5H11.5Z",
    "inverted_triangle": "M17 11L22.5 1.5H11.5Z",
}
"""Outline of each marker, by what Bokeh calls it."""


def _drawing(parts):
    size = f'width="{WIDTH}" height="{HEIGHT}" viewBox="0 0 {WIDTH} {HEIGHT}"'
    return f'<svg class="swatch" {size} aria-hidden="true">{parts}</svg>'
