"""The README keeps its word: its Python runs, and its command lines are ones that the program takes."""

import re
import shlex
import textwrap
from pathlib import Path

import matplotlib as mpl
import pytest

from dashboard.cli import main
from trackig_core import PRESETS, Specification, Study

README = (Path(__file__).parent.parent / "README.md").read_text(encoding="utf-8")

BLOCKS = [
    textwrap.dedent(block).strip() for block in re.findall(r"(?:^    .*\n(?:[ ]*\n(?=    ))?)+", README, re.M)
]

PYTHON = [block for block in BLOCKS if "import trackig_core" in block]

COMMANDS = [
    shlex.split(line, comments=True)[1:]
    for block in BLOCKS
    for line in block.splitlines()
    if line.startswith("trackig ")
]


@pytest.fixture(autouse=True)
def _no_windows(monkeypatch):
    monkeypatch.setitem(mpl.rcParams, "backend", "agg")


@pytest.mark.parametrize("code", PYTHON)
def test_python_runs(code, capsys):
    names = {}
    exec(compile(code, "README.md", "exec"), names)
    said = capsys.readouterr().out
    assert said.count(" dB\n") == 21
    assert "dB apart" in said
    # what the lines after the block build on it
    design = names["design"]
    for expression in re.findall(r"`((?:design|tig)\.[^`]*\([^`]*\))`", README):
        if not re.search(r"\((solution|data|design)\)", expression) and "levels" not in expression:
            assert eval(expression, names) is not None
    assert design == PRESETS["booted-block-low-mass"]


def test_there_is_python_and_every_command():
    assert len(PYTHON) == 1
    asked = {"range", "sensitivity", "tolerance", "map", "find"}
    assert {command[0] for command in COMMANDS} == {"solve", "check", "report", "serve"} | asked


@pytest.mark.parametrize("command", COMMANDS, ids=lambda command: command[0])
def test_command_lines_are_taken(command, tmp_path, monkeypatch, capsys):
    """Each runs as it stands; serving, which would not end, is asked for its help."""
    monkeypatch.chdir(tmp_path)
    limits = Specification([(40, 16), (63, -1), (125, -9)])
    study = Study(PRESETS["booted-block-low-mass"], specification=limits, name="README")
    Path("study.toml").write_text(study.to_toml(), encoding="utf-8")
    if command[0] == "serve":
        with pytest.raises(SystemExit) as ended:
            main([*command, "--help"])
        assert ended.value.code == 0
        assert "--show" in capsys.readouterr().out
    else:
        code = main(command)
        said = capsys.readouterr()
        assert code == 0, said.err
        if command[0] != "report":
            assert said.out
