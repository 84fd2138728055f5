"""Writes collage.jsonl: a cat at a window, of torn papers, each grown from an example.

    python palettes/gallery/make_collage.py

Needs scipy beside the program, to fill the outlines.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path

from cutting import window
from cutting.board import Board


def pasted() -> Board:
    """The papers, in the order in which they are pasted."""
    board = Board(1000, 800)
    window.ground(board)
    window.night(board)
    window.village(board)
    window.frame(board)
    window.curtains(board)
    window.pot(board)
    window.cat(board)
    return board


def main() -> None:
    lines = (json.dumps(line, separators=(",", ":")) + "\n" for line in pasted().lines)
    (Path(__file__).resolve().parent / "collage.jsonl").write_text("".join(lines), "utf-8")


if __name__ == "__main__":
    sys.exit(main())
