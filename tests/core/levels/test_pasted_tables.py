"""Specifications and sources as people paste them: what is read, what is set aside, what is refused."""

import dataclasses
import re

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import trackig_core as tig
from trackig_core import table_text, typed_tables
from trackig_core.levels.specification import (
    CALLED_LOSS,
    GAIN,
    UNSTATED,
    Specification,
    SpecificationError,
)

TWO = ((31.5, -6.0), (40.0, -8.5))


@pytest.mark.parametrize(
    "data",
    [
        "Frequenz [Hz];Grenzwert [dB]\n31,5;-6\n40;-8,5",
        "Frequency (Hz) Limit (dB)\n31.5 -6\n40 -8.5",
        "Frequency (Hz)   Limit (dB)\n31.5   -6\n40   -8.5",
        "frequency_hz ig_max_db\n31.5 -6\n40 -8.5",
        "Fréquence,Gain\nHz,dB\n31.5,-6\n40,-8.5",
        "f / Hz\tΔL / dB\n31,5\t\N{EN DASH}6\n40\t\N{MINUS SIGN}8,5",
        "\n\nRequirement\tof the client\n31.5\t-6\n40\t-8.5",
        "31,5 Hz\t-6 dB\n40\N{NO-BREAK SPACE}Hz\t<= -8,5 dB",
        "31,5 Hz -6 dB\n40 Hz ≤ -8,5 dB",
        "31,5 -6,0\n40 -8,5",
        "31.5: -6\n40: -8.5",
        "31.5 Hz = -6 dB\n40 Hz = -8.5 dB",
        "| Hz | dB |\n|---:|---|\n| 31.5 | -6 |\n| 40 | -8.5 |",
        '"Frequency\n[Hz]"\t"Limit\n[dB]"\n31.5\t-6\n40\t-8.5',
        '"31,5","-6"\n"40","-8,5"',
        "sep=;\n31,5;-6\n40;-8,5",
        "kHz;dB\n0,0315;-6\n0,04;-8,5",
        "周波数;上限\n31.5;-6\n40;-8.5",
        "1/3 octave band;Limit\n31.5;-6\n40;-8.5",
        "Frequenz [Hz]\t31,5\t40\nGrenzwert [dB]\t-6\t-8,5",
        "Frequenz;Hz;31,5;40\nGrenzwert;dB;-6;-8,5",
        "Frequency (Hz) 31.5 40\nLimit in dB -6 -8.5",
        "Frequenz [Hz];Größe \N{EN DASH} dB\n31,5;\N{EN DASH}6\n40;-8,5".encode("cp1252"),
        "Frequenz [Hz]\tGrenzwert [dB]\n31,5\t≤ -6\n40\t-8,5".encode("utf-16"),
        "\N{BYTE ORDER MARK}Frequenz;Größe\n31,5;-6\n40;-8,5".encode(),
    ],
)
def test_what_a_person_would_read_is_read_without_a_word(data):
    reading = Specification.read(data)
    assert reading.table.points == TWO
    assert reading.notes == ()
    assert not reading.table.question


@pytest.mark.parametrize(
    ("data", "notes"),
    [
        ("31.5;-6\n40;-8.5\n630;-9\n0.8k;-9", ["set aside, outside 5 to 500 Hz: 630, 800 Hz"]),
        ("31.5;-6\n40;-8.5\n50;\n63;–\n80;n/a", ["no value at 50, 63, 80 Hz"]),
        ("Los 3\nHz;dB\n31.5;-6\n40;-8.5", ["line 1 is not read: 'Los 3'"]),
        (
            "31.5;-6\nlow\n40;-8.5\nall bands",
            ["line 2 is not read: 'low'", "line 4 is not read: 'all bands'"],
        ),
        ("31.5;-6\n40;-8.5\nSum;-3", ["line 3 is not read: 'Sum' is no frequency"]),
        ("Hz;dB;Remark\n31.5;-6;km 3\n40;-8.5;", ["column 3 ('Remark') is not read"]),
        (
            "f_l [Hz];f_m [Hz];f_u [Hz];max [dB]\n28,2;31,5;35,5;-6\n35,5;40;44,7;-8,5",
            ["column 1 ('f_l [Hz]') is not read", "column 3 ('f_u [Hz]') is not read"],
        ),
        ("Frequency;31.5;40\nLimit;-6;-8.5\nFrequency;50;63\nLimit;;n/a", ["no value at 50, 63 Hz"]),
        ("No.;Hz;dB\n1;31.5;-6\n2;40;-8.5", ["column 1 ('No.') is not read"]),
        ("Hz;limit, dB;measured, dB\n31.5;-6;-7\n40;-8.5;-9", ["column 3 ('measured, dB') is not read"]),
    ],
)
def test_what_is_set_aside_is_said(data, notes):
    reading = Specification.read(data)
    assert reading.table.points == TWO
    assert list(reading.notes) == notes


