"""A front: one level's rectangle before and after a change, on its way up the pyramid."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from engine.canvas import kernels
from engine.canvas.evaluate import TileCache, evaluate, evaluate_sparse, step
from engine.canvas.store import Pyramid
from engine.numeric.address import Rect
from engine.texture.planes import COLOURS, Planes, merged, plane_map
from engine.texture.record import Instance

_CLIMBS = 14  # levels a change usually climbs before it is less than the grid can show


@dataclass(frozen=True, eq=False, slots=True)
class Front:
    """`rect` is even; `old` and `new` have the same inks; `keep` is A, float32 (h, w); `changed`, uint8 (h, w), marks
    where A != 1 or v' != v."""

    level: int
    rect: Rect
    old: Planes
    new: Planes
    keep: np.ndarray
    changed: np.ndarray
    spares_alpha: bool = False  # whether the change leaves alpha alone, at all levels


@dataclass(frozen=True, eq=False, slots=True)
class Surroundings:
    """Old values of a level around a change: `planes` over `rect`, None where nothing lies."""

    rect: Rect
    planes: Planes | None


@dataclass(frozen=True, eq=False, slots=True)
class Below:
    """What rule U reads of the level below, at this level's resolution: R v before and after, R A, and which pixels are
    parents of changed ones.  Planes (4 + 3n, h, w) with `inks`, others (h, w); zero where nothing changed."""

    old: np.ndarray
    new: np.ndarray
    keep: np.ndarray
    parents: np.ndarray
    inks: tuple[Instance, ...]

    @classmethod
    def blank(cls, rect: Rect, inks: tuple[Instance, ...]) -> Below:
        """Makes one for a rectangle where nothing lies and nothing has changed."""
        planes, size = COLOURS + 3 * len(inks), (rect.height, rect.width)
        old, new = np.zeros((planes, *size), np.float32), np.zeros((planes, *size), np.float32)
        return cls(old, new, np.zeros(size, np.float32), np.zeros(size, np.uint8), inks)

    def add(self, old: Planes | None, new: Planes, keep: np.ndarray, changed: np.ndarray, top: int, left: int) -> None:
        """Reduce one even rectangle of the level below into the place whose corner is (top, left)."""
        if old is not None:
            kernels.halve(old.data, plane_map(old.inks, self.inks), self.old, top, left)
        kernels.halve(new.data, plane_map(new.inks, self.inks), self.new, top, left)
        kernels.halve(keep[None], _FIRST, self.keep[None], top, left)
        kernels.halve_marks(changed, self.parents, top, left)


_FIRST = np.zeros(1, np.int64)


def widened(planes: Planes, inks: tuple[Instance, ...]) -> Planes:
    """Returns the same values in a stack that has room for more inks, contiguous."""
    if planes.inks == inks:
        return Planes(np.ascontiguousarray(planes.data), inks)
    out = np.zeros((COLOURS + 3 * len(inks), *planes.data.shape[1:]), np.float32)
    for c, source in enumerate(plane_map(planes.inks, inks)):
        if source >= 0:
            out[c] = planes.data[source]
    return Planes(out, inks)


def halved(rect: Rect) -> Rect:
    """Returns the parents of an even rectangle, made even."""
    return rect.zoomed(-1).evened()


def climbs(pyramid: Pyramid, level: int, rect: Rect, cache: TileCache | None) -> Iterator[Surroundings]:
    """Yields what lies around a change of `rect` at the levels above its own, upwards: two pixels wider than it can
    reach.

    They are computed downwards in one cascade, a dozen levels at a time.
    """
    at, level = halved(rect), level - 1
    while True:
        rects = []
        for _ in range(_CLIMBS):
            rects.append(at.grown(2))
            at = halved(at)
        value = evaluate_sparse(pyramid, level - _CLIMBS + 1, rects[-1], cache)
        values = [value]
        for j in range(_CLIMBS - 2, -1, -1):
            value = step(pyramid, value, rects[j + 1], level - j, rects[j])
            values.append(value)
        yield from map(Surroundings, rects, reversed(values))
        level -= _CLIMBS


def climbed(front: Front, above: Surroundings) -> Front | None:
    """Rule U: the front one level up, None when nothing changes there."""
    at = halved(front.rect)
    inks = merged(() if above.planes is None else above.planes.inks, front.old.inks)
    below = Below.blank(at, inks)
    top, left = (front.rect.y0 >> 1) - at.y0, (front.rect.x0 >> 1) - at.x0
    below.add(front.old, front.new, front.keep, front.changed, top, left)
    return lifted(front.level - 1, at, below, above, front.spares_alpha)


def lifted(level: int, rect: Rect, below: Below, above: Surroundings, spares_alpha: bool) -> Front | None:
    """Rule U on `rect` of `level`, whose old values `above` holds; None when nothing changes."""
    if above.planes is None:
        before = Planes(np.zeros_like(below.old), below.inks)
    else:
        before = widened(above.planes.cut(*rect.slices(above.rect)), below.inks)
    new, changed = np.empty_like(before.data), np.empty_like(below.parents)
    if not kernels.climb(below.old, below.new, below.keep, below.parents, spares_alpha, before.data, new, changed):
        return None
    return Front(level, rect, before, Planes(new, below.inks), below.keep, changed, spares_alpha)


def cut_front(front: Front, rect: Rect) -> Front | None:
    """Returns the part of a front inside `rect`, whose corners are even."""
    at = front.rect.intersect(rect)
    if at.empty:
        return None
    window = at.slices(front.rect)
    old = widened(front.old.cut(*window), front.old.inks)
    new = widened(front.new.cut(*window), front.new.inks)
    keep, changed = np.ascontiguousarray(front.keep[window]), np.ascontiguousarray(front.changed[window])
    return Front(front.level, at, old, new, keep, changed, front.spares_alpha)


def joined(pyramid: Pyramid, fronts: Sequence[Front], cache: TileCache | None) -> Front:
    """Fronts of one level that do not overlap, as one; unchanged in between."""
    rect = Rect(0, 0, 0, 0)
    for front in fronts:
        rect = rect.union(front.rect)
    level = fronts[0].level
    around = evaluate(pyramid, level, rect, cache)
    inks = merged(around.inks, *(front.old.inks for front in fronts))
    old = widened(around, inks)
    new = old.data.copy()
    keep = np.ones((rect.height, rect.width), np.float32)
    changed = np.zeros((rect.height, rect.width), np.uint8)
    for front in fronts:
        rows, columns = front.rect.slices(rect)
        new[:, rows, columns] = widened(front.new, inks).data
        keep[rows, columns], changed[rows, columns] = front.keep, front.changed
    return Front(level, rect, old, Planes(new, inks), keep, changed, fronts[0].spares_alpha)
