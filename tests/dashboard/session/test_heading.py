"""What files say of themselves: which design they are about, by which definition, and how it was solved."""

import datetime

import trackig_core as tig
from dashboard.session.heading import Heading, current_name

DAY = datetime.date(2026, 3, 5)
SLAB = tig.PRESETS["slab-track"]


def test_the_current_design_is_called_after_the_preset_it_comes_from():
    assert current_name(tig.Study(SLAB, preset="slab-track")) == "Slab track"
    softer = SLAB.replace(pad_stiffness=50e6)
    assert current_name(tig.Study(softer, preset="slab-track")) == "Slab track, modified"
    assert current_name(tig.Study(softer)) == "This design"


def test_a_pin_is_called_by_its_name_and_every_way_of_solving_is_named_once(session):
    session.show("booted-sleeper")
    session.pin("slab-track", "Slab of 1998")
    study, (current, pin) = session.snapshot.study(), session.assessment.shown
    assert Heading.of(study, [pin], DAY).design == "Slab of 1998"
    both = Heading.of(study, [current, pin], DAY)
    assert both.design == "Booted sleeper"
    assert both.fidelity == "time stepping at the paper's resolution"
    assert both.day == "5 March 2026"
