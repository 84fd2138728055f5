"""The teapot that Martin Newell drew at the University of Utah in 1975: 32 bicubic Bezier patches, public data.

Rim, body, lid and bottom are curves (radius, height) turned around the axis, four patches a round; handle and spout are
rows of control points of one half, (x, y, z), mirrored for the other.  Jim Blinn's bottom is with them, and the height
is that of 1975's picture, a little lower than the pot's.  The lid is widened from 1.3 to 1.4, so that it lies on the
rim without a gap.
"""

from __future__ import annotations

import numpy as np

_STEPS = 14  # along a patch
_BEND = 0.56  # how far along the tangent Newell's quarter circles have their control points
_REVOLVED = (
    ((1.4, 2.4), (1.3375, 2.53125), (1.4375, 2.53125), (1.5, 2.4)),
    ((1.5, 2.4), (1.75, 1.875), (2.0, 1.35), (2.0, 0.9)),
    ((2.0, 0.9), (2.0, 0.45), (1.5, 0.225), (1.5, 0.15)),
    ((0.0, 3.15), (0.8, 3.15), (0.0, 2.85), (0.2, 2.7)),
    ((0.2, 2.7), (0.4, 2.55), (1.4, 2.55), (1.4, 2.4)),
    ((1.5, 0.15), (1.5, 0.075), (1.425, 0.0), (0.0, 0.0)),
)
# Across each: a point in the plane of symmetry, how far the next two lie beside it, and the last; rows go along.
_Row = tuple[float, float, float, float, float]  # x, z of the first; half a width; x, z of the last
_HANDLE: tuple[_Row, ...] = (
    *((-1.6, 2.025, 0.3, -1.5, 2.25), (-2.3, 2.025, 0.3, -2.5, 2.25), (-2.7, 2.025, 0.3, -3.0, 2.25)),
    *((-2.7, 1.8, 0.3, -3.0, 1.8), (-2.7, 1.575, 0.3, -3.0, 1.35), (-2.5, 1.125, 0.3, -2.65, 0.9375)),
    (-2.0, 0.9, 0.3, -1.9, 0.6),
)
_SPOUT: tuple[_Row, ...] = (
    *((1.7, 1.425, 0.66, 1.7, 0.6), (2.6, 1.425, 0.66, 3.1, 0.825), (2.3, 2.1, 0.25, 2.4, 2.025)),
    *((2.7, 2.4, 0.25, 3.3, 2.4), (2.8, 2.475, 0.25, 3.525, 2.49375), (2.9, 2.475, 0.15, 3.45, 2.5125)),
    (2.8, 2.4, 0.15, 3.2, 2.4),
)


def grids() -> list[np.ndarray]:
    """Returns grids of points, one for each patch: float64 (rows, columns, 3), seen from outside."""
    return [_surface(patch) for patch in patches()]


def patches() -> list[np.ndarray]:
    """Returns the control points of the 32 patches: float64 (4, 4, 3) each."""
    out = [quarter for curve in _REVOLVED for quarter in _turned(np.array(curve))]
    for rows in (_HANDLE, _SPOUT):
        for half in (rows[:4], rows[3:]):
            one = np.array([_across(row) for row in half])
            out += [one, (one * (1.0, -1.0, 1.0))[:, ::-1]]
    return out


def _turned(curve: np.ndarray) -> list[np.ndarray]:
    """The four quarters of a surface of revolution, by a curve of four (radius, height)."""
    radius, height = curve[:, 0], curve[:, 1]
    # Control points of a quarter circle of radius 1, from the x axis to the y axis.
    across = np.array([(1.0, 0.0), (1.0, _BEND), (_BEND, 1.0), (0.0, 1.0)])
    out = []
    for quarter in range(4):
        x, y = across.T
        for _ in range(quarter):
            x, y = -y, x
        columns = [radius[:, None] * x, radius[:, None] * y, np.repeat(height[:, None], 4, axis=1)]
        out.append(np.stack(columns, axis=-1)[:, ::-1])
    return out


def _across(row: _Row) -> list[tuple[float, float, float]]:
    x, z, width, last_x, last_z = row
    return [(x, 0.0, z), (x, -width, z), (last_x, -width, last_z), (last_x, 0.0, last_z)]


def _surface(patch: np.ndarray) -> np.ndarray:
    """Points of a patch, `_STEPS` a side."""
    t = np.linspace(0.0, 1.0, _STEPS + 1)
    weights = np.stack([(1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t * t * (1 - t), t**3], axis=1)
    return np.stack([weights @ patch[..., axis] @ weights.T for axis in range(3)], axis=-1)
