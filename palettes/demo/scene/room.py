"""The studio behind the window: the room, the canvas on its easel, the painter, and the window in front of them."""

from __future__ import annotations

from scene.colour import mix
from scene.easel import FIRM, HAIR, ROUND, SOFT, Easel, Point, hand, hatch, rock, wave
from scene.noise import dice
from scene.painter import painter
from scene.window import CANVAS, CANVAS_SIZE, WINDOW, X, box


def geraniums(
    easel: Easel, beds: list[tuple[float, float, float]], size: float, fine: int, layer: str = "Studio"
) -> None:
    """Geraniums in beds (left, right, y)."""
    chance = dice(f"flowers {fine}")
    for tone, count, lift, big in (("#33553c", 26, 0.2, 1.0), ("#6f9148", 22, 0.5, 0.7), ("#b8323c", 14, 1.3, 0.62),
                                   ("#ec6a5c", 12, 1.5, 0.42), ("#ffc0a8", 8, 1.6, 0.22)):  # fmt: skip
        spots = []
        for left, right, y in beds:
            for _ in range(count):
                x, up = chance.uniform(left, right), (lift + chance.gauss(0, 0.55)) * size
                spots.append([(x, y - up), (x + 0.4 * size, y - up + 0.2 * size)])
        easel.touches(layer, fine, spots, size * big, tone, ROUND)


def behind(easel: Easel) -> None:
    """The room behind the window: wall, lamp light, floor, a shelf of jars and books, pictures."""
    left, top, right, foot = WINDOW
    wall = [rock("#8a5238", 0.9, 0.4, 0.35, 31)]
    easel.stroke(
        "Studio",
        8,
        hatch(box(left + 0.02, top + 0.02, right - 0.02, foot - 0.3), 0.05, 1.4),
        0.05,
        "#5e3630",
        FIRM,
        wall,
    )
    floor = [(left + 0.3, foot - 0.5), (right - 0.3, foot - 0.5), (right - 0.02, foot), (left + 0.02, foot)]
    easel.stroke("Studio", 8, hatch(box(left + 0.02, foot - 0.5, right - 0.02, foot), 0.04, 1.4), 0.04, "#4c2f2a", FIRM)
    easel.stroke(
        "Studio", 8, hatch(floor, 0.04, 1.4), 0.04, "#7a4c34", FIRM, [wave("stripes", "#a56f48", 0.6, 0.14, 8)]
    )
    lamp = (X - 0.95, top + 0.62)
    for size, tone, opacity in ((1.3, "#c87838", 0.55), (0.8, "#eba650", 0.55), (0.4, "#ffd684", 0.7)):
        easel.stroke("Studio", 7, [lamp, (lamp[0] + 0.02, lamp[1])], size, tone, SOFT, opacity=opacity, flow=0.6)
    easel.stroke("Studio", 8, [(lamp[0], top), (lamp[0], lamp[1] - 0.1)], 0.012, "#2f2226", FIRM)
    shade = [
        (lamp[0] - 0.07, lamp[1] - 0.12),
        (lamp[0] + 0.07, lamp[1] - 0.12),
        (lamp[0] + 0.2, lamp[1]),
        (lamp[0] - 0.2, lamp[1]),
    ]
    easel.stroke("Studio", 9, hatch(shade, 0.015, 1.4), 0.015, "#3f6a5c", FIRM)
    easel.stroke(
        "Studio",
        9,
        [(lamp[0] - 0.05, lamp[1] + 0.03), (lamp[0] + 0.05, lamp[1] + 0.03)],
        0.055,
        "#fff6d0",
        ROUND,
        dynamics={},
    )
    _shelf(easel, left + 0.18, top + 1.28)
    pictures = (
        (X - 0.42, top + 0.35, 0.34, 0.26, "#6f93ac", "#57713f"),
        (X + 1.15, top + 0.3, 0.5, 0.36, "#e0a868", "#6a4a6a"),
        (X + 1.25, top + 0.86, 0.26, 0.34, "#8aa6a0", "#b0563c"),
    )
    for px, py, w, h, sky, earth in pictures:
        easel.stroke("Studio", 9, hatch(box(px, py, px + w, py + h), 0.02, 1.4), 0.02, "#c8964c", FIRM)
        easel.stroke(
            "Studio", 9, hatch(box(px + 0.03, py + 0.03, px + w - 0.03, py + 0.6 * h), 0.015, 1.4), 0.015, sky, FIRM
        )
        hill = [
            (px + 0.03, py + 0.62 * h),
            (px + 0.4 * w, py + 0.4 * h),
            (px + w - 0.03, py + 0.6 * h),
            (px + w - 0.03, py + h - 0.03),
            (px + 0.03, py + h - 0.03),
        ]
        easel.stroke("Studio", 9, hatch(hill, 0.012, 1.4), 0.012, earth, FIRM, [rock("#f0d090", 0.7, 0.08, 0.3, 32)])


