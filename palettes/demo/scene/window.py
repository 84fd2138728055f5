"""Where the painter's house, its studio window and the canvas behind it are."""

from __future__ import annotations

from scene.easel import HEIGHT, WIDTH, Point
from scene.town import STUDIO

X, FOOT = STUDIO
EAVES, PEAK = FOOT - 11.5, FOOT - 21.5
LEFT, RIGHT = X - 7, X + 7
CANVAS = (X + 0.2, FOOT - 14.1)  # corner of the painter's canvas: one unit of its scene is a pixel of level 11
DEEPER = 11
CANVAS_SIZE = (WIDTH / 2**DEEPER, HEIGHT / 2**DEEPER)
MIDDLE = (CANVAS[0] + CANVAS_SIZE[0] / 2, CANVAS[1] + CANVAS_SIZE[1] / 2)
WINDOW = (X - 2.0, FOOT - 15.15, X + 2.0, FOOT - 12.55)  # left, top, right, foot of the studio's window


def inside(x: float, y: float) -> tuple[float, float]:
    """Where a place of the scene lies on the painter's canvas."""
    return CANVAS[0] + x / 2**DEEPER, CANVAS[1] + y / 2**DEEPER


def box(left: float, top: float, right: float, foot: float) -> list[Point]:
    return [(left, top), (right, top), (right, foot), (left, foot)]
