"""Has Bokeh look up once what never changes about the defaults of its models.

Whatever reads a property that nobody set (when a model is made, walked through or sent) asks for its default.
Each time Bokeh gathers the overridden defaults along the class's ancestors, asks every part of a property's
type whether a default of it could change, and looks for a theme of the instance in a way that ends in an
exception. A page opens with 20,000 such questions: a quarter of its processor time.
"""

from types import FunctionType

from bokeh.core.has_props import HasProps
from bokeh.core.property.bases import ParameterizedProperty
from bokeh.core.property.descriptors import PropertyDescriptor
from bokeh.core.property.instance import InstanceDefault

_overridden = {}
"""Overridden defaults of a class, by the class; classes of models last as long as the process."""

_gather = HasProps._overridden_defaults.__func__
_ask_parts = ParameterizedProperty._may_have_unstable_default


def _overridden_defaults(cls):
    found = _overridden.get(cls)
    if found is None:
        found = _overridden[cls] = _gather(cls)
    return found


def _themed_values(self):
    return self.__dict__.get("__themed_values__")


def _is_unstable(cls, value):  # noqa: ARG001
    return isinstance(value, FunctionType | InstanceDefault)


def _may_have_unstable_default(self):
    found = self.__dict__.get("_trackig_unstable")
    if found is None:
        found = self._trackig_unstable = _ask_parts(self)
    return found


def install():
    """Have it do so in this process."""
    HasProps._overridden_defaults = classmethod(_overridden_defaults)
    HasProps.themed_values = _themed_values
    PropertyDescriptor.is_unstable = classmethod(_is_unstable)
    ParameterizedProperty._may_have_unstable_default = _may_have_unstable_default
