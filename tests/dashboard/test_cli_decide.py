"""Commands that choose between designs print what the core answers, and end with the code that says how."""

import contextlib
import csv
import io
import json
import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

import trackig_core as tig
from dashboard import cli_decide
from dashboard.cli import main
from tests.core.decide.test_search import CATALOGUE
from tests.waiting import WAIT

ROOT = Path(__file__).parent.parent.parent
BLOCK = tig.PRESETS["booted-block-low-mass"]
LEVELS = tig.solve(BLOCK, "exact").insertion_gain
CEILING = tig.Specification(
    [(hz, level + 1) for hz, level in zip(tig.BAND_CENTRES, LEVELS, strict=True)], name="One above"
)
HOPELESS = tig.Specification([(5, -40.0)])


@pytest.fixture
def save(tmp_path):
    def save(file="study.toml", **parts):
        path = tmp_path / file
        study = tig.Study(**{"design": BLOCK, "specification": CEILING, **parts})
        path.write_text(study.to_toml(), encoding="utf-8")
        return str(path)

    return save


def table(path):
    lines = path.read_text(encoding="utf-8").splitlines()
    return list(csv.DictReader(line for line in lines if not line.startswith("# ")))


def printed(text):
    """Return the cells of a printed table, which two spaces or more part, and none within."""
    return [line.split() for line in text.split("\n\n")[0].splitlines()]


def test_range_prints_and_writes_what_the_core_finds(save, tmp_path, capsys):
    out, answer = tmp_path / "out.csv", tmp_path / "out.json"
    words = ["range", save(), "--field", "boot_stiffness", "--field", "block_mass"]
    assert main([*words, "--csv", str(out), "--json", str(answer)]) == 0
    expected = tig.decide.feasible_ranges(BLOCK, CEILING, fields=["boot_stiffness", "block_mass"])
    rows = table(out)
    assert [(row["field"], row["low"], row["high"]) for row in rows] == [
        (field, f"{low:.6g}", f"{high:.6g}") for field in expected for low, high in expected[field]
    ]
    for remark in ("# study: Study", f"# answer: {expected}", "# solution: frequency-domain solution"):
        assert remark in out.read_text(encoding="utf-8").splitlines()
    said = capsys.readouterr().out
    assert said.endswith(f"\n{expected}\n")
    low, high = expected["boot_stiffness"][0]
    assert printed(said)[1] == [
        "boot_stiffness",
        f"{low / 1e6:.4g}",
        f"{high / 1e6:.4g}",
        "2",
        "200",
        "kN/mm",
    ]
    found = json.loads(answer.read_text(encoding="utf-8"))
    assert found["sentence"] == str(expected)
    assert found["rows"][0]["low"] == pytest.approx(expected["boot_stiffness"][0][0], rel=1e-12)
    assert found["settings"] == {"fields": ["boot_stiffness", "block_mass"]}


def test_a_pinned_design_and_a_deflection_limit_are_taken(save, capsys):
    soft = BLOCK.replace(boot_stiffness=15e6)
    study = save(pinned=[tig.PinnedDesign("Soft", soft)])
    sinks = tig.static_response(soft, 85e3).rail_deflection
    assert main(["range", study, "--design", "Soft", "--max-deflection", str(0.9 * sinks)]) == 0
    expected = tig.decide.feasible_ranges(soft, CEILING, max_deflection=0.9 * sinks)
    assert capsys.readouterr().out.endswith(f"\n{expected}\n")
    assert main(["range", study, "--design", "Hard"]) == 2
    assert "there is no such pinned design; pinned are 'Soft'" in capsys.readouterr().err


def test_sensitivity_is_local_or_over_tolerances(save, capsys):
    study = save()
    assert main(["sensitivity", study, "--change", "5%"]) == 0
    expected = tig.decide.sensitivity(BLOCK, CEILING, changes=0.05)
    assert capsys.readouterr().out.endswith(f"\n{expected}\n")
    words = ["--tolerance", "boot_stiffness=10%", "--tolerance", "block_mass=normal:2%", "--samples", "128"]
    assert main(["sensitivity", study, *words, "--figure", "63", "--seed", "4"]) == 0
    tolerances = {"boot_stiffness": 0.1, "block_mass": tig.decide.Normal(0.02)}
    expected = tig.decide.sobol(BLOCK, tolerances, CEILING, figures=["63"], samples=128, seed=4)
    assert capsys.readouterr().out.endswith(f"\n{expected}\n")


