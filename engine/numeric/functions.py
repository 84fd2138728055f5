"""The elementary functions of single floats that each arithmetic has."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

from engine.numeric import elementary
from engine.numeric.arithmetic import EVERYWHERE, LIBRARY

_OfOne = Callable[[float], float]
_OfTwo = Callable[[float, float], float]


@dataclass(frozen=True, slots=True)
class Functions:
    """`power` is that of what is at least 0."""

    two_to: _OfOne
    log2: _OfOne
    sin: _OfOne
    cos: _OfOne
    power: _OfTwo


def _two_to(x: float) -> float:
    out: float = 2.0**x
    return out


def _power(x: float, y: float) -> float:
    out: float = x**y
    return out


_ROWS = {
    LIBRARY: Functions(_two_to, math.log2, math.sin, math.cos, _power),
    EVERYWHERE: Functions(elementary.exp2, elementary.log2, elementary.sin, elementary.cos, elementary.power),
}


def functions(arithmetic: int) -> Functions:
    """Returns the functions of an arithmetic."""
    return _ROWS[arithmetic]
