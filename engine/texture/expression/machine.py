"""The machine that works written textures out: a list of operations on rows of samples.

It is compiled once, whatever is written.  A program is int32 (n, 12): code, target, four sources, where numbers and
keys begin, how many there are, which slope is meant, and the targets of both slopes where these are made beside a
value.  Sources and targets are rows of `registers`, float64 (rows, LENGTH), the first of which are the constants.
What a row holds does not depend on how the samples are cut into blocks.
"""

from __future__ import annotations

import math

import numpy as np

from engine.numeric import elementary
from engine.numeric.kernel import forced, inner_uncounted, uncounted
from engine.texture.expression.cell_rows import cell_row
from engine.texture.expression.codes import Code
from engine.texture.expression.noise_rows import hash32, noise_row, noise_rows, white_row

LENGTH = 256  # samples of a block
SHOWN_LEAST, SHOWN_MOST = -1.0, 2.0  # of what a pixel shows
WITH_SLOPES = 3  # of noise: value and both slopes
_WIDE = 1e30  # of widths that are none
_FAR = 2.0**30

_ADD, _SUB, _MUL, _DIV, _MIN, _MAX = Code.ADD, Code.SUB, Code.MUL, Code.DIV, 7, 8
_LESS, _ABS, _FLOOR, _SQRT = Code.LESS, Code.ABS, Code.FLOOR, Code.SQRT
_ADD_TO, _TIMES, _SELECT, _WIDTH = Code.ADD_TO, Code.TIMES, Code.SELECT, Code.WIDTH
_SIN, _COS, _TAN, _ATAN2 = Code.SIN, Code.COS, Code.TAN, Code.ATAN2
_EXP, _LOG, _POW = Code.EXP, Code.LOG, Code.POW
_NOISE, _WHITE, _CELLS, _RAMP = Code.NOISE, Code.WHITE, Code.CELLS, Code.RAMP
_X, _Y, _RANDOM = Code.X, Code.Y, Code.RANDOM


@inner_uncounted
def _of_two(code: int, a: np.ndarray, b: np.ndarray, out: np.ndarray) -> None:
    if code == _ADD:
        for i in range(out.size):
            out[i] = a[i] + b[i]
    elif code == _SUB:
        for i in range(out.size):
            out[i] = a[i] - b[i]
    elif code == _MUL:
        for i in range(out.size):
            out[i] = a[i] * b[i]
    elif code == _DIV:
        for i in range(out.size):
            out[i] = a[i] / b[i] if b[i] != 0.0 else (a[i] * _WIDE) * _WIDE
    elif code == _MIN:
        for i in range(out.size):
            out[i] = a[i] if a[i] < b[i] else b[i]
    elif code == _MAX:
        for i in range(out.size):
            out[i] = a[i] if a[i] > b[i] else b[i]
    elif code == _LESS:
        for i in range(out.size):
            out[i] = 1.0 if a[i] < b[i] else 0.0
    else:
        for i in range(out.size):
            out[i] = 1.0 if a[i] <= b[i] else 0.0


@inner_uncounted
def _of_one(code: int, a: np.ndarray, number: float, out: np.ndarray) -> None:
    if code == _ABS:
        for i in range(out.size):
            out[i] = abs(a[i])
    elif code == _FLOOR:
        for i in range(out.size):
            out[i] = np.floor(a[i])
    elif code == _SQRT:
        for i in range(out.size):
            out[i] = math.sqrt(abs(a[i]))
    elif code == _ADD_TO:
        for i in range(out.size):
            out[i] = a[i] + number
    else:
        for i in range(out.size):
            out[i] = a[i] * number


@inner_uncounted
def _picked(test: np.ndarray, a: np.ndarray, b: np.ndarray, out: np.ndarray) -> None:
    for i in range(out.size):
        out[i] = a[i] if test[i] != 0.0 else b[i]


@inner_uncounted
def _width(a: np.ndarray, b: np.ndarray, number: float, out: np.ndarray) -> None:
    """Writes how wide a pixel is along something whose slopes these are."""
    for i in range(out.size):
        width = math.sqrt(a[i] * a[i] + b[i] * b[i]) * number
        out[i] = width if width < _WIDE else _WIDE