def test_octave_bands_are_named_as_such():
    assert "octave bands" in Specification.read("31.5;-6\n63;-7\n125;-8").notes[0]


@pytest.mark.parametrize(
    ("data", "line", "column", "words"),
    [
        ("Hz;a;b\n31.5;-6;-7", 1, 3, "column 2 ('a') and column 3 ('b') may both hold the limit: keep one"),
        ("31,5,-3,5\n40,0,-4,5", 1, 3, "if numbers have decimal commas, separate them by semicolons"),
        ("31.5 - 6\n40 - 8", 1, 2, "'- 6' may be one number, or no value and a number"),
        ("31.5;-6\n40;-8*", 2, 2, "limit '-8*': give a number from -100 to 100 dB"),
        ("31.5;-6\n;-8", 2, 1, "frequency ''"),
        ("31.5;-6\n4O;-8", 2, 1, "frequency '4O'"),
        ("31.5;-6\n600;-8", 2, 1, "frequency 600.0"),
        ("31.5;-6 kg\n40;-8", 1, 2, "'-6 kg' is in kg, a unit of mass: give it in dB"),
        ("31.5;>= -6", 1, 2, "'>= -6': give greatest insertion gain allowed, or the least insertion loss"),
        ("31.5;<= -6\n40;>= 8", 2, 2, "'>= 8'"),
        ("Hz;31.5;40\ndB;-6;-8;-9", 2, 4, "'-9' does not stand below a frequency of line 1"),
        ("Hz;31.5;40\ndB;-6;-8\nHz;50", 3, None, "1 rows from here on"),
        ("x" * 2000, 1, None, "give at most 1000 a line"),
        ("1 " * 450 + "\n" + ("1 " * 450 + "\n") * 40, None, None, "cells: give at most 6000"),
        (b"PK\x03\x04\0\0", None, None, "this is an Excel workbook"),
        (b"%PDF-1.7", None, None, "this is a PDF"),
    ],
)
def test_what_is_ambiguous_is_refused_with_line_and_column(data, line, column, words):
    with pytest.raises(SpecificationError) as caught:
        Specification.read(data)
    assert (caught.value.line, caught.value.column) == (line, column)
    assert words in str(caught.value)


@pytest.mark.parametrize(
    ("data", "limits", "asks"),
    [
        ("Hz;Insertion loss, dB\n31.5;6\n40;8", CALLED_LOSS, "called insertion losses"),
        ("Hz;Einfügungsdämm-Maß\n31.5;6\n40;-1", CALLED_LOSS, "called insertion losses"),
        ("Hz;dB\n31.5;>= 6\n40;≥ 8", CALLED_LOSS, "called insertion losses"),
        ("31.5;6\n40;0", UNSTATED, "no limit is below 0 dB"),
        ("31.5;6\n40;-1", GAIN, ""),
        ("Hz;<= dB\n31.5;-6\n40;-8", GAIN, ""),
    ],
)
def test_what_may_be_an_insertion_loss_gives_no_verdict_before_that_is_answered(data, limits, asks):
    table = Specification.read(data).table
    assert table.limits == limits
    assert asks in table.question
    assert bool(asks) == bool(table.question)
    if not asks:
        assert table.in_force is table
        return
    assert table.in_force is None
    with pytest.raises(SpecificationError, match=asks):
        table.check(np.zeros(21))
    for answered in (table.turned(), table.kept()):
        assert answered.question == ""
        assert answered.check(np.full(21, -50.0)).complies
    with pytest.raises(ValueError, match=asks):
        tig.decide.feasible_ranges(tig.PRESETS["booted-block-low-mass"], table)


