"""The table of fields that is shown agrees with that of the core."""

import pytest

from dashboard.fields import FIELDS
from dashboard.session.inputs import DesignInputs
from trackig_core.track.fields import SLIDER_RANGES


def test_every_number_that_is_searched_has_a_slider():
    assert set(FIELDS) == set(SLIDER_RANGES)


@pytest.mark.parametrize("name", SLIDER_RANGES)
def test_sliders_end_where_the_search_ends(name):
    """The ends of a slider, in display units, are to the last digit the ends of the search in SI units."""
    low, high = DesignInputs.param[name].bounds
    assert (FIELDS[name].to_si(low), FIELDS[name].to_si(high)) == SLIDER_RANGES[name]
