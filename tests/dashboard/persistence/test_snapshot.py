"""A session as link and as study: what is written comes back, and what is at fault changes nothing."""

from urllib.parse import parse_qs

import pytest

import trackig_core as tig
from dashboard.persistence.link import MOST_PROBLEMS

LIMITS = tig.Specification([(63, -3.0), (125, -5.0)], "Tunnel")
SOURCE = tig.SourceSpectrum([(31.5, 60.0)])


def arguments(query):
    """Return a query as the server hands it on."""
    return {key: [each.encode() for each in values] for key, values in parse_qs(query).items()}


@pytest.fixture
def filled(session):
    """Return a session in which everything differs from how a session opens."""
    session.show("booted-sleeper")
    session.inputs.boot_stiffness = 33.25
    session.pin("slab-track", "Slab & <b>co</b>")
    second = session.pin("booted-block-high-mass", "Heavy")
    session.pins.choose_base(second.key)
    session.definition.param.update(summation="coherent", reference="rigid")
    session.assessment.param.update(specification=LIMITS, source=SOURCE, title="A workshop")
    session.snapshot.tab = "level"
    return session


def state(session):
    base = session.pins.base and session.pins[session.pins.base].name
    chosen = session.definition.summation, session.definition.reference
    return session.inputs.to_values(), session.pins.pinned, base, chosen


def test_a_link_reopens_design_pins_view_and_tab(filled, summary):
    other = type(filled)(summary)
    assert other.snapshot.follow(arguments(filled.snapshot.query())) == ()
    assert state(other) == state(filled)
    assert other.snapshot.tab == "level"
    assert other.snapshot.query() == filled.snapshot.query()


BESIDE = {
    "specification": (LIMITS, "the specification"),
    "source": (SOURCE, "the source spectrum"),
    "measured": ((tig.MeasuredGain([(63, -3.0)], "Test house"),), "insertion gain from elsewhere"),
    "title": ("Line 4", "the name of the study"),
}


@pytest.mark.parametrize(("name", "value", "words"), [(name, *each) for name, each in BESIDE.items()])
def test_whatever_does_not_come_back_from_a_link_is_said_to_be_left_out(session, summary, name, value, words):
    assert session.snapshot.left_out == ""
    setattr(session.assessment, name, value)
    other = type(session)(summary)
    other.snapshot.follow(arguments(session.snapshot.query()))
    assert getattr(other.assessment, name) != value
    assert session.snapshot.left_out == words
    other.snapshot.open(session.snapshot.study().to_toml())
    assert getattr(other.assessment, name) == value, "as it is said, the study file holds it"


def test_kept_answers_are_said_to_be_left_out_of_a_link(filled):
    filled.snapshot.answers.kept = (object(),)
    assert filled.snapshot.left_out == (
        "the specification, the source spectrum, the kept answers, the name of the study"
    )


def test_a_study_is_undone_in_one_step_and_a_link_is_where_undo_begins(filled, summary):
    other = type(filled)(summary)
    other.snapshot.follow(arguments(filled.snapshot.query()))
    assert not other.snapshot.steps.can_undo
    before = state(other), other.assessment.title
    other.inputs.wheel_mass = 700.0
    mine = filled.snapshot.study().to_toml()
    other.snapshot.open(mine)
    other.snapshot.steps.undo()
    assert other.inputs.wheel_mass == 700.0
    assert other.assessment.specification is None
    other.snapshot.steps.undo()
    assert (state(other), other.assessment.title) == before


def test_the_paper_s_figure_2_reopens_alone(session, summary):
    session.pins.show_table_1()
    other = type(session)(summary)
    other.snapshot.follow(arguments(session.snapshot.query()))
    assert other.pins.alone


def test_a_study_reopens_everything_exactly(filled, summary):
    other = type(filled)(summary)
    other.snapshot.open(filled.snapshot.study().to_toml().encode())
    assert state(other) == state(filled)
    assert other.assessment.specification == LIMITS
    assert other.assessment.source == SOURCE
    assert other.assessment.title == "A workshop"
    assert other.snapshot.study() == filled.snapshot.study()


def test_a_study_replaces_what_was_there(filled, summary):
    filled.snapshot.open(type(filled)(summary).snapshot.study().to_toml())
    assert filled.pins.pinned == ()
    assert filled.assessment.specification is None
    assert filled.assessment.source is None


@pytest.mark.parametrize(
    "spoil",
    [
        lambda _: "",
        lambda text: text.replace("version = 1", "version = 2"),
        lambda text: text.replace("pad_loss_factor", "pad_los_factor"),
        lambda text: text.replace("fastener_spacing_m = 0.75", "fastener_spacing_m = 2.75"),
        lambda text: text + "x" * 300_000,
        lambda text: text.encode("utf-16"),
        lambda _: b"\xff\x00\xfe",
    ],
)
def test_a_study_at_fault_changes_nothing(filled, summary, spoil):
    text = filled.snapshot.study().to_toml()
    other = type(filled)(summary)
    before = other.snapshot.study()
    with pytest.raises(tig.StudyError):
        other.snapshot.open(spoil(text))
    assert other.snapshot.study() == before


def test_a_hostile_link_opens_what_it_can_and_tells_the_rest(session):
    hostile = {
        "pad_stiffness": [b"9" * 5000],
        "boot_stiffness": [b"1e999"],
        "tab": [b"<script>alert(1)</script>"],
        "alone": [b"2"],
        "<img src=x onerror=alert(1)>": [b"x"],
        "block_mass": [b"77"],
    }
    problems = session.snapshot.follow(hostile)
    assert session.inputs.block_mass == 77
    assert session.inputs.boot_stiffness == 28, "a number without bound is none: the preset's stays"
    assert session.snapshot.tab == "explore"
    assert not session.pins.alone
    assert len(problems) == MOST_PROBLEMS + 1
    assert problems[-1] == "And 2 more of the kind."
    assert not any("<" in words for words in problems)


def test_every_change_that_is_kept_is_told(session):
    told = []
    session.snapshot.watch(lambda *_: told.append(session.snapshot.query()))
    session.inputs.boot_stiffness = 30
    session.definition.reference = "rigid"
    session.pin("slab-track")
    session.assessment.specification = LIMITS
    session.snapshot.tab = "keep"
    assert len(told) >= 5
    assert "boot_stiffness=30" in told[-1]
    assert "tab=keep" in told[-1]
