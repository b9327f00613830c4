"""Specifications and the files they come in: what is read, what is refused and where, and the verdict."""

import pickle

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import trackig_core as tig

NAN = float("nan")

LIMITS = tig.Specification([(8, 12.5), (31.5, -3.0), (63, -10.25), (250, -20.0)], name="Client")

FILE = """frequency_hz,ig_max_db
8,12.5
31.5,-3
63,-10.25
250,-20
"""

points = st.dictionaries(
    st.sampled_from([float(label) for label in tig.BAND_LABELS]), st.floats(-100, 100), min_size=1
).map(lambda table: list(table.items()))


@pytest.mark.parametrize(
    "data",
    [
        FILE,
        FILE.encode(),
        b"\xef\xbb\xbf" + FILE.encode(),
        "\N{BYTE ORDER MARK}" + FILE,
        FILE.encode("utf-16"),
        FILE.replace("\n", "\r\n"),
        FILE.replace("\n", "\r"),
        FILE.replace(".", "@").replace(",", ";").replace("@", ","),
        FILE.replace(",", "\t"),
        FILE.replace(".", "@").replace(",", "\t").replace("@", ","),
        FILE.partition("\n")[2],
        FILE.partition("\n")[2].replace(",", "  "),
        FILE.partition("\n")[2].replace(".", "@").replace(",", " ").replace("@", ","),
        FILE.partition("\n")[2].replace(",", ", "),
        "# K\u00fcche\n\n" + FILE.replace("\n", "\n# between\n\n,,\n"),
        ("# K\u00fcche\n" + FILE).encode("latin-1"),
        FILE.replace("\n", ",,\n"),
        FILE.replace("-", "\N{MINUS SIGN}"),
        FILE.replace("63", "63.1").replace("31.5", "31.623").replace("250", "+2.5e2"),
        FILE.upper(),
        FILE.replace(",", " , "),
        FILE + "500,\n16\n",
        '"frequency_hz","ig_max_db"\n"8","12.5"\n63,-10.25\n250,-20\n31.5,-3\n',
    ],
)
def test_files_are_read_as_people_write_them(data):
    assert tig.Specification.from_csv(data, "Client") == LIMITS


@pytest.mark.parametrize(
    ("text", "line", "column", "words"),
    [
        ("", None, None, "no frequency with its limit"),
        ("frequency_hz,ig_max_db\n", None, None, "no frequency with its limit"),
        ("frequency_hz,ig_max_db\n8,\n", None, None, "no frequency with its limit"),
        ("frequency_hz,level_db\n8,1\n", 1, 2, "'level_db' where 'ig_max_db' is due"),
        ("# note\nfrequency_hz,ig_max_db\n8,1\n10,abc\n", 4, 2, "limit 'abc'"),
        ("8,1\n10,nan\n", 2, 2, "from -100 to 100 dB"),
        ("8,1\n10,inf\n", 2, 2, "limit 'inf'"),
        ("8,1\n10,101\n", 2, 2, "limit 101"),
        ("8,1\n10,1e999\n", 2, 2, "limit '1e999'"),
        ("8,1\n10,1_0\n", 2, 2, "limit '1_0'"),
        ("8,1\n4.5,1\n", 2, 1, "5 to 500 Hz"),
        ("8,1\n600,1\n", 2, 1, "5 to 500 Hz"),
        ("8,1\n-8,1\n", 2, 1, "frequency -8"),
        ("8,1\n8 Hzz,1\n", 2, 1, "frequency '8 Hzz'"),
        ("8,1\n13,1\n", 2, 1, "the nearest is 12.5 Hz"),
        ("8,1\n45,1\n", 2, 1, "the nearest is"),
        ("8,1\n\n7.94,2\n", 3, 1, "the band 8 Hz stands in line 1 already"),
        ("8,1\n31,5,-3,5\n", 2, 3, "decimal commas"),
        ("8;1\n10;1.234,5\n", 2, 2, "limit 1234.5"),
        ("31.5\n63\n", None, None, "no frequency with its limit"),
        ("63 -3; 80 hello", None, None, "no frequency with its limit"),
        ("8,1\n10,<script>alert(1)</script>\n", 2, 2, "<script>"),
        ("8,1\n10," + "9" * 900 + "\n", 2, 2, "limit '999"),
        ("8,1\n10," + "9" * 5000 + "\n", 2, None, "at most 1000 a line"),
        ('8,1\n10,"1\n', None, None, None),
    ],
)
def test_wrong_files_name_line_and_column(text, line, column, words):
    if words is None:
        assert tig.Specification.from_csv(text).points == ((8.0, 1.0), (10.0, 1.0))
        return
    with pytest.raises(tig.SpecificationError) as caught:
        tig.Specification.from_csv(text)
    message = str(caught.value)
    assert (caught.value.line, caught.value.column) == (line, column)
    assert words in message
    place = f"line {line}" + (f", column {column}" if column else "")
    assert message.startswith(f"{place}: " if line else "no frequency")
    assert len(message) < 250


