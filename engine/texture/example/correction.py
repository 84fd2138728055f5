"""Order-independent correction (Lefebvre & Hoppe 2005, "Parallel controllable texture synthesis") over the energy of
Ritter et al. 2006, section 5, in which the shape of the region takes part.

Each pass corrects the pixels of a level in four sub-passes, one for each parity of row and column.  A pixel reads what
its neighbourhood was before its own sub-pass, so nothing depends on the order within one, nor on threads or tiles.
Energies are whole numbers.  All arrays are windows with MARGIN pixels around what may be corrected.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numba import njit

from engine.numeric.hashing import mix64
from engine.numeric.neighbourhood import RADIUS, SIDE, ones, region_bits, row_apart, row_apart_within
from engine.numeric.neighbourhood import ROW as WEIGHTS_ROW

MARGIN = RADIUS + 1  # even
SUBPASSES = 4
REACH = SUBPASSES * RADIUS  # pixels that a change can spread in a pass
OUTSIDE = -1  # instead of a source, where there is no region

_FAR = np.int32(2**31 - 1)
_RIM_CANDIDATES = 8
_SHAPES = 64  # of which the nearest are searched
_COUNTS_APART, _SHAPES_APART = 2, 2  # of what is searched at a rim: neighbours inside, and pixels of the shape
_ALIKE = 6  # pixels by which the shape under a patch may differ from the one it was copied from
_DRAWN = 12  # pixels of another shape up to which pixels are drawn alike: along a straight rim all shapes are one
_GOLDEN = np.uint64(0x9E3779B97F4A7C15)


class Example(NamedTuple):
    """A level of the exemplar, as kernels take it; `compared` flat."""

    compared: np.ndarray
    region: np.ndarray
    bits: np.ndarray
    order: np.ndarray
    starts: np.ndarray


class Rules(NamedTuple):
    """`penalty`: energy of a pixel of another shape; `leeway`: so many of those are free; `square`: bits of the
    neighbourhood; `kappa`: 256 (1 + kappa); `stride`: of the search through all candidates, 0 for none; `rims`: whether
    the region's shape counts."""

    weights: np.ndarray
    square: np.uint64
    penalty: int
    leeway: int
    kappa: int
    stride: int
    rims: bool


class Window(NamedTuple):
    """`mask`, `was`: uint8 (h, w), the region now and before; `bits`: uint64 (h, w), its shapes; `now`: int32 (h, w),
    the sources at this moment; `shown`, `care`: int16 (h * w * 4), their values, and -1 inside the region; `planes`:
    int32 (passes + 1, h, w), the sources after each pass, from the start (0) on, as they were until they are corrected;
    `need`: uint8 (passes + 1, h, w), what is to be corrected in each; `hashes`: uint64 (h, w), by place; `y`, `x`:
    parity of the first row and column; `fresh`: nothing of it was there before."""

    mask: np.ndarray
    was: np.ndarray
    bits: np.ndarray
    now: np.ndarray
    shown: np.ndarray
    care: np.ndarray
    planes: np.ndarray
    need: np.ndarray
    hashes: np.ndarray
    y: int
    x: int
    fresh: bool


def window_of(
    mask: np.ndarray, was: np.ndarray, planes: np.ndarray, hashes: np.ndarray, parity: tuple[int, int]
) -> Window:
    """A window whose shapes, and what they ask for, are known; one of the `start` functions has to follow."""
    size = mask.shape
    bits, need = np.zeros(size, np.uint64), np.zeros(planes.shape, np.uint8)
    shown, care = np.zeros(4 * mask.size, np.int16), np.zeros(4 * mask.size, np.int16)
    region_bits(mask, bits)
    fresh = not was.any()
    _mark_shapes(mask, was, need, fresh)
    now = np.full(size, OUTSIDE, np.int32)
    return Window(mask, was, bits, now, shown, care, planes, need, hashes, *parity, fresh)


@njit(inline="always")
def _turn(y, x):
    """Which of the four sub-passes corrects a pixel: (0, 0), (1, 1), (0, 1), (1, 0), by row and column."""
    return (y & 1) * 3 if (x & 1) == 0 else 2 - (y & 1)


