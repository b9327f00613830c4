"""One question of each kind gives the same figures from the library, on the page and on the command line."""

import json

import pytest

import trackig_core as tig
from dashboard.cli import main
from dashboard.compute.inquiries import Inquiry, InquiryRunner
from tests.core.decide.test_search import CATALOGUE
from tests.waiting import on_a_loop
from trackig_core.decide.questions import digest

BLOCK = tig.PRESETS["booted-block-low-mass"].replace(boot_static_stiffness=20e6)
LEVELS = tig.solve(BLOCK, "exact").insertion_gain
LIMITS = tig.Specification(
    [(hz, level + 1) for hz, level in zip(tig.BAND_CENTRES, LEVELS, strict=True)],
    rail_deflection_limit=2.5e-3,
)
PADS = [each.choice(BLOCK) for each in CATALOGUE.of_kind("pad").values()]
MOST = 2.2e-3

ASKED = {
    "range": (
        lambda: tig.decide.feasible_ranges(BLOCK, LIMITS, fields=["boot_stiffness"], max_deflection=MOST),
        {"fields": ["boot_stiffness"]},
        ["range", "--field", "boot_stiffness"],
    ),
    "sensitivity": (
        lambda: tig.decide.sensitivity(BLOCK, LIMITS, changes=0.05, max_deflection=MOST),
        {"changes": 0.05},
        ["sensitivity", "--change", "5%"],
    ),
    "tolerance": (
        lambda: tig.decide.tolerance(
            BLOCK, LIMITS, {"block_mass": 0.1}, samples=300, seed=4, max_deflection=MOST
        ),
        {"tolerances": {"block_mass": 0.1}, "samples": 300, "seed": 4},
        ["tolerance", "--tolerance", "block_mass=10%", "--samples", "300", "--seed", "4"],
    ),
    "map": (
        lambda: tig.decide.design_map(
            BLOCK, "boot_stiffness", "block_mass", LIMITS, points=(7, 5), max_deflection=MOST
        ),
        {"x_field": "boot_stiffness", "y_field": "block_mass", "points": [7, 5]},
        ["map", "boot_stiffness", "block_mass", "--points", "7x5"],
    ),
    "find": (
        lambda: tig.decide.find(
            BLOCK,
            LIMITS,
            {"block_mass": (20.0, 90.0)},
            choices={"pad": PADS},
            population=8,
            generations=3,
            seed=2,
            max_deflection=MOST,
        ),
        {
            "free": {"block_mass": [20.0, 90.0]},
            "choices": {"pad": PADS},
            "population": 8,
            "generations": 3,
            "seed": 2,
        },
        [
            *("find", "--free", "block_mass=20..90", "--catalogue", "own.toml", "--component", "pad"),
            *("--population", "8", "--generations", "3", "--seed", "2"),
        ],
    ),
}
"""The same question by its function, as the page asks it, and in words of the command line."""


@pytest.mark.parametrize("kind", ASKED)
def test_the_figures_are_the_same_everywhere(kind, tmp_path, monkeypatch, capsys):
    function, settings, (command, *words) = ASKED[kind]
    expected = function()

    inquiry = Inquiry()
    InquiryRunner(inquiry)
    settings = {**settings, "max_deflection": MOST}
    question = tig.decide.Question(kind, BLOCK, settings, specification=LIMITS)
    on_a_loop(inquiry.param.update, asked=question)
    assert not inquiry.problem
    assert inquiry.answered == question
    assert digest(inquiry.result) == digest(expected)

    monkeypatch.chdir(tmp_path)
    (tmp_path / "own.toml").write_text(CATALOGUE.to_toml(), encoding="utf-8")
    (tmp_path / "study.toml").write_text(tig.Study(BLOCK, specification=LIMITS).to_toml(), encoding="utf-8")
    assert main([command, "study.toml", *words, "--max-deflection", str(MOST), "--json", "-"]) in (0, 1)
    said = json.loads(capsys.readouterr().out)
    assert said["digest"] == digest(expected)
    assert said["sentence"] == str(expected)
    assert len(said["rows"]) == len(expected.to_dataframe())
    if kind == "find":
        curve = CATALOGUE.of_kind("pad")["Measured"].values["pad_stiffness"]
        measured = next(each for each in said["rows"] if each["pad"] == "Measured")
        assert measured["pad_stiffness"] == {
            "points": [list(point) for point in curve.points],
            "preload": curve.preload,
        }
