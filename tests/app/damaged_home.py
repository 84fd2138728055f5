"""A home in which an artist has worked, every file of which is damaged then."""

from __future__ import annotations

import os
import random
import shutil
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
from PIL import Image
from test_damaged_settings import brush, example

from engine.brush.settings import Brush
from engine.journal.heads import head_of_new
from engine.journal.journal import Journal
from engine.painting import commands as c
from engine.studio import requests as q
from engine.studio import results
from engine.studio.filing.opening_requests import Show
from engine.studio.journalled.posts import Posts
from engine.studio.worker import Worker

PATIENCE = 120.0  # seconds
PREFERENCES = "[kept]\nversions = 5\ngigabytes = 2.5\n\n[memory]\nmegabytes = 2048\n"
KERNELS = 6  # of which the code is damaged: each is compiled anew


class Painter:
    """The program without its window."""

    def __init__(self, folder: Path) -> None:
        self.worker = Worker(lambda: None, posts=Posts(Journal(head_of_new(), folder)))
        self._came: list[results.Result] = []
        self.until(lambda: self._has(results.Ready))

    def until(self, good: Callable[[], bool]) -> None:
        end = time.monotonic() + PATIENCE
        while not good():
            self._came += self.worker.results()
            assert time.monotonic() < end
            time.sleep(0.01)

    def _has(self, kind: type) -> list[results.Result]:
        return [result for result in self._came if isinstance(result, kind)]

    def do(self, request: q.Request, kind: type) -> results.Result:
        """Asks, and returns the first result of a kind."""
        self._came = []
        self.worker.post(request)
        self.until(lambda: bool(self._has(kind)))
        return self._has(kind)[0]

    def stroke(self, seed: int) -> None:
        told = np.random.default_rng(seed)
        points = np.column_stack([told.uniform(50, 900, (30, 2)), np.ones((30, 4)) * 0.5])
        self.worker.post(q.Begin(0, (0, 0), Brush(radius=9.0)))
        self.worker.post(q.Points(points))
        self.do(q.Finish(), results.Scene)


def make_home(home: Path) -> None:
    """Makes it: what the program has in XDG_CONFIG_HOME, XDG_DATA_HOME and XDG_STATE_HOME, which lie in `home`."""
    config, data, state = (home / name / "inkfall" for name in ("config", "data", "state"))
    for folder in (config / "brushes", data / "examples", state / "log"):
        folder.mkdir(parents=True)
    (config / "preferences.toml").write_text(PREFERENCES)
    brush(config / "brushes")
    example(data / "examples")
    (state / "log" / "inkfall.log").write_text("2026-01-01 00:00:00,000 INFO MainThread: something\n" * 9)
    Image.fromarray(np.random.default_rng(3).integers(0, 255, (90, 120, 3), np.uint8)).save(home / "photo.png")
    by_choice, entries = Painter(state / "paintings"), state / "paintings"
    by_choice.stroke(1)
    for seed in (2, 3):  # the second keeps the first as an earlier version
        by_choice.stroke(seed)
        by_choice.do(q.Save(home / "lake.ora"), results.Saved)
    by_choice.stroke(4)
    by_choice.worker.close(PATIENCE)  # into the bin
    for path, seed in ((home / "lake.ora", 5), (home / "photo.png", 6), (None, 7)):
        painter = Painter(entries)
        if path is not None:
            whole = painter.do(q.Open(path), results.Whole)
            painter.do(Show(whole.file), results.Scene)
        painter.do(q.Do(c.AddLayer("sky")), results.Scene)
        painter.stroke(seed)
        folder = painter.worker.entry
        assert folder is not None
        painter.until(lambda folder=folder: any(folder.glob("checkpoint-*")) and (folder / "picture.png").exists())
        painter.worker.close(PATIENCE, by_choice=False)


def damage(home: Path, chance: random.Random, cuts: bool) -> int:
    """Cuts each file somewhere, or flips some bits of it; how many there are."""
    found = [path for path in sorted(home.rglob("*")) if path.is_file() and path.stat().st_size]
    for path in found:
        harm(path, chance, cuts)
    return len(found)


def harm(path: Path, chance: random.Random, cuts: bool) -> None:
    """Cuts a file somewhere, or flips some of its bits."""
    data = bytearray(path.read_bytes())
    if cuts:
        del data[chance.randrange(len(data)) :]
    for _ in range(0 if cuts else chance.randint(1, 8)):
        data[chance.randrange(len(data))] ^= 1 << chance.randrange(8)
    path.unlink()  # it may be a link
    path.write_bytes(data)


def damaged_cache(cache: Path, chance: random.Random, cuts: bool) -> None:
    """Copies the cache of this process's kernels and examples, and damages some of it."""
    kernels = Path(os.environ["NUMBA_CACHE_DIR"])
    for folder in (kernels, kernels.with_name("examples")):
        if folder.is_dir():
            shutil.copytree(folder, cache / "inkfall" / folder.name, copy_function=os.link)
    files = [path for path in cache.rglob("*") if path.is_file()]
    code = [path for path in files if path.suffix == ".kernel"]
    for path in [*chance.sample(code, min(KERNELS, len(code))), *(path for path in files if path.suffix != ".kernel")]:
        harm(path, chance, cuts)
