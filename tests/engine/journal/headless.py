"""A painter without a window, in a process of its own, that is killed while it paints.

`python headless.py FOLDER SEED [FILES [WHEN [KIND]]]` paints, once the engine is "loaded" or "at once", until it is
killed.  KIND: what it does besides, a row of KINDS.  It tells on standard output what it does: "up N" after the pen was
lifted N times, "ask N" after N commands, "at N K T U" after stroke N has K points, which were posted from T to U by the
monotonic clock, "kept" when its journal is there, so that all is written at once from then on, "now WORDS" when what
goes on in the background has changed, "saved" and "exported" when a file of FILES was written.
"""

from __future__ import annotations

import sys
import time
from pathlib import Path

import numpy as np
from PIL import Image

from engine.brush.settings import Brush
from engine.journal.heads import head_of_new
from engine.journal.journal import Journal
from engine.painting import commands as c
from engine.studio import requests as q
from engine.studio import results
from engine.studio.journalled.posts import Posts
from engine.studio.results import Ready
from engine.studio.worker import Worker

KINDS = ("painting", "growing", "saving", "exporting")
SAVED, EXPORTED, EXAMPLE = "saved.ora", "seen.png", "spots.png"
OLD = b"what was there before\n" * 1000  # in the files that it writes
SLOW = 8  # strokes of which one is drawn as slowly as by a hand


def pen(told: np.random.Generator, count: int) -> np.ndarray:
    """So many points of a stroke, float64 (count, 6)."""
    line = np.cumsum(told.uniform(-9, 9, (count, 2)), axis=0) + told.uniform(50, 900, 2)
    return np.column_stack([line, told.uniform(0.1, 1, count), np.zeros((count, 2)), np.arange(count) * 0.008])


def strokes(seed: int, grows: bool = False):
    """Yields what is painted: (brush, points, command after it or None), always the same.  Where it `grows`, every
    third stroke is painted with an example."""
    told = np.random.default_rng(seed)
    for n in range(100_000):
        colour = f"#{int(told.integers(1 << 24)):06x}"
        brush = Brush(radius=float(told.uniform(2, 14)), colour=colour)
        points, which = pen(told, int(told.integers(8, 60))), int(told.integers(10))
        more = {0: c.Undo(1), 1: c.Redo(1), 2: c.AddLayer(f"layer {n}")}.get(which)
        if grows and n % 3 == 0:
            brush = Brush(radius=40.0, mode="example", example="spots", hardness=1.0, example_detail=1)
        yield brush, points, more


def example(folder: Path) -> c.Command:
    """Defines a texture that strokes grow, of a picture that lies in a folder then."""
    y, x = np.mgrid[0:96, 0:96]
    spots = np.stack([y * 2, 0 * x + 60, 40 + 200 * ((x // 9 + y // 9) % 2), 255 - x], axis=-1).astype(np.uint8)
    Image.fromarray(spots).save(folder / EXAMPLE)
    return c.parse({"do": "texture", "name": "spots", "maker": "example", "path": str(folder / EXAMPLE), "kappa": 1})


class Painter:
    """The program without its window: it posts, and tells what it hears of."""

    def __init__(self, folder: str) -> None:
        self.worker = Worker(lambda: None, posts=Posts(Journal(head_of_new(), Path(folder))))
        self.loaded, self.busy, self._saves, self._exports, self._grows = False, "", False, False, False
        self._kept = False

    def hear(self) -> None:
        """Takes the results, and tells those that matter."""
        for result in self.worker.results():
            match result:
                case Ready():
                    self.loaded = True
                case results.Growing():
                    self._grows = result.done < 1.0
                case results.Saved():
                    self._saves = False
                    print("saved", flush=True)
                case results.Note(about="export", bad=False):
                    self._exports = False
                    print("exported", flush=True)
        self._tell()

    def _tell(self) -> None:
        """Tells what goes on in the background, if that has changed, and that its journal is there."""
        entry = self.worker.journal.entry
        if not self._kept and entry.open and not entry.held:
            self._kept = True
            print("kept", flush=True)
        now = {"saving": self._saves, "exporting": self._exports, "growing": self._grows}
        busy = " ".join(word for word, at_it in now.items() if at_it)
        if busy != self.busy:
            self.busy = busy
            print("now", busy, flush=True)

    def save(self, folder: Path) -> None:
        """Has the painting saved, unless it is being saved."""
        if not self._saves:
            self.worker.post(q.Save(folder / SAVED))
            self._saves = True
            self._tell()

    def export(self, folder: Path) -> None:
        """Has the picture exported, unless it is being exported."""
        if not self._exports:
            self.worker.post(q.Export(folder / EXPORTED))
            self._exports = True
            self._tell()

    def stroke(self, number: int, brush: Brush, points: np.ndarray) -> None:
        """Posts a stroke, some of them as slowly as a hand draws."""
        slow = number % SLOW == 0
        self.worker.post(q.Begin(0, (0, 0), brush))
        count = 0
        for part in np.array_split(points, len(points) if slow else 4):
            count += len(part)
            began = time.monotonic()
            self.worker.post(q.Points(part))
            print(f"at {number} {count} {began} {time.monotonic()}", flush=True)
            time.sleep(0.008 if slow else 0.002)
            self.hear()
        self.worker.post(q.Finish())
        print(f"up {number}", flush=True)


def main(folder: str, seed: str, files: str = "", when: str = "at once", kind: str = "painting") -> None:
    painter, asked = Painter(folder), 0
    while when == "loaded" and not painter.loaded:
        time.sleep(0.05)
        painter.hear()
    if kind == "growing":
        painter.worker.post(q.Do(example(Path(files))))
    for n, (brush, points, more) in enumerate(strokes(int(seed), kind == "growing"), 1):
        painter.stroke(n, brush, points)
        if more is not None:
            asked += 1
            painter.worker.post(q.Do(more))
            print(f"ask {asked}", flush=True)
        if files and (kind == "saving" or (kind != "painting" and n % 5 == 0)):
            painter.save(Path(files))
        if kind == "exporting":
            painter.export(Path(files))
        painter.hear()
        while when == "loaded" and painter.worker.behind:  # the engine keeps up, or it would be the journal alone
            painter.hear()
            time.sleep(0.001)


if __name__ == "__main__":
    main(*sys.argv[1:])
