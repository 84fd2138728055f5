"""The collage: a cat on a windowsill, the moon over a village, curtains of tissue."""

from __future__ import annotations

import math
from collections.abc import Sequence

from cutting.board import Board
from cutting.shapes import Spot, box, curve, ellipse, ribbon, torn

_SHADE = "#0e0d14"


def paste(
    board: Board,
    name: str,
    paper: str,
    outlines: Sequence[Sequence[Spot]],
    seed: int,
    by: float = 2.5,
    lift: float = 1.0,
) -> None:
    """A torn piece on its own layer with its shadow, which is the longer the more the piece is lifted."""
    board.layer(name)
    rough = [torn(outline, seed + k, by) for k, outline in enumerate(outlines)]
    for outline in rough if lift else ():
        for reach, part in ((13.0, 0.50), (6.0, 0.40)):
            path = [(x + 4.0 * lift, y + 6.0 * lift) for x, y in [*outline[::2], outline[0]]]
            board.soft(path, reach * lift, _SHADE, part, flow=0.06)
    board.grow(f"torn-{paper}", rough, seed=seed)


def ground(board: Board) -> None:
    """A warm board, and newsprint on it for the wall."""
    board.layer("Board")
    shapes = [{"shape": "ring", "frequency": 0.09, "width": 0.05}, {"shape": "noise", "b": 1, "strength": 0.14}]
    texture = {"name": "Board", "maker": "spectrum", "size": [256, 256], "roughness": 0.65, "seed": 3}
    board.lines.append({"do": "texture", **texture, "shapes": shapes})
    ink = {"texture": "Board", "amount": 0.5, "colour": "#cfc3ad", "period": 90}
    brush = {"radius": 160, "hardness": 1, "colour": "#ddd3bf", "dynamics": {}, "ink": [ink]}
    rows = [(0, 100), (1000, 100), (1000, 300), (0, 300), (0, 500), (1000, 500), (1000, 700), (0, 700)]
    board.lines.append({"do": "stroke", "brush": brush, "points": [list(place) for place in rows]})
    paste(board, "Wall", "headlines", [box(28, 26, 972, 774)], 3, 5.0)
    paste(board, "Wainscot", "sea-paper", [box(30, 716, 970, 770)], 5, 4.0)


def night(board: Board) -> None:
    paste(board, "Sky", "night-paper", [box(168, 62, 832, 600)], 11)
    paste(board, "Halo", "blue-tissue", [ellipse(622, 196, 106, 104)], 13, 7.0, 0.0)
    paste(board, "Moon", "cream-paper", [ellipse(622, 196, 72, 71)], 17, 2.0, 0.8)
    cloud = curve(
        [(596, 254), (650, 236), (706, 246), (764, 230), (830, 240), (824, 268), (740, 264), (680, 276), (616, 270)],
        closed=True,
    )
    low = curve(
        [(190, 200), (250, 178), (330, 190), (400, 176), (470, 196), (400, 212), (310, 206), (240, 222)], closed=True
    )
    paste(board, "Clouds", "blue-tissue", [cloud, low], 19, 3.0, 0.0)
    stars = ((236, 118), (318, 130), (410, 104), (452, 262), (232, 284), (292, 244), (540, 104), (722, 116), (548, 296))
    paste(board, "Stars", "cream-paper", [ellipse(x, y, 7.5, 7) for x, y in stars], 23, 1.5, 0.5)


def village(board: Board) -> None:
    far = curve([(172, 470), (240, 436), (320, 420), (420, 440), (520, 408), (640, 380), (740, 404), (828, 372)])
    paste(board, "Far hills", "sea-paper", [[*far, (828, 598), (172, 598)]], 29)
    near = curve([(172, 540), (260, 512), (380, 520), (500, 500), (600, 486), (720, 500), (828, 470)])
    paste(board, "Near hill", "pine-paper", [[*near, (828, 598), (172, 598)]], 31)
    walls = ((526, 470, 584, 530), (0, 0, 0, 0), (668, 470, 722, 524))
    paste(board, "Houses", "cream-paper", [box(*walls[0]), box(*walls[2])], 37, 1.5, 0.7)
    tower = [(628, 420), (658, 420), (658, 526), (628, 526)]
    paste(board, "Church", "brown-paper", [tower, box(592, 484, 634, 528)], 41, 1.5, 0.7)
    roofs = [[(516, 476), (555, 432), (594, 476)], [(584, 490), (604, 464), (634, 464), (634, 490)]]
    roofs += [[(621, 428), (643, 366), (665, 428)], [(658, 476), (678, 444), (712, 444), (734, 476)]]
    paste(board, "Roofs", "red-paper", roofs, 43, 1.5, 0.7)
    lights = ((541, 498), (568, 510), (643, 452), (686, 498), (708, 500), (611, 508))
    paste(board, "Lights", "ochre-paper", [box(x - 8, y - 9, x + 8, y + 9) for x, y in lights], 47, 1.0, 0.4)


def frame(board: Board) -> None:
    paste(board, "Bars", "cream-paper", [box(489, 64, 513, 600), box(170, 326, 832, 346)], 53, 1.5)
    jambs = [box(140, 52, 182, 606), box(818, 52, 860, 606)]
    paste(board, "Jambs", "cream-paper", jambs, 59, 2.0)
    paste(board, "Lintel", "cream-paper", [box(124, 42, 876, 82)], 61, 2.0)
    paste(board, "Sill", "brown-paper", [box(96, 592, 904, 650)], 67, 3.0, 1.5)


