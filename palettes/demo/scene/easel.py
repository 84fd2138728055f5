"""The easel: strokes of a scene, in the scene's own units, become commands of a recording.

A scene is 1280 x 800 units.  Its unit is a pixel of the easel's level, and its corner lies at the easel's origin, so
the same scene can be painted again, small, inside itself.  A stroke is painted `fine` levels below the easel's: its
edges stay crisp down to there.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import Any

from scene.noise import value

Point = tuple[float, ...]  # x, y and perhaps pressure

WIDTH, HEIGHT = 1280, 800
SKETCHED = (7, 21)  # seeds of the textures that the small scene keeps: rock and leaves

ROUND = {"dynamics": {"radius": [[0, 0.25], [1, 1]]}}
FIRM = {"hardness": 0.95, "dynamics": {}}
SOFT = {"hardness": 0, "spacing": 0.2, "flow": 0.2, "dynamics": {"radius": [[0, 0.4], [1, 1]]}}
HAIR = {"hardness": 0.7, "dynamics": {"radius": [[0, 0.15], [1, 1]]}}
_LIFTS = {"opacity": [[0, 0], [0.02, 1]]}


@dataclass
class Easel:
    """`only`: the layer that everything goes to; None: the layers that the scene names."""

    level: int = 0
    origin: tuple[int, int] = (0, 0)
    only: str | None = None
    lines: list[dict[str, Any]] = field(default_factory=list)
    _active: str | None = None

    def within(self, fine: int, corner: Point, layer: str) -> Easel:
        """An easel for the whole scene in small: its unit a pixel `fine` levels below, on one layer, same recording."""
        x, y = (round(math.ldexp(o + c, fine)) for o, c in zip(self.origin, corner, strict=True))
        return Easel(self.level + fine, (x, y), layer, self.lines, layer)

    @property
    def sketch(self) -> bool:
        """Whether the scene is the small one inside itself: painted with fewer and broader strokes."""
        return self.only is not None

    def layer(self, name: str, **settings: Any) -> None:
        """A new layer on top, for the scene at full size only."""
        if self.only is None:
            self._active = name
            self.lines.append({"do": "layer", "add": name})
            if settings:
                self.lines.append({"do": "layer", "set": name, **settings})

    def stroke(
        self,
        layer: str,
        fine: int,
        points: Sequence[Point],
        radius: float,
        colour: str,
        brush: dict[str, Any] = ROUND,
        ink: Iterable[dict[str, Any]] = (),
        **more: Any,
    ) -> None:
        """`points`, `radius` and the ink's periods in units of the scene."""
        scale = 2**fine
        if self.sketch:  # nothing beyond the picture's frame
            points = [(min(max(p[0], -40), WIDTH + 40), min(max(p[1], -40), HEIGHT + 40), *p[2:]) for p in points]
        corner = [math.floor((o + p) * scale) for o, p in zip(self.origin, points[0], strict=False)]
        digits = 1 if radius * scale < 3.5 else None
        placed = []
        for point in points:
            x, y = (round((o + p) * scale - c, digits) for o, p, c in zip(self.origin, point, corner, strict=False))
            placed.append([x, y, _short(point[2], digits or 1)] if len(point) > 2 and point[2] < 0.98 else [x, y])
        layer = self.only or layer
        made = {"radius": round(radius * scale, 2), "colour": colour, **brush, **more}
        kept = [part for part in ink if not self.sketch or part.get("seed") in SKETCHED]
        textures = [{**part, "period": round(part["period"] * scale, 2)} for part in kept]
        if textures:
            made["ink"] = textures
        line = {"do": "stroke", "level": self.level + fine, "origin": corner, "brush": made, "points": placed}
        if layer != self._active:
            line["layer"] = layer
        self.lines.append(line)

    def touches(
        self,
        layer: str,
        fine: int,
        paths: Sequence[Sequence[Point]],
        radius: float,
        colour: str,
        brush: dict[str, Any] = ROUND,
        ink: Iterable[dict[str, Any]] = (),
        **more: Any,
    ) -> None:
        """Many touches of one colour as one stroke: between them the pen is lifted, its pressure 0."""
        line: list[Point] = []
        for path in _near(paths):
            first, last = (_faint(path, end) for end in (0, -1))
            line += [(*path[0][:2], 0), *path[first : len(path) - last], (*path[-1][:2], 0)]
        dynamics = {**brush["dynamics"], **more.pop("dynamics", {}), **_LIFTS}
        if line:
            self.stroke(layer, fine, line, radius, colour, {**brush, "dynamics": dynamics}, ink, **more)


def _short(number: float, digits: int) -> float:
    """Rounded, and an integer if it is 0."""
    return round(number, digits) or 0


def _faint(path: Sequence[Point], end: int) -> bool:
    """Whether the pressure at an end of a touch is so low that it may as well be 0."""
    return len(path[end]) > 2 and path[end][2] <= 0.4 * max((*point, 1.0)[2] for point in path)


