"""The table of fields that is shown agrees with that of the core."""

import pytest

from dashboard.fields import ASKED_FIELDS, EXTRA_FIELDS, FIELDS
from dashboard.session.inputs import DesignInputs
from trackig_core.decide.numbers import is_logarithmic
from trackig_core.track.fields import RANGES, SEARCHED_RANGES, SLIDER_RANGES


def test_every_number_that_is_searched_has_a_slider():
    assert set(FIELDS) == set(SLIDER_RANGES)


@pytest.mark.parametrize("name", SLIDER_RANGES)
def test_sliders_end_where_the_search_ends(name):
    """The ends of a slider, in display units, are to the last digit the ends of the search in SI units."""
    low, high = DesignInputs.param[name].bounds
    assert (FIELDS[name].to_si(low), FIELDS[name].to_si(high)) == SLIDER_RANGES[name]


def test_every_number_that_is_searched_is_shown_by_name_and_unit():
    assert set(ASKED_FIELDS) == set(SEARCHED_RANGES)
    labels = [field.label for field in ASKED_FIELDS.values()]
    assert len({*labels}) == len(labels)
    units = {"N/m": "kN/mm", "N s/m": "kN s/m", "m/s": "km/h"}
    for name, field in ASKED_FIELDS.items():
        unit = RANGES[name][2]
        assert field.unit == units.get(unit, unit)
        assert field.logarithmic == is_logarithmic(name)
        if name not in EXTRA_FIELDS:
            assert (field.to_si(field.low), field.to_si(field.high)) == SEARCHED_RANGES[name]
