"""Bands that are chosen: what is shown and written follows them, what is judged stays in the paper's."""

import csv
import datetime
import io
import json

import numpy as np
import pytest

import trackig_core as tig
from dashboard.cli import main
from dashboard.figures.insertion_gain import InsertionGainFigure
from dashboard.persistence.exports import gain_csv
from dashboard.report.data_sheet import data_sheet
from dashboard.report.html_report import html_report
from dashboard.report.pictures import picture
from dashboard.session.bands import CHOICES, WIDE, bands_text
from dashboard.session.heading import Heading
from trackig_core.bands import BANDS

DAY = datetime.date(2026, 3, 5)
BLOCK = tig.PRESETS["booted-block-low-mass"]
LIMIT = tig.Specification([(63, 0.0)])
MEASURED = tig.levels.MeasuredGain([(63, -7.25), (80, -9.0)], name="On site & so on")
OTHER = [name for name in CHOICES.values() if name != "one-third-octave"]


@pytest.fixture
def solved(session):
    session.show("booted-block-low-mass")
    session.pin("slab-track", "Slab")
    return session


def heading(session):
    return Heading.of(session.snapshot.study(), session.assessment.shown, DAY)


def columns(text):
    lines = [line for line in text.splitlines() if not line.startswith("# ")]
    header, *rows = csv.reader(io.StringIO("\n".join(lines)))
    return dict(zip(header, zip(*rows, strict=True), strict=True))


def expected(name, design, summary):
    """Return levels in bands, of the run where its record covers them, else of the exact solution."""
    if name in WIDE:
        return tig.solve(design, "exact", bands=name).insertion_gain
    return summary.solution.gain_for(bands=name).levels


def test_every_choice_of_the_core_is_offered():
    assert set(CHOICES.values()) == set(BANDS)


@pytest.mark.parametrize("name", OTHER)
def test_figure_and_csv_follow_the_choice(solved, name):
    figure = InsertionGainFigure()
    solved.definition.bands = name
    current, slab = solved.assessment.results
    figure.show(current, (slab,), limit=LIMIT.levels)
    levels = expected(name, BLOCK, current.summary)
    np.testing.assert_allclose(figure.bands.data["level"], levels)
    np.testing.assert_allclose(
        figure.pins.data["pin_0"], expected(name, tig.PRESETS["slab-track"], slab.summary)
    )
    edges = BANDS[name].edges
    assert (figure.model.x_range.start, figure.model.x_range.end) == pytest.approx((edges[0], edges[-1]))
    assert figure.model.xaxis[0].ticker.ticks == list(BANDS[name].centres)
    assert figure.model.xaxis[0].axis_label.startswith(BANDS[name].words)
    text = gain_csv(solved.assessment.shown, heading(solved))
    table = columns(text)
    assert table["frequency_hz"] == BANDS[name].labels
    np.testing.assert_allclose(np.array(table["insertion_gain_db This design"], float), levels, atol=6e-5)
    assert f"# bands: {bands_text(name)}" in text
    assert ("read the outer bands with care" in text) == (name in WIDE)


def test_the_figure_comes_back_to_the_papers_bands(solved):
    figure = InsertionGainFigure()
    for name in ("wide octave", "one-third-octave"):
        solved.definition.bands = name
        figure.show(solved.assessment.current, solved.assessment.shown_pins)
    assert tuple(figure.bands.data["label"]) == tuple(figure.pins.data["label"]) == tig.BAND_LABELS
    assert figure.model.x_range.end == pytest.approx(tig.BAND_EDGES[-1])


def test_verdict_and_level_do_not_depend_on_what_is_shown(solved):
    solved.assessment.param.update(specification=LIMIT, source=tig.SourceSpectrum([(63, 60.0)]))
    before = solved.assessment.current
    solved.definition.bands = "wide octave"
    after = solved.assessment.current
    np.testing.assert_array_equal(after.verdict.margins, before.verdict.margins)
    assert after.level.unweighted == before.level.unweighted


def test_a_choice_goes_with_link_and_study_and_is_undone(solved):
    assert "bands" not in solved.snapshot.query()
    assert "bands" not in solved.snapshot.study().to_toml()
    solved.snapshot.steps.restart()
    solved.definition.bands = "wide octave"
    assert "bands=wide+octave" in solved.snapshot.query()
    text = solved.snapshot.study().to_toml()
    assert tig.Study.from_toml(text).view.bands == "wide octave"
    solved.snapshot.steps.undo()
    assert solved.definition.bands == "one-third-octave"
    solved.snapshot.open(text)
    assert solved.definition.bands == "wide octave"
    with pytest.raises(tig.StudyError, match=r"view\.bands"):
        tig.Study.from_toml(text.replace("wide octave", "wide"))


@pytest.mark.parametrize("name", ["one-third-octave", *OTHER])
def test_report_and_data_sheet_hold_the_bands_and_measured_curves(solved, name):
    solved.definition.bands = name
    solved.assessment.param.update(specification=LIMIT, measured=(MEASURED,))
    study, current = solved.snapshot.study(), solved.assessment.current
    report = html_report(
        study, {each.design: each.summary for each in solved.assessment.results}, date=DAY, version="1"
    )
    sheet = data_sheet(current, heading(solved), LIMIT, measured=(MEASURED,))
    has_measured = BANDS[name].tenths == 1
    for text in (report, sheet):
        assert "On site &amp; so on" in text
        assert ("−7.2" in text) == has_measured
        assert bands_text(name) in text
        assert all(f">{label}<" in text for label in BANDS[name].labels)
    assert picture("gain", "png", [current], heading(solved), specification=LIMIT, measured=(MEASURED,))


def test_measured_curves_stand_in_the_csv_in_rows_of_their_own_bands(solved):
    def written():
        return gain_csv(solved.assessment.shown, heading(solved), (MEASURED,))

    solved.definition.bands = "wide one-third-octave"
    table = columns(written())
    found = dict(zip(table["frequency_hz"], table["measured_insertion_gain_db On site & so on"], strict=True))
    assert {band: level for band, level in found.items() if level} == {"63": "-7.2500", "80": "-9.0000"}
    solved.definition.bands = "octave"
    assert not any(name.startswith("measured") for name in columns(written()))
    assert "left out beside octaves" in written()


@pytest.mark.parametrize("name", OTHER)
def test_the_command_line_takes_bands_and_a_studys(name, tmp_path, capsys):
    assert main(["solve", "booted-block-low-mass", "--fidelity", "live", "--bands", name, "--json", "-"]) == 0
    found = json.loads(capsys.readouterr().out)
    live = tig.solve(BLOCK, "live")
    levels = (
        tig.solve(BLOCK, "exact", bands=name).insertion_gain
        if name in WIDE
        else live.gain_for(bands=name).levels
    )
    np.testing.assert_allclose(found["insertion_gain_db"], levels)
    assert any("read the outer bands" in note for note in found["notes"]) == (name in WIDE)
    study = tmp_path / "study.toml"
    study.write_text(tig.Study(BLOCK, view=tig.View(bands=name)).to_toml(), encoding="utf-8")
    assert main(["solve", str(study), "--fidelity", "live", "--json", "-"]) == 0
    np.testing.assert_allclose(json.loads(capsys.readouterr().out)["insertion_gain_db"], levels)
