"""CSV files: every number of the solution, under a header that no spreadsheet takes for a formula."""

import csv
import io

import numpy as np

import trackig_core as tig
from dashboard.persistence.exports import file_name, force_csv, gain_csv


def table(text):
    header, *rows = csv.reader(io.StringIO(text))
    return header, rows


def test_gain_of_every_design_stands_beside_its_band(session):
    session.show("booted-sleeper")
    session.pin("slab-track", "=SUM(A1)")
    header, rows = table(gain_csv(session.assessment.shown))
    assert header == ["frequency_hz", "insertion_gain_db This design", "insertion_gain_db =SUM(A1)"]
    assert [row[0] for row in rows] == list(tig.BAND_LABELS)
    for column, preset in ((1, "booted-sleeper"), (2, "slab-track")):
        gain = [float(row[column]) for row in rows]
        np.testing.assert_array_equal(gain, tig.solve(tig.PRESETS[preset]).insertion_gain)


def test_forces_keep_the_time_of_their_own_run(session, summary):
    session.show("booted-block-low-mass")
    session.pin("slab-track", "Slab")
    header, rows = table(force_csv(session.assessment.shown))
    assert header[3:] == ["time_s Slab", "total_force_kN Slab", "loaded_support_force_kN Slab"]
    for first, preset in ((0, "booted-block-low-mass"), (3, "slab-track")):
        shown = summary(preset)
        columns = np.array([row[first : first + 3] for row in rows if row[first]], dtype=float).T
        for column, curve in zip(
            columns, (shown.time, shown.total_force, shown.loaded_support_force), strict=True
        ):
            np.testing.assert_allclose(column, curve, rtol=1e-6)


def test_file_names_are_plain():
    assert file_name("Study", ".toml") == "trackig-study.toml"
    assert file_name("../../<b>Tunnel 7</b>\\", "gain.csv") == "trackig-b-tunnel-7-b-gain.csv"
    assert file_name("地下", "report.html") == "trackig-report.html"
