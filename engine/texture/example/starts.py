"""What a level begins with before its corrections: what lies below the coarser level's sources, or, at the coarsest
level, patches of the example.

Kernels are called one after another from Python: one that called them would be compiled with all of them in it again.
"""

from __future__ import annotations

import numpy as np

from engine.numeric.hashing import mix64
from engine.numeric.kernel import Array, Int, inlined, inner_uncounted, uncounted
from engine.numeric.neighbourhood import FULL, RADIUS, ones
from engine.texture.example.channels import told_apart, turned_source, way_of
from engine.texture.example.exemplar import COUNTS
from engine.texture.example.region_window import OUTSIDE, Example, Rules, Window, mark_readers, shape_at, turn_of

_ALIKE = 6  # pixels by which the shape under a patch may differ from the one it was copied from
_DRAWN = 12  # pixels of another shape up to which pixels are drawn alike: along a straight rim all shapes are one
_PATCHES, _LIKE = 24, 40000  # patches that are drawn to be as told, and the energy that is near enough
# As much for a pixel of another shape where pieces are drawn: of a rim that is told alike all along, else, one piece
# would be the nearest, and come again and again.
_LIKE_PIECES = 40 * _LIKE
_GOLDEN = np.uint64(0x9E3779B97F4A7C15)


@uncounted
def _begin(window: Window, before: np.ndarray, example: Example) -> None:
    """The starts in planes[0], `before` (int32 (h, w)) having been those until now, go into the window."""
    height, width = window.mask.shape
    for y in range(height):
        mask, start, now = window.mask[y], window.planes[0, y], window.now[y]
        care, shown = window.care[4 * y * width :], window.shown[4 * y * width :]
        for x in range(width):
            if mask[x] == 0:
                for p in range(window.planes.shape[0]):
                    window.planes[p, y, x] = OUTSIDE
                continue
            now[x] = start[x]
            j = 4 * ((start[x] >> 16) * example.region.shape[1] + (start[x] & 0xFFFF))
            for c in range(4):
                care[4 * x + c] = -1
                shown[4 * x + c] = example.compared[j + c]
    if window.fresh:
        return
    for y in range(height):
        for x in range(width):
            if window.was[y, x] and window.mask[y, x] and window.planes[0, y, x] != before[y, x]:
                mark_readers(window, y, x, np.int64(0), turn_of(window, y, x))  # type: ignore[arg-type]


@inlined
def _child(parent: Int, y: Int, x: Int, region: np.ndarray) -> Int:
    """Returns the pixel below a coarser source for an even or odd row and column, or the nearest of its four in the
    region."""
    row, column = 2 * (parent >> 16) - RADIUS - 1, 2 * (parent & 0xFFFF) - RADIUS - 1
    for k in range(4):
        r, c = row + (y ^ (k >> 1)), column + (x ^ (k & 1))
        if region[r, c]:
            return np.int32(r << 16 | c)
    return np.int32(OUTSIDE)


@uncounted
def _children(
    mask: np.ndarray, parents: np.ndarray, odd_y: Int, odd_x: Int, region: np.ndarray, out: np.ndarray
) -> None:
    """Writes the sources that a window of the region begins with below coarser ones: int32 (h, w)."""
    for y in range(mask.shape[0]):
        inside, row, above = mask[y], out[y], parents[(y + odd_y) >> 1]
        for x in range(row.size):
            row[x] = OUTSIDE
            if inside[x] and above[(x + odd_x) >> 1] >= 0:
                row[x] = _child(above[(x + odd_x) >> 1], (y + odd_y) & 1, (x + odd_x) & 1, region)


def start_finer(window: Window, parents: np.ndarray, before: np.ndarray, example: Example) -> None:
    """Starts from the sources one level coarser: int32 arrays of the pixels above the window's, now and before."""
    _children(window.mask, parents, window.y, window.x, example.region, window.planes[0])
    old = np.empty_like(window.planes[0])
    if not window.fresh:
        _children(window.was, before, window.y, window.x, example.region, old)
    _begin(window, old, example)


def start_coarsest(
    window: Window,
    patches: np.ndarray,
    corners: np.ndarray,
    block: int,
    offset: tuple[int, int],
    example: Example,
    rules: Rules,
) -> None:
    """Starts from patches of the example, or from pixels whose neighbourhoods have the shape.

    `patches`: uint64 hashes of the patches that meet the window, `offset`: (row, column) of its first pixel in the
    first of them; `corners`: names of the pixels where patches may begin.
    """
    old = window.planes[0].copy()
    _draw(window, patches, corners, block, offset, example, rules)
    _begin(window, old, example)


