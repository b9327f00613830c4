"""Insertion gain from elsewhere on the page: taken, named, drawn as points, compared, kept, undone."""

import numpy as np
import pytest

import trackig_core as tig
from dashboard.figures.insertion_gain import InsertionGainFigure
from dashboard.views.comparison_table import table_html
from dashboard.views.measured_gains import MANY, MeasuredGains

TABLE = "Hz\tinsertion gain, dB\n31.5\t-6\n63\t-12.5\n"


@pytest.fixture
def view(session):
    session.show("booted-block-low-mass")
    return MeasuredGains(session.assessment)


def test_a_pasted_table_becomes_a_named_curve_and_no_specification(session, view):
    view.name_box.value = "Site A"
    view.pasted.value = TABLE
    view._take_area()
    assert session.assessment.measured == (tig.levels.MeasuredGain([(31.5, -6), (63, -12.5)], "Site A"),)
    assert session.assessment.specification is None
    assert session.assessment.current.verdict is None
    assert (view.name_box.value, view.pasted.value) == ("", "")
    assert "Taken: 2 bands, 31.5 to 63 Hz." in view.message.object


def test_names_are_made_to_differ_and_four_are_enough(session, view):
    for _ in range(4):
        assert view.take(TABLE)
    assert [each.name for each in session.assessment.measured] == [
        "Measured", "Measured 2", "Measured 3", "Measured 4",
    ]  # fmt: skip
    assert not view.take(TABLE)
    assert MANY in view.message.object
    view.remove(session.assessment.measured[1])
    assert [each.name for each in session.assessment.measured] == ["Measured", "Measured 3", "Measured 4"]


@pytest.mark.parametrize("data", ["", "nonsense", b"\xff\xfe", "31.5;<b>"])
def test_what_is_no_table_is_refused_and_said(session, view, data):
    assert not view.take(data)
    assert session.assessment.measured == ()
    assert "Not taken" in view.message.object
    assert "<b>" not in view.message.object


def test_it_is_kept_in_the_study_and_undone(session, view):
    view.take(TABLE)
    kept = session.assessment.measured
    text = session.snapshot.study().to_toml()
    session.snapshot.steps.undo()
    assert session.assessment.measured == ()
    session.snapshot.steps.redo()
    assert session.assessment.measured == kept
    session.assessment.measured = ()
    session.snapshot.open(text)
    assert session.assessment.measured == kept


def test_points_are_drawn_and_listed_as_measured(session, view):
    view.take(TABLE)
    figure = InsertionGainFigure()
    figure.show(session.assessment.current, measured=session.assessment.measured)
    drawn = figure.measured.data["curve_0"]
    assert list(np.flatnonzero(np.isfinite(drawn))) == [8, 11]
    assert figure.legend.listed[-1] == "measured: Measured"
    figure.show(session.assessment.current)
    assert not np.isfinite(figure.measured.data["curve_0"]).any()
    assert figure.legend.listed[-1] != "measured: Measured"


def test_the_table_lists_computed_less_measured(session, view):
    view.take(TABLE)
    current = session.assessment.current
    text = table_html([current], current, [8, 9], session.assessment.measured)
    below = text.split("Computed less measured: Measured, dB")[1]
    assert f"{current.levels[8] + 6:+.1f}".replace("-", "−") in below
    assert below.count("Hz") == 1
    differences = np.array([current.levels[8] + 6, current.levels[11] + 12.5])
    assert f"{np.sqrt(np.mean(differences**2)):.1f}" in below
