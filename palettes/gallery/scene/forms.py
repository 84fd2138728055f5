"""Lines and outlines: curves through points, rows that fill a form, forms turned on a lathe."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from scene.easel import Point


def curve(points: Sequence[Point], steps: int = 4) -> list[Point]:
    """A Catmull-Rom curve through points of any number of parts, `steps` to each span."""
    ends = [points[0], *points, points[-1]]
    out: list[Point] = []
    for a, b, c, d in zip(ends, ends[1:], ends[2:], ends[3:], strict=False):
        for k in range(steps):
            t = k / steps
            out.append(
                tuple(
                    0.5 * (2 * q + (r - p) * t + (2 * p - 5 * q + 4 * r - s) * t * t + (3 * q - p - 3 * r + s) * t**3)
                    for p, q, r, s in zip(a, b, c, d, strict=True)
                )
            )
    return [*out, tuple(points[-1])]


def tapered(points: Sequence[Point], ends: float = 0.15) -> list[Point]:
    """The same points with a pressure that rises from `ends` at the first and falls to it at the last."""
    n = max(1, len(points) - 1)
    return [(p[0], p[1], max(ends, math.sin(math.pi * k / n) ** 0.7)) for k, p in enumerate(points)]


def rows(outline: Sequence[Point], radius: float, gap: float = 1.3) -> list[Point]:
    """One line that fills a form with a brush of a radius, in horizontal rows that stay within it."""
    inner = inset(outline, radius)
    top, bottom = min(p[1] for p in inner) + 0.01, max(p[1] for p in inner) - 0.01
    count = max(1, math.ceil((bottom - top) / (gap * radius)))
    path: list[Point] = []
    for k in range(count + 1):
        y = top + (bottom - top) * k / count
        across = sorted(_crossings(inner, y))
        if len(across) >= 2:
            line = [(across[0], y), (across[-1], y)]
            path.extend(line if k % 2 else line[::-1])
    return path


def solid(outline: Sequence[Point], radius: float, fine: float = 1.2) -> list[Point]:
    """Rows that fill a form, a line round them, and one round the form, so light that it is `fine` on each side."""
    light = [(*p[:2], fine / radius) for p in inset(outline, fine)]
    return [*rows(outline, radius), *inset(outline, radius)[::2], *light]


def _crossings(outline: Sequence[Point], y: float) -> list[float]:
    found = []
    for (ax, ay), (bx, by) in zip(outline, [*outline[1:], outline[0]], strict=True):
        if (ay <= y) != (by <= y):
            found.append(ax + (bx - ax) * (y - ay) / (by - ay))
    return found


def inset(outline: Sequence[Point], by: float) -> list[Point]:
    """A closed outline, moved inwards."""
    n = len(outline)
    area = sum(outline[k - 1][0] * outline[k][1] - outline[k][0] * outline[k - 1][1] for k in range(n))
    side = by if area > 0 else -by
    out: list[Point] = []
    for k in range(n):
        (ax, ay), (bx, by_) = outline[k - 1], outline[(k + 1) % n]
        length = math.hypot(bx - ax, by_ - ay) or 1.0
        out.append((outline[k][0] - (by_ - ay) / length * side, outline[k][1] + (bx - ax) / length * side))
    return [*out, out[0]]


@dataclass(frozen=True)
class Turned:
    """A form turned on a lathe, standing at `foot` and leaning by `lean` degrees (clockwise).

    `profile`: (half width, height) from the foot to the top, in units; `squash`: by how much the right half is wider.
    """

    foot: Point
    profile: Sequence[Point]
    lean: float = 0.0
    squash: float = 1.0

    def at(self, across: float, height: float) -> Point:
        """The place `across` (-1..1 from the left edge to the right) at a height."""
        half = self._half(height) * across * (self.squash if across > 0 else 1.0)
        return self.moved((half, -height))

    def moved(self, local: Point) -> Point:
        turn = math.radians(self.lean)
        x, y = local
        return (
            self.foot[0] + x * math.cos(turn) - y * math.sin(turn),
            self.foot[1] + x * math.sin(turn) + y * math.cos(turn),
        )

    def _half(self, height: float) -> float:
        for (wa, ha), (wb, hb) in zip(self.smooth, self.smooth[1:], strict=False):
            if ha <= height <= hb:
                return wa + (wb - wa) * (height - ha) / max(hb - ha, 1e-9)
        return self.smooth[-1][0] if height > self.smooth[-1][1] else self.smooth[0][0]

    @property
    def smooth(self) -> list[Point]:
        return curve(self.profile, 3)

    @property
    def top(self) -> float:
        return self.profile[-1][1]

    @property
    def outline(self) -> list[Point]:
        side = curve(self.profile, 5)
        right = [self.moved((w * self.squash, -h)) for w, h in side]
        return right + [self.moved((-w, -h)) for w, h in reversed(side) if w > 0]

    def along(self, across: float, low: float = 0.0, high: float = 1.0, count: int = 9) -> list[Point]:
        """A line up the form, `across` its width, between two parts of its height."""
        return [self.at(across, self.top * (low + (high - low) * k / (count - 1))) for k in range(count)]
