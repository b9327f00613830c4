"""The command line: what it prints is what the core computes, and errors are told in one line."""

import contextlib
import csv
import dataclasses
import html
import io
import json
import logging
import os
import re
import socket
import subprocess
import sys
import time
import urllib.error
import urllib.request
from pathlib import Path

import numpy as np
import pytest

import trackig_core as tig
from dashboard import formats
from dashboard.cli import main
from tests.waiting import WAIT

ROOT = Path(__file__).parent.parent.parent
BLOCK = tig.PRESETS["booted-block-low-mass"]
FLOOR = tig.Specification([(8, -50.0)], name="Floor")
CEILING = tig.Specification([(float(label), 40.0) for label in tig.BAND_LABELS], name="Ceiling")


@pytest.fixture
def save(tmp_path):
    """Return a function that saves a study and returns its path."""

    def save(file="study.toml", **parts):
        path = tmp_path / file
        path.write_text(tig.Study(**{"design": BLOCK, **parts}).to_toml(), encoding="utf-8")
        return str(path)

    return save


def bands(text):
    """Return the levels of a printed table of bands."""
    lines = [line.split() for line in text.splitlines()]
    found = {line[0]: float(line[1]) for line in lines if len(line) == 2 and line[0] in tig.BAND_LABELS}
    return np.array([found[label] for label in tig.BAND_LABELS])


def test_solve_prints_what_the_core_finds(capsys):
    assert main(["solve", "booted-sleeper", "--set", "boot_stiffness=20e6", "--fidelity", "exact"]) == 0
    text = capsys.readouterr().out
    solution = tig.solve(tig.PRESETS["booted-sleeper"].replace(boot_stiffness=20e6), "exact")
    np.testing.assert_allclose(bands(text), solution.insertion_gain, atol=0.0501)
    assert f"loaded track    {solution.natural_frequencies.loaded_track:.1f} Hz" in text


def test_solve_is_the_papers_unless_told_otherwise(capsys, summary):
    assert main(["solve", "booted-block-low-mass"]) == 0
    text = capsys.readouterr().out
    np.testing.assert_allclose(
        bands(text), summary("booted-block-low-mass").solution.insertion_gain, atol=0.0501
    )
    assert "fidelity paper, reference line, summation energy" in text


def test_a_study_is_solved_as_it_is_looked_at(capsys, save):
    path = save(view=tig.View(summation="coherent", reference="rigid"))
    assert main(["solve", path, "--fidelity", "exact"]) == 0
    text = capsys.readouterr().out
    expected = tig.solve(BLOCK, "exact", summation="coherent", reference="rigid").insertion_gain
    np.testing.assert_allclose(bands(text), expected, atol=0.0501)
    assert main(["solve", path, "--fidelity", "exact", "--reference", "line"]) == 0
    assert "reference line, summation coherent" in capsys.readouterr().out


def test_what_was_measured_is_named_with_its_preload(capsys, save):
    curve = tig.StiffnessCurve([(1, 310.4e6, 0.151), (10, 605.7e6, 0.151), (30, 671e6, 0.151)], preload=30e3)
    path = save(design=BLOCK.replace(pad_stiffness=curve, pad_loss_factor=None))
    assert main(["solve", path, "--fidelity", "exact", "--json", str(Path(path).with_name("out.json"))]) == 0
    text = capsys.readouterr().out
    assert "pad stiffness measured at 3 frequencies, 1 to 30 Hz, preload 30 kN; fit error " in text
    found = json.loads(Path(path).with_name("out.json").read_text(encoding="utf-8"))
    assert found["design"]["pad_stiffness"] == {
        "points": [list(row) for row in curve.points],
        "preload": 30e3,
    }


