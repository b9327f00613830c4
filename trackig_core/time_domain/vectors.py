"""Vectors of doubles in compiled code: a kernel loads, computes with and stores a row of lanes as one value.

Left to itself the compiler vectorises only short loops over few arrays: a loop that touches all that a
bay of track consists of, it leaves scalar. With vectors as values, one sweep along the track reads
and writes each quantity once per time step. LLVM maps them to what the processor has: one register of 512
bits, two of 256, four of 128.

``+``, ``-`` and ``*`` work between vectors. In the interpreter, where these functions do not run, slices of
NumPy arrays take the part of vectors.
"""

import operator
from collections.abc import Callable
from typing import Any, TypeAlias

from llvmlite import ir
from numba import types
from numba.extending import intrinsic, models, overload, register_model

WIDTH = 8
"""Doubles in a vector [-]: a cache line."""

_VECTOR = ir.VectorType(ir.DoubleType(), WIDTH)
_NOTHING = ir.Constant(_VECTOR, None)
_INTEGER = ir.IntType(32)
_BYTES_PER_DOUBLE = 8


Vector: TypeAlias = Any
"""A vector, in annotations: a value of Numba's in compiled code, a slice of an array in the interpreter."""


class VectorType(types.Type):
    """Numba's type of a vector of :data:`WIDTH` doubles."""


VECTOR: Any = VectorType(f"vector of {WIDTH}")

_in_compiled_code: Callable[[Callable[..., Any]], Any] = intrinsic


@register_model(VectorType)
class _VectorModel(models.PrimitiveModel):
    """A vector is held in registers, as LLVM's own vector."""

    def __init__(self, manager: Any, kind: VectorType) -> None:
        super().__init__(manager, kind, _VECTOR)  # type: ignore[no-untyped-call]


def _pointer(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
    array = context.make_array(signature.args[0])(context, builder, arguments[0])
    return builder.bitcast(builder.gep(array.data, [arguments[1]]), _VECTOR.as_pointer())


@_in_compiled_code
def load(_typing: Any, array: Any, place: Any) -> Any:
    """Return the vector that begins at a place of a contiguous array; no bounds are checked."""

    def code(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        vector = builder.load(_pointer(context, builder, signature, arguments))
        vector.align = _BYTES_PER_DOUBLE
        return vector

    return VECTOR(array, types.intp), code


@_in_compiled_code
def store(_typing: Any, array: Any, place: Any, vector: Any) -> Any:
    """Store a vector from a place of a contiguous array on; no bounds are checked."""

    def code(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        stored = builder.store(arguments[2], _pointer(context, builder, signature, arguments))
        stored.align = _BYTES_PER_DOUBLE
        return context.get_dummy_value()

    return types.none(array, types.intp, VECTOR), code


@_in_compiled_code
def spread(_typing: Any, number: Any) -> Any:
    """Return a vector all of whose lanes hold one number."""

    def code(_context: Any, builder: Any, _signature: Any, arguments: Any) -> Any:
        return _rearranged(builder, _replaced(builder, _NOTHING, arguments[0], 0), [0] * WIDTH)

    return VECTOR(types.float64), code


@_in_compiled_code
def first_lane(_typing: Any, number: Any) -> Any:
    """Return a vector whose first lane holds a number, and the others zero."""

    def code(_context: Any, builder: Any, _signature: Any, arguments: Any) -> Any:
        return _replaced(builder, _NOTHING, arguments[0], 0)

    return VECTOR(types.float64), code


@_in_compiled_code
def one_lane_up(_typing: Any, vector: Any, number: Any) -> Any:
    """Return a vector moved by one lane: what stood in lane 0 stands in lane 1, and a number in lane 0."""

    def code(_context: Any, builder: Any, _signature: Any, arguments: Any) -> Any:
        moved = _rearranged(builder, arguments[0], [0, *range(WIDTH - 1)])
        return _replaced(builder, moved, arguments[1], 0)

    return VECTOR(VECTOR, types.float64), code


@_in_compiled_code
def one_lane_down(_typing: Any, vector: Any, number: Any) -> Any:
    """Return a vector moved by one lane: what stood in lane 1 stands in lane 0, and a number in the last."""

    def code(_context: Any, builder: Any, _signature: Any, arguments: Any) -> Any:
        moved = _rearranged(builder, arguments[0], [*range(1, WIDTH), 0])
        return _replaced(builder, moved, arguments[1], WIDTH - 1)

    return VECTOR(VECTOR, types.float64), code


def _rearranged(builder: Any, vector: Any, lanes: list[int]) -> Any:
    """Return a vector whose lanes are those of another, given by number."""
    return builder.shuffle_vector(vector, vector, ir.Constant(ir.VectorType(_INTEGER, WIDTH), lanes))


def _replaced(builder: Any, vector: Any, number: Any, lane: int) -> Any:
    """Return a vector one lane of which holds a number instead."""
    return builder.insert_element(vector, number, ir.Constant(_INTEGER, lane))


def _between_vectors(operation: Callable[[Any, Any], Any], instruction: str) -> None:
    """Let compiled code apply an operator to two vectors."""

    @_in_compiled_code
    def compute(_typing: Any, left: Any, right: Any) -> Any:
        def code(_context: Any, builder: Any, _signature: Any, arguments: Any) -> Any:
            return getattr(builder, instruction)(*arguments)

        return VECTOR(VECTOR, VECTOR), code

    @overload(operation)
    def choose(left: Any, right: Any) -> Any:
        def implementation(left: Any, right: Any) -> Any:
            return compute(left, right)

        both = isinstance(left, VectorType) and isinstance(right, VectorType)
        return implementation if both else None


_between_vectors(operator.add, "fadd")
_between_vectors(operator.sub, "fsub")
_between_vectors(operator.mul, "fmul")
