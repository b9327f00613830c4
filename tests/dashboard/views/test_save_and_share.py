"""The tabs Specification, Level and Keep: what is typed, pasted or opened, and what is told."""

import asyncio
import re

import numpy as np
import pytest

import trackig_core as tig
from dashboard import theme
from dashboard.views.received_level import ReceivedLevel
from dashboard.views.save_and_share import SaveAndShare
from dashboard.views.specification import SpecificationView
from dashboard.views.verdict import ShortVerdict

HOSTILE = "<img src=x onerror=alert(1)>"


class FakeExchange:
    """Notes what is saved, and opens files that a test has."""

    def __init__(self):
        self.openers, self.saved = {}, []

    def on_file(self, purpose, callback):
        self.openers[purpose] = callback

    def save(self, name, text, kind="text/csv"):
        self.saved.append((name, text, kind))


@pytest.fixture
def exchange():
    return FakeExchange()


@pytest.fixture
def view(session, exchange):
    session.show("booted-block-low-mass")
    made = SpecificationView(session.assessment, exchange)
    made.look(True)
    return made


@pytest.fixture
def level(session, exchange):
    session.show("booted-block-low-mass")
    made = ReceivedLevel(session.assessment, session.pins, exchange)
    made.look(True)
    return made


def limits(session):
    return dict(session.assessment.specification.points)


def type_in(view, label, text):
    view.editor.grid.handle_message({"kind": "typed", "band": tig.BAND_LABELS.index(label), "text": text})


def test_limits_are_typed_changed_and_taken_out(session, view):
    type_in(view, "63", "-3")
    type_in(view, "80", " −5,5 ")
    assert limits(session) == {63.0: -3.0, 80.0: -5.5}
    assert view.editor.grid.values[tig.BAND_LABELS.index("80")] == "-5.5"
    type_in(view, "63", "-4")
    type_in(view, "80", "")
    assert limits(session) == {63.0: -4.0}
    type_in(view, "63", "  ")
    assert session.assessment.specification is None


@pytest.mark.parametrize("typed", ["abc", "1e3", "101", "nan", "9" * 5000, HOSTILE])
def test_a_limit_at_fault_names_its_band_and_changes_nothing(session, view, typed):
    type_in(view, "63", "-3")
    type_in(view, "80", typed)
    assert limits(session) == {63.0: -3.0}
    assert "Not taken: 80 Hz: " in view.editor.message.object
    assert "give a number from -100 to 100 dB, or nothing" in view.editor.message.object
    assert "<img" not in view.editor.message.object
    type_in(view, "80", "-5")
    assert "Hz" not in view.editor.message.object


@pytest.mark.parametrize(
    ("data", "where"),
    [
        (b"frequency_hz,ig_max_db\n63,-3\n80,high\n", "line 3, column 2"),
        (b"frequency_hz,ig_max_db\n63,-3\n70,-3\n", "line 3, column 1"),
        (f"63,-3\n80,{HOSTILE}\n".encode(), "line 2, column 2"),
        (b"\x89PNG\0", "not a text file"),
        (b"63,-3\n" * 20_000, "larger than 64 kB"),
    ],
)
def test_a_file_at_fault_names_its_place_and_changes_nothing(session, view, exchange, data, where):
    type_in(view, "63", "-3")
    exchange.openers["specification"](data)
    assert limits(session) == {63.0: -3.0}
    assert where in view.editor.message.object
    assert "<img" not in view.editor.message.object


def test_files_tables_and_columns_are_taken(session, view, exchange):
    exchange.openers["specification"]("frequency_hz;ig_max_db\n31,5;2,5\n".encode("utf-16"))
    assert limits(session) == {31.5: 2.5}
    view.editor.pasted.value = "frequency_hz\tig_max_db\n63\t-3\n80\t-4,5"
    view.editor.apply.param.trigger("clicks")
    assert limits(session) == {63.0: -3.0, 80.0: -4.5}
    assert view.editor.pasted.value == ""
    assert "Taken: 2 bands, 63 to 80 Hz." in view.editor.answer.object
    view.editor.pasted.value = "63\t-3\n80\tx"
    view.editor.apply.param.trigger("clicks")
    assert "line 2, column 2" in view.editor.answer.object
    assert "line 2" not in view.editor.message.object
    assert view.editor.pasted.value == "63\t-3\n80\tx"
    place = tig.BAND_LABELS.index("100")
    view.editor.grid.handle_message({"kind": "pasted", "band": place, "text": "-6\n-7\n"})
    assert limits(session) == {63.0: -3.0, 80.0: -4.5, 100.0: -6.0, 125.0: -7.0}
    assert "Taken: 2 numbers, from 100 Hz on." in view.editor.message.object
    view.editor.grid.handle_message({"kind": "pasted", "band": 20, "text": "1\n2\n"})
    assert "1 at most from 500 Hz on" in view.editor.message.object
    view.editor.clear.param.trigger("clicks")
    assert session.assessment.specification is None


