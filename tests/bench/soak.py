"""A long session: what strokes cost as they become many, and what all of them then cost to undo, save and open.

`python -m bench.soak --strokes 50000` prints one JSON object every 1,000 strokes: processor seconds that they took and
what the process holds; then what came of saving, of opening, and of undoing to the first.  Strokes of all sizes, some
of rock, some that erase, on three layers at nine levels; now and then one is undone.  `--wide` paints each level over
the whole frame, which never fills at the fine ones: what a stroke costs grows with what lies below it.  `--plain`
paints without rock: up to nine inks, three planes each, come to lie where strokes overlap, which cost what they cost.
`--side 400`, with `INKFALL_MEMORY=290`, is the same on a fourteenth of the area, in a fourteenth of the strokes.
"""

from __future__ import annotations

import argparse
import json
import tempfile
import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from engine.archive.opening import open_painting
from engine.archive.saving import Snapshot, save
from engine.brush.settings import Brush, Component
from engine.canvas.layers import layers
from engine.keeping import collecting
from engine.keeping.memory import resident
from engine.painting import commands as c
from engine.session.session import Session

LAYERS, LEVELS = 3, range(-2, 7)
SWEEP = 250  # strokes down through the levels and up again: what one costs hangs on its level
SPAN = 4000  # pixels of level 0 that is painted on over the whole frame
SIDE = 1500  # pixels of each level otherwise: what an artist sees, and some more
FILLED = 0.2  # of the strokes: by then most of it is painted on
POINTS, AT_ONCE = 24, 4
RADII = (1.5, 3.0, 3.0, 6.0, 6.0, 9.0, 9.0, 30.0, 60.0)
ROCK = (Component("rock", 0.6, "#d0b090"),)
STEADY = 1.2  # the last thousand strokes to the median of those on a canvas that is painted on, at most


@dataclass(frozen=True)
class Area:
    """What is painted on, and with: `side` pixels of each level, or `wide`; all of one colour where `plain`."""

    side: int = SIDE
    wide: bool = False
    plain: bool = False


def main(count: int, each: int, seed: int, area: Area = Area()) -> Iterator[dict[str, Any]]:
    session, rng = Session(), np.random.default_rng(seed)
    for number in range(1, LAYERS + 1):
        session.do(c.AddLayer(f"Layer {number}"))
    spent = []
    for done in range(each, count + 1, each):
        start, begun = time.process_time(), time.monotonic()
        for number in range(done - each, done):
            _stroke(session, level_of(number), rng, area)
            if rng.random() < 0.05:
                session.do(c.Undo(1))
            while session.room.pending:
                session.room.step()
            if collecting.due():  # as the window's engine does at rest
                collecting.pass_over()
        spent.append(time.process_time() - start)
        yield _held(session) | {"strokes": done, "seconds": spent[-1], "wall": time.monotonic() - begun}
    steady = spent[int(FILLED * len(spent)) :]
    yield {"last to median": spent[-1] / float(np.median(steady)), "bound": STEADY}
    yield from _filed(session)
    yield _undone(session)


def level_of(number: int) -> int:
    """Returns the level of a stroke: from the coarsest to the finest and back, so many strokes at each."""
    part = number % SWEEP / SWEEP
    return LEVELS[int(len(LEVELS) * min(2.0 * part, 2.0 - 2.0 * part) * 0.9999)]


def _stroke(session: Session, level: int, rng: np.random.Generator, area: Area) -> None:
    kind = rng.random()
    brush = Brush(
        mode="erase" if kind < 0.08 else "paint",
        radius=float(rng.choice(RADII)),
        hardness=0.6,
        opacity=float(rng.choice([0.3, 0.8, 1.0])),
        colour="#" + "".join(f"{v:02x}" for v in rng.integers(0, 256, 3)),
        ink=ROCK if kind > 0.85 and not area.plain else (),
    )
    side = int(SPAN * 2.0**level) if area.wide else area.side
    points = np.zeros((POINTS, 6))
    points[:, :2] = np.cumsum(rng.normal(0.0, 8.0, (POINTS, 2)), axis=0)
    points[:, 2] = rng.uniform(0.4, 1.0, POINTS)
    x, y = rng.integers(0, side, 2).tolist()
    live = session.begin(level, (x, y), brush, f"Layer {rng.integers(1, LAYERS + 1)}")
    for first in range(0, POINTS, AT_ONCE):
        live.add(points[first : first + AT_ONCE])
    session.finish(live)


def _held(session: Session) -> dict[str, Any]:
    return {
        "resident": resident() >> 20,
        "records": sum(layer.pyramid.nbytes for layer in layers(session.painting.root)) >> 20,
        "history": session.history.held >> 20,
        "cache": session.cache.held >> 20,
        "steps": session.history.undo_count,
        "all steps": session.steps.count,
    }


def _filed(session: Session) -> Iterator[dict[str, Any]]:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "soak.ora")
        start, wall = time.process_time(), time.monotonic()
        save(path, Snapshot(session.painting, session.recording()))
        size = path.stat().st_size
        yield {"saved": time.process_time() - start, "wall": time.monotonic() - wall, "bytes": size}
        start, wall = time.process_time(), time.monotonic()
        open_painting(path)
        yield {"opened": time.process_time() - start, "wall": time.monotonic() - wall, "resident": resident() >> 20}


def _undone(session: Session) -> dict[str, Any]:
    held, start = session.history.undo_count, time.process_time()
    while session.history.undo_count:
        session.do(c.Undo(1))
    left = session.steps.count  # that are to be played anew
    empty = not any(layer.pyramid.levels for layer in layers(session.painting.root))
    return {"undone": held, "seconds": time.process_time() - start, "left to replay": left, "empty": empty}


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--strokes", type=int, default=50_000)
    parser.add_argument("--each", type=int, default=1000, help="strokes from one line to the next")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--wide", action="store_true", help="over the whole frame at each level")
    parser.add_argument("--side", type=int, default=SIDE, help="pixels of each level that are painted on")
    parser.add_argument("--plain", action="store_true", help="without rock")
    asked = parser.parse_args()
    for row in main(asked.strokes, asked.each, asked.seed, Area(asked.side, asked.wide, asked.plain)):
        print(json.dumps(row), flush=True)
