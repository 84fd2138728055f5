"""What a region painted with an example looks like below its own pixels: the B-spline of them, as everywhere on the
canvas, and the finer pixels that the example has where they come from, or that were learnt of it (`learnt_below`).

The sources go on beyond the region's rim, so that the example's own rim is seen there; where the example goes on too,
the region ends along the B-spline of its pixels.  Between pixels that come from different places of the example, what
lies below both fades from one to the other.
"""

from __future__ import annotations

import numpy as np

from engine.canvas.grown import learnt_below
from engine.numeric.address import Rect
from engine.numeric.grid import FINE_STEP, snap
from engine.numeric.kernel import kernel
from engine.numeric.pyramid import expand_into
from engine.texture.example import show, tiles
from engine.texture.example.exemplar import PAD
from engine.texture.example.region import Region
from engine.texture.example.region_window import OUTSIDE
from engine.texture.example.tiles import Tiles

HALO = 3  # pixels around the ancestors of a rectangle: what all finer levels of it can read
BEYOND = 2  # pixels beyond the rim that have a source: as far as a B-spline spreads
_SMALL = 1 << 10  # pixels of a rectangle that is looked at for being of one colour
# The neighbours whose sources go on to a pixel, the nearest first.
_NEAR = np.array(
    sorted(
        ((dy, dx) for dy in range(-BEYOND, BEYOND + 1) for dx in range(-BEYOND, BEYOND + 1)),
        key=lambda at: (at[0] ** 2 + at[1] ** 2, at),
    ),
    np.int64,
)


def expanded(base: Tiles, region: Region, finer: int, rect: Rect) -> tuple[np.ndarray, Rect]:
    """Returns what is shown `finer` levels below the region's own, of whose pixels `base` holds the colours:
    read-only float32 (4, h, w) of a rectangle around `rect`, and that rectangle."""

    def needed(k: int) -> Rect:
        return rect.evened() if k == finer else rect.zoomed(k - finer).grown(HALO).evened()

    detailed = min(len(region.exemplar.finer), finer)
    octaves = min(region.exemplar.octaves, finer - detailed)
    at = needed(detailed + octaves)
    learning = region.exemplar.learning
    if octaves and learning is not None:
        value = learnt_below.below_own(learning, octaves, at, lambda place: _own(base, region, detailed, place))
    else:
        value = _own(base, region, detailed, at)
    for k in range(detailed + octaves + 1, finer + 1):
        if at.area <= _SMALL and (value == value[:, :1, :1]).all():
            at, value = rect, np.tile(value[:, :1, :1], (1, rect.height, rect.width))
            break
        inner = needed(k)
        value, at = _expand(value, at, inner), inner
    value.flags.writeable = False  # as tiles are: so the kernel is compiled once
    return value, at


def _own(base: Tiles, region: Region, k: int, rect: Rect) -> np.ndarray:
    """Returns what is shown where the example has pixels of its own, `k` levels below the region's: float32 (4, h, w)
    of an even rectangle of that level."""
    if not k:
        return tiles.gathered(base, rect, np.zeros((4, rect.height, rect.width), np.float32))
    value = _detail(region, k, rect)
    if not region.fresh(0):
        _fill(value, base, region, k, rect)
    return value


def _detail(region: Region, k: int, rect: Rect) -> np.ndarray:
    """Returns what the example has `k` levels below the region's pixels: float32 (4, h, w) of a rectangle of that
    level."""

    def needed(j: int) -> Rect:
        return rect.zoomed(j - k).grown(HALO).evened() if j < k else rect

    first = at = needed(0)
    names, ends = _names(region, at)
    inside = ends[None].astype(np.float32)
    for j in range(1, k + 1):
        inside, at = _expand(inside, at, needed(j)), needed(j)
    out = np.empty((4, at.height, at.width), np.float32)
    _show(names, region.exemplar.finer[k - 1], inside[0], k, at.y0 - (first.y0 << k), at.x0 - (first.x0 << k), out)
    return out


