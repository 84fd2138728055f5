"""The kernels of module `lifting` in NumPy, with the same bits; their arguments and results are the same."""

from __future__ import annotations

import numpy as np

from engine.canvas.plain import LAG, Corner, Pair, Window, clamp_alpha, halve
from engine.canvas.rising.spans import Extent, Lowered, Marks, extent_of, spans_of, within
from engine.numeric.grid import FINE_STEP, snapped_to
from engine.numeric.kernel import Array

_ZERO, _ONE = np.float32(0.0), np.float32(1.0)


def lower(
    sources: Pair, maps: Pair, keep: Array, below: Marks, window: Window, lowered: Lowered, step: np.float32
) -> None:
    """Does what the kernel of that name in `lifting` does."""
    row, column, height, width, top, left = window
    means, kept, parents, spans = lowered
    inner, outer = (slice(row, row + 2 * height), slice(column, column + 2 * width)), np.s_[top : top + height]
    shape = height, width
    halved = np.empty((2, len(maps[0]), *shape), np.float32), np.empty((1, *shape), np.float32)
    for source, planes, out in zip(sources, maps, halved[0], strict=True):
        halve(source[:, *inner], planes, out, 0, 0, step)
    halve(keep[None, *inner], np.zeros(1, np.int64), halved[1], 0, 0, FINE_STEP)
    marked = below[1][inner[0]].reshape(height, 2, 2)
    first, last = marked[:, :, 0].min(axis=1), marked[:, :, 1].max(axis=1)
    empty = first >= last
    here = np.where(empty[:, None], (1 << 30, 0), np.column_stack([first // 2, (last + 1) // 2]) + left - column // 2)
    spans[outer, 0] = np.minimum(spans[outer, 0], here[:, 0])
    spans[outer, 1] = np.maximum(spans[outer, 1], here[:, 1])
    inside = within(here - left, width)
    marks = below[0][inner] != 0
    rows = marks[::2] | marks[1::2]
    place = outer, slice(left, left + width)
    parents[place] = np.where(inside, rows[:, ::2] | rows[:, 1::2], parents[place])
    kept[place] = np.where(inside, halved[1][0], kept[place])
    means[:, :, *place] = np.where(inside, halved[0], means[:, :, *place])


def climb(
    lowered: Lowered, spares: bool, around: Array, corner: Corner, values: Array, marks: Marks, step: np.float32,
    noise: Array,
) -> Extent:  # fmt: skip
    """Does what the kernel of that name in `lifting` does."""
    means, keep, parents, _ = lowered
    top, left = corner
    changed, spans = marks
    old, new = values
    old[...] = around[:, top : top + keep.shape[0], left : left + keep.shape[1]]
    on = parents != 0
    keep[~on] = _ONE
    rest = old - np.where(on, means[0], _ZERO)
    rest[np.abs(rest) <= LAG * step] = _ZERO
    kept = keep * rest + noise if noise.size else keep * rest
    new[...] = np.where(on, np.where(on, means[1], _ZERO) + snapped_to(kept, step), old)
    if spares:
        new[3] = old[3]
    else:
        clamp_alpha(new, 0, new.shape[1])
    changed[...] = (keep != _ONE) + 2 * (new != old).any(axis=0)
    spans[...] = spans_of(changed)
    return extent_of(changed)


def place_changed(values: Array, planes: Array, spans: Array, out: Array, top: int, left: int) -> None:
    """Does what the kernel of that name in `lifting` does."""
    height, width = values.shape[1:]
    inside = within(spans, width)
    for c, source in enumerate(planes.tolist()):
        part = out[c, top : top + height, left : left + width]
        part[inside] = values[source][inside] if source >= 0 else _ZERO


def spread(parents: np.ndarray, top: int, left: int, out: np.ndarray, spans: np.ndarray) -> bool:
    """Does what the kernel of that name in `lifting` does."""
    y = np.arange(out.shape[0])
    row, columns = top + 1 + y // 2, slice(left, left + out.shape[1] // 2 + 2)
    both = (parents[row, columns] | parents[row + 2 * (y & 1) - 1, columns]) & 2
    out[:, ::2] |= both[:, 1:-1] | both[:, :-2]
    out[:, 1::2] |= both[:, 1:-1] | both[:, 2:]
    spans[...] = 2 * spans_of(out[:, ::2] | out[:, 1::2])
    return bool(out.any())
