"""The paint-box: touches of a brush become strokes that grow the bundled washes, in commands of a recording.

Places and radii are in pixels of the picture, from its upper left corner.  A touch is a list of (x, y, radius): the
pen's pressure is the radius, and between touches it is lifted, so that many of them make one stroke.
"""

from __future__ import annotations

import math
import random
from collections.abc import Sequence
from itertools import pairwise
from typing import Any

import numpy as np
from scipy import ndimage

Place = tuple[float, float, float]
Touch = list[Place]

_SCALLOP = 0.5
WIDTH, HEIGHT = 1200, 900
_SHAPE = ((-0.62, 0.0), (-0.3, 0.85), (0.15, 1.0), (0.66, 0.0))  # along a touch: place and radius, in parts


class Box:
    """Collects the commands; a wash is defined when it is first used."""

    def __init__(self, seed: int) -> None:
        self.lines: list[dict[str, Any]] = []
        self.chance = random.Random(seed)
        self._defined: set[str] = set()
        self._covered: dict[tuple[str, int, str], np.ndarray] = {}
        self._layer = ""

    def layer(self, name: str, opacity: float = 1.0) -> None:
        """A new layer on top, through which all that lies below it shows, as through a glaze."""
        self.lines.append({"do": "layer", "add": name})
        self.lines.append({"do": "layer", "set": name, "blend": "multiply", "opacity": opacity})
        self._layer = name

    def select(self, name: str) -> None:
        """Paint on a layer that is there."""
        self.lines.append({"do": "layer", "select": name})
        self._layer = name

    def wash(self, name: str, touches: Sequence[Touch], depth: int = 0, level: int = 0) -> None:
        """One stroke with a wash: at level 1 its example is half as large in the picture, at -1 twice as large."""
        if name not in self._defined:
            self._defined.add(name)
            self.lines.append({"do": "texture", "name": name, "maker": "example", "bundled": f"wash-{name}"})
        laid = self._stroke(touches, level, {"mode": "example", "example": name, "depth": depth})
        _cover(self._covered.setdefault((self._layer, depth, name), np.zeros((HEIGHT, WIDTH), bool)), laid)

    def covered(self, name: str, x: float, y: float, depth: int = 0) -> bool:
        """Whether a wash of the active layer lies there."""
        return bool(
            self._covered[self._layer, depth, name][min(max(int(y), 0), HEIGHT - 1), min(max(int(x), 0), WIDTH - 1)]
        )

    def lift(self, layers: Sequence[str], touches: Sequence[Touch], level: int = 0) -> None:
        """White paper again, as under masking fluid: the washes of those layers dry with a rim around it."""
        for name in layers:
            self.select(name)
            self._stroke(touches, level, {"mode": "erase"})

    def mend(self, name: str, depth: int = 0, gap: int = 2) -> None:
        """Close slits and pinholes in a wash, narrower than about twice `gap`, which water would run across."""
        seen = self._covered[self._layer, depth, name]
        y, x = np.ogrid[-gap : gap + 1, -gap : gap + 1]
        slits, count = ndimage.label(
            ndimage.binary_closing(seen, x * x + y * y <= gap * gap + 1) & ~seen, np.ones((3, 3))
        )
        touches = []
        for number, (rows, columns) in enumerate(ndimage.find_objects(slits), 1):
            corner = np.array([rows.start + 0.5, columns.start + 0.5])
            touches.append(_along(np.argwhere(slits[rows, columns] == number) + corner, gap + 0.4))
        if count:
            self.wash(name, touches, depth)

    def _stroke(self, touches: Sequence[Touch], level: int, how: dict[str, Any]) -> Touch:
        """The stroke, as it is written down with rounded places and pressures."""
        scale, top = 2.0**level, max(place[2] for touch in touches for place in touch)
        path = [place for touch in touches for place in (_lifted(touch) if len(touches) > 1 else touch)]
        left, above = (math.floor(v * scale) for v in path[0][:2])
        brush = how | {"radius": round(top * scale, 1), "hardness": 1, "dynamics": {"radius": "pressure"}}
        points = []
        for x, y, radius in path:
            digits = 1 if 0.0 < radius * scale < 4.0 else None
            pressure = round(radius / top, 2)
            points.append([round(x * scale - left, digits), round(y * scale - above, digits), pressure or 0])
        self.lines.append({"do": "stroke", "level": level, "origin": [left, above], "brush": brush, "points": points})
        return [((x + left) / scale, (y + above) / scale, p * brush["radius"] / scale) for x, y, p in points]

    def touch(self, x: float, y: float, radius: float, angle: float, long: float = 1.6, bend: float = 0.3) -> Touch:
        """The brush pressed down and lifted again, drawn `long` radii along an angle."""
        across, down, length = math.cos(angle), math.sin(angle), radius * long
        bend *= self.chance.uniform(-1.0, 1.0) * length
        made = []
        for along, part in _SHAPE:
            a, b = along * length, bend * (0.5 - 2.0 * along * along)
            size = radius * part * self.chance.uniform(0.85, 1.1)
            made.append((x + across * a - down * b, y + down * a + across * b, size))
        return made

    def within(self) -> tuple[float, float]:
        """A place in the disc of radius 1."""
        angle, far = self.chance.uniform(0.0, 2.0 * math.pi), math.sqrt(self.chance.random())
        return far * math.cos(angle), far * math.sin(angle)


