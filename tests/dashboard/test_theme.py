"""Contrast and difference of the colours, and numbers as text."""

from itertools import combinations

import numpy as np
import pytest

from dashboard import formats, theme

TO_XYZ = np.array([[0.4125, 0.3576, 0.1804], [0.2127, 0.7152, 0.0722], [0.0193, 0.1192, 0.9503]])
"""Linear sRGB to XYZ; IEC 61966-2-1."""

READERS = {
    "all cones": np.eye(3),
    "protanope": [
        [0.152286, 1.052583, -0.204868],
        [0.114503, 0.786281, 0.099216],
        [-0.003882, -0.048116, 1.051998],
    ],
    "deuteranope": [
        [0.367322, 0.860646, -0.227968],
        [0.280085, 0.672501, 0.047413],
        [-0.01182, 0.04294, 0.968881],
    ],
    "tritanope": [
        [1.255528, -0.076749, -0.178779],
        [-0.078411, 0.930809, 0.147602],
        [0.004733, 0.691367, 0.3039],
    ],
}
"""How readers see linear sRGB; Machado, Oliveira and Fernandes (2009), severity 1."""

CLEAR, TOLERABLE = 15, 9
"""Difference in CIELAB between colours that are told apart alone, and with a dash to help; 2.3 is just
noticeable side by side (Mahy et al., 1994)."""


def linear(colour):
    """Return the linear channels of an sRGB colour."""
    channels = np.array([int(colour[i : i + 2], 16) / 255 for i in (1, 3, 5)])
    return np.where(channels <= 0.04045, channels / 12.92, ((channels + 0.055) / 1.055) ** 2.4)


def luminance(colour):
    """Relative luminance of an sRGB colour; WCAG 2.2."""
    return np.array([0.2126, 0.7152, 0.0722]) @ linear(colour)


def seen(colour, reader):
    """Return a colour in CIELAB, as a reader sees it."""
    seen_xyz = TO_XYZ @ np.clip(np.array(READERS[reader]) @ linear(colour), 0, 1) / TO_XYZ.sum(axis=1)
    x, y, z = np.where(seen_xyz > 216 / 24389, np.cbrt(seen_xyz), (24389 / 27 * seen_xyz + 16) / 116)
    return np.array([116 * y - 16, 500 * (x - y), 200 * (y - z)])


def difference(one, other, reader):
    """Return how far apart a reader sees two colours, in CIELAB."""
    return np.linalg.norm(seen(one, reader) - seen(other, reader))


def test_differences_are_those_of_the_cielab_of_black_and_white():
    assert difference("#000000", "#ffffff", "all cones") == pytest.approx(100, abs=0.1)


@pytest.mark.parametrize("reader", READERS)
def test_the_design_at_hand_differs_from_every_pinned_one(reader):
    for colour in theme.DESIGN_COLOURS:
        assert difference(theme.THIS_DESIGN, colour, reader) >= CLEAR


@pytest.mark.parametrize("reader", READERS)
def test_pinned_designs_differ_by_colour_or_by_colour_and_dash(reader):
    designs = list(zip(theme.DESIGN_COLOURS, theme.DESIGN_DASHES, strict=True))
    for (one, dash), (other, other_dash) in combinations(designs, 2):
        assert difference(one, other, reader) >= (CLEAR if dash == other_dash else TOLERABLE)


def test_every_design_colour_has_a_name():
    assert len(theme.DESIGN_COLOUR_NAMES) == len({*theme.DESIGN_COLOUR_NAMES}) == len(theme.DESIGN_COLOURS)


@pytest.mark.parametrize("paper", [theme.LIGHT_PAPER, theme.DARK_PAPER])
@pytest.mark.parametrize("colour", theme.FIGURE_COLOURS)
def test_figure_colours_stand_out_in_both_themes(colour, paper):
    darker, lighter = sorted((luminance(colour), luminance(paper)))
    assert (lighter + 0.05) / (darker + 0.05) >= 3


@pytest.mark.parametrize(
    ("frequency", "text"),
    [(5.0, "5.00 Hz"), (39.055, "39.1 Hz"), (301.47, "301 Hz"), (2251.2, "2251 Hz")],
)
def test_frequencies_show_three_figures(frequency, text):
    assert formats.frequency_text(frequency) == text


@pytest.mark.parametrize(
    ("seconds", "text"), [(0.0004, "0 ms"), (0.4821, "482 ms"), (0.9996, "1.0 s"), (12.34, "12.3 s")]
)
def test_durations_change_unit_at_a_second(seconds, text):
    assert formats.duration_text(seconds) == text


@pytest.mark.parametrize(("level", "text"), [(15.07, "+15.1 dB"), (-33.7, "−33.7 dB"), (0.0, "+0.0 dB")])
def test_levels_have_a_sign(level, text):
    assert formats.level_text(level) == text


@pytest.mark.parametrize(
    ("value", "text"), [(1000.0, "1000"), (31.5, "31.5"), (0.2, "0.2"), (0.3000001, "0.3")]
)
def test_quantities_read_as_typed(value, text):
    assert formats.quantity_text(value) == text


@pytest.mark.parametrize(("level", "text"), [(0.04, "0.0"), (-0.04, "0.0"), (-3.26, "−3.3"), (2.0, "+2.0")])
def test_levels_in_tables_have_a_sign_unless_zero(level, text):
    assert formats.signed_text(level) == text


@pytest.mark.parametrize(
    ("difference", "text"), [(0.0, "0.0"), (-0.004, "0.0"), (0.005001, "+0.01"), (-1.2, "−1.20")]
)
def test_no_difference_has_no_sign_with_more_decimals_either(difference, text):
    assert formats.signed_text(difference, 2) == text


@pytest.mark.parametrize(
    ("points", "text"),
    [([(63.0, -3.0)], "1 band, 63 Hz"), ([(31.5, 1.0), (40.0, 2.0)], "2 bands, 31.5 to 40 Hz")],
)
def test_how_far_a_table_goes_is_told_in_bands(points, text):
    assert formats.extent_text(points) == text


@pytest.mark.parametrize(
    ("name", "text"),
    [("Softer boot", "Softer boot"), ("a\x00b\nc", "a b c"), ("x" * 13, "x" * 11 + "…"), ("", "")],
)
def test_names_are_one_short_line(name, text):
    assert formats.name_text(name, 12) == text
