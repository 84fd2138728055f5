"""Eigenvectors of small symmetric matrices, by rotations in a fixed order (Jacobi 1846): the same bits on every
processor."""

from __future__ import annotations

import numpy as np

from engine.numeric.kernel import kernel

_SWEEPS = 30  # at most: each squares what is left beside the diagonal
_NOTHING = 1e-14  # of the largest eigenvalue: one that is not told from none


def eigenvectors(matrix: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Returns the eigenvalues of a symmetric matrix (n, n), the largest first, and the vectors as columns: float64."""
    values, vectors = _rotated(np.array(matrix, np.float64))
    order = np.argsort(-values, kind="stable")
    return values[order], vectors[:, order]


def pseudo_inverse(columns: np.ndarray) -> np.ndarray:
    """Returns the pseudo-inverse (r, c) of a few columns (c, r): float64."""
    given = columns.astype(np.float64)
    values, vectors = eigenvectors(product(np.ascontiguousarray(given.T), given))
    kept = values > _NOTHING * values.max(initial=0.0)
    lengths = np.where(kept, 1.0 / np.where(kept, values, 1.0), 0.0)
    return product(product(vectors * lengths, np.ascontiguousarray(vectors.T)), np.ascontiguousarray(given.T))


@kernel
def product(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Returns the product of two matrices, summed in order."""
    out = np.zeros((a.shape[0], b.shape[1]))
    for i in range(a.shape[0]):
        for j in range(b.shape[1]):
            for k in range(a.shape[1]):
                out[i, j] += a[i, k] * b[k, j]
    return out


@kernel
def _rotated(a: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Returns the diagonal that is left of a matrix, which is written over, and the product of all rotations."""
    n = a.shape[0]
    vectors = np.eye(n)
    for _ in range(_SWEEPS):
        left = 0.0
        for p in range(n):
            for q in range(p + 1, n):
                left += abs(a[p, q])
        if left == 0.0:
            break
        for p in range(n):
            for q in range(p + 1, n):
                if abs(a[p, q]) <= 1e-300:
                    a[p, q] = a[q, p] = 0.0
                    continue
                theta = (a[q, q] - a[p, p]) / (2.0 * a[p, q])
                t = 1.0 / (abs(theta) + np.sqrt(theta * theta + 1.0))
                t = -t if theta < 0.0 else t
                c = 1.0 / np.sqrt(t * t + 1.0)
                s = t * c
                for k in range(n):
                    x, y = a[k, p], a[k, q]
                    a[k, p], a[k, q] = c * x - s * y, s * x + c * y
                for k in range(n):
                    x, y = a[p, k], a[q, k]
                    a[p, k], a[q, k] = c * x - s * y, s * x + c * y
                    x, y = vectors[k, p], vectors[k, q]
                    vectors[k, p], vectors[k, q] = c * x - s * y, s * x + c * y
                a[p, q] = a[q, p] = 0.0
    return np.diag(a).copy(), vectors
