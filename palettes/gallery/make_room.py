"""Writes room.jsonl: a room with a tiled floor, a window, and on the wall a picture of the room, and so on.

python palettes/gallery/make_room.py
"""

from __future__ import annotations

import json
import math
import random
import sys
from pathlib import Path
from typing import Any

WIDTH, HEIGHT = 1024, 768  # of the frame, pixels of level 0
LEVEL, FINER = 2, 4  # the level that most is painted at, and its pixels to one of level 0
FLOOR = 548  # where the floor meets the wall
PICTURE, SMALLER = (604, 150), 2  # the corner of what hangs on the wall, and by how many levels it is smaller
WINDOW = (96, 84, 356, 420)
Point = tuple[float, ...]  # x, y, perhaps the pressure
TEXTURES = {
    "Oak": {
        "size": [256, 256],
        "roughness": 0.6,
        "seed": 16,
        "shapes": [{"shape": "wedge", "angle": 0, "spread": 5, "from": 0.01, "to": 0.08, "slope": 1}],
    },
    "Grain": {
        "size": [256, 256],
        "roughness": 0.6,
        "seed": 21,
        "shapes": [{"shape": "wedge", "angle": 90, "spread": 5, "from": 0.01, "to": 0.08, "slope": 1}],
    },
    "Plaster": {
        "size": [256, 256],
        "roughness": 0.65,
        "seed": 8,
        "shapes": [{"shape": "noise", "b": 1.3, "from": 0.02, "to": 0.25}],
    },
    "Moss": {
        "size": [256, 256],
        "roughness": 0.65,
        "seed": 39,
        "shapes": [{"shape": "ring", "frequency": 0.06, "width": 0.04}],
    },
}


class Sheet:
    """The lines of the recording."""

    def __init__(self) -> None:
        self.lines: list[dict[str, Any]] = [
            {"inkfall": 2, "frame": [0, 0, WIDTH, HEIGHT], "seed": 5, "paper": "#d9cbb0"}
        ]
        self.nodes = 0  # in the root
        for name, told in TEXTURES.items():
            self.lines.append({"do": "texture", "name": name, "maker": "spectrum", **told})

    def layer(self, name: str, **members: Any) -> None:
        self.add(name)
        if members:
            self.lines.append({"do": "layer", "set": name, **members})

    def add(self, name: str, **members: Any) -> None:
        """On top of all."""
        self.lines.append({"do": "layer", "add": name, **members, "group": None, "to": self.nodes})
        self.nodes += 1

    def region(self, points: list[Point], feather: float = 0, level: int = LEVEL, op: str = "replace") -> None:
        """Selects what a line goes round."""
        scale = 2.0**level
        outline = [[round(x * scale, 1), round(y * scale, 1)] for x, y, *_ in points]
        told: dict[str, Any] = {"do": "select", "outline": outline, "level": level}
        told |= {"op": op} if op != "replace" else {}
        self.lines.append(told | ({"feather": feather * scale} if feather else {}))

    def fill(self, points: list[Point], feather: float = 0, level: int = LEVEL, **brush: Any) -> None:
        """Fills what a line goes round, on the active layer."""
        self.region(points, feather, level)
        self.lines.append({"do": "fill", "level": level, "brush": brush})

    def stroke(self, points: list[Point], radius: float, symmetry: dict[str, Any] | None = None, **brush: Any) -> None:
        """A line on the active layer, where nothing is selected."""
        told = {"hardness": 0.9, "spacing": 0.15, **brush, "radius": round(radius * FINER, 2)}
        places = [[round(x * FINER, 1), round(y * FINER, 1), *rest] for x, y, *rest in points]
        command = {"do": "stroke", "level": LEVEL, "points": places, "brush": told}
        self.lines.append(command | ({"symmetry": symmetry} if symmetry else {}))

    def gradient(self, name: str, start: Point, end: Point, *colours: str, kind: str = "linear") -> None:
        ramp = [[round(n / (len(colours) - 1), 3), colour] for n, colour in enumerate(colours)]
        told = {"kind": kind, "from": list(start), "to": list(end), "ramp": ramp}
        self.lines.append({"do": "texture", "name": name, "maker": "gradient", **told})

    def all_free(self) -> None:
        """Nothing is selected any more."""
        self.lines.append({"do": "select", "none": True})


