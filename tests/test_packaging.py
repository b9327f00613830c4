"""What a wheel holds: every package, and every asset that the dashboard reads."""

import shutil
import subprocess
import sys
import tomllib
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent

SOURCES = ("pyproject.toml", "README.md", "LICENSE", "trackig_core", "dashboard", "assets")

BUILD = "import setuptools.build_meta as backend, sys; backend.build_wheel(sys.argv[1])"

READ = """
import sys
sys.path.insert(0, sys.argv[1])
from dashboard import assets
assert str(assets.FOLDER).startswith(sys.argv[1]), assets.FOLDER
sys.stdout.reconfigure(encoding="utf-8")
assert assets.read_text(assets.METHOD)
assert sorted(assets.LESSONS.glob("*.md"))
print(assets.read_text("track.svg"), end="")
"""


@pytest.fixture(scope="module")
def wheel(tmp_path_factory):
    """Build a wheel from a copy of the sources, without the network."""
    copy, built = tmp_path_factory.mktemp("sources"), tmp_path_factory.mktemp("wheel")
    for name in SOURCES:
        if (ROOT / name).is_dir():
            shutil.copytree(ROOT / name, copy / name, ignore=shutil.ignore_patterns("__pycache__"))
        else:
            shutil.copy(ROOT / name, copy)
    run = subprocess.run(
        [sys.executable, "-c", BUILD, str(built)], cwd=copy, capture_output=True, text=True, check=False
    )
    assert run.returncode == 0, run.stdout + run.stderr
    return next(built.glob("*.whl"))


def test_every_package_is_listed():
    listed = tomllib.loads((ROOT / "pyproject.toml").read_text())["tool"]["setuptools"]["packages"]
    present = {
        ".".join(init.parent.relative_to(ROOT).parts)
        for package in ("trackig_core", "dashboard")
        for init in (ROOT / package).rglob("__init__.py")
    }
    assert {*listed} == present | {"trackig_assets"}


def test_a_wheel_holds_all_code_and_all_texts(wheel):
    held = {name for name in zipfile.ZipFile(wheel).namelist() if ".dist-info/" not in name}
    code = {
        file.relative_to(ROOT).as_posix()
        for package in ("trackig_core", "dashboard")
        for file in (ROOT / package).rglob("*")
        if file.suffix in (".py", ".csv", ".html", ".js", ".toml") or file.name == "py.typed"
    }
    texts = {
        "trackig_assets/" + file.relative_to(ROOT / "assets").as_posix()
        for file in (ROOT / "assets").rglob("*")
        if file.suffix in (".svg", ".md", ".ipynb")
    }
    assert texts
    assert held == code | texts


def test_an_installed_wheel_finds_its_assets(wheel, tmp_path):
    installed, elsewhere = tmp_path / "installed", tmp_path / "elsewhere"
    elsewhere.mkdir()
    zipfile.ZipFile(wheel).extractall(installed)
    run = subprocess.run(
        [sys.executable, "-c", READ, str(installed)], cwd=elsewhere, capture_output=True, check=False
    )
    assert run.returncode == 0, run.stderr.decode()
    assert run.stdout == (ROOT / "assets" / "track.svg").read_bytes()
