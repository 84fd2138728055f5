"""A tile of land made from the painting: heights, texels, light."""

from __future__ import annotations

from collections import OrderedDict

import numpy as np

from engine.numeric.address import Rect
from engine.terrain.drape import Cover
from engine.terrain.height_window import in_pixels
from engine.terrain.plane import Land
from engine.terrain.seen.land_tiles import BRIGHTEST, FINER, QUADS, TEXEL_RIM, TEXELS, UNIT, LandTile, TileKey
from engine.terrain.seen.tile_light import Square, lit, sunlit

SHADE_MARGIN = 24  # pixels of a level around what is looked at there
_FARTHER = 3  # levels from one square of those in which shadows are looked for to the next
_SQUARES = 3
_MOST_KEPT = 96  # windows


class TileMaker:
    """Makes tiles of one land.  It belongs to the thread that calls it; windows of heights are kept for neighbours."""

    def __init__(self, land: Land, cover: Cover, wet: bool) -> None:
        self.land, self.cover, self.wet = land, cover, wet
        self._windows: OrderedDict[tuple[int, Rect], np.ndarray] = OrderedDict()

    def make(self, key: TileKey) -> LandTile:
        """Returns a tile."""
        own, coarse = self._corners(key.level, _covered(key, 0)), self._corners(key.level - 1, _covered(key, 1))
        whole = _whole(own, key.level)
        parents = _whole(coarse, key.level - 1) * 2
        on = np.arange(QUADS + 1) >> 1
        heights = np.stack([whole, parents[on][:, on]], axis=2)
        base = int(heights.min())
        heights = (heights - base).astype(np.float32)
        fine, colours = self._texels(key)
        above = in_pixels(fine, key.level) - base * 2.0**-UNIT
        low, high = min(0.0, float(above.min()) * 2**UNIT), max(float(heights.max()), float(above.max()) * 2**UNIT)
        return LandTile(key, base, heights, low, high, above.astype(np.float32), colours)

    def _corners(self, level: int, rect: Rect) -> np.ndarray:
        """Returns heights, in pixels of level 0, of corners of a level: those of `rect`'s pixels and what ends it."""
        h = self.land.height(level, Rect(rect.x0 - 1, rect.y0 - 1, rect.x1 + 1, rect.y1 + 1))
        if self.wet:
            h = np.maximum(h, 0.0)
        out: np.ndarray = (h[:-1, :-1] + h[:-1, 1:] + (h[1:, :-1] + h[1:, 1:])) * 0.25
        return out

    def _kept(self, level: int, rect: Rect) -> np.ndarray:
        found = self._windows.get((level, rect))
        if found is None:
            found = self._windows[level, rect] = self._corners(level, rect)
            if len(self._windows) > _MOST_KEPT:
                self._windows.popitem(last=False)
        self._windows.move_to_end((level, rect))
        return found

    def _texels(self, key: TileKey) -> tuple[np.ndarray, np.ndarray]:
        """Returns heights of the corners of texels, and what the texels show."""
        level, inner = key.level + FINER, _inner(key)
        around = inner.grown(SHADE_MARGIN)
        corners = self._corners(level, around)
        base = float(corners[SHADE_MARGIN, SHADE_MARGIN])
        rel = in_pixels(corners - base, level).astype(np.float32)
        squares = [Square(rel, 1.0, (SHADE_MARGIN - TEXEL_RIM, SHADE_MARGIN - TEXEL_RIM), TEXELS + 2 * TEXEL_RIM)]
        for n in range(1, _SQUARES + 1):
            squares.append(self._around(key, level - n * _FARTHER, base))
        sides = TEXELS + 2 * TEXEL_RIM + 1
        seen = sunlit(squares, sides)
        shown = inner.grown(TEXEL_RIM)
        outer = shown.grown(SHADE_MARGIN - TEXEL_RIM)
        cut = slice(SHADE_MARGIN - TEXEL_RIM, SHADE_MARGIN - TEXEL_RIM + sides - 1)
        flat = (rel[:-1, :-1] + rel[:-1, 1:] + (rel[1:, :-1] + rel[1:, 1:])) * np.float32(0.25)
        colours = self.cover.colours(level, outer, flat, base)[cut, cut]
        seen = (seen[:-1, :-1] + seen[:-1, 1:] + (seen[1:, :-1] + seen[1:, 1:])) * np.float32(0.25)
        sea = float(in_pixels(-base, level)) if self.wet else -np.inf
        light = lit(flat, colours, seen, SHADE_MARGIN - TEXEL_RIM, sea)
        coded = np.rint(np.sqrt(np.clip(light * (1.0 / BRIGHTEST), 0.0, 1.0)) * 255.0).astype(np.uint8)
        mine = slice(SHADE_MARGIN, SHADE_MARGIN + TEXELS + 1)
        return corners[mine, mine], np.ascontiguousarray(coded)

    def _around(self, key: TileKey, level: int, base: float) -> Square:
        """Returns the land around a tile, at a coarser level; the same for tiles that lie in one pixel of it."""
        down, up = key.level - level, key.level + FINER - level
        inner, wide = _inner(key).grown(TEXEL_RIM), max(1, QUADS >> down)
        rect = Rect.at(key.x * QUADS >> down, key.y * QUADS >> down, wide, wide).grown(SHADE_MARGIN)
        h = self._kept(level, rect)
        scale = float(1 << up)
        rel = in_pixels(h - base, level).astype(np.float32)
        inset = (inner.x0 / scale) - rect.x0, (inner.y0 / scale) - rect.y0
        return Square(rel, scale, inset, inner.width / scale)


def _covered(key: TileKey, up: int) -> Rect:
    """Returns the pixels that a tile covers, of its own level or of one `up` coarser."""
    side = QUADS >> up
    return Rect.at(key.x * side, key.y * side, side, side)


def _inner(key: TileKey) -> Rect:
    """Returns the texels of a tile."""
    return Rect.at(key.x * TEXELS, key.y * TEXELS, TEXELS, TEXELS)


def _whole(heights: np.ndarray, level: int) -> np.ndarray:
    """Returns heights of level 0 in whole units of a level."""
    out: np.ndarray = np.rint(in_pixels(heights, level + UNIT)).astype(np.int64)
    return out
