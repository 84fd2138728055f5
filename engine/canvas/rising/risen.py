"""What a change makes of the levels above its own: rule U, level by level, each at once for all its tiles."""

from __future__ import annotations

import functools
from collections.abc import Iterator, Sequence

import numpy as np

from engine.canvas.dither import NO_DITHER, dithering
from engine.canvas.front import Around, Patch, placed_extent
from engine.canvas.rising import lifting, spreading
from engine.canvas.rising.spans import NO_COLUMNS, STRIP_WIDTH, Lowered, Marks
from engine.canvas.store import Pyramid
from engine.numeric.address import TILE, Rect, TileKey
from engine.numeric.grid import FINE_STEP
from engine.texture.planes import COLOURS, Planes, merged, plane_map
from engine.texture.record import Instance


class Risen:
    """A level above a change: its values around it, which become the new ones where it changes them.

    `planes`: float32 (C, h, w) over `rect`; `lowered`: A and the marks there, and the columns of each row in which any
    is marked, in strips of `STRIP_WIDTH` columns; `means`: what rule U reads of the level below, (2, C, h, w), before
    and after, where that is not made piece by piece; `was`: the old values, if they are asked for.
    """

    def __init__(self, around: Around, inks: tuple[Instance, ...]) -> None:
        self.around, self.level, self.rect = around, around.level, around.rect
        self.planes = around.with_inks(inks)
        size = self.rect.height, self.rect.width
        self.lowered: Lowered = (
            np.empty(size, np.float32),
            np.zeros(size, np.uint8),
            _nowhere(size[0], _places(self.rect, STRIP_WIDTH)),
        )
        self.means: Planes | None = None
        self.was: np.ndarray | None = None

    @functools.cached_property
    def by_tiles(self) -> np.ndarray:
        """Gives the columns of each row in which any pixel is marked, by tile: int32 (h, T, 2)."""
        spans, tiles = self.lowered[2], _places(self.rect, TILE)
        pairs, odd = _nowhere(len(spans), 2 * tiles), self.rect.x0 // STRIP_WIDTH & 1
        pairs[:, odd : odd + spans.shape[1]] = spans
        both = pairs.reshape(len(spans), tiles, 2, 2)
        return np.stack([both[..., 0].min(axis=2), both[..., 1].max(axis=2)], axis=-1)

    def patches(self, spares_alpha: bool) -> list[Patch]:
        """Returns what changed by tile, of a level whose old values were asked for."""
        return [
            self._patch(key, dirty.evened(), dirty, spares_alpha)
            for key, dirty in boxed(self.level, self.rect, self.by_tiles)
        ]

    def _patch(self, key: TileKey, at: Rect, dirty: Rect, spares_alpha: bool) -> Patch:
        rows, columns = at.slices(self.rect)
        spans = self.by_tiles[rows, key.x - self.rect.x0 // TILE] - np.int32(columns.start)
        spans[spans[:, 0] >= spans[:, 1]] = NO_COLUMNS
        assert self.was is not None
        parts = self.was, self.planes.data, *self.lowered[:2]
        old, new, keep, marks = (np.ascontiguousarray(part[..., rows, columns]) for part in parts)
        inks = self.planes.inks
        return Patch(key, at, dirty, Planes(old, inks), Planes(new, inks), keep, (marks, spans), spares_alpha)


def rise(
    pyramid: Pyramid, patches: Sequence[Patch], levels: Iterator[Around], most: int | None = None
) -> tuple[list[Risen], bool]:
    """Rule U: returns what some patches of a level make of those above, whose old values `levels` has, the finest
    first: up to the first that does not change, or `most` of them; and whether the last of them changes."""
    inks = merged(*(patch.new.inks for patch in patches))
    here, found = Risen(next(levels), inks), list[Risen]()
    while True:
        found.append(here)
        if len(found) == most:
            here.was = here.planes.data.copy()
        above = _above(here, levels)
        if here.means is None:
            count = _risen_from(pyramid, patches, here, above)
        else:
            count = _climbed(pyramid, here, above, patches[0].spares_alpha)
        if not count or len(found) == most:
            return found, count > 0
        here = above


def _above(here: Risen, levels: Iterator[Around]) -> Risen:
    """Returns the next level, before anything of it changes."""
    above = Risen(next(levels), here.planes.inks)
    above.means = Planes(np.empty((2, len(here.planes.data), *above.lowered[0].shape), np.float32), here.planes.inks)
    return above


def _risen_from(pyramid: Pyramid, patches: Sequence[Patch], here: Risen, above: Risen) -> int:
    """Has patches change the level above them, each a quarter of a tile, and what that makes of the next level."""
    inks, unit, count = here.planes.inks, pyramid.step, 0
    noise = NO_DITHER if unit == FINE_STEP else np.empty(here.lowered[0].shape, np.float32)
    room, spare = np.empty((TILE // 2) ** 2 * 2 * len(here.planes.data), np.float32), _spare(here)
    assert above.means is not None
    onto = _onto(here.rect, above.rect)
    for patch in patches:
        part = patch.dirty.evened()
        strip = part.x0 // TILE - here.rect.x0 // STRIP_WIDTH
        to = Rect(part.x0 >> 1, part.y0 >> 1, part.x1 >> 1, part.y1 >> 1)
        top, left = to.y0 - here.rect.y0, to.x0 - here.rect.x0
        at = to.evened()
        rows, columns = at.slices(here.rect)
        means = room[: 2 * len(here.planes.data) * at.area].reshape(2, -1, at.height, at.width)
        within = (means, (rows.start, columns.start))
        maps = _none(len(inks)), plane_map(patch.new.inks, inks)
        sources = patch.new.data, patch.new.data
        if patch.old is not None:
            maps, sources = (plane_map(patch.old.inks, inks), maps[1]), (patch.old.data, patch.new.data)
        read = part.y0 - patch.at.y0, part.x0 - patch.at.x0, to.height, top, left, strip
        lifting.lower(sources, maps, patch.keep, patch.marks, read, within, here.lowered, unit)
        if noise.size:
            _sow(pyramid, here, at, noise)
        window = (rows.start, rows.stop, strip, strip + 1, *onto)
        count += lifting.climb(
            within, here.lowered, here.planes.data, window, (above.means.data, (0, 0)), above.lowered, spare,
            patch.spares_alpha, unit, noise,
        )  # fmt: skip
    return count


def _climbed(pyramid: Pyramid, here: Risen, above: Risen, spares: bool) -> int:
    """Has what the level below makes of one change it, and what that makes of the next level."""
    unit, noise = pyramid.step, NO_DITHER
    assert here.means is not None
    assert above.means is not None
    means = here.means.data
    if here.means.inks != here.planes.inks:  # of some nothing lies in the change
        planes = plane_map(here.means.inks, here.planes.inks)
        means = np.where((planes >= 0)[:, None, None], means[:, planes], np.float32(0.0))
    if unit != FINE_STEP:
        noise = np.empty(here.lowered[0].shape, np.float32)
        for _, box in boxed(here.level, here.rect, here.by_tiles):
            _sow(pyramid, here, box.evened(), noise)
        del here.by_tiles
    window = (0, here.rect.height, 0, here.lowered[2].shape[1], *_onto(here.rect, above.rect))
    coarser = above.means.data, (0, 0)
    count: int = lifting.climb(
        (means, (0, 0)), here.lowered, here.planes.data, window, coarser, above.lowered, _spare(here), spares, unit,
        noise,
    )  # fmt: skip
    return count


def _sow(pyramid: Pyramid, here: Risen, at: Rect, noise: np.ndarray) -> None:
    """Writes what is added before values are rounded to the coarse grid, within a rectangle of one tile."""
    key = TileKey(here.level, at.x0 // TILE, at.y0 // TILE)
    x, y, part = key.x * TILE, key.y * TILE, at.slices(here.rect)
    inner = Rect(at.x0 - x, at.y0 - y, at.x1 - x, at.y1 - y)
    keep = np.ascontiguousarray(here.lowered[0][part])
    noise[part] = dithering(pyramid.step, pyramid.commits + 1, key, inner, keep)


def _spare(here: Risen) -> tuple[np.ndarray, np.ndarray]:
    """Returns rows that `lifting.climb` writes over."""
    return np.empty((2, len(here.planes.data), STRIP_WIDTH), np.float32), np.empty(STRIP_WIDTH, np.uint8)


def _onto(rect: Rect, above: Rect) -> tuple[int, int, int, int]:
    """Returns where the pixels, and the strips, of a level lie in the next coarser one, as `lifting.climb` is told."""
    strip = rect.x0 // STRIP_WIDTH
    return (rect.y0 >> 1) - above.y0, (rect.x0 >> 1) - above.x0, strip & 1, (strip >> 1) - above.x0 // STRIP_WIDTH


def _places(rect: Rect, side: int) -> int:
    """Counts the columns of tiles, or of strips, that a rectangle meets."""
    return (rect.x1 - 1) // side - rect.x0 // side + 1


def _nowhere(height: int, places: int) -> np.ndarray:
    """Returns spans in which nothing lies."""
    spans = np.empty((height, places, 2), np.int32)
    spans[...] = NO_COLUMNS
    return spans


@functools.cache
def _none(inks: int) -> np.ndarray:
    """Returns a map of planes that takes none; not to be written to."""
    return np.full(COLOURS + 3 * inks, -1, np.int64)


def boxed(level: int, rect: Rect, spans: np.ndarray) -> list[tuple[TileKey, Rect]]:
    """Returns the tiles in which spans over a rectangle of a level, int32 (h, T, 2), hold anything, with the
    rectangle of the level in which they do."""
    x, y = rect.x0 // TILE, rect.y0 // TILE
    found = np.empty(((rect.y1 - 1) // TILE - y + 1, spans.shape[1], 4), np.int32)
    spreading.boxes(spans, rect.y0 % TILE, found)
    rows, columns = np.nonzero(found[:, :, 1])
    return [
        (TileKey(level, x + column, y + row), placed_extent(rect, extent))
        for row, column, extent in zip(rows.tolist(), columns.tolist(), found[rows, columns].tolist(), strict=True)
    ]


class Touched:
    """Where the residuals of a level change, by tile: marks over a rectangle, and the columns of each row that hold
    them."""

    def __init__(self, level: int, rect: Rect, marks: Marks) -> None:
        self.level, self.rect, self.marks = level, rect, marks

    @classmethod
    def of_patches(cls, patches: Sequence[Patch], above: Risen) -> Touched:
        """Takes what changed of the tiles of a level, and the children of what moved above."""
        rect = above.rect.grown(-2).zoomed(1).grown(2)
        marks, spans = (
            np.zeros((rect.height, rect.width), np.uint8),
            np.zeros((rect.height, _places(rect, TILE), 2), np.int32),
        )
        for patch in patches:
            rows, columns = patch.dirty.slices(rect)
            there = patch.dirty.slices(patch.at)
            marks[rows, columns] = patch.marks[0][there]
            spans[rows, patch.key.x - rect.x0 // TILE] = patch.marks[1][there[0]] + np.int32(patch.at.x0 - rect.x0)
        return cls(patches[0].key.level, rect, (marks, spans))._spread(above)

    @classmethod
    def of_level(cls, here: Risen, above: Risen) -> Touched:
        """Takes what changed of a level, and the children of what moved above; its own marks are used up."""
        return cls(here.level, here.rect, (here.lowered[1], here.by_tiles.copy()))._spread(above)

    def _spread(self, above: Risen) -> Touched:
        corner = (self.rect.y0 >> 1) - 1 - above.rect.y0, (self.rect.x0 >> 1) - 1 - above.rect.x0
        spreading.spread(above.lowered[1:], corner, self.marks, self.rect.x0 % TILE)
        return self

    def tiles(self) -> list[tuple[TileKey, Rect]]:
        """Returns the tiles with the even rectangles in which they are touched."""
        return [(key, box.evened()) for key, box in boxed(self.level, self.rect, self.marks[1])]

    def within(self, part: Rect) -> np.ndarray:
        """Returns the marks of a rectangle."""
        return np.ascontiguousarray(self.marks[0][part.slices(self.rect)])

    def spans(self, key: TileKey, part: Rect) -> np.ndarray:
        """Returns the columns of each row of a rectangle in a tile, from its left edge on."""
        rows, columns = part.slices(self.rect)
        spans: np.ndarray = self.marks[1][rows, key.x - self.rect.x0 // TILE] - np.int32(columns.start)
        spans[spans < 0] = 0
        return spans
