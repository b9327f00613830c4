"""The limit of rail deflection on the page: typed, shown for each design, part of the verdict."""

import pytest

import trackig_core as tig
from dashboard.views.deflection_limit import NO_BANDS, DeflectionLimit, deflections_html
from dashboard.views.specification import SpecificationView

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
    assert deflections_html((), None) == f"<p>{NO_BANDS}</p>"


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
