"""Regions of like colour on a torus: what leaves a picture at one side goes on at the other."""

from __future__ import annotations

import numpy as np

from engine.numeric.flood import (
    FREE,
    REACHED,
    RINGS,
    Likeness,
    cover_region,
    flood_from,
    grow_back,
    mark_alike,
    narrowed,
    nearest_core,
)
from engine.numeric.kernel import kernel


def region_around(picture: np.ndarray, x: int, y: int, likeness: Likeness) -> np.ndarray:
    """Returns how much of each pixel of a picture that repeats without end the region of a pixel covers, as
    `flood.region`: float32 (h, w).  `picture`: premultiplied float32 (4, h, w)."""
    _, height, width = picture.shape
    reach = (likeness.gap + 1) // 2
    pad = 2 * (reach + RINGS)  # what a pixel's coverage depends on lies within
    planes = np.ascontiguousarray(with_repeats(picture, pad), np.float32)
    colour = planes[:, y + pad, x + pad].copy()
    known = np.zeros((height + 2 * pad + 2, width + 2 * pad + 2), np.uint8)
    mark_alike(planes, colour, np.float32(likeness.tolerance), known)
    if not likeness.contiguous:
        known *= np.uint8(REACHED)
    else:
        _flood(known, (height, width), pad, y, x, reach)
    covered, bounds = np.empty(planes.shape[1:], np.float32), np.zeros(4, np.int64)
    cover_region(planes, colour, known, covered, bounds)
    return covered[pad : pad + height, pad : pad + width]


def with_repeats(picture: np.ndarray, pad: int) -> np.ndarray:
    """Returns a picture, (..., h, w), with so many pixels of its repeats all around."""
    rows, columns = (np.arange(-pad, side + pad) % side for side in picture.shape[-2:])
    found: np.ndarray = picture[..., rows[:, None], columns]
    return found


@kernel
def _flood(known: np.ndarray, size: tuple[int, int], pad: int, y: int, x: int, reach: int) -> None:
    """Makes own what is free and hangs together with a pixel of the cell: `known` is uint8 (h + 2 pad + 2, w + 2 pad +
    2) of a cell of `size` (h, w).  Gaps of up to twice `reach` are closed."""
    height, width = size
    core = known if reach == 0 else narrowed(known, reach)
    down, right = y + pad + 1, x + pad + 1
    if reach:
        start = nearest_core(known, core, down, right)
        if start < 0:
            core, reach = known, 0
        else:
            down, right = start // known.shape[1], start % known.shape[1]
    cell = np.zeros((height + 2, width + 2), np.uint8)
    cell[1:-1, 1:-1] = core[pad + 1 : pad + 1 + height, pad + 1 : pad + 1 + width]
    _flood_around(cell, (down - 1 - pad) % height + 1, (right - 1 - pad) % width + 1)
    for i in range(height + 2 * pad):
        for j in range(width + 2 * pad):
            core[i + 1, j + 1] = cell[(i - pad) % height + 1, (j - pad) % width + 1]
    if reach:
        grow_back(known, core, 2 * reach)


@kernel
def _flood_around(known: np.ndarray, y: int, x: int) -> None:
    """As `flood_from`, also over the rim: `known` is uint8 (h + 2, w + 2)."""
    height, width = known.shape[0] - 2, known.shape[1] - 2
    flood_from(known, y, x)
    grows = True
    while grows:
        grows = False
        for i in range(1, height + 1):
            for one, other in ((1, width), (width, 1)):
                if known[i, one] == REACHED and known[i, other] == FREE:
                    flood_from(known, i, other)
                    grows = True
        for j in range(1, width + 1):
            for one, other in ((1, height), (height, 1)):
                if known[one, j] == REACHED and known[other, j] == FREE:
                    flood_from(known, other, j)
                    grows = True