def curtains(board: Board) -> None:
    for side, name in ((-1.0, "Left"), (1.0, "Right")):

        def at(x: float, y: float, side: float = side) -> Spot:
            return (500 + side * (500 - x), y)

        inner = [at(284, 36), at(266, 140), at(226, 260), at(160, 380), at(130, 440), at(150, 500), at(166, 578)]
        outer = [at(62, 578), at(66, 440), at(58, 240), at(62, 36)]
        paste(board, f"{name} curtain", "rose-tissue", [[*curve(inner), *curve(outer)]], 71 + int(side), 3.0, 0.0)
        inner = [at(186, 36), at(180, 140), at(156, 260), at(118, 380), at(104, 440), at(112, 500), at(116, 566)]
        outer = [at(84, 566), at(82, 440), at(98, 240), at(112, 36)]
        paste(board, f"{name} fold", "rose-tissue", [[*curve(inner), *curve(outer)]], 77 + int(side), 2.5, 0.0)
        tie = [at(56, 424), at(140, 428), at(142, 456), at(56, 450)]
        paste(board, f"{name} tie", "ochre-paper", [tie], 83 + int(side), 1.5, 0.7)
    paste(board, "Rod", "black-paper", [box(44, 24, 956, 46)], 89, 2.0)


def pot(board: Board) -> None:
    x = 774
    leaves = [
        _leaf(x, 534, angle, length, 15) for angle, length in ((-2.45, 84), (-2.0, 118), (-1.15, 112), (-0.75, 76))
    ]
    paste(board, "Leaves behind", "sea-paper", leaves[1:3], 97, 1.5)
    paste(board, "Leaves", "pine-paper", [leaves[0], leaves[3]], 101, 1.5)
    stems = [((x - 4, 534), (x - 12, 470), (x - 26, 420)), ((x + 3, 534), (x + 16, 480), (x + 22, 432))]
    paste(board, "Stems", "pine-paper", [ribbon(curve(stem), 4.5) for stem in stems], 103, 0.8, 0.5)
    paste(board, "Flowers", "red-paper", [_flower(x - 30, 404, 38), _flower(x + 24, 424, 33)], 107, 1.5)
    hearts = [ellipse(x - 30, 404, 16, 16), ellipse(x + 24, 424, 14, 14)]
    paste(board, "Hearts", "ochre-paper", hearts, 109, 1.0, 0.5)
    paste(board, "Pot", "red-paper", [[(x - 44, 530), (x + 44, 530), (x + 34, 624), (x - 34, 624)]], 113, 2.0, 1.2)
    paste(board, "Pot's rim", "red-paper", [box(x - 54, 510, x + 54, 538)], 117, 2.0)


def _leaf(x: float, y: float, angle: float, length: float, wide: float) -> list[Spot]:
    c, s = math.cos(angle), math.sin(angle)
    side = (
        (0.0, 0.25),
        (0.3, 0.85),
        (0.6, 0.95),
        (0.85, 0.5),
        (1.0, 0.0),
        (0.85, -0.5),
        (0.6, -0.95),
        (0.3, -0.85),
        (0.0, -0.25),
    )
    return [(x + c * length * t - s * wide * v, y + s * length * t + c * wide * v) for t, v in curve(side)]


def _flower(x: float, y: float, radius: float) -> list[Spot]:
    angles = [2.0 * math.pi * k / 80 for k in range(80)]
    return [
        (
            x + radius * (0.84 + 0.2 * math.cos(5 * a)) * math.cos(a),
            y + radius * (0.84 + 0.2 * math.cos(5 * a)) * math.sin(a),
        )
        for a in angles
    ]


def cat(board: Board) -> None:
    x, y = 352.0, 0.0
    body = [(-40, 380), (-58, 430), (-84, 490), (-112, 552), (-120, 598), (-96, 628), (0, 634), (96, 628), (120, 598)]
    body += [(112, 552), (84, 490), (62, 430), (46, 380), (2, 366)]
    head = [(-66, 352), (-62, 318), (-58, 262), (-30, 296), (4, 290), (38, 292), (66, 256), (74, 316), (78, 352)]
    head += [(62, 388), (6, 402), (-50, 388)]
    head_ = [*curve([(x + a, b) for a, b in head[:3]], 6), *curve([(x + a, b) for a, b in head[2:7]], 6)]
    head_ += curve([(x + a, b) for a, b in [*head[6:], head[0]]], 6)
    tail = ribbon(
        curve([(x + 70, 612), (x + 118, 632), (x + 128, 690), (x + 96, 734), (x + 112, 762), (x + 146, 752)]),
        15.0,
        11.0,
    )
    paste(
        board, "Cat", "black-paper", [curve([(x + a, y + b) for a, b in body], closed=True), head_, tail], 127, 1.8, 1.5
    )
    collar = [(-50, 398), (4, 412), (60, 396), (62, 412), (6, 430), (-54, 414)]
    paste(board, "Collar", "red-paper", [[(x + a, b) for a, b in collar]], 131, 1.0, 0.6)