@pytest.mark.parametrize(
    "data",
    [b"\x89PNG\r\n\x1a\n\0\0", "8,1\0", b"\xff\xfe8\0,\0\0\xd8", "8,1\n" * 1000, "#" * 70_000, b"1" * 70_000],
)
def test_what_is_no_table_is_refused(data):
    with pytest.raises(tig.SpecificationError):
        tig.Specification.from_csv(data)


@given(
    st.one_of(st.binary(max_size=200), st.text(max_size=200), st.text('0123456789.,;\t\n"#-e', max_size=60))
)
def test_any_file_is_read_or_refused(data):
    try:
        specification = tig.Specification.from_csv(data)
    except tig.SpecificationError:
        return
    assert 1 <= len(specification.points) <= 21


@given(points, st.text(max_size=70))
def test_files_round_trip_exactly(points, name):
    try:
        specification = tig.Specification(points, name=name)
    except tig.SpecificationError:
        assert not name or name != name.strip() or not name.isprintable() or len(name) > 60
        return
    # a table does not say what its limits are, and is asked about
    assert tig.Specification.from_csv(specification.to_csv(), name).kept() == specification


@pytest.mark.parametrize(
    ("points", "words"),
    [
        ([], "no frequency with its limit"),
        (5, "give rows of frequency, limit"),
        ([5], "give rows"),
        ([(8, 1), (10,)], "row 2: 1 values"),
        ([(8, 1), (10, True)], "row 2, column 2: limit True"),
        ([(8, 1), (10, None)], "row 2, column 2: limit None"),
        ([(8, 1), (10, "1")], "row 2, column 2"),
        ([(8, 1), (10, NAN)], "row 2, column 2: limit nan"),
        ([(8, 1), (10, 10**400)], "row 2, column 2"),
        ([(8, 1), (10, 10**5000)], "row 2, column 2: limit a number of more than"),
        ([(8, 1), (8, 1)], "row 2, column 1: the band 8 Hz stands in row 1"),
        ([("8", 1)], "row 1, column 1"),
    ],
)
def test_wrong_rows_are_refused(points, words):
    with pytest.raises(tig.SpecificationError) as caught:
        tig.Specification(points)
    assert str(caught.value).startswith(words)


@pytest.mark.parametrize("name", ["", "  ", " a", "a ", "a\nb", "a\0b", "\u202eab", "x" * 61, 5, "\ud800"])
def test_names_that_cannot_be_shown_are_refused(name):
    with pytest.raises(tig.SpecificationError, match="name = "):
        tig.Specification([(8, 1)], name=name)


def test_errors_pass_between_processes():
    with pytest.raises(tig.SpecificationError) as caught:
        tig.Specification.from_csv("8,1\n10,x\n")
    copy = pickle.loads(pickle.dumps(caught.value))
    assert (str(copy), copy.line, copy.column) == (str(caught.value), 2, 2)


def test_equal_specifications_are_equal_keys():
    again = tig.Specification(LIMITS.points[::-1], name="Client")
    assert again == LIMITS
    assert hash(again) == hash(LIMITS)


def test_the_template_asks_for_every_band_and_needs_an_answer():
    template = tig.Specification.template_csv()
    with pytest.raises(tig.SpecificationError, match="no frequency with its limit"):
        tig.Specification.from_csv(template)
    filled = tig.Specification.from_csv(
        "\n".join(line + "1" if line.endswith(",") else line for line in template.splitlines())
    )
    assert filled.points == tuple((float(label), 1.0) for label in tig.BAND_LABELS)


def test_base_two_centres_name_their_bands():
    found = tig.Specification([(1000 * 2 ** (n / 3), 0.0) for n in range(-23, -2)])
    np.testing.assert_array_equal([f for f, _ in found.points], [float(label) for label in tig.BAND_LABELS])


def levels(**changed):
    """Return levels that meet the limits with a margin of 1 dB but where changed."""
    base = np.where(np.isnan(LIMITS.levels), 50.0, LIMITS.levels - 1)
    for band, value in changed.items():
        base[tig.BAND_LABELS.index(band.strip("b").replace("_", "."))] = value
    return base


@pytest.mark.parametrize(
    ("changed", "complies", "words"),
    [
        ({}, True, "complies, least margin 1.0 dB at 8 Hz"),
        ({"b63": -10.45}, True, "complies, least margin 0.2 dB at 63 Hz"),
        ({"b63": -10.25}, True, "complies, least margin 0.0 dB at 63 Hz"),
        ({"b63": -10.25 + 1e-12}, True, "complies, least margin 0.0 dB at 63 Hz"),
        ({"b63": -10.25 - 0.03}, True, "complies, least margin 0.03 dB at 63 Hz"),
        ({"b63": -10.25 + 0.03}, False, "fails by 0.03 dB at 63 Hz (1 band)"),
        ({"b63": -10.25 + 2e-6}, False, "fails by 0.000002 dB at 63 Hz (1 band)"),
        ({"b31_5": 0.4, "b250": -19.0}, False, "fails by 3.4 dB at 31.5 Hz (2 bands)"),
        ({"b100": 99.0}, True, "complies, least margin 1.0 dB at 8 Hz"),
    ],
)
def test_the_verdict_in_words(changed, complies, words):
    verdict = LIMITS.check(levels(**changed))
    assert verdict.complies == complies
    assert str(verdict) == words


