"""The painter's house: a front to be looked at from near, and behind its window, much finer, the painter at work.

On the painter's canvas stands this whole scene again, painted 2^11 times as fine.
"""

from __future__ import annotations

from collections.abc import Callable

from scene import room
from scene.easel import FIRM, HAIR, ROUND, SOFT, Easel, Point, hand, hatch, rock, wave
from scene.land import clump
from scene.noise import dice
from scene.town import people
from scene.window import CANVAS, DEEPER, EAVES, FOOT, LEFT, PEAK, RIGHT, WINDOW, X, box


def paint(easel: Easel, scene: Callable[[Easel], None]) -> None:
    easel.layer("Studio")
    _square(easel)
    if not easel.sketch:
        behind = [
            (X - 9.6, FOOT - 2, 2.2),
            (X - 8.2, FOOT - 1, 1.5),
            (X - 8.9, FOOT - 5, 1.9),
            (X + 11.6, FOOT - 1.5, 1.6),
        ]
        clump(easel, "Studio", behind, "behind", fine=5)
    _front(easel)
    _timbers(easel)
    if not easel.sketch:
        _casements(easel)
    _roof(easel)
    _opening(easel)
    if easel.sketch:
        return
    _door(easel)
    _garden(easel)
    people(easel)
    room.behind(easel)
    easel.layer("Picture")
    scene(easel.within(DEEPER, CANVAS, "Picture"))
    easel.layer("Window")
    room.in_front(easel)


def _square(easel: Easel) -> None:
    """The paved place before the house."""
    paving = [wave("squares", "#ecd8b2", 0.7, 0.8, 30)]
    ground = [(X - 17, FOOT - 1.2), (X + 18, FOOT - 1.2), (X + 22, FOOT + 5), (X - 20, FOOT + 5)]
    easel.stroke("Studio", 4, hatch(ground, 0.6, 1.3), 0.6, "#bfa37c", FIRM, paving)
    edge = hand([(X - 20, FOOT + 5.1), (X, FOOT + 5.4), (X + 22, FOOT + 5.1)], 1.5, 0.15)
    easel.stroke("Studio", 4, edge, 0.45, "#8a7a64", ROUND)
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
    easel.stroke(
        "Studio",
        5,
        hatch(box(LEFT, FOOT - 1.3, RIGHT, FOOT), 0.2, 1.3),
        0.2,
        "#a08c80",
        FIRM,
        [wave("squares", "#cdb9a0", 0.6, 1.1)],
    )


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
    easel.touches(
        "Studio", 6, [[(x + 0.09, y + 0.09) for x, y in beam] for beam in beams], 0.2, "#8a6c66", FIRM, opacity=0.5
    )
    easel.touches("Studio", 6, beams, 0.19, "#5b3a32", FIRM, wood)
    easel.touches(
        "Studio", 6, [[(x - 0.1, y - 0.1) for x, y in beam] for beam in beams], 0.05, "#b98a62", HAIR, opacity=0.8
    )


def _casements(easel: Easel) -> None:
    """Windows with shutters, curtains and boxes of flowers."""
    places = ((X - 5.6, 477.0, 0), (X - 1.0, 477.0, 1), (X + 3.5, 477.0, 0), (X + 1.2, 481.8, 1))

    def boxes(
        left: float, top: float, right: float, foot: float, by: float, which: tuple = (0, 1)
    ) -> list[list[Point]]:
        return [hatch(box(x + left, y + top, x + right, y + foot), by, 1.4) for x, y, lit in places if lit in which]

    slats = [wave("stripes", "#8fae9c", 0.7, 0.18, 90)]
    easel.touches(
        "Studio", 6, boxes(-0.95, 0, -0.12, 2.6, 0.07) + boxes(2.02, 0, 2.85, 2.6, 0.07), 0.07, "#476a66", FIRM, slats
    )
    easel.touches("Studio", 6, boxes(-0.06, -0.1, 1.96, 2.7, 0.08), 0.08, "#f3e6cc", FIRM)
    for lit, pane, sheen in ((0, "#4b5a78", "#9fb4cc"), (1, "#e8a552", "#ffe9b0")):
        easel.touches("Studio", 6, boxes(0.12, 0.1, 1.78, 2.5, 0.07, (lit,)), 0.07, pane, FIRM)
        gleams = [[(x + 0.3, y + 2.1), (x + 1.4, y + 0.3)] for x, y, on in places if on == lit]
        easel.touches("Studio", 6, gleams, 0.28, sheen, SOFT, opacity=0.6)
    curtains = []
    for x, y, _ in places:
        for side, way in ((x + 0.15, 1), (x + 1.75, -1)):
            for k in range(3):
                fall = [(side + way * 0.13 * k, y + 0.15), (side + way * (0.1 * k + 0.02), y + 1.6 - 0.3 * k)]
                curtains.append(hand(fall, 0.3, 0.02, k))
    easel.touches("Studio", 6, curtains, 0.075, "#f6ead6", ROUND, opacity=0.85)
    bars = [[(x + 0.95, y), (x + 0.95, y + 2.6)] for x, y, _ in places] + [
        [(x, y + 0.9), (x + 1.9, y + 0.9)] for x, y, _ in places
    ]
    easel.touches("Studio", 6, bars, 0.06, "#fff6e2", FIRM)
    easel.touches("Studio", 6, boxes(-0.2, 2.7, 2.1, 3.1, 0.06), 0.06, "#7a4c3a", FIRM)
    room.geraniums(easel, [(x - 0.15, x + 2.05, y + 2.72) for x, y, _ in places], 0.13, 6)


