"""What a ladder is: the picture, and below it the painting's own coarser levels, each half as wide."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

from engine.numeric.address import Rect

TILES_OF_BLOCK = 8  # along a side, at most
_MOST_BLOCKS = 16  # along a side of the picture, while a block may still become larger
_MOST_SMALL = 4  # of those that are a single tile: they take longer than a larger one


class Block(NamedTuple):
    """What is written at a time: pixels `rect` of a rung, counted from the rung's own corner."""

    rung: int
    rect: Rect


@dataclass(frozen=True, slots=True)
class Rung:
    """The picture once more, `step` levels coarser: `rect` of the painting's `level`."""

    step: int
    level: int
    rect: Rect

    @property
    def size(self) -> tuple[int, int]:
        """Gives width and height."""
        return self.rect.width, self.rect.height


@dataclass(frozen=True, slots=True)
class Ladder:
    """One rectangle at many levels, the picture itself first.

    `name`: what it is shown under; `depth`: bits of a channel; `tile`: pixels along a side of what readers get at a
    time.  A rung begins at that pixel of its level which is nearest to the picture's corner, so it is never off by more
    than half of its own pixel, and by nothing where the corner is a multiple of its pixels.
    """

    name: str
    rungs: tuple[Rung, ...]
    depth: int
    tile: int

    @classmethod
    def of(cls, name: str, level: int, area: Rect, depth: int, tile: int, smallest: int) -> Ladder:
        """Makes the ladder of `area` of a level, down to the first rung with no side above `smallest`."""
        rungs = [Rung(0, level, area)]
        while max(rungs[-1].size) > smallest:
            rungs.append(_coarser(area, level, len(rungs)))
        return cls(name, tuple(rungs), depth, tile)

    @property
    def block(self) -> int:
        """Gives the pixels along a side of a block: some tiles, more of them for a larger picture."""
        largest = max(self.rungs[0].size)
        side = self.tile if largest <= _MOST_SMALL * self.tile else 2 * self.tile
        while side < TILES_OF_BLOCK * self.tile and side * _MOST_BLOCKS < largest:
            side *= 2
        return side

    @property
    def pixels(self) -> int:
        """Counts the pixels of all rungs."""
        return sum(rung.rect.area for rung in self.rungs)

    def offset(self, rung: Rung) -> tuple[int, int]:
        """Returns where a rung begins, in pixels of the picture from its corner."""
        corner = self.rungs[0].rect
        return (rung.rect.x0 << rung.step) - corner.x0, (rung.rect.y0 << rung.step) - corner.y0

    def blocks(self) -> Iterator[Block]:
        """Yields what is to be written, the largest rung first; no two blocks share a file or a piece of one."""
        for rung in self.rungs:
            for rect in grid(rung.size, self.block):
                yield Block(rung.step, rect)


def grid(size: tuple[int, int], side: int, within: Rect | None = None) -> Iterator[Rect]:
    """Yields the squares of `side` pixels that an area of `size` is cut into, row by row; of those that begin
    `within` a rectangle where that is given."""
    whole = Rect.at(0, 0, *size)
    part = whole if within is None else within
    for y in range(-(-part.y0 // side) * side, part.y1, side):
        for x in range(-(-part.x0 // side) * side, part.x1, side):
            yield Rect.at(x, y, side, side).intersect(whole)


def _coarser(area: Rect, level: int, step: int) -> Rung:
    half = 1 << (step - 1)
    width, height = (max(1, -(-side >> step)) for side in (area.width, area.height))
    return Rung(step, level - step, Rect.at((area.x0 + half) >> step, (area.y0 + half) >> step, width, height))
