"""Numbers of the command line are read with a unit, or in SI; what is none is refused with what is."""

import re

import pytest

from dashboard.cli_numbers import field_cost, field_number, field_range, read_share
from trackig_core.typed_numbers import NumberError


@pytest.mark.parametrize(
    ("field", "text", "value"),
    [
        ("boot_stiffness", "20e6", 20e6),
        ("boot_stiffness", "20 kN/mm", 20e6),
        ("boot_stiffness", "20MN/m", 20e6),
        ("block_mass", "0,05 t", 50.0),
        ("pad_loss_factor", "15 %", 0.15),
        ("rail_deflection_limit", "2.5 mm", 0.0025),
        ("wheel_load", "85kN", 85e3),
        ("ground.damping", "20 kN s/m", 20e3),
        ("speed", "72 km/h", 20.0),
    ],
)
def test_a_number_is_in_its_unit_or_in_si(field, text, value):
    assert field_number(field, text) == value


@pytest.mark.parametrize(
    ("field", "text", "ends"),
    [
        ("boot_stiffness", "5e6..40e6", [5e6, 40e6]),
        ("boot_stiffness", "5..40 kN/mm", [5e6, 40e6]),
        ("boot_stiffness", "5 kN/mm..40", [5e6, 40e6]),
        ("boot_stiffness", "5kN/mm:40MN/m", [5e6, 40e6]),
        ("boot_stiffness", "500 N/mm to 40 kN/mm", [0.5e6, 40e6]),
        ("boot_stiffness", "5M..40M", [5e6, 40e6]),
        ("fastener_spacing", "600..650 mm", [0.6, 0.65]),
        ("fastener_spacing", ".6...65", [0.6, 0.65]),
        ("block_mass", "-1..5", [-1.0, 5.0]),
        ("pad_loss_factor", "5..20%", [0.05, 0.2]),
    ],
)
def test_a_unit_at_one_end_of_a_range_holds_for_both(field, text, ends):
    assert field_range(field, text) == ends


@pytest.mark.parametrize(
    ("field", "text", "cost"),
    [
        ("block_mass", "2.5", 2.5),
        ("block_mass", "2.5/kg", 2.5),
        ("block_mass", "2500 per t", 2.5),
        ("boot_stiffness", "3/(kN/mm)", 3e-6),
        ("boot_stiffness", "3 / kN/mm", 3e-6),
        ("boot_stiffness", "3 per kN/mm", 3e-6),
        ("colour", "3", 3.0),
    ],
)
def test_a_cost_is_per_the_unit_that_is_named(field, text, cost):
    assert field_cost(field, text) == pytest.approx(cost, rel=1e-15)


@pytest.mark.parametrize("text", ["10%", "10 %", "0.1", "0,1", "±10%", "+-10 %", "+/-10%"])
def test_a_share_is_a_number_or_in_per_cent(text):
    assert read_share(text) == 0.1


@pytest.mark.parametrize(
    ("read", "words"),
    [
        (
            lambda: field_number("boot_stiffness", "20 kg"),
            "boot_stiffness is a number from 100000 to 1e+13 N/m",
        ),
        (lambda: field_number("pad_loss_factor", "1 m"), "give a number without a unit"),
        (lambda: field_range("block_mass", "5-9"), "write block_mass=LOW..HIGH, with a unit or in SI"),
        (
            lambda: field_range("block_mass", "5..9 furlongs"),
            "'furlongs' is no unit that is known; block_mass is",
        ),
        (
            lambda: field_range("block_mass", "5..9 m"),
            "m is a unit of length; give kg; block_mass is a number",
        ),
        (
            lambda: field_range("block_mass", "heavy..9"),
            "'heavy' is no number; block_mass is a number from 1",
        ),
        (lambda: field_cost("block_mass", "2/m"), "'m' is no unit of block_mass; give a cost per kg"),
        (lambda: field_cost("block_mass", "2/3/kg"), "'3/kg' is no unit of block_mass"),
        (lambda: field_cost("block_mass", ""), "write block_mass=2.5/kg"),
        (lambda: read_share("2 kg"), "give a number without a unit"),
    ],
)
def test_what_is_refused_is_told_with_what_is_taken(read, words):
    with pytest.raises(NumberError, match=re.escape(words)):
        read()
