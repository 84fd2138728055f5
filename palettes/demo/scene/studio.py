"""The painter's house: a front to be looked at from near, and behind its window, much finer, the painter at work.

On the painter's canvas stands this whole scene again, painted 2^11 times as fine.
"""

from __future__ import annotations

from collections.abc import Callable

from scene.colour import mix
from scene.easel import FIRM, HAIR, ROUND, SOFT, Easel, Point, hand, hatch, rock, wave
from scene.land import clump
from scene.noise import dice
from scene.town import STUDIO, people

X, FOOT = STUDIO
EAVES, PEAK = FOOT - 11.5, FOOT - 21.5
LEFT, RIGHT = X - 7, X + 7
CANVAS = (X + 0.2, FOOT - 14.1)  # corner of the painter's canvas: one unit of its scene is a pixel of level 11
DEEPER = 11
CANVAS_SIZE = (1280 / 2**DEEPER, 800 / 2**DEEPER)
MIDDLE = (CANVAS[0] + CANVAS_SIZE[0] / 2, CANVAS[1] + CANVAS_SIZE[1] / 2)
WINDOW = (X - 2.0, FOOT - 15.15, X + 2.0, FOOT - 12.55)  # left, top, right, foot of the studio's window
_BEAM, _LIT_BEAM = "#5b3a32", "#8d6048"


def inside(x: float, y: float) -> tuple[float, float]:
    """Where a place of the scene lies on the painter's canvas."""
    return CANVAS[0] + x / 2**DEEPER, CANVAS[1] + y / 2**DEEPER


def _box(left: float, top: float, right: float, foot: float) -> list[Point]:
    return [(left, top), (right, top), (right, foot), (left, foot)]


def paint(easel: Easel, scene: Callable[[Easel], None]) -> None:
    easel.layer("Studio")
    _square(easel)
    if not easel.sketch:
        behind = [(X - 9.6, FOOT - 2, 2.2), (X - 8.2, FOOT - 1, 1.5), (X - 8.9, FOOT - 5, 1.9), (X + 11.6, FOOT - 1.5, 1.6)]
        clump(easel, "Studio", behind, "behind", fine=5)
    _front(easel)
    _timbers(easel)
    for left, top, lit in ((X - 5.6, 477.0, 0), (X - 1.0, 477.0, 1), (X + 3.5, 477.0, 0), (X + 1.2, 481.8, 1)):
        if not easel.sketch:
            _casement(easel, left, top, bool(lit))
    _roof(easel)
    _opening(easel)
    if easel.sketch:
        return
    _door(easel)
    _garden(easel)
    people(easel)
    _room(easel)
    easel.layer("Picture")
    scene(easel.within(DEEPER, CANVAS, "Picture"))
    easel.layer("Window")
    _canvas_and_easel(easel)
    _painter(easel)
    _frame(easel)


def _square(easel: Easel) -> None:
    """The paved place before the house."""
    paving = [wave("squares", "#ecd8b2", 0.7, 0.8, 30), rock("#8f7458", 0.4, 3, 0.3, 25)]
    ground = [(X - 17, FOOT - 1.2), (X + 18, FOOT - 1.2), (X + 22, FOOT + 5), (X - 20, FOOT + 5)]
    easel.stroke("Studio", 4, hatch(ground, 0.6, 1.3), 0.6, "#bfa37c", FIRM, paving)
    edge = hand([(X - 20, FOOT + 5.1), (X, FOOT + 5.4), (X + 22, FOOT + 5.1)], 1.5, 0.15)
    easel.stroke("Studio", 4, edge, 0.45, "#8a7a64", ROUND, [rock("#d8c8a4", 0.9, 3, 0.3, 25)])
    shade = hatch([(X + 7, FOOT), (X + 9, FOOT - 1), (X + 16, FOOT + 1.5), (X + 11, FOOT + 2)], 0.7)
    easel.stroke("Studio", 3, shade, 0.7, "#54486a", SOFT, opacity=0.5, flow=0.5)