@pytest.mark.parametrize("typed", ["-6,5 dB", "\N{EN DASH}6.5", "<= -6,5", "\N{FULLWIDTH HYPHEN-MINUS}6.5"])
def test_a_limit_is_read_as_in_a_table(session, view, typed):
    type_in(view, "63", typed)
    assert limits(session) == {63.0: -6.5}


def test_a_pasted_column_takes_out_what_it_leaves_blank(session, view):
    session.assessment.specification = tig.Specification([(63, -3), (80, -4), (100, -5)])
    place = tig.BAND_LABELS.index("63")
    view.editor.grid.handle_message({"kind": "pasted", "band": place, "text": "-6 dB\r\n\r\n-7,5\r\n"})
    assert limits(session) == {63.0: -6.0, 100.0: -7.5}


def test_cells_side_by_side_are_not_read_as_one_number(session, view):
    view.editor.grid.handle_message({"kind": "pasted", "band": 0, "text": "8\t100\n10\t-6"})
    assert limits(session) == {8.0: 100.0, 10.0: -6.0}


def test_what_is_set_aside_is_said_and_the_rest_taken(session, view, exchange):
    exchange.openers["specification"](b"63;-3\n630;-4\nnight;-5")
    assert limits(session) == {63.0: -3.0}
    message = view.editor.message.object
    assert 'role="status"' in message
    assert "outside 5 to 500 Hz: 630 Hz" in message
    assert "line 3 is not read" in message


def test_limits_that_look_like_insertion_loss_are_asked_about(session, view, exchange):
    session.show("slab-track")
    turn, keep = view.question[1]
    assert not view.question.visible
    exchange.openers["specification"](b"63;10\n80;12")
    assert view.question.visible
    assert "answer the question above the table" in view.editor.message.object
    assert session.assessment.results[0].verdict is None
    assert "No verdict yet" in view.verdict.object
    assert "no limit is below 0 dB" in view.verdict.object
    assert "No verdict yet; answer first" in ShortVerdict(session.assessment).pane.object
    turn.param.trigger("clicks")
    assert limits(session) == {63.0: -10.0, 80.0: -12.0}
    assert "No verdict" not in view.verdict.object
    assert "answer the question" not in view.editor.message.object
    assert not view.question.visible
    assert not session.assessment.results[0].verdict.complies
    type_in(view, "63", "10")
    type_in(view, "80", "12")
    assert view.question.visible
    keep.param.trigger("clicks")
    assert not view.question.visible
    assert session.assessment.results[0].verdict.complies
    type_in(view, "80", "13")
    assert not view.question.visible
    exchange.openers["specification"]("Hz;Dämmung\n63;10\n80;-1".encode())
    assert view.question.visible
    view.editor.clear.param.trigger("clicks")
    assert not view.question.visible


def test_what_was_answered_travels_in_a_study_and_an_open_question_too(session, view, exchange):
    _, keep = view.question[1]
    exchange.openers["specification"](b"63;10\n80;12")
    asked = session.snapshot.study().to_toml()
    keep.param.trigger("clicks")
    answered = session.snapshot.study().to_toml()
    session.snapshot.open(asked)
    assert view.question.visible
    assert session.assessment.current.verdict is None
    session.snapshot.open(answered)
    assert not view.question.visible
    assert session.assessment.current.verdict is not None


def test_a_new_table_leaves_the_limit_of_deflection_and_is_asked_about_anew(session, view, exchange):
    _, keep = view.question[1]
    exchange.openers["specification"](b"63;10")
    keep.param.trigger("clicks")
    view.deflection.boxes["rail_deflection_limit"].value = "2.5"
    assert not view.question.visible
    exchange.openers["specification"](b"63;11")
    assert view.question.visible
    assert session.assessment.specification.rail_deflection_limit == pytest.approx(2.5e-3)


