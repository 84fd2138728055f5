"""Steps of Fourier transforms in float32, of sixteen lines beside one another: the same bits on every processor.

A block of n complex numbers for each of LANES lines is a flat float32 array of 2 LANES n: the real parts of the first
number of each line, their imaginary parts, those of the second number, and so on.  A butterfly takes r such numbers,
transforms them, turns them by `waves`, and writes them: what the compiler is told in registers is never reordered nor
fused, and needs no proof that arrays do not overlap.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from llvmlite import ir
from numba import types
from numba.extending import intrinsic

from engine.numeric.kernel import Low

LANES = 16
IN_REGISTERS = 5  # of the lengths that are transformed in registers

_FLOAT, _INT = ir.FloatType(), ir.IntType(32)
_VECTOR, _PLACES = ir.VectorType(_FLOAT, LANES), ir.VectorType(_INT, LANES)


class _Complex(NamedTuple):
    """Sixteen complex numbers in two registers."""

    builder: Low
    real: Low
    imaginary: Low

    def plus(self, other: _Complex) -> _Complex:
        b = self.builder
        return _Complex(b, b.fadd(self.real, other.real), b.fadd(self.imaginary, other.imaginary))

    def less(self, other: _Complex) -> _Complex:
        b = self.builder
        return _Complex(b, b.fsub(self.real, other.real), b.fsub(self.imaginary, other.imaginary))

    def times(self, factor: float) -> _Complex:
        b, by = self.builder, ir.Constant(_VECTOR, [float(np.float32(factor))] * LANES)
        return _Complex(b, b.fmul(self.real, by), b.fmul(self.imaginary, by))

    def turned(self, cosine: Low, sine: Low) -> _Complex:
        b = self.builder
        real = b.fsub(b.fmul(self.real, cosine), b.fmul(self.imaginary, sine))
        return _Complex(b, real, b.fadd(b.fmul(self.real, sine), b.fmul(self.imaginary, cosine)))

    def less_turned(self, other: _Complex) -> _Complex:
        """Returns this less i times the other."""
        b = self.builder
        return _Complex(b, b.fadd(self.real, other.imaginary), b.fsub(self.imaginary, other.real))

    def plus_turned(self, other: _Complex) -> _Complex:
        """Returns this and i times the other."""
        b = self.builder
        return _Complex(b, b.fsub(self.real, other.imaginary), b.fadd(self.imaginary, other.real))


def _of_two(a: _Complex, b: _Complex) -> list[_Complex]:
    return [a.plus(b), a.less(b)]


def _of_three(a: _Complex, b: _Complex, c: _Complex) -> list[_Complex]:
    both, apart = b.plus(c), b.less(c).times(3.0**0.5 / 2.0)
    middle = a.less(both.times(0.5))
    return [a.plus(both), middle.less_turned(apart), middle.plus_turned(apart)]


def _of_four(a: _Complex, b: _Complex, c: _Complex, d: _Complex) -> list[_Complex]:
    even, odd, even_apart, odd_apart = a.plus(c), b.plus(d), a.less(c), b.less(d)
    return [even.plus(odd), even_apart.less_turned(odd_apart), even.less(odd), even_apart.plus_turned(odd_apart)]


_C1, _C2 = (5.0**0.5 - 1.0) / 4.0, -(5.0**0.5 + 1.0) / 4.0  # cosines of a fifth of a turn, and of two
_S1, _S2 = ((10.0 + 2.0 * 5.0**0.5) / 16.0) ** 0.5, ((10.0 - 2.0 * 5.0**0.5) / 16.0) ** 0.5


def _of_five(a: _Complex, b: _Complex, c: _Complex, d: _Complex, e: _Complex) -> list[_Complex]:
    outer, inner, outer_apart, inner_apart = b.plus(e), c.plus(d), b.less(e), c.less(d)
    first = a.plus(outer.times(_C1)).plus(inner.times(_C2))
    second = a.plus(outer.times(_C2)).plus(inner.times(_C1))
    near = outer_apart.times(_S1).plus(inner_apart.times(_S2))
    far = outer_apart.times(_S2).less(inner_apart.times(_S1))
    sums = [first.less_turned(near), second.less_turned(far), second.plus_turned(far), first.plus_turned(near)]
    return [a.plus(outer.plus(inner)), *sums]


def _at(context: Low, builder: Low, kind: Low, array: Low, index: Low) -> Low:
    """Tells where the value of an index of a flat array lies."""
    return builder.gep(context.make_array(kind)(context, builder, array).data, [index])


def _loaded(context: Low, builder: Low, kind: Low, array: Low, index: Low) -> Low:
    place = builder.bitcast(_at(context, builder, kind, array, index), _VECTOR.as_pointer())
    return builder.load(place, align=4)


def _stored(context: Low, builder: Low, kind: Low, array: Low, index: Low, register: Low) -> None:
    builder.store(register, builder.bitcast(_at(context, builder, kind, array, index), _VECTOR.as_pointer()), align=4)


def _moved(builder: Low, index: Low, step: int) -> Low:
    return builder.add(index, ir.Constant(index.type, step))


def _butterfly(count: int, transform: Callable[..., list[_Complex]]) -> Low:
    """Returns what writes the transform of `count` numbers, each turned by as many turns of `waves`."""

    def emit(context: Low, builder: Low, signature: Low, arguments: Low) -> Low:
        x, i, i_step, u, o, o_step, waves, turn = arguments
        kinds = signature.args

        def place(first: Low, step: Low, k: int) -> Low:
            at = builder.add(first, builder.mul(step, ir.Constant(step.type, k)))
            return builder.mul(at, ir.Constant(at.type, 2 * LANES))

        def wave(k: int, part: int) -> Low:
            at = _moved(builder, builder.mul(turn, ir.Constant(turn.type, 2 * k)), part)
            value = builder.load(_at(context, builder, kinds[6], waves, at))
            one = builder.insert_element(ir.Constant(_VECTOR, ir.Undefined), value, ir.Constant(_INT, 0))
            return builder.shuffle_vector(one, one, ir.Constant(_PLACES, [0] * LANES))

        given = []
        for k in range(count):
            at = place(i, i_step, k)
            parts = (_loaded(context, builder, kinds[0], x, _moved(builder, at, n)) for n in (0, LANES))
            given.append(_Complex(builder, *parts))
        for k, value in enumerate(transform(*given)):
            turned, at = value.turned(wave(k, 0), wave(k, 1)) if k else value, place(o, o_step, k)
            _stored(context, builder, kinds[3], u, at, turned.real)
            _stored(context, builder, kinds[3], u, _moved(builder, at, LANES), turned.imaginary)
        return context.get_dummy_value()

    @intrinsic  # type: ignore[untyped-decorator]
    def butterfly(context: Low, x: Low, i: Low, i_step: Low, u: Low, o: Low, o_step: Low, waves: Low, turn: Low) -> Low:
        place = types.intp
        return types.void(x, place, place, u, place, place, waves, place), emit

    return butterfly


# Each takes number i, i + i_step, ... of block x, and writes o, o + o_step, ... of block u: the k-th turned by wave
# k * turn of `waves`, float32 (2n,) with the real and the imaginary part of each.
of_two, of_three = _butterfly(2, _of_two), _butterfly(3, _of_three)
of_four, of_five = _butterfly(4, _of_four), _butterfly(5, _of_five)


@intrinsic  # type: ignore[untyped-decorator]
def turn_over(context: Low, a: Low, i: Low, i_step: Low, b: Low, o: Low, o_step: Low) -> Low:
    """Writes sixteen rows of sixteen floats, from index i on and i_step apart, as columns."""

    def emit(context: Low, builder: Low, signature: Low, arguments: Low) -> Low:
        a, i, i_step, b, o, o_step = arguments

        def place(first: Low, step: Low, k: int) -> Low:
            return builder.add(first, builder.mul(step, ir.Constant(step.type, k)))

        rows = [_loaded(context, builder, signature.args[0], a, place(i, i_step, k)) for k in range(LANES)]
        for s in (8, 4, 2, 1):
            first = ir.Constant(_PLACES, [n if not n & s else LANES + n - s for n in range(LANES)])
            second = ir.Constant(_PLACES, [n + s if not n & s else LANES + n for n in range(LANES)])
            for k in range(LANES):
                if not k & s:
                    one, other = rows[k], rows[k + s]
                    rows[k] = builder.shuffle_vector(one, other, first)
                    rows[k + s] = builder.shuffle_vector(one, other, second)
        for k, row in enumerate(rows):
            _stored(context, builder, signature.args[3], b, place(o, o_step, k), row)
        return context.get_dummy_value()

    place = types.intp
    return types.void(a, place, place, b, place, place), emit


@intrinsic  # type: ignore[untyped-decorator]
def split(context: Low, x: Low, i: Low, j: Low, z: Low, one: Low, other: Low) -> Low:
    """Takes a frequency of two real lines from those, at i and j, of the complex line of which they are the parts."""

    def emit(context: Low, builder: Low, signature: Low, arguments: Low) -> Low:
        x, i, j, z, one, other = arguments
        at = (i, _moved(builder, i, LANES), j, _moved(builder, j, LANES))
        a, b, c, d = (_loaded(context, builder, signature.args[0], x, index) for index in at)
        half = ir.Constant(_VECTOR, [0.5] * LANES)
        found = builder.fadd(a, c), builder.fsub(b, d), builder.fadd(b, d), builder.fsub(c, a)
        places = one, _moved(builder, one, LANES), other, _moved(builder, other, LANES)
        for register, index in zip(found, places, strict=True):
            _stored(context, builder, signature.args[3], z, index, builder.fmul(half, register))
        return context.get_dummy_value()

    place = types.intp
    return types.void(x, place, place, z, place, place), emit


@intrinsic  # type: ignore[untyped-decorator]
def joined(context: Low, z: Low, one: Low, other: Low, x: Low, i: Low, j: Low) -> Low:
    """Writes a frequency, at i and j, of the complex line whose parts are two real lines, its parts changed over."""

    def emit(context: Low, builder: Low, signature: Low, arguments: Low) -> Low:
        z, one, other, x, i, j = arguments
        at = one, _moved(builder, one, LANES), other, _moved(builder, other, LANES)
        a, b, c, d = (_loaded(context, builder, signature.args[0], z, index) for index in at)
        found = builder.fsub(c, b), builder.fadd(a, d), builder.fadd(b, c), builder.fsub(a, d)
        places = j, _moved(builder, j, LANES), i, _moved(builder, i, LANES)
        for register, index in zip(found, places, strict=True):
            _stored(context, builder, signature.args[3], x, index, register)
        return context.get_dummy_value()

    place = types.intp
    return types.void(z, place, place, x, place, place), emit


@intrinsic  # type: ignore[untyped-decorator]
def parted(context: Low, a: Low, i: Low, x: Low, real: Low, imaginary: Low) -> Low:
    """Writes sixteen complex numbers, from index i on, as their real and their imaginary parts."""

    def emit(context: Low, builder: Low, signature: Low, arguments: Low) -> Low:
        a, i, x, *places = arguments
        pair = [_loaded(context, builder, signature.args[0], a, _moved(builder, i, step)) for step in (0, LANES)]
        for part, place in enumerate(places):
            taken = ir.Constant(_PLACES, [2 * n + part for n in range(LANES)])
            _stored(context, builder, signature.args[2], x, place, builder.shuffle_vector(*pair, taken))
        return context.get_dummy_value()

    place = types.intp
    return types.void(a, place, x, place, place), emit


@intrinsic  # type: ignore[untyped-decorator]
def paired(context: Low, x: Low, real: Low, imaginary: Low, a: Low, i: Low) -> Low:
    """Undoes `parted`."""

    def emit(context: Low, builder: Low, signature: Low, arguments: Low) -> Low:
        x, real, imaginary, a, i = arguments
        parts = [_loaded(context, builder, signature.args[0], x, place) for place in (real, imaginary)]
        for step in (0, LANES):
            taken = ir.Constant(_PLACES, [(step + n) // 2 + LANES * (n & 1) for n in range(LANES)])
            found = builder.shuffle_vector(*parts, taken)
            _stored(context, builder, signature.args[3], a, _moved(builder, i, step), found)
        return context.get_dummy_value()

    place = types.intp
    return types.void(x, place, place, a, place), emit
