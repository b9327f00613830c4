"""Has Bokeh look up once what never changes about its models, defaults above all.

Whatever reads a property that nobody set (when a model is made, walked through or sent) asks for its default.
Each time Bokeh gathers the overridden defaults along the class's ancestors, asks every part of a property's
type whether a default of it could change, and looks for a theme of the instance in a way that ends in an
exception. A page opens with 20,000 such questions: a quarter of its processor time. A tab that is opened adds
as many, since all models of the page are looked through for references to others each time that it grows.

Each message begins with the references to all models of the page, made anew; each value that is converted has
its property's type put into words first, in case it were refused; and each of Panel's callbacks has its
signature looked through, when it is handed over and at each event. Each page is searched for faults of its
layout, which is what tests are for.
"""

from functools import cached_property, partial
from itertools import chain
from types import FunctionType

from bokeh.core.has_props import HasProps
from bokeh.core.property.bases import ParameterizedProperty
from bokeh.core.property.descriptors import PropertyDescriptor
from bokeh.core.property.instance import InstanceDefault
from bokeh.model import Model
from bokeh.model import model as model_module
from bokeh.model import util as model_util
from bokeh.settings import settings
from bokeh.util import callback_manager
from bokeh.util.dataclasses import entries, is_dataclass

_overridden = {}
"""Overridden defaults of a class, by the class; classes of models last as long as the process."""

_gather = HasProps._overridden_defaults.__func__
_ask_parts = ParameterizedProperty._may_have_unstable_default
_put_into_words = ParameterizedProperty.__str__
_check_signature = callback_manager._check_callback
_count_arguments = callback_manager._nargs
_refer = Model.ref.fget

_look_up_default = PropertyDescriptor._get_default
_visit_references = model_util.visit_immediate_value_references

_UNCHANGING = {bool, int, float, str, type(None)}

_defaults = {}
"""Defaults that cannot change, by class and name of the property."""

_checked = set()
"""Methods, with what they are given beforehand and what they are called with, whose signature fits."""

_counted = {}
"""Arguments that are wanting, by method and what it is given beforehand."""


def _overridden_defaults(cls):
    found = _overridden.get(cls)
    if found is None:
        found = _overridden[cls] = _gather(cls)
    return found


def _themed_values(self):
    return self.__dict__.get("__themed_values__")


def _is_unstable(cls, value):  # noqa: ARG001
    return isinstance(value, FunctionType | InstanceDefault)


def _get_default(self, obj):
    if _themed_values(obj) is not None:
        return _look_up_default(self, obj)
    kind = (type(obj), self.name)
    try:
        return _defaults[kind]
    except KeyError:
        default = _look_up_default(self, obj)
    if type(default) in _UNCHANGING and not self.has_unstable_default(obj):
        _defaults[kind] = default
    return default


def _visit(value, visitor):
    kind = type(value)
    if kind in _UNCHANGING:
        return
    if issubclass(kind, list | tuple):
        for each in value:
            _visit(each, visitor)
    elif issubclass(kind, dict):
        for each in chain(value.keys(), value.values()):
            _visit(each, visitor)
    elif issubclass(kind, Model):
        visitor(value)
    elif issubclass(kind, HasProps):
        _visit_references(value, visitor)
    elif is_dataclass(value):
        for _, each in entries(value):
            _visit(each, visitor)


def _may_have_unstable_default(self):
    found = self.__dict__.get("_trackig_unstable")
    if found is None:
        found = self._trackig_unstable = _ask_parts(self)
    return found


def _words(self):
    found = self.__dict__.get("_trackig_words")
    if found is None:
        found = self._trackig_words = _put_into_words(self)
    return found


def _given_beforehand(callback):
    """Return which method it is and how much it was given beforehand, or None for what is no such method."""
    if isinstance(callback, partial) and hasattr(callback.func, "__func__"):
        return (callback.func.__func__, len(callback.args), *callback.keywords)
    return None


def _check_callback(callback, fargs, what="Callback functions"):
    kind = _given_beforehand(callback)
    if kind is None or (*kind, *fargs) not in _checked:
        _check_signature(callback, fargs, what)
        if kind is not None:
            _checked.add((*kind, *fargs))


def _nargs(callback):
    kind = _given_beforehand(callback)
    if kind is None:
        return _count_arguments(callback)
    if kind not in _counted:
        _counted[kind] = _count_arguments(callback)
    return _counted[kind]


def install():
    """Have it do so in this process."""
    HasProps._overridden_defaults = classmethod(_overridden_defaults)
    HasProps.themed_values = _themed_values
    PropertyDescriptor.is_unstable = classmethod(_is_unstable)
    PropertyDescriptor._get_default = _get_default
    for module in (model_util, model_module):
        module.visit_value_and_its_immediate_references = _visit
    ParameterizedProperty._may_have_unstable_default = _may_have_unstable_default
    ParameterizedProperty.__str__ = _words
    callback_manager._check_callback = _check_callback
    callback_manager._nargs = _nargs
    settings.perform_document_validation = False
    Model.ref = cached_property(_refer)
    Model.ref.__set_name__(Model, "ref")