def _near(paths: Sequence[Sequence[Point]]) -> list[Sequence[Point]]:
    """The paths in an order of short ways: by bands, to and fro."""
    if len(paths) < 3:
        return list(paths)
    top, bottom = min(p[0][1] for p in paths), max(p[0][1] for p in paths)
    band = max(1e-9, (bottom - top) / max(1.0, math.sqrt(len(paths) / 2)))
    rows: dict[int, list[Sequence[Point]]] = {}
    for path in paths:
        rows.setdefault(int((path[0][1] - top) / band), []).append(path)
    out: list[Sequence[Point]] = []
    for k in sorted(rows):
        out += sorted(rows[k], key=lambda path: path[0][0], reverse=bool(k % 2))
    return out


def rock(colour: str, amount: float, period: float, roughness: float = 0.35, seed: int = 1) -> dict[str, Any]:
    return {
        "texture": "rock",
        "amount": amount,
        "colour": colour,
        "period": period,
        "roughness": roughness,
        "seed": seed,
    }


def wave(texture: str, colour: str, amount: float, period: float, angle: float = 0.0) -> dict[str, Any]:
    """Stripes, sawtooth or squares."""
    return {"texture": texture, "amount": amount, "colour": colour, "period": period, "angle": angle}


def hand(points: Sequence[Point], step: float, wobble: float = 0.0, seed: int = 0, taper: float = 0.0) -> list[Point]:
    """A line as a hand draws it: a Catmull-Rom curve through the points, every `step` units, trembling by `wobble`
    units, its pressure falling off over the fraction `taper` at both ends."""
    ends = [points[0], *points, points[-1]]
    path: list[Point] = []
    for a, b, c, d in zip(ends, ends[1:], ends[2:], ends[3:], strict=False):
        count = max(1, math.ceil(math.dist(b[:2], c[:2]) / step))
        for k in range(count):
            path.append(_between(a, b, c, d, k / count))
    path.append((*points[-1][:2], points[-1][2] if len(points[-1]) > 2 else 1.0))
    out = []
    for k, (x, y, p) in enumerate(path):
        at = k / max(1, len(path) - 1)
        press = p * min(1.0, min(at, 1 - at) / taper) if taper else p
        dx, dy = value(seed, 0.37 * k, 0.5), value(seed, 0.37 * k, 7.5)
        out.append((x + wobble * dx, y + wobble * dy, max(0.02, press * (1 - 0.12 * abs(dx)))))
    return out


def _between(a: Point, b: Point, c: Point, d: Point, t: float) -> Point:
    x, y = (
        0.5 * (2 * q + (r - p) * t + (2 * p - 5 * q + 4 * r - s) * t * t + (3 * q - p - 3 * r + s) * t**3)
        for p, q, r, s in zip(a[:2], b[:2], c[:2], d[:2], strict=True)
    )
    low, high = (b[2] if len(b) > 2 else 1.0), (c[2] if len(c) > 2 else 1.0)
    return x, y, low + (high - low) * t


def hatch(corners: Sequence[Point], radius: float, gap: float = 1.5) -> list[Point]:
    """One line that fills a convex polygon to its edges with a firm brush: its outline, drawn in by the radius, then
    to and fro in rows."""
    inner = _inset(corners, radius)
    path = [*inner, inner[0]]
    top, bottom = min(y for _, y in inner), max(y for _, y in inner)
    rows = max(1, math.ceil((bottom - top) / (gap * radius)))
    for k in range(rows + 1):
        y = top + (bottom - top) * k / rows
        across = sorted(_crossings(inner, y))
        if across:
            line = [(across[0], y), (across[-1], y)]
            path.extend(line if k % 2 else line[::-1])
    return path


def _inset(corners: Sequence[Point], by: float) -> list[Point]:
    """A convex polygon with its sides moved inwards; clipped to its middle where it is too thin."""
    n = len(corners)
    area = sum(corners[i - 1][0] * corners[i][1] - corners[i][0] * corners[i - 1][1] for i in range(n))
    turn = 1.0 if area > 0 else -1.0
    mid = tuple(sum(c[k] for c in corners) / n for k in (0, 1))
    out = []
    for i in range(n):
        p, q, r = corners[i - 1], corners[i], corners[(i + 1) % n]
        (ax, ay), (bx, by_) = _normal(p, q, turn), _normal(q, r, turn)
        scale = by / max(0.3, 1 + ax * bx + ay * by_)
        x, y = q[0] + (ax + bx) * scale, q[1] + (ay + by_) * scale
        over = (x - mid[0]) * (q[0] - mid[0]) + (y - mid[1]) * (q[1] - mid[1]) < 0
        out.append(mid if over else (x, y))
    return out


def _normal(p: Point, q: Point, turn: float) -> tuple[float, float]:
    dx, dy = q[0] - p[0], q[1] - p[1]
    length = math.hypot(dx, dy) or 1.0
    return -dy / length * turn, dx / length * turn


def _crossings(corners: Sequence[Point], y: float) -> list[float]:
    found = []
    for (ax, ay), (bx, by) in zip(corners, [*corners[1:], corners[0]], strict=True):
        if min(ay, by) <= y <= max(ay, by):
            found.extend([ax, bx] if ay == by else [ax + (bx - ax) * (y - ay) / (by - ay)])
    return found
