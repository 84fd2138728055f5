"""The past of a painting: small pictures of its steps, each of whose strokes falls on another layer than that before.

Processor time of the engine's thread.
"""

from __future__ import annotations

import random
import time
from collections.abc import Iterator
from statistics import mean

from bench import Figure
from engine.canvas.tile_cache import TileCache
from engine.painting import commands as c
from engine.session.session import Session
from engine.studio.past.step_pictures import StepPainter, StepPictures

CACHE = 256 << 20  # bytes
LAYERS, STROKES, SIDE = (1, 4, 10), 300, 400  # strokes on random ones of so many layers, over so many pixels
PICTURE = 1e-3  # seconds, at most


def measure(small: bool = False) -> Iterator[Figure]:
    for count in LAYERS:
        taken = _pictures(count, 6 if small else STROKES)
        name = f"a step's picture, {count} layer{'s' if count > 1 else ''}"
        yield Figure(name, taken * 1e3, "ms", f"{PICTURE * 1e3:.0f} ms", taken / PICTURE, 1.0)


def _pictures(count: int, strokes: int) -> float:
    """The mean time of a picture, the first third left out."""
    rng, session = random.Random(5), Session(cache=TileCache(CACHE))
    names = [f"Layer {n}" for n in range(count)]
    for name in names:
        session.do(c.AddLayer(name))
    painter, pictures, times = StepPainter(), StepPictures(), []
    for _ in range(strokes):
        session.do(_stroke(rng, rng.choice(names)))
        step = session.steps.done[-1]
        start = time.thread_time()
        pictures.keep(step, painter.made(step, session.painting, session.cache))
        times.append(time.thread_time() - start)
    return mean(times[strokes // 3 :])


def _stroke(rng: random.Random, layer: str) -> c.Command:
    """A scribble of a dozen points, at one of three levels."""
    x, y = rng.uniform(0, SIDE), rng.uniform(0, SIDE)
    points = []
    for _ in range(12):
        points.append([round(x, 2), round(y, 2), 0.8])
        x, y = x + rng.uniform(-20, 20), y + rng.uniform(-20, 20)
    brush = {"radius": 12, "opacity": 0.7, "colour": f"#{rng.randrange(1 << 24):06x}"}
    told = {"do": "stroke", "layer": layer, "level": rng.randrange(3), "points": points, "brush": brush}
    return c.parse(told)
