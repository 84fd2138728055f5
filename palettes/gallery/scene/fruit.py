"""Pears with freckled skin, and plums with their bloom."""

from __future__ import annotations

import math
from typing import NamedTuple

from scene.easel import Easel, Point
from scene.forms import Turned, curve, rows, tapered
from scene.shading import EVEN, fill, glow, line, shade, spray

_PROFILE = (
    *((0, 0), (0.17, 0.0), (0.33, 0.07), (0.415, 0.22), (0.39, 0.4), (0.29, 0.56), (0.205, 0.7), (0.165, 0.83)),
    *((0.12, 0.93), (0.05, 0.985), (0, 0.99)),
)
_FRECKLES = {"texture": "Drops", "period": 4.2, "shaping": [[0, 0], [0.68, 0], [0.8, 1], [1, 1]]}


class Pear(NamedTuple):
    """`lean` in degrees; `lit`: where across it the light falls, -1..1."""

    name: str
    foot: Point
    tall: float
    lean: float
    skin: str
    light: str
    blush: str
    lit: float

    @property
    def form(self) -> Turned:
        return Turned(self.foot, tuple((w * self.tall, h * self.tall) for w, h in _PROFILE), self.lean)


PEARS = (
    Pear("Standing pear", (302, 408), 118, 4, "#a8922c", "#dcc75a", "#a8301f", -0.42),
    Pear("Leaning pear", (98, 428), 104, -11, "#8d9636", "#cfcf6a", "#b0522a", -0.35),
    Pear("Lying pear", (346, 404), 102, 79, "#b08c2c", "#e6c95c", "#a02a20", -0.45),
)
PLUMS = (  # in the bowl: place, radius
    *(((372, 330), 19.5), ((438, 331), 19.5), ((404, 334), 19.5)),
    *(((388, 343), 17.5), ((424, 343), 17.5)),
)


def pear(easel: Easel, which: Pear) -> None:
    easel.layer(which.name)
    form, tall = which.form, which.tall
    fill(easel, form.outline, 3.2, (which.skin, which.light), 70)
    easel.lock(which.name)
    _skin(easel, which, form)
    for across, radius, colour, part in (
        *((1.0, 0.3, "#4c3a66", 0.95), (0.75, 0.34, "#7a6070", 0.7), (-1.08, 0.12, "#6a6048", 0.7)),
    ):
        shade(easel, form.along(across, 0, 0.97), tall * radius, colour, part, 0.11)
    middle, low = form.at(0, tall * 0.22)[0], max(p[1] for p in form.outline) - 2
    shade(easel, [(middle + tall * k / 6, low) for k in range(-2, 4)], tall * 0.2, "#54383e", 0.9, 0.12)
    glow(easel, form.along(0.9, 0.14, 0.42), tall * 0.07, "#7a4c2c", 0.6, 0.06)
    easel.touch(
        "Ink spatter", rows(form.outline, 7), 2, radius=8, hardness=0.8, colour="#6a4420", opacity=0.5, **EVEN,
        density=_FRECKLES,
    )  # fmt: skip
    spray(easel, form.along(which.lit - 0.02, 0.24, 0.34, 4), tall * 0.08, "#fff6d8", 0.9, flow=0.12)
    spray(easel, form.along(which.lit + 0.1, 0.72, 0.82, 4), tall * 0.045, "#fff3cf", 0.6, flow=0.12)
    _stalk(easel, which, form)


def _skin(easel: Easel, which: Pear, form: Turned) -> None:
    """A blush on the side that grew in the sun, and the yellow where the light falls now."""
    easel.touch(
        "Wet in wet", form.along(0.5, 0.1, 0.62), radius=which.tall * 0.25, opacity=0.9, flow=0.16, hardness=0,
        colour=which.blush, tints={"Blooms": "#d98a3c"}, periods={"Blooms": 60},
    )  # fmt: skip
    easel.touch(
        "Soft pastel", form.along(which.lit, 0.1, 0.9), radius=which.tall * 0.2, opacity=0.8, flow=0.1, hardness=0,
        colour=which.light, tints={"Pastel bloom": "#f6eba0"}, periods={"Pastel bloom": 60},
    )  # fmt: skip


def _stalk(easel: Easel, which: Pear, form: Turned) -> None:
    easel.layer(f"{which.name}, stalk")
    bent = ((0, -0.96), (0.02, -1.06), (0.07, -1.16))
    way = curve([form.moved((x * which.tall, y * which.tall)) for x, y in bent], 4)
    spray(easel, way[:2], 5, "#3c2a18", 0.6, 2)
    thick = [(x, y, 0.65 + 0.35 * k / len(way)) for k, (x, y) in enumerate(way)]
    line(easel, thick, 2.0, ("#3a2616", "#9a7850"), 18)
    line(easel, [(x - 0.5, y - 0.5, 0.6) for x, y in way[2:]], 0.9, ("#a98658", "#c9ab7c"), 18, opacity=0.7)


def plum(easel: Easel, place: Point, size: float, number: int) -> None:
    name = f"Plum {number}"
    easel.layer(name)
    x, y = place
    turns = [k * math.tau / 40 for k in range(40)]
    tones = (("#2c1d3d", "#5a3a66"), ("#3a1f38", "#74405e"), ("#27203f", "#51487a"))
    fill(easel, [(x + size * math.cos(t), y + size * 0.96 * math.sin(t)) for t in turns], 3, tones[number % 3], 40)
    easel.lock(name)
    easel.touch(
        "Sanguine chalk", [(x - 8, y - 3), (x - 2, y - 10), (x + 5, y - 9)], 2, radius=12, colour="#8f8fb8",
        opacity=0.45, flow=0.15, hardness=0, tints={"Sanded board": "#b8bcd8"}, **EVEN,
        grain={"texture": "Sanded board", "period": 20, "amount": 0.6},
    )  # fmt: skip
    shade(easel, [(x + size, y - size), (x + size, y + size)], size, "#1c1228", 0.95, 0.07)
    spray(easel, [(x - 6, y - 8), (x - 5, y - 9)], 4, "#f0ecff", 0.8, 2, flow=0.15)
    groove = tapered(curve([(x + 3, y - size), (x + 7, y - 4), (x + 4, y + size)], 4), 0.2)
    spray(easel, groove, 1.6, "#150c1e", 0.6, 2)
