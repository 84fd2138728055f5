"""The edit that lays paint over other paint at one level, as a stroke does."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass

import numpy as np

from engine.brush.stamp import Stamp
from engine.canvas.commit import commit
from engine.canvas.painted import tile_bounds
from engine.canvas.store import Pyramid
from engine.numeric.address import Rect, TileKey
from engine.numeric.grid import snapped
from engine.texture.planes import Planes

_ALPHA = 3


@dataclass(frozen=True, eq=False)
class _Laying:
    """The edit that lays paint: A = 1 - its alpha, B = the paint itself."""

    level: int
    tiles: list[TileKey]
    paint: Callable[[TileKey], Planes | None]
    spares_alpha: bool = False

    @property
    def rect(self) -> Rect:
        """Gives the tiles' bounds."""
        return tile_bounds(self.tiles)

    def stamp(self, key: TileKey, old: Planes) -> Stamp | None:
        """As `Edit.stamp`."""
        found = self.paint(key)
        if found is None:
            return None
        keep = np.float32(1) - np.clip(found.data[_ALPHA], 0, 1)
        return Stamp(snapped(keep), found.data, found.inks)


def laid_at(below: Pyramid, level: int, tiles: Iterable[TileKey], paint: Callable[[TileKey], Planes | None]) -> Pyramid:
    """Returns paint with what is told of tiles of a level over it, on the grid."""
    ordered = sorted(tiles, key=lambda key: (key.y, key.x))
    return commit(below, _Laying(level, ordered, paint)) if ordered else below
