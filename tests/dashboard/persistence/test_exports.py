"""CSV files: figures that mean something, under comments on what they are; no formulas for spreadsheets."""

import csv
import dataclasses
import datetime
import io

import numpy as np
import pandas as pd
import pytest

import trackig_core as tig
from dashboard.persistence.exports import file_name, force_csv, gain_csv
from dashboard.session.heading import Heading

DAY = datetime.date(2026, 3, 5)


def heading(session):
    return Heading.of(session.snapshot.study(), session.assessment.shown, DAY)


def table(text):
    """Return comments, header and rows."""
    lines = text.splitlines()
    comments = [line for line in lines if line.startswith("# ")]
    assert lines[: len(comments)] == comments
    header, *rows = csv.reader(io.StringIO("\n".join(lines[len(comments) :])))
    return comments, header, rows


def test_gain_of_every_design_stands_beside_its_band(session):
    session.show("booted-sleeper")
    session.pin("slab-track", "=SUM(A1)")
    _, header, rows = table(gain_csv(session.assessment.shown, heading(session)))
    assert header == ["frequency_hz", "insertion_gain_db This design", "insertion_gain_db =SUM(A1)"]
    assert [row[0] for row in rows] == list(tig.BAND_LABELS)
    for column, preset in ((1, "booted-sleeper"), (2, "slab-track")):
        gain = [row[column] for row in rows]
        assert gain == [f"{level:.4f}" for level in tig.solve(tig.PRESETS[preset]).insertion_gain]


def test_comments_say_what_the_figures_are(session):
    session.show("booted-sleeper")
    session.assessment.title = "Tunnel 7"
    session.definition.param.update(summation="coherent", reference="rigid")
    comments, _, _ = table(gain_csv(session.assessment.shown, heading(session)))
    assert comments == [
        "# study: Tunnel 7",
        "# design: Booted sleeper",
        "# insertion gain: forces of the supports summed; relative to the exact rigid track",
        "# solution: time stepping at the paper's resolution",
        "# date: 2026-03-05",
        f"# trackig {tig.__version__}",
        "# rail deflection at least 1.34 mm, seat load 34.8 kN under one wheel of 85 kN: This design",
    ]


@pytest.mark.parametrize("write", [gain_csv, force_csv])
def test_a_reader_that_skips_comments_finds_the_table(session, write):
    session.show("booted-block-low-mass")
    session.pin("slab-track", "Track #1")
    frame = pd.read_csv(io.StringIO(write(session.assessment.shown, heading(session))), comment="#")
    assert frame.columns[-1].endswith("Track #1")
    assert frame.notna().to_numpy().all()


def test_time_is_held_once_and_forces_have_five_figures(session, summary):
    session.show("booted-block-low-mass")
    session.pin("slab-track", "Slab")
    comments, header, rows = table(force_csv(session.assessment.shown, heading(session)))
    assert header == [
        "time_s",
        *(
            f"{force} {name}"
            for name in ("This design", "Slab")
            for force in ("total_force_kN", "loaded_support_force_kN")
        ),
    ]
    assert not [line for line in comments if "interpolated" in line]
    columns = np.array(rows, dtype=float).T
    for first, preset in ((1, "booted-block-low-mass"), (3, "slab-track")):
        shown = summary(preset)
        np.testing.assert_allclose(columns[0], shown.time, rtol=1e-8)
        np.testing.assert_allclose(columns[first], shown.total_force, rtol=5.1e-5)
        np.testing.assert_allclose(columns[first + 1], shown.loaded_support_force, rtol=5.1e-5)
    assert max(len(cell.lstrip("-0.").split("e")[0].replace(".", "")) for cell in rows[100][1:]) <= 5


def test_a_run_at_other_times_is_interpolated_and_the_file_says_so(session, summary):
    session.show("booted-block-low-mass")
    pin = session.pin("slab-track", "Slab")
    slab = summary("slab-track")
    later = dataclasses.replace(
        slab,
        time=slab.time[:4000] + 1e-4,
        total_force=np.sin(400 * (slab.time[:4000] + 1e-4)),
        loaded_support_force=slab.loaded_support_force[:4000],
    )
    session.pinned.summaries = {pin.key: later}
    comments, _, rows = table(force_csv(session.assessment.shown, heading(session)))
    assert "# interpolated to the times of the longest record: Slab" in comments
    inside = [row for row in rows if row[3]]
    assert 3990 < len(inside) < len(rows)
    found = np.array([[row[0], row[3]] for row in inside], dtype=float)
    np.testing.assert_allclose(found[:, 1], np.sin(400 * found[:, 0]), atol=1e-4)
    assert rows[0][3] == rows[-1][3] == ""


def test_without_a_run_in_time_there_are_no_forces(session):
    session.show("booted-block-low-mass")
    still = dataclasses.replace(session.outcome.summary, time=None)
    session.outcome.summary = still
    _, header, rows = table(force_csv(session.assessment.shown, heading(session)))
    assert (header, rows) == (["time_s"], [])


def test_file_names_are_plain():
    assert file_name("Study", ".toml") == "trackig-study.toml"
    assert file_name("Tunnel 7", "Booted block, low mass", "gain.png") == (
        "trackig-tunnel-7-booted-block-low-mass-gain.png"
    )
    assert file_name("../../<b>Tunnel 7</b>\\", "gain.csv") == "trackig-b-tunnel-7-b-gain.csv"
    assert file_name("地下", "report.html") == "trackig-report.html"