def test_limits_that_were_not_taken_are_named_with_the_verdict(session, view, exchange):
    exchange.openers["specification"](b"63;-3\n630;-4\n<img>;-5")
    rest = "2 not judged, of no band from 5 to 500 Hz: 630 Hz, &#x27;&lt;img&gt;&#x27;"
    assert rest in view.verdict.object
    assert rest in ShortVerdict(session.assessment).pane.object
    assert "What was given last" not in view.verdict.object
    type_in(view, "80", "abc")
    told = view.verdict.object
    assert told.index("What was given last was not taken") < told.index("still in force") < told.index("<ul")
    type_in(view, "80", "-5")
    assert "What was given last" not in view.verdict.object
    assert rest in view.verdict.object
    view.editor.clear.param.trigger("clicks")
    type_in(view, "80", "-5")
    assert "not judged" not in view.verdict.object


def test_template_and_table_are_saved_as_they_are_read(session, view, exchange):
    view.editor.template.param.trigger("clicks")
    assert exchange.saved[-1][:2] == (
        "trackig-specification-template.csv",
        tig.Specification.template_csv(),
    )
    type_in(view, "63", "-3.25")
    view.editor.save.param.trigger("clicks")
    assert tig.Specification.from_csv(exchange.saved[-1][1]) == session.assessment.specification


def test_the_verdict_names_every_design_in_words(session, view):
    session.pin("slab-track", HOSTILE)
    session.assessment.specification = tig.Specification([(160, 0.0)])
    text = view.verdict.object
    assert "<img" not in text
    for each in session.assessment.results:
        assert str(each.verdict) in text
        assert each.colour in text
    assert [each.verdict.complies for each in session.assessment.results] == [True, False]
    hand, slab = view.editor.grid.designs
    band = tig.BAND_LABELS.index("160")
    assert hand["parts"][0]["cells"][band][1] is False
    margin = session.assessment.results[1].verdict.margins[band]
    assert slab["parts"][1]["cells"][band] == [f"✗ −{abs(margin):.1f}", True]
    assert slab["parts"][1]["cells"][0] == ["", False]


def test_a_margin_that_rounds_to_nothing_still_fails_in_the_table(session, view):
    gain = session.assessment.results[0].levels[0]
    session.assessment.specification = tig.Specification([(5, float(gain) - 0.001)])
    cell = view.editor.grid.designs[0]["parts"][1]["cells"][0]
    assert cell == ["✗ −0.0", True]
    assert "fails by 0.001 dB" in view.verdict.object


def test_nothing_is_drawn_while_nobody_looks(session, exchange):
    view = SpecificationView(session.assessment, exchange)
    session.show("slab-track")
    session.assessment.specification = tig.Specification([(63, 0.0)])
    assert view.editor.grid.designs == []
    view.look(True)
    assert len(view.editor.grid.designs) == 1


def test_the_short_verdict_is_seen_once_there_is_one(session):
    short = ShortVerdict(session.assessment)
    session.show("slab-track")
    assert short.pane.object == ""
    session.assessment.specification = tig.Specification([(63, 0.0)])
    assert str(session.assessment.results[0].verdict) in short.pane.object


def test_levels_stand_with_their_difference_from_the_base(session, level):
    source = tig.SourceSpectrum([(31.5, 60.0), (63, 70.5), (125, 65.0)])
    pin = session.pin("slab-track", HOSTILE)
    session.assessment.source = source
    level.base.value = pin.key
    assert session.pins.base == pin.key
    text = level.table.object
    assert "<img" not in text
    rows = [re.findall(r"<td>([^<]*)</td>", row) for row in text.split("<tr>")[2:]]
    slab = source.with_track(tig.solve(tig.PRESETS["slab-track"]).insertion_gain)
    hand = source.with_track(tig.solve(tig.PRESETS["booted-block-low-mass"]).insertion_gain)
    difference = hand.a_weighted - slab.a_weighted
    assert rows[1][1] == f"{hand.a_weighted:.1f}"
    assert rows[1][3] == f"{difference:+.1f}".replace("-", "−")
    assert rows[2][2:] == ["0.0", "0.0"]


