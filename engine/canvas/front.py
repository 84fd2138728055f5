"""A change of one level on its way up the pyramid: patches before and after, and the level above around them."""

from __future__ import annotations

import functools
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from engine.canvas.dither import dithering
from engine.canvas.evaluate import evaluate_sparse, step
from engine.canvas.rising import lifting
from engine.canvas.rising.spans import Marks
from engine.canvas.store import Pyramid
from engine.canvas.tile_cache import TileCache
from engine.numeric.address import Rect, TileKey
from engine.texture.planes import COLOURS, Planes, merged, plane_map, widened
from engine.texture.record import Instance

_NOWHERE = 1 << 30, 0  # columns of a row in which nothing lies
_CLIMBS = 14  # levels a change usually climbs before it is less than the grid can show


@dataclass(frozen=True, eq=False, slots=True)
class Patch:
    """What changed of one tile.

    `at`: the even rectangle that the arrays cover, within the tile; `dirty`: the one that holds all that changed.
    `old` (None: nothing lay there) and `new` have the same inks; `keep` is A, float32 (h, w).
    `marks`: `changed`, uint8 (h, w), is not zero where A != 1 or v' != v; its bit 2 tells where v' != v, but not in the
    patches of an edit's own level; and `spans`, int32 (h, 2), the columns of each row in which any is marked.  Off
    them, and off the 2 x 2 pixels that they meet, only patches of an edit's own level have values.
    """

    key: TileKey
    at: Rect
    dirty: Rect
    old: Planes | None
    new: Planes
    keep: np.ndarray
    marks: Marks
    spares_alpha: bool = False  # whether the change leaves alpha alone, at all levels


class Around:
    """Values of a level around a change: the old ones, until `take` puts the new ones in their place.

    `planes` is None where nothing lies, `blank` whether nothing did; `moved`, uint8, has bit 2 where `mark` was told
    that a value changes.
    """

    def __init__(self, level: int, rect: Rect, planes: Planes | None) -> None:
        self.level, self.rect, self.planes = level, rect, planes
        self.blank, self._whole = planes is None, False
        self.moved: np.ndarray | None = None

    def with_inks(self, inks: tuple[Instance, ...]) -> Planes:
        """Returns the planes, which from now on are contiguous and have room for these inks."""
        if self._whole and self.planes is not None and (not inks or inks == self.planes.inks):
            return self.planes
        self._whole = True
        if self.planes is None:
            size = self.rect.height, self.rect.width
            self.planes = Planes(np.zeros((COLOURS + 3 * len(inks), *size), np.float32), inks)
        else:
            self.planes = widened(self.planes, merged(self.planes.inks, inks))
        return self.planes

    def take(self, patches: Sequence[Patch]) -> None:
        """Puts the new values of patches of this level in their places."""
        whole = self.with_inks(merged(*(patch.new.inks for patch in patches)))
        for patch in patches:
            planes, (_, spans) = plane_map(patch.new.inks, whole.inks), patch.marks
            top, left = patch.at.y0 - self.rect.y0, patch.at.x0 - self.rect.x0
            lifting.place_changed(patch.new.data, planes, spans, whole.data, top, left)

    def mark(self, patches: Sequence[Patch]) -> None:
        """Notes where patches of this level change it."""
        self.moved = np.zeros((self.rect.height, self.rect.width), np.uint8)
        for patch in patches:
            self.moved[patch.at.slices(self.rect)] = patch.marks[0]

    def spread(self, rect: Rect, touched: Marks) -> bool:
        """Marks the children of changed pixels in `touched`, over the even `rect`, and tells the columns of each row
        with marks; returns whether there is any."""
        corner = rect.parents()
        top, left, moved = corner.y0 - self.rect.y0, corner.x0 - self.rect.x0, self.moved
        if moved is None:
            top, left, moved = 0, 0, np.zeros((corner.height, corner.width), np.uint8)
        out: bool = lifting.spread(moved, top, left, *touched)
        return out


def halved(rect: Rect) -> Rect:
    """Returns the parents of an even rectangle, made even."""
    return rect.zoomed(-1).evened()


def united(rects: Iterable[Rect]) -> Rect:
    """Returns the smallest rectangle that holds all of some."""
    whole = Rect(0, 0, 0, 0)
    for rect in rects:
        whole = whole.union(rect)
    return whole


