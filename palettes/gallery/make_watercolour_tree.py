"""Writes watercolour-tree.jsonl: a tree painted by laying washes over one another, each grown from an example.

    python palettes/gallery/make_watercolour_tree.py

Needs scipy beside the program, to find where a wash would close.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path

from orchard import land, tree
from orchard.box import HEIGHT, WIDTH, Box


def painted() -> Box:
    """The scene, in the order of its washes."""
    box = Box(31)
    land.paper(box)
    land.sky(box)
    land.hills(box)
    land.cottage(box)
    land.meadow(box)
    land.path(box)
    land.shadow(box)
    tree.first_leaves(box)
    tree.wood(box)
    tree.glazes(box)
    tree.blossom(box)
    tree.grass(box)
    return box


def main() -> None:
    header = {"inkfall": 1, "frame": [0, 0, WIDTH, HEIGHT], "seed": 7}
    lines = (json.dumps(line, separators=(",", ":")) + "\n" for line in (header, *painted().lines))
    (Path(__file__).resolve().parent / "watercolour-tree.jsonl").write_text("".join(lines), "utf-8")


if __name__ == "__main__":
    sys.exit(main())
