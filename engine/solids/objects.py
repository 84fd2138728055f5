"""Objects to show a solid on: each a closed mesh, 2 long, around 0, z upwards."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import lru_cache

import numpy as np

from engine.solids import bust, teapot
from engine.solids.mesh import Mesh, grid_mesh, meshed, together, unit, unit_sized

_ROUND = 2.0 * np.pi
_AROUND = 160  # points along a round
# Half of the outline of a vase, (radius, height), and then of its inside, as points of a smooth curve.
_VASE = (
    *((0.0, 0.0), (0.33, 0.0), (0.36, 0.03), (0.34, 0.09), (0.44, 0.27), (0.58, 0.55), (0.62, 0.8), (0.54, 1.08)),
    *((0.36, 1.3), (0.24, 1.46), (0.21, 1.62), (0.26, 1.8), (0.36, 1.93), (0.40, 1.965), (0.385, 1.985)),
    *((0.33, 1.93), (0.21, 1.78), (0.16, 1.62), (0.19, 1.47), (0.32, 1.27), (0.0, 1.2)),
)


def sphere() -> Mesh:
    """The ball of radius 1."""
    v, u = np.meshgrid(np.linspace(0.0, np.pi, _AROUND // 2 + 1), _circle(_AROUND), indexing="ij")
    return _closed(np.stack([np.sin(v) * np.cos(u), np.sin(v) * np.sin(u), -np.cos(v)], axis=-1))


def torus() -> Mesh:
    """A ring that lies, its tube half as thick as its hole is wide."""
    v, u = np.meshgrid(_circle(_AROUND // 2), _circle(_AROUND), indexing="ij")
    far = 0.66 - 0.34 * np.cos(v)
    return _closed(np.stack([far * np.cos(u), far * np.sin(u), -0.34 * np.sin(v)], axis=-1))


def cube() -> Mesh:
    """A cube with edges that are a little round."""
    t = np.linspace(-1.0, 1.0, 49)
    steps = np.sign(t) * (1.0 - (1.0 - np.abs(t)) ** 1.6)  # more of them where it is round
    y, x = np.meshgrid(steps, steps, indexing="ij")
    parts = []
    for axis in range(3):
        for side in (1.0, -1.0):
            face = np.empty((*x.shape, 3))
            face[..., axis], face[..., (axis + 1) % 3], face[..., (axis + 2) % 3] = side, side * x, y
            core = np.clip(face, -0.93, 0.93)
            parts.append(core + 0.07 * unit(face - core))
    return _closed(*parts)


def vase() -> Mesh:
    """A body of revolution, hollow at the top."""
    return _closed(_revolved(_VASE, 120))


def knot() -> Mesh:
    """A tube along a trefoil."""
    t = np.linspace(0.0, _ROUND, 321)
    path = np.stack([np.sin(t) + 2 * np.sin(2 * t), np.cos(t) - 2 * np.cos(2 * t), -1.25 * np.sin(3 * t)], axis=-1)
    along = unit(np.stack([np.cos(t) + 4 * np.cos(2 * t), -np.sin(t) + 4 * np.sin(2 * t), -3.75 * np.cos(3 * t)], -1))
    side = unit(np.cross(along, unit(path * (1.0, 1.0, 0.0))))
    other = np.cross(along, side)
    u = _circle(40)
    ring = np.cos(u)[:, None, None] * side + np.sin(u)[:, None, None] * other
    return _closed((path + 0.62 * ring)[::-1])


def _revolved(profile: Sequence[tuple[float, float]], steps: int) -> np.ndarray:
    """A smooth curve through points (radius, height), turned around the z axis: (steps + 1, around, 3)."""
    given = np.array(profile, float)
    at = np.linspace(0.0, len(given) - 1.0, steps + 1)
    here = np.clip(at.astype(int), 0, len(given) - 2)
    f = (at - here)[:, None]
    ends = np.concatenate([2 * given[:1] - given[1:2], given, 2 * given[-1:] - given[-2:-1]])
    a, b, c, d = (ends[here + step] for step in range(4))
    # Catmull & Rom's cubic through b and c, whose slopes are those of a to c and b to d.
    curve = b + 0.5 * f * (c - a + f * (2 * a - 5 * b + 4 * c - d + f * (3 * (b - c) + d - a)))
    radius, height = np.maximum(curve[:, :1], 0.0), curve[:, 1:]
    radius[[0, -1]] = 0.0
    u = _circle(_AROUND)[None]
    return np.stack([radius * np.cos(u), radius * np.sin(u), height + 0.0 * u], axis=-1)


def _circle(count: int) -> np.ndarray:
    out: np.ndarray = np.linspace(0.0, _ROUND, count + 1)
    return out


def _closed(*grids: np.ndarray) -> Mesh:
    """The mesh of grids, whose seams are closed, for points that are one are welded."""
    points, faces = together([grid_mesh(grid) for grid in grids])
    return meshed(unit_sized(points), faces)


OBJECTS: dict[str, Callable[[], Mesh]] = {
    "sphere": sphere,
    "cube": cube,
    "torus": torus,
    "vase": vase,
    "teapot": lambda: _closed(*teapot.grids()),
    "knot": knot,
    "bust": bust.carved,
}


@lru_cache(maxsize=len(OBJECTS))
def object_named(name: str) -> Mesh:
    """Returns the object of that name."""
    return OBJECTS[name]()
