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


def _clipped_plainly(spans: np.ndarray, by: int, width: int, out: np.ndarray) -> int:
    """As `clip`, plainly."""
    out[:] = np.clip(spans.astype(np.int32) + np.int32(by), 0, width)
    out[out[:, 0] >= out[:, 1]] = 0
    return int((out[:, 1] - out[:, 0]).sum())


@or_plain(_clipped_plainly)
@uncounted
def clip(spans: Array, by: int, width: int, out: Array) -> int:
    """out, int32 (h, 2), = what of columns `spans`, uint8 (h, 2), lies in 0..width when they are moved `by` to the
    right: 0, 0 where nothing does.  Returns how many columns that are."""
    count = 0
    for y in range(spans.shape[0]):
        first, last = max(int(spans[y, 0]) + by, 0), min(int(spans[y, 1]) + by, width)
        if first >= last:
            first = last = 0
        out[y, 0], out[y, 1] = first, last
        count += last - first
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
