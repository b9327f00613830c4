"""A test house's table becomes the pad or boot only when it is used, and never by a factor of 1000."""

from pathlib import Path

import numpy as np
import pytest

import trackig_core as tig
from dashboard.compute.workers import AT_REST, key_of
from dashboard.session.inputs import values_of
from dashboard.session.measuring import Measuring
from dashboard.session.special import input_text
from dashboard.views.measured import Measured
from dashboard.views.sidebar import chips

TABLES = Path(__file__).parents[2] / "data" / "measured_stiffness"
FINITE_ELEMENT, PAD, POLYURETHANE = (
    (TABLES / f"{name}.csv").read_bytes() for name in ("finite_element_pad", "pad_1_to_30_hz", "polyurethane")
)


class FakeExchange:
    def __init__(self):
        self.openers = {}

    def on_file(self, purpose, callback):
        """Take the callback of a purpose."""
        self.openers[purpose] = callback


@pytest.fixture
def editor(session):
    made = Measured(session.inputs, Measuring(), FakeExchange())
    made.session = session
    return made


def design_of(editor):
    return editor.session.inputs.to_design()


def test_a_unit_that_no_pad_has_is_asked_before_anything_is_used(editor):
    editor.take(FINITE_ELEMENT)
    assert editor.use.disabled
    assert "In N/mm, the stiffness is" in editor.words.object
    assert "are the figures in N/m?" in editor.words.object
    editor.unit.value = "N/m"
    assert not editor.use.disabled
    assert "Stiffness in N/m, as chosen." in editor.words.object
    editor.use.clicks += 1
    curve = design_of(editor).pad_stiffness
    assert curve.points[0] == (199.5, 3.86e9, 0.1)
    assert len(curve.points) == 200
    assert design_of(editor).pad_loss_factor is None


def test_a_unit_that_is_confirmed_is_taken_as_it_is(editor):
    editor.take(FINITE_ELEMENT)
    editor.unit.value = "N/mm"
    assert not editor.use.disabled
    assert editor._measuring.reading.curve.points[0][1] == 3.86e12


@pytest.mark.parametrize(
    ("data", "part", "extrapolated"),
    [
        (PAD, "pad", "Bands from 31.5 Hz on rest on extrapolation (13 of 21)."),
        (POLYURETHANE, "boot", "Bands up to 8 Hz rest on extrapolation (3 of 21)."),
    ],
    ids=["pad", "polyurethane"],
)
def test_a_table_is_previewed_and_then_used(editor, data, part, extrapolated):
    editor.part.value = part
    before = design_of(editor)
    editor.take(data)
    assert design_of(editor) == before
    assert not editor.use.disabled
    assert editor.use.label == f"Use for the {part}"
    assert extrapolated in editor.words.object
    curve = editor._measuring.reading.curve
    assert tig.analysis.curve_fit(curve).error_at_points < 0.05
    np.testing.assert_array_equal(editor.stiffness.points.data["frequency"], [p[0] for p in curve.points])
    editor.use.clicks += 1
    changes = {f"{part}_stiffness": curve, f"{part}_loss_factor": None}
    assert design_of(editor) == before.replace(**changes)
    assert extrapolated in editor.words.object
    assert (editor.use.visible, editor.remove.visible) == (False, True)
    editor.remove.clicks += 1
    assert design_of(editor) == before
    editor.session.snapshot.steps.undo()
    assert design_of(editor) == before.replace(**changes)


def test_a_used_table_is_saved_and_opened_with_the_study(editor, summary):
    editor.take(PAD)
    editor.use.clicks += 1
    other = type(editor.session)(summary)
    other.snapshot.open(editor.session.snapshot.study().to_toml())
    assert other.inputs.to_design() == design_of(editor)


def test_the_preload_is_said_kept_and_named_wherever_the_curve_is(editor, summary):
    editor.take(b"# EN 17495, preload: 30 kN\n" + PAD)
    assert "Measured at 3 frequencies, 1 to 30 Hz, preload 30 kN." in editor.words.object
    editor.use.clicks += 1
    assert "preload 30 kN" in editor.words.object
    design = design_of(editor)
    assert design.pad_stiffness.preload == 30e3
    assert input_text(design, "pad_stiffness") == "measured at 3 frequencies, 1 to 30 Hz, preload 30 kN"
    assert chips(editor.session.inputs)["pad_stiffness"] == input_text(design, "pad_stiffness")
    other = type(editor.session)(summary)
    other.snapshot.open(editor.session.snapshot.study().to_toml())
    assert other.inputs.to_design() == design
    # another preload is another design, which is not solved again
    editor.take(b"# preload: 40 kN\n" + PAD)
    editor.use.clicks += 1
    assert design_of(editor).pad_stiffness.preload == 40e3
    assert key_of(design_of(editor), AT_REST) == key_of(design, AT_REST)


def test_an_assumed_unit_is_named(editor):
    editor.pasted.value = "10 605.7 0.151\n30 671 0.151"
    editor.read.clicks += 1
    assert "Stiffness in kN/mm, assumed: the table names none." in editor.words.object


@pytest.mark.parametrize("data", [b"", b"\xff\xfe", b"nothing", b"1,2", b"<script>alert(1)</script>"])
def test_what_is_no_table_is_refused_and_what_was_there_stays(editor, data):
    editor.take(PAD)
    reading = editor._measuring.reading
    editor.take(data)
    assert "Not read: " in editor.message.object
    assert "<script" not in editor.message.object
    assert editor._measuring.reading is reading


def test_what_is_discarded_leaves_the_design(editor):
    before = design_of(editor)
    editor.take(PAD)
    editor.discard.clicks += 1
    assert design_of(editor) == before
    assert "Nothing is measured of the pad" in editor.words.object


def test_a_single_stage_track_has_no_boot_to_measure(editor):
    editor.session.inputs.take(values_of(tig.PRESETS["slab-track"]))
    editor.part.value = "boot"
    editor.take(PAD)
    assert editor.use.disabled
    assert "no boots" in editor.words.object


def test_a_measured_loss_factor_alone_is_shown_and_can_be_removed(editor):
    curve = tig.LossFactorCurve([(1, 0.1), (50, 0.15), (900, 0.2)])
    before = design_of(editor)
    editor.session.inputs.take(values_of(before.replace(pad_loss_factor=curve)))
    assert [each.model.visible for each in (editor.stiffness, editor.loss_factor)] == [False, True]
    np.testing.assert_array_equal(editor.loss_factor.points.data["value"], [0.1, 0.15, 0.2])
    editor.remove.clicks += 1
    assert design_of(editor) == before


def test_points_outside_the_fit_are_in_brackets(editor):
    editor.take(PAD)
    rows = editor.table.object.split("<tr>")[2:]
    assert rows[0].startswith("<td>1</td><td>310.4</td><td>(+62.5)</td><td>0.151</td>")
    assert rows[1].startswith("<td>10</td><td>605.7</td><td>−1.5</td>")
