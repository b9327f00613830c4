"""Designs side by side: the list of pins, the table, differences from a base, undo and redo, the drawing."""

import dataclasses
import re
from types import SimpleNamespace

import numpy as np
import pytest
from bokeh.models import HoverTool

import trackig_core as tig
from dashboard import formats, theme
from dashboard.client.browser import Browser
from dashboard.figures.swatches import swatch_svg
from dashboard.session.assessment import Assessment
from dashboard.session.inputs import DesignInputs, GainDefinition
from dashboard.session.measuring import Measuring
from dashboard.session.pins import Pins
from dashboard.session.results import DesignResult, Outcome
from dashboard.session.shelf import Shelf
from dashboard.session.steps import Steps
from dashboard.teaching.lessons import set_sliders
from dashboard.theme import MOST_PINNED
from dashboard.views.compare import NOTHING_TO_COMPARE, Compare
from dashboard.views.comparison_table import table_html
from dashboard.views.design_bar import DesignBar
from dashboard.views.likeness import Likeness, likeness_words
from dashboard.views.track import Track

MARKUP = "<img src=x onerror=console.error(1)>"

KEYS = ("slab-track", "booted-sleeper")


class Session:
    """What a user has in front of him, with two pins and no solver."""

    def __init__(self, summary, make_pictures):
        self.inputs, self.definition, self.pins = DesignInputs(), GainDefinition(), Pins()
        self.outcome = Outcome(summary=summary("booted-block-low-mass"))
        self.slab, self.sleeper = self.pins.add_all([(tig.PRESETS[key], key, key) for key in KEYS])
        summaries = {self.slab.key: summary("slab-track"), self.sleeper.key: summary("booted-sleeper")}
        self.pinned = make_pictures(summaries=summaries)
        self.assessment = Assessment(self.inputs, self.outcome, self.definition, self.pins, self.pinned)
        self.asked = []
        self.view = Compare(
            self.inputs, self.pins, self.definition, self.assessment, lambda: self.asked.append(True)
        )
        self.view.look(active=True)

    def level(self, key):
        return tig.solve(tig.PRESETS[key]).insertion_gain

    @property
    def table(self):
        return self.view.table.object

    def row(self, label):
        """Return what stands in a row of the table, tags taken off."""
        row = self.table.split(f'<th scope="row">{label}</th>')[1].split("</tr>")[0]
        return [
            tuple(cell.replace("</span>", "").split('<span class="difference">'))
            for cell in row.replace("</td>", "").split("<td>")[1:]
        ]


@pytest.fixture
def session(summary, make_pictures):
    return Session(summary, make_pictures)


def test_parameters_stand_side_by_side_in_display_units(session):
    assert session.row("Pad stiffness, kN/mm") == [("100",), ("1000", "+900"), ("150", "+50")]
    assert session.row("Block mass, kg") == [("45",), ("–",), ("210", "+165")]
    assert session.row("Fastener spacing, m") == [("0.6",), ("0.25", "−0.35"), ("0.75", "+0.15")]


def test_frequencies_and_levels_differ_from_the_chosen_base(session):
    session.view.base.value = session.slab.key
    assert session.pins.base == session.slab.key
    solutions = [tig.solve(tig.PRESETS[key]) for key in ("booted-block-low-mass", *KEYS)]
    loaded = [solution.natural_frequencies.loaded_track for solution in solutions]
    found = session.row("Loaded track")
    assert found[1] == (formats.frequency_text(loaded[1]).removesuffix(" Hz"),)
    assert found[0][1] == formats.signed_text(loaded[0] - loaded[1])
    band = tig.BAND_LABELS.index("63")
    hand, slab, sleeper = (solution.insertion_gain[band] for solution in solutions)
    assert session.row("63 Hz") == [
        (formats.signed_text(hand), formats.signed_text(hand - slab)),
        (formats.signed_text(slab),),
        (formats.signed_text(sleeper), formats.signed_text(sleeper - slab)),
    ]


