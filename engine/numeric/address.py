"""Places on the canvas: rectangles and tiles with unbounded integer addresses.

Level L has 2^L pixels per level-0 pixel, along each axis.  All coordinates are Python integers of any size.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

TILE = 128  # pixels along a side


class TileKey(NamedTuple):
    """Tile (x, y) of a level covers pixels [x*TILE, (x+1)*TILE) x [y*TILE, (y+1)*TILE)."""

    level: int
    x: int
    y: int

    @property
    def rect(self) -> Rect:
        """Gives the pixels of the tile's level that it covers."""
        return Rect(self.x * TILE, self.y * TILE, (self.x + 1) * TILE, (self.y + 1) * TILE)


class Rect(NamedTuple):
    """Pixels [x0, x1) x [y0, y1) of some level."""

    x0: int
    y0: int
    x1: int
    y1: int

    @classmethod
    def at(cls, x: int, y: int, width: int, height: int) -> Rect:
        """Makes the rectangle of a size at a corner."""
        return cls(x, y, x + width, y + height)

    @property
    def width(self) -> int:
        """Gives the number of columns."""
        return self.x1 - self.x0

    @property
    def height(self) -> int:
        """Gives the number of rows."""
        return self.y1 - self.y0

    @property
    def empty(self) -> bool:
        """Tells whether no pixel lies within."""
        return self.x1 <= self.x0 or self.y1 <= self.y0

    @property
    def area(self) -> int:
        """Counts the pixels."""
        return 0 if self.empty else self.width * self.height

    def intersect(self, other: Rect) -> Rect:
        """Gives the pixels of both; what is empty if they do not meet."""
        x0, y0, x1, y1 = self
        left, top, right, bottom = other
        return Rect(
            left if left > x0 else x0,
            top if top > y0 else y0,
            right if right < x1 else x1,
            bottom if bottom < y1 else y1,
        )

    def meets(self, other: Rect) -> bool:
        """Tells whether both share a pixel."""
        return self.x0 < other.x1 and other.x0 < self.x1 and self.y0 < other.y1 and other.y0 < self.y1

    def union(self, other: Rect) -> Rect:
        """Returns the smallest rectangle that holds both; an empty one counts for nothing."""
        if self.empty:
            return other
        if other.empty:
            return self
        return Rect(min(self.x0, other.x0), min(self.y0, other.y0), max(self.x1, other.x1), max(self.y1, other.y1))

    def grown(self, by: int) -> Rect:
        """Gives the rectangle with `by` pixels more on every side."""
        return Rect(self.x0 - by, self.y0 - by, self.x1 + by, self.y1 + by)

    def evened(self) -> Rect:
        """Returns the smallest rectangle around this one whose corners have even coordinates."""
        return Rect(self.x0 & ~1, self.y0 & ~1, (self.x1 + 1) & ~1, (self.y1 + 1) & ~1)

    def parents(self) -> Rect:
        """Returns the coarser pixels that expand reads for an even rectangle: those above it and one more all
        around."""
        return Rect((self.x0 >> 1) - 1, (self.y0 >> 1) - 1, (self.x1 >> 1) + 1, (self.y1 >> 1) + 1)

    def zoomed(self, levels: int) -> Rect:
        """Returns the pixels `levels` finer (or coarser, if negative) that meet this rectangle's area."""
        if levels >= 0:
            return Rect(self.x0 << levels, self.y0 << levels, self.x1 << levels, self.y1 << levels)
        n = -levels
        return Rect(self.x0 >> n, self.y0 >> n, -(-self.x1 >> n), -(-self.y1 >> n))

    def slices(self, inside: Rect) -> tuple[slice, slice]:
        """Returns row and column slices of this rectangle in an array that covers `inside`."""
        return (
            slice(self.y0 - inside.y0, self.y1 - inside.y0),
            slice(self.x0 - inside.x0, self.x1 - inside.x0),
        )

    def within_tiles(self) -> Rect:
        """Returns the places of the tiles that meet this rectangle, which is not empty."""
        return Rect(self.x0 // TILE, self.y0 // TILE, (self.x1 - 1) // TILE + 1, (self.y1 - 1) // TILE + 1)

    def tiles(self, level: int) -> Iterator[TileKey]:
        """Yields the tiles of `level` that meet this rectangle, row by row."""
        if self.empty:
            return
        for y in range(self.y0 // TILE, (self.y1 - 1) // TILE + 1):
            for x in range(self.x0 // TILE, (self.x1 - 1) // TILE + 1):
                yield TileKey(level, x, y)


def lies_within(inner: Rect, outer: Rect) -> bool:
    """Tells whether all corners of a rectangle lie within another."""
    return outer.x0 <= inner.x0 and outer.y0 <= inner.y0 and inner.x1 <= outer.x1 and inner.y1 <= outer.y1