@njit(cache=True, nogil=True)
def _mark_shapes(mask, was, need, fresh):
    """Asks for all pixels in whose neighbourhood the region changed, in every pass."""
    height, width = mask.shape
    if fresh:
        need[:] = 1
        return
    altered = np.zeros((height, width), np.uint8)
    for y in range(height):
        for x in range(width):
            altered[y, x] = mask[y, x] ^ was[y, x]
    around = np.zeros((height, width), np.uint64)
    region_bits(altered, around)
    for y in range(height):
        for x in range(width):
            if around[y, x]:
                for p in range(need.shape[0]):
                    need[p, y, x] = 1


@njit(cache=True, nogil=True)
def _mark_readers(window, y, x, p, turn):
    """Asks for the pixels that read the source of one as it is after pass `p` (0: at the start)."""
    height, width = window.mask.shape
    for row in range(max(0, y - RADIUS), min(height, y + RADIUS + 1)):
        for column in range(max(0, x - RADIUS), min(width, x + RADIUS + 1)):
            later = _turn(row + window.y, column + window.x) > turn
            if later and p > 0:
                window.need[p, row, column] = 1
            elif not later and p + 1 < window.need.shape[0]:
                window.need[p + 1, row, column] = 1


@njit(inline="always")
def _show(window, compared, stride, y, x, source):
    """Puts a source and its values into the window."""
    window.now[y, x] = source
    i = 4 * (y * window.mask.shape[1] + x)
    if source < 0:
        for c in range(4):
            window.shown[i + c] = 0
        return
    j = 4 * ((source >> 16) * stride + (source & 0xFFFF))
    for c in range(4):
        window.shown[i + c] = compared[j + c]


@njit(cache=True, nogil=True)
def _begin(window, before, example):
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
                _mark_readers(window, y, x, 0, _turn(y + window.y, x + window.x))


@njit(inline="always")
def _child(parent, y, x, region):
    """The pixel below a coarser source for an even or odd row and column, or the nearest of its four in the region."""
    row, column = 2 * (parent >> 16) - RADIUS - 1, 2 * (parent & 0xFFFF) - RADIUS - 1
    for k in range(4):
        r, c = row + (y ^ (k >> 1)), column + (x ^ (k & 1))
        if region[r, c]:
            return np.int32(r << 16 | c)
    return np.int32(OUTSIDE)


@njit(cache=True, nogil=True)
def _children(mask, parents, odd_y, odd_x, region, out):
    """The sources that a window of the region begins with below coarser ones: int32 (h, w)."""
    for y in range(mask.shape[0]):
        inside, row, above = mask[y], out[y], parents[(y + odd_y) >> 1]
        for x in range(row.size):
            row[x] = OUTSIDE
            if inside[x] and above[(x + odd_x) >> 1] >= 0:
                row[x] = _child(above[(x + odd_x) >> 1], (y + odd_y) & 1, (x + odd_x) & 1, region)


@njit(cache=True, nogil=True)
def start_finer(window, parents, before, example):
    """Starts from the sources one level coarser: int32 arrays of the pixels above the window's, now and before."""
    _children(window.mask, parents, window.y, window.x, example.region, window.planes[0])
    old = np.empty_like(window.planes[0])
    if not window.fresh:
        _children(window.was, before, window.y, window.x, example.region, old)
    _begin(window, old, example)


