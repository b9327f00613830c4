"""A solution: its gain by every definition, as a table, as a picture, and at a glance."""

import dataclasses
import pickle
import subprocess
import sys

import matplotlib
import numpy as np
import pytest

import trackig_core as tig
from trackig_core import solution as module

matplotlib.use("agg")

BLOCK = tig.PRESETS["booted-block-low-mass"]


@pytest.fixture
def solution():
    return tig.solve(BLOCK, "live")


@pytest.mark.parametrize("reference", ["line", "rigid"])
@pytest.mark.parametrize("summation", ["energy", "coherent"])
def test_gain_by_any_definition_is_that_of_a_solve_by_it(solution, reference, summation):
    gain = solution.gain_for(reference, summation)
    assert (gain.reference, gain.summation) == (reference, summation)
    expected = tig.solve(BLOCK, "live", reference=reference, summation=summation)
    assert (gain.levels == expected.insertion_gain).all()


def test_each_definition_is_computed_once(solution, monkeypatch):
    calls = []

    def counted(*arguments, compute=module.insertion_gain):
        calls.append(arguments)
        return compute(*arguments)

    monkeypatch.setattr(module, "insertion_gain", counted)
    assert solution.gain_for() is solution.gain
    assert solution.gain_for("rigid") is solution.gain_for("rigid")
    assert len(calls) == 1


def test_an_unknown_definition_is_refused(solution):
    with pytest.raises(ValueError, match="reference = 'stif': give 'line' or 'rigid'"):
        solution.gain_for("stif")


def test_copies_compute_gains_of_their_own(solution):
    solution.gain_for("rigid")
    light = dataclasses.replace(solution, history=None)
    assert light.history is None
    assert light.gain_for() is solution.gain
    changed = dataclasses.replace(solution, design=BLOCK.replace(wheel_mass=440.0))
    difference = changed.gain_for("rigid").levels - solution.gain_for("rigid").levels
    assert difference == pytest.approx(20 * np.log10(2.0))


def test_pickling_keeps_everything(solution):
    copy = pickle.loads(pickle.dumps(solution))
    assert copy.design == BLOCK
    assert (copy.insertion_gain == solution.insertion_gain).all()
    assert (copy.gain_for("rigid").levels == solution.gain_for("rigid").levels).all()


def test_the_table_has_a_row_per_band(solution):
    table = solution.to_dataframe()
    assert tuple(table.index) == tig.BAND_LABELS
    assert table.index.name == "band_hz"
    assert (table["insertion_gain_db"] == solution.insertion_gain).all()
    assert (table["centre_hz"] == tig.BAND_CENTRES).all()
    ratio = table["band_energy_n2s"] / table["reference_energy_n2s"]
    assert 10 * np.log10(ratio.to_numpy()) == pytest.approx(solution.insertion_gain)


def test_the_picture_shows_the_gain_and_says_what_it_is(solution):
    ax = solution.plot()
    assert (ax.lines[0].get_ydata() == solution.insertion_gain).all()
    assert [label.get_text() for label in ax.get_xticklabels()] == list(tig.BAND_LABELS)
    assert ax.get_xlabel() == "One-third-octave band [Hz]"
    assert ax.get_ylabel() == "Insertion gain re straight reference line [dB]"
    assert "squared support forces summed" in ax.get_title()
    other = dataclasses.replace(solution, gain=solution.gain_for("rigid", "coherent"))
    assert other.plot(ax) is ax
    assert len(ax.lines) == 2
    matplotlib.pyplot.close(ax.figure)


def test_at_a_glance(solution):
    shown = repr(solution)
    assert "\n" not in shown
    assert len(shown) < 200
    frequencies = solution.natural_frequencies
    for part in (
        "live",
        f"{frequencies.loaded_track:.1f} Hz",
        f"{frequencies.coupled_block:.1f} Hz",
        f"{solution.insertion_gain.max():.1f} dB",
        f"{solution.insertion_gain.min():.1f} dB",
    ):
        assert part in shown
        assert part in solution._repr_html_()


def test_the_table_of_a_notebook_is_escaped(solution):
    hostile = dataclasses.replace(solution, notes=("<script>alert(1)</script>",), fidelity="<b>")
    shown = hostile._repr_html_()
    assert "<script>" not in shown
    assert "<b>" not in shown
    assert "&lt;script&gt;" in shown


def test_importing_loads_neither_pandas_nor_matplotlib():
    code = "import sys, trackig_core; print(sorted({'pandas', 'matplotlib'} & sys.modules.keys()))"
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout.strip() == "[]"
