"""The town on the hill: rows of houses from the back to the front, the church, lanes and gardens."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from random import Random

from scene.colour import mix
from scene.easel import FIRM, HAIR, ROUND, SOFT, Easel, Point, hand, hatch, rock, wave
from scene.land import TOWN, clump
from scene.noise import dice, value

PLASTER = ("#e8cfa8", "#dfbd94", "#efdcbf", "#d8ac8c", "#cdb49c", "#e6c9b4")
ROOFS = (("#8f4334", "#cf7350"), ("#7c3a35", "#b9614a"), ("#a2523a", "#dd8a5c"), ("#6c4747", "#a5705f"))
_ROWS = (  # foot, left, right, width of a house
    (422, 946, 1026, 8.0), (433, 916, 1054, 9.0), (445, 898, 1070, 10.0), (458, 888, 1084, 11.5),
    (472, 886, 1090, 13.0), (487, 894, 1086, 14.5),
)  # fmt: skip
NEAR = 50.0  # houses so near to the painter's are looked at closely
STUDIO = (1000.0, 486.0)  # foot of the painter's house, in the middle of the front row
FINE = 4


@dataclass(frozen=True)
class House:
    """`x`, `y`: left and foot of its front; `gable`: whether the gable faces us, or else the eaves."""

    x: float
    y: float
    width: float
    wall: float
    roof: float
    gable: bool
    plaster: str
    tiles: tuple[str, str]

    @property
    def front(self) -> list[Point]:
        right, eaves = self.x + self.width, self.y - self.wall
        peak = [(self.x + self.width / 2, eaves - self.roof)] if self.gable else []
        return [(self.x, self.y), (self.x, eaves), *peak, (right, eaves), (right, self.y)]


def paint(easel: Easel) -> None:
    easel.layer("Town")
    _ground(easel)
    chance = dice("town")
    for k, row in enumerate(_ROWS):
        if k == 2:
            _church(easel, 968, 444)
        houses = list(_row(easel, chance, k, row))
        _shadows(easel, houses)
        paint_houses(easel, houses)
        _edges(easel, houses, chance)
        _windows(easel, houses, chance)
        _gardens(easel, chance, row)


def _ground(easel: Easel) -> None:
    x = TOWN[0]
    lanes = [[(x - 92, 489), (x, 489.5), (x + 96, 488)], [(x + 16, 490), (x + 12, 476), (x + 2, 436)]]
    for lane in lanes:
        easel.stroke("Town", 3, hand(lane, 8, 0.8), 3.4, "#b9a07e", ROUND, [wave("squares", "#e6d2ac", 0.7, 1.5, 12)])


def _row(easel: Easel, chance: Random, k: int, row: tuple[float, float, float, float]) -> Iterator[House]:
    foot, left, right, size = row
    plaster, roofs = (PLASTER[1:3], ROOFS[:2]) if easel.sketch else (PLASTER[k % 2 :: 2], ROOFS)
    x = left
    while x < right:
        width = size * chance.uniform(0.85, 1.2)
        y = foot + 1.6 * value(41, x / 30, k) + abs(x - 985) * 0.02
        if not (k >= 4 and STUDIO[0] - 8.5 - width < x < STUDIO[0] + 8.5):
            yield House(
                x, y, width, size * chance.uniform(0.62, 0.95), size * chance.uniform(0.5, 0.72),
                chance.random() < 0.45, chance.choice(plaster), chance.choice(roofs),
            )  # fmt: skip
        x += width * chance.uniform(1.0, 1.18) + (2.5 if chance.random() < 0.2 else 0)


def _shadows(easel: Easel, houses: list[House]) -> None:
    paths = [[(h.x + 0.8 * h.width, h.y), (h.x + 1.5 * h.width, h.y + 0.6, 0.5)] for h in houses]
    if paths:
        easel.touches("Town", 2, paths, 2.2, "#54505c", SOFT, opacity=0.6, flow=0.6)


def faces(house: House) -> list[tuple[int, str, list[Point]]]:
    """(order, colour, corners) of front, side and roof; the sun is on the left.  Walls are even, roofs are odd."""
    x, y, w = house.x, house.y, house.width
    eaves, peak = y - house.wall, y - house.wall - house.roof
    dim = mix(house.plaster, "#8d7480", 0.34)
    if house.gable:
        back = 0.42 * w
        slope = [(x + w / 2, peak), (x + w / 2 + back, peak - 0.06 * w), (x + w + back, eaves), (x + w, eaves)]
        side = [(x + w, eaves), (x + w + back, eaves - 0.4), (x + w + back, y - 0.8), (x + w, y)]
        return [(0, "#766676", side), (1, mix(house.tiles[0], "#3f3448", 0.35), slope),
                (2, mix(house.plaster, "#fff0c8", 0.2), house.front)]  # fmt: skip
    back, over = 0.2 * w, 0.05 * w
    side = [(x - back, y - 0.5), (x - back, eaves - 0.3), (x - 0.35 * back, peak), (x, eaves), (x, y)]
    left, right = x - 0.35 * back, x + w - 0.35 * back
    slope = [(x - over, eaves + over), (left, peak), (right, peak), (x + w + over, eaves + over)]
    return [(2, "#f6e4be", side), (2, dim, house.front), (3, house.tiles[0], slope)]


def paint_houses(easel: Easel, houses: list[House]) -> None:
    """Houses that stand in a row: what is alike in order and colour is one stroke."""
    alike: dict[tuple[int, str, int], list[list[Point]]] = {}
    for house in houses:
        for order, tone, corners in faces(house):
            by = 0.9 if easel.sketch else 0.5
            alike.setdefault((order, tone, _fine(easel, house.x, house.y)), []).append(hatch(corners, by, 1.55))
    for (order, tone, fine), paths in sorted(alike.items(), key=lambda item: item[0][0]):
        tiles, grain = (
            wave("stripes", mix(tone, "#f0a070", 0.5), 0.7, 0.9, 90),
            rock(mix(tone, "#6b5560", 0.6), 0.55, 2.5, 0.3, 25),
        )
        ink = [tiles] * (fine > 2) if order % 2 else [grain] * (fine > 3)
        easel.touches("Town", fine, paths, 0.9 if easel.sketch else 0.5, tone, FIRM, ink)


def _fine(easel: Easel, x: float, y: float) -> int:
    """Houses are painted finer towards the painter's."""
    if easel.sketch:
        return 1
    return 2 if y < 452 else 4 if abs(x - STUDIO[0]) < NEAR else 3


