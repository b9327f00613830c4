"""Vehicle, axles and ground as they are chosen: off changes nothing, and what a study holds stays."""

from urllib.parse import parse_qs

import pytest

import trackig_core as tig
from dashboard.fields import SURROUNDINGS
from dashboard.persistence import link, studies
from dashboard.session import surroundings
from dashboard.session.inputs import DesignInputs, GainDefinition, design_of, preset_values, values_of

BLOCK = tig.PRESETS["booted-block-low-mass"]
OWN = BLOCK.replace(
    suspension=tig.Suspension(1.1e6, 3e3, 512.25),
    axle_positions=(0.0, 2.0, 5.5),
    speed=22.22,
    ground=tig.Ground(1.23e8, 4.56e4, 7.5),
)


@pytest.fixture
def inputs():
    return DesignInputs()


def opened(query):
    """Return what a link holds, through the server's reading of its query."""
    return link.decode({key: [each.encode() for each in texts] for key, texts in parse_qs(query).items()})


def test_off_says_nothing_anywhere(inputs):
    assert inputs.to_design() == BLOCK
    query = link.encode(inputs.to_values())
    assert not any(name in query for name in (*SURROUNDINGS, "speed"))
    assert {name: getattr(BLOCK, name) for name in SURROUNDINGS} == surroundings.OFF


def test_what_is_chosen_is_of_the_catalogue(inputs):
    inputs.take_given({"suspension": "metro", "ground": "soft clay"})
    design = inputs.to_design()
    assert design == BLOCK.replace(
        suspension=tig.VEHICLES["metro"].suspension, ground=tig.GROUNDS["soft clay"]
    )
    assert inputs.modified
    inputs.revert()
    assert inputs.to_design() == BLOCK


def test_the_axles_are_those_of_the_vehicle_s_bogie(inputs):
    inputs.take_given({"axle_positions": "bogie"})
    assert inputs.axle_positions == (0.0, tig.VEHICLES["regional"].wheelbase)
    inputs.take_given({"suspension": "freight"})
    assert inputs.axle_positions == (0.0, tig.VEHICLES["freight"].wheelbase)
    inputs.take_given({"suspension": "metro", "axle_positions": "none"})
    assert inputs.to_design().axle_positions == (0.0,)


def test_speed_is_typed_in_kilometres_an_hour_and_comes_back_as_typed(inputs):
    inputs.take_given({"axle_positions": "bogie", "speed": "80"})
    assert inputs.to_design().speed == pytest.approx(80 / 3.6, rel=1e-11)
    assert values_of(inputs.to_design())["speed"] == 80.0
    inputs.take_given({"speed": ""})
    assert inputs.to_design().speed is None


@pytest.mark.parametrize("given", ["no such", "own", 3, None, ["metro"]])
def test_what_is_not_offered_is_not_taken(inputs, given):
    inputs.take_given({"suspension": given})
    assert inputs.to_design() == BLOCK
    assert ("suspension" in inputs.refused) == (given != "own")


def test_a_study_s_own_values_open_and_stay_to_the_last_digit(inputs):
    study = tig.Study.from_toml(tig.Study(design=OWN).to_toml())
    inputs.take(studies.from_study(study).values)
    assert inputs.to_design() == OWN
    values = inputs.to_values()
    assert {surroundings.chosen(name, values) for name in SURROUNDINGS} == {surroundings.OWN}
    inputs.take_given(dict.fromkeys(SURROUNDINGS, surroundings.OWN))
    assert inputs.to_design() == OWN


def test_a_link_holds_names_and_own_numbers(inputs):
    inputs.take_given({"suspension": "high speed", "axle_positions": "bogie", "speed": 80, "ground": "rock"})
    for design in (inputs.to_design(), OWN):
        pin = tig.PinnedDesign("a~b;c=d", design, colour=1, preset="booted-block-low-mass")
        values = preset_values("booted-block-low-mass") | values_of(design)
        found = opened(link.encode(values, pins=[pin]))
        assert found.problems == ()
        assert design_of(found.values) == design
        assert found.pins[0].design == design
    assert "suspension=high+speed" in link.encode(inputs.to_values())


HOSTILE = ("nan_1_2", "1e400_1_1", "x", "_", "1_2", "1_" * 300, "0_0", "-1_1_1", "0_29_-29")


@pytest.mark.parametrize("text", HOSTILE)
def test_what_a_link_cannot_mean_is_ignored_in_words(text):
    for name in SURROUNDINGS:
        found = link.decode({name: [text.encode()], "speed": [b"20"]})
        design = design_of(found.values)
        assert found.problems or getattr(design, name) != surroundings.OFF[name]


def test_axles_that_do_not_go_with_the_rest_are_refused_in_words(inputs):
    inputs.take(values_of(BLOCK.replace(axle_positions=(0.0, 0.15), fastener_spacing=0.3)))
    inputs.take_given({"fastener_spacing": 1.0})
    assert inputs.fastener_spacing == 0.3
    assert "rail element" in inputs.refused["fastener_spacing"]


def test_every_design_has_a_reference_that_has_a_meaning():
    definition = GainDefinition(reference="line")
    yielding = BLOCK.replace(ground=tig.GROUNDS["stiff clay"])
    assert [definition.reference_of(each) for each in (BLOCK, yielding)] == ["line", "stiff"]
    for design in (BLOCK, yielding):
        solution = tig.solve(design, "exact")
        reference = definition.reference_of(design)
        wanted = tig.solve(design, "exact", reference=reference).insertion_gain
        assert definition.gain(solution).levels == pytest.approx(wanted, abs=1e-12)
        assert definition.levels_of(solution.spectrum, solution) == pytest.approx(wanted, abs=1e-12)
    definition.reference = "stiff"
    assert definition.reference_of(BLOCK) == "stiff"


def test_words_say_what_a_design_has():
    assert surroundings.text(BLOCK, "suspension") == "unsprung wheel"
    assert surroundings.text(BLOCK, "ground") == "rigid"
    metro = BLOCK.replace(suspension=tig.VEHICLES["metro"].suspension, axle_positions=(0.0, 2.1))
    assert surroundings.text(metro, "suspension") == "metro (generic)"
    assert surroundings.text(metro, "axle_positions") == "at 0, 2.1 m, independent roughness"
    assert surroundings.text(OWN, "ground") == "own: 123 kN/mm, 45.6 kN s/m, 7.5 kg"
    assert surroundings.text(OWN, "suspension") == "own: primary 1.1 kN/mm, 3 kN s/m; bogie 512.25 kg"
    whole = OWN.replace(suspension=tig.Suspension(1.1e6, 3e3, 512.25, 0.25e6, 15e3, 4000.0))
    assert surroundings.text(whole, "suspension").endswith("; secondary 0.25 kN/mm, 15 kN s/m; body 4000 kg")
    assert surroundings.text(OWN, "axle_positions").endswith("same roughness at 79.992 km/h")
