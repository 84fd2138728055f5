"""Regions of like colour: which pixels hang together with one, and how much of those at the rim belongs to them.

Two colours are as unlike as the largest difference of their premultiplied channels.  A region is 4-connected.  Gaps are
closed by narrowing what is free until they are shut, and growing what was reached back; where the other side is free
as well, both meet halfway.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from engine.numeric.address import Rect
from engine.numeric.kernel import Int, Low, Real, forced, inner, kernel

RINGS = 4  # pixels beyond a region that may belong to it in part
HALO = 1.0 / 16.0  # of what lies under a soft line that may still be seen beside it
_RIDGE = 2  # px around a pixel within which its line is strongest
SHUT, FREE, REACHED, OTHER = 0, 1, 2, 3  # what is known of a pixel
_BESIDE = np.float32(0.5)  # of pixels beside a region that are covered, at least


class Likeness(NamedTuple):
    """`tolerance`: the greatest difference that is still alike, 0..1; `gap`: width of the gaps that are closed, px;
    `contiguous`: only what hangs together with the pixel."""

    tolerance: float = 0.1
    gap: int = 0
    contiguous: bool = True


class Region(NamedTuple):
    """`covered`: float32 (h, w), 1 inside, less at the rim; `rect`: of the array, outside which it is 0; `open`:
    whether the region reaches the array's border."""

    covered: np.ndarray
    rect: Rect
    open: bool


