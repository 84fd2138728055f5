"""A painter without a window, in a process of its own, that is killed while it paints.

`python headless.py FOLDER SEED [FILE [loaded]]` paints, once the engine is loaded or at once, until it is killed, and
tells on standard output what it has posted: "up N" after the pen was lifted N times, "ask N" after N commands.
"""

from __future__ import annotations

import sys
import time
from pathlib import Path

import numpy as np

from engine.brush.settings import Brush
from engine.journal.heads import head_of_new
from engine.journal.journal import Journal
from engine.painting import commands as c
from engine.studio import requests as q
from engine.studio.journalled.posts import Posts
from engine.studio.results import Ready
from engine.studio.worker import Worker


def pen(told: np.random.Generator, count: int) -> np.ndarray:
    """So many points of a stroke, float64 (count, 6)."""
    line = np.cumsum(told.uniform(-9, 9, (count, 2)), axis=0) + told.uniform(50, 900, 2)
    return np.column_stack([line, told.uniform(0.1, 1, count), np.zeros((count, 2)), np.arange(count) * 0.008])


def strokes(seed: int):
    """Yields what is painted: (brush, points, command after it or None), always the same."""
    told = np.random.default_rng(seed)
    for n in range(100_000):
        colour = f"#{int(told.integers(1 << 24)):06x}"
        brush = Brush(radius=float(told.uniform(2, 14)), colour=colour)
        points, which = pen(told, int(told.integers(8, 60))), int(told.integers(10))
        more = {0: c.Undo(1), 1: c.Redo(1), 2: c.AddLayer(f"layer {n}")}.get(which)
        yield brush, points, more


def main(folder: str, seed: str, saved: str = "", when: str = "at once") -> None:
    worker = Worker(lambda: None, posts=Posts(Journal(head_of_new(), Path(folder))))
    while when == "loaded" and not any(isinstance(result, Ready) for result in worker.results()):
        time.sleep(0.05)
    asked = 0
    for n, (brush, points, more) in enumerate(strokes(int(seed)), 1):
        worker.post(q.Begin(0, (0, 0), brush))
        for part in np.array_split(points, 4):
            worker.post(q.Points(part))
            time.sleep(0.002)
        worker.post(q.Finish())
        print(f"up {n}", flush=True)
        if more is not None:
            asked += 1
            worker.post(q.Do(more))
            print(f"ask {asked}", flush=True)
        if saved and n % 5 == 0:
            worker.post(q.Save(Path(saved)))
        worker.results()
        while when == "loaded" and worker.behind:  # the engine keeps up, or it would be the journal alone
            worker.results()
            time.sleep(0.001)


if __name__ == "__main__":
    main(*sys.argv[1:])