def _edges(easel: Easel, houses: list[House], chance: Random) -> None:
    """Of a row: barge boards of the gables, ridges in the sun, chimneys."""
    boards, ridges, chimneys = [], [], []
    for h in houses:
        eaves, w = h.y - h.wall, h.width
        peak = eaves - h.roof
        if h.gable:
            left, right = (h.x - 0.05 * w, eaves + 0.05 * w), (h.x + 1.04 * w, eaves + 0.03 * w)
            boards.append([left, (h.x + w / 2, peak - 0.2), right])
        else:
            top = h.x + w * chance.uniform(0.2, 0.7)
            ridges.append([(h.x - 0.07 * w, peak), (h.x + 0.93 * w, peak)])
            chimneys.append([(top, peak + 0.8), (top, peak - 1.1)])
    fine = min(_fine(easel, 0, houses[0].y) + 1, 4)
    easel.touches("Town", fine, boards, 0.4, "#b5674c", FIRM)
    easel.touches("Town", fine, ridges, 0.28, "#e8ac7c", FIRM)
    easel.touches("Town", fine, chimneys, 0.5, "#8a6258", FIRM)


def _windows(easel: Easel, houses: list[House], chance: Random) -> None:
    """All windows of a row: panes dark or lit, bright frames, doors.  Near the painter's house, with more care."""
    dark, lit, frames, doors, near = [], [], [], [], []
    for h in houses:
        floors = 2 if h.wall > 0.72 * h.width else 1
        count = 3 if h.width > 8 else 2
        for floor in range(floors):
            y = h.y - h.wall * ((0.82, 0.36)[floor] if floors == 2 else 0.66)
            for k in range(count):
                x = h.x + h.width * (k + 0.6) / (count + 0.2)
                if k == 1 and floor == floors - 1:
                    doors.append([(x, h.y - 0.4), (x, h.y - 0.32 * h.wall)])
                elif not easel.sketch and h.y > 465 and abs(x - STUDIO[0]) < NEAR:
                    near.append((x, y, chance.random() < 0.3))
                else:
                    frames.append([(x, y), (x, y + 1.1)])
                    (lit if chance.random() < 0.22 else dark).append([(x, y + 0.1), (x, y + 1.0)])
    fine = min(_fine(easel, 0, houses[0].y) + 1, 4)
    if not easel.sketch:
        easel.touches("Town", fine, frames, 0.48, "#f4e3c6", FIRM)
    easel.touches("Town", fine, dark, 0.32, "#48526c", FIRM)
    easel.touches("Town", fine, lit, 0.34, "#f6b95a", FIRM)
    easel.touches("Town", fine, doors, 0.62, "#6e4436", FIRM)
    _near_windows(easel, near)