def test_tolerance_takes_specimens(save, tmp_path, capsys):
    specimens = tmp_path / "boots.csv"
    specimens.write_text(
        "boot_stiffness,boot_loss_factor\n27e6,0.2\n29e6,0.21\n31e6,0.22\n", encoding="utf-8"
    )
    words = [
        "--production",
        str(specimens),
        "--tolerance",
        "pad_stiffness=0.1",
        "--samples",
        "500",
        "--seed",
        "2",
    ]
    out = tmp_path / "samples.csv"
    assert main(["tolerance", save(), *words, "--csv", str(out)]) == 0
    production = {"boot_stiffness": [27e6, 29e6, 31e6], "boot_loss_factor": [0.2, 0.21, 0.22]}
    expected = tig.decide.tolerance(
        BLOCK, CEILING, {"pad_stiffness": 0.1}, production=production, samples=500, seed=2
    )
    said = capsys.readouterr()
    assert said.out.endswith(f"\n{expected}\n")
    assert said.err == "", "how far a short run is, nobody wants in a file"
    assert [row["margin"] for row in table(out)] == [f"{margin:.6g}" for margin in expected.margins]


def test_map_writes_every_point(save, tmp_path, capsys):
    out = tmp_path / "map.csv"
    words = ["map", save(), "boot_stiffness", "block_mass", "--points", "7x5"]
    words += ["--range", "block_mass=0.02 t to 90 kg"]
    assert main([*words, "--csv", str(out)]) in (0, 1)
    rows = table(out)
    assert len(rows) == 35
    point = BLOCK.replace(
        boot_stiffness=float(rows[17]["boot_stiffness"]), block_mass=float(rows[17]["block_mass"])
    )
    margin = CEILING.check(tig.solve(point, "exact").insertion_gain).worst_margin
    assert float(rows[17]["margin"]) == pytest.approx(margin, abs=0.01)
    assert {float(row["block_mass"]) for row in rows} == {20.0, 37.5, 55.0, 72.5, 90.0}
    said = capsys.readouterr().out
    assert "of the map complies" in said
    assert said.splitlines()[0].split(", ") == [
        *("over the map margin", "dB deflection", "mm loaded_track", "Hz coupled_block", "Hz")
    ]
    margins, deflections = ([float(row[name]) for row in rows] for name in ("margin", "deflection"))
    for line, of in zip(said.splitlines()[1:4], (min, np.median, max), strict=True):
        assert line.split()[1:3] == [f"{of(margins):.2f}", f"{1e3 * of(deflections):.3f}"]


SPRUNG = BLOCK.replace(suspension=tig.VEHICLES["metro"].suspension, ground=tig.GROUNDS["soft clay"])


def test_map_and_sensitivity_take_vehicle_and_ground_by_path(save, tmp_path, capsys):
    out = tmp_path / "map.csv"
    fields = ("ground.stiffness", "suspension.primary_damping")
    words = ["map", save(design=SPRUNG), *fields, "--points", "3x2", "--range", "ground.stiffness=20e6..80e6"]
    assert main([*words, "--csv", str(out)]) in (0, 1)
    expected = tig.decide.design_map(
        *(SPRUNG, *fields, CEILING),
        points=(3, 2),
        ranges={"ground.stiffness": (20e6, 80e6)},
        reference="stiff",
    )
    assert str(expected) in capsys.readouterr().out
    rows = table(out)
    assert [row["ground.stiffness"] for row in rows[:3]] == ["2e+07", "4e+07", "8e+07"]
    assert [row["margin"] for row in rows] == [f"{each:.6g}" for each in expected.figures["margin"].ravel()]
    assert main(["sensitivity", save(design=SPRUNG)]) == 0
    said = capsys.readouterr().out
    assert "suspension.body_mass" in said
    assert "ground.mass" not in said, "there is none that a share of it could change"


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["map", "ground.stiffness", "speed"], "'speed' is not a single number of this design: give any of"),
        (["range", "--field", "suspension.stiffness"], "suspension.primary_stiffness"),
        (["find", "--free", "suspension.stiffness"], "suspension.primary_stiffness"),
        (["tolerance", "--tolerance", "ground.mass=10%"], "give any of pad_stiffness"),
    ],
)
def test_a_path_that_leads_nowhere_is_told_with_those_that_do(save, capsys, words, message):
    command, *rest = words
    with pytest.raises(SystemExit) if command == "find" else contextlib.nullcontext():
        assert main([command, save(design=SPRUNG), *rest]) == 2
    assert message in capsys.readouterr().err


