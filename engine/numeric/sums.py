"""Sums in an order of our own: the same bits on every processor, with every version of every library.

NumPy's hang on how it goes through an array, which differs between its versions, and those of `einsum` and of BLAS on
how wide the processor's registers are.  Here a row is summed in eight parts, of every eighth value, in float64.
"""

from __future__ import annotations

import math

import numpy as np

from engine.numeric.kernel import kernel

Axes = int | tuple[int, ...] | None


def total(values: np.ndarray, axis: Axes = None, dtype: object = None, keepdims: bool = False) -> np.ndarray:
    """Returns the sum along some axes, or of all: worked out in float64, as wide as `values` is unless `dtype` says."""
    axes = _axes(values, axis)
    kept = [n for n in range(values.ndim) if n not in axes]
    rows = values.transpose(*kept, *axes).reshape(math.prod(values.shape[n] for n in kept), _count(values, axes))
    out = np.empty(len(rows))
    _sums(np.ascontiguousarray(rows), out)
    shape = [1 if n in axes else size for n, size in enumerate(values.shape) if keepdims or n not in axes]
    return out.reshape(shape).astype(dtype or values.dtype)  # type: ignore[call-overload, no-any-return]


def mean(values: np.ndarray, axis: Axes = None, dtype: object = None, keepdims: bool = False) -> np.ndarray:
    """Returns the mean along some axes, or of all, as `total`."""
    out = total(values, axis, np.float64, keepdims) / _count(values, _axes(values, axis))
    return out.astype(dtype or values.dtype)  # type: ignore[call-overload, no-any-return]


def _axes(values: np.ndarray, axis: Axes) -> tuple[int, ...]:
    given = range(values.ndim) if axis is None else (axis,) if isinstance(axis, int) else axis
    return tuple(n % values.ndim for n in given)


def _count(values: np.ndarray, axes: tuple[int, ...]) -> int:
    return math.prod(values.shape[n] for n in axes)


@kernel
def _sums(rows: np.ndarray, out: np.ndarray) -> None:
    """out (n,) = the sum of each of rows (n, m), all in float64."""
    even = rows.shape[1] // 8 * 8
    parts = np.empty(8)
    for n in range(rows.shape[0]):
        row = rows[n]
        parts[:] = 0.0
        for i in range(0, even, 8):
            for k in range(8):
                parts[k] += np.float64(row[i + k])
        for i in range(even, row.size):
            parts[i - even] += np.float64(row[i])
        out[n] = ((parts[0] + parts[4]) + (parts[2] + parts[6])) + ((parts[1] + parts[5]) + (parts[3] + parts[7]))
