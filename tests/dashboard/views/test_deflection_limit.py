"""The limit of rail deflection on the page: typed, shown for each design, part of the verdict."""

import datetime

import pytest

import trackig_core as tig
from dashboard.figures.insertion_gain import InsertionGainFigure
from dashboard.report.data_sheet import data_sheet
from dashboard.report.html_report import html_report
from dashboard.report.pictures import picture
from dashboard.session.heading import Heading
from dashboard.views.deflection_limit import NOT_LIMITED, DeflectionLimit, deflections_html
from dashboard.views.specification import SpecificationView

DAY = datetime.date(2026, 3, 5)
BANDS = tig.Specification([(63, 20.0)])


@pytest.fixture
def limit(session):
    session.show("booted-block-low-mass")
    session.assessment.specification = BANDS
    return DeflectionLimit(session.assessment)


def test_a_limit_that_is_typed_becomes_part_of_specification_and_verdict(session, limit):
    limit.boxes["rail_deflection_limit"].value = "1,3 mm"
    specification = session.assessment.specification
    assert specification.rail_deflection_limit == pytest.approx(1.3e-3)
    assert specification.points == BANDS.points
    sinks = tig.static_response(session.assessment.current.design, 85e3).rail_deflection
    margin = session.assessment.current.verdict.deflection_margin
    assert margin == pytest.approx(1.3e-3 - sinks)
    assert f"at least {1e3 * sinks:.2f} mm" in limit.table.object
    limit.boxes["wheel_load"].value = "112.5"
    assert session.assessment.specification.wheel_load == 112.5e3
    assert session.assessment.current.verdict.sinks_too_far
    assert "✗" in limit.table.object


def test_an_empty_box_takes_the_limit_away(session, limit):
    limit.boxes["rail_deflection_limit"].value = "2"
    limit.boxes["rail_deflection_limit"].value = " "
    assert session.assessment.specification == BANDS
    assert limit.boxes["wheel_load"].disabled


@pytest.mark.parametrize("text", ["nonsense", "0", "-1", "1e9", "3 kN"])
def test_what_cannot_be_a_limit_is_said_and_changes_nothing(session, limit, text):
    limit.boxes["rail_deflection_limit"].value = text
    assert session.assessment.specification == BANDS
    assert "Not taken" in limit.message.object


def test_without_bands_there_is_nothing_to_limit():
    assert deflections_html((), None) == f"<p>{NOT_LIMITED}</p>"


class FakeExchange:
    def on_file(self, purpose, callback):
        """Take no file."""


def test_bands_that_are_typed_or_pasted_leave_the_limit(session):
    session.show("slab-track")
    view = SpecificationView(session.assessment, FakeExchange())
    session.assessment.specification = tig.Specification([(63, 5.0)], "Mine", 2.5e-3, 112.5e3)
    view.editor.grid.handle_message({"kind": "typed", "band": 3, "text": "-6"})
    assert session.assessment.specification.rail_deflection_limit == 2.5e-3
    view.editor.take("63;-3")
    assert session.assessment.specification.points == ((63.0, -3.0),)
    assert session.assessment.specification.wheel_load == 112.5e3


def test_a_limit_of_deflection_may_stand_alone(session):
    """Verdict, study, report, CSV of bands and picture, without any band."""
    session.show("slab-track")
    limit = DeflectionLimit(session.assessment)
    limit.boxes["rail_deflection_limit"].value = "0.03"
    specification = session.assessment.specification
    assert (specification.points, specification.rail_deflection_limit) == ((), pytest.approx(3e-5))
    verdict = session.assessment.current.verdict
    assert not verdict.complies
    assert str(verdict).startswith("fails; rail deflection")
    assert "✗" in limit.table.object
    assert not specification.is_probably_loss
    study = session.snapshot.study()
    assert tig.Study.from_toml(study.to_toml()).specification == specification
    result = session.assessment.current
    report = html_report(study, {result.design: result.summary}, date=DAY, version="1")
    assert "fails; rail deflection" in report
    heading = Heading.of(study, [result], DAY)
    assert "fails; rail deflection" in data_sheet(result, heading, specification)
    assert picture("gain", "png", [result], heading, specification=specification)
    InsertionGainFigure().show(result, limit=specification.levels)
    view = SpecificationView(session.assessment, FakeExchange())
    view.editor._take_typed(20, "3")
    assert session.assessment.specification.points == ((500.0, 3.0),)
    view.editor._take_typed(20, "")
    assert session.assessment.specification == specification
    limit.boxes["rail_deflection_limit"].value = ""
    assert session.assessment.specification is None
