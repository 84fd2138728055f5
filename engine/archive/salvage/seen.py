"""A layer's picture, as other programs see it, and where a layer shows something else."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from engine.archive.imports import Pasted, pasted
from engine.archive.salvage.finer_levels import with_values
from engine.canvas.commit import commit
from engine.canvas.evaluate import evaluate
from engine.canvas.growth import Growth, meets
from engine.canvas.store import Pyramid
from engine.numeric.address import TILE, Rect, TileKey
from engine.numeric.arithmetic import FINE
from engine.numeric.colour import from_rgba8, from_rgba16, to_rgba8
from engine.numeric.grid import snapped
from engine.numeric.pyramid import reduce

ROUNDING = np.float32(1.02 / 255)  # of premultiplied values that have gone through straight ones of 8 bits
_SPREAD = 4  # pixels of a level around the frame that see the next coarser one's within it
ROWS_AT_ONCE = 256  # of a picture that is made smaller


class Shown:
    """A picture, uint8 or uint16 RGBA (h, w, 4), and where it lies: `rect` of `level`; `frame`: the pixels of that
    level of which it tells, that around it there is nothing."""

    def __init__(self, pixels: np.ndarray, rect: Rect, level: int = 0, frame: Rect | None = None) -> None:
        self.pixels, self.rect, self.level = pixels, rect, level
        self.frame = rect if frame is None else frame.union(rect)
        self._smaller: list[tuple[Rect, np.ndarray]] = []  # at the next coarser level and on

    def laid(self, grid: int) -> Pyramid:
        """Returns a layer of nothing else, on a grid of so many bits."""
        if self.level == 0 and grid == FINE:
            return pasted(iter([self.pixels]), self.rect.x0, self.rect.y0)
        return commit(Pyramid(grid=grid), Pasted(self.pixels, self.rect, self.level))

    def planes(self, level: int, rect: Rect) -> np.ndarray:
        """Returns what the picture is like over `rect` of its level or a coarser one: float32 (4, h, w) on the grid, 0
        outside it."""
        if level == self.level:
            part = rect.intersect(self.rect)
            pixels = np.ascontiguousarray(self.pixels[part.slices(self.rect)])
            return _padded((from_rgba16 if pixels.dtype == np.uint16 else from_rgba8)(pixels), part, rect)
        while len(self._smaller) < self.level - level:
            self._smaller.append(self._next())
        at, planes = self._smaller[self.level - level - 1]
        part = rect.intersect(at)
        return _padded(planes[:, *part.slices(at)], part, rect)

    def _next(self) -> tuple[Rect, np.ndarray]:
        """Returns the picture at the next coarser level, and the rectangle that it takes there."""
        finer, (at, _) = len(self._smaller), self._smaller[-1] if self._smaller else (self.rect, None)
        whole = at.evened()
        rows = range(whole.y0, whole.y1, ROWS_AT_ONCE)
        bands = (Rect(whole.x0, y, whole.x1, min(y + ROWS_AT_ONCE, whole.y1)) for y in rows)
        planes = [snapped(reduce(self.planes(self.level - finer, band))) for band in bands]
        return whole.zoomed(-1), np.concatenate(planes, axis=1)

    def within(self, level: int) -> Rect:
        """Returns the pixels of a level, the picture's or a coarser one, all of which lie in the frame."""
        by, frame = self.level - level, self.frame
        return Rect(-(-frame.x0 >> by), -(-frame.y0 >> by), frame.x1 >> by, frame.y1 >> by)

    def is_same(self, seen: np.ndarray | None, rect: Rect) -> np.ndarray:
        """Tells where what a layer shows over `rect` of the picture's level, float32 (4, h, w), None for nothing, is
        what the picture does, as far as 8 bits tell: bool (h, w)."""
        wanted = self.planes(self.level, rect)
        seen = np.zeros_like(wanted) if seen is None else np.ascontiguousarray(seen)
        there = to_rgba8(wanted)
        near: np.ndarray = np.abs(wanted - seen).max(axis=0) <= ROUNDING
        same: np.ndarray = (there == to_rgba8(seen)).all(axis=-1) & (near | (there[..., 3] > 0))
        return same


