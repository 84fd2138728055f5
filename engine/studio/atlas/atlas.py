"""Where there is paint, found while nothing else waits: in sight or not, the nearest, the map, small pictures."""

from __future__ import annotations

import math
from collections.abc import Callable, Generator
from typing import Any

import numpy as np

from engine.canvas.composite import composite
from engine.canvas.layers import Layer
from engine.canvas.reading import layer_planes
from engine.checks.owned import Owned
from engine.numeric.address import TILE, Rect
from engine.numeric.colour import to_premul8
from engine.painting.places import Bookmark
from engine.studio import requests as q
from engine.studio import results
from engine.studio.atlas.depths import Finest, finest_tiles, nearest_tiles, spots, tiles_within
from engine.studio.atlas.miniature import miniature
from engine.studio.easel import Easel

_COARSER = 3  # levels coarser than it is shown, at which what is in sight is looked at
_SEEN = 1 / 128  # alpha of paint that one sees
_WIDER = 3  # frames: paint beyond so much is no part of the map's picture
_CELL = 22  # pixels of the map that have one mark of a level
Told = Generator[
    results.Sought | results.PaintMap | None, None, None
]  # None between pieces of work, at last what is told


class Atlas(Owned):
    """It belongs to the engine's thread.  The newest request of a kind counts."""

    def __init__(self, easel: Easel) -> None:
        self._easel = easel
        self._sought: Told | None = None
        self._mapped: Told | None = None
        self._wanted: tuple[Bookmark, ...] = ()
        self._size = (1, 1)
        self._made: dict[str, tuple[Bookmark, tuple[int, int], object]] = {}
        self._finest: tuple[object, Finest] = (None, {})
        self.handlers: dict[type, Callable[[Any], None]] = {
            q.Seek: self._seek,
            q.AskMap: self._ask_map,
            q.AskMiniatures: self._ask_miniatures,
        }

    @property
    def pending(self) -> int:
        """Pieces of open work."""
        return (self._sought is not None) + (self._mapped is not None) + len(self._wanted)

    def step(self) -> None:
        """Does the next piece: of what is sought first, pictures of bookmarks last."""
        sought, mapped = self._sought, self._mapped
        if sought is not None:
            self._sought = None  # what fails is not tried again
            self._sought = sought if self._goes_on(sought) else None
        elif mapped is not None:
            self._mapped = None
            self._mapped = mapped if self._goes_on(mapped) else None
        elif self._wanted:
            bookmark, self._wanted = self._wanted[0], self._wanted[1:]
            self._picture(bookmark)

    def _goes_on(self, work: Told) -> bool:
        """Does a piece; True if there is more of it."""
        found = next(work)
        if found is not None:
            self._easel.send(found)
        return found is None

    # --- pictures of bookmarks ---------------------------------------------------------------------------------------

    def _ask_miniatures(self, request: q.AskMiniatures) -> None:
        self._size = request.size
        self._wanted = tuple(
            mark for mark in request.bookmarks if self._made.get(mark.name) != (mark, self._size, self._state)
        )

    @property
    def _state(self) -> object:
        return self._easel.session.state

    def _picture(self, bookmark: Bookmark) -> None:
        self._made[bookmark.name] = bookmark, self._size, self._state
        pixels = results.frozen(to_premul8(miniature(bookmark, self._size, self._seen)))
        self._easel.send(results.Picture(f"place {bookmark.name}", pixels))

    def _seen(self, level: int, rect: Rect) -> np.ndarray:
        """Returns what the painting shows of a rectangle, float32 (4, h, w)."""
        painting, cache = self._easel.session.painting, self._easel.session.cache

        def read(layer: Layer, level: int, rect: Rect) -> np.ndarray | None:
            return layer_planes(layer, level, rect, cache)

        return composite(painting.root, level, rect, read)

    def _painted(self, level: int, rect: Rect) -> bool:
        return bool((self._seen(level, rect)[3] >= _SEEN).any())

    def _finest_tiles(self) -> Generator[None, None, Finest]:
        root = self._easel.session.painting.root
        if self._finest[0] is not root:
            found = yield from finest_tiles(root, self._painted)
            self._finest = root, found
        return self._finest[1]

    # --- in sight, and the nearest -----------------------------------------------------------------------------------

    def _seek(self, request: q.Seek) -> None:
        self._sought = self._found(request)

    def _found(self, request: q.Seek) -> Told:
        level, sight = request.level, request.area
        coarse = sight.zoomed(-_COARSER)
        in_sight = bool((self._seen(level - _COARSER, coarse)[3] >= _SEEN / (1 << 2 * _COARSER)).any())
        if in_sight:
            yield results.Sought(level, sight, True)
            return
        finest = yield from self._finest_tiles()
        x, y = (sight.x0 + sight.x1) // 2, (sight.y0 + sight.y1) // 2
        nearest = yield from nearest_tiles(finest, level, sight)
        for own, tile in nearest:
            rect = Rect.at(tile[0] * TILE, tile[1] * TILE, TILE, TILE)
            painted = np.argwhere(self._seen(own, rect)[3] >= _SEEN)
            if len(painted):
                up = level - own
                at = [
                    min(max((v >> up if up >= 0 else v << -up) - corner, 0), TILE)
                    for v, corner in ((y, rect.y0), (x, rect.x0))
                ]
                row, column = painted[np.abs(painted - at).max(axis=1).argmin()].tolist()
                yield results.Sought(level, sight, False, (own, rect.x0 + column, rect.y0 + row))
                return
            yield None
        yield results.Sought(level, sight, False)

    # --- the map -----------------------------------------------------------------------------------------------------

    def _ask_map(self, request: q.AskMap) -> None:
        self._mapped = self._map(request.size)

    def _map(self, size: tuple[int, int]) -> Told:
        """Yields the map; its picture was sent before."""
        finest = yield from self._finest_tiles()
        frame = self._easel.session.painting.frame
        level, area = yield from _mapped_area(frame, finest, size)
        yield None
        pixels = results.frozen(to_premul8(self._seen(level, area)))
        self._easel.send(results.Picture("map", pixels))
        yield None
        found = yield from spots(finest, level, _CELL)
        yield results.PaintMap(level, area, found)


def _mapped_area(frame: Rect, finest: Finest, size: tuple[int, int]) -> Generator[None, None, tuple[int, Rect]]:
    """Returns the level and the pixels of it that a map of `size` pixels shows: the frame and the paint around it, as
    far as that is not too far away; pauses on the way."""
    most = Rect(
        frame.x0 - _WIDER * frame.width,
        frame.y0 - _WIDER * frame.height,
        frame.x1 + _WIDER * frame.width,
        frame.y1 + _WIDER * frame.height,
    )
    near = yield from tiles_within(finest, most)
    whole = frame if near.empty else frame.union(near.intersect(most))
    level = math.ceil(math.log2(min(size[0] / whole.width, size[1] / whole.height)))
    return level, whole.zoomed(level)