def region(picture: np.ndarray, x: int, y: int, likeness: Likeness) -> Region:
    """Returns the region of a pixel.  `picture`: premultiplied float32 (4, h, w).

    A pixel that is too near to a line for a gap's width belongs to the nearest place that is not; one of a region that
    is narrow everywhere, to all of that.
    """
    planes = np.ascontiguousarray(picture, np.float32)
    colour, tolerance = planes[:, y, x].copy(), np.float32(likeness.tolerance)
    _, height, width = planes.shape
    known = np.zeros((height + 2, width + 2), np.uint8)  # what lies outside is not free
    mark_alike(planes, colour, tolerance, known)
    if not likeness.contiguous:
        known *= np.uint8(REACHED)
    elif likeness.gap > 0:
        _flood_closed(known, y + 1, x + 1, (likeness.gap + 1) // 2)
    else:
        flood_from(known, y + 1, x + 1)
    covered, bounds = np.empty((height, width), np.float32), np.zeros(4, np.int64)
    reached = cover_region(planes, colour, known, covered, bounds)
    return Region(covered, Rect(*bounds.tolist()), reached)


@kernel
def mark_alike(planes: np.ndarray, colour: np.ndarray, tolerance: np.float32, known: np.ndarray) -> None:
    """Marks as free what is alike: `known` is uint8 (h + 2, w + 2)."""
    for y in range(planes.shape[1]):
        r, g, b, a = planes[0, y], planes[1, y], planes[2, y], planes[3, y]
        out = known[y + 1]
        for x in range(planes.shape[2]):
            near = abs(r[x] - colour[0]) <= tolerance
            near &= abs(g[x] - colour[1]) <= tolerance
            near &= abs(b[x] - colour[2]) <= tolerance
            near &= abs(a[x] - colour[3]) <= tolerance
            out[x + 1] = near


@inner
def _longer(stack: np.ndarray) -> np.ndarray:
    out = np.empty(2 * stack.shape[0], stack.dtype)
    out[: stack.shape[0]] = stack
    return out


@kernel
def flood_from(known: np.ndarray, y: int, x: int) -> None:
    """Makes own what is free and hangs together with a pixel, run by run."""
    width = known.shape[1]
    stack = np.empty(1024, np.int64)
    stack[0] = y * width + x
    count = 1
    while count:
        count -= 1
        y, x = stack[count] // width, stack[count] % width
        row = known[y]
        if row[x] != FREE:
            continue
        first, end = x, x + 1
        while row[first - 1] == FREE:
            first -= 1
        while row[end] == FREE:
            end += 1
        row[first:end] = REACHED
        for at in (y - 1, y + 1):
            beside, x = known[at], first
            while x < end:
                if beside[x] != FREE:
                    x += 1
                    continue
                if count == stack.shape[0]:
                    stack = _longer(stack)
                stack[count] = at * width + x
                count += 1
                while x < end and beside[x] == FREE:
                    x += 1


@kernel
def narrowed(known: np.ndarray, reach: int) -> np.ndarray:
    """Returns what is free with all pixels within `reach`, along rows and columns; beyond the border all is."""
    height, width = known.shape[0] - 2, known.shape[1] - 2
    across = np.empty((height, width), np.uint8)
    for y in range(height):
        row, out = known[y + 1], across[y]
        last, x = -reach - 1, 0  # of the pixels that are not free
        for end in range(width + reach):
            if end < width and row[end + 1] == SHUT:
                last = end
            x = end - reach
            if x >= 0:
                out[x] = last < x - reach
    found = np.zeros(known.shape, np.uint8)
    shut = np.zeros(width, np.int32)
    for end in range(height + reach):
        if end < height:
            come = across[end]
            for x in range(width):
                shut[x] += 1 - come[x]
        if end - 2 * reach - 1 >= 0:
            gone = across[end - 2 * reach - 1]
            for x in range(width):
                shut[x] -= 1 - gone[x]
        if end >= reach:
            out = found[end - reach + 1]
            for x in range(width):
                out[x + 1] = shut[x] == 0
    return found


@kernel
def _flood_closed(known: np.ndarray, y: int, x: int, reach: int) -> None:
    """As `flood_from`, with gaps of up to twice `reach` closed."""
    core = narrowed(known, reach)
    start = nearest_core(known, core, y, x)
    if start < 0:
        flood_from(known, y, x)
        return
    width = known.shape[1]
    flood_from(core, start // width, start % width)
    grow_back(known, core, 2 * reach)


@inner
def nearest_core(known: np.ndarray, core: np.ndarray, y: Int, x: Int) -> Int:
    """Returns the place of the pixel of the core that is fewest steps away; -1 if none can be reached."""
    width = known.shape[1]
    start: Int = y * width + x
    if core[y, x]:
        return start
    within, seen = known.reshape(-1), np.zeros(known.size, np.uint8)
    flat = core.reshape(-1)
    queue = np.empty(1024, np.int64)
    queue[0], seen[start] = start, 1
    done, count = 0, 1
    while done < count:
        here = queue[done]
        done += 1
        for step in (-width, -1, 1, width):
            there: Int = here + step
            if within[there] == FREE and not seen[there]:
                if flat[there]:
                    return there
                seen[there] = 1
                if count == queue.shape[0]:
                    queue = _longer(queue)
                queue[count] = there
                count += 1
    return -1


@inner
def grow_back(known: np.ndarray, core: np.ndarray, steps: int) -> None:
    """Makes own what is free and at most so many steps from the core's own pixels, and no farther than from others."""
    height, width = known.shape
    free = known.reshape(-1)
    queue, other = np.empty(4096 + width, np.int64), np.empty(4096 + width, np.int64)
    first: Low = np.int64(1)
    kind: Low = np.int64(REACHED)
    count: Low = np.int64(0)  # a constant would have what takes it compiled for that, too
    others: Low = np.int64(0)
    top, bottom, left, right = height, 0, width, 0  # of the own front
    for y in range(1, height - 1):
        own, out = core[y], known[y]
        for x in range(width):
            out[x] = REACHED if own[x] == REACHED else (OTHER if own[x] == FREE else out[x])
        if count + width > queue.shape[0]:
            queue = _longer(queue)
        before = count
        count = _fronts(core, y, first, width - 1, kind, queue, count)
        if count > before:
            top, bottom = min(top, y), y + 1
            left, right = min(left, queue[before] - y * width), max(right, queue[count - 1] - y * width + 1)
    far = 2 * steps  # others from beyond come too late
    kind = np.int64(FREE)
    for y in range(max(1, top - far), min(height - 1, bottom + far)):
        if others + width > other.shape[0]:
            other = _longer(other)
        others = _fronts(core, y, max(first, left - far), min(width - 1, right + far), kind, other, others)
    done: Low = np.int64(0)
    others_done: Low = np.int64(0)
    for _ in range(steps):
        queue, done, count = _ring(free, width, queue, done, count, np.uint8(REACHED))
        other, others_done, others = _ring(free, width, other, others_done, others, np.uint8(OTHER))


@inner
def _fronts(core: np.ndarray, y: int, first: int, end: int, kind: int, queue: np.ndarray, count: int) -> int:
    """Lists the pixels of a part of a row of the core, of one kind, beside which there are others than the core's."""
    above, own, below, start = core[y - 1], core[y], core[y + 1], y * core.shape[1]
    for x in range(first, end):
        inside = own[x - 1] != SHUT and own[x + 1] != SHUT and above[x] != SHUT and below[x] != SHUT
        if own[x] == kind and not inside:
            queue[count] = start + x
            count += 1
    return count


@inner
def _ring(
    free: np.ndarray, width: int, queue: np.ndarray, done: int, count: int, kind: np.uint8
) -> tuple[np.ndarray, int, int]:
    """Takes the free pixels beside those of the queue from `done` on."""
    end = count
    for n in range(done, end):
        for step in (-width, -1, 1, width):
            there = queue[n] + step
            if free[there] == FREE:
                free[there] = kind
                if count == queue.shape[0]:
                    queue = _longer(queue)
                queue[count] = there
                count += 1
    return queue, end, count


@forced
def _unlike(planes: np.ndarray, colour: np.ndarray, y: int, x: int) -> Real:
    far: Real = abs(planes[0, y, x] - colour[0])
    for c in range(1, 4):
        far = max(far, abs(planes[c, y, x] - colour[c]))
    return far


@inner
def _rims(
    above: np.ndarray, own: np.ndarray, below: np.ndarray, near: np.ndarray, rim: np.ndarray, out: np.ndarray
) -> tuple[int, int]:
    """Writes what a row of the region covers, and which pixels lie beside it; returns the first and last of both, or
    -1."""
    width = out.shape[0]
    for x in range(width + 2):
        near[x] = (above[x] == REACHED) | (own[x] == REACHED) | (below[x] == REACHED)
    for x in range(width):
        out[x] = own[x + 1] == REACHED
    for x in range(width):
        rim[x] = near[x] | near[x + 1] | near[x + 2]
    first, last = 0, width - 1
    while first < width and rim[first] == 0:
        first += 1
    while last >= first and rim[last] == 0:
        last -= 1
    for x in range(width):
        rim[x] &= own[x + 1] != REACHED
    return first, last if first <= last else -1


@inner
def _listed(rim: np.ndarray, start: int, queue: np.ndarray, count: int) -> int:
    for x in range(rim.shape[0]):
        if rim[x]:
            queue[count] = start + x
            count += 1
    return count


@kernel
def cover_region(
    planes: np.ndarray, colour: np.ndarray, known: np.ndarray, covered: np.ndarray, bounds: np.ndarray
) -> bool:
    """Writes how much of each pixel is covered, and the bounds of that; tells whether own pixels lie at the border.

    Pixels beside the region are covered by a half at least.  From them on, as long as a line becomes stronger, and up
    to RINGS pixels, they are covered so far that of what is neither line nor fill HALO is seen at most: 1 - HALO / (1 -
    s), s being the pixel's difference against the greatest around it.
    """
    height, width = covered.shape
    queue = np.empty(4096 + width, np.int64)
    count: Low = np.int64(0)
    near, rim = np.empty(width + 2, np.uint8), np.empty(width, np.uint8)
    bounds[:] = width, height, 0, 0
    reached = False
    for y in range(height):
        own = known[y + 1]
        first, last = _rims(known[y], own, known[y + 2], near, rim, covered[y])
        if last < 0:
            continue
        _widen(bounds, first, y)
        _widen(bounds, last, y)
        reached |= own[1] == REACHED or own[width] == REACHED
        if y == 0 or y == height - 1:
            for x in range(width):
                reached |= own[x + 1] == REACHED
        if count + width > queue.shape[0]:
            queue = _longer(queue)
        count = _listed(rim, y * width, queue, count)
    for n in range(count):
        y, x = queue[n] // width, queue[n] % width
        part = _part(planes, colour, y, x) if known[y + 1, x + 1] == SHUT else _BESIDE
        covered[y, x] = max(part, _BESIDE)
    done: Low = np.int64(0)
    for _ in range(RINGS - 1):
        queue, done, count = _rise(planes, colour, known, covered, bounds, queue, done, count)
    bounds[0], bounds[1] = min(bounds[0], bounds[2]), min(bounds[1], bounds[3])
    return reached


@inner
def _widen(bounds: np.ndarray, x: int, y: int) -> None:
    bounds[0], bounds[1] = min(bounds[0], x), min(bounds[1], y)
    bounds[2], bounds[3] = max(bounds[2], x + 1), max(bounds[3], y + 1)


@inner
def _rise(
    planes: np.ndarray,
    colour: np.ndarray,
    known: np.ndarray,
    covered: np.ndarray,
    bounds: np.ndarray,
    queue: np.ndarray,
    done: int,
    count: int,
) -> tuple[np.ndarray, int, int]:
    """Covers the pixels of lines beside those of the queue from `done` on that are stronger than these."""
    height, width = covered.shape
    end = count
    for n in range(done, end):
        y, x = queue[n] // width, queue[n] % width
        far = _unlike(planes, colour, y, x)
        for at in range(max(y - 1, 0), min(y + 2, height)):
            for to in range(max(x - 1, 0), min(x + 2, width)):
                if covered[at, to] != 0 or known[at + 1, to + 1] != SHUT or _unlike(planes, colour, at, to) <= far:
                    continue
                part = _part(planes, colour, at, to)
                if part > 0:
                    covered[at, to] = part
                    _widen(bounds, to, at)
                    if count == queue.shape[0]:
                        queue = _longer(queue)
                    queue[count] = at * width + to
                    count += 1
    return queue, end, count


@inner
def _part(planes: np.ndarray, colour: np.ndarray, y: int, x: int) -> Real:
    """Returns how far a pixel of a line is covered."""
    own = _unlike(planes, colour, y, x)
    most: Real = np.float32(0)
    for at in range(max(y - _RIDGE, 0), min(y + _RIDGE + 1, planes.shape[1])):
        for to in range(max(x - _RIDGE, 0), min(x + _RIDGE + 1, planes.shape[2])):
            most = max(most, _unlike(planes, colour, at, to))
    left = most - own
    if left <= np.float32(HALO) * most:
        return np.float32(0)
    return np.float32(1) - np.float32(HALO) * most / left
