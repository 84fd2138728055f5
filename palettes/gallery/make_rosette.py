"""Writes rosette.jsonl: a rosette drawn with symmetry, its petals filled with rock, that contains itself in its middle.

python palettes/gallery/make_rosette.py
"""

from __future__ import annotations

import json
import math
import sys
from pathlib import Path
from typing import Any

SIDE, MIDDLE = 1024, 512  # of the frame, pixels of level 0
FINER = 4  # pixels of the level that it is painted at, LEVEL, to one of level 0
LEVEL = 2
AROUND = 480  # pixels of LEVEL on each side of a fill in which its region is looked for
CREAM, NIGHT, GOLD = "#f3ead8", "#1d2c46", "#e9c46a"
Point = tuple[float, float, float]  # x, y, pressure


class Sheet:
    """The lines of the recording."""

    def __init__(self) -> None:
        self.lines: list[dict[str, Any]] = [
            {"inkfall": 2, "frame": [0, 0, SIDE, SIDE], "seed": 11, "paper": CREAM},
            *({"do": "layer", "add": name} for name in ("Night", "Colour", "Lines")),
        ]

    def stroke(self, points: list[Point], radius: float, parts: int = 1, mirror: bool = True, **brush: Any) -> None:
        """A line, again in each of `parts` parts of a turn; everything in pixels of level 0."""
        told = {"colour": CREAM, "hardness": 0.9, "spacing": 0.15, **brush, "radius": radius * FINER}
        command: dict[str, Any] = {"do": "stroke", "level": LEVEL, "layer": "Lines", "brush": told}
        command["points"] = [[round(x * FINER, 1), round(y * FINER, 1), round(p, 3)] for x, y, p in points]
        if parts > 1:
            command["symmetry"] = {"centre": [MIDDLE * FINER] * 2, "count": parts, "mirror": mirror}
        self.lines.append(command)

    def fill(self, radius: float, degrees: float, **brush: Any) -> None:
        """The region of the lines around a place, in polar coordinates, on the layer below them."""
        x, y = (round(value * FINER) for value in polar(radius, degrees))
        rect = [x - AROUND, y - AROUND, 2 * AROUND, 2 * AROUND]
        like = {"at": [x, y], "level": LEVEL, "rect": rect, "tolerance": 0.3, "gap": 6, "of": "Lines"}
        self.lines.append({"do": "fill", "like": like, "layer": "Colour", "brush": brush})


def polar(radius: float, degrees: float) -> tuple[float, float]:
    return MIDDLE + radius * math.cos(math.radians(degrees)), MIDDLE + radius * math.sin(math.radians(degrees))


def swelling(part: float) -> float:
    """The pen's pressure along the side of a petal, 0..1."""
    return 0.25 + 0.75 * math.sin(math.pi * part)


def petal(inner: float, outer: float, bend: float, steps: int = 40) -> list[Point]:
    """One side of a petal to the right of the middle."""
    long, found = outer - inner, []
    for part in (step / steps for step in range(steps + 1)):
        found.append((MIDDLE + inner + long * part, MIDDLE + long * bend * math.sin(math.pi * part), swelling(part)))
    return found


def ring(x: float, y: float, radius: float, steps: int = 40) -> list[Point]:
    turns = (2 * math.pi * step / steps for step in range(steps + 1))
    return [(x + radius * math.cos(turn), y + radius * math.sin(turn), 1.0) for turn in turns]


def rock(light: str, dark: str, period: float) -> dict[str, Any]:
    """A brush of a colour with rock in it."""
    return {"colour": light, "ink": [{"texture": "rock", "amount": 0.8, "period": period * FINER, "colour": dark}]}


def ground(sheet: Sheet) -> None:
    deep = {"texture": "rock", "amount": 0.5, "period": 220, "colour": "#0d1626"}
    brush = {"colour": "#20304a", "ink": [deep]}
    like = {"at": [5, 5], "of": None, "tolerance": 0.02}
    sheet.lines.append({"do": "fill", "like": like, "open": True, "layer": "Night", "brush": brush})


def lines(sheet: Sheet) -> None:
    thin = {"dynamics": {"radius": [[0, 0.25], [1, 1]]}}
    for inner, outer, parts, bend in ((96, 196, 8, 0.33), (196, 330, 8, 0.30), (330, 470, 16, 0.22)):
        sheet.stroke(petal(inner, outer, bend), 3.2, parts, **thin)
    for radius, width in ((96, 2.6), (330, 1.8), (484, 2.6), (500, 2.6)):
        sheet.stroke(ring(MIDDLE, MIDDLE, radius, 200), width)
    for radius, degrees, size, width, parts in (
        (258, 0, 13, 1.8, 8),
        (270, 22.5, 20, 2.2, 8),
        (415, 11.25, 11, 1.8, 16),
    ):
        sheet.stroke(ring(*polar(radius, degrees), size), width, parts)


def colours(sheet: Sheet) -> None:
    for part in range(8):
        turn = 45 * part
        sheet.fill(150, turn, **rock("#b8452f", "#5c150e", 60))
        sheet.fill(290, turn, **rock("#e3a13a", "#8a4a0e", 90))
        sheet.fill(258, turn, colour=CREAM)
        sheet.fill(270, turn + 22.5, **rock("#3f8f8a", "#0f3b3c", 30))
    for part in range(16):
        turn = 22.5 * part
        sheet.fill(380, turn, **rock("#5e7fae", "#1e3658", 80))
        sheet.fill(415, turn + 11.25, **rock("#d9776a", "#7d2a23", 26))


def dots(sheet: Sheet) -> None:
    for radius, degrees, size, colour, parts in (
        (212, 22.5, 5, CREAM, 8), (300, 22.5, 4, GOLD, 8), (318, 11, 3.2, CREAM, 16), (450, 11.25, 5, GOLD, 16),
        (360, 11.25, 3.5, CREAM, 16), (492, 2.8125, 2.6, GOLD, 64),
    ):  # fmt: skip
        sheet.stroke([(*polar(radius, degrees), 1.0)], size, parts, False, colour=colour)


def itself(sheet: Sheet) -> None:
    """The whole painting once more in its middle, an eighth as large; one colour where the two meet."""
    sheet.fill(0, 0, colour=NIGHT)
    outside = {"at": [20, 20], "level": LEVEL, "tolerance": 0.3, "of": "Lines"}
    sheet.lines.append({"do": "fill", "like": outside, "open": True, "layer": "Colour", "brush": {"colour": NIGHT}})
    corner, view = MIDDLE - SIDE // 16, {"size": [SIDE, SIDE]}
    sheet.lines += [
        {"do": "layer", "add": "Itself", "kind": "placement", "of": None, "rect": [0, 0, 0, SIDE, SIDE],
         "at": [corner] * 2, "levels": -3},
        {"do": "bookmark", "name": "out", "level": 0, "origin": [0, 0], **view},
        {"do": "bookmark", "name": "in", "level": 3, "origin": [corner * 8] * 2, **view},
    ]  # fmt: skip


def main() -> None:
    sheet = Sheet()
    for part in (ground, lines, colours, dots, itself):
        part(sheet)
    told = (json.dumps(line, separators=(",", ":")) + "\n" for line in sheet.lines)
    (Path(__file__).resolve().parent / "rosette.jsonl").write_text("".join(told), "utf-8")


if __name__ == "__main__":
    sys.exit(main())