def test_bands_are_those_that_were_chosen(session):
    assert '<th scope="row">8 Hz</th>' not in session.table
    session.view.bands.value = ["8"]
    assert '<th scope="row">8 Hz</th>' in session.table
    assert '<th scope="row">63 Hz</th>' not in session.table


def test_differences_are_drawn_from_the_base(session):
    data = session.view.differences.curves
    own = session.level("booted-block-low-mass")
    np.testing.assert_allclose(data.data["pin_0"], session.level("slab-track") - own, atol=1e-9)
    np.testing.assert_allclose(data.data["pin_1"], session.level("booted-sleeper") - own, atol=1e-9)
    assert np.isnan(data.data[f"pin_{MOST_PINNED}"]).all()
    session.pins.choose_base(session.slab.key)
    slab = session.level("slab-track")
    np.testing.assert_allclose(data.data["pin_0"], session.level("booted-sleeper") - slab, atol=1e-9)
    np.testing.assert_allclose(data.data[f"pin_{MOST_PINNED}"], own - slab, atol=1e-9)
    names = list(session.view.differences.legend.listed)
    assert names == ["this design", "booted-sleeper"]
    (hover,) = session.view.differences.model.select({"type": HoverTool})
    assert [name for name, _ in hover.tooltips] == ["band", *names]


def test_without_a_second_design_it_says_what_to_do_instead_of_an_empty_plot(session):
    assert session.view._difference_place.objects == [session.view._difference_pane]
    for pin in session.pins.pinned:
        session.pins.remove(pin.key)
    (said,) = session.view._difference_place.objects
    assert said.object == NOTHING_TO_COMPARE


def test_a_base_that_is_not_solved_yet_says_no_differences(session):
    new = session.pins.add(tig.PRESETS["slab-track"].replace(wheel_mass=700.0), "new")
    session.pins.choose_base(new.key)
    assert np.isnan(session.view.differences.curves.data["pin_0"]).all()
    assert [cell[0] for cell in session.row("63 Hz")][-1] == "–"
    assert all(len(cell) == 1 for cell in session.row("63 Hz"))


def test_the_choice_of_sum_is_compared_too(session):
    session.definition.summation = "coherent"
    band = tig.BAND_LABELS.index("125")
    slab = tig.solve(tig.PRESETS["slab-track"], summation="coherent").insertion_gain[band]
    assert session.row("125 Hz")[1][0] == formats.signed_text(slab)


def test_nothing_is_drawn_while_nobody_looks(session, summary):
    before = session.table
    session.view.look(active=False)
    session.outcome.summary = summary("booted-block-high-mass")
    assert session.table == before
    session.view.look(active=True)
    assert session.table != before


def test_hidden_pins_are_neither_listed_nor_drawn(session):
    session.view.list.rows[session.slab.key].shown.value = False
    assert not session.pins[session.slab.key].shown
    assert "slab-track" not in session.table
    names = list(session.view.differences.legend.listed)
    assert names == ["booted-sleeper"]


def test_a_row_renames_recolours_puts_back_and_removes(session):
    row = session.view.list.rows[session.slab.key]
    row.name_box.value = "Mine"
    assert session.pins[session.slab.key].name == "Mine"
    assert "Mine" in session.table
    row.colour.value = 5
    assert session.pins[session.slab.key].colour == 5
    assert row.swatch.object == swatch_svg(theme.DESIGN_COLOURS[5], theme.DESIGN_DASHES[5])
    row.use.param.trigger("clicks")
    assert session.inputs.to_design() == tig.PRESETS["slab-track"]
    assert session.view.list.rows[session.slab.key] is row
    row.remove.param.trigger("clicks")
    assert [pin.key for pin in session.pins.pinned] == [session.sleeper.key]
    assert list(session.view.list.rows) == [session.sleeper.key]


@pytest.mark.parametrize("name", ["booted-sleeper", "", "x" * 41])
def test_a_name_that_cannot_be_taken_changes_nothing(session, name):
    row = session.view.list.rows[session.slab.key]
    row.name_box.value = name
    assert session.pins[session.slab.key].name == "slab-track"
    assert row.name_box.error_state
    row.name_box.value = "Mine"
    assert not row.name_box.error_state


