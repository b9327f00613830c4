"""The band that production makes of insertion gain, drawn for the design that it was computed of."""

import numpy as np

import trackig_core as tig
from dashboard.session.inputs import GainDefinition
from dashboard.session.production import Production

PERCENTILES = np.arange(63.0).reshape(3, 21)


def test_on_ground_that_yields_the_band_is_that_against_the_stiff_track():
    design = tig.PRESETS["booted-block-low-mass"].replace(ground=tig.GROUNDS["soft clay"])
    production = Production(wanted=True, computed=(design, "stiff", "energy", PERCENTILES))
    np.testing.assert_array_equal(production.band(design, GainDefinition()), PERCENTILES[[0, 2]])
    assert production.band(design.replace(ground=None), GainDefinition()) is None
