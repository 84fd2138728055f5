"""The town on the hill: rows of houses from the back to the front, the church, lanes and gardens."""

from __future__ import annotations

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
        houses = list(_row(chance, k, row))
        _shadows(easel, houses)
        for house in houses:
            paint_house(easel, house)
        _edges(easel, houses, chance)
        _windows(easel, houses, chance)
        _gardens(easel, chance, row)


def _ground(easel: Easel) -> None:
    x, y, across, down = TOWN
    rows = []
    for k in range(9):
        v = k / 4 - 1
        half = across * (1 - v * v * 0.8) ** 0.5 * 0.98
        rows.append(hand([(x - half, y + v * down * 0.8), (x, y + v * down * 0.8 - 2), (x + half, y + v * down * 0.8)], 20, 1, k))
    easel.touches("Town", 2, rows, 9, "#b59c6c", ROUND, [rock("#6f8248", 0.9, 12, 0.3, 24)], dynamics={"radius": [[0, 1], [1, 1]]}, opacity=0.9)
    lanes = [[(x - 90, y + 27), (x, y + 26), (x + 95, y + 24)], [(x + 20, y + 50), (x + 14, y + 20), (x + 4, y - 25)]]
    for lane in lanes:
        easel.stroke("Town", 3, hand(lane, 8, 0.8), 3.4, "#b9a07e", ROUND, [wave("squares", "#e6d2ac", 0.7, 1.5, 12)])


def _row(chance: Random, k: int, row: tuple[float, float, float, float]):
    foot, left, right, size = row
    x = left
    while x < right:
        width = size * chance.uniform(0.85, 1.2)
        y = foot + 1.6 * value(41, x / 30, k) + abs(x - 985) * 0.02
        if not (k >= 4 and STUDIO[0] - 8.5 - width < x < STUDIO[0] + 8.5):
            yield House(
                x, y, width, size * chance.uniform(0.62, 0.95), size * chance.uniform(0.5, 0.72),
                chance.random() < 0.45, chance.choice(PLASTER), chance.choice(ROOFS),
            )  # fmt: skip
        x += width * chance.uniform(1.0, 1.18) + (2.5 if chance.random() < 0.2 else 0)


def _shadows(easel: Easel, houses: list[House]) -> None:
    paths = [[(h.x + 0.8 * h.width, h.y), (h.x + 1.5 * h.width, h.y + 0.6, 0.5)] for h in houses]
    if paths:
        easel.touches("Town", 2, paths, 2.2, "#54505c", SOFT, opacity=0.6, flow=0.6)


def paint_house(easel: Easel, house: House) -> None:
    """Front, side and roof; the sun is on the left."""
    x, y, w = house.x, house.y, house.width
    eaves = y - house.wall
    grain = [rock(mix(house.plaster, "#6b5560", 0.6), 0.55, 2.5, 0.3, 25)]
    tiles = [wave("stripes", house.tiles[1], 0.7, 0.9, 90)]
    dim = mix(house.plaster, "#8d7480", 0.34)
    if house.gable:
        peak = eaves - house.roof
        back = 0.42 * w
        slope = [(x + w / 2, peak), (x + w / 2 + back, peak - 0.06 * w), (x + w + back, eaves), (x + w, eaves)]
        side = [(x + w, eaves), (x + w + back, eaves - 0.4), (x + w + back, y - 0.8), (x + w, y)]
        easel.stroke("Town", FINE - easel.sketch, hatch(side, 0.5, 1.55), 0.5, mix(dim, "#4c4660", 0.45), FIRM, grain)
        easel.stroke("Town", FINE - easel.sketch, hatch(slope, 0.5, 1.55), 0.5, mix(house.tiles[0], "#3f3448", 0.35), FIRM, tiles)
        easel.stroke("Town", FINE - easel.sketch, hatch(house.front, 0.5, 1.55), 0.5, mix(house.plaster, "#fff0c8", 0.2), FIRM, grain)
    else:
        ridge = eaves - house.roof
        back = 0.2 * w
        gable = [(x - back, y - 0.5), (x - back, eaves - 0.3), (x - 0.35 * back, ridge), (x, eaves), (x, y)]
        easel.stroke("Town", FINE - easel.sketch, hatch(gable, 0.45, 1.5), 0.45, mix(house.plaster, "#fff2cc", 0.5), FIRM, grain)
        easel.stroke("Town", FINE - easel.sketch, hatch(house.front, 0.5, 1.55), 0.5, dim, FIRM, grain)
        over = 0.05 * w
        slope = [(x - over, eaves + over), (x - 0.35 * back, ridge), (x + w - 0.35 * back, ridge), (x + w + over, eaves + over)]
        easel.stroke("Town", FINE - easel.sketch, hatch(slope, 0.5, 1.55), 0.5, house.tiles[0], FIRM, tiles)