def test_differences_are_from_the_reference_track_until_another_is_chosen(session, level):
    source = tig.SourceSpectrum([(31.5, 60.0), (63, 70.5), (125, 65.0)])
    session.assessment.source = source
    hand = source.with_track(tig.solve(tig.PRESETS["booted-block-low-mass"]).insertion_gain)
    reference = source.with_track(np.zeros(21))

    def shown():
        rows = [re.findall(r"<td>([^<]*)</td>", row) for row in level.table.object.split("<tr>")[2:]]
        return [row[3] for row in rows]

    def text(difference):
        return f"{difference:+.1f}".replace("-", "−").replace("+0.0", "0.0")

    assert "re reference\N{NO-BREAK SPACE}track, dB(A)" in level.table.object
    assert shown() == ["0.0", text(hand.a_weighted - reference.a_weighted)]
    level.base.value = 0
    assert "re This design, dB(A)" in level.table.object
    assert shown() == [text(reference.a_weighted - hand.a_weighted), "0.0"]
    pin = session.pin("slab-track", "Slab")
    session.pins.choose_base(pin.key)
    assert level.base.value == pin.key
    assert "re Slab, dB(A)" in level.table.object
    level.base.value = level.base.options["reference\N{NO-BREAK SPACE}track"]
    assert "re reference\N{NO-BREAK SPACE}track, dB(A)" in level.table.object
    assert session.pins.base == pin.key, "other tabs keep theirs"
    assert level.figure.model.yaxis.axis_label == "Received level, dB re as the source"


def test_the_preset_from_which_the_design_departs_can_be_compared_with(session, level, summary):
    session.assessment.source = tig.SourceSpectrum([(63, 70.5)])
    session.outcome.preset_summary = summary("booted-sleeper")
    name = next(name for name in level.base.options if name.startswith("preset: "))
    level.base.value = level.base.options[name]
    assert f"re {name.removeprefix('preset: ')}, dB" in level.table.object
    expected = session.assessment.preset.level.relative_to(session.assessment.current.level).a_weighted
    assert f"{-expected:+.1f}".replace("-", "−") in level.table.object
    session.outcome.preset_summary = None
    assert level.base.value == 0


def test_received_levels_are_drawn_with_the_reference_track(session, level):
    assert not level.plot.visible
    session.pin("slab-track", "Slab")
    session.assessment.source = tig.SourceSpectrum([(31.5, 60.0), (63, 70.5)])
    assert level.plot.visible
    data, band = level.figure.curves.data, tig.BAND_LABELS.index("63")
    slab = tig.solve(tig.PRESETS["slab-track"]).insertion_gain
    assert data["pin_0"][band] == 70.5 + slab[band]
    assert data["pin_9"][band] == 70.5
    assert np.isnan(data["pin_9"][0])
    assert level.figure.legend.listed == ("this design", "reference track", "Slab")
    assert level.figure.model.y_range.start <= 60.0
    session.assessment.source = None
    assert not level.plot.visible


def test_a_band_whose_neighbours_have_no_level_is_drawn_as_a_point(session, level):
    session.assessment.source = tig.SourceSpectrum([(31.5, 60.0), (63, 70.5), (80, 66.0), (500, 50.0)])
    alone, gain = level.figure.alone.data, session.outcome.summary.solution.insertion_gain
    places = [tig.BAND_LABELS.index(each) for each in ("31.5", "500")]
    assert list(alone["centre"]) == [tig.BAND_CENTRES[each] for each in (*places, *places)]
    assert list(alone["level"]) == [60.0, 50.0, 60.0 + gain[places[0]], 50.0 + gain[places[1]]]
    assert list(alone["colour"]) == [theme.PRESET_GHOST] * 2 + [theme.THIS_DESIGN] * 2
    session.assessment.source = tig.SourceSpectrum([(63, 70.5), (80, 66.0)])
    assert list(level.figure.alone.data["level"]) == []


def test_a_source_at_fault_changes_nothing(session, level, exchange):
    type_in(level, "63", "70.5")
    exchange.openers["source"](b"frequency_hz,level_db\n63,999\n")
    assert session.assessment.source.points == ((63.0, 70.5),)
    assert "line 2, column 2" in level.editor.message.object


def test_a_study_is_saved_under_its_name_and_opened_again(session, exchange, summary):
    session.show("booted-sleeper")
    session.assessment.specification = tig.Specification([(63, 0.0)])
    view = SaveAndShare(session.snapshot, exchange)
    view.study_name.value = "Tunnel 7"
    view.save.param.trigger("clicks")
    name, text, _ = exchange.saved[-1]
    assert name == "trackig-tunnel-7.toml"
    other = type(session)(summary)
    SaveAndShare(other.snapshot, exchange)
    exchange.openers["study"](text.encode())
    assert other.snapshot.study() == session.snapshot.study()
    assert other.assessment.title == "Tunnel 7"


