"""A 1920 x 1080 view evaluated from its parent level, against a copy of the bytes that it reads and writes."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator

import numpy as np

from app.bench import Figure
from engine.canvas.evaluate import evaluate, step
from engine.canvas.layers import layers
from engine.canvas.store import Pyramid
from engine.numeric.address import Rect
from engine.painting.commands import parse
from engine.painting.painting import Painting, apply

VIEW = Rect.at(64, 64, 1920, 1080)
REPEATS = 9
INKS = [
    {"texture": "rock", "amount": 0.5, "colour": "#d0b090", "period": 64},
    {"texture": "stripes", "amount": 0.3, "colour": "#80c040", "period": 24},
    {"texture": "squares", "amount": 0.3, "colour": "#4060c0", "period": 40},
]


def measure() -> Iterator[Figure]:
    yield _figure("view, three ink instances", INKS, 8.0)
    yield _figure("view, colour alone", [], 4.0)


def _figure(name: str, inks: list[dict], limit: float) -> Figure:
    pyramid = _painted(inks)
    above = Rect((VIEW.x0 >> 1) - 1, (VIEW.y0 >> 1) - 1, (VIEW.x1 >> 1) + 1, (VIEW.y1 >> 1) + 1).evened()
    parent = evaluate(pyramid, 0, above)
    shown = step(pyramid, parent, above, 1, VIEW)
    assert shown is not None
    moved = parent.data.nbytes + shown.data.nbytes
    source = np.ones(moved // 8, np.float32)  # copying reads it and writes as much
    target = np.empty_like(source)
    own, copying = [], []
    for _ in range(REPEATS):  # in turns, so that both meet the same neighbours
        own.append(seconds(lambda: step(pyramid, parent, above, 1, VIEW)))
        copying.append(seconds(lambda: np.copyto(target, source)))
    best = min(own)
    return Figure(name, best * 1e3, "ms", f"a copy of its {moved >> 20} MiB", best / min(copying), limit)


def _painted(inks: list[dict]) -> Pyramid:
    """A layer covered with ink at level 0."""
    brush = {"radius": 400, "hardness": 1, "colour": "#604020", "ink": inks, "spacing": 0.5}
    stroke = parse({"do": "stroke", "points": [[0, 300], [1100, 300]], "brush": brush})
    painting = apply(Painting(), stroke)
    return next(iter(layers(painting.root))).pyramid


def seconds(work: Callable[[], object]) -> float:
    start = time.perf_counter()
    work()
    return time.perf_counter() - start
