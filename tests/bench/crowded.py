"""Paintings larger than memory: `python -m bench.crowded --strokes 1000000 --budget 512` prints JSON objects.

As many strokes as are asked for lie side by side, each as the residuals of one that was painted, at its level and at
all coarser ones; none shares its data with another.  Told is what then comes of strokes among them, of taking these
back, of views at many levels, of saving and of opening, and of all that on what was opened: processor seconds, and the
megabytes that the process holds, with the most that it ever held.
"""

from __future__ import annotations

import argparse
import json
import math
import os
import resource
import tempfile
import time
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import immutables
import numpy as np

from engine.archive.opening import open_painting
from engine.archive.saving import Snapshot, save
from engine.brush.settings import Brush
from engine.canvas import layers
from engine.canvas.evaluate import evaluate
from engine.canvas.rising.paged_level import PagedLevel, PageEditor
from engine.canvas.store import Change, Record
from engine.keeping.memory import VARIABLE, resident
from engine.numeric.address import TILE, Rect
from engine.painting import commands as c
from engine.session.coding.paged_records import put_page_away
from engine.session.session import Session

BRUSH = Brush(radius=9.0, hardness=0.5, opacity=0.7, colour="#305070")
POINTS = 24
PAGE = 8  # tiles of a page are a row
STROKES, VIEW = 50, (1280, 800)
OF_LATE = 64  # commits before which the records seem to have been stored: they may be put away


def main(count: int, filed: bool) -> Iterator[dict[str, Any]]:
    session, rng = Session(), np.random.default_rng(11)
    session.do(c.AddLayer("Layer 1"))
    _stroke(session, (30, 40), rng)
    start = time.process_time()
    side = _crowd(session, count)
    yield {"strokes": side * side, "built": time.process_time() - start} | _held(session)
    yield from _worked(session, side, rng)
    if not filed:
        return
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "crowded.ora")
        yield _saved(session, path)
        del session  # as the window does where another painting takes its place
        start, wall = time.process_time(), time.monotonic()
        session = Session(open_painting(path).painting)
        yield {"opened": time.process_time() - start, "wall": time.monotonic() - wall} | _held(session)
        yield from _worked(session, side, rng)
        yield _saved(session, path)


def _worked(session: Session, side: int, rng: np.random.Generator) -> Iterator[dict[str, Any]]:
    """Paints some strokes, takes half of them back, and looks at the middle at many levels."""
    times = []
    for _ in range(STROKES):
        start = time.process_time()
        _stroke(session, tuple(rng.integers(0, side * TILE, 2).tolist()), rng)
        times.append(1e3 * (time.process_time() - start))
        _rest(session)
    yield {"stroke": float(np.median(times)), "worst": max(times)} | _held(session)
    start = time.process_time()
    for _ in range(STROKES // 2):
        session.do(c.Undo(1))
        _rest(session)
    yield {"undone": 1e3 * (time.process_time() - start) / (STROKES // 2)} | _held(session)
    for level in range(0, -side.bit_length() - 1, -1):
        start, at = time.process_time(), (side * TILE >> 1) >> -level
        pyramid = next(layers.layers(session.painting.root)).pyramid
        evaluate(pyramid, level, Rect.at(at - VIEW[0] // 2, at - VIEW[1] // 2, *VIEW), session.cache)
        seen = 1e3 * (time.process_time() - start)
        session.room.keep_within(session.painting.root)
        _rest(session)
        yield {"level": level, "seen": seen} | _held(session)


def _stroke(session: Session, at: tuple[int, int], rng: np.random.Generator) -> None:
    points = np.zeros((POINTS, 6))
    points[:, :2] = np.cumsum(rng.uniform(-6, 6, (POINTS, 2)), axis=0)
    points[:, 2] = rng.uniform(0.4, 1.0, POINTS)
    live = session.begin(0, at, BRUSH, "Layer 1")
    live.add(points)
    session.finish(live)


def _rest(session: Session) -> None:
    while session.room.pending:
        session.room.step()


def _crowd(session: Session, count: int) -> int:
    """Lays the records of the session's one stroke side by side; returns how many are a row."""
    side = -(-math.isqrt(count - 1) // PAGE) * PAGE
    layer = next(layers.layers(session.painting.root))
    change, levels = _later(layer.pyramid.last), layer.pyramid.levels
    for level, stored in sorted(levels.items()):
        pattern, along = next(iter(stored.values())), max(1, side >> -level)
        laid: PagedLevel[Record] = PagedLevel.of({})
        for top in range(0, along, PAGE):
            editor, rows = PageEditor(laid), range(top, min(top + PAGE, along))
            for n, place in enumerate((x, y) for y in rows for x in range(along)):
                data = np.roll(pattern.data, top + n, axis=2)
                editor.set(place, Record(pattern.rect, data, pattern.inks, 0))
            laid = editor.finish()
            for at, page in laid.pages.items():
                put_page_away(at, page, 0)
        levels = levels.set(level, laid)
    pyramid = replace(layer.pyramid, levels=levels, last=change, known=immutables.Map())
    root = layers.with_pyramid(session.painting.root, layer.name, pyramid)
    session.amend(replace(session.painting, root=root))
    return side


def _later(change: Change | None) -> Change:
    """Returns a commit many later than another."""
    assert change is not None
    return replace(change, depth=change.depth + OF_LATE)


def _saved(session: Session, path: Path) -> dict[str, Any]:
    start, wall = time.process_time(), time.monotonic()
    save(path, Snapshot(session.painting, session.recording()))
    took = {"saved": time.process_time() - start, "wall": time.monotonic() - wall, "bytes": path.stat().st_size}
    return took | _held(session)


def _held(session: Session) -> dict[str, Any]:
    records = sum(layer.pyramid.nbytes for layer in layers.layers(session.painting.root))
    most = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss >> 10
    return {"resident": resident() >> 20, "most": most, "records": records >> 20}


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--strokes", type=int, default=1_000_000)
    parser.add_argument("--budget", type=int, default=512, help="MB that the program may take, beside its own")
    parser.add_argument("--unfiled", action="store_true", help="neither saved nor opened")
    asked = parser.parse_args()
    os.environ[VARIABLE] = str(asked.budget)
    for row in main(asked.strokes, not asked.unfiled):
        print(json.dumps(row), flush=True)
