"""The values of a rectangle of pixels: premultiplied colour, alpha, and the amplitudes of the ink lying there."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cache, lru_cache
from typing import Any

import numpy as np

from engine.texture.record import Instance

_Order = tuple[Any, ...]  # of a key, by which keys are compared
COLOURS = 4  # red, green, blue, alpha
_NONE = -1, -1, -1
_FEW = 32  # planes that are copied one by one
_INSERTED = 8  # such a part of a stack, at most, is put into it one by one
_ORDERED = 1 << 13  # keys, and tuples within them, whose order is kept: of a stroke's three inks the line is one


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
    """Returns the union of several sets of ink instances, sorted by key, as each of the sets is."""
    stacks = [s for s in map(tuple, sets) if s]
    if not stacks:
        return ()
    first = stacks[0]
    if all(s is first or s == first for s in stacks):
        return first
    largest = max(stacks, key=len)
    known = set(map(id, largest))  # of many inks, most often one stack has nearly all: to hash and to sort them, whose
    # keys may be long, takes longer
    others = {id(ink): ink for s in stacks if s is not largest for ink in s if id(ink) not in known}
    if not others:
        return largest
    if len(others) * _INSERTED > len(largest):
        return tuple(sorted({ink for s in stacks for ink in s}, key=_order))
    return _with_others(largest, others.values())


def _with_others(sorted_inks: tuple[Instance, ...], others: Iterable[Instance]) -> tuple[Instance, ...]:
    """Returns sorted inks and a few others, each at its place, but those that are equal to one that is there."""
    found = list(sorted_inks)
    for ink in others:
        at = bisect_left(found, _order(ink), key=_order)
        if at == len(found) or found[at] != ink:
            found.insert(at, ink)
    return tuple(found)


def _order(ink: Instance) -> _Order:
    return sort_key(ink.key)


def sort_key(key: object) -> _Order:
    """Orders keys that mix strings, numbers and tuples."""
    if isinstance(key, tuple):
        return _sort_parts(key)
    return (1, key) if isinstance(key, str) else (0, key)


@lru_cache(_ORDERED)
def _sort_parts(key: tuple[object, ...]) -> _Order:
    return (2, *map(sort_key, key))


@cache
def _all_planes(count: int) -> np.ndarray:
    return np.arange(count, dtype=np.int64)  # writable all the same: kernels are compiled anew for arrays that are not


def plane_map(inks: tuple[Instance, ...], into: tuple[Instance, ...]) -> np.ndarray:
    """For each plane of a stack with the inks `into`, its index in a stack with `inks`, or -1: int64 (4 + 3n,).

    The array is not to be written to.
    """
    if inks is into or inks == into:
        return _all_planes(COLOURS + 3 * len(into))
    planes, known, count = list(range(COLOURS)), 0, len(inks)
    for ink in into:
        if known < count and inks[known] is ink:
            at = COLOURS + 3 * known
            planes += (at, at + 1, at + 2)
            known += 1
        else:
            planes += _NONE
    return np.array(planes, np.int64) if known == count else _looked_up(inks, into)


def _looked_up(inks: tuple[Instance, ...], into: tuple[Instance, ...]) -> np.ndarray:
    """As `plane_map`, whether the one holds all of the other or not, and whatever objects equal inks are."""
    places = {ink: COLOURS + 3 * i for i, ink in enumerate(inks)}
    planes = list(range(COLOURS))
    for ink in into:
        at = places.get(ink)
        planes += _NONE if at is None else (at, at + 1, at + 2)
    return np.array(planes, np.int64)


def widened(planes: Planes, inks: tuple[Instance, ...]) -> Planes:
    """Returns the same values in a stack that has room for more inks, contiguous."""
    if planes.inks == inks:
        return Planes(np.ascontiguousarray(planes.data), inks)
    out = np.zeros((COLOURS + 3 * len(inks), *planes.data.shape[1:]), np.float32)
    sources = plane_map(planes.inks, inks)
    if len(out) > _FEW:
        there = np.flatnonzero(sources >= 0)
        out[there] = planes.data[sources[there]]
        return Planes(out, inks)
    for c, source in enumerate(sources.tolist()):
        if source >= 0:
            out[c] = planes.data[source]
    return Planes(out, inks)