def test_limits_of_no_band_of_the_model_are_named_with_the_verdict():
    table = Specification.read("Hz;dB\n4;-1\n31.5;-6\n40;-8\n630;-9\n800;\nnight;-5").table
    assert table.not_judged == ("4 Hz", "630 Hz", "'night'")
    rest = "3 not judged, of no band from 5 to 500 Hz: 4 Hz, 630 Hz, 'night'"
    assert (
        str(table.check(np.full(21, -10.0)))
        == f"complies in 2 of 5 limits, least margin 2.0 dB at 40 Hz; {rest}"
    )
    assert str(table.check(np.zeros(21))) == f"fails by 8.0 dB at 40 Hz (2 bands); {rest}"
    deflection = dataclasses.replace(table, points=(), rail_deflection_limit=2e-3)
    assert str(deflection.check(np.zeros(21), 1e-3)).startswith("complies in 1 of 4 limits; rail deflection")


def test_many_limits_that_are_not_judged_are_counted():
    rows = "\n".join(f"remark {number};-5" for number in range(20))
    verdict = Specification.read(f"63;-3\n{rows}").table.check(np.zeros(21))
    assert "20 not judged" in str(verdict)
    assert str(verdict).endswith("'remark 7' and 12 more")
    with pytest.raises(SpecificationError, match="70 rows are of no band: give at most 60"):
        Specification.read("63;-3\n" + "\n".join(f"remark {number};-5" for number in range(70)))


def test_what_was_said_of_limits_holds_while_they_are_typed_over():
    asked = Specification.given([(63, 10.0)])
    assert asked.question
    assert not asked.kept().with_points([(63, 10.0), (80, 12.0)]).question
    assert asked.with_points([(63, 10.0), (80, 12.0)]).question
    assert not asked.with_points([(63, 10.0), (80, -1.0)]).question
    loss = Specification.given([(63, 10.0), (80, -1.0)], says_loss=True)
    assert loss.with_points([(63, 9.0), (80, -1.0)]).question
    assert loss.kept().with_points([(63, 9.0), (80, 1.0)]).question


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"limits": "loss"}, "limits = 'loss': give one of 'insertion gain'"),
        ({"not_judged": ("a\nb",)}, "not_judged = "),
        ({"not_judged": ("x" * 41,)}, "not_judged = "),
        ({"not_judged": ("x",) * 61}, "not_judged = "),
        ({"not_judged": (5,)}, "not_judged = "),
    ],
)
def test_what_is_said_of_limits_is_checked(given, words):
    with pytest.raises(SpecificationError, match=words):
        Specification(TWO, **given)


def test_a_turned_specification_is_one_of_insertion_gain():
    loss = tig.Specification([(31.5, 6.0), (40, 8.5)], "Client")
    assert loss.turned() == tig.Specification(TWO, "Client")
    slab = np.zeros(21)
    assert loss.check(slab).complies
    assert not loss.turned().check(slab).complies


def test_a_source_takes_no_bounds():
    assert tig.SourceSpectrum.read("Terz\tPegel\n31,5\t62").table.points == ((31.5, 62.0),)
    with pytest.raises(tig.BandTableError, match="line 1, column 2: '<= 62': give the level alone"):
        tig.SourceSpectrum.read("31.5;<= 62")


WRITTEN = {
    "separator": ["\t", ";", " ; ", "  ", " | "],
    "decimal": [".", ","],
    "minus": ["-", "\N{MINUS SIGN}", "\N{EN DASH}"],
    "header": [None, ("Frequency [Hz]", "Limit [dB]"), ("f", "IG"), ("Frequenz, Hz", "Anforderung")],
    "units": [("", ""), (" Hz", " dB"), ("Hz", "")],
    "sideways": [False, True],
    "code": [None, "utf-8", "utf-16", "utf-8-sig"],
}

limits = st.dictionaries(
    st.sampled_from(tig.BAND_LABELS), st.integers(-1000, 1000).map(lambda tenths: tenths / 10), min_size=3
)


@given(limits, st.fixed_dictionaries({name: st.sampled_from(each) for name, each in WRITTEN.items()}))
def test_a_specification_may_be_written_in_many_ways(limits, how):
    def written(number, unit):
        return f"{number:g}".replace("-", how["minus"]).replace(".", how["decimal"]) + unit

    points = sorted((float(label), limit) for label, limit in limits.items())
    rows = [[written(value, unit) for value, unit in zip(pair, how["units"], strict=True)] for pair in points]
    if how["header"] is not None:
        rows.insert(0, list(how["header"]))
    if how["sideways"] and (how["header"] is not None or all(limit < 0 for _, limit in points)):
        rows = zip(*rows, strict=True)
    text = "\n".join(how["separator"].join(row) for row in rows)
    reading = Specification.read(text if how["code"] is None else text.encode(how["code"]))
    assert list(reading.table.points) == points
    assert reading.notes in ((), ("only octave bands are given: each is taken as its one-third-octave band",))


