"""Shaping tables: a curve of 0..1 into 0..1 that every value of a texture is sent through (Lewis 1984, section 6.1).

A curve is a name of CURVES, or knots (in, out), with straight lines between them and level ends: so is a curve drawn
by hand, which is some dozens of knots.  Tables of 1025 entries hold curves with corners at multiples of 1/1024
exactly; between entries values are interpolated.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache

import numpy as np

from engine.numeric.curves import CURVES, EDGES, KNOTS_CAP, Curve, Shape
from engine.numeric.kernel import kernel

__all__ = ["CURVES", "EDGES", "KNOTS_CAP", "Shape", "is_identity", "look_up", "shape", "shape_signed", "table"]

STEPS = 1024

_ZERO = np.float32(0.0)
_HALF = np.float32(0.5)
_ONE = np.float32(1.0)
_STEPS = np.float32(STEPS)
_LAST = np.int32(STEPS - 1)


@lru_cache(maxsize=256)
def table(curve: Shape, rows: str = "shaping") -> np.ndarray:
    """Returns the values of a curve at 0, 1/1024, ..., 1: float32 (1025,), 0..1, not to be written to.

    `rows`: which table a name is of, "shaping" (CURVES) or "edge" (EDGES).  KeyError if it is none of it.
    """
    t = np.linspace(0.0, 1.0, STEPS + 1)
    named: Mapping[str, Curve] = CURVES if rows == "shaping" else EDGES
    values = named[curve].of(t) if isinstance(curve, str) else np.interp(t, *np.array(curve, np.float64).T)
    return np.clip(values, 0.0, 1.0).astype(np.float32)


def is_identity(curve: Shape | None) -> bool:
    """Tells whether a curve changes nothing."""
    return curve is None or bool((table(curve) == table("identity")).all())


def shape(values: np.ndarray, curve: np.ndarray) -> np.ndarray:
    """`values`, float32 of any shape, through a table: a new array; outside 0..1 the ends of the table hold."""
    out = np.array(values, np.float32, order="C")
    look_up(out.reshape(-1), curve, _ONE, _ZERO)
    return out


def shape_signed(values: np.ndarray, curve: np.ndarray) -> np.ndarray:
    """As `shape` for S of -1..1: s = (S + 1)/2 goes through the table."""
    out = np.array(values, np.float32, order="C")
    look_up(out.reshape(-1), curve, _HALF, _HALF)
    return out


@kernel
def look_up(values: np.ndarray, curve: np.ndarray, scale: np.float32, offset: np.float32) -> None:
    """values (n,) = (curve(scale values + offset) - offset) / scale, all float32."""
    back = _ONE / scale
    for i in range(values.size):
        t = min(max((values[i] * scale + offset) * _STEPS, _ZERO), _STEPS)
        k = min(np.int32(t), _LAST)
        low = curve[k]
        values[i] = (low + (curve[k + 1] - low) * (t - np.float32(k)) - offset) * back
