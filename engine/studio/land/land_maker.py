"""Tiles of land for the window, made on the engine's thread: one a step, the most urgent first."""

from __future__ import annotations

import math
import time
from collections import deque
from collections.abc import Callable
from dataclasses import replace

from engine.checks.owned import Owned
from engine.numeric.address import Rect
from engine.painting.value import Painting
from engine.studio.easel import Easel
from engine.studio.land.land_records import AskGround, AskLand, GroundFound, LandMade
from engine.studio.land.stroke_seen import StrokeSeen
from engine.studio.requests import Handlers
from engine.studio.sight import STEPS_KEPT
from engine.terrain.drape import cover_of, draped_root
from engine.terrain.plane import DEEP, Land, heights_of, land
from engine.terrain.seen.land_tiles import FINER, QUADS, TEXELS, TileKey
from engine.terrain.seen.tile_light import towards_sun
from engine.terrain.seen.tile_making import SHADE_MARGIN, TileMaker

LAND_CACHE = 32 << 20  # bytes of evaluated tiles while land is seen, those of the canvas, which is not, among them

_Where = Callable[[int], "list[Rect] | None"]


class LandMaker(Owned):
    """It belongs to the engine's thread.  The newest `AskLand` counts.  `clock` tells seconds."""

    def __init__(self, easel: Easel, clock: Callable[[], float] = time.perf_counter) -> None:
        self._easel, self._seen = easel, StrokeSeen(easel, clock)
        self._painting: Painting | None = None  # that the tiles are of
        self._maker: TileMaker | None = None
        self._revision = 0
        self._changes: deque[tuple[int, _Where]] = deque(maxlen=STEPS_KEPT)
        self._wanted: dict[TileKey, int] = {}
        self._open: deque[TileKey] = deque()
        self._canvas: int | None = None  # the level that was looked at before the land was
        self.handlers: Handlers = {AskLand: self._ask, AskGround: self._find}

    @property
    def pending(self) -> int:
        """Returns tiles to look at."""
        if self._wanted and self._seen.painting() is not self._painting:
            self._follow()
        return len(self._open)

    def step(self) -> None:
        """Makes the next tile that is lacking or old."""
        while self._open:
            key = self._open[0]
            if self._is_old(key):
                assert self._maker is not None
                tile = self._maker.make(key)
                self._open.popleft()
                self._wanted[key] = self._revision
                self._easel.send(LandMade(tile, self._revision))
                break
            self._open.popleft()
        if self._easel.live is None:
            self._easel.session.cache.shrink(LAND_CACHE, alone=True)

    def _ask(self, request: AskLand) -> None:
        cache, began = self._easel.session.cache, bool(self._wanted)
        self._wanted = dict(request.tiles)
        if not self._wanted:
            self._open.clear()
            self._maker = self._painting = None
            self._changes.clear()
            if began and cache.level is None:
                cache.look_at(self._canvas)
            return
        if cache.level is not None:
            self._canvas = cache.level
            cache.look_at(None)  # tiles of all levels are alike
        self._follow()
        self._open = deque(self._wanted)

    def _find(self, request: AskGround) -> None:
        self._follow()
        assert self._maker is not None
        level = min(request.level, DEEP)
        by = 2**level if level >= 0 else 1 / 2**-level
        x, y = int(request.x * by // 1), int(request.y * by // 1)
        z = float(self._maker.land.height(level, Rect.at(x, y, 1, 1))[0, 0])
        self._easel.send(GroundFound(request, max(z, 0.0) if self._maker.wet else z))

    def _follow(self) -> None:
        """Takes over the painting as it is now, and notes where it is another one than before."""
        painting, before = self._seen.painting(), self._painting
        if painting is before:
            return
        self._painting = painting
        cache = self._easel.session.cache
        where = None if before is None or _told(before) != _told(painting) else self._seen.between(before, painting)
        if where is None or self._maker is None:
            self._revision += 1
            self._changes.clear()
            seen = land(painting, cache=cache)
            wet = seen.sea != 0.0
            self._maker = TileMaker(seen, cover_of(seen, wet), wet)
            self._changes.append((self._revision, lambda level: None))
        else:
            self._revision += 1
            self._changes.append((self._revision, where))
            seen = _of(self._maker.land, painting)
            cover = replace(self._maker.cover, root=draped_root(seen))
            self._maker = TileMaker(seen, cover, self._maker.wet)
        self._open = deque(sorted(self._wanted, key=self._is_shaded_only))

    def _is_shaded_only(self, key: TileKey) -> bool:
        """Tells whether the newest change does not meet a tile itself: at most its shadow does, which can wait."""
        _, where = self._changes[-1]
        found = where(key.level + FINER)
        near = _texels_of(key).grown(SHADE_MARGIN)
        return found is not None and not any(area.meets(near) for area in found)

    def _reach(self, key: TileKey) -> Rect:
        """Returns where a change may be seen in a tile: around it, and towards the sun as far as shadows fall."""
        assert self._maker is not None
        near, (x, y, z) = _texels_of(key).grown(_SHADED), towards_sun()
        high = max(self._maker.cover.high - self._maker.cover.low, 0.0)
        far = min(math.ldexp(high / z, min(key.level + FINER, 64)), float(SHADE_MARGIN << 3 * FINER))
        dx, dy = round(far * x), round(far * y)
        return near.union(Rect(near.x0 + dx, near.y0 + dy, near.x1 + dx, near.y1 + dy))

    def _is_old(self, key: TileKey) -> bool:
        """Tells whether the window's copy of a tile is none, or shows something else than the painting."""
        held = self._wanted.get(key, self._revision)
        if held == self._revision:
            return False
        if held < 0 or not self._changes or self._changes[0][0] > held + 1:
            return True
        level, reach = key.level + FINER, self._reach(key)
        for revision, where in self._changes:
            found = where(level) if revision > held else []
            if found is None or any(area.meets(reach) for area in found):
                return True
        self._wanted[key] = self._revision
        return False


def _texels_of(key: TileKey) -> Rect:
    """Returns the texels of a tile."""
    return Rect.at(key.x * TEXELS, key.y * TEXELS, TEXELS, TEXELS)


_SHADED = SHADE_MARGIN * (1 << FINER) + QUADS  # texels around a tile in which a change may be seen in its light


def _of(before: Land, painting: Painting) -> Land:
    """Returns another painting seen as the same land."""
    return replace(before, painting=painting, _known={})


def _told(painting: Painting) -> tuple[object, ...]:
    """Returns what the land is told by, besides its paint."""
    node = heights_of(painting)
    frame = painting.frame
    return (
        (frame, None) if node is None else (frame, node.name, getattr(node, "scale", None), getattr(node, "sea", None))
    )
