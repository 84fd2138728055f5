"""The lake: sky and mountains mirrored in broken strokes, ripples, glitter, a boat."""

from __future__ import annotations

from scene import mountains, sky
from scene.colour import mix
from scene.easel import FIRM, HAIR, ROUND, SOFT, Easel, Point, hand, hatch, wave
from scene.ground import FAR_SHORE, dry
from scene.noise import dice, fractal

_RIPPLES = [wave("stripes", "#fff1d8", 0.1, 4.4, 88.2)]


def mirrored(x: float, y: float) -> str:
    """Colour of the water at a place: what stands above the far shore, cooler and darker towards us."""
    up = FAR_SHORE - 1.02 * (y - FAR_SHORE)
    main = mountains.MAIN
    if up > 448 + 52 * min(max((x - 380) / 280, 0), 1):
        seen = "#4d6a66"
    elif up > 408 + 70 * min(max((x - 330) / 470, 0), 1):
        seen = "#708a90"
    elif up > main.ridge(x) and main.crest[0][0] < x < main.crest[-1][0]:
        seen = mix(main.colour(x, up), "#41607c", 0.3)
    else:
        seen = mix(sky.colour(x, up - 20), "#5f8aa8", 0.16)
    return mix(seen, "#2a4a68", 0.62 * min(1, max(0, y - FAR_SHORE - 30) / 290))


def paint(easel: Easel) -> None:
    easel.layer("Lake")
    for y in range(int(FAR_SHORE) + 4, 812, 24):
        tone = _water(420, y)
        easel.stroke("Lake", 0, [(-20, y), (1040, y)], 19, tone, ROUND, _RIPPLES, hardness=0.4, dynamics={})
    for y in range(int(FAR_SHORE) + 16, 812, 48):
        for x in range(-100 + y % 7 * 30, 1000, 330):
            line = hand([(x, y), (x + 180, y + 1), (x + 380, y)], 60, 2, y + x, 0.3)
            easel.stroke("Lake", 0, line, 48, _water(x + 180, y), SOFT, _RIPPLES, opacity=0.9)
    easel.stroke("Lake", 0, [(-20, 504), (560, 504), (700, 512)], 7, "#6d7f80", SOFT, opacity=0.5)
    _masses(easel)
    _reflections(easel)
    _glitter(easel)
    _boat(easel, 610, 606)


def _water(x: float, y: float) -> str:
    """Colour of still water under the clear sky."""
    return mix(sky.colour(x, 2 * FAR_SHORE - y), "#2f5578", 0.14 + 0.6 * (y - FAR_SHORE) / 300)


def _masses(easel: Easel) -> None:
    """The mountains upside down, in long soft strokes, before the ripples break them."""
    heaps: dict[tuple[int, str], list[list[Point]]] = {}
    for x in range(110, 1000, 13):
        depth = (FAR_SHORE - mountains.MAIN.ridge(x)) / 1.02
        y = FAR_SHORE + 4
        while y < FAR_SHORE + depth - 12 and not dry(x, y + 20):
            heaps.setdefault((5, mirrored(x, y + 14)), []).append([(x, y), (x + 1, y + 30)])
            y += 26
    for (_, tone), paths in _merged(heaps).items():
        easel.touches("Lake", 0, paths, 11, tone, SOFT, opacity=0.5, flow=0.4)


def _reflections(easel: Easel) -> None:
    chance = dice("reflections")
    heaps: dict[tuple[int, str], list[list[Point]]] = {}
    y = FAR_SHORE + 2
    while y < 800:
        near = (y - FAR_SHORE) / 300
        x = -20 + 40 * chance.random()
        while x < 1000:
            length = (22 if easel.sketch else 9) + 30 * near
            length *= chance.uniform(0.6, 1.5)
            if not dry(x + length / 2, y) and not dry(x + length, y + 2):
                tone = mirrored(x + length / 2 + 14 * near * fractal(81, y / 7, x / 90), y)
                heaps.setdefault((6 if y < 600 else 8, tone), []).append(
                    [(x, y, 0.2), (x + length / 2, y + 0.8 * chance.gauss(0, 1), 1.0), (x + length, y, 0.2)]
                )
            x += length * chance.uniform(1.3, 3.2)
        y += (1.9 + 4.2 * near) * (2.2 if easel.sketch else 1)
    for (band, tone), paths in _merged(heaps).items():
        easel.touches(
            "Lake",
            1 - easel.sketch,
            paths,
            (2.2 if easel.sketch else 1.2) + 0.45 * (band - 5),
            tone,
            HAIR,
            _RIPPLES,
            opacity=0.75,
        )