@given(st.floats(1e-6, 60))
def test_a_verdict_never_fails_by_nothing(amount):
    verdict = tig.Specification([(63, 0.0)]).check(np.full(21, amount * 1.001))
    assert not verdict.complies
    shown = float(str(verdict).split()[2])
    assert shown > 0
    assert shown == pytest.approx(amount, rel=0.51, abs=0.051)


def test_margins_are_limit_less_level_where_there_is_a_limit():
    verdict = LIMITS.check(levels(b31_5=0.4))
    given = {float(label): margin for label, margin in zip(tig.BAND_LABELS, verdict.margins, strict=True)}
    assert {f: given[f] for f, _ in LIMITS.points} == pytest.approx({8: 1.0, 31.5: -3.4, 63: 1.0, 250: 1.0})
    assert np.isnan(verdict.margins).sum() == 17
    assert [tig.BAND_LABELS[i] for i in np.flatnonzero(verdict.fails)] == ["31.5"]
    assert (verdict.worst_band, verdict.worst_margin) == ("31.5", pytest.approx(-3.4))


@pytest.mark.parametrize("wrong", [np.zeros(20), np.full(21, NAN), np.full(21, np.inf), 3.0])
def test_levels_must_be_one_per_band(wrong):
    with pytest.raises(ValueError, match="21 finite levels"):
        LIMITS.check(wrong)


def test_a_solution_is_held_against_a_specification():
    solution = tig.solve(tig.PRESETS["booted-block-low-mass"], "exact")
    limits = zip((float(label) for label in tig.BAND_LABELS), solution.insertion_gain, strict=True)
    tight = tig.Specification([(f, level + 2 * (f != 63)) for f, level in limits])
    verdict = tight.check(solution.insertion_gain)
    assert verdict.complies
    assert (verdict.worst_margin, verdict.worst_band) == (0.0, "63")


SOFT = tig.Specification([(63, 0.0)], rail_deflection_limit=2.5e-3, wheel_load=100e3)


@pytest.mark.parametrize(
    ("level", "deflection", "complies", "words"),
    [
        (
            -1.0,
            2.0e-3,
            True,
            "complies, least margin 1.0 dB at 63 Hz; rail deflection 0.5 mm below its limit",
        ),
        (
            -1.0,
            2.5e-3,
            True,
            "complies, least margin 1.0 dB at 63 Hz; rail deflection 0.0 mm below its limit",
        ),
        (
            -1.0,
            2.51e-3,
            False,
            "fails, least margin 1.0 dB at 63 Hz; rail deflection 0.01 mm above its limit",
        ),
        (1.0, 2.0e-3, False, "fails by 1.0 dB at 63 Hz (1 band); rail deflection 0.5 mm below its limit"),
        (1.0, 3.0e-3, False, "fails by 1.0 dB at 63 Hz (1 band); rail deflection 0.5 mm above its limit"),
    ],
)
def test_a_limit_of_rail_deflection_is_part_of_the_verdict(level, deflection, complies, words):
    verdict = SOFT.check(np.full(21, level), deflection)
    assert (verdict.complies, str(verdict)) == (complies, words)
    assert verdict.deflection_margin == pytest.approx(2.5e-3 - deflection, abs=1e-12)


def test_a_limited_deflection_has_to_be_given():
    for missing in (None, NAN):
        with pytest.raises(ValueError, match=r"rail_deflection = .*: the specification limits it.*100 kN"):
            SOFT.check(np.zeros(21), missing)
    assert LIMITS.check(levels(), 1.0).deflection_margin is None


@pytest.mark.parametrize(
    ("values", "words"),
    [
        ({"rail_deflection_limit": 2.5}, "rail_deflection_limit = 2.5: give a number from 1e-06 to 0.1 m"),
        ({"rail_deflection_limit": NAN}, "rail_deflection_limit = nan"),
        ({"rail_deflection_limit": 1e-3, "wheel_load": 85}, "wheel_load = 85: give a number from 1000 to"),
        ({"wheel_load": "85 kN"}, "wheel_load = '85 kN'"),
    ],
)
def test_wrong_limits_of_rail_deflection_are_refused(values, words):
    with pytest.raises(tig.SpecificationError) as caught:
        tig.Specification([(63, 0.0)], **values)
    assert str(caught.value).startswith(words)


def test_a_load_without_a_limit_says_nothing():
    assert tig.Specification([(63, 0.0)], wheel_load=100e3) == tig.Specification([(63, 0.0)])
