"""What lies behind the tree: paper, sky, hills, a cottage with trees about it, the meadow and a path through it."""

from __future__ import annotations

import math

from orchard.box import Box, Place, Touch, curve

_SKY: tuple[tuple[Place, ...], ...] = (
    (
        *((96, 150, 40), (160, 120, 62), (250, 104, 70), (380, 84, 66), (560, 72, 58), (760, 92, 74)),
        *((930, 84, 72), (1060, 112, 62), (1110, 140, 36)),
    ),
    ((690, 160, 50), (850, 180, 80), (1000, 206, 70), (1080, 236, 48), (1120, 262, 26)),
    ((120, 216, 36), (196, 262, 54), (300, 312, 52), (360, 330, 30)),
    ((740, 310, 26), (820, 312, 44), (930, 326, 52), (1020, 352, 34), (1070, 360, 14)),
    ((112, 424, 10), (190, 436, 26), (280, 448, 26), (360, 440, 14)),
    ((860, 448, 8), (930, 452, 18), (1010, 462, 20), (1080, 456, 9)),
)
_WISPS = ((300, 100), (1060, 190), (960, 350), (250, 300), (800, 100), (240, 440), (1000, 120))
_FAR = (
    *((66, 596), (150, 572), (260, 556), (370, 566), (500, 584), (640, 572), (760, 540)),
    *((880, 516), (970, 520), (1060, 542), (1120, 572), (1152, 598)),
)
_NEAR = ((640, 612), (720, 598), (800, 586), (890, 574), (980, 576), (1060, 590), (1120, 606))
_COPSES = (  # x, half width, height, touches
    *((118, 22, 24, 14), (206, 26, 36, 20), (246, 12, 22, 12), (330, 16, 14, 9), (690, 24, 15, 10)),
    *((806, 26, 34, 20), (846, 24, 24, 14), (975, 26, 16, 10), (1040, 24, 32, 16), (1076, 12, 22, 12)),
)
_ROWS = (  # of the meadow: y, from x to x, radius
    *((642, 92, 1120, 12), (660, 70, 1150, 15), (684, 96, 1128, 18), (712, 58, 1140, 18), (742, 120, 1100, 18)),
    *((772, 150, 1090, 17), (800, 190, 1010, 15), (824, 270, 880, 11)),
)
_PATH: tuple[Place, ...] = (
    *((922, 636, 1.5), (908, 648, 2.6), (918, 662, 4), (938, 678, 5.5), (922, 698, 7), (860, 716, 8.5)),
    *((778, 734, 10), (706, 760, 13), (654, 800, 17), (624, 856, 22)),
)


def paper(box: Box) -> None:
    """Cold-pressed paper, a little warm."""
    box.layer("Paper")
    shapes = [{"shape": "ring", "frequency": 0.09, "width": 0.05}, {"shape": "noise", "b": 1, "strength": 0.14}]
    texture = {"name": "Cold-pressed paper", "maker": "spectrum", "size": [256, 256], "roughness": 0.65, "seed": 3}
    box.lines.append({"do": "texture", **texture, "shapes": shapes})
    ink = {"texture": "Cold-pressed paper", "amount": 0.35, "colour": "#efe9dc", "period": 110}
    brush = {"radius": 160, "hardness": 1, "colour": "#fbf8f0", "dynamics": {}, "ink": [ink]}
    rows = [(0, 100), (1200, 100), (1200, 300), (0, 300), (0, 500), (1200, 500), (1200, 700), (0, 700), (0, 850)]
    box.lines.append({"do": "stroke", "brush": brush, "points": [*map(list, rows), [1200, 850]]})


def sky(box: Box) -> None:
    """Laid into damp paper, at twice the size; the clouds are the paper."""
    box.layer("Sky", 0.46)
    gauss, uniform = box.chance.gauss, box.chance.uniform
    touches = [
        [(x + gauss(0, 5), y + 14 + gauss(0, 9), max(7.0, r * uniform(0.7, 1.15))) for x, y, r in curve(path)]
        for path in _SKY
    ]
    for _ in range(34):
        x, y = box.chance.choice(_WISPS)
        touches.append(box.touch(x + gauss(0, 90), y + 20 + gauss(0, 45), uniform(7, 20), gauss(0, 0.25), 3.2))
    box.wash("sky", touches, level=-1)


def hills(box: Box) -> None:
    for name, wash, top, bottom, opacity in (
        ("Far hills", "violet", _FAR, 604, 0.34),
        ("Near hills", "deep-green", _NEAR, 612, 0.22),
    ):
        box.layer(name, opacity)
        ridge = curve([(x, y + 10, 10) for x, y in top], 3)
        rows = [[(x, y + box.chance.gauss(0, 0.8), r) for x, y, r in ridge]]
        for part in (k / 8 for k in range(1, 9)):
            low = [(x, y + (bottom - y) * part + box.chance.gauss(0, 2.5), 13.0) for x, y, _ in ridge if bottom - y > 0]
            rows += [low] if len(low) > 1 else []
        box.wash(wash, rows)
        box.mend(wash)