def climbs(pyramid: Pyramid, level: int, rect: Rect, cache: TileCache | None) -> Iterator[Around]:
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
        for j, (around, value) in enumerate(zip(rects, reversed(values), strict=True)):
            yield Around(level - j, around, value)
        level -= _CLIMBS


def cropped(patch: Patch, within: Rect) -> Patch | None:
    """Returns what of a patch lies in an even rectangle; None where nothing changes there."""
    at, dirty = patch.at.intersect(within), patch.dirty.intersect(within)
    if at == patch.at or dirty.empty:
        return None if dirty.empty else patch
    rows, columns = at.slices(patch.at)
    spans = np.clip(patch.marks[1][rows] - np.int32(columns.start), 0, at.width)
    spans[spans[:, 0] >= spans[:, 1]] = _NOWHERE
    old, new = (
        None if planes is None else Planes(np.ascontiguousarray(planes.data[:, rows, columns]), planes.inks)
        for planes in (patch.old, patch.new)
    )
    keep, marked = (np.ascontiguousarray(values[rows, columns]) for values in (patch.keep, patch.marks[0]))
    assert new is not None
    return Patch(patch.key, at, dirty, old, new, keep, (marked, spans), patch.spares_alpha)


def lift(pyramid: Pyramid, patches: Sequence[Patch], above: Around) -> list[Patch]:
    """Rule U: the patches of the level above, whose old values `above` holds; none where nothing changes there."""
    groups: dict[tuple[int, int], list[Patch]] = {}
    for patch in patches:
        groups.setdefault((patch.key.x >> 1, patch.key.y >> 1), []).append(patch)
    held = above.with_inks(merged(*(patch.new.inks for patch in patches)))
    keys = ((TileKey(above.level, *place), group) for place, group in groups.items())
    lifted = (_lifted(pyramid, key, group, above.rect, held) for key, group in keys)
    return [patch for patch in lifted if patch is not None]


def _lifted(pyramid: Pyramid, key: TileKey, below: Sequence[Patch], around: Rect, held: Planes) -> Patch | None:
    """Rule U on what some patches make of one tile of the level above; `held` has its old values over `around`."""
    at = halved(united(patch.dirty.evened() for patch in below))
    inks, size, unit = held.inks, (at.height, at.width), pyramid.step
    keep, parents = np.empty(size, np.float32), np.zeros(size, np.uint8)
    lowered = np.empty((2, len(held.data), *size), np.float32), keep, parents, np.empty((at.height, 2), np.int32)
    lowered[3][:] = _NOWHERE
    for patch in below:
        part = patch.dirty.evened()
        maps = _none(len(inks)), plane_map(patch.new.inks, inks)
        sources = patch.new.data, patch.new.data
        if patch.old is not None:
            maps, sources = (maps[1], maps[1]), (patch.old.data, patch.new.data)
        window = (
            part.y0 - patch.at.y0, part.x0 - patch.at.x0, part.height >> 1, part.width >> 1,
            (part.y0 >> 1) - at.y0, (part.x0 >> 1) - at.x0,
        )  # fmt: skip
        lifting.lower(sources, maps, patch.keep, patch.marks, window, lowered, unit)
    spares = below[0].spares_alpha
    values, marks = np.empty_like(lowered[0]), blank_marks(*size)
    corner = at.y0 - around.y0, at.x0 - around.x0
    x, y = key.rect.x0, key.rect.y0
    dither = dithering(unit, pyramid.commits + 1, key, Rect(at.x0 - x, at.y0 - y, at.x1 - x, at.y1 - y), keep)
    extent = lifting.climb(lowered, spares, held.data, corner, values, marks, unit, dither)
    dirty = placed_extent(at, extent)
    if dirty.empty:
        return None
    return Patch(key, at, dirty, Planes(values[0], inks), Planes(values[1], inks), keep, marks, spares)


def blank_marks(height: int, width: int) -> Marks:
    """Returns marks of which none is set; their spans are still to be told."""
    return np.zeros((height, width), np.uint8), np.empty((height, 2), np.int32)


@functools.cache
def _none(inks: int) -> np.ndarray:
    """Returns a map of planes that takes none; not to be written to."""
    return np.full(COLOURS + 3 * inks, -1, np.int64)


def placed_extent(at: Rect, extent: tuple[int, int, int, int]) -> Rect:
    """Returns the rectangle y0, y1, x0, x1 of an array that covers `at`, as one of its level."""
    y0, y1, x0, x1 = extent
    return Rect(at.x0 + x0, at.y0 + y0, at.x0 + x1, at.y0 + y1)
