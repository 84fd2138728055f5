"""What corrections work on, as kernels take it: a level of the example, the rules, and a window of the region.

All arrays of a window have MARGIN pixels around what may be corrected.  Corrections are made in four sub-passes, one
for each parity of row and column; `need` tells which pixels a sub-pass has to look at.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from engine.numeric.kernel import inlined, inner_uncounted, kernel
from engine.numeric.neighbourhood import RADIUS, region_bits

MARGIN = RADIUS + 1  # even
SUBPASSES = 4
OUTSIDE = -1  # instead of a source, where there is no region


class Example(NamedTuple):
    """A level of the exemplar; `compared` flat; `shapes`: uint64, the bits of those of `order` that do not lie wholly
    inside, which come first, and FULL; `told`, `turns`: its control channels, as `Control` has them."""

    compared: np.ndarray
    region: np.ndarray
    bits: np.ndarray
    order: np.ndarray
    shapes: np.ndarray
    starts: np.ndarray
    told: np.ndarray
    turns: np.ndarray


class Rules(NamedTuple):
    """`penalty`: energy of a pixel of another shape; `leeway`: so many of those are free; `square`: bits of the
    neighbourhood; `kappa`, `rim_kappa`: 256 (1 + kappa), inside and at a rim; `stride`: of the search through all
    candidates, 0 for none; `rims`: whether the region's shape counts; `told`: int32, the weights of control channels,
    none at levels where they do not count; `depth`: energy of a neighbour more or less inside, beyond one; `shapes`: of
    a rim that are searched, about, at most; `pieces`: whether rims start from pieces of the example's."""

    weights: np.ndarray
    square: np.uint64
    penalty: int
    leeway: int
    kappa: int
    rim_kappa: int
    stride: int
    rims: bool
    told: np.ndarray
    depth: int
    shapes: int
    pieces: bool


class Window(NamedTuple):
    """`mask`, `was`: uint8 (h, w), the region now and before; `bits`: uint64 (h, w), its shapes; `now`: int32 (h, w),
    the sources at this moment; `shown`, `care`: int16 (h * w * 4), their values, and -1 inside the region; `planes`:
    int32 (passes + 1, h, w), the sources after each pass, from the start (0) on, as they were until they are corrected;
    `need`: uint8 (passes + 1, h, w), what is to be corrected in each; `hashes`: uint64 (h, w), by place; `y`, `x`:
    parity of the first row and column; `fresh`: nothing of it was there before; `told`: uint8 (C, h, w), control
    channels."""

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
    told: np.ndarray


class WindowPlace(NamedTuple):
    """`y`, `x`: parity of a window's first row and column; `told`: what its control channels tell now, and before."""

    y: int
    x: int
    told: tuple[np.ndarray, np.ndarray]


def window_of(mask: np.ndarray, was: np.ndarray, planes: np.ndarray, hashes: np.ndarray, place: WindowPlace) -> Window:
    """Returns a window whose shapes, and what they ask for, are known; a `starts` function has to follow."""
    size = mask.shape
    bits, need = np.zeros(size, np.uint64), np.zeros(planes.shape, np.uint8)
    shown, care = np.zeros(4 * mask.size, np.int16), np.zeros(4 * mask.size, np.int16)
    region_bits(mask, bits)
    fresh = not was.any()
    _mark_shapes(mask, was, need, fresh)
    if not fresh and len(place.told[0]):
        _mark_told(*place.told, mask, need)
    now = np.full(size, OUTSIDE, np.int32)
    return Window(mask, was, bits, now, shown, care, planes, need, hashes, place.y, place.x, fresh, place.told[0])


@inlined
def shape_at(example: Example, i: int) -> np.uint64:
    """Returns the shape around a pixel of the order."""
    return example.shapes[min(i, example.shapes.size - 1)]  # type: ignore[no-any-return]


@inlined
def first_of(window: Window, turn: int) -> tuple[int, int]:
    """Returns the first row and column of the four sub-passes' pixels: every other one, beginning with (0, 0), (1,
    1), (0, 1) and (1, 0) where the window's own place is even."""
    return (turn ^ window.y) & 1, ((turn + 1 >> 1) ^ window.x) & 1


@inlined
def turn_of(window: Window, y: int, x: int) -> int:
    """Returns the sub-pass that corrects a pixel."""
    return (y + window.y & 1) * 3 if (x + window.x & 1) == 0 else 2 - (y + window.y & 1)


@kernel
def _mark_shapes(mask: np.ndarray, was: np.ndarray, need: np.ndarray, fresh: bool) -> None:
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


@kernel
def _mark_told(told: np.ndarray, before: np.ndarray, mask: np.ndarray, need: np.ndarray) -> None:
    """Asks for all pixels of which control channels tell something else than before, in every pass."""
    height, width = mask.shape
    for c in range(told.shape[0]):
        for y in range(height):
            for x in range(width):
                if told[c, y, x] != before[c, y, x] and mask[y, x]:
                    for p in range(need.shape[0]):
                        need[p, y, x] = 1


@inner_uncounted
def mark_readers(window: Window, y: int, x: int, p: int, turn: int) -> None:
    """Asks for the pixels that read the source of one as it is after pass `p` (0: at the start)."""
    height, width = window.mask.shape
    top, left = max(0, y - RADIUS), max(0, x - RADIUS)
    for other in range(SUBPASSES):
        then = p if other > turn else p + 1
        if then == 0 or then >= window.need.shape[0]:
            continue
        need = window.need[then]
        first = first_of(window, other)
        for row in range(top + (top + first[0] & 1), min(height, y + RADIUS + 1), 2):
            for column in range(left + (left + first[1] & 1), min(width, x + RADIUS + 1), 2):
                need[row, column] = 1
