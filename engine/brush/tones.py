"""Loops of the raster-ops: channel functions by name, each with its own loop, and what ops need besides.

Colours are straight (not premultiplied), encoded as the layer is, 0..1.  A function gives the target t of a channel
and its slope t', so that a stroke of weight w makes c + w (t - c), and small grey detail 1 + w (t' - 1) of itself.  A
target is brought into 0..1; where that cuts it off, the slope is 0.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from engine.numeric.arithmetic import EVERYWHERE, LIBRARY
from engine.numeric.elementary import power
from engine.numeric.grid import snap
from engine.numeric.kernel import Array, forced, inner, kernel

_ZERO, _ONE, _TWO, _HALF = np.float32(0), np.float32(1), np.float32(2), np.float32(0.5)
_TINY = np.float32(1e-6)
_THIRD = np.float32(1 / 3)
_OPAQUE = np.float32(1 - 1 / 256)
_INK = np.float32(2)  # the largest amplitude that may come about by amplifying
LUMA = (0.3, 0.59, 0.11)  # W3C, Compositing and Blending Level 1, section 10.2
_RED, _GREEN, _BLUE = (np.float32(part) for part in LUMA)
STEPS = 1024  # of a ramp's table

Loop = Callable[[np.ndarray, np.ndarray, np.ndarray, np.ndarray, np.ndarray], None]  # of `_separable`
# Of a colour, the brush's, and two parameters: where it goes, and how steeply.
Channel = Callable[[np.float32, np.float32, np.float32, np.float32], tuple[np.float32, np.float32]]


# ---- channel functions: (channel, brush's colour, first and second parameter) -> target, slope ----------------------


@forced
def _multiply(c: np.float32, p: np.float32, a: np.float32, b: np.float32) -> tuple[np.float32, np.float32]:
    return c * p, p


@forced
def _screen(c: np.float32, p: np.float32, a: np.float32, b: np.float32) -> tuple[np.float32, np.float32]:
    return c + p - c * p, _ONE - p


@forced
def _overlay(c: np.float32, p: np.float32, a: np.float32, b: np.float32) -> tuple[np.float32, np.float32]:
    dark = c <= _HALF
    return (_TWO * c * p if dark else _ONE - _TWO * (_ONE - c) * (_ONE - p)), (_TWO * p if dark else _TWO * (_ONE - p))


@forced
def _dodge(c: np.float32, p: np.float32, a: np.float32, b: np.float32) -> tuple[np.float32, np.float32]:
    gain = _ONE / max(_ONE - p, _TINY)
    return c * gain, gain


@forced
def _burn(c: np.float32, p: np.float32, a: np.float32, b: np.float32) -> tuple[np.float32, np.float32]:
    gain = _ONE / max(p, _TINY)
    return _ONE - (_ONE - c) * gain, gain


@forced
def _add(c: np.float32, p: np.float32, a: np.float32, b: np.float32) -> tuple[np.float32, np.float32]:
    return c + p, _ONE


@forced
def _subtract(c: np.float32, p: np.float32, a: np.float32, b: np.float32) -> tuple[np.float32, np.float32]:
    return c - p, _ONE


@forced
def _difference(c: np.float32, p: np.float32, a: np.float32, b: np.float32) -> tuple[np.float32, np.float32]:
    return abs(c - p), (_ONE if c >= p else -_ONE)


@forced
def _invert(c: np.float32, p: np.float32, a: np.float32, b: np.float32) -> tuple[np.float32, np.float32]:
    return _ONE - c, -_ONE


@forced
def _lighten(c: np.float32, p: np.float32, a: np.float32, b: np.float32) -> tuple[np.float32, np.float32]:
    return c + a * (_ONE - c), _ONE - a


@forced
def _darken(c: np.float32, p: np.float32, a: np.float32, b: np.float32) -> tuple[np.float32, np.float32]:
    return c * (_ONE - a), _ONE - a


@forced
def _gamma(c: np.float32, p: np.float32, a: np.float32, b: np.float32) -> tuple[np.float32, np.float32]:
    return c**a, a * max(c, _TINY) ** (a - _ONE)


@forced
def _gamma_everywhere(c: np.float32, p: np.float32, a: np.float32, b: np.float32) -> tuple[np.float32, np.float32]:
    """As `_gamma`, with the same bits on every processor."""
    x, y = np.float64(c), np.float64(a)
    return np.float32(power(x, y)), np.float32(y * power(max(x, 1e-6), y - 1.0))


@forced
def _contrast(c: np.float32, p: np.float32, a: np.float32, b: np.float32) -> tuple[np.float32, np.float32]:
    return b + a * (c - b), a


@forced
def _tone(c: np.float32, p: np.float32, a: np.float32, b: np.float32) -> tuple[np.float32, np.float32]:
    return _HALF + b * (c - _HALF) + a, b


@forced
def _posterise(c: np.float32, p: np.float32, a: np.float32, b: np.float32) -> tuple[np.float32, np.float32]:
    return np.floor(min(c * a, a - _HALF)) / (a - _ONE), _ZERO


def _separable(function: Channel) -> Loop:
    """Returns the loop of a channel function: colours `c` to targets `t` and slopes `s`, float32 (3, n), by the brush's
    `colour` (3,) and the op's `parameters` (9,).  It is compiled when it is first used."""

    @kernel
    def loop(c: np.ndarray, colour: np.ndarray, parameters: np.ndarray, t: np.ndarray, s: np.ndarray) -> None:
        a, b = parameters[0], parameters[1]
        for channel in range(3):
            source, target, slope, p = c[channel], t[channel], s[channel], colour[channel]
            for x in range(source.size):
                value, steep = function(source[x], p, a, b)
                target[x] = min(max(value, _ZERO), _ONE)
                slope[x] = steep if _ZERO <= value <= _ONE else _ZERO

    return loop


