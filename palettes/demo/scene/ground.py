"""The lie of the land: its lines and its perspective, shared by lake, fields and town."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from scene.easel import Point
from scene.noise import fractal

FAR_SHORE = 500.0
SHORE: Sequence[Point] = (
    (560, 497), (660, 506), (770, 513), (880, 524), (950, 543), (990, 570), (985, 605), (930, 640), (850, 668),
    (740, 695), (620, 722), (500, 752), (380, 800), (340, 830),
)  # fmt: skip
HILL: Sequence[Point] = (
    (555, 500), (640, 482), (720, 462), (800, 442), (880, 428), (960, 414), (1040, 402), (1130, 386), (1220, 372),
    (1310, 364),
)  # fmt: skip


def along(line: Sequence[Point], x: float) -> float:
    """y of a line that runs from left to right."""
    (ax, ay), (bx, by) = next(((a, b) for a, b in pairwise(line) if x <= b[0]), (line[-2], line[-1]))
    return ay + (by - ay) * min(max((x - ax) / (bx - ax), 0), 1)


def hilltop(x: float) -> float:
    return along(HILL, x) + 2.5 * fractal(61, x / 60)


def front(x: float) -> float:
    """Where the hill's fields end: at the shore, and beyond it in the meadow."""
    return along(SHORE[:6], x) if x < 985 else 566 + 0.12 * (x - 985)


def dry(x: float, y: float) -> bool:
    """Whether a place below the hilltop is on the right bank."""
    line = [*SHORE]
    inside = False
    ring = [*line, (1400, 830), (1400, 300), (560, 300)]
    for (ax, ay), (bx, by) in zip(ring, [*ring[1:], ring[0]], strict=True):
        if (ay > y) != (by > y) and x < ax + (bx - ax) * (y - ay) / (by - ay):
            inside = not inside
    return inside


def on_hill(u: float, v: float) -> Point:
    """The place on the hill of x = u at the top, v = 0, as lines run towards us to the front, v = 1."""
    x = 900 + (u - 900) * (1 + 0.55 * v) + 30 * v
    top = hilltop(x)
    return x, top + (front(x) - top) * v**1.25
