"""Order-independent correction (Lefebvre & Hoppe 2005, "Parallel controllable texture synthesis") over the energy of
Ritter et al. 2006, section 5, in which the shape of the region takes part.

Each pass corrects the pixels of a level in four sub-passes, one for each parity of row and column.  A pixel reads what
its neighbourhood was before its own sub-pass, so nothing depends on the order within one, nor on threads or tiles.
Energies are whole numbers.
"""

from __future__ import annotations

import numpy as np

from engine.numeric.hashing import mix64
from engine.numeric.kernel import Array, Int, inlined, inner_uncounted, uncounted
from engine.numeric.neighbourhood import (
    FULL,
    RADIUS,
    SIDE,
    middle_apart,
    middle_apart_within,
    ones,
    others_apart,
    others_apart_within,
)
from engine.texture.example.channels import told_apart, turned_source, way_of
from engine.texture.example.exemplar import COUNTS
from engine.texture.example.region_window import (
    MARGIN,
    OUTSIDE,
    SUBPASSES,
    Example,
    Rules,
    Window,
    first_of,
    mark_readers,
)

REACH = SUBPASSES * RADIUS  # pixels that a change can spread in a pass

_FAR = np.int32(2**31 - 1)
_RIM_CANDIDATES = 8
_ONE_IN = 3  # shapes at most, drawn by place: along a straight rim the best of all would be the same again and again
_COUNTS_APART, _SHAPES_APART = 2, 2  # of what is searched at a rim: neighbours inside, and pixels of the shape
_GOLDEN = np.uint64(0x9E3779B97F4A7C15)


@inlined
def _show(window: Window, compared: np.ndarray, stride: Int, y: Int, x: Int, source: Int) -> None:
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


@uncounted
def wanted(window: Window, p: Int, turn: Int, beyond: Int, places: np.ndarray) -> int:
    """Lists the pixels to correct in a sub-pass, as row * width + column; gives their number.

    `beyond`: pixels along the edges that do not count after the pass, nor do those that only such pixels read then.
    """
    height, width = window.mask.shape
    count = 0
    margin = max(MARGIN, beyond - RADIUS * (SUBPASSES - 1 - turn))
    first = first_of(window, turn)  # type: ignore[arg-type]
    for y in range(margin + (margin + first[0] & 1), height - margin, 2):
        asked, mask = window.need[p, y], window.mask[y]
        for x in range(margin + (margin + first[1] & 1), width - margin, 2):
            if asked[x] and mask[x]:
                places[count] = y * width + x
                count += 1
    return count


@inner_uncounted
def _colours_apart(
    window: Window, i: Int, example: Example, j: Int, weights: np.ndarray, rim: bool, e: Int, least: Int
) -> Int:
    """`e` and how far the colours of two neighbourhoods are apart, or some number from `least` on."""
    row, other = 4 * window.mask.shape[1], 4 * example.region.shape[1]
    if rim:
        e += middle_apart_within(window.shown, i, row, example.compared, j, other, weights, 0, window.care)
        if e < least:
            e += others_apart_within(window.shown, i, row, example.compared, j, other, weights, 0, window.care)
    else:
        e += middle_apart(window.shown, i, row, example.compared, j, other, weights, 0)
        if e < least:
            e += others_apart(window.shown, i, row, example.compared, j, other, weights, 0)
    return np.int32(e)


@inlined
def _energy(
    window: Window, y: Int, x: Int, example: Example, name: Int, rules: Rules, bits: Int, rim: bool, least: Int
) -> Int:
    """Returns the energy between the neighbourhoods of a pixel and of an example's, or some number from `least` on.

    At a `rim` what lies outside the region does not count but for its shape.
    """
    row, column = name >> 16, name & 0xFFFF
    other = example.bits[row, column] & rules.square
    e = np.int32(rules.penalty * max(0, ones(bits ^ other) - rules.leeway))
    e += np.int32(rules.depth * max(0, abs(ones(bits) - ones(other)) - 1))
    e += told_apart(window, y, x, example, name, rules)
    if e >= least:
        return e
    i = 4 * ((y - RADIUS) * window.mask.shape[1] + x - RADIUS)
    return _colours_apart(window, i, example, _corner(example, name), rules.weights, rim, e, least)