def _fill(value: np.ndarray, base: Tiles, region: Region, k: int, rect: Rect) -> None:
    """Shows in `value`, as `_detail` gives it, the B-spline of those pixels that have no source yet."""
    first = at = rect.zoomed(-k).grown(HALO).evened()
    mask = tiles.gathered(region.masks[0], at, np.zeros((1, at.height, at.width), np.uint8))[0]
    late = (mask > 0) & (show.sources(region, at) < 0)
    if not late.any():
        return
    plain = tiles.gathered(base, at, np.zeros((4, at.height, at.width), np.float32))
    for j in range(1, k + 1):
        inner = rect.zoomed(j - k).grown(HALO).evened() if j < k else rect
        plain, at = _expand(plain, at, inner), inner
    rows = np.arange(rect.height) + (rect.y0 - (first.y0 << k)) >> k
    columns = np.arange(rect.width) + (rect.x0 - (first.x0 << k)) >> k
    where = late[np.ix_(rows, columns)]
    value[:, where] = plain[:, where]


def _expand(value: np.ndarray, at: Rect, inner: Rect) -> np.ndarray:
    out = np.empty((len(value), inner.height, inner.width), np.float32)
    top, left = (inner.y0 >> 1) - 1 - at.y0, (inner.x0 >> 1) - 1 - at.x0
    expand_into(value, top, left, np.arange(len(value)), out, 0, inner.height, FINE_STEP)
    return out


def _names(region: Region, rect: Rect) -> tuple[np.ndarray, np.ndarray]:
    """Sources of the pixels of a rectangle, int32 (h, w), going on `BEYOND` pixels outside the region; and uint8
    (h, w), 0 where the region ends and the example would go on."""
    wide = rect.grown(BEYOND)
    names = show.sources(region, wide)
    mask = tiles.gathered(region.masks[0], wide, np.zeros((1, wide.height, wide.width), np.uint8))[0]
    names[mask == 0] = OUTSIDE
    out, ends = np.empty((rect.height, rect.width), np.int32), np.zeros((rect.height, rect.width), np.uint8)
    _continued(names, _NEAR, region.exemplar.colours[0], out, ends)
    return out, ends


@kernel
def _continued(names: np.ndarray, near: np.ndarray, colours: np.ndarray, out: np.ndarray, ends: np.ndarray) -> None:
    """For each pixel of `out` the source that its nearest neighbour in `names` (BEYOND pixels more on each side)
    continues with; OUTSIDE where there is none."""
    for y in range(out.shape[0]):
        for x in range(out.shape[1]):
            out[y, x] = OUTSIDE
            for i in range(near.shape[0]):
                dy, dx = near[i]
                source = names[y + BEYOND + dy, x + BEYOND + dx]
                if source >= 0:
                    source += -(dy << 16) - dx
                    out[y, x] = source
                    row, column = (source >> 16) - PAD, (source & 0xFFFF) - PAD
                    within = 0 <= row < colours.shape[0] and 0 <= column < colours.shape[1]
                    ends[y, x] = i == 0 or not within or colours[row, column, 3] <= 0.0
                    break


@kernel
def _show(
    names: np.ndarray, colours: np.ndarray, inside: np.ndarray, k: int, top: int, left: int, out: np.ndarray
) -> None:
    """Shows in `out` (4, h, w), `k` levels below `names` and `top`, `left` pixels from their first one, what the
    example has there, `colours` (rows, columns, 4), as far as it is `inside` (h, w), 0..1; on the grid."""
    found = np.empty(4, np.float32)
    for y in range(inside.shape[0]):
        for x in range(inside.shape[1]):
            share = np.float32((inside[y, x] - 0.5) * (1 << k) + 0.5)  # the outline is one pixel wide
            share = min(np.float32(1.0), max(np.float32(0.0), share))
            found[:] = 0.0
            if share > 0.0:
                show.below(names, colours, False, k, y + top, x + left, found)
            for c in range(4):
                out[c, y, x] = snap(share * found[c])
