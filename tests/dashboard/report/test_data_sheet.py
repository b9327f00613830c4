"""The data sheet: all of one design, as text, on what prints as one page (which a browser's test counts)."""

import datetime
import html

import pytest

import trackig_core as tig
from dashboard import formats
from dashboard.report.data_sheet import data_sheet
from dashboard.session.heading import Heading
from dashboard.session.results import SolutionSummary

DAY = datetime.date(2026, 3, 5)
HOSTILE = "<script>alert(1)</script>"
LIMIT = tig.Specification([(63, 0.0), (80, -30.0)], name=f"Limit {HOSTILE}")
SOURCE = tig.SourceSpectrum([(63, 60.0)], name="Source & so on")


@pytest.fixture
def sheet(session):
    session.show("booted-block-low-mass")
    session.assessment.param.update(specification=LIMIT, source=SOURCE, title=HOSTILE)
    result = session.assessment.current
    return result, data_sheet(result, Heading.of(session.snapshot.study(), [result], DAY), LIMIT, SOURCE)


def test_everything_of_the_design_is_on_it(sheet):
    result, text = sheet
    natural = result.summary.solution.natural_frequencies
    for words in (
        "<h1>Booted block, low mass</h1>",
        html.escape(LIMIT.name),
        str(result.verdict),
        "5 March 2026",
        f"trackig {tig.__version__}",
        formats.definition_text("energy", "line").capitalize().replace("'", "&#39;"),
        formats.frequency_text(natural.loaded_track).removesuffix(" Hz"),
        formats.frequency_text(natural.coupled_block).removesuffix(" Hz"),
        "Source: Source &amp; so on.",
        f"{result.level.unweighted:.1f} dB, {result.level.a_weighted:.1f} dB(A)",
        "<td>28</td>",
        "<svg",
    ):
        assert words in text, words
    assert HOSTILE not in text
    for level in result.levels:
        assert f">{formats.signed_text(level)}</td>" in text


def test_a_question_that_is_open_stands_in_the_place_of_the_verdict(session):
    session.show("booted-block-low-mass")
    asked = tig.Specification.given([(63, 10.0)], "Client", set_aside=("630 Hz",))
    session.assessment.specification = asked
    result = session.assessment.current
    heading = Heading.of(session.snapshot.study(), [result], DAY)
    text = data_sheet(result, heading, asked)
    assert "no verdict yet.</strong> To be answered first: no limit is below 0 dB" in text
    assert "stepped line" not in text
    session.assessment.specification = asked.kept()
    result = session.assessment.current
    text = data_sheet(result, heading, asked.kept())
    assert "complies in 1 of 2 limits" in text
    assert "1 not judged, of no band from 5 to 500 Hz: 630 Hz" in text


def test_bands_that_fail_are_marked(sheet):
    result, text = sheet
    assert text.count('<td class="fails">') == 2 * int(result.verdict.fails.sum()) > 0


@pytest.mark.parametrize(
    ("bands", "specification", "says"),
    [
        ("one-third-octave", LIMIT, "crosses mark levels above it."),
        ("octave", LIMIT, "allowed in one-third octaves from 5 to 500 Hz, in which the design is judged."),
        ("wide one-third-octave", LIMIT, "allowed in one-third octaves from 5 to 500 Hz"),
        ("one-third-octave", tig.Specification((), rail_deflection_limit=2.5e-3), ""),
    ],
)
def test_crosses_are_named_where_they_are_drawn_and_a_line_where_there_is_one(
    session, bands, specification, says
):
    session.show("booted-block-low-mass")
    session.assessment.specification = specification
    session.definition.bands = bands
    result = session.assessment.current
    heading = Heading.of(session.snapshot.study(), [result], DAY)
    text = data_sheet(result, heading, specification)
    assert says in text
    assert ("crosses mark" in text) == (specification is LIMIT and bands == "one-third-octave")
    assert ("stepped line" in text) == bool(says)


def test_what_a_single_stage_track_lacks_is_left_out(session):
    session.show("slab-track")
    result = session.assessment.current
    text = data_sheet(result, Heading.of(session.snapshot.study(), [result], DAY))
    for absent in ("Boot stiffness", "Coupled block", "Level with the track", "Limit", "–"):
        assert absent not in text


def test_hatched_bands_are_named(session, measured_result):
    heading = Heading.of(session.snapshot.study(), [measured_result], DAY)
    text = data_sheet(measured_result, heading)
    assert f"Hatched bands lie beyond what was measured of {heading.design}." in text
    assert "<pattern " in text


def test_how_a_design_was_solved_is_said_of_one_beyond_the_paper(session):
    design = tig.PRESETS["booted-block-low-mass"].replace(ground=tig.GROUNDS["soft clay"])
    session.show("booted-block-low-mass")
    session.outcome.summary = SolutionSummary.of(tig.solve(design, "exact"), 1.0)
    result = session.assessment.current
    text = data_sheet(result, Heading.of(session.snapshot.study(), [result], DAY))
    assert "Solved by frequency-domain solution." in text