def _front(easel: Easel) -> None:
    grain = [rock("#a98a78", 0.6, 2.5, 0.3, 25)]
    side = [(RIGHT, EAVES), (RIGHT + 3.4, EAVES - 0.6), (RIGHT + 3.4, FOOT - 1.2), (RIGHT, FOOT)]
    easel.stroke("Studio", 4, hatch(side, 0.4, 1.3), 0.4, "#8d7480", FIRM, grain)
    front = [(LEFT, FOOT), (LEFT, EAVES), (X, PEAK), (RIGHT, EAVES), (RIGHT, FOOT)]
    easel.stroke("Studio", 5, hatch(front, 0.25, 1.3), 0.25, "#eed7ae", FIRM, [rock("#c9a98a", 0.7, 2.5, 0.3, 25)])
    for k in range(3):
        under = [(LEFT, EAVES + 0.9 + 0.2 * k), (X, PEAK + 1.5 + 0.3 * k), (RIGHT, EAVES + 0.9 + 0.2 * k)]
        easel.stroke("Studio", 5, under, 0.55, "#8a6a70", SOFT, opacity=0.4)
    easel.stroke("Studio", 5, hatch(_box(LEFT, FOOT - 1.3, RIGHT, FOOT), 0.2, 1.3), 0.2, "#a08c80", FIRM, [wave("squares", "#cdb9a0", 0.6, 1.1)])


def _timbers(easel: Easel) -> None:
    """The frame of the wall: each beam with its sunny edge."""
    beams: list[list[Point]] = [
        [(LEFT + 0.15, EAVES + 0.2), (RIGHT - 0.15, EAVES + 0.2)],
        [(LEFT + 0.15, 480.7), (RIGHT - 0.15, 480.7)],
        [(X - 2.2, 469.6), (X + 2.2, 469.6)],
        [(LEFT + 0.2, EAVES), (LEFT + 0.2, FOOT - 1.2)],
        [(RIGHT - 0.2, EAVES), (RIGHT - 0.2, FOOT - 1.2)],
        [(X - 2.6, 480.6), (X - 2.6, EAVES)],
        [(X + 2.4, 480.6), (X + 2.4, EAVES)],
        [(X, 469.4), (X, PEAK + 1)],
        [(X - 5.9, EAVES), (X - 2.9, 470.6)],
        [(X + 5.9, EAVES), (X + 2.9, 470.6)],
        [(X - 2.9, 470.4), (X - 2.9, EAVES)],
        [(X + 2.9, 470.4), (X + 2.9, EAVES)],
    ]
    wood = [rock("#7d5545", 0.9, 0.8, 0.3, 26)]
    easel.touches("Studio", 6, [[(x + 0.09, y + 0.09) for x, y in beam] for beam in beams], 0.2, "#8a6c66", FIRM, opacity=0.5)
    easel.touches("Studio", 6, beams, 0.19, _BEAM, FIRM, wood)
    easel.touches("Studio", 6, [[(x - 0.1, y - 0.1) for x, y in beam] for beam in beams], 0.05, "#b98a62", HAIR, opacity=0.8)


