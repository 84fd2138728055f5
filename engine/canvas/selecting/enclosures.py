"""The regions that a closed line goes round wholly: they hang together with nothing outside of it.

Found on a picture whose outermost pixels lie outside: what hangs together with any pixel outside is marked, and what is
left is within.
"""

from __future__ import annotations

import numpy as np

from engine.numeric.address import Rect
from engine.numeric.flood import (
    FREE,
    OTHER,
    REACHED,
    Likeness,
    Region,
    cover_region,
    flood_from,
    grow_back,
    mark_alike,
    narrowed,
)
from engine.numeric.kernel import kernel


def enclosed(picture: np.ndarray, inside: np.ndarray, colour: np.ndarray, likeness: Likeness) -> Region:
    """Returns all regions of one colour, premultiplied float32 (4,), that lie wholly inside, bool (h, w), of a picture,
    premultiplied float32 (4, h, w); covered along soft lines as `flood.region` has it, but nothing outside."""
    planes = np.ascontiguousarray(picture, np.float32)
    _, height, width = planes.shape
    known = np.zeros((height + 2, width + 2), np.uint8)
    mark_alike(planes, colour, np.float32(likeness.tolerance), known)
    known[1:-1, 1:-1][~inside] = FREE
    shut = known.copy()  # what is within though no gap is closed
    _flood_outside(shut, inside)
    within = shut == FREE
    if likeness.gap > 0:
        _close(known, inside, (likeness.gap + 1) // 2)
    known[known == FREE] = OTHER
    if likeness.gap <= 0:
        known[shut == REACHED] = OTHER
    known[within] = REACHED
    covered, bounds = np.empty((height, width), np.float32), np.zeros(4, np.int64)
    cover_region(planes, colour, known, covered, bounds)
    covered[~inside] = 0
    return Region(covered, Rect(*bounds.tolist()), False)


def enclosed_all(picture: np.ndarray, inside: np.ndarray, tolerance: float) -> Region:
    """Returns all that lies inside, bool (h, w), but for what hangs together, colour by colour, with a pixel at its
    rim: lines within it, too.  Of the pixels beside that a half is covered."""
    planes = np.ascontiguousarray(picture, np.float32)
    known = np.zeros((inside.shape[0] + 2, inside.shape[1] + 2), np.uint8)
    known[1:-1, 1:-1] = np.where(inside, np.uint8(FREE), np.uint8(OTHER))
    _reach(planes, np.float32(tolerance), known)
    covered = (known[1:-1, 1:-1] == FREE).astype(np.float32)
    _soften(known, covered)
    rows, columns = np.flatnonzero(covered.any(axis=1)), np.flatnonzero(covered.any(axis=0))
    bounds = Rect(0, 0, 0, 0)
    if len(rows):
        bounds = Rect(int(columns[0]), int(rows[0]), int(columns[-1]) + 1, int(rows[-1]) + 1)
    return Region(covered, bounds, False)


@kernel
def _flood_outside(known: np.ndarray, inside: np.ndarray) -> None:
    """Makes own what is free and hangs together with anything outside."""
    for y in range(inside.shape[0]):
        for x in range(inside.shape[1]):
            if not inside[y, x] and known[y + 1, x + 1] == FREE:
                flood_from(known, y + 1, x + 1)


@kernel
def _close(known: np.ndarray, inside: np.ndarray, reach: int) -> None:
    """Makes own what hangs together with nothing outside where gaps of up to twice `reach` are closed."""
    core = narrowed(known, reach)
    _flood_outside(core, inside)
    for y in range(core.shape[0]):
        for x in range(core.shape[1]):
            core[y, x] = FREE if core[y, x] == REACHED else (REACHED if core[y, x] == FREE else core[y, x])
    grow_back(known, core, 2 * reach)


@kernel
def _reach(planes: np.ndarray, tolerance: np.float32, known: np.ndarray) -> None:
    """Marks as another's what hangs together with a pixel at the rim of what is free, and is alike; `known` is uint8
    (h + 2, w + 2)."""
    height, width = planes.shape[1], planes.shape[2]
    stack = np.empty(height * width + 1, np.int64)
    rim = np.zeros((height, width), np.bool_)
    for y in range(height):
        for x in range(width):
            beside = known[y, x + 1] == OTHER or known[y + 2, x + 1] == OTHER
            beside |= known[y + 1, x] == OTHER or known[y + 1, x + 2] == OTHER
            rim[y, x] = known[y + 1, x + 1] == FREE and beside
    for y in range(height):
        for x in range(width):
            if not rim[y, x] or known[y + 1, x + 1] != FREE:
                continue
            r, g, b, a = planes[0, y, x], planes[1, y, x], planes[2, y, x], planes[3, y, x]
            stack[0], count = y * width + x, 1
            known[y + 1, x + 1] = OTHER
            while count:
                count -= 1
                v, u = stack[count] // width, stack[count] % width
                for n in range(4):
                    to, at = u + (n == 0) - (n == 1), v + (n == 2) - (n == 3)
                    if known[at + 1, to + 1] != FREE:
                        continue
                    near = abs(planes[0, at, to] - r) <= tolerance and abs(planes[1, at, to] - g) <= tolerance
                    near = near and abs(planes[2, at, to] - b) <= tolerance and abs(planes[3, at, to] - a) <= tolerance
                    if near:
                        known[at + 1, to + 1] = OTHER
                        stack[count] = at * width + to
                        count += 1


@kernel
def _soften(known: np.ndarray, covered: np.ndarray) -> None:
    """Covers by a half what is covered beside a pixel that is another's."""
    for y in range(covered.shape[0]):
        for x in range(covered.shape[1]):
            if covered[y, x] == 0:
                continue
            for at in range(y, y + 3):
                for to in range(x, x + 3):
                    if known[at, to] == OTHER:
                        covered[y, x] = 0.5
