"""The named shaping curves (Lewis 1984, section 6.1), as rows: light to import, for brushes and for the window.

Their tables and the kernel that looks values up are in `shaping`.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

KNOTS_CAP = 64

_QUARTER_HIGH, _QUARTER_LOW = 1.5707963267341256, 6.077100506506192e-11  # pi/2; the first has 33 bits
_Knots = tuple[tuple[float, float], ...]
Shape = str | _Knots  # a name, or knots (in, out)


@dataclass(frozen=True, slots=True)
class Curve:
    """A row: `of` takes float64 values 0..1 to values that are clipped to 0..1."""

    name: str
    label: str
    tooltip: str
    of: Callable[[np.ndarray], np.ndarray]


def _smooth(t: np.ndarray) -> np.ndarray:
    t = np.clip(t, 0.0, 1.0)
    out: np.ndarray = t * t * (3.0 - 2.0 * t)
    return out


def _wet(t: np.ndarray) -> np.ndarray:
    """Up within a tenth of the width, down to a third, and a little up again where the wash has settled."""
    out: np.ndarray = np.interp(t, (0.0, 0.06, 0.22, 0.5, 1.0), (0.85, 1.0, 0.6, 0.4, 0.46))
    return out


def _cosine(angle: np.ndarray) -> np.ndarray:
    """The same bits everywhere, by sums and products alone, for some turns.  Not `elementary.cos`: that needs numba."""
    quarters = np.rint(angle * (2.0 / np.pi))
    left = (angle - quarters * _QUARTER_HIGH) - quarters * _QUARTER_LOW
    square, odd, even = left * left, np.ones_like(left), np.ones_like(left)
    for n in range(10, 0, -1):
        odd = 1.0 - odd * square / (2 * n * (2 * n + 1))
        even = 1.0 - even * square / (2 * n * (2 * n - 1))
    value = np.where(quarters % 2.0 == 0.0, even, -left * odd)
    return np.where(quarters % 4.0 >= 2.0, -value, value)


def _double(t: np.ndarray) -> np.ndarray:
    return np.clip(1.5 * _cosine(np.clip(t * 2.0, 0.0, 1.5) * 2.0 * np.pi), 0.0, 1.0)


def smooth_curve(knots: _Knots, t: np.ndarray) -> np.ndarray:
    """Returns a smooth curve through knots at float64 values t: rising where they rise, level beyond the ends.

    Cubic pieces with the slopes of Fritsch and Butland 1984, by sums, products and quotients alone: the same bits
    everywhere.
    """
    x, y = np.array(knots, np.float64).T
    if len(x) == 1:
        return np.full_like(t, y[0])
    wide = np.diff(x)
    steep = np.diff(y) / wide
    slopes = np.concatenate((steep[:1], np.zeros(len(x) - 2), steep[-1:]))
    inner = np.flatnonzero(steep[:-1] * steep[1:] > 0.0)
    one, other = 2.0 * wide[inner + 1] + wide[inner], wide[inner + 1] + 2.0 * wide[inner]
    slopes[1 + inner] = (one + other) / (one / steep[inner] + other / steep[inner + 1])
    i = np.clip(np.searchsorted(x, t, side="right") - 1, 0, len(x) - 2)
    u = np.clip((t - x[i]) / wide[i], 0.0, 1.0)
    back = 1.0 - u
    rise = u * u * (3.0 - 2.0 * u)
    out: np.ndarray = y[i] + rise * (y[i + 1] - y[i]) + wide[i] * u * back * (slopes[i] * back - slopes[i + 1] * u)
    return out


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
    Curve("bands", "Bands", "Three waves, like contour lines", lambda t: 0.5 - 0.5 * _cosine(6.0 * np.pi * t)),
)

# For the rim of a stroke: 0 at the rim itself, 1 a width inside it and beyond.
EDGES: dict[str, Curve] = _rows(
    Curve("wet", "Wet", "Pigment gathers at the rim and leaves the inside pale", _wet),
    Curve("dark", "Dark", "A little darker along the rim", lambda t: 1.0 - 0.4 * _smooth(t)),
    Curve("worn", "Worn", "The rim is rubbed thin", lambda t: 0.08 + 0.92 * _smooth(t)),
    Curve("soft", "Soft", "Fades towards the rim", _smooth),
    Curve("outline", "Outline", "The rim alone", lambda t: 1.0 - _smooth(2.5 * t - 1.0)),
    Curve("double", "Double", "The rim, and a second line inside it", _double),
)