def _casement(easel: Easel, left: float, top: float, lit: bool) -> None:
    """A window with shutters, curtains and a box of flowers."""
    right, foot = left + 1.9, top + 2.6
    pane = "#e8a552" if lit else "#4b5a78"
    slats = [wave("stripes", "#8fae9c", 0.7, 0.18, 90)]
    for a in (left - 0.95, right + 0.12):
        easel.stroke("Studio", 6, hatch(_box(a, top, a + 0.83, foot), 0.07, 1.4), 0.07, "#476a66", FIRM, slats)
    easel.stroke("Studio", 6, hatch(_box(left - 0.06, top - 0.1, right + 0.06, foot + 0.1), 0.08, 1.4), 0.08, "#f3e6cc", FIRM)
    easel.stroke("Studio", 6, hatch(_box(left + 0.12, top + 0.1, right - 0.12, foot - 0.1), 0.07, 1.4), 0.07, pane, FIRM)
    sheen = [(left + 0.3, foot - 0.5), (right - 0.5, top + 0.3)]
    easel.stroke("Studio", 6, sheen, 0.28, "#ffe9b0" if lit else "#9fb4cc", SOFT, opacity=0.6)
    curtains = []
    for side, way in ((left + 0.15, 1), (right - 0.15, -1)):
        for k in range(3):
            curtains.append(hand([(side + way * 0.13 * k, top + 0.15), (side + way * (0.1 * k + 0.02), top + 1.6 - 0.3 * k)], 0.3, 0.02, k))
    easel.touches("Studio", 6, curtains, 0.075, "#f6ead6", ROUND, opacity=0.85)
    bars = [[((left + right) / 2, top), ((left + right) / 2, foot)], [(left, top + 0.9), (right, top + 0.9)]]
    easel.touches("Studio", 6, bars, 0.06, "#fff6e2", FIRM)
    easel.stroke("Studio", 6, hatch(_box(left - 0.2, foot + 0.1, right + 0.2, foot + 0.5), 0.06, 1.4), 0.06, "#7a4c3a", FIRM)
    _flowers(easel, left - 0.15, right + 0.15, foot + 0.12, 0.13, 6, f"box {left} {top}")


def _flowers(easel: Easel, left: float, right: float, y: float, size: float, fine: int, name: str, layer: str = "Studio") -> None:
    chance = dice(name)
    for tone, count, lift, big in (("#33553c", 26, 0.2, 1.0), ("#6f9148", 22, 0.5, 0.7), ("#b8323c", 14, 1.3, 0.62),
                                   ("#ec6a5c", 12, 1.5, 0.42), ("#ffc0a8", 8, 1.6, 0.22)):  # fmt: skip
        spots = []
        for _ in range(count):
            x, up = chance.uniform(left, right), (lift + chance.gauss(0, 0.55)) * size
            spots.append([(x, y - up), (x + 0.4 * size, y - up + 0.2 * size)])
        easel.touches(layer, fine, spots, size * big, tone, ROUND)


def _door(easel: Easel) -> None:
    left, top, right = X - 4.0, 481.9, X - 1.6
    arch = [(left, FOOT), (left, top + 0.7), ((left + right) / 2, top - 0.2), (right, top + 0.7), (right, FOOT)]
    easel.stroke("Studio", 6, hatch([(x + (0.3 if x > X - 2.8 else -0.3) * (x != (left + right) / 2), y - 0.3 * (y < FOOT)) for x, y in arch], 0.1, 1.4), 0.1, "#b7a48e", FIRM)
    easel.stroke("Studio", 6, hatch(arch, 0.09, 1.4), 0.09, "#6a3f30", FIRM, [wave("stripes", "#9a6446", 0.8, 0.42)])
    easel.touches("Studio", 6, [[(left + 0.5, 483.2), (left + 0.5, 483.3)]], 0.13, "#f0c872", FIRM)
    easel.touches("Studio", 6, [[(left - 0.5, 482.6), (left - 0.5, 483.1)]], 0.22, "#ffdf94", FIRM)
    easel.stroke("Studio", 5, [(left - 0.5, 482.8), (left - 0.45, 482.9)], 1.6, "#ffc870", SOFT, opacity=0.5, flow=0.5)


