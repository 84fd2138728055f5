"""The four pixels below one, by the maps of its kind, in registers of sixteen: three differences along four axes, then
four pixels of four channels.

What the compiler is told in registers is never reordered nor fused, as in `butterflies`, so that a value is the same as
if it were reckoned alone: the sums go by the neighbours, row by row, then by the noise, then by the axes.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache

import numpy as np
from llvmlite import ir
from numba import types
from numba.extending import intrinsic

from engine.numeric.kernel import Low
from engine.texture.learnt.maps import LANES, TAPPED, Maps

REGISTER = LANES * LANES  # numbers that are worked on at once
NOISES = 3 * LANES  # numbers of a pixel's noise: three along each of four axes
_NOISED = 3  # pixels each way whose noise counts
_ALPHA = 3  # the channel that limits the others, and that has no noise
_FLOAT, _INT, _INDEX = ir.FloatType(), ir.IntType(32), ir.IntType(64)
_FOUR, _ALL = ir.VectorType(_FLOAT, LANES), ir.VectorType(_FLOAT, REGISTER)
_NONE, _WHOLE = ir.Constant(_ALL, [0.0] * REGISTER), ir.Constant(_ALL, [1.0] * REGISTER)


@lru_cache(maxsize=16)
def in_registers(maps: Maps) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Returns what `four_finer` is given of maps: their axes (LANES REGISTER,), and for each kind what neighbours and
    noise count (kinds TAPS REGISTER,), (kinds 3 NOISY REGISTER,): float32, with nothing where there are fewer axes,
    channels or differences."""
    count, channels = maps.axes.shape
    axes = np.zeros((LANES, LANES, LANES), np.float32)
    axes[:count, :, :channels] = maps.axes[:, None]
    found = [axes.reshape(-1)]
    for parts in (maps.sharp, maps.rough):
        kinds, _, taps, _ = parts.shape
        room = np.zeros((kinds, taps, LANES, LANES), np.float32)
        room[..., :count] = parts.transpose(0, 2, 3, 1)
        found.append(room.reshape(-1))
    return found[0], found[1], found[2]


def _shuffled(builder: Low, one: Low, other: Low, place: Callable[[int, int], int]) -> Low:
    """A register whose number 4 k + n is that at place(k, n) of two others, which are counted as one."""
    places = [place(k, n) for k in range(LANES) for n in range(LANES)]
    return builder.shuffle_vector(one, other, ir.Constant(ir.VectorType(_INT, REGISTER), places))


def _loaded(builder: Low, data: Low, first: Low, kind: Low, more: int = 0) -> Low:
    at = builder.add(first, ir.Constant(_INDEX, more))
    return builder.load(builder.bitcast(builder.gep(data, [at]), kind.as_pointer()), align=4)


def _four_times(builder: Low, data: Low, first: Low, more: int = 0) -> Low:
    four = _loaded(builder, data, first, _FOUR, more)
    return _shuffled(builder, four, four, lambda k, n: n)


def _weighed(builder: Low, values: list[Low], parts: Low, first: Low) -> Low:
    """The sum of what some values count for, one after the other."""
    total = _NONE
    for k, value in enumerate(values):
        part = _loaded(builder, parts, first, _ALL, REGISTER * k)
        total = builder.fadd(total, builder.fmul(value, part))
    return total


def _row(builder: Low, first: Low, step: Low, k: int) -> Low:
    return builder.add(first, builder.mul(step, ir.Constant(_INDEX, k)))


def _differences(builder: Low, sharp: Low, rough: Low, axes: Low) -> Low:
    """What four pixels differ by, number 4 k + c of channel c: across, down, and crosswise."""
    both, total = builder.fadd(sharp, rough), _NONE
    for r in range(LANES):
        own = _shuffled(builder, sharp, both, _along(r))
        axis = _loaded(builder, axes, ir.Constant(_INDEX, REGISTER * r), _ALL)
        total = builder.fadd(total, builder.fmul(axis, own))
    return total


