"""Periodic pictures on another grid, by cubic convolution (Keys 1981, a = -1/2)."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np


def resampled(data: np.ndarray, size: tuple[int, int], rows: np.ndarray, columns: np.ndarray) -> np.ndarray:
    """Returns pixels `rows` x `columns` (any integers) of the periodic picture `data` (C, h, w) stretched to `size`
    (H, W).

    float32 (C, rows, columns).  Each pixel depends on its own place alone; where a side keeps its size, the picture
    is kept.  An axis that shrinks is filtered as wide as it shrinks.
    """
    return resampled_rows(
        lambda used: np.ascontiguousarray(data[:, used]), (data.shape[1], data.shape[2]), size, rows, columns
    )


def resampled_rows(
    read: Callable[[np.ndarray], np.ndarray],
    old: tuple[int, int],
    size: tuple[int, int],
    rows: np.ndarray,
    columns: np.ndarray,
) -> np.ndarray:
    """Returns the same of a picture of the size `old` (h, w), of which `read` gives rows, numbered in rising order:
    float32 (C, rows, w)."""
    source, weights = _taps(rows, size[0], old[0])
    used, inverse = np.unique(source, return_inverse=True)
    part = _summed(read(used), inverse.reshape(source.shape), weights, 1)
    return _summed(part, *_taps(columns, size[1], old[1]), 2)


def rows_at(data: np.ndarray, places: np.ndarray) -> np.ndarray:
    """Returns the rows of `data` (C, h, w) at `places`, real numbers in 0..h - 1, as they are and not filtered: float32
    (C, places, w)."""
    first = np.floor(places).astype(np.int64)
    offsets = np.arange(-1, 3)[:, None]
    weights = cubic(np.abs(places - first - offsets)).astype(np.float32)
    return _summed(data, np.clip(first + offsets, 0, data.shape[1] - 1), weights, 1)


def _taps(places: np.ndarray, size: int, old: int) -> tuple[np.ndarray, np.ndarray]:
    """Source indices and weights, (taps, places) each, of pixels `places` of an axis stretched from `old` to `size`."""
    if size == old:
        return (places % size)[None], np.ones((1, places.size), np.float32)
    scale = max(1.0, old / size)
    centre = (places % size + 0.5) * (old / size) - 0.5
    first = np.floor(centre).astype(np.int64)
    reach = int(np.ceil(2 * scale))
    offsets = np.arange(1 - reach, reach + 1)[:, None]
    weights = cubic(np.abs(centre - first - offsets) / scale)
    weights /= weights.sum(0)
    return (first + offsets) % old, weights.astype(np.float32)


def cubic(d: np.ndarray) -> np.ndarray:
    """Returns the weight of a pixel so far away, 0 or more, in pixels."""
    near = (1.5 * d - 2.5) * d * d + 1.0
    far = ((-0.5 * d + 2.5) * d - 4.0) * d + 2.0
    return np.where(d < 1.0, near, np.where(d < 2.0, far, 0.0))


def _summed(data: np.ndarray, source: np.ndarray, weights: np.ndarray, axis: int) -> np.ndarray:
    """Returns the weighted sum of the taps along `axis`, tap after tap: the same order for every pixel."""
    shape = [1, 1, 1]
    shape[axis] = weights.shape[1]
    out = np.take(data, source[0], axis) * weights[0].reshape(shape)
    for index, weight in zip(source[1:], weights[1:], strict=True):
        out += np.take(data, index, axis) * weight.reshape(shape)
    result: np.ndarray = out
    return result