CHANNELS: dict[str, Loop] = {
    function.__name__[1:]: _separable(function)
    for function in (
        _multiply, _screen, _overlay, _dodge, _burn, _add, _subtract, _difference, _invert, _lighten, _darken, _gamma,
        _contrast, _posterise, _tone,
    )
}  # fmt: skip


GAMMAS = {LIBRARY: CHANNELS["gamma"], EVERYWHERE: _separable(_gamma_everywhere)}  # by arithmetic


@kernel
def mixed(c: np.ndarray, matrix: np.ndarray, t: np.ndarray, s: np.ndarray) -> None:
    """Channels mixed by `matrix`, float32 (9,), whose rows sum to 1, so that grey detail stays."""
    for channel in range(3):
        m0, m1, m2 = matrix[3 * channel], matrix[3 * channel + 1], matrix[3 * channel + 2]
        red, green, blue, target, slope = c[0], c[1], c[2], t[channel], s[channel]
        for x in range(target.size):
            value = m0 * red[x] + m1 * green[x] + m2 * blue[x]
            target[x] = min(max(value, _ZERO), _ONE)
            slope[x] = _ONE if -_TINY <= value <= _ONE + _TINY else _ZERO


@kernel
def ramp(index: np.ndarray, table: np.ndarray, t: np.ndarray, s: np.ndarray) -> None:
    """Writes the colours of `table`, float32 (1025, 3), at `index`, 0..1, and how fast they change along it."""
    steps = np.float32(STEPS)
    for x in range(index.size):
        place = min(max(index[x], _ZERO), _ONE) * steps
        i = min(int(place), STEPS - 1)
        part = place - np.float32(i)
        for channel in range(3):
            step = table[i + 1, channel] - table[i, channel]
            t[channel, x] = table[i, channel] + part * step
            s[channel, x] = step * steps


@kernel
def sharpen(c: np.ndarray, mean: np.ndarray, amount: np.float32, t: np.ndarray, s: np.ndarray) -> None:
    """Colours away from the `mean` around them, float32 (3, n), by `amount` times how far they are."""
    for channel in range(3):
        source, around, target, slope = c[channel], mean[channel], t[channel], s[channel]
        for x in range(source.size):
            value = source[x] + amount * (source[x] - around[x])
            target[x] = min(max(value, _ZERO), _ONE)
            slope[x] = _ONE + amount if _ZERO <= value <= _ONE else _ZERO


@kernel
def luma(c: np.ndarray, out: np.ndarray) -> None:
    """Brightness of straight colours `c`, float32 (3, n), into `out` (n,)."""
    red, green, blue = c[0], c[1], c[2]
    for x in range(out.size):
        out[x] = _RED * red[x] + _GREEN * green[x] + _BLUE * blue[x]


@kernel
def straight(v: np.ndarray, out: np.ndarray) -> None:
    """Turns colour and alpha, float32 (4, n), to straight colours (3, n) within 0..1; black where nothing lies."""
    alpha = v[3]
    for channel in range(3):
        source, target = v[channel], out[channel]
        for x in range(alpha.size):
            value = source[x] / max(alpha[x], _TINY)
            target[x] = min(max(value, _ZERO), _ONE)


@kernel
def weigh(coverage: np.ndarray, texture: np.ndarray, weight: np.ndarray, free: np.ndarray) -> bool:
    """w = M clamp(tex) into `weight`, M where the texture is not cut off into `free`; whether w is anything.

    All float32 (h, w); M is rounded to the grid; `free` is how strongly w follows the texture's finer detail.
    """
    some = np.int32(0)
    for y in range(coverage.shape[0]):
        m, t, w, f = coverage[y], texture[y], weight[y], free[y]
        for x in range(m.size):
            covered = snap(m[x])
            w[x] = covered * min(max(t[x], _ZERO), _ONE)
            f[x] = covered if _ZERO <= t[x] <= _ONE else _ZERO
            some |= np.int32(w[x] > _ZERO)
    return some != 0  # type: ignore[no-any-return]