def test_find_takes_catalogues_and_rails(save, tmp_path, capsys):
    boots = tmp_path / "boot.csv"
    boots.write_text("boot_stiffness,boot_loss_factor,cost\n20e6,0.15,30\n28e6,0.2,20\n", encoding="utf-8")
    words = ["find", save(), "--free", "block_mass=20..100", "--choose", str(boots), "--rails", "60,60E1"]
    words += ["--objective", "margin", "--objective", "cost", "--cost", "block_mass=0.1"]
    out = tmp_path / "cloud.csv"
    assert main([*words, "--population", "20", "--generations", "6", "--csv", str(out)]) == 0
    rows = table(out)
    assert len(rows) == 120
    assert {(row["boot_stiffness"], row["rail"]) for row in rows} == {
        (boot, rail) for boot in ("2e+07", "2.8e+07") for rail in ("60", "60E1")
    }
    price = {"2e+07": 30, "2.8e+07": 20}
    for row in rows:
        expected = price[row["boot_stiffness"]] + 0.1 * float(row["block_mass"])
        assert float(row["cost"]) == pytest.approx(expected, rel=1e-5)
    told = capsys.readouterr()
    assert "designs comply, and no other beats" in told.out
    assert "No other beats a design: none that was tried is as good in margin and cost" in told.out
    assert "deflection, mm" in told.out, "what each costs in deflection, though it was not sought"
    assert "No limit of rail deflection is set" in told.out
    assert "give --max-deflection, or limit it" in told.err
    limited = [*words, "--population", "4", "--generations", "1", "--max-deflection", "0.02"]
    assert main(limited) in (0, 1)
    told = capsys.readouterr()
    assert "o limit of rail deflection" not in told.out + told.err


def test_find_takes_measured_components_of_a_catalogue(save, tmp_path, capsys):
    catalogue, out = tmp_path / "own.toml", tmp_path / "cloud.csv"
    catalogue.write_text(CATALOGUE.to_toml(), encoding="utf-8")
    words = ["find", save(), "--free", "block_mass=20..100", "--catalogue", str(catalogue)]
    asked = [*words, "--component", "pad", "--component", "rail", "--population", "8", "--generations", "2"]
    assert main([*asked, "--csv", str(out)]) in (0, 1)
    choices = {
        kind: [each.choice(BLOCK) for each in CATALOGUE.of_kind(kind).values()] for kind in ("pad", "rail")
    }
    free = {"block_mass": (20, 100)}
    expected = tig.decide.find(BLOCK, CEILING, free, choices=choices, population=8, generations=2)
    rows = table(out)
    assert [row["pad"] for row in rows] == list(expected.chosen["pad"])
    assert [row["slack"] for row in rows] == [f"{each:.6g}" for each in expected.slack]
    text = out.read_text(encoding="utf-8")
    assert "Curve(" not in text.split("digest", 1)[1]
    points = {
        name: json.loads(rows_of)
        for name, rows_of in re.findall(
            r"^# (measured \d+): .*; rows of Hz, N/m, loss factor: (.*)$", text, re.M
        )
    }
    number = next(at for at, row in enumerate(rows) if row["pad_stiffness"] in points)
    curve = tig.StiffnessCurve(points[rows[number]["pad_stiffness"]])
    assert curve.points == expected.many.design(number).pad_stiffness.points
    assert {row["pad_stiffness"] for row in rows if row["pad"] == rows[number]["pad"]} == {*points}
    said = capsys.readouterr().out
    assert said.endswith(f"\n{expected}\n")
    assert expected.chosen["pad"][expected.closest] in said
    assert main(words) == 2
    assert "--catalogue: name with --component" in capsys.readouterr().err


