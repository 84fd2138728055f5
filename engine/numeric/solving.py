"""Small systems of equations and the nearest rotation of a matrix, in float64, in a fixed order: the same bits on every
processor."""

from __future__ import annotations

import numpy as np

from engine.numeric.kernel import Array, kernel

_SWEEPS = 40  # of rotations, at most
_ORTHOGONAL = 1e-15  # of two columns' lengths: a product that is none


def solved(matrices: np.ndarray, right: np.ndarray) -> np.ndarray:
    """Returns x so that matrices (..., n, n) times x are `right` (..., n, m), by elimination with the largest pivots:
    float64.  A matrix that has no inverse gives what does not grow beyond all bounds."""
    a = np.array(matrices, np.float64, order="C").reshape(-1, *matrices.shape[-2:])
    b = np.array(right, np.float64, order="C").reshape(-1, *right.shape[-2:])
    for one, other in zip(a, b, strict=True):
        _solve(one, other)
    return b.reshape(right.shape)


def nearest_rotation(matrix: np.ndarray) -> np.ndarray:
    """Returns the rotation (or reflection) that is nearest to a matrix (n, n), found by turning its columns until they
    stand upright on one another (Hestenes 1958): float64."""
    turned, turns = np.array(matrix.T, np.float64, order="C"), np.eye(len(matrix))
    _make_upright(turned, turns)
    return _joined(turned, turns)


@kernel
def _solve(a: Array, b: Array) -> None:
    """b = the solution of a x = b; `a` is written over."""
    n = a.shape[0]
    for k in range(n):
        best = k
        for i in range(k + 1, n):
            if abs(a[i, k]) > abs(a[best, k]):
                best = i
        if best != k:
            for j in range(n):
                a[k, j], a[best, j] = a[best, j], a[k, j]
            for j in range(b.shape[1]):
                b[k, j], b[best, j] = b[best, j], b[k, j]
        if abs(a[k, k]) < 1e-300:
            a[k, k] = 1e-300
        for i in range(k + 1, n):
            factor = a[i, k] / a[k, k]
            if factor != 0.0:
                for j in range(k + 1, n):
                    a[i, j] -= factor * a[k, j]
                for j in range(b.shape[1]):
                    b[i, j] -= factor * b[k, j]
    for k in range(n - 1, -1, -1):
        for j in range(b.shape[1]):
            total = b[k, j]
            for i in range(k + 1, n):
                total -= a[k, i] * b[i, j]
            b[k, j] = total / a[k, k]


@kernel
def _make_upright(rows: Array, turns: Array) -> None:
    """Turns pairs of rows until all are orthogonal; `turns` gets what turned them."""
    n = rows.shape[0]
    for _ in range(_SWEEPS):
        done = True
        for p in range(n):
            for q in range(p + 1, n):
                a, b, both = 0.0, 0.0, 0.0
                for k in range(rows.shape[1]):
                    a += rows[p, k] * rows[p, k]
                    b += rows[q, k] * rows[q, k]
                    both += rows[p, k] * rows[q, k]
                if abs(both) <= _ORTHOGONAL * np.sqrt(a * b) or abs(both) < 1e-300:
                    continue
                done = False
                slope = (b - a) / (2.0 * both)
                t = 1.0 / (abs(slope) + np.sqrt(slope * slope + 1.0))
                t = -t if slope < 0.0 else t
                c = 1.0 / np.sqrt(t * t + 1.0)
                s = t * c
                for k in range(rows.shape[1]):
                    x, y = rows[p, k], rows[q, k]
                    rows[p, k], rows[q, k] = c * x - s * y, s * x + c * y
                for k in range(n):
                    x, y = turns[p, k], turns[q, k]
                    turns[p, k], turns[q, k] = c * x - s * y, s * x + c * y
        if done:
            return


@kernel
def _joined(rows: Array, turns: Array) -> Array:
    """Returns the sum over k of the direction of row k times turns[k]; a row of nothing has none and is left out."""
    n = rows.shape[0]
    out = np.zeros((n, n))
    for k in range(n):
        size = 0.0
        for i in range(n):
            size += rows[k, i] * rows[k, i]
        if size > 1e-300:
            scale = 1.0 / np.sqrt(size)
            for i in range(n):
                for j in range(n):
                    out[i, j] += rows[k, i] * scale * turns[k, j]
    return out
