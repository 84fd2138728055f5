"""The values that lie in some columns of each row of planes, one after another."""

from __future__ import annotations

import numpy as np

from engine.canvas.rising.spans import within
from engine.numeric.kernel import Array, uncounted
from engine.numeric.stand_in import or_plain


def _gathered_plainly(data: np.ndarray, top: int, spans: np.ndarray, out: np.ndarray) -> None:
    """As `gather`, plainly."""
    out[:] = data[:, top : top + len(spans)][:, within(spans, data.shape[2])].reshape(-1)


def _scattered_plainly(values: np.ndarray, spans: np.ndarray, out: np.ndarray, top: int) -> None:
    """As `scatter`, plainly."""
    out[:, top : top + len(spans)][:, within(spans, out.shape[2])] = values.reshape(len(out), -1)


def _picked_plainly(data: np.ndarray, top: int, told: np.ndarray, by: int, spans: np.ndarray, out: np.ndarray) -> int:
    """As `pick`, plainly."""
    clipped = np.clip(told.astype(np.int32) + np.int32(by), 0, data.shape[2])
    clipped[clipped[:, 0] >= clipped[:, 1]] = 0
    count = len(data) * int((clipped[:, 1] - clipped[:, 0]).sum())
    if count > len(out):
        return -1
    spans[:] = clipped
    _gathered_plainly(data, top, clipped, out[:count])
    return count


@or_plain(_picked_plainly)
@uncounted
def pick(data: Array, top: int, told: Array, by: int, spans: Array, out: Array) -> int:
    """As `gather`, of what of columns `told`, uint8 (k, 2), lies in the rows when they are moved `by` to the right:
    these become `spans`, uint8 (k, 2), 0, 0 where there are none.  Returns how many values that are; -1 where `out`
    has no room for them."""
    count, width = 0, data.shape[2]
    for y in range(told.shape[0]):
        first, last = max(int(told[y, 0]) + by, 0), min(int(told[y, 1]) + by, width)
        if first >= last:
            first = last = 0
        spans[y, 0], spans[y, 1] = first, last
        count += (last - first) * data.shape[0]
    if count > out.size:
        return -1
    n = 0
    for c in range(data.shape[0]):
        for y in range(told.shape[0]):
            size = int(spans[y, 1]) - int(spans[y, 0])
            row, o = data[c, top + y][spans[y, 0] : spans[y, 1]], out[n : n + size]
            for i in range(size):
                o[i] = row[i]
            n += size
    return count


@or_plain(_gathered_plainly)
@uncounted
def gather(data: Array, top: int, spans: Array, out: Array) -> None:
    """out (n,) = what lies of `data` (C, h, w), integers, in the columns that `spans`, int32 (k, 2), tells of its rows
    from `top` on: plane after plane, row after row."""
    n = 0
    for c in range(data.shape[0]):
        for y in range(spans.shape[0]):
            first, last = spans[y, 0], spans[y, 1]
            if first < last:
                row, o = data[c, top + y][first:last], out[n : n + last - first]
                for i in range(o.size):
                    o[i] = row[i]
                n += last - first


@or_plain(_scattered_plainly)
@uncounted
def scatter(values: Array, spans: Array, out: Array, top: int) -> None:
    """Puts the values (n,) that `gather` gives back into their places of `out` (C, h, w)."""
    n = 0
    for c in range(out.shape[0]):
        for y in range(spans.shape[0]):
            first, last = spans[y, 0], spans[y, 1]
            if first < last:
                row, v = out[c, top + y][first:last], values[n : n + last - first]
                for i in range(v.size):
                    row[i] = v[i]
                n += last - first
