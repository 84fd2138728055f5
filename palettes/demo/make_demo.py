"""Writes the bundled demo: demo.jsonl, a landscape as a recording, and demo.json, the places of its zoom series.

    python palettes/demo/make_demo.py

The same files come out on every machine.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path

from scene import foreground, lake, land, mountains, sky, studio, town, window
from scene.easel import HEIGHT, WIDTH, Easel

FOLDER = Path(__file__).resolve().parent
STOPS = (  # of the zoom series: level, middle in level-0 pixels
    (0, (640.0, 400.0)), (2, (1000.0, 470.0)), (4, (1000.0, 473.0)), (6, (1000.0, 473.6)), (8, (1000.0, 472.12)),
    (10, (1000.42, 472.05)), (12, window.inside(880.0, 420.0)),
)  # fmt: skip


def landscape(easel: Easel) -> None:
    """The scene, bottom to top; the studio holds a picture of it."""
    for part in (sky, mountains, lake, land, town):
        part.paint(easel)
    studio.paint(easel, landscape)
    foreground.paint(easel)
    if not easel.sketch:
        foreground.light(easel)


def main() -> None:
    easel = Easel()
    landscape(easel)
    header = {"inkfall": 1, "frame": [0, 0, WIDTH, HEIGHT], "seed": 7}
    ending = (
        {"do": "layer", "select": "Foreground"},  # whoever paints on sees the colour that was chosen, as it is
        {"do": "view", "level": 0, "origin": [0, 0], "size": [WIDTH, HEIGHT]},
    )
    lines = [header, *easel.lines, *ending]
    text = "".join(json.dumps(line, separators=(",", ":")) + "\n" for line in lines)
    (FOLDER / "demo.jsonl").write_text(text, "utf-8")
    places = [
        [level, round(x * 2**level) - WIDTH // 2, round(y * 2**level) - HEIGHT // 2, WIDTH, HEIGHT]
        for level, (x, y) in STOPS
    ]
    (FOLDER / "demo.json").write_text(json.dumps({"zoom": places}) + "\n", "utf-8")


if __name__ == "__main__":
    sys.exit(main())
