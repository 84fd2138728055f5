"""The apple tree: a first wash of leaves, the wood, two glazes of shade over both, blossom kept white and tinted."""

from __future__ import annotations

import math
from collections.abc import Callable

from orchard.box import Box, Place, Touch, curve

_BOUGHS = (  # where the leaves are: middle, half width and half height
    *((300, 300, 130, 84), (405, 190, 132, 84), (550, 135, 132, 74), (695, 198, 128, 84), (795, 315, 112, 76)),
    *((620, 290, 120, 78), (450, 318, 105, 62), (235, 405, 92, 48), (715, 418, 108, 50), (565, 415, 70, 36)),
    (360, 400, 70, 36),
)
_STEM: Touch = [
    *((410, 786, 10), (432, 768, 24), (446, 735, 25), (450, 700, 24), (452, 660, 24)),
    *((462, 620, 22), (474, 580, 22), (478, 550, 22)),
]
_WOOD: tuple[tuple[Place, ...], ...] = (
    tuple(_STEM),
    ((378, 790, 2), (398, 782, 7), (420, 768, 13), (436, 744, 18)),
    ((502, 788, 2), (484, 778, 7), (468, 762, 13), (458, 736, 18)),
    ((448, 796, 4), (450, 780, 11), (450, 760, 18)),
    (
        *((474, 568, 20), (452, 525, 16), (430, 490, 13), (392, 452, 11), (356, 420, 8.5)),
        *((322, 372, 6.5), (300, 330, 4.5), (262, 292, 2)),
    ),
    (
        *((478, 560, 21), (488, 510, 17), (494, 450, 14), (516, 390, 11), (524, 320, 8.5)),
        *((546, 250, 6), (544, 190, 4.5), (562, 128, 2)),
    ),
    (
        *((484, 556, 16), (530, 506, 13), (566, 478, 12), (610, 430, 10), (662, 398, 8)),
        *((700, 346, 6.5), (760, 306, 4), (806, 262, 1.5)),
    ),
    ((500, 440, 9), (474, 390, 7.5), (456, 330, 5.5), (424, 270, 4), (410, 205, 2.5), (392, 150, 1.2)),
    ((600, 438, 7), (648, 436, 5.5), (700, 418, 4.5), (760, 414, 3), (800, 420, 1.2)),
    ((522, 338, 7), (570, 292, 5.5), (628, 252, 4.5), (676, 200, 3), (722, 168, 1.2)),
    ((384, 444, 6), (334, 434, 4.5), (280, 422, 3.5), (216, 424, 1.2)),
    ((668, 392, 5), (710, 384, 4), (764, 364, 3), (820, 352, 1.2)),
    ((442, 306, 4), (392, 284, 3), (330, 280, 1.2)),
    ((548, 236, 4), (590, 190, 3), (618, 150, 1.2)),
    ((318, 366, 4), (278, 356, 3), (236, 330, 1.2)),
)
_SHADE: tuple[Place, ...] = (
    *((470, 776, 0), (464, 735, 10), (464, 690, 10), (465, 650, 9)),
    *((475, 610, 8.5), (487, 575, 8), (492, 546, 5), (494, 520, 0)),
)
_TUFTS = (  # x, y, blades, length
    *((404, 790, 7, 18), (424, 797, 6, 14), (446, 800, 5, 12), (474, 796, 6, 16), (492, 792, 5, 13), (300, 800, 5, 13)),
    *((330, 806, 4, 10), (232, 790, 3, 10), (700, 812, 4, 11), (742, 806, 5, 12), (850, 806, 3, 9)),
)


