"""The land: wooded shores, the hill with its fields and hedges, the path, the meadow."""

from __future__ import annotations

import math
from itertools import pairwise

from scene.colour import mix
from scene.easel import FIRM, HAIR, ROUND, SOFT, Easel, Point, hand, hatch, rock, wave
from scene.ground import FAR_SHORE, SHORE, along, dry, front, hilltop, on_hill
from scene.noise import dice, fractal, value

LEAVES = ("#2f4a3c", "#47663f", "#7d8a45", "#c7b25c")  # of foliage, from shade to sun
TOWN = (988.0, 456.0, 110.0, 52.0)  # middle and half axes of the ground that the town takes


def foliage(tone: str, light: float = 0.5) -> list[dict]:
    return [rock(mix(tone, "#ffe79a", light), 0.8, 5, 0.25, seed=21)]


def paint(easel: Easel) -> None:
    easel.layer("Land")
    _woods(easel, "far woods", 96, -40, 900, (392, 436), 458, ("#66808c", "#7d9290", "#a3a58c", "#d3bb8c"), 3.0)
    haze = [(x, 452 + 6 * fractal(68, x / 80)) for x in range(-40, 900, 60)]
    easel.stroke("Land", 0, haze, 20, "#e6dcc6", SOFT, opacity=0.55)
    _woods(easel, "near woods", 97, -40, 700, (440, 474), 500, ("#45635f", "#5d7860", "#8b8f58", "#cbb068"), 3.4)
    _shoreline(easel)
    _hill(easel)
    _fields(easel)
    _hedges(easel)
    _meadow(easel)


def _woods(
    easel: Easel, name: str, seed: int, left: float, right: float, heights: Point, foot: float, tones, size: float
) -> None:
    """A wooded ridge that sinks to the right: its mass first, then crowns lit from the left."""
    low, high = heights
    size *= 2.2 if easel.sketch else 1

    def top(x: float) -> float:
        t = (x - left) / (right - left)
        return low + (high - low) * t**1.5 + 12 * fractal(seed, x / 90) + 26 * max(0, t - 0.72) ** 1.0

    body: list[Point] = []
    x = left
    while x < right:
        body += [(x, max(top(x), 0) + 4), (x + 4, foot + 4), (x + 8, foot + 4)]
        x += 8
    easel.stroke("Land", 0, body, 6, tones[1], ROUND, foliage(tones[1], 0.2), dynamics={})
    chance = dice(name)
    for k, tone in enumerate((tones[0], tones[1], tones[2], tones[3])):
        paths = []
        x = left
        while x < right:
            y = top(x)
            while y < foot:
                px, py = x + chance.uniform(-3, 3), y + chance.uniform(-3, 3)
                glow = 0.5 + 0.9 * fractal(seed + 7, px / 70, py / 26, 3) - 0.012 * (py - top(px))
                if abs(3.2 * glow - k) < 0.8 or (y == top(x) and k == 1):
                    tall = size * chance.uniform(1.0, 2.0) * (1, 1, 0.8, 0.6)[k]
                    paths.append([(px, py - tall, 0.1), (px, py + 0.4 * tall, (1, 0.9, 0.7, 0.5)[k])])
                y += (3.6 if easel.sketch else 2.8) * size
            x += 2.0 * size
        easel.touches(
            "Land",
            0 if easel.sketch or name == "far woods" else 1,
            paths,
            size,
            tone,
            ROUND,
            foliage(tone),
            opacity=0.9,
        )


def _shoreline(easel: Easel) -> None:
    line = hand([(x, FAR_SHORE + 2 + 1.5 * fractal(66, x / 40)) for x in range(-20, 700, 40)], 14, 0.4)
    easel.stroke("Land", 2, line, 1.6, "#7f7357", ROUND)
    easel.stroke("Land", 2, [(x, y - 1.6, p) for x, y, p in line], 0.9, "#e8cb92", HAIR, opacity=0.8)


def _hill(easel: Easel) -> None:
    """The ground under everything on the right bank."""
    body: list[Point] = []
    for x in range(560, 1310, 9):
        body += [(x, hilltop(x) + 6), (x + 4, front(x)), (x + 9, front(x))]
    easel.stroke("Land", 1 - easel.sketch, body, 7, "#7f8f4c", ROUND, foliage("#7f8f4c", 0.4), dynamics={})
    lower = [(x, y) for x, y in SHORE[3:]]
    sweep: list[Point] = []
    for k, y in enumerate(range(548, 815, 9)):
        x = next(
            (
                ax + (bx - ax) * (y - ay) / (by - ay)
                for (ax, ay), (bx, by) in pairwise(lower)
                if min(ay, by) <= y <= max(ay, by)
            ),
            360,
        )
        row = [(x + 8 + 2 * value(5, y / 9), y), (1300, y)]
        sweep += row if k % 2 else row[::-1]
    easel.stroke("Land", 1 - easel.sketch, sweep, 8, "#66783c", ROUND, foliage("#66783c", 0.35), dynamics={})


