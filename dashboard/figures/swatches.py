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


def extrapolated_svg():
    """Return a piece of the light hatching behind bands that rest on extrapolation."""
    hatching = " ".join(f"M{x} 1L{x + 10} 11" for x in range(2, 24, 7))
    return _drawing(f'<path d="{hatching}" fill="none" stroke="{theme.EXTRAPOLATED}" stroke-width="1.5"/>')


def point_svg(shape, colour):
    """Return a point of a curve that is drawn as points: one of the markers of the theme."""
    return _drawing(f'<path d="{theme.MARKERS[shape]}" fill="none" stroke="{colour}" stroke-width="2"/>')


def _drawing(parts):
    size = f'width="{WIDTH}" height="{HEIGHT}" viewBox="0 0 {WIDTH} {HEIGHT}"'
    return f'<svg class="swatch" {size} aria-hidden="true">{parts}</svg>'
