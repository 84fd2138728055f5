"""The light in which objects are shown: one large lamp, a weak one opposite, and a bright room.

Each lamp is many directions; for each the objects are drawn once as it sees them, and a point is in its light where
nothing is nearer to it.  So shadows are soft, and what is near to a wall or in a fold is dark.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from engine.solids.depth import draw_triangles, let_through
from engine.solids.mesh import unit

_SIDE = 512  # pixels of what a light sees
KEY = unit(np.array((-0.55, -0.62, 0.78)))  # towards the lamp
FILL = unit(np.array((0.85, -0.30, 0.45)))
_KEY_COLOUR, _FILL_COLOUR = np.array((1.0, 0.93, 0.82)) * 1.95, np.array((0.62, 0.76, 1.0)) * 0.28
_SKY_COLOUR = np.array((0.80, 0.90, 1.0)) * 0.95
_FLOOR = np.array((0.42, 0.38, 0.34))  # what the ground sends back
_KEYS, _FILLS, _SKIES = 28, 6, 44
_WIDE = 0.16  # the lamp's half width, as a tangent


class Ray(NamedTuple):
    """A direction to a light, and its colour."""

    towards: np.ndarray
    colour: np.ndarray


def rays() -> list[Ray]:
    """Returns all directions, evenly spread by the golden angle."""
    out = []
    for middle, colour, count, wide in ((KEY, _KEY_COLOUR, _KEYS, _WIDE), (FILL, _FILL_COLOUR, _FILLS, 0.3)):
        across, down = axes(middle)
        for x, y in _disc(count):
            out.append(Ray(unit(middle + wide * (x * across + y * down)), colour / count))
    for x, y in _disc(_SKIES):
        # Places even on a disc, lifted to the half ball, are as dense as the cosine: each has the same share.
        towards = np.array((x, y, np.sqrt(max(1.0 - x * x - y * y, 0.0))))
        warm = 1.0 + 0.15 * np.array((1.0, 0.0, -1.0)) * float(towards @ KEY)
        out.append(Ray(towards, _SKY_COLOUR * warm / (_SKIES * max(float(towards[2]), 0.15))))
    return out


def _disc(count: int) -> list[tuple[float, float]]:
    turns = np.arange(count) * 2.399963229728653
    far = np.sqrt((np.arange(count) + 0.5) / count)
    return list(zip(far * np.cos(turns), far * np.sin(turns), strict=True))


def axes(towards: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Returns two directions across one, and across one another."""
    up = np.array((0.0, 0.0, 1.0)) if abs(towards[2]) < 0.9 else np.array((0.0, 1.0, 0.0))
    across = unit(np.cross(up, towards))
    return across, np.cross(towards, across)


@dataclass(frozen=True, slots=True, eq=False)
class Lights:
    """All lights as they see a scene: `views` and `maps` of `depth.let_through`."""

    views: np.ndarray
    maps: np.ndarray

    def at(self, points: np.ndarray, normals: np.ndarray) -> np.ndarray:
        """Returns the light that reaches points with normals: float64 (N, 3)."""
        out = np.zeros((len(points), 3))
        let_through(points, normals, self.views, self.maps, out)
        # The ground and the room send light back to what looks down.
        out += _FLOOR * (0.5 - 0.5 * normals[:, 2:]) ** 1.5 * 0.55
        return out


def lights_on(points: np.ndarray, faces: np.ndarray) -> Lights:
    """Returns how all lights see the triangles of a scene."""
    directions = rays()
    radius = float(np.sqrt((points * points).sum(axis=1)).max(initial=1.0)) * 1.02
    scale = _SIDE / (2.0 * radius)
    views = np.empty((len(directions), 15))
    maps = np.full((len(directions), _SIDE, _SIDE), -np.inf, np.float32)
    names = np.empty((_SIDE, _SIDE), np.int32)
    for n, ray in enumerate(directions):
        across, down = axes(ray.towards)
        views[n] = (*across, *down, *ray.towards, -radius, scale, *ray.colour, 3.0 / scale)
        seen = np.stack([(points @ across + radius) * scale, (points @ down + radius) * scale, points @ ray.towards], 1)
        draw_triangles(seen, faces, 0, maps[n], names, 0)
    return Lights(views, maps)