def test_a_track_is_written_as_a_study_that_other_commands_take(capsys, save, tmp_path):
    out, limits = tmp_path / "own.toml", tmp_path / "limits.csv"
    limits.write_text(CEILING.to_csv(), encoding="utf-8")
    words = ["solve", "booted-sleeper", "--set", "boot_stiffness=20kN/mm", "--fidelity", "exact"]
    words += ["--reference", "rigid", "--bands", "octave", "--wheel-load", "100 kN", "--wheelbase", "2.5 m"]
    words += ["--limits", "insertion-gain"]
    assert main([*words, "--specification", str(limits), "--study", str(out)]) == 0
    assert "fidelity exact" in capsys.readouterr().out
    softer = tig.PRESETS["booted-sleeper"].replace(boot_stiffness=20e6)
    assert tig.Study.from_toml(out.read_bytes()) == tig.Study(
        softer,
        preset="booted-sleeper",
        view=tig.View(reference="rigid", bands="octave"),
        load=tig.study.StaticLoad(100e3, 2.5),
        specification=dataclasses.replace(CEILING, name="Specification"),
    )
    assert main(["check", str(out), "--fidelity", "exact"]) == 0
    assert "complies" in capsys.readouterr().out
    assert main([*words, "--study", str(out)]) == 2
    assert "give --force" in capsys.readouterr().err
    # what a study holds besides is kept
    pinned = [tig.PinnedDesign("Soft", softer)]
    assert main(["solve", save(pinned=pinned, name="Mine"), "--fidelity", "exact", "--study", "-"]) == 0
    written = tig.Study.from_toml(capsys.readouterr().out)
    assert (written.name, written.pinned) == ("Mine", tuple(pinned))


@pytest.mark.parametrize(("at_screen", "told"), [(True, "trackig: kernels are compiled\n"), (False, "")])
def test_who_waits_at_a_screen_is_told_that_a_first_run_compiles(monkeypatch, at_screen, told):
    log = logging.getLogger("trackig_core.compiling")
    for name in ("handlers", "level", "propagate"):
        monkeypatch.setattr(log, name, getattr(log, name))
    screen = io.TextIOWrapper(io.BytesIO(), encoding="utf-8", write_through=True)
    screen.isatty = lambda: at_screen
    monkeypatch.setattr(sys, "stderr", screen)
    assert main(["solve", "slab-track", "--fidelity", "exact"]) == 0
    log.info("kernels are compiled")
    said = screen.buffer.getvalue().decode().replace("\r\n", "\n")
    assert said.endswith(told)
    assert bool(said) == bool(told)


def test_a_preset_is_checked_and_reported(capsys, tmp_path):
    limits, out = tmp_path / "limits.csv", tmp_path / "report.html"
    limits.write_text(CEILING.to_csv(), encoding="utf-8")
    given = ["--specification", str(limits), "--fidelity", "exact", "--limits", "insertion-gain"]
    assert main(["check", "slab-track", *given]) == 0
    assert "complies, least margin" in capsys.readouterr().out
    assert main(["report", "slab-track", str(out), *given]) == 0
    assert "[500.0, 40.0],\n]" in out.read_text(encoding="utf-8")


TABLES = ROOT / "tests" / "data" / "measured_stiffness"


@pytest.mark.parametrize(
    ("name", "part", "extrapolated"),
    [("pad_1_to_30_hz", "pad", "from 31.5 Hz on"), ("polyurethane", "boot", "up to 8 Hz")],
)
def test_a_test_house_s_table_becomes_the_pad_or_boot(capsys, name, part, extrapolated):
    path = TABLES / f"{name}.csv"
    assert main(["solve", "booted-sleeper", "--fidelity", "exact", "--measured", f"{part}={path}"]) == 0
    text = capsys.readouterr().out
    curve = tig.study.read_stiffness(path.read_bytes()).curve
    changes = {f"{part}_stiffness": curve, f"{part}_loss_factor": None}
    design = tig.PRESETS["booted-sleeper"].replace(**changes)
    np.testing.assert_allclose(bands(text), tig.solve(design, "exact").insertion_gain, atol=0.0501)
    assert f"bands {extrapolated} rest on extrapolation" in text
    error = float(re.search(rf"{part} stiffness measured at 3 .*; fit error ([\d.]+)% at most", text)[1])
    assert error < 5


def test_a_table_whose_unit_no_pad_has_is_asked_about_and_the_answer_is_taken(capsys):
    words = [
        "solve",
        "slab-track",
        "--fidelity",
        "exact",
        "--measured",
        f"pad={TABLES / 'finite_element_pad.csv'}",
    ]
    assert main(words) == 2
    told = capsys.readouterr().err
    assert "pads have 1 to 10,000: are the figures in N/m? Give --stiffness-unit N/m" in told
    assert main([*words, "--stiffness-unit", "N/m"]) == 0
    text = capsys.readouterr().out
    assert "pad stiffness measured at 200 frequencies, 199.5 to 3162 Hz; fit error " in text
    assert "bands up to 160 Hz rest on extrapolation" in text