def box(x0: float, y0: float, x1: float, y1: float) -> list[Point]:
    return [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]


def ring(x: float, y: float, radius: float, steps: int = 72, high: float = 1.0) -> list[Point]:
    turns = (2 * math.pi * step / steps for step in range(steps + 1))
    return [(x + radius * math.cos(turn), y + high * radius * math.sin(turn)) for turn in turns]


def ink(texture: str, colour: str, amount: float, period: float) -> dict[str, Any]:
    return {"texture": texture, "colour": colour, "amount": amount, "period": round(period, 1)}


def wall(sheet: Sheet) -> None:
    sheet.layer("Wall")
    sheet.gradient("day", (80, 200), (1010, 420), "#efe2c2", "#dcc79d", "#b39a73")
    sheet.fill(
        box(-8, -8, WIDTH + 8, FLOOR + 8),
        0,
        1,
        colour="#dcc79d",
        ink=[{"texture": "day"}, ink("Plaster", "#8d7650", 0.22, 300), ink("rock", "#fff4d8", 0.14, 420)],
    )


def panelling(sheet: Sheet) -> None:
    """The lower part of the wall."""
    top = FLOOR - 96
    sheet.layer("Panels")
    wood = {"colour": "#6f7f74", "ink": [ink("Oak", "#3d4a44", 0.45, 420), ink("rock", "#90a093", 0.3, 300)]}
    sheet.fill(box(-8, top, WIDTH + 8, FLOOR + 2), 0, 1, **{**wood, "ink": [ink("Oak", "#3d4a44", 0.45, 210)]})
    sheet.fill(box(-8, top - 8, WIDTH + 8, top + 2), colour="#94a397", ink=[ink("Grain", "#5a685e", 0.4, 420)])
    sheet.fill(box(-8, top + 2, WIDTH + 8, top + 6), 1, colour="#38433d")
    sheet.fill(box(-8, FLOOR - 16, WIDTH + 8, FLOOR), colour="#7f8f84", ink=[ink("Grain", "#45524a", 0.4, 420)])
    sheet.fill(box(-8, FLOOR - 18, WIDTH + 8, FLOOR - 16), 0.6, colour="#a9b7ab")
    for n in range(-1, 9):
        x = 22 + 128 * n
        sheet.fill(box(x, top + 18, x + 100, FLOOR - 28), 0.8, colour="#4b5850")
        sheet.fill(box(x + 3, top + 21, x + 100, FLOOR - 28), 0.6, colour="#98a79b")
        sheet.fill(
            box(x + 3, top + 21, x + 97, FLOOR - 31), 0.4, colour="#78887c", ink=[ink("Oak", "#4a5850", 0.5, 260)]
        )


def view(sheet: Sheet) -> None:
    """What is seen through the window: evening, hills, cypresses."""
    x0, y0, x1, y1 = WINDOW
    told = random.Random(3)
    sheet.layer("View")
    sheet.gradient("sky", (220, y0), (220, y1 - 90), "#5f8fae", "#a9c4c0", "#f3dfae", "#f6c98a")
    sheet.fill(box(x0, y0, x1, y1), 0, colour="#a9c4c0", ink=[{"texture": "sky"}])
    sheet.fill(ring(268, 236, 21), 1.5, colour="#fff3cf")
    for y, rise, light, dark, period in (
        (286, 20, "#9db0a0", "#7d9488", 200),
        (312, 15, "#7f9a72", "#54724f", 170),
        (344, 12, "#8fa04f", "#4c6a32", 130),
        (378, 8, "#a58f45", "#5d6a2c", 100),
    ):
        edge = [
            (x, y - rise * math.sin(x / 41 + y) - 0.4 * rise * math.sin(x / 17 + 2 * y)) for x in range(x0, x1 + 1, 4)
        ]
        sheet.fill([*edge, (x1, y1), (x0, y1)], 0.7, colour=light, ink=[ink("Moss", dark, 0.75, period)])
        for _ in range(5 if y < 370 else 0):
            x = told.uniform(x0 + 10, x1 - 10)
            high = told.uniform(0.05, 0.09) * y
            foot = y + 3 - rise * math.sin(x / 41 + y) - 0.4 * rise * math.sin(x / 17 + 2 * y)
            tree = [
                (x - high * 0.14, foot),
                (x - high * 0.17, foot - high * 0.4),
                (x, foot - high),
                (x + high * 0.17, foot - high * 0.4),
                (x + high * 0.14, foot),
            ]
            sheet.fill(tree, 0.7, colour="#2f4a35", ink=[ink("Moss", "#14261c", 0.7, 40)])


