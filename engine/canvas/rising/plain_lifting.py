"""The kernels of module `lifting` in NumPy, with the same bits; their arguments and results are the same."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product

import numpy as np

from engine.canvas.plain import LAG, QUARTER, Pair, Window, clamp_alpha
from engine.canvas.rising.spans import NO_COLUMNS, Lowered, Marks, Means, Spare, spans_of, within
from engine.numeric.grid import FINE_STEP, snapped_to
from engine.numeric.kernel import Array

_ZERO, _ONE = np.float32(0.0), np.float32(1.0)


def lower(
    sources: Pair, maps: Pair, keep: Array, below: Marks, window: Window, means: Means, out: Lowered, step: np.float32
) -> None:
    """Does what the kernel of that name in `lifting` does."""
    row, column, height, top, left, strip = window
    marked = below[1][row : row + 2 * height].reshape(height, 2, 2)
    first, last = marked[:, :, 0].min(axis=1), marked[:, :, 1].max(axis=1)
    for y in np.flatnonzero(first < last).tolist():
        begin, end = int(first[y]) // 2, (int(last[y]) + 1) // 2
        here = np.s_[row + 2 * y : row + 2 * y + 2, 2 * begin : 2 * end]
        halved = [_mean(_chosen(source, planes, here), step) for source, planes in zip(sources, maps, strict=True)]
        at = top + y, begin + left - column // 2
        out[2][at[0], strip] = at[1], at[1] + end - begin
        _put_row(halved, keep[here], below[0][here], at, means, out)


def climb(
    means: Means, here: Lowered, values: Array, window: Window, coarser: Means, above: Lowered, spare: Spare,
    spares: bool, step: np.float32, noise: Array,
) -> int:  # fmt: skip
    """Does what the kernel of that name in `lifting` does."""
    kept, marks, spans = here
    y0, y1, s0, s1, down, right, odd, shift = window
    count = 0
    for y, s in product(range(y0, y1, 2), range(s0, s1)):
        first = int(spans[y : y + 2, s, 0].min()) & ~1
        last = (int(spans[y : y + 2, s, 1].max()) + 1) & ~1
        if first >= last:
            continue
        part = np.s_[y : y + 2, first:last]
        was = values[:, *part].copy()
        _climb_pair(means, here, values, (y, first, last), spares, step, noise)
        spans[y : y + 2, s] = spans_of(marks[part]) + first
        spans[y : y + 2, s][~marks[part].any(axis=1)] = NO_COLUMNS
        begin, end = int(spans[y : y + 2, s, 0].min()) // 2, (int(spans[y : y + 2, s, 1].max()) + 1) // 2
        if begin >= end:
            continue
        count += 1
        row, strip, pair = y // 2 + down, ((s + odd) >> 1) + shift, np.s_[y : y + 2, 2 * begin : 2 * end]
        span = above[2][row, strip]
        span[:] = min(span[0], begin + right), max(span[1], end + right)
        halved = [_mean(v, step) for v in (was[:, :, 2 * begin - first : 2 * end - first], values[:, *pair])]
        _put_row(halved, kept[pair], marks[pair], (row, begin + right), coarser, above)
    return count


def _climb_pair(
    means: Means, here: Lowered, values: Array, where: tuple[int, int, int], spares: bool, step: np.float32,
    noise: Array,
) -> None:  # fmt: skip
    """Rule U on some columns of two rows: values, A and the marks."""
    y, first, last = where
    part, (lowered, (top, left)) = np.s_[y : y + 2, first:last], means
    on, old = here[1][part] != 0, values[:, *part].copy()
    before, after = lowered[:, :, y - top : y - top + 2, first - left : last - left]
    here[0][part][~on] = _ONE
    keep = here[0][part]
    rest = old - np.where(on, before, _ZERO)
    rest[np.abs(rest) <= LAG * step] = _ZERO
    kept = keep * rest + noise[part] if noise.size else keep * rest
    new = np.where(on, np.where(on, after, _ZERO) + snapped_to(kept, step), old)
    if spares:
        new[3] = old[3]
    else:
        clamp_alpha(new, 0, 2)
    values[:, *part] = new
    here[1][part] = (keep != _ONE) + 2 * (new != old).any(axis=0)


def _chosen(source: Array, planes: Array, part: tuple[slice, slice]) -> np.ndarray:
    """Returns a part of the planes that a map chooses, zero for -1."""
    found = [source[c, *part] if c >= 0 else np.zeros_like(source[0][part]) for c in planes.tolist()]
    return np.stack(found)


def _mean(rows: np.ndarray, step: np.float32) -> np.ndarray:
    """Returns the means of 2 x 2 pixels of two rows of planes."""
    total = (rows[:, 0, ::2] + rows[:, 0, 1::2]) + (rows[:, 1, ::2] + rows[:, 1, 1::2])
    return snapped_to(total * QUARTER, step)


def _put_row(
    halved: Sequence[np.ndarray], keep: Array, marks: Array, at: tuple[int, int], means: Means, out: Lowered
) -> None:
    """Writes a row of what rule U reads: the means of values before and after, of A, and what is marked."""
    (values, corner), (row, left) = means, at
    columns = slice(left, left + halved[0].shape[1])
    for n, mean in enumerate(halved):
        values[n, :, row - corner[0], columns.start - corner[1] : columns.stop - corner[1]] = mean
    out[0][row, columns] = _mean(keep[None], FINE_STEP)[0]
    out[1][row, columns] = (marks != 0).any(axis=0).reshape(-1, 2).any(axis=1)


def place_changed(values: Array, planes: Array, spans: Array, out: Array, top: int, left: int) -> None:
    """Does what the kernel of that name in `lifting` does."""
    height, width = values.shape[1:]
    inside = within(spans, width)
    for c, source in enumerate(planes.tolist()):
        part = out[c, top : top + height, left : left + width]
        part[inside] = values[source][inside] if source >= 0 else _ZERO