@pytest.mark.parametrize(
    ("words", "told"),
    [
        ("block=x.csv", "write pad=FILE.csv or boot=FILE.csv"),
        ("x.csv", "write pad=FILE.csv or boot=FILE.csv"),
        ("pad=none.csv", "none.csv: No such file"),
        (f"boot={TABLES / 'polyurethane.csv'}", "boot_stiffness"),
        (f"pad={TABLES / 'README.md'}", "README.md: "),
    ],
)
def test_a_table_that_cannot_be_measured_of_a_track_is_told_in_one_line(capsys, words, told):
    assert main(["solve", "slab-track", "--measured", words]) == 2
    error = capsys.readouterr().err
    assert told in error
    assert error.count("\n") == 1


def test_a_report_says_whose_it_is_if_that_is_given(save, tmp_path, capsys):
    out = tmp_path / "report.html"
    words = ["report", save(), str(out), "--fidelity", "exact", "--project", "Line 7"]
    assert main([*words, "--client", "<b>Metro & Co</b>", "--author", "A. Nother"]) == 0
    text = out.read_text(encoding="utf-8")
    for name, value in (
        ("Project", "Line 7"),
        ("Client", html.escape("<b>Metro & Co</b>")),
        ("Author", "A. Nother"),
    ):
        assert f"<dt>{name}</dt><dd>{value}</dd>" in text
    assert main([*words, "--force", "--client", "x" * 61]) == 2
    assert "trackig: --client = 'xxx" in capsys.readouterr().err


def test_a_report_holds_the_ladder_if_that_is_asked_for(save, tmp_path, capsys):
    page, title = tmp_path / "report.html", "What the simplified model leaves out"
    words = ["report", save(), str(page), "--fidelity", "exact", "--force"]
    assert main(words) == 0
    assert title not in page.read_text(encoding="utf-8")
    assert main([*words, "--ladder", "--vehicle", "metro", "--ground", "soft clay"]) == 0
    text = page.read_text(encoding="utf-8")
    ladder = tig.analysis.ladder(BLOCK, "metro", "soft clay")
    assert title in text
    assert "suspension, generic: metro; other axles, generic: metro; ground, generic: soft clay;" in text
    assert html.escape(ladder.sentence) in text
    assert main([*words, "--ladder"]) == 0
    assert "suspension, generic: regional; " in page.read_text(encoding="utf-8")
    # a design's own vehicle and ground are not replaced by what is generic
    own = BLOCK.replace(
        suspension=tig.Suspension(1e6, 1e4, 1e3), axle_positions=(0.0, 2.0), ground=tig.Ground(3e8, 1e6, 0.0)
    )
    words[1] = save(design=own)
    assert main([*words, "--ladder", "--vehicle", "metro", "--ground", "soft clay"]) == 0
    text = page.read_text(encoding="utf-8")
    assert "suspension, the design; other axles, the design; ground, the design;" in text
    assert html.escape(tig.analysis.ladder(own).sentence) in text
    capsys.readouterr()
    assert main([*words, "--ground", "rock"]) == 2
    assert "are those of the ladder: give --ladder too\n" in capsys.readouterr().err


def test_fields_can_be_changed_and_cleared(capsys):
    changes = ["block_mass=none", "boot_stiffness=none", "boot_loss_factor=none", "rail=54E1"]
    words = [word for change in changes for word in ("--set", change)]
    assert main(["solve", "booted-sleeper", "--fidelity", "exact", *words]) == 0
    text = capsys.readouterr().out
    design = tig.PRESETS["booted-sleeper"].replace(
        block_mass=None, boot_stiffness=None, boot_loss_factor=None, rail=tig.RAILS["54E1"]
    )
    np.testing.assert_allclose(bands(text), tig.solve(design, "exact").insertion_gain, atol=0.0501)
    assert "coupled block" not in text


def comments_and_rows(text):
    """Return the comment lines of a CSV file and the rows of its table."""
    remarks = [line for line in text.splitlines() if line.startswith("# ")]
    return remarks, list(csv.reader(text.splitlines()[len(remarks) :]))


