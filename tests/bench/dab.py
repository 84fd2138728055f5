"""Soft dabs: laid into a stroke's coverage, against libmypaint's; and one of rock through to pixels, against memcpy."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from bench import Figure, libmypaint
from bench.clock import best, copying, processor, slowness
from engine.brush import edits
from engine.brush.dabs import Stroker
from engine.brush.ink import resolve
from engine.brush.mask import StrokeMask
from engine.brush.settings import Brush, Component
from engine.canvas import kernels
from engine.canvas.dither import NO_DITHER
from engine.numeric.address import TileKey
from engine.numeric.grid import FINE_STEP
from engine.texture.planes import Planes

REPEATS = 15
TIMES_FASTER = 5.0
DABS = {8.0: 2000, 32.0: 800, 128.0: 100}
LIBMYPAINT = {
    4.0: 26e6,
    8.0: 61e6,
    32.0: 124e6,
    128.0: 156e6,
}  # pixels of disc area a second, one thread (measured elsewhere)
SIDE = 2000.0  # pixels that scattered dabs lie in, along each axis
SCATTERED = {4.0: (4000, 3.0), 8.0: (3000, 4.0), 32.0: (800, 5.0)}  # how many, and how much faster they ought to be
WIDE = 250.0  # radius of the textured dab


def measure(small: bool = False) -> Iterator[Figure]:
    yield _textured(1 if small else REPEATS)
    slow = 1.0 if libmypaint.library() else slowness()
    repeats = 1 if small else REPEATS
    for radius, count in DABS.items():
        count = 4 if small else count
        along = [(300.0 + 300.0 * i / count, 300.0 + i % 7) for i in range(count)]
        yield _coverage(f"dabs, radius {radius:.0f}", radius, along, TIMES_FASTER, repeats, slow)
    for radius, (count, goal) in SCATTERED.items():
        places = SIDE * np.random.default_rng(1).random((4 if small else count, 2))
        yield _coverage(f"dabs, radius {radius:.0f}, scattered", radius, places.tolist(), goal, repeats, slow)


def _coverage(
    name: str, radius: float, places: list[tuple[float, float]], goal: float, repeats: int, slow: float
) -> Figure:
    """Many dabs, in portions as frames bring them."""
    count = len(places)
    laid = np.array([(x, y, radius, 0.5, 0.5, 0.5) for x, y in places])

    def own() -> None:
        mask = StrokeMask(0, (0, 0))
        for part in np.array_split(laid, max(1, count // 50)):
            mask.paint(part)

    area, there = count * math.pi * radius * radius, libmypaint.library() is not None
    own()  # compiles, and touches the memory
    times = [(processor(own), libmypaint.dabs(places, radius, 0.5) if there else 0.0) for _ in range(repeats)]
    taken, theirs = (min(column) for column in zip(*times, strict=True))
    bound, note = "libmypaint's, same dabs", "libmypaint measured in the same run, one thread"
    if not there:
        theirs = area / LIBMYPAINT[radius] * slow
        bound, note = "libmypaint's, scaled", f"its figure of another run, as copying takes {slow:.2f} x as long"
    return Figure(name, area / taken / 1e6, "Mpixel/s", bound, theirs / taken, goal, True, note)


def _textured(repeats: int) -> Figure:
    """One soft dab of rock: coverage, stamp and new pixels of its tiles; the rock's own picture is already there, as
    after the first dab of a stroke."""
    brush = Brush(radius=WIDE, hardness=0.3, colour="#604020", ink=(Component("rock", 0.8, "#d0c0a0"),))
    ink = resolve(brush, {}, 0, 0)
    old: dict[TileKey, Planes] = {}
    new = np.ones((7, 128, 128), np.float32)
    marks = np.ones((128, 128), np.uint8), np.ones((128, 2), np.int32)
    planes = np.arange(7)

    def own() -> None:
        mask = StrokeMask(0, (0, 0))
        mask.paint(Stroker(brush).add(np.array([[300.0, 300.0, 0.7]])))
        edit = edits.edit(brush, mask, ink)
        for key in edit.tiles:
            below = old.setdefault(key, Planes(np.full((7, 128, 128), 0.25, np.float32), ink.inks))
            stamp = edit.stamp(key, below)
            if stamp is not None:
                how = planes, stamp.plain, False, new, marks, FINE_STEP, NO_DITHER
                kernels.apply_stamp(below.data, stamp.keep, stamp.add, np.empty(0, np.float32), *how)

    own()
    moved = len(old) * 128 * 128 * (2 * 4 + 2 * 7 * 4)  # coverage and seven planes, read and written
    taken, copy = best(repeats, own, copying(moved))
    return Figure("a soft dab of rock", taken * 1e3, "ms", f"a copy of its {moved >> 20} MiB", taken / copy, 4.0)