PAIRS = tig.Specification([(63, 0), (80, -3), (100, -4.5)])


@pytest.mark.parametrize(
    "line",
    [
        "63 0 80 -3 100 -4.5",
        "63\t0\t80\t-3\t100\t-4,5",
        "63; 0; 80; -3; 100; -4,5",
        "63 Hz 0 dB 80 Hz -3 dB 100 Hz -4.5 dB",
    ],
)
def test_frequencies_and_levels_in_turn_on_one_line_are_pairs(line):
    reading = tig.Specification.read(line)
    assert reading.table.points == PAIRS.points
    assert "the line is read as frequency and level in turn" in reading.notes


@pytest.mark.parametrize(
    "line",
    [
        "63 0; 80 -3; 100 -4.5",
        "63 0, 80 -3, 100 -4.5",
        "63 0; 80 -3; 100 -4,5;",
        "63: 0; 80: -3; 100: -4.5",
        "63,0; 80,-3; 100,-4.5",
        "63=0, 80=-3, 100=-4.5",
        "63 Hz: <= 0 dB; 80 Hz: <= -3 dB; 100 Hz: <= -4.5 dB",
        "63 Hz 0 dB, 80 Hz -3 dB, 100 Hz -4,5 dB",
    ],
)
def test_rows_may_stand_in_one_line(line):
    assert tig.Specification.read(line).table.points == PAIRS.points


def test_a_frequency_that_no_standard_writes_is_said_to_be_taken_for_its_band():
    reading = tig.Specification.read("64 -3\n80 -5\n31 -1")
    assert reading.table.points == ((31.5, -1.0), (63.0, -3.0), (80.0, -5.0))
    assert "taken for the nearest band: 64 Hz as 63 Hz, 31 Hz as 31.5 Hz" in reading.notes


@pytest.mark.parametrize("centres", [10 ** (np.arange(7, 28) / 10), 1000 * 2 ** (np.arange(-23, -2) / 3)])
def test_exact_mid_band_frequencies_are_taken_without_a_word(centres):
    rows = "\n".join(f"{each:.3g} -{place + 1}" for place, each in enumerate(centres))
    reading = tig.Specification.read(rows)
    assert len(reading.table.points) == 21
    assert not any("nearest" in each for each in reading.notes)


def test_rows_of_one_line_may_have_three_numbers():
    data = "1 20 0.1; 63 25 0.15; 400 30 0.2"
    columns = typed_tables.read_table(data).columns
    assert [[*each.values] for each in columns] == [[1, 63, 400], [20, 25, 30], [0.1, 0.15, 0.2]]


@pytest.mark.parametrize("line", ["1 000; 2 000", "63; -3", "Hz 31.5 63; dB 3 10", "63 0; 80", "a 1; b 2"])
def test_a_line_whose_parts_are_no_rows_of_numbers_is_one_row(line):
    assert {cell.line for row in table_text.read_cells(line) for cell in row} == {1}
    assert len(table_text.read_cells(line)) == 1


@pytest.mark.parametrize(
    ("line", "count"), [("63 80 100 125", 4), ("80 -3 63 0", 4), ("62 1 99 2 3 4", 6), ("63 80 -3", 3)]
)
def test_one_line_that_may_be_read_in_two_ways_is_refused_with_an_example(line, count):
    with pytest.raises(tig.SpecificationError) as refused:
        tig.Specification.read(line)
    assert str(refused.value) == (
        f"line 1: {count} values in one line: give a line per band, frequency in Hz and limit in dB, "
        "such as 63 -3"
    )


@pytest.mark.parametrize("kind", [tig.Specification, tig.SourceSpectrum, tig.MeasuredGain])
def test_the_example_of_a_refusal_is_one_that_is_taken(kind):
    with pytest.raises(tig.BandTableError, match=r"such as 63 -?[0-9]+$") as refused:
        kind.read("hello")
    assert not re.search("[a-z]_[a-z]", str(refused.value)), "no names of columns"
    reading = kind.read(str(refused.value).rpartition("such as ")[2])
    assert [frequency for frequency, _ in reading.table.points] == [63]
