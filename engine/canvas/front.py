"""A change of one level on its way up the pyramid: patches before and after, and the level above around them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from engine.canvas.evaluate import evaluate_sparse, step
from engine.canvas.rising import lifting
from engine.canvas.rising.spans import NO_COLUMNS, Marks
from engine.canvas.store import Pyramid
from engine.canvas.tile_cache import TileCache
from engine.numeric.address import Rect, TileKey
from engine.texture.planes import COLOURS, Planes, merged, plane_map, widened
from engine.texture.record import Instance

_CLIMBS = 14  # levels a change usually climbs before it is less than the grid can show


@dataclass(frozen=True, eq=False, slots=True)
class Patch:
    """What changed of one tile.

    `at`: the even rectangle that the arrays cover, within the tile; `dirty`: the one that holds all that changed.
    `old` (None: nothing lay there) has no inks that `new` has not; `keep` is A, float32 (h, w).
    `marks`: `changed`, uint8 (h, w), is not zero where A != 1 or v' != v; its bit 2 tells where v' != v, but not in the
    patches of an edit's own level; and `spans`, int32 (h, 2), the columns of each row in which any is marked.  Off
    them, and off the 2 x 2 pixels that they meet, only patches of an edit's own level have an A.
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
    """Values of a level around a change: the old ones, until the new ones take their place.

    `planes` is None where nothing lies.
    """

    def __init__(self, level: int, rect: Rect, planes: Planes | None) -> None:
        self.level, self.rect, self.planes = level, rect, planes
        self._whole = False

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


def halved(rect: Rect) -> Rect:
    """Returns the parents of an even rectangle, made even."""
    return rect.zoomed(-1).evened()


def united(rects: Iterable[Rect]) -> Rect:
    """Returns the smallest rectangle that holds all of some."""
    whole = Rect(0, 0, 0, 0)
    for rect in rects:
        whole = whole.union(rect)
    return whole


def climbs(
    pyramid: Pyramid, level: int, rect: Rect, cache: TileCache | None, known: list[Around] | None = None
) -> Iterator[Around]:
    """Yields what lies around a change of `rect` at the levels above its own, upwards: two pixels wider than it can
    reach, at least.

    They are computed downwards in one cascade, a dozen levels at a time.  `known`: some that are known, of larger
    rectangles, the finest first; those that are computed are added to it.
    """
    at, level = halved(rect), level - 1
    known = [] if known is None else known
    for around in list(known):
        yield around
        at, level = halved(around.rect.grown(-2)), around.level - 1
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
        found = [Around(level - j, *told) for j, told in enumerate(zip(rects, reversed(values), strict=True))]
        known += found
        yield from found
        level -= _CLIMBS


def known_around(pyramid: Pyramid, level: int, rect: Rect, cache: TileCache | None) -> list[Around]:
    """Returns what the newest commit left of the levels above a change, if that is all around it; none else.  It is the
    caller's from now on."""
    found = cache.front.taken(pyramid) if cache is not None else ()
    need = halved(rect).grown(2)
    if not found or found[0].level != level - 1 or found[0].rect.union(need) != found[0].rect:
        return []
    return [around for around in found if isinstance(around, Around)]


def cropped(patch: Patch, within: Rect) -> Patch | None:
    """Returns what of a patch lies in an even rectangle; None where nothing changes there."""
    at, dirty = patch.at.intersect(within), patch.dirty.intersect(within)
    if at == patch.at or dirty.empty:
        return None if dirty.empty else patch
    rows, columns = at.slices(patch.at)
    spans = np.clip(patch.marks[1][rows] - np.int32(columns.start), 0, at.width)
    spans[spans[:, 0] >= spans[:, 1]] = NO_COLUMNS
    old, new = (
        None if planes is None else Planes(np.ascontiguousarray(planes.data[:, rows, columns]), planes.inks)
        for planes in (patch.old, patch.new)
    )
    keep, marked = (np.ascontiguousarray(values[rows, columns]) for values in (patch.keep, patch.marks[0]))
    assert new is not None
    return Patch(patch.key, at, dirty, old, new, keep, (marked, spans), patch.spares_alpha)


def blank_marks(height: int, width: int) -> Marks:
    """Returns marks of which none is set; their spans are still to be told."""
    return np.zeros((height, width), np.uint8), np.empty((height, 2), np.int32)


def placed_extent(at: Rect, extent: tuple[int, int, int, int]) -> Rect:
    """Returns the rectangle y0, y1, x0, x1 of an array that covers `at`, as one of its level."""
    y0, y1, x0, x1 = extent
    return Rect(at.x0 + x0, at.y0 + y0, at.x0 + x1, at.y0 + y1)
