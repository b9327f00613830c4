"""Studies in the dashboard: what was saved opens as it was, whether sliders can show it or not."""

import dataclasses

import pytest
from hypothesis import given
from hypothesis import strategies as st

import trackig_core as tig
from dashboard.fields import EXTRA_FIELDS, EXTRAS, NUMBERS, OPENING_PRESET, SECOND_STAGE, six_figures
from dashboard.persistence.studies import from_study, to_study
from dashboard.session.inputs import DesignInputs, GainDefinition, design_of, preset_values, values_of
from dashboard.session.pins import Pins
from dashboard.theme import MOST_PINNED
from trackig_core.names import LONGEST_NAME, is_name

BLOCK, SLAB = tig.PRESETS["booted-block-low-mass"], tig.PRESETS["slab-track"]
MEASURED = tig.StiffnessCurve([(5, 90e6, 0.1), (500, 150e6, 0.2)])


def number(name):
    low, high = DesignInputs.param[name].bounds
    return st.one_of(st.sampled_from([low, high]), st.floats(low, high).map(six_figures))


def as_kept(values):
    """Return values, those that a single-stage track does not have as its preset has them."""
    if values["two_stage"]:
        return values
    return values | {name: preset_values(values["preset"])[name] for name in SECOND_STAGE}


def extra(name):
    """Return any value of an extra number: nothing too, where there may be none."""
    return st.one_of(st.just(EXTRA_FIELDS[name].default), number(name))


any_values = st.fixed_dictionaries(
    {
        "preset": st.sampled_from([*tig.PRESETS]),
        "two_stage": st.booleans(),
        "rail": st.sampled_from([*tig.RAILS]),
        **{name: number(name) for name in NUMBERS},
        "special": st.just({}),
        **{name: extra(name) for name in EXTRAS},
        "suspension": st.sampled_from([None, tig.VEHICLES["metro"].suspension]),
        "axle_positions": st.sampled_from([(0.0,), (0.0, 2.5)]),
        "ground": st.sampled_from([None, *tig.GROUNDS.values()]),
    }
).map(as_kept)
any_view = st.fixed_dictionaries(
    {
        name: st.sampled_from([*GainDefinition.param[name].objects])
        for name in ("summation", "reference", "bands")
    }
)
printable = st.characters(exclude_categories=["C", "Z"], include_characters=" ")
any_name = st.text(printable, min_size=1, max_size=LONGEST_NAME).filter(is_name)


def pin(name, colour, values, shown):
    """Return a pinned design of some inputs."""
    return tig.PinnedDesign(name, design_of(values), colour, shown, values["preset"])


def any_pins(least=0):
    return st.lists(
        st.tuples(any_name, st.integers(0, MOST_PINNED - 1), any_values, st.booleans()),
        min_size=least,
        max_size=MOST_PINNED,
        unique_by=(lambda pin: pin[0], lambda pin: pin[1]),
    ).map(lambda rows: tuple(pin(*row) for row in rows))


def tables(kind):
    bands = st.sampled_from([float(label) for label in tig.BAND_LABELS])
    rows = st.dictionaries(bands, st.floats(-50, 50), min_size=1).map(lambda table: [*table.items()])
    return st.one_of(st.none(), st.builds(kind, rows, any_name))


@given(any_values, any_view, any_pins(), tables(tig.Specification), tables(tig.SourceSpectrum), st.data())
def test_what_was_saved_opens_as_it_was(values, view, pins, specification, source, data):
    base = data.draw(st.sampled_from([None, *range(len(pins))]))
    study = to_study(values, view, pins, base, specification, source, "Assessment")
    opened = from_study(tig.Study.from_toml(study.to_toml()))
    assert opened.values == values
    assert opened.view == view
    assert opened.pins == pins
    assert opened.base == base
    assert (opened.specification, opened.source, opened.name) == (specification, source, "Assessment")


