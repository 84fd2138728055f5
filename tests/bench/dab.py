"""Soft dabs: laid into a stroke's coverage, against libmypaint's; and one of rock through to pixels, against memcpy."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from bench import Figure, libmypaint
from bench.clock import best, copying, slowness
from engine.brush import edits
from engine.brush.dabs import Stroker
from engine.brush.ink import resolve
from engine.brush.mask import StrokeMask
from engine.brush.settings import Brush, Component
from engine.canvas import kernels
from engine.numeric.address import TileKey
from engine.texture.planes import Planes

REPEATS = 15
TIMES_FASTER = 5.0
DABS = {8.0: 2000, 32.0: 800, 128.0: 100}
LIBMYPAINT = {8.0: 61e6, 32.0: 124e6, 128.0: 156e6}  # pixels of disc area a second, one thread (measured elsewhere)
WIDE = 250.0  # radius of the textured dab


def measure(small: bool = False) -> Iterator[Figure]:
    yield _textured(1 if small else REPEATS)
    slow = 1.0 if libmypaint.library() else slowness()
    for radius, count in DABS.items():
        yield _coverage(radius, 4 if small else count, 1 if small else REPEATS, slow)


def _coverage(radius: float, count: int, repeats: int, slow: float) -> Figure:
    """Many dabs along a line, in portions as frames bring them."""
    places = [(300.0 + 300.0 * i / count, 300.0 + i % 7) for i in range(count)]
    laid = np.array([(x, y, radius, 0.5, 0.5, 0.5) for x, y in places])

    def own() -> None:
        mask = StrokeMask(0, (0, 0))
        for part in np.array_split(laid, max(1, count // 50)):
            mask.paint(part)

    area = count * math.pi * radius * radius
    if libmypaint.library():
        taken, theirs = best(repeats, own, lambda: libmypaint.dabs(places, radius, 0.5))
        bound, note = "libmypaint's, same dabs", "libmypaint measured in the same run, one thread"
    else:
        [taken], theirs = best(repeats, own), area / LIBMYPAINT[radius] * slow
        bound, note = "libmypaint's, scaled", f"its figure of another run, as copying takes {slow:.2f} x as long"
    name = f"dabs, radius {radius:.0f}"
    return Figure(name, area / taken / 1e6, "Mpixel/s", bound, theirs / taken, TIMES_FASTER, True, note)


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
                kernels.apply_stamp(below.data, stamp.keep, stamp.add, planes, stamp.plain, False, new, marks)

    own()
    moved = len(old) * 128 * 128 * (2 * 4 + 2 * 7 * 4)  # coverage and seven planes, read and written
    taken, copy = best(repeats, own, copying(moved))
    return Figure("a soft dab of rock", taken * 1e3, "ms", f"a copy of its {moved >> 20} MiB", taken / copy, 4.0)