def test_a_table_is_that_of_the_page_and_a_record_in_full(tmp_path):
    table, record = tmp_path / "ig.csv", tmp_path / "ig.json"
    arguments = ["solve", "slab-track", "--fidelity", "exact", "--csv", str(table), "--json", str(record)]
    assert main(arguments) == 0
    solution = tig.solve(tig.PRESETS["slab-track"], "exact")
    remarks, rows = comments_and_rows(table.read_text())
    assert remarks[:4] == [
        "# study: Study",
        "# design: Slab track",
        f"# insertion gain: {formats.definition_text('energy', 'line')}",
        "# solution: frequency-domain solution",
    ]
    assert f"# trackig {tig.__version__}" in remarks
    assert rows[0] == ["frequency_hz", "insertion_gain_db This design"]
    assert [row[0] for row in rows[1:]] == list(tig.BAND_LABELS)
    assert [row[1] for row in rows[1:]] == [f"{level:.4f}" for level in solution.insertion_gain]
    found = json.loads(record.read_text())
    assert found["insertion_gain_db"] == solution.insertion_gain.tolist()
    assert found["natural_frequencies_hz"]["loaded_track"] == solution.natural_frequencies.loaded_track
    assert found["natural_frequencies_hz"]["coupled_block"] is None
    rail = tig.Rail(**found["design"].pop("rail"))
    assert tig.TrackDesign(rail=rail, **found["design"]) == solution.design


def test_a_table_says_what_was_changed_and_holds_measured_curves(tmp_path, save):
    table = tmp_path / "ig.csv"
    measured = [tig.MeasuredGain([(63, -3.25)], name="On site")]
    path = save(name="Tunnel 7", preset="booted-block-low-mass", measured=measured)
    words = ["--set", "boot_stiffness=20kN/mm", "--reference", "rigid", "--fidelity", "exact"]
    assert main(["solve", path, *words, "--csv", str(table)]) == 0
    remarks, rows = comments_and_rows(table.read_text())
    assert remarks[:3] == [
        "# study: Tunnel 7",
        "# design: Booted block, low mass, modified",
        f"# insertion gain: {formats.definition_text('energy', 'rigid')}",
    ]
    assert rows[0][2] == "measured_insertion_gain_db On site"
    assert {row[2] for row in rows[1:]} == {"", "-3.2500"}


def test_files_are_not_written_over_unless_forced(tmp_path, capsys, save):
    table = tmp_path / "ig.csv"
    table.write_text("precious")
    arguments = ["solve", "slab-track", "--fidelity", "exact", "--csv", str(table)]
    assert main(arguments) == 2
    assert "give --force" in capsys.readouterr().err
    assert table.read_text() == "precious"
    assert main([*arguments, "--force"]) == 0
    assert table.read_text().startswith("# study: ")
    path = save("study.html")
    before = Path(path).read_text()
    assert main(["report", path, path, "--force"]) == 2
    assert "this is the file that is read" in capsys.readouterr().err
    assert Path(path).read_text() == before


@pytest.mark.parametrize(
    ("option", "begin"), [("--csv", "# study: Study\n# design: Slab track\n"), ("--json", "{")]
)
def test_a_file_may_be_standard_output_which_then_holds_nothing_else(capsys, tmp_path, option, begin):
    arguments = ["solve", "slab-track", "--fidelity", "exact", option]
    assert main([*arguments, str(tmp_path / "file")]) == 0
    assert "loaded track" in capsys.readouterr().out
    assert main([*arguments, "-"]) == 0
    output = capsys.readouterr().out
    assert output == (tmp_path / "file").read_text()
    assert output.startswith(begin)


@pytest.mark.parametrize(
    ("change", "field", "value"),
    [
        ("boot_stiffness=20kN/mm", "boot_stiffness", 20e6),
        ("boot_stiffness = 20 kN/mm", "boot_stiffness", 20e6),
        ("boot_stiffness=20e6", "boot_stiffness", 20e6),
        ("boot_stiffness=20_000_000", "boot_stiffness", 20e6),
        ("wheel_mass=880kg", "wheel_mass", 880.0),
        ("wheel_mass=0,88 t", "wheel_mass", 880.0),
        ("pad_loss_factor=20 %", "pad_loss_factor", 0.2),
        ("fastener_spacing=60 cm", "fastener_spacing", 0.6),
        ("rail=49E1", "rail", tig.RAILS["49E1"]),
    ],
)
def test_a_change_may_have_a_unit(capsys, change, field, value):
    arguments = ["solve", "booted-sleeper", "--fidelity", "exact", "--json", "-", "--set", change]
    assert main(arguments) == 0
    found = json.loads(capsys.readouterr().out)["design"][field]
    assert found == (dataclasses.asdict(value) if field == "rail" else value)