def test_a_name_that_is_none_is_told_and_not_taken(session, exchange):
    view = SaveAndShare(session.snapshot, exchange)
    view.study_name.value = "   "
    assert view.study_name.error_state
    assert session.assessment.title == tig.Study.name


def test_a_study_at_fault_is_told_without_markup_and_changes_nothing(session, exchange):
    view = SaveAndShare(session.snapshot, exchange)
    before = session.snapshot.study()
    text = before.to_toml().replace('name = "Study"', f"name = '{HOSTILE * 9}'")
    exchange.openers["study"](text.encode())
    assert "Not opened, nothing has changed" in view.message.object
    assert "<img" not in view.message.object
    assert session.snapshot.study() == before


def test_there_is_nothing_to_download_before_a_picture_is_there(session, exchange):
    view = SaveAndShare(session.snapshot, exchange)
    assert view.gain.disabled
    session.show("slab-track")
    assert not view.gain.disabled


def test_the_report_shows_what_is_on_screen(session, exchange):
    session.show("booted-sleeper")
    session.pin("slab-track", HOSTILE)
    session.assessment.specification = tig.Specification([(63, 0.0)])
    view = SaveAndShare(session.snapshot, exchange)
    asyncio.run(view._save_report())
    name, text, kind = exchange.saved[-1]
    assert (name, kind) == ("trackig-study-report.html", "text/html")
    assert str(session.assessment.results[0].verdict) in text
    assert "<img" not in text
    assert not view.report.loading


def test_a_report_says_whose_it_is_where_that_is_a_name(session, exchange):
    session.show("booted-sleeper")
    view = SaveAndShare(session.snapshot, exchange)
    view.particulars["client"].value = " Metro <Co> "
    view.particulars["author"].value = "no\nname"
    assert view.particulars["author"].error_state
    assert "printable characters" in view.particulars["author"].helper_text
    asyncio.run(view._save_report())
    _, text, _ = exchange.saved[-1]
    assert "<dt>Client</dt><dd>Metro &lt;Co&gt;</dd>" in text
    assert "<dt>Author" not in text
    view.particulars["author"].value = ""
    assert not view.particulars["author"].error_state


def test_a_report_without_a_picture_is_refused_in_words(session, exchange):
    view = SaveAndShare(session.snapshot, exchange)
    asyncio.run(view._save_report())
    assert exchange.saved == []


def test_curves_are_named_after_study_and_design_and_leave_out_what_is_not_drawn(session, exchange):
    session.show("booted-sleeper")
    session.pin("slab-track", "Slab")
    session.assessment.title = "Tunnel 7"
    view = SaveAndShare(session.snapshot, exchange)
    view.gain.param.trigger("clicks")
    assert exchange.saved[-1][0] == "trackig-tunnel-7-booted-sleeper-gain.csv"
    session.pins.alone = True
    view.force.param.trigger("clicks")
    name, text, _ = exchange.saved[-1]
    assert name == "trackig-tunnel-7-slab-force.csv"
    assert "This design" not in text


def test_a_data_sheet_is_that_of_the_chosen_design(session, exchange):
    session.show("booted-sleeper")
    view = SaveAndShare(session.snapshot, exchange)
    pin = session.pin("slab-track", HOSTILE)
    assert list(view.sheet_design.options) == ["this\N{NO-BREAK SPACE}design", HOSTILE]
    view.sheet_design.value = pin.key
    session.assessment.specification = tig.Specification([(63, 0.0)])
    assert view.sheet_design.value == pin.key
    asyncio.run(view._save_sheet())
    name, text, kind = exchange.saved[-1]
    assert (name, kind) == ("trackig-study-img-src-x-onerror-alert-1-data-sheet.html", "text/html")
    assert str(session.assessment.results[1].verdict) in text
    assert "<img" not in text


@pytest.mark.parametrize(("form", "start"), [("png", b"\x89PNG"), ("svg", b"<?xml")])
def test_pictures_are_saved_of_what_is_drawn(session, exchange, form, start):
    session.show("booted-sleeper")
    view = SaveAndShare(session.snapshot, exchange)
    asyncio.run(view._save_picture("gain", form))
    name, data, _ = exchange.saved[-1]
    assert name == f"trackig-study-booted-sleeper-gain.{form}"
    assert data.startswith(start)
    assert not view.pictures["gain", form].loading


def test_a_refused_study_is_told_below_the_buttons_of_studies(session, exchange):
    view = SaveAndShare(session.snapshot, exchange)
    (paper,) = [each for each in view.build().objects if view.message in each.objects]
    assert view.open in paper.objects[1].objects