@pytest.mark.parametrize(
    "words",
    [
        ["range"],
        ["tolerance", "--tolerance", "boot_stiffness=10%", "--samples", "200"],
        ["find", "--free", "boot_stiffness", "--population", "8", "--generations", "2"],
    ],
)
def test_nothing_complies(save, capsys, words):
    assert main([words[0], save(specification=HOPELESS), *words[1:]]) == 1
    assert "compl" in capsys.readouterr().out


def test_no_design_of_a_map_complies(save):
    words = ["map", "boot_stiffness", "block_mass", "--points", "3x3"]
    assert main([words[0], save(specification=HOPELESS), *words[1:]]) == 1


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["range"], "no specification to hold designs against; give --specification FILE.csv"),
        (["map", "boot_stiffness", "boot_stiffness"], "both fields are boot_stiffness: give two"),
        (["sensitivity", "--tolerance", "rail=10%"], "'rail' is not a single number of this design"),
        (["map", "boot_stiffness", "block_mass", "--figure", "level"], "level: there is no source spectrum"),
        (["map", "boot_stiffness", "block_mass", "--range", "block_mass=-1..5"], "give a low end above 0"),
    ],
)
def test_input_at_fault_is_told_in_one_line(save, capsys, words, message):
    assert main([words[0], save(specification=None), *words[1:]]) == 2
    said = capsys.readouterr().err
    assert said.startswith("trackig: ")
    assert message in said
    assert said.count("\n") == 1


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("boot_stiffness\n20e6,1\n", "row 2: 2 values, and 1 fields in the header"),
        ("boot_stiffness\nsoft\n", "row 2, boot_stiffness: 'soft' is no number"),
        ("boot_stiffness [kg]\n20\n", "'boot_stiffness [kg]' names no unit of boot_stiffness, such as N/m"),
        ("pad_loss_factor [m]\n0.2\n", "names no unit of pad_loss_factor: it has none"),
        ("boot_stiffness [kN/mm]\n20 kg\n", "row 2, boot_stiffness: '20 kg': kg is a unit of mass"),
        ("boot_stiffness\n", "give a header of fields and one row or more"),
    ],
)
def test_a_table_at_fault_names_its_row(save, tmp_path, capsys, text, message):
    path = tmp_path / "table.csv"
    path.write_text(text, encoding="utf-8")
    assert main(["tolerance", save(), "--production", str(path)]) == 2
    assert message in capsys.readouterr().err
    assert main(["tolerance", save(), "--production", str(tmp_path / "none.csv")]) == 2
    assert "none.csv: No such file" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["range", "x.toml", "--range", "block_mass"], "write FIELD=LOW..HIGH"),
        (
            ["range", "x.toml", "--range", "block_mass=5"],
            "write block_mass=LOW..HIGH, with a unit or in SI; block_mass is a number from 1 to 10000 kg",
        ),
        (["range", "x.toml", "--range", "colour=1..2"], "fields are pad_stiffness"),
        (
            ["map", "x.toml", "a", "b", "--range", "boot_stiffness=5..40 kg"],
            "kg is a unit of mass; give N/m, N/mm, kN/mm or MN/m; boot_stiffness is a number from 100000 to "
            "1e+13 N/m",
        ),
        (["range", "x.toml", "--max-deflection", "2 kN"], "rail_deflection_limit is a number from 1e-06"),
        (
            ["find", "x.toml", "--cost", "block_mass=2/mm"],
            "'mm' is no unit of block_mass; give a cost per kg",
        ),
        (
            ["tolerance", "x.toml", "--tolerance", "block_mass=2kg"],
            "a tolerance is a share, such as 10% or 0.1",
        ),
        (["sensitivity", "x.toml", "--change", "a lot"], "'a lot' is no number"),
        (["find", "x.toml", "--free", "colour"], "fields are pad_stiffness"),
        (["tolerance", "x.toml", "--tolerance", "boot_stiffness"], "write FIELD=SHARE"),
        (["map", "x.toml", "a", "b", "--points", "5"], "write NXxNY"),
    ],
)
def test_words_that_are_none_are_refused_at_once(capsys, words, message):
    with pytest.raises(SystemExit) as ended:
        main(words)
    assert ended.value.code == 2
    assert message in capsys.readouterr().err


