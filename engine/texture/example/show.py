"""The pixels of a region painted with an example.

Where sources from different places of the example meet, each pixel is the mean, under a window, of what its
neighbours' sources would continue with: so seams are blended, and all else is copied (the vote of Kwatra et al. 2005,
"Texture optimization for example-based synthesis", section 3, once and at the end).
"""

from __future__ import annotations

import numpy as np

from engine.numeric.address import Rect
from engine.numeric.colour import to_rgba8, to_rgba16
from engine.numeric.elementary import exp, mapped
from engine.numeric.grid import snapped
from engine.numeric.kernel import Array, Int, Real, inlined, inner, kernel
from engine.texture.example import tiles
from engine.texture.example.exemplar import PAD
from engine.texture.example.region import Region
from engine.texture.example.region_window import OUTSIDE

FAINT = 0.5  # part of a coarse level's colour that a pixel shows, at least, where the example ends below it


def sources(region: Region, rect: Rect, level: int = 0) -> np.ndarray:
    """Tells where each pixel of a level comes from: int32 (h, w), rows and columns as `exemplar` names them; -1
    outside."""
    out = np.full((1, rect.height, rect.width), OUTSIDE, np.int32)
    result: np.ndarray = tiles.gathered_last(region.levels[level].sources, rect, out)[0]
    return result


def picture(region: Region, rect: Rect, level: int = 0) -> np.ndarray:
    """Colours of a rectangle of a level: premultiplied float32 (4, h, w) in 0..1, on the grid."""
    return snapped(_blended(region, rect, level)[0])


def preview(region: Region, rect: Rect) -> np.ndarray:
    """Colours of the region's pixels in a rectangle of level 0, as far as they are known: premultiplied float32
    (4, h, w) in 0..1, on the grid; 0 outside.

    Each pixel has its own source, be it one of before the region changed, or that of the finest level that has one
    for the region as it is: of a coarser level what the example has below that, fading to what it has below the next
    one, and at least FAINT of that level's own colour, as the example may end there.  Where no level has a source it
    has the example's average colour, and where the region is refined it is `picture`.
    """
    mask = tiles.gathered(region.masks[0], rect, np.zeros((1, rect.height, rect.width), np.uint8))[0]
    out = _blended(region, rect, 0)[0]
    out *= mask
    left = _left(mask, sources(region, rect))
    for n in range(1, len(region.levels)):
        if not left:
            break
        if not region.levels[n].sources:
            continue
        above = rect.zoomed(-n).grown(1)
        place = rect.y0 - (above.y0 << n), rect.x0 - (above.x0 << n)
        mirrored = not region.exemplar.boundary
        colours = region.exemplar.colours[0], region.exemplar.colours[n]
        left = _fill(out, mask, _valid(region, above, n), *colours, mirrored, n, *place)
    if left:
        out[:, mask > 0] = region.exemplar.average[:, None]
    return snapped(out)


def _valid(region: Region, rect: Rect, level: int) -> np.ndarray:
    """Sources as `sources`, but none where a neighbour of a pixel has joined or left the region since that level was
    refined: what was a rim is none any more."""
    names = sources(region, rect, level)
    then, now = region.levels[level].mask, region.masks[level]
    if then is not now and (names >= 0).any():
        around = rect.grown(1)
        held = [
            tiles.gathered(one, around, np.zeros((1, around.height, around.width), np.uint8))[0] for one in (then, now)
        ]
        differs = held[0] != held[1]
        rows = differs[:-2] | differs[1:-1] | differs[2:]
        names[rows[:, :-2] | rows[:, 1:-1] | rows[:, 2:]] = OUTSIDE
    return names


def pixels(region: Region, rect: Rect) -> np.ndarray:
    """Returns the finest level as the example's own pixels, of its type: RGBA (h, w, 4), not premultiplied."""
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
    window = mapped(exp, -(distance**2) / (2.0 * max(reach, 1) ** 2))
    out = np.zeros((4, rect.height, rect.width), np.float32)
    blended = np.zeros((rect.height, rect.width), np.bool_)
    weights = np.outer(window, window).astype(np.float32)
    around = sources(region, rect.grown(reach), level)
    _blend(around, exemplar.colours[level], exemplar.levels[level].region, weights, out, blended)
    return out, blended


@kernel
def _left(mask: np.ndarray, names: np.ndarray) -> int:
    """Takes the pixels that have a source off the mask, uint8 (h, w); gives how many are left."""
    left = 0
    for y in range(mask.shape[0]):
        for x in range(mask.shape[1]):
            if mask[y, x] and names[y, x] >= 0:
                mask[y, x] = 0
            left += mask[y, x]
    return left