@njit(cache=True, nogil=True)
def start_coarsest(window, patches, corners, block, offset, example, rules):
    """Starts from patches of the example, or from pixels whose neighbourhoods have the shape.

    `patches`: uint64 hashes of the patches that meet the window, `offset`: (row, column) of its first pixel in the
    first of them; `corners`: names of the pixels where patches may begin.
    """
    height, width = window.mask.shape
    old = window.planes[0].copy()
    for y in range(height):
        for x in range(width):
            if window.mask[y, x] and (window.need[0, y, x] or old[y, x] < 0):
                row, column = y + offset[0], x + offset[1]
                drawn = patches[row // block, column // block] % np.uint64(corners.size)
                start = corners[drawn] + np.int32((row % block) << 16 | (column % block))
                window.planes[0, y, x] = _shaped(window.bits[y, x], start, window.hashes[y, x], example, rules)
    _begin(window, old, example)


@njit(cache=True, nogil=True)
def _shaped(bits, start, h, example, rules):
    """`start`, if the shape around it is alike; else the pixel that the hash draws of those with about such a shape, or
    with the nearest if there are none."""
    if not rules.rims:
        return start
    if ones(bits ^ example.bits[start >> 16, start & 0xFFFF]) <= _ALIKE:
        return start
    least, drawn = np.int32(50), np.uint64(0)
    for i in range(example.order.size):
        name = example.order[i]
        apart = max(_DRAWN, ones(bits ^ example.bits[name >> 16, name & 0xFFFF]))
        if apart <= least:
            chance = mix64(h + np.uint64(i) * _GOLDEN)
            if apart < least or chance > drawn:
                least, drawn, start = apart, chance, name
    return start


@njit(cache=True, nogil=True)
def wanted(window, p, turn, beyond, places):
    """Lists the pixels to correct in a sub-pass, as row * width + column; gives their number.

    `beyond`: pixels along the edges that do not count after the pass, nor do those that only such pixels read then.
    """
    height, width = window.mask.shape
    count = 0
    margin = max(MARGIN, beyond - RADIUS * (SUBPASSES - 1 - turn))
    for y in range(margin, height - margin):
        asked, mask = window.need[p, y], window.mask[y]
        odd = -1
        for x in range(2):
            if _turn(y + window.y, x + window.x) == turn:
                odd = x
        if odd < 0:
            continue
        for x in range(margin + (margin + odd & 1), width - margin, 2):
            if asked[x] and mask[x]:
                places[count] = y * width + x
                count += 1
    return count


@njit(cache=True, nogil=True)
def _colours_apart(window, i, example, j, weights, rim, e, least):
    """`e` and how far the colours of two neighbourhoods are apart, or some number from `least` on."""
    for r in range(SIDE):
        if e >= least:
            break
        if rim:
            e += row_apart_within(window.shown, i, example.compared, j, weights, r * WEIGHTS_ROW, window.care)
        else:
            e += row_apart(window.shown, i, example.compared, j, weights, r * WEIGHTS_ROW)
        i += 4 * window.mask.shape[1]
        j += 4 * example.region.shape[1]
    return np.int32(e)


@njit(inline="always")
def _energy(window, y, x, example, name, rules, bits, rim, least):
    """The energy between the neighbourhoods of a pixel and of an example's, or some number from `least` on.

    At a `rim` what lies outside the region does not count but for its shape.
    """
    row, column = name >> 16, name & 0xFFFF
    e = np.int32(rules.penalty * max(0, ones(bits ^ (example.bits[row, column] & rules.square)) - rules.leeway))
    if e >= least:
        return e
    i = 4 * ((y - RADIUS) * window.mask.shape[1] + x - RADIUS)
    j = 4 * ((row - RADIUS) * example.region.shape[1] + column - RADIUS)
    return _colours_apart(window, i, example, j, rules.weights, rim, e, least)


@njit(cache=True, nogil=True)
def _corrected(window, y, x, p, example, rules, tried):
    """The best source for one pixel: what continues its neighbours' sources, or what is much nearer."""
    bits = window.bits[y, x] & rules.square
    rim = bits != rules.square
    if not rules.rims:
        bits = rules.square
    searched = rules.stride > 0 or (bits != rules.square and p == 1)
    count = _continued(window, y, x, example, rules.stride > 0, tried)
    if count == 1 and not searched:
        return tried[0]
    least, best = _FAR, np.int32(OUTSIDE)
    for k in range(count):
        e = _energy(window, y, x, example, tried[k], rules, bits, rim, least)
        if e < least:
            least, best = e, tried[k]
    if least == 0:
        return best
    limit = least if best < 0 else np.int32(np.int64(least) * 256 // rules.kappa)
    h = mix64(window.hashes[y, x] + np.uint64(p) * _GOLDEN)
    if rules.stride:
        first = np.int64(h % np.uint64(min(rules.stride, example.order.size)))
        last = example.order.size
        return _searched(window, y, x, example, rules, bits, rim, limit, best, first, last, rules.stride)
    if searched:
        return _searched_rim(window, y, x, example, rules, bits, least, best, h)
    return best


@njit(cache=True, nogil=True)
def _continued(window, y, x, example, coarsest, names):
    """The coherence search: lists the sources that continue those of a pixel and its neighbours; gives their number."""
    count = 0
    for k in range(9):
        if k == 0 and coarsest:
            continue  # at the coarsest level a pixel does not hold to itself
        dy, dx = (k + 4) % 9 // 3 - 1, (k + 4) % 9 % 3 - 1
        source = window.now[y + dy, x + dx]
        if source < 0:
            continue
        name = np.int32(source - (dy << 16) - dx)
        if example.region[name >> 16, name & 0xFFFF] == 0 or _holds(names, count, name):
            continue
        names[count] = name
        count += 1
    return count


@njit(inline="always")
def _holds(names, count, name):
    found = False
    for i in range(count):
        found = found or names[i] == name
    return found


@njit(cache=True, nogil=True)
def _searched(window, y, x, example, rules, bits, rim, limit, best, first, last, stride):
    """The best of some of the example's pixels in their order, if its energy is below `limit`; else `best`."""
    for i in range(first, last, stride):
        e = _energy(window, y, x, example, example.order[i], rules, bits, rim, limit)
        if e < limit:
            limit, best = e, example.order[i]
    return best


@njit(cache=True, nogil=True)
def _searched_rim(window, y, x, example, rules, bits, limit, best, h):
    """The best of those with about as many neighbours inside whose shapes are nearest, if it is below `limit`.

    What is another shape weighs as it is, only colours weigh (1 + kappa) times as much as those of what continues the
    neighbours: so shapes override colours, whatever the rim looks like (Ritter et al. 2006, section 5).
    """
    first, last = _alike(example.starts, ones(window.bits[y, x]))
    step = max(1, (last - first) // _SHAPES)
    first += np.int64(h % np.uint64(step))
    nearest, count = np.int32(SIDE * SIDE + 1), 0
    for i in range(first, last, step):
        apart = _apart(bits, example, example.order[i], rules)
        if apart < nearest:
            nearest, count = apart, 0
        count += apart == nearest
    near = nearest + (_SHAPES_APART if count < _RIM_CANDIDATES else 0)
    for i in range(first, last, step):
        name = example.order[i]
        apart = _apart(bits, example, name, rules)
        shape = np.int32(rules.penalty * max(0, apart - rules.leeway))
        if apart > near or shape >= limit:
            continue
        e = _energy(window, y, x, example, name, rules, bits, True, limit)
        if e < limit:
            e = np.int64(shape) + np.int64(e - shape) * rules.kappa // 256
            if e < limit:
                limit, best = np.int32(e), name
    return best


@njit(inline="always")
def _apart(bits, example, name, rules):
    """Pixels by which a shape differs from the one around a pixel of the example."""
    return np.int32(ones(bits ^ (example.bits[name >> 16, name & 0xFFFF] & rules.square)))


@njit(cache=True, nogil=True)
def _alike(starts, count):
    """The part of the order with about so many neighbours inside, though not all, or with the next fewer and more."""
    most = SIDE * SIDE
    low, high = max(0, count - _COUNTS_APART), min(most - 1, count + _COUNTS_APART)
    while low > 0 and starts[low] == starts[count]:
        low -= 1
    while high < most and starts[high + 1] == starts[count + 1]:
        high += 1
    return np.int64(starts[low]), np.int64(starts[high + 1])


@njit(cache=True, nogil=True)
def correct(window, places, first, last, p, example, rules, found):
    """Finds the sources of the pixels places[first:last]."""
    tried = np.empty(9, np.int32)
    width = window.mask.shape[1]
    for i in range(first, last):
        found[i] = _corrected(window, places[i] // width, places[i] % width, p, example, rules, tried)


@njit(cache=True, nogil=True)
def settle(window, places, count, found, p, turn, example):
    """Takes over the sources found in a sub-pass; asks for what reads one that changed."""
    height, width = window.mask.shape
    plane = window.planes[p]
    for i in range(count):
        y, x = places[i] // width, places[i] % width
        if plane[y, x] != found[i]:
            plane[y, x] = found[i]
            if not window.fresh:
                _mark_readers(window, y, x, p, turn)
    for y in range(height):
        for x in range(width):
            if _turn(y + window.y, x + window.x) == turn and plane[y, x] != window.now[y, x]:
                _show(window, example.compared, example.region.shape[1], y, x, plane[y, x])


@njit(cache=True, nogil=True)
def correct_all(window, p, beyond, example, rules):
    """All of a pass."""
    places = np.empty(window.mask.size // 4 + window.mask.shape[0] + window.mask.shape[1] + 1, np.int32)
    found = np.empty(places.size, np.int32)
    for turn in range(SUBPASSES):
        count = wanted(window, p, turn, beyond, places)
        correct(window, places, 0, count, p, example, rules, found)
        settle(window, places, count, found, p, turn, example)