@kernel
def change(
    old: Array,
    planes: Array,
    weight: Array,
    free: Array,
    c: Array,
    t: Array,
    s: Array,
    along: bool,
    gains: Array,
    keep: Array,
    add: Array,
) -> None:
    """Writes a and B of an op that changes colours and spares alpha: v' = v + w (alpha t - v), A = 1 + w (t' - 1) in
    -1..2.

    `old` float32 (4 + 3m, h, w), premultiplied; `weight`, `free` (h, w), as of `weigh`; `c`, `t`, `s` (3, h, w):
    straight colours, targets and slopes, the latter along the brush's texture if `along`.  `add` (4 + 3n, h, w) and
    `keep` (h, w) are written.  `planes` int64 (3n,): where the planes of the n inks are in `old`, -1 for none; `gains`
    (n,): what the op's own texture adds to each of them.

    Where the layer is not opaque, finer detail is mostly that of its alpha, and keeps its colour if A is the ratio of
    the new colour to the old.
    """
    for y in range(weight.shape[0]):
        w, a, alpha = weight[y], keep[y], old[3, y]
        c0, c1, c2, t0, t1, t2 = c[0, y], c[1, y], c[2, y], t[0, y], t[1, y], t[2, y]
        s0, s1, s2 = s[0, y], s[1, y], s[2, y]
        for x in range(w.size):
            sum_c, sum_t = c0[x] + c1[x] + c2[x], t0[x] + t1[x] + t2[x]
            slope = _ZERO if along else (s0[x] + s1[x] + s2[x]) * _THIRD
            ratio = min(max(sum_t / max(sum_c, _TINY), _ZERO), _TWO) if alpha[x] > _ZERO else _ONE
            a[x] = snap(min(max(_ONE + w[x] * ((slope if alpha[x] >= _OPAQUE else ratio) - _ONE), -_ONE), _TWO))
        for channel in range(3):
            v, b, target = old[channel, y], add[channel, y], t[channel, y]
            for x in range(w.size):
                b[x] = snap(v[x] + w[x] * (alpha[x] * target[x] - v[x])) - snap(a[x] * v[x])
        add[3, y] = _ZERO
        _inks(old, planes, free, gains, y, t, s, along, a, add)


@inner
def _inks(
    old: Array, planes: Array, free: Array, gains: Array, y: int, t: Array, s: Array, along: bool, a: Array, add: Array
) -> None:
    """B of the ink planes of a row: the op's own texture goes on in them, to one half at most; none passes 2."""
    f, alpha = free[y], old[3, y]
    for i in range(planes.size):
        channel, gain = i % 3, gains[i // 3]
        v, b, target, slope = old[channel, y], add[4 + i, y], t[channel, y], s[channel, y]
        before = old[max(planes[i], 0), y]
        there = _ONE if planes[i] >= 0 else _ZERO
        for x in range(f.size):
            steep = alpha[x] * slope[x] if along else alpha[x] * target[x] - v[x]
            left = snap(a[x] * before[x] * there)
            most = min(max(abs(left), _HALF), _INK)
            b[x] = min(max(left + snap(f[x] * gain * steep), -most), most) - left


@kernel
def spray(keep: Array, free: Array, colour: Array, old: Array, planes: Array, gains: Array, add: Array) -> None:
    """B of the ink planes, add[4:], of paint of one `colour` (3,) laid through a texture, as `change` makes them where
    the layer is opaque; where nothing lies there is nothing for the texture to stand out from."""
    for y in range(keep.shape[0]):
        a, f, alpha = keep[y], free[y], old[3, y]
        for i in range(planes.size):
            channel, gain, source = i % 3, gains[i // 3], planes[i]
            v, b, p = old[channel, y], add[4 + i, y], colour[channel]
            before = old[max(source, 0), y]
            there = _ONE if source >= 0 else _ZERO
            for x in range(a.size):
                left = snap(a[x] * before[x] * there)
                most = min(max(abs(left), _HALF), _INK)
                b[x] = min(max(left + snap(f[x] * gain * (alpha[x] * p - v[x])), -most), most) - left


@kernel
def moved(planes: np.ndarray, right: np.ndarray, down: np.ndarray, out: np.ndarray) -> None:
    """`planes` float32 (4, h + 2 r, w + 2 r) at places (right, down) px from each pixel, float32 (h, w), |.| < r, by
    bilinear interpolation, into `out` (4, h, w)."""
    reach = (planes.shape[1] - out.shape[1]) // 2
    for y in range(out.shape[1]):
        for x in range(out.shape[2]):
            px, py = np.float32(x + reach) + right[y, x], np.float32(y + reach) + down[y, x]
            i, j = int(px), int(py)
            u, v = px - np.float32(i), py - np.float32(j)
            for channel in range(4):
                upper, lower = planes[channel, j], planes[channel, j + 1]
                top = upper[i] + u * (upper[i + 1] - upper[i])
                out[channel, y, x] = top + v * (lower[i] + u * (lower[i + 1] - lower[i]) - top)
