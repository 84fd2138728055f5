"""Products of matrices with many columns, in float32: the same bits on every processor.

What the compiler is told in registers is never reordered nor fused, as in `butterflies`.  Sums over the columns are
taken in eight parts, of every eighth column, a thousand columns at a time, and those in float64.
"""

from __future__ import annotations

import numpy as np
from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic

from engine.numeric.in_parts import in_parts
from engine.numeric.kernel import Array, Int, Low, inner, kernel

_ROWS = 4  # that are worked on together
_SUMMED, _WIDE = 8, 16  # columns beside one another: of sums, of combinations
_BLOCK = 1024  # columns whose products are summed in float32
_FLOAT, _INT = ir.FloatType(), ir.IntType(32)
_SUMS, _PART = ir.VectorType(_FLOAT, _SUMMED), ir.VectorType(_FLOAT, _WIDE)


def products(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Returns the sums over all columns of the products of rows of x (a, n) and of y (b, n): float64 (a, b)."""
    rows, columns = x.shape[0], y.shape[0]
    same = x is y
    x = _filled(x)
    y = x if same else _filled(y)
    out = np.zeros((x.shape[0], y.shape[0]))
    one, other, count = x.reshape(-1), y.reshape(-1), x.shape[1]
    in_parts(
        lambda first, last: _add_products(one, other, count, same, first, last, out),
        len(out),
        one.size * columns,
        _ROWS,
    )
    if same:
        out = np.tril(out) + np.tril(out, -1).T
    return out[:rows, :columns]


def combinations(factors: np.ndarray, x: np.ndarray, out: np.ndarray | None = None) -> np.ndarray:
    """Returns factors (a, b) times x (b, n): float32 (a, n); added to `out`, if that is given."""
    adding = out is not None
    made = np.empty((factors.shape[0], x.shape[1]), np.float32) if out is None else out
    room = made if len(made) % _ROWS == 0 else _filled(made)
    flat, told, count = np.ascontiguousarray(x, np.float32).reshape(-1), _filled(factors).reshape(-1), x.shape[0]
    in_parts(
        lambda first, last: _combine(told, flat, count, adding, first, last, room), x.shape[1], room.size * count, _WIDE
    )
    if room is not made:
        made[:] = room[: len(made)]
    return made


def _filled(x: np.ndarray) -> np.ndarray:
    """Returns a matrix of float32, with rows of nothing at its end so that their number is a multiple of _ROWS."""
    short = -len(x) % _ROWS
    return np.ascontiguousarray(np.pad(x, ((0, short), (0, 0))) if short else x, np.float32)


def _at(context: Low, builder: Low, kind: Low, array: Low, index: Low, register: Low) -> Low:
    """Tells where a register of values from an index of a flat array on lies."""
    place = builder.gep(context.make_array(kind)(context, builder, array).data, [index])
    return builder.bitcast(place, register.as_pointer())


def _counted(builder: Low, first: Low, step: Low, k: int) -> Low:
    return builder.add(first, builder.mul(step, ir.Constant(step.type, k)))


def _halves(builder: Low, register: Low) -> Low:
    """Sums the values of a register."""
    width = _SUMMED
    while width > 1:
        width //= 2
        kind = ir.VectorType(_INT, width)
        low, high = (ir.Constant(kind, [n + m for n in range(width)]) for m in (0, width))
        undefined = ir.Constant(register.type, ir.Undefined)
        parts = [builder.shuffle_vector(register, undefined, which) for which in (low, high)]
        register = builder.fadd(*parts)
    return builder.extract_element(register, ir.Constant(_INT, 0))


@intrinsic  # type: ignore[untyped-decorator]
def _tile(context: Low, x: Low, i: Low, y: Low, j: Low, step: Low, count: Low, out: Low) -> Low:
    """Writes the sums of products of four rows of x, from index i on and `step` apart, and four of y: out (16,)."""

    def emit(context: Low, builder: Low, signature: Low, arguments: Low) -> Low:
        x, i, y, j, step, count, out = arguments
        kinds = signature.args
        sums = [cgutils.alloca_once(builder, _SUMS) for _ in range(_ROWS * _ROWS)]
        for place in sums:
            builder.store(ir.Constant(_SUMS, [0.0] * _SUMMED), place)
        zero, wide = ir.Constant(count.type, 0), ir.Constant(count.type, _SUMMED)
        with cgutils.for_range_slice(builder, zero, count, wide, count.type) as (at, _):

            def loaded(array: Low, kind: Low, first: Low) -> list[Low]:
                starts = (builder.add(_counted(builder, first, step, k), at) for k in range(_ROWS))
                return [builder.load(_at(context, builder, kind, array, n, _SUMS), align=4) for n in starts]

            ours, theirs = loaded(x, kinds[0], i), loaded(y, kinds[2], j)
            for n, place in enumerate(sums):
                product = builder.fmul(ours[n // _ROWS], theirs[n % _ROWS])
                builder.store(builder.fadd(builder.load(place), product), place)
        target = context.make_array(kinds[6])(context, builder, out).data
        for n, place in enumerate(sums):
            index = ir.Constant(count.type, n)
            builder.store(_halves(builder, builder.load(place)), builder.gep(target, [index]))
        return context.get_dummy_value()

    place = types.intp
    return types.void(x, place, y, place, place, place, out), emit


@intrinsic  # type: ignore[untyped-decorator]
def _strip(context: Low, a: Low, i: Low, x: Low, j: Low, step: Low, count: Low, out: Low, o: Low) -> Low:
    """Adds to sixteen columns of four rows of `out`, from index o on, `count` rows of x from index j on, times the
    factors from a[i] on; rows of x and of `out` are `step` apart, those of a `count`."""

    def emit(context: Low, builder: Low, signature: Low, arguments: Low) -> Low:
        a, i, x, j, step, count, out, o = arguments
        kinds = signature.args
        places = [_at(context, builder, kinds[6], out, _counted(builder, o, step, k), _PART) for k in range(_ROWS)]
        sums = [cgutils.alloca_once(builder, _PART) for _ in range(_ROWS)]
        for place, total in zip(places, sums, strict=True):
            builder.store(builder.load(place, align=4), total)
        with cgutils.for_range(builder, count, intp=count.type) as loop:
            row = builder.add(j, builder.mul(loop.index, step))
            values = builder.load(_at(context, builder, kinds[2], x, row, _PART), align=4)
            for k, total in enumerate(sums):
                at = builder.add(_counted(builder, i, count, k), loop.index)
                factor = builder.load(_at(context, builder, kinds[0], a, at, _FLOAT))
                one = builder.insert_element(ir.Constant(_PART, ir.Undefined), factor, ir.Constant(_INT, 0))
                all_ = builder.shuffle_vector(one, one, ir.Constant(ir.VectorType(_INT, _WIDE), [0] * _WIDE))
                builder.store(builder.fadd(builder.load(total), builder.fmul(values, all_)), total)
        for place, total in zip(places, sums, strict=True):
            builder.store(builder.load(total), place, align=4)
        return context.get_dummy_value()

    place = types.intp
    return types.void(a, place, x, place, place, place, out, place), emit


@kernel
def _add_products(x: Array, y: Array, n: Int, same: bool, start: Int, end: Int, out: Array) -> None:
    """Rows from `start` to `end` of out (a, b) += the products of flat x (a n) and y (b n); of the `same` only the
    lower half."""
    part, even = np.empty(_ROWS * _ROWS, np.float32), n // _SUMMED * _SUMMED
    for first in range(0, even, _BLOCK):
        count = min(_BLOCK, even - first)
        for i in range(start, end, _ROWS):
            for j in range(0, i + _ROWS if same else out.shape[1], _ROWS):
                _tile(x, i * n + first, y, j * n + first, n, count, part)
                for k in range(_ROWS * _ROWS):
                    out[i + k // _ROWS, j + k % _ROWS] += np.float64(part[k])
    for p in range(even, n):
        for i in range(start, end):
            for j in range(out.shape[1]):
                out[i, j] += np.float64(x[i * n + p]) * np.float64(y[j * n + p])


@kernel
def _combine(factors: Array, x: Array, rows: Int, adding: bool, start: Int, end: Int, out: Array) -> None:
    """Columns from `start`, a multiple of _WIDE, to `end` of out (a, n) = the flat factors (a rows) times the flat
    x (rows n), or more by that."""
    n = out.shape[1]
    flat, even = out.reshape(-1), n // _WIDE * _WIDE
    if not adding:
        out[:, start:end] = np.float32(0.0)
    for p in range(start, min(even, end), _WIDE):
        for i in range(0, out.shape[0], _ROWS):
            _strip(factors, i * rows, x, p, n, rows, flat, i * n + p)
    if even < end:
        _combine_rest(factors, x, rows, out, even)


@inner
def _combine_rest(factors: Array, x: Array, rows: Int, out: Array, start: Int) -> None:
    n = out.shape[1]
    for i in range(out.shape[0]):
        for p in range(start, n):
            total = out[i, p]
            for k in range(rows):
                total += x[k * n + p] * factors[i * rows + k]
            out[i, p] = total
