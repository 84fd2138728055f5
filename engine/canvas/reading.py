"""The pixels of a layer: its paint, and over it what was painted with examples."""

from __future__ import annotations

import functools
from collections.abc import Mapping
from typing import Protocol

import numpy as np

from engine.canvas.evaluate import evaluate, evaluate_sparse, is_crowded, shown
from engine.canvas.growth import Growth, meets, over
from engine.canvas.layers import Layer
from engine.canvas.store import Pyramid
from engine.canvas.tile_cache import TileCache
from engine.numeric.address import TILE, Rect, TileKey, lies_within
from engine.numeric.column import Clip
from engine.texture.planes import COLOURS, Planes

_FEW = 4  # squares that are worked out at once
_FULL = 1.34  # times as large a rectangle may be as what is worked out of it
_SCREEN_TILE = 2 * TILE  # pixels along a side of what a tile of the screen shows, at most, that lies elsewhere
_CROWDED_BYTES = 96 << 20  # of the planes of a rectangle, from which on its ink is not worked out for the screen
_WORTH = 48 * 48  # pixels of a rectangle from which on whole tiles are worked out for it


class Read(Protocol):
    """The pixels of a layer: float32 (4, h, w), premultiplied, not necessarily clamped; None where it is empty."""

    def __call__(self, layer: Layer, level: int, rect: Rect) -> np.ndarray | None: ...


def layer_planes(layer: Layer, level: int, rect: Rect, cache: TileCache | None = None) -> np.ndarray | None:
    """Returns colour and alpha of `rect` of a level: premultiplied float32 (4, h, w) on the grid, None where a layer
    is empty.

    Not to be written to.  Without a cache, ink that adds nothing down to this level is left out on the way.
    """
    if cache is None:
        paint = shown(layer.pyramid, level, rect)
    else:
        found = _seen(layer.pyramid, level, rect, cache)
        paint = None if found is None else found.rgba
    return covered(paint, layer.growth, level, rect)


def _seen(pyramid: Pyramid, level: int, rect: Rect, cache: TileCache) -> Planes | None:
    """Returns the values of a rectangle, which the cache keeps; but where very many inks meet, as those of a thousand
    strokes do in a tile of a coarse level, colour and alpha alone, which it does not."""
    if not is_crowded(pyramid, level, rect, _CROWDED_BYTES):
        return evaluate_sparse(pyramid, level, rect, cache, lent=True)
    found = shown(pyramid, level, rect)
    return None if found is None else Planes(found)


def kept_planes(layer: Layer, level: int, rect: Rect, cache: TileCache) -> np.ndarray | None:
    """As `layer_planes`, of what is seen elsewhere than it lies: whole tiles are worked out and kept, as most of them
    are asked for again, by what is seen beside this."""
    pyramid = layer.pyramid
    if rect.area < _WORTH or pyramid.bare is not None:
        return layer_planes(layer, level, rect, cache)
    beside = max(rect.width, rect.height) <= _SCREEN_TILE and any(side % TILE for side in rect)
    known, whole = cache.view(pyramid, Clip(level, rect)) if beside else (False, None)
    if known:
        return covered(None if whole is None else whole.rgba, layer.growth, level, rect)
    found = {key: cache.view(pyramid, key) for key in rect.tiles(level)}
    if beside and not any(known for known, _ in found.values()):
        inner = [_mark(key) for key in found if lies_within(key.rect, rect)]
        if not any(cache.view(pyramid, mark)[0] for mark in inner):
            return covered(_by_itself(pyramid, Clip(level, rect), inner, cache), layer.growth, level, rect)
    for block in _blocks([key for key, (known, _) in found.items() if not known]):
        whole = _seen(pyramid, level, block, cache)
        for key in block.tiles(level):
            if key in found:
                found[key] = True, None if whole is None else whole.cut(*key.rect.slices(block))
    return covered(_gathered(found, level, rect), layer.growth, level, rect)