@pytest.mark.parametrize(
    ("specification", "pinned", "code"),
    [
        (CEILING, [], 0),
        (FLOOR, [], 1),
        (CEILING, [tig.PinnedDesign("Softer", BLOCK.replace(boot_stiffness=20e6))], 0),
    ],
)
def test_check_tells_each_verdict_and_whether_all_comply(save, capsys, specification, pinned, code):
    assert main(["check", save(specification=specification, pinned=pinned), "--fidelity", "exact"]) == code
    lines = capsys.readouterr().out.splitlines()
    designs = {"This design": BLOCK} | {each.name: each.design for each in pinned}
    levels = {name: tig.solve(design, "exact").insertion_gain for name, design in designs.items()}
    assert lines[::2] == [f"{name}: {specification.check(level)}" for name, level in levels.items()]
    for line, design in zip(lines[1::2], designs.values(), strict=True):
        sinks = 1e3 * tig.static_response(design).rail_deflection
        assert line.startswith(f"    rail deflection at least {sinks:.2f} mm, seat load ")


def test_check_of_a_limit_of_deflection_alone_follows_the_static_stiffness(save, capsys):
    stiff = BLOCK.replace(pad_static_stiffness=80e6, boot_static_stiffness=14e6)
    sinks = [tig.static_response(each).rail_deflection for each in (BLOCK, stiff)]
    assert sinks[0] < sinks[1], "a static stiffness below the dynamic one lets the rail sink further"
    between = tig.Specification([], rail_deflection_limit=sum(sinks) / 2)
    assert main(["check", save(specification=between), "--fidelity", "exact"]) == 0
    assert "This design: complies; rail deflection" in capsys.readouterr().out
    pinned = [tig.PinnedDesign("As stated", stiff)]
    assert main(["check", save(specification=between, pinned=pinned), "--fidelity", "exact"]) == 1
    lines = capsys.readouterr().out.splitlines()
    assert lines[2].startswith("As stated: fails; rail deflection")
    assert f"rail deflection {1e3 * sinks[1]:.2f} mm" in lines[3]


def test_only_designs_that_are_shown_are_checked(save, capsys):
    slab = tig.PRESETS["slab-track"]
    levels = [tig.solve(design, "exact").insertion_gain[15] for design in (BLOCK, slab)]
    between = tig.Specification([(160, sum(levels) / 2)])
    assert levels[0] < levels[1]
    for shown in (True, False):
        pinned = [tig.PinnedDesign("Slab", slab, shown=shown)]
        path = save(specification=between, pinned=pinned)
        assert main(["check", path, "--fidelity", "exact"]) == int(shown)
        assert ("Slab: fails by" in capsys.readouterr().out) == shown


def test_check_takes_a_specification_from_a_file(save, tmp_path, capsys):
    table = tmp_path / "limit.csv"
    table.write_text(FLOOR.to_csv())
    assert main(["check", save(), "--fidelity", "exact", "--specification", str(table)]) == 1
    table.write_text("frequency_hz,ig_max_db\n8,x\n")
    capsys.readouterr()
    assert main(["check", save(), "--fidelity", "exact", "--specification", str(table)]) == 2
    assert f"{table}: line 2, column 2: limit 'x'" in capsys.readouterr().err