@inlined
def _corrected(window: Window, y: Int, x: Int, p: Int, example: Example, rules: Rules, tried: np.ndarray) -> Int:
    """Returns the best source for one pixel: what continues its neighbours' sources, or what is much nearer."""
    bits = window.bits[y, x] & rules.square
    rim = bits != rules.square or window.bits[y, x] > FULL
    if not rules.rims:
        bits = rules.square
    searched = rules.stride > 0 or (bits != rules.square and p == 1)
    count = _continued(window, y, x, example, rules.stride > 0, tried)
    if example.turns.size:
        count = _turned_too(window, y, x, example, tried, count)
    if count == 1 and not searched:
        return tried[0]  # type: ignore[no-any-return]
    least, best = _FAR, np.int32(OUTSIDE)
    for k in range(count):
        e = _energy(window, y, x, example, tried[k], rules, bits, rim, least)
        if e < least:
            least, best = e, tried[k]  # type: ignore[assignment]
    if least == 0:
        return best
    limit = least if best < 0 else np.int32(np.int64(least) * 256 // rules.kappa)
    h = mix64(window.hashes[y, x] + np.uint64(p) * _GOLDEN)
    if rules.stride:
        way = way_of(window, y, x, example)
        last = np.int64(example.starts[way + COUNTS])
        first = example.starts[way] + np.int64(h % np.uint64(min(rules.stride, last - example.starts[way])))
        return _searched(window, y, x, example, rules, bits, rim, limit, best, first, last, rules.stride)
    if searched:
        return _searched_rim(window, y, x, example, rules, bits, least, best, h)
    return best


@inlined
def _continued(window: Window, y: Int, x: Int, example: Example, coarsest: bool, names: np.ndarray) -> Int:
    """Makes the coherence search: lists the sources that continue those of a pixel and its neighbours; gives their
    number."""
    count = 0
    for k in range(9):
        if k == 0 and coarsest:
            continue  # at the coarsest level a pixel does not hold to itself
        dy, dx = (k + 4) % 9 // 3 - 1, (k + 4) % 9 % 3 - 1
        source = window.now[y + dy, x + dx]
        if source < 0:
            continue
        name = np.int32(source - (dy << 16) - dx)
        if _holds(names, count, name) or example.region[name >> 16, name & 0xFFFF] == 0:
            continue
        names[count] = name
        count += 1
    return count


@inlined
def _turned_too(window: Window, y: Int, x: Int, example: Example, names: np.ndarray, count: Int) -> Int:
    """Lists beside some sources those of the same place of the example in the copy that is turned as the channel of
    orientation tells, where they are in another one; gives the number of all."""
    listed = count
    for i in range(listed):
        name = turned_source(example, names[i], window.told[0, y, x])
        if name >= 0 and not _holds(names, count, name):
            names[count] = name
            count += 1
    return count


@inlined
def _holds(names: np.ndarray, count: Int, name: Int) -> bool:
    found = False
    for i in range(count):
        found = found or names[i] == name
    return found


@inner_uncounted
def _searched(
    window: Window,
    y: Int,
    x: Int,
    example: Example,
    rules: Rules,
    bits: Int,
    rim: bool,
    limit: Int,
    best: Int,
    first: Int,
    last: Int,
    stride: Int,
) -> Int:
    """Returns the best of some of the example's pixels in their order, if its energy is below `limit`; else `best`."""
    for i in range(first, last, stride):
        e = _energy(window, y, x, example, example.order[i], rules, bits, rim, limit)
        if e < limit:
            limit, best = e, example.order[i]
    return best


@inner_uncounted
def _searched_rim(
    window: Window, y: Int, x: Int, example: Example, rules: Rules, bits: Int, limit: Int, best: Int, h: Int
) -> Int:
    """Returns the best of those with about as many neighbours inside whose shapes are nearest, if it is below `limit`.

    What is another shape weighs as it is, only colours weigh (1 + kappa) times as much as those of what continues the
    neighbours: so shapes override colours, whatever the rim looks like (Ritter et al. 2006, section 5).
    """
    way = way_of(window, y, x, example)
    first, last = _alike(example.starts[way : way + COUNTS + 1], ones(window.bits[y, x] & FULL))
    step = max(_ONE_IN, (last - first) // rules.shapes)
    first += np.int64(h % np.uint64(step))
    nearest, count = np.int32(SIDE * SIDE + 1), 0
    for i in range(first, last, step):
        apart = ones(bits ^ (example.shapes[i] & rules.square))
        if apart < nearest:
            nearest, count = apart, 0
        count += apart == nearest
    near = nearest + (_SHAPES_APART if count < _RIM_CANDIDATES else 0)
    corner = 4 * ((y - RADIUS) * window.mask.shape[1] + x - RADIUS)
    share = (256 << 16) // rules.rim_kappa + 1
    for i in range(first, last, step):
        apart = ones(bits ^ (example.shapes[i] & rules.square))
        shape = np.int32(rules.penalty * max(0, apart - rules.leeway))
        if apart > near or shape >= limit:
            continue
        name = example.order[i]
        shape += told_apart(window, y, x, example, name, rules)
        if shape >= limit:
            continue
        most = np.int32(((limit - shape) * share >> 16) + 1)  # of the colours, beyond which it is too far in any case
        e = _colours_apart(window, corner, example, _corner(example, name), rules.weights, True, np.int32(0), most)
        e = np.int64(shape) + np.int64(e) * rules.rim_kappa // 256
        if e < limit:
            limit, best = np.int32(e), name
    return best


@inlined
def _corner(example: Example, name: Int) -> Int:
    """Tells where the neighbourhood of a pixel of the example begins."""
    return 4 * (((name >> 16) - RADIUS) * example.region.shape[1] + (name & 0xFFFF) - RADIUS)  # type: ignore[no-any-return]


@inner_uncounted
def _alike(starts: np.ndarray, count: Int) -> tuple[Int, Int]:
    """Returns the part of the order with about so many neighbours inside, though not all, or with the next fewer and
    more."""
    most = SIDE * SIDE - 1
    low, high = max(0, count - _COUNTS_APART), min(most, count + _COUNTS_APART)
    while low > 0 and starts[low] == starts[count]:
        low -= 1
    while high < most and starts[high + 1] == starts[count + 1]:
        high += 1
    return np.int64(starts[low]), np.int64(starts[high + 1])


@uncounted
def _correct(
    window: Window,
    places: Array,
    first: Int,
    last: Int,
    p: Int,
    example: Example,
    rules: Rules,
    found: Array,
    tried: Array,
) -> None:
    width = window.mask.shape[1]
    for i in range(first, last):
        found[i] = _corrected(window, places[i] // width, places[i] % width, p, example, rules, tried)


def correct(
    window: Window,
    places: np.ndarray,
    first: int,
    last: int,
    p: int,
    example: Example,
    rules: Rules,
    found: np.ndarray,
) -> None:
    """Finds the sources of the pixels places[first:last]."""
    _correct(window, places, first, last, p, example, rules, found, np.empty(18, np.int32))


@uncounted
def settle(
    window: Window, places: np.ndarray, count: Int, found: np.ndarray, p: Int, turn: Int, example: Example
) -> None:
    """Takes over the sources found in a sub-pass; asks for what reads one that changed."""
    height, width = window.mask.shape
    plane = window.planes[p]
    for i in range(count):
        y, x = places[i] // width, places[i] % width
        if plane[y, x] != found[i]:
            plane[y, x] = found[i]
            if not window.fresh:
                mark_readers(window, y, x, p, turn)  # type: ignore[arg-type]
    first = first_of(window, turn)  # type: ignore[arg-type]
    for y in range(first[0], height, 2):
        for x in range(first[1], width, 2):
            if plane[y, x] != window.now[y, x]:
                _show(window, example.compared, example.region.shape[1], y, x, plane[y, x])


def correct_all(window: Window, p: int, beyond: int, example: Example, rules: Rules) -> None:
    """Corrects all of a pass."""
    places = np.empty(window.mask.size // 4 + window.mask.shape[0] + window.mask.shape[1] + 1, np.int32)
    found = np.empty(places.size, np.int32)
    for turn in range(SUBPASSES):
        count = wanted(window, p, turn, beyond, places)
        correct(window, places, 0, count, p, example, rules, found)
        settle(window, places, count, found, p, turn, example)
