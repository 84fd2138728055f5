"""Formulas compiled: the tree of `formula.parse` to a loop over pixels, by way of text that `formula.printed` makes.

Every formula has a value everywhere: arithmetic is that of IEEE 754 in float64, roots and powers take the magnitude
of what is below them, logarithms are of the magnitude plus 1e-300, exponents end at 700, and a result that is not
finite counts as 0.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import lru_cache

import numpy as np
from numba import njit
from numba.core.types import Array, float32, float64, void

from engine.numeric import elementary
from engine.numeric.arithmetic import LIBRARY
from engine.numeric.formula import NAMES, Tree, printed
from engine.numeric.hashing import place64
from engine.numeric.kernel import dividing

MEMO = 64  # compiled formulas kept
_WHOLE = 2.0**31  # beyond, `noise` has no places
_KEY = np.uint64(0x6A09E667F3BCC908)


@dividing
def _sin(a: float) -> float:
    return math.sin(a)


@dividing
def _cos(a: float) -> float:
    return math.cos(a)


@dividing
def _tan(a: float) -> float:
    return math.tan(a)


@dividing
def _atan2(a: float, b: float) -> float:
    return math.atan2(a, b)


@dividing
def _sqrt(a: float) -> float:
    return math.sqrt(abs(a))


@dividing
def _abs(a: float) -> float:
    return abs(a)


@dividing
def _exp(a: float) -> float:
    return math.exp(a if a < 700.0 or a != a else 700.0)


@dividing
def _log(a: float) -> float:
    return math.log(abs(a) + 1e-300)


@dividing
def _floor(a: float) -> float:
    return np.floor(a)  # type: ignore[no-any-return]


@dividing
def _fract(a: float) -> float:
    return a - np.floor(a)  # type: ignore[no-any-return]


@dividing
def _min(a: float, b: float) -> float:
    return a if a < b or a != a else b  # what is no number stays none


@dividing
def _max(a: float, b: float) -> float:
    return a if a > b or a != a else b


@dividing
def _clamp(a: float, lo: float, hi: float) -> float:
    return _min(_max(a, lo), hi)


@dividing
def _mix(a: float, b: float, part: float) -> float:
    return a + (b - a) * part


@dividing
def _step(edge: float, a: float) -> float:
    return 1.0 if a >= edge else 0.0


@dividing
def _smoothstep(lo: float, hi: float, a: float) -> float:
    s = _clamp((a - lo) / (hi - lo), 0.0, 1.0)
    return s * s * (3.0 - 2.0 * s)


@dividing
def _pow(a: float, b: float) -> float:
    return abs(a) ** b  # type: ignore[no-any-return]


@dividing
def _own_exp(a: float) -> float:
    return elementary.exp(a if a < 700.0 or a != a else 700.0)


@dividing
def _own_log(a: float) -> float:
    return elementary.log(abs(a) + 1e-300)


@dividing
def _own_pow(a: float, b: float) -> float:
    return elementary.power(abs(a), b)


@dividing
def _mod(a: float, b: float) -> float:
    return a - b * np.floor(a / b)  # type: ignore[no-any-return]


@dividing
def _noise(a: float, b: float) -> float:
    """Returns a random number of 0..1 for the unit square of the plane that (a, b) lies in."""
    if not (abs(a) < _WHOLE and abs(b) < _WHOLE):
        return 0.0
    x, y = np.uint64(np.int64(np.floor(a)) & 0xFFFFFFFF), np.uint64(np.int64(np.floor(b)) & 0xFFFFFFFF)
    return np.float64(place64(_KEY, x, y) >> np.uint64(11)) * 2.0**-53


_ROWS = ("pic", "luma", "tex", "d", "pressure", "x", "y")  # one value a pixel
_SCALARS = ("colour", "level")
_SIGNATURE = void(
    *[Array(float32, 1, "C", readonly=True)] * len(_ROWS), *[float64] * len(_SCALARS), Array(float32, 1, "C")
)
_TEMPLATE = """
def kernel({arguments}, out):
    for i in range(out.size):
{rows}
        value = {body}
        out[i] = value if -1e6 < value < 1e6 else bounded(value)
"""


@dividing
def _bounded(value: float) -> float:
    """Returns what does not fit a pixel: 0 for what is no number, the nearest that fits for the others."""
    return 0.0 if not np.isfinite(value) else (1e6 if value > 0.0 else -1e6)


def source(tree: Tree) -> str:
    """Returns the text that is compiled for a checked tree: it holds names of this module, numbers and operators
    alone."""
    rows = "\n".join(f"        {name} = np.float64({name}_row[i])" for name in _ROWS)
    arguments = ", ".join([*(f"{name}_row" for name in _ROWS), *_SCALARS])
    return _TEMPLATE.format(arguments=arguments, rows=rows, body=printed(tree))


@lru_cache(MEMO)
def kernel(tree: Tree, arithmetic: int = LIBRARY) -> Callable[..., None]:
    """Returns the compiled loop of a checked tree: (pic, luma, tex, d, pressure, x, y, colour, level, out).

    `arithmetic`: that of the painting.  All but `colour` and `level`, which are floats, are C-contiguous float32 (n,);
    `out` is written: finite, within -1e6..1e6.  Raises nothing.
    """
    scope = dict(_SCOPE) if arithmetic == LIBRARY else _SCOPE | _OF_OUR_OWN
    exec(compile(source(tree), "<formula>", "exec"), scope)  # text printed here from a checked tree
    out: Callable[..., None] = njit(_SIGNATURE, nogil=True, error_model="numpy")(scope["kernel"])
    return out


_FUNCTIONS = (
    _sin, _cos, _tan, _atan2, _sqrt, _abs, _exp, _log, _floor, _fract,
    _min, _max, _clamp, _mix, _step, _smoothstep, _pow, _mod, _noise,
)  # fmt: skip
_SCOPE = {"__builtins__": {}, "range": range, "np": np, "bounded": _bounded} | {f.__name__: f for f in _FUNCTIONS}
# What takes the place of functions of the C library: the same bits on every processor.
_OF_OUR_OWN = {
    "_sin": elementary.sin,
    "_cos": elementary.cos,
    "_tan": elementary.tan,
    "_atan2": elementary.atan2,
    "_exp": _own_exp,
    "_log": _own_log,
    "_pow": _own_pow,
}
assert set(_ROWS) | set(_SCALARS) == set(NAMES)