@inner_uncounted
def _sines(code: int, a: np.ndarray, out: np.ndarray) -> None:
    if code == _SIN:
        for i in range(out.size):
            out[i] = elementary.sin(a[i])
    elif code == _COS:
        for i in range(out.size):
            out[i] = elementary.cos(a[i])
    else:
        for i in range(out.size):
            out[i] = elementary.tan(a[i])


@inner_uncounted
def _powers(code: int, a: np.ndarray, b: np.ndarray, out: np.ndarray) -> None:
    if code == _EXP:
        for i in range(out.size):
            out[i] = elementary.exp(a[i] if a[i] < 700.0 else 700.0)
    elif code == _LOG:
        for i in range(out.size):
            out[i] = elementary.log(abs(a[i]) + 1e-300)
    elif code == _POW:
        for i in range(out.size):
            out[i] = elementary.power(abs(a[i]), b[i])
    else:
        for i in range(out.size):
            out[i] = elementary.atan2(a[i], b[i])


@inner_uncounted
def _ramp(t: np.ndarray, width: np.ndarray, knots: np.ndarray, slope: int, out: np.ndarray) -> None:
    """Writes the mean of a piecewise linear function over t - width / 2 .. t + width / 2, or its slope; `knots`:
    places, which rise, then values; before the first and beyond the last it is level."""
    last = knots.size // 2 - 1
    values = knots[last + 1 :]
    for i in range(out.size):
        half = 0.5 * width[i] if width[i] > 1e-9 else 0.5e-9
        low, high = t[i] - half, t[i] + half
        if slope:
            out[i] = (_level(high, knots, values, last) - _level(low, knots, values, last)) / (2.0 * half)
            continue
        if not high - low > 0.0 or high <= knots[0] or low >= knots[last] or half <= 1e-6:
            out[i] = _level(t[i], knots, values, last)
            continue
        total = max(knots[0] - low, 0.0) * values[0] + max(high - knots[last], 0.0) * values[last]
        for k in range(last):
            left, right = max(low, knots[k]), min(high, knots[k + 1])
            if right > left:
                part = (0.5 * (left + right) - knots[k]) / (knots[k + 1] - knots[k])
                total += (right - left) * (values[k] + part * (values[k + 1] - values[k]))
        out[i] = total / (high - low)


@forced
def _level(t: float, knots: np.ndarray, values: np.ndarray, last: int) -> float:
    if not t > knots[0]:
        return float(values[0])
    for k in range(last):
        if t < knots[k + 1]:
            part = (t - knots[k]) / (knots[k + 1] - knots[k])
            return float(values[k] + part * (values[k + 1] - values[k]))
    return float(values[last])


@inner_uncounted
def _chance(a: np.ndarray, b: np.ndarray, key: np.uint32, out: np.ndarray) -> None:
    """Writes a random number of 0..1 for each pair of whole numbers."""
    for i in range(out.size):
        x = math.floor(a[i]) if abs(a[i]) < _FAR else 0
        y = math.floor(b[i]) if abs(b[i]) < _FAR else 0
        out[i] = np.float64(hash32(key, x, y) >> np.uint32(8)) * (1.0 / 16777216.0)


@inner_uncounted
def _scattered(
    op: np.ndarray, rows: tuple[np.ndarray, np.ndarray, tuple[np.ndarray, np.ndarray]], numbers: np.ndarray,
    keys: np.ndarray, room: np.ndarray, out: np.ndarray,
) -> None:  # fmt: skip
    """What is random by place: noise, white, cells."""
    u, v, widths = rows
    if op[0] == _NOISE:
        for i in range(out.size):
            out[i] = 0.0
        for n in range(op[8]):
            first = op[6] + 5 * n
            noise_row(u, v, widths, numbers[first : first + 5], keys[op[7] + n], room, out)
    elif op[0] == _WHITE:
        white_row(u, v, widths, keys[op[7]], op[8], room, out)
    else:
        cell_row(u, v, widths, numbers[op[6]], keys[op[7]], op[8], op[9], out)


