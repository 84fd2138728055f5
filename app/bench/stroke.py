"""A stroke of 1,000 points, radius 32, from pen to committed pixels at all levels, against libmypaint's speed."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import partial

import numpy as np

from app.bench import Figure
from app.bench.view import seconds
from engine.brush.record import Brush, Component
from engine.painting.painting import Painting
from engine.painting.stroke import LiveStroke

POINTS = 1000
REPEATS = 5
LIBMYPAINT = 60_000.0  # points a second on one core, without a pyramid (measured elsewhere, not in this run)


def measure() -> Iterator[Figure]:
    for name, ink in (("stroke, one colour", ()), ("stroke, rock", (Component("rock", 0.8, "#d0c0a0"),))):
        brush = Brush(radius=32.0, hardness=0.5, colour="#204060", ink=ink)
        best = min(seconds(partial(_paint, brush)) for _ in range(REPEATS))
        rate = POINTS / best
        yield Figure(name, rate, "points/s", "libmypaint's 60,000", rate / LIBMYPAINT, 1.0, more_is_better=True)


def _paint(brush: Brush) -> Painting:
    t = np.linspace(0.0, 1.0, POINTS)
    # A curve of some 6,600 px: less than one dab for each point, as in libmypaint's own benchmark.
    x, y = 300 + 260 * np.sin(5 * math.tau * t), 250 + 200 * np.cos(3 * math.tau * t)
    points = np.column_stack([x, y, 0.3 + 0.7 * t])
    live = LiveStroke(Painting(), 0, (0, 0), brush)
    for part in np.array_split(points, POINTS // 4):  # as a frame brings them
        live.add(part)
    return live.commit()
