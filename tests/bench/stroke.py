"""A stroke of 1,000 points, radius 32, from pen to committed pixels at all levels, against libmypaint's speed."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import partial

import numpy as np

from bench import Figure, libmypaint
from bench.clock import best, slowness
from engine.brush.settings import Brush, Component
from engine.session.apply import Painting
from engine.strokes.paint_stroke import LiveStroke

POINTS = 1000
REPEATS = 15
RADIUS, HARDNESS, SPACING = 32.0, 0.5, 0.25
AT_ONCE = 4  # points, as a frame brings them
LIBMYPAINT = 50_000.0  # points a second of this very stroke, one thread, without a pyramid (of another run)


def measure(small: bool = False) -> Iterator[Figure]:
    repeats, points = (1, _curve(20)) if small else (REPEATS, _curve(POINTS))
    slow = 1.0 if libmypaint.library() else slowness()
    for name, ink in (("stroke, one colour", ()), ("stroke, rock", (Component("rock", 0.8, "#d0c0a0"),))):
        brush = Brush(radius=RADIUS, hardness=HARDNESS, spacing=SPACING, colour="#204060", ink=ink)
        yield _figure(name, brush, points, repeats, slow)


def _figure(name: str, brush: Brush, points: np.ndarray, repeats: int, slow: float) -> Figure:
    own = partial(painted, brush, points)
    if libmypaint.library():
        told = [(float(x), float(y), float(p)) for x, y, p in points]
        taken, theirs = best(repeats, own, lambda: libmypaint.stroke(told, RADIUS, HARDNESS, SPACING))
        bound = f"libmypaint's {len(points) / theirs:,.0f}"
        note = "libmypaint without a pyramid, same points and dabs, measured in the same run, one thread"
    else:
        [taken], theirs = best(repeats, own), len(points) / LIBMYPAINT * slow
        bound = f"libmypaint's {len(points) / theirs:,.0f}"
        note = f"its figure of another run, as copying takes {slow:.2f} x as long"
    return Figure(name, len(points) / taken, "points/s", bound, theirs / taken, 1.0, True, note)


def _curve(count: int) -> np.ndarray:
    """A curve of some 6,600 px for 1,000 points: x, y, pressure."""
    t = np.linspace(0.0, count / POINTS, count)
    x, y = 300 + 260 * np.sin(5 * math.tau * t), 250 + 200 * np.cos(3 * math.tau * t)
    return np.column_stack([x, y, 0.3 + 0.7 * t])


def painted(brush: Brush, points: np.ndarray) -> Painting:
    live = LiveStroke(Painting(), 0, (0, 0), brush)
    for part in np.array_split(points, max(1, len(points) // AT_ONCE)):
        live.add(part)
    return live.commit()
