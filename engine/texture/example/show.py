"""The pixels of a region painted with an example.

Where sources from different places of the example meet, each pixel is the mean, under a window, of what its
neighbours' sources would continue with: so seams are blended, and all else is copied (the vote of Kwatra et al. 2005,
"Texture optimization for example-based synthesis", section 3, once and at the end).
"""

from __future__ import annotations

import numpy as np
from numba import njit

from engine.numeric.address import Rect
from engine.numeric.colour import to_rgba8, to_rgba16
from engine.numeric.grid import snapped
from engine.texture.example import tiles
from engine.texture.example.correction import OUTSIDE
from engine.texture.example.exemplar import PAD
from engine.texture.example.region import Region


def sources(region: Region, rect: Rect, level: int = 0) -> np.ndarray:
    """Where each pixel of a level comes from: int32 (h, w), rows and columns as `exemplar` names them; -1 outside."""
    out = np.full((1, rect.height, rect.width), OUTSIDE, np.int32)
    return tiles.gathered_last(region.levels[level].sources, rect, out)[0]


def picture(region: Region, rect: Rect, level: int = 0) -> np.ndarray:
    """Colours of a rectangle of a level: premultiplied float32 (4, h, w) in 0..1, on the grid."""
    return snapped(_blended(region, rect, level)[0])


def preview(region: Region, rect: Rect) -> np.ndarray:
    """Colours of the region's pixels in a rectangle of level 0, as far as they are known: premultiplied float32
    (4, h, w) in 0..1, on the grid; 0 outside.

    Each pixel has the colour of the finest level that has a source for it, be it one of before the region changed, and
    the example's average where no level has one.  Where the region is refined it is `picture`.
    """
    mask = tiles.gathered(region.masks[0], rect, np.zeros((1, rect.height, rect.width), np.uint8))[0]
    out = _blended(region, rect, 0)[0]
    out *= mask
    left = _left(mask, sources(region, rect))
    for n in range(1, len(region.levels)):
        if not left:
            break
        above = rect.zoomed(-n)
        place = rect.y0 - (above.y0 << n), rect.x0 - (above.x0 << n)
        left = _fill(out, mask, sources(region, above, n), region.exemplar.colours[n], n, *place)
    if left:
        out[:, mask > 0] = region.exemplar.average[:, None]
    return snapped(out)


def pixels(region: Region, rect: Rect) -> np.ndarray:
    """The finest level as the example's own pixels, of its type: RGBA (h, w, 4), not premultiplied."""
    own = region.exemplar.pixels
    planes, blended = _blended(region, rect, 0)
    out = to_rgba8(planes) if own.dtype == np.uint8 else to_rgba16(planes)
    names = sources(region, rect)
    copied = (names >= 0) & ~blended
    out[copied] = own[(names[copied] >> 16) - PAD, (names[copied] & 0xFFFF) - PAD]
    return out


def _blended(region: Region, rect: Rect, level: int) -> tuple[np.ndarray, np.ndarray]:
    """Premultiplied colours (4, h, w), and where they are mixed of several: bool (h, w)."""
    exemplar = region.exemplar
    reach = exemplar.parameters.feather
    if exemplar.boundary:  # a rim is narrow, and would be blurred
        reach //= 2
    distance = np.abs(np.arange(-reach, reach + 1))
    window = np.exp(-(distance**2) / (2.0 * max(reach, 1) ** 2))
    out = np.zeros((4, rect.height, rect.width), np.float32)
    blended = np.zeros((rect.height, rect.width), np.bool_)
    weights = np.outer(window, window).astype(np.float32)
    around = sources(region, rect.grown(reach), level)
    _blend(around, exemplar.colours[level], exemplar.levels[level].region, weights, out, blended)
    return out, blended


@njit(cache=True, nogil=True)
def _left(mask, names):
    """Takes the pixels that have a source off the mask, uint8 (h, w); gives how many are left."""
    left = 0
    for y in range(mask.shape[0]):
        for x in range(mask.shape[1]):
            if mask[y, x] and names[y, x] >= 0:
                mask[y, x] = 0
            left += mask[y, x]
    return left


@njit(cache=True, nogil=True)
def _fill(out, mask, names, colours, n, top, left_side):
    """Gives the pixels of a mask the colours of sources `n` levels coarser, the first of which begins `top` and
    `left_side` pixels before; takes them off the mask, and gives how many are left."""
    left = 0
    for y in range(mask.shape[0]):
        for x in range(mask.shape[1]):
            if mask[y, x] == 0:
                continue
            source = names[(y + top) >> n, (x + left_side) >> n]
            if source < 0:
                left += 1
                continue
            mask[y, x] = 0
            for c in range(4):
                out[c, y, x] = colours[(source >> 16) - PAD, (source & 0xFFFF) - PAD, c]
    return left


@njit(cache=True, nogil=True)
def _blend(around, colours, region, weights, out, blended):
    """`around`: sources, with as many pixels around `out` (4, h, w) as `weights` reach."""
    reach = weights.shape[0] // 2
    for y in range(out.shape[1]):
        for x in range(out.shape[2]):
            source = around[y + reach, x + reach]
            if source < 0:
                continue
            if _alone(around, y, x, reach, source):
                for c in range(4):
                    out[c, y, x] = colours[(source >> 16) - PAD, (source & 0xFFFF) - PAD, c]
                continue
            blended[y, x] = True
            _mean(around, y, x, colours, region, weights, out)


@njit(cache=True, nogil=True)
def _alone(around, y, x, reach, source):
    """Whether all neighbours inside come from the same place of the example."""
    for dy in range(2 * reach + 1):
        for dx in range(2 * reach + 1):
            other = around[y + dy, x + dx]
            if other >= 0 and other != source + ((dy - reach) << 16) + dx - reach:
                return False
    return True


@njit(cache=True, nogil=True)
def _mean(around, y, x, colours, region, weights, out):
    """The mean of what the neighbours' sources continue with."""
    reach = weights.shape[0] // 2
    total = np.float32(0.0)
    for dy in range(2 * reach + 1):
        for dx in range(2 * reach + 1):
            other = around[y + dy, x + dx]
            if other < 0:
                continue
            row, column = (other >> 16) - dy + reach, (other & 0xFFFF) - dx + reach
            if region[row, column] == 0:
                continue
            weight = weights[dy, dx]
            total += weight
            for c in range(4):
                out[c, y, x] += weight * colours[row - PAD, column - PAD, c]
    for c in range(4):
        out[c, y, x] /= total