def _roof(easel: Easel) -> None:
    """The far slope, then barge boards over the gable."""
    tiles = [wave("stripes", "#b9614a", 0.7, 0.6, 82), rock("#5a3038", 0.5, 1.5, 0.3, 27)]
    slope = [(X, PEAK - 0.5), (X + 4, PEAK - 1.0), (RIGHT + 4.4, EAVES + 0.2), (RIGHT + 0.9, EAVES + 1.0)]
    easel.stroke("Studio", 5, hatch(slope, 0.25, 1.3), 0.25, "#6f3a3c", FIRM, tiles)
    verge = [(LEFT - 1.0, EAVES + 1.2), (X, PEAK - 0.4), (RIGHT + 1.0, EAVES + 1.2)]
    easel.stroke("Studio", 6, verge, 0.34, "#7a4638", FIRM, [rock("#a86a50", 0.8, 0.8, 0.3, 26)])
    easel.stroke("Studio", 6, [(x - 0.16, y - 0.18) for x, y in verge[:2]], 0.11, "#f0b888", FIRM)
    easel.stroke("Studio", 6, [(x + 0.16, y - 0.22) for x, y in verge[1:]], 0.09, "#b87458", FIRM)
    teeth = []
    for k in range(1, 24):
        for (ax, ay), (bx, by) in ((verge[0], verge[1]), (verge[1], verge[2])):
            x, y = ax + (bx - ax) * k / 24, ay + (by - ay) * k / 24
            teeth.append([(x, y + 0.36), (x, y + 0.42)])
    easel.touches("Studio", 6, teeth, 0.12, "#7a4638", FIRM)
    chimney = _box(X + 4.4, PEAK - 0.2, X + 6.0, PEAK + 4.6)
    easel.stroke("Studio", 5, hatch(chimney, 0.15, 1.3), 0.15, "#8f5a4c", FIRM, [wave("squares", "#c98a6c", 0.6, 0.5)])
    smoke = hand([(X + 5.2, PEAK - 0.6, 0.2), (X + 4.8, PEAK - 3, 0.5), (X + 6.8, PEAK - 6, 0.8), (X + 6.2, PEAK - 10, 1.0)], 0.6, 0.4, 3)
    easel.stroke("Studio", 3, smoke, 1.6, "#efe4da", SOFT, opacity=0.4, flow=0.15)


def _opening(easel: Easel) -> None:
    left, top, right, foot = WINDOW
    easel.stroke("Studio", 6, hatch(_box(left - 0.2, top - 0.2, right + 0.2, foot + 0.16), 0.1, 1.4), 0.1, "#d9c3a0", FIRM, [rock("#9a7c6c", 0.7, 0.8, 0.3, 26)])
    easel.stroke("Studio", 7, hatch(_box(left, top, right, foot), 0.06, 1.4), 0.06, "#a5683c", FIRM)
    easel.stroke("Studio", 6, [(left + 0.9, top + 0.8), (X + 0.8, top + 1.1)], 0.9, "#ffd488", SOFT, opacity=0.8)


