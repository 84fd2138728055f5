"""Olive branches, their shadow on the wall, and two leaves that fell."""

from __future__ import annotations

import math

from scene.easel import Easel, Point
from scene.forms import curve, rows, tapered
from scene.jug import BODY
from scene.shading import THINNING, line, spray

_STEMS: tuple[tuple[Point, ...], ...] = (
    ((186, 177), (176, 140), (150, 92), (112, 60), (84, 52)),
    ((190, 177), (192, 130), (182, 76), (190, 30), (206, 8)),
    ((194, 177), (210, 136), (240, 96), (276, 72), (304, 70)),
    ((198, 177), (220, 152), (262, 136), (298, 142)),
    ((182, 177), (160, 152), (122, 132), (92, 138)),
)
_LEAVES = (("#39462f", "#5e6b48"), ("#5d6c45", "#8d9a68"), ("#8f9a78", "#c9cfae"))
_SHADOW = "#57465c"


def shadow(easel: Easel) -> None:
    """Of jug and branches, on the wall."""
    easel.layer("Shadow on the wall", blend="multiply", opacity=0.55)
    body = [(0.96 * x + 66, 0.96 * y + 26) for x, y in BODY.outline]
    spray(easel, rows(body, 7), 11, _SHADOW, 0.8, hardness=0.3, flow=0.5)
    for number, points in enumerate(_STEMS):
        stem = curve([(0.96 * x + 62, 0.96 * y + 26) for x, y in points], 6)
        spray(easel, stem, 2.4, _SHADOW, 0.8, flow=0.5)
        for k in range(5, len(stem), 2):
            way, long = _way(stem, k, k % 4 - 1 if k % 2 else 1, 0.6), 15 + (k * 5 + number) % 8
            x, y = stem[k]
            tip = (x + long * math.cos(way), y + long * math.sin(way) + 4)
            leaf = [(x, y, 0.2), ((x + tip[0]) / 2, (y + tip[1]) / 2, 1.0), (*tip, 0.2)]
            spray(easel, leaf, 5.5, _SHADOW, 0.8, flow=0.5, **THINNING)


def _way(stem: list[Point], k: int, side: int, turn: float) -> float:
    """The direction of a leaf at point k of a stem."""
    return math.atan2(stem[k][1] - stem[k - 1][1], stem[k][0] - stem[k - 1][0]) + side * turn


def branches(easel: Easel) -> None:
    easel.layer("Branches")
    for number, points in enumerate(_STEMS):
        stem = curve(points, 6)
        thin = [(x, y, 1 - 0.6 * k / len(stem)) for k, (x, y) in enumerate(stem)]
        bark = {"colour": "#2b221b", "tints": {"Bark": "#8b7d66"}, "periods": {"Bark": 40}, "edge": None}
        easel.touch("Old bark", thin, 2, radius=1.9, **bark)
        for tone in range(3):
            for k in range(7 + tone, len(stem), 3):
                _leaf(easel, stem, k, (k // 3 + number) % 2 * 2 - 1, tone)


def _leaf(easel: Easel, stem: list[Point], k: int, side: int, tone: int) -> None:
    x, y = stem[k]
    way = _way(stem, k, side, 0.5 + 0.25 * ((k * 7 + tone * 3) % 5) / 4)
    long = 19 + (k * 5 + tone * 4) % 9
    _blade(easel, (x, y), (x + long * math.cos(way), y + long * math.sin(way) + 4 + (k + tone) % 3), side, tone)


def _blade(easel: Easel, foot: Point, tip: Point, side: int, tone: int) -> None:
    (x, y), way = foot, math.atan2(tip[1] - foot[1], tip[0] - foot[0])
    mid = ((x + tip[0]) / 2 + 2 * side * math.sin(way), (y + tip[1]) / 2 - 2 * side * math.cos(way))
    line(easel, tapered(curve([foot, mid, tip], 3), 0.1), 4.3, _LEAVES[tone], 26)
    if tone == 2:
        vein = [foot, ((x + tip[0]) / 2 + side, (y + tip[1]) / 2), tip]
        easel.touch("Pencil", vein, 2, radius=0.4, colour="#5d6748", dynamics={}, opacity=0.7)


def fallen(easel: Easel) -> None:
    """On the table."""
    easel.layer("Fallen leaves")
    for (x, y), (tx, ty), tone in (((318, 437), (296, 443), 1), ((60, 444), (84, 447), 2)):
        under = tapered([(x + 1, y + 2.5), ((x + tx) / 2 + 1, (y + ty) / 2 + 4), (tx + 1, ty + 2)], 0.2)
        spray(easel, under, 4.5, "#1c100c", 0.7, 2, flow=0.4, **THINNING)
        _blade(easel, (x, y), (tx, ty), 1, tone)