def test_a_report_is_written(save, tmp_path, capsys):
    out = tmp_path / "out.html"
    pinned = [tig.PinnedDesign("<b>Softer</b>", BLOCK.replace(boot_stiffness=20e6), shown=False)]
    path = save(specification=CEILING, pinned=pinned, view=tig.View(base=0), name="Assessment")
    assert main(["report", path, str(out), "--fidelity", "exact"]) == 0
    text = out.read_text(encoding="utf-8")
    assert text.startswith("<!DOCTYPE html>")
    assert "<h1>Assessment</h1>" in text
    assert tig.__version__ in text
    assert capsys.readouterr().out.strip() == str(out)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["solve", "booted-slper"], "did you mean booted-sleeper?"),
        (["solve", "zzz.toml"], "no preset and no file; presets are slab-track"),
        (["solve", "slab-track", "--set", "boot_stifness=2e7"], "'boot_stiffness'"),
        (["solve", "slab-track", "--set", "pad_stiffness=20"], "from 100000 to 1e+13 N/m"),
        (["solve", "slab-track", "--set", "pad_stiffness=nan"], "'nan' is no number; pad_stiffness is"),
        (["solve", "slab-track", "--set", "pad_stiffness=stiff"], "a number from 100000 to 1e+13 N/m"),
        (["solve", "slab-track", "--set", "pad_stiffness=20 kg"], "kg is a unit of mass; give N/m, N/mm"),
        (["solve", "slab-track", "--set", "wheel_mass=1,200"], "'1,200' may be 1200 or 1.200"),
        (["solve", "slab-track", "--csv", "-", "--json", "-"], "standard output takes one of them"),
        (["report", "{tmp}/bare.toml", "{tmp}/x.pdf"], "write {tmp}/x.html, and print it to PDF"),
        (["report", "{tmp}/bare.toml", "{tmp}/x"], "a report is an HTML file"),
        (["solve", "slab-track", "--set", "pad_stiffness"], "write FIELD=VALUE"),
        (["solve", "slab-track", "--set", "rail=99"], "rails are 60, 49E1"),
        (["solve", "slab-track", "--set", "boot_stiffness=2e7"], "come together"),
        (["solve", "{tmp}"], "{tmp}: "),
        (["solve", "{tmp}/bad.toml"], "{tmp}/bad.toml: this is not TOML"),
        (["solve", "{tmp}/large.toml"], "{tmp}/large.toml: the file is larger than 256 kB"),
        (["check", "{tmp}/none.toml"], "{tmp}/none.toml: no preset and no file"),
        (["check", "slab-track"], "give --specification FILE.csv"),
        (["solve", "slab-track", "--limits", "insertion-loss"], "give --study too"),
        (["solve", "slab-track", "--csv", "-", "--study", "-"], "standard output takes one of them"),
        (["check", "{tmp}/bare.toml"], "has no specification"),
        (["report", "{tmp}/bare.toml", "{tmp}/no/such/folder.html", "--fidelity", "exact"], "No such file"),
        (["solve", "slab-track", "--fidelity", "exact", "--set", "pad_loss_factor=0"], "loss"),
    ],
)
def test_errors_are_told_in_one_line(arguments, words, tmp_path, capsys, save):
    save("bare.toml")
    (tmp_path / "bad.toml").write_text("format = ")
    (tmp_path / "large.toml").write_text("#" * 300_000)
    assert main([each.format(tmp=tmp_path) for each in arguments]) == 2
    output = capsys.readouterr()
    assert output.out == ""
    assert output.err.startswith("trackig: ")
    assert output.err.count("\n") == 1
    assert words.format(tmp=tmp_path) in output.err


@pytest.mark.parametrize(
    "arguments",
    [[], ["solve"], ["fly"], ["solve", "slab-track", "--fidelity", "wild"], ["serve", "--port", "99999"]],
)
def test_wrong_usage_exits_with_two(arguments, capsys):
    with pytest.raises(SystemExit) as caught:
        main(arguments)
    assert caught.value.code == 2
    assert "usage: trackig" in capsys.readouterr().err


def test_a_specification_of_insertion_loss_is_not_taken_for_gain(save, tmp_path, capsys):
    table, study = tmp_path / "limit.csv", save(design=tig.PRESETS["slab-track"])
    arguments = ["check", study, "--fidelity", "exact", "--specification", str(table)]
    table.write_text("Frequenz [Hz];Einfügungsdämm-Maß [dB]\n63;10\n630;10\n", encoding="utf-8")
    assert main(arguments) == 2
    output = capsys.readouterr()
    assert output.out == ""
    assert "set aside, outside 5 to 500 Hz: 630 Hz" in output.err
    assert "Give --limits insertion-loss" in output.err
    assert main([*arguments, "--limits", "insertion-loss"]) == 1
    assert main([*arguments, "--limits", "insertion-gain"]) == 0
    assert "complies in 1 of 2 limits" in capsys.readouterr().out
    table.write_text("63;10\n")
    assert main(arguments) == 2
    output = capsys.readouterr()
    assert output.out == ""
    assert "no verdict: no limit is below 0 dB, as if they were insertion losses" in output.err
    assert "Give --limits insertion-loss to turn their sign, or --limits insertion-gain" in output.err
    assert main([*arguments, "--limits", "insertion-gain"]) == 0


