"""The real window while it is painted in, with the journal and without, stroke by stroke in turns: `python -m
bench.journalled STROKES FOLDER`.

Prints one JSON object.  The pen moves 125 times a second, and a frame is drawn for what came, as `panning` has it.
"""

from __future__ import annotations

import json
import math
import sys
import time
from pathlib import Path
from typing import Any

from app.input.events import LEFT
from app.loop import SWITCH, opened_window
from app.window import Window
from bench.panning import Hand
from bench.zooming import until
from engine.journal.heads import head_of_new
from engine.journal.journal import Journal
from engine.studio.journalled.posts import Posts
from engine.studio.worker import Worker

MOVES, EVERY = 125, 1 / 125  # of a stroke; seconds between them
TURN = 0.05  # radians of a move
WARM = 2  # strokes of each kind that do not count: kernels are compiled, tiles are made

Frames = list[tuple[float, float]]  # seconds until what the pen did was seen; of them, the thread's processor time


def main(strokes: int, folder: Path) -> dict[str, Any]:
    """By whether there is a journal: for each frame the seconds from the pen's move until it is on the screen, and the
    processor time of the window's thread."""
    window = opened_window()
    window.frame()
    sys.setswitchinterval(SWITCH)
    posts = Posts(Journal(head_of_new(), folder))
    window.connect(lambda _before: Worker(window.pace.told, posts=posts))
    worker = window.engine.worker
    window.pointers.mouse = hand = Hand()
    found: dict[str, Frames] = {"with": [], "without": []}
    try:
        until(window, lambda: window.desk.known.ready and window.desk.known.scene is not None)
        for number in range(2 * (strokes + WARM)):
            kept = "with" if number % 2 else "without"
            worker._posts = posts if number % 2 else None  # what is posted is told to it, or not
            frames = _stroke(window, hand, number // 2)
            found[kept] += frames if number >= 2 * WARM else []
            until(window, lambda: worker.settled)
        size = sum(path.stat().st_size for path in folder.rglob("*") if path.is_file())
    finally:
        worker._posts = posts
        worker.close()
        window.close()
    return {**found, "journal": size}


def _stroke(window: Window, hand: Hand, number: int) -> Frames:
    """A curl of a second; the same one with the journal and without."""
    x, y = 420.0 + 60 * (number % 6), 300.0 + 40 * (number % 5)
    frames: Frames = []
    due = time.perf_counter()
    hand.does("down", (x, y), LEFT)
    for move in range(MOVES):
        due += EVERY
        while (rest := due - time.perf_counter()) > 0:
            window.pace.rest(rest)
        hand.does("move", (x + 2.5 * move * math.cos(TURN * move), y + move * math.sin(TURN * move)))
        spent = time.thread_time()
        window.frame()
        frames.append((time.perf_counter() - due, time.thread_time() - spent))
        due = max(due, time.perf_counter() - EVERY)  # what was missed is not made up for
    hand.does("up", (x, y), LEFT)
    window.frame()
    return frames


if __name__ == "__main__":
    print(json.dumps(main(int(sys.argv[1]), Path(sys.argv[2]))))