@inner_uncounted
def _noise_and_slopes(
    op: np.ndarray, rows: tuple[np.ndarray, np.ndarray, tuple[np.ndarray, np.ndarray]], numbers: np.ndarray,
    keys: np.ndarray, room: np.ndarray, outs: tuple[np.ndarray, np.ndarray, np.ndarray],
) -> None:  # fmt: skip
    u, v, widths = rows
    for row in outs:
        for i in range(row.size):
            row[i] = 0.0
    for n in range(op[8]):
        first = op[6] + 5 * n
        noise_rows(u, v, widths, numbers[first : first + 5], keys[op[7] + n], room, outs)


@inner_uncounted
def _step(
    op: np.ndarray, numbers: np.ndarray, keys: np.ndarray, registers: np.ndarray, size: int, room: np.ndarray
) -> None:
    """Carries out one operation."""
    code, out = op[0], registers[op[1], :size]
    a, b = registers[op[2], :size], registers[op[3], :size]
    if code <= _LESS + 1:
        _of_two(code, a, b, out)
    elif code <= _TIMES:
        _of_one(code, a, numbers[op[6]], out)
    elif code == _SELECT:
        _picked(a, b, registers[op[4], :size], out)
    elif code == _WIDTH:
        _width(a, b, numbers[op[6]], out)
    elif code <= _TAN:
        _sines(code, a, out)
    elif code <= _POW:
        _powers(code, a, b, out)
    elif code <= _CELLS:
        rows = (a, b, (registers[op[4], :size], registers[op[5], :size]))
        if code == _NOISE and op[9] == WITH_SLOPES:
            outs = (out, registers[op[10], :size], registers[op[11], :size])
            _noise_and_slopes(op, rows, numbers, keys, room, outs)
        else:
            _scattered(op, rows, numbers, keys, room, out)
    elif code == _RAMP:
        _ramp(a, b, numbers[op[6] : op[6] + 2 * op[8]], op[9], out)
    elif code == _RANDOM:
        _chance(a, b, keys[op[7]], out)


@inner_uncounted
def _copied(row: np.ndarray, out: np.ndarray) -> None:
    for i in range(out.size):
        out[i] = row[i]


@inner_uncounted
def _gathered(value: np.ndarray, part: float, out: np.ndarray) -> None:
    for i in range(out.size):
        v = value[i]
        bounded = min(max(v, SHOWN_LEAST), SHOWN_MOST) if v == v else 0.0
        out[i] += np.float32(bounded * part)


@uncounted
def run(
    program: np.ndarray, numbers: np.ndarray, keys: np.ndarray, xs: np.ndarray, ys: np.ndarray, row: int,
    shown: np.ndarray, pictures: np.ndarray, registers: np.ndarray, room: np.ndarray, out: np.ndarray,
) -> None:  # fmt: skip
    """Adds the registers `shown`, a mean over the samples of each pixel, to out, float32 (channels, pixels).

    `xs`, `ys`: places of the samples, float64 (samples of a pixel, pixels); `row`: after so many pixels begins another
    row of them; `pictures`: float64 (n, samples of a pixel, pixels).
    """
    part = 1.0 / xs.shape[0]
    for start in range(0, out.shape[1], row):
        for left in range(start, min(start + row, out.shape[1]), LENGTH):
            end = min(left + LENGTH, start + row, out.shape[1])
            size = end - left
            for s in range(xs.shape[0]):
                for n in range(program.shape[0]):
                    op = program[n]
                    if op[0] == _X:
                        _copied(xs[s, left:end], registers[op[1], :size])
                    elif op[0] == _Y:
                        _copied(ys[s, left:end], registers[op[1], :size])
                    elif op[0] > _RANDOM:
                        _copied(pictures[op[8], s, left:end], registers[op[1], :size])
                    else:
                        _step(op, numbers, keys, registers, size, room)
                for c in range(shown.size):
                    _gathered(registers[shown[c], :size], part, out[c, left:end])
