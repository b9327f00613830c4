"""The table of fields that is shown agrees with that of the core."""

from dashboard.fields import FIELDS
from trackig_core.track.fields import SLIDER_RANGES


def test_sliders_offer_the_ranges_that_are_searched():
    """Where a slider ends in display units, the search for feasible ranges ends in SI units."""
    shown = {name: (each.to_si(each.low), each.to_si(each.high)) for name, each in FIELDS.items()}
    assert shown == SLIDER_RANGES
