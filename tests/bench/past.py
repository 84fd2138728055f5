"""The past of a painting: small pictures of its steps, each of whose strokes falls on another layer than that before;
the strokes that show at a pixel which thousands of faint ones cover; and a look at a step whose paint is packed.

Processor time of the engine's thread.
"""

from __future__ import annotations

import gc
import random
import time
from collections.abc import Iterator
from itertools import pairwise
from statistics import mean
from typing import Any

from bench import Figure
from engine.canvas.tile_cache import TileCache
from engine.painting import commands as c
from engine.session.session import Session
from engine.studio import requests as q
from engine.studio import results
from engine.studio.past import past_records as p
from engine.studio.past.step_pictures import StepPainter, StepPictures
from engine.studio.studio import Studio

CACHE = 256 << 20  # bytes
LAYERS, STROKES, SIDE = (1, 4, 10), 300, 400  # strokes on random ones of so many layers, over so many pixels
PICTURE = 1e-3  # seconds, at most
FAINT, HERE = 5000, (0, 455, 455)  # strokes; pixel that they all cover
FIRST = 0.05  # seconds until the newest strokes that show are told
BACK, SEEN = 200, 0.03  # steps back that is looked; seconds until the view is seen
TILES = tuple((0, x, y, -1) for y in range(4) for x in range(5))
LOOKS: dict[str, dict[str, Any]] = {
    "plain": {},
    "grain": {"opacity": 0.1, "grain": {"texture": "rock", "period": 32, "amount": 0.2}},
    "tip": {"tip": {"texture": "rock", "source": "window", "period": 8}},
    "wet edge": {"edge": "wet"},
    "raster with ink": {"mode": "raster", "op": "multiply", "ink": [{"texture": "rock", "period": 16}]},
}


def measure(small: bool = False) -> Iterator[Figure]:
    for count in LAYERS:
        taken = _pictures(count, 6 if small else STROKES)
        name = f"a step's picture, {count} layer{'s' if count > 1 else ''}"
        yield Figure(name, taken * 1e3, "ms", f"{PICTURE * 1e3:.0f} ms", taken / PICTURE, 1.0)
    for look, brush in LOOKS.items():
        count = 20 if small else FAINT
        first, longest, whole = min(_asked(_faint(count, brush)) for _ in range(2))
        note = f"all after {whole * 1e3:.0f} ms, in pieces of at most {longest * 1e3:.0f} ms"
        name, bound = f"painted here, {count:,} x {look}, first told", f"{FIRST * 1e3:.0f} ms"
        yield Figure(name, first * 1e3, "ms", bound, first / FIRST, 1.0, note=note)
    seen, cold = _looked_back(8 if small else BACK)
    note = f"the same view of the present, from nothing, takes {cold * 1e3:.0f} ms"
    yield Figure("a look at a packed step", seen * 1e3, "ms", f"{SEEN * 1e3:.0f} ms", seen / SEEN, 1.0, note=note)


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


def _faint(count: int, brush: dict[str, Any]) -> Session:
    """Strokes that all cover a pixel, and leave nearly all of it to be seen; only one is painted."""
    rng, commands = random.Random(1), []
    for _ in range(count):
        points = [[HERE[1] + rng.uniform(-40, 40), HERE[2] + rng.uniform(-40, 40), 0.8] for _ in range(20)]
        points[10] = [HERE[1], HERE[2], 0.8]
        told = {"do": "stroke", "points": points, "brush": {"radius": 12, "opacity": 0.02, **brush}}
        commands.append(c.parse(told))
    session = Session(cache=TileCache(CACHE))
    session.do(commands[0])
    session.log += commands[1:]
    return session


def _asked(session: Session) -> tuple[float, float, float]:
    """Seconds until the first strokes are told, of the longest piece of work, and until all are."""
    told: list[float] = []

    def send(result: results.Result) -> None:
        if isinstance(result, p.Here):
            told.append(time.thread_time())

    studio = Studio(send, lambda request: None)
    studio.easel.show(session, None)
    while studio.step():
        pass
    gc.collect()
    pieces = [time.thread_time()]
    studio.do(p.AskHere(*HERE))
    pieces.append(time.thread_time())
    while studio.step():
        pieces.append(time.thread_time())
    studio.close()
    return told[0] - pieces[0], max(b - a for a, b in pairwise(pieces)), told[-1] - pieces[0]


def _looked_back(by: int) -> tuple[float, float]:
    """Seconds for a view of three layers painted with rock, so many steps back, and as it is, from nothing."""
    studio = Studio(lambda result: None, lambda request: None)
    for n in range(3):
        studio.do(q.Do(c.AddLayer(f"Rock {n}")))
    rng, ink = random.Random(3), [{"texture": "rock", "colour": "#ffffff", "period": 16}]
    for n in range(by + by // 2):
        x, y = rng.uniform(0, 1280), rng.uniform(0, 1024)
        points = [[x + 20 * k, y + rng.uniform(-20, 20), 0.8] for k in range(14)]
        brush = {"radius": 20, "opacity": 0.8, "colour": f"#{rng.randrange(1 << 24):06x}", "ink": ink}
        studio.do(q.Do(c.parse({"do": "stroke", "layer": f"Rock {n % 3}", "points": points, "brush": brush})))
    while studio.step():
        pass
    steps = studio.easel.session.steps.count
    times = []
    for number in (steps - by, None):
        studio.do(p.LookBack(number))
        studio.easel.session.cache.clear()
        start = time.thread_time()
        studio.look(q.Look(TILES))
        while studio.easel.viewer.sight.open:
            studio.step()
        times.append(time.thread_time() - start)
    studio.close()
    return times[0], times[1]
