"""What a region painted with an example looks like below its own pixels: the B-spline of them, as everywhere on the
canvas, and the finer pixels that the example has where they come from.

The sources go on beyond the region's rim, so that the example's own rim is seen there: what an example shows is one
copy of it then, S_k, with what its pixels are otherwise spread over it.
"""

from __future__ import annotations

import numpy as np
from numba import njit

from engine.numeric.address import Rect
from engine.numeric.grid import snap
from engine.numeric.pyramid import expand_into
from engine.texture.example import show, tiles
from engine.texture.example.correction import OUTSIDE
from engine.texture.example.exemplar import PAD
from engine.texture.example.region import Region
from engine.texture.example.tiles import Tiles

HALO = 3  # pixels around the ancestors of a rectangle: what all finer levels of it can read
BEYOND = 2  # pixels beyond the rim that have a source: as far as a B-spline spreads
_SMALL = 1 << 10  # pixels of a rectangle that is looked at for being of one colour
_RGBA = np.arange(4)
# The neighbours whose sources go on to a pixel, the nearest first.
_NEAR = np.array(
    sorted(
        ((dy, dx) for dy in range(-BEYOND, BEYOND + 1) for dx in range(-BEYOND, BEYOND + 1)),
        key=lambda at: (at[0] ** 2 + at[1] ** 2, at),
    ),
    np.int64,
)


def expanded(base: Tiles, region: Region, finer: int, rect: Rect) -> tuple[np.ndarray, Rect]:
    """What is shown `finer` levels below the region's own, of whose pixels `base` holds the colours: read-only float32
    (4, h, w) of a rectangle around `rect`, and that rectangle.

    With the example's detail it is S_k + E^k (what is shown - S_0), k being `finer` or as many levels as the example
    has; E expands by one level.
    """

    def needed(k: int) -> Rect:
        return rect.evened() if k == finer else rect.zoomed(k - finer).grown(HALO).evened()

    at = needed(0)
    value = tiles.gathered(base, at, np.zeros((4, at.height, at.width), np.float32))
    detailed = min(len(region.exemplar.finer), finer)
    names = _names(region, at) if detailed else None
    if names is not None:
        _add(value, names, region.exemplar.colours[0], 0, 0, 0, np.float32(-1.0))
    for k in range(1, finer + 1):
        if k > detailed and at.area <= _SMALL and (value == value[:, :1, :1]).all():
            at, value = rect, np.tile(value[:, :1, :1], (1, rect.height, rect.width))
            break
        inner = needed(k)
        value, at = _expand(value, at, inner), inner
        if names is not None and k == detailed:
            first = needed(0)
            top, left = at.y0 - (first.y0 << k), at.x0 - (first.x0 << k)
            _add(value, names, region.exemplar.finer[k - 1], k, top, left, np.float32(1.0))
            np.clip(value[3], 0.0, 1.0, out=value[3])
            np.clip(value[:3], 0.0, value[3], out=value[:3])
    value.flags.writeable = False  # as tiles are: so the kernel is compiled once
    return value, at


def _expand(value: np.ndarray, at: Rect, inner: Rect) -> np.ndarray:
    out = np.empty((4, inner.height, inner.width), np.float32)
    top, left = (inner.y0 >> 1) - 1 - at.y0, (inner.x0 >> 1) - 1 - at.x0
    expand_into(value, top, left, _RGBA, out, 0, inner.height)
    return out


def _names(region: Region, rect: Rect) -> np.ndarray:
    """Sources of the pixels of a rectangle, int32 (h, w), going on `BEYOND` pixels outside the region."""
    wide = rect.grown(BEYOND)
    names = show.sources(region, wide)
    mask = tiles.gathered(region.masks[0], wide, np.zeros((1, wide.height, wide.width), np.uint8))[0]
    names[mask == 0] = OUTSIDE
    out = np.empty((rect.height, rect.width), np.int32)
    _continued(names, _NEAR, out)
    return out


@njit(cache=True, nogil=True)
def _continued(names, near, out):
    """For each pixel of `out` the source that its nearest neighbour in `names` (BEYOND pixels more on each side)
    continues with; OUTSIDE where there is none."""
    for y in range(out.shape[0]):
        for x in range(out.shape[1]):
            out[y, x] = OUTSIDE
            for i in range(near.shape[0]):
                dy, dx = near[i]
                source = names[y + BEYOND + dy, x + BEYOND + dx]
                if source >= 0:
                    out[y, x] = source - (dy << 16) - dx
                    break


@njit(cache=True, nogil=True)
def _add(value, names, colours, k, top, left, factor):
    """Adds to `value` (4, h, w), `k` levels below `names` and `top`, `left` pixels from their first one, what the
    example has there, `colours` (rows, columns, 4), on the grid."""
    side = 1 << k
    for y in range(value.shape[1]):
        row = (y + top) >> k
        for x in range(value.shape[2]):
            source = names[row, (x + left) >> k]
            if source < 0:
                continue
            i = ((source >> 16) - PAD) * side + ((y + top) & (side - 1))
            j = ((source & 0xFFFF) - PAD) * side + ((x + left) & (side - 1))
            if 0 <= i < colours.shape[0] and 0 <= j < colours.shape[1]:
                for c in range(4):
                    value[c, y, x] += factor * snap(colours[i, j, c])
