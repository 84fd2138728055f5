"""Shaping tables: a curve of 0..1 into 0..1 that every value of a texture is sent through (Lewis 1984, section 6.1).

A curve is a name of CURVES, or knots (in, out), with straight lines between them and level ends: so is a curve drawn
by hand, which is some dozens of knots.  Tables of 1025 entries hold curves with corners at multiples of 1/1024
exactly; between entries values are interpolated.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numba import njit

STEPS = 1024

Knots = tuple[tuple[float, float], ...]
Shape = str | Knots  # a name, or knots (in, out)

_ZERO = np.float32(0.0)
_HALF = np.float32(0.5)
_ONE = np.float32(1.0)
_STEPS = np.float32(STEPS)
_LAST = np.int32(STEPS - 1)


@dataclass(frozen=True, slots=True)
class Curve:
    """A row: `of` takes float64 values 0..1 to values that are clipped to 0..1."""

    name: str
    label: str
    tooltip: str
    of: Callable[[np.ndarray], np.ndarray]


def _smooth(t: np.ndarray) -> np.ndarray:
    t = np.clip(t, 0.0, 1.0)
    return t * t * (3.0 - 2.0 * t)


def _wet(t: np.ndarray) -> np.ndarray:
    """Up within a tenth of the width, down to a third, and a little up again where the wash has settled."""
    return np.interp(t, (0.0, 0.1, 0.3, 0.6, 1.0), (0.75, 1.0, 0.62, 0.38, 0.45))


def _double(t: np.ndarray) -> np.ndarray:
    return np.clip(1.5 * np.cos(np.clip(t * 2.0, 0.0, 1.5) * 2.0 * np.pi), 0.0, 1.0)


def _rows(*rows: Curve) -> dict[str, Curve]:
    return {row.name: row for row in rows}


CURVES: dict[str, Curve] = _rows(
    Curve("identity", "As it is", "Leaves the texture as it is", lambda t: t),
    Curve("compress", "Compress", "Half the contrast, around the middle", lambda t: 0.25 + 0.5 * t),
    Curve("stretch", "Stretch", "Twice the contrast; what leaves the range is cut", lambda t: 2.0 * t - 0.5),
    Curve("negate", "Negate", "Dark for light: hills become hollows", lambda t: 1.0 - t),
    Curve("rectify", "Rectify", "Folds the dark half over the light one: creases", lambda t: np.abs(2.0 * t - 1.0)),
    Curve("clip", "Clip", "Keeps what is above the middle and cuts the rest", lambda t: 2.0 * t - 1.0),
    Curve("threshold", "Threshold", "Islands with hard shores: all or nothing", lambda t: _smooth(4.0 * t - 1.5)),
    Curve("power", "Power", "The square: peaks stand out", lambda t: t * t),
    Curve("root", "Root", "The square root: hollows fill", np.sqrt),
    Curve("gaps", "Gaps", "Covers all but the lowest hollows", lambda t: _smooth(3.0 * t - 0.6)),
    Curve("steps", "Steps", "Five flat steps", lambda t: np.floor(np.minimum(t * 5.0, 4.0)) / 4.0),
    Curve("bands", "Bands", "Three waves, like contour lines", lambda t: 0.5 - 0.5 * np.cos(6.0 * np.pi * t)),
)

# For the rim of a stroke: 0 at the rim itself, 1 a width inside it and beyond.
EDGES: dict[str, Curve] = _rows(
    Curve("wet", "Wet", "Pigment gathers at the rim and leaves the inside pale", _wet),
    Curve("dark", "Dark", "A little darker along the rim", lambda t: 1.0 - 0.4 * _smooth(t)),
    Curve("worn", "Worn", "The rim is rubbed thin", lambda t: 0.15 + 0.85 * _smooth(t)),
    Curve("soft", "Soft", "Fades towards the rim", _smooth),
    Curve("outline", "Outline", "The rim alone", lambda t: 1.0 - _smooth(2.5 * t - 1.0)),
    Curve("double", "Double", "The rim, and a second line inside it", _double),
)


@lru_cache(maxsize=256)
def table(curve: Shape, rows: str = "shaping") -> np.ndarray:
    """The values of a curve at 0, 1/1024, ..., 1: float32 (1025,), 0..1, not to be written to.

    `rows`: which table a name is of, "shaping" (CURVES) or "edge" (EDGES).  KeyError if it is none of it.
    """
    t = np.linspace(0.0, 1.0, STEPS + 1)
    named: Mapping[str, Curve] = CURVES if rows == "shaping" else EDGES
    values = named[curve].of(t) if isinstance(curve, str) else np.interp(t, *np.array(curve, np.float64).T)
    return np.clip(values, 0.0, 1.0).astype(np.float32)


def is_identity(curve: Shape | None) -> bool:
    """Whether a curve changes nothing."""
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


@njit(cache=True, nogil=True)
def look_up(values, curve, scale, offset):
    """values (n,) = (curve(scale values + offset) - offset) / scale, all float32."""
    back = _ONE / scale
    for i in range(values.size):
        t = min(max((values[i] * scale + offset) * _STEPS, _ZERO), _STEPS)
        k = min(np.int32(t), _LAST)
        low = curve[k]
        values[i] = (low + (curve[k + 1] - low) * (t - np.float32(k)) - offset) * back