def test_numbers_have_units_wherever_they_are_taken(save, tmp_path):
    found, boots = tmp_path / "found.csv", tmp_path / "boot.csv"
    boots.write_text("Boot stiffness [kN/mm],cost (EUR)\n20,30\n28,20\n", encoding="utf-8")
    words = ["find", save(), "--free", "block_mass=20 kg:0.1 t", "--choose", str(boots)]
    words += ["--objective", "cost", "--cost", "pad_stiffness=2 per kN/mm", "--max-deflection", "1.5 mm"]
    assert main([*words, "--population", "8", "--generations", "2", "--csv", str(found)]) in (0, 1)
    rows = table(found)
    assert {row["boot_stiffness"] for row in rows} == {"2e+07", "2.8e+07"}
    assert all(20 <= float(row["block_mass"]) <= 100 for row in rows)
    price = {"2e+07": 30, "2.8e+07": 20}
    for row in rows:
        expected = price[row["boot_stiffness"]] + 2 * BLOCK.pad_stiffness / 1e6
        assert float(row["cost"]) == pytest.approx(expected, rel=1e-5)
    remarks = found.read_text(encoding="utf-8")
    assert '"free": {"block_mass": [20.0, 100.0]}' in remarks
    assert '"max_deflection": 0.0015' in remarks


def test_a_preset_and_a_specification_stand_for_a_study(save, tmp_path, capsys):
    limits = tmp_path / "limits.csv"
    limits.write_text(CEILING.to_csv(), encoding="utf-8")
    asked = ["--field", "boot_stiffness"]
    assert main(["range", "booted-block-low-mass", "--specification", str(limits), *asked]) == 0
    of_preset = capsys.readouterr().out
    assert main(["range", save(), *asked]) == 0
    assert of_preset == capsys.readouterr().out
    assert main(["range", save(specification=HOPELESS), "--specification", str(limits), *asked]) == 0
    assert of_preset == capsys.readouterr().out
    assert main(["map", "booted-sleeper", "boot_stiffness", "pad_stiffness", "--points", "3x3"]) == 0
    assert "The greatest rail deflection is" in capsys.readouterr().out
    assert main(["find", "booted-blok", "--free", "block_mass"]) == 2
    assert "did you mean booted-block-" in capsys.readouterr().err
    assert main(["find", "booted-sleeper", "--free", "block_mass"]) == 2
    assert "give --specification FILE.csv" in capsys.readouterr().err