@kernel
def _fill(
    out: Array,
    mask: Array,
    names: Array,
    finest: Array,
    coarse: Array,
    mirrored: bool,
    n: Int,
    top: Int,
    left_side: Int,
) -> int:
    """Gives the pixels of a mask what is `below` their sources `n` levels coarser, the first of which begins `top` and
    `left_side` pixels before; takes them off the mask, and gives how many are left.  `finest`, `coarse`: colours of
    the finest level, and of the one that the sources are of."""
    left = 0
    found = np.empty(4, np.float32)
    for y in range(mask.shape[0]):
        for x in range(mask.shape[1]):
            if mask[y, x] == 0:
                continue
            if names[(y + top) >> n, (x + left_side) >> n] < 0:
                left += 1
                continue
            mask[y, x] = 0
            found[:] = 0.0
            below(names, finest, mirrored, n, y + top, x + left_side, found)
            for c in range(4):
                out[c, y, x] = found[c]
            if found[3] < FAINT:
                found[:] = 0.0
                _between(names, coarse, n, y + top, x + left_side, found)
                share = np.float32(FAINT) - out[3, y, x] / max(found[3], np.float32(1e-6))
                for c in range(4):
                    out[c, y, x] += max(share, np.float32(0.0)) * found[c]
    return left


@inlined
def _around(k: Int, y: Int, x: Int) -> tuple[Int, Int, Real, Real]:
    """Returns the first of the four pixels `k` levels coarser that lie around a pixel, and how far it is to the
    others."""
    side = 1 << k
    row, column = (y - (side >> 1)) >> k, (x - (side >> 1)) >> k
    down = np.float32(y - (side >> 1) - row * side + 0.5) / side
    across = np.float32(x - (side >> 1) - column * side + 0.5) / side
    return row, column, down * down * (3 - 2 * down), across * across * (3 - 2 * across)


@inlined
def _between(names: np.ndarray, colours: np.ndarray, k: Int, y: Int, x: Int, found: np.ndarray) -> None:
    """Adds to `found` (4,) the mean colour of the four sources around a pixel `k` levels below."""
    row, column, down, across = _around(k, y, x)
    total = np.float32(0.0)
    for n in range(4):
        source = names[row + (n >> 1), column + (n & 1)]
        if source >= 0:
            weight = (down if n >> 1 else 1 - down) * (across if n & 1 else 1 - across)
            total += weight
            for m in range(4):
                found[m] += weight * colours[(source >> 16) - PAD, (source & 0xFFFF) - PAD, m]
    if total > 0.0:
        for m in range(4):
            found[m] /= total


@inlined
def below(names: np.ndarray, colours: np.ndarray, mirrored: bool, k: Int, y: Int, x: Int, found: np.ndarray) -> None:
    """Adds to `found` (4,) what an example has, in `colours` (rows, columns, 4) `k` levels below `names`, at a pixel:
    the sources of the four pixels around it go on to there, as far as there are any, and those nearer to it count for
    more.  Beyond the picture it goes on `mirrored`, or there is nothing."""
    side = 1 << k
    row, column, down, across = _around(k, y, x)
    total = np.float32(0.0)
    for n in range(4):
        r, c = row + (n >> 1), column + (n & 1)
        source = names[r, c]
        if source < 0:
            continue
        weight = (down if n >> 1 else 1 - down) * (across if n & 1 else 1 - across)
        total += weight
        i = ((source >> 16) - PAD - r) * side + y
        j = ((source & 0xFFFF) - PAD - c) * side + x
        if mirrored:
            i = max(i, -1 - i)
            j = max(j, -1 - j)
            i = min(i, 2 * colours.shape[0] - 1 - i)
            j = min(j, 2 * colours.shape[1] - 1 - j)
        if 0 <= i < colours.shape[0] and 0 <= j < colours.shape[1]:
            for m in range(4):
                found[m] += weight * colours[i, j, m]
    if total > 0.0:
        for m in range(4):
            found[m] /= total


@kernel
def _blend(around: Array, colours: Array, region: Array, weights: Array, out: Array, blended: Array) -> None:
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


@kernel
def _alone(around: np.ndarray, y: Int, x: Int, reach: Int, source: Int) -> bool:
    """Tells whether all neighbours inside come from the same place of the example."""
    for dy in range(2 * reach + 1):
        for dx in range(2 * reach + 1):
            other = around[y + dy, x + dx]
            if other >= 0 and other != source + ((dy - reach) << 16) + dx - reach:
                return False
    return True


@inner
def _mean(
    around: np.ndarray, y: Int, x: Int, colours: np.ndarray, region: np.ndarray, weights: np.ndarray, out: np.ndarray
) -> None:
    """Writes the mean of what the neighbours' sources continue with."""
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