def _room(easel: Easel) -> None:
    """The room behind the window: wall, lamp light, floor, a shelf of jars and books, pictures."""
    left, top, right, foot = WINDOW
    wall = [rock("#8a5238", 0.9, 0.4, 0.35, 31)]
    easel.stroke("Studio", 8, hatch(_box(left + 0.02, top + 0.02, right - 0.02, foot - 0.3), 0.05, 1.4), 0.05, "#5e3630", FIRM, wall)
    floor = [(left + 0.3, foot - 0.5), (right - 0.3, foot - 0.5), (right - 0.02, foot), (left + 0.02, foot)]
    easel.stroke("Studio", 8, hatch(_box(left + 0.02, foot - 0.5, right - 0.02, foot), 0.04, 1.4), 0.04, "#4c2f2a", FIRM)
    easel.stroke("Studio", 8, hatch(floor, 0.04, 1.4), 0.04, "#7a4c34", FIRM, [wave("stripes", "#a56f48", 0.6, 0.14, 8)])
    lamp = (X - 0.95, top + 0.62)
    for size, tone, opacity in ((1.3, "#c87838", 0.55), (0.8, "#eba650", 0.55), (0.4, "#ffd684", 0.7)):
        easel.stroke("Studio", 7, [lamp, (lamp[0] + 0.02, lamp[1])], size, tone, SOFT, opacity=opacity, flow=0.6)
    easel.stroke("Studio", 8, [(lamp[0], top), (lamp[0], lamp[1] - 0.1)], 0.012, "#2f2226", FIRM)
    shade = [(lamp[0] - 0.07, lamp[1] - 0.12), (lamp[0] + 0.07, lamp[1] - 0.12), (lamp[0] + 0.2, lamp[1]), (lamp[0] - 0.2, lamp[1])]
    easel.stroke("Studio", 9, hatch(shade, 0.015, 1.4), 0.015, "#3f6a5c", FIRM)
    easel.stroke("Studio", 9, [(lamp[0] - 0.05, lamp[1] + 0.03), (lamp[0] + 0.05, lamp[1] + 0.03)], 0.055, "#fff6d0", ROUND, dynamics={})
    _shelf(easel, left + 0.18, top + 1.28)
    pictures = ((X - 0.42, top + 0.35, 0.34, 0.26, "#6f93ac", "#57713f"), (X + 1.15, top + 0.3, 0.5, 0.36, "#e0a868", "#6a4a6a"),
                (X + 1.25, top + 0.86, 0.26, 0.34, "#8aa6a0", "#b0563c"))  # fmt: skip
    for px, py, w, h, sky, earth in pictures:
        easel.stroke("Studio", 9, hatch(_box(px, py, px + w, py + h), 0.02, 1.4), 0.02, "#c8964c", FIRM)
        easel.stroke("Studio", 9, hatch(_box(px + 0.03, py + 0.03, px + w - 0.03, py + 0.6 * h), 0.015, 1.4), 0.015, sky, FIRM)
        hill = [(px + 0.03, py + 0.62 * h), (px + 0.4 * w, py + 0.4 * h), (px + w - 0.03, py + 0.6 * h), (px + w - 0.03, py + h - 0.03), (px + 0.03, py + h - 0.03)]
        easel.stroke("Studio", 9, hatch(hill, 0.012, 1.4), 0.012, earth, FIRM, [rock("#f0d090", 0.7, 0.08, 0.3, 32)])


def _shelf(easel: Easel, x: float, y: float) -> None:
    chance = dice("shelf")
    easel.stroke("Studio", 8, [(x - 0.1, y), (x + 1.0, y)], 0.03, "#8a5a3c", FIRM)
    at = x - 0.05
    while at < x + 0.95:
        wide, tall = chance.uniform(0.04, 0.085), chance.uniform(0.17, 0.3)
        tone = chance.choice(("#a8483c", "#d8a458", "#5a7a80", "#e8d4b0", "#6a5a82", "#7d9058"))
        easel.stroke("Studio", 9, hatch(_box(at, y - 0.03 - tall, at + wide, y - 0.03), 0.012, 1.4), 0.012, tone, FIRM)
        easel.stroke("Studio", 9, [(at + 0.015, y - 0.02 - tall), (at + 0.015, y - 0.05)], 0.008, mix(tone, "#fff0c0", 0.6), HAIR)
        at += wide + (0.012 if chance.random() < 0.8 else 0.07)
    easel.stroke("Studio", 8, hatch(_box(x, y + 0.55, x + 0.9, y + 0.63), 0.03, 1.4), 0.03, "#6a4230", FIRM)
    for k in range(2):
        easel.stroke("Studio", 8, [(x + 0.06 + 0.78 * k, y + 0.6), (x + 0.06 + 0.78 * k, y + 1.05)], 0.03, "#573426", FIRM)
    for k in range(5):
        jar = x + 0.1 + 0.17 * k
        tone = ("#c8543c", "#e0b048", "#4a7a9a", "#e8e0cc", "#5f8a58")[k]
        easel.stroke("Studio", 9, hatch(_box(jar - 0.045, y + 0.42, jar + 0.045, y + 0.55), 0.015, 1.4), 0.015, mix(tone, "#e8f0f0", 0.25), FIRM)
        easel.stroke("Studio", 9, [(jar - 0.025, y + 0.45), (jar - 0.025, y + 0.53)], 0.008, "#fffaf0", HAIR)
        if k in (1, 3):
            quills = [[(jar, y + 0.45), (jar + lean, y + 0.22)] for lean in (-0.06, -0.01, 0.05)]
            easel.touches("Studio", 9, quills, 0.009, "#d8b88a", FIRM)


