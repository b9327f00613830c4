"""What every change must keep: lint, format, types, and who may import whom."""

import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent

CHECKS = {
    "ruff finds nothing": ["-m", "ruff", "check", "."],
    "ruff would format nothing": ["-m", "ruff", "format", "--check", "."],
    "the core's types agree": ["-m", "mypy", "--no-incremental"],
    "import contracts hold": [
        "-c",
        "from importlinter.cli import lint_imports_command as c; c(['--no-cache'])",
    ],
}


@pytest.mark.slow
@pytest.mark.parametrize("arguments", CHECKS.values(), ids=CHECKS.keys())
def test_conventions(arguments):
    run = subprocess.run([sys.executable, *arguments], cwd=ROOT, capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stdout + run.stderr
