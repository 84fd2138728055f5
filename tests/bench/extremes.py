"""Paintings that are large in places, in layers or in levels: what a stroke costs there, and whether that grows.

`python -m bench.extremes places 100000`, or `layers 2000`, or `levels 200`, prints one JSON object: milliseconds of the
processor that a stroke of each tenth of them takes, from pen to committed pixels at all levels and the step of the
history, the longest of all, and those of an undo.
"""

from __future__ import annotations

import json
import sys
import time
from collections.abc import Callable

import numpy as np

from engine.brush.settings import Brush
from engine.keeping import collecting
from engine.keeping.memory import resident
from engine.painting import commands as c
from engine.session.session import Session

PLACE, LEVEL, LAYERS = 10**12, 4096, 1000
AT_ONCE = 4  # points, as a frame brings them
TENTHS = 10
BRUSH = Brush(radius=6.0, hardness=0.7, opacity=0.8, colour="#305070")
Place = Callable[[np.random.Generator], tuple[int, int, int, str | None]]  # level, x, y, layer


def _at_places(rng: np.random.Generator) -> tuple[int, int, int, str | None]:
    x, y = rng.integers(-PLACE, PLACE, 2).tolist()
    return 0, x, y, None


def _on_layers(rng: np.random.Generator) -> tuple[int, int, int, str | None]:
    x, y = rng.integers(0, 1000, 2).tolist()
    return 0, x, y, f"Layer {rng.integers(1, LAYERS + 1)}"


def _at_levels(rng: np.random.Generator) -> tuple[int, int, int, str | None]:
    level = int(rng.integers(-LEVEL, LEVEL + 1))
    x, y = (((place << LEVEL) >> (LEVEL - level)) + int(rng.integers(-200, 200)) for place in (1000, 700))
    return level, x, y, None


_PLACES: dict[str, Place] = {"places": _at_places, "layers": _on_layers, "levels": _at_levels}


def paint(kind: str, count: int) -> dict[str, object]:
    session, rng = Session(), np.random.default_rng(7)
    if kind == "layers":
        for number in range(1, LAYERS + 1):
            session.do(c.AddLayer(f"Layer {number}"))
    for level in (0, 3, 0):  # kernels are loaded
        _stroke(session, (level, 0, 0, None), rng)
    session.do(c.Undo(3))
    place, times = _PLACES[kind], []
    for _ in range(count):
        at = place(rng)
        start = time.thread_time()
        _stroke(session, at, rng)
        times.append(1e3 * (time.thread_time() - start))
    undone = min(count, session.history.undo_count)
    start = time.thread_time()
    for _ in range(undone):
        session.do(c.Undo(1))
    took = 1e3 * (time.thread_time() - start) / max(1, undone)
    tenths = [float(np.mean(part)) for part in np.array_split(times, TENTHS)]
    return {"strokes": tenths, "worst": max(times), "undone": took, "steps": undone, "resident": resident() >> 20}


def _stroke(session: Session, at: tuple[int, int, int, str | None], rng: np.random.Generator) -> None:
    level, x, y, layer = at
    points = np.zeros((20, 6))
    points[:, :2] = np.cumsum(rng.uniform(-6, 6, (20, 2)), axis=0)
    points[:, 2] = rng.uniform(0.4, 1.0, 20)
    live = session.begin(level, (x, y), BRUSH, layer)
    for first in range(0, len(points), AT_ONCE):
        live.add(points[first : first + AT_ONCE])
    session.finish(live)
    if collecting.due():  # as the window's engine does at rest
        collecting.pass_over()


if __name__ == "__main__":
    print(json.dumps(paint(sys.argv[1], int(sys.argv[2]))))