def window(sheet: Sheet) -> None:
    x0, y0, x1, y1 = WINDOW
    sheet.layer("Window")
    bar = {"colour": "#e8dcc0", "ink": [ink("Oak", "#a58d63", 0.45, 300)]}
    flat = {"colour": "#efe4ca", "ink": [ink("Grain", "#a58d63", 0.45, 300)]}
    sheet.fill(box(x0 - 22, y0 - 22, x0 + 4, y1 + 8), 0.4, **bar)
    sheet.fill(box(x1 - 4, y0 - 22, x1 + 22, y1 + 8), 0.4, **bar)
    sheet.fill(box(x0 - 28, y0 - 28, x1 + 28, y0 + 4), 0.4, **flat)
    sheet.fill(box((x0 + x1) / 2 - 7, y0, (x0 + x1) / 2 + 7, y1), 0.4, **bar)
    for y in (y0 + 112, y0 + 224):
        sheet.fill(box(x0, y - 5, x1, y + 5), 0.4, **flat)
    sheet.fill(box(x0 - 40, y1 - 2, x1 + 40, y1 + 20), 0.4, **flat)
    dark = {"colour": "#5d4d33"}
    for edge in (
        box(x0 - 24, y0 - 22, x0 - 22, y1),
        box(x1 + 22, y0 - 22, x1 + 25, y1),
        box(x0 - 40, y1 + 20, x1 + 42, y1 + 24),
        box(x0 + 4, y0 + 4, x0 + 6, y1),
        box((x0 + x1) / 2 + 7, y0, (x0 + x1) / 2 + 9, y1),
    ):
        sheet.fill(edge, 1, **dark)
    sheet.fill(box(x0, y0 + 4, x1, y0 + 9), 2.5, **dark)


def floor(sheet: Sheet) -> None:
    """A tile that is painted on a torus, and laid in rows that are ever larger to the front."""
    wide, high = 128, 40
    sheet.layer("Tile", wrap=[0, 0, 0, wide, high])
    sheet.fill(
        box(0, 0, wide, high),
        colour="#b5673f",
        ink=[ink("rock", "#7c3a22", 0.75, 128), ink("rock", "#d99a68", 0.3, 64)],
    )
    sheet.all_free()
    for points in ([(0, 0), (wide, 0)], [(0, 0), (0, high)]):
        sheet.stroke([(*p, 1) for p in points], 1.3, colour="#5b3a2c", hardness=0.6)
    sheet.stroke([(4, 2.4, 1), (wide - 3, 2.4, 1)], 0.7, colour="#e3ac7c", opacity=0.7)
    sheet.stroke([(*p, 1) for p in ring(64, 20, 15, 60, 0.62)], 1.2, colour="#f0d9a8")
    sheet.fill(ring(64, 20, 12, 48, 0.62), 0.5, colour="#3f6f73", ink=[ink("rock", "#1e4448", 0.6, 60)])
    sheet.fill(ring(64, 20, 4.5, 32, 0.62), 0.4, colour="#f0d9a8")
    for corner in (0, wide):
        for y in (0, high):
            sheet.fill(
                [(corner - 22, y), (corner, y - 13), (corner + 22, y), (corner, y + 13)],
                0.4,
                colour="#ead6ab",
                ink=[ink("rock", "#b79a66", 0.6, 80)],
            )
    sheet.all_free()
    sheet.lines.append({"do": "layer", "set": "Tile", "visible": False})
    sheet.add("Floor", kind="group")
    y, scale, row = float(FLOOR), 0.5, 0
    while y < HEIGHT:
        deep = high * scale
        name, group = f"tiles {row + 1}", f"row {row + 1}"
        sheet.lines.append({"do": "layer", "add": group, "kind": "group", "group": "Floor"})
        at = [round(WIDTH / 2 + (row % 2) * wide * scale / 2), round(y)]
        levels = math.floor(math.log2(scale))
        laid = {"kind": "placement", "of": "Tile", "rect": [0, 0, 0, wide, high], "repeat": True, "group": group}
        sheet.lines.append(
            {"do": "layer", "add": name, **laid, "at": at, "levels": levels, "c": [scale / 2.0**levels, 0]}
        )
        end = y + deep
        sheet.region(box(-8, round(y), WIDTH + 8, round(end)))
        sheet.lines.append({"do": "layer", "set": group, "mask": True})
        y, scale, row = end, scale * 1.24, row + 1
    sheet.all_free()


