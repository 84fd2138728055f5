"""What ink implies of a tile's colour: textured paint is colour and amplitude times texture, and a file need not say
twice what the texture is.

Where strokes of ink lie, colour is close to

    v_c = p_c alpha + sum over inks i of (a_ic + s_ic alpha) S_i + q_ic a_ic

with the amplitudes a, the texture's appearance S, and numbers p, q, s that are the same for a whole tile: p and q are
the brushes' colours, s what rounding took from the amplitudes.  (C + a s (X - C), for all strokes of one X and a, has
that form exactly; engine/brush/ink.py.)  At levels coarser than an ink's base level its appearance is the mean of
the base level's (rule U of the canvas).  A file holds p, q, s and what is left: mostly nothing, or a rounding.

`without` takes colour out of the records of a pyramid, `restored` puts it back, level by level from the coarsest on,
since the sum is about values, and the value of a level stands on the coarser ones.  Where a texture has changed since
a file was saved, colour follows it as it is now; each tile carries the CRC-32 of its colour, so that one can tell.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import groupby
from typing import Any

import numpy as np
from isal import isal_zlib

from engine.archive import implied_kernels as kernels
from engine.canvas.evaluate import evaluate_sparse
from engine.canvas.store import Pyramid, Record
from engine.canvas.tile_cache import TileCache
from engine.numeric.address import TILE, Rect, TileKey
from engine.numeric.pyramid import reduce
from engine.painting.cascade import Cascade
from engine.texture.expression.placing.generated import Generated
from engine.texture.planes import COLOURS, Planes
from engine.texture.record import Instance

TEXTURES = 1  # raised when a texture's pixels change: what older files imply is then another picture
ABOVE = 2  # levels above an ink's base for which its appearance is worked out: 16 pixels of it for one
MOST = 4  # inks of a tile
STRIDE = 4  # of the pixels by which terms are found,
FEW = 1 << 12  # unless a tile has no more than these
SQUARE = 4  # tiles along the side of a square that is evaluated at a time
ABOVE_AT_ONCE = 8 << 20  # bytes of the planes above a square, up to which its tiles are worked on together
SHARED = 8  # inks whose appearance is held for a whole square
_NOTHING = Rect(0, 0, 0, 0)
ONE = 1 << 30  # unit of p, q, s
TERM_CAP = 1 << 40  # |p|, |q|, |s| in that unit

Tile = tuple[TileKey, Record]


@dataclass(frozen=True, slots=True)
class Implied:
    """What was taken out of a tile's colour: the inks, for red, green and blue the terms p, then q and s of each ink,
    in units of 2^-30, and the CRC-32 of the three planes of colour before, little-endian."""

    inks: tuple[Instance, ...]
    terms: tuple[int, ...]
    crc: int

    @property
    def factors(self) -> np.ndarray:
        """float32 (3, 1 + 2n)."""
        return (np.array(self.terms, np.float64) / ONE).astype(np.float32).reshape(3, 1 + 2 * len(self.inks))

    def is_of(self, data: np.ndarray) -> bool:
        """Tells whether the data of a tile have the colour that they had."""
        return bool(isal_zlib.crc32(data[:3].data) == self.crc)


Coded = tuple[TileKey, Record, Implied | None]


def ordered(tiles: Sequence[Tile]) -> list[Tile]:
    """Returns the tiles from the coarsest level on, those of a square together."""
    return sorted(tiles, key=lambda tile: (*square_of(tile[0]), tile[0].y, tile[0].x))


def square_of(key: TileKey) -> tuple[int, int, int]:
    """Names the square that a tile lies in."""
    return key.level, key.y // SQUARE, key.x // SQUARE


def without(values: Cascade, tiles: Sequence[Tile]) -> list[Coded]:
    """Returns tiles of a pyramid on which nothing waits, the colour that their ink implies taken out where that
    leaves less."""
    if not values.inked:
        return [(key, record, None) for key, record in tiles]
    out: list[Coded] = []
    for _, square in groupby(tiles, key=lambda tile: square_of(tile[0])):
        for part in _parts(list(square)):
            out.extend(_square_without(values, part))
    return out


def _parts(square: list[Tile]) -> list[list[Tile]]:
    """Returns the tiles of a square that are worked on together: all, or each by itself where so many inks lie that
    the planes above all of them would take too many bytes."""
    inks = set[Instance]().union(*(record.inks for _, record in square))
    together = 4 * _bounds(square).parents().area * (COLOURS + 3 * len(inks)) <= ABOVE_AT_ONCE
    return [square] if together else [[tile] for tile in square]


def needed(tiles: Iterable[Tile] | Sequence[Coded]) -> dict[int, Rect]:
    """By level, the even rectangle around all tiles of it."""
    found: dict[int, Rect] = {}
    for key, record, *_ in tiles:
        found[key.level] = found.get(key.level, _NOTHING).union(_at(key, record).evened())
    return found


def _square_without(values: Cascade, group: list[Tile]) -> Iterator[Coded]:
    rect = _bounds(group).parents().evened()
    above = values.at(group[0][0].level - 1, rect)
    tiles = [_Tile(key, record, rect, above, values.pyramid.step) for key, record in group]
    inks = [tile.inks() for tile in tiles]
    seen = _Seen(tiles, inks)
    for tile, there in zip(tiles, inks, strict=True):
        yield _tile_without(tile, there, seen)


def _bounds(group: Sequence[Tile] | Sequence[Coded]) -> Rect:
    return needed(group)[group[0][0].level]


def _at(key: TileKey, record: Record) -> Rect:
    x, y, r = key.x * TILE, key.y * TILE, record.rect
    return Rect(x + r.x0, y + r.y0, x + r.x1, y + r.y1)


_Arguments = tuple[
    np.ndarray, np.ndarray, np.ndarray, np.ndarray, np.ndarray, np.ndarray, np.ndarray, np.ndarray, np.float32
]  # fmt: skip


class _Tile:
    """A tile on its parents: `above`, what lies on `rect` of the level above, None for nothing; all of a grid of this
    `step`."""

    def __init__(self, key: TileKey, record: Record, rect: Rect, above: Planes | None, step: np.float32) -> None:
        self.key, self.record, self._step = key, record, step
        self.at = _at(key, record)
        self._above = Planes.empty(rect.height, rect.width) if above is None else above
        self._corner = self.at.evened().parents()
        self._place = self._corner.y0 - rect.y0, self._corner.x0 - rect.x0, self.at.y0 & 1, self.at.x0 & 1

    def inks(self) -> tuple[Instance, ...]:
        """Returns the inks that lie here and whose appearance is known, the finer ones first; none if there are too
        many of those that add texture of their own at this level, or things, which take longer to draw than to read."""
        found = list(self.record.inks)
        top, left, *_ = self._place
        for i, ink in enumerate(self._above.inks):
            inside = self._above.data, COLOURS + 3 * i, top, left, self._corner.height, self._corner.width
            if ink not in found and kernels.lies(*inside):
                found.append(ink)
        adding = [ink for ink in found if ink.base < self.key.level]
        others = [ink for ink in found if 0 <= ink.base - self.key.level <= ABOVE]
        dear = any(isinstance(ink, Generated) for ink in found)
        return () if dear or len(adding) > MOST else tuple([*adding, *others][:MOST])

    def arguments(self, inks: tuple[Instance, ...], seen: _Seen) -> _Arguments:
        """Returns what the kernels need of the tile for these inks."""
        sources, own = (
            np.array([COLOURS + 3 * there.index(ink) if ink in there else -1 for ink in inks], np.int64)
            for there in (self._above.inks, self.record.inks)
        )
        place = np.array(self._place, np.int64)
        planes, start = seen.at(inks, self.at)
        detail = _detail(inks, self.key.level, self.at)
        return self.record.data, self._above.data, place, sources, own, planes, start, detail, self._step


def _tile_without(tile: _Tile, inks: tuple[Instance, ...], seen: _Seen) -> Coded:
    key, record = tile.key, tile.record
    if not inks:
        return key, record, None
    arguments = tile.arguments(inks, seen)
    terms = np.rint(kernels.fit(*arguments, STRIDE if tile.at.area > FEW else 1) * ONE)
    if not (np.isfinite(terms).all() and np.abs(terms).max() <= TERM_CAP):
        return key, record, None
    implied = Implied(inks, tuple(map(int, terms.ravel())), isal_zlib.crc32(record.data[:3].data))
    data = record.data.copy()
    if kernels.exchange(*arguments, implied.factors, np.int32(-1), data) <= 0:
        return key, record, None
    data.flags.writeable = False
    return key, replace(record, held=data), implied


class _Seen:
    """The appearance of inks on some tiles of a square: evaluated once for all of them, unless there are too many."""

    def __init__(self, tiles: Sequence[_Tile], inks: Sequence[tuple[Instance, ...]]) -> None:
        places: dict[Instance, Rect] = {}
        for tile, there in zip(tiles, inks, strict=True):
            for ink in there:
                places[ink] = places.get(ink, _NOTHING).union(tile.at)
        self._level = tiles[0].key.level
        shared = len(places) <= SHARED
        self._held = {ink: (at, _appearance(ink, self._level, at)) for ink, at in places.items()} if shared else {}

    def at(self, inks: Sequence[Instance], at: Rect) -> tuple[np.ndarray, np.ndarray]:
        """Float32 (n, 1 or 3, H, W), and the row and the column where what lies on `at` begins, int64 (2,)."""
        if len(inks) == 1 and inks[0] in self._held:
            place, planes = self._held[inks[0]]
            return planes[None], np.array([at.y0 - place.y0, at.x0 - place.x0], np.int64)
        return _stacked([self._cut(ink, at) for ink in inks], at), np.zeros(2, np.int64)

    def _cut(self, ink: Instance, at: Rect) -> np.ndarray:
        if ink not in self._held:
            return _appearance(ink, self._level, at)
        place, planes = self._held[ink]
        return planes[:, *at.slices(place)]


def _appearance(ink: Instance, level: int, at: Rect) -> np.ndarray:
    """Appearance of an ink at a level from `ABOVE` above its base on: float32 (1 or 3, h, w), to be read only."""
    lacking = max(ink.base - level, 0)
    seen = ink.appearance(level + lacking, at.zoomed(lacking))[:3]
    for _ in range(lacking):
        seen = reduce(seen)
    return np.require(seen, np.float32, ["C", "W"])  # of one type, for which the kernels are compiled


def _detail(inks: Sequence[Instance], level: int, at: Rect) -> np.ndarray:
    """Returns what the inks add at a level: float32 (n, 1 or 3, h, w), n = 0 if they add nothing."""
    if all(ink.base >= level for ink in inks):
        return np.empty((0, 1, 0, 0), np.float32)
    added = [ink.bandpass(level, at) for ink in inks]
    return _stacked([np.zeros((1, 1, 1), np.float32) if planes is None else planes for planes in added], at)


def _stacked(found: Sequence[np.ndarray], at: Rect) -> np.ndarray:
    """Returns planes (1 or 3, h, w) each as one array: float32 (n, 1 or 3, h, w)."""
    planes = max(len(each) for each in found)
    return np.stack([np.broadcast_to(each, (planes, at.height, at.width)) for each in found]).astype(
        np.float32, copy=False
    )


def restored(pyramid: Pyramid, tiles: Sequence[Coded], run: Callable[..., Iterable[Any]] = map) -> int:
    """Puts the colour back into those of `tiles` from which it was taken, all of them in their places in `pyramid`.

    `run` maps a function over a list, maybe on several threads.  Returns how many tiles have another colour than they
    had: their texture changed.
    """
    lacking = sorted((tile for tile in tiles if tile[2] is not None), key=lambda tile: square_of(tile[0]))
    values, changed = Cascade(pyramid, needed(lacking)), 0
    for _, found in groupby(lacking, key=lambda tile: tile[0].level):
        squares = [list(square) for _, square in groupby(found, key=lambda tile: square_of(tile[0]))]
        changed += sum(run(partial(_square_restored, values), squares))
    return changed


def _square_restored(values: Cascade, square: Sequence[Coded]) -> int:
    rect = _bounds(square).parents().evened()
    above = values.at(square[0][0].level - 1, rect)
    changed = 0
    for (_, record, implied), data in zip(square, _restored(values.pyramid.step, square, rect, above), strict=True):
        record.exchange(data)
        changed += implied is not None and not implied.is_of(data)
    return changed


def square_restored(pyramid: Pyramid, square: Sequence[Coded], cache: TileCache) -> list[np.ndarray]:
    """Returns the data of tiles of one square with the colour that was taken out of them, read-only."""
    rect = _bounds(square).parents().evened()
    above = evaluate_sparse(pyramid, square[0][0].level - 1, rect, cache)
    if above is not None:
        above = Planes(np.ascontiguousarray(above.data), above.inks)
    return list(_restored(pyramid.step, square, rect, above))


def _restored(step: np.float32, square: Sequence[Coded], rect: Rect, above: Planes | None) -> Iterator[np.ndarray]:
    """Yields the data of tiles, in units of `step`; `above`, what lies on `rect` of the coarser level."""
    tiles = [_Tile(key, record, rect, above, step) for key, record, _ in square]
    entries = [implied for _, _, implied in square if implied is not None]
    seen = _Seen(tiles, [implied.inks for implied in entries])
    for tile, implied in zip(tiles, entries, strict=True):
        data = tile.record.data.copy()
        kernels.exchange(*tile.arguments(implied.inks, seen), implied.factors, np.int32(1), data)
        data.flags.writeable = False
        yield data
