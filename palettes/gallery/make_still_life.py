"""Writes still-life.jsonl: a painting of 250,000 pixels from less than 10,000 points of the pen, all of it with the
bundled brushes.

    python palettes/gallery/make_still_life.py

The same file comes out on every machine.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path

from scene import bowl, cloth, fruit, jug, light, olive, room
from scene.easel import SIZE, Easel


def painted() -> Easel:
    """The scene, back to front."""
    easel = Easel()
    room.wall(easel)
    light.on_wall(easel)
    olive.shadow(easel)
    room.table(easel)
    room.shadows(easel)
    jug.jug(easel)
    jug.mouth(easel)
    olive.branches(easel)
    jug.lip(easel)
    bowl.bowl(easel)
    cloth.cloth(easel)
    for pear in fruit.PEARS:
        fruit.pear(easel, pear)
    fruit.plum(easel, (462, 420), 16.0, 6)
    olive.fallen(easel)
    light.over_all(easel)
    return easel


def main() -> None:
    header = {"inkfall": 1, "frame": [0, 0, SIZE, SIZE], "seed": 7}
    lines = (json.dumps(line, separators=(",", ":")) + "\n" for line in (header, *painted().lines))
    (Path(__file__).resolve().parent / "still-life.jsonl").write_text("".join(lines), "utf-8")


if __name__ == "__main__":
    sys.exit(main())