def frame(sheet: Sheet) -> None:
    """The moulding around the picture on the wall."""
    (x0, y0), thick = PICTURE, 30
    x1, y1 = x0 + (WIDTH >> SMALLER), y0 + (HEIGHT >> SMALLER)
    sheet.layer("Frame")
    sheet.fill(
        box(x0 - thick + 10, y0 - thick + 16, x1 + thick + 16, y1 + thick + 26), 12, colour="#5a4527", opacity=0.6
    )
    for out, light, dark in (
        (thick, "#8a5a2c", "#3f2410"),
        (thick - 6, "#c1914a", "#6d4517"),
        (10, "#7a4c22", "#341c0b"),
    ):
        for texture, side in (
            ("Grain", [(x0 - out, y0 - out), (x1 + out, y0 - out), (x1, y0), (x0, y0)]),
            ("Grain", [(x0 - out, y1 + out), (x1 + out, y1 + out), (x1, y1), (x0, y1)]),
            ("Oak", [(x0 - out, y0 - out), (x0, y0), (x0, y1), (x0 - out, y1 + out)]),
            ("Oak", [(x1 + out, y0 - out), (x1, y0), (x1, y1), (x1 + out, y1 + out)]),
        ):
            sheet.fill(side, 0.3, colour=light, ink=[ink(texture, dark, 0.6, 300)])
    for points, colour in (
        ([(x0 - thick, y0 - thick), (x1 + thick, y0 - thick)], "#e0b878"),
        ([(x0 - thick, y0 - thick), (x0 - thick, y1 + thick)], "#d0a566"),
        ([(x0 - thick, y1 + thick), (x1 + thick, y1 + thick)], "#2b1708"),
        ([(x1 + thick, y0 - thick), (x1 + thick, y1 + thick)], "#2b1708"),
    ):
        sheet.all_free()
        sheet.stroke([(*p, 1) for p in points], 1.1, colour=colour)


def plate(sheet: Sheet) -> None:
    """A painted plate, drawn with symmetry."""
    x, y, size = 482, 196, 46
    sheet.layer("Plate")
    sheet.fill(ring(x + 6, y + 10, size), 7, colour="#5a4527", opacity=0.6)
    sheet.fill(ring(x, y, size), 0.4, colour="#f1e6cd", ink=[ink("rock", "#cdbb92", 0.4, 120)])
    sheet.all_free()
    for n, (radius, colour, wide) in enumerate(
        ((size - 2, "#2e5f7d", 1.4), (size - 7, "#2e5f7d", 0.6), (22, "#c1763a", 0.9))
    ):
        sheet.stroke([(*p, 1) for p in ring(x, y, radius)], wide, colour=colour, opacity=1 - 0.1 * n)
    turned = {"centre": [x * FINER, y * FINER], "count": 8, "mirror": True}
    petal = [
        (x + 7 + 14 * t, y + 6 * math.sin(math.pi * t), 0.3 + 0.7 * math.sin(math.pi * t))
        for t in (n / 16 for n in range(17))
    ]
    thin = {"dynamics": {"radius": [[0, 0.3], [1, 1]]}}
    sheet.stroke(petal, 1.5, turned, colour="#2e5f7d", **thin)
    sheet.stroke([(x + 31, y, 1)], 3.2, {**turned, "mirror": False}, colour="#c1763a")
    sheet.stroke(
        [(x + 26 + 9 * t, y + 5 + 5 * t, 1 - t) for t in (n / 8 for n in range(9))],
        1.4,
        turned,
        colour="#5b8a5a",
        **thin,
    )
    sheet.stroke([(x, y, 1)], 4, colour="#c1763a")


