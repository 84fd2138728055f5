"""Kinds of neighbourhoods: how steep a picture is about a pixel, and which way it falls, in eight directions of waves.

By the structure tensor of 3 x 3 differences.  A neighbourhood that falls in no direction has a kind of its own.
"""

from __future__ import annotations

import numpy as np

from engine.numeric.kernel import Array, inner, kernel
from engine.texture.learnt.maps import HEADINGS

LOOKED_ROUND = 2  # pixels around a pixel that say of which kind it is
_EIGHTH = np.float32(0.41421356)  # the tangent of an eighth of half a turn
_DIRECTED = np.float32(0.2)  # of the squared steepness: what falls less in one direction has none
_SIXTEENTH, _TWO = np.float32(0.0625), np.float32(2.0)


def kinds_of(plane: np.ndarray, edges: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Returns of a plane (h + 4, w + 4), float32, the kinds int16 (h, w), and how steep it is, squared: float32 (h, w).

    `edges`: slopes, in rising order, between which kinds lie."""
    height, width = plane.shape[0] - 2 * LOOKED_ROUND, plane.shape[1] - 2 * LOOKED_ROUND
    kinds, steep = np.empty((height, width), np.int16), np.empty((height, width), np.float32)
    _tell_kinds(plane, np.ascontiguousarray(edges * edges), kinds, steep)
    return kinds, steep


def liveliness(steep: np.ndarray, edges: np.ndarray) -> np.ndarray:
    """Tells how much noise is due where it is so steep, squared: less, the less steep it is below the first edge, so
    that what is smooth stays smooth; float32, 0..1."""
    least = np.float32(edges[0] * edges[0]) + np.float32(1e-20)
    out: np.ndarray = np.sqrt(np.minimum(steep / least, np.float32(1.0)))
    return out


@kernel
def _tell_kinds(plane: Array, edges: Array, kinds: Array, steep: Array) -> None:
    height, width = kinds.shape
    across = np.empty((3, height + 2, width + 2), np.float32)
    for y in range(height + 2):
        above, here, below = plane[y], plane[y + 1], plane[y + 2]
        xx, yy, xy = across[0, y], across[1, y], across[2, y]
        for x in range(width + 2):
            u, v = here[x + 2] - here[x], below[x + 1] - above[x + 1]
            xx[x], yy[x], xy[x] = u * u, v * v, u * v
    for y in range(height):
        kind, slope = kinds[y], steep[y]
        for x in range(width):
            xx, yy, xy = _about(across[0], y, x), _about(across[1], y, x), _about(across[2], y, x)
            slope[x] = xx + yy
            kind[x] = _direction(xx - yy, _TWO * xy, xx + yy)
            for edge in edges:
                if slope[x] > edge:
                    kind[x] += HEADINGS + 1


@inner
def _about(values: Array, y: int, x: int) -> np.float32:
    """The mean over 3 x 3, the middle counting most."""
    a, b, c = values[y], values[y + 1], values[y + 2]
    above, here, below = (
        (a[x] + a[x + 2]) + _TWO * a[x + 1],
        (b[x] + b[x + 2]) + _TWO * b[x + 1],
        (c[x] + c[x + 2]) + _TWO * c[x + 1],
    )
    found: np.float32 = ((above + below) + _TWO * here) * _SIXTEENTH
    return found


@inner
def _direction(a: np.float32, b: np.float32, steep: np.float32) -> int:
    """Of the doubled angle whose cosine and sine go as a and b: 0 to 7; 8 for none."""
    if a * a + b * b < _DIRECTED * steep * steep:
        return HEADINGS
    if abs(b) <= _EIGHTH * abs(a):
        return 0 if a > 0 else 4
    if abs(a) <= _EIGHTH * abs(b):
        return 2 if b > 0 else 6
    if b > 0:
        return 1 if a > 0 else 3
    return 7 if a > 0 else 5