def test_tables_name_their_units(save, capsys):
    study = save()
    assert main(["sensitivity", study, "--change", "5%"]) == 0
    title, heads, first, *_ = capsys.readouterr().out.splitlines()
    assert title == "Change of each figure when one field changes:"
    figures = "margin, dB deflection, mm loaded_track, Hz coupled_block, Hz"
    assert heads.split() == f"field changed by, % {figures}".split()
    expected = tig.decide.sensitivity(BLOCK, CEILING, changes=0.05).differences
    down = {name: values[0, 0] for name, values in expected.items()}
    assert first.split() == [
        *("pad_stiffness", "-5", f"{down['margin']:.2f}", f"{1e3 * down['deflection']:.3f}"),
        *(f"{down['loaded_track']:.1f}", f"{down['coupled_block']:.1f}"),
    ]
    assert main(["tolerance", study, "--tolerance", "boot_stiffness=10%", "--samples", "200"]) == 0
    said = capsys.readouterr().out.splitlines()
    assert said[1].split(", ") == ["band", "Hz 5 %", "dB 50 %", "dB 95 %", "dB"]
    levels = tig.decide.tolerance(BLOCK, CEILING, {"boot_stiffness": 0.1}, samples=200).percentiles
    assert said[2].split() == ["5", *(f"{level:.2f}" for level in levels[:, 0])]
    words = ["--tolerance", "boot_stiffness=10%", "--tolerance", "block_mass=2%", "--samples", "128"]
    assert main(["sensitivity", study, *words]) == 0
    said = capsys.readouterr().out.splitlines()
    indices = tig.decide.sobol(BLOCK, {"boot_stiffness": 0.1, "block_mass": 0.02}, CEILING, samples=128)
    assert "alone, %" in said[1]
    assert f" {100 * indices.first_order[0, 0]:.0f} (" in said[2]


SEARCH = ["--free", "boot_stiffness=20..40 kN/mm", "--free", "block_mass", "--population", "20"]


def test_a_few_of_the_best_designs_are_printed_unless_all_are_asked_for(save, capsys):
    words = ["find", save(), *SEARCH, "--generations", "12"]
    assert main(words) == 0
    free = {"boot_stiffness": (20e6, 40e6), "block_mass": (10, 500)}
    best = tig.decide.find(BLOCK, CEILING, free, population=20, generations=12)
    count = best.front.size
    assert count > 10
    heads, *rows, remark = capsys.readouterr().out.split("\n\n")[0].splitlines()
    assert re.findall(r"\S+, \S+", heads) == [
        *("block_mass, kg", "boot_stiffness, kN/mm", "margin, dB", "deflection, mm", "slack, dB")
    ]
    assert len(rows) == 10
    assert remark.startswith(
        f"10 of the {count} best designs, spread evenly over them, greatest margin first"
    )
    ends = [best.best()[0], best.best()[-1]]
    assert [row.split()[:2] for row in (rows[0], rows[-1])] == [
        [f"{each.block_mass:.4g}", f"{each.boot_stiffness / 1e6:.4g}"] for each in ends
    ]
    assert main([*words, "--all"]) == 0
    rows = printed(capsys.readouterr().out)[1:]
    assert [row[1] for row in rows] == [f"{each.boot_stiffness / 1e6:.4g}" for each in best.best()]


def test_it_does_not_write_over_files(save, tmp_path, capsys):
    out = tmp_path / "out.csv"
    out.write_text("mine")
    assert main(["range", save(), "--csv", str(out)]) == 2
    assert out.read_text() == "mine"
    assert "give --force" in capsys.readouterr().err
    assert main(["range", save(), "--csv", str(out), "--force"]) == 0


def test_designs_go_to_a_folder_part_by_part(save, tmp_path, capsys):
    folder = tmp_path / "map"
    words = ["map", save(), "boot_stiffness", "block_mass", "--points", "5x4", "--parquet", str(folder)]
    assert main(words) == 0
    assert capsys.readouterr().out == "20 designs are solved, in 1 part of which 0 were there.\n"
    assert main(words) == 0
    assert "1 part of which 1" in capsys.readouterr().out
    expected = tig.decide.design_map(BLOCK, "boot_stiffness", "block_mass", points=(5, 4), figures=["63"])
    found = pd.read_parquet(folder)
    assert np.array_equal(found["63"].to_numpy().reshape(4, 5), expected.figures["63"])
    words = ["tolerance", save(), "--tolerance", "boot_stiffness=10%", "--samples", "50", "--parquet"]
    assert main([*words, str(folder)]) == 2
    assert "holds another job" in capsys.readouterr().err
    assert main([*words, str(tmp_path / "samples")]) == 0
    found = pd.read_parquet(tmp_path / "samples")["boot_stiffness"]
    expected = tig.decide.tolerance(BLOCK, CEILING, {"boot_stiffness": 0.1}, samples=200)
    assert found.tolist() == expected.many.columns["boot_stiffness"][:50].tolist()