def _shelf(easel: Easel, x: float, y: float) -> None:
    chance = dice("shelf")
    easel.stroke("Studio", 8, [(x - 0.1, y), (x + 1.0, y)], 0.03, "#8a5a3c", FIRM)
    books: dict[str, list[list[Point]]] = {}
    gilt = []
    at = x - 0.05
    while at < x + 0.95:
        wide, tall = chance.uniform(0.04, 0.085), chance.uniform(0.17, 0.3)
        tone = chance.choice(("#a8483c", "#d8a458", "#5a7a80", "#e8d4b0", "#6a5a82", "#7d9058"))
        books.setdefault(tone, []).append(hatch(box(at, y - 0.03 - tall, at + wide, y - 0.03), 0.012, 1.4))
        gilt.append([(at + 0.015, y - 0.02 - tall), (at + 0.015, y - 0.05)])
        at += wide + (0.012 if chance.random() < 0.8 else 0.07)
    for tone, spines in books.items():
        easel.touches("Studio", 9, spines, 0.012, tone, FIRM)
    easel.touches("Studio", 9, gilt, 0.008, "#f0dcae", HAIR, opacity=0.7)
    easel.stroke("Studio", 8, hatch(box(x, y + 0.55, x + 0.9, y + 0.63), 0.03, 1.4), 0.03, "#6a4230", FIRM)
    for k in range(2):
        easel.stroke(
            "Studio", 8, [(x + 0.06 + 0.78 * k, y + 0.6), (x + 0.06 + 0.78 * k, y + 1.05)], 0.03, "#573426", FIRM
        )
    for k in range(5):
        jar = x + 0.1 + 0.17 * k
        tone = ("#c8543c", "#e0b048", "#4a7a9a", "#e8e0cc", "#5f8a58")[k]
        easel.stroke(
            "Studio",
            9,
            hatch(box(jar - 0.045, y + 0.42, jar + 0.045, y + 0.55), 0.015, 1.4),
            0.015,
            mix(tone, "#e8f0f0", 0.25),
            FIRM,
        )
        easel.stroke("Studio", 9, [(jar - 0.025, y + 0.45), (jar - 0.025, y + 0.53)], 0.008, "#fffaf0", HAIR)
        if k in (1, 3):
            quills = [[(jar, y + 0.45), (jar + lean, y + 0.22)] for lean in (-0.06, -0.01, 0.05)]
            easel.touches("Studio", 9, quills, 0.009, "#d8b88a", FIRM)


def in_front(easel: Easel) -> None:
    """All that lies over the picture: its frame, its maker, and the window."""
    _stand(easel)
    painter(easel)
    _frame(easel)


def _stand(easel: Easel) -> None:
    """The picture's gilded frame, which also trims its edges, and the easel that carries it."""
    (x, y), (w, h) = CANVAS, CANVAS_SIZE
    wood = [rock("#c8905c", 0.9, 0.1, 0.3, 33)]
    mid = x + w / 2
    legs = [
        [(mid, y + h + 0.05), (mid, y + 1.2)],
        [(x + 0.16, y + h + 0.04), (x - 0.02, y + 1.24)],
        [(x + w - 0.16, y + h + 0.04), (x + w + 0.02, y + 1.24)],
        [(mid, y - 0.06), (mid, y - 0.26)],
    ]
    easel.touches("Window", 9, legs, 0.028, "#7d4f30", FIRM, wood)
    easel.touches("Window", 9, [[(px - 0.012, py) for px, py in leg] for leg in legs], 0.008, "#dca870", HAIR)
    rim = 0.034
    ring = [
        (x - rim, y - rim),
        (x + w + rim, y - rim),
        (x + w + rim, y + h + rim),
        (x - rim, y + h + rim),
        (x - rim, y - rim),
    ]
    easel.stroke("Window", 10, ring, 0.034, "#a8742c", FIRM, [rock("#f6d27a", 0.9, 0.06, 0.3, 34)])
    for out, size, tone in ((0.026, 0.006, "#ffe6a0"), (0.036, 0.006, "#7a4e1c"), (-0.008, 0.005, "#fff0b8")):
        line = [(px + (out if px < mid else -out), py + (out if py < y + h / 2 else -out)) for px, py in ring]
        easel.stroke("Window", 10, line, size, tone, FIRM)
    tray = [(x - 0.02, y + h + 0.085), (x + w + 0.02, y + h + 0.085)]
    easel.stroke("Window", 9, tray, 0.026, "#8a5834", FIRM, wood)
    easel.stroke("Window", 10, [(px, py - 0.02) for px, py in tray], 0.007, "#e8b880", HAIR)


