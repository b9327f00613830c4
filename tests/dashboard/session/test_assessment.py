"""Designs compared with a specification and a source: the words and numbers are the library's."""

import numpy as np
import pytest

import trackig_core as tig
from dashboard import theme
from dashboard.session.pins import THIS_DESIGN

LIMITS = tig.Specification([(63, -3.0), (125, -5.0)])
SOURCE = tig.SourceSpectrum([(31.5, 60.0), (63, 70.5)])


def test_every_design_that_is_solved_is_assessed_under_its_name(session):
    session.show("booted-block-low-mass")
    session.assessment.specification = LIMITS
    pin = session.pin("slab-track", "Slab")
    hand, slab = session.assessment.results
    assert (hand.key, hand.name) == (None, THIS_DESIGN)
    assert (slab.key, slab.name, slab.colour, slab.dash) == (pin.key, "Slab", *theme.look(pin.colour))
    for each, preset in ((hand, "booted-block-low-mass"), (slab, "slab-track")):
        expected = LIMITS.check(tig.solve(tig.PRESETS[preset]).insertion_gain)
        np.testing.assert_allclose(each.verdict.margins, expected.margins, atol=1e-9)
        assert str(each.verdict) == str(expected)


def test_a_pin_without_a_solution_is_listed_and_not_assessed(session):
    session.show("slab-track")
    session.assessment.specification = LIMITS
    session.pins.add(session.inputs.to_design(), "Not solved yet")
    hand, pin = session.assessment.results
    assert (hand.name, pin.name, pin.design) == (THIS_DESIGN, "Not solved yet", hand.design)
    assert (pin.summary, pin.gain, pin.levels, pin.verdict, pin.level) == (None,) * 5
    assert session.assessment.shown == (hand,)


def test_before_anything_is_solved_there_is_the_current_design_and_nothing_of_it(session):
    (hand,) = session.assessment.results
    assert hand.design == session.inputs.to_design()
    assert hand.summary is None
    assert session.assessment.base is hand
    assert session.assessment.shown == ()


def test_hidden_pins_are_assessed_but_not_shown(session):
    session.show("slab-track")
    pin = session.pin("booted-sleeper", "Sleeper")
    session.pins.show(pin.key, False)
    assert [each.name for each in session.assessment.results] == [THIS_DESIGN, "Sleeper"]
    assert [each.name for each in session.assessment.shown] == [THIS_DESIGN]


def test_levels_follow_the_source_the_base_and_the_choice_of_gain(session):
    session.show("booted-block-low-mass")
    pin = session.pin("slab-track", "Slab")
    session.assessment.source = SOURCE
    session.pins.choose_base(pin.key)
    session.definition.param.update(summation="coherent", reference="rigid")
    hand, slab = session.assessment.results
    assert session.assessment.base is slab
    chosen = {"summation": "coherent", "reference": "rigid"}
    for each, preset in ((hand, "booted-block-low-mass"), (slab, "slab-track")):
        expected = SOURCE.with_track(tig.solve(tig.PRESETS[preset], **chosen).insertion_gain)
        assert each.level.a_weighted == pytest.approx(expected.a_weighted)
        assert each.level.unweighted == pytest.approx(expected.unweighted)


def test_without_specification_and_source_there_is_no_verdict_and_no_level(session):
    session.show("slab-track")
    (hand,) = session.assessment.results
    assert hand.verdict is None
    assert hand.level is None
