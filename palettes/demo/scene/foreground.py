"""What frames the view: the bank at the left with its firs and reeds, flowers in the meadow, and the evening light."""

from __future__ import annotations

from scene.colour import mix
from scene.easel import HAIR, ROUND, SOFT, Easel, Point, hand
from scene.ground import along
from scene.land import along_path, foliage
from scene.noise import dice, fractal

BANK: list[Point] = [(-30, 688), (60, 700), (150, 724), (250, 764), (330, 812), (360, 840)]
_FIRS = ((158, 742, 408, 0.8), (14, 722, 300, 1.0), (84, 728, 206, 1.15))  # x, foot, top, breadth
_NEEDLES = ("#16262b", "#1f3833", "#2f4a39", "#6d6a3c")


def paint(easel: Easel) -> None:
    easel.layer("Foreground")
    for x, foot, top, breadth in _FIRS:
        _fir(easel, x, foot, top, breadth)
    if easel.sketch:
        return
    _bank(easel)
    _flowers(easel)


def _fir(easel: Easel, x: float, foot: float, top: float, breadth: float) -> None:
    """Boughs that droop, in tiers, darkest first; those to the left catch the sun."""
    easel.stroke("Foreground", 1, [(x, foot, 1.0), (x + 1, top, 0.1)], 6 * breadth, "#2b2428", ROUND)
    chance = dice(f"fir {x}")
    for k, tone in enumerate(_NEEDLES[:2] if easel.sketch else _NEEDLES):
        paths: list[list[Point]] = []
        y = top + 4
        while y < foot - 26:
            grown = (y - top) / (foot - top)
            reach = (2 + 74 * grown**1.15) * breadth * (1, 0.95, 0.8, 0.62)[k]
            for way in (-1, 1):
                if k == 3 and way > 0:
                    continue
                long = reach * chance.uniform(0.5, 1.15)
                drop = 3 + long * chance.uniform(0.25, 0.5)
                start = y + chance.uniform(-4, 4) - 2 * k
                paths.append(
                    [
                        (x, start, 0.3 + 0.3 * grown),
                        (x + 0.55 * way * long, start + 0.35 * drop, 0.35 + 0.65 * grown),
                        (x + way * long, start + drop, 0.1),
                    ]
                )
            y += (8 + 11 * grown) * (1, 1, 1.3, 1.6)[k] * (1.6 if easel.sketch else 1)
        size = (7.5, 6.0, 4.2, 2.6)[k] * breadth
        easel.touches("Foreground", 1 - easel.sketch, paths, size, tone, HAIR, foliage(tone, 0.35), hardness=0.85)


def _bank(easel: Easel) -> None:
    body: list[Point] = []
    for x in range(-20, 360, 10):
        body += [(x, along(BANK, x) + 8), (x + 5, 830), (x + 10, 830)]
    easel.stroke("Foreground", 1, body, 8, "#2b3a2c", ROUND, foliage("#2b3a2c", 0.3), dynamics={})
    chance = dice("bank")
    for k, tone in enumerate(("#1f3029", "#3a4c31", "#5f6b38", "#b59a54")):
        blades = []
        for _ in range(105 if k < 3 else 60):
            x = chance.uniform(-20, 345)
            y = along(BANK, x) + (3 + 80 * chance.random() ** 1.6 if k < 3 else 30 * chance.random() ** 2)
            tall = chance.uniform(14, 34) * (1.2 if k == 3 else 1)
            lean = chance.gauss(0.2, 0.22) * tall
            blades.append([(x, y + 6, 0.9), (x + 0.35 * lean, y - 0.55 * tall, 0.6), (x + lean, y - tall, 0.0)])
        easel.touches("Foreground", 1, blades, 2.6, tone, ROUND, foliage(tone, 0.35))
    reeds, heads = [], []
    for _ in range(34):
        x = chance.uniform(180, 372)
        y = along(BANK, x) + 12
        tall, lean = chance.uniform(36, 78), chance.gauss(3, 5)
        reeds.append([(x, y, 0.9), (x + 0.3 * lean, y - 0.5 * tall, 0.8), (x + lean, y - tall, 0.5)])
        heads.append([(x + lean, y - tall + 11), (x + 1.1 * lean, y - tall)])
    easel.touches("Foreground", 2, reeds, 1.0, "#6f6c3c", ROUND)
    easel.touches("Foreground", 2, heads[::2], 2.3, "#5a3c2c", ROUND, foliage("#5a3c2c", 0.25), dynamics={})


def _flowers(easel: Easel) -> None:
    chance = dice("flowers")
    for tone, count, size in (
        ("#f3e7c8", 150, 1.9),
        ("#d9563f", 110, 2.3),
        ("#e9b53f", 110, 1.9),
        ("#8d78b8", 80, 2.0),
    ):
        spots: list[list[Point]] = []
        for _ in range(count):
            x, near = chance.uniform(470, 1280), chance.random() ** 0.8
            y = 640 + 155 * near
            drift = fractal(91, x / 120, y / 40 + 7 * size, 2)
            if drift > 0.12 and y > 700 - 0.2 * (x - 560) and abs(x - along_path(y)) > 26:
                press = 0.35 + 0.65 * near
                spots.append([(x, y, press), (x + 0.8, y + 0.4, press)])
        easel.touches("Foreground", 2, spots, size, tone, ROUND, dynamics={"radius": [[0, 0], [1, 1]]})


def light(easel: Easel) -> None:
    """Warmth from the sun, low at the left, and the cool of the evening in the corners."""
    easel.layer("Light", blend="soft-light", opacity=0.75)
    for x, y, size, tone, opacity in (
        (40, 330, 420, "#ffb45c", 0.75), (260, 420, 360, "#ffc980", 0.5), (430, 250, 260, "#ffdca0", 0.45),
        (980, 440, 240, "#ffd79a", 0.5), (1290, 40, 420, "#3a5590", 0.5), (1260, 800, 330, "#2c3a5c", 0.55),
        (640, 20, 300, "#41659c", 0.35), (120, 820, 300, "#2c3352", 0.5), (700, 830, 300, "#34486c", 0.4),
    ):  # fmt: skip
        line = hand([(x - 60, y + 6), (x, y), (x + 60, y + 6)], 40)
        easel.stroke("Light", -2, line, size, tone, SOFT, opacity=opacity, flow=0.3)
    easel.layer("Sun", blend="screen")
    for size, tone, opacity in ((150, "#ff9a3c", 0.3), (70, "#ffc068", 0.4), (26, "#ffe2a0", 0.6)):
        easel.stroke("Sun", 0, [(166, 336), (167, 336)], size, tone, SOFT, opacity=opacity, flow=0.5)
    easel.stroke(
        "Sun", 2, [(166, 336), (166.5, 336)], 13, mix("#fff3d0", "#ffffff", 0.3), ROUND, hardness=0.85, dynamics={}
    )