_CROPS = (
    ("#d6b65a", "#f3d98a"), ("#8a9a48", "#b9bd62"), ("#a5794a", "#cf9f66"), ("#b7a750", "#e0cf7c"),
    ("#6e8a46", "#98a955"), ("#e0c26c", "#f8e3a0"), ("#94653f", "#c08a58"), ("#a3ad55", "#cfd07c"),
)  # fmt: skip


def _fields(easel: Easel) -> None:
    chance = dice("fields")
    rows = (0.04, 0.2, 0.4, 0.66, 0.98)
    crop = 0
    for k, (v0, v1) in enumerate(pairwise(rows)):
        u = 640.0 + 30 * k
        while u < 1260:
            width = chance.uniform(55, 105)
            skew = chance.uniform(-10, 10)
            corners = [on_hill(u, v0), on_hill(u + width, v0), on_hill(u + width + skew, v1), on_hill(u + skew, v1)]
            crop += chance.choice((1, 2, 3))
            middle = [sum(c[i] for c in corners) / 4 for i in (0, 1)]
            if _taken(*middle) > 0.8 and corners[0][0] < 1300:
                _field(easel, corners, _CROPS[crop % len(_CROPS)], chance.choice((0, 1)), 1.8 if v1 < 0.5 else 2.6)
            u += width + 2


def _taken(x: float, y: float) -> float:
    """Below 1 on the town's ground."""
    return ((x - TOWN[0]) / TOWN[2]) ** 2 + ((y - TOWN[1]) / TOWN[3]) ** 2


def _field(easel: Easel, corners: list[Point], crop: tuple[str, str], down: int, period: float) -> None:
    """Furrows along one pair of its sides; the upper edge catches the sun."""
    a, b, _, d = corners
    end = d if down else b
    angle = math.degrees(math.atan2(end[1] - a[1], end[0] - a[0])) + 90
    furrows = wave("stripes", crop[1], 0.75, period, round(angle % 180 / 30) * 30 + 4)
    soil = foliage_of(crop)
    near = abs(corners[0][0] - 960) < 80
    easel.stroke("Land", 1 + (near and not easel.sketch), hatch(corners, 2.2, 1.2), 2.2, crop[0], FIRM, [furrows, soil])


def foliage_of(crop: tuple[str, str]) -> dict:
    return rock(mix(crop[0], "#3e3a22", 0.5), 0.5, 5, 0.25, seed=21)


def _hedges(easel: Easel) -> None:
    """Bushes and trees along the hill, in its folds and at the shore, each with its shade and its sun."""
    chance = dice("hedges")
    bushes: list[tuple[float, float, float]] = []
    for v in (0.02, 0.2, 0.4, 0.66, 0.97):
        u = 600.0
        while u < 1290:
            x, y = on_hill(u, v)
            if (dry(x, y + 1) or y < 520) and value(31, u / 45, v * 9) > -0.25 and _taken(x, y) > 1:
                bushes.append((x, y, (1.5 + 1.9 * v) * chance.uniform(0.6, 1.5)))
            u += chance.uniform(3, 9)
    for _ in range(46):
        x, y = on_hill(chance.uniform(640, 1270), chance.random())
        if _taken(x, y) > 1.02 and dry(x, y):
            bushes.append((x, y, chance.uniform(3, 5.5)))
    for x, y in [p[:2] for p in hand(SHORE[:6], 7)]:
        if _taken(x, y) > 1.0 and chance.random() < 0.7:
            bushes.append((x, y - 1.5, chance.uniform(1.8, 4.2)))
    stands: dict[int, list[tuple[float, float, float]]] = {}
    for bush in sorted(bushes, key=lambda bush: bush[1]):
        stands.setdefault(int((bush[0] > 850) + (bush[0] > 1170)), []).append(bush)
    for k, stand in stands.items():
        clump(easel, "Land", stand, f"hedge {k}", fine=2 if k == 1 else 1)