def _frame(easel: Easel) -> None:
    """The window's own bars, sill, flowers and cat, in front of the room."""
    left, top, right, foot = WINDOW
    wood = [rock("#c8a888", 0.8, 0.3, 0.3, 37)]
    ring = [(left, top), (right, top), (right, foot), (left, foot), (left, top)]
    easel.stroke("Window", 8, ring, 0.075, "#efe0c4", FIRM, wood)
    bars = [[(x, top), (x, foot)] for x in (X - 0.68, X + 1.1)]
    easel.touches("Window", 8, bars, 0.035, "#efe0c4", FIRM, wood)
    easel.touches(
        "Window",
        8,
        [[(x + 0.03, y) for x, y in bar] for bar in [*bars, [(left + 0.06, top), (left + 0.06, foot)]]],
        0.012,
        "#8a6a5c",
        FIRM,
    )
    easel.stroke("Window", 8, [(left + 0.06, top + 0.07), (right - 0.06, top + 0.07)], 0.014, "#7a5a50", FIRM)
    sill = [(left - 0.3, foot + 0.1), (right + 0.3, foot + 0.1)]
    easel.stroke("Window", 8, sill, 0.1, "#c9ac88", FIRM, [rock("#f3e2c0", 0.9, 0.3, 0.3, 38)])
    easel.stroke("Window", 8, [(x, y - 0.085) for x, y in sill], 0.02, "#fff2d0", FIRM)
    easel.stroke(
        "Window",
        8,
        hatch(box(left - 0.1, foot - 0.06, X - 0.75, foot + 0.14), 0.03, 1.4),
        0.03,
        "#a5583c",
        FIRM,
        [rock("#d88a60", 0.8, 0.2, 0.3, 38)],
    )
    geraniums(easel, [(left - 0.05, X - 0.8, foot - 0.08)], 0.075, 8, "Window")
    _cat(easel, X + 1.55, foot + 0.03)


def _cat(easel: Easel, x: float, y: float) -> None:
    """Asleep? No: watching the swallows."""
    fur = [rock("#e8a860", 0.9, 0.08, 0.25, 39)]
    tail = hand([(x + 0.14, y - 0.02), (x + 0.3, y + 0.03), (x + 0.33, y + 0.2), (x + 0.26, y + 0.27)], 0.03)
    easel.stroke("Window", 9, tail, 0.028, "#a8622c", FIRM, fur)
    trunk = [(x - 0.09, y - 0.3), (x + 0.05, y - 0.3), (x + 0.18, y), (x - 0.12, y)]
    easel.stroke("Window", 9, hatch(trunk, 0.04, 1.2), 0.04, "#b06a30", FIRM, fur)
    easel.stroke("Window", 9, [(x - 0.05, y - 0.36), (x - 0.015, y - 0.36)], 0.085, "#b87236", FIRM, fur)
    ears = [[(x - 0.11, y - 0.41), (x - 0.12, y - 0.48, 0.1)], [(x + 0.03, y - 0.41), (x + 0.05, y - 0.48, 0.1)]]
    easel.touches("Window", 9, ears, 0.035, "#a8622c", ROUND)
    easel.touches("Window", 9, [[(x - 0.075, y - 0.2), (x - 0.08, y - 0.02)]], 0.03, "#f6e4c8", ROUND)
    easel.touches(
        "Window",
        10,
        [[(x - 0.085, y - 0.37), (x - 0.083, y - 0.368)], [(x + 0.01, y - 0.37), (x + 0.012, y - 0.368)]],
        0.012,
        "#2a2420",
        FIRM,
    )
    easel.touches(
        "Window",
        9,
        [[(x + 0.02 * k, y - 0.26), (x + 0.045 * k, y - 0.1, 0.3)] for k in (1, 2, 3)],
        0.012,
        "#7a3f1c",
        HAIR,
    )
