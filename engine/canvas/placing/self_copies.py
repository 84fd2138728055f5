"""A picture that contains itself several times: each tile of each level is made once, from those of coarser levels.

Copies of copies are never told apart: there are as many as one likes, and no more tiles for that.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

import numpy as np

from engine.canvas.placing.placement import Placement
from engine.canvas.placing.sampling import source_level
from engine.canvas.placing.through import seen_first
from engine.numeric.address import Rect, TileKey

_AROUND = 3  # pixels of a source beside one that its sampling reads
Make = Callable[[TileKey], "np.ndarray | None"]  # composites a tile from what there is of coarser levels


class Tiles:
    """The tiles of what a node shows, which holds `copies` of itself; `make` may ask for tiles of coarser levels."""

    def __init__(self, copies: Sequence[Placement]) -> None:
        self._seen = [seen_first(one) for one in copies]
        self._made: dict[TileKey, np.ndarray | None] = {}

    def picture(self, level: int, rect: Rect, make: Make) -> np.ndarray | None:
        """Returns what the node shows of a rectangle: float32 (4, h, w), None where it is empty."""
        keys = list(rect.tiles(level))
        for key in sorted(self._missing(keys)):  # the coarsest first: no tile waits for another one
            if key not in self._made:
                self._made[key] = make(key)
        out: np.ndarray | None = None
        for key in keys:
            pixels = self._made[key]
            if pixels is not None:
                out = np.zeros((4, rect.height, rect.width), np.float32) if out is None else out
                part = key.rect.intersect(rect)
                out[:, *part.slices(rect)] = pixels[:, *part.slices(key.rect)]
        return out

    def _missing(self, keys: Sequence[TileKey]) -> set[TileKey]:
        """Returns the tiles that some need, themselves among them, which are not made yet."""
        found: set[TileKey] = set()
        waiting = list(keys)
        while waiting:
            key = waiting.pop()
            if key not in found and key not in self._made:
                found.add(key)
                waiting += self._read_by(key)
        return found

    def _read_by(self, key: TileKey) -> Iterator[TileKey]:
        for seen in self._seen:
            if not seen.vanishes(key.level):
                part = seen.meets(key.level, key.rect)
                if not part.empty:
                    at = source_level(seen.similarity, key.level)
                    yield from seen.similarity.box(part, key.level, at, _AROUND).tiles(at)
