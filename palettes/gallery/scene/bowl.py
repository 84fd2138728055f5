"""A bowl of rusty iron, with plums in it."""

from __future__ import annotations

import math

from scene.easel import Easel, Point
from scene.forms import Turned, inset
from scene.fruit import PLUMS, plum
from scene.shading import EVEN, fill, glow, line, shade, spray

_FORM = Turned((408, 396), ((20, 0), (24, 2), (42, 14), (58, 34), (63, 50), (64, 54)))
_RIM = (408, 342, 64, 11)  # middle, half width, half height


def bowl(easel: Easel) -> None:
    easel.layer("Bowl, inside")
    fill(easel, _ring(0, 345, 24), 2.4, ("#21160f", "#4a2c1a"))
    _rim(easel, 180, 360)
    for number, (place, size) in enumerate(PLUMS):
        plum(easel, place, size, number + 1)
    easel.layer("Bowl")
    front = [*_ring(180, 0, 17)]
    front += [_FORM.at(1, h) for h in range(48, -1, -6)] + [_FORM.at(-1, h) for h in range(0, 49, 6)]
    shell = [*_rows(2.2), *inset(front, 2.2)]
    line(easel, shell, 2.6, ("#4a3a34", "#6e5a50"), hardness=0.97, **EVEN)
    easel.lock("Bowl")
    easel.touch("Rust", shell, 2, radius=6, periods={"Rust": 90}, density=None, opacity=0.92, **EVEN)
    for across, radius, colour, part in (
        *((1.0, 34, "#352a44", 0.95), (0.6, 34, "#6c5a60", 0.7), (-1.05, 12, "#5a4a4a", 0.7)),
    ):
        shade(easel, _FORM.along(across, 0, 1), radius, colour, part, 0.1)
    shade(easel, [(376, 396), (408, 399), (442, 396)], 18, "#40303a", 0.9, 0.08)
    glow(easel, _FORM.along(-0.5, 0.3, 0.95), 18, "#7a5432", 0.8, 0.07)
    easel.layer("Bowl, rim")
    _rim(easel, 0, 180)
    spray(easel, _ring(120, 175, 7), 1.6, "#ffdca8", 0.8, 2)


def _ring(start: float, end: float, count: int) -> list[Point]:
    x, y, a, b = _RIM
    turns = (math.radians(start + (end - start) * k / (count - 1)) for k in range(count))
    return [(x + a * math.cos(t), y + b * math.sin(t)) for t in turns]


def _rim(easel: Easel, start: float, end: float) -> None:
    iron = {"colour": "#5d3220", "tints": {"Plaster wall": "#d08a52"}, "periods": {"Plaster wall": 30}}
    easel.touch("Rough plaster", _ring(start, end, 17), 2, radius=1.5, grain=None, hardness=0.9, **iron, **EVEN)


def _rows(radius: float) -> list[Point]:
    """Rows that fill the front of the bowl, bent as its rim is."""
    path: list[Point] = []
    for k in range(18):
        height = 2 + 48 * k / 17
        bend = 10 * (height / 54) ** 1.5
        half = _FORM.at(1, height)[0] - _FORM.foot[0] - radius
        parts = (-1, -0.7, 0, 0.7, 1) if k % 2 == 0 else (1, 0.7, 0, -0.7, -1)
        x, y = _FORM.foot[0], _FORM.foot[1] - height
        path.extend((x + half * t, y + bend * math.sqrt(1 - t * t)) for t in parts)
    return path
