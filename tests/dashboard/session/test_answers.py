"""Kept answers: their settings are told as people chose them."""

import pytest

import trackig_core as tig
from dashboard.session.answers import settings_texts

BLOCK = tig.PRESETS["booted-block-low-mass"]
LIMITS = tig.Specification([(63, 2.0)])


@pytest.mark.parametrize(
    ("kind", "settings", "words"),
    [
        (
            "map",
            {"x_field": "boot_stiffness", "y_field": "block_mass"},
            ["across: boot stiffness", "up: block mass"],
        ),
        (
            "find",
            {"free": {"boot_stiffness": [10e6, 40e6]}, "max_deflection": 1.5e-3},
            ["free: boot stiffness 10 kN/mm to 40 kN/mm", "rail sinks at most: 1.5 mm"],
        ),
    ],
)
def test_settings_are_called_what_they_are_where_they_are_chosen(kind, settings, words):
    question = tig.decide.Question(kind, BLOCK, settings, specification=LIMITS)
    assert settings_texts(question) == words
