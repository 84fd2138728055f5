"""Heights that brushes laid on a layer beside its paint, as fine at level 16 as at level 0.

A layer's heaps are pyramids by their exponent e, in units of 2^e pixels of level 0; the land is that much higher, all
heaps together.  A stroke goes to the heap whose unit is 4 to 64 times the height that it lays, so that a stone of 4
pixels of level 40 is stored in steps as fine, seen from there, as one of 4 pixels of level 0, and strokes add up many
times before a heap is full.  A heap is a pyramid as any other: edits, rule U, evaluation, files are the layers' own.
Red, green and blue of it are the same height, alpha is 0.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator

import immutables
import numpy as np

from engine.canvas.store import Pyramid, Record
from engine.numeric.address import Rect
from engine.texture.even_planes import EvenPlanes

Heaps = immutables.Map[int, Pyramid]
NO_HEAPS: Heaps = immutables.Map()
NO_HEAP = Pyramid()
MOST_INK = 2.0  # likewise of an ink's amplitude
MOST_HEAPED = 8.0  # units: the most that lies in a heap; up to there all sums are exact
_ROOM, _APART = 2, 4  # bits of room above a stroke's height; heaps are so many octaves apart
_OWN = 14  # octaves of its own pixels that the unit of what a stroke touches may have, at most
_AROUND = 3  # pixels around a rectangle of a level that have a part in it


def exponent(height: float, level: int) -> int:
    """Returns the exponent of the heap that a height goes to, in pixels of a level; it is not 0."""
    octaves = math.frexp(height)[1] - level + _ROOM
    return -(-octaves // _APART) * _APART


def share(height: float, level: int, unit: int) -> float:
    """Returns a height, in pixels of a level, in units of 2^unit pixels of level 0."""
    return math.ldexp(height, -level - unit)


def of_scale(heaps: Heaps, level: int) -> Iterator[int]:
    """Yields the exponents of heaps that were laid on a scale like that of a level, or a finer one: what an eraser
    takes there, and a smoother smooths.  A stone is taken off a mountain, and the mountain stays."""
    return (unit for unit in sorted(heaps) if unit + level <= _OWN)


def lies(heap: Pyramid, level: int, rect: Rect) -> bool:
    """Tells whether a heap may be other than flat in a rectangle of a level."""
    return any(heap.has_records(k, rect.zoomed(k - level).grown(_AROUND)) for k in heap.levels if k <= level)


def held_once(records: Iterable[Record | None]) -> None:
    """Holds the planes of a heap's new records, which are the same, once: a quarter of the bytes."""
    for record in records:
        data = None if record is None else record.held
        even = EvenPlanes.of(data) if isinstance(data, np.ndarray) else None
        if record is not None and even is not None:
            record.exchange(even)


def own_lines(heaps: Heaps) -> Heaps:
    """Returns the same heaps at the start of lines of history of their own."""
    return immutables.Map({unit: heap.branched() for unit, heap in heaps.items()})
