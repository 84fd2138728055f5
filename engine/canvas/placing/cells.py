"""A part of a picture repeated without end."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import NamedTuple

import numpy as np

from engine.canvas.placing.pose import SourcePart
from engine.canvas.placing.sampling import Picture
from engine.numeric.address import Rect
from engine.numeric.pyramid import reduce

_FINER = 3  # levels by which a cell may be read finer, and averaged, where its sides lie within pixels
_MEAN = 64  # pixels along a cell whose mean stands for it where these levels do not do
_FEW = 4  # cells that are read whole, at most, for a rectangle


class Repeats(NamedTuple):
    """A rectangle, and as it is seen again and again in a picture that repeats a cell."""

    part: Rect
    cell: Rect

    def meets(self, rect: Rect) -> bool:
        """Tells whether it is seen anywhere in a rectangle."""
        return not self.intersect(rect).empty

    def intersect(self, rect: Rect) -> Rect:
        """Returns the least rectangle that holds all that is seen of it in another one."""
        x0, x1 = _seen(self.part.x0, self.part.x1, self.cell.width, rect.x0, rect.x1)
        y0, y1 = _seen(self.part.y0, self.part.y1, self.cell.height, rect.y0, rect.y1)
        return Rect(x0, y0, x1, y1)


SeenAreas = Callable[[int], Sequence[Rect | Repeats] | None]  # by level; None: anywhere


def _seen(first: int, last: int, period: int, low: int, high: int) -> tuple[int, int]:
    """Returns the least span of [low, high) that holds what lies there of a span and its repeats."""
    begin, end = -((last - 1 - low) // period), (high - 1 - first) // period
    if begin > end or first >= last:
        return low, low
    return max(low, first + begin * period), min(high, last + end * period)


def repeated(picture: Picture, part: SourcePart | None) -> Picture:
    """Returns the picture that shows a part of another one over and over, from that part's own place on; the other
    itself where there is no part."""
    if part is None:
        return picture

    def cells(level: int, rect: Rect) -> np.ndarray | None:
        by = max(0, part.whole_from - level)
        if by > _FINER:
            return _mean(picture, part, rect)
        found = _laid(picture, level + by, part.rect.zoomed(level + by - part.level), rect.zoomed(by))
        for _ in range(by):
            found = None if found is None else reduce(found)
        return found

    return cells


def _laid(picture: Picture, level: int, cell: Rect, rect: Rect) -> np.ndarray | None:
    """Returns the cells that a rectangle meets; `cell` is that of the picture, in pixels of the level."""
    if cell.area <= _FEW * rect.area:
        whole = picture(level, cell)
        if whole is None:
            return None
        rows = (rect.y0 - cell.y0) % cell.height + np.arange(rect.height)
        columns = (rect.x0 - cell.x0) % cell.width + np.arange(rect.width)
        spread: np.ndarray = whole[:, (rows % cell.height)[:, None], columns % cell.width]
        return spread
    out: np.ndarray | None = None
    for part, source in parts_by_cell(cell, rect):
        found = picture(level, source)
        if found is not None:
            out = np.zeros((4, rect.height, rect.width), np.float32) if out is None else out
            out[:, *part.slices(rect)] = found
    return out


def parts_by_cell(cell: Rect, rect: Rect) -> Iterator[tuple[Rect, Rect]]:
    """Yields the parts of a rectangle by the cells that they lie in, each with its place in the first cell."""
    for row in range((rect.y0 - cell.y0) // cell.height, (rect.y1 - 1 - cell.y0) // cell.height + 1):
        for column in range((rect.x0 - cell.x0) // cell.width, (rect.x1 - 1 - cell.x0) // cell.width + 1):
            right, down = column * cell.width, row * cell.height
            part = Rect(cell.x0 + right, cell.y0 + down, cell.x1 + right, cell.y1 + down).intersect(rect)
            yield part, Rect(part.x0 - right, part.y0 - down, part.x1 - right, part.y1 - down)


def _mean(picture: Picture, part: SourcePart, rect: Rect) -> np.ndarray | None:
    """Returns the mean of a cell that is small on the screen, wherever one looks."""
    level, cell = part.level, part.rect
    while max(cell.width, cell.height) > _MEAN:
        level, cell = level - 1, cell.zoomed(-1)
    found = picture(level, cell)
    if found is None:
        return None
    colour = found.reshape(4, -1).mean(axis=1, dtype=np.float64).astype(np.float32)
    return np.broadcast_to(colour[:, None, None], (4, rect.height, rect.width)).copy()