def test_no_name_becomes_markup(session):
    session.pins.rename(session.slab.key, MARKUP)
    session.pins.choose_base(session.slab.key)
    assert "<img" not in session.table
    assert "&lt;img" in session.table


def test_no_pin_can_be_taken_for_the_current_design(session):
    session.pins.rename(session.slab.key, "this design")
    assert list(session.view.base.options.values()) == [0, session.slab.key, session.sleeper.key]


def test_table_1_is_pinned_in_one_click_and_figure_2_shown_in_another(session):
    session.view.table_1.param.trigger("clicks")
    assert {pin.design for pin in session.pins.pinned} == set(tig.PRESETS.values())
    session.view.figure_2.param.trigger("clicks")
    assert session.pins.alone
    assert session.asked == [True]


def test_where_there_is_no_room_for_table_1_nothing_changes(session):
    slab = tig.PRESETS["slab-track"]
    session.pins.add_all((slab.replace(wheel_mass=700.0 + n), "", None) for n in range(MOST_PINNED - 2))
    for button in (session.view.table_1, session.view.figure_2):
        button.param.trigger("clicks")
    assert len(session.pins.pinned) == MOST_PINNED
    assert not session.pins.alone
    assert session.asked == []


class Bar:
    """The bar above the sliders, and a clock that a test sets."""

    def __init__(self, make_pictures):
        self.inputs, self.pins, self.browser, self.now = DesignInputs(), Pins(), Browser(), 0.0
        definition = GainDefinition()
        assessment = Assessment(self.inputs, Outcome(), definition, self.pins, make_pictures())
        steps = Steps(self.inputs, definition, self.pins, assessment, clock=lambda: self.now)
        self.bar = DesignBar(self.inputs, self.pins, steps, self.browser)


@pytest.fixture
def bar(make_pictures):
    return Bar(make_pictures)


def test_a_drag_is_undone_in_one_step_and_redone(bar):
    for position, mass in enumerate((50.0, 60.0, 70.0)):
        bar.now = 0.1 * position
        bar.inputs.block_mass = mass
    bar.now = 10.0
    bar.inputs.wheel_mass = 700.0
    bar.bar.undo.param.trigger("clicks")
    assert (bar.inputs.block_mass, bar.inputs.wheel_mass) == (70.0, 880.0)
    bar.browser.undone += 1
    assert bar.inputs.to_design() == tig.PRESETS["booted-block-low-mass"]
    assert bar.bar.undo.disabled
    assert not bar.bar.redo.disabled
    bar.browser.redone += 1
    bar.bar.redo.param.trigger("clicks")
    assert (bar.inputs.block_mass, bar.inputs.wheel_mass) == (70.0, 700.0)
    assert bar.bar.redo.disabled


def test_quick_presses_of_the_keys_that_come_as_one_are_a_step_each(bar):
    for position, mass in enumerate((50.0, 60.0, 70.0)):
        bar.now = 10.0 * position
        bar.inputs.block_mass = mass
    bar.browser.undone += 2
    assert bar.inputs.block_mass == 50.0
    bar.browser.redone += 2
    assert bar.inputs.block_mass == 70.0
    # a count that nobody can have pressed ends all the same
    bar.browser.undone += 10**15
    assert bar.inputs.to_design() == tig.PRESETS["booted-block-low-mass"]


def test_a_preset_is_one_step(bar):
    bar.inputs.preset = "slab-track"
    bar.bar.undo.param.trigger("clicks")
    assert bar.inputs.preset == "booted-block-low-mass"
    assert bar.inputs.to_design() == tig.PRESETS["booted-block-low-mass"]
    assert bar.bar.undo.disabled


def test_a_lesson_sets_the_sliders_in_one_step(bar):
    before = bar.inputs.to_values()
    set_sliders(bar.inputs, {"preset": "booted-sleeper", "boot_stiffness": 20.0, "wheel_mass": 700.0})
    expected = tig.PRESETS["booted-sleeper"].replace(boot_stiffness=20e6, wheel_mass=700.0)
    assert bar.inputs.to_design() == expected
    assert bar.inputs.preset == "booted-sleeper"
    bar.bar.undo.param.trigger("clicks")
    assert bar.inputs.to_values() == before
    assert bar.bar.undo.disabled


