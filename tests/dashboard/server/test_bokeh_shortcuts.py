"""Defaults of models are what Bokeh finds, themes and changeable ones included, and are looked up once."""

import re
from functools import partial

import pytest
from bokeh.core.has_props import HasProps
from bokeh.core.property.bases import ParameterizedProperty
from bokeh.core.property.descriptors import PropertyDescriptor, UnsetValueError
from bokeh.core.property.vectorization import Expr
from bokeh.events import ButtonClick
from bokeh.model import model as model_module
from bokeh.model import util as model_util
from bokeh.model.util import collect_models
from bokeh.models import (
    Button,
    ColumnDataSource,
    CumSum,
    CustomJS,
    FixedTicker,
    LinearAxis,
    Model,
    Plot,
)
from bokeh.settings import settings
from bokeh.util import callback_manager

from dashboard.server import bokeh_shortcuts

REPLACED = (
    (HasProps, "_overridden_defaults"),
    (HasProps, "themed_values"),
    (PropertyDescriptor, "is_unstable"),
    (ParameterizedProperty, "_may_have_unstable_default"),
    (ParameterizedProperty, "__str__"),
    (callback_manager, "_check_callback"),
    (callback_manager, "_nargs"),
    (PropertyDescriptor, "_get_default"),
    (model_util, "visit_value_and_its_immediate_references"),
    (model_module, "visit_value_and_its_immediate_references"),
    (Model, "ref"),
)


@pytest.fixture
def install(monkeypatch):
    """Return what installs the shortcuts; Bokeh's own way is back after the test."""
    for owner, name in REPLACED:
        monkeypatch.setattr(owner, name, owner.__dict__[name])
    yield bokeh_shortcuts.install
    settings.perform_document_validation.unset_value()


def defaults(kind):
    """Return each property's default, and whether it may change, of a kind of models."""
    made = kind()
    found = {name: kind.lookup(name) for name in kind.properties() - {"id"}}
    return {
        name: (without_identity(repr(each.class_default(kind))), each.has_unstable_default(made))
        for name, each in found.items()
    }


def without_identity(text):
    return re.sub(r"id=[^,)]+|0x[0-9a-f]+", "", text)


@pytest.mark.filterwarnings("ignore")
def test_defaults_of_all_models_are_what_bokeh_finds(install):
    kinds = [
        each for each in Model.model_class_reverse_map.values() if each.__module__.startswith("bokeh.models")
    ]
    before = [defaults(each) for each in kinds]
    install()
    assert len(kinds) > 200
    for kind, expected in zip(kinds, before, strict=True):
        # the second answer comes from what was noted at the first
        assert defaults(kind) == defaults(kind) == expected, kind


def test_models_share_no_default_that_may_change(install):
    install()
    one, other = ColumnDataSource(), ColumnDataSource()
    one.data["x"] = [1.0]
    assert dict(other.data) == {}
    assert Plot().x_range is not Plot().x_range


def test_values_that_were_never_set_are_what_bokeh_finds(install):
    def value(model, name):
        try:
            return without_identity(repr(getattr(model, name)))
        except UnsetValueError:
            return "unset"

    def values():
        made = [kind() for kind in (ColumnDataSource, LinearAxis, Plot, Button)]
        return [{name: value(each, name) for name in sorted(each.properties() - {"id"})} for each in made]

    before = values()
    install()
    assert values() == values() == before
    button = Button(label="Set")
    assert (button.label, Button().label) == ("Set", before[-1]["label"].strip("'"))


def test_references_are_found_wherever_they_stand(install):
    def found():
        plots = [Plot() for _ in range(4)]
        source = ColumnDataSource(
            tags=[{"nested": [1, "x", None, True, (2.5, plots[0])]}, Expr(expr=CumSum())]
        )
        source.js_on_change("data", CustomJS(args={"one": plots[1]}))
        held = [plots[2], (LinearAxis(ticker=FixedTicker()), {"a": plots[3]}), source]
        return sorted(type(each).__name__ for each in collect_models(*held))

    before = found()
    install()
    assert found() == before
    assert before.count("Plot") == 4
    assert {"CumSum", "CustomJS", "FixedTicker"} <= {*before}


def test_types_are_told_as_bokeh_tells_them(install):
    def told():
        return [str(Plot.lookup(name).property) for name in sorted(Plot.properties())]

    before = told()
    install()
    assert told() == told() == before


def test_callbacks_that_do_not_fit_are_refused_still(install):
    class Watcher:
        def note(self, page, attr, old, new):
            pass

    install()
    plot = Plot()
    for watcher in (Watcher(), Watcher()):
        plot.on_change("name", partial(watcher.note, "page"))
        with pytest.raises(ValueError, match="must have signature"):
            plot.on_change("name", watcher.note)
        with pytest.raises(ValueError, match="must have signature"):
            plot.on_change("name", partial(watcher.note, "page", "attr"))


def test_callbacks_get_the_event_that_they_ask_for(install):
    class Watcher:
        def __init__(self):
            self.noted = []

        def note(self, page, event=None):
            self.noted.append((page, event))

        def note_event(self, page, event):
            self.noted.append((page, event))

    install()
    for watcher in (Watcher(), Watcher()):
        button = Button()
        button.on_event(ButtonClick, partial(watcher.note, "a"), partial(watcher.note_event, "b"))
        click = ButtonClick(button)
        button._trigger_event(click)
        assert watcher.noted == [("a", None), ("b", click)]


def test_models_are_referred_to_by_their_identity(install):
    install()
    one, other = Plot(), Plot()
    for _ in range(2):
        assert one.ref == {"id": one.id}
        assert other.ref == {"id": other.id}
    assert one.clone().ref["id"] != one.id


def test_a_theme_comes_and_goes(install):
    install()
    axis, plain = LinearAxis(), LinearAxis().axis_label_text_font_size
    axis.apply_theme({"axis_label_text_font_size": "31px"})
    assert axis.axis_label_text_font_size == "31px"
    assert LinearAxis().axis_label_text_font_size == plain
    axis.unapply_theme()
    axis.apply_theme({})
    assert axis.axis_label_text_font_size == plain