def cottage(box: Box) -> None:
    """A cottage among trees at the foot of the hills: its walls are the paper."""
    box.layer("Far trees", 0.5)
    gauss, uniform = box.chance.gauss, box.chance.uniform
    touches = []
    for x, wide, high, count in _COPSES:
        for _ in range(count):
            u, radius = gauss(0, 0.5), uniform(4, 8)
            top = max(0.0, high * (1.0 - 0.8 * u * u) * uniform(-0.15, 1.0))
            touches.append(box.touch(x + u * wide, 625 - radius - top, radius, gauss(1.57, 0.6), 1.3))
    for start, end in ((84, 360), (660, 1110)):
        touches.append(curve([(x, 622 + gauss(0, 1.5), uniform(1.5, 4)) for x in range(start, end, 25)], 2))
    box.wash("deep-green", touches, level=1)
    walls: list[Touch] = [[(914, 606, 5), (930, 606, 5)], [(914, 613, 5), (930, 613, 5)]]
    box.lift(("Far hills", "Near hills", "Far trees"), walls, level=1)
    box.layer("Cottage", 0.85)
    eaves: Touch = [(906, 600, 2.2), (911, 592, 2.2), (932, 592, 2.2), (938, 600, 2.2), (908, 600, 2.2)]
    chimney: Touch = [(927, 588, 1.8), (927, 592, 1.8)]
    box.wash("burnt-sienna", [eaves, [(909, 597, 2.4), (935, 597, 2.4)], chimney], level=1)
    shade_and_door: list[Touch] = [[(932, 605, 2.6), (932, 615, 2.6)], [(917, 610, 1.4), (917, 614, 1.4)]]
    box.wash("violet", shade_and_door, level=1)


def meadow(box: Box) -> None:
    """Broad rows that run dry towards their ends, and a second glaze near the tree."""
    box.layer("Meadow", 0.85)
    gauss, uniform = box.chance.gauss, box.chance.uniform
    touches = [_row(box, *row) for row in _ROWS]
    for start, way in ((110, 1), (1110, -1)):
        for _ in range(22):
            y = uniform(645, 826)
            x = start + way * (gauss(0, 34) + abs(y - 690) * 0.5)
            touches.append(box.touch(x, y, uniform(3, 9), gauss(0, 0.2), 3.4))
    for _ in range(20):
        touches.append(box.touch(gauss(590, 190), gauss(838, 6), uniform(3, 7), gauss(0, 0.15), 4))
    box.wash("spring-green", touches)
    box.mend("spring-green")
    touches = []
    for _ in range(36):
        x, y = gauss(620, 230), uniform(668, 830)
        touches.append(box.touch(x, y, uniform(2.5, 4 + (y - 660) / 23), gauss(0, 0.08), 6, 0.12))
    for _ in range(16):
        touches.append(box.touch(gauss(450, 130), gauss(806, 14), uniform(5, 11), gauss(0, 0.12), 5, 0.12))
    box.wash("olive", touches, 1)


def _row(box: Box, y: float, start: float, end: float, radius: float, count: int = 16) -> Touch:
    gauss, uniform = box.chance.gauss, box.chance.uniform
    phase, start, end = uniform(0, 6), start + gauss(0, 20), end + gauss(0, 20)
    made = []
    for k in range(count):
        slope = 8 * math.sin(0.32 * k - 1) if y < 680 else 0.0
        dry = min(1.0, 0.3 + 0.35 * min(k, count - 1 - k))
        x = start + (end - start) * k / (count - 1) + gauss(0, 9)
        made.append((x, y + slope + 4 * math.sin(phase + 0.8 * k) + gauss(0, 2.5), radius * dry * uniform(0.75, 1.15)))
    return curve(made, 2)


def path(box: Box) -> None:
    """A path that leads to the cottage: the paper, with a thin wash of ochre."""
    gauss, uniform = box.chance.gauss, box.chance.uniform
    way = [(x, y + gauss(0, 0.6), r * uniform(0.92, 1.1)) for x, y, r in curve(_PATH)]
    box.lift(("Meadow",), [way])
    box.layer("Path", 0.32)
    touches: list[Touch] = [[(x, y, 0.6 * r) for x, y, r in way[6:]]]
    for _ in range(16):
        x, y, r = box.chance.choice(way[8:])
        touches.append(box.touch(x + gauss(0, 0.5) * r, y, r * uniform(0.2, 0.5), gauss(0, 0.2), 3))
    box.wash("ochre", touches)


def shadow(box: Box) -> None:
    """What the tree casts on the meadow, with the sun between."""
    box.layer("Shadow", 0.78)
    uniform, gauss = box.chance.uniform, box.chance.gauss
    touches = [curve([(450, 768, 9), (510, 770, 13), (580, 772, 12), (640, 774, 9)], 3)]
    for _ in range(120):
        u, v = box.within()
        if math.hypot(u, v) < 0.9 or box.chance.random() < 0.4:
            x, y = 745 + 285 * u, 776 + 27 * v + 3 * u
            touches.append(box.touch(x, y, uniform(4, 10), gauss(0.02, 0.06), 5, 0.12))
    box.wash("violet", touches)
    box.mend("violet")
    touches = []
    for _ in range(46):
        u, v = box.within()
        x, y = 670 + 200 * u, 778 + 16 * v + 3 * u
        touches.append(box.touch(x, y, uniform(3, 8), gauss(0.02, 0.06), 5, 0.12))
    box.wash("deep-green", touches, 1)