def first_leaves(box: Box) -> None:
    """The lightest wash over all of the crown, with single leaves about it."""
    box.layer("Leaves")
    gauss, uniform = box.chance.gauss, box.chance.uniform
    for x, y, wide, high in _BOUGHS:
        size, touches = math.sqrt(wide * high / 9500), []
        for _ in range(round(8 * size)):
            u, v = box.within()
            place = x + 0.74 * u * wide, y + 0.7 * v * high, uniform(24, 42) * size
            touches += _clump(box, place, 8, (10, 23), (4, 8), 14)
        box.wash("spring-green", touches)
    touches = []
    for x, y, wide, high in _BOUGHS * 9:
        angle, far = uniform(0, 2 * math.pi), gauss(1.16, 0.12)
        place = x + wide * far * math.cos(angle), y + high * far * math.sin(angle)
        touches.append(box.touch(*place, uniform(2.5, 5.5), uniform(0, 2 * math.pi), 1.9))
    box.wash("spring-green", touches)
    box.mend("spring-green")


def _clump(
    box: Box, place: Place, count: int, large: tuple[float, float], small: tuple[float, float], leaves: int
) -> list[Touch]:
    """Touches that run into each other, and single leaves around them."""
    (x, y, size), made = place, []
    for _ in range(count):
        u, v = box.within()
        radius = box.chance.uniform(*large) * (1.0 - 0.4 * math.hypot(u, v))
        angle = math.atan2(v, u) + box.chance.gauss(0.25, 0.6)
        made.append(box.touch(x + 1.15 * u * size, y + 0.75 * v * size, radius, angle))
    for _ in range(leaves):
        angle, far = box.chance.uniform(0, 2 * math.pi), size * box.chance.gauss(1.36, 0.2)
        at = x + 1.25 * far * math.cos(angle), y + 0.85 * far * math.sin(angle)
        made.append(box.touch(*at, box.chance.uniform(*small), angle + box.chance.gauss(0.25, 0.6), 2.0))
    return made


def wood(box: Box) -> None:
    """Trunk and branches, the side away from the light, and the bark's cracks."""
    box.lift(("Far hills", "Meadow"), [curve([(x, y, r - 5) for x, y, r in _STEM[2:]], 3)])
    box.layer("Wood", 0.92)
    gauss, uniform = box.chance.gauss, box.chance.uniform
    box.wash("bark", [curve(branch) for branch in _WOOD])
    box.mend("bark")
    touches = [curve(_SHADE, 2)]
    for _ in range(22):
        y = uniform(570, 770)
        touches.append(box.touch(_trunk(y) + gauss(2, 8), y, uniform(2, 4.5), gauss(1.45, 0.15), 5, 0.15))
    box.wash("bark", touches, 1)
    touches = []
    for _ in range(30):
        y = uniform(560, 780)
        touches.append(box.touch(_trunk(y) + gauss(0, 10), y, uniform(1.4, 2.8), gauss(1.45, 0.12), 7, 0.15))
    box.wash("bark", touches, 2, level=1)


def _trunk(y: float) -> float:
    """The middle of the trunk at a height."""
    return 452 + max(0.0, 640 - y) * 0.28


def glazes(box: Box) -> None:
    """Leaves in half light and in shade, ever more towards the lower right."""
    box.select("Leaves")
    _glaze(box, "olive", 1, (5, 0.6, 1.4), lambda u, v: (0.22 + 0.6 * u, 0.32 + 0.45 * v), (18, 36), (7, 17))
    _glaze(box, "deep-green", 2, (3.6, 0.3, 1.5), lambda u, v: (0.25 + 0.55 * u, 0.45 + 0.35 * v), (9, 26), (4, 9))


