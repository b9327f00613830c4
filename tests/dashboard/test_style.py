"""Contrast of the colours, and numbers as text."""

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


@pytest.mark.parametrize(
    ("name", "text"),
    [("Softer boot", "Softer boot"), ("a\x00b\nc", "a b c"), ("x" * 13, "x" * 11 + "…"), ("", "")],
)
def test_names_are_one_short_line(name, text):
    assert style.name_text(name, 12) == text