@uncounted
def _draw(
    window: Window, patches: Array, corners: Array, block: Int, offset: tuple[Int, Int], example: Example, rules: Rules
) -> None:
    """Puts the starts that are new, or whose neighbourhoods are, into planes[0]."""
    height, width = window.mask.shape
    starts = window.planes[0]
    for y in range(height):
        for x in range(width):
            if window.mask[y, x] and (window.need[0, y, x] or starts[y, x] < 0):
                row, column = y + offset[0], x + offset[1]
                chance = patches[row // block, column // block]
                place = np.int32((row % block) << 16 | (column % block))
                start = corners[chance % np.uint64(corners.size)] + place
                if rules.told.size:
                    middle = np.int32((block >> 1) << 16 | block >> 1)
                    start = _as_told(window, y, x, start, (chance, corners, place, middle), example, rules)
                if rules.pieces:
                    starts[y, x] = _piece(window, y, x, start, (chance, place), example, rules)
                else:
                    starts[y, x] = _shaped(window, y, x, start, example, rules)


@inner_uncounted
def _as_told(
    window: Window, y: Int, x: Int, start: Int, drawing: tuple[Int, Array, Int, Int], example: Example, rules: Rules
) -> Int:
    """Returns the pixel of one of some patches, all drawn for the same place and turned as the example is wanted, that
    is most like what control channels tell; `start` if it is as good as any.

    `drawing`: the hash of the patch, the names of the pixels where patches may begin, how far its pixel lies from
    there, and its middle, as names do.
    """
    chance, corners, place, middle = drawing
    least, best = told_apart(window, y, x, example, start, rules), start
    for k in range(_PATCHES):
        if least < _LIKE:
            break
        if k:
            chance = mix64(chance + _GOLDEN)
        corner = np.int32(corners[chance % np.uint64(corners.size)])
        name = corner + place
        if example.turns.size:
            turned = turned_source(example, corner + middle, window.told[0, y, x])
            row = (turned >> 16) + (place >> 16) - (middle >> 16)
            column = (turned & 0xFFFF) + (place & 0xFFFF) - (middle & 0xFFFF)
            inside = 0 <= row < example.region.shape[0] and 0 <= column < example.region.shape[1]
            if turned >= 0 and inside and example.region[row, column]:
                name = row << 16 | column
        e = told_apart(window, y, x, example, name, rules)
        if e < least:
            least, best = e, name
    return best


@inner_uncounted
def _shaped(window: Window, y: Int, x: Int, start: Int, example: Example, rules: Rules) -> Int:
    """`start`, if the shape around it is alike; else the pixel that the hash draws of those with about such a shape, or
    with the nearest if there are none; what control channels tell counts as pixels of another shape."""
    if not rules.rims:
        return start
    bits, h = window.bits[y, x], window.hashes[y, x]
    if ones(bits ^ example.bits[start >> 16, start & 0xFFFF]) <= _ALIKE:
        return start
    least, drawn = np.int32(1 << 20), np.uint64(0)
    way = way_of(window, y, x, example)
    for i in range(example.starts[way], example.starts[way + COUNTS]):
        apart = max(_DRAWN, ones(bits ^ shape_at(example, i)))
        if apart <= least and rules.told.size:
            apart += told_apart(window, y, x, example, example.order[i], rules) // _LIKE
        if apart <= least:
            chance = mix64(h + np.uint64(i) * _GOLDEN)
            if apart < least or chance > drawn:
                least, drawn, start = apart, chance, example.order[i]
    return start


@inner_uncounted
def _piece(window: Window, y: Int, x: Int, start: Int, drawing: tuple[Int, Int], example: Example, rules: Rules) -> Int:
    """As `_shaped`, but all pixels of a patch draw the same part of the example, as far as it has their shapes there.

    `drawing`: the hash of the patch, and how far its pixel lies from where it begins, as names do.
    """
    bits, (chance, place) = window.bits[y, x] & FULL, drawing
    if not rules.rims or ones(bits ^ example.bits[start >> 16, start & 0xFFFF]) <= _ALIKE:
        return start
    least, drawn = np.int32(50), np.uint64(0)
    way = way_of(window, y, x, example)
    for i in range(example.starts[way], example.starts[way + COUNTS]):
        apart = max(_DRAWN, ones(bits ^ shape_at(example, i)))
        if apart <= least and rules.told.size:
            apart += told_apart(window, y, x, example, example.order[i], rules) // _LIKE_PIECES
        if apart <= least:
            rank = mix64(chance + np.uint64(np.int64(example.order[i] - place)) * _GOLDEN)
            if apart < least or rank > drawn:
                least, drawn, start = apart, rank, example.order[i]
    return start