def test_keys_without_a_step_do_nothing(bar):
    bar.browser.undone += 1
    bar.browser.redone += 1
    assert not bar.inputs.modified


def test_a_design_is_pinned_under_its_name_or_that_of_its_preset(bar):
    bar.bar.pin.param.trigger("clicks")
    bar.inputs.block_mass = 70.0
    bar.bar.pin.param.trigger("clicks")
    bar.bar.name_box.value = MARKUP
    bar.bar.pin.param.trigger("clicks")
    assert [pin.name for pin in bar.pins.pinned] == ["Booted block, low mass", "Design 1", MARKUP]
    assert bar.bar.name_box.value == ""
    assert bar.pins.pinned[1].design.block_mass == 70.0


def test_a_ninth_pin_is_refused_and_its_name_kept(bar):
    for _ in range(MOST_PINNED):
        bar.bar.pin.param.trigger("clicks")
    bar.bar.name_box.value = "one more"
    bar.bar.pin.param.trigger("clicks")
    assert len(bar.pins.pinned) == MOST_PINNED
    assert bar.bar.name_box.value == "one more"


class FakeExchange:
    def on_file(self, purpose, callback):
        """Take no file."""


def track_of(inputs, picture):
    """Return the tab Track of a solved design, without the response to a hammer."""
    outcome = Outcome(summary=picture)
    return Track(inputs, outcome, Measuring(), Shelf(), FakeExchange(), None, lambda _: None)


def test_a_rail_of_one_s_own_is_named_on_the_track(summary):
    inputs = DesignInputs()
    track = track_of(inputs, summary("slab-track"))
    track.look(active=True)
    assert not track.rail_name.visible
    inputs.take_given({"rail": "own"})
    assert (track.rail_name.visible, track.rail_name.value) == (True, "own")
    track.rail_name.value = "UIC 54, worn"
    assert inputs.to_design().rail.name == "UIC 54, worn"
    assert "UIC 54, worn" in track.drawing.object
    track.rail_name.value = "\n"
    assert track.rail_name.error_state
    assert inputs.to_design().rail.name == "UIC 54, worn"


def test_the_drawing_follows_the_sliders_while_it_is_in_sight(summary):
    inputs = DesignInputs()
    track = track_of(inputs, summary("slab-track"))
    assert track.drawing.object == ""
    track.look(active=True)
    inputs.block_mass = 222.0
    assert "222 kg" in track.drawing.object
    track.look(active=False)
    inputs.block_mass = 111.0
    assert "222 kg" in track.drawing.object
    inputs.two_stage = False
    track.look(active=True)
    assert "kg" in track.drawing.object
    assert "111 kg" not in track.drawing.object


def test_unlike_wheels_are_told_and_set_alike_as_one_change(session):
    view = session.view.likeness
    assert view.row.visible
    assert "unsprung wheel mass (450, 880 and 950 kg)" in view.text.object
    session.pins.choose_base(session.sleeper.key)
    changes = []
    session.pins.param.watch(lambda event: changes.append(event.new), "pinned")
    view.set_alike.param.trigger("clicks")
    assert len(changes) == 1
    assert {pin.design.wheel_mass for pin in session.pins.pinned} == {session.inputs.wheel_mass}
    assert [pin.name for pin in session.pins.pinned] == list(KEYS)
    assert session.pins[session.pins.base].name == KEYS[1]
    assert not {pin.key for pin in session.pins.pinned} & {session.slab.key, session.sleeper.key}
    assert not view.row.visible


def test_designs_that_differ_in_their_supports_alone_are_not_warned_of():
    block = tig.PRESETS["booted-block-low-mass"]
    assert likeness_words([block, block.replace(boot_stiffness=60e6, fastener_spacing=0.7)]) == ""
    other = block.replace(rail=tig.RAILS["49E1"], contact_stiffness=1e9)
    words = likeness_words([block, other])
    assert "contact stiffness (1000 and 1200 kN/mm) and rail (49E1 and 60)" in words


