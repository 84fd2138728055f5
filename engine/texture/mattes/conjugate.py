"""Large sparse systems solved by conjugate gradients, scaled by their diagonals: nearly enough, and from a guess on."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy import sparse


class Until(NamedTuple):
    """Steps at most, and the part of the first error that may be left."""

    steps: int
    close: float


def descended(
    matrix: sparse.csr_matrix, diagonal: np.ndarray, target: np.ndarray, first: np.ndarray, until: Until
) -> np.ndarray:
    """Returns the solution of (matrix + diagonal) x = target, from `first` on; `matrix` (n, n), the others (n,)."""
    x = first
    residual = target - (matrix @ x + diagonal * x)
    along = residual / diagonal
    strength = _dot(residual, along)
    enough = max(until.close**2 * strength, 1e-12)
    for _ in range(until.steps):
        if strength <= enough:
            break
        moved = matrix @ along + diagonal * along
        step = strength / _dot(along, moved)
        x = x + step * along
        residual = residual - step * moved
        scaled = residual / diagonal
        strength, before = _dot(residual, scaled), strength
        along = scaled + (strength / before) * along
    return x


def _dot(a: np.ndarray, b: np.ndarray) -> float:
    """Not by the library of linear algebra, whose threads wait for one another."""
    return float(np.einsum("i,i->", a, b))