def _near_windows(easel: Easel, near: list[tuple[float, float, bool]]) -> None:
    """Windows with shutters, frames, bars and sills, in rectangles."""

    def boxes(shift: float, half: float, top: float, foot: float, which=(True, False)) -> list[list[Point]]:
        return [
            hatch([(x + shift - half, y + top), (x + shift + half, y + top), (x + shift + half, y + foot),
                   (x + shift - half, y + foot)], 0.14, 1.5)
            for x, y, lit in near if lit in which
        ]  # fmt: skip

    easel.touches("Town", 5, boxes(-0.95, 0.32, 0, 1.9) + boxes(0.95, 0.32, 0, 1.9), 0.14, "#54716c", FIRM)
    easel.touches("Town", 5, boxes(0, 0.62, -0.05, 1.95), 0.14, "#f6e8cd", FIRM)
    easel.touches("Town", 5, boxes(0, 0.46, 0.1, 1.8, (False,)), 0.14, "#4d5b78", FIRM)
    easel.touches("Town", 5, boxes(0, 0.46, 0.1, 1.8, (True,)), 0.14, "#f2b256", FIRM)
    bars = [[(x, y + 0.1), (x, y + 1.8)] for x, y, _ in near]
    bars += [[(x - 0.5, y + 0.75), (x + 0.5, y + 0.75)] for x, y, _ in near]
    easel.touches("Town", 5, bars, 0.07, "#f6e8cd", FIRM)
    easel.touches("Town", 5, [[(x - 0.9, y + 2.08), (x + 0.9, y + 2.08)] for x, y, _ in near], 0.13, "#c0a68a", FIRM)


def people(easel: Easel) -> None:
    """On the square before the painter's house: a well, and those who meet there."""
    x, y = STUDIO[0] - 13.5, STUDIO[1] + 2.6
    stone = [rock("#e8d8ba", 0.9, 2.5, 0.3, 25)]
    basin = [(x - 2.2, y - 0.2), (x - 2.0, y + 1.0), (x + 2.0, y + 1.0), (x + 2.2, y - 0.2)]
    easel.stroke("Studio", 5, hatch(basin, 0.25, 1.4), 0.25, "#8f8276", FIRM, stone)
    easel.stroke("Studio", 5, [(x - 1.9, y - 0.15), (x + 1.9, y - 0.15)], 0.35, "#7fa5b4", FIRM)
    easel.stroke("Studio", 5, [(x, y), (x, y - 3.0)], 0.35, "#a8988a", FIRM, stone)
    easel.touches(
        "Studio",
        5,
        [hand([(x, y - 2.6), (x + s, y - 2.2), (x + 1.4 * s, y - 0.3)], 0.4) for s in (-1, 1)],
        0.1,
        "#dcecef",
        FIRM,
    )
    folk = (
        (-6.2, 2.4, "#8e3f46", "#3a3444"), (-4.9, 2.7, "#4a6a88", "#e9d8b8"), (5.4, 2.2, "#c9963f", "#5a4038"),
        (10.4, 3.4, "#5f7d54", "#3c3a4c"), (11.5, 3.2, "#e6d3b4", "#96503c"), (-9.6, 4.0, "#6b4f78", "#2e3040"),
    )  # fmt: skip
    shades, heads = [], []
    for dx, dy, coat, skirt in folk:
        fx, fy = STUDIO[0] + dx, STUDIO[1] + dy
        shades.append([(fx + 0.2, fy), (fx + 1.5, fy + 0.25)])
        heads.append([(fx, fy - 1.78), (fx + 0.02, fy - 1.8)])
        legs = [(fx - 0.18, fy - 1.0), (fx + 0.18, fy - 1.0), (fx + 0.38, fy), (fx - 0.38, fy)]
        easel.stroke("Studio", 6, hatch(legs, 0.1, 1.4), 0.1, skirt, FIRM)
        body = [(fx - 0.28, fy - 1.55), (fx + 0.28, fy - 1.55), (fx + 0.2, fy - 0.8), (fx - 0.2, fy - 0.8)]
        easel.stroke("Studio", 6, hatch(body, 0.1, 1.4), 0.1, coat, FIRM)
    easel.touches("Studio", 6, heads, 0.2, "#e3b38e", FIRM)
    hair = [hand([(x - 0.2, y - 0.1), (x, y - 0.22), (x + 0.2, y - 0.1)], 0.1) for ((x, y), _) in heads]
    easel.touches("Studio", 6, hair, 0.1, "#33262a", FIRM)
    easel.touches("Studio", 4, shades, 0.3, "#5c4c56", SOFT, opacity=0.5, flow=0.6)


