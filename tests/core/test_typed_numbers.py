"""Numbers as people type them: what is read, in which unit, and what is refused."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from trackig_core.track.rails import STEEL_MODULUS
from trackig_core.typed_numbers import NumberError, find_unit, read_number, read_quantity


@pytest.mark.parametrize("text", ["3055 cm4", "3055cm⁴", "3055 cm^4", "30.55e6 mm⁴"])
def test_a_second_moment_of_area_is_that_of_a_rail_of_steel(text):
    assert read_number(text, "MN m²") == pytest.approx(STEEL_MODULUS * 3055e-8 / 1e6, rel=1e-12)
    assert read_number(text, "N m2") == pytest.approx(STEEL_MODULUS * 3055e-8, rel=1e-12)


@pytest.mark.parametrize(
    ("text", "unit", "value"),
    [
        ("880", "", 880.0),
        (" 880 ", "kg", 880.0),
        ("1e3", "", 1000.0),
        ("1E+2", "", 100.0),
        ("1,5e3", "", 1500.0),
        ("1.2×10^9", "", 1.2e9),
        ("1,2·10⁹ N/m", "N/m", 1.2e9),
        ("5*10**-3", "", 0.005),
        ("2×10⁻³", "", 0.002),
        (".5", "", 0.5),
        (",5", "", 0.5),
        ("5.", "", 5.0),
        ("0,125", "", 0.125),
        ("31,5", "Hz", 31.5),
        ("31,5 Hz", "Hz", 31.5),
        ("31.5HZ", "Hz", 31.5),
        ("1k", "Hz", 1000.0),
        ("1k25", "Hz", 1250.0),
        ("1.25 kHz", "Hz", 1250.0),
        ("20M", "N/m", 20e6),
        ("1 000", "", 1000.0),
        ("1\N{NO-BREAK SPACE}000", "", 1000.0),
        ("1\N{THIN SPACE}200\N{THIN SPACE}000", "", 1.2e6),
        ("1\N{NARROW NO-BREAK SPACE}000,5", "", 1000.5),
        ("1_000", "", 1000.0),
        ("1'000.5", "", 1000.5),
        ("1\N{RIGHT SINGLE QUOTATION MARK}000", "", 1000.0),
        ("1,200.5", "", 1200.5),
        ("1.200,5", "", 1200.5),
        ("1,234,567", "", 1234567.0),
        ("\N{FULLWIDTH DIGIT EIGHT}\N{FULLWIDTH DIGIT EIGHT}0", "kg", 880.0),
        ("\N{ARABIC-INDIC DIGIT EIGHT}\N{ARABIC-INDIC DIGIT EIGHT}\N{ARABIC-INDIC DIGIT ZERO}", "", 880.0),
        ("880kg", "kg", 880.0),
        ("880\N{NO-BREAK SPACE}kg", "kg", 880.0),
        ("0.88 t", "kg", 880.0),
        ("20kN/mm", "N/m", 20e6),
        ("20 kN mm⁻¹", "N/m", 20e6),
        ("20e6 N/m", "kN/mm", 20.0),
        ("20 MN/m", "kN/mm", 20.0),
        ("6.4 MN·m²", "N m2", 6.4e6),
        ("6.4MNm2", "N m2", 6.4e6),
        ("60 cm", "m", 0.6),
        ("700mm", "m", 0.7),
        ("20 %", "", 0.2),
        ("90 km/h", "m/s", 25.0),
        ("30 kN s/m", "N s/m", 30e3),
        ("-6", "", -6.0),
        ("+6 dB", "dB", 6.0),
        ("- 6", "", -6.0),
        ("\N{MINUS SIGN}6", "", -6.0),
        ("\N{EN DASH}6 dB", "dB", -6.0),
        ("\N{NON-BREAKING HYPHEN}6", "", -6.0),
        ("\N{FULLWIDTH HYPHEN-MINUS}6", "", -6.0),
        ("\N{LEFT-TO-RIGHT MARK}-6\N{ZERO WIDTH SPACE}", "", -6.0),
    ],
)
def test_numbers_are_read_as_a_person_reads_them(text, unit, value):
    assert read_number(text, unit) == value


@pytest.mark.parametrize(
    ("text", "unit", "words"),
    [
        ("", "kg", "give a number"),
        ("  ", "", "give a number"),
        ("stiff", "N/m", "'stiff' is no number"),
        ("1,200", "kg", "'1,200' may be 1200 or 1.200: write one of them"),
        ("1_0", "", "is no number"),
        ("12 34", "", "is no number"),
        ("1,2,3", "", "is no number"),
        ("1.2.3", "", "is no number"),
        (".", "", "is no number"),
        ("--6", "", "is no number"),
        ("\N{SOFT HYPHEN}6", "", "is no number"),
        ("nan", "", "is no number"),
        ("inf", "", "is no number"),
        ("1e999", "", "is too large"),
        ("2×106", "", "is no unit that is known"),
        ("20 kg", "N/m", "kg is a unit of mass; give N/m, N/mm, kN/mm or MN/m"),
        ("20 kN", "N/m", "kN is a unit of force"),
        ("20 kg", "", "give a number without a unit"),
        ("20 apples", "kg", "'apples' is no unit that is known"),
    ],
)
def test_what_is_no_certain_number_is_refused(text, unit, words):
    with pytest.raises(NumberError) as caught:
        read_number(text, unit)
    assert words in str(caught.value)


def test_a_comma_is_decimal_where_the_reader_knows_it():
    assert read_number("-6,125", decimal=",") == -6.125
    assert read_number("6,125.5", decimal=",") == 6125.5


def test_a_quantity_keeps_its_unit():
    value, unit = read_quantity("31,5 kN/mm")
    assert (value, unit.quantity, unit.factor) == (31.5, "stiffness", 10**6)
    assert read_quantity("31.5") == (31.5, None)
    assert find_unit("furlong") is None


def test_a_unit_that_is_unknown_is_the_programmers_mistake():
    with pytest.raises(ValueError, match="furlong"):
        read_number("5 m", "furlong")


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_every_float_is_read_back_exactly(number):
    assert read_number(repr(number)) == number
    assert read_number(f"{number!r} N/m", "N/m") == number


@given(st.text(max_size=30) | st.text("0123456789.,-eEkM×^'_ Nm/", max_size=20))
def test_any_text_is_a_number_or_refused(text):
    try:
        number = read_number(text, "N/m")
    except NumberError:
        return
    assert abs(number) < float("inf")
