"""Asks for what a kernel reads soon.

Rows of a stroke are short and lie far apart, so that nearly each of them waits for memory: where the next ones are
asked for meanwhile, the processor waits for several at once.  No value depends on it.
"""

from __future__ import annotations

from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic

from engine.numeric.kernel import Array, Int, Low, inner_uncounted

LINE = 64  # bytes that come at once
_BYTE, _NUMBER = ir.IntType(8), ir.IntType(32)
_READ, _STAYS, _DATA = 0, 3, 1  # as LLVM tells them


@intrinsic  # type: ignore[untyped-decorator]
def _ask(context: Low, array: Low, plane: Low, row: Low, column: Low) -> Low:
    """Asks for the bytes around an element of planes, or of one plane, which may lie outside: none is read."""

    def emit(context: Low, builder: Low, signature: Low, arguments: Low) -> Low:
        there = context.make_array(signature.args[0])(context, builder, arguments[0])
        place = builder.ptrtoint(there.data, ir.IntType(64))
        steps = cgutils.unpack_tuple(builder, there.strides)
        for index, step in zip(arguments[-len(steps) :], steps, strict=True):
            place = builder.add(place, builder.mul(index, step))
        kind = ir.FunctionType(ir.VoidType(), [_BYTE.as_pointer(), _NUMBER, _NUMBER, _NUMBER])
        ask = cgutils.get_or_insert_function(builder.module, kind, "llvm.prefetch.p0i8")
        told = [ir.Constant(_NUMBER, value) for value in (_READ, _STAYS, _DATA)]
        builder.call(ask, [builder.inttoptr(place, _BYTE.as_pointer()), *told])
        return context.get_dummy_value()

    return types.void(array, types.intp, types.intp, types.intp), emit


@inner_uncounted
def ask(data: Array, plane: Int, row: Int, first: Int, last: Int) -> None:
    """Asks for columns of a row of planes (C, h, w), or of a plane (h, w)."""
    step = LINE // data.itemsize
    for x in range(first, last + step - 1, step):
        _ask(data, plane, row, min(x, last - 1))
