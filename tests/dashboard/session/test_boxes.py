"""What stands in boxes comes back with a page that is loaded anew, and nothing else comes in that way."""

import json

import panel as pn
import panel_material_ui as pmui
import pytest

from dashboard.session.boxes import MOST_TYPED, Boxes


def widgets():
    return {
        "share": pmui.TextInput(value="15", max_length=40),
        "ticked": pmui.Checkbox(),
        "samples": pn.widgets.Select(options={"1 000": 1000, "10 000": 10_000}, value=10_000),
        "free": pn.widgets.CheckBoxGroup(options={"Pad": "pad", "Boot": "boot"}, value=["pad"]),
    }


OTHER = {"share": "12,5", "ticked": True, "samples": 1000, "free": ["boot"]}


def change(boxes, values):
    for name, value in values.items():
        boxes[name].value = value


@pytest.fixture
def there():
    return widgets()


@pytest.fixture
def kept(there):
    boxes = Boxes()
    boxes.keep(**there)
    return boxes


def test_what_is_as_at_first_is_not_kept(kept, there):
    assert kept.typed == ""
    before = {name: box.value for name, box in there.items()}
    change(there, OTHER)
    assert json.loads(kept.typed) == OTHER
    change(there, before)
    assert kept.typed == ""


def test_what_was_typed_comes_back_into_boxes_that_are_there(kept, there):
    change(there, OTHER)
    again, after = widgets(), Boxes()
    after.keep(**again)
    after.put_back(kept.typed)
    assert {name: box.value for name, box in again.items()} == OTHER
    assert after.typed == kept.typed


def test_what_was_typed_waits_for_a_box_that_is_made_later_and_is_not_lost_meanwhile(kept, there):
    change(there, OTHER)
    again, after = widgets(), Boxes()
    after.put_back(kept.typed)
    assert json.loads(after.typed) == OTHER
    after.keep(**again)
    assert {name: box.value for name, box in again.items()} == OTHER
    assert after.typed == kept.typed


def test_a_box_that_changes_another_leaves_that_as_it_stood():
    def made():
        boxes, every, one = Boxes(), pmui.TextInput(value="10"), pmui.TextInput(value="10")
        every.param.watch(lambda event: one.param.update(value=event.new), "value")
        boxes.keep(every=every, one=one)
        return boxes, every, one

    before, every, one = made()
    every.value = "20"
    one.value = "10"
    after, _, one = made()
    after.put_back(before.typed)
    assert one.value == "10"


def test_what_was_chosen_waits_until_it_is_offered_unless_something_else_is_chosen():
    for chosen, expected in ((None, "ground"), ("pad", "pad")):
        box = pn.widgets.Select(options={"Boot": "boot", "Pad": "pad"}, value="boot")
        boxes = Boxes()
        boxes.keep(across=box)
        boxes.put_back('{"across": "ground"}')
        assert box.value == "boot"
        if chosen is not None:
            box.value = chosen
        box.options = {**box.options, "Ground": "ground"}
        boxes.put_waiting()
        assert box.value == expected


@pytest.mark.parametrize(
    "typed",
    [
        "{",
        "7",
        "[" * 10_000,
        json.dumps({"share": 7, "ticked": 1, "samples": "1000", "free": "boot"}),
        json.dumps({"share": "1" * 41, "ticked": "", "samples": True, "free": ["boot", "rail"]}),
        json.dumps({"share": None, "ticked": None, "samples": [1000], "free": [["boot"]]}),
        json.dumps({"share": {}, "ticked": [], "samples": {}, "free": {"boot": 1}}),
        json.dumps({"share": "1", "none": "x" * MOST_TYPED}),
    ],
)
def test_nonsense_from_a_browser_stands_in_no_box(kept, there, typed):
    before = {name: box.value for name, box in there.items()}
    kept.put_back(typed)
    assert {name: box.value for name, box in there.items()} == before