def _canvas_and_easel(easel: Easel) -> None:
    """The picture's gilded frame, which also trims its edges, and the easel that carries it."""
    (x, y), (w, h) = CANVAS, CANVAS_SIZE
    wood = [rock("#c8905c", 0.9, 0.1, 0.3, 33)]
    mid = x + w / 2
    legs = [[(mid, y + h + 0.05), (mid, y + 1.2)], [(x + 0.16, y + h + 0.04), (x - 0.02, y + 1.24)], [(x + w - 0.16, y + h + 0.04), (x + w + 0.02, y + 1.24)],
            [(mid, y - 0.06), (mid, y - 0.26)]]  # fmt: skip
    easel.touches("Window", 9, legs, 0.028, "#7d4f30", FIRM, wood)
    easel.touches("Window", 9, [[(px - 0.012, py) for px, py in leg] for leg in legs], 0.008, "#dca870", HAIR)
    rim = 0.034
    ring = [(x - rim, y - rim), (x + w + rim, y - rim), (x + w + rim, y + h + rim), (x - rim, y + h + rim), (x - rim, y - rim)]
    easel.stroke("Window", 10, ring, 0.034, "#a8742c", FIRM, [rock("#f6d27a", 0.9, 0.06, 0.3, 34)])
    for out, size, tone in ((0.026, 0.006, "#ffe6a0"), (0.036, 0.006, "#7a4e1c"), (-0.008, 0.005, "#fff0b8")):
        line = [(px + (out if px < mid else -out), py + (out if py < y + h / 2 else -out)) for px, py in ring]
        easel.stroke("Window", 10, line, size, tone, FIRM)
    tray = [(x - 0.02, y + h + 0.085), (x + w + 0.02, y + h + 0.085)]
    easel.stroke("Window", 9, tray, 0.026, "#8a5834", FIRM, wood)
    easel.stroke("Window", 10, [(px, py - 0.02) for px, py in tray], 0.007, "#e8b880", HAIR)


