"""The evening sky: a gradient warmest low on the left, where the sun is, and clouds lit from there."""

from __future__ import annotations

import math

from scene.colour import mix, ramp
from scene.easel import FIRM, SOFT, Easel, hand, rock
from scene.noise import dice, fractal

_COOL = [(0, "#2f5f8f"), (120, "#5286ab"), (230, "#86adc0"), (330, "#b9cbc8"), (420, "#dcd6c4"), (520, "#e6d3b8")]
_WARM = [(0, "#4a78a0"), (110, "#8fa9b4"), (210, "#d6c8b0"), (300, "#f6d6a2"), (390, "#ffcf8e"), (520, "#ffc27f")]
_VEIL = rock("#fff4e0", 0.16, 420, 0.75, seed=11)


def colour(x: float, y: float) -> str:
    """Of the clear sky at a place; the lake asks for it too."""
    return mix(ramp(_WARM, y), ramp(_COOL, y), min(max((x - 60) / 900, 0), 1) ** 0.8)


def paint(easel: Easel) -> None:
    easel.layer("Sky")
    for y in range(-10, 560, 80):
        easel.stroke("Sky", 0, [(-10, y), (1290, y)], 110, colour(500, y), FIRM, [_VEIL], hardness=0.3)
    for y in range(-10, 540, 78):
        for x in range(-60, 1300, 330):
            line = hand([(x, y), (x + 165, y + 4), (x + 330, y)], 82, 3, x + y)
            easel.stroke("Sky", 0, line, 110, colour(x + 165, y), SOFT, [_VEIL], opacity=0.8)
    _cirrus(easel)
    for name, x, y, width, height in _CUMULUS[: 3 if easel.sketch else None]:
        _cumulus(easel, name, x, y, width, height)


def _cirrus(easel: Easel) -> None:
    easel.layer("Clouds", opacity=0.94)
    chance = dice("cirrus")
    for k in range(4 if easel.sketch else 9):
        strands = []
        for _ in range(3):
            x, y = chance.uniform(-60, 1200), 10 + 170 * chance.random() ** 1.2
            length = chance.uniform(140, 380)
            for _ in range(5):
                dx, dy, part = chance.gauss(0, 22), chance.gauss(0, 7), chance.uniform(0.4, 1)
                line = [(x + dx, y + dy), (x + dx + 0.4 * part * length, y + dy - 0.1 * part * length)]
                strands.append(hand([*line, (x + dx + part * length, y + dy - 0.15 * part * length)], 26, 5, k, 0.5))
        lit = mix("#ffe9c8", "#e8ecea", k / 9)
        size = chance.uniform(4, 9)
        easel.touches("Clouds", 0, strands, size, lit, SOFT, flow=0.09, opacity=chance.uniform(0.12, 0.32))


_CUMULUS = (
    ("far bank", 1010, 322, 420, 60),
    ("right tower", 1150, 262, 310, 120),
    ("left bank", 130, 318, 330, 70),
    ("middle", 655, 228, 230, 54),
    ("small", 300, 120, 170, 30),
)


def _cumulus(easel: Easel, name: str, x: float, y: float, width: float, height: float) -> None:
    """Heaps of puffs on a flat base: first all in shade, then lit from the left and above, the rims last."""
    chance = dice(name)
    puffs = []
    for _ in range(int(width / (8 if easel.sketch else 5.2))):
        across = max(-1, min(1, chance.gauss(0, 0.4)))
        crown = height * (1 - across * across) * (0.55 + 0.45 * fractal(5, across * 2.2 + x, y))
        puffs.append((x + across * width / 2, y - crown * chance.random() ** 0.8, 0.1 * height + 0.17 * crown))
    puffs.sort(key=lambda puff: puff[1])
    warm = min(max(1 - x / 1200, 0), 1)
    shade, body = mix("#8f9bb5", "#b99aa2", warm), mix("#c3c8d0", "#e6c6b2", warm)
    lit, rim = mix("#f3e4cf", "#ffe0b4", warm), mix("#fff8ea", "#fff3d8", warm)
    fluff = [rock("#ffffff", 0.22, 64, 0.3, seed=12)]
    passes = ((shade, 0.0, 1.3, 0.5), (body, 0.15, 1.0, 0.5), (lit, 0.4, 0.7, 0.5), (rim, 0.62, 0.4, 0.55))
    largest = max(r for *_, r in puffs)
    for tone, shift, size, opacity in passes:
        for k in range(2):
            chosen = [p for p in puffs[k::2] if tone == shade or p[1] < y - 0.1 * height]
            paths = [_puff(px - shift * r, py - shift * r, r, r / largest) for px, py, r in chosen]
            easel.touches("Clouds", 0, paths, size * largest, tone, SOFT, fluff, opacity=opacity, **_BILLOW)
    base = [(x + width * (0.47 * math.cos(math.pi * k / 6)), y + 3 * math.sin(2.1 * k)) for k in range(7)]
    for k in range(2):
        line = hand([(px, py + 5 * k) for px, py in base], 20, 4, k, 0.4)
        easel.stroke("Clouds", 0, line, 10 - 2 * k, mix(shade, colour(x, y), 0.35), SOFT, opacity=0.4)


_BILLOW: dict = {"flow": 0.5, "hardness": 0.3, "dynamics": {"radius": [[0, 0], [1, 1]]}}


def _puff(x: float, y: float, r: float, press: float) -> list[tuple[float, ...]]:
    return [(x - 0.25 * r, y, press), (x + 0.25 * r, y, 0.9 * press)]