def _gardens(easel: Easel, chance: Random, row: tuple[float, float, float, float]) -> None:
    foot, left, right, size = row
    trees = [
        (chance.uniform(left, right), foot + chance.uniform(0.5, 2), size * chance.uniform(0.14, 0.3)) for _ in range(9)
    ]
    keep = [t for t in trees if abs(t[0] - STUDIO[0]) > 12 or foot < 450]
    clump(easel, "Town", sorted(keep, key=lambda t: t[1]), f"garden {foot}", fine=2 if foot < 452 else 3, plain=True)


def _church(easel: Easel, x: float, y: float) -> None:
    nave = House(x + 4, y, 22, 11, 8, False, "#ecd9ba", ROOFS[1])
    paint_houses(easel, [nave])
    stone = [rock("#9a8478", 0.6, 2.5, 0.3, 25)]
    tower = [(x - 5, y), (x - 5, y - 30), (x + 4, y - 30), (x + 4, y)]
    easel.stroke("Town", _fine(easel, 0, y), hatch(tower, 0.5, 1.55), 0.5, "#e9d2ac", FIRM, stone)
    shade = [(x + 0.6, y), (x + 0.6, y - 30), (x + 4, y - 30), (x + 4, y)]
    easel.stroke("Town", _fine(easel, 0, y), hatch(shade, 0.5, 1.55), 0.5, "#a18a8a", FIRM, stone)
    slate = [wave("stripes", "#9fb0b8", 0.6, 0.9, 90)]
    spire = [(x - 6, y - 29.5), (x - 0.5, y - 56), (x + 5, y - 29.5)]
    easel.stroke("Town", _fine(easel, 0, y), hatch(spire, 0.45, 1.5), 0.45, "#6c8088", FIRM, slate)
    easel.stroke(
        "Town",
        _fine(easel, 0, y),
        hatch([(x + 0.8, y - 29.5), (x - 0.3, y - 55), (x + 5, y - 29.5)], 0.45, 1.5),
        0.45,
        "#46566a",
        FIRM,
        slate,
    )
    easel.stroke("Town", _fine(easel, 0, y), [(x - 0.5, y - 54), (x - 0.5, y - 60)], 0.22, "#e8c987", FIRM)
    easel.stroke("Town", _fine(easel, 0, y), [(x - 1.7, y - 58.3), (x + 0.7, y - 58.3)], 0.2, "#e8c987", FIRM)
    easel.stroke("Town", _fine(easel, 0, y), [(x - 5.3, y - 30), (x + 4.3, y - 30)], 0.5, "#f6e6c4", FIRM)
    bells = [[(x - 2.6 + 3.4 * k, y - 26.5), (x - 2.6 + 3.4 * k, y - 23)] for k in (0, 1)]
    easel.touches("Town", _fine(easel, 0, y), bells, 0.75, "#3f3c4e", FIRM)
    tall = [[(x + 7.5 + 4.2 * k, y - 8), (x + 7.5 + 4.2 * k, y - 4)] for k in range(4)]
    easel.touches("Town", _fine(easel, 0, y), tall, 0.7, "#4a5470", FIRM)
    easel.touches("Town", _fine(easel, 0, y), [[(x - 0.5, y - 18.2), (x - 0.45, y - 18.2)]], 1.6, "#f2e6cc", FIRM)
    easel.touches(
        "Town",
        5,
        [[(x - 0.5, y - 18.2), (x - 0.5, y - 19.4)], [(x - 0.5, y - 18.2), (x + 0.4, y - 17.8)]],
        0.14,
        "#3c3440",
        HAIR,
    )
