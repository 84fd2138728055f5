"""What the room is written down on, its measures and its textures."""

from __future__ import annotations

import math
from typing import Any

WIDTH, HEIGHT = 1024, 768  # of the frame, pixels of level 0
LEVEL, FINER = 2, 4  # the level that most is painted at, and its pixels to one of level 0
FLOOR = 548  # where the floor meets the wall
PICTURE, SMALLER = (604, 150), 2  # the corner of what hangs on the wall, and by how many levels it is smaller
WINDOW = (96, 84, 356, 420)
EYE, DEEP = (512, 250), 0.9  # where lines away from us end, and how much smaller what lies behind the wall is for that
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


def behind(*points: Point) -> list[Point]:
    """The same on the far side of the wall."""
    return [(round(EYE[0] + DEEP * (x - EYE[0]), 2), round(EYE[1] + DEEP * (y - EYE[1]), 2)) for x, y, *_ in points]


def rounded(points: list[Point], times: int = 3) -> list[Point]:
    """The same line with its corners cut."""
    for _ in range(times):
        pairs = zip(points, [*points[1:], points[0]], strict=True)
        points = [(a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1])) for a, b in pairs for part in (0.25, 0.75)]
    return points