def _glaze(
    box: Box,
    wash: str,
    depth: int,
    often: tuple[float, float, float],
    place: Callable[[float, float], tuple[float, float]],
    size: tuple[float, float],
    large: tuple[float, float],
) -> None:
    """`often`: clumps to a bough, and how many times as many in the light and in the shade."""
    for x, y, wide, high in _BOUGHS:
        scale, touches = math.sqrt(wide * high / 9500), []
        shade = min(1.0, max(0.0, 0.42 + (x - 520) / 620 + (y - 300) / 420))
        for _ in range(round(often[0] * scale * (often[1] + (often[2] - often[1]) * shade))):
            u, v = place(*box.within())
            part = box.chance.uniform(0.5, 1.3)
            at = x + u * wide, y + v * high, box.chance.uniform(*size) * scale * part
            touches += _clump(box, at, round(8 * part), large, (3, 6.5), 13)
        if touches:
            box.wash(wash, touches, depth)
    box.mend(wash, depth)


def blossom(box: Box) -> None:
    """Flowers of five petals, on the side of the light and away from the branches; some petals have fallen."""
    gauss, uniform = box.chance.gauss, box.chance.uniform
    wood = [place for branch in _WOOD for place in curve(branch) if place[2] > 3.2]
    petals: list[Touch] = []
    halos: list[Touch] = []
    hearts: list[Touch] = []
    while len(hearts) < 42:
        x, y, wide, high = box.chance.choice(_BOUGHS)
        angle, far = gauss(3.9, 1.5), uniform(0.4, 1.0)
        x, y = x + wide * far * math.cos(angle), y + high * far * math.sin(angle)
        if not box.covered("spring-green", x, y) or min(math.hypot(x - a, y - b) for a, b, _ in wood) < 26:
            continue
        for _ in range(box.chance.choice((1, 1, 1, 2, 3))):
            at = x + gauss(0, 13), y + gauss(0, 10), uniform(3.2, 5.4)
            flower = _flower(box, *at)
            petals += flower
            halos += [[(a, b, r * uniform(0.75, 1.1)) for a, b, r in petal] for petal in flower]
            halos.append([(*at[:2], 0.8 * at[2]), (at[0] + 1, at[1], 0.8 * at[2])])
            hearts.append([(at[0] - 0.5, at[1], 1.3), (at[0] + 0.6, at[1], 1.3)])
    box.lift(("Leaves",), halos)
    box.layer("Blossom", 0.85)
    fallen = [box.touch(gauss(500, 150), uniform(770, 832), uniform(2, 3.6), gauss(0, 0.3), 1.2) for _ in range(36)]
    box.wash("blossom", petals + fallen, level=1)
    box.wash("ochre", hearts, 1, level=1)


def _flower(box: Box, x: float, y: float, size: float) -> list[Touch]:
    """Petals about a place, seen a little from the side."""
    turn, flat, made = box.chance.uniform(0, 2 * math.pi), box.chance.uniform(0.7, 1.0), []
    for k in range(5):
        angle, radius = turn + 0.4 * math.pi * k + box.chance.gauss(0, 0.12), size * box.chance.uniform(0.75, 0.95)
        across, down = math.cos(angle), flat * math.sin(angle)
        places = ((0.5 * size, 0.35 * radius), (1.3 * size, radius), (1.3 * size + 0.3 * radius, 0.7 * radius))
        made.append([(x + across * far, y + down * far, r) for far, r in places])
    return made


def grass(box: Box) -> None:
    """Blades at the foot of the tree, and a few further off."""
    box.layer("Grass", 0.9)
    gauss, uniform = box.chance.gauss, box.chance.uniform
    blades: list[Touch] = []
    for x, y, count, length in _TUFTS:
        for _ in range(count):
            a, b = x + gauss(0, 6), y + gauss(0, 2)
            up, high, bent = gauss(-1.57, 0.4), length * uniform(0.6, 1.2), gauss(0.15, 0.3)
            middle = a + 0.5 * high * math.cos(up), b + 0.5 * high * math.sin(up), 2.2
            blades.append([(a, b, 2.6), middle, (a + high * math.cos(up + bent), b + high * math.sin(up + bent), 0.0)])
    box.chance.shuffle(blades)
    box.wash("olive", blades[:36], level=1)
    box.wash("deep-green", blades[36:], 1, level=1)