def test_names_of_rails_are_text_in_a_warning():
    block = tig.PRESETS["booted-block-low-mass"]
    own = block.replace(rail=dataclasses.replace(block.rail, name=MARKUP))
    results = [DesignResult(tig.PinnedDesign("one", design)) for design in (block, own)]
    warning = Likeness(None, SimpleNamespace(results=results))
    warning.show()
    assert "&lt;img" in warning.text.object
    assert "<img" not in warning.text.object


def test_hidden_designs_are_no_cause_for_a_warning(session):
    for pin in session.pins.pinned:
        session.pins.show(pin.key, shown=False)
    assert not session.view.likeness.row.visible


def test_insertion_gain_itself_is_drawn_beside_its_differences(session):
    gains = session.view.gains
    data = gains.curves.data
    np.testing.assert_array_equal(data["pin_8"], session.level("booted-block-low-mass"))
    np.testing.assert_array_equal(data["pin_1"], session.level("booted-sleeper"))
    assert gains.legend.listed == ("this design", *KEYS)
    assert gains.model.y_range.start <= min(data["pin_8"].min(), data["pin_1"].min())
    session.definition.summation = "coherent"
    assert gains.model.yaxis[0].axis_label == "IG, dB (coherent / line)"


def test_own_rails_and_curves_are_compared_in_words(fake_picture):
    curve = tig.StiffnessCurve([(5, 20e6, 0.1), (500, 30e6, 0.2)])
    plain = tig.PRESETS["booted-block-low-mass"]
    odd = plain.replace(boot_stiffness=curve, boot_loss_factor=None, rail=tig.Rail("worn", 58.0, 6e6))
    results = []
    for number, design in enumerate((plain, odd, plain.replace(boot_stiffness=300e6))):
        picture = fake_picture(design)
        record = tig.PinnedDesign(f"Design {number}", design, key=number + 1)
        results.append(DesignResult(record, picture, picture.solution.gain))
    table = table_html(results, results[0], ())
    rows = re.findall(r'<th scope="row">(.*?)</th>(.*?)</tr>', table)
    cells = {label: re.findall(r"<td>(.*?)</td>", row) for label, row in rows}
    assert cells["Boot stiffness, kN/mm"][1] == "measured at 2 frequencies, 5 to 500 Hz"
    assert cells["Boot stiffness, kN/mm"][2] == '300<span class="difference">+272</span>'
    assert cells["Boot loss factor"][1] == "in the stiffness table"
    assert cells["Rail section"] == ["60", "worn: 58 kg/m, 6 MN m²", "60"]
    assert "60 and worn: 58 kg/m, 6 MN m²" in likeness_words([each.design for each in results])


def test_statics_stand_side_by_side_and_only_extra_numbers_that_are_set():
    block = tig.PRESETS["booted-block-low-mass"]
    stated = block.replace(pad_static_stiffness=70e6, boot_static_stiffness=20e6, stiffness_frequency=10.0)
    load = tig.study.StaticLoad(100e3)
    results = [
        DesignResult(tig.PinnedDesign("one", design), statics=load.response(design))
        for design in (block, stated)
    ]
    text = table_html(results, results[0], [])
    first, second = (1e3 * each.statics.rail_deflection for each in results)
    assert "Under one wheel of 100 kN" in text
    assert f"<td>≥ {first:.2f}</td>" in text
    assert f'<td>{second:.2f}<span class="difference">+{second - first:.2f}</span></td>' in text
    assert "Stiffness stated at, Hz" in text
    same = table_html(
        [results[0], DesignResult(results[1].pinned, statics=results[0].statics)], results[0], []
    )
    assert f'<td>≥ {first:.2f}<span class="difference">0.0</span></td>' in same
    assert "Pad static stiffness" in text
    assert "Pad static stiffness" not in table_html(results[:1], results[0], [])