def _painter(easel: Easel) -> None:
    """Standing at the left, one arm with the brush at the canvas."""
    (x, y), (_, h) = CANVAS, CANVAS_SIZE
    body = x - 0.36
    smock = [rock("#7f9cb4", 0.8, 0.3, 0.4, 35)]
    easel.touches("Window", 8, [[(body - 0.07, y + 0.75), (body - 0.09, y + 1.2)], [(body + 0.08, y + 0.75), (body + 0.09, y + 1.2)]], 0.06, "#3a3440", FIRM)
    coat = [(body - 0.13, y + 0.14), (body + 0.13, y + 0.14), (body + 0.22, y + 0.86), (body - 0.22, y + 0.86)]
    easel.stroke("Window", 9, hatch(coat, 0.03, 1.4), 0.03, "#3f5f80", FIRM, smock)
    folds = [hand([(body + 0.05 * k, y + 0.3), (body + 0.075 * k, y + 0.82)], 0.1, 0.01, k) for k in (-2, -1, 1, 2)]
    easel.touches("Window", 9, folds, 0.014, "#2c4460", ROUND, opacity=0.7)
    easel.touches("Window", 9, [[(body - 0.13, y + 0.18), (body - 0.2, y + 0.84)]], 0.014, "#a9c0cc", ROUND, opacity=0.8)
    arm = hand([(body + 0.1, y + 0.2), (body + 0.19, y + 0.36), (body + 0.3, y + 0.25)], 0.04)
    easel.stroke("Window", 10, arm, 0.05, "#46688a", FIRM, smock)
    easel.stroke("Window", 10, [(px - 0.01, py - 0.035, 0.8) for px, py, _ in arm], 0.012, "#a9c0cc", ROUND)
    easel.stroke("Window", 10, [(body + 0.31, y + 0.235), (body + 0.33, y + 0.225)], 0.033, "#e8b48c", FIRM)
    easel.stroke("Window", 11, [(body + 0.27, y + 0.27), (body + 0.345, y + 0.205)], 0.006, "#6a4428", FIRM)
    easel.stroke("Window", 11, [(body + 0.345, y + 0.205), (body + 0.357, y + 0.195, 0.3)], 0.008, "#e8c468", ROUND)
    palette = hand([(body - 0.2, y + 0.46), (body - 0.1, y + 0.42), (body + 0.02, y + 0.47), (body - 0.08, y + 0.52), (body - 0.2, y + 0.47)], 0.05)
    easel.stroke("Window", 10, palette, 0.04, "#b07c4c", FIRM)
    for k, tone in enumerate(("#f6f0e0", "#e8b83c", "#c8402c", "#3c6a9c", "#4c7a44")):
        easel.stroke("Window", 10, [(body - 0.19 + 0.045 * k, y + 0.455 + 0.008 * (k % 2)), (body - 0.18 + 0.045 * k, y + 0.46)], 0.016, tone, ROUND, dynamics={})
    head = (body + 0.02, y - 0.03)
    easel.stroke("Window", 10, [(head[0], head[1] + 0.06), (head[0], y + 0.13)], 0.045, "#c88f6c", FIRM)
    easel.stroke("Window", 10, [(head[0] - 0.005, head[1] - 0.02), (head[0] + 0.008, head[1] + 0.045)], 0.085, "#dba27c", FIRM)
    easel.stroke("Window", 10, hand([(head[0] + 0.085, head[1]), (head[0] + 0.105, head[1] + 0.02), (head[0] + 0.085, head[1] + 0.03)], 0.01), 0.014, "#dba27c", FIRM)
    easel.stroke("Window", 10, hand([(head[0] - 0.07, head[1] + 0.06), (head[0] - 0.085, head[1] - 0.03), (head[0] - 0.02, head[1] - 0.08)], 0.02), 0.035, "#5c3a30", ROUND, dynamics={})
    easel.stroke("Window", 11, [(head[0] + 0.05, head[1] - 0.012), (head[0] + 0.052, head[1] - 0.01)], 0.008, "#3a2a2a", FIRM)
    easel.stroke("Window", 11, hand([(head[0] + 0.035, head[1] - 0.03), (head[0] + 0.055, head[1] - 0.035), (head[0] + 0.07, head[1] - 0.028)], 0.01), 0.004, "#5c3a30", FIRM)
    easel.stroke("Window", 11, hand([(head[0] + 0.05, head[1] + 0.055), (head[0] + 0.065, head[1] + 0.06), (head[0] + 0.08, head[1] + 0.052)], 0.01), 0.004, "#a85a4c", FIRM)
    easel.stroke("Window", 10, [(head[0] + 0.02, head[1] + 0.035), (head[0] + 0.022, head[1] + 0.036)], 0.025, "#e8967c", SOFT, opacity=0.5, flow=0.5)
    easel.stroke("Window", 11, hand([(head[0] - 0.025, head[1] - 0.005), (head[0] - 0.04, head[1] + 0.012), (head[0] - 0.022, head[1] + 0.03)], 0.01), 0.013, "#c88f6c", FIRM)
    beret = hand([(head[0] - 0.11, head[1] - 0.07), (head[0] - 0.02, head[1] - 0.115), (head[0] + 0.1, head[1] - 0.075)], 0.03)
    easel.stroke("Window", 10, beret, 0.045, "#8e2f34", FIRM, [rock("#d0605c", 0.7, 0.06, 0.3, 36)])
    easel.stroke("Window", 10, [(head[0], head[1] - 0.15), (head[0] + 0.012, head[1] - 0.18)], 0.011, "#8e2f34", FIRM)


