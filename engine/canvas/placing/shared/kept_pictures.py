"""Pictures of groups that are shown again and again, kept tile by tile for as long as the layers stay the same."""

from __future__ import annotations

import numpy as np

from engine.canvas.placing.sampling import Picture
from engine.numeric.address import Rect, TileKey

_WORTH = 48 * 48  # pixels of a rectangle from which on whole tiles are made for it
_MOST = 256  # tiles with something in them: 64 MiB
_MOST_EMPTY = 1 << 14

_Key = tuple[int | None, TileKey]


class KeptPictures:
    """The newest tiles of some pictures.  Safe for several threads: at worst a tile is made twice."""

    def __init__(self) -> None:
        self._tiles: dict[_Key, np.ndarray] = {}
        self._empty: set[_Key] = set()

    def of(self, number: int | None, picture: Picture) -> Picture:
        """Returns the same picture, of a node of an id, made in whole tiles that are kept."""

        def kept(level: int, rect: Rect) -> np.ndarray | None:
            if rect.area < _WORTH:
                return picture(level, rect)
            out: np.ndarray | None = None
            for key in rect.tiles(level):
                tile = self._tile((number, key), picture)
                if tile is not None:
                    out = np.zeros((4, rect.height, rect.width), np.float32) if out is None else out
                    part = key.rect.intersect(rect)
                    out[:, *part.slices(rect)] = tile[:, *part.slices(key.rect)]
            return out

        return kept

    def _tile(self, held: _Key, picture: Picture) -> np.ndarray | None:
        found = self._tiles.get(held)
        if found is not None or held in self._empty:
            return found
        made = picture(held[1].level, held[1].rect)
        if made is None:
            if len(self._empty) >= _MOST_EMPTY:
                self._empty = set()
            self._empty.add(held)
            return None
        if len(self._tiles) >= _MOST:
            self._tiles = {}
        self._tiles[held] = made if made.flags.owndata else made.copy()
        return made