def test_a_study_that_leaves_a_question_open_gets_no_verdict(save, tmp_path, capsys):
    specification = tig.Specification.given([(63, 10.0)], set_aside=("630 Hz",))
    study, out = save(specification=specification), tmp_path / "report.html"
    for command in (["check", study], ["report", study, str(out)], ["range", study], ["sensitivity", study]):
        assert main(command) == 2
        output = capsys.readouterr()
        assert output.out == ""
        assert f"{study}: no verdict: no limit is below 0 dB" in output.err
    assert not out.exists()
    assert main(["check", study, "--fidelity", "exact", "--limits", "insertion-gain"]) == 0
    assert "1 not judged, of no band from 5 to 500 Hz: 630 Hz" in capsys.readouterr().out
    assert main(["range", study, "--field", "boot_stiffness", "--limits", "insertion-loss"]) in (0, 1)
    assert "\nLimits of the specification: 1 not judged" in capsys.readouterr().out
    options = ["--fidelity", "exact", "--limits", "insertion-gain"]
    assert main(["report", study, str(out), *options]) == 0
    assert "1 not judged, of no band from 5 to 500 Hz: 630 Hz" in out.read_text(encoding="utf-8")


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="there are no named pipes")
def test_a_pipe_is_refused_at_once(tmp_path, capsys):
    os.mkfifo(tmp_path / "fifo.toml")
    assert main(["check", str(tmp_path / "fifo.toml")]) == 2
    assert "this is not a regular file" in capsys.readouterr().err


def test_help_names_units_and_ranges(capsys):
    with pytest.raises(SystemExit) as caught:
        main(["solve", "--help"])
    assert caught.value.code == 0
    text = capsys.readouterr().out
    assert "boot_stiffness     100000 to 1e+13 N/m" in text
    assert "fastener_spacing   0.1 to 2 m" in text


def run(arguments, folder, **more):
    """Start the command in a process of its own, away from the project's folder."""
    return subprocess.Popen(
        [sys.executable, "-m", "dashboard", *arguments],
        cwd=folder,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
        text=True,
        **more,
    )


def test_the_command_runs_as_a_process_and_lets_go_of_a_closed_pipe(tmp_path):
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
    process = run(["solve", "slab-track", "--fidelity", "exact"], tmp_path, **pipes)
    output, errors = process.communicate(timeout=WAIT)
    assert (process.returncode, errors) == (0, "")
    assert "loaded track" in output
    process = run(["solve", "slab-track", "--fidelity", "exact"], tmp_path, **pipes)
    process.stdout.close()
    assert process.stderr.read() == ""
    assert process.wait(WAIT) == 0
    process.stderr.close()


def test_verdicts_that_nobody_reads_do_not_pass_for_compliance(tmp_path, save):
    process = run(
        ["check", save(specification=FLOOR), "--fidelity", "exact"], tmp_path, stdout=subprocess.PIPE
    )
    process.stdout.close()
    assert process.wait(WAIT) == 141


@pytest.mark.parametrize(
    "crash",
    [
        "import sys; sys.modules['numba'] = None",  # an installation that lacks a part
        "import trackig_core as tig; tig.solve = lambda *_, **__: 1 / 0",
    ],
)
def test_a_crash_does_not_pass_for_a_verdict(crash, save):
    script = f"{crash}\nimport sys\nfrom dashboard.__main__ import main\nsys.exit(main(sys.argv[1:]))"
    done = subprocess.run(
        [sys.executable, "-c", script, "check", save(specification=FLOOR)],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 70
    assert "Traceback" in done.stderr
    assert "an error of trackig or its installation" in done.stderr


def test_serve_shows_the_dashboard_from_anywhere(tmp_path):
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    log = tmp_path / "log.txt"
    with log.open("w") as output:
        server = run(["serve", "--port", str(port)], tmp_path, stdout=output, stderr=subprocess.STDOUT)
    try:
        page, deadline = "", time.monotonic() + WAIT
        while not page and server.poll() is None and time.monotonic() < deadline:
            with (
                contextlib.suppress(urllib.error.URLError, ConnectionError),
                urllib.request.urlopen(f"http://localhost:{port}/dashboard", timeout=WAIT) as answer,
            ):
                page = answer.read().decode()
            time.sleep(0.1)
    finally:
        server.terminate()
        server.wait(WAIT)
    assert "<title>trackig</title>" in page, log.read_text()
    assert "could not start" not in page
    assert f"http://localhost:{port}/dashboard" in log.read_text()
    assert "Traceback" not in log.read_text()