def _along(axis: int) -> Callable[[int, int], int]:
    """Where difference k along an axis lies for channel c: alpha has none of noise, or an outline would fray."""
    return lambda k, c: LANES * k + axis + (0 if c == _ALPHA else REGISTER)


def _signed(builder: Low, told: Low, k: int, sign: Callable[[int, int], int]) -> Low:
    """Difference k of each channel, for each of four pixels with a sign."""
    own = _shuffled(builder, told, told, lambda _, c: LANES * k + c)
    signs = [float(sign(pixel >> 1, pixel & 1)) for pixel in range(LANES) for _ in range(LANES)]
    return builder.fmul(own, ir.Constant(_ALL, signs))


def _limited(builder: Low, value: Low) -> Low:
    """Within 0..1, colours below alpha, the last of four."""
    value = builder.select(builder.fcmp_ordered(">", _NONE, value), _NONE, value)
    alpha = _shuffled(builder, value, value, lambda k, c: LANES * k + _ALPHA)
    alpha = builder.select(builder.fcmp_ordered("<", _WHOLE, alpha), _WHOLE, alpha)
    most = _shuffled(builder, alpha, _WHOLE, lambda k, c: REGISTER if c == _ALPHA else LANES * k)
    return builder.select(builder.fcmp_ordered("<", most, value), most, value)


@intrinsic  # type: ignore[untyped-decorator]
def four_finer(
    context: Low, along: Low, i: Low, i_row: Low, noise: Low, n: Low, n_row: Low,
    sharp: Low, s: Low, rough: Low, r: Low, axes: Low, lively: Low, own: Low, out: Low,
) -> Low:  # fmt: skip
    """Writes the four pixels below one to `out` (REGISTER,): upper left, upper right, lower left, lower right, each of
    four channels, within 0..1, colours below alpha.

    All arrays are flat.  `along` from i on, rows being i_row apart, are the neighbourhood's pixels along four axes;
    `noise` from n on, as far apart as n_row, is what `NOISES` says; `sharp` from s on and `rough` from r on are a
    kind's, as `axes` by `in_registers`; `lively`: how much noise counts; `own` (LANES,): the pixel, with alpha."""

    def emit(context: Low, builder: Low, signature: Low, arguments: Low) -> Low:
        def data(k: int) -> Low:
            return context.make_array(signature.args[k])(context, builder, arguments[k]).data

        along, noise, sharp, rough, axes, own, out = (data(k) for k in (0, 3, 6, 8, 10, 12, 13))
        _, i, i_row, _, n, n_row, _, s, _, r, _, lively, _, _ = arguments
        middle = _four_times(builder, along, _row(builder, i, i_row, TAPPED // 2), TAPPED // 2 * LANES)
        near = [
            builder.fsub(_four_times(builder, along, _row(builder, i, i_row, y), LANES * x), middle)
            for y in range(TAPPED)
            for x in range(TAPPED)
        ]
        one = builder.insert_element(ir.Constant(_ALL, ir.Undefined), lively, ir.Constant(_INT, 0))
        due = _shuffled(builder, one, one, lambda k, c: 0)
        random = [
            builder.fmul(_four_times(builder, noise, _row(builder, n, n_row, y), LANES * x), due)
            for y in range(_NOISED)
            for x in range(3 * _NOISED)
        ]
        told = _differences(builder, _weighed(builder, near, sharp, s), _weighed(builder, random, rough, r), axes)
        value = _four_times(builder, own, ir.Constant(_INDEX, 0))
        value = builder.fadd(value, _signed(builder, told, 0, lambda j, i: 1 - 2 * i))
        value = builder.fadd(value, _signed(builder, told, 1, lambda j, i: 1 - 2 * j))
        value = builder.fadd(value, _signed(builder, told, 2, lambda j, i: (1 - 2 * j) * (1 - 2 * i)))
        builder.store(_limited(builder, value), builder.bitcast(out, _ALL.as_pointer()), align=4)
        return context.get_dummy_value()

    place = types.intp
    taken = along, place, place, noise, place, place, sharp, place, rough, place, axes, types.float32, own, out
    return types.void(*taken), emit
