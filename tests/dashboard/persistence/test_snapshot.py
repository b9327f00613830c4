"""A session as link and as study: what is written comes back, and what is at fault changes nothing."""

from urllib.parse import parse_qs

import pytest

import trackig_core as tig

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
    session.presentation.param.update(summation="coherent", reference="rigid")
    session.workshop.param.update(specification=LIMITS, source=SOURCE, title="A workshop")
    session.keeping.tab = "level"
    return session


def state(session):
    pins = [(pin.name, pin.colour, pin.shown, dict(pin.values)) for pin in session.pins.pinned]
    base = session.pins.base and session.pins[session.pins.base].name
    chosen = session.presentation.summation, session.presentation.reference
    return session.inputs.to_values(), pins, base, chosen


def test_a_link_reopens_design_pins_view_and_tab(filled, picture):
    other = type(filled)(picture)
    assert other.keeping.follow(arguments(filled.keeping.query())) == ()
    assert state(other) == state(filled)
    assert other.keeping.tab == "level"
    assert other.keeping.query() == filled.keeping.query()


def test_the_paper_s_figure_2_reopens_alone(session, picture):
    session.pins.show_table_1()
    other = type(session)(picture)
    other.keeping.follow(arguments(session.keeping.query()))
    assert other.pins.alone


def test_a_study_reopens_everything_exactly(filled, picture):
    other = type(filled)(picture)
    other.keeping.open(filled.keeping.study().to_toml().encode())
    assert state(other) == state(filled)
    assert other.workshop.specification == LIMITS
    assert other.workshop.source == SOURCE
    assert other.workshop.title == "A workshop"
    assert other.keeping.study() == filled.keeping.study()


def test_a_study_replaces_what_was_there(filled, picture):
    filled.keeping.open(type(filled)(picture).keeping.study().to_toml())
    assert filled.pins.pinned == ()
    assert filled.workshop.specification is None
    assert filled.workshop.source is None


@pytest.mark.parametrize(
    "spoil",
    [
        lambda _: "",
        lambda text: text.replace("version = 1", "version = 2"),
        lambda text: text.replace("pad_loss_factor", "pad_los_factor"),
        lambda text: text.replace("fastener_spacing_m = 0.75", "fastener_spacing_m = 1.75"),
        lambda text: text + "x" * 300_000,
        lambda text: text.encode("utf-16"),
        lambda _: b"\xff\x00\xfe",
    ],
)
def test_a_study_at_fault_changes_nothing(filled, picture, spoil):
    text = filled.keeping.study().to_toml()
    other = type(filled)(picture)
    before = other.keeping.study()
    with pytest.raises(tig.StudyError):
        other.keeping.open(spoil(text))
    assert other.keeping.study() == before


def test_a_hostile_link_opens_what_it_can_and_tells_the_rest(session):
    hostile = {
        "pad_stiffness": [b"9" * 5000],
        "boot_stiffness": [b"1e999"],
        "tab": [b"<script>alert(1)</script>"],
        "alone": [b"2"],
        "<img src=x onerror=alert(1)>": [b"x"],
        "block_mass": [b"77"],
    }
    problems = session.keeping.follow(hostile)
    assert session.inputs.block_mass == 77
    assert session.inputs.boot_stiffness == 200
    assert session.keeping.tab == "explore"
    assert not session.pins.alone
    assert len(problems) == 5
    assert not any("<" in words for words in problems)


def test_every_change_that_is_kept_is_told(session):
    told = []
    session.keeping.watch(lambda *_: told.append(session.keeping.query()))
    session.inputs.boot_stiffness = 30
    session.presentation.reference = "rigid"
    session.pin("slab-track")
    session.workshop.specification = LIMITS
    session.keeping.tab = "keep"
    assert len(told) >= 5
    assert "boot_stiffness=30" in told[-1]
    assert "tab=keep" in told[-1]