QUESTIONS = {
    "tolerance": {"tolerances": {"boot_stiffness": {"uniform": 0.1}}, "samples": 200},
    "map": {"x_field": "boot_stiffness", "y_field": "block_mass", "figures": ["margin"], "points": [12, 9]},
    "find": {"free": ["boot_stiffness"], "population": 8, "generations": 2},
}


def test_a_report_has_the_pictures_of_kept_answers_that_come_out_again(save, tmp_path, capsys):
    answers = []
    for kind, settings in QUESTIONS.items():
        question = tig.decide.Question(kind, BLOCK, settings, CEILING)
        answers.append(tig.decide.Answer.of(question, question.ask()))
    other = tig.decide.Question("map", BLOCK, {**QUESTIONS["map"], "points": [5, 5]}, CEILING)
    answers.append(tig.decide.Answer(other, "It was otherwise.", "0" * 64, {}))
    unanswerable = tig.decide.Question("map", BLOCK, {**QUESTIONS["map"], "points": [1, 5]}, CEILING)
    answers.append(tig.decide.Answer(unanswerable, "Nobody could say.", "1" * 64, {}))
    out = tmp_path / "report.html"
    assert main(["report", save(answers=answers), str(out), "--fidelity", "exact"]) == 0
    text = out.read_text(encoding="utf-8")
    sections = re.findall(r'<section class="page">.*?</section>', text, re.DOTALL)
    assert ["<svg" in section for section in sections] == [True, True, False, False, False]
    assert "Designs of the front" in sections[2]
    # each was asked: none says that it was not
    assert ["computed again" in section for section in sections] == [False] * 5
    said = [
        "Other figures came out on this machine. The answer is now: ",
        "It could not be asked again: points = (1, 5): give two numbers from 2",
    ]
    assert [words in section for words, section in zip(said, sections[3:], strict=True)] == [True] * 2
    notes = [line for line in capsys.readouterr().err.splitlines() if line.startswith("kept answer")]
    assert f"'It was otherwise.', in the report by its words alone: {said[0]}" in notes[0]
    assert f"'Nobody could say.', in the report by its words alone: {said[1]}" in notes[1]


@pytest.mark.slow
@pytest.mark.skipif(os.name == "nt", reason="signals are sent")
def test_control_c_leaves_the_best_so_far(save, tmp_path):
    out = tmp_path / "cloud.csv"
    words = ["find", save(), "--free", "boot_stiffness", "--free", "block_mass", "--generations", "100000"]
    screen, stderr = os.openpty()
    process = subprocess.Popen(
        [sys.executable, "-m", "dashboard", *words, "--csv", str(out)],
        cwd=ROOT,
        stdout=subprocess.PIPE,
        stderr=stderr,
        text=True,
    )
    os.close(stderr)
    # 0 % is told after the first generation
    said = b""
    while not said.endswith(b"\r0 %"):  # a first run says before that it compiles
        said += os.read(screen, 1)
    time.sleep(0.5)
    process.send_signal(signal.SIGINT)
    said, _ = process.communicate(timeout=WAIT)
    os.close(screen)
    assert process.returncode == 130
    assert "designs comply, and no other beats" in said
    assert len(table(out)) >= 100


class Screen(io.StringIO):
    def isatty(self):
        return True


def test_how_far_it_is_stands_in_one_line_on_a_screen_and_seldom_in_a_file(monkeypatch):
    now = 0.0
    monkeypatch.setattr(cli_decide.time, "monotonic", lambda: now)
    said = {}
    for stream in (Screen(), io.StringIO()):
        now = 0.0
        monkeypatch.setattr(sys, "stderr", stream)
        with cli_decide.watched(None) as how:
            for done in (0.0, 0.05, 0.1, 0.2, 0.25, 0.35, 1.0):
                how["progress"](done)
                now += 4
        said[type(stream)] = stream.getvalue()
    assert said == {Screen: "\r0 %\r10 %\r20 %\r30 %\r100 %\n", io.StringIO: "20 %\n100 %\n"}