def _by_itself(pyramid: Pyramid, at: Clip, inner: list[Clip], cache: TileCache) -> np.ndarray | None:
    """Returns colour and alpha of a rectangle that cuts through tiles: it is worked out and kept as it is, as all that
    is seen beside it cuts through tiles at the same places.  Of the tiles that lie within it is kept that they were
    seen: what meets them at other places is worked out by tiles."""
    whole = evaluate_sparse(pyramid, at.level, at.rect, cache, tiled=False)
    if whole is not None and not whole.data.flags.c_contiguous:
        whole = Planes(np.ascontiguousarray(whole.data), whole.inks)
    cache.lend(pyramid, at, whole)  # as it is: empty inks were left out of hardly more than it
    for mark in inner:
        cache.adopt(pyramid, mark, None)
    return None if whole is None else whole.rgba


def _mark(key: TileKey) -> Clip:
    """Returns the key of that a tile was seen, within something that is kept as it is: nothing at its corner, so that
    it is no key of values."""
    corner = key.rect.x0, key.rect.y0
    return Clip(key.level, Rect(*corner, *corner))


def _gathered(tiles: Mapping[TileKey, tuple[bool, Planes | None]], level: int, rect: Rect) -> np.ndarray | None:
    """Returns colour and alpha of a rectangle of a level, from all tiles that it meets; None where nothing lies."""
    out: np.ndarray | None = None
    columns = _spans(rect.x0, rect.x1)
    for y, rows, rows_of_tile in _spans(rect.y0, rect.y1):
        for x, across, across_tile in columns:
            value = tiles[TileKey(level, x, y)][1]
            if value is None:
                continue
            if out is None:
                made = np.zeros if any(planes is None for _, planes in tiles.values()) else np.empty
                out = made((COLOURS, rect.height, rect.width), np.float32)
            out[:, rows, across] = value.data[:COLOURS, rows_of_tile, across_tile]
    return out


def _spans(first: int, last: int) -> list[tuple[int, slice, slice]]:
    """Returns the tiles along a side of a rectangle: the place, where in the rectangle, and which part of the tile."""
    out = []
    for place in range(first // TILE, (last - 1) // TILE + 1):
        begin, end = max(first, place * TILE), min(last, (place + 1) * TILE)
        out.append((place, slice(begin - first, end - first), slice(begin - place * TILE, end - place * TILE)))
    return out


def _blocks(missing: list[TileKey]) -> list[Rect]:
    """Returns squares of 2 x 2 tiles that hold some tiles; one rectangle where they fill most of it, and are few:
    of many, most may hold nothing."""
    blocks = {(key.x // 2, key.y // 2) for key in missing}
    squares = [Rect.at(x * 2 * TILE, y * 2 * TILE, 2 * TILE, 2 * TILE) for x, y in blocks]
    whole = functools.reduce(Rect.union, squares, Rect(0, 0, 0, 0))
    few = len(squares) <= _FEW
    return [whole] if few and 0 < whole.area <= _FULL * sum(square.area for square in squares) else squares


def covered(paint: np.ndarray | None, growth: Growth, level: int, rect: Rect) -> np.ndarray | None:
    """Returns a layer's paint, (4, h, w) or None, with a growth over it; the same array where that shows nothing."""
    if not growth or not meets(growth, level, rect):
        return paint
    out = np.zeros((4, rect.height, rect.width), np.float32) if paint is None else np.array(paint, order="C")
    over(out, growth, level, rect)
    return out


def layer_ink(layer: Layer, level: int, rect: Rect, cache: TileCache | None = None) -> Planes:
    """As `layer_planes`, with the ink that lies in the paint, as far as it is not covered."""
    found = evaluate(layer.pyramid, level, rect, cache)
    if not layer.growth:
        return found
    data = np.array(found.data, order="C")
    over(data, layer.growth, level, rect)
    return Planes(data, found.inks)