def curve(points: Sequence[Place], steps: int = 4) -> Touch:
    """A Catmull-Rom curve through points, `steps` to each span."""
    ends = [points[0], *points, points[-1]]
    out: Touch = []
    for a, b, c, d in zip(ends, ends[1:], ends[2:], ends[3:], strict=False):
        for t in (k / steps for k in range(steps)):
            x, y, r = (
                0.5 * (2 * q + (v - p) * t + (2 * p - 5 * q + 4 * v - w) * t * t + (3 * q - p - 3 * v + w) * t**3)
                for p, q, v, w in zip(a, b, c, d, strict=True)
            )
            out.append((x, y, max(r, 0.0)))
    return [*out, points[-1]]


def _lifted(touch: Touch) -> Touch:
    """The touch with the pen lifted before and after it."""
    start, end = touch[0], touch[-1]
    return [*([(*start[:2], 0.0)] if start[2] else []), *touch, *([(*end[:2], 0.0)] if end[2] else [])]


def _cover(seen: np.ndarray, touch: Touch) -> None:
    """Mark the pixels that a stroke covers, but for what lies between its dabs at their rim."""
    for (ax, ay, ar), (bx, by, br) in pairwise(touch):
        count = max(1, math.ceil(2.0 * math.hypot(bx - ax, by - ay)))
        for t in (k / count for k in range(count + 1)):
            x, y, r = ax + (bx - ax) * t, ay + (by - ay) * t, ar + (br - ar) * t - _SCALLOP
            if r <= 0.0:
                continue
            left, above = max(0, math.floor(x - r)), max(0, math.floor(y - r))
            part = seen[above : max(0, math.ceil(y + r)), left : max(0, math.ceil(x + r))]
            down, across = np.ogrid[: part.shape[0], : part.shape[1]]
            part |= (across + left + 0.5 - x) ** 2 + (down + above + 0.5 - y) ** 2 <= r * r


def _along(places: np.ndarray, radius: float) -> Touch:
    """A way through places (k, 2) as y, x, so that none is further than `radius` from it."""
    kept: Touch = []
    for y, x in places[
        np.argsort(places[:, int(np.ptp(places[:, 1]) >= np.ptp(places[:, 0]))], kind="stable")
    ].tolist():
        if all(math.hypot(x - a, y - b) > radius for a, b, _ in kept):
            kept.append((x, y, radius))
    return kept if len(kept) > 1 else [*kept, (kept[0][0] + 0.5, kept[0][1], radius)]