def bench(sheet: Sheet) -> None:
    """A bench under the picture, on it a jug with twigs."""
    sheet.layer("Bench")
    sheet.fill([(556, 640), (900, 640), (960, 676), (590, 676)], 9, colour="#2a1a12", opacity=0.75)
    wood = {"colour": "#8f6238", "ink": [ink("Grain", "#4a2a13", 0.65, 380)]}
    leg = {"colour": "#6d4626", "ink": [ink("Oak", "#331b0b", 0.65, 200)]}
    for x in (572, 860):
        sheet.fill([(x, 520), (x + 26, 520), (x + 22, 650), (x + 4, 650)], 0.4, **leg)
        sheet.fill([(x + 18, 520), (x + 26, 520), (x + 22, 650), (x + 17, 650)], 2, colour="#2b170a", opacity=0.8)
    sheet.fill(box(580, 530, 880, 552), 0.4, colour="#6d4626", ink=[ink("Grain", "#331b0b", 0.65, 300)])
    sheet.fill(box(580, 528, 880, 536), 3, colour="#241308", opacity=0.8)
    sheet.fill([(566, 492), (900, 492), (916, 514), (550, 514)], 0.4, **{**wood, "colour": "#b5834c"})
    sheet.fill(box(550, 514, 916, 528), 0.4, **wood)
    jug = [
        (650, 508),
        (638, 480),
        (640, 452),
        (654, 434),
        (656, 420),
        (650, 410),
        (690, 410),
        (684, 420),
        (686, 434),
        (702, 452),
        (704, 480),
        (692, 508),
    ]
    sheet.fill([(650, 500), (700, 496), (772, 508), (700, 514), (652, 512)], 4, colour="#3a2212", opacity=0.8)
    sheet.fill(
        rounded(jug), 0.5, colour="#3f6f73", ink=[ink("rock", "#1e4448", 0.5, 160), ink("Plaster", "#7fb0a8", 0.3, 200)]
    )
    sheet.fill(
        rounded([(688, 414), (690, 436), (704, 456), (704, 482), (692, 508), (676, 508), (690, 478), (684, 440)]),
        4,
        colour="#12292c",
        opacity=0.7,
    )
    sheet.fill(rounded([(648, 450), (656, 440), (654, 470), (648, 482)]), 2.5, colour="#cfe6dc", opacity=0.7)
    for x, size, colour, dark in (
        (780, 17, "#c9803a", "#7d3f14"),
        (812, 16, "#b8452f", "#5c150e"),
        (797, 15, "#d3a03f", "#7d5214"),
    ):
        y = 510 - size if size != 15 else 484
        sheet.fill(ring(x + 8, 511, size, 40, 0.25), 3, colour="#3a2212", opacity=0.7)
        sheet.fill(ring(x, y, size), 0.6, colour=colour, ink=[ink("rock", dark, 0.5, 70)])
        sheet.fill(ring(x - 5, y - 5, size / 3), 3, colour="#fff0cf", opacity=0.6)
    twigs(sheet)