def _merged(heaps: dict[tuple[int, str], list[list[Point]]]) -> dict[tuple[int, str], list[list[Point]]]:
    """Fewer colours: those that agree in the three upper bits of each channel become one."""
    found: dict[tuple, tuple[str, list[list[Point]]]] = {}
    for (band, tone), paths in heaps.items():
        key = (band, *(int(tone[i : i + 2], 16) >> 5 for i in (1, 3, 5)))
        found.setdefault(key, (tone, []))[1].extend(paths)
    return {(key[0], tone): paths for key, (tone, paths) in found.items()}


def _glitter(easel: Easel) -> None:
    """The sun's path on the left, and light caught by ripples everywhere."""
    chance = dice("glitter")
    for tone, count, opacity in (("#ffd9a0", 170, 0.6), ("#fff3d4", 100, 0.85)):
        paths = []
        for _ in range(count):
            near = chance.random() ** 1.5
            y = FAR_SHORE + 3 + 260 * near
            x = chance.gauss(166, 34 + 60 * near) if chance.random() < 0.75 else chance.uniform(100, 900)
            length = 3 + 16 * near * chance.random()
            if not dry(x + length, y):
                paths.append([(x, y, 0.2), (x + length / 2, y + 0.3, 0.4 + 0.6 * near), (x + length, y, 0.1)])
        easel.touches("Lake", 1, paths, 1.7, tone, HAIR, opacity=opacity)


def _boat(easel: Easel, x: float, y: float) -> None:
    """A small sail on its way home."""
    easel.stroke(
        "Lake", 2, hatch([(x + 1, y + 5), (x + 17, y + 5), (x + 8, y + 40)], 1.2), 1.2, "#c9a98c", FIRM, opacity=0.4
    )
    sail = [(x + 3, y - 4), (x + 4, y - 40), (x + 21, y - 6)]
    easel.stroke("Lake", 3, hatch(sail, 0.8), 0.8, "#e9d0ae", FIRM, [wave("stripes", "#fff6e4", 0.75, 3.0, 78)])
    easel.stroke("Lake", 3, hatch([(x + 1.5, y - 5), (x + 3, y - 35), (x - 8, y - 5)], 0.7), 0.7, "#fff0d2", FIRM)
    easel.stroke("Lake", 3, [(x + 3, y + 1), (x + 3.2, y - 42)], 0.5, "#4a3a34", FIRM)
    hull = [(x - 11, y - 2), (x + 23, y - 3), (x + 17, y + 4), (x - 6, y + 4)]
    easel.stroke("Lake", 3, hatch(hull, 0.8), 0.8, "#6b3d33", FIRM, [wave("stripes", "#a8654a", 0.6, 1.6, 88)])
    easel.stroke("Lake", 3, [(x - 11, y - 2.4, 0.7), (x + 6, y - 1.8), (x + 23, y - 3.2, 0.7)], 0.6, "#f0d2a2", FIRM)
    for k in range(3):
        line = hand(
            [(x - 14 - 9 * k, y + 5 + 3 * k), (x + 8, y + 6 + 3 * k), (x + 26 + 12 * k, y + 5 + 3 * k)], 6, 0.4, k, 0.5
        )
        easel.stroke("Lake", 2, line, 0.9, mix("#fff0d4", "#7d94a6", 0.3 * k), SOFT, flow=0.6)
