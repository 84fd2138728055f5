"""Neighbourhoods of 7 x 7 pixels: which of them belong to a region, as bits, and how far two are apart, in integers.

A picture here is int16 (h, w, 4) of values 0..255, laid out row by row, flat; weights are int16 (7, 32), flat: one for
each channel of 8 pixels, the eighth of which is 0 so that a row fills whole vector registers.  Integers make the sums
the same on every processor, whatever the order in which it adds.
"""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import numpy as np
from llvmlite import ir
from numba import njit, types
from numba.core import cgutils
from numba.extending import intrinsic

RADIUS, SIDE = 3, 7
ROW = 32  # values of a row of weights
FULL = np.uint64((1 << SIDE * SIDE) - 1)
WEIGHT = 8  # mean of the weights over 7 x 7 pixels

_LANES = ir.VectorType(ir.IntType(16), ROW)
_WIDE = ir.VectorType(ir.IntType(32), ROW)


@intrinsic
def ones(context, number):
    """How many bits of a uint64 are set: int32."""

    def emit(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        return builder.trunc(builder.ctpop(arguments[0]), ir.IntType(32))

    return types.int32(types.uint64), emit


def _lanes(context: Any, builder: Any, kind: Any, array: Any, at: Any) -> Any:
    """32 int16 values of a flat array from an index on."""
    data = context.make_array(kind)(context, builder, array).data
    pointer = builder.bitcast(builder.gep(data, [at]), _LANES.as_pointer())
    return builder.load(pointer, align=2)


def _sum_of_squares(context: Any, builder: Any, difference: Any, weights: Any) -> Any:
    weighted = builder.mul(difference, weights)
    products = builder.mul(builder.sext(difference, _WIDE), builder.sext(weighted, _WIDE))
    name = f"llvm.vector.reduce.add.v{ROW}i32"
    add = cgutils.get_or_insert_function(builder.module, ir.FunctionType(ir.IntType(32), [_WIDE]), name)
    return builder.call(add, [products])


@intrinsic
def row_apart(context, a, i, b, j, weights, k):
    """Sum of weights[k + t] (a[i + t] - b[j + t])^2 over t < 32: int32; all arrays int16, flat, 0 <= index."""
    signature = types.int32(a, types.intp, b, types.intp, weights, types.intp)

    def emit(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        kinds = signature.args
        one, other, weight = (_lanes(context, builder, kinds[n], arguments[n], arguments[n + 1]) for n in (0, 2, 4))
        return _sum_of_squares(context, builder, builder.sub(one, other), weight)

    return signature, emit


@intrinsic
def row_apart_within(context, a, i, b, j, weights, k, within):
    """As `row_apart`, but b counts only where `within[i + t]` is -1 (it is 0 elsewhere, and so is a)."""
    signature = types.int32(a, types.intp, b, types.intp, weights, types.intp, within)

    def emit(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        kinds = signature.args
        one, other, weight = (_lanes(context, builder, kinds[n], arguments[n], arguments[n + 1]) for n in (0, 2, 4))
        mask = _lanes(context, builder, kinds[6], arguments[6], arguments[1])
        return _sum_of_squares(context, builder, builder.sub(one, builder.and_(other, mask)), weight)

    return signature, emit


@njit(cache=True, nogil=True)
def region_bits(mask, out):
    """Bits of the 7 x 7 pixels around each that lie in the region, pixel (dy, dx) as bit 7 (dy + 3) + dx + 3.

    `mask`: uint8 0 or 1 (h, w); `out`: uint64 (h, w), all but its outermost three rows and columns are written.
    """
    height, width = mask.shape
    rows = np.zeros((height, width), np.uint64)
    for y in range(height):
        given, row = mask[y], rows[y]
        for dx in range(SIDE):
            for x in range(RADIUS, width - RADIUS):
                row[x] |= np.uint64(given[x + dx - RADIUS]) << np.uint64(dx)
    for y in range(RADIUS, height - RADIUS):
        target = out[y]
        for x in range(RADIUS, width - RADIUS):
            target[x] = np.uint64(0)
        for dy in range(SIDE):
            row = rows[y + dy - RADIUS]
            for x in range(RADIUS, width - RADIUS):
                target[x] |= row[x] << np.uint64(SIDE * dy)


@lru_cache(maxsize=8)
def weights(side: int = SIDE, spread: float = 2.0) -> np.ndarray:
    """A Gaussian of `spread` pixels over `side` x `side` pixels (3, 5 or 7): int16 (7 * 32), read-only, summing to
    about 49 * WEIGHT for each channel."""
    y, x = np.mgrid[-RADIUS : RADIUS + 1, -RADIUS : RADIUS + 1]
    plane = np.exp(-(x * x + y * y) / (2.0 * spread * spread)) * ((abs(x) <= side // 2) & (abs(y) <= side // 2))
    plane = np.maximum(np.rint(plane * (WEIGHT * plane.size / plane.sum())), plane > 0.0)
    out = np.zeros((SIDE, ROW // 4, 4), np.int16)
    out[:, :SIDE] = plane[:, :, None]
    flat = out.reshape(-1)
    flat.flags.writeable = False
    return flat


@lru_cache(maxsize=8)
def square_bits(side: int) -> np.uint64:
    """The bits of the inner `side` x `side` pixels (3, 5 or 7)."""
    near = range(RADIUS - side // 2, RADIUS + side // 2 + 1)
    return np.uint64(sum(1 << SIDE * y + x for y in near for x in near))
