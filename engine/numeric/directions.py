"""Directions that are spread evenly, and how pictures lie on planes across them."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

_GOLDEN = math.pi * (1.0 + math.sqrt(5.0))
_STEEP = 0.8  # of the first axis in a normal: planes that lie flatter take their rows from the second one


def frames(count: int, turned: Sequence[float] | np.ndarray = (0.0, 0.0, 0.0)) -> np.ndarray:
    """`count` normals, evenly over half a sphere that three numbers in 0..1 turn at random, and the directions of rows
    and columns on planes across them: float64 (count, 3, 3), each orthonormal, axes (z, y, x).

    Rows follow z, on planes that lie flat y, as they do on slices across the axes (Gonzalez 2010, "Measurement of areas
    on a sphere using Fibonacci lattices"; Shoemake 1992, "Uniform random rotations").
    """
    part = (np.arange(count) + 0.5) / count
    around, out = _GOLDEN * np.arange(count), np.sqrt(1.0 - part * part)
    normals = np.stack([part, out * np.sin(around), out * np.cos(around)], axis=1) @ _rotation(*turned)
    return np.stack([frame(normal) for normal in normals])


def frame(normal: np.ndarray) -> np.ndarray:
    """Returns a unit vector and the directions of rows and columns on planes across it: float64 (3, 3)."""
    down = np.eye(3)[int(abs(normal[0]) > _STEEP)]
    down = down - normal * (normal @ down)
    down /= math.hypot(*down)
    across = np.cross(normal, down)
    across *= np.sign(across[np.abs(across).argmax()])
    return np.array([normal, down, across])


def _rotation(a: float, b: float, c: float) -> np.ndarray:
    """Returns the matrix of a quaternion that three numbers, evenly in 0..1, make even over all."""
    x, y = math.sqrt(1.0 - a) * math.sin(2.0 * math.pi * b), math.sqrt(1.0 - a) * math.cos(2.0 * math.pi * b)
    z, w = math.sqrt(a) * math.sin(2.0 * math.pi * c), math.sqrt(a) * math.cos(2.0 * math.pi * c)
    return np.array(
        [
            [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - z * w), 2.0 * (x * z + y * w)],
            [2.0 * (x * y + z * w), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - x * w)],
            [2.0 * (x * z - y * w), 2.0 * (y * z + x * w), 1.0 - 2.0 * (x * x + y * y)],
        ]
    )