def twigs(sheet: Sheet) -> None:
    told = random.Random(8)
    sheet.all_free()
    thin = {"dynamics": {"radius": [[0, 0.2], [1, 1]]}}
    for lean in (-46, -20, 6, 34, 58):
        tall = told.uniform(42, 64)
        stem = [(670 + lean * t * t, 414 - tall * t, 1 - 0.6 * t) for t in (n / 12 for n in range(13))]
        sheet.stroke(stem, 1.6, colour="#4a3b22", **thin)
        for n in range(4, 13):
            x, y, _ = stem[n]
            for side in (-1, 1):
                angle = math.atan2(-tall, lean * 1.6) + side * told.uniform(0.5, 1.0)
                long = told.uniform(9, 15)
                leaf = [
                    (
                        x + long * t * math.cos(angle),
                        y + long * t * math.sin(angle),
                        math.sin(math.pi * (0.08 + 0.92 * t)),
                    )
                    for t in (k / 6 for k in range(7))
                ]
                colour = told.choice(("#6f8a4a", "#56743c", "#8fa35a", "#3f5c33"))
                sheet.stroke(leaf, 2.9, colour=colour, ink=[ink("Moss", "#2c4424", 0.5, 60)], **thin)


def rounded(points: list[Point], times: int = 3) -> list[Point]:
    """The same line with its corners cut."""
    for _ in range(times):
        pairs = zip(points, [*points[1:], points[0]], strict=True)
        points = [(a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1])) for a, b in pairs for part in (0.25, 0.75)]
    return points


def shade(sheet: Sheet) -> None:
    sheet.layer("Shade", blend="multiply")
    sheet.gradient("dusk", (300, 200), (1040, 820), "#ffffff", "#e9dccb", "#8f7768")
    sheet.fill(box(-8, -8, WIDTH + 8, HEIGHT + 8), 0, 1, colour="#ffffff", ink=[{"texture": "dusk"}])
    sheet.fill(box(-40, FLOOR - 3, WIDTH + 40, FLOOR + 10), 7, colour="#6b5647", opacity=0.8)
    sheet.gradient("corner", (0, 60), (0, -60), "#ffffff", "#a58f78")
    sheet.fill(box(-40, -60, WIDTH + 40, 10), 18, colour="#b9a48c", opacity=0.7)


def light(sheet: Sheet) -> None:
    """What falls through the panes onto wall and floor."""
    sheet.layer("Light", blend="screen", opacity=0.62)
    sheet.gradient("fall", (300, 560), (640, 780), "#ffcf7d", "#8d5a24", "#2a1808")
    pane = {"colour": "#000000", "ink": [{"texture": "fall"}]}
    for row in range(2):
        for column in range(2):
            y0, y1 = FLOOR + 14 + 98 * row, FLOOR + 98 + 98 * row + 12 * row
            left, wide, lean = 236 + 118 * column, 96, 0.92
            points = [
                (left + lean * (y - FLOOR) + side * wide * (1 + 0.0022 * (y - FLOOR)), y)
                for y, side in ((y0, 0), (y0, 1), (y1, 1), (y1, 0))
            ]
            sheet.fill(points, 3, **pane)
    sheet.gradient("glow", (226, 250), (640, 300), "#7a5a2c", "#3a2812", "#000000", kind="radial")
    sheet.fill(box(-8, -8, 700, FLOOR), 40, 1, colour="#000000", ink=[{"texture": "glow"}], opacity=0.6)
    sheet.all_free()


def itself(sheet: Sheet) -> None:
    """The whole painting once more on the wall, and the way there."""
    x, y = PICTURE
    shown = {"kind": "placement", "of": None, "rect": [0, 0, 0, WIDTH, HEIGHT]}
    view = {"size": [WIDTH, HEIGHT]}
    sheet.add("The room", **shown, at=[x, y], levels=-SMALLER)
    sheet.lines += [
        {"do": "bookmark", "name": "out", "level": 0, "origin": [0, 0], **view},
        {"do": "bookmark", "name": "in", "level": SMALLER, "origin": [x << SMALLER, y << SMALLER], **view},
    ]


def main() -> None:
    sheet = Sheet()
    for part in (wall, panelling, view, window, floor, frame, plate, bench, shade, light, itself):
        part(sheet)
    told = (json.dumps(line, separators=(",", ":")) + "\n" for line in sheet.lines)
    (Path(__file__).resolve().parent / "room.jsonl").write_text("".join(told), "utf-8")


if __name__ == "__main__":
    sys.exit(main())