@given(any_values, any_pins(1))
def test_sliders_and_pins_take_what_a_study_opens(values, pins):
    opened = from_study(to_study(values, pins=pins, base=len(pins) - 1))
    inputs, kept = DesignInputs(), Pins()
    inputs.take(opened.values)
    kept.replace_all(opened.pins, opened.base)
    assert inputs.to_values() == values
    assert kept.pinned == pins
    for each in kept.pinned:
        inputs.take(values_of(each.design, each.preset))
        assert inputs.to_design() == each.design
        assert inputs.preset == each.preset
    assert kept[kept.base].name == pins[-1].name


def test_a_single_stage_track_opens_the_same_whatever_its_idle_inputs_were():
    values = preset_values("slab-track")
    study = to_study(values | {"block_mass": 321.0})
    assert study == to_study(values)
    assert from_study(study).values == values


@pytest.mark.parametrize("preset", tig.PRESETS)
def test_a_published_track_opens_as_its_preset(preset):
    opened = from_study(tig.Study(tig.PRESETS[preset]))
    assert opened.values == preset_values(preset)


def test_any_other_track_without_a_preset_departs_from_the_opening_one():
    design = SLAB.replace(wheel_mass=700)
    opened = from_study(tig.Study(design))
    assert opened.values["preset"] == OPENING_PRESET
    assert design_of(opened.values) == design


def test_designs_of_one_colour_get_their_own():
    pinned = [tig.PinnedDesign(name, SLAB) for name in ("A", "B", "C")]
    assert [pin.colour for pin in from_study(tig.Study(BLOCK, pinned)).pins] == [0, 1, 2]


SPECIAL = {
    "beyond the slider": BLOCK.replace(boot_stiffness=300e6),
    "below the slider": SLAB.replace(fastener_spacing=0.15),
    "seven figures": BLOCK.replace(pad_stiffness=100.0001e6),
    "measured stiffness": BLOCK.replace(pad_stiffness=MEASURED, pad_loss_factor=None),
    "measured loss factor": BLOCK.replace(boot_loss_factor=tig.LossFactorCurve([(5, 0.1), (500, 0.2)])),
    "a rail of its own": BLOCK.replace(rail=dataclasses.replace(BLOCK.rail, mass_per_metre=61.0)),
    "static stiffness": BLOCK.replace(pad_static_stiffness=80e6, boot_static_stiffness=20e6),
    "another frequency": SLAB.replace(stiffness_frequency=10.0),
}


@pytest.mark.parametrize("design", SPECIAL.values(), ids=SPECIAL)
def test_designs_that_sliders_cannot_show_open_and_are_saved_to_the_last_digit(design):
    pinned = [tig.PinnedDesign("Plain", SLAB), tig.PinnedDesign("Odd one", design, colour=1)]
    opened = from_study(tig.Study.from_toml(tig.Study(design, pinned).to_toml()))
    inputs = DesignInputs()
    inputs.take(opened.values)
    assert inputs.to_design() == design
    assert [pin.design for pin in opened.pins] == [SLAB, design]
    again = tig.Study.from_toml(to_study(inputs.to_values(), pins=opened.pins).to_toml())
    assert again.design == design
    assert [pin.design for pin in again.pinned] == [SLAB, design]


def test_a_study_of_more_designs_than_the_page_shows_is_refused_and_still_read():
    many = tig.Study(BLOCK, [tig.PinnedDesign(f"Design {n}", SLAB, colour=n) for n in range(9)])
    with pytest.raises(tig.StudyError, match="pinned: 9 designs: the page shows at most 8"):
        from_study(tig.Study.from_toml(many.to_toml()))


def test_designs_of_one_name_are_refused():
    with pytest.raises(tig.StudyError, match="two designs are called “A”; give each its own"):
        from_study(tig.Study(BLOCK, [tig.PinnedDesign("A", SLAB), tig.PinnedDesign("A", BLOCK)]))
