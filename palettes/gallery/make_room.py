"""Writes room.jsonl: a room with a tiled floor, a window, and on the wall a picture of the room, and so on.

python palettes/gallery/make_room.py
"""

from __future__ import annotations

import json
import sys
from pathlib import Path

from interior.furniture import bench, frame, plate, shade
from interior.sheet import FLOOR, HEIGHT, PICTURE, SMALLER, WIDTH, Sheet, box
from interior.shell import floor, panelling, view, wall, window

SHELL, FURNITURE = (wall, panelling, view, window, floor), (frame, plate, bench, shade)


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
    for part in (*SHELL, *FURNITURE, light, itself):
        part(sheet)
    told = (json.dumps(line, separators=(",", ":")) + "\n" for line in sheet.lines)
    (Path(__file__).resolve().parent / "room.jsonl").write_text("".join(told), "utf-8")


if __name__ == "__main__":
    sys.exit(main())