def clump(
    easel: Easel, layer: str, bushes: list[tuple[float, float, float]], name: str, fine: int = 2, plain: bool = False
) -> None:
    """Bushes at (x, y of the foot, radius): long shadows to the right, then crowns from shade to sun."""
    largest = max(r for *_, r in bushes)
    shadows = [[(x, y, 0.8 * r / largest), (x + 3.2 * r, y + 0.7 * r, 0.0)] for x, y, r in bushes]
    press = {"radius": [[0, 0], [1, 1]]}
    easel.touches(layer, max(fine - 2, 0), shadows, largest, "#33433c", SOFT, opacity=0.45, flow=0.5, dynamics=press)
    chance = dice(name)
    for k, tone in enumerate(LEAVES[1:] if easel.sketch else LEAVES):
        paths = []
        for x, y, r in bushes:
            for _ in range((1, 1, 1, 1)[k] if easel.sketch else (2, 3, 3, 2)[k]):
                dx, dy = chance.gauss(0, 0.45) * r, chance.gauss(0, 0.4) * r
                size = r * (0.75, 0.55, 0.36, 0.22)[k] * chance.uniform(0.7, 1.2) / largest
                px, py = x + dx - (0, 0.15, 0.4, 0.55)[k] * r, y - r + dy - (0, 0.1, 0.35, 0.6)[k] * r
                paths.append([(px, py, min(1, size)), (px + 0.35 * r, py + 0.12 * r, 0.0)])
        easel.touches(
            layer,
            min(fine, 1) if easel.sketch else fine,
            paths,
            largest,
            tone,
            ROUND,
            [] if plain else foliage(tone),
            dynamics=press,
        )


def _meadow(easel: Easel) -> None:
    """Grass in strokes that grow towards us, a path that leads to the town, flowers."""
    _grass(easel, 560, 700, (8, 2.0), ("#566a36", "#74833e", "#98984a", "#c2ad5a"), 620)
    path = [
        (1003, 492),
        (1010, 516),
        (1026, 548),
        (1068, 590),
        (1092, 628),
        (1066, 672),
        (1050, 716),
        (1092, 768),
        (1160, 830),
    ]
    for k, (tone, size, shift) in enumerate((("#a98a5c", 1.0, 0), ("#d9b983", 0.8, -1), ("#efd6a4", 0.4, -4))):
        line = hand(
            [(x + shift * (y - 500) / 200, y, (0.12 + 0.88 * (max(0, y - 505) / 300) ** 1.3)) for x, y in path],
            9,
            1.0,
            k,
        )
        easel.stroke(
            "Land",
            1,
            line,
            24 * size,
            tone,
            ROUND,
            [rock("#7d6444", 0.5, 5, 0.25, seed=21)],
            dynamics={"radius": [[0, 0.02], [1, 1]]},
            opacity=0.9,
        )
    _grass(easel, 690, 815, (15, 2.8), ("#2f452c", "#465c33", "#6d7a3c", "#a8974b"), 540)


def _grass(easel: Easel, top: float, foot: float, size: Point, tones, count: int) -> None:
    """Blades in drifts of sun and shade; each shorter and paler with distance."""
    chance = dice(f"grass {top}")
    if easel.sketch:
        count, size = count // 4, (size[0], 1.9 * size[1])
    drifts: list[list[list[Point]]] = [[] for _ in tones]
    for _ in range(count):
        x, y = chance.uniform(380, 1290), top + (foot - top) * chance.random()
        near = (y - 540) / 260
        if not dry(x - 14, y + 2) or abs(x - along_path(y)) < 5 + 24 * max(0, near):
            continue
        sun = 1.6 + 2.4 * fractal(71, x / 190, y / 42, 3) + chance.gauss(0, 0.35)
        tall = size[0] * (0.45 + near) * chance.uniform(0.6, 1.3)
        lean = chance.gauss(0.3, 0.2) * tall
        blade = [(x, y, 0.9), (x + 0.4 * lean, y - 0.6 * tall, 0.6), (x + lean, y - tall, 0.0)]
        drifts[min(max(round(sun), 0), len(tones) - 1)].append(blade)
    for tone, blades in zip(tones, drifts, strict=True):
        easel.touches("Land", 1 - easel.sketch, blades, size[1], tone, ROUND, foliage(tone, 0.4), opacity=0.85)


def along_path(y: float) -> float:
    line = ((520, 1010), (548, 1026), (590, 1068), (628, 1092), (672, 1066), (716, 1050), (768, 1092), (830, 1160))
    return along(line, y)
