"""The evening sun through a window: panes of light on the wall, dappled by leaves, and warmth over everything."""

from __future__ import annotations

import math

from scene.easel import Easel, Point
from scene.forms import inset
from scene.shading import EVEN, spray

_PANES: tuple[tuple[Point, ...], ...] = (
    ((38, 96), (104, 82), (128, 190), (62, 206)),
    ((116, 79), (176, 66), (200, 172), (140, 187)),
    ((66, 220), (131, 204), (152, 300), (88, 318)),
    ((144, 200), (203, 186), (222, 280), (164, 296)),
)


def _slanting(pane: tuple[Point, ...], radius: float) -> list[Point]:
    """Rows that fill a pane, parallel to its upper and lower edge."""
    (ax, ay), (bx, by), (cx, cy), (dx, dy) = inset(pane, radius)[:4]
    count = round(math.dist((ax, ay), (dx, dy)) / radius)
    path: list[Point] = []
    for t in (k / count for k in range(count + 1)):
        row = [(ax + (dx - ax) * t, ay + (dy - ay) * t), (bx + (cx - bx) * t, by + (cy - by) * t)]
        path.extend(row if len(path) % 4 else row[::-1])
    return path


def on_wall(easel: Easel) -> None:
    for pane in _PANES:
        sun = {"radius": 6, "spacing": 0.2, **EVEN}
        field = _slanting(pane, 5)
        easel.touch("Dappled light", field, colour="#c8924a", hardness=0.75, opacity=0.8, ink=None, **sun)
        leaves = {"colour": "#8a6a3a", "periods": {"Leaves": 120}}
        easel.touch("Dappled light", field, hardness=0.6, opacity=0.5, **leaves, **sun)


def over_all(easel: Easel) -> None:
    easel.layer("Sun", blend="soft-light", opacity=0.6)
    spray(easel, [(20, 40), (140, 170), (250, 330)], 190, "#ffcf8a", 0.8, 0, flow=0.2)
    spray(easel, [(500, 60), (520, 260), (480, 520)], 170, "#2c2a4c", 0.7, 0, flow=0.2)