def _edges(easel: Easel, houses: list[House], chance: Random) -> None:
    """Of a row: barge boards of the gables, ridges in the sun, chimneys."""
    boards, ridges, chimneys = [], [], []
    for h in houses:
        eaves, w = h.y - h.wall, h.width
        peak = eaves - h.roof
        if h.gable:
            boards.append([(h.x - 0.05 * w, eaves + 0.05 * w), (h.x + w / 2, peak - 0.2), (h.x + 1.04 * w, eaves + 0.03 * w)])
        else:
            top = h.x + w * chance.uniform(0.2, 0.7)
            ridges.append([(h.x - 0.07 * w, peak), (h.x + 0.93 * w, peak)])
            chimneys.append([(top, peak + 0.8), (top, peak - 1.1)])
    easel.touches("Town", FINE - easel.sketch, boards, 0.4, "#b5674c", FIRM)
    easel.touches("Town", FINE - easel.sketch, ridges, 0.28, "#e8ac7c", FIRM)
    easel.touches("Town", FINE - easel.sketch, chimneys, 0.5, "#8a6258", FIRM)


def _windows(easel: Easel, houses: list[House], chance: Random) -> None:
    """All windows of a row: panes dark or lit, bright frames, doors."""
    dark, lit, frames, doors = [], [], [], []
    for h in houses:
        floors = 2 if h.wall > 0.78 * h.width else 1
        count = 3 if h.width > 8 else 2
        for floor in range(floors):
            y = h.y - h.wall * ((0.72, 0.3)[floor] if floors == 2 else 0.62)
            for k in range(count):
                x = h.x + h.width * (k + 0.6) / (count + 0.2)
                if floor == 1 and k == 1:
                    doors.append([(x, h.y - 0.25), (x, h.y - 0.3 * h.wall)])
                    continue
                frames.append([(x, y), (x, y + 1.1)])
                (lit if chance.random() < 0.22 else dark).append([(x, y + 0.1), (x, y + 1.0)])
    easel.touches("Town", FINE - easel.sketch, frames, 0.48, "#f4e3c6", FIRM)
    easel.touches("Town", FINE - easel.sketch, dark, 0.32, "#48526c", FIRM)
    easel.touches("Town", FINE - easel.sketch, lit, 0.34, "#f6b95a", FIRM)
    easel.touches("Town", FINE - easel.sketch, doors, 0.55, "#6e4436", FIRM)


def _gardens(easel: Easel, chance: Random, row: tuple[float, float, float, float]) -> None:
    foot, left, right, size = row
    trees = [(chance.uniform(left, right), foot + chance.uniform(0.5, 2), size * chance.uniform(0.14, 0.3)) for _ in range(9)]
    keep = [t for t in trees if abs(t[0] - STUDIO[0]) > 12 or foot < 450]
    clump(easel, "Town", sorted(keep, key=lambda t: t[1]), f"garden {foot}", fine=3)


def _church(easel: Easel, x: float, y: float) -> None:
    nave = House(x + 4, y, 22, 11, 8, False, "#ecd9ba", ROOFS[1])
    paint_house(easel, nave)
    stone = [rock("#9a8478", 0.6, 2.5, 0.3, 25)]
    tower = [(x - 5, y), (x - 5, y - 30), (x + 4, y - 30), (x + 4, y)]
    easel.stroke("Town", FINE - easel.sketch, hatch(tower, 0.5, 1.55), 0.5, "#e9d2ac", FIRM, stone)
    shade = [(x + 0.6, y), (x + 0.6, y - 30), (x + 4, y - 30), (x + 4, y)]
    easel.stroke("Town", FINE - easel.sketch, hatch(shade, 0.5, 1.55), 0.5, "#a18a8a", FIRM, stone)
    slate = [wave("stripes", "#9fb0b8", 0.6, 0.9, 90)]
    spire = [(x - 6, y - 29.5), (x - 0.5, y - 56), (x + 5, y - 29.5)]
    easel.stroke("Town", FINE - easel.sketch, hatch(spire, 0.45, 1.5), 0.45, "#6c8088", FIRM, slate)
    easel.stroke("Town", FINE - easel.sketch, hatch([(x + 0.8, y - 29.5), (x - 0.3, y - 55), (x + 5, y - 29.5)], 0.45, 1.5), 0.45, "#46566a", FIRM, slate)
    easel.stroke("Town", FINE - easel.sketch, [(x - 0.5, y - 54), (x - 0.5, y - 60)], 0.22, "#e8c987", FIRM)
    easel.stroke("Town", FINE - easel.sketch, [(x - 1.7, y - 58.3), (x + 0.7, y - 58.3)], 0.2, "#e8c987", FIRM)
    easel.stroke("Town", FINE - easel.sketch, [(x - 5.3, y - 30), (x + 4.3, y - 30)], 0.5, "#f6e6c4", FIRM)
    bells = [[(x - 2.6 + 3.4 * k, y - 26.5), (x - 2.6 + 3.4 * k, y - 23)] for k in (0, 1)]
    easel.touches("Town", FINE - easel.sketch, bells, 0.75, "#3f3c4e", FIRM)
    tall = [[(x + 7.5 + 4.2 * k, y - 8), (x + 7.5 + 4.2 * k, y - 4)] for k in range(4)]
    easel.touches("Town", FINE - easel.sketch, tall, 0.7, "#4a5470", FIRM)
    easel.touches("Town", FINE - easel.sketch, [[(x - 0.5, y - 18.2), (x - 0.45, y - 18.2)]], 1.6, "#f2e6cc", FIRM)
    easel.touches("Town", 5, [[(x - 0.5, y - 18.2), (x - 0.5, y - 19.4)], [(x - 0.5, y - 18.2), (x + 0.4, y - 17.8)]], 0.14, "#3c3440", HAIR)
