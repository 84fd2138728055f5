"""Neighbourhoods of 7 x 7 pixels: which of them belong to a region, as bits, and how far two are apart, in integers.

A picture here is int16 (h, w, 4) of values 0..255, laid out row by row, flat; weights are int16 (7, 32), flat: one for
each channel of 8 pixels, the eighth of which is 0 so that a row fills whole vector registers.  Integers make the sums
the same on every processor, whatever the order in which it adds.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic

from engine.numeric.elementary import exp, mapped
from engine.numeric.kernel import Low, kernel

RADIUS, SIDE = 3, 7
ROW = 32  # values of a row of weights
FULL = np.uint64((1 << SIDE * SIDE) - 1)
WEIGHT = 8  # mean of the weights over 7 x 7 pixels

_MIDDLE, _OTHERS = (2, 3, 4), (0, 1, 5, 6)
_LANES = ir.VectorType(ir.IntType(16), ROW)
_WIDE = ir.VectorType(ir.IntType(32), ROW)


@intrinsic  # type: ignore[untyped-decorator]
def ones(context: Low, number: Low) -> Low:
    """Tells how many bits of a uint64 are set: int32."""

    def emit(context: Low, builder: Low, signature: Low, arguments: Low) -> Low:
        return builder.trunc(builder.ctpop(arguments[0]), ir.IntType(32))

    return types.int32(types.uint64), emit


def _lanes(context: Low, builder: Low, kind: Low, array: Low, at: Low) -> Low:
    """32 int16 values of a flat array from an index on."""
    data = context.make_array(kind)(context, builder, array).data
    pointer = builder.bitcast(builder.gep(data, [at]), _LANES.as_pointer())
    return builder.load(pointer, align=2)


def _weighted_squares(builder: Low, difference: Low, weights: Low) -> Low:
    weighted = builder.mul(difference, weights)
    return builder.mul(builder.sext(difference, _WIDE), builder.sext(weighted, _WIDE))


def _summed(builder: Low, products: Low) -> Low:
    name = f"llvm.vector.reduce.add.v{ROW}i32"
    add = cgutils.get_or_insert_function(builder.module, ir.FunctionType(ir.IntType(32), [_WIDE]), name)
    return builder.call(add, [products])


def _apart_over(rows: tuple[int, ...], within: bool) -> Low:
    """Tells how far some of the rows of two neighbourhoods are apart, which are added up in one register."""

    def emit(context: Low, builder: Low, signature: Low, arguments: Low) -> Low:
        a, i, a_row, b, j, b_row, weights, k, *care = arguments
        kinds, total = signature.args, None

        def lanes(n: int, array: Low, first: Low, step: Low, r: int) -> Low:
            at = builder.add(first, builder.mul(step, ir.Constant(step.type, r)))
            return _lanes(context, builder, kinds[n], array, at)

        for r in rows:
            one, other = lanes(0, a, i, a_row, r), lanes(3, b, j, b_row, r)
            if care:
                other = builder.and_(other, lanes(8, care[0], i, a_row, r))
            weight = lanes(6, weights, k, ir.Constant(k.type, ROW), r)
            products = _weighted_squares(builder, builder.sub(one, other), weight)
            total = products if total is None else builder.add(total, products)
        return _summed(builder, total)

    places = types.intp, types.intp
    if within:

        @intrinsic  # type: ignore[untyped-decorator]
        def apart(
            context: Low, a: Low, i: Low, a_row: Low, b: Low, j: Low, b_row: Low, weights: Low, k: Low, care: Low
        ) -> Low:
            return types.int32(a, *places, b, *places, weights, types.intp, care), emit

    else:

        @intrinsic  # type: ignore[untyped-decorator]
        def apart(context: Low, a: Low, i: Low, a_row: Low, b: Low, j: Low, b_row: Low, weights: Low, k: Low) -> Low:
            return types.int32(a, *places, b, *places, weights, types.intp), emit

    return apart


# Sum of weights[k + 32 r + t] (a[i + r a_row + t] - b[j + r b_row + t])^2 over t < 32 and the three rows r in the
# middle of a neighbourhood, or over the four others: int32; all arrays int16, flat, 0 <= index.  Those in the middle
# weigh most: they may tell that the others need not be looked at.
middle_apart, others_apart = _apart_over(_MIDDLE, False), _apart_over(_OTHERS, False)
# The same, but b counts only where `care[i + r a_row + t]` is -1 (it is 0 elsewhere, and so is a).
middle_apart_within, others_apart_within = _apart_over(_MIDDLE, True), _apart_over(_OTHERS, True)


@kernel
def region_bits(mask: np.ndarray, out: np.ndarray) -> None:
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
    """Returns a Gaussian of `spread` pixels over `side` x `side` pixels (3, 5 or 7): int16 (7 * 32), read-only,
    summing to about 49 * WEIGHT for each channel."""
    y, x = np.mgrid[-RADIUS : RADIUS + 1, -RADIUS : RADIUS + 1]
    plane = mapped(exp, -(x * x + y * y) / (2.0 * spread * spread)) * ((abs(x) <= side // 2) & (abs(y) <= side // 2))
    plane = np.maximum(np.rint(plane * (WEIGHT * plane.size / plane.sum())), plane > 0.0)
    out = np.zeros((SIDE, ROW // 4, 4), np.int16)
    out[:, :SIDE] = plane[:, :, None]
    flat = out.reshape(-1)
    flat.flags.writeable = False
    return flat


@lru_cache(maxsize=8)
def square_bits(side: int) -> np.uint64:
    """Returns the bits of the inner `side` x `side` pixels (3, 5 or 7)."""
    near = range(RADIUS - side // 2, RADIUS + side // 2 + 1)
    return np.uint64(sum(1 << SIDE * y + x for y in near for x in near))


@lru_cache(maxsize=1)
def straight_shapes() -> np.ndarray:
    """Returns the shapes that straight outlines have around pixels inside: uint64 (n,), read-only."""
    rows, columns = np.mgrid[-RADIUS : RADIUS + 1, -RADIUS : RADIUS + 1].reshape(2, -1)
    found = set()
    for y in range(-RADIUS, RADIUS + 1):
        for x in range(-RADIUS, RADIUS + 1):
            for far in range(1, 2 * RADIUS * SIDE):
                inside = 2 * (y * rows + x * columns) < far
                found.add(sum(1 << int(place) for place in np.flatnonzero(inside)))
    found.discard(int(FULL))
    out = np.array(sorted(found), np.uint64)
    out.flags.writeable = False
    return out