def _door(easel: Easel) -> None:
    left, top, right = X - 4.0, 481.9, X - 1.6
    arch = [(left, FOOT), (left, top + 0.7), ((left + right) / 2, top - 0.2), (right, top + 0.7), (right, FOOT)]
    easel.stroke(
        "Studio",
        6,
        hatch(
            [(x + (0.3 if x > X - 2.8 else -0.3) * (x != (left + right) / 2), y - 0.3 * (y < FOOT)) for x, y in arch],
            0.1,
            1.4,
        ),
        0.1,
        "#b7a48e",
        FIRM,
    )
    easel.stroke("Studio", 6, hatch(arch, 0.09, 1.4), 0.09, "#6a3f30", FIRM, [wave("stripes", "#9a6446", 0.8, 0.42)])
    easel.touches("Studio", 6, [[(left + 0.5, 483.2), (left + 0.5, 483.3)]], 0.13, "#f0c872", FIRM)
    easel.touches("Studio", 6, [[(left - 0.5, 482.6), (left - 0.5, 483.1)]], 0.22, "#ffdf94", FIRM)
    easel.stroke("Studio", 5, [(left - 0.5, 482.8), (left - 0.45, 482.9)], 1.6, "#ffc870", SOFT, opacity=0.5, flow=0.5)


def _roof(easel: Easel) -> None:
    """The far slope, then barge boards over the gable."""
    tiles = [wave("stripes", "#b9614a", 0.7, 0.6, 82)]
    slope = [(X, PEAK - 0.5), (X + 4, PEAK - 1.0), (RIGHT + 4.4, EAVES + 0.2), (RIGHT + 0.9, EAVES + 1.0)]
    easel.stroke("Studio", 5, hatch(slope, 0.25, 1.3), 0.25, "#6f3a3c", FIRM, tiles)
    verge = [(LEFT - 1.0, EAVES + 1.2), (X, PEAK - 0.4), (RIGHT + 1.0, EAVES + 1.2)]
    easel.stroke("Studio", 6, verge, 0.34, "#7a4638", FIRM)
    easel.stroke("Studio", 6, [(x - 0.16, y - 0.18) for x, y in verge[:2]], 0.11, "#f0b888", FIRM)
    easel.stroke("Studio", 6, [(x + 0.16, y - 0.22) for x, y in verge[1:]], 0.09, "#b87458", FIRM)
    teeth = []
    for k in range(1, 24):
        for (ax, ay), (bx, by) in ((verge[0], verge[1]), (verge[1], verge[2])):
            x, y = ax + (bx - ax) * k / 24, ay + (by - ay) * k / 24
            teeth.append([(x, y + 0.36), (x, y + 0.42)])
    easel.touches("Studio", 6, teeth, 0.12, "#7a4638", FIRM)
    chimney = box(X + 4.4, PEAK - 0.2, X + 6.0, PEAK + 4.6)
    easel.stroke("Studio", 5, hatch(chimney, 0.15, 1.3), 0.15, "#8f5a4c", FIRM, [wave("squares", "#c98a6c", 0.6, 0.5)])
    smoke = hand(
        [(X + 5.2, PEAK - 0.6, 0.2), (X + 4.8, PEAK - 3, 0.5), (X + 6.8, PEAK - 6, 0.8), (X + 6.2, PEAK - 10, 1.0)],
        0.6,
        0.4,
        3,
    )
    easel.stroke("Studio", 3, smoke, 1.6, "#efe4da", SOFT, opacity=0.4, flow=0.15)


def _opening(easel: Easel) -> None:
    left, top, right, foot = WINDOW
    easel.stroke(
        "Studio",
        6,
        hatch(box(left - 0.2, top - 0.2, right + 0.2, foot + 0.16), 0.1, 1.4),
        0.1,
        "#d9c3a0",
        FIRM,
        [rock("#9a7c6c", 0.7, 0.8, 0.3, 26)],
    )
    easel.stroke("Studio", 7, hatch(box(left, top, right, foot), 0.06, 1.4), 0.06, "#a5683c", FIRM)
    easel.stroke("Studio", 6, [(left + 0.9, top + 0.8), (X + 0.8, top + 1.1)], 0.9, "#ffd488", SOFT, opacity=0.8)


def _garden(easel: Easel) -> None:
    chance = dice("studio garden")
    bushes = [
        (X + 7.6 + chance.gauss(0, 0.5), FOOT + 0.4 + chance.random() * 0.4, chance.uniform(0.5, 1.2)) for _ in range(7)
    ]
    bushes += [(X - 6.4 + chance.gauss(0, 0.4), FOOT + 0.5, chance.uniform(0.4, 0.8)) for _ in range(4)]
    clump(easel, "Studio", bushes, "studio bushes", fine=4)
    rose = hand(
        [
            (RIGHT - 0.6, FOOT),
            (RIGHT - 0.9, FOOT - 4),
            (RIGHT - 0.3, FOOT - 7),
            (RIGHT - 1.2, FOOT - 10.4),
            (X + 4.6, FOOT - 13.4),
        ],
        0.5,
        0.2,
        5,
    )
    easel.stroke("Studio", 6, rose, 0.09, "#4c5a38", ROUND)
    for tone, count, size in (
        ("#38583c", 70, 0.24),
        ("#6c8c46", 60, 0.17),
        ("#d8566a", 34, 0.15),
        ("#ffc4c4", 26, 0.08),
    ):
        spots = []
        for _ in range(count):
            x, y, _p = chance.choice(rose)
            x, y = x + chance.gauss(0, 0.4), y + chance.gauss(0, 0.4)
            spots.append([(x, y), (x + 0.1, y + 0.05)])
        easel.touches("Studio", 6, spots, size, tone, ROUND)