def _frame(easel: Easel) -> None:
    """The window's own bars, sill, flowers and cat, in front of the room."""
    left, top, right, foot = WINDOW
    wood = [rock("#c8a888", 0.8, 0.3, 0.3, 37)]
    ring = [(left, top), (right, top), (right, foot), (left, foot), (left, top)]
    easel.stroke("Window", 8, ring, 0.075, "#efe0c4", FIRM, wood)
    bars = [[(x, top), (x, foot)] for x in (X - 0.68, X + 1.1)]
    easel.touches("Window", 8, bars, 0.035, "#efe0c4", FIRM, wood)
    easel.touches("Window", 8, [[(x + 0.03, y) for x, y in bar] for bar in [*bars, [(left + 0.06, top), (left + 0.06, foot)]]], 0.012, "#8a6a5c", FIRM)
    easel.stroke("Window", 8, [(left + 0.06, top + 0.07), (right - 0.06, top + 0.07)], 0.014, "#7a5a50", FIRM)
    sill = [(left - 0.3, foot + 0.1), (right + 0.3, foot + 0.1)]
    easel.stroke("Window", 8, sill, 0.1, "#c9ac88", FIRM, [rock("#f3e2c0", 0.9, 0.3, 0.3, 38)])
    easel.stroke("Window", 8, [(x, y - 0.085) for x, y in sill], 0.02, "#fff2d0", FIRM)
    easel.stroke("Window", 8, hatch(_box(left - 0.1, foot - 0.06, X - 0.75, foot + 0.14), 0.03, 1.4), 0.03, "#a5583c", FIRM, [rock("#d88a60", 0.8, 0.2, 0.3, 38)])
    _flowers(easel, left - 0.05, X - 0.8, foot - 0.08, 0.075, 8, "sill", "Window")
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
    easel.touches("Window", 10, [[(x - 0.085, y - 0.37), (x - 0.083, y - 0.368)], [(x + 0.01, y - 0.37), (x + 0.012, y - 0.368)]], 0.012, "#2a2420", FIRM)
    easel.touches("Window", 9, [[(x + 0.02 * k, y - 0.26), (x + 0.045 * k, y - 0.1, 0.3)] for k in (1, 2, 3)], 0.012, "#7a3f1c", HAIR)


def _garden(easel: Easel) -> None:
    chance = dice("studio garden")
    bushes = [(X + 7.6 + chance.gauss(0, 0.5), FOOT + 0.4 + chance.random() * 0.4, chance.uniform(0.5, 1.2)) for _ in range(7)]
    bushes += [(X - 6.4 + chance.gauss(0, 0.4), FOOT + 0.5, chance.uniform(0.4, 0.8)) for _ in range(4)]
    clump(easel, "Studio", bushes, "studio bushes", fine=4)
    rose = hand([(RIGHT - 0.6, FOOT), (RIGHT - 0.9, FOOT - 4), (RIGHT - 0.3, FOOT - 7), (RIGHT - 1.2, FOOT - 10.4), (X + 4.6, FOOT - 13.4)], 0.5, 0.2, 5)
    easel.stroke("Studio", 6, rose, 0.09, "#4c5a38", ROUND)
    for tone, count, size in (("#38583c", 70, 0.24), ("#6c8c46", 60, 0.17), ("#d8566a", 34, 0.15), ("#ffc4c4", 26, 0.08)):
        spots = []
        for _ in range(count):
            x, y, _p = chance.choice(rose)
            x, y = x + chance.gauss(0, 0.4), y + chance.gauss(0, 0.4)
            spots.append([(x, y), (x + 0.1, y + 0.05)])
        easel.touches("Studio", 6, spots, size, tone, ROUND)
