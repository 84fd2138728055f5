"""Writes orange.jsonl: a peeled orange on a table, its peel hanging over the edge, grown from examples.

    python palettes/gallery/make_orange.py

Needs scipy beside the program, to fill the outlines.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path

from cutting import fruit, table
from cutting.board import Board


def painted() -> Board:
    """The scene, back to front."""
    board = Board(1000, 960)
    table.wall(board)
    table.cloth(board)
    table.shadows(board)
    fruit.whole(board)
    fruit.shadow(board)
    fruit.wedges(board)
    fruit.flesh(board)
    fruit.inside_of_peel(board)
    fruit.peel(board)
    return board


def main() -> None:
    lines = (json.dumps(line, separators=(",", ":")) + "\n" for line in painted().lines)
    (Path(__file__).resolve().parent / "orange.jsonl").write_text("".join(lines), "utf-8")


if __name__ == "__main__":
    sys.exit(main())
