"""What finer levels tell of a tile that is missing.

Where finer strokes lie, a level is the mean of the next finer one (rule U), v = R v', and that is what its residuals
make of it, v' = E v + residual'.  So v is where v <- R(E v + residual') comes to rest; what this leaves open for long,
its means over 2 x 2 pixels, is what the next coarser level shows.  Where nothing finer is stored, a level is mostly
what is expanded from the coarser one.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from engine.archive.grounds import with_tiles
from engine.archive.implied import Coded
from engine.canvas.evaluate import evaluate, step
from engine.canvas.store import Pyramid, Record
from engine.numeric.address import TILE, Rect, TileKey
from engine.numeric.grid import snapped, snapped_to
from engine.numeric.pyramid import reduce
from engine.texture.planes import COLOURS, Planes

_TILE = Rect(0, 0, TILE, TILE)
_NEAR = 4  # pixels around finer residuals in which the coarser level's own reach
_TURNS, _SWEEPS = 16, 2  # for each tile, and how often for all: neighbours tell one another


def finer_told(pyramid: Pyramid, keys: Sequence[TileKey], finer: Sequence[Coded], anchored: bool) -> Pyramid:
    """With residuals by which tiles of a level are what `finer`, tiles of the next level, say; `anchored`: the next
    coarser level is as it was."""
    levels: dict[int, dict[tuple[int, int], Record]] = {}
    for key, record, _ in finer:
        levels.setdefault(key.level, {})[key.x, key.y] = record
    for _ in range(_SWEEPS):
        for key in keys:
            told = _Told(with_tiles(pyramid, levels), key, anchored)
            if told.where.any():
                pyramid = with_values(pyramid, key, key.rect, told.values(), told.where)
    return pyramid


class _Told:
    """One tile; `where`: what finer tiles tell of, bool (128, 128)."""

    def __init__(self, pyramid: Pyramid, key: TileKey, anchored: bool) -> None:
        self._pyramid, self._key, self._anchored = pyramid, key, anchored
        self.where = self._near_residuals()

    def _near_residuals(self) -> np.ndarray:
        around = self._key.rect.grown(_NEAR)
        there = np.zeros((2 * around.height, 2 * around.width), bool)
        for key, record in self._pyramid.records(self._key.level + 1, around.zoomed(1)):
            if record.inks:
                return np.zeros((TILE, TILE), bool)
            x, y, r = key.rect.x0, key.rect.y0, record.rect
            at = Rect(x + r.x0, y + r.y0, x + r.x1, y + r.y1)
            part = at.intersect(around.zoomed(1))
            if not part.empty:
                there[part.slices(around.zoomed(1))] = record.data[:COLOURS, *part.slices(at)].any(axis=0)
        near: np.ndarray = np.logical_or.reduce(there.reshape(around.height, 2, around.width, 2), axis=(1, 3))
        for axis in (0, 1):
            windows = np.lib.stride_tricks.sliding_window_view(near, 2 * _NEAR + 1, axis)
            near = np.logical_or.reduce(windows, axis=-1)
        return near

    def values(self) -> np.ndarray:
        """Returns colour and alpha of the tile: float32 (4, 128, 128) on the grid."""
        key, at = self._key, self._key.rect.grown(1)
        found = evaluate(self._pyramid, key.level, at)
        data = found.data.copy()
        inner = data[:COLOURS, 1:-1, 1:-1]
        mean = evaluate(self._pyramid, key.level - 1, key.rect.zoomed(-1)).rgba
        for _ in range(_TURNS):
            below = step(self._pyramid, Planes(data, found.inks), at, key.level + 1, key.rect.zoomed(1))
            new = reduce(below.rgba) if below is not None else np.zeros_like(inner)
            if self._anchored:
                new += np.repeat(np.repeat(mean - reduce(new), 2, axis=1), 2, axis=2)
            inner[:, self.where] = snapped_to(snapped(new), self._pyramid.step)[:, self.where]
        return inner


def with_values(pyramid: Pyramid, key: TileKey, part: Rect, wanted: np.ndarray, where: np.ndarray) -> Pyramid:
    """With a residual by which `part` of a tile shows `wanted`, float32 (4, h, w), at the pixels of `where`, bool
    (h, w)."""
    rows, columns = part.slices(key.rect)
    old = _residual(pyramid, key)
    # Alpha is clamped where it is seen: without a residual of its own it is what the parents give.
    new = old.data.copy()
    new[3, rows, columns] = 0
    bare = evaluate(_with_record(pyramid, key, replace(old, held=new)), key.level, part).rgba
    new[:COLOURS, rows, columns] += np.rint((wanted - bare) / pyramid.step).astype(np.int32)
    new[:COLOURS, rows, columns] = np.where(where, new[:COLOURS, rows, columns], old.data[:COLOURS, rows, columns])
    new.flags.writeable = False
    return _with_record(pyramid, key, replace(old, held=new))


def _residual(pyramid: Pyramid, key: TileKey) -> Record:
    """Returns the record of a tile, over all of it."""
    stored = pyramid.levels.get(key.level)
    old = None if stored is None else stored.get((key.x, key.y))
    data = np.zeros((COLOURS if old is None else len(old.data), TILE, TILE), np.int32)
    if old is not None:
        data[:, *old.rect.slices(_TILE)] = old.data
    return Record(_TILE, data, () if old is None else old.inks, pyramid.depth)


def _with_record(pyramid: Pyramid, key: TileKey, record: Record) -> Pyramid:
    return with_tiles(pyramid, {key.level: {(key.x, key.y): record}})
