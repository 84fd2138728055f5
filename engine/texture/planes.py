"""The values of a rectangle of pixels: premultiplied colour, alpha, and the amplitudes of the ink lying there."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cache, lru_cache
from typing import Any

import numpy as np

from engine.texture.record import Instance

COLOURS = 4  # red, green, blue, alpha


@dataclass(frozen=True, eq=False, slots=True)
class Planes:
    """`data`: float32 (4 + 3n, h, w) on the grid: R, G, B, A premultiplied, then for each of the n `inks`, which are
    sorted by key, its red, green and blue amplitude (Perlin & Velho 1995, section 3.4)."""

    data: np.ndarray
    inks: tuple[Instance, ...] = ()

    @classmethod
    def empty(cls, height: int, width: int) -> Planes:
        """Makes the values of a rectangle on which nothing lies."""
        return cls(np.zeros((COLOURS, height, width), np.float32))

    @property
    def rgba(self) -> np.ndarray:
        """Gives colour and alpha: a view (4, h, w)."""
        return self.data[:COLOURS]

    def cut(self, rows: slice, columns: slice) -> Planes:
        """Gives a part: views, no copies."""
        return Planes(self.data[:, rows, columns], self.inks)


def merged(*sets: Iterable[Instance]) -> tuple[Instance, ...]:
    """Returns the union of several sets of ink instances, sorted by key."""
    stacks = [s for s in map(tuple, sets) if s]
    if not stacks:
        return ()
    first = stacks[0]
    if all(s is first or s == first for s in stacks):
        return first
    return tuple(sorted({ink for s in stacks for ink in s}, key=lambda ink: sort_key(ink.key)))


@lru_cache(4096)
def sort_key(key: object) -> tuple[Any, ...]:
    """Orders keys that mix strings, numbers and tuples."""
    if isinstance(key, tuple):
        return (2, *(sort_key(part) for part in key))
    return (1, key) if isinstance(key, str) else (0, key)


@cache
def _all_planes(count: int) -> np.ndarray:
    return np.arange(count, dtype=np.int64)  # writable all the same: kernels are compiled anew for arrays that are not


def plane_map(inks: tuple[Instance, ...], into: tuple[Instance, ...]) -> np.ndarray:
    """For each plane of a stack with the inks `into`, its index in a stack with `inks`, or -1: int64 (4 + 3n,).

    The array is not to be written to.
    """
    if inks is into or inks == into:
        return _all_planes(COLOURS + 3 * len(into))
    places = {ink: COLOURS + 3 * i for i, ink in enumerate(inks)}
    planes = list(range(COLOURS))
    for ink in into:
        at = places.get(ink)
        planes.extend((-1, -1, -1) if at is None else (at, at + 1, at + 2))
    return np.array(planes, np.int64)


def widened(planes: Planes, inks: tuple[Instance, ...]) -> Planes:
    """Returns the same values in a stack that has room for more inks, contiguous."""
    if planes.inks == inks:
        return Planes(np.ascontiguousarray(planes.data), inks)
    out = np.zeros((COLOURS + 3 * len(inks), *planes.data.shape[1:]), np.float32)
    for c, source in enumerate(plane_map(planes.inks, inks)):
        if source >= 0:
            out[c] = planes.data[source]
    return Planes(out, inks)
