"""Contrast of the colours, and numbers as text."""

import itertools

import numpy as np
import pytest

from dashboard import style


def luminance(colour):
    """Relative luminance of an sRGB colour; WCAG 2.2."""
    channels = [int(colour[i : i + 2], 16) / 255 for i in (1, 3, 5)]
    linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in channels]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


@pytest.mark.parametrize("paper", [style.LIGHT_PAPER, style.DARK_PAPER])
@pytest.mark.parametrize("colour", style.FIGURE_COLOURS)
def test_figure_colours_stand_out_in_both_themes(colour, paper):
    darker, lighter = sorted((luminance(colour), luminance(paper)))
    assert (lighter + 0.05) / (darker + 0.05) >= 3


@pytest.mark.parametrize(
    ("frequency", "text"),
    [(5.0, "5.00 Hz"), (39.055, "39.1 Hz"), (301.47, "301 Hz"), (2251.2, "2251 Hz")],
)
def test_frequencies_show_three_figures(frequency, text):
    assert style.frequency_text(frequency) == text


@pytest.mark.parametrize(
    ("seconds", "text"), [(0.0004, "0 ms"), (0.4821, "482 ms"), (0.9996, "1.0 s"), (12.34, "12.3 s")]
)
def test_durations_change_unit_at_a_second(seconds, text):
    assert style.duration_text(seconds) == text


@pytest.mark.parametrize(("level", "text"), [(15.07, "+15.1 dB"), (-33.7, "−33.7 dB"), (0.0, "+0.0 dB")])
def test_levels_have_a_sign(level, text):
    assert style.level_text(level) == text


@pytest.mark.parametrize(
    ("value", "text"), [(1000.0, "1000"), (31.5, "31.5"), (0.2, "0.2"), (0.3000001, "0.3")]
)
def test_quantities_read_as_typed(value, text):
    assert style.quantity_text(value) == text


EYES = {
    "normal": np.eye(3),
    "red-blind": [
        (0.152286, 1.052583, -0.204868), (0.114503, 0.786281, 0.099216), (-0.003882, -0.048116, 1.051998)
    ],
    "green-blind": [
        (0.367322, 0.860646, -0.227968), (0.280085, 0.672501, 0.047413), (-0.011820, 0.042940, 0.968881)
    ],
}  # fmt: skip
"""How eyes turn linear sRGB into what others would see; Machado, Oliveira and Fernandes (2009)."""

TO_XYZ = np.array([[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]])


def lab(colour, eyes):
    """Return CIELAB 1976 coordinates of a colour as given eyes see it."""
    channels = np.array([int(colour[i : i + 2], 16) / 255 for i in (1, 3, 5)])
    linear = np.where(channels <= 0.04045, channels / 12.92, ((channels + 0.055) / 1.055) ** 2.4)
    xyz = TO_XYZ @ np.clip(np.array(eyes) @ linear, 0, 1) / TO_XYZ.sum(axis=1)
    x, y, z = np.where(xyz > 0.008856, np.cbrt(xyz), 7.787 * xyz + 16 / 116)
    return np.array([116 * y - 16, 500 * (x - y), 200 * (y - z)])


@pytest.mark.parametrize("eyes", EYES.values(), ids=EYES)
def test_all_eyes_tell_designs_apart(eyes):
    colours = [lab(colour, eyes) for colour in (style.THIS_DESIGN, *style.PIN_COLOURS)]
    assert min(np.linalg.norm(a - b) for a, b in itertools.combinations(colours, 2)) > 12


def test_no_two_designs_share_a_dash():
    assert len(set(style.DASHES)) == len(style.DASHES) == 1 + len(style.PIN_COLOURS)


@pytest.mark.parametrize(("level", "text"), [(0.04, "0.0"), (-0.04, "0.0"), (-3.26, "−3.3"), (2.0, "+2.0")])
def test_levels_in_tables_have_a_sign_unless_zero(level, text):
    assert style.signed_text(level) == text