class Compared:
    """A layer as it is, next to its picture; what was painted with examples is left alone."""

    def __init__(self, shown: Shown, growth: Growth, pyramid: Pyramid) -> None:
        self._shown, self._growth, self._before = shown, growth, pyramid
        self._wrong: dict[int, tuple[Rect, np.ndarray]] = {}  # by level, where the layer shows something else

    def put_right(self, first: int, doubtful: Sequence[TileKey] = ()) -> Pyramid:
        """Returns the layer with residuals of the levels from `first` on by which it shows the picture; outside the
        frame it shows what it did.

        At levels coarser than the picture's only what lies over something wrong is changed, and tiles that are
        `doubtful`: a level need not be the mean of the next finer one.
        """
        shown, pyramid = self._shown, self._before
        self._look(first)
        at, changed = Rect(0, 0, 0, 0), np.zeros((0, 0), bool)
        for level in range(first, shown.level + 1):
            rect = shown.frame.zoomed(level - shown.level).grown(_SPREAD if changed.any() else 0)
            where = _spread(changed, at, rect) | _laid(*self._wrong[level], rect)
            for key in doubtful:
                if key.level == level:
                    where |= _laid(key.rect, np.ones((TILE, TILE), bool), rect)
            at, changed = rect, np.zeros_like(where)
            for key in rect.tiles(level):
                part = key.rect.intersect(rect)
                mine = where[part.slices(rect)]
                if not (mine.any() or level == shown.level) or meets(self._growth, level, part):
                    continue
                wanted, other = self._compared(pyramid, level, part, mine)
                if other.any():
                    pyramid = with_values(pyramid, key, part, wanted, other)
                    changed[part.slices(rect)] = other
        return pyramid

    def _compared(self, pyramid: Pyramid, level: int, part: Rect, where: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Returns what `part` of a level is to show, and where that is something else, of `where` at least."""
        shown, seen = self._shown, evaluate(pyramid, level, part).rgba
        picture, before = shown.planes(level, part), evaluate(self._before, level, part).rgba
        inside = np.zeros(where.shape, bool)
        inside[_clipped(shown.within(level), part).slices(part)] = True
        # At the frame's edge a pixel may hold more than the picture does, and no less.
        wanted = np.where(inside | (picture[3] > before[3] + ROUNDING), picture, before)
        if level == shown.level:
            return wanted, np.where(inside, ~shown.is_same(seen, part), where & (seen != wanted).any(axis=0))
        return wanted, where & np.where(inside, ~_near(picture, seen), (seen != wanted).any(axis=0))

    def _look(self, first: int) -> None:
        """Finds what is wrong at the picture's level, and what of the coarser ones lies over it."""
        frame, level = self._shown.frame, self._shown.level
        wrong = np.zeros((frame.height, frame.width), bool)
        for key in frame.tiles(level) if first < level else ():
            part = key.rect.intersect(frame)
            if not meets(self._growth, level, part):
                seen = evaluate(self._before, level, part).rgba
                wrong[part.slices(frame)] = ~_near(self._shown.planes(level, part), seen)
        self._wrong[level] = frame, wrong
        for k in range(level - 1, first - 1, -1):
            at, finer = self._wrong[k + 1]
            even = at.evened()
            pairs = _laid(at, finer, even).reshape(even.height // 2, 2, even.width // 2, 2)
            self._wrong[k] = even.zoomed(-1), np.logical_or.reduce(pairs, axis=(1, 3))


def _near(wanted: np.ndarray, seen: np.ndarray) -> np.ndarray:
    """Tells where planes look alike, as near as 8 bits tell: bool (h, w)."""
    near: np.ndarray = np.abs(wanted - np.minimum(np.maximum(seen, 0), seen[3:])).max(axis=0) <= ROUNDING
    return near


def _clipped(rect: Rect, part: Rect) -> Rect:
    """Returns what of `rect` lies in `part`, an empty rectangle at its corner for nothing."""
    found = rect.intersect(part)
    return Rect(part.x0, part.y0, part.x0, part.y0) if found.empty else found


def _laid(at: Rect, there: np.ndarray, rect: Rect) -> np.ndarray:
    """Returns bools over `at` as bools over `rect`, False elsewhere: a new array."""
    out = np.zeros((rect.height, rect.width), bool)
    part = _clipped(at, rect)
    if not part.empty:
        out[part.slices(rect)] = there[part.slices(at)]
    return out


def _spread(changed: np.ndarray, at: Rect, rect: Rect) -> np.ndarray:
    """Returns which pixels of `rect`, of the level next finer than that of `at`, see a pixel of `changed` when they are
    expanded: a new array."""
    if not changed.any():
        return np.zeros((rect.height, rect.width), bool)
    near = np.pad(changed, 1).repeat(2, axis=0).repeat(2, axis=1)
    for axis in (0, 1):
        near |= np.roll(near, 1, axis) | np.roll(near, -1, axis)
    return _laid(at.grown(1).zoomed(1), near, rect)


def _padded(planes: np.ndarray, part: Rect, rect: Rect) -> np.ndarray:
    """Returns planes over `part` as planes over `rect`, 0 elsewhere: a new array."""
    out = np.zeros((4, rect.height, rect.width), np.float32)
    if not part.empty:
        out[:, *part.slices(rect)] = planes
    return out
