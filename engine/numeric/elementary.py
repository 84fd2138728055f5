"""Elementary functions of our own: the same bits on every processor, with every version of every library.

They are made of + - * /, floor and the bits of floats alone, all of which IEEE 754 settles; nothing here may be
compiled with a licence to reorder or to fuse.  Leading parts are carried as the sum of two floats (Dekker 1971), the
rest are Taylor series.  Errors, in units of the last place: exp, exp2, log, log2, log1p, power and atan2 stay below
0.7, sin and cos below 0.8, tan and expm1 below 2.5; sin, cos and tan of what lies beyond 2^20 are right to 2^-52.
Loops over them vectorise: exp, sin, cos and tan take a third of the C library's time in a loop, log four fifths, power
five times as long.

Each is a plain function of floats, which Python may call and kernels are made with; `mapped` does a whole array.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from engine.numeric import exact_constants as c
from engine.numeric.kernel import dividing, forced

_INFINITY, _NONE = math.inf, math.nan
_SPLIT = 134217729.0  # 2^27 + 1: Dekker's
_PI, _LN2 = c.pi(), c.logarithm_of_2()
_LN2_A, _LN2_B = c.parts(_LN2, 32, 53)  # the first times an exponent is exact
_LN2_HIGH, _LN2_LOW = c.parts(_LN2, 53, 53)
_PER_LN2, _PER_LN2_LOW = c.parts((1 << 2 * c.BITS) // _LN2, 53, 53)
_HIGHEST, _LOWEST = 709.79, -745.14  # beyond, e^x is infinite, or nothing
_STEEP = 1e22  # powers beyond are 0, 1 or infinite
_LEAST = 2.0**-1022  # of floats with all their bits
_ROOT_HALF = 0x3FE6A09E667F3BCD  # the bits of 2^-1/2
_THIRD_HIGH, _THIRD_LOW = c.parts((1 << c.BITS) // 3, 53, 53)
_QUARTER_A, _QUARTER_B, _QUARTER_C, _QUARTER_D = c.parts(_PI >> 1, 33, 33, 33, 53)  # pi/2, for turns up to 2^20
_QUARTER_HIGH, _QUARTER_LOW = c.parts(_PI >> 1, 53, 53)
_PER_QUARTER = c.parts((2 << 2 * c.BITS) // _PI, 53)[0]
_NEAR = 2.0**20  # angles up to which three parts of pi/2 do
_FIRST = -33  # exponents of 2 in the table
_TURNS = c.remainders(_FIRST, 1000)
_STEPS = 8
_ARCS = c.arctangents(_STEPS)


# ---- sums and products as two floats --------------------------------------------------------------------------------


@forced
def _sum(a: float, b: float) -> tuple[float, float]:
    s = a + b
    t = s - a
    return s, (a - (s - t)) + (b - t)


@forced
def _product(a: float, b: float) -> tuple[float, float]:
    p = a * b
    t = _SPLIT * a
    a1 = t - (t - a)
    a2 = a - a1
    t = _SPLIT * b
    b1 = t - (t - b)
    b2 = b - b1
    return p, ((a1 * b1 - p) + a1 * b2 + a2 * b1) + a2 * b2


# ---- exponentials and logarithms ------------------------------------------------------------------------------------


@forced
def _two_to(n: int) -> float:
    """2^n, n from -1022 to 1023."""
    return float(np.int64(np.int64(n + 1023) << np.int64(52)).view(np.float64))


@forced
def _scaled(value: float, n: int) -> float:
    half = n >> 1
    return value * _two_to(half) * _two_to(n - half)


@forced
def _beyond_line(t: float) -> float:
    """(e^t - 1 - t) / t^2 for |t| up to 0.35."""
    return 0.5 + t * (
        1 / 6 + t * (1 / 24 + t * (1 / 120 + t * (1 / 720 + t * (1 / 5040 + t * (1 / 40320 + t * (1 / 362880 + t * (
            1 / 3628800 + t * (1 / 39916800 + t * (1 / 479001600 + t * (1 / 6227020800)))))))))))  # fmt: skip


@forced
def _grown(t: float, low: float) -> float:
    """e^(t + low), |t| up to 0.35, low beside it next to nothing."""
    s = 1.0 + t
    return s + ((t - (s - 1.0)) + (t * t * _beyond_line(t) + low * s))


@forced
def _raised(x: float, low: float) -> float:
    """e^(x + low), low beside x next to nothing."""
    if x != x:
        return x
    if x > _HIGHEST:
        return _INFINITY
    if x < _LOWEST:
        return 0.0
    k = math.floor(x * _PER_LN2 + 0.5)
    t, more = _sum(x - k * _LN2_A, low - k * _LN2_B)
    return _scaled(_grown(t, more), k)


@forced
def _logarithm(x: float) -> tuple[float, float]:
    """ln x as two floats, x finite and above 0."""
    e = np.int64(0)
    if x < _LEAST:
        x *= 18014398509481984.0  # 2^54
        e = np.int64(-54)
    bits = np.float64(x).view(np.int64)
    k = (bits - np.int64(_ROOT_HALF)) >> np.int64(52)
    m = float(np.int64(bits - (k << np.int64(52))).view(np.float64))  # from 2^-1/2 to 2^1/2
    n, (d, rest) = m - 1.0, _sum(m, 1.0)
    s = n / d
    p, q = _product(s, d)
    low = ((n - p) - q - s * rest) / d
    z, y = _product(s, s)
    y += 2.0 * s * low
    cube, more = _product(s, z)
    more += s * y + low * z
    third, even = _product(cube, _THIRD_HIGH)
    even += more * _THIRD_HIGH + cube * _THIRD_LOW
    tail = cube * z * (
        1 / 5 + z * (1 / 7 + z * (1 / 9 + z * (1 / 11 + z * (1 / 13 + z * (1 / 15 + z * (1 / 17 + z * (1 / 19 + z * (
            1 / 21 + z * (1 / 23 + z * (1 / 25 + z * (1 / 27))))))))))))  # fmt: skip
    high, more = _sum(s, third)
    more += low + even + tail
    whole = float(e + k)
    high, rest = _sum(whole * _LN2_A, 2.0 * high)
    return _sum(high, rest + (2.0 * more + whole * _LN2_B))


@forced
def exp(x: float) -> float:
    """e^x."""
    return _raised(x, 0.0)


@forced
def expm1(x: float) -> float:
    """e^x - 1."""
    return x + x * x * _beyond_line(x) if -0.35 < x < 0.35 else _raised(x, 0.0) - 1.0


@forced
def exp2(x: float) -> float:
    """2^x, exactly where x is whole."""
    if not -1075.0 < x < 1024.0:
        return x if x != x else (_INFINITY if x > 0.0 else 0.0)
    k = math.floor(x + 0.5)
    p, q = _product(x - k, _LN2_HIGH)
    return _scaled(_grown(p, q + (x - k) * _LN2_LOW), k)


@forced
def log(x: float) -> float:
    """The natural logarithm; -infinity of 0, none of what is below."""
    if not 0.0 < x < _INFINITY:
        return -_INFINITY if x == 0.0 else (x if x > 0.0 else _NONE)
    high, low = _logarithm(x)
    return high + low


@forced
def log1p(x: float) -> float:
    """ln(1 + x)."""
    if not -1.0 < x < _INFINITY:
        return -_INFINITY if x == -1.0 else (x if x > 0.0 else _NONE)
    s, rest = _sum(1.0, x)
    high, low = _logarithm(s)
    return high + (low + rest / s)


@forced
def log2(x: float) -> float:
    """The binary logarithm, exactly where that is whole."""
    if not 0.0 < x < _INFINITY:
        return -_INFINITY if x == 0.0 else (x if x > 0.0 else _NONE)
    high, low = _logarithm(x)
    k = math.floor(high * _PER_LN2 + 0.5)
    if -1022 <= k <= 1023 and x == _two_to(k):
        return float(k)
    p, q = _product(high, _PER_LN2)
    return p + (q + (high * _PER_LN2_LOW + low * _PER_LN2))


@forced
def power(x: float, y: float) -> float:
    """x^y for x from 0 on; no number for x below 0."""
    if y == 0.0 or x == 1.0:
        return 1.0
    if x != x or y != y or x < 0.0:
        return _NONE
    if x == 0.0 or x == _INFINITY or abs(y) > _STEEP:
        return _INFINITY if (x > 1.0) == (y > 0.0) else 0.0
    high, low = _logarithm(x)
    p, q = _product(y, high)
    return _raised(p, q + y * low)


# ---- angles ---------------------------------------------------------------------------------------------------------


@forced
def _turned(x: float) -> tuple[int, float, float]:
    """x as quarter turns, modulo 4 of them, and what is left, at most an eighth of a turn, as two floats."""
    if abs(x) < _NEAR:
        k = math.floor(x * _PER_QUARTER + 0.5)
        a, low = _sum(x - k * _QUARTER_A, -k * _QUARTER_B)
        a, more = _sum(a, -k * _QUARTER_C)
        a, low = _sum(a, low + (more - k * _QUARTER_D))
        return k & 3, a, low
    bits = np.float64(abs(x)).view(np.int64)
    e = int(bits >> np.int64(52)) - 1075
    m = (bits & np.int64(0xFFFFFFFFFFFFF)) | np.int64(0x10000000000000)
    halves = (float(m >> np.int64(27)), float(m & np.int64(0x7FFFFFF)))
    high, low = 0.0, 0.0
    for n in range(4):
        high, more = _sum(high, halves[0] * float(_TURNS[e + 27 - _FIRST, n]))
        low += more
        high, more = _sum(high, halves[1] * float(_TURNS[e - _FIRST, n]))
        low += more
    k = math.floor(high * _PER_QUARTER + 0.5)
    p, q = _product(float(k), _QUARTER_HIGH)
    high, more = _sum(high, -p)
    high, low = _sum(high, low + (more - q - k * _QUARTER_LOW))
    return (k & 3, high, low) if x > 0.0 else (-k & 3, -high, -low)


@forced
def _sine(y: float, low: float) -> float:
    z = y * y
    series = -1 / 6 + z * (1 / 120 + z * (-1 / 5040 + z * (1 / 362880 + z * (-1 / 39916800 + z * (
        1 / 6227020800 + z * (-1 / 1307674368000 + z * (1 / 355687428096000)))))))  # fmt: skip
    return y + (low * (1.0 - 0.5 * z) + y * z * series)


@forced
def _cosine(y: float, low: float) -> float:
    z = y * y
    half = 0.5 * z
    w = 1.0 - half
    series = 1 / 24 + z * (-1 / 720 + z * (1 / 40320 + z * (-1 / 3628800 + z * (1 / 479001600 + z * (
        -1 / 87178291200 + z * (1 / 20922789888000))))))  # fmt: skip
    return w + (((1.0 - w) - half) + (z * z * series - y * low))


@forced
def sin(x: float) -> float:
    """The sine of x radians."""
    if not abs(x) < _INFINITY:
        return _NONE
    n, y, low = _turned(x)
    value = _cosine(y, low) if n & 1 else _sine(y, low)
    return -value if n & 2 else value


@forced
def cos(x: float) -> float:
    """The cosine of x radians."""
    if not abs(x) < _INFINITY:
        return _NONE
    n, y, low = _turned(x)
    value = _sine(y, low) if n & 1 else _cosine(y, low)
    return -value if (n + 1) & 2 else value


@forced
def tan(x: float) -> float:
    """The tangent of x radians."""
    if not abs(x) < _INFINITY:
        return _NONE
    n, y, low = _turned(x)
    s, t = _sine(y, low), _cosine(y, low)
    return -t / s if n & 1 else s / t


@forced
def _arc(a: float, b: float) -> tuple[float, float]:
    """atan(a / b), 0 <= a <= b, b above 0, as two floats."""
    if b > 2.0**900 or b < 2.0**-900:
        scale = 2.0**-400 if b > 1.0 else 2.0**150
        a, b = a * scale, b * scale
    i = math.floor(_STEPS * (a / b) + 0.5)
    at = i / _STEPS
    p, q = _product(at, b)
    n, more = _sum(a - p, -q)
    p, q = _product(at, a)
    d, rest = _sum(b, p)
    t = n / d
    p, e = _product(t, d)
    low = ((n - p) - e + more - t * (rest + q)) / d
    z = t * t
    series = -1 / 3 + z * (1 / 5 + z * (-1 / 7 + z * (1 / 9 + z * (-1 / 11 + z * (1 / 13)))))
    s, rest = _sum(float(_ARCS[i, 0]), t)
    return _sum(s, rest + (float(_ARCS[i, 1]) + low + t * z * series))


@forced
def atan2(y: float, x: float) -> float:
    """The angle of (x, y) from the x axis, -pi..pi; of zeros and infinities as C has it."""
    if x != x or y != y:
        return _NONE
    down, across = abs(y), abs(x)
    if down == _INFINITY or across == _INFINITY:
        down, across = (1.0 if down == _INFINITY else 0.0), (1.0 if across == _INFINITY else 0.0)
    high, low = 0.0, 0.0
    if down > across:
        high, low = _arc(across, down)
        high, more = _sum(_QUARTER_HIGH, -high)
        low = more + (_QUARTER_LOW - low)
    elif down > 0.0:
        high, low = _arc(down, across)
    if math.copysign(1.0, x) < 0.0:
        high, more = _sum(2.0 * _QUARTER_HIGH, -high)
        low = more + (2.0 * _QUARTER_LOW - low)
    return math.copysign(high + low, y)


@forced
def atan(x: float) -> float:
    """The arc tangent, -pi/2..pi/2."""
    return atan2(x, 1.0)


# ---- arrays ---------------------------------------------------------------------------------------------------------

Function = Callable[[float], float]


def _loop(function: Function) -> Callable[[np.ndarray, np.ndarray], None]:
    @dividing
    def loop(x: np.ndarray, out: np.ndarray) -> None:
        for i in range(x.size):
            out[i] = function(np.float64(x[i]))

    return loop


_MAPPED: tuple[Function, ...] = (exp, expm1, exp2, log, log1p, log2, sin, cos, tan, atan)
_LOOPS = {function: _loop(function) for function in _MAPPED}


def mapped(function: Function, values: np.ndarray) -> np.ndarray:
    """Returns a function of this module of every value: worked out in float64, as wide as `values` is."""
    given: np.ndarray = np.ascontiguousarray(values)
    out = np.empty(given.shape, given.dtype if given.dtype == np.float32 else np.float64)
    _LOOPS[function](given.reshape(-1), out.reshape(-1))
    return out


@dividing
def _angles(y: np.ndarray, x: np.ndarray, out: np.ndarray) -> None:
    for i in range(x.size):
        out[i] = atan2(np.float64(y[i]), np.float64(x[i]))


@dividing
def _powers(x: np.ndarray, y: float, out: np.ndarray) -> None:
    for i in range(x.size):
        out[i] = power(np.float64(x[i]), y)


def powers(values: np.ndarray, exponent: float) -> np.ndarray:
    """Returns `power` of every value, as `mapped`."""
    given: np.ndarray = np.ascontiguousarray(values)
    out = np.empty(given.shape, given.dtype if given.dtype == np.float32 else np.float64)
    _powers(given.reshape(-1), exponent, out.reshape(-1))
    return out


def angles(down: np.ndarray, across: np.ndarray) -> np.ndarray:
    """Returns `atan2` of two arrays of one shape, as `mapped`."""
    y, x = np.ascontiguousarray(down), np.ascontiguousarray(across)
    out = np.empty(x.shape, x.dtype if x.dtype == np.float32 else np.float64)
    _angles(y.reshape(-1), x.reshape(-1), out.reshape(-1))
    return out
